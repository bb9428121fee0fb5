//! Smooths a jagged line within a tube around it (Whittaker smoother).
//!
//! The result minimises `Σ w |x − p|² + λ Σ |second difference of x|²` over evenly spaced points p of the
//! line. Unlike averaging, it does not shrink bends. Weights rise where x deviates by more than the
//! tolerance, so the line is as smooth as the tube allows. Points that still deviate are pulled back to the
//! wall of the tube. Source: Eilers, A perfect smoother, Analytical Chemistry 2003; Whittaker 1923.

use crate::geometry::plane::planar_distance::length;
use kurbo::{Point, Vec2};

/// Maximum number of rounds of raising weights.
const MAX_ROUNDS: usize = 6;

/// Wavelength, in spacings, that is damped by half at weight 1.
const CUTOFF_SPACINGS: f64 = 36.0;

/// Smooths evenly spaced points and moves none by more than `tolerance`. The ends of an open line stay.
pub(crate) fn smooth(points: &[Point], closed: bool, tolerance: f64) -> Vec<Point> {
    let n = points.len();
    if n < 3 || tolerance <= 0.0 {
        return points.to_vec();
    }
    if !closed {
        return solve(points, tolerance, true);
    }
    // A closed line is extended on both sides by more than the reach of the smoother.
    let margin = (4.0 * CUTOFF_SPACINGS) as usize;
    let unrolled: Vec<Point> =
        (0..n + 2 * margin).map(|k| points[(k + n * (margin / n + 1) - margin) % n]).collect();
    let mut smooth = solve(&unrolled, tolerance, false);
    smooth.drain(..margin);
    smooth.truncate(n);
    smooth
}

fn solve(points: &[Point], tolerance: f64, pinned: bool) -> Vec<Point> {
    let n = points.len();
    let radians = std::f64::consts::TAU / CUTOFF_SPACINGS;
    let stiffness = 1.0 / (radians * radians * radians * radians);
    let mut weights = vec![1.0; n];
    if pinned {
        weights[0] = 1e9;
        weights[n - 1] = 1e9;
    }
    let mut smooth = points.to_vec();
    for round in 0..MAX_ROUNDS {
        smooth = whittaker(points, &weights, stiffness);
        let mut strays = false;
        for i in 0..n {
            let ratio = length(smooth[i] - points[i]) / tolerance;
            if ratio > 1.0 {
                strays = true;
                weights[i] *= (ratio * ratio).min(16.0) * 2.0;
            }
        }
        if !strays || round + 1 == MAX_ROUNDS {
            break;
        }
    }
    for i in 0..n {
        let stray: Vec2 = smooth[i] - points[i];
        let distance = length(stray);
        if distance > tolerance {
            smooth[i] = points[i] + stray * (tolerance / distance);
        }
    }
    if pinned {
        smooth[0] = points[0];
        smooth[n - 1] = points[n - 1];
    }
    smooth
}

/// Solves `(W + λ DᵀD) x = W p`, with D the second differences. The matrix has five diagonals and is factored
/// into L D Lᵀ.
fn whittaker(points: &[Point], weights: &[f64], stiffness: f64) -> Vec<Point> {
    let n = points.len();
    let mut diagonal = vec![0.0; n];
    let mut one = vec![0.0; n];
    let mut two = vec![0.0; n];
    let mut x: Vec<Vec2> = vec![Vec2::ZERO; n];
    // Row i of DᵀD sums the second differences i−2, i−1 and i that contain the point.
    let holds = |k: isize| if k >= 0 && (k as usize) + 2 < n { 1.0 } else { 0.0 };
    for i in 0..n {
        let k = i as isize;
        let (p, q, r) = (holds(k), holds(k - 1), holds(k - 2));
        let a0 = weights[i] + stiffness * (p + 4.0 * q + r);
        let a1 = stiffness * -2.0 * (p + q);
        let a2 = stiffness * p;
        let (d1, e1) = if i >= 1 { (diagonal[i - 1], one[i - 1]) } else { (0.0, 0.0) };
        let (d2, e2) = if i >= 2 { (diagonal[i - 2], two[i - 2]) } else { (0.0, 0.0) };
        let between = if i >= 1 { two[i - 1] } else { 0.0 };
        diagonal[i] = a0 - d1 * e1 * e1 - d2 * e2 * e2;
        one[i] = (a1 - d1 * e1 * between) / diagonal[i];
        two[i] = a2 / diagonal[i];
        let mut b = points[i].to_vec2() * weights[i];
        if i >= 1 {
            b -= x[i - 1] * e1;
        }
        if i >= 2 {
            b -= x[i - 2] * e2;
        }
        x[i] = b;
    }
    for i in (0..n).rev() {
        let mut b = x[i] / diagonal[i];
        if i + 1 < n {
            b -= x[i + 1] * one[i];
        }
        if i + 2 < n {
            b -= x[i + 2] * two[i];
        }
        x[i] = b;
    }
    x.into_iter().map(Vec2::to_point).collect()
}
