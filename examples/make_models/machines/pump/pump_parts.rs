//! Parts of the pump: casing, bearing frame, coupling, base and fasteners.
//!
//! Lengths in mm. The shaft is the x axis, z is up, and the volute surrounds the origin.

use std::f64::consts::{PI, TAU};

use glam::{DAffine3, DMat3, DVec2, DVec3};
use libm::{cos, sin};

use crate::geometry::outline::{at, circle, polar, rounded, rounded_rectangle};
use crate::geometry::part::together;
use crate::geometry::solid::Solid;
use crate::geometry::sweep::{prism, tube, turned};

/// Height of the top of the base relative to the shaft.
pub const FLOOR: f64 = -165.0;
/// Centre of the discharge nozzle, and height of its flange.
pub const DISCHARGE: [f64; 2] = [104.0, 150.0];

const ROUND: usize = 48;

/// Rotates a solid from the z axis to the x axis.
pub fn along_x(solid: Solid) -> Solid {
    solid.moved(DAffine3::from_mat3(DMat3::from_cols(DVec3::NEG_Z, DVec3::Y, DVec3::X)))
}

/// Solid turned about x. The profile lists (radius, x).
pub fn shaft_turned(profile: &[(f64, f64)]) -> Solid {
    along_x(turned(profile, ROUND))
}

/// Pipe flange from z = 0 up: a disc with bore and eight holes, and a raised face.
fn flange(radius: f64, bore: f64) -> Solid {
    let mut holes: Vec<Vec<DVec2>> = (0..8)
        .map(|i| circle(polar(DVec2::ZERO, radius - 11.0, TAU * (f64::from(i) + 0.5) / 8.0), 5.0, 24))
        .collect();
    holes.push(circle(DVec2::ZERO, bore, ROUND));
    let disc = prism(&circle(DVec2::ZERO, radius, ROUND), &holes, 0.0, 14.0);
    let face = turned(
        &[(bore + 0.6, 13.0), (radius - 19.0, 13.0), (radius - 19.0, 16.0), (bore + 0.6, 16.0)],
        ROUND,
    );
    together([disc, face])
}

/// Spiral casing with its vertical discharge nozzle and feet.
pub fn volute() -> Solid {
    const TURNS: usize = 72;
    let ring = |centre: DVec3, outwards: DVec3, radius: f64| -> Vec<DVec3> {
        (0..30)
            .map(|k| {
                let angle = TAU * f64::from(k) / 30.0;
                centre + radius * (cos(angle) * outwards - sin(angle) * DVec3::X)
            })
            .collect()
    };
    let mut rings: Vec<Vec<DVec3>> = (0..=TURNS)
        .map(|i| {
            let turn = i as f64 / TURNS as f64;
            let outwards = DVec3::new(0.0, cos(TAU * turn), sin(TAU * turn));
            let radius = 14.0 + 20.0 * turn;
            ring((70.0 + radius) * outwards, outwards, radius)
        })
        .collect();
    let [side, top] = DISCHARGE;
    rings.push(ring(DVec3::new(0.0, side, 60.0), DVec3::Y, 34.0));
    let neck = turned(
        &[
            (23.6, 40.0),
            (36.0, 40.0),
            (35.0, top - 20.0),
            (37.5, top - 6.0),
            (42.0, top + 1.0),
            (23.6, top + 1.0),
        ],
        ROUND,
    )
    .shifted(0.0, side, 0.0);
    let barrel = shaft_turned(&[(0.0, -37.0), (80.0, -37.0), (80.0, 37.0), (0.0, 37.0)]);
    let foot = |y: f64| {
        let outline = rounded(&[
            (at(-30.0, FLOOR), 0.0),
            (at(30.0, FLOOR), 0.0),
            (at(30.0, FLOOR + 12.0), 2.0),
            (at(14.0, FLOOR + 12.0), 8.0),
            (at(10.0, -60.0), 0.0),
            (at(-10.0, -60.0), 0.0),
            (at(-14.0, FLOOR + 12.0), 8.0),
            (at(-30.0, FLOOR + 12.0), 2.0),
        ]);
        prism(&outline, &[], -9.0, 9.0).moved(upright_y()).shifted(0.0, y, 0.0)
    };
    together([
        tube(&rings),
        neck,
        flange(58.0, 24.0).shifted(0.0, side, top),
        barrel,
        foot(-52.0),
        foot(52.0),
    ])
}

