//! Assemblies taken apart: order, room between parts, what cannot be parted, trail lines.

use glam::{DAffine3, DVec3};
use ligne::Scene;
use ligne::explode::{Explosion, TRAIL, explode, moved, with_trails};
use ligne::scene::{Geometry, Part};

use crate::support::dice::Dice;
use crate::support::models;
use crate::support::solids::{Solid, cuboid};

fn assembly(parts: &[(&str, Solid)]) -> Scene {
    let mut scene = Scene::default();
    for (name, solid) in parts {
        let geometry = scene.geometries.len();
        let Solid { positions, triangles } = solid.clone();
        scene.geometries.push(Geometry { positions, triangles, ..Geometry::default() });
        scene.parts.push(Part { name: (*name).into(), geometry, world_from_part: DAffine3::IDENTITY });
    }
    scene
}

fn block(low: [f64; 3], high: [f64; 3]) -> Solid {
    cuboid(DVec3::from(low), DVec3::from(high))
}

/// A square frame about the z axis.
fn frame(inner: f64, outer: f64, low: f64, high: f64) -> Solid {
    let mut ring = block([-outer, -outer, low], [-inner, outer, high]);
    ring.add(block([inner, -outer, low], [outer, outer, high]));
    ring.add(block([-inner, -outer, low], [inner, -inner, high]));
    ring.add(block([-inner, inner, low], [inner, outer, high]));
    ring
}

/// The box around each part.
fn boxes(scene: &Scene) -> Vec<[DVec3; 2]> {
    let of = |part: &Part| {
        let corner = |p: &DVec3| part.world_from_part.transform_point3(*p);
        let corners = scene.geometries[part.geometry].positions.iter().map(corner);
        corners.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], p| [low.min(p), high.max(p)])
    };
    scene.parts.iter().map(of).collect()
}

fn along(axis: DVec3, factor: f64) -> Explosion {
    Explosion { axis: Some(axis), factor }
}

#[test]
fn stacked_parts_keep_their_order_and_come_apart() {
    let plate = |k: f64| block([-2.0, -2.0, k], [2.0, 2.0, k + 1.0]);
    let scene = assembly(&[("c", plate(2.0)), ("a", plate(0.0)), ("b", plate(1.0)), ("d", plate(3.0))]);
    for axis in [DVec3::Z, DVec3::NEG_Z] {
        let ways = explode(&scene, &along(axis, 1.0));
        let apart = boxes(&moved(scene.clone(), &ways));
        let order = [1, 2, 0, 3];
        for pair in order.windows(2) {
            let room = apart[pair[1]][0].z - apart[pair[0]][1].z;
            assert!((room - 0.04 * 48f64.sqrt()).abs() < 1e-9, "{axis}: {room}");
        }
        assert!(ways.offsets.iter().all(|way| way.x == 0.0 && way.y == 0.0));
        assert_eq!(ways.offsets.iter().filter(|way| **way == DVec3::ZERO).count(), 1);
    }
    // Twice as far.
    let far = boxes(&moved(scene.clone(), &explode(&scene, &along(DVec3::Z, 2.0))));
    assert!((far[2][0].z - far[1][1].z - 0.08 * 48f64.sqrt()).abs() < 1e-9);
}

#[test]
fn parts_come_off_on_the_side_that_is_free() {
    // A pot, what is in it, its lid, and its foot.
    let mut pot = frame(2.0, 3.0, 0.0, 4.0);
    pot.add(block([-3.0, -3.0, -1.0], [3.0, 3.0, 0.0]));
    let scene = assembly(&[
        ("in it", block([-1.9, -1.9, 0.0], [1.9, 1.9, 2.0])),
        ("pot", pot),
        ("lid", block([-3.0, -3.0, 4.0], [3.0, 3.0, 5.0])),
        ("foot", block([-1.0, -1.0, -3.0], [1.0, 1.0, -1.0])),
    ]);
    let ways = explode(&scene, &along(DVec3::Z, 1.0));
    let apart = boxes(&moved(scene.clone(), &ways));
    assert_eq!(ways.offsets[1], DVec3::ZERO);
    assert!(apart[0][0].z > apart[1][1].z && apart[2][0].z > apart[0][1].z && apart[3][1].z < apart[1][0].z);
    // Along x the pot holds what is in it; lid and foot are beside it there.
    let ways = explode(&scene, &along(DVec3::X, 1.0));
    assert!(ways.offsets[0].x == 0.0 && ways.offsets[0].length() > 0.0, "{ways:?}");
    // The axis is found.
    let found = explode(&scene, &Explosion::default());
    assert!(found.offsets.iter().all(|way| way.x == 0.0 && way.y == 0.0) && found.offsets[0].z > 0.0);
}

