//! [`Layers`]: a layer for each kind of line, with the colour, width and type of line that most of it has.

use std::collections::BTreeMap;

use super::colour_index;
use super::dxf_source::Sheet;
use crate::colour::srgb::Colour;
use crate::drawing::{LayerKind, Mark, Paint};

/// The layer that every file has, and where nothing is.
pub(crate) const ZERO: &str = "0";

/// The type of lines without gaps.
pub(crate) const CONTINUOUS: &str = "CONTINUOUS";

/// Widths of lines that DXF knows, in hundredths of a millimetre.
const WEIGHTS: [u16; 24] =
    [0, 5, 9, 13, 15, 18, 20, 25, 30, 35, 40, 50, 53, 60, 70, 80, 90, 100, 106, 120, 140, 158, 200, 211];

/// What of a pen a layer or a mark has.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Pen {
    pub(crate) colour: u8,
    /// Hundredths of a millimetre; none of fills.
    pub(crate) weight: Option<u16>,
    /// Lengths of dashes and gaps in the file's lengths, one decimal in page units; none of lines without gaps.
    pub(crate) dash: Vec<f64>,
}

/// A layer, and how its lines look.
#[derive(Debug)]
pub(crate) struct Entry {
    pub(crate) name: String,
    pub(crate) pen: Pen,
}

impl Entry {
    /// The type of its lines.
    pub(crate) fn line_type(&self) -> String {
        if self.pen.dash.is_empty() { CONTINUOUS.to_owned() } else { format!("{}_DASHES", self.name) }
    }
}

/// All layers that something is in, by name.
#[derive(Debug)]
pub(crate) struct Layers {
    pub(crate) list: Vec<Entry>,
}

impl Layers {
    /// The layers of a drawing: what most of a layer's marks have is the layer's.
    pub(crate) fn of(sheet: &Sheet) -> Self {
        let mut all: BTreeMap<String, Vec<Pen>> = BTreeMap::new();
        for (kind, mark) in &sheet.marks {
            all.entry(name_of(*kind, mark)).or_default().push(pen_of(sheet, mark));
        }
        let entry = |(name, pens): (String, Vec<Pen>)| {
            let colour = most(pens.iter().map(|pen| pen.colour)).unwrap_or(colour_index::BLACK);
            let weight = most(pens.iter().filter_map(|pen| pen.weight));
            // Dashes of strokes are stretched to end well: those of the one in the middle stand for all.
            let mut dashes: Vec<Vec<f64>> =
                pens.into_iter().map(|pen| pen.dash).filter(|dash| !dash.is_empty()).collect();
            dashes.sort_by(|a, b| a.iter().sum::<f64>().total_cmp(&b.iter().sum()));
            let dash = dashes.get(dashes.len() / 2).cloned().unwrap_or_default();
            Entry { name, pen: Pen { colour, weight, dash } }
        };
        Self { list: all.into_iter().map(entry).collect() }
    }

    /// The layer of a mark.
    pub(crate) fn layer(&self, kind: LayerKind, mark: &Mark) -> Option<&Entry> {
        let name = name_of(kind, mark);
        self.list
            .binary_search_by(|entry| entry.name.as_str().cmp(&name))
            .ok()
            .and_then(|at| self.list.get(at))
    }
}

/// What stands most often, of several the least.
fn most<T: Ord + Copy>(of: impl Iterator<Item = T>) -> Option<T> {
    let mut counts: BTreeMap<T, usize> = BTreeMap::new();
    of.for_each(|value| *counts.entry(value).or_default() += 1);
    let most = counts.values().copied().max();
    counts.into_iter().find(|(_, count)| Some(*count) == most).map(|(value, _)| value)
}

/// How a mark is drawn.
pub(crate) fn pen_of(sheet: &Sheet, mark: &Mark) -> Pen {
    let weight = |width: f64| {
        let wanted = (width * sheet.mm_per_unit * 100.0).round().clamp(0.0, 1e4) as i32;
        WEIGHTS.into_iter().min_by_key(|weight| (i32::from(*weight) - wanted).abs())
    };
    let pen = |colour: Colour, weight, dash| Pen { colour: colour_index::nearest(colour), weight, dash };
    match &mark.paint {
        Paint::Stroke(stroke) => {
            let decimal = |length: f64| (length * 10.0).round() / 10.0 * sheet.scale;
            let dash = period(&stroke.dash).iter().map(|length| decimal(*length)).collect();
            pen(stroke.colour, weight(stroke.width), dash)
        }
        Paint::Outline(outline) => pen(outline.colour, weight(outline.width), Vec::new()),
        Paint::Fill(colour) => pen(*colour, None, Vec::new()),
        Paint::Gradient(gradient) => pen(gradient.middle(), None, Vec::new()),
        Paint::Image(_) => pen(Colour::BLACK, None, Vec::new()),
    }
}

/// Most lengths of dashes and gaps that a type of line may have (AutoCAD DXF Reference, LTYPE).
const MAX_LENGTHS: usize = 12;

/// One period of dashes and gaps that are written out one by one because they fit from corner to corner.
fn period(dash: &[f64]) -> &[f64] {
    let inner = dash.get(2..).unwrap_or_default();
    let alike = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-6 * a.abs();
    let repeats = |length: &usize| {
        let next = inner.get(*length..2 * length);
        next.is_some_and(|next| inner.iter().zip(next).all(alike))
    };
    let whole = || &dash[..dash.len().min(MAX_LENGTHS)];
    (2..=MAX_LENGTHS).step_by(2).find(repeats).map_or_else(whole, |length| &inner[..length])
}

/// The name of a mark's layer: the kind of line, hidden ones apart; what is no line by the layer of the drawing. Letters, digits and hyphens.
fn name_of(kind: LayerKind, mark: &Mark) -> String {
    let classes = &mark.provenance.classes;
    let line = if classes.contains(&"silhouette") { Some(&"silhouette") } else { classes.first() };
    let name = match (kind, line) {
        (LayerKind::Lines, Some(line)) => (*line).to_owned(),
        (LayerKind::HiddenLines, Some(line)) => format!("hidden-{line}"),
        _ => kind.id().to_owned(),
    };
    name.to_ascii_uppercase()
}
