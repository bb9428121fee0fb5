//! Rounded solids, each in a family of tessellations.

use std::collections::HashMap;

use glam::DVec3;
use libm::{cos, sin};
use ligne::scene::Geometry;

use super::solids::Solid;

/// The unit sphere from an octahedron: `8 * 4^level` triangles.
pub(crate) fn octasphere(level: u32) -> Solid {
    let positions = vec![DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
    let triangles =
        vec![[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]];
    blown_up(Solid { positions, triangles }, level)
}

/// The unit sphere from an icosahedron: `20 * 4^level` triangles.
pub(crate) fn icosphere(level: u32) -> Solid {
    let g = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let mut positions = Vec::new();
    for (s, t) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        for p in [DVec3::new(0.0, s, t * g), DVec3::new(s, t * g, 0.0), DVec3::new(t * g, 0.0, s)] {
            positions.push(p.normalize());
        }
    }
    // Its faces are the triples of vertices that are pairwise neighbours.
    let side = 1.06;
    let mut triangles = Vec::new();
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                let [p, q, r] = [a, b, c].map(|i| positions[i]);
                if p.distance(q) < side && q.distance(r) < side && r.distance(p) < side {
                    let outward = (q - p).cross(r - p).dot(p) > 0.0;
                    triangles.push(if outward { [a, b, c] } else { [a, c, b] }.map(|i| i as u32));
                }
            }
        }
    }
    blown_up(Solid { positions, triangles }, level)
}

/// Splits each triangle into four, `level` times, with new vertices on the unit sphere.
fn blown_up(mut solid: Solid, level: u32) -> Solid {
    for _ in 0..level {
        let mut middles: HashMap<[u32; 2], u32> = HashMap::new();
        let mut triangles = Vec::new();
        for [a, b, c] in std::mem::take(&mut solid.triangles) {
            let [ab, bc, ca] = [[a, b], [b, c], [c, a]].map(|[p, q]| {
                *middles.entry([p.min(q), p.max(q)]).or_insert_with(|| {
                    let sum = solid.positions[p as usize] + solid.positions[q as usize];
                    solid.positions.push(sum.normalize());
                    solid.positions.len() as u32 - 1
                })
            });
            triangles.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        solid.triangles = triangles;
    }
    solid
}

/// The unit sphere with `2 * around` meridians and `around` − 1 parallels.
pub(crate) fn globe(around: u32) -> Solid {
    let mut solid = Solid { positions: vec![DVec3::Z, DVec3::NEG_Z], ..Solid::default() };
    let meridians = 2 * around;
    let at = |i: u32, j: u32| match j {
        0 => 0,
        j if j == around => 1,
        j => 2 + (i % meridians) * (around - 1) + j - 1,
    };
    for i in 0..meridians {
        let u = std::f64::consts::PI * f64::from(i) / f64::from(around);
        for j in 1..around {
            let v = std::f64::consts::PI * f64::from(j) / f64::from(around);
            solid.positions.push(DVec3::new(sin(v) * cos(u), sin(v) * sin(u), cos(v)));
        }
        for j in 0..around {
            let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
            solid
                .triangles
                .extend([[a, b, c], [a, c, d]].into_iter().filter(|t| t[0] != t[2] && t[1] != t[2]));
        }
    }
    solid
}

/// The open saddle z = x² − y² over the square from −1 to 1, with `cells` × `cells` squares.
pub(crate) fn saddle(cells: u32) -> Solid {
    let mut solid = Solid::default();
    let at = |i: u32| 2.0 * f64::from(i) / f64::from(cells) - 1.0;
    let row = cells + 1;
    for j in 0..row {
        for i in 0..row {
            let (x, y) = (at(i), at(j));
            solid.positions.push(DVec3::new(x, y, x * x - y * y));
            if i < cells && j < cells {
                let a = j * row + i;
                solid.triangles.extend([[a, a + 1, a + row + 1], [a, a + row + 1, a + row]]);
            }
        }
    }
    solid
}

/// A capped cylinder about the z axis with radius 1, from z = −1 to 1, whose normals are split at the rims.
pub(crate) fn cylinder(around: u32, along: u32) -> Geometry {
    let mut geometry = Geometry::default();
    let angle = |i: u32| std::f64::consts::TAU * f64::from(i) / f64::from(around);
    for i in 0..around {
        let n = DVec3::new(cos(angle(i)), sin(angle(i)), 0.0);
        geometry.normals.push(n.as_vec3().to_array());
        for j in 0..=along {
            let z = 2.0 * f64::from(j) / f64::from(along) - 1.0;
            geometry.positions.push(n + DVec3::Z * z);
        }
    }
    let (up, down) = (around, around + 1);
    geometry.normals.extend([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]);
    let at = |i: u32, j: u32| (i % around) * (along + 1) + j;
    let mut add = |corners: [u32; 3], normals: [u32; 3]| {
        geometry.triangles.push(corners);
        geometry.corner_normals.push(normals);
    };
    for i in 0..around {
        let next = (i + 1) % around;
        for j in 0..along {
            add([at(i, j), at(next, j), at(next, j + 1)], [i, next, next]);
            add([at(i, j), at(next, j + 1), at(i, j + 1)], [i, next, i]);
        }
        if i > 0 && next > 0 {
            add([at(0, along), at(i, along), at(next, along)], [up; 3]);
            add([at(0, 0), at(next, 0), at(i, 0)], [down; 3]);
        }
    }
    geometry
}
