//! Canonical form of an SVG file: paths start and sort as in the exporter, and everything else stays as it
//! is.
//!
//! The text is edited in place. Values of `d` and `data-axis` are replaced, and neighbouring paths of equal
//! paint are sorted. Paths whose rendering cannot be derived from attributes alone are only rounded, or left
//! unchanged.

use std::borrow::Cow;
use std::ops::Range;

use crate::parallel::prelude::*;
use kurbo::BezPath;
use usvg::roxmltree::{Attribute, Document, Node};

use super::computed_style::{ComputedStyle, DocumentContext, PathRewrite, painted_alike};
use super::{path_parser, presentation_attributes};
use crate::diff::curves::segment::points;
use crate::diff::markup::{input_limits, is_svg, number_scan};
use crate::error::Error;
use crate::export::encoding::decimals::{Decimals, MAX_DECIMALS};
use crate::export::paths::canonical_path::{CanonicalWriter, PathForm};
use crate::export::paths::path_piece::PathPoint;
use crate::export::svg::mark_order::MarkName;

/// Largest product of coordinate steps and path pieces for which relative coordinates read back exactly. Sums
/// of 53-bit numbers are each off by half a bit.
const MAX_EXACT_STEPS: f64 = (1u64 << 50) as f64;

/// Rewrites an SVG file in the form of this exporter, so that version control shows small differences. The
/// picture stays the same.
///
/// Marks are sorted, paths start at their least point, and numbers are rounded to `precision` decimals, at
/// most 8. With `None` the number of decimals of the file is kept. Styles become attributes where that is
/// exact. Otherwise only path data and the order of neighbouring paths of equal paint change.
///
/// Paths are only rounded where scripts, external style sheets, references or animations might depend on
/// them. Invalid paths and paths with arcs or unused moves stay unchanged.
///
/// ```
/// let svg = |paths: &str| {
///     format!(r##"<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9" fill="none" stroke="#000">{paths}</svg>"##)
/// };
/// let form = ligne::diff::canonical_svg(&svg(r#"<path d="M 8,5 L 1,5"/> <path d="M 2 1 H 4"/>"#), None)?;
/// assert_eq!(form, svg(r#"<path d="M2 1h2"/> <path d="M1 5h7"/>"#));
/// # Ok::<(), ligne::Error>(())
/// ```
///
/// # Errors
/// If the text is not SVG, or if reading it might take more time or memory than its length justifies. The
/// error has no file name.
pub fn canonical_svg(text: &str, precision: Option<u8>) -> Result<String, Error> {
    let plain = presentation_attributes::plain(text)?;
    let text = plain.as_deref().unwrap_or(text);
    let document = input_limits::parse(text)?;
    let paths = Paths::of(&document);
    let precision = precision.unwrap_or_else(|| paths.decimals()).min(MAX_DECIMALS);
    let written: Vec<RewrittenPath> =
        paths.found.par_iter().map(|found| written(text, found, Decimals::new(precision))).collect();
    let mut out = String::with_capacity(text.len());
    let mut cursor = 0;
    let mut at = 0;
    for run in paths.found.chunk_by(|a, b| a.run == b.run) {
        let mut order: Vec<usize> = (at..at + run.len()).collect();
        order.sort_by_cached_key(|index| written.get(*index).zip(paths.found.get(*index)).map(key));
        for (slot, from) in run.iter().zip(order) {
            let range = slot.node.range();
            if let (Some(before), Some(written)) = (text.get(cursor..range.start), written.get(from)) {
                out.push_str(before);
                out.push_str(&written.element);
                cursor = range.end;
            }
        }
        at += run.len();
    }
    out.push_str(text.get(cursor..).unwrap_or_default());
    Ok(out)
}

/// Paths of a document, in document order.
struct Paths<'a, 'input> {
    found: Vec<PathElement<'a, 'input>>,
    afar: DocumentContext<'a>,
    /// Number of runs so far.
    runs: usize,
    /// Byte where the root element starts. Entity declarations before it may also contain elements.
    begin: usize,
}

/// A path element of the document.
struct PathElement<'a, 'input> {
    node: Node<'a, 'input>,
    leave: PathRewrite,
    /// Number of the run of paths that may be exchanged with this one.
    run: usize,
}

impl<'a, 'input> Paths<'a, 'input> {
    fn of(document: &'a Document<'input>) -> Self {
        let root = document.root_element();
        let afar = DocumentContext::of(document);
        let look = ComputedStyle::new(&afar);
        let mut paths = Self { found: Vec::new(), afar, runs: 0, begin: root.range().start };
        paths.inside(root, &look);
        paths
    }

    /// Collects the paths of an element. The recursion is limited because files with deeper nesting are
    /// refused.
    fn inside(&mut self, node: Node<'a, 'input>, around: &ComputedStyle<'a>) {
        let look = around.child_style(node, &self.afar);
        // The previous path, while no other content separates it from the next one.
        let mut neighbour: Option<Node> = None;
        for child in node.children() {
            if child.is_text() && child.text().is_none_or(|text| text.trim().is_empty()) {
                continue;
            }
            let before = neighbour.take();
            if !child.is_element() || !is_svg(&child) {
                continue;
            }
            if child.tag_name().name() != "path" {
                self.inside(child, &look);
                continue;
            }
            if child.range().start < self.begin {
                continue;
            }
            let own = look.child_style(child, &self.afar);
            let free = own.may_be_exchanged(child);
            if !(free && before.is_some_and(|before| painted_alike(before, child))) {
                self.runs += 1;
            }
            neighbour = free.then_some(child);
            self.found.push(PathElement { node: child, leave: own.allowed_rewrite(child), run: self.runs });
        }
    }

