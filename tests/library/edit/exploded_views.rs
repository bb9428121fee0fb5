//! Exploded views of small assemblies against exact offsets: order of parts, gaps, free directions, part
//! settings and trail lines.

use glam::{DAffine3, DQuat, DVec3};
use ligne::Scene;
use ligne::edit::explode::{Explosion, PartExplosion, TRAIL, explode, moved, with_trails};
use ligne::scene::{Geometry, Part};

use crate::library::support::readers::shared_folder;
use crate::library::support::scenes::random_dice::Dice;
use crate::library::support::scenes::solids::{Solid, cuboid};

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

/// Square frame about the z axis.
fn frame(inner: f64, outer: f64, low: f64, high: f64) -> Solid {
    let mut ring = block([-outer, -outer, low], [-inner, outer, high]);
    ring.add(block([inner, -outer, low], [outer, outer, high]));
    ring.add(block([-inner, -outer, low], [inner, -inner, high]));
    ring.add(block([-inner, inner, low], [inner, outer, high]));
    ring
}

/// World-space bounding box of each part.
fn boxes(scene: &Scene) -> Vec<[DVec3; 2]> {
    let of = |part: &Part| {
        let corner = |p: &DVec3| part.world_from_part.transform_point3(*p);
        let corners = scene.geometries[part.geometry].positions.iter().map(corner);
        corners.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], p| [low.min(p), high.max(p)])
    };
    scene.parts.iter().map(of).collect()
}

fn explosion_along(axis: DVec3, factor: f64) -> Explosion {
    Explosion { axis: Some(axis), factor, ..Explosion::default() }
}

#[test]
fn stacked_parts_keep_their_order_when_exploded() {
    let plate = |k: f64| block([-2.0, -2.0, k], [2.0, 2.0, k + 1.0]);
    let scene = assembly(&[("c", plate(2.0)), ("a", plate(0.0)), ("b", plate(1.0)), ("d", plate(3.0))]);
    for axis in [DVec3::Z, DVec3::NEG_Z] {
        let ways = explode(&scene, &explosion_along(axis, 1.0));
        let apart = boxes(&moved(scene.clone(), &ways));
        let order = [1, 2, 0, 3];
        for pair in order.windows(2) {
            let room = apart[pair[1]][0].z - apart[pair[0]][1].z;
            assert!((room - 0.04 * 48f64.sqrt()).abs() < 1e-9, "{axis}: {room}");
        }
        assert!(ways.offsets.iter().all(|way| way.x == 0.0 && way.y == 0.0));
        assert_eq!(ways.offsets.iter().filter(|way| **way == DVec3::ZERO).count(), 1);
    }
    // A factor of 2 doubles the gaps.
    let far = boxes(&moved(scene.clone(), &explode(&scene, &explosion_along(DVec3::Z, 2.0))));
    assert!((far[2][0].z - far[1][1].z - 0.08 * 48f64.sqrt()).abs() < 1e-9);
}

#[test]
fn exploded_parts_move_towards_their_free_side() {
    // A pot with its contents, a lid and a foot.
    let mut pot = frame(2.0, 3.0, 0.0, 4.0);
    pot.add(block([-3.0, -3.0, -1.0], [3.0, 3.0, 0.0]));
    let scene = assembly(&[
        ("in it", block([-1.9, -1.9, 0.0], [1.9, 1.9, 2.0])),
        ("pot", pot),
        ("lid", block([-3.0, -3.0, 4.0], [3.0, 3.0, 5.0])),
        ("foot", block([-1.0, -1.0, -3.0], [1.0, 1.0, -1.0])),
    ]);
    let ways = explode(&scene, &explosion_along(DVec3::Z, 1.0));
    let apart = boxes(&moved(scene.clone(), &ways));
    assert_eq!(ways.offsets[1], DVec3::ZERO);
    assert!(apart[0][0].z > apart[1][1].z && apart[2][0].z > apart[0][1].z && apart[3][1].z < apart[1][0].z);
    // Along x the pot blocks its contents, so they move in another direction.
    let ways = explode(&scene, &explosion_along(DVec3::X, 1.0));
    assert!(ways.offsets[0].x == 0.0 && ways.offsets[0].length() > 0.0, "{ways:?}");
    // Without an axis, the z axis is found.
    let found = explode(&scene, &Explosion::default());
    assert!(found.offsets.iter().all(|way| way.x == 0.0 && way.y == 0.0) && found.offsets[0].z > 0.0);
}

