//! An angle bracket: a bent plate with a rib, a bearing boss on the wall, and pads on the base.

use std::f64::consts::PI;

use glam::{DAffine3, DMat3, DVec2, DVec3};

use crate::geometry::outline::{arc, at, circle};
use crate::geometry::solid::Solid;

// All lengths in mm. x runs across, y outward along the base, z up the wall.
const WIDTH: f64 = 64.0;
const LENGTH: f64 = 72.0;
const HEIGHT: f64 = 88.0;
const THICKNESS: f64 = 8.0;
const INNER_BEND: f64 = 7.0;
const OUTER_BEND: f64 = 10.0;
const BASE_CORNER: f64 = 12.0;
const WALL_CORNER: f64 = 26.0;
const RIB: [f64; 2] = [28.0, 36.0];
const RIB_REACH: f64 = 21.0;
/// Number of segments of a quarter circle.
const QUARTER: usize = 18;

/// Start of the flat parts of base and wall on the inside of the bend.
const INSIDE: f64 = THICKNESS + INNER_BEND;

/// The bracket.
pub fn bracket() -> Solid {
    let mut solid = Solid::default();
    let (base_tops, base_bottoms) = base_bosses(&mut solid);
    let (wall_fronts, wall_backs) = wall_boss(&mut solid);
    base(&mut solid, &base_tops, &base_bottoms);
    wall(&mut solid, &wall_fronts, &wall_backs);
    bend(&mut solid);
    rib(&mut solid);
    solid.welded(1e-6)
}

/// Outline of a plate from (0, `foot`) across and up to `far`, with round far corners.
fn plate(foot: &[DVec2], far: f64, corner: f64) -> Vec<DVec2> {
    let mut outline = foot.to_vec();
    outline.extend(end(far, corner));
    outline
}

/// Round far end of a plate, from its right to its left side.
fn end(far: f64, corner: f64) -> Vec<DVec2> {
    let mut outline = arc(at(WIDTH - corner, far - corner), corner, 0.0, PI / 2.0, QUARTER);
    outline.extend(arc(at(corner, far - corner), corner, PI / 2.0, PI, QUARTER));
    outline
}

/// Inner foot of a plate, which runs around the foot of the rib.
fn notched_foot() -> Vec<DVec2> {
    let [low, high] = RIB;
    let reach = INSIDE + RIB_REACH;
    vec![
        at(0.0, INSIDE),
        at(low, INSIDE),
        at(low, reach),
        at(high, reach),
        at(high, INSIDE),
        at(WIDTH, INSIDE),
    ]
}

fn base(solid: &mut Solid, tops: &[Vec<u32>], bottoms: &[Vec<u32>]) {
    let lift = |z: f64| move |point: DVec2| -> DVec3 { point.extend(z) };
    let top = solid.ring(plate(&notched_foot(), LENGTH, BASE_CORNER).into_iter().map(lift(THICKNESS)));
    let foot = [at(0.0, OUTER_BEND), at(WIDTH, OUTER_BEND)];
    let bottom = solid.ring(plate(&foot, LENGTH, BASE_CORNER).into_iter().rev().map(lift(0.0)));
    solid.plate(&top, &slices(tops));
    solid.plate(&bottom, &slices(bottoms));
    let low = solid.ring(end(LENGTH, BASE_CORNER).into_iter().map(lift(0.0)));
    let high = solid.ring(end(LENGTH, BASE_CORNER).into_iter().map(lift(THICKNESS)));
    solid.strip(&low, &high);
}

fn wall(solid: &mut Solid, fronts: &[Vec<u32>], backs: &[Vec<u32>]) {
    let stand = |y: f64| move |point: DVec2| DVec3::new(point.x, y, point.y);
    let front =
        solid.ring(plate(&notched_foot(), HEIGHT, WALL_CORNER).into_iter().rev().map(stand(THICKNESS)));
    let foot = [at(0.0, OUTER_BEND), at(WIDTH, OUTER_BEND)];
    let back = solid.ring(plate(&foot, HEIGHT, WALL_CORNER).into_iter().map(stand(0.0)));
    solid.plate(&front, &slices(fronts));
    solid.plate(&back, &slices(backs));
    let near = solid.ring(end(HEIGHT, WALL_CORNER).into_iter().map(stand(THICKNESS)));
    let far = solid.ring(end(HEIGHT, WALL_CORNER).into_iter().map(stand(0.0)));
    solid.strip(&near, &far);
}

fn slices(rings: &[Vec<u32>]) -> Vec<&[u32]> {
    rings.iter().map(Vec::as_slice).collect()
}

/// Inner fillet from the flat of the base to the flat of the wall, as (y, z).
fn inner_arc() -> Vec<DVec2> {
    arc(at(INSIDE, INSIDE), INNER_BEND, 1.5 * PI, PI, QUARTER)
}

/// Outer fillet of the bend from the wall to the base, as (y, z).
fn outer_arc() -> Vec<DVec2> {
    arc(at(OUTER_BEND, OUTER_BEND), OUTER_BEND, PI, 1.5 * PI, QUARTER)
}

