//! A drawing as SVG: Inkscape layers or groups of parts, compact and fast to write.

use crate::parallel::prelude::*;
use rustc_hash::FxHashMap;

use super::hotspots;
use super::mark_elements::{write_gradient, write_mark};
use super::mark_order::{self, MARKS_PER_CHUNK, MarkPaths, PaintRun};
use super::paint_attributes::{Attributes, hex};
use super::part_groups::{PartGroup, part_groups};
use super::svg_images;
use super::svg_options::{Grouping, SvgOptions};
use crate::colour::srgb::Colour;
use crate::drawing::{Drawing, Layer, LayerKind, Mark, Page, Paint, Unit};
use crate::export::encoding::decimals::Decimals;
use crate::export::encoding::embedded_pictures::PictureIds;
use crate::export::encoding::xml::{UniqueIds, escape};

impl Drawing {
    /// Writes the drawing as SVG text in canonical form. The same drawing gives the same bytes, and a small
    /// change of the drawing gives a small change of the text.
    ///
    /// Marks that may be exchanged are sorted, and paths start at a point that does not depend on how they
    /// were created; see [`Layer::ordered`]. The error of coordinates is at most half a unit of the last
    /// written decimal.
    #[must_use]
    pub fn to_svg(&self, options: &SvgOptions) -> String {
        let mut ids = UniqueIds::new(&options.id_prefix);
        let named = &PictureIds::of(self, &mut ids);
        let mut out = Vec::new();
        let has_buttons = !self.hotspots.is_empty();
        open(&mut out, (&self.title, &self.page), (!named.is_empty(), has_buttons), options, &mut ids);
        self.write_content(&mut out, named, options, &mut ids);
        finished(out)
    }

    /// Writes pictures, paper, layers and hot-spots.
    pub(crate) fn write_content(
        &self,
        out: &mut Vec<u8>,
        named: &PictureIds,
        options: &SvgOptions,
        ids: &mut UniqueIds,
    ) {
        let decimals = Decimals::new(options.decimals(self.page.unit));
        let ink = options.ink.map(|ink| Colour { a: 255, ..ink });
        if !named.is_empty() {
            named.write(out);
        }
        self.paper(out, ids);
        match options.group {
            Grouping::Layer => {
                for layer in &self.layers {
                    let marks: Vec<&Mark> = layer.marks.iter().collect();
                    let (id, label) = self.names(layer);
                    open_layer(out, ids, &id, &label);
                    let fills = gradient_ids(&marks, ids);
                    let group =
                        SvgGroup { marks: &marks, ordered: layer.ordered, decimals, named, fills, ink };
                    group.write(out, b"");
                }
            }
            Grouping::Part => {
                for PartGroup { name, marks, ordered } in part_groups(self) {
                    let fills = gradient_ids(&marks, ids);
                    let group = SvgGroup { marks: &marks, ordered, decimals, named, fills, ink };
                    match name {
                        Some(name) => {
                            out.extend_from_slice(b"<g id=\"");
                            out.extend_from_slice(ids.take(&format!("part-{name}")).as_bytes());
                            out.push(b'"');
                            // Hot-spots already have the names of parts.
                            if options.read_aloud && !self.hotspots.is_empty() {
                                out.extend_from_slice(b" aria-hidden=\"true\"");
                            }
                            let mut title = b"<title>".to_vec();
                            escape(&mut title, &name);
                            title.extend_from_slice(b"</title>\n");
                            group.write(out, &title);
                        }
                        None => {
                            out.extend_from_slice(b"<g");
                            group.write(out, b"");
                        }
                    }
                }
            }
        }
        if !self.hotspots.is_empty() {
            open_layer(out, ids, hotspots::HOTSPOT_LAYER, hotspots::HOTSPOT_LAYER);
            hotspots::write(out, &self.hotspots, decimals, options.read_aloud);
        }
    }

