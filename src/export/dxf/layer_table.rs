//! DXF layers: one for each kind of line, with the most common colour, width and line type of its marks.

use std::collections::BTreeMap;

use super::colour_index;
use super::dxf_source::DxfSource;
use crate::colour::srgb::Colour;
use crate::drawing::{LayerKind, Mark, Paint};
use crate::export::tolerances;

/// The layer that every file has; it stays empty.
pub(crate) const DEFAULT_LAYER: &str = "0";

/// The line type of solid lines.
pub(crate) const CONTINUOUS: &str = "CONTINUOUS";

/// Line weights that DXF allows, in hundredths of a millimetre.
const LINE_WEIGHTS_HUNDREDTH_MM: [u16; 24] =
    [0, 5, 9, 13, 15, 18, 20, 25, 30, 35, 40, 50, 53, 60, 70, 80, 90, 100, 106, 120, 140, 158, 200, 211];

/// Pen of a layer or a mark.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LayerPen {
    pub(crate) colour: u8,
    /// Hundredths of a millimetre; `None` for fills.
    pub(crate) weight: Option<u16>,
    /// Lengths of dashes and gaps in file units, rounded to 0.1 page units; empty for solid lines.
    pub(crate) dash: Vec<f64>,
}

/// A layer with its pen.
#[derive(Debug)]
pub(crate) struct DxfLayer {
    pub(crate) name: String,
    pub(crate) pen: LayerPen,
}

impl DxfLayer {
    /// Name of its line type.
    pub(crate) fn line_type(&self) -> String {
        if self.pen.dash.is_empty() { CONTINUOUS.to_owned() } else { format!("{}_DASHES", self.name) }
    }
}

/// All layers that contain marks, sorted by name.
#[derive(Debug)]
pub(crate) struct DxfLayers {
    pub(crate) list: Vec<DxfLayer>,
}

impl DxfLayers {
    /// Collects the layers of a drawing. A layer has the most common pen of its marks.
    pub(crate) fn of(sheet: &DxfSource) -> Self {
        let mut all: BTreeMap<String, Vec<LayerPen>> = BTreeMap::new();
        for (kind, mark) in &sheet.marks {
            all.entry(name_of(*kind, mark)).or_default().push(pen_of(sheet, mark));
        }
        let entry = |(name, pens): (String, Vec<LayerPen>)| {
            let colour = most(pens.iter().map(|pen| pen.colour)).unwrap_or(colour_index::BLACK);
            let weight = most(pens.iter().filter_map(|pen| pen.weight));
            // Dashes are stretched to fit each stroke. The median pattern stands for all.
            let mut dashes: Vec<Vec<f64>> =
                pens.into_iter().map(|pen| pen.dash).filter(|dash| !dash.is_empty()).collect();
            dashes.sort_by(|a, b| a.iter().sum::<f64>().total_cmp(&b.iter().sum()));
            let dash = dashes.get(dashes.len() / 2).cloned().unwrap_or_default();
            DxfLayer { name, pen: LayerPen { colour, weight, dash } }
        };
        Self { list: all.into_iter().map(entry).collect() }
    }

    /// The layer of a mark.
    pub(crate) fn layer(&self, kind: LayerKind, mark: &Mark) -> Option<&DxfLayer> {
        let name = name_of(kind, mark);
        self.list
            .binary_search_by(|entry| entry.name.as_str().cmp(&name))
            .ok()
            .and_then(|at| self.list.get(at))
    }
}

/// The most frequent value; the least of several.
fn most<T: Ord + Copy>(of: impl Iterator<Item = T>) -> Option<T> {
    let mut counts: BTreeMap<T, usize> = BTreeMap::new();
    of.for_each(|value| *counts.entry(value).or_default() += 1);
    let most = counts.values().copied().max();
    counts.into_iter().find(|(_, count)| Some(*count) == most).map(|(value, _)| value)
}

/// Pen of a mark.
pub(crate) fn pen_of(sheet: &DxfSource, mark: &Mark) -> LayerPen {
    let weight = |width: f64| {
        let wanted = (width * sheet.mm_per_unit * 100.0).round().clamp(0.0, 1e4) as i32;
        LINE_WEIGHTS_HUNDREDTH_MM.into_iter().min_by_key(|weight| (i32::from(*weight) - wanted).abs())
    };
    let pen = |colour: Colour, weight, dash| LayerPen { colour: colour_index::nearest(colour), weight, dash };
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

/// Most dash and gap lengths of a line type. Source: AutoCAD DXF Reference, LTYPE.
const MAX_PATTERN_LENGTHS: usize = 12;

/// One period of a dash pattern that was written out to fit from corner to corner.
fn period(dash: &[f64]) -> &[f64] {
    let inner = dash.get(2..).unwrap_or_default();
    let alike = |(a, b): (&f64, &f64)| (a - b).abs() <= tolerances::MAX_DASH_DIFFERENCE_OF_LENGTH * a.abs();
    let repeats = |length: &usize| {
        let next = inner.get(*length..2 * length);
        next.is_some_and(|next| inner.iter().zip(next).all(alike))
    };
    let whole = || &dash[..dash.len().min(MAX_PATTERN_LENGTHS)];
    (2..=MAX_PATTERN_LENGTHS).step_by(2).find(repeats).map_or_else(whole, |length| &inner[..length])
}

/// Layer name of a mark in letters, digits and hyphens: the kind of line, with a prefix for hidden lines.
/// Marks other than lines use the layer of the drawing.
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
