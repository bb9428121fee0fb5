//! Slivers between two different subdivisions of one circle on machined parts make no creases; solids with
//! known edges are the reference.

use std::f64::consts::TAU;

use glam::DVec3;
use ligne::geometry::numbers::portable_math::{cos, sin};
use ligne::lines::{LineKind, LineOptions};
use ligne::mesh::{DihedralCosines, Mesh, Soup};
use ligne::surface::Patches;
use ligne::surface::evidence::evidence_layout::patches_by_evidence;

use crate::library::support::pipeline::{orthographic, run_stages, scene};
use crate::library::support::scenes::solids::Solid;

const SHAFT_SIDES: usize = 24;

/// A shaft of 24 sides with a tapered end: `narrowing` over a fifth of its radius. At sides where `halved`
/// returns true, only the shaft is divided, which leaves a sliver between chord and extra corner.
fn shaft(narrowing: f64, halved: impl Fn(usize) -> bool) -> Solid {
    let mut solid = Solid::default();
    let mut put = |turn: f64, radius: f64, height: f64| {
        let turn = TAU * turn / SHAFT_SIDES as f64;
        solid.positions.push(DVec3::new(radius * cos(turn), radius * sin(turn), height));
        solid.positions.len() as u32 - 1
    };
    let (bottom, top) = (put(0.0, 0.0, 0.0), put(0.0, 0.0, 2.2));
    let rings = [(1.0, 0.0), (1.0, 2.0), (1.0 - narrowing, 2.2)].map(|(radius, height)| {
        (0..SHAFT_SIDES).map(|k| put(k as f64, radius, height)).collect::<Vec<u32>>()
    });
    let halves: Vec<Option<[u32; 2]>> = (0..SHAFT_SIDES)
        .map(|k| halved(k).then(|| [0.0, 1.992].map(|height| put(k as f64 + 0.5, 1.0, height))))
        .collect();
    for (k, half) in halves.into_iter().enumerate() {
        let [[a, b], [c, d], [e, f]] =
            [0, 1, 2].map(|ring| [rings[ring][k], rings[ring][(k + 1) % SHAFT_SIDES]]);
        solid.triangles.extend([[c, d, e], [d, f, e], [e, f, top]]);
        let columns = match half {
            None => vec![[a, b, c, d]],
            Some([low, high]) => {
                solid.triangles.push([c, high, d]);
                vec![[a, low, c, high], [low, b, high, d]]
            }
        };
        for [a, b, c, d] in columns {
            solid.triangles.extend([[a, b, c], [b, d, c], [b, a, bottom]]);
        }
    }
    solid
}

fn mesh(solid: Solid) -> Mesh {
    Mesh::build(Soup { positions: solid.positions, triangles: solid.triangles, ..Soup::default() })
}

/// Returns the number of crease edges where the tapered end begins, by statistics and by evidence.
fn count_creases_at_the_taper(solid: Solid) -> usize {
    let mut mesh = mesh(solid);
    let of_both = [Patches::new(&mesh, 40.0, false), patches_by_evidence(&mut mesh, 40.0, false)];
    let is_there = |edge: &usize| {
        let ends = mesh.edges.vertices[*edge].map(|v| (mesh.positions[v as usize] + mesh.origin).z);
        ends.iter().all(|z| (1.9..2.1).contains(z))
    };
    let [by_statistics, by_evidence] = of_both.map(|patches| {
        (0..mesh.edges.len()).filter(|edge| patches.hard.is_hard(*edge)).filter(is_there).count()
    });
    assert_eq!(by_statistics, by_evidence);
    by_evidence
}

#[test]
fn slivers_between_two_circle_subdivisions_are_no_creases() {
    // The end tapers by 20 degrees.
    let wrinkled = mesh(shaft(0.073, |side| side % 4 == 0));
    let turns = DihedralCosines::of(&wrinkled);
    let sharp = (0..wrinkled.edges.len()).filter(|edge| turns.of_two(*edge) < 0.76).count();
    assert_eq!(sharp, 12 + 30 + SHAFT_SIDES, "two sides of each of six slivers, and both rims");
    assert_eq!(count_creases_at_the_taper(shaft(0.073, |side| side % 4 == 0)), 0);
    // Without slivers, the end meets the shaft at a crease.
    assert_eq!(count_creases_at_the_taper(shaft(0.073, |_| false)), SHAFT_SIDES);
}