    /// Writes the coloured paper.
    pub(crate) fn paper(&self, out: &mut Vec<u8>, ids: &mut UniqueIds) {
        let Some(colour) = self.page.background else { return };
        let number = |value: f64| Decimals::new(4).text(value);
        let kind = LayerKind::Paper;
        // The plain colour is a separate layer below a paper layer with marks.
        let taken = self.layers.iter().any(|layer| layer.kind == kind);
        open_layer(out, ids, if taken { "paper-colour" } else { kind.id() }, kind.id());
        let opacity = match colour.a {
            255 => String::new(),
            a => format!(" fill-opacity=\"{}\"", Decimals::new(3).text(f64::from(a) / 255.0)),
        };
        let rectangle = format!(
            ">\n<rect width=\"{}\" height=\"{}\" fill=\"{}\"{opacity}/>\n</g>\n",
            number(self.page.width),
            number(self.page.height),
            hex(colour),
        );
        out.extend_from_slice(rectangle.as_bytes());
    }

    /// Id and label of a layer. If several layers have one kind, their ids are numbered by pen, and the pen
    /// is the label.
    pub(crate) fn names(&self, layer: &Layer) -> (String, String) {
        let id = layer.kind.id();
        let mut same = self.layers.iter().filter(|other| other.kind == layer.kind);
        let id = match (&layer.pen, same.nth(1)) {
            (Some(pen), Some(_)) => format!("{id}-{}", pen.split(' ').next().unwrap_or_default()),
            _ => id.to_owned(),
        };
        let label = layer.pen.clone().unwrap_or_else(|| id.clone());
        (id, label)
    }
}

/// Writes the start of the root element and the title. For screen readers, the root has the role of one
/// picture, or of a group if it contains buttons: the content of a picture has neither roles nor names.
pub(crate) fn open(
    out: &mut Vec<u8>,
    (title, page): (&String, &Page),
    (uses, has_buttons): (bool, bool),
    options: &SvgOptions,
    ids: &mut UniqueIds,
) {
    let number = |value: f64| Decimals::new(4).text(value);
    let unit = match page.unit {
        Unit::Px => "",
        Unit::Mm => "mm",
    };
    let (width, height) = (number(page.width), number(page.height));
    let links = if uses { "xmlns:xlink=\"http://www.w3.org/1999/xlink\" " } else { "" };
    let root = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" {links}\
         xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" \
         width=\"{width}{unit}\" height=\"{height}{unit}\" viewBox=\"0 0 {width} {height}\""
    );
    out.extend_from_slice(root.as_bytes());
    let texts = [("title", Some(title)), ("desc", options.desc.as_ref())];
    let texts = texts.map(|(tag, text)| {
        let text = text.filter(|text| !text.is_empty())?;
        Some((tag, text, options.read_aloud.then(|| ids.take(tag))))
    });
    if options.read_aloud {
        let role = if has_buttons { "group" } else { "img" };
        out.extend_from_slice(format!(" role=\"{role}\"").as_bytes());
        let known: Vec<&str> = texts.iter().flatten().filter_map(|(_, _, id)| id.as_deref()).collect();
        if !known.is_empty() {
            out.extend_from_slice(format!(" aria-labelledby=\"{}\"", known.join(" ")).as_bytes());
        }
    }
    out.extend_from_slice(b">\n");
    for (tag, text, id) in texts.into_iter().flatten() {
        let id = id.map(|id| format!(" id=\"{id}\"")).unwrap_or_default();
        out.extend_from_slice(format!("<{tag}{id}>").as_bytes());
        escape(out, text);
        out.extend_from_slice(format!("</{tag}>\n").as_bytes());
    }
}

/// Writes the end of the document and returns its text.
pub(crate) fn finished(mut out: Vec<u8>) -> String {
    out.extend_from_slice(b"</svg>\n");
    // Everything written is ASCII or copied from text.
    String::from_utf8(out).unwrap_or_else(|error| String::from_utf8_lossy(error.as_bytes()).into_owned())
}

/// Writes the start tag of a layer, without its painting attributes and closing bracket.
fn open_layer(out: &mut Vec<u8>, ids: &mut UniqueIds, id: &str, label: &str) {
    out.extend_from_slice(b"<g id=\"");
    out.extend_from_slice(ids.take(id).as_bytes());
    out.extend_from_slice(b"\" inkscape:groupmode=\"layer\" inkscape:label=\"");
    escape(out, label);
    out.push(b'"');
}

/// Marks written as one group.
struct SvgGroup<'a> {
    marks: &'a [&'a Mark],
    /// Whether marks keep their order, and paths their direction.
    ordered: bool,
    decimals: Decimals,
    named: &'a PictureIds<'a>,
    /// Ids of the gradients, by index of the mark.
    fills: FxHashMap<usize, String>,
    /// Colour written as `currentColor`.
    ink: Option<Colour>,
}

