//! Bars of constant cross-section along z, so an edge is determined by a corner of the profile.

use glam::DVec3;
use libm::{cos, sin};

use super::solids::Solid;

/// Length of the bars along z, world units.
pub(crate) const BAR_LENGTH: f64 = 6.0;

/// A bar with a convex or star-shaped profile around the origin, counter-clockwise.
pub(crate) fn bar(profile: &[[f64; 2]]) -> Solid {
    let mut solid = Solid::default();
    let count = profile.len() as u32;
    for z in [0.0, BAR_LENGTH] {
        solid.positions.push(DVec3::new(0.0, 0.0, z));
        solid.positions.extend(profile.iter().map(|[x, y]| DVec3::new(*x, *y, z)));
    }
    for k in 0..count {
        let [a, b] = [k + 1, (k + 1) % count + 1];
        let [c, d] = [a, b].map(|v| v + count + 1);
        solid.triangles.extend([[a, b, c], [b, d, c], [b, a, 0], [c, d, count + 1]]);
    }
    solid
}

/// A profile from a start point and steps, each a length followed by a turn in degrees.
pub(crate) fn step_profile(start: [f64; 2], steps: &[(f64, f64)]) -> Vec<[f64; 2]> {
    let (mut at, mut heading, mut profile) = (start, 0.0f64, vec![start]);
    for (length, turn) in steps {
        at = [at[0] + length * cos(heading), at[1] + length * sin(heading)];
        profile.push(at);
        heading += turn.to_radians();
    }
    profile
}
