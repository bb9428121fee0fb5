//! A centrifugal pump with its motor on a base: an assembly of named nodes with shared bolts.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

use glam::{DQuat, DVec3};

use super::pump_motor as motor;
use super::pump_parts as parts;
use super::pump_parts::FLOOR;
use crate::machines::workshop::{
    BLUE, BRASS, DARK, GREEN, HALF_TURN, ORANGE, STEEL, Shop, TO_BACK, TO_FRONT, TO_SIDE, UP, ZINC, around,
    place, several,
};
use crate::writers::glb::{Assembly, Node};

/// Corners of a rectangle at a height.
fn corners(x: [f64; 2], y: f64, z: f64) -> Vec<DVec3> {
    x.into_iter().flat_map(|x| [DVec3::new(x, -y, z), DVec3::new(x, y, z)]).collect()
}

/// The pump, in metres and y up, as glTF requires.
pub fn pump() -> Assembly {
    let mut shop = Shop::default();
    let bolt = shop.mesh("bolt", ZINC, parts::bolt());
    let anchor = shop.mesh("anchor", ZINC, parts::anchor());
    let screw = shop.mesh("screw", STEEL, parts::screw());
    let groups = vec![
        Node::group("base", base(&mut shop, anchor)),
        Node::group("pump-end", pump_end(&mut shop, bolt, screw)),
        Node::group("coupling", coupling(&mut shop)),
        Node::group("motor", drive(&mut shop, bolt, screw)),
    ];
    let root = Node {
        // From z up in mm to y up in m.
        rotation: DQuat::from_xyzw(-FRAC_1_SQRT_2, 0.0, 0.0, FRAC_1_SQRT_2),
        scale: 0.001,
        ..Node::group("pump", groups)
    };
    Assembly {
        meshes: shop.meshes,
        root,
        with_normals: true,
        eye: DVec3::new(-0.95, 0.78, 1.42),
        target: DVec3::new(0.19, -0.07, 0.0),
        fov_y: 20.5 * PI / 180.0,
        aspect: 1.3,
        clip: None,
    }
}

fn base(shop: &mut Shop, anchor: usize) -> Vec<Node> {
    let plate = shop.part("base-plate", DARK, parts::base_plate());
    let rail = shop.mesh("base-rail", DARK, parts::base_rail());
    let left = place("base-rail-left", rail, DVec3::new(0.0, 108.0, 0.0), UP);
    // A half turn about z also swaps the ends, so the rail is shifted back by twice its centre.
    let right = place("base-rail-right", rail, DVec3::new(400.0, -108.0, 0.0), HALF_TURN);
    let mut nodes = vec![plate, left, right];
    let mut spots = corners([-115.0, 515.0], 128.0, FLOOR);
    spots.extend([DVec3::new(230.0, -128.0, FLOOR), DVec3::new(230.0, 128.0, FLOOR)]);
    nodes.extend(several("anchor", anchor, UP, spots));
    nodes
}

fn pump_end(shop: &mut Shop, bolt: usize, screw: usize) -> Vec<Node> {
    let mut nodes = vec![
        shop.part("volute", BLUE, parts::volute()),
        shop.part("suction-cover", BLUE, parts::suction_cover()),
        shop.part("bearing-frame", BLUE, parts::bearing_frame()),
        shop.part("bearing-cap", DARK, parts::bearing_cap()),
        shop.part("pump-shaft", STEEL, parts::shaft(180.0, 214.0)),
    ];
    let plug = shop.mesh("filler-plug", BRASS, parts::plug());
    nodes.push(place("filler-plug", plug, DVec3::new(118.0, 0.0, 41.0), UP));
    let glass = shop.mesh("sight-glass", BRASS, parts::sight_glass());
    nodes.push(place("sight-glass", glass, DVec3::new(112.0, -41.0, 0.0), TO_SIDE));
    nodes.extend(several("cover-bolt", bolt, TO_FRONT, around(-50.0, 77.0, 10, 0.5)));
    nodes.extend(several("frame-bolt", bolt, TO_BACK, around(50.0, 77.0, 8, 0.5)));
    nodes.extend(several("cap-screw", screw, TO_BACK, around(177.0, 34.0, 6, 0.5)));
    nodes.extend(several("foot-bolt", bolt, UP, corners([-21.0, 21.0], 52.0, FLOOR + 12.0)));
    let leg = [DVec3::new(130.0, -33.0, FLOOR + 12.0), DVec3::new(130.0, 33.0, FLOOR + 12.0)];
    nodes.extend(several("leg-bolt", bolt, UP, leg));
    nodes
}

fn coupling(shop: &mut Shop) -> Vec<Node> {
    let hub = shop.mesh("coupling-hub", STEEL, parts::coupling_hub());
    let star = shop.mesh("coupling-star", ORANGE, parts::coupling_star());
    vec![
        place("coupling-hub-pump", hub, DVec3::new(193.0, 0.0, 0.0), UP),
        place("coupling-star", star, DVec3::new(221.5, 0.0, 0.0), UP),
        place("coupling-hub-motor", hub, DVec3::new(262.0, 0.0, 0.0), HALF_TURN),
    ]
}

fn drive(shop: &mut Shop, bolt: usize, screw: usize) -> Vec<Node> {
    let mut nodes = vec![
        shop.part("motor-housing", GREEN, motor::housing()),
        shop.part("motor-shield", GREEN, motor::front_shield()),
        shop.part("motor-shaft", STEEL, parts::shaft(255.0, 275.0)),
        shop.part("fan-cover", DARK, motor::fan_cover()),
        shop.part("terminal-box", GREEN, motor::terminal_box()),
        shop.part("terminal-lid", DARK, motor::terminal_lid()),
    ];
    let eye = shop.mesh("lifting-eye", STEEL, parts::eye_bolt());
    nodes.push(place("lifting-eye", eye, DVec3::new(306.0, 0.0, 87.0), UP));
    nodes.extend(several("motor-bolt", bolt, UP, corners([322.0, 414.0], 64.0, FLOOR + 13.0)));
    nodes.extend(several("lid-screw", screw, UP, corners([327.0, 405.0], 32.0, 122.0)));
    nodes.extend(several("shield-screw", screw, TO_FRONT, around(280.0, 50.0, 4, 0.5)));
    nodes
}
