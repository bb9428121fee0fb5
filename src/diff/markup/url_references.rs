//! Ids in `url(#…)` references of attribute values.

/// Ids that a value refers to by `url(#…)`, and `None` for references to other files.
pub(crate) fn references(value: &str) -> impl Iterator<Item = Option<&str>> {
    value.split("url(").skip(1).map(|rest| {
        let id = rest.trim_start_matches(['"', '\'', ' ']).strip_prefix('#')?;
        id.split(['"', '\'', ')', ' ']).next()
    })
}
