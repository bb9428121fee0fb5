//! The declarations of one element as a `style` attribute of bounded length.

use std::fmt::Write as _;

use rustc_hash::FxHashSet;

use super::css_sheet::{self, Declaration};
use super::tag_limits::too_much;
use crate::error::Error;

/// With more declarations than this, only the last one of each property is kept. Readers take quadratic time
/// in the number of declarations.
const MAX_UNMERGED_DECLARATIONS: usize = 64;
/// Most declarations of an element after that.
const MAX_PROPERTIES: usize = 1000;
/// Most bytes of a style that is not a plain list of declarations.
const MAX_STYLE_BYTES: usize = 4096;

/// Whether a style is longer than usual.
pub(crate) fn is_long(style: &str) -> bool {
    style.len() > MAX_STYLE_BYTES
}

/// Declarations of style sheets, followed by those of the element itself, which take precedence. Escaped for
/// XML.
///
/// # Errors
/// If the style exceeds the limits.
pub(crate) fn merged_declarations(declared: &[Declaration], own: &str) -> Result<String, Error> {
    let many = declared.len() + own.matches(';').count() > MAX_UNMERGED_DECLARATIONS;
    let listed = if many || is_long(own) { css_sheet::declarations(own) } else { None };
    let rest = if listed.is_some() { "" } else { own };
    let mut all: Vec<Declaration> = declared.iter().copied().chain(listed.into_iter().flatten()).collect();
    if many {
        // Repeated properties may be fallbacks for older programs. That many repetitions are not.
        let mut known: FxHashSet<(&str, bool)> = FxHashSet::default();
        all = all.into_iter().rev().filter(|d| known.insert((d.name, d.important))).collect();
        all.reverse();
    }
    if all.len() > MAX_PROPERTIES || is_long(rest) {
        return Err(too_much("declarations in a style"));
    }
    let mut out = String::new();
    for Declaration { name, value, important } in all {
        let _ = write!(out, "{name}:{}{};", escaped(value), if important { " !important" } else { "" });
    }
    Ok(out + &escaped(rest))
}

/// Escapes text for XML.
pub(crate) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn merged_declarations_have_a_bounded_length() {
        let one = Declaration { name: "fill", value: "a<b", important: false };
        assert_eq!(
            merged_declarations(&[one], "fill:red;fill:url(#x)").unwrap(),
            "fill:a&lt;b;fill:red;fill:url(#x)"
        );
        let own = "fill:red;stroke:#000!important;fill:blue;".repeat(20_000);
        assert_eq!(merged_declarations(&[one; 300], &own).unwrap(), "stroke:#000 !important;fill:blue;");
        let names: String = (0..2000).map(|i| format!("p{i}:1;")).collect();
        assert!(
            merged_declarations(&[], &names).unwrap_err().to_string().contains("declarations in a style")
        );
        assert!(merged_declarations(&[], &"{".repeat(5000)).is_err());
    }
}
