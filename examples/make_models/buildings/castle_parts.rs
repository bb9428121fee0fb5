//! Parts of the castle: battlements, round towers, windows, flags and quoins.

use std::f64::consts::{PI, TAU};

use glam::{DAffine3, DMat3, DVec2, DVec3};
use libm::sin;

use crate::geometry::outline::{arc, arch, at};
use crate::geometry::part::{Material, together};
use crate::geometry::solid::Solid;
use crate::geometry::sweep::{block, prism, sector, turned};

const fn plain(name: &'static str, colour: [f64; 3]) -> Material {
    Material { name, colour, metallic: 0.0, roughness: 1.0 }
}

pub const STONE: Material = plain("stone", [0.80, 0.77, 0.70]);
pub const ASH: Material = plain("ashlar", [0.88, 0.85, 0.78]);
pub const SANDSTONE: Material = plain("sandstone", [0.72, 0.62, 0.48]);
pub const ROOF: Material = plain("roof", [0.70, 0.26, 0.20]);
pub const SLATE: Material = plain("slate", [0.34, 0.38, 0.45]);
pub const WOOD: Material = plain("wood", [0.45, 0.30, 0.18]);
pub const GLASS: Material = plain("glass", [0.20, 0.26, 0.34]);
pub const GOLD: Material = plain("gold", [0.86, 0.70, 0.28]);
pub const FLAG: Material = plain("flag", [0.18, 0.36, 0.62]);
pub const GRASS: Material = plain("grass", [0.46, 0.60, 0.34]);

/// Number of sides of a round tower.
const SIDES: usize = 36;

/// Rotation from -y to the direction (x, y), a unit vector.
pub fn facing(x: f64, y: f64) -> DAffine3 {
    DAffine3::from_mat3(DMat3::from_cols(DVec3::new(-y, x, 0.0), DVec3::new(-x, -y, 0.0), DVec3::Z))
}

/// Turns a prism over (x, z) upright, with its height towards -y.
fn upright(solid: Solid) -> Solid {
    solid.moved(DAffine3::from_mat3(DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y)))
}

/// Wall along x around the origin, with a parapet of `merlons` merlons on its outer (-y) side and a walkway
/// behind it.
pub fn battlement(length: f64, thickness: f64, height: f64, merlons: u32) -> Solid {
    let half = length / 2.0;
    let tooth = length / f64::from(2 * merlons - 1);
    let (crest, sill, foot) = (height, height - 0.55, height - 1.0);
    let mut outline = vec![at(-half, foot - 0.1), at(half, foot - 0.1)];
    for i in (0..merlons).rev() {
        let left = -half + tooth * f64::from(2 * i);
        outline.extend([at(left + tooth, crest), at(left, crest)]);
        if i > 0 {
            outline.extend([at(left, sill), at(left - tooth, sill)]);
        }
    }
    let parapet = upright(prism(&outline, &[], thickness / 2.0 - 0.3, thickness / 2.0 + 0.12));
    let y = thickness / 2.0;
    if foot < 0.6 {
        return parapet;
    }
    let wall = block(DVec3::new(-half, -y, 0.0), DVec3::new(half, y, foot));
    let plinth = block(DVec3::new(-half, -y - 0.18, 0.0), DVec3::new(half, y, 0.5));
    together([wall, plinth, parapet])
}

/// Solids of a round tower by material, and the position of its tip.
pub struct Tower {
    pub stone: Solid,
    pub trim: Solid,
    pub roof: Solid,
    pub top: f64,
}

/// Round tower about z: a battered foot, a corbelled parapet with merlons, a drum and a cone.
pub fn round_tower(radius: f64, height: f64, cone: f64) -> Tower {
    let r = radius;
    let wide = r * 1.16;
    let shaft = turned(
        &[
            (0.0, 0.0),
            (r * 1.14, 0.0),
            (r * 1.12, 0.35),
            (r, 1.3),
            (r, height - 1.9),
            (r * 1.04, height - 1.6),
            (wide, height - 1.3),
            (wide, height - 0.6),
            (wide * 0.88, height - 0.6),
            (wide * 0.88, height - 1.0),
            (0.0, height - 1.0),
        ],
        SIDES,
    );
    let merlons = 12;
    let pitch = TAU / f64::from(merlons);
    let merlons = (0..merlons).map(|i| {
        let middle = pitch * (f64::from(i) + 0.5);
        sector(
            [wide * 0.9, wide * 0.985],
            [middle - 0.29 * pitch, middle + 0.29 * pitch],
            [height - 0.6, height - 0.1],
            4,
        )
    });
    let drum = turned(
        &[(0.0, height - 1.1), (r * 0.8, height - 1.1), (r * 0.8, height + 0.6), (0.0, height + 0.6)],
        SIDES,
    );
    let stone = together([shaft, drum].into_iter().chain(merlons));

    let belt = |z: f64| turned(&[(0.0, z), (r + 0.08, z), (r + 0.08, z + 0.18), (0.0, z + 0.18)], SIDES);
    let corbels = (0..24).map(|i| {
        let middle = TAU * f64::from(i) / 24.0;
        sector([r * 0.9, r * 1.13], [middle - 0.05, middle + 0.05], [height - 2.0, height - 1.35], 2)
    });
    let trim = together([belt(height * 0.52)].into_iter().chain(corbels));

    let eave = height + 0.5;
    let (out, tip) = (r * 1.02, eave + cone);
    // The foot of the cone flares, like a shingle roof.
    let roof = turned(
        &[
            (0.0, eave),
            (out, eave),
            (out, eave + 0.08),
            (out * 0.80, eave + 0.08 + cone * 0.12),
            (out * 0.40, eave + cone * 0.52),
            (0.0, tip),
        ],
        SIDES,
    );
    Tower { stone, trim, roof, top: tip - 0.15 }
}

