//! XML and CSS of an SVG file, read in time and memory in proportion to the length of the file.
//!
//! 1. [`input_limits`] parses the XML and refuses files above plain limits on size, depth and number of
//!    elements.
//! 2. [`css_sheet`] reads the CSS rules of `style` elements, word by word with [`css_reader`].
//! 3. [`cascade`] finds the rules that apply to an element, within a limit on the work for a file.
//!
//! Also: [`number_scan`] decimals and range of the numbers of an attribute; [`url_references`] ids in `url(#…)`.

use std::fmt::Write as _;

use rustc_hash::FxHashSet;

use self::css_sheet::Declaration;
use self::input_limits::too_much;
use crate::error::Error;

pub(crate) mod cascade;
mod css_reader;
pub(crate) mod css_sheet;
pub(crate) mod input_limits;
pub(crate) mod number_scan;
mod url_references;

pub(crate) use url_references::references;

/// In longer styles, only the last declaration of each property is kept. Readers take quadratic time.
const MAX_STYLE_BYTES: usize = 4096;
/// Most declarations of an element after that.
const MAX_DECLARATIONS: usize = 1000;

/// Whether an element belongs to SVG.
pub(crate) fn is_svg(node: &usvg::roxmltree::Node) -> bool {
    matches!(node.tag_name().namespace(), None | Some("http://www.w3.org/2000/svg"))
}

/// Appends text that is escaped for XML.
pub(crate) fn escape(out: &mut String, text: &str) {
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            _ => out.push(c),
        }
    }
}

/// Declarations of style sheets, followed by those of the element itself, which take precedence. Escaped for
/// XML.
///
/// # Errors
/// If the style exceeds the limits.
pub(crate) fn style_text(declared: &[Declaration], own: &str) -> Result<String, Error> {
    let mut out = String::new();
    write_declarations(&mut out, declared);
    escape(&mut out, own);
    if out.len() <= MAX_STYLE_BYTES {
        return Ok(out);
    }
    let (own, rest) = match css_sheet::declarations(own) {
        Some(list) => (list, ""),
        None if own.len() <= MAX_STYLE_BYTES => (Vec::new(), own),
        None => return Err(too_much("declarations in a style")),
    };
    let mut known: FxHashSet<(&str, bool)> = FxHashSet::default();
    let all = declared.iter().chain(&own).rev();
    let mut last: Vec<&Declaration> = all.filter(|d| known.insert((d.name, d.important))).collect();
    if last.len() > MAX_DECLARATIONS {
        return Err(too_much("declarations in a style"));
    }
    last.reverse();
    out.clear();
    write_declarations(&mut out, last);
    escape(&mut out, rest);
    Ok(out)
}

/// Appends declarations that are escaped for XML.
fn write_declarations<'a>(out: &mut String, list: impl IntoIterator<Item = &'a Declaration<'a>>) {
    for Declaration { name, value, important } in list {
        let _ = write!(out, "{name}:");
        escape(out, value);
        out.push_str(if *important { " !important;" } else { ";" });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn style_text_has_a_bounded_length() {
        let one = Declaration { name: "fill", value: "a<b", important: false };
        assert_eq!(style_text(&[one], "fill:red;fill:url(#x)").unwrap(), "fill:a&lt;b;fill:red;fill:url(#x)");
        let own = "fill:red;stroke:#000!important;fill:blue;".repeat(20_000);
        assert_eq!(style_text(&[one; 300], &own).unwrap(), "stroke:#000 !important;fill:blue;");
        let names: String = (0..2000).map(|i| format!("p{i}:1;")).collect();
        assert!(style_text(&[], &names).unwrap_err().to_string().contains("declarations in a style"));
        assert!(style_text(&[], &"{".repeat(5000)).is_err());
    }
}