/// Creates ids for the gradients of marks.
fn gradient_ids(marks: &[&Mark], ids: &mut UniqueIds) -> FxHashMap<usize, String> {
    let graded = marks.iter().enumerate().filter(|(_, mark)| matches!(mark.paint, Paint::Gradient(_)));
    graded.map(|(index, _)| (index, ids.take("gradient"))).collect()
}

impl SvgGroup<'_> {
    /// Writes the rest of a group whose start tag is open: shared attributes, `head`, marks and end tag.
    fn write(&self, out: &mut Vec<u8>, head: &[u8]) {
        let runs = mark_order::runs(self.marks);
        let counts: Vec<(Attributes, usize)> =
            runs.iter().map(|run| (run.attributes, run.range.len())).collect();
        let common = Attributes::common(&counts);
        if self.ordered {
            out.extend_from_slice(b" data-order=\"travel\"");
        }
        common.write(out, self.ink);
        out.extend_from_slice(b">\n");
        out.extend_from_slice(head);
        self.write_gradients(out);
        let paths = MarkPaths::of(self.marks, self.ordered, self.decimals);
        let order = match self.ordered {
            true => (0..self.marks.len()).collect(),
            false => mark_order::sorted(self.marks, &runs, &paths),
        };
        let write = |(index, chunk): (usize, &[usize])| {
            let mut out = Vec::with_capacity(chunk.len() * 96);
            self.write_chunk(
                &mut out,
                chunk,
                index * MARKS_PER_CHUNK,
                &ChunkContext { common, paths: &paths, runs: &runs },
            );
            out
        };
        let pieces: Vec<Vec<u8>> =
            order.par_chunks(MARKS_PER_CHUNK).with_max_len(1).enumerate().map(write).collect();
        out.reserve(pieces.iter().map(Vec::len).sum::<usize>() + 16);
        for piece in pieces {
            out.extend_from_slice(&piece);
        }
        out.extend_from_slice(b"</g>\n");
    }

    /// Writes the gradients of the group's marks.
    fn write_gradients(&self, out: &mut Vec<u8>) {
        if self.fills.is_empty() {
            return;
        }
        out.extend_from_slice(b"<defs>\n");
        for (index, mark) in self.marks.iter().enumerate() {
            if let (Paint::Gradient(gradient), Some(id)) = (&mark.paint, self.fills.get(&index)) {
                write_gradient(out, gradient, id, self.decimals);
            }
        }
        out.extend_from_slice(b"</defs>\n");
    }

    /// Writes a chunk of marks, starting with number `from`. Neighbours of equal paint that differs from the
    /// group's paint share an inner group.
    fn write_chunk(&self, out: &mut Vec<u8>, chunk: &[usize], from: usize, shared: &ChunkContext) {
        let ChunkContext { common, paths, runs } = shared;
        let first = runs.partition_point(|run| run.range.end <= from);
        let to = from + chunk.len();
        for PaintRun { range, attributes } in runs.iter().skip(first).take_while(|run| run.range.start < to) {
            let grouped = range.len() > 1 && !attributes.fits(common);
            if grouped && range.start >= from {
                out.extend_from_slice(b"<g");
                attributes.write_over(common, out, self.ink);
                out.extend_from_slice(b">\n");
            }
            let outer = if grouped { attributes } else { common };
            for place in range.start.max(from)..range.end.min(to) {
                let Some((index, mark)) =
                    chunk.get(place - from).and_then(|i| Some((*i, self.marks.get(*i)?)))
                else {
                    continue;
                };
                if let Paint::Image(image) = &mark.paint {
                    let Self { named, decimals, .. } = self;
                    let attributes = (outer, attributes);
                    svg_images::write(out, (mark, image), attributes, paths.data(index), named, *decimals);
                    continue;
                }
                let texts = [paths.axis(index), paths.data(index)];
                write_mark(out, mark, outer, attributes, (self.fills.get(&index), self.ink), texts);
            }
            if grouped && range.end <= to {
                out.extend_from_slice(b"</g>\n");
            }
        }
    }
}

/// Data shared by the chunks of a group.
struct ChunkContext<'a> {
    common: Attributes,
    paths: &'a MarkPaths,
    runs: &'a [PaintRun],
}