#[test]
fn creases_next_to_slivers_stay() {
    // By 60 degrees: 18 sides, and both halves of 6.
    assert_eq!(count_creases_at_the_taper(shaft(0.346, |side| side % 4 == 0)), 30);
    assert_eq!(count_creases_at_the_taper(shaft(0.073, |_| true)), 2 * SHAFT_SIDES);
}

/// A mound on a plate, shaped like a roof with round ends and steep on both sides. Its ridge is a sliver.
fn mound() -> Solid {
    const ROUND: usize = 12;
    let tips = [DVec3::new(-3.0, 0.0, 2.0), DVec3::new(3.0, 0.0, 2.0)];
    let mut solid = Solid::default();
    solid.positions.extend(tips);
    solid.positions.extend([DVec3::new(0.0, -0.05, 2.0), DVec3::new(0.0, 0.05, 2.0)]);
    // The foot around both ends, and the rim of the plate.
    let foot: Vec<DVec3> = (0..2 * (ROUND + 1))
        .map(|k| {
            let (end, step) = (k / (ROUND + 1), k % (ROUND + 1));
            let turn = (0.25 + 0.5 * end as f64 + 0.5 * step as f64 / ROUND as f64) * TAU;
            tips[end] + DVec3::new(0.84 * cos(turn), 0.84 * sin(turn), -1.0)
        })
        .collect();
    solid.positions.extend(&foot);
    solid.positions.extend(foot.iter().map(|p| DVec3::new(3.0 * p.x, 8.0 * p.y, p.z)));
    let count = foot.len() as u32;
    let (at, rim) = (|k: u32| 4 + k % count, |k: u32| 4 + count + k % count);
    let round = ROUND as u32;
    for k in 0..count {
        solid.triangles.extend([[at(k), rim(k), rim(k + 1)], [at(k), rim(k + 1), at(k + 1)]]);
        if k % (round + 1) < round {
            solid.triangles.push([k / (round + 1), at(k), at(k + 1)]);
        }
    }
    // Both sides from the foot to the ridge, and the ridge.
    for [from, near, to, far] in [[round, 0, 1, 2], [2 * round + 1, 1, 0, 3]] {
        solid.triangles.extend([
            [near, at(from), far],
            [at(from), at(from + 1), far],
            [at(from + 1), to, far],
        ]);
    }
    solid.triangles.extend([[0, 2, 1], [0, 1, 3]]);
    solid
}

#[test]
fn thin_ridges_are_creases() {
    // Around it, the surface turns by a hundred degrees.
    assert_eq!(count_creases_at_the_taper(mound()), 4);
}

#[test]
fn contours_along_slivers_keep_their_corners() {
    // From above and from one side. The slivers on the far side have their lower edges on the outline.
    let eye = DVec3::new(10.0 * cos(1.3), 0.0, 10.0 * sin(1.3));
    let wrinkled = scene([shaft(0.073, |side| side % 4 == 0)]);
    let drawn = run_stages(&wrinkled, &orthographic(eye, DVec3::Z, 4.0), &LineOptions::default());
    let height = |v: u32| (drawn.mesh.positions[v as usize] + drawn.mesh.origin).z;
    let contours = || {
        let of_kind = drawn.lines.segments.iter().filter(|s| s.kind == LineKind::Contour);
        of_kind.filter(|s| s.ends.iter().all(|v| height(*v) > 1.9))
    };
    assert_eq!(contours().filter(|s| s.strength > 40.0 && !s.smooth).count(), 6);
    assert!(contours().all(|s| s.smooth == (s.strength < 40.0)), "corners where it bends by more");
}
