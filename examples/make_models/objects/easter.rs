//! An egg and a block with vertex colours. Regions and lines depend on these colours only.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use libm::{cos, sin};

const AROUND: usize = 28;
const UP: usize = 18;

/// Position and colour (sRGB) of a vertex.
type Vertex = ([f64; 3], [f64; 3]);

/// Egg: pink at the bottom, yellow in the middle, blue at the top, with waves in between.
fn egg() -> (Vec<Vertex>, Vec<Vec<usize>>) {
    let mut vertices = Vec::new();
    for j in 0..=UP {
        let down = TAU / 2.0 * j as f64 / UP as f64;
        for i in 0..AROUND {
            let turn = TAU * i as f64 / AROUND as f64;
            let out = sin(down) * (0.36 + 0.04 * (1.0 - cos(down)));
            let at = [out * cos(turn), 0.5 + 0.5 * cos(down), out * sin(turn)];
            let level = at[1] + 0.09 * sin(3.0 * turn) * sin(down);
            vertices.push((at, blend(level)));
        }
    }
    let at = |j: usize, i: usize| j * AROUND + i % AROUND + 1;
    let quad = |(j, i): (usize, usize)| {
        // Rings at the ends are points.
        let mut face = vec![at(j, i), at(j, i + 1), at(j + 1, i + 1), at(j + 1, i)];
        if j == 0 {
            face.remove(1);
        } else if j + 1 == UP {
            face.remove(3);
        }
        face
    };
    let faces = (0..UP).flat_map(|j| (0..AROUND).map(move |i| (j, i))).map(quad).collect();
    (vertices, faces)
}

/// Colour of the egg at a height from 0 to 1.
fn blend(level: f64) -> [f64; 3] {
    const STOPS: [[f64; 3]; 3] = [[0.93, 0.35, 0.5], [0.98, 0.86, 0.4], [0.25, 0.45, 0.8]];
    let place = level.clamp(0.0, 1.0) * 2.0;
    let first = (place as usize).min(1);
    let share = place - first as f64;
    [0, 1, 2].map(|k| STOPS[first][k] + (STOPS[first + 1][k] - STOPS[first][k]) * share)
}

/// Block with a different colour at each corner.
fn block() -> (Vec<Vertex>, Vec<Vec<usize>>) {
    let corner = |k: usize| {
        let side = [k & 1, k >> 1 & 1, k >> 2 & 1].map(|bit| bit as f64);
        let at = [0.75 + 0.6 * side[0], 0.6 * side[1], -0.3 + 0.6 * side[2]];
        (at, side.map(|c| 0.25 + 0.65 * c))
    };
    let faces = [[1, 5, 7, 3], [2, 4, 8, 6], [1, 2, 6, 5], [3, 7, 8, 4], [1, 3, 4, 2], [5, 6, 8, 7]];
    ((0..8).map(corner).collect(), faces.map(|face| face.to_vec()).to_vec())
}

/// The model as OBJ with vertex colours.
pub fn text() -> String {
    let mut text = "# An egg and a block with coloured vertices\n".to_owned();
    let mut before = 0;
    for (name, (vertices, faces)) in [("egg", egg()), ("block", block())] {
        let _ = writeln!(text, "o {name}");
        for ([x, y, z], [r, g, b]) in &vertices {
            let _ = writeln!(text, "v {x:.5} {y:.5} {z:.5} {r:.4} {g:.4} {b:.4}");
        }
        for face in faces {
            let corners: Vec<String> = face.iter().map(|v| (v + before).to_string()).collect();
            let _ = writeln!(text, "f {}", corners.join(" "));
        }
        before += vertices.len();
    }
    text
}
