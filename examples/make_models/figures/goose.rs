//! A goose with few faces: body, neck, wings and legs that interpenetrate. Its outline can be drawn smoother
//! than its mesh.

use std::f64::consts::TAU;

use glam::{DAffine3, DVec3};
use libm::{cos, sin};

use crate::geometry::part::{Material, Part};
use crate::geometry::solid::Solid;

const DOWN: Material = Material { name: "down", colour: [0.93, 0.93, 0.9], metallic: 0.0, roughness: 0.9 };
const ORANGE: Material =
    Material { name: "orange", colour: [0.92, 0.55, 0.15], metallic: 0.0, roughness: 0.6 };

/// Cross-section of a limb: centre, half-axis sideways, and half-axis perpendicular to limb and side.
type Slice = ([f64; 3], f64, f64);

/// Closed surface with `sides` sides around cross-sections in the plane of x and z, perpendicular to the
/// path. The first and the last are points.
fn limb(slices: &[Slice], sides: usize) -> Solid {
    let mut solid = Solid::default();
    let middle = |i: usize| DVec3::from(slices[i].0);
    let last = slices.len() - 1;
    let rings: Vec<Vec<u32>> = (0..=last)
        .map(|i| {
            if i == 0 || i == last {
                return vec![solid.point(middle(i))];
            }
            let way = (middle(i + 1) - middle(i - 1)).normalize();
            let (wide, high) = (slices[i].1, slices[i].2);
            let up = way.cross(DVec3::Y).normalize();
            let aside = way.cross(up);
            solid.ring((0..sides).map(|k| {
                // Every second ring is rotated by half a side, so no edge loop runs along the limb.
                let turn = TAU * (k as f64 + 0.5 * (i % 2) as f64) / sides as f64;
                middle(i) + up * (high * cos(turn)) + aside * (wide * sin(turn))
            }))
        })
        .collect();
    for (i, pair) in rings.windows(2).enumerate() {
        let (lower, upper) = (&pair[0], &pair[1]);
        for k in 0..lower.len().max(upper.len()) {
            let (next, at) = ((k + 1) % sides, |ring: &[u32], k: usize| ring[k.min(ring.len() - 1)]);
            let [a, b, c, d] = [at(lower, k), at(lower, next), at(upper, next), at(upper, k)];
            if a == b {
                solid.faces.push(vec![a, c, d]);
            } else if c == d {
                solid.faces.push(vec![a, b, c]);
            } else if i % 2 == 0 {
                // The upper ring is rotated by half a side.
                solid.faces.extend([vec![a, b, c], vec![a, c, d]]);
            } else {
                solid.faces.extend([vec![a, b, d], vec![b, c, d]]);
            }
        }
    }
    solid
}

fn body() -> Solid {
    limb(
        &[
            ([-2.3, 0.0, 2.25], 0.0, 0.0),
            ([-1.9, 0.0, 2.1], 0.42, 0.2),
            ([-1.2, 0.0, 1.75], 0.85, 0.62),
            ([-0.3, 0.0, 1.5], 1.05, 0.9),
            ([0.6, 0.0, 1.5], 0.98, 0.88),
            ([1.25, 0.0, 1.65], 0.65, 0.6),
            ([1.55, 0.0, 1.75], 0.0, 0.0),
        ],
        9,
    )
}

fn neck() -> Solid {
    limb(
        &[
            ([0.6, 0.0, 1.4], 0.0, 0.0),
            ([0.9, 0.0, 1.75], 0.5, 0.5),
            ([1.25, 0.0, 2.4], 0.36, 0.36),
            ([1.32, 0.0, 3.1], 0.29, 0.29),
            ([1.35, 0.0, 3.6], 0.34, 0.36),
            ([1.62, 0.0, 4.0], 0.37, 0.38),
            ([1.98, 0.0, 3.98], 0.26, 0.26),
            ([2.14, 0.0, 3.9], 0.0, 0.0),
        ],
        8,
    )
}

fn beak() -> Solid {
    let slices = [
        ([1.85, 0.0, 4.0], 0.0, 0.0),
        ([1.95, 0.0, 3.96], 0.2, 0.2),
        ([2.35, 0.0, 3.78], 0.17, 0.11),
        ([2.72, 0.0, 3.66], 0.0, 0.0),
    ];
    limb(&slices, 6)
}

/// Wing on the side `y`, whose root lies inside the body.
fn wing(y: f64) -> Solid {
    let slices = [
        ([0.95, y, 1.75], 0.0, 0.0),
        ([0.6, y, 1.85], 0.2, 0.38),
        ([-0.3, y, 1.9], 0.26, 0.55),
        ([-1.2, y, 2.05], 0.18, 0.36),
        ([-2.0, y * 0.75, 2.3], 0.0, 0.0),
    ];
    limb(&slices, 7)
}

fn leg(y: f64) -> Solid {
    let mut leg = limb(
        &[
            ([0.1, y, 1.1], 0.0, 0.0),
            ([0.1, y, 0.9], 0.24, 0.24),
            ([0.16, y, 0.12], 0.11, 0.11),
            ([0.16, y, 0.0], 0.0, 0.0),
        ],
        6,
    );
    let foot = limb(
        &[
            ([-0.12, y, 0.06], 0.0, 0.0),
            ([0.02, y, 0.08], 0.12, 0.08),
            ([0.55, y, 0.05], 0.3, 0.05),
            ([0.72, y, 0.04], 0.0, 0.0),
        ],
        6,
    );
    leg.append(&foot);
    leg
}

/// The parts, z up and facing x.
pub fn parts() -> Vec<Part> {
    let left = DAffine3::from_scale(DVec3::new(1.0, -1.0, 1.0));
    vec![
        Part::new("body", DOWN, body()),
        Part::new("neck", DOWN, neck()),
        Part::new("beak", ORANGE, beak()),
        Part::new("wing-right", DOWN, wing(-0.95)),
        Part::new("wing-left", DOWN, wing(-0.95).moved(left)),
        Part::new("leg-right", ORANGE, leg(-0.4)),
        Part::new("leg-left", ORANGE, leg(-0.4).moved(left)),
    ]
}
