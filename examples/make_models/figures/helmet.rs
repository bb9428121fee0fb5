//! A helmet as one part of several materials: a smooth shell with straps, posts and a visor. Normals are
//! smooth over all edges except the rims of the shell.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DAffine3, DMat3, DVec3};
use libm::{cos, sin};

use crate::geometry::outline::polar;
use crate::geometry::part::{Material, Part};
use crate::geometry::solid::Solid;
use crate::geometry::sweep::{tube, turned};
use crate::machines::bevels::mean_normals;

const fn paint(name: &'static str, colour: [f64; 3]) -> Material {
    Material { name, colour, metallic: 0.0, roughness: 0.5 }
}

const SHELL: Material = paint("shell", [0.82, 0.8, 0.72]);
const LEATHER: Material = paint("leather", [0.42, 0.27, 0.17]);
const GLASS: Material = paint("glass", [0.25, 0.35, 0.42]);
const BRASS: Material = Material { name: "brass", colour: [0.85, 0.68, 0.33], metallic: 1.0, roughness: 0.3 };

const OUTER: f64 = 1.0;
const INNER: f64 = 0.93;
const SIDES: usize = 40;
const STEPS: i32 = 10;

/// Dome with a thick wall, open at the bottom, with a straight skirt of one ring.
fn shell() -> Solid {
    let mut profile = vec![(0.0, INNER)];
    let quarter = |i: i32| FRAC_PI_2 * f64::from(i) / f64::from(STEPS);
    profile.extend((1..=STEPS).map(|i| (INNER * sin(quarter(i)), INNER * cos(quarter(i)))));
    profile.extend([(INNER, -0.5), (OUTER, -0.5)]);
    profile.extend((0..STEPS).rev().map(|i| (OUTER * sin(quarter(i + 1)), OUTER * cos(quarter(i + 1)))));
    profile.push((0.0, OUTER));
    turned(&profile, SIDES)
}

/// Strap over the dome with bevelled edges. Its section is perpendicular to the arc it follows. `tilt`
/// rotates its plane about y, where its ends are.
fn strap(half_width: f64, tilt: f64, [from, to]: [f64; 2]) -> Solid {
    let (low, high, bevel) = (0.985, 1.05, 0.02);
    let section = [
        (low, -half_width),
        (high - bevel, -half_width),
        (high, bevel - half_width),
        (high, half_width - bevel),
        (high - bevel, half_width),
        (low, half_width),
    ];
    let steps = 24;
    let rings: Vec<Vec<DVec3>> = (0..=steps)
        .map(|i| {
            let turn = from + (to - from) * f64::from(i) / f64::from(steps);
            let out = DVec3::new(0.0, cos(turn), sin(turn));
            section.iter().rev().map(|&(radius, x)| out * radius + DVec3::X * x).collect()
        })
        .collect();
    let lean = DMat3::from_cols(
        DVec3::new(cos(tilt), 0.0, -sin(tilt)),
        DVec3::Y,
        DVec3::new(sin(tilt), 0.0, cos(tilt)),
    );
    tube(&rings).moved(DAffine3::from_mat3(lean))
}

/// Curved pane before the face: a thick piece of a ring on pivots at the sides.
fn visor() -> Solid {
    let reach = 1.05;
    let section = |turn: f64| {
        let out = polar(glam::DVec2::ZERO, 1.0, turn);
        let place = move |radius: f64, z: f64| (out * radius).extend(z);
        vec![place(1.06, -0.42), place(1.1, -0.42), place(1.16, 0.1), place(1.12, 0.12)]
    };
    let rings: Vec<Vec<DVec3>> =
        (0..=16).map(|i| section(reach - 2.0 * reach * f64::from(i) / 16.0)).collect();
    tube(&rings)
}

/// Short cylinder of one ring with chamfers, along y or up.
fn post(radius: f64, length: f64, sides: usize) -> Solid {
    let bevel = 0.18 * radius;
    let profile =
        [(0.0, 0.0), (radius, 0.0), (radius, length - bevel), (radius - bevel, length), (0.0, length)];
    turned(&profile, sides)
}

fn posts() -> Solid {
    let mut solid = Solid::default();
    let to_side = DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y);
    let to_other = DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y);
    for turn in [to_side, to_other] {
        let pivot = post(0.2, 0.3, 20).shifted(0.0, 0.0, 0.88).moved(DAffine3::from_mat3(turn));
        solid.append(&pivot.shifted(0.0, 0.0, -0.12));
    }
    solid.append(&post(0.05, 0.75, 12).shifted(0.0, 0.0, 0.9));
    solid.append(&post(0.11, 0.1, 16).shifted(0.0, 0.0, 1.6));
    solid
}

/// Pieces of one part, z up and facing x, each with its material and normals.
pub fn parts() -> (Vec<Part>, Vec<Vec<DVec3>>) {
    let mut straps = strap(0.1, 0.0, [-0.35, PI + 0.35]);
    straps.append(&strap(0.06, 0.75, [0.3, PI - 0.3]));
    let pieces = [(SHELL, shell()), (LEATHER, straps), (GLASS, visor()), (BRASS, posts())];
    pieces
        .into_iter()
        .map(|(material, solid)| {
            let normals = mean_normals(&solid);
            (Part::new("helmet", material, solid), normals)
        })
        .unzip()
}