#[test]
fn parts_in_a_bore_leave_by_the_nearer_end() {
    let scene = assembly(&[
        ("bearing", block([-1.0, -1.0, 2.0], [1.0, 1.0, 3.0])),
        ("case", frame(1.0, 3.0, 0.0, 4.0)),
        ("bush", block([-1.0, -1.0, 0.5], [1.0, 1.0, 1.0])),
        ("post", block([4.0, -1.0, 0.0], [5.0, 1.0, 4.0])),
    ]);
    let ways = explode(&scene, &explosion_along(DVec3::Z, 1.0));
    let apart = boxes(&moved(scene.clone(), &ways));
    // Each part leaves the bore by the nearer end. The post next to the case stays.
    assert!(apart[0][0].z > apart[1][1].z && apart[2][1].z < apart[1][0].z, "{ways:?}");
    assert_eq!([ways.offsets[1], ways.offsets[3]], [DVec3::ZERO; 2]);
}

#[test]
fn a_bolt_leaves_by_its_head_without_a_modelled_hole() {
    let mut bolt = block([-0.5, -0.5, -2.0], [0.5, 0.5, 1.0]);
    bolt.add(block([-1.0, -1.0, 1.0], [1.0, 1.0, 1.5]));
    let scene = assembly(&[("base", block([-4.0, -4.0, -3.0], [4.0, 4.0, 1.0])), ("bolt", bolt)]);
    let ways = explode(&scene, &explosion_along(DVec3::Z, 1.0));
    assert_eq!(ways.offsets[0], DVec3::ZERO);
    assert!(ways.offsets[1].z > 3.0, "{ways:?}");
}

