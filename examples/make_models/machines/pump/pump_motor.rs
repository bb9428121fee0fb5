//! Electric motor of the pump: finned housing, end shields, fan cover, terminal box, feet.

use std::f64::consts::TAU;

use glam::{DAffine3, DMat3, DVec2, DVec3};

use super::pump_parts::{FLOOR, along_x, shaft_turned};
use crate::geometry::outline::{at, circle, polar, rounded, rounded_rectangle};
use crate::geometry::part::together;
use crate::geometry::solid::Solid;
use crate::geometry::sweep::{prism, turned};

/// Housing with cooling fins, from x = 296 to 440.
pub fn housing() -> Solid {
    const FINS: usize = 36;
    let pitch = TAU / FINS as f64;
    let outline: Vec<DVec2> = (0..FINS)
        .flat_map(|fin| {
            let middle = pitch * fin as f64;
            [(76.0, -0.30), (89.0, -0.16), (89.0, 0.16), (76.0, 0.30)]
                .map(|(radius, side)| polar(DVec2::ZERO, radius, middle + side * pitch))
        })
        .collect();
    let core = along_x(prism(&outline, &[], 296.0, 440.0));
    let foot = rounded(&[
        (at(-78.0, FLOOR), 0.0),
        (at(-78.0, FLOOR + 13.0), 3.0),
        (at(-48.0, FLOOR + 13.0), 10.0),
        (at(-48.0, -50.0), 0.0),
        (at(48.0, -50.0), 0.0),
        (at(48.0, FLOOR + 13.0), 10.0),
        (at(78.0, FLOOR + 13.0), 3.0),
        (at(78.0, FLOOR), 0.0),
        (at(34.0, FLOOR), 0.0),
        (at(34.0, FLOOR + 40.0), 24.0),
        (at(-34.0, FLOOR + 40.0), 24.0),
        (at(-34.0, FLOOR), 0.0),
    ]);
    let across = DAffine3::from_mat3(DMat3::from_cols(DVec3::Y, DVec3::Z, DVec3::X));
    let foot = prism(&foot, &[], -14.0, 14.0).moved(across);
    together([core, foot.clone().shifted(322.0, 0.0, 0.0), foot.shifted(414.0, 0.0, 0.0)])
}

/// End shield on the driving side.
pub fn front_shield() -> Solid {
    shaft_turned(&[
        (0.0, 272.0),
        (22.0, 272.0),
        (24.0, 274.0),
        (26.0, 280.0),
        (62.0, 280.0),
        (72.0, 282.0),
        (79.0, 286.0),
        (84.0, 292.0),
        (84.0, 300.0),
        (0.0, 300.0),
    ])
}

/// Fan cover at the back, with a grille of rings.
pub fn fan_cover() -> Solid {
    let mut profile = vec![(0.0, 434.0), (91.0, 434.0), (93.0, 436.0), (93.0, 486.0)];
    profile.extend([(91.5, 493.0), (87.0, 498.0), (80.0, 500.0)]);
    for ring in 0..5 {
        let outer = 72.0 - 12.0 * f64::from(ring);
        profile.extend([(outer, 500.0), (outer, 495.0), (outer - 5.0, 495.0), (outer - 5.0, 500.0)]);
    }
    profile.push((0.0, 500.0));
    shaft_turned(&profile)
}

/// Terminal box on top, without its lid.
pub fn terminal_box() -> Solid {
    let base = prism(&rounded_rectangle(at(366.0, 0.0), at(88.0, 74.0), 8.0), &[], 70.0, 114.0);
    let gland = turned(
        &[
            (0.0, 0.0),
            (13.0, 0.0),
            (13.0, 6.0),
            (10.0, 8.0),
            (10.0, 20.0),
            (6.0, 23.0),
            (6.0, 14.0),
            (0.0, 14.0),
        ],
        36,
    );
    let nut = prism(&circle(DVec2::ZERO, 13.5, 6), &[], 8.0, 15.0);
    // The cable enters from the side of negative y.
    let sideways = DAffine3::from_mat3(DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y));
    let gland = together([gland, nut]).moved(sideways).shifted(366.0, -37.0, 94.0);
    together([base, gland])
}

/// Lid of the terminal box.
pub fn terminal_lid() -> Solid {
    let lid = rounded_rectangle(at(366.0, 0.0), at(94.0, 80.0), 10.0);
    let raised = rounded_rectangle(at(366.0, 0.0), at(70.0, 48.0), 5.0);
    together([prism(&lid, &[], 114.0, 122.0), prism(&raised, &[], 121.0, 124.5)])
}
