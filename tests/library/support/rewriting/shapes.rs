//! Bodies with short coordinates: boxes, prisms, plates, stairs, houses, sheets and rounded bodies.

use glam::{DMat3, DVec3};
use libm::{cos, sin};

use super::body::{Body, Face};
use crate::library::support::scenes::random_dice::Dice;

fn uncoloured_face(corners: impl IntoIterator<Item = u32>) -> Face {
    Face { corners: corners.into_iter().collect(), colour: 0 }
}

/// A prism over a counter-clockwise polygon of the xy plane, from z = 0 to `height`.
pub(crate) fn extrude(outline: &[(f64, f64)], height: f64, core: [DVec3; 2]) -> Body {
    let count = outline.len() as u32;
    let ring = |z: f64| outline.iter().map(move |&(x, y)| DVec3::new(x, y, z));
    let mut faces = vec![uncoloured_face((0..count).rev()), uncoloured_face(count..2 * count)];
    faces.extend((0..count).map(|k| {
        let next = (k + 1) % count;
        uncoloured_face([k, next, next + count, k + count])
    }));
    let points = ring(0.0).chain(ring(height)).collect();
    Body { points, faces, is_closed: true, core: Some(core), ..Body::default() }
}

/// An axis-aligned box with one corner at the origin.
pub(crate) fn cuboid(size: DVec3) -> Body {
    let outline = [(0.0, 0.0), (size.x, 0.0), (size.x, size.y), (0.0, size.y)];
    extrude(&outline, size.z, [size * 0.25, size * 0.75])
}

/// A random multiple of 0.5, from `least` to `most` halves.
fn random_half_units(dice: &mut Dice, least: usize, most: usize) -> f64 {
    0.5 * (least + dice.below(most - least + 1)) as f64
}

pub(crate) fn random_cuboid(dice: &mut Dice) -> Body {
    cuboid(DVec3::new(
        random_half_units(dice, 1, 8),
        random_half_units(dice, 1, 8),
        random_half_units(dice, 1, 8),
    ))
}

/// The core of a prism: the middle half of the box over the rectangle from `low` to `high`.
fn inner_box(low: (f64, f64), high: (f64, f64), height: f64) -> [DVec3; 2] {
    let (a, b) = (DVec3::new(low.0, low.1, 0.0), DVec3::new(high.0, high.1, height));
    [a + (b - a) * 0.25, a + (b - a) * 0.75]
}

/// A prism over a triangle, a trapezium or a hexagon.
pub(crate) fn random_prism(dice: &mut Dice) -> Body {
    let (a, h) = (random_half_units(dice, 2, 4), random_half_units(dice, 1, 8));
    match dice.below(3) {
        0 => extrude(
            &[(0.0, 0.0), (4.0 * a, 0.0), (a, 3.0 * a)].map(|(x, y)| (x / 2.0, y / 2.0)),
            h,
            inner_box((0.4 * a, 0.1 * a), (0.8 * a, 0.5 * a), h),
        ),
        1 => {
            let outline = [(0.0, 0.0), (3.0 * a, 0.0), (2.0 * a, a), (a, a)];
            extrude(&outline, h, inner_box((a, 0.0), (2.0 * a, a), h))
        }
        _ => {
            let outline = [(1.0, 0.0), (2.0, 0.0), (3.0, 1.5), (2.0, 3.0), (1.0, 3.0), (0.0, 1.5)];
            extrude(
                &outline.map(|(x, y)| (x * a / 2.0, y * a / 2.0)),
                h,
                inner_box((a / 2.0, 0.0), (a, a), h),
            )
        }
    }
}