#[test]
fn parts_that_overlap_across_the_axis_separate_along_it() {
    let mut dice = Dice::new(3);
    for round in 0..20 {
        let mut parts = Vec::new();
        let mut height = 0.0;
        for _ in 0..8 {
            // Stacked blocks of random sizes and offsets.
            let (x, y) = (dice.between(-2.0, 2.0), dice.between(-2.0, 2.0));
            let (w, d, h) = (dice.between(0.5, 3.0), dice.between(0.5, 3.0), dice.between(0.2, 2.0));
            parts.push(("block", block([x - w, y - d, height], [x + w, y + d, height + h])));
            height += h;
        }
        let scene = assembly(&dice.shuffled(parts));
        let before = boxes(&scene);
        let apart = boxes(&moved(scene.clone(), &explode(&scene, &explosion_along(DVec3::Z, 1.0))));
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
fn trail_lines_start_at_the_original_positions() {
    let scene = assembly(&[
        ("under", block([-2.0, -2.0, 0.0], [2.0, 2.0, 1.0])),
        ("over", block([-1.0, -1.0, 1.0], [1.0, 1.0, 2.0])),
    ]);
    let ways = explode(&scene, &explosion_along(DVec3::Z, 1.0));
    let drawn = with_trails(scene, &ways);
    let trail = drawn.parts.last().expect("a part");
    assert_eq!(trail.name, TRAIL);
    let wires = &drawn.geometries[trail.geometry];
    assert_eq!(wires.wires, [[0, 1]]);
    assert_eq!(wires.positions, [DVec3::new(0.0, 0.0, 1.5), DVec3::new(0.0, 0.0, 1.5) + ways.offsets[1]]);
}

/// A base, and a washer, a disc and a nut on a stud along the z axis. The stack is 6 units tall.
fn stack(place: impl Fn(DVec3) -> DVec3) -> Vec<(&'static str, Solid)> {
    let parts = vec![
        ("base", block([-2.0, -2.0, 0.0], [2.0, 2.0, 1.0])),
        ("washer", frame(0.5, 1.0, 1.0, 1.3)),
        ("disc", frame(0.5, 1.6, 1.3, 2.0)),
        ("nut", frame(0.48, 1.0, 2.0, 2.8)),
        ("stud", block([-0.5, -0.5, 1.0], [0.5, 0.5, 6.0])),
    ];
    let placed = |(name, mut solid): (&'static str, Solid)| {
        solid.positions.iter_mut().for_each(|p| *p = place(*p));
        (name, solid)
    };
    parts.into_iter().map(placed).collect()
}

#[test]
fn sub_assemblies_explode_along_their_own_axis() {
    let mut dice = Dice::new(57);
    for round in 0..12 {
        let turn = DQuat::from_axis_angle(dice.direction(), dice.between(0.3, 1.2));
        let rounded = |p: DVec3| if round % 2 == 0 { p } else { p.as_vec3().as_dvec3() };
        let mut parts = vec![("ground", block([-8.0, -4.0, -3.0], [12.0, 4.0, -2.5]))];
        parts.extend(stack(|p| p - DVec3::X * 4.0 - DVec3::Z * 2.5));
        parts.extend(stack(|p| rounded(turn * p + DVec3::X * 6.0)));
        let ways = explode(&assembly(&parts), &Explosion::default());
        for (first, axis) in [(1, DVec3::Z), (6, turn * DVec3::Z)] {
            let of_base = ways.offsets[first];
            let heights: Vec<f64> = (0..5).map(|k| (ways.offsets[first + k] - of_base).dot(axis)).collect();
            for k in 1..5 {
                let aside = (ways.offsets[first + k] - of_base).cross(axis).length();
                assert!(aside < 1e-5, "round {round}: part {k} leaves the axis by {aside}: {ways:?}");
            }
            assert!(heights.windows(2).all(|pair| pair[0] < pair[1]), "round {round}: {heights:?}");
            assert!(heights[4] > heights[3] + 1.8, "round {round}: the stud stays in the nut: {heights:?}");
        }
    }
}

#[test]
fn parts_are_not_pulled_through_their_retainers() {
    // The stud overlaps the nut slightly, as modelled threads do.
    let parts = stack(|p| p);
    for axis in [DVec3::X, DVec3::Y, DVec3::new(1.0, 1.0, 0.0)] {
        let ways = explode(&assembly(&parts), &explosion_along(axis, 1.0));
        let between = ways.offsets[4] - ways.offsets[3];
        assert!(between.cross(DVec3::Z).length() < 1e-9 && between.z > 0.0, "{axis}: {ways:?}");
    }
}

#[test]
fn thin_parts_block_others() {
    // A pin under a hook, both much thinner than a hundredth of their plate.
    for side in [0.5, 0.05, 0.005] {
        let mut hook = block([side, 0.0, 0.0], [2.0 * side, side, 3.0]);
        hook.add(block([0.0, 0.0, 2.0], [side, side, 3.0]));
        let scene = assembly(&[
            ("plate", block([-50.0, -50.0, -1.0], [50.0, 50.0, 0.0])),
            ("pin", block([0.0, 0.0, 0.0], [side, side, 1.0])),
            ("hook", hook),
        ]);
        let ways = explode(&scene, &explosion_along(DVec3::Z, 1.0));
        assert!(ways.offsets[2].z > ways.offsets[1].z && ways.offsets[1].z > 0.0, "{side}: {ways:?}");
    }
}

#[test]
fn part_settings_override_the_explosion() {
    let scene = assembly(&stack(|p| p));
    let ways = |told: Vec<PartExplosion>| {
        explode(&scene, &Explosion { axis: Some(DVec3::Z), parts: told, ..Explosion::default() }).offsets
    };
    let found = ways(Vec::new());
    let told = |name: &str| PartExplosion::new(name);
    let group = Some("plates".to_owned());
    let ways_of_group = ways(vec![
        PartExplosion { group: group.clone(), ..told("washer") },
        PartExplosion { group, ..told("dis?") },
    ]);
    assert!(ways_of_group[1] == ways_of_group[2] && ways_of_group[1].z > 0.0, "{ways_of_group:?}");
    assert!(found[2].z > found[1].z);

    let far = ways(vec![
        PartExplosion { distance: Some(7.5), ..told("nut") },
        PartExplosion { distance: Some(0.0), ..told("stud") },
    ]);
    assert_eq!([far[3], far[4]], [DVec3::Z * 7.5, DVec3::ZERO]);
    assert_eq!(far[..3], found[..3]);

    let aside = ways(vec![PartExplosion { direction: Some(DVec3::new(-2.0, 0.0, 0.0)), ..told("*t*") }]);
    assert!(
        aside.iter().all(|way| way.cross(DVec3::X).length() == 0.0 || way.cross(DVec3::Z).length() == 0.0)
    );
    assert!(aside[4].x < 0.0 && aside[3].x < 0.0 && aside[2].x == 0.0, "{aside:?}");
    let exactly = PartExplosion { direction: Some(DVec3::NEG_X), distance: Some(4.0), ..told("base") };
    assert_eq!(ways(vec![exactly])[0], DVec3::X * -4.0);

    // `order` moves the stud below the base.
    let order = |name: &str, order: f64| PartExplosion { order: Some(order), ..told(name) };
    let turned = ways(vec![order("stud", 1.0), order("base", 2.0)]);
    assert!(turned[4].z + 6.0 < turned[0].z, "{turned:?}");
    // The last matching entry wins.
    let last = ways(vec![
        PartExplosion { distance: Some(1.0), ..told("*") },
        PartExplosion { distance: Some(2.0), ..told("nut") },
    ]);
    assert_eq!((last[3].length(), last[4].length()), (2.0, 1.0));
}

#[test]
fn most_parts_of_a_drive_move_when_exploded() {
    let Some(path) = shared_folder::find("cad/drive.glb") else { return };
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
