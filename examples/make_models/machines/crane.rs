//! A moving crane: a cab on its base, with rotating boom, jib and hook.

use std::f64::consts::TAU;

use glam::{DQuat, DVec3};
use libm::{cos, sin};

use crate::geometry::part::{Material, Part, together};
use crate::geometry::solid::Solid;
use crate::geometry::sweep::{block, turned};
use crate::writers::glb::{Assembly, Moving, Node, Way};

const YELLOW: Material =
    Material { name: "yellow", colour: [0.95, 0.75, 0.15], metallic: 0.0, roughness: 0.5 };
const GREY: Material = Material { name: "grey", colour: [0.45, 0.47, 0.5], metallic: 0.0, roughness: 0.6 };
const GLASS: Material = Material { name: "window", colour: [0.6, 0.8, 0.9], metallic: 0.0, roughness: 0.1 };

/// Lengths of the boom and the jib.
const BOOM: f64 = 4.0;
const JIB: f64 = 2.6;

/// Rotation about an axis by an angle in degrees. Sines and cosines are equal on all machines.
pub fn turn(axis: DVec3, degrees: f64) -> DQuat {
    let half = degrees / 720.0 * TAU;
    let v = axis * sin(half);
    DQuat::from_xyzw(v.x, v.y, v.z, cos(half))
}

/// Beam along x with a boss around its pivot, which lies across; y up.
fn beam(length: f64, high: f64, deep: f64) -> Solid {
    let boss = turned(
        &[(0.0, -0.6 * deep), (0.6 * high, -0.6 * deep), (0.6 * high, 0.6 * deep), (0.0, 0.6 * deep)],
        24,
    );
    let body =
        block(DVec3::new(0.3 * high, -high / 2.0, -deep / 2.0), DVec3::new(length, high / 2.0, deep / 2.0));
    together([body, boss])
}

/// The crane, in metres, y up, with a clip of four seconds.
pub fn crane() -> Assembly {
    let mut meshes = Vec::new();
    let mut node = |name: &str, material: Material, solid: Solid, at: DVec3, children: Vec<Node>| {
        meshes.push(Part::new(name, material, solid));
        Node { translation: at, mesh: Some(meshes.len() - 1), ..Node::group(name, children) }
    };
    let hook = node(
        "hook",
        GREY,
        together([
            block(DVec3::new(-0.04, -1.4, -0.04), DVec3::new(0.04, 0.0, 0.04)),
            block(DVec3::new(-0.25, -1.9, -0.25), DVec3::new(0.25, -1.4, 0.25)),
        ]),
        DVec3::X * JIB,
        Vec::new(),
    );
    let jib = node("jib", YELLOW, beam(JIB, 0.3, 0.3), DVec3::X * BOOM, vec![hook]);
    let boom = node("boom", YELLOW, beam(BOOM, 0.45, 0.4), DVec3::new(0.5, 1.0, 0.0), vec![jib]);
    let window = node(
        "window",
        GLASS,
        block(DVec3::new(0.1, 0.35, 0.66), DVec3::new(0.6, 0.95, 0.7)),
        DVec3::ZERO,
        Vec::new(),
    );
    let cab = node(
        "cab",
        YELLOW,
        block(DVec3::new(-1.0, 0.02, -0.65), DVec3::new(0.8, 1.15, 0.65)),
        DVec3::Y * 0.9,
        vec![boom, window],
    );
    let base = node(
        "base",
        GREY,
        block(DVec3::new(-1.2, 0.0, -1.2), DVec3::new(1.2, 0.9, 1.2)),
        DVec3::ZERO,
        vec![cab],
    );
    // Each node turns about one axis, with a key per second.
    let turning = |node: &str, axis: DVec3, degrees: [f64; 5]| {
        let keys = degrees.iter().enumerate().map(|(k, degrees)| (k as f64, turn(axis, *degrees)));
        Moving { node: node.to_owned(), way: Way::Turns(keys.collect()) }
    };
    let turnings = vec![
        turning("cab", DVec3::Y, [0.0, 0.0, 50.0, 50.0, 0.0]),
        turning("boom", DVec3::Z, [15.0, 60.0, 60.0, 35.0, 15.0]),
        turning("jib", DVec3::Z, [-40.0, -80.0, -30.0, -55.0, -40.0]),
        turning("hook", DVec3::Z, [25.0, 20.0, -30.0, 20.0, 25.0]),
    ];
    Assembly {
        meshes,
        root: base,
        with_normals: false,
        eye: DVec3::new(3.0, 6.0, 13.0),
        target: DVec3::new(2.0, 2.4, 0.0),
        fov_y: TAU / 9.0,
        aspect: 1.3,
        clip: Some(("lift".to_owned(), turnings)),
    }
}
