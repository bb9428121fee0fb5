//! Random scenes with difficult visibility: several closed and open parts, each a connected surface.

use glam::{DMat3, DVec3};
use libm::{cos, sin};
use ligne::scene::{Camera, Scene};

use super::random_dice::Dice;
use super::round_solids::icosphere;
use super::solids::{Solid, cuboid, torus, tube};
use crate::library::support::pipeline::{orthographic, perspective, scene};

/// Kinds of scenes with difficult visibility.
pub(crate) const HARD_SCENE_KINDS: [&str; 6] =
    ["rods in bores", "shells in shells", "slivers", "sheets", "one-ring cylinders", "figures behind plates"];

/// A random scene of one of the kinds in [`HARD_SCENE_KINDS`], about two units across.
pub(crate) fn hard_scene(kind: &str, dice: &mut Dice) -> Scene {
    scene(hard_solids(kind, dice))
}

/// The solids of [`hard_scene`].
pub(crate) fn hard_solids(kind: &str, dice: &mut Dice) -> Vec<Solid> {
    let turn = dice.turn();
    let parts = match kind {
        "rods in bores" => rods_in_bores(dice),
        "shells in shells" => shells_in_shells(dice),
        "slivers" => slivers(dice),
        "sheets" => arched_sheets(dice),
        "one-ring cylinders" => (0..6).map(|_| randomly_placed(random_rod(dice), 0.7, dice)).collect(),
        _ => figures_behind_plates(dice),
    };
    parts.into_iter().map(|part| part.moved(|p| turn * p)).collect()
}

/// A camera from a random direction, perspective or orthographic.
pub(crate) fn camera_from_any_side(dice: &mut Dice) -> Camera {
    let direction = dice.direction();
    if dice.below(2) == 0 {
        perspective(direction * dice.between(7.0, 8.0), DVec3::ZERO, 35.0)
    } else {
        orthographic(direction * 6.0, DVec3::ZERO, 4.4)
    }
}

/// A solid of revolution about z. The profile lists (radius, z) from the axis outwards, up and back to the
/// axis.
///
/// A profile that never reaches the axis closes into a ring. Each step gives one ring of faces.
pub(crate) fn lathe(profile: &[(f64, f64)], sides: usize) -> Solid {
    let mut solid = Solid::default();
    let mut rings: Vec<Vec<u32>> = Vec::new();
    for &(radius, z) in profile {
        let count = if radius == 0.0 { 1 } else { sides };
        let first = solid.positions.len() as u32;
        solid.positions.extend((0..count).map(|i| {
            let angle = std::f64::consts::TAU * i as f64 / sides as f64;
            DVec3::new(radius * cos(angle), radius * sin(angle), z)
        }));
        rings.push((first..first + count as u32).collect());
    }
    let is_ring = rings[0].len() > 1;
    for k in 0..rings.len() - usize::from(!is_ring) {
        let (low, high) = (&rings[k], &rings[(k + 1) % rings.len()]);
        for i in 0..sides {
            let at = |ring: &[u32], i: usize| ring[(i % sides).min(ring.len() - 1)];
            let [a, b, c, d] = [at(low, i), at(low, i + 1), at(high, i + 1), at(high, i)];
            solid
                .triangles
                .extend([[a, b, c], [a, c, d]].into_iter().filter(|[a, b, c]| a != b && b != c && c != a));
        }
    }
    solid
}

/// A closed rod along z with chamfers of 45 degrees; `rings` is the number of face rings along its side.
fn rod(radius: f64, half: f64, sides: usize, rings: usize) -> Solid {
    let chamfer = 0.2 * radius;
    let (low, high) = (chamfer - half, half - chamfer);
    let mut profile = vec![(0.0, -half), (radius - chamfer, -half)];
    profile.extend((0..=rings).map(|k| (radius, low + (high - low) * k as f64 / rings as f64)));
    profile.extend([(radius - chamfer, half), (0.0, half)]);
    lathe(&profile, sides)
}

fn random_rod(dice: &mut Dice) -> Solid {
    // Nine sides would turn by 40 degrees each, which makes creases.
    let sides = 10 + dice.below(38);
    let rings = [1, 1, 1, 3][dice.below(4)];
    rod(dice.between(0.08, 0.3), dice.between(0.4, 1.2), sides, rings)
}

/// The solid with a random rotation and translation.
fn randomly_placed(solid: Solid, spread: f64, dice: &mut Dice) -> Solid {
    let (turn, place) = (dice.turn(), dice.point(spread));
    solid.moved(|p| turn * p + place)
}

/// Housings with a bore and a rod through it with clearance, and a rod in a blind hole.
fn rods_in_bores(dice: &mut Dice) -> Vec<Solid> {
    let mut parts = Vec::new();
    for x in [-0.75, 0.75] {
        let (bore, sides) = (dice.between(0.15, 0.35), 16 + dice.below(24));
        let (wide, high) = (bore + dice.between(0.15, 0.3), dice.between(0.3, 0.6));
        let housing = lathe(
            &[(bore, -high), (wide - 0.05, -high), (wide, 0.05 - high), (wide, high), (bore, high)],
            sides,
        );
        let room = dice.between(0.01, 0.06);
        let inside = rod(bore - room, dice.between(0.2, 1.3), 12 + dice.below(30), 1);
        parts.extend([housing, inside].map(|part| part.moved(|p| p + DVec3::X * x)));
    }
    let cup = [(0.0, -0.5), (0.4, -0.5), (0.45, -0.45), (0.45, 0.3), (0.3, 0.3), (0.3, -0.3), (0.0, -0.3)];
    let pin = rod(0.25, 0.2, 20, 1);
    let aside = DVec3::new(0.0, dice.between(0.9, 1.2), 0.0);
    parts.extend([lathe(&cup, 28), pin].map(|part| part.moved(|p| p + aside)));
    parts
}