#[test]
fn what_stands_in_a_bore_comes_out_of_it() {
    let scene = assembly(&[
        ("bearing", block([-1.0, -1.0, 2.0], [1.0, 1.0, 3.0])),
        ("case", frame(1.0, 3.0, 0.0, 4.0)),
        ("bush", block([-1.0, -1.0, 0.5], [1.0, 1.0, 1.0])),
        ("post", block([4.0, -1.0, 0.0], [5.0, 1.0, 4.0])),
    ]);
    let ways = explode(&scene, &along(DVec3::Z, 1.0));
    let apart = boxes(&moved(scene.clone(), &ways));
    // The one nearer to an end leaves by that; what stands beside stays.
    assert!(apart[0][0].z > apart[1][1].z && apart[2][1].z < apart[1][0].z, "{ways:?}");
    assert_eq!([ways.offsets[1], ways.offsets[3]], [DVec3::ZERO; 2]);
}

#[test]
fn a_bolt_comes_out_by_its_head_though_its_hole_is_missing() {
    let mut bolt = block([-0.5, -0.5, -2.0], [0.5, 0.5, 1.0]);
    bolt.add(block([-1.0, -1.0, 1.0], [1.0, 1.0, 1.5]));
    let scene = assembly(&[("base", block([-4.0, -4.0, -3.0], [4.0, 4.0, 1.0])), ("bolt", bolt)]);
    let ways = explode(&scene, &along(DVec3::Z, 1.0));
    assert_eq!(ways.offsets[0], DVec3::ZERO);
    assert!(ways.offsets[1].z > 3.0, "{ways:?}");
}

#[test]
fn no_two_parts_overlap_on_the_axis_where_they_overlap_across_it() {
    let mut dice = Dice::new(3);
    for round in 0..20 {
        let mut parts = Vec::new();
        let mut height = 0.0;
        for _ in 0..8 {
            // Blocks on top of each other, shifted and of all sizes.
            let (x, y) = (dice.between(-2.0, 2.0), dice.between(-2.0, 2.0));
            let (w, d, h) = (dice.between(0.5, 3.0), dice.between(0.5, 3.0), dice.between(0.2, 2.0));
            parts.push(("block", block([x - w, y - d, height], [x + w, y + d, height + h])));
            height += h;
        }
        let scene = assembly(&dice.shuffled(parts));
        let before = boxes(&scene);
        let apart = boxes(&moved(scene.clone(), &explode(&scene, &along(DVec3::Z, 1.0))));
        for a in 0..apart.len() {
            for b in 0..a {
                let overlap = apart[a][1].min(apart[b][1]) - apart[a][0].max(apart[b][0]);
                if overlap.x > 0.3 && overlap.y > 0.3 {
                    assert!(overlap.z < 0.0, "round {round}: {a} and {b} overlap by {overlap}");
                    let order = |of: &[[DVec3; 2]]| of[a][0].z < of[b][0].z;
                    assert_eq!(order(&before), order(&apart), "round {round}: {a} and {b}");
                }
            }
        }
    }
}

#[test]
fn trails_lead_from_where_parts_were() {
    let scene = assembly(&[
        ("under", block([-2.0, -2.0, 0.0], [2.0, 2.0, 1.0])),
        ("over", block([-1.0, -1.0, 1.0], [1.0, 1.0, 2.0])),
    ]);
    let ways = explode(&scene, &along(DVec3::Z, 1.0));
    let drawn = with_trails(scene, &ways);
    let trail = drawn.parts.last().expect("a part");
    assert_eq!(trail.name, TRAIL);
    let wires = &drawn.geometries[trail.geometry];
    assert_eq!(wires.wires, [[0, 1]]);
    assert_eq!(wires.positions, [DVec3::new(0.0, 0.0, 1.5), DVec3::new(0.0, 0.0, 1.5) + ways.offsets[1]]);
}

#[test]
fn a_drive_is_taken_apart() {
    let Some(path) = models::find("cad/drive.glb") else { return };
    let scene = Scene::open(path).expect("a model");
    let ways = explode(&scene, &Explosion::default());
    let way = |name: &str| {
        let part =
            scene.parts.iter().position(|part| part.name == name).unwrap_or_else(|| panic!("a {name}"));
        ways.offsets[part]
    };
    let moving = ways.offsets.iter().filter(|way| **way != DVec3::ZERO).count();
    assert!(moving * 2 > ways.offsets.len(), "{moving} of {} move", ways.offsets.len());
    assert!(way("bolt_M6x25_1").length() > 0.0);
    assert_eq!(ways, explode(&scene, &Explosion::default()));
}
