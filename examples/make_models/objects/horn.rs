//! A post horn: an open bell without thickness, and a tube of straight pieces and narrow bends that passes
//! behind it.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};
use libm::{cos, pow, sin};

use crate::geometry::outline::circle;
use crate::geometry::part::{Material, Part};
use crate::geometry::solid::Solid;
use crate::geometry::sweep::turned;

const BRASS: Material = Material { name: "brass", colour: [0.86, 0.68, 0.3], metallic: 1.0, roughness: 0.25 };
const SILVER: Material = Material { name: "silver", colour: [0.8, 0.8, 0.82], metallic: 1.0, roughness: 0.2 };

const SIDES: usize = 28;
const BEND_STEPS: usize = 16;
const TUBE: f64 = 0.62;
/// Half the height of the coil, half the length of its straight pieces, and the shift of a turn to the back.
const BEND: f64 = 3.6;
const HALF_STRAIGHT: f64 = 4.2;
const BACK: f64 = 2.8;
const BELL_LENGTH: f64 = 13.0;
const BELL_STEPS: usize = 14;
const MOUTH: f64 = 4.6;

/// Centres and radii of the rings from the mouthpiece to the mouth of the bell, z up, with the bell along x.
fn path() -> Vec<(DVec3, f64)> {
    let mut path = Vec::new();
    // Each bend is half a turn in the same direction. The straight pieces between them lead to the front.
    for half_turn in 0..3 {
        let side = if half_turn % 2 == 0 { 1.0 } else { -1.0 };
        let y = BACK * (1.0 - f64::from(half_turn) / 2.0);
        if half_turn == 0 {
            path.push((DVec3::new(-HALF_STRAIGHT - 2.0, y, BEND), TUBE * 0.8));
        }
        path.extend((0..=BEND_STEPS).map(|i| {
            let turn = PI / 2.0 - PI * i as f64 / BEND_STEPS as f64;
            let round = DVec3::new(side * BEND * cos(turn), 0.0, side * BEND * sin(turn));
            (DVec3::new(side * HALF_STRAIGHT, y, 0.0) + round, TUBE)
        }));
    }
    // The last bend ends at the lower right, and the bell leads to the left.
    let foot = DVec3::new(HALF_STRAIGHT - 2.0, -0.3, -BEND);
    path.extend((0..=BELL_STEPS).map(|i| {
        let t = i as f64 / BELL_STEPS as f64;
        let flare = TUBE + 0.5 * t + (MOUTH - TUBE - 0.5) * pow(t, 5.0);
        // Rings are closer together where the bell opens.
        let along = 1.0 - (1.0 - t) * (1.0 - t) * 0.6 - (1.0 - t) * 0.4;
        (foot + along * DVec3::new(-BELL_LENGTH, -2.0, 0.0), flare)
    }));
    path
}

/// Surface of tube and bell, open at both ends.
fn skin() -> Solid {
    let path = path();
    let mut solid = Solid::default();
    let last = path.len() - 1;
    let rings: Vec<Vec<u32>> = (0..=last)
        .map(|i| {
            let (middle, radius) = path[i];
            let way = (path[(i + 1).min(last)].0 - path[i.saturating_sub(1)].0).normalize();
            let u = way.cross(DVec3::Y).normalize();
            let v = way.cross(u);
            let round = circle(DVec2::ZERO, radius, SIDES);
            solid.ring(round.into_iter().map(|point| middle + u * point.x + v * point.y))
        })
        .collect();
    for pair in rings.windows(2) {
        solid.band(&pair[0], &pair[1]);
    }
    solid
}

/// Closed funnel on the first ring.
fn mouth_piece() -> Solid {
    let profile =
        [(0.0, 0.0), (0.3, 0.0), (0.45, 1.2), (1.0, 1.9), (1.15, 2.1), (1.15, 2.3), (0.9, 2.4), (0.0, 1.8)];
    let lying = turned(&profile, 24).moved(glam::DAffine3::from_mat3(glam::DMat3::from_cols(
        DVec3::NEG_Y,
        DVec3::Z,
        DVec3::NEG_X,
    )));
    lying.shifted(-HALF_STRAIGHT - 1.2, BACK, BEND)
}

/// Closed cylinder of one ring with a narrower button, through the tubes.
fn valve(x: f64) -> Solid {
    let profile = [
        (0.0, -4.9),
        (0.75, -4.9),
        (0.95, -4.7),
        (0.95, 4.9),
        (0.35, 4.9),
        (0.35, 5.7),
        (0.7, 5.7),
        (0.7, 5.9),
        (0.0, 5.9),
    ];
    turned(&profile, 24).shifted(x, 0.1, 0.0)
}

/// The parts, z up.
pub fn parts() -> Vec<Part> {
    let mut parts = vec![Part::new("horn", BRASS, skin()), Part::new("mouth-piece", SILVER, mouth_piece())];
    parts.extend(
        (0..3).map(|i| Part::new(&format!("valve-{}", i + 1), SILVER, valve(2.6 * f64::from(i) - 0.4))),
    );
    parts
}