/// Places an outline in (x, z), with thickness along -y.
fn upright_y() -> DAffine3 {
    DAffine3::from_mat3(DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y))
}

/// Front cover with the suction nozzle and its flange.
pub fn suction_cover() -> Solid {
    let bore = 30.0;
    let cover = shaft_turned(&[
        (bore - 0.5, -113.0),
        (48.0, -113.0),
        (42.0, -104.0),
        (40.0, -92.0),
        (41.0, -76.0),
        (46.0, -64.0),
        (56.0, -54.0),
        (60.0, -50.0),
        (88.0, -50.0),
        (90.0, -48.0),
        (90.0, -37.0),
        (bore - 0.5, -37.0),
    ]);
    // The flange faces the opposite direction along x.
    let turn = DAffine3::from_mat3(DMat3::from_cols(DVec3::Z, DVec3::Y, DVec3::NEG_X));
    together([cover, flange(62.0, bore).moved(turn).shifted(-112.0, 0.0, 0.0)])
}

/// Bearing frame behind the casing, with its foot.
pub fn bearing_frame() -> Solid {
    let frame = shaft_turned(&[
        (0.0, 37.0),
        (90.0, 37.0),
        (90.0, 48.0),
        (88.0, 50.0),
        (64.0, 50.0),
        (60.0, 56.0),
        (48.0, 70.0),
        (42.0, 82.0),
        (42.0, 150.0),
        (45.0, 154.0),
        (50.0, 156.0),
        (50.0, 168.0),
        (0.0, 168.0),
    ]);
    let ribs = (0..4).map(|i| {
        let angle = TAU * (f64::from(i) + 0.5) / 4.0;
        let turn = DAffine3::from_mat3(DMat3::from_cols(
            DVec3::X,
            DVec3::new(0.0, cos(angle), sin(angle)),
            DVec3::new(0.0, -sin(angle), cos(angle)),
        ));
        let side = [at(49.0, 40.0), at(140.0, 40.0), at(140.0, 46.0), at(74.0, 60.0), at(49.0, 62.0)];
        prism(&side, &[], -3.0, 3.0).moved(turn)
    });
    let leg = rounded(&[
        (at(-46.0, FLOOR), 0.0),
        (at(46.0, FLOOR), 0.0),
        (at(46.0, FLOOR + 12.0), 3.0),
        (at(20.0, FLOOR + 12.0), 12.0),
        (at(16.0, -30.0), 0.0),
        (at(-16.0, -30.0), 0.0),
        (at(-20.0, FLOOR + 12.0), 12.0),
        (at(-46.0, FLOOR + 12.0), 3.0),
    ]);
    // The outline of the leg lies across the shaft.
    let across = DAffine3::from_mat3(DMat3::from_cols(DVec3::Y, DVec3::Z, DVec3::X));
    let leg = prism(&leg, &[], -11.0, 11.0).moved(across).shifted(130.0, 0.0, 0.0);
    together([frame, leg].into_iter().chain(ribs))
}

/// Cap that closes the bearing towards the coupling.
pub fn bearing_cap() -> Solid {
    shaft_turned(&[
        (0.0, 168.0),
        (44.0, 168.0),
        (44.0, 175.0),
        (42.0, 177.0),
        (24.0, 177.0),
        (20.0, 183.0),
        (0.0, 183.0),
    ])
}

/// Shaft of the pump, from the bearing to the coupling.
pub fn shaft(from: f64, to: f64) -> Solid {
    shaft_turned(&[(0.0, from), (11.0, from), (11.0, to), (0.0, to)])
}

/// Coupling hub from x = 0 towards positive x, with three jaws at the far end.
pub fn coupling_hub() -> Solid {
    let hub = shaft_turned(&[
        (0.0, 0.0),
        (22.0, 0.0),
        (24.0, 2.0),
        (24.0, 14.0),
        (36.0, 14.0),
        (38.0, 16.0),
        (38.0, 28.0),
        (0.0, 28.0),
    ]);
    let jaws = (0..3).map(|i| {
        let middle = TAU * f64::from(i) / 3.0;
        along_x(crate::geometry::sweep::sector(
            [16.0, 37.0],
            [middle - 0.42, middle + 0.42],
            [27.0, 41.0],
            12,
        ))
    });
    together([hub].into_iter().chain(jaws))
}

