//! 2-D outlines: circles, arcs, rounded polygons, slots and arches.

use std::f64::consts::{PI, TAU};

use glam::DVec2;
use libm::{acos, cos, sin, tan};

/// Point from two numbers.
pub fn at(x: f64, y: f64) -> DVec2 {
    DVec2::new(x, y)
}

/// Point at an angle (radians, counter-clockwise from x) and a distance from a centre.
pub fn polar(centre: DVec2, radius: f64, angle: f64) -> DVec2 {
    centre + radius * DVec2::new(cos(angle), sin(angle))
}

/// Counter-clockwise circle of `count` points.
pub fn circle(centre: DVec2, radius: f64, count: usize) -> Vec<DVec2> {
    (0..count).map(|i| polar(centre, radius, TAU * i as f64 / count as f64)).collect()
}

/// Arc of `steps` segments, including both ends.
pub fn arc(centre: DVec2, radius: f64, from: f64, to: f64, steps: usize) -> Vec<DVec2> {
    (0..=steps).map(|i| polar(centre, radius, from + (to - from) * i as f64 / steps as f64)).collect()
}

/// Rectangle from its lower left to its upper right corner.
pub fn rectangle(low: DVec2, high: DVec2) -> Vec<DVec2> {
    vec![low, at(high.x, low.y), high, at(low.x, high.y)]
}

/// Polygon with tangent arcs of the given radii in place of its corners. A radius of 0 keeps a corner sharp.
pub fn rounded(corners: &[(DVec2, f64)]) -> Vec<DVec2> {
    let count = corners.len();
    let mut outline = Vec::new();
    for (i, &(corner, radius)) in corners.iter().enumerate() {
        let back = (corners[(i + count - 1) % count].0 - corner).normalize();
        let ahead = (corners[(i + 1) % count].0 - corner).normalize();
        if radius <= 0.0 {
            outline.push(corner);
            continue;
        }
        let half = acos(back.dot(ahead).clamp(-1.0, 1.0)) / 2.0;
        let centre = corner + (back + ahead).normalize() * (radius / sin(half));
        let foot = corner + back * (radius / tan(half));
        let sweep = (PI - 2.0 * half) * if back.perp_dot(ahead) < 0.0 { 1.0 } else { -1.0 };
        let steps = (sweep.abs() / (PI / 36.0)).ceil().max(2.0) as usize;
        outline.extend((0..=steps).map(|k| {
            let angle = sweep * k as f64 / steps as f64;
            centre + DVec2::new(cos(angle), sin(angle)).rotate(foot - centre)
        }));
    }
    outline
}

/// Rectangle around a centre, with four equal round corners.
pub fn rounded_rectangle(centre: DVec2, size: DVec2, radius: f64) -> Vec<DVec2> {
    let [low, high] = [centre - size / 2.0, centre + size / 2.0];
    let corners: Vec<_> = rectangle(low, high).into_iter().map(|corner| (corner, radius)).collect();
    rounded(&corners)
}

/// Window or gate: vertical sides below a half circle. `foot` is the centre of the sill.
pub fn arch(foot: DVec2, width: f64, height: f64, steps: usize) -> Vec<DVec2> {
    let half = width / 2.0;
    let mut outline = vec![foot - at(half, 0.0), foot + at(half, 0.0)];
    outline.extend(arc(foot + at(0.0, height - half), half, 0.0, PI, steps));
    outline
}
