//! Normals smoothed over a length: the noise of scans goes, the shape stays.
//!
//! One step takes the mean normal of each face, and gives each vertex the mean of the faces around
//! it, weighted by area. Heat that flows for a time is a sum of such steps, and Chebyshev's
//! polynomials need far fewer of them than small steps would: about the square root.
//!
//! Source: Hammond, Vandergheynst and Gribonval, "Wavelets on graphs via spectral graph theory",
//! 2011, section 6, for Chebyshev's polynomials of a smoothing matrix.

use glam::DVec3;
use rayon::prelude::*;

use super::SmoothNormals;
use super::fans::{Fans, GRAIN};

/// Terms that add less than this to the sum are left out.
const LEAST_TERM: f64 = 2e-3;

/// Longest smoothing in mean lengths of edges; more would take long, and finer meshes are scanned
/// more exactly.
const MOST_EDGES: f64 = 5.0;

/// The unit normals, smoothed with a bell curve of standard deviation `length`, world units; no
/// more than [`MOST_EDGES`]. Where edges are as long as that, normals stay as they are.
pub(super) fn diffuse(smooth: &SmoothNormals, fans: &Fans, length: f64) -> Vec<DVec3> {
    let areas: Vec<f64> = fans.frames.iter().map(|frame| frame.areas.iter().sum()).collect();
    let edge2 = mean_edge_squared(&areas);
    if length <= 0.0 || edge2 <= 0.0 {
        return smooth.normals.clone();
    }
    // A step spreads by a third of the squared edge in each direction, where triangles are regular.
    let steps = 3.0 * (length * length / edge2).min(MOST_EDGES * MOST_EDGES);
    let flow = Flow { smooth, fans, areas, edge2 };
    let weights = weights(steps / 2.0);
    // Chebyshev's recurrence for the matrix 2 S − 1, whose eigenvalues lie from −1 to 1.
    let twice_less = |a: &[DVec3], b: &[DVec3], factor: f64| -> Vec<DVec3> {
        let step = flow.step(a);
        (0..a.len())
            .into_par_iter()
            .with_min_len(GRAIN)
            .map(|v| (step[v] * 2.0 - a[v]) * factor - b[v])
            .collect()
    };
    let none = vec![DVec3::ZERO; smooth.normals.len()];
    let (mut before, mut now) = (none, smooth.normals.clone());
    let mut sum: Vec<DVec3> = now.iter().map(|n| *n * weights[0]).collect();
    for (k, weight) in weights.iter().enumerate().skip(1) {
        let next = twice_less(&now, &before, if k == 1 { 1.0 } else { 2.0 });
        sum.par_iter_mut().with_min_len(GRAIN).zip(&next).for_each(|(s, n)| *s += *n * *weight);
        before = now;
        now = next;
    }
    sum.into_iter().map(DVec3::normalize_or_zero).collect()
}

struct Flow<'a> {
    smooth: &'a SmoothNormals,
    fans: &'a Fans,
    areas: Vec<f64>,
    edge2: f64,
}

impl Flow<'_> {
    /// One step. Large faces take part only by the share that keeps the length of smoothing the
    /// same as elsewhere.
    fn step(&self, normals: &[DVec3]) -> Vec<DVec3> {
        let means: Vec<DVec3> = self
            .smooth
            .corners
            .par_iter()
            .with_min_len(GRAIN)
            .enumerate()
            .map(|(face, corners)| {
                if self.fans.holds(face) {
                    corners.iter().map(|v| normals[*v as usize]).sum::<DVec3>() / 3.0
                } else {
                    DVec3::ZERO
                }
            })
            .collect();
        let usual = self.edge2 / EDGE2_OF_AREA;
        (0..normals.len())
            .into_par_iter()
            .with_min_len(GRAIN)
            .map(|vertex| {
                let (mut sum, mut taken, mut all) = (DVec3::ZERO, 0.0, 0.0);
                for (face, _) in self.fans.around(vertex) {
                    let area = self.areas[face];
                    let part = area.min(usual);
                    sum += means[face] * part;
                    taken += part;
                    all += area;
                }
                if all > 0.0 { (sum + normals[vertex] * (all - taken)) / all } else { normals[vertex] }
            })
            .collect()
    }
}

/// Square of the edge of an even-sided triangle, in areas.
const EDGE2_OF_AREA: f64 = 2.309_401_076_758_503;

/// The square of the edge of an even-sided triangle as large as half of all area is smaller than.
fn mean_edge_squared(areas: &[f64]) -> f64 {
    let count = areas.iter().filter(|a| **a > 0.0).count();
    // Summed in the order of size, so that the order of faces does not matter.
    let mut sorted: Vec<f64> = areas.iter().copied().filter(|a| *a > 0.0).collect();
    if count == 0 {
        return 0.0;
    }
    let (_, median, _) = sorted.select_nth_unstable_by(count / 2, f64::total_cmp);
    *median * EDGE2_OF_AREA
}

/// The coefficients of exp(−z (1 − x)) in Chebyshev's polynomials of x: the modified Bessel
/// functions of z, by Miller's backward recurrence. Their sum is 1.
fn weights(z: f64) -> Vec<f64> {
    let count = (16.0 + 12.0 * z.sqrt() + z).ceil() as usize;
    let mut bessel = vec![0.0; count + 2];
    bessel[count] = 1e-250;
    for k in (1..=count).rev() {
        bessel[k - 1] = bessel[k + 1] + 2.0 * k as f64 / z.max(1e-12) * bessel[k];
        if bessel[k - 1] > 1e200 {
            bessel.iter_mut().for_each(|b| *b *= 1e-200);
        }
    }
    bessel.iter_mut().skip(1).for_each(|b| *b *= 2.0);
    let sum: f64 = bessel.iter().sum();
    bessel.iter_mut().for_each(|b| *b /= sum);
    while bessel.len() > 1 && bessel.last().is_some_and(|last| *last < LEAST_TERM) {
        bessel.pop();
    }
    let sum: f64 = bessel.iter().sum();
    bessel.into_iter().map(|b| b / sum).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_are_those_of_a_flow_of_heat() {
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
        assert!((chebyshev(0.5) - (-1.0f64).exp()).abs() < 5e-3);
        assert!((chebyshev(-0.5) - (-3.0f64).exp()).abs() < 5e-3);
        assert_eq!(weights(0.0), [1.0]);
        assert!(weights(37.0).len() < 30);
    }
}