/// Elastic star between the jaws of the coupling.
pub fn coupling_star() -> Solid {
    let corners: Vec<(DVec2, f64)> = (0..12)
        .map(|i| {
            let (radius, round) = if i % 4 < 2 { (39.5, 3.0) } else { (34.0, 1.5) };
            (polar(DVec2::ZERO, radius, TAU * (f64::from(i) + 0.5) / 12.0), round)
        })
        .collect();
    along_x(prism(&rounded(&corners), &[], 0.0, 12.0))
}

/// Base plate.
pub fn base_plate() -> Solid {
    let plate = rounded_rectangle(at(200.0, 0.0), at(680.0, 300.0), 14.0);
    prism(&plate, &[], FLOOR - 12.0, FLOOR)
}

/// Channel of the base, open on the side of positive y.
pub fn base_rail() -> Solid {
    let (low, high) = (FLOOR - 60.0, FLOOR - 12.0);
    let profile = [
        at(0.0, low),
        at(34.0, low),
        at(34.0, low + 7.0),
        at(7.0, low + 7.0),
        at(7.0, high - 7.0),
        at(34.0, high - 7.0),
        at(34.0, high),
        at(0.0, high),
    ];
    let along = DAffine3::from_mat3(DMat3::from_cols(DVec3::Y, DVec3::Z, DVec3::X));
    prism(&profile, &[], -110.0, 510.0).moved(along)
}

/// Hexagonal prism from z = `low` with a chamfered top.
fn hexagon(radius: f64, low: f64, height: f64) -> Solid {
    let ring = |scale: f64, z: f64| {
        circle(DVec2::ZERO, radius * scale, 6).into_iter().map(|p| p.extend(z)).collect()
    };
    tube(&[ring(1.0, low), ring(1.0, low + 0.82 * height), ring(0.88, low + height)])
}

/// Head of a hexagon bolt on its washer, with the seat at z = 0.
pub fn bolt() -> Solid {
    let washer = turned(&[(0.0, 0.0), (8.6, 0.0), (8.6, 1.7), (0.0, 1.7)], 36);
    together([washer, hexagon(7.2, 1.7, 5.6)])
}

/// Foundation bolt: washer, nut and the end of the thread.
pub fn anchor() -> Solid {
    let washer = turned(&[(0.0, 0.0), (14.0, 0.0), (14.0, 2.5), (0.0, 2.5)], 36);
    let end = turned(&[(0.0, 8.0), (6.0, 8.0), (6.0, 22.0), (5.0, 23.0), (0.0, 23.0)], 36);
    together([washer, hexagon(11.0, 2.5, 10.0), end])
}

/// Head of a socket screw, with the seat at z = 0.
pub fn screw() -> Solid {
    turned(&[(0.0, 0.0), (4.0, 0.0), (4.0, 3.6), (3.6, 4.0), (2.2, 4.0), (2.2, 1.6), (0.0, 1.6)], 24)
}

/// Filler plug on top of the bearing frame, with the seat at z = 0.
pub fn plug() -> Solid {
    let neck = turned(&[(0.0, 0.0), (11.0, 0.0), (11.0, 6.0), (0.0, 6.0)], 36);
    let cap = turned(&[(0.0, 9.0), (6.0, 9.0), (6.0, 14.0), (5.0, 15.5), (0.0, 16.0)], 36);
    together([neck, hexagon(9.0, 6.0, 6.0), cap])
}

/// Sight glass in the side of the bearing frame, with the seat at z = 0: a bezel around a recessed pane.
pub fn sight_glass() -> Solid {
    turned(&[(0.0, 0.0), (13.0, 0.0), (13.0, 5.0), (12.0, 6.0), (9.0, 6.0), (8.4, 4.0), (0.0, 4.0)], 48)
}

/// Lifting eye, with the seat at z = 0.
pub fn eye_bolt() -> Solid {
    let collar = turned(&[(0.0, 0.0), (11.0, 0.0), (11.0, 3.0), (6.0, 6.0), (0.0, 6.0)], 36);
    let rings: Vec<Vec<DVec3>> = (0..36)
        .map(|i| {
            let angle = TAU * f64::from(i) / 36.0;
            let outwards = DVec3::new(0.0, cos(angle), sin(angle));
            let centre = DVec3::Z * 20.0 + 14.0 * outwards;
            (0..16)
                .map(|k| PI * f64::from(k) / 8.0)
                .map(|around| centre + 4.2 * (cos(around) * outwards - sin(around) * DVec3::X))
                .collect()
        })
        .collect();
    together([collar, crate::geometry::sweep::torus(&rings)])
}
