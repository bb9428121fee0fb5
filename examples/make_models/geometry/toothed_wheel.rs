//! Plain toothed wheels: straight or helical prisms with straight-sided teeth, for gears without involutes.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};
use libm::{cos, sin};

use super::outline::{circle, polar};
use super::solid::Solid;
use super::sweep::prism;

/// Outline of a wheel, counter-clockwise: four points per tooth, with the first tooth at angle 0.
pub fn outline(teeth: usize, root: f64, tip: f64) -> Vec<DVec2> {
    let step = TAU / teeth as f64;
    (0..teeth)
        .flat_map(|tooth| {
            let corners = [(root, -0.34), (tip, -0.14), (tip, 0.14), (root, 0.34)];
            corners.map(|(radius, turn)| polar(DVec2::ZERO, radius, step * (tooth as f64 + turn)))
        })
        .collect()
}

/// Wheel about z with a round bore. `bore` is its radius and number of sides.
pub fn wheel(teeth: usize, [root, tip]: [f64; 2], bore: (f64, usize), [low, high]: [f64; 2]) -> Solid {
    prism(&outline(teeth, root, tip), &[circle(DVec2::ZERO, bore.0, bore.1)], low, high)
}

/// Prism about z between two counter-clockwise outlines, twisted by `twist` radians over its height, in
/// `layers` layers of faces.
pub fn helical(outer: &[DVec2], inner: &[DVec2], [low, high]: [f64; 2], twist: f64, layers: usize) -> Solid {
    let mut solid = Solid::default();
    let mut rims = [outer, inner].map(|rim| {
        let layer = |k: usize| {
            let share = k as f64 / layers as f64;
            let turn = DVec2::new(cos(twist * share), sin(twist * share));
            rim.iter().map(move |point| -> DVec3 { turn.rotate(*point).extend(low + (high - low) * share) })
        };
        (0..=layers).map(|k| solid.ring(layer(k))).collect::<Vec<_>>()
    });
    for k in 0..layers {
        solid.band(&rims[0][k], &rims[0][k + 1]);
        solid.band(&rims[1][k + 1], &rims[1][k]);
    }
    solid.plate(&rims[0][layers], &[&rims[1][layers]]);
    rims[0][0].reverse();
    solid.plate(&rims[0][0], &[&rims[1][0]]);
    solid
}
