//! Large scenes for timing: a city of boxes, a Menger sponge, spheres, terrain, a knot, a folded scan, a
//! plate of printed parts, and an assembly with doubled faces.
//!
//! Benches include this file by path, so it uses no other file of the example.

use std::collections::BTreeMap;

/// Welded triangles, counter-clockwise from outside; y is up.
#[derive(Debug, Clone, Default)]
pub(crate) struct Triangles {
    pub points: Vec<[f64; 3]>,
    pub faces: Vec<[u32; 3]>,
    /// First face of each object; empty for a single object.
    pub objects: Vec<usize>,
}

impl Triangles {
    fn point(&mut self, point: [f64; 3]) -> u32 {
        self.points.push(point);
        self.points.len() as u32 - 1
    }

    fn quad(&mut self, [a, b, c, d]: [u32; 4]) {
        self.faces.extend([[a, b, c], [a, c, d]]);
    }

    /// Adds another scene, scaled and moved, as a separate object.
    fn place(&mut self, other: &Self, size: f64, at: [f64; 3]) {
        self.objects.push(self.faces.len());
        let first = self.points.len() as u32;
        self.points.extend(other.points.iter().map(|p| [0, 1, 2].map(|k| p[k] * size + at[k])));
        self.faces.extend(other.faces.iter().map(|face| face.map(|corner| corner + first)));
    }

