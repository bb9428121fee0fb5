//! A seated bear of soft blobs, in few triangles: what a smooth shape looks like when its mesh is coarse.
//!
//! Source: G. Wyvill, C. McPheeters and B. Wyvill, Data structure for soft objects, The Visual Computer
//! 1986, for blobs of bounded reach; S. Gibson, Constrained elastic surface nets, MICCAI 1998, for the
//! mesh with one vertex a cell, here moved onto the surface.

use std::collections::BTreeMap;

use glam::{DVec3, IVec3};

use crate::geometry::solid::Solid;

/// Edge of a cell.
const CELL: f64 = 0.27;
/// Where the sum of all blobs is this, the surface lies.
const LEVEL: f64 = 0.3;

/// A blob: middle and half-axes of what it reaches.
type Blob = ([f64; 3], [f64; 3]);

/// Blobs in the plane of symmetry: body, head, snout.
const MIDDLE: [Blob; 3] = [
    ([0.0, 0.05, 0.88], [1.02, 0.92, 1.3]),
    ([0.0, -0.08, 2.22], [0.95, 0.86, 0.86]),
    ([0.0, -0.64, 2.06], [0.5, 0.56, 0.46]),
];
/// Blobs to the right, an ear, an arm and a leg; each has its twin on the left.
const RIGHT: [Blob; 5] = [
    ([0.58, 0.05, 2.78], [0.5, 0.46, 0.5]),
    ([0.8, -0.12, 1.3], [0.62, 0.5, 0.46]),
    ([1.2, -0.2, 1.42], [0.5, 0.5, 0.48]),
    ([0.62, -0.45, 0.26], [0.66, 0.8, 0.56]),
    ([0.88, -1.02, 0.34], [0.58, 0.58, 0.68]),
];

/// All blobs with the gradient of their sum; both in one, since the one follows from the other.
fn field(at: DVec3) -> (f64, DVec3) {
    let twins = RIGHT.iter().flat_map(|(middle, axes)| {
        let [x, y, z] = *middle;
        [([x, y, z], *axes), ([-x, y, z], *axes)]
    });
    let mut sum = (-LEVEL, DVec3::ZERO);
    for (middle, axes) in MIDDLE.into_iter().chain(twins) {
        let axes = DVec3::from(axes);
        let offset = (at - DVec3::from(middle)) / axes;
        let rest = 1.0 - offset.length_squared();
        if rest > 0.0 {
            sum.0 += rest * rest * rest;
            sum.1 -= 6.0 * rest * rest * offset / axes;
        }
    }
    sum
}

fn corner(cell: IVec3) -> DVec3 {
    // Half a cell aside, so that the plane of symmetry runs through the middle of cells.
    (cell.as_dvec3() + DVec3::new(0.5, 0.37, 0.21)) * CELL
}

/// The vertex of a cell: the mean of where its edges are crossed, moved onto the surface.
fn vertex(cell: IVec3) -> DVec3 {
    let mut crossed = (DVec3::ZERO, 0.0);
    for axis in IVec3::AXES {
        let others = IVec3::AXES.into_iter().filter(|other| *other != axis).collect::<Vec<_>>();
        for k in 0..4 {
            let from = cell + others[0] * (k & 1) + others[1] * (k >> 1);
            let (a, b) = (corner(from), corner(from + axis));
            let (at_a, at_b) = (field(a).0, field(b).0);
            if (at_a > 0.0) != (at_b > 0.0) {
                crossed.0 += a.lerp(b, at_a / (at_a - at_b));
                crossed.1 += 1.0;
            }
        }
    }
    let mut at = crossed.0 / crossed.1;
    for _ in 0..8 {
        let (value, gradient) = field(at);
        at -= gradient * (value / gradient.length_squared());
    }
    at
}

/// The bear, z up and looking along −y, and its exact normals.
pub fn bear() -> (Solid, Vec<DVec3>) {
    let (low, high) = (IVec3::new(-9, -11, -3), IVec3::new(9, 8, 17));
    let mut solid = Solid::default();
    let mut ids: BTreeMap<[i32; 3], u32> = BTreeMap::new();
    for z in low.z..high.z {
        for y in low.y..high.y {
            for x in low.x..high.x {
                let cell = IVec3::new(x, y, z);
                for (k, axis) in IVec3::AXES.into_iter().enumerate() {
                    let ends = [corner(cell), corner(cell + axis)].map(|at| field(at).0 > 0.0);
                    if ends[0] == ends[1] {
                        continue;
                    }
                    // Round the edge, counter-clockwise seen from its far end.
                    let (u, v) = (IVec3::AXES[(k + 1) % 3], IVec3::AXES[(k + 2) % 3]);
                    let mut quad = [cell - u - v, cell - v, cell, cell - u]
                        .map(|cell| *ids.entry(cell.to_array()).or_insert_with(|| solid.point(vertex(cell))));
                    if ends[1] {
                        quad.reverse();
                    }
                    let [a, b, c, d] = quad.map(|id| solid.points[id as usize]);
                    if a.distance_squared(c) > b.distance_squared(d) {
                        quad.rotate_left(1);
                    }
                    let [a, b, c, d] = quad;
                    solid.faces.extend([vec![a, b, c], vec![a, c, d]]);
                }
            }
        }
    }
    let normals = solid.points.iter().map(|at| -field(*at).1.normalize()).collect();
    (solid, normals)
}
