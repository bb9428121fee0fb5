//! The result of a drawing, in the forms that the bounds compare: lines, areas, strokes and bytes.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use kurbo::{ParamCurveArclen, Point, Shape};
use ligne::drawing::{Drawing, LayerKind, Mark, Paint};
use ligne::export::SvgOptions;

use crate::library::support::pipeline::Stages;
use crate::library::support::references::drawing_judge::{centre_line, visible_line_marks};

/// The class of a line and the name of its part; either is empty if it does not count.
pub(crate) type LineKey = (String, String);

/// The result of a drawing.
pub(crate) struct Picture {
    /// Visible lines as short segments, by class and part.
    pub lines: BTreeMap<LineKey, Vec<[Point; 2]>>,
    drawing: Option<Drawing>,
    bytes: OnceLock<String>,
}

fn mark_key(mark: &Mark) -> LineKey {
    let class = mark.provenance.classes.first().unwrap_or(&"").to_string();
    (class, mark.provenance.part.as_deref().unwrap_or("").to_owned())
}

impl Picture {
    pub(crate) fn of_stages(stages: &Stages) -> Self {
        let mut lines: BTreeMap<LineKey, Vec<[Point; 2]>> = BTreeMap::new();
        for edge in stages.map.edges.iter().filter(|edge| edge.invisibility == 0) {
            let class = format!("{:?}", edge.kind);
            lines.entry((class, String::new())).or_default().push(stages.edge_ends(edge));
        }
        Self { lines, drawing: None, bytes: OnceLock::new() }
    }

    pub(crate) fn of_drawing(drawing: Drawing) -> Self {
        let mut lines: BTreeMap<LineKey, Vec<[Point; 2]>> = BTreeMap::new();
        for mark in visible_line_marks(&drawing) {
            lines.entry(mark_key(mark)).or_default().extend(centre_line(mark));
        }
        Self { lines, drawing: Some(drawing), bytes: OnceLock::new() }
    }

    /// The whole result as text, with enough digits that rounding hides no difference.
    pub(crate) fn bytes(&self) -> &str {
        self.bytes.get_or_init(|| match &self.drawing {
            Some(drawing) => drawing.to_svg(&SvgOptions::default().with_precision(8)),
            None => format!("{:?}", self.lines),
        })
    }

    fn marks(&self, layer: LayerKind) -> impl Iterator<Item = &Mark> {
        let layers = self.drawing.iter().flat_map(|drawing| &drawing.layers);
        layers.filter(move |other| other.kind == layer).flat_map(|layer| &layer.marks)
    }

    /// The length of intersection lines per part, in hundredths of a px.
    pub(crate) fn intersection_lengths(&self) -> BTreeMap<String, i64> {
        let mut owned: BTreeMap<String, f64> = BTreeMap::new();
        let lines = self.marks(LayerKind::Lines).chain(self.marks(LayerKind::HiddenLines));
        for mark in lines.filter(|mark| mark.provenance.classes.first() == Some(&"intersection")) {
            let length = mark.path.segments().map(|segment| segment.arclen(1e-6)).sum::<f64>();
            *owned.entry(mark_key(mark).1).or_default() += length;
        }
        owned.into_iter().map(|(part, length)| (part, (length * 100.0).round() as i64)).collect()
    }

    /// The filled area by colour and part, px².
    pub(crate) fn fill_areas(&self) -> BTreeMap<LineKey, f64> {
        let mut areas: BTreeMap<LineKey, f64> = BTreeMap::new();
        for mark in self.marks(LayerKind::Fills).chain(self.marks(LayerKind::Shadows)) {
            if let Paint::Fill(colour) = &mark.paint {
                *areas.entry((format!("{colour:?}"), mark_key(mark).1)).or_default() +=
                    mark.path.area().abs();
            }
        }
        areas
    }

    /// The length of hatching strokes per part, px.
    pub(crate) fn hatching_lengths(&self) -> BTreeMap<LineKey, f64> {
        let mut strokes: BTreeMap<LineKey, f64> = BTreeMap::new();
        for mark in self.marks(LayerKind::Hatching) {
            let length = centre_line(mark).iter().map(|[a, b]| (*b - *a).hypot()).sum::<f64>();
            *strokes.entry((String::new(), mark_key(mark).1)).or_default() += length;
        }
        strokes
    }
}