/// A plate in the shape of a T, a plus, an L or a U.
pub(crate) fn random_plate(dice: &mut Dice) -> Body {
    let (a, b, c, h) = (
        random_half_units(dice, 1, 3),
        random_half_units(dice, 1, 3),
        random_half_units(dice, 1, 3),
        random_half_units(dice, 1, 3),
    );
    match dice.below(4) {
        0 => {
            let (x1, x2, x3) = (a, a + b, a + b + c);
            let outline =
                [(x1, 0.0), (x2, 0.0), (x2, b), (x3, b), (x3, b + c), (0.0, b + c), (0.0, b), (x1, b)];
            extrude(&outline, h, inner_box((x1, 0.0), (x2, b + c), h))
        }
        1 => {
            let (x1, x2, x3, y1, y2, y3) = (a, a + b, a + b + c, b, b + c, 2.0 * b + c);
            let outline = [
                (x1, 0.0),
                (x2, 0.0),
                (x2, y1),
                (x3, y1),
                (x3, y2),
                (x2, y2),
                (x2, y3),
                (x1, y3),
                (x1, y2),
                (0.0, y2),
                (0.0, y1),
                (x1, y1),
            ];
            extrude(&outline, h, inner_box((x1, 0.0), (x2, y3), h))
        }
        2 => {
            let outline = [(0.0, 0.0), (a + b, 0.0), (a + b, c), (a, c), (a, b + c), (0.0, b + c)];
            extrude(&outline, h, inner_box((0.0, 0.0), (a, b + c), h))
        }
        _ => {
            let (x1, x2, x3, y) = (a, a + b, a + b + c, b + c);
            let outline = [(0.0, 0.0), (x3, 0.0), (x3, y), (x2, y), (x2, c), (x1, c), (x1, y), (0.0, y)];
            extrude(&outline, h, inner_box((0.0, 0.0), (x3, c), h))
        }
    }
}

pub(crate) fn random_stairs(dice: &mut Dice) -> Body {
    let (steps, run, rise, h) = (
        2 + dice.below(3),
        random_half_units(dice, 1, 2),
        random_half_units(dice, 1, 2),
        random_half_units(dice, 2, 6),
    );
    let wide = run * steps as f64;
    let mut outline = vec![(0.0, 0.0), (wide, 0.0)];
    for step in (0..steps).rev() {
        let (x, y) = (run * step as f64, rise * (steps - step) as f64);
        outline.extend([(x + run, y), (x, y)]);
    }
    extrude(&outline, h, inner_box((0.0, 0.0), (wide, rise), h))
}

/// A house: an extruded gable with its ridge along z.
pub(crate) fn random_house(dice: &mut Dice) -> Body {
    let (half, wall, roof, h) = (
        random_half_units(dice, 2, 4),
        random_half_units(dice, 2, 5),
        random_half_units(dice, 1, 4),
        random_half_units(dice, 3, 8),
    );
    let (wide, top) = (2.0 * half, wall + roof);
    let outline = [(0.0, 0.0), (wide, 0.0), (wide, wall), (half, top), (0.0, wall)];
    extrude(&outline, h, inner_box((0.0, 0.0), (wide, wall), h))
}

/// An open sheet: a rectangle, or two rectangles that meet in a fold.
pub(crate) fn random_sheet(dice: &mut Dice) -> Body {
    let (x, y, z) =
        (random_half_units(dice, 2, 8), random_half_units(dice, 2, 8), random_half_units(dice, 2, 6));
    let mut points: Vec<DVec3> =
        [(0.0, 0.0), (x, 0.0), (x, y), (0.0, y)].map(|(x, y)| DVec3::new(x, y, 0.0)).into();
    let mut faces = vec![uncoloured_face([0, 1, 2, 3])];
    if dice.below(2) == 0 {
        points.extend([DVec3::new(x, y, z), DVec3::new(0.0, y, z)]);
        faces.push(uncoloured_face([3, 2, 4, 5]));
    }
    Body { points, faces, ..Body::default() }
}

/// A solid of revolution about z. The profile lists radius and height, from the axis outwards, up and back to
/// it.
///
/// A profile that never reaches the axis closes into a ring.
pub(crate) fn lathe(profile: &[(f64, f64)], sides: u32) -> Body {
    let mut body = Body { is_closed: true, is_round: true, ..Body::default() };
    let mut rings: Vec<Vec<u32>> = Vec::new();
    for &(radius, z) in profile {
        let count = if radius == 0.0 { 1 } else { sides };
        let first = body.points.len() as u32;
        body.points.extend((0..count).map(|k| {
            let angle = std::f64::consts::TAU * f64::from(k) / f64::from(sides);
            DVec3::new(radius * cos(angle), radius * sin(angle), z)
        }));
        rings.push((first..first + count).collect());
    }
    let is_ring = rings[0].len() > 1;
    for k in 0..rings.len() - usize::from(!is_ring) {
        let (low, high) = (&rings[k], &rings[(k + 1) % rings.len()]);
        let [(low_radius, low_z), (high_radius, high_z)] = [profile[k], profile[(k + 1) % profile.len()]];
        // A flat end becomes one polygon.
        if low_z == high_z && low_radius == 0.0 {
            body.faces.push(uncoloured_face(high.iter().rev().copied()));
            continue;
        }
        if low_z == high_z && high_radius == 0.0 {
            body.faces.push(uncoloured_face(low.iter().copied()));
            continue;
        }
        for i in 0..sides as usize {
            let at = |ring: &[u32], i: usize| ring[(i % sides as usize).min(ring.len() - 1)];
            let mut corners = vec![at(low, i), at(low, i + 1), at(high, i + 1), at(high, i)];
            corners.dedup();
            if corners.first() == corners.last() {
                corners.pop();
            }
            body.faces.push(uncoloured_face(corners));
        }
    }
    // A flat end uses no point on the axis.
    body.without_unused_points()
}

