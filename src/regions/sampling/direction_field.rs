//! [`DirectionField`]: the stroke direction at each lattice point, from the surface's curvature or its light.

use crate::parallel::prelude::*;
use glam::{DVec2, DVec3};

use super::flat_faces::flat_points;
use super::page_lattice::{LatticeProbe, LightLattice};
use crate::geometry::numbers::portable_math::{cos, sin};
use crate::regions::tolerances;

/// Source of the stroke directions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum DirectionSource {
    /// No directions, only light.
    Light,
    /// Direction of largest curvature, rotated by an angle (radians) in the surface.
    Curvature(f64),
    /// Direction of the light's gradient, rotated by an angle (radians) on the page.
    LightGradient(f64),
}

/// Undirected line at a point of the page: cosine and sine of twice its angle (from x to y), times its
/// confidence, 0 to 1.
pub(crate) type LineDirection = [f32; 2];

/// Stroke directions at the points of a lattice.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct DirectionField {
    /// One per point.
    pub directions: Vec<LineDirection>,
    /// Whether a point's direction is independent of its neighbours; true on wide flat faces.
    pub is_independent: Vec<bool>,
}

impl LightLattice {
    /// Stroke directions from the given source, one per point.
    #[must_use]
    pub(crate) fn axes(&self, probe: &LatticeProbe, asked: DirectionSource) -> DirectionField {
        let (mut of, angle) = match asked {
            DirectionSource::Light => (vec![[0.0; 2]; self.facets.len()], 0.0),
            DirectionSource::Curvature(angle) => (probe.bends(self, angle), angle),
            DirectionSource::LightGradient(angle) => (self.shades(angle), angle),
        };
        // On flat faces distant light is constant, but the light of lamps changes.
        let follows_light = matches!(asked, DirectionSource::LightGradient(_))
            && probe.lit.shading.bin_channel().is_some_and(|bins| probe.lit.shading.is_local(bins));
        let mut hold = if asked == DirectionSource::Light || follows_light {
            vec![false; of.len()]
        } else {
            flat_points(self, &probe.as_built)
        };
        let level = |k: usize| {
            let (_, at) = probe.hits[k]?;
            (self.facets[k] != 0).then(|| turned(probe.level(at, probe.as_built[k]), angle))
        };
        of.par_iter_mut().zip(&mut hold).enumerate().with_min_len(1 << 10).for_each(|(k, (axis, hold))| {
            let sure = f64::from(axis[0] * axis[0] + axis[1] * axis[1]).sqrt();
            if asked != DirectionSource::Light && (*hold || sure < DEFAULT_CONFIDENCE) {
                match level(k) {
                    Some(way) => *axis = double_angle(way, if *hold { 1.0 } else { DEFAULT_CONFIDENCE }),
                    None => *hold = false,
                }
            }
        });
        DirectionField { directions: of, is_independent: hold }
    }

    /// Directions of the light's gradient on the page, by central differences within a facet.
    fn shades(&self, angle: f64) -> Vec<LineDirection> {
        let light = |k: usize, next: usize| {
            (self.facets[k] == self.facets[next]).then(|| f64::from(self.lights[next]))
        };
        let slope = |k: usize, before: Option<usize>, after: Option<usize>| {
            let own = f64::from(self.lights[k]);
            let [a, b] = [before, after].map(|next| next.and_then(|next| light(k, next)));
            match (a, b) {
                (Some(a), Some(b)) => (b - a) / 2.0,
                (Some(a), None) => own - a,
                (None, Some(b)) => b - own,
                (None, None) => 0.0,
            }
        };
        (0..self.facets.len())
            .into_par_iter()
            .with_min_len(1 << 10)
            .map(|k| {
                let (column, row) = (k % self.columns, k / self.columns);
                let x = slope(k, (column > 0).then(|| k - 1), (column + 1 < self.columns).then_some(k + 1));
                let up = (row > 0).then(|| k - self.columns);
                let y = slope(k, up, (row + 1 < self.rows).then_some(k + self.columns));
                if self.facets[k] == 0 {
                    return [0.0; 2];
                }
                let slope = DVec2::new(x, y);
                double_angle(turned(slope, angle), (slope.length() / MIN_SURE_SLOPE).min(1.0))
            })
            .collect()
    }
}

/// Smallest change of light between neighbouring points that gives a direction full confidence.
const MIN_SURE_SLOPE: f64 = 0.02;

/// Confidence of default directions.
const DEFAULT_CONFIDENCE: f64 = 0.004;

