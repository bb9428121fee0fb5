//! A stepped shaft with chamfers in its bearing and motor. Turned parts with long thin faces that
//! interpenetrate.

use std::f64::consts::{PI, TAU};

use glam::{DAffine3, DMat3, DVec2, DVec3};

use crate::geometry::outline::{arc, at, circle, polar};
use crate::geometry::part::{Material, Part};
use crate::geometry::solid::Solid;
use crate::geometry::sweep::{block, prism, turned};
use crate::geometry::toothed_wheel;

const STEEL: Material = Material { name: "steel", colour: [0.72, 0.74, 0.77], metallic: 1.0, roughness: 0.4 };
const CAST: Material = Material { name: "cast", colour: [0.35, 0.45, 0.5], metallic: 0.0, roughness: 0.7 };
const BRASS: Material = Material { name: "brass", colour: [0.85, 0.68, 0.33], metallic: 1.0, roughness: 0.3 };

const SIDES: usize = 32;

/// Rotates a turned part from the z axis to the x axis.
fn lying(solid: Solid) -> Solid {
    solid.moved(DAffine3::from_mat3(DMat3::from_cols(DVec3::Y, DVec3::Z, DVec3::X)))
}

/// Shaft with one ring of faces per step. Two steps end in a chamfer of 45 degrees, and one starts with a
/// cone.
fn shaft() -> Solid {
    turned(
        &[
            (0.0, -84.0),
            (6.5, -84.0),
            (8.0, -82.5),
            (8.0, -26.0),
            (11.0, -23.0),
            (11.0, 19.0),
            (10.0, 20.0),
            (7.0, 20.0),
            (7.0, 70.0),
            (5.5, 71.5),
            (0.0, 71.5),
        ],
        SIDES,
    )
}

/// Pillow block around the thick step, with a gap.
fn bearing() -> Solid {
    let mut rim = vec![at(-46.0, -36.0), at(46.0, -36.0), at(46.0, -25.0), at(27.0, -25.0)];
    rim.extend(arc(DVec2::ZERO, 27.0, 0.0, PI, 20));
    rim.extend([at(-27.0, -25.0), at(-46.0, -25.0)]);
    prism(&rim, &[circle(DVec2::ZERO, 12.0, SIDES)], -20.0, 16.0)
}

/// Cup with chamfered rims around the thin end.
fn motor() -> Solid {
    let profile = [
        (0.0, -120.0),
        (25.0, -120.0),
        (29.0, -116.0),
        (29.0, -51.0),
        (26.0, -48.0),
        (10.0, -48.0),
        (10.0, -88.0),
        (0.0, -88.0),
    ];
    turned(&profile, 40)
}

fn collar() -> Solid {
    turned(&[(7.6, 21.0), (12.5, 21.0), (14.0, 22.5), (14.0, 28.5), (12.5, 30.0), (7.6, 30.0)], SIDES)
}

fn bolt(foot: DVec3) -> Solid {
    let head: Vec<DVec2> = (0..6).map(|i| polar(DVec2::ZERO, 5.5, TAU * f64::from(i) / 6.0)).collect();
    let mut bolt = prism(&head, &[], 0.0, 4.5);
    bolt.append(&turned(&[(0.0, 3.0), (3.0, 3.0), (3.0, 8.0), (2.2, 8.8), (0.0, 8.8)], 20));
    bolt.shifted(foot.x, foot.y, foot.z)
}

/// The parts, with the axis along x, in mm.
pub fn parts() -> Vec<Part> {
    let feet = [-36.0, 36.0].map(|y| bolt(DVec3::new(-2.0, y, -25.0)));
    let stand = block(DVec3::new(-112.0, -22.0, -36.0), DVec3::new(-56.0, 22.0, -20.0));
    let pinion = toothed_wheel::wheel(18, [15.0, 19.0], (7.4, SIDES), [38.0, 58.0]);
    let [left, right] = feet;
    vec![
        Part::new("shaft", STEEL, lying(shaft())),
        Part::new("bearing", CAST, lying(bearing())),
        Part::new("motor", CAST, lying(motor())),
        Part::new("motor-stand", CAST, stand),
        Part::new("collar", BRASS, lying(collar())),
        Part::new("pinion", STEEL, lying(pinion)),
        Part::new("bolt-left", STEEL, left),
        Part::new("bolt-right", STEEL, right),
    ]
}
