//! Lines that leave the frame: drawn past its border and cut there.
//!
//! Such a line continues outside the picture, so its end does not taper. The border cuts its ink straight, at
//! any slant of the line.

use kurbo::{PathEl, Point, Rect, Shape as _, Vec2};

use super::stroke_shape::StrokeShape;
use crate::chains::Chain;
use crate::drawing::region_clip::ClipRegion;
use crate::drawing::{Length, Unit};
use crate::geometry::tolerances::TRIANGLE_BORDER_PX;
use crate::strokes::axes::stroke_axis::StrokeAxis;
use crate::strokes::brushes::brush::BrushShape;
use crate::strokes::pens::pen::Pen;
use crate::strokes::tolerances;

/// Least slant (sine) for which a line is drawn far enough past the border to be cut from edge to edge. Ink
/// of flatter lines may lack a corner.
const MIN_SLANT_SINE: f64 = 0.1;

/// Least share of a brush that lies inside the frame.
const MIN_INSIDE_SHARE: f64 = 0.1;

/// Number of columns for measuring brush tips.
const TIP_COLUMNS: usize = 64;

/// Share of the greatest width that counts as full width.
const FULL_WIDTH_SHARE: f64 = 0.95;

/// Tolerance of cut outlines, px.
const CUT_TOLERANCE_PX: f64 = 0.02;

/// For the first and last point of a chain, the sine of the angle between line and border where it leaves the
/// frame. `None` where it ends inside.
pub(crate) fn leaving(chain: &Chain, axis: &StrokeAxis, frame: Option<Rect>, px: f64) -> [Option<f64>; 2] {
    let Some(frame) = frame.filter(|_| !chain.closed && axis.len() > 1) else { return [None; 2] };
    let ends = [chain.points.first(), chain.points.last()];
    [0, 1].map(|side| {
        let out = -axis.end_tangent(side);
        let sine = outward(*ends[side]?, frame, TRIANGLE_BORDER_PX * px)?.dot(out);
        (sine > 0.0).then_some(sine)
    })
}

/// The outward direction at a point on the frame's border. In a corner, the left or right side counts.
fn outward(p: Point, frame: Rect, near: f64) -> Option<Vec2> {
    let sides = [
        (p.x - frame.x0, Vec2::new(-1.0, 0.0)),
        (frame.x1 - p.x, Vec2::new(1.0, 0.0)),
        (p.y - frame.y0, Vec2::new(0.0, -1.0)),
        (frame.y1 - p.y, Vec2::new(0.0, 1.0)),
    ];
    sides.into_iter().find(|(inside, _)| inside.abs() <= near).map(|(_, out)| out)
}

/// Distance past the border that a line is drawn at each end where it leaves. The taper, the brush tip, the
/// end and its tremor then lie outside the frame.
pub(crate) fn past(leaving: [Option<f64>; 2], length: f64, pen: &Pen, unit: Unit) -> [f64; 2] {
    let in_unit = |length: Length| length.in_unit(unit);
    let across = in_unit(pen.width) + 2.0 * in_unit(pen.hand.tremor) + in_unit(pen.hand.stray);
    let ends = leaving.map(|sine| sine.map_or(0.0, |sine| across / sine.max(MIN_SLANT_SINE)));
    let stretched = pen.brush.as_ref().filter(|brush| !brush.repeats && leaving != [None; 2]);
    let tips = stretched.map_or([0.0; 2], |brush| tips(&brush.shape));
    let tips = [0, 1].map(|side| if leaving[side].is_some() { tips[side] } else { 0.0 });
    // The line inside the frame is the brush without its tips.
    let whole = length / (1.0 - tips[0] - tips[1]).max(MIN_INSIDE_SHARE);
    [0, 1].map(|side| {
        let taper = if leaving[side].is_some() { in_unit(pen.swell.taper) } else { 0.0 };
        ends[side] + taper.max(whole * tips[side])
    })
}

/// Lengths of the tips at the start and end of a brush, up to its full width, as shares of its length.
fn tips(shape: &BrushShape) -> [f64; 2] {
    let columns = TIP_COLUMNS as f64;
    let path = shape.path([columns, columns / shape.ratio().max(1.0)]);
    let mut edges = [[f64::INFINITY, f64::NEG_INFINITY]; TIP_COLUMNS];
    let mut last = Point::ZERO;
    kurbo::flatten(path.iter(), tolerances::BRUSH_FLATNESS_OF_SIZE, |element| {
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
    let is_full = |[low, high]: &[f64; 2]| high - low >= FULL_WIDTH_SHARE * widest;
    let part = |columns: Option<usize>| columns.map_or(0.0, |count| count as f64 / TIP_COLUMNS as f64);
    [part(edges.iter().position(is_full)), part(edges.iter().rev().position(is_full))]
}

/// The part of a shape inside the frame; `None` if it is empty.
pub(crate) fn cut(shape: StrokeShape, frame: Rect, px: f64) -> Option<StrokeShape> {
    let tolerance = CUT_TOLERANCE_PX * px;
    let region = ClipRegion::new(&frame.to_path(tolerance), tolerance);
    let cut = match shape {
        StrokeShape::Path(path, closed) => {
            let kept = region.line(&path);
            let closed = closed && kept == path;
            StrokeShape::Path(kept, closed)
        }
        StrokeShape::Outline { path, axis, width } => {
            let (kept, kept_axis) = (region.area(&path, tolerance), region.line(&axis));
            // Scale the mean width by the change of area per length, so that it describes the remaining part.
            let mean =
                |path: &kurbo::BezPath, axis: &kurbo::BezPath| path.area().abs() / axis.perimeter(tolerance);
            let width = width * mean(&kept, &kept_axis) / mean(&path, &axis);
            if !width.is_finite() {
                return None;
            }
            StrokeShape::Outline { path: kept, axis: kept_axis, width }
        }
        StrokeShape::Image { path, strip, pixels, pieces } => {
            StrokeShape::Image { path: region.area(&path, tolerance), strip, pixels, pieces }
        }
    };
    let (StrokeShape::Path(path, _) | StrokeShape::Outline { path, .. } | StrokeShape::Image { path, .. }) =
        &cut;
    (path.elements().len() > 1).then_some(cut)
}