/// Pane and frame of a window with a sill, in the plane y = 0, facing -y, with the foot at the origin.
pub fn window(width: f64, height: f64) -> (Solid, Solid) {
    let inner = arch(DVec2::ZERO, width, height, 10);
    let pane = upright(prism(&inner, &[], -0.1, 0.04));
    let half = width / 2.0;
    let mut hood = arc(at(0.0, height - half), half + 0.14, 0.0, PI, 10);
    hood.extend(arc(at(0.0, height - half), half, PI, 0.0, 10));
    let hood = upright(prism(&hood, &[], -0.1, 0.12));
    let sill = block(DVec3::new(-half - 0.16, -0.2, -0.16), DVec3::new(half + 0.16, 0.1, 0.0));
    let bar = block(DVec3::new(-0.04, -0.08, 0.0), DVec3::new(0.04, 0.05, height - 0.02));
    (pane, together([hood, sill, bar]))
}

/// Pole with a knob, and a waving pennant at its top. Both start at the origin.
pub fn flag(height: f64, length: f64) -> (Solid, Solid) {
    let r = 0.05;
    let knob: Vec<(f64, f64)> =
        arc(at(0.0, height), 2.2 * r, -0.45 * PI, 0.45 * PI, 8).iter().map(|p| (p.x, p.y)).collect();
    let mut profile = vec![(0.0, 0.0), (r, 0.0), (r, knob[0].1)];
    profile.extend(&knob[1..]);
    profile.push((0.0, height + 2.2 * r));
    let pole = turned(&profile, 16);

    let steps: u32 = 14;
    let mut solid = Solid::default();
    let (middle, half) = (height - 0.12 - 0.28 * length, 0.28 * length);
    let [low, high] = [-1.0, 1.0].map(|edge| {
        [-0.012, 0.012].map(|side| {
            solid.ring((0..=steps).map(|i| {
                let t = f64::from(i) / f64::from(steps);
                let wave = 0.1 * length * sin(TAU * t) * t;
                let z = middle + edge * half * (1.0 - 0.94 * t);
                DVec3::new(length * t + 0.8 * r, wave + side, z)
            }))
        })
    });
    solid.strip(&low[0], &high[0]);
    solid.strip(&high[1], &low[1]);
    solid.strip(&low[1], &low[0]);
    solid.strip(&high[0], &high[1]);
    let end = steps as usize;
    solid.faces.push(vec![low[1][0], low[0][0], high[0][0], high[1][0]]);
    solid.faces.push(vec![low[0][end], low[1][end], high[1][end], high[0][end]]);
    (pole, solid)
}

/// Pseudo-random number from 0 to 1 for two integers.
fn chance(seed: u32, index: u32) -> f64 {
    let mut bits = seed.wrapping_mul(0x9E37_79B9) ^ index.wrapping_mul(0x85EB_CA6B);
    for _ in 0..2 {
        bits = (bits ^ (bits >> 15)).wrapping_mul(0x2C1B_3C6D);
    }
    f64::from(bits >> 8) / f64::from(1_u32 << 24)
}

/// Loose facing stones on a wall that faces -y, around the origin along x, from z = 0 up.
pub fn quoins(length: f64, height: f64, seed: u32) -> Solid {
    let courses = (height / 0.42) as u32;
    let slots = (length / 1.0) as u32;
    let mut stones = Vec::new();
    for (course, slot) in (0..courses).flat_map(|course| (0..slots).map(move |slot| (course, slot))) {
        let index = course * 64 + slot;
        if chance(seed, index) < 0.2 {
            let shift = if course % 2 == 0 { 0.0 } else { 0.5 };
            let x = -length / 2.0 + f64::from(slot) + shift;
            let z = 0.42 * f64::from(course) + 0.2;
            let width = 0.5 + 0.35 * chance(seed + 1, index);
            stones.push(block(DVec3::new(x, -0.06, z), DVec3::new(x + width, 0.1, z + 0.34)));
        }
    }
    together(stones)
}
