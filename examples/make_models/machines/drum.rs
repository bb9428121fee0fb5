//! A planetary gear set with helical teeth inside a closed drum. All teeth are hidden.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use crate::geometry::outline::{circle, polar};
use crate::geometry::part::{Material, Part};
use crate::geometry::solid::Solid;
use crate::geometry::sweep::{block, prism, turned};
use crate::geometry::toothed_wheel;

const PAINT: Material = Material { name: "paint", colour: [0.72, 0.35, 0.22], metallic: 0.0, roughness: 0.6 };
const STEEL: Material = Material { name: "steel", colour: [0.74, 0.75, 0.78], metallic: 1.0, roughness: 0.4 };

/// Twist of the teeth of sun and planets, radians, and number of layers of faces.
const TWIST: f64 = 0.35;
const LAYERS: usize = 3;

/// Cup of the drum, closed at the bottom, with one ring of faces per step.
fn cup() -> Solid {
    let profile = [
        (0.0, -32.0),
        (56.0, -32.0),
        (60.0, -28.0),
        (60.0, 20.0),
        (64.0, 20.0),
        (64.0, 26.0),
        (56.0, 26.0),
        (56.0, -26.0),
        (0.0, -26.0),
    ];
    turned(&profile, 56)
}

/// Lid on the rim with a small gap, which closes the drum.
fn lid() -> Solid {
    let profile = [
        (0.0, 20.0),
        (55.5, 20.0),
        (55.5, 26.1),
        (64.0, 26.1),
        (64.0, 30.0),
        (62.5, 31.5),
        (24.0, 31.5),
        (20.0, 35.5),
        (20.0, 44.0),
        (18.5, 45.5),
        (0.0, 45.5),
    ];
    turned(&profile, 56)
}

/// Shaft that extends from the lid.
fn output() -> Solid {
    turned(&[(0.0, 41.0), (8.0, 41.0), (9.0, 42.0), (9.0, 72.0), (7.5, 73.5), (0.0, 73.5)], 28)
}

/// Sun and planets differ only in the direction of their teeth.
fn gear(twist: f64) -> Solid {
    let bore = circle(DVec2::ZERO, 6.0, 24);
    toothed_wheel::helical(&toothed_wheel::outline(15, 13.0, 16.5), &bore, [-14.0, 8.0], twist, LAYERS)
}

/// Ring gear with teeth on the inside.
fn ring() -> Solid {
    let rim = circle(DVec2::ZERO, 54.0, 56);
    toothed_wheel::helical(&rim, &toothed_wheel::outline(45, 49.0, 45.5), [-14.0, 8.0], -TWIST / 3.0, LAYERS)
}

fn carrier() -> Solid {
    let rim = [(12.0, 11.0), (43.0, 11.0), (44.0, 12.0), (44.0, 15.0), (43.0, 16.0), (12.0, 16.0)];
    let mut solid = turned(&rim, 36);
    for place in around(31.0, 3) {
        let pin =
            turned(&[(0.0, -16.0), (4.0, -16.0), (5.0, -15.0), (5.0, 17.0), (4.0, 18.0), (0.0, 18.0)], 20);
        solid.append(&pin.shifted(place.x, place.y, 0.0));
    }
    solid
}

fn bolt() -> Solid {
    let head: Vec<DVec2> = (0..6).map(|i| polar(DVec2::ZERO, 3.2, TAU * f64::from(i) / 6.0)).collect();
    prism(&head, &[], 31.0, 34.0)
}

/// Points on a circle about z.
fn around(radius: f64, count: u32) -> impl Iterator<Item = DVec2> {
    (0..count).map(move |i| polar(DVec2::ZERO, radius, TAU * f64::from(i) / f64::from(count)))
}

/// The parts, z up, in mm.
pub fn parts() -> Vec<Part> {
    let mut parts = vec![
        Part::new("cup", PAINT, cup()),
        Part::new("lid", PAINT, lid()),
        Part::new("output", STEEL, output()),
        Part::new("sun", STEEL, gear(TWIST)),
        Part::new("ring", STEEL, ring()),
        Part::new("carrier", STEEL, carrier()),
    ];
    let foot = || block(DVec3::new(-10.0, -10.0, -44.0), DVec3::new(10.0, 10.0, -27.0));
    let mut several = |name: &str, material: Material, solid: &dyn Fn() -> Solid, radius: f64, count: u32| {
        for (i, place) in around(radius, count).enumerate() {
            let solid = solid().shifted(place.x, place.y, 0.0);
            parts.push(Part::new(&format!("{name}-{}", i + 1), material, solid));
        }
    };
    several("planet", STEEL, &|| gear(-TWIST), 31.0, 3);
    several("bolt", STEEL, &bolt, 60.2, 8);
    several("foot", PAINT, &foot, 42.0, 4);
    parts
}
