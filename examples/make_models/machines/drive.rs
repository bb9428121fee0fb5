//! A cycloidal drive: two toothed discs on eccentrics roll along a ring of pins and drive the pins of the
//! output flange.
//!
//! Lengths in mm. The shafts lie along x, the input is on the left, and z is up. Eleven lobes and twelve pins
//! give a ratio of 11 : 1.

use std::f64::consts::{FRAC_1_SQRT_2, PI, TAU};

use glam::{DAffine3, DMat3, DQuat, DVec2, DVec3};
use libm::{atan2, cos, sin};

use super::workshop::{BLUE, BRASS, DARK, GREEN, ORANGE, STEEL, Shop, UP, ZINC, around, place, several};
use crate::geometry::outline::{arc, at, circle, polar};
use crate::geometry::part::together;
use crate::geometry::solid::Solid;
use crate::geometry::sweep::{block, prism, turned};
use crate::machines::pump::pump_parts::{along_x, shaft_turned};
use crate::writers::glb::{Assembly, Node};

/// Number of ring pins, radius of their circle, and radius of a pin.
const PINS: u32 = 12;
const RING: f64 = 50.0;
const PIN: f64 = 4.0;

/// Eccentricity of the discs, and play between discs and pins.
const ECCENTRICITY_MM: f64 = 2.0;
const PLAY_MM: f64 = 0.1;

/// Radius of the circle of the output pins, and radius of a pin.
const CARRIED: f64 = 31.0;
const CARRIER_PIN: f64 = 4.5;

/// Radii of the screw circles of the input cover and the output cover.
const SCREWS: f64 = 66.0;
const CAP_SCREWS: f64 = 39.0;

/// Half a turn about the shafts.
const OVER: DQuat = DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0);
const OUTWARDS: DQuat = DQuat::from_xyzw(0.0, 0.0, 1.0, 0.0);

const ROUND: usize = 48;

/// Toothed outline of a disc: the curve at a constant distance from the path of the pins.
fn lobes() -> Vec<DVec2> {
    let (count, radius) = (f64::from(PINS), PIN + PLAY_MM);
    let steps = 12 * (PINS - 1);
    let point = |k: u32| {
        let turn = TAU * f64::from(k) / f64::from(steps);
        let lean = (1.0 - count) * turn;
        let lean = atan2(sin(lean), RING / (ECCENTRICITY_MM * count) - cos(lean));
        let x = RING * cos(turn) - radius * cos(turn + lean) - ECCENTRICITY_MM * cos(count * turn);
        let y = -RING * sin(turn) + radius * sin(turn + lean) + ECCENTRICITY_MM * sin(count * turn);
        // The formula runs clockwise, so y is negated.
        at(x, -y)
    };
    (0..steps).map(point).collect()
}

fn disc() -> Solid {
    let hole = |k: u32| {
        circle(
            polar(DVec2::ZERO, CARRIED, TAU * f64::from(k) / 6.0),
            CARRIER_PIN + ECCENTRICITY_MM + PLAY_MM,
            32,
        )
    };
    let mut holes: Vec<Vec<DVec2>> = (0..6).map(hole).collect();
    holes.push(circle(DVec2::ZERO, 18.0, ROUND));
    along_x(prism(&lobes(), &holes, 0.0, 12.0))
}

/// Ring about x between two radii and two positions.
fn ring(inner: f64, outer: f64, low: f64, high: f64) -> Solid {
    shaft_turned(&[(inner, low), (outer, low), (outer, high), (inner, high)])
}

/// Ball bearing about x, starting at 0: rings and balls.
fn bearing([bore, inner, outer, outside]: [f64; 4], width: f64, balls: u32) -> Solid {
    let (middle, radius) = ((inner + outer) / 2.0, (outer - inner) / 2.0);
    let half: Vec<(f64, f64)> =
        arc(DVec2::ZERO, radius, -PI / 2.0, PI / 2.0, 8).iter().map(|p| (p.x, p.y)).collect();
    let half: Vec<(f64, f64)> =
        half.iter().map(|(r, z)| (if r.abs() < 1e-9 { 0.0 } else { *r }, *z)).collect();
    let ball = along_x(turned(&half, 16));
    let balls = around(width / 2.0, middle, balls, 0.25).map(|at| ball.clone().shifted(at.x, at.y, at.z));
    together([ring(bore, inner, 0.0, width), ring(outer, outside, 0.0, width)].into_iter().chain(balls))
}

/// Circles evenly spaced around the centre.
fn holes(count: u32, on: f64, radius: f64) -> Vec<Vec<DVec2>> {
    let middle = |k: u32| polar(DVec2::ZERO, on, TAU * f64::from(k) / f64::from(count));
    (0..count).map(|k| circle(middle(k), radius, 24)).collect()
}

/// Solid about z under construction, made of rings perpendicular to z.
#[derive(Default)]
struct Turning(Solid);

impl Turning {
    fn ring(&mut self, outline: &[DVec2], z: f64) -> Vec<u32> {
        self.0.ring(outline.iter().map(|p| p.extend(z)))
    }

