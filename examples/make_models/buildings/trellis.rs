//! A vine in a pot on a trellis, made of alpha-masked cards: leaves, and a panel with a repeated hole.
//! Transparent texels are cut out.

use std::fmt::Write as _;

use glam::{DVec2, DVec3};
use libm::{cos, sin};

use crate::geometry::solid::Solid;
use crate::geometry::sweep::turned;

/// Side length of both textures, texels.
const SIDE: usize = 64;

/// Number of holes across the panel and up it.
const HOLES: [u32; 2] = [5, 7];

/// Number of leaves on the vine.
const LEAVES: usize = 28;

/// Grey texture whose opacity follows a signed distance in texels: opaque where it is positive.
fn picture(grey: u8, within: impl Fn(DVec2) -> f64) -> Vec<u8> {
    let at = |k: usize| DVec2::new((k % SIDE) as f64 + 0.5, (k / SIDE) as f64 + 0.5) / SIDE as f64;
    let opacity = |k: usize| (127.5 + 255.0 * SIDE as f64 * within(at(k))).clamp(0.0, 255.0) as u8;
    let pixels: Vec<u8> = (0..SIDE * SIDE).flat_map(|k| [grey, opacity(k)]).collect();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, SIDE as u32, SIDE as u32);
    encoder.set_color(png::ColorType::GrayscaleAlpha);
    let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(&pixels));
    assert!(written.is_ok(), "writing to memory");
    bytes
}

/// Plate with a round hole whose radius is three eighths of its side.
pub fn hole() -> Vec<u8> {
    picture(200, |p| p.distance(DVec2::splat(0.5)) - 0.375)
}

/// Pointed leaf with a stalk: the intersection of two circles.
pub fn leaf() -> Vec<u8> {
    picture(120, |p| {
        let blade = [0.1, 0.9].map(|x| 0.58 - p.distance(DVec2::new(x, 0.44)));
        let stalk = (0.015 - (p.x - 0.5).abs()).min(p.y - 0.5).min(0.98 - p.y);
        blade[0].min(blade[1]).max(stalk)
    })
}

/// Materials that name the textures.
pub fn library() -> &'static str {
    "# A vine on a trellis\n\
     newmtl clay\nKd 0.72 0.4 0.28\n\
     newmtl panel\nKd 0.8 0.76 0.66\nmap_d trellis-hole.png\n\
     newmtl leaf\nKd 0.35 0.6 0.3\nmap_d trellis-leaf.png\n"
}

/// Square with its corners in order, and the texture range from its first to its third corner.
struct Card {
    corners: [DVec3; 4],
    shows: [u32; 2],
}

/// The model, y up.
pub fn text() -> String {
    let mut out = "# A vine on a trellis, in metres\nmtllib trellis.mtl\n".to_owned();
    let mut points = 0;
    let pot = turned(
        &[
            (0.0, 0.0),
            (0.16, 0.0),
            (0.22, 0.3),
            (0.25, 0.3),
            (0.25, 0.36),
            (0.2, 0.36),
            (0.17, 0.3),
            (0.0, 0.3),
        ],
        40,
    );
    let (wide, high) = (f64::from(HOLES[0]) * 0.2, f64::from(HOLES[1]) * 0.2);
    let panel = [[-wide, 0.0], [wide, 0.0], [wide, high], [-wide, high]];
    let panel = Card { corners: panel.map(|[x, z]| DVec3::new(x / 2.0, 0.3, z + 0.1)), shows: HOLES };
    let leaves: Vec<Card> = (0..LEAVES).map(leaf_card).collect();
    add_solid(&mut out, &mut points, &pot);
    add_cards(&mut out, &mut points, "panel", &[panel]);
    add_cards(&mut out, &mut points, "leaf", &leaves);
    out
}

/// Leaf on a vine that winds up in front of the panel.
fn leaf_card(number: usize) -> Card {
    let along = number as f64 / LEAVES as f64;
    let turn = number as f64 * 2.4;
    let stalk = DVec3::new(0.12 * sin(9.0 * along), 0.12, 0.36 + 1.0 * along);
    let way = DVec3::new(cos(turn), -0.35, 0.45 + 0.5 * sin(turn)).normalize();
    let across = way.cross(DVec3::new(0.2 * sin(turn), -1.0, 0.3)).normalize();
    let (half, long) = (across * 0.11, way * 0.22);
    Card { corners: [stalk - half, stalk + half, stalk + half + long, stalk - half + long], shows: [1, 1] }
}

fn add_points(out: &mut String, points: &[DVec3]) {
    for p in points {
        // The model is built z up and written y up.
        let _ = writeln!(out, "v {:.4} {:.4} {:.4}", p.x, p.z, -p.y);
    }
}

fn add_solid(out: &mut String, points: &mut usize, solid: &Solid) {
    out.push_str("o pot\nusemtl clay\n");
    add_points(out, &solid.points);
    for face in &solid.faces {
        let corners: Vec<String> =
            face.iter().map(|corner| (*corner as usize + *points + 1).to_string()).collect();
        let _ = writeln!(out, "f {}", corners.join(" "));
    }
    *points += solid.points.len();
}

fn add_cards(out: &mut String, points: &mut usize, name: &str, cards: &[Card]) {
    let _ = writeln!(out, "o {name}\nusemtl {name}");
    for card in cards {
        add_points(out, &card.corners);
        let [u, v] = card.shows;
        let _ = writeln!(out, "vt 0 0\nvt {u} 0\nvt {u} {v}\nvt 0 {v}");
        let corner = |k: usize| format!("{}/-{}", *points + k + 1, 4 - k);
        let _ = writeln!(out, "f {} {} {} {}", corner(0), corner(1), corner(2), corner(3));
        *points += 4;
    }
}
