//! A glass jar with three marbles, on a board between two boxes. The material library defines its opacity.

use glam::DVec3;
use libm::{cos, sin};

use crate::geometry::part::{Material, Part};
use crate::geometry::solid::Solid;
use crate::geometry::sweep::{block, turned};

const fn material(name: &'static str, colour: [f64; 3]) -> Material {
    Material { name, colour, metallic: 0.0, roughness: 0.5 }
}

const WOOD: Material = material("wood", [0.72, 0.53, 0.34]);
const CORK: Material = material("cork", [0.8, 0.66, 0.46]);
const GLASS: Material = material("glass", [0.62, 0.85, 0.8]);
const CARDS: Material = material("cards", [0.28, 0.4, 0.72]);
const MARBLES: [Material; 3] = [
    material("red", [0.8, 0.22, 0.18]),
    material("yellow", [0.93, 0.75, 0.2]),
    material("green", [0.3, 0.6, 0.32]),
];

/// Opacity of the glass.
const OPACITY: f64 = 0.35;

fn marble([x, y, z]: [f64; 3], radius: f64) -> Solid {
    let turn = |k: i32| std::f64::consts::PI * f64::from(k) / 24.0;
    let at = |k: i32| {
        // Points at the poles lie exactly on the axis.
        let away = if k == 0 || k == 24 { 0.0 } else { radius * sin(turn(k)) };
        (away, -radius * cos(turn(k)))
    };
    let profile: Vec<(f64, f64)> = (0..=24).map(at).collect();
    turned(&profile, 48).shifted(x, y, z)
}

/// The parts, z up, in cm.
pub fn parts() -> Vec<Part> {
    let glass =
        turned(&[(0.0, 0.1), (3.6, 0.1), (4.0, 0.6), (4.0, 6.6), (3.0, 8.0), (3.0, 9.0), (0.0, 9.0)], 64);
    let cork = turned(&[(0.0, 9.0), (2.9, 9.0), (3.2, 10.4), (0.0, 10.4)], 64);
    let places = [[-1.2, -0.9, 1.7], [1.5, 0.5, 1.6], [-0.4, 1.3, 4.1]];
    let mut parts = vec![
        Part::new("board", WOOD, block(DVec3::new(-10.0, -8.0, -1.0), DVec3::new(10.0, 8.0, 0.0))),
        Part::new("jar", GLASS, glass),
        Part::new("cork", CORK, cork),
        Part::new("box before", CARDS, block(DVec3::new(2.2, -6.8, 0.0), DVec3::new(5.0, -5.0, 3.2))),
        Part::new("box behind", CARDS, block(DVec3::new(-8.0, 4.4, 0.0), DVec3::new(0.5, 6.4, 5.6))),
    ];
    for ((material, place), radius) in MARBLES.into_iter().zip(places).zip([1.5, 1.4, 1.3]) {
        parts.push(Part::new(&format!("{} marble", material.name), material, marble(place, radius)));
    }
    parts
}

/// Material library with the opacity of the glass.
pub fn library(title: &str, parts: &[Part]) -> String {
    let plain = crate::writers::obj::library(title, parts);
    plain.replace("newmtl glass\n", &format!("newmtl glass\nd {OPACITY}\n"))
}
