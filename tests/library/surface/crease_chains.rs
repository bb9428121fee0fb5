//! Chains of creases whose angle varies: they continue below the threshold, and on machined parts to the next
//! line.

use super::creases::{CREASE_DEG, ends, find, mesh};
use crate::library::support::scenes::solids::Solid;
use glam::DVec3;
use ligne::geometry::numbers::portable_math::tan;
use ligne::mesh::Mesh;
use ligne::surface::{HardEdges, Patches};

/// A roof of `n` bays with its ridge on the x axis. At post `i`, the surface turns by `turn_deg(i)` degrees.
fn roof(n: u32, turn_deg: impl Fn(u32) -> f64) -> Solid {
    let mut solid = Solid::default();
    for i in 0..=n {
        let drop = tan((turn_deg(i) / 2.0).to_radians());
        let x = f64::from(i);
        solid.positions.extend([
            DVec3::new(x, 0.0, 0.0),
            DVec3::new(x, 2.0, -2.0 * drop),
            DVec3::new(x, -2.0, -2.0 * drop),
        ]);
    }
    for i in 0..n {
        let (a, b) = (3 * i, 3 * i + 3);
        solid.triangles.extend([[a, b, b + 1], [a, b + 1, a + 1], [a, b + 2, b], [a, a + 2, b + 2]]);
    }
    solid
}

/// Returns the bays of a roof with a hard ridge, sorted. Panics if any other edge is hard.
fn hard_bays(mesh: &Mesh) -> Vec<usize> {
    let ridge = |p: &DVec3| p.y.abs() < 1e-9 && p.z.abs() < 1e-9;
    let mut bays = Vec::new();
    for pair in ends(mesh, &find(mesh)) {
        assert!(pair.iter().all(ridge), "{pair:?}");
        bays.push(pair[0].x.min(pair[1].x).round() as usize);
    }
    bays.sort_unstable();
    bays
}

#[test]
fn a_crease_that_dips_below_the_threshold_is_one_chain() {
    // Turns of `high` degrees that fall to `low` in the middle.
    let dip = |low: f64, high: f64| {
        mesh(roof(40, move |i| low + (high - low) * (f64::from(i.abs_diff(20)) / 10.0).min(1.0)))
    };
    let dips = dip(25.0, 60.0);
    assert!(HardEdges::above(&dips, CREASE_DEG).count() < 35);
    assert_eq!(hard_bays(&dips), (0..40).collect::<Vec<_>>());
    // Below the low threshold, the crease ends.
    let bays = hard_bays(&dip(5.0, 60.0));
    assert!(bays.len() > 28 && bays.len() < 37, "{bays:?}");
    // Without any sharp edge, there is no crease.
    assert!(hard_bays(&mesh(roof(30, |_| 35.0))).is_empty());
}

#[test]
fn a_fading_crease_is_one_chain() {
    let fades = mesh(roof(40, |i| 120.0 - 3.0 * f64::from(i)));
    let bays = hard_bays(&fades);
    assert_eq!(bays, (0..bays.len()).collect::<Vec<_>>(), "in one piece from its sharp end on");
    let sharp = HardEdges::above(&fades, CREASE_DEG).count();
    assert!(bays.len() >= sharp + 5 && bays.len() <= 35, "{} of 40 bays, {sharp} sharp", bays.len());
}

/// A house under such a roof, with flat walls and gables as in a CAD model.
fn house(n: u32, turn_deg: impl Fn(u32) -> f64) -> Mesh {
    let mut solid = roof(n, turn_deg);
    let eaves = |i: u32| [3 * i + 1, 3 * i + 2];
    let first = solid.positions.len() as u32;
    let ground = |i: u32| [first + 2 * i, first + 2 * i + 1];
    for i in 0..=n {
        solid.positions.extend([2.0, -2.0].map(|y| DVec3::new(f64::from(i), y, -9.0)));
    }
    for i in 0..n {
        let ([a, b], [c, d]) = (eaves(i), eaves(i + 1));
        let ([p, q], [r, s]) = (ground(i), ground(i + 1));
        solid.triangles.extend([[a, c, r], [a, r, p], [b, s, d], [b, q, s]]);
    }
    for (i, turned) in [(0, true), (n, false)] {
        let ([a, b], [p, q], ridge) = (eaves(i), ground(i), 3 * i);
        for [k, l, m] in [[ridge, b, a], [a, b, q], [a, q, p]] {
            solid.triangles.push(if turned { [k, m, l] } else { [k, l, m] });
        }
    }
    mesh(solid)
}

/// Returns the bays with a drawn ridge, and the bays with a ridge above the crease angle.
fn drawn_and_sharp(mesh: &Mesh) -> [Vec<usize>; 2] {
    let patches = Patches::new(mesh, CREASE_DEG, false);
    assert!(patches.figure.iter().all(|figure| !figure), "a house is no figure");
    [&patches.hard, &HardEdges::above(mesh, CREASE_DEG)].map(|hard| {
        let on_ridge = |p: &DVec3| p.y.abs() < 1e-9 && p.z.abs() < 1e-9;
        let ridge = ends(mesh, hard).into_iter().filter(|pair| pair.iter().all(on_ridge));
        let mut bays: Vec<usize> = ridge.map(|pair| pair[0].x.min(pair[1].x).round() as usize).collect();
        bays.sort_unstable();
        bays
    })
}

#[test]
fn creases_of_machined_parts_extend_to_the_next_line() {
    let all: Vec<usize> = (0..24).collect();
    // The crease extends to the gable, and from dash to dash.
    let fading = house(24, |i| 60.0 - f64::from(i) * 1.1);
    let dashed = house(24, |i| if i % 4 < 2 { 48.0 } else { 34.0 });
    for mesh in [fading, dashed] {
        let [drawn, sharp] = drawn_and_sharp(&mesh);
        assert!(sharp.len() < 20 && !sharp.is_empty(), "{sharp:?}");
        assert_eq!(drawn, all);
    }
    // If it fades before it reaches another line, it is not extended.
    let [drawn, sharp] = drawn_and_sharp(&house(24, |i| 60.0 - f64::from(i) * 1.6));
    assert!(sharp.len() > 8 && sharp.len() < 16, "{sharp:?}");
    assert_eq!(drawn, sharp);
    let [drawn, _] = drawn_and_sharp(&house(24, |_| 14.0));
    assert!(drawn.is_empty());
}