/// A cylinder, a cone, a stepped shaft, a sphere, a torus or a vase.
pub(crate) fn random_round_body(dice: &mut Dice) -> Body {
    let (r, h) = (random_half_units(dice, 1, 4), random_half_units(dice, 1, 8));
    let sides = 4 * (4 + dice.below(9)) as u32;
    let inner = |radius: f64, height: f64| {
        Some([DVec3::new(-radius, -radius, 0.25 * height), DVec3::new(radius, radius, 0.75 * height)])
    };
    match dice.below(6) {
        0 => {
            let body = lathe(&[(0.0, 0.0), (r, 0.0), (r, h), (0.0, h)], sides);
            Body { core: inner(0.5 * r, h), ..body }
        }
        1 => lathe(&[(0.0, 0.0), (r, 0.0), (0.0, h)], sides),
        2 => {
            let (wide, top) = (1.5 * r, h + 1.0);
            let body = lathe(&[(0.0, 0.0), (wide, 0.0), (wide, h), (r, h), (r, top), (0.0, top)], sides);
            Body { core: inner(0.5 * r, h), ..body }
        }
        3 => {
            let rows = sides / 2;
            let ring = |k: u32| {
                let angle = std::f64::consts::PI * f64::from(k) / f64::from(rows);
                (r * sin(angle), r - r * cos(angle))
            };
            let mut profile = vec![(0.0, 0.0)];
            profile.extend((1..rows).map(ring));
            profile.push((0.0, 2.0 * r));
            Body { core: inner(0.4 * r, 2.0 * r), ..lathe(&profile, sides) }
        }
        4 => {
            let (tube, rows) = (0.25 * r, 8 + 4 * dice.below(3));
            let ring = |k: usize| {
                let angle = std::f64::consts::TAU * k as f64 / rows as f64;
                (r + tube * cos(angle), tube + tube * sin(angle))
            };
            lathe(&(0..rows).map(ring).collect::<Vec<_>>(), sides)
        }
        _ => {
            let profile: Vec<(f64, f64)> = [(0.0, 0.0), (0.6, 0.0)]
                .into_iter()
                .chain((1..=10).map(|k| {
                    let t = f64::from(k) / 10.0;
                    (0.6 + 0.4 * sin(t * std::f64::consts::PI), t)
                }))
                .chain([(0.0, 1.0)])
                .map(|(x, z)| (x * r, z * h))
                .collect();
            Body { core: inner(0.3 * r, h), ..lathe(&profile, sides) }
        }
    }
}

/// One of the 24 rotations that keep boxes axis-aligned.
pub(crate) fn random_axis_rotation(dice: &mut Dice) -> DMat3 {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let first = dice.below(3);
    let second = (first + 1 + dice.below(2)) % 3;
    let sign = |dice: &mut Dice| if dice.below(2) == 0 { 1.0 } else { -1.0 };
    let (x, y) = (axes[first] * sign(dice), axes[second] * sign(dice));
    DMat3::from_cols(x, y, x.cross(y))
}

impl Body {
    fn without_unused_points(mut self) -> Self {
        let mut numbers = vec![u32::MAX; self.points.len()];
        let mut points = Vec::new();
        for corner in self.faces.iter_mut().flat_map(|face| &mut face.corners) {
            let number = &mut numbers[*corner as usize];
            if *number == u32::MAX {
                *number = points.len() as u32;
                points.push(self.points[*corner as usize]);
            }
            *corner = *number;
        }
        self.points = points;
        self
    }
}
