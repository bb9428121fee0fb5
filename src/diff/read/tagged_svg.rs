//! Rewrites an SVG file for usvg, so that each shape can be traced back to its label after parsing.
//!
//! usvg keeps ids but drops classes and `data-` attributes. It also needs fonts and image decoders for texts
//! and pictures. Therefore:
//!
//! - Every shape gets an id. Its layer, classes, part and other origin data are stored under that id.
//! - Style-sheet declarations move to the elements they apply to, within limits on their number.
//! - Texts and pictures become rectangles whose gradient encodes their content.
//! - Numbers out of range are refused, and the precision of the coordinates is recorded.

use std::fmt::Write as _;
use std::sync::Arc;

use rustc_hash::FxHashMap;
use usvg::roxmltree::{Document, Node};

use super::inherited_context::InheritedContext;
use crate::diff::markup::cascade::Cascade;
use crate::diff::markup::css_sheet::{self, Declaration};
use crate::diff::markup::{escape, is_svg, number_scan, style_text};
use crate::diff::shapes::label::Label;
use crate::diff::shapes::placeholder::{self, Details};
use crate::drawing::Unit;
use crate::error::Error;

/// Elements that draw shapes.
const SHAPE_ELEMENTS: [&str; 8] = ["path", "rect", "circle", "ellipse", "line", "polyline", "polygon", "use"];
/// Attributes whose numbers must be in range: those that set the precision of a drawing, and others.
const COORDINATE_ATTRIBUTES: [&str; 8] = ["d", "points", "x1", "y1", "x2", "y2", "cx", "cy"];
/// Other attributes whose numbers have the same limits.
const LENGTH_ATTRIBUTES: &str =
    "x y r rx ry width height data-axis transform viewBox stroke-width stroke-dasharray";
/// Attributes copied to the rectangle in place of a text or a picture.
const BOX_ATTRIBUTES: [&str; 6] = ["id", "x", "y", "width", "height", "transform"];
/// Properties copied to that rectangle, because they change its visibility.
const BOX_STYLE_PROPERTIES: [&str; 8] =
    ["display", "visibility", "opacity", "clip-path", "mask", "filter", "mix-blend-mode", "isolation"];

/// Data of a shape other than geometry and paint.
#[derive(Debug, Clone, Default)]
pub(crate) struct ShapeOrigin {
    pub label: Arc<Label>,
    pub tone: Option<u16>,
    pub invisibility: u16,
    /// Centre line of a variable-width stroke, as path data, and its mean width.
    pub axis: Option<(String, f64)>,
    /// Description of a text or a picture.
    pub words: Option<Arc<str>>,
    /// Properties that change the look of a text or a picture.
    pub details: Details,
    /// Material of the model.
    pub material: Option<Arc<str>>,
}

/// A file prepared for usvg.
#[derive(Debug, Default)]
pub(crate) struct TaggedSvg {
    /// The rewritten file.
    pub svg: String,
    /// Data of each shape by its id.
    pub origins: FxHashMap<String, ShapeOrigin>,
    /// Largest number of decimals of a coordinate.
    pub decimals: u8,
    /// Whether any path has arcs.
    pub arcs: bool,
    pub unit: Unit,
    /// Whether style sheets have rules that are not supported and were not applied.
    pub has_unapplied_rules: bool,
    /// Definitions of the gradients that encode the content of texts and pictures.
    gradients: String,
    /// Whether the file has texts or pictures.
    has_placeholders: bool,
}

/// Rewrites a document for usvg. Without `placeholders`, texts and pictures stay.
///
/// # Errors
/// If a number or a style exceeds the limits.
pub(crate) fn rewrite(document: &Document, placeholders: bool) -> Result<TaggedSvg, Error> {
    let mut markup = TaggedSvg::default();
    let root = document.root_element();
    if root.attribute("width").is_some_and(|width| width.trim_end().ends_with("mm")) {
        markup.unit = Unit::Mm;
    }
    markup.has_placeholders =
        placeholders && document.descendants().any(|node| matches!(node.tag_name().name(), "text" | "image"));
    let cascade = Cascade::of(document);
    markup.has_unapplied_rules = cascade.has_more;
    markup.element(root, &InheritedContext::default(), &cascade)?;
    Ok(markup)
}