    /// Grid of points bent into a surface that closes in both directions.
    fn torus(around: u32, along: u32, at: impl Fn(f64, f64) -> [f64; 3]) -> Self {
        let mut out = Self::default();
        for (i, j) in (0..along).flat_map(|i| (0..around).map(move |j| (i, j))) {
            out.point(at(f64::from(i) / f64::from(along), f64::from(j) / f64::from(around)));
        }
        for (i, j) in (0..along).flat_map(|i| (0..around).map(move |j| (i, j))) {
            let at = |i: u32, j: u32| i % along * around + j % around;
            out.quad([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
        out
    }
}

/// Corners of each side of a cube, counter-clockwise from outside. Bits 0, 1 and 2 of a corner are x, y and
/// z. Sides in the order -x, +x, -y, +y, -z, +z.
const SIDES: [[usize; 4]; 6] =
    [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];

/// Pseudo-random number from 0 to 1 for a grid cell. `salt` selects one of several per cell.
fn chance(x: i64, y: i64, salt: u64) -> f64 {
    let mut bits = (x as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15)
        ^ (y as u64).wrapping_mul(0xC2B2_AE3D_27D4_EB4F)
        ^ salt.wrapping_mul(0x1656_67B1_9E37_79F9);
    for _ in 0..2 {
        bits = (bits ^ (bits >> 31)).wrapping_mul(0x7FB5_D329_728E_A185);
    }
    (bits >> 11) as f64 / (1_u64 << 53) as f64
}

/// `side` x `side` houses in blocks of five with streets in between. Some touch, none overlap. 300 per side
/// give 1.08 million triangles.
pub(crate) fn city(side: u32) -> Triangles {
    let mut out = Triangles::default();
    let middle = f64::from(side) / 2.0;
    for (i, j) in (0..side).flat_map(|i| (0..side).map(move |j| (i, j))) {
        let (column, row) = (i64::from(i), i64::from(j));
        let [x, z] = [i, j].map(|k| 10.0 * f64::from(k) + 8.0 * f64::from(k / 5));
        let distance = (f64::from(i) - middle).abs().max((f64::from(j) - middle).abs()) / middle;
        let tall = chance(column, row, 1);
        let height = 4.0 + 12.0 * chance(column, row, 2) + 90.0 * (1.0 - distance) * tall * tall * tall;
        // One house in four fills its whole plot, so it touches neighbours that do the same.
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

/// Whether a unit cell of a Menger sponge with `size` cells per side is solid.
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

/// Surface of a Menger sponge in the unit cube, with one square per outer side of a smallest cube. Level 4
/// has 672,768 triangles. Where solid cells only meet along an edge, four squares share it.
pub(crate) fn menger(level: u32) -> Triangles {
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

/// Unit sphere of 12 `n`² triangles: the sides of a cube with `n` squares along each, projected onto the
/// sphere.
pub(crate) fn sphere(n: u32) -> Triangles {
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

/// Smooth value between 0 and 1, interpolated from the corners of the grid cell around a point.
fn noise(x: f64, z: f64, salt: u64) -> f64 {
    let (i, j) = (x.floor() as i64, z.floor() as i64);
    let ease = |t: f64| t * t * (3.0 - 2.0 * t);
    let (u, v) = (ease(x - x.floor()), ease(z - z.floor()));
    let row = |j: i64| chance(i, j, salt) * (1.0 - u) + chance(i + 1, j, salt) * u;
    row(j) * (1.0 - v) + row(j + 1) * v
}

/// Hills over a square of side 100, with `n` squares along each side: 2 `n`² triangles, open at the border.
pub(crate) fn terrain(n: u32) -> Triangles {
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

/// Sine and cosine of an angle in turns.
fn turned(turns: f64) -> [f64; 2] {
    let (sin, cos) = libm::sincos(turns * std::f64::consts::TAU);
    [cos, sin]
}

/// Trefoil of a round tube with `n` squares around it: 8 `n`² triangles. 100 give 80 thousand, 1,118 give ten
/// million.
pub(crate) fn knot(n: u32) -> Triangles {
    let middle = |s: f64| {
        let ([c2, s2], [c3, s3]) = (turned(2.0 * s), turned(3.0 * s));
        let away = 2.0 + c3;
        [away * c2, s3, away * s2]
    };
    Triangles::torus(n, 4 * n, |along, around| {
        let (here, ahead) = (middle(along), middle(along + 1e-4));
        let way: [f64; 3] = std::array::from_fn(|k| ahead[k] - here[k]);
        let side = normalized(cross(way, [0.0, 1.0, 0.0]));
        let up = normalized(cross(side, way));
        let [c, s] = turned(around);
        std::array::from_fn(|k| here[k] + 0.45 * (c * side[k] + s * up[k]))
    })
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn normalized(a: [f64; 3]) -> [f64; 3] {
    let length = a.iter().map(|x| x * x).sum::<f64>().sqrt();
    a.map(|x| x / length)
}

/// Two nested shells, folded and rough like a scan: 24 `n`² triangles, 1.2 million for 224.
pub(crate) fn nested(n: u32) -> Triangles {
    let mut out = Triangles::default();
    for (salt, radius) in [(40_u64, 1.0), (50, 0.86)] {
        let mut shell = sphere(n);
        for (k, p) in shell.points.iter_mut().enumerate() {
            let fold = |scale: f64, salt: u64| {
                let [x, y, z] = p.map(|x| (x + 2.0) * scale);
                noise(x, y, salt) + noise(y, z, salt + 1) + noise(z, x, salt + 2) - 1.5
            };
            let folds = 0.05 * fold(3.0, salt) + 0.02 * fold(9.0, salt + 3);
            let rough = 0.25 / f64::from(n) * (chance(k as i64, 0, salt + 6) - 0.5);
            *p = p.map(|x| x * radius * (1.0 + folds + rough));
        }
        out.points.extend(&shell.points);
        let first = (out.points.len() - shell.points.len()) as u32;
        out.faces.extend(shell.faces.iter().map(|face| face.map(|corner| corner + first)));
    }
    out
}

/// Plate with 83 parts of five kinds side by side: 83 times 8 `n`² triangles, one million for 39.
pub(crate) fn printed(n: u32) -> Triangles {
    let kinds: Vec<Triangles> = (0..5).map(|kind| printed_part(kind, n)).collect();
    let mut out = Triangles::default();
    for k in 0..83_u32 {
        let at = [3.0 * f64::from(k % 10), 0.0, 3.0 * f64::from(k / 10)];
        let size = 0.7 + 0.3 * chance(i64::from(k), 0, 60);
        out.place(&kinds[(k % 5) as usize], size, at);
    }
    out
}

/// Ring, rippled vase, gear, spring washer, or layered ball.
fn printed_part(kind: u32, n: u32) -> Triangles {
    Triangles::torus(2 * n, 2 * n, |along, around| {
        let ([c, s], [height, width]) = (turned(along), {
            let [c, s] = turned(around);
            [s, c]
        });
        let square = |x: f64| (3.0 * x).clamp(-1.0, 1.0);
        let (away, up) = match kind {
            0 => (0.9 + 0.35 * width, 0.35 * height),
            1 => (0.8 + 0.06 * turned(12.0 * along)[0] + 0.3 * height * height + 0.06 * width, 1.2 * height),
            2 => (0.8 + (0.3 + 0.1 * square(turned(9.0 * along)[0])) * square(width), 0.3 * square(height)),
            3 => (0.9 + 0.3 * width, 0.06 * height + 0.2 * turned(3.0 * along)[0]),
            _ => (0.62 + 0.6 * width, (8.0 * 0.9 * height).round() / 8.0 + 0.02 * height),
        };
        [away * c, up, away * s]
    })
}

/// 67 objects, some inside each other, with every face doubled in both orientations: 67 times 16 `n`²
/// triangles, 347 thousand for 18.
pub(crate) fn doubled(n: u32) -> Triangles {
    let mut single = Triangles::default();
    let kinds: Vec<Triangles> = (0..5).map(|kind| printed_part(kind, n)).collect();
    for k in 0..67_u32 {
        let at = [1.6 * f64::from(k % 9), 0.4 * f64::from(k % 4), 1.6 * f64::from(k / 9)];
        single.place(&kinds[(k % 5) as usize], 0.9, at);
    }
    let mut out = Triangles { points: single.points, ..Triangles::default() };
    for (k, first) in single.objects.iter().enumerate() {
        let end = single.objects.get(k + 1).copied().unwrap_or(single.faces.len());
        out.objects.push(out.faces.len());
        for [a, b, c] in single.faces[*first..end].iter().copied() {
            out.faces.extend([[a, b, c], [c, b, a]]);
        }
    }
    out
}