    /// Rings about z along a profile of (radius, z). Walls face outward on the way up and inward on the way
    /// down.
    fn walls(&mut self, profile: &[(f64, f64)]) -> [Vec<u32>; 2] {
        let rings: Vec<Vec<u32>> =
            profile.iter().map(|(radius, z)| self.ring(&circle(DVec2::ZERO, *radius, ROUND), *z)).collect();
        rings.windows(2).for_each(|pair| self.0.band(&pair[0], &pair[1]));
        [rings[0].clone(), rings[rings.len() - 1].clone()]
    }

    /// Walls of holes between two heights. Returns their rims.
    fn drill(&mut self, holes: &[Vec<DVec2>], [low, high]: [f64; 2]) -> [Vec<Vec<u32>>; 2] {
        let mut rims = [Vec::new(), Vec::new()];
        for hole in holes {
            let (below, above) = (self.ring(hole, low), self.ring(hole, high));
            self.0.band(&above, &below);
            rims[0].push(below);
            rims[1].push(above);
        }
        rims
    }

    /// Face perpendicular to z with holes, facing up or down.
    fn face(&mut self, outer: &[u32], holes: &[Vec<u32>], looks_up: bool) {
        let mut outer = outer.to_vec();
        if !looks_up {
            outer.reverse();
        }
        let holes: Vec<&[u32]> = holes.iter().map(Vec::as_slice).collect();
        self.0.plate(&outer, &holes);
    }
}

fn housing() -> Solid {
    let mut case = Turning::default();
    let [front, flange] = case.walls(&[(72.0, 0.0), (72.0, 8.0)]);
    let [body, end] = case.walls(&[(63.0, 8.0), (63.0, 40.0), (58.0, 47.0), (46.0, 50.0), (46.0, 66.0)]);
    let [bore, shoulder] = case.walls(&[(31.0, 66.0), (31.0, 40.0)]);
    let [deep, mouth] = case.walls(&[(54.2, 40.0), (54.2, 0.0)]);
    let [mut in_front, mut behind] = case.drill(&holes(8, SCREWS, 2.5), [0.0, 8.0]);
    let [bottoms, mut in_end] = case.drill(&holes(6, CAP_SCREWS, 2.5), [57.0, 66.0]);
    bottoms.iter().for_each(|bottom| case.face(bottom, &[], true));
    in_front.push(mouth);
    case.face(&front, &in_front, false);
    behind.push(body);
    case.face(&flange, &behind, true);
    in_end.push(bore);
    case.face(&end, &in_end, true);
    case.face(&deep, &[shoulder], false);
    // Feet under a saddle, as an outline in (y, z) with thickness along x.
    let mut outline = vec![at(-75.0, -84.0), at(75.0, -84.0), at(75.0, -74.0)];
    outline.extend(arc(DVec2::ZERO, 59.0, -PI * 0.22, -PI * 0.78, 24));
    outline.push(at(-75.0, -74.0));
    let upright = DAffine3::from_mat3(DMat3::from_cols(DVec3::Y, DVec3::Z, DVec3::X));
    let foot = |low: f64, high: f64| prism(&outline, &[], low, high).moved(upright);
    together([along_x(case.0), foot(11.0, 19.0), foot(30.0, 38.0)])
}

fn input_cover() -> Solid {
    let mut cover = Turning::default();
    let [back, front] = cover.walls(&[(72.0, -8.0), (72.0, 0.0)]);
    let [end, boss] = cover.walls(&[(26.0, -22.0), (26.0, -8.0)]);
    let [pocket, seat] = cover.walls(&[(17.5, 0.0), (17.5, -12.0)]);
    let [groove, step] = cover.walls(&[(14.0, -12.0), (14.0, -15.0)]);
    let [bore, mouth] = cover.walls(&[(12.0, -15.0), (12.0, -22.0)]);
    let [mut behind, mut in_front] = cover.drill(&holes(8, SCREWS, 2.8), [-8.0, 0.0]);
    in_front.push(pocket);
    cover.face(&front, &in_front, true);
    behind.push(boss);
    cover.face(&back, &behind, false);
    cover.face(&end, &[mouth], false);
    cover.face(&seat, &[groove], true);
    cover.face(&step, &[bore], true);
    along_x(cover.0)
}

fn output_cover() -> Solid {
    let mut bores = holes(6, CAP_SCREWS, 2.8);
    bores.push(circle(DVec2::ZERO, 22.0, ROUND));
    along_x(prism(&circle(DVec2::ZERO, 46.0, ROUND), &bores, 66.0, 73.0))
}

fn input_shaft() -> Solid {
    let shaft = shaft_turned(&[
        (0.0, -60.0),
        (6.5, -60.0),
        (7.5, -59.0),
        (7.5, -24.0),
        (8.5, -24.0),
        (8.5, -1.0),
        (10.5, -1.0),
        (10.5, 5.0),
        (10.0, 5.0),
        (10.0, 31.0),
        (6.0, 31.0),
        (6.0, 42.0),
        (0.0, 42.0),
    ]);
    let lobe = |low: f64, off: f64| {
        shaft_turned(&[(0.0, low), (14.0, low), (14.0, low + 12.0), (0.0, low + 12.0)]).shifted(0.0, 0.0, off)
    };
    together([shaft, lobe(6.0, -ECCENTRICITY_MM), lobe(20.0, ECCENTRICITY_MM)])
}