/// The two L-shaped sides and the fillets between them.
fn bend(solid: &mut Solid) {
    let row = |x: f64| move |point: DVec2| DVec3::new(x, point.x, point.y);
    let mut profile = outer_arc();
    profile.extend([at(LENGTH - BASE_CORNER, 0.0), at(LENGTH - BASE_CORNER, THICKNESS)]);
    profile.extend(inner_arc());
    profile.extend([at(THICKNESS, HEIGHT - WALL_CORNER), at(0.0, HEIGHT - WALL_CORNER)]);
    let right = solid.ring(profile.iter().copied().map(row(WIDTH)));
    let left = solid.ring(profile.iter().rev().copied().map(row(0.0)));
    solid.plate(&right, &[]);
    solid.plate(&left, &[]);
    for (points, from, to) in
        [(outer_arc(), 0.0, WIDTH), (inner_arc(), 0.0, RIB[0]), (inner_arc(), RIB[1], WIDTH)]
    {
        let near = solid.ring(points.iter().copied().map(row(from)));
        let far = solid.ring(points.iter().copied().map(row(to)));
        solid.strip(&near, &far);
    }
}

/// Stiffening rib in the bend: two flat sides and a slope.
fn rib(solid: &mut Solid) {
    let reach = INSIDE + RIB_REACH;
    let row = |x: f64| move |point: DVec2| DVec3::new(x, point.x, point.y);
    let slope = [at(reach, THICKNESS), at(THICKNESS, reach)];
    let mut side: Vec<DVec2> = inner_arc().into_iter().rev().collect();
    side.extend(slope);
    let right = solid.ring(side.iter().copied().map(row(RIB[1])));
    let left = solid.ring(side.iter().rev().copied().map(row(RIB[0])));
    solid.plate(&right, &[]);
    solid.plate(&left, &[]);
    let near = solid.ring(slope.into_iter().map(row(RIB[0])));
    let far = solid.ring(slope.into_iter().map(row(RIB[1])));
    solid.strip(&near, &far);
}

/// Walls turned about the z axis of `frame` along a profile of (radius, height). Returns the first and the
/// last ring.
fn turned(solid: &mut Solid, frame: DAffine3, profile: &[DVec2], count: usize) -> (Vec<u32>, Vec<u32>) {
    let rings: Vec<Vec<u32>> = profile
        .iter()
        .map(|place| {
            solid.ring(
                circle(DVec2::ZERO, place.x, count)
                    .into_iter()
                    .map(|p| frame.transform_point3(p.extend(place.y))),
            )
        })
        .collect();
    for pair in rings.windows(2) {
        solid.band(&pair[0], &pair[1]);
    }
    (rings[0].clone(), rings[rings.len() - 1].clone())
}

/// Fillet around the foot of a boss, from the plate up.
fn foot_fillet(radius: f64, fillet: f64) -> Vec<DVec2> {
    arc(at(radius + fillet, fillet), fillet, 1.5 * PI, PI, 4)
}

/// Two round pads with counterbored holes on the base. Returns their rings in its top and bottom.
fn base_bosses(solid: &mut Solid) -> (Vec<Vec<u32>>, Vec<Vec<u32>>) {
    [14.0, WIDTH - 14.0]
        .into_iter()
        .map(|x| {
            let frame = DAffine3::from_translation(DVec3::new(x, 54.0, THICKNESS));
            let mut profile = foot_fillet(9.0, 1.2);
            profile.extend([at(9.0, 2.4), at(8.4, 3.0), at(6.4, 3.0), at(6.0, 2.6), at(6.0, -2.0)]);
            profile.extend([at(3.6, -2.0), at(3.6, -THICKNESS)]);
            turned(solid, frame, &profile, 60)
        })
        .unzip()
}

/// Bearing boss on the wall with its bore and four holes around it.
fn wall_boss(solid: &mut Solid) -> (Vec<Vec<u32>>, Vec<Vec<u32>>) {
    let centre = DVec3::new(WIDTH / 2.0, THICKNESS, 61.0);
    // +y points out of the wall. x stays across, and -z is second, so the frame is right-handed.
    let axes = DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y);
    let mut profile = foot_fillet(15.0, 2.0);
    profile.extend([at(15.0, 12.8), at(13.8, 14.0), at(11.2, 14.0), at(10.0, 12.8)]);
    profile.extend([at(10.0, 2.0), at(8.0, 2.0), at(8.0, -THICKNESS + 1.0), at(9.0, -THICKNESS)]);
    let mut rings = vec![turned(solid, DAffine3 { matrix3: axes, translation: centre }, &profile, 60)];
    for (x, z) in [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)] {
        let translation = centre + DVec3::new(16.0 * x, 0.0, 16.0 * z);
        let frame = DAffine3 { matrix3: axes, translation };
        rings.push(turned(solid, frame, &[at(3.2, 0.0), at(2.6, -0.6), at(2.6, -THICKNESS)], 72));
    }
    rings.into_iter().unzip()
}
