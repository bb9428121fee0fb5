//! A spur gear of 24 involute teeth with a thin web, lightening holes, and a bore with a keyway.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};
use libm::{acos, cos, tan};

use crate::geometry::outline::{arc, at, circle, polar};
use crate::geometry::solid::Solid;

const TEETH: usize = 24;
/// Pitch diameter divided by the number of teeth, mm.
const MODULE: f64 = 4.0;
const PRESSURE_ANGLE: f64 = 20.0 * PI / 180.0;
const FILLET: f64 = 1.1;
const CIRCLE_STEPS: usize = 72;

const RIM_HALF: f64 = 10.0;
const WEB_HALF: f64 = 3.5;
const HUB_HALF: f64 = 14.0;
const RIM_RADIUS: f64 = 36.5;
const HUB_RADIUS: f64 = 17.0;
const BORE_RADIUS: f64 = 9.5;

/// Involute angle, radians, at a distance of `radius` from the centre.
fn involute(base: f64, radius: f64) -> f64 {
    let pressure = acos(base / radius);
    tan(pressure) - pressure
}

/// One side of a tooth from root to tip, as (radius, angle from the centre of the tooth).
fn flank() -> Vec<(f64, f64)> {
    let pitch = MODULE * TEETH as f64 / 2.0;
    let base = pitch * cos(PRESSURE_ANGLE);
    let (root, tip) = (pitch - 1.25 * MODULE, pitch + MODULE);
    let half_at_pitch = PI / (2.0 * TEETH as f64);
    let angle_at = |radius: f64| half_at_pitch + involute(base, pitch) - involute(base, radius.max(base));
    let start = root + FILLET;
    // The root fillet is a quarter ellipse from the root circle to the flank.
    let fillet = (0..18).map(|i| {
        let angle = PI / 2.0 * f64::from(i) / 18.0;
        let out = 1.0 - cos(angle);
        let aside = 1.0 - libm::sin(angle);
        (root + FILLET * out, angle_at(start) + FILLET * aside / root)
    });
    // Equal steps of the roll angle turn the flank by equal angles.
    let roll = |radius: f64| ((radius / base).powi(2) - 1.0).max(0.0).sqrt();
    let involute = (0..=8).map(|i| {
        let angle = roll(start) + (roll(tip) - roll(start)) * f64::from(i) / 8.0;
        let radius = if i == 0 { start } else { base * (1.0 + angle * angle).sqrt() };
        (radius, angle_at(radius))
    });
    fillet.chain(involute).collect()
}

/// Toothed outline, counter-clockwise.
fn teeth() -> Vec<DVec2> {
    let flank = flank();
    let mut outline = Vec::new();
    for tooth in 0..TEETH {
        let middle = TAU * tooth as f64 / TEETH as f64;
        let point =
            |&(radius, angle): &(f64, f64), side: f64| polar(DVec2::ZERO, radius, middle + side * angle);
        outline.extend(flank.iter().map(|place| point(place, -1.0)));
        if let Some(&(tip, half)) = flank.last() {
            let along = arc(DVec2::ZERO, tip, middle - half, middle + half, 2);
            outline.extend(&along[1..2]);
        }
        outline.extend(flank.iter().rev().map(|place| point(place, 1.0)));
        if let Some(&(root, half)) = flank.first() {
            let next = TAU / TEETH as f64 - half;
            let along = arc(DVec2::ZERO, root, middle + half, middle + next, 2);
            outline.extend(&along[1..2]);
        }
    }
    outline
}

/// Bore with keyway, counter-clockwise.
fn bore() -> Vec<DVec2> {
    let (half_key, key_top) = (3.0, 12.3);
    let edge = acos(half_key / BORE_RADIUS);
    let mut outline = arc(DVec2::ZERO, BORE_RADIUS, PI - edge, TAU + edge, 86);
    outline.extend([at(half_key, key_top), at(-half_key, key_top)]);
    outline
}

/// Rings about the axis along a profile of (radius, z). The bands between them face right of an upward
/// profile.
fn rings(solid: &mut Solid, profile: &[(f64, f64)]) -> (Vec<u32>, Vec<u32>) {
    let rings: Vec<Vec<u32>> = profile
        .iter()
        .map(|&(radius, z)| {
            solid.ring(circle(DVec2::ZERO, radius, CIRCLE_STEPS).into_iter().map(|p| p.extend(z)))
        })
        .collect();
    for pair in rings.windows(2) {
        solid.band(&pair[0], &pair[1]);
    }
    (rings[0].clone(), rings[rings.len() - 1].clone())
}

/// Quarter circle as (radius, z).
fn quarter(centre: (f64, f64), radius: f64, from: f64, to: f64) -> Vec<(f64, f64)> {
    arc(at(centre.0, centre.1), radius, from, to, 18).into_iter().map(|point| (point.x, point.y)).collect()
}

/// The gear about the z axis, in mm.
pub fn gear() -> Solid {
    let mut solid = Solid::default();
    let lift = |z: f64| move |point: &DVec2| -> DVec3 { point.extend(z) };
    let teeth = teeth();
    let bore = bore();
    let holes: Vec<Vec<DVec2>> = (0..6)
        .map(|i| circle(polar(DVec2::ZERO, 26.75, TAU * (f64::from(i) + 0.5) / 6.0), 5.6, 72))
        .collect();
    let mut sides = Vec::new();
    for sign in [-1.0, 1.0] {
        // The upper half is built first, then mirrored to the lower side.
        let mut half = Solid::default();
        let outline = half.ring(teeth.iter().map(lift(RIM_HALF)));
        let blend = 2.0;
        // This wall faces inward, so it is listed from the top down.
        let rim = [(RIM_RADIUS + 0.8, RIM_HALF), (RIM_RADIUS, RIM_HALF - 0.8), (RIM_RADIUS, WEB_HALF)];
        let (rim_top, rim_foot) = rings(&mut half, &rim);
        let hub = quarter((HUB_RADIUS + blend, WEB_HALF + blend), blend, 1.5 * PI, PI);
        let hub: Vec<_> =
            hub.into_iter().chain([(HUB_RADIUS, HUB_HALF - 1.0), (HUB_RADIUS - 1.0, HUB_HALF)]).collect();
        let (hub_foot, hub_top) = rings(&mut half, &hub);
        let through: Vec<Vec<u32>> =
            holes.iter().map(|hole| half.ring(hole.iter().map(lift(WEB_HALF)))).collect();
        let key = half.ring(bore.iter().map(lift(HUB_HALF)));
        half.plate(&outline, &[&rim_top]);
        let mut in_web: Vec<&[u32]> = through.iter().map(Vec::as_slice).collect();
        in_web.push(&hub_foot);
        half.plate(&rim_foot, &in_web);
        half.plate(&hub_top, &[&key]);
        let base = solid.points.len() as u32;
        solid.append(&half.moved(glam::DAffine3::from_scale(DVec3::new(1.0, 1.0, sign))));
        let shift = |ring: &Vec<u32>| ring.iter().map(|corner| corner + base).collect::<Vec<_>>();
        sides.push((shift(&outline), through.iter().map(shift).collect::<Vec<_>>(), shift(&key)));
    }
    if let [(low_teeth, low_holes, low_key), (high_teeth, high_holes, high_key)] = sides.as_slice() {
        solid.band(low_teeth, high_teeth);
        // Walls of holes face inward.
        solid.band(high_key, low_key);
        for (low, high) in low_holes.iter().zip(high_holes) {
            solid.band(high, low);
        }
    }
    solid
}
