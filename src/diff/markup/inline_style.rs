//! [`said`]: what is declared for one element, as an attribute `style` that readers take no long time for.

use std::fmt::Write as _;

use rustc_hash::FxHashSet;

use super::style_sheet::{self, Declaration};
use super::tag_limits::too_much;
use crate::error::Error;

/// Declarations of which only the last of each property is kept, and properties that an element may have: readers take time in
/// proportion to the square of them.
const MANY: usize = 64;
const MOST_PROPERTIES: usize = 1000;
/// Bytes of a style of another form.
const LONG: usize = 4096;

/// Whether a style is longer than any that is written by hand or program.
pub(crate) fn is_long(style: &str) -> bool {
    style.len() > LONG
}

/// What sheets declare for an element, and then what it says of itself, which wins: with XML's signs as entities.
///
/// # Errors
/// Where it is more than is read.
pub(crate) fn said(declared: &[Declaration], own: &str) -> Result<String, Error> {
    let many = declared.len() + own.matches(';').count() > MANY;
    let listed = if many || is_long(own) { style_sheet::declarations(own) } else { None };
    let rest = if listed.is_some() { "" } else { own };
    let mut all: Vec<Declaration> = declared.iter().copied().chain(listed.into_iter().flatten()).collect();
    if many {
        // What is said of one thing several times may be meant for programs that do not know the last of it; said so often
        // it is not.
        let mut known: FxHashSet<(&str, bool)> = FxHashSet::default();
        all = all.into_iter().rev().filter(|d| known.insert((d.name, d.important))).collect();
        all.reverse();
    }
    if all.len() > MOST_PROPERTIES || is_long(rest) {
        return Err(too_much("declarations in a style"));
    }
    let mut out = String::new();
    for Declaration { name, value, important } in all {
        let _ = write!(out, "{name}:{}{};", escaped(value), if important { " !important" } else { "" });
    }
    Ok(out + &escaped(rest))
}

/// A text with XML's signs as entities.
pub(crate) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn styles_are_as_long_as_there_are_properties() {
        let one = Declaration { name: "fill", value: "a<b", important: false };
        assert_eq!(said(&[one], "fill:red;fill:url(#x)").unwrap(), "fill:a&lt;b;fill:red;fill:url(#x)");
        let own = "fill:red;stroke:#000!important;fill:blue;".repeat(20_000);
        assert_eq!(said(&[one; 300], &own).unwrap(), "stroke:#000 !important;fill:blue;");
        let names: String = (0..2000).map(|i| format!("p{i}:1;")).collect();
        assert!(said(&[], &names).unwrap_err().to_string().contains("declarations in a style"));
        assert!(said(&[], &"{".repeat(5000)).is_err());
    }
}
