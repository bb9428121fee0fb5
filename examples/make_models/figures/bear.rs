//! A seated bear made of soft blobs: a smooth shape with a coarse mesh.
//!
//! Sources: G. Wyvill, C. McPheeters and B. Wyvill, Data structure for soft objects, The Visual Computer 1986
//! (blobs of limited radius); S. Gibson, Constrained elastic surface nets, MICCAI 1998 (a mesh with one
//! vertex per cell). Deviation: vertices are moved onto the surface.

use std::collections::BTreeMap;

use glam::{DVec3, IVec3};

use crate::geometry::solid::Solid;

/// Edge length of a cell.
const CELL: f64 = 0.27;
/// Iso-value of the surface in the sum of all blobs.
const LEVEL: f64 = 0.3;

/// Blob: centre and half-axes of its extent.
type Blob = ([f64; 3], [f64; 3]);

/// Blobs in the plane of symmetry: body, head, snout.
const MIDDLE: [Blob; 3] = [
    ([0.0, 0.05, 0.88], [1.02, 0.92, 1.3]),
    ([0.0, -0.08, 2.22], [0.95, 0.86, 0.86]),
    ([0.0, -0.64, 2.06], [0.5, 0.56, 0.46]),
];
/// Blobs on the right side: an ear, an arm and a leg. Each is mirrored to the left.
const RIGHT: [Blob; 5] = [
    ([0.58, 0.05, 2.78], [0.5, 0.46, 0.5]),
    ([0.8, -0.12, 1.3], [0.62, 0.5, 0.46]),
    ([1.2, -0.2, 1.42], [0.5, 0.5, 0.48]),
    ([0.62, -0.45, 0.26], [0.66, 0.8, 0.56]),
    ([0.88, -1.02, 0.34], [0.58, 0.58, 0.68]),
];

/// Value and gradient of the sum of all blobs.
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
    // Shifted by half a cell, so that the plane of symmetry runs through cell centres.
    (cell.as_dvec3() + DVec3::new(0.5, 0.37, 0.21)) * CELL
}

/// Vertex of a cell: the mean of the crossings of its edges, moved onto the surface.
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

/// The bear, z up and facing −y, with its exact normals.
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
                    // Around the edge, counter-clockwise as seen from its far end.
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
