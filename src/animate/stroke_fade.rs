//! Fading of strokes that appear or disappear, over several frames.
//!
//! Each frame is compared with a number of frames before and after it. The closer the first frame that lacks
//! a stroke, the less of the stroke is drawn.
//!
//! A stroke can continue under another name, as part of a longer line or in pieces. It counts as present if
//! the model cells along it contain lines.

use kurbo::{BezPath, ParamCurve, ParamCurveNearest, PathEl, Point};
use rustc_hash::FxHashSet;

use crate::colour::srgb::Colour;
use crate::drawing::{Drawing, Paint};
use crate::motion::FadeBy;

/// Share of its cells that must contain lines for a renamed stroke to count as present.
const MIN_PRESENT_CELL_SHARE: f64 = 0.5;

/// Flattening tolerance of axes when outlines are thinned, user units.
const AXIS_FLATNESS: f64 = 0.05;

/// Strokes of a frame: their names and the model cells that they pass through.
#[derive(Debug, Clone, Default)]
pub struct StrokeTrace {
    names: FxHashSet<u64>,
    cells: FxHashSet<u64>,
}

impl StrokeTrace {
    /// The trace of a drawing made by an [`Animator`](super::Animator).
    #[must_use]
    pub fn of(drawing: &Drawing) -> Self {
        let mut trace = Self::default();
        for mark in drawing.layers.iter().flat_map(|layer| &layer.marks) {
            if mark.provenance.identity != 0 {
                trace.names.insert(mark.provenance.identity);
                trace.cells.extend(mark.provenance.places.iter());
            }
        }
        trace
    }

    fn has(&self, name: u64, places: &[u64]) -> bool {
        let held = || places.iter().filter(|place| self.cells.contains(place)).count();
        self.names.contains(&name)
            || (!places.is_empty() && held() as f64 >= MIN_PRESENT_CELL_SHARE * places.len() as f64)
    }
}

/// Fades the strokes that some neighbouring frames lack.
///
/// `around` holds the frames before and after this one, nearest first. It holds `None` outside the film,
/// where nothing counts as lacking. Strokes painted with a picture do not fade.
pub fn fade(drawing: &mut Drawing, around: &[[Option<&StrokeTrace>; 2]], by: FadeBy) {
    for mark in drawing.layers.iter_mut().flat_map(|layer| &mut layer.marks) {
        let (name, places) = (mark.provenance.identity, &mark.provenance.places);
        let lacks =
            |pair: &[Option<&StrokeTrace>; 2]| pair.iter().flatten().any(|trace| !trace.has(name, places));
        let Some(far) = around.iter().position(lacks).filter(|_| name != 0) else { continue };
        let share = (far + 1) as f64 / (around.len() + 1) as f64;
        let pale = |colour: Colour| Colour { a: (f64::from(colour.a) * share).round() as u8, ..colour };
        match (&mut mark.paint, by) {
            (Paint::Stroke(stroke), FadeBy::Width) => stroke.width *= share,
            (Paint::Outline(outline), FadeBy::Width) => {
                mark.path = thinned(&mark.path, &outline.axis, share);
                outline.width *= share;
                outline.pen_width *= share;
            }
            (Paint::Stroke(stroke), FadeBy::Opacity) => stroke.colour = pale(stroke.colour),
            (Paint::Outline(outline), FadeBy::Opacity) => outline.colour = pale(outline.colour),
            (Paint::Fill(colour), _) => *colour = pale(*colour),
            (Paint::Gradient(gradient), _) => {
                gradient.stops.iter_mut().for_each(|(_, colour)| *colour = pale(*colour));
            }
            (Paint::Image(_), _) => {}
        }
    }
}

/// An outline with its points moved towards the axis, to a share of their distance.
fn thinned(outline: &BezPath, axis: &BezPath, share: f64) -> BezPath {
    let mut flat = BezPath::new();
    kurbo::flatten(axis, AXIS_FLATNESS, |element| flat.push(element));
    let near = |point: Point| {
        let nearest = flat.segments().map(|segment| {
            let nearest = segment.nearest(point, AXIS_FLATNESS);
            (nearest.distance_sq, segment.eval(nearest.t))
        });
        let nearest = nearest.min_by(|a, b| a.0.total_cmp(&b.0));
        nearest.map_or(point, |(_, on_axis)| on_axis.lerp(point, share))
    };
    let thin = |element: PathEl| match element {
        PathEl::MoveTo(p) => PathEl::MoveTo(near(p)),
        PathEl::LineTo(p) => PathEl::LineTo(near(p)),
        PathEl::QuadTo(a, p) => PathEl::QuadTo(near(a), near(p)),
        PathEl::CurveTo(a, b, p) => PathEl::CurveTo(near(a), near(b), near(p)),
        PathEl::ClosePath => PathEl::ClosePath,
    };
    outline.elements().iter().copied().map(thin).collect()
}
