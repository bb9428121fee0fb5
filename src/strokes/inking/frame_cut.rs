//! Lines that leave the frame: drawn past its border, then cut there.
//!
//! Such a line goes on outside the picture. Its end is no end of a stroke: it does not taper, and the border cuts its ink straight,
//! however slanted the line is.

use kurbo::{PathEl, Point, Rect, Shape as _, Vec2};

use super::stroke_shape::Shape;
use crate::chains::Chain;
use crate::drawing::region_clip::Region;
use crate::drawing::{Length, Unit};
use crate::geometry::numbers::tolerance::COVER_PX;
use crate::strokes::axes::stroke_axis::Axis;
use crate::strokes::brushes::brush::BrushShape;
use crate::strokes::pens::pen::Pen;

/// The border cuts a line of this slant (sine) from edge to edge past its end; ink of a flatter one may lack a corner.
const MIN_SLANT_SINE: f64 = 0.1;

/// The part of a brush that is laid inside the frame, at least.
const MIN_INSIDE: f64 = 0.1;

/// Tips of brushes are measured in so many columns, on an outline flattened to a part of its length or width.
const TIP_COLUMNS: usize = 64;
const TIP_FLAT: f64 = 1e-3;

/// A brush has its full width where it has this part of its greatest one.
const FULL_WIDTH: f64 = 0.95;

/// How far the outline of ink that is cut may be off, px.
const TOLERANCE_PX: f64 = 0.02;

/// For the first and last point of a chain, how steeply it leaves the frame there: the sine of its angle to the border. `None` where
/// it ends inside.
pub(crate) fn leaving(chain: &Chain, axis: &Axis, frame: Option<Rect>, px: f64) -> [Option<f64>; 2] {
    let Some(frame) = frame.filter(|_| !chain.closed && axis.len() > 1) else { return [None; 2] };
    let ends = [chain.points.first(), chain.points.last()];
    [0, 1].map(|side| {
        let out = -axis.end_tangent(side);
        let sine = outward(*ends[side]?, frame, COVER_PX * px)?.dot(out);
        (sine > 0.0).then_some(sine)
    })
}

/// The direction out of the frame at a point on its border; in a corner that of its left or right side.
fn outward(p: Point, frame: Rect, near: f64) -> Option<Vec2> {
    let sides = [
        (p.x - frame.x0, Vec2::new(-1.0, 0.0)),
        (frame.x1 - p.x, Vec2::new(1.0, 0.0)),
        (p.y - frame.y0, Vec2::new(0.0, -1.0)),
        (frame.y1 - p.y, Vec2::new(0.0, 1.0)),
    ];
    sides.into_iter().find(|(inside, _)| inside.abs() <= near).map(|(_, out)| out)
}

/// How far past the border a line must be drawn at each end, where it leaves at a slant: its taper and the tip of its brush lie
/// outside, and neither its end nor tremor shows at the border.
pub(crate) fn past(leaving: [Option<f64>; 2], length: f64, pen: &Pen, unit: Unit) -> [f64; 2] {
    let in_unit = |length: Length| length.in_unit(unit);
    let across = in_unit(pen.width) + 2.0 * in_unit(pen.hand.tremor) + in_unit(pen.hand.stray);
    let ends = leaving.map(|sine| sine.map_or(0.0, |sine| across / sine.max(MIN_SLANT_SINE)));
    let stretched = pen.brush.as_ref().filter(|brush| !brush.repeats && leaving != [None; 2]);
    let tips = stretched.map_or([0.0; 2], |brush| tips(&brush.shape));
    let tips = [0, 1].map(|side| if leaving[side].is_some() { tips[side] } else { 0.0 });
    // The line inside is what the tips leave of the whole brush.
    let whole = length / (1.0 - tips[0] - tips[1]).max(MIN_INSIDE);
    [0, 1].map(|side| {
        let taper = if leaving[side].is_some() { in_unit(pen.swell.taper) } else { 0.0 };
        ends[side] + taper.max(whole * tips[side])
    })
}

/// How long the tips of a brush are at its start and end, in parts of its length: up to where it has its full width.
fn tips(shape: &BrushShape) -> [f64; 2] {
    let columns = TIP_COLUMNS as f64;
    let path = shape.path([columns, columns / shape.ratio().max(1.0)]);
    let mut edges = [[f64::INFINITY, f64::NEG_INFINITY]; TIP_COLUMNS];
    let mut last = Point::ZERO;
    kurbo::flatten(path.iter(), TIP_FLAT, |element| {
        let (PathEl::MoveTo(to) | PathEl::LineTo(to)) = element else { return };
        let from = if matches!(element, PathEl::MoveTo(_)) { to } else { last };
        last = to;
        let (low, high) = (from.x.min(to.x), from.x.max(to.x));
        for (k, edges) in edges.iter_mut().enumerate() {
            let x = (k as f64 + 0.5) / columns;
            if low <= x && x <= high {
                let y =
                    if high > low { from.y + (to.y - from.y) * (x - from.x) / (to.x - from.x) } else { to.y };
                *edges = [edges[0].min(y), edges[1].max(y)];
            }
        }
    });
    let widest = edges.iter().map(|[low, high]| high - low).fold(0.0, f64::max);
    let is_full = |[low, high]: &[f64; 2]| high - low >= FULL_WIDTH * widest;
    let part = |columns: Option<usize>| columns.map_or(0.0, |count| count as f64 / TIP_COLUMNS as f64);
    [part(edges.iter().position(is_full)), part(edges.iter().rev().position(is_full))]
}

/// The part of a shape in the frame; `None` if nothing does.
pub(crate) fn cut(shape: Shape, frame: Rect, px: f64) -> Option<Shape> {
    let tolerance = TOLERANCE_PX * px;
    let region = Region::new(&frame.to_path(tolerance), tolerance);
    let cut = match shape {
        Shape::Path(path, closed) => {
            let kept = region.line(&path);
            let closed = closed && kept == path;
            Shape::Path(kept, closed)
        }
        Shape::Outline { path, axis, width } => {
            let (kept, kept_axis) = (region.area(&path, tolerance), region.line(&axis));
            // The mean width of what is left, as that of the whole is of the whole.
            let mean =
                |path: &kurbo::BezPath, axis: &kurbo::BezPath| path.area().abs() / axis.perimeter(tolerance);
            let width = width * mean(&kept, &kept_axis) / mean(&path, &axis);
            if !width.is_finite() {
                return None;
            }
            Shape::Outline { path: kept, axis: kept_axis, width }
        }
        Shape::Image { path, strip, pixels, pieces } => {
            Shape::Image { path: region.area(&path, tolerance), strip, pixels, pieces }
        }
    };
    let (Shape::Path(path, _) | Shape::Outline { path, .. } | Shape::Image { path, .. }) = &cut;
    (path.elements().len() > 1).then_some(cut)
}
