//! A vase with scanner noise next to a machined gear, in one mesh. Smooth and flat shapes can only be
//! distinguished by component.

use std::f64::consts::TAU;

use glam::DVec3;
use libm::{cos, sin};

use crate::geometry::solid::Solid;
use crate::geometry::sweep::{block, turned};
use crate::geometry::toothed_wheel;

const AROUND: usize = 52;
const UP: usize = 46;
/// Amplitude of the scanner noise, as a share of the vase's height.
const NOISE: f64 = 0.0012;

/// Pseudo-random number from −1 to 1 for a grid position, equal on all machines.
fn chance(i: usize, j: usize, salt: usize) -> f64 {
    let mut word = (i * 7919 + j * 104_729 + salt * 1_299_709) as u64;
    for _ in 0..2 {
        word = word.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        word ^= word >> 29;
    }
    (word >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// Outer radius of the vase at a height from 0 to 1.
fn radius(height: f64) -> f64 {
    0.2 + 0.13 * sin(TAU * (0.85 * height - 0.1)) + 0.05 * height
}

/// Closed vase of height 1 with ribs and noise.
fn vase() -> Solid {
    let mut solid = Solid::default();
    let mut rings = vec![vec![solid.point(DVec3::ZERO)]];
    for j in 0..=UP {
        let height = j as f64 / UP as f64;
        rings.push(solid.ring((0..AROUND).map(|i| {
            let turn = TAU * (i as f64 + 0.5 * (j % 2) as f64) / AROUND as f64;
            let rib = 1.0 + 0.025 * cos(6.0 * turn) * sin(TAU / 2.0 * height);
            let out = radius(height) * rib;
            let exact = DVec3::new(out * cos(turn), out * sin(turn), height);
            exact + NOISE * DVec3::new(chance(i, j, 1), chance(i, j, 2), chance(i, j, 3))
        })));
    }
    rings.push(vec![solid.point(DVec3::Z * 1.01)]);
    for pair in rings.windows(2) {
        solid.band(&pair[0], &pair[1]);
    }
    solid
}

/// Stepped gear wheel with a bore, and its hub of one ring.
fn gear() -> Solid {
    let mut gear = toothed_wheel::wheel(22, [0.27, 0.33], (0.12, 28), [0.06, 0.16]);
    let hub = [(0.085, 0.0), (0.14, 0.0), (0.15, 0.01), (0.15, 0.21), (0.14, 0.22), (0.085, 0.22)];
    gear.append(&turned(&hub, 28));
    gear
}

/// Vase, gear and a rod through the gear on a board, z up.
pub fn shelf() -> Solid {
    let mut solid = vase().shifted(-0.32, 0.0, 0.0);
    let upright = glam::DMat3::from_cols(DVec3::NEG_X, DVec3::Z, DVec3::Y);
    let place = |solid: Solid| solid.moved(glam::DAffine3::from_mat3(upright)).shifted(0.38, -0.1, 0.335);
    solid.append(&place(gear()));
    solid.append(&place(turned(
        &[(0.0, -0.1), (0.07, -0.1), (0.08, -0.09), (0.08, 0.4), (0.07, 0.41), (0.0, 0.41)],
        28,
    )));
    solid.append(&block(DVec3::new(-0.75, -0.35, -0.06), DVec3::new(0.85, 0.42, -0.002)));
    solid
}
