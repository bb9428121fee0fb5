//! A brick flies past a man, who turns his head and shakes his fist.
//!
//! Source: figure 13 of Lake and others, "Stylized rendering techniques for scalable real-time 3D animation",
//! 2000.

use std::f64::consts::TAU;

use glam::{DAffine3, DVec3};
use libm::{cos, sin};

use crate::geometry::part::{Material, Part, together, y_up_from_z_up};
use crate::geometry::solid::Solid;
use crate::geometry::sweep::{block, turned};
use crate::machines::crane::turn;
use crate::writers::glb::{Assembly, Moving, Node, Way};

const fn matt(name: &'static str, colour: [f64; 3]) -> Material {
    Material { name, colour, metallic: 0.0, roughness: 0.8 }
}

const CLAY: Material = matt("clay", [0.78, 0.32, 0.2]);
const SKIN: Material = matt("skin", [0.95, 0.76, 0.62]);
const COAT: Material = matt("coat", [0.3, 0.45, 0.62]);
const TROUSERS: Material = matt("trousers", [0.36, 0.34, 0.38]);
const FELT: Material = matt("felt", [0.35, 0.28, 0.22]);
const STONE: Material = matt("stone", [0.74, 0.73, 0.7]);

/// Number of sides of turned solids.
const ROUND: usize = 20;

/// Duration of the flight, seconds.
const FLIGHT: f64 = 1.5;

/// Solid turned about the y axis. The profile lists radii and heights from the bottom outward and up.
fn upright(profile: &[(f64, f64)]) -> Solid {
    turned(profile, ROUND).moved(y_up_from_z_up())
}

/// Ball around the origin.
fn ball(radius: f64) -> Solid {
    let rings = (0..=10).map(|k| {
        let angle = f64::from(k) / 20.0 * TAU;
        let wide = if k % 10 == 0 { 0.0 } else { radius * sin(angle) };
        (wide, -radius * cos(angle))
    });
    upright(&rings.collect::<Vec<_>>())
}

/// Limb that hangs from its joint: a ball, then a cone with a round end.
fn limb(length: f64, from: f64, to: f64) -> Solid {
    upright(&[
        (0.0, -length - 0.9 * to),
        (0.6 * to, -length - 0.7 * to),
        (to, -length),
        (from, 0.0),
        (0.7 * from, 0.7 * from),
        (0.0, from),
    ])
}

/// The man and the brick, in metres, y up, with the clip of the flight.
pub fn brick() -> Assembly {
    let mut meshes = Vec::new();
    let mut node = |name: &str, material: Material, solid: Solid, at: DVec3, children: Vec<Node>| {
        meshes.push(Part::new(name, material, solid));
        Node { translation: at, mesh: Some(meshes.len() - 1), ..Node::group(name, children) }
    };
    let fist =
        |x: f64| ball(0.085).moved(DAffine3::from_scale(DVec3::new(1.0, 1.15, 0.9))).shifted(x, -0.05, 0.0);
    let mut arm = |side: &str, at: DVec3| {
        let fist = node(&format!("fist-{side}"), SKIN, fist(0.0), DVec3::new(0.0, -0.3, 0.0), Vec::new());
        let fore =
            node(&format!("forearm-{side}"), COAT, limb(0.26, 0.075, 0.065), DVec3::Y * -0.32, vec![fist]);
        node(&format!("arm-{side}"), COAT, limb(0.3, 0.095, 0.075), at, vec![fore])
    };
    let arms = [arm("left", DVec3::new(0.29, 1.36, 0.0)), arm("right", DVec3::new(-0.29, 1.36, 0.0))];
    let hat = node(
        "hat",
        FELT,
        upright(&[(0.0, 0.08), (0.27, 0.08), (0.27, 0.1), (0.175, 0.11), (0.15, 0.3), (0.0, 0.3)]),
        DVec3::ZERO,
        Vec::new(),
    );
    let nose = ball(0.05).shifted(0.0, -0.02, 0.19);
    let head = node("head", SKIN, together([ball(0.2), nose]), DVec3::Y * 1.68, vec![hat]);
    let legs = [-0.13, 0.13].map(|x| limb(0.72, 0.12, 0.09).shifted(x, 0.86, 0.0));
    let shoes =
        [-0.13, 0.13].map(|x| block(DVec3::new(x - 0.08, 0.02, -0.12), DVec3::new(x + 0.08, 0.12, 0.2)));
    let trousers = node("trousers", TROUSERS, together(legs), DVec3::ZERO, Vec::new());
    let shoes = node("shoes", FELT, together(shoes), DVec3::ZERO, Vec::new());
    let coat = upright(&[
        (0.0, 0.72),
        (0.31, 0.72),
        (0.25, 1.05),
        (0.27, 1.34),
        (0.16, 1.47),
        (0.08, 1.53),
        (0.0, 1.53),
    ]);
    let man = node("coat", COAT, coat, DVec3::ZERO, [vec![trousers, shoes, head], arms.into()].concat());
    let clay = block(DVec3::new(-0.22, -0.11, -0.13), DVec3::new(0.22, 0.11, 0.13));
    let flying = node("brick", CLAY, clay, DVec3::new(-2.2, 1.2, -0.42), Vec::new());
    let flying = Node { leaves_lines: true, ..flying };
    let pavement = block(DVec3::new(-1.8, -0.06, -0.9), DVec3::new(1.8, 0.0, 0.7));
    let pavement = node("pavement", STONE, pavement, DVec3::ZERO, Vec::new());
    let root = Node::group("street corner", vec![pavement, man, flying]);

    // The brick is thrown: its vertical speed decreases at a constant rate.
    let speed = |time: f64| DVec3::new(2.9, 2.0 - 2.6 * time, 0.0);
    let place = |time: f64| DVec3::new(-2.2 + 2.9 * time, 1.2 + (2.0 - 1.3 * time) * time, -0.42);
    let turns = |node: &str, axis: DVec3, degrees: &[(f64, f64)]| {
        let keys = degrees.iter().map(|(time, degrees)| (*time, turn(axis, *degrees)));
        Moving { node: node.to_owned(), way: Way::Turns(keys.collect()) }
    };
    let moving = vec![
        Moving {
            node: "brick".to_owned(),
            way: Way::Flies([0.0, FLIGHT].map(|time| (time, place(time), speed(time))).into()),
        },
        turns("brick", DVec3::new(0.36, 0.48, -0.8), &[(0.0, 0.0), (0.75, 55.0), (FLIGHT, 110.0)]),
        turns("head", DVec3::Y, &[(0.0, -70.0), (0.35, -60.0), (0.8, 20.0), (1.1, 70.0), (FLIGHT, 75.0)]),
        turns("arm-left", DVec3::Z, &[(0.0, 14.0), (FLIGHT, 14.0)]),
        turns("forearm-left", DVec3::X, &[(0.0, -12.0), (FLIGHT, -12.0)]),
        turns("arm-right", DVec3::Z, &[(0.0, -14.0), (0.5, -14.0), (0.9, -95.0), (FLIGHT, -105.0)]),
        turns(
            "forearm-right",
            DVec3::Z,
            &[(0.0, -8.0), (0.6, -8.0), (0.9, -50.0), (1.1, -80.0), (1.3, -35.0), (FLIGHT, -80.0)],
        ),
    ];
    Assembly {
        meshes,
        root,
        with_normals: false,
        eye: DVec3::new(0.5, 1.6, 6.4),
        target: DVec3::new(0.0, 1.08, 0.0),
        fov_y: TAU / 12.0,
        aspect: 1.3,
        clip: Some(("fly".to_owned(), moving)),
    }
}
