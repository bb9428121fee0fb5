//! A beach ball on a checked cloth, both textured. The texture of the cloth repeats.

use std::fmt::Write as _;

use glam::DVec3;
use libm::{cos, sin};

/// Number of meridians and parallels of the ball.
const ROUND: u32 = 64;
const HIGH: u32 = 32;

/// Radius of the ball and half side of the cloth, metres.
const RADIUS: f64 = 0.25;
const HALF: f64 = 0.5;

/// Repeats of the texture along each side of the cloth.
const CHECKS: u32 = 5;

const CREAM: [f64; 3] = [246.0, 239.0, 224.0];
const SECTORS: [[f64; 3]; 6] =
    [[214.0, 66.0, 52.0], CREAM, [240.0, 180.0, 41.0], CREAM, [45.0, 110.0, 178.0], CREAM];

/// Size of the caps of the ball, as a share of the distance between the poles.
const CAP: f64 = 1.0 / 12.0;

/// Picture of a colour function over the unit square (origin at the upper left), averaged over each texel.
fn picture(width: u32, height: u32, colour: impl Fn(f64, f64) -> [f64; 3]) -> Vec<u8> {
    const PARTS: u32 = 4;
    let mut pixels = Vec::new();
    for (row, column) in (0..height).flat_map(|row| (0..width).map(move |column| (row, column))) {
        let mut sum = [0.0; 3];
        for (j, i) in (0..PARTS).flat_map(|j| (0..PARTS).map(move |i| (j, i))) {
            let at = |k: u32, part: u32, count: u32| {
                (f64::from(k) + (f64::from(part) + 0.5) / f64::from(PARTS)) / f64::from(count)
            };
            let colour = colour(at(column, i, width), at(row, j, height));
            sum.iter_mut().zip(colour).for_each(|(sum, c)| *sum += c);
        }
        pixels.extend(sum.map(|sum| (sum / f64::from(PARTS * PARTS)).round() as u8));
    }
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(&pixels));
    assert!(written.is_ok(), "writing to memory");
    bytes
}

/// Texture of the ball: six sectors between two caps.
pub fn sectors() -> Vec<u8> {
    picture(300, 180, |u, v| {
        let is_cap = !(CAP..1.0 - CAP).contains(&v);
        if is_cap { CREAM } else { SECTORS[(u * 6.0) as usize % 6] }
    })
}

/// Texture of the cloth: two crossing stripes, darker at the crossing, on almost white.
pub fn checks() -> Vec<u8> {
    picture(50, 50, |u, v| match (u < 0.5, v < 0.5) {
        (true, true) => [52.0, 122.0, 84.0],
        (false, false) => [250.0, 247.0, 238.0],
        _ => [148.0, 190.0, 160.0],
    })
}

/// Materials that name the textures.
pub fn library() -> &'static str {
    "# A ball on a cloth\n\
     newmtl ball\nKd 1 1 1\nmap_Kd picnic-ball.png\n\
     newmtl cloth\nKd 1 1 1\nmap_Kd picnic-cloth.png\n"
}

/// The model, y up.
pub fn text() -> String {
    let mut out = "# A ball on a cloth, in metres\nmtllib picnic.mtl\no ball\nusemtl ball\n".to_owned();
    for j in 0..=HIGH {
        let down = std::f64::consts::PI * f64::from(j) / f64::from(HIGH);
        for i in 0..=ROUND {
            let turn = std::f64::consts::TAU * f64::from(i % ROUND) / f64::from(ROUND);
            let p = DVec3::new(sin(down) * cos(turn), cos(down) + 1.0, -sin(down) * sin(turn)) * RADIUS;
            let _ = writeln!(out, "v {:.5} {:.5} {:.5}", p.x, p.y, p.z + 0.0);
            let (u, v) = (f64::from(i) / f64::from(ROUND), 1.0 - f64::from(j) / f64::from(HIGH));
            let _ = writeln!(out, "vt {u:.6} {v:.6}");
        }
    }
    let number = |i: u32, j: u32| j * (ROUND + 1) + i + 1;
    for (i, j) in (0..HIGH).flat_map(|j| (0..ROUND).map(move |i| (i, j))) {
        let corners = [number(i, j), number(i, j + 1), number(i + 1, j + 1), number(i + 1, j)];
        let corners: &[u32] = match j {
            0 => &corners[..3],
            j if j == HIGH - 1 => &[corners[0], corners[1], corners[3]],
            _ => &corners,
        };
        let corners: Vec<String> = corners.iter().map(|corner| format!("{corner}/{corner}")).collect();
        let _ = writeln!(out, "f {}", corners.join(" "));
    }
    out.push_str("o cloth\nusemtl cloth\n");
    for [x, z] in [[-1, 1], [1, 1], [1, -1], [-1, -1]] {
        let _ = writeln!(out, "v {} 0 {}", f64::from(x) * HALF, f64::from(z) * HALF);
    }
    let _ = writeln!(
        out,
        "vt 0 0\nvt {CHECKS} 0\nvt {CHECKS} {CHECKS}\nvt 0 {CHECKS}\nf -4/-4 -3/-3 -2/-2 -1/-1"
    );
    out
}
