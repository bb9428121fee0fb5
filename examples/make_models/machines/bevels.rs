//! Blocks with smooth normals over bevelled edges.
//!
//! - A block rounded in three narrow strips, with exact normals.
//! - A block with a single chamfer, whose normals are the plain mean of the faces, as modelling programs
//!   write them.
//! - An angle with a fillet.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec2, DVec3};
use libm::{cos, sin};

use crate::geometry::outline::{arc, at};
use crate::geometry::part::{Material, Part};
use crate::geometry::solid::Solid;

const IVORY: Material = Material { name: "ivory", colour: [0.9, 0.86, 0.75], metallic: 0.0, roughness: 0.5 };
const SLATE: Material = Material { name: "slate", colour: [0.35, 0.4, 0.45], metallic: 0.0, roughness: 0.7 };
const RED: Material = Material { name: "red", colour: [0.7, 0.2, 0.15], metallic: 0.0, roughness: 0.5 };

/// Box around the origin whose edges are rounded in `strips` strips. It is a sphere of parallels and
/// meridians with its octants moved apart.
fn rounded_box(half: DVec3, radius: f64, strips: usize) -> Solid {
    let inner = half - DVec3::splat(radius);
    let mut solid = Solid::default();
    let mut rings = Vec::new();
    for (side, i) in [-1.0, 1.0].into_iter().flat_map(|side| (0..=strips).map(move |i| (side, i))) {
        let from_rim = if side < 0.0 { strips - i } else { i };
        let tilt = FRAC_PI_2 * from_rim as f64 / strips as f64;
        // The flat faces above and below have one point per corner.
        let (out, up) = if from_rim == strips { (0.0, 1.0) } else { (cos(tilt), sin(tilt)) };
        let mut ring = Vec::new();
        for corner in 0..4 {
            let (x, y) = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)][corner];
            for k in 0..=strips {
                let turn = FRAC_PI_2 * (corner as f64 + k as f64 / strips as f64);
                let round = DVec3::new(out * cos(turn), out * sin(turn), side * up);
                ring.push(inner * DVec3::new(x, y, side) + radius * round);
            }
        }
        rings.push(solid.ring(ring));
    }
    for pair in rings.windows(2) {
        solid.band(&pair[0], &pair[1]);
    }
    solid.faces.push(rings[0].iter().rev().copied().collect());
    solid.faces.push(rings[rings.len() - 1].clone());
    without_empty_sides(solid.welded(1e-6))
}

/// Removes repeated corners of faces, and faces with fewer than three corners left.
fn without_empty_sides(mut solid: Solid) -> Solid {
    for face in &mut solid.faces {
        face.dedup();
        if face.first() == face.last() {
            face.pop();
        }
    }
    solid.faces.retain(|face| face.len() > 2);
    solid
}

/// Exact normals of the rounded box.
fn exact_normals(solid: &Solid, half: DVec3, radius: f64) -> Vec<DVec3> {
    let inner = half - DVec3::splat(radius);
    solid.points.iter().map(|point| (*point - point.clamp(-inner, inner)).normalize()).collect()
}

/// Unweighted mean of the face normals around each point. Narrow chamfers and wide faces have equal weight.
pub fn mean_normals(solid: &Solid) -> Vec<DVec3> {
    let mut sums = vec![DVec3::ZERO; solid.points.len()];
    for face in &solid.faces {
        let [a, b, c] = [0, 1, 2].map(|k| solid.points[face[k] as usize]);
        let normal = (b - a).cross(c - a).normalize();
        face.iter().for_each(|corner| sums[*corner as usize] += normal);
    }
    sums.into_iter().map(|sum| sum.normalize_or(DVec3::Z)).collect()
}

/// Angle along y with an inner fillet of four strips. Sides and ends have separate points and normals.
fn angle() -> (Solid, Vec<DVec3>) {
    let mut rim = vec![at(0.0, 0.0), at(42.0, 0.0), at(42.0, 8.0)];
    rim.extend(arc(at(20.0, 20.0), 12.0, 3.0 * FRAC_PI_2, 2.0 * FRAC_PI_2, 4));
    rim.extend([at(8.0, 46.0), at(0.0, 46.0)]);
    let place = |point: &DVec2, y: f64| DVec3::new(point.x, y, point.y);
    let mut solid = Solid::default();
    let mut normals = Vec::new();
    let count = rim.len();
    let way = |i: usize| (rim[(i + 1) % count] - rim[i % count]).normalize();
    for i in 0..count {
        // Sharp corners split the normals, and the fillet does not.
        let outward = |way: DVec2| DVec3::new(way.y, 0.0, -way.x);
        let smooth = |i: usize| way((i + count - 1) % count).dot(way(i)) > 0.8;
        let own = outward(way(i));
        let mut side = Vec::new();
        for corner in [i, (i + 1) % count] {
            let both = (outward(way((corner + count - 1) % count)) + outward(way(corner))).normalize();
            side.push(if smooth(corner) { both } else { own });
        }
        let low: Vec<u32> = solid.ring([i, (i + 1) % count].map(|k| place(&rim[k], 40.0)));
        let high: Vec<u32> = solid.ring([i, (i + 1) % count].map(|k| place(&rim[k], 0.0)));
        normals.extend([side[0], side[1], side[0], side[1]]);
        solid.strip(&low, &high);
    }
    for (y, normal) in [(0.0, DVec3::NEG_Y), (40.0, DVec3::Y)] {
        let mut end = solid.ring(rim.iter().map(|point| place(point, y)));
        normals.extend(end.iter().map(|_| normal));
        if y > 0.0 {
            end.reverse();
        }
        solid.plate(&end, &[]);
    }
    (solid, normals)
}

/// The parts, in mm, and their normals, one list per part.
pub fn parts() -> (Vec<Part>, Vec<Vec<DVec3>>) {
    let half = DVec3::new(40.0, 26.0, 18.0);
    let mut rounded = rounded_box(half, 5.0, 3);
    let exact = exact_normals(&rounded, half, 5.0);
    let half = DVec3::new(22.0, 16.0, 24.0);
    let chamfered = rounded_box(half, 2.5, 1);
    let mean = mean_normals(&chamfered);
    let (angle, split) = angle();
    rounded = rounded.shifted(0.0, 0.0, 18.0);
    let parts = vec![
        Part::new("rounded-block", IVORY, rounded),
        Part::new("chamfered-block", SLATE, chamfered.shifted(-10.0, 4.0, 58.0)),
        Part::new("angle", RED, angle.shifted(46.0, -20.0, 0.0)),
    ];
    (parts, vec![exact, mean, split])
}