impl LatticeProbe<'_> {
    /// Directions of largest curvature, from finite differences of the smoothed normals. Bends that are too
    /// small for strokes to follow are smoothed away.
    fn bends(&self, samples: &LightLattice, angle: f64) -> Vec<LineDirection> {
        let lit = self.lit;
        let frame = &lit.view.frame;
        let normals = self.smooth_normals(samples);
        let columns = samples.columns;
        let around = |k: usize, step: usize, has_before: bool, has_after: bool| {
            let own = |other: usize| samples.facets[other] == samples.facets[k] && self.hits[other].is_some();
            let from = if has_before && own(k - step) { k - step } else { k };
            let to = if has_after && own(k + step) { k + step } else { k };
            let at = |k: usize| self.hits[k].map_or(DVec3::ZERO, |(_, at)| at);
            let points = (to - from) / step.max(1);
            let share = 1.0 / points.max(1) as f64;
            ((at(to) - at(from)) * share, (normals[to] - normals[from]) * share)
        };
        (0..self.hits.len())
            .into_par_iter()
            .with_min_len(1 << 10)
            .map(|k| {
                if samples.facets[k] == 0 || self.hits[k].is_none() {
                    return [0.0; 2];
                }
                let (column, row) = (k % columns, k / columns);
                let x = around(k, 1, column > 0, column + 1 < columns);
                let y = around(k, columns, row > 0, row + 1 < samples.rows);
                let depth = self.hits[k].map_or(frame.focus, |(_, at)| frame.depth(at));
                match bend([x.0, y.0], [x.1, y.1], angle, frame.side_at(depth)) {
                    Some((way, sure)) => double_angle(way, sure),
                    None => [0.0; 2],
                }
            })
            .collect()
    }

    /// Unit normals at all points, smoothed over neighbours on the same facet.
    fn smooth_normals(&self, samples: &LightLattice) -> Vec<DVec3> {
        samples.spread(self.normals.clone(), NORMAL_SMOOTHING_ROUNDS, |_, own, around| {
            let sum: DVec3 = around.into_iter().flatten().sum();
            (own + sum).normalize_or_zero()
        })
    }

    /// Horizontal direction of a surface, projected to the page; default for walls. Horizontal surfaces use
    /// the page's horizontal.
    fn level(&self, at: DVec3, normal: DVec3) -> DVec2 {
        let frame = &self.lit.view.frame;
        let level = frame.up.cross(normal);
        let level = if level.length_squared() > MIN_LEVEL_SINE * MIN_LEVEL_SINE {
            level.normalize()
        } else {
            frame.right
        };
        let step = frame.px_at(frame.depth(at)) * tolerances::PROJECTION_STEP_PX;
        let [from, to] = [at, at + level * step].map(|p| frame.image_from_local(p).truncate());
        to - from
    }
}

/// Rounds of smoothing normals; they act over about five lattice points.
const NORMAL_SMOOTHING_ROUNDS: usize = 40;

/// Direction of largest curvature on the page, rotated by an angle in the surface, and its confidence.
///
/// `ways` are the surface steps that correspond to one lattice step right and one down, and `turns` the
/// changes of the normal along them. Both fundamental forms are taken in page coordinates: where II v = k I
/// v, v is a principal direction. Source: do Carmo, Differential Geometry of Curves and Surfaces, section
/// 3.3.
fn bend(ways: [DVec3; 2], turns: [DVec3; 2], angle: f64, size: f64) -> Option<(DVec2, f64)> {
    let [g11, g12, g22] = [ways[0].dot(ways[0]), ways[0].dot(ways[1]), ways[1].dot(ways[1])];
    let m12 = f64::midpoint(turns[0].dot(ways[1]), turns[1].dot(ways[0]));
    let [m11, m22] = [turns[0].dot(ways[0]), turns[1].dot(ways[1])];
    let area2 = g11 * g22 - g12 * g12;
    if area2 <= tolerances::MIN_STEP_SINE_SQUARED * g11 * g22 {
        return None;
    }
    let mean = (m11 * g22 - 2.0 * m12 * g12 + m22 * g11) / (2.0 * area2);
    let gauss = (m11 * m22 - m12 * m12) / area2;
    let apart = (mean * mean - gauss).max(0.0).sqrt();
    let k1 = if mean >= 0.0 { mean + apart } else { mean - apart };
    let rows = [DVec2::new(-(m12 - k1 * g12), m11 - k1 * g11), DVec2::new(m22 - k1 * g22, -(m12 - k1 * g12))];
    let first = if rows[0].length_squared() > rows[1].length_squared() { rows[0] } else { rows[1] };
    let length = |v: DVec2| (v.x * v.x * g11 + 2.0 * v.x * v.y * g12 + v.y * v.y * g22).max(0.0).sqrt();
    let long = length(first);
    if long <= 0.0 || !long.is_finite() {
        return None;
    }
    let first = first / long;
    // The other principal direction, at a right angle in the surface.
    let second = DVec2::new(-(first.x * g12 + first.y * g22), first.x * g11 + first.y * g12) / area2.sqrt();
    let (s, c) = (sin(angle), cos(angle));
    let sure = 2.0 * apart / (2.0 * (mean.abs() + apart)).max(f64::MIN_POSITIVE);
    Some((first * c - second * s, sure * (k1.abs() * size / MIN_SURE_BEND_RAD).min(1.0)))
}

/// Sine of the slope below which a surface counts as horizontal.
const MIN_LEVEL_SINE: f64 = 0.05;

/// Smallest bend over the longer side of the frame that gives a direction full confidence, radians.
const MIN_SURE_BEND_RAD: f64 = 2.0;

fn turned(v: DVec2, angle: f64) -> DVec2 {
    let (s, c) = (sin(angle), cos(angle));
    DVec2::new(v.x * c + v.y * s, v.y * c - v.x * s)
}

/// Double-angle form of the line along a vector, with the given confidence.
fn double_angle(v: DVec2, sure: f64) -> LineDirection {
    let length2 = v.length_squared();
    if length2 <= 0.0 || !length2.is_finite() {
        return [0.0; 2];
    }
    [(v.x * v.x - v.y * v.y) / length2 * sure, 2.0 * v.x * v.y / length2 * sure].map(|x| x as f32)
}
