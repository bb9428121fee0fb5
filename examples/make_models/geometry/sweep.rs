//! Solids swept from outlines: prisms, turned parts, boxes and tubes.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};
use libm::{cos, sin};

use super::outline::rectangle;
use super::solid::Solid;

/// Prism along z from `low` to `high` over an outline with holes, in either orientation.
pub fn prism(outer: &[DVec2], holes: &[Vec<DVec2>], low: f64, high: f64) -> Solid {
    let mut solid = Solid::default();
    let mut bottoms = Vec::new();
    let mut tops = Vec::new();
    for (place, rim) in std::iter::once(outer).chain(holes.iter().map(Vec::as_slice)).enumerate() {
        let area: f64 = (0..rim.len()).map(|i| rim[i].perp_dot(rim[(i + 1) % rim.len()])).sum();
        let mut rim = rim.to_vec();
        if (area > 0.0) != (place == 0) {
            rim.reverse();
        }
        let bottom = solid.ring(rim.iter().map(|point| point.extend(low)));
        let top = solid.ring(rim.iter().map(|point| point.extend(high)));
        solid.band(&bottom, &top);
        bottoms.push(bottom);
        tops.push(top);
    }
    bottoms[0].reverse();
    for rims in [bottoms, tops] {
        let holes: Vec<&[u32]> = rims[1..].iter().map(Vec::as_slice).collect();
        solid.plate(&rims[0], &holes);
    }
    solid
}

/// Box between two corners.
pub fn block(low: DVec3, high: DVec3) -> Solid {
    prism(&rectangle(low.truncate(), high.truncate()), &[], low.z, high.z)
}

/// Box of a size, centred on the middle of its bottom.
pub fn pillar(foot: DVec3, size: DVec3) -> Solid {
    let half = DVec3::new(size.x / 2.0, size.y / 2.0, 0.0);
    block(foot - half, foot + half + DVec3::Z * size.z)
}

/// Solid turned about z. The profile lists (radius, z) from the bottom outward and up. It begins and ends on
/// the axis, or closes into a ring.
pub fn turned(profile: &[(f64, f64)], count: usize) -> Solid {
    let mut solid = Solid::default();
    let rings: Vec<Vec<u32>> = profile
        .iter()
        .map(|&(radius, z)| {
            let points = if radius == 0.0 { 1 } else { count };
            solid.ring((0..points).map(|i| {
                let angle = TAU * i as f64 / count as f64;
                DVec3::new(radius * cos(angle), radius * sin(angle), z)
            }))
        })
        .collect();
    for pair in rings.windows(2) {
        solid.band(&pair[0], &pair[1]);
    }
    if let (Some(first), Some(last)) = (rings.first(), rings.last())
        && first.len() > 1
    {
        solid.band(last, first);
    }
    solid
}

/// Surface over a sequence of rings with flat ends. Each ring runs counter-clockwise as seen against the
/// direction of the sequence.
pub fn tube(rings: &[Vec<DVec3>]) -> Solid {
    let mut solid = Solid::default();
    let rings: Vec<Vec<u32>> = rings.iter().map(|ring| solid.ring(ring.iter().copied())).collect();
    for pair in rings.windows(2) {
        solid.band(&pair[0], &pair[1]);
    }
    if let (Some(first), Some(last)) = (rings.first(), rings.last()) {
        let start: Vec<u32> = first.iter().rev().copied().collect();
        solid.plate(&start, &[]);
        solid.plate(last, &[]);
    }
    solid
}

/// Surface over a closed sequence of rings.
pub fn torus(rings: &[Vec<DVec3>]) -> Solid {
    let mut solid = Solid::default();
    let rings: Vec<Vec<u32>> = rings.iter().map(|ring| solid.ring(ring.iter().copied())).collect();
    for i in 0..rings.len() {
        solid.band(&rings[i], &rings[(i + 1) % rings.len()]);
    }
    solid
}

/// Sector of a ring about z: two radii, two angles (radians) and two heights.
pub fn sector(radii: [f64; 2], angles: [f64; 2], heights: [f64; 2], steps: usize) -> Solid {
    let mut outline = super::outline::arc(DVec2::ZERO, radii[1], angles[0], angles[1], steps);
    outline.extend(super::outline::arc(DVec2::ZERO, radii[0], angles[1], angles[0], steps));
    prism(&outline, &[], heights[0], heights[1])
}
