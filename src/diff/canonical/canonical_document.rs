//! The canonical form of any SVG file: its paths begun and ordered as the exporter does, and all else as it was.
//!
//! The text is edited in place: values of `d` and `data-axis` are replaced, and neighbouring paths that are painted alike
//! change places. What cannot be told from attributes alone is only rounded, or left.

use std::borrow::Cow;
use std::ops::Range;

use crate::parallel::prelude::*;
use kurbo::{BezPath, PathEl, Point};
use usvg::roxmltree::{Attribute, Document, Node};

use super::computed_style::{Afar, Leave, Look, painted_alike};
use super::{path_parser, presentation_attributes};
use crate::diff::markup::{input_limits, number_scan};
use crate::error::Error;
use crate::export::encoding::decimals::{Decimals, MOST_DECIMALS};
use crate::export::paths::canonical_path::{Canonical, Form};
use crate::export::paths::path_piece::Step;
use crate::export::svg::mark_order::Name;

/// Steps times pieces of a path beyond which its relative coordinates might not read back exactly: sums of numbers of 53
/// bits, each off by half a bit.
const MOST_STEPS: f64 = (1u64 << 50) as f64;

/// An SVG file in the form that drawings are written in, so that a version control shows small differences: ordered
/// marks, paths that begin at their least point, rounded numbers. The picture stays the same.
///
/// Paths are rounded to `precision` decimals, at most 8; `None`: to as many as the file has. Styles become attributes where all that
/// they say can be said so; beside that only path data and the order of neighbouring paths painted alike are changed. Where scripts, other style sheets, references or animations might
/// tell the difference, paths are only rounded; those with arcs or with moves that nothing is drawn from, and wrong ones, stay as they are.
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
/// Where the text is no SVG, or reading it might take more time or memory than its length accounts for. The error names
/// no file.
pub fn canonical_svg(text: &str, precision: Option<u8>) -> Result<String, Error> {
    let plain = presentation_attributes::plain(text)?;
    let text = plain.as_deref().unwrap_or(text);
    let document = input_limits::parse(text)?;
    let paths = Paths::of(&document);
    let precision = precision.unwrap_or_else(|| paths.decimals()).min(MOST_DECIMALS);
    let written: Vec<Written> =
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

/// The paths of a document, in its order.
struct Paths<'a, 'input> {
    found: Vec<Found<'a, 'input>>,
    afar: Afar<'a>,
    /// Runs begun so far.
    runs: usize,
    /// Where the root begins: what comes before are declarations that elements may be made of.
    begin: usize,
}

/// A path.
struct Found<'a, 'input> {
    node: Node<'a, 'input>,
    leave: Leave,
    /// The number of the run of paths that may be exchanged with this one.
    run: usize,
}

impl<'a, 'input> Paths<'a, 'input> {
    fn of(document: &'a Document<'input>) -> Self {
        let root = document.root_element();
        let afar = Afar::of(document);
        let look = Look::new(&afar);
        let mut paths = Self { found: Vec::new(), afar, runs: 0, begin: root.range().start };
        paths.inside(root, &look);
        paths
    }

    /// Finds the paths in an element; no deeper than elements nest in files that are read.
    fn inside(&mut self, node: Node<'a, 'input>, around: &Look<'a>) {
        let look = around.inside(node, &self.afar);
        // The paths before, as long as nothing parts them from what comes next.
        let mut neighbour: Option<Node> = None;
        for child in node.children() {
            if child.is_text() && child.text().is_none_or(|text| text.trim().is_empty()) {
                continue;
            }
            let before = neighbour.take();
            let svg = matches!(child.tag_name().namespace(), None | Some("http://www.w3.org/2000/svg"));
            if !child.is_element() || !svg {
                continue;
            }
            if child.tag_name().name() != "path" {
                self.inside(child, &look);
                continue;
            }
            if child.range().start < self.begin {
                continue;
            }
            let own = look.inside(child, &self.afar);
            let free = own.may_be_exchanged(child);
            if !(free && before.is_some_and(|before| painted_alike(before, child))) {
                self.runs += 1;
            }
            neighbour = free.then_some(child);
            self.found.push(Found { node: child, leave: own.leave(child), run: self.runs });
        }
    }

    /// Most decimals of a coordinate.
    fn decimals(&self) -> u8 {
        let data = |found: &Found| {
            let values = DATA.iter().filter_map(|name| found.node.attribute(*name));
            values.map(|value| number_scan::scan(value).decimals).max().unwrap_or(0)
        };
        self.found.par_iter().map(data).max().unwrap_or(0)
    }
}

/// Attributes that hold path data.
const DATA: [&str; 2] = ["d", "data-axis"];

/// A path as it is to be.
struct Written<'a> {
    /// The whole element.
    element: Cow<'a, str>,
    /// Where in it the path data is.
    data: Range<usize>,
    /// Where the path begins.
    start: Option<Step>,
}

