//! A pipe elbow as one closed solid: a bend between two straight pieces of one ring each, and two flanges
//! with bolt holes.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec2, DVec3};
use libm::{cos, sin};

use crate::geometry::outline::{circle, polar};
use crate::geometry::solid::Solid;

const SIDES: usize = 36;
const BEND_STEPS: usize = 20;
const BEND_RADIUS: f64 = 46.0;
const STRAIGHT: f64 = 42.0;
const OUTER: f64 = 17.0;
const INNER: f64 = 13.5;
const FLANGE_RADIUS: f64 = 35.0;
const FLANGE_HEIGHT: f64 = 9.0;
const CHAMFER: f64 = 1.5;
const BOLTS: u32 = 6;
const BOLT_CIRCLE: f64 = 26.5;
const BOLT_HOLE: f64 = 4.2;

/// Point on the axis with the two directions across it. All frames share y.
#[derive(Clone, Copy)]
struct Frame {
    middle: DVec3,
    across: DVec3,
}

impl Frame {
    fn at(self, point: DVec2) -> DVec3 {
        self.middle + self.across * point.x + DVec3::Y * point.y
    }

    /// Ring around the axis, counter-clockwise about its direction.
    fn ring(self, solid: &mut Solid, centre: DVec2, radius: f64, count: usize) -> Vec<u32> {
        solid.ring(circle(centre, radius, count).into_iter().map(|point| self.at(point)))
    }
}

/// Frames from the lower mouth up, around the bend, and out along x.
fn frames() -> Vec<Frame> {
    let up = |z: f64| Frame { middle: DVec3::Z * z, across: DVec3::X };
    let out = |x: f64| Frame {
        middle: DVec3::new(BEND_RADIUS + x, 0.0, STRAIGHT + BEND_RADIUS),
        across: DVec3::NEG_Z,
    };
    let mut frames = vec![up(0.0), up(FLANGE_HEIGHT), up(STRAIGHT)];
    frames.extend((1..BEND_STEPS).map(|i| {
        let turn = FRAC_PI_2 * i as f64 / BEND_STEPS as f64;
        let across = DVec3::new(cos(turn), 0.0, -sin(turn));
        Frame { middle: DVec3::new(BEND_RADIUS, 0.0, STRAIGHT) - BEND_RADIUS * across, across }
    }));
    frames.extend([out(0.0), out(STRAIGHT - FLANGE_HEIGHT), out(STRAIGHT)]);
    frames
}

/// Rim, holes and both faces of a flange from `low` to `high`. `foot` and `mouth` are the rings of the tube
/// in its lower and upper face.
fn flange(solid: &mut Solid, [low, high]: [Frame; 2], foot: &[u32], mouth: &[u32]) {
    // Chamfers of 45 degrees at both ends.
    let way = (high.middle - low.middle).normalize() * CHAMFER;
    let inside = |frame: Frame, way: DVec3| Frame { middle: frame.middle + way, ..frame };
    let steps = [(low, CHAMFER), (inside(low, way), 0.0), (inside(high, -way), 0.0), (high, CHAMFER)];
    let rims = steps.map(|(frame, less)| frame.ring(solid, DVec2::ZERO, FLANGE_RADIUS - less, SIDES + 8));
    for pair in rims.windows(2) {
        solid.band(&pair[0], &pair[1]);
    }
    let mut holes: [Vec<Vec<u32>>; 2] = [vec![foot.to_vec()], vec![mouth.to_vec()]];
    for i in 0..BOLTS {
        let turn = std::f64::consts::TAU * (f64::from(i) + 0.5) / f64::from(BOLTS);
        let place = polar(DVec2::ZERO, BOLT_CIRCLE, turn);
        let [below, above] = [low, high].map(|frame| frame.ring(solid, place, BOLT_HOLE, 10));
        solid.band(&above, &below);
        holes[0].push(below);
        holes[1].push(above);
    }
    let [below, above] = holes.each_ref().map(|holes| holes.iter().map(Vec::as_slice).collect::<Vec<_>>());
    let turned_down: Vec<u32> = rims[0].iter().rev().copied().collect();
    solid.plate(&turned_down, &below);
    solid.plate(&rims[3], &above);
}

/// The elbow, with one mouth below and one to the side, in mm.
pub fn elbow() -> Solid {
    let mut solid = Solid::default();
    let frames = frames();
    let last = frames.len() - 1;
    // The bore has one ring of faces from mouth to bend, so the frames at the inner faces of the flanges are
    // skipped.
    let stops = frames.iter().enumerate().filter(|(i, _)| *i != 1 && *i != last - 1);
    let bore: Vec<Vec<u32>> =
        stops.map(|(_, frame)| frame.ring(&mut solid, DVec2::ZERO, INNER, SIDES)).collect();
    for pair in bore.windows(2) {
        solid.band(&pair[1], &pair[0]);
    }
    let skin: Vec<Vec<u32>> =
        frames[1..last].iter().map(|frame| frame.ring(&mut solid, DVec2::ZERO, OUTER, SIDES)).collect();
    for pair in skin.windows(2) {
        solid.band(&pair[0], &pair[1]);
    }
    flange(&mut solid, [frames[0], frames[1]], &bore[0], &skin[0]);
    flange(&mut solid, [frames[last - 1], frames[last]], &skin[skin.len() - 1], &bore[bore.len() - 1]);
    solid
}
