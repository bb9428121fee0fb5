//! A biplane with doubled surfaces: wings and tail planes with back-to-back faces, and a cowling that two
//! parts share.

use glam::{DVec2, DVec3};
use libm::{cos, sin};

use crate::geometry::outline::circle;
use crate::geometry::part::{Material, Part};
use crate::geometry::solid::Solid;
use crate::geometry::sweep::{tube, turned};

const RED: Material = Material { name: "red", colour: [0.75, 0.16, 0.12], metallic: 0.0, roughness: 0.5 };
const CREAM: Material = Material { name: "cream", colour: [0.93, 0.88, 0.74], metallic: 0.0, roughness: 0.7 };
const METAL: Material = Material { name: "metal", colour: [0.7, 0.71, 0.74], metallic: 1.0, roughness: 0.4 };

const CHORD_STEPS: usize = 6;
const SPAN_STEPS: usize = 10;

/// Arched sheet around the origin: chord along x, span along y, rounded tips.
fn sheet(chord: f64, span: f64, arch: f64) -> Solid {
    let mut solid = Solid::default();
    let rows: Vec<Vec<u32>> = (0..=SPAN_STEPS)
        .map(|j| {
            let y = 2.0 * j as f64 / SPAN_STEPS as f64 - 1.0;
            let tip = 1.0 - 0.35 * y.powi(6);
            solid.ring((0..=CHORD_STEPS).map(|i| {
                let x = 2.0 * i as f64 / CHORD_STEPS as f64 - 1.0;
                DVec3::new(x * chord / 2.0 * tip, y * span / 2.0, arch * (1.0 - x * x) * tip)
            }))
        })
        .collect();
    for pair in rows.windows(2) {
        solid.strip(&pair[0], &pair[1]);
    }
    solid
}

/// Adds the reverse of every face on the same points. Both begin at the same corner, so they are split along
/// the same diagonal.
fn back_to_back(mut solid: Solid) -> Solid {
    let back = |face: &Vec<u32>| face[..1].iter().chain(face[1..].iter().rev()).copied().collect();
    let backs: Vec<Vec<u32>> = solid.faces.iter().map(back).collect();
    solid.faces.extend(backs);
    solid
}

/// Doubles every face on separate points, with the same orientation.
fn twice(solid: &Solid) -> Solid {
    let mut double = solid.clone();
    double.append(solid);
    double
}

/// Closed body of rings along x. Each ring: x, half width, half height, height of the centre.
fn fuselage() -> Solid {
    let slices = [
        (-3.6, 0.1, 0.28, 0.22),
        (-2.6, 0.26, 0.36, 0.12),
        (-1.2, 0.44, 0.52, 0.03),
        (0.2, 0.52, 0.6, 0.0),
        (1.5, 0.54, 0.6, 0.0),
    ];
    let rings = slices.map(|(x, wide, high, z)| {
        circle(DVec2::ZERO, 1.0, 16).into_iter().map(|p| DVec3::new(x, wide * p.x, z + high * p.y)).collect()
    });
    tube(&rings)
}

/// Profile turned about x instead of z.
fn along_x(profile: &[(f64, f64)], count: usize) -> Solid {
    turned(profile, count).moved(glam::DAffine3::from_mat3(glam::DMat3::from_cols(
        DVec3::Y,
        DVec3::Z,
        DVec3::X,
    )))
}

fn cowling() -> Solid {
    along_x(&[(0.0, 1.45), (0.62, 1.45), (0.66, 1.6), (0.66, 2.1), (0.5, 2.25), (0.18, 2.3), (0.0, 2.3)], 24)
}

/// Thin rod between two points, with one ring of faces.
fn rod(from: DVec3, to: DVec3, radius: f64) -> Solid {
    let way = (to - from).normalize();
    let u = way.any_orthonormal_vector();
    let v = way.cross(u);
    let ring =
        |middle: DVec3| circle(DVec2::ZERO, radius, 8).into_iter().map(move |p| middle + u * p.x + v * p.y);
    tube(&[ring(from).collect(), ring(to).collect()])
}

fn struts() -> Solid {
    let mut solid = Solid::default();
    for y in [-2.2_f64, -0.42, 0.42, 2.2] {
        for x in [0.35, 1.25] {
            let foot = if y.abs() < 1.0 { 0.25 } else { -0.37 };
            solid.append(&rod(DVec3::new(x - 0.15, y, foot), DVec3::new(x, y, 1.45), 0.05));
        }
    }
    for y in [-0.75, 0.75] {
        solid.append(&rod(DVec3::new(1.0, y * 0.5, -0.3), DVec3::new(1.0, y, -1.25), 0.06));
    }
    solid.append(&rod(DVec3::new(1.0, -0.95, -1.25), DVec3::new(1.0, 0.95, -1.25), 0.06));
    solid
}

fn wheels() -> Solid {
    let mut solid = Solid::default();
    let across = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    for side in [-0.85, 0.85] {
        let profile = [(0.0, -0.09), (0.3, -0.09), (0.38, -0.04), (0.38, 0.04), (0.3, 0.09), (0.0, 0.09)];
        let turn = glam::DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y);
        let wheel = turned(&profile, 20).moved(glam::DAffine3::from_mat3(turn));
        let place = across(1.0, side);
        solid.append(&wheel.shifted(place.x, place.y, -1.25));
    }
    solid
}

/// Two blades as one twisted sheet.
fn propeller() -> Solid {
    let mut solid = Solid::default();
    let rows: Vec<Vec<u32>> = (0..=8)
        .map(|j| {
            let along = 2.0 * f64::from(j) / 8.0 - 1.0;
            let turn = 0.9 - 0.5 * along.abs();
            let half = 0.14 * (1.0 - 0.4 * along * along);
            let side = if along < 0.0 { -1.0 } else { 1.0 };
            solid.ring(
                [-half, half].map(|w| DVec3::new(2.38 + w * sin(turn) * side, w * cos(turn), along * 1.35)),
            )
        })
        .collect();
    for pair in rows.windows(2) {
        solid.strip(&pair[0], &pair[1]);
    }
    solid
}

/// The parts, z up and flying along x.
pub fn parts() -> Vec<Part> {
    let fin = {
        let mut fin = Solid::default();
        let rim = [(-3.7, 0.3), (-2.8, 0.3), (-3.15, 0.95), (-3.45, 1.12), (-3.75, 1.0)];
        let rim = fin.ring(rim.map(|(x, z)| DVec3::new(x, 0.0, z)));
        fin.plate(&rim, &[]);
        fin
    };
    vec![
        Part::new("fuselage", RED, fuselage()),
        Part::new("wing-upper", CREAM, back_to_back(sheet(1.5, 7.0, 0.16).shifted(0.7, 0.0, 1.4))),
        Part::new("wing-lower", CREAM, back_to_back(sheet(1.4, 6.2, 0.14).shifted(0.6, 0.0, -0.45))),
        Part::new("tail-plane", CREAM, twice(&sheet(0.9, 2.6, 0.05).shifted(-3.2, 0.0, 0.3))),
        Part::new("fin", CREAM, back_to_back(fin)),
        Part::new("cowling", METAL, cowling()),
        Part::new("cowling-paint", RED, cowling()),
        Part::new("propeller", METAL, twice(&propeller())),
        Part::new("struts", METAL, struts()),
        Part::new("wheels", METAL, wheels()),
    ]
}