/// Nested closed shells, and nested bowls.
fn shells_in_shells(dice: &mut Dice) -> Vec<Solid> {
    let mut parts = Vec::new();
    let squeeze = DVec3::new(dice.between(0.6, 0.8), dice.between(0.6, 0.8), dice.between(0.6, 0.8));
    for (level, size) in [(3, 1.0), (2, 0.85), (2, 0.5), (1, 0.3)] {
        parts.push(icosphere(level).moved(|p| p * squeeze * size - DVec3::X * 0.7));
    }
    let mut size = 0.75;
    for _ in 0..3 {
        let wall = 0.06;
        let quarter = |k: usize| std::f64::consts::FRAC_PI_2 * k as f64 / 7.0;
        let mut profile = vec![(0.0, -size)];
        profile.extend((1..=7).map(|k| (size * sin(quarter(k)), -size * cos(quarter(k)))));
        profile.extend(
            (1..=7).rev().map(|k| ((size - wall) * sin(quarter(k)), (wall - size) * cos(quarter(k)))),
        );
        profile.push((0.0, wall - size));
        let bowl = lathe(&profile, 20 + dice.below(16));
        parts.push(bowl.moved(|p| p + DVec3::X * 0.8));
        size *= dice.between(0.6, 0.8);
    }
    parts
}

/// Needles and strips with aspect ratios up to 1000, in front of and behind a ball.
fn slivers(dice: &mut Dice) -> Vec<Solid> {
    let mut parts = vec![icosphere(2).moved(|p| p * 0.6)];
    for _ in 0..5 {
        let radius = dice.between(0.004, 0.01);
        parts.push(randomly_placed(rod(radius, 1.2, 10 + dice.below(8), 1), 0.5, dice));
    }
    for _ in 0..3 {
        let half = DVec3::new(1.2, 0.0012, dice.between(0.05, 0.2));
        parts.push(randomly_placed(cuboid(-half, half), 0.5, dice));
    }
    parts.push(randomly_placed(rod(0.4, 0.5, 180, 1), 0.6, dice));
    parts
}

/// Open arched sheets, single or duplicated with the same or the opposite winding, and an open tube.
fn arched_sheets(dice: &mut Dice) -> Vec<Solid> {
    let mut parts = vec![randomly_placed(icosphere(2).moved(|p| p * 0.4), 0.4, dice)];
    for k in 0..5 {
        let mut sheet = arched_sheet(dice);
        match k % 3 {
            1 => sheet.triangles.extend(sheet.triangles.clone().into_iter().map(|[a, b, c]| [a, c, b])),
            2 => sheet.triangles.extend(sheet.triangles.clone()),
            _ => {}
        }
        parts.push(randomly_placed(sheet, 0.5, dice));
    }
    let sides = 16 + dice.below(16);
    parts.push(randomly_placed(tube(sides, 1, dice.between(0.2, 0.4), 0.8), 0.4, dice));
    parts
}

fn arched_sheet(dice: &mut Dice) -> Solid {
    let (count, height) = (8_u32, dice.between(0.1, 0.4));
    let mut solid = Solid::default();
    for j in 0..=count {
        for i in 0..=count {
            let [x, y] = [i, j].map(|k| 2.0 * f64::from(k) / f64::from(count) - 1.0);
            solid.positions.push(DVec3::new(0.7 * x, 0.6 * y, height * (1.0 - x * x) * (1.0 + 0.3 * y)));
            if i < count && j < count {
                let a = j * (count + 1) + i;
                solid.triangles.extend([[a, a + 1, a + count + 2], [a, a + count + 2, a + count + 1]]);
            }
        }
    }
    solid
}

/// A figure of balls, a ring and rods, behind a plate and behind a frame.
fn figures_behind_plates(dice: &mut Dice) -> Vec<Solid> {
    let mut parts = vec![
        icosphere(2).moved(|p| p * DVec3::new(0.4, 0.5, 0.4)),
        icosphere(2).moved(|p| p * 0.3 + DVec3::Y * 0.7),
        torus(24, 10, 0.6, 0.12).moved(|p| DVec3::new(p.x, p.z, p.y)),
    ];
    for x in [-0.3, 0.3] {
        let leg = rod(0.13, 0.5, 14, 1);
        parts.push(leg.moved(|p| DVec3::new(p.x + x, p.z - 0.8, p.y)));
    }
    let z = dice.between(0.9, 1.2);
    let edge = dice.between(-0.2, 0.4);
    parts.push(cuboid(DVec3::new(-1.2, -1.2, z), DVec3::new(1.2, edge, z + 0.08)));
    let frame =
        [(-1.3, -1.3, 1.3, -0.5), (-1.3, 0.6, 1.3, 1.3), (-1.3, -0.5, -0.4, 0.6), (0.5, -0.5, 1.3, 0.6)];
    let lean = DMat3::from_rotation_y(dice.between(-0.2, 0.2));
    parts.extend(frame.map(|(x, y, to_x, to_y)| {
        cuboid(DVec3::new(x, y, -1.2), DVec3::new(to_x, to_y, -1.1)).moved(|p| lean * p)
    }));
    parts
}
