//! Strokes of a hatching as paths.
//!
//! All strokes of one facet and pressure share one compound path, so drawings stay small and one click
//! selects the hatching of a surface.

use kurbo::{BezPath, Point, Vec2};

use crate::chains::fit::bezier_fit::{end_tangent, fit};
use crate::drawing::Unit;
use crate::geometry::plane::planar_distance::length;
use crate::geometry::plane::polylines::{arc_lengths, polyline_length};
use crate::hatching::guides::stroke_layout::HatchStroke;
use crate::hatching::options::HatchLayer;

/// Pen of hatching strokes. Lengths are in page units.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HatchNib {
    /// Width of a stroke at full pressure.
    pub width: f64,
    /// Share of the width lost at the ends, 0 to 1.
    pub taper: f64,
    /// A CSS px in page units.
    pub px: f64,
}

/// Number of pressure steps. Finer steps would not be visible.
pub(crate) const PRESSURE_STEPS: usize = 4;

/// Length of a taper in stroke widths. Shorter strokes taper to their middle.
const TAPER_LENGTH_WIDTHS: f64 = 24.0;

/// Mean width of a layer's strokes as a share of the width at full pressure.
#[must_use]
pub(crate) fn mean_width(layer: &HatchLayer, unit: Unit) -> f64 {
    let [length, width] = [layer.length, layer.width].map(|length| length.in_unit(unit));
    let tapered = if length > 0.0 { (2.0 * TAPER_LENGTH_WIDTHS * width / length).min(1.0) } else { 0.0 };
    // Mean of 1 - taper (1 - x (2 - x)) over the taper, and mean over the pressure steps.
    let pressed = if layer.pressure > 0.0 {
        let share = |degree: usize| {
            let (low, high) = (degree as f64 / PRESSURE_STEPS as f64, pressure(degree));
            (high.min(1.0) - low.max(1.0 - layer.pressure)).max(0.0) / layer.pressure
        };
        (0..PRESSURE_STEPS).map(|degree| share(degree) * pressure(degree)).sum()
    } else {
        1.0
    };
    pressed * (1.0 - layer.taper * tapered / 3.0)
}

/// Greatest distance of fitted curves from the stroke points, px.
const FIT_TOLERANCE_PX: f64 = 0.05;

/// The step of a pressure, 0 to [`PRESSURE_STEPS`] - 1.
#[must_use]
pub(crate) fn degree(pressure: f64) -> usize {
    ((pressure * PRESSURE_STEPS as f64) as usize).min(PRESSURE_STEPS - 1)
}

/// The pressure that a step stands for.
#[must_use]
pub(crate) fn pressure(degree: usize) -> f64 {
    (degree as f64 + 1.0) / PRESSURE_STEPS as f64
}

/// Adds the centre line of a stroke to a path.
pub(crate) fn add_line(stroke: &HatchStroke, px: f64, path: &mut BezPath) {
    let points = &stroke.points;
    path.move_to(points[0]);
    add_curve(points, px, path);
}

/// Continues a path from the first point through the others.
fn add_curve(points: &[Point], px: f64, path: &mut BezPath) {
    let n = points.len();
    if n < 3 {
        points[1..].iter().for_each(|p| path.line_to(*p));
        return;
    }
    let start = end_tangent(|i| points[i], n);
    let end = -end_tangent(|i| points[n - 1 - i], n);
    fit(points, start, end, FIT_TOLERANCE_PX * px, path);
}

/// Adds the outline of a stroke of varying width.
///
/// The width is that of the nib, or the value of `width` at each point. `tapers` selects the ends that taper.
pub(crate) fn add_outline(
    stroke: &HatchStroke,
    nib: &HatchNib,
    tapers: [bool; 2],
    width: Option<&dyn Fn(Point) -> f64>,
    path: &mut BezPath,
) {
    let points = dense(&stroke.points, nib, width.is_some());
    let arcs = arc_lengths(&points);
    let n = points.len();
    let total = arcs[n - 1];
    let count = tapers.iter().filter(|tapers| **tapers).count();
    let taper = (TAPER_LENGTH_WIDTHS * nib.width).min(total / count.max(1) as f64);
    let from_end = |arc: f64| {
        let distances = [arc, total - arc].into_iter().zip(tapers).filter(|(_, tapers)| *tapers);
        distances.map(|(distance, _)| distance).fold(f64::INFINITY, f64::min)
    };
    let half = |i: usize| {
        let full_width = width.map_or(nib.width, |width| width(points[i]));
        let taper_share = if taper > 0.0 { (from_end(arcs[i]) / taper).min(1.0) } else { 1.0 };
        let width_factor = 1.0 - nib.taper * (1.0 - taper_share * (2.0 - taper_share));
        full_width * width_factor / 2.0
    };
    let side = |sign: f64| -> Vec<Point> {
        (0..n)
            .map(|i| {
                let chord = points[(i + 1).min(n - 1)] - points[i.saturating_sub(1)];
                let long = length(chord);
                let across = if long > 0.0 { Vec2::new(chord.y, -chord.x) / long } else { Vec2::ZERO };
                points[i] + across * (half(i) * sign)
            })
            .collect()
    };
    let (left, mut right) = (side(1.0), side(-1.0));
    right.reverse();
    path.move_to(left[0]);
    add_curve(&left, nib.px, path);
    if left[n - 1] != right[0] {
        path.line_to(right[0]);
    }
    add_curve(&right, nib.px, path);
    path.close_path();
}

/// The points of a stroke, subdivided so that the width can vary along it.
fn dense(points: &[Point], nib: &HatchNib, swells: bool) -> Vec<Point> {
    let step = if swells { WIDTH_SAMPLE_STEP_PX * nib.px } else { polyline_length(points) / 6.0 };
    let mut out = vec![points[0]];
    for pair in points.windows(2) {
        let count = (length(pair[1] - pair[0]) / step.max(nib.px * 0.5)).ceil().clamp(1.0, 1e5) as usize;
        out.extend((1..=count).map(|k| pair[0].lerp(pair[1], k as f64 / count as f64)));
    }
    out
}

/// Distance between width samples of a swelling stroke, px.
const WIDTH_SAMPLE_STEP_PX: f64 = 3.0;
