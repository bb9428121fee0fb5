//! A trefoil: a round tube along a torus knot with two turns around and three turns through.

use std::f64::consts::TAU;

use glam::DVec3;
use libm::{cos, sin};

use crate::geometry::solid::Solid;
use crate::geometry::sweep::torus;

const AROUND: f64 = 2.0;
const THROUGH: f64 = 3.0;
const RING_RADIUS: f64 = 2.0;
const WINDING_RADIUS: f64 = 0.95;
const TUBE_RADIUS: f64 = 0.46;
const STEPS: usize = 240;
const SIDES: usize = 24;

/// Point on the axis of the tube for a parameter from 0 to 2π, and the nearest point on the axis of the
/// torus.
fn axis(t: f64) -> (DVec3, DVec3) {
    let outwards = DVec3::new(cos(AROUND * t), sin(AROUND * t), 0.0);
    let middle = RING_RADIUS * outwards;
    let offset = WINDING_RADIUS * (cos(THROUGH * t) * outwards + sin(THROUGH * t) * DVec3::Z);
    (middle + offset, middle)
}

/// The tube with its exact normals.
pub fn knot() -> (Solid, Vec<DVec3>) {
    let mut normals = Vec::new();
    let rings: Vec<Vec<DVec3>> = (0..STEPS)
        .map(|i| {
            let t = TAU * i as f64 / STEPS as f64;
            let (centre, middle) = axis(t);
            let way = (axis(t + 1e-5).0 - axis(t - 1e-5).0).normalize();
            let u = (centre - middle).reject_from_normalized(way).normalize();
            let v = way.cross(u);
            (0..SIDES)
                .map(|k| {
                    let angle = TAU * k as f64 / SIDES as f64;
                    let normal = cos(angle) * u + sin(angle) * v;
                    normals.push(normal);
                    centre + TUBE_RADIUS * normal
                })
                .collect()
        })
        .collect();
    (torus(&rings), normals)
}