fn output_flange() -> Solid {
    shaft_turned(&[
        (8.5, 33.5),
        (42.0, 33.5),
        (42.0, 39.0),
        (18.0, 39.0),
        (18.0, 42.0),
        (15.0, 42.0),
        (15.0, 118.0),
        (14.0, 119.0),
        (0.0, 119.0),
        (0.0, 43.0),
        (8.5, 43.0),
    ])
}

/// Socket screw: the head from x = -5 to 0, and the shank from there.
fn screw() -> Solid {
    shaft_turned(&[
        (0.0, -3.0),
        (2.2, -3.0),
        (2.2, -5.0),
        (3.8, -5.0),
        (4.2, -4.6),
        (4.2, 0.0),
        (2.5, 0.0),
        (2.5, 14.5),
        (2.0, 15.0),
        (0.0, 15.0),
    ])
}

/// The drive, in metres and y up, as glTF requires.
pub fn drive() -> Assembly {
    let mut shop = Shop::default();
    let screw = shop.mesh("screw", ZINC, screw());
    let pin = shop.mesh("ring-pin", STEEL, shaft_turned(&[(0.0, 3.0), (PIN, 3.0), (PIN, 35.0), (0.0, 35.0)]));
    let disc = shop.mesh("disc", GREEN, disc());
    let roller = shop.mesh("roller-bearing", BRASS, ring(14.0, 18.0, 0.0, 12.0));
    let carrier = shop.mesh(
        "carrier-pin",
        STEEL,
        shaft_turned(&[(0.0, 4.0), (CARRIER_PIN, 4.0), (CARRIER_PIN, 38.0), (0.0, 38.0)]),
    );
    let up = |z: f64, x: f64| DVec3::new(x, 0.0, z);
    let mut input = vec![
        shop.part("input-cover", BLUE, input_cover()),
        shop.part("input-shaft", STEEL, input_shaft()),
        shop.part("input-bearing", ZINC, bearing([8.5, 11.0, 15.0, 17.5], 10.0, 9).shifted(-12.0, 0.0, 0.0)),
        shop.part("input-seal", ORANGE, ring(8.5, 12.0, -21.0, -16.0)),
        shop.part("input-key", STEEL, block(DVec3::new(-52.0, -2.5, 4.5), DVec3::new(-30.0, 2.5, 9.5))),
    ];
    input.extend(several("cover-screw", screw, UP, around(-8.0, SCREWS, 8, 0.0)));
    let mut gear = vec![
        place("disc-1", disc, up(-ECCENTRICITY_MM, 6.0), UP),
        place("disc-2", disc, up(ECCENTRICITY_MM, 20.0), OVER),
        place("roller-bearing-1", roller, up(-ECCENTRICITY_MM, 6.0), UP),
        place("roller-bearing-2", roller, up(ECCENTRICITY_MM, 20.0), OVER),
    ];
    gear.extend(several("ring-pin", pin, UP, around(0.0, RING, PINS, 0.0)));
    let mut output = vec![
        shop.part("output-flange", STEEL, output_flange()),
        shop.part("pilot-bush", BRASS, ring(6.0, 8.5, 33.5, 42.0)),
        shop.part(
            "output-bearing",
            ZINC,
            bearing([15.0, 19.5, 26.0, 31.0], 16.0, 11).shifted(42.0, 0.0, 0.0),
        ),
        shop.part("spacer", DARK, ring(27.0, 31.0, 58.0, 66.0)),
        shop.part("output-cover", BLUE, output_cover()),
        shop.part("output-seal", ORANGE, ring(15.0, 22.0, 66.0, 72.0)),
        shop.part("output-key", STEEL, block(DVec3::new(84.0, -4.0, 10.5), DVec3::new(112.0, 4.0, 18.0))),
    ];
    output.extend(several("carrier-pin", carrier, UP, around(0.0, CARRIED, 6, 0.5)));
    output.extend(several("cap-screw", screw, OUTWARDS, around(73.0, CAP_SCREWS, 6, 0.5)));
    let groups = vec![
        Node::group("case", vec![shop.part("housing", BLUE, housing())]),
        Node::group("input", input),
        Node::group("gear", gear),
        Node::group("output", output),
    ];
    let root = Node {
        // From z up in mm to y up in m.
        rotation: DQuat::from_xyzw(-FRAC_1_SQRT_2, 0.0, 0.0, FRAC_1_SQRT_2),
        scale: 0.001,
        ..Node::group("drive", groups)
    };
    Assembly {
        meshes: shop.meshes,
        root,
        with_normals: false,
        eye: DVec3::new(-0.32, 0.24, 0.42),
        target: DVec3::new(0.02, -0.005, 0.0),
        fov_y: 24.0 * PI / 180.0,
        aspect: 1.3,
        clip: None,
    }
}