/// What paths are sorted by: as the exporter does.
fn key<'a>((written, found): (&'a Written, &'a Found)) -> (Name<'a>, Option<Step>, &'a str) {
    let of = |name| found.node.attribute(name);
    let name = Name {
        classes: of("class").unwrap_or_default(),
        part: of("data-part"),
        material: of("data-material"),
        tone: of("data-tone").and_then(|tone| tone.parse().ok()),
    };
    (name, written.start, written.element.get(written.data.clone()).unwrap_or_default())
}

/// Writes one element.
fn written<'a>(text: &'a str, found: &Found, decimals: Decimals) -> Written<'a> {
    let whole = found.node.range();
    let source = text.get(whole.clone()).unwrap_or_default();
    let mut written = Written { element: Cow::Borrowed(source), data: 0..0, start: None };
    let own = |attribute: &Attribute| attribute.namespace().is_none() && DATA.contains(&attribute.name());
    // From the last to the first, so that places before stay what they are.
    let mut attributes: Vec<Attribute> = found.node.attributes().filter(own).collect();
    attributes.sort_by_key(|attribute| std::cmp::Reverse(attribute.range_value().start));
    for attribute in attributes {
        let Some(range) = value_range(text, &attribute, &whole) else { continue };
        let is_axis = attribute.name() != "d";
        let form = match found.leave.form {
            Form::Kept => Form::Kept,
            _ if is_axis => Form::Stroked,
            form => form,
        };
        let (data, start) = rewritten(attribute.value(), Leave { form, ..found.leave }, decimals);
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

/// Where in its element the value of an attribute stands, if it stands between quotes there.
fn value_range(text: &str, attribute: &Attribute, element: &Range<usize>) -> Option<Range<usize>> {
    let range = attribute.range_value();
    let quote = text.as_bytes().get(range.start.checked_sub(1)?)?;
    let quoted = matches!(quote, b'"' | b'\'') && text.as_bytes().get(range.end) == Some(quote);
    let inside = element.start < range.start && range.end < element.end;
    (quoted && inside).then(|| range.start - element.start..range.end - element.start)
}

/// Path data in canonical form, and where it begins; no data where it is to stay as it is.
fn rewritten(data: &str, leave: Leave, decimals: Decimals) -> (Option<String>, Option<Step>) {
    let Some(read) = path_parser::read(data) else { return (None, None) };
    let mut canonical = Canonical::new(decimals);
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

/// Whether what is written reads back as the same steps.
fn is_exact(path: &BezPath, decimals: Decimals) -> bool {
    let most = |points: &[Point]| points.iter().flat_map(|p| [p.x.abs(), p.y.abs()]).fold(0.0, f64::max);
    let elements = path.elements();
    let of_element = |element: &PathEl| match *element {
        PathEl::MoveTo(p) | PathEl::LineTo(p) => most(&[p]),
        PathEl::QuadTo(c, p) => most(&[c, p]),
        PathEl::CurveTo(c1, c2, p) => most(&[c1, c2, p]),
        PathEl::ClosePath => 0.0,
    };
    let largest = elements.iter().map(of_element).fold(0.0, f64::max);
    largest * decimals.scale() * (elements.len() as f64) < MOST_STEPS
}
