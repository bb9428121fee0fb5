//! Rods with chamfered ends, with one or several rings of faces, that project above and next to a wall.

use glam::DVec3;

use crate::geometry::solid::Solid;
use crate::geometry::sweep::{block, turned};

/// Rod from the ground up, with `rings` rings of faces between its ends.
fn rod(radius: f64, length: f64, sides: usize, rings: usize) -> Solid {
    let chamfer = 0.15 * radius;
    let mut profile = vec![(0.0, 0.0), (radius - chamfer, 0.0)];
    let straight = length - 2.0 * chamfer;
    profile.extend((0..=rings).map(|i| (radius, chamfer + straight * i as f64 / rings as f64)));
    profile.extend([(radius - chamfer, length), (0.0, length)]);
    turned(&profile, sides)
}

/// A wall, a row of rods three units behind it, a short rod in front, and a long lying rod; z up.
pub fn rack() -> Solid {
    let mut solid = block(DVec3::new(-10.0, -0.5, 0.0), DVec3::new(10.0, 0.5, 12.0));
    for (i, (sides, rings)) in [(32, 1), (32, 4), (24, 1), (12, 1), (48, 1)].into_iter().enumerate() {
        let x = 3.6 * i as f64 - 7.2;
        let length = 9.0 + 1.6 * i as f64;
        solid.append(&rod(1.0, length, sides, rings).shifted(x, 4.5, 0.0));
    }
    solid.append(&rod(0.8, 6.0, 32, 1).shifted(4.0, -3.5, 0.0));
    let lying = glam::DMat3::from_cols(DVec3::Y, DVec3::Z, DVec3::X);
    let long = rod(1.2, 30.0, 32, 1).moved(glam::DAffine3::from_mat3(lying));
    solid.append(&long.shifted(-14.0, 9.0, 3.0));
    solid
}
