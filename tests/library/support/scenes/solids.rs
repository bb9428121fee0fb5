//! Solids in closed form, for tests and benchmarks.

use glam::DVec3;

/// A triangle mesh.
#[derive(Debug, Clone, Default)]
pub(crate) struct Solid {
    pub positions: Vec<DVec3>,
    pub triangles: Vec<[u32; 3]>,
}

impl Solid {
    /// Adds another solid without sharing vertices.
    pub(crate) fn add(&mut self, other: Solid) {
        let first = self.positions.len() as u32;
        self.positions.extend(other.positions);
        self.triangles.extend(other.triangles.iter().map(|t| t.map(|v| v + first)));
    }

    /// The solid with `place` applied to each point.
    pub(crate) fn moved(mut self, place: impl Fn(DVec3) -> DVec3) -> Solid {
        self.positions.iter_mut().for_each(|p| *p = place(*p));
        self
    }
}

/// An axis-aligned box of twelve triangles.
pub(crate) fn cuboid(low: DVec3, high: DVec3) -> Solid {
    let corner = |i: u32| {
        let pick = |bit: u32, low: f64, high: f64| if i >> bit & 1 == 0 { low } else { high };
        DVec3::new(pick(0, low.x, high.x), pick(1, low.y, high.y), pick(2, low.z, high.z))
    };
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    Solid {
        positions: (0..8).map(corner).collect(),
        triangles: sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect(),
    }
}

/// A torus about the z axis, with `around` × `along` quads.
pub(crate) fn torus(around: usize, along: usize, radius: f64, tube: f64) -> Solid {
    grid(around, along, true, |u, v| {
        let (cos_u, sin_u) = turn(u);
        let (cos_v, sin_v) = turn(v);
        let r = radius + tube * cos_v;
        DVec3::new(r * cos_u, r * sin_u, tube * sin_v)
    })
}

/// An open tube about the z axis, from −`half` to `half`.
pub(crate) fn tube(around: usize, along: usize, radius: f64, half: f64) -> Solid {
    grid(around, along, false, |u, v| {
        let (cos_u, sin_u) = turn(u);
        DVec3::new(radius * cos_u, radius * sin_u, half * (2.0 * v - 1.0))
    })
}

/// A sphere of meridians and parallels, with a fan of triangles at each pole.
pub(crate) fn sphere(around: usize, radius: f64) -> Solid {
    let mut sphere = grid(2 * around, around, false, |u, v| {
        let (cos_u, sin_u) = turn(u);
        // The first and last parallels are slightly off the poles, which are closed by fans.
        let (cos_v, sin_v) = turn((v * 0.98 + 0.01) / 2.0);
        radius * DVec3::new(sin_v * cos_u, sin_v * sin_u, cos_v)
    });
    let (rows, last) = (around as u32 + 1, sphere.positions.len() as u32);
    sphere.positions.extend([DVec3::Z * radius, DVec3::NEG_Z * radius]);
    for i in 0..2 * around as u32 {
        let next = (i + 1) % (2 * around as u32);
        sphere.triangles.push([i * rows, next * rows, last]);
        sphere.triangles.push([next * rows + rows - 1, i * rows + rows - 1, last + 1]);
    }
    sphere
}

fn turn(fraction: f64) -> (f64, f64) {
    let angle = fraction * std::f64::consts::TAU;
    (libm::cos(angle), libm::sin(angle))
}

/// A grid of quads that is closed in u, and in v if `closed`; `place` maps the unit square to points.
fn grid(us: usize, vs: usize, closed: bool, place: impl Fn(f64, f64) -> DVec3) -> Solid {
    let rows = if closed { vs } else { vs + 1 };
    let mut solid = Solid::default();
    for i in 0..us {
        for j in 0..rows {
            solid.positions.push(place(i as f64 / us as f64, j as f64 / vs as f64));
        }
    }
    let at = |i: usize, j: usize| ((i % us) * rows + j % rows) as u32;
    for i in 0..us {
        for j in 0..vs {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            solid.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    solid
}