impl TaggedSvg {
    /// Writes an element, its declarations from the style sheets, and its children.
    fn element(&mut self, node: Node, around: &InheritedContext, cascade: &Cascade) -> Result<(), Error> {
        match node.tag_name().name() {
            // Style sheets are applied to the elements instead.
            "style" => Ok(()),
            _ if !is_svg(&node) => Ok(()),
            "text" | "image" if self.has_placeholders => self.write_placeholder(node, around, cascade),
            _ => self.plain(node, around, cascade),
        }
    }

    /// Writes an SVG element that is neither a text nor a picture, and its children.
    fn plain(&mut self, node: Node, around: &InheritedContext, cascade: &Cascade) -> Result<(), Error> {
        let declared = cascade.declared(node)?;
        let name = node.tag_name().name();
        let mut around = around.enter(node);
        if self.has_placeholders {
            around.props = placeholder::inherit(&around.props, node, &declared);
        }
        self.svg.push('<');
        self.svg.push_str(name);
        if node.parent_element().is_none() {
            self.svg.push_str(
                " xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\"",
            );
        }
        if SHAPE_ELEMENTS.contains(&name) {
            self.shape(node, &around);
        }
        for attribute in node.attributes() {
            let (name, value) = (attribute.name(), attribute.value());
            self.check(node, name, value)?;
            let prefix = match attribute.namespace() {
                None if name == "style" => continue,
                None => "",
                Some("http://www.w3.org/1999/xlink") => "xlink:",
                Some("http://www.w3.org/XML/1998/namespace") => "xml:",
                Some(_) => continue,
            };
            self.attribute(prefix, name, value);
        }
        // The element's own declarations take precedence.
        let own = node.attribute("style").unwrap_or_default();
        if !(declared.is_empty() && own.is_empty()) {
            let _ = write!(self.svg, " style=\"{}\"", style_text(&declared, own)?);
        }
        self.svg.push('>');
        for child in node.children() {
            if child.is_element() {
                self.element(child, &around, cascade)?;
            } else if let Some(text) = child.text().filter(|_| child.is_text()) {
                escape(&mut self.svg, text);
            }
        }
        if node.parent_element().is_none() {
            let _ = write!(self.svg, "<defs>{}</defs>", self.gradients);
        }
        let _ = write!(self.svg, "</{name}>");
        Ok(())
    }

    fn attribute(&mut self, prefix: &str, name: &str, value: &str) {
        let _ = write!(self.svg, " {prefix}{name}=\"");
        escape(&mut self.svg, value);
        self.svg.push('"');
    }

    /// Stores the data of a shape, and writes an id if it has none.
    fn shape(&mut self, node: Node, around: &InheritedContext) {
        let mut classes: Vec<Arc<str>> = Vec::new();
        let mut tone = node.attribute("data-tone").and_then(|tone| tone.parse().ok());
        for class in node.attribute("class").unwrap_or_default().split_ascii_whitespace() {
            match class.strip_prefix("tone-").and_then(|tone| tone.parse().ok()) {
                Some(number) => tone = Some(number),
                None => classes.push(Arc::from(class)),
            }
        }
        classes.sort_unstable();
        let width = node.attribute("data-width").and_then(|text| text.parse().ok());
        let axis = node.attribute("data-axis").zip(width);
        let invisibility = node.attribute("data-invisibility").and_then(|text| text.parse().ok());
        let origin = ShapeOrigin {
            label: around.label(classes),
            tone,
            invisibility: invisibility.unwrap_or(0),
            axis: axis.map(|(axis, width)| (axis.to_owned(), width)),
            material: node.attribute("data-material").map(Arc::from),
            ..ShapeOrigin::default()
        };
        self.remember(node, origin);
    }

