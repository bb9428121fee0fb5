//! Large scenes for timing: a city of boxes, a Menger sponge, spheres and terrain of any size.
//!
//! Benches include this file by its path, so it uses nothing of the program around it.

use std::collections::BTreeMap;

/// Welded triangles, counter-clockwise from outside; y is up.
#[derive(Debug, Clone, Default)]
pub struct Triangles {
    pub points: Vec<[f64; 3]>,
    pub faces: Vec<[u32; 3]>,
}

impl Triangles {
    fn point(&mut self, point: [f64; 3]) -> u32 {
        self.points.push(point);
        self.points.len() as u32 - 1
    }

    fn quad(&mut self, [a, b, c, d]: [u32; 4]) {
        self.faces.extend([[a, b, c], [a, c, d]]);
    }
}

/// The corners of each side of a cube, counter-clockwise from outside; bit 0 of a corner is x, bit 1
/// is y, bit 2 is z. Sides in the order -x, +x, -y, +y, -z, +z.
const SIDES: [[usize; 4]; 6] =
    [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];

/// A number from 0 to 1 for a cell of a grid; `salt` tells several of one cell apart.
fn chance(x: i64, y: i64, salt: u64) -> f64 {
    let mut bits = (x as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15)
        ^ (y as u64).wrapping_mul(0xC2B2_AE3D_27D4_EB4F)
        ^ salt.wrapping_mul(0x1656_67B1_9E37_79F9);
    for _ in 0..2 {
        bits = (bits ^ (bits >> 31)).wrapping_mul(0x7FB5_D329_728E_A185);
    }
    (bits >> 11) as f64 / (1_u64 << 53) as f64
}

/// `side` x `side` houses in blocks of five with streets between; some touch, none overlap. 300 a
/// side make 1.08 million triangles.
pub fn city(side: u32) -> Triangles {
    let mut out = Triangles::default();
    let middle = f64::from(side) / 2.0;
    for (i, j) in (0..side).flat_map(|i| (0..side).map(move |j| (i, j))) {
        let (column, row) = (i64::from(i), i64::from(j));
        let [x, z] = [i, j].map(|k| 10.0 * f64::from(k) + 8.0 * f64::from(k / 5));
        let distance = (f64::from(i) - middle).abs().max((f64::from(j) - middle).abs()) / middle;
        let tall = chance(column, row, 1);
        let height = 4.0 + 12.0 * chance(column, row, 2) + 90.0 * (1.0 - distance) * tall * tall * tall;
        // One house in four fills its whole plot and so touches its neighbours that do.
        let gap = if chance(column, row, 3) < 0.25 { 0.0 } else { 0.5 + 1.5 * chance(column, row, 4) };
        let (low, high) = ([x + gap, 0.0, z + gap], [x + 10.0 - gap, height, z + 10.0 - gap]);
        let corners: [u32; 8] = std::array::from_fn(|corner| {
            out.point(std::array::from_fn(
                |axis| if corner >> axis & 1 == 1 { high[axis] } else { low[axis] },
            ))
        });
        for side in SIDES {
            out.quad(side.map(|corner| corners[corner]));
        }
    }
    out
}

/// Whether the unit cell of a Menger sponge of so many cells a side is solid.
fn is_solid(cell: [i64; 3], size: i64) -> bool {
    if cell.iter().any(|&k| k < 0 || k >= size) {
        return false;
    }
    let mut cell = cell;
    while cell.iter().any(|&k| k > 0) {
        if cell.iter().filter(|&&k| k % 3 == 1).count() >= 2 {
            return false;
        }
        cell = cell.map(|k| k / 3);
    }
    true
}

/// The surface of a Menger sponge in the unit cube, a square for each outer side of a smallest cube.
/// Level 4 has 672,768 triangles. Where solid cells meet along an edge only, four squares share it.
pub fn menger(level: u32) -> Triangles {
    let size = 3_i64.pow(level);
    let mut out = Triangles::default();
    let mut known: BTreeMap<[i64; 3], u32> = BTreeMap::new();
    for x in 0..size {
        for (y, z) in (0..size).flat_map(|y| (0..size).map(move |z| (y, z))) {
            if !is_solid([x, y, z], size) {
                continue;
            }
            for (place, side) in SIDES.iter().enumerate() {
                let mut beyond = [x, y, z];
                beyond[place / 2] += if place % 2 == 1 { 1 } else { -1 };
                if is_solid(beyond, size) {
                    continue;
                }
                let corners = side.map(|corner| {
                    let at: [i64; 3] =
                        std::array::from_fn(|axis| [x, y, z][axis] + (corner >> axis & 1) as i64);
                    *known.entry(at).or_insert_with(|| out.point(at.map(|k| k as f64 / size as f64)))
                });
                out.quad(corners);
            }
        }
    }
    out
}

/// A unit sphere of 12 `n`² triangles: the sides of a cube, `n` squares along each, blown up.
pub fn sphere(n: u32) -> Triangles {
    let mut out = Triangles::default();
    let mut known: BTreeMap<[i64; 3], u32> = BTreeMap::new();
    let size = i64::from(n);
    for side in SIDES {
        let corner =
            |k: usize| -> [i64; 3] { std::array::from_fn(|axis| 2 * (side[k] >> axis & 1) as i64 - 1) };
        let [a, b, _, d] = [0, 1, 2, 3].map(corner);
        let mut at = |i: i64, j: i64| {
            let key: [i64; 3] = std::array::from_fn(|axis| {
                a[axis] * size + (b[axis] - a[axis]) * i + (d[axis] - a[axis]) * j
            });
            *known.entry(key).or_insert_with(|| {
                let [x, y, z] = key.map(|k| k as f64);
                let length = (x * x + y * y + z * z).sqrt();
                out.points.push([x / length, y / length, z / length]);
                out.points.len() as u32 - 1
            })
        };
        let mut quads = Vec::new();
        for (i, j) in (0..size).flat_map(|i| (0..size).map(move |j| (i, j))) {
            quads.push([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
        for quad in quads {
            out.quad(quad);
        }
    }
    out
}

/// A smooth value between 0 and 1 from the corners of the grid cell around a point.
fn noise(x: f64, z: f64, salt: u64) -> f64 {
    let (i, j) = (x.floor() as i64, z.floor() as i64);
    let ease = |t: f64| t * t * (3.0 - 2.0 * t);
    let (u, v) = (ease(x - x.floor()), ease(z - z.floor()));
    let row = |j: i64| chance(i, j, salt) * (1.0 - u) + chance(i + 1, j, salt) * u;
    row(j) * (1.0 - v) + row(j + 1) * v
}

/// Hills over a square of side 100, `n` squares along each side: 2 `n`² triangles, open at the rim.
pub fn terrain(n: u32) -> Triangles {
    let mut out = Triangles::default();
    for (i, j) in (0..=n).flat_map(|i| (0..=n).map(move |j| (i, j))) {
        let [x, z] = [i, j].map(|k| 100.0 * f64::from(k) / f64::from(n) - 50.0);
        let octave = |k: u32| {
            noise(x * 0.06 * f64::from(1 << k), z * 0.06 * f64::from(1 << k), 10 + u64::from(k))
                / f64::from(1 << k)
        };
        let height: f64 = (0..5).map(octave).sum();
        out.point([x, 11.0 * height, z]);
    }
    for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
        let at = |i: u32, j: u32| i * (n + 1) + j;
        out.quad([at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)]);
    }
    out
}
