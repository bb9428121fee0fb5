//! Normals smoothed by heat diffusion, which removes the noise of scans and keeps the shape.
//!
//! 1. One step S averages the corner normals of each face, and then the faces around each vertex by area.
//! 2. Heat flow over a time is a series in S. In Chebyshev polynomials it needs about the square root of the
//!    number of small steps.
//!
//! Source: Hammond, Vandergheynst and Gribonval, "Wavelets on graphs via spectral graph theory", 2011,
//! section 6, for Chebyshev polynomials of a smoothing matrix.

use crate::parallel::prelude::*;
use glam::DVec3;

use super::vertex_fans::VertexFans;
use crate::mesh::PartId;
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::surface::SmoothNormals;
use crate::surface::tolerances;

/// Maximum standard deviation of the smoothing, in typical edge lengths. It limits the run time; finer meshes
/// are scanned more exactly.
const MAX_SMOOTHING_EDGES: f64 = 4.0;

/// Unit normals smoothed with a Gaussian. `length` returns its standard deviation for each part, world units,
/// limited to [`MAX_SMOOTHING_EDGES`]. Normals stay unchanged where edges are as long as that. `part_of` has
/// one part per smooth vertex.
pub(crate) fn diffuse(
    smooth: &SmoothNormals,
    fans: &VertexFans,
    part_of: &[PartId],
    length: impl Fn(PartId) -> f64,
) -> Vec<DVec3> {
    let areas: Vec<f64> = fans.frames.iter().map(|frame| frame.areas.iter().sum()).collect();
    let part_of_face = |face: usize| part_of[smooth.corners[face][0] as usize].index();
    let mut areas_of: Vec<Vec<f64>> = Vec::new();
    for (face, area) in areas.iter().enumerate().filter(|(_, area)| **area > 0.0) {
        let part = part_of_face(face);
        if areas_of.len() <= part {
            areas_of.resize_with(part + 1, Vec::new);
        }
        areas_of[part].push(*area);
    }
    let edge2_of: Vec<f64> = areas_of.into_iter().map(usual_edge_squared).collect();
    let weights_of = |(part, edge2): (usize, &f64)| {
        let length = length(PartId::from(part));
        if length <= 0.0 || *edge2 <= 0.0 {
            return vec![1.0];
        }
        // On regular triangles, one step has a variance of a third of the squared edge length in each
        // direction.
        let steps = 3.0 * (length * length / edge2).min(MAX_SMOOTHING_EDGES * MAX_SMOOTHING_EDGES);
        weights(steps / 2.0)
    };
    let weights_of: Vec<Vec<f64>> = edge2_of.iter().enumerate().map(weights_of).collect();
    let terms = weights_of.iter().map(Vec::len).max().unwrap_or(1);
    if terms == 1 {
        return smooth.normals.clone();
    }
    let usual = |face: usize| edge2_of[part_of_face(face)] / SQUARED_EDGE_PER_AREA;
    let mut flow = HeatFlow::new(smooth, fans, &areas, usual);
    // A vertex in no fan stays unchanged.
    let weight = |vertex: usize, k: usize| {
        let weights = weights_of.get(part_of[vertex].index());
        weights.map_or(f64::from(u8::from(k == 0)), |weights| weights.get(k).copied().unwrap_or(0.0))
    };
    let mut before = vec![DVec3::ZERO; smooth.normals.len()];
    let mut now = smooth.normals.clone();
    let mut sum: Vec<DVec3> = now.iter().enumerate().map(|(v, n)| *n * weight(v, 0)).collect();
    for k in 1..terms {
        let factor = if k == 1 { 1.0 } else { 2.0 };
        flow.step(&now, &mut before, &mut sum, factor, |vertex| weight(vertex, k));
        std::mem::swap(&mut now, &mut before);
    }
    sum.par_iter_mut().with_min_len(MIN_TASK_ITEMS).for_each(|normal| *normal = normal.normalize_or_zero());
    sum
}

/// One smoothing step S, with its data.
struct HeatFlow<'a> {
    smooth: &'a SmoothNormals,
    fans: &'a VertexFans,
    /// Effective area of each face. Large faces count only in part, so that the smoothing length is the same
    /// everywhere.
    parts: Vec<f64>,
    /// For each vertex, the inverse of the area around it, and the share of that area that is not smoothed.
    around: Vec<(f64, f64)>,
    /// Buffer for the mean normals of the faces, weighted by effective area.
    means: Vec<DVec3>,
}