    /// Stores the data of an element under its id.
    fn remember(&mut self, node: Node, origin: ShapeOrigin) {
        let id = match node.attribute("id") {
            Some(id) => id.to_owned(),
            None => {
                // A middle dot: no hand-written id is expected to start with it.
                let id = format!("\u{b7}{}", self.origins.len());
                let _ = write!(self.svg, " id=\"{id}\"");
                id
            }
        };
        self.origins.insert(id, origin);
    }

    /// Writes a rectangle in place of a text or a picture. Its colours encode the description and the look.
    fn write_placeholder(
        &mut self,
        node: Node,
        around: &InheritedContext,
        cascade: &Cascade,
    ) -> Result<(), Error> {
        let declared = cascade.declared(node)?;
        let around = around.enter(node);
        let is_text = node.tag_name().name() == "text";
        let said = match is_text {
            true => Some(placeholder::text(node, &around.props, &declared, cascade)?),
            false => placeholder::picture(node, &around.props, &declared),
        };
        // A picture without a target draws nothing.
        let Some(said) = said else { return Ok(()) };
        self.svg.push_str("<rect");
        let [first, last] = said.colours();
        let number = self.origins.len();
        let _ = write!(
            self.gradients,
            "<linearGradient id=\"ligne.stand-in.{number}\" x2=\"1\" y2=\"1\"><stop stop-color=\"{first}\"/>\
             <stop offset=\"1\" stop-color=\"{last}\"/></linearGradient>"
        );
        let origin = ShapeOrigin {
            label: around.label(Vec::new()),
            words: Some(Arc::from(said.words)),
            details: said.details,
            ..ShapeOrigin::default()
        };
        self.remember(node, origin);
        let mut sized = false;
        for attribute in node.attributes().filter(|a| a.namespace().is_none()) {
            let (name, value) = (attribute.name(), attribute.value());
            self.check(node, name, value)?;
            if BOX_ATTRIBUTES.contains(&name) || BOX_STYLE_PROPERTIES.contains(&name) {
                // A text may have a position for every letter.
                let first =
                    if name.len() == 1 { value.split([' ', ',']).next().unwrap_or("0") } else { value };
                self.attribute("", name, first);
                sized |= name == "width";
            }
        }
        // The visibility may be set in a style.
        let own = css_sheet::declarations(node.attribute("style").unwrap_or_default()).unwrap_or_default();
        let all = declared.iter().chain(&own).map(|d| Declaration { important: false, ..*d });
        let style: Vec<Declaration> = all.filter(|d| BOX_STYLE_PROPERTIES.contains(&d.name)).collect();
        let _ = write!(self.svg, " style=\"{}\"", style_text(&style, "")?);
        let size = match (sized, is_text) {
            (true, _) => "",
            // About the size of two letters.
            (_, true) => " width=\"24\" height=\"12\"",
            (_, false) => " width=\"1\" height=\"1\"",
        };
        let _ = write!(self.svg, "{size} stroke=\"none\" fill=\"url(#ligne.stand-in.{number})\"/>");
        Ok(())
    }

    /// Refuses numbers out of range, and records the precision of coordinates.
    fn check(&mut self, node: Node, name: &str, value: &str) -> Result<(), Error> {
        let is_coordinate = COORDINATE_ATTRIBUTES.contains(&name);
        if !is_coordinate && !LENGTH_ATTRIBUTES.split(' ').any(|known| known == name) {
            return Ok(());
        }
        let numbers = number_scan::scan(value);
        if let Some(at) = numbers.too_large {
            let start: String = value[at..].chars().take(12).collect();
            let line = node.document().text_pos_at(node.range().start);
            return Err(Error::new(format!("`{name}` has the number {start}, which is out of range"))
                .at(format!("line {}, column {}", line.row, line.col))
                .remedy("keep coordinates below a hundred million"));
        }
        if is_coordinate {
            self.decimals = self.decimals.max(numbers.decimals);
            self.arcs |= name == "d" && value.contains(['a', 'A']);
        }
        Ok(())
    }
}