    /// Largest number of decimals in any path data.
    fn decimals(&self) -> u8 {
        let data = |found: &PathElement| {
            let values = PATH_DATA_ATTRIBUTES.iter().filter_map(|name| found.node.attribute(*name));
            values.map(|value| number_scan::scan(value).decimals).max().unwrap_or(0)
        };
        self.found.par_iter().map(data).max().unwrap_or(0)
    }
}

/// Attributes that contain path data.
const PATH_DATA_ATTRIBUTES: [&str; 2] = ["d", "data-axis"];

/// A path after rewriting.
struct RewrittenPath<'a> {
    /// Text of the whole element.
    element: Cow<'a, str>,
    /// Byte range of the path data in `element`.
    data: Range<usize>,
    /// Start point of the path.
    start: Option<PathPoint>,
}

/// Sort key of a path, as in the exporter.
fn key<'a>(
    (written, found): (&'a RewrittenPath, &'a PathElement),
) -> (MarkName<'a>, Option<PathPoint>, &'a str) {
    let of = |name| found.node.attribute(name);
    let name = MarkName {
        classes: of("class").unwrap_or_default(),
        part: of("data-part"),
        material: of("data-material"),
        tone: of("data-tone").and_then(|tone| tone.parse().ok()),
    };
    (name, written.start, written.element.get(written.data.clone()).unwrap_or_default())
}

/// Rewrites one path element.
fn written<'a>(text: &'a str, found: &PathElement, decimals: Decimals) -> RewrittenPath<'a> {
    let whole = found.node.range();
    let source = text.get(whole.clone()).unwrap_or_default();
    let mut written = RewrittenPath { element: Cow::Borrowed(source), data: 0..0, start: None };
    let own = |attribute: &Attribute| {
        attribute.namespace().is_none() && PATH_DATA_ATTRIBUTES.contains(&attribute.name())
    };
    // Last attribute first, so that the ranges of earlier ones stay valid.
    let mut attributes: Vec<Attribute> = found.node.attributes().filter(own).collect();
    attributes.sort_by_key(|attribute| std::cmp::Reverse(attribute.range_value().start));
    for attribute in attributes {
        let Some(range) = value_range(text, &attribute, &whole) else { continue };
        let is_axis = attribute.name() != "d";
        let form = match found.leave.form {
            PathForm::Kept => PathForm::Kept,
            _ if is_axis => PathForm::Stroked,
            form => form,
        };
        let (data, start) = rewritten(attribute.value(), PathRewrite { form, ..found.leave }, decimals);
        let length = data.as_ref().map_or(range.len(), String::len);
        if let Some(data) = data.filter(|data| source.get(range.clone()) != Some(data)) {
            written.element.to_mut().replace_range(range.clone(), &data);
        }
        if is_axis {
            let grown = |at: usize| if at >= range.end { at - range.len() + length } else { at };
            written.data = grown(written.data.start)..grown(written.data.end);
        } else {
            written.data = range.start..range.start + length;
            written.start = start;
        }
    }
    written
}

/// Byte range of an attribute's value inside its element; `None` if it is not quoted there.
fn value_range(text: &str, attribute: &Attribute, element: &Range<usize>) -> Option<Range<usize>> {
    let range = attribute.range_value();
    let quote = text.as_bytes().get(range.start.checked_sub(1)?)?;
    let quoted = matches!(quote, b'"' | b'\'') && text.as_bytes().get(range.end) == Some(quote);
    let inside = element.start < range.start && range.end < element.end;
    (quoted && inside).then(|| range.start - element.start..range.end - element.start)
}

/// Path data in canonical form and its start point. The data is `None` where it must stay unchanged.
fn rewritten(data: &str, leave: PathRewrite, decimals: Decimals) -> (Option<String>, Option<PathPoint>) {
    let Some(read) = path_parser::read(data) else { return (None, None) };
    let mut canonical = CanonicalWriter::new(decimals);
    let own_start = read.start.map(|start| canonical.step(start));
    if read.has_arcs
        || read.has_lone_moves
        || read.path.elements().is_empty()
        || !is_exact(&read.path, decimals)
    {
        return (None, own_start);
    }
    let mut out = Vec::with_capacity(data.len());
    let start = canonical.write(&mut out, &read.path, leave.form);
    if leave.all_points && canonical.has_lost_points() {
        return (None, own_start);
    }
    (String::from_utf8(out).ok(), start)
}

/// Whether the written text reads back as exactly the same steps.
fn is_exact(path: &BezPath, decimals: Decimals) -> bool {
    let largest = points(path).into_iter().flat_map(|p| [p.x.abs(), p.y.abs()]).fold(0.0, f64::max);
    largest * decimals.scale() * (path.elements().len() as f64) < MAX_EXACT_STEPS
}