impl<'a> HeatFlow<'a> {
    fn new(
        smooth: &'a SmoothNormals,
        fans: &'a VertexFans,
        areas: &[f64],
        usual: impl Fn(usize) -> f64,
    ) -> Self {
        let part = |(face, area): (usize, &f64)| if *area > 0.0 { area.min(usual(face)) } else { 0.0 };
        let parts: Vec<f64> = areas.iter().enumerate().map(part).collect();
        let around = (0..smooth.normals.len())
            .into_par_iter()
            .with_min_len(MIN_TASK_ITEMS)
            .map(|vertex| {
                let (mut taken, mut all) = (0.0, 0.0);
                for (face, _) in fans.around(vertex) {
                    taken += parts[face];
                    all += areas[face];
                }
                if all > 0.0 { (1.0 / all, (all - taken) / all) } else { (0.0, 1.0) }
            })
            .collect();
        let means = vec![DVec3::ZERO; areas.len()];
        Self { smooth, fans, parts, around, means }
    }

    /// One step of Chebyshev's recurrence for the matrix 2 S − 1, whose eigenvalues lie from −1 to 1.
    /// `before` becomes `factor` (2 S − 1) `now` − `before`, and `sum` grows by `weight` times that.
    fn step(
        &mut self,
        now: &[DVec3],
        before: &mut [DVec3],
        sum: &mut [DVec3],
        factor: f64,
        weight: impl Fn(usize) -> f64 + Sync,
    ) {
        let (smooth, fans, parts, around) = (self.smooth, self.fans, &self.parts, &self.around);
        self.means.par_iter_mut().with_min_len(MIN_TASK_ITEMS).enumerate().for_each(|(face, mean)| {
            if parts[face] > 0.0 {
                let [a, b, c] = smooth.corners[face].map(|v| now[v as usize]);
                *mean = (a + b + c) * (parts[face] / 3.0);
            }
        });
        let means = &self.means;
        before.par_iter_mut().zip(sum).with_min_len(MIN_TASK_ITEMS).enumerate().for_each(
            |(vertex, (before, sum))| {
                let whole: DVec3 = fans.around(vertex).map(|(face, _)| means[face]).sum();
                let (inverse, rest) = around[vertex];
                let step = whole * inverse + now[vertex] * rest;
                *before = (step * 2.0 - now[vertex]) * factor - *before;
                *sum += *before * weight(vertex);
            },
        );
    }
}

/// Squared edge of an equilateral triangle, divided by its area.
const SQUARED_EDGE_PER_AREA: f64 = 2.309_401_076_758_503;

/// Squared edge of an equilateral triangle with the median area; 0 without triangles.
fn usual_edge_squared(mut sound: Vec<f64>) -> f64 {
    if sound.is_empty() {
        return 0.0;
    }
    let middle = sound.len() / 2;
    let (_, median, _) = sound.select_nth_unstable_by(middle, f64::total_cmp);
    *median * SQUARED_EDGE_PER_AREA
}

/// Chebyshev coefficients of exp(−z (1 − x)): modified Bessel functions of z, by Miller's backward
/// recurrence. Their sum is 1.
fn weights(z: f64) -> Vec<f64> {
    let count = (16.0 + 12.0 * z.sqrt() + z).ceil() as usize;
    let mut bessel = vec![0.0; count + 2];
    bessel[count] = tolerances::BESSEL_START;
    for k in (1..=count).rev() {
        bessel[k - 1] = bessel[k + 1] + 2.0 * k as f64 / z.max(tolerances::MIN_BESSEL_ARGUMENT) * bessel[k];
        if bessel[k - 1] > 1e200 {
            bessel.iter_mut().for_each(|b| *b *= tolerances::BESSEL_RESCALE);
        }
    }
    bessel.iter_mut().skip(1).for_each(|b| *b *= 2.0);
    let sum: f64 = bessel.iter().sum();
    bessel.iter_mut().for_each(|b| *b /= sum);
    while bessel.len() > 1 && bessel.last().is_some_and(|last| *last < tolerances::MIN_CHEBYSHEV_WEIGHT) {
        bessel.pop();
    }
    let sum: f64 = bessel.iter().sum();
    bessel.into_iter().map(|b| b / sum).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn diffusion_weights_approximate_the_heat_kernel() {
        // Eigenvalue x = 0.5 after z = 2: exp(-1).
        let chebyshev = |x: f64| {
            let (mut before, mut now, mut sum) = (x, 1.0, 0.0);
            for weight in weights(2.0) {
                sum += weight * now;
                (before, now) = (now, 2.0 * x * now - before);
            }
            sum
        };
        assert!((chebyshev(1.0) - 1.0).abs() < 1e-12);
        let e = std::f64::consts::E;
        assert!((chebyshev(0.5) - 1.0 / e).abs() < 5e-3);
        assert!((chebyshev(-0.5) - 1.0 / (e * e * e)).abs() < 5e-3);
        assert_eq!(weights(0.0), [1.0]);
        assert!(weights(37.0).len() < 30);
    }
}
