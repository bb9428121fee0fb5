//! The teapot of Martin Newell, from its published control points.
//!
//! Source: M. Newell, The utilization of procedure models in digital image synthesis, University of Utah,
//! 1975. The bottom was added later, as listed by F. Crow (The origins of the teapot, IEEE Computer Graphics
//! and Applications 7(1), 1987). Round parts consist of four quarters, so each row of control points is given
//! by radius, tangent end and height.

use glam::{DVec2, DVec3};

use crate::geometry::part::{Material, Part};
use crate::geometry::patches::{self, Net};

const STEPS: usize = 10;

const PORCELAIN: Material =
    Material { name: "porcelain", colour: [0.93, 0.91, 0.86], metallic: 0.0, roughness: 0.3 };

/// Row of a round part: radius, end of its tangents, height.
type Row = (f64, f64, f64);

const BODY: [[Row; 4]; 4] = [
    [(1.4, 0.784, 2.4), (1.3375, 0.749, 2.53125), (1.4375, 0.805, 2.53125), (1.5, 0.84, 2.4)],
    [(1.5, 0.84, 2.4), (1.75, 0.98, 1.875), (2.0, 1.12, 1.35), (2.0, 1.12, 0.9)],
    [(2.0, 1.12, 0.9), (2.0, 1.12, 0.45), (1.5, 0.84, 0.225), (1.5, 0.84, 0.15)],
    [(1.5, 0.84, 0.15), (1.5, 0.84, 0.075), (1.425, 0.798, 0.0), (0.0, 0.0, 0.0)],
];

const LID: [[Row; 4]; 2] = [
    [(0.0, 0.0, 3.15), (0.8, 0.45, 3.15), (0.0, 0.0, 2.85), (0.2, 0.112, 2.7)],
    [(0.2, 0.112, 2.7), (0.4, 0.224, 2.55), (1.3, 0.728, 2.55), (1.3, 0.728, 2.4)],
];

/// Half a row of handle or spout: the inner and the outer point (x, z), and half the width.
type HalfRow = ([f64; 2], [f64; 2], f64);

const HANDLE: [HalfRow; 7] = [
    ([-1.6, 2.025], [-1.5, 2.25], 0.3),
    ([-2.3, 2.025], [-2.5, 2.25], 0.3),
    ([-2.7, 2.025], [-3.0, 2.25], 0.3),
    ([-2.7, 1.8], [-3.0, 1.8], 0.3),
    ([-2.7, 1.575], [-3.0, 1.35], 0.3),
    ([-2.5, 1.125], [-2.65, 0.9375], 0.3),
    ([-2.0, 0.9], [-1.9, 0.6], 0.3),
];

const SPOUT: [HalfRow; 7] = [
    ([1.7, 1.425], [1.7, 0.6], 0.66),
    ([2.6, 1.425], [3.1, 0.825], 0.66),
    ([2.3, 2.1], [2.4, 2.025], 0.25),
    ([2.7, 2.4], [3.3, 2.4], 0.25),
    ([2.8, 2.475], [3.525, 2.49375], 0.25),
    ([2.9, 2.475], [3.45, 2.5125], 0.15),
    ([2.8, 2.4], [3.2, 2.4], 0.15),
];

/// The four quarters of a round part.
fn round(rows: &[[Row; 4]]) -> Vec<Net> {
    let quarter_turns = [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y];
    let quarters = |rows: &[Row; 4]| {
        let rows = *rows;
        quarter_turns.map(|way| {
            rows.map(|(radius, tangent, height)| {
                [(radius, 0.0), (radius, tangent), (tangent, radius), (0.0, radius)]
                    .map(|(along, across)| (way.rotate(DVec2::new(along, across))).extend(height))
            })
        })
    };
    rows.iter().flat_map(quarters).collect()
}

/// The four patches of handle or spout: two along it, each with its mirror image across y = 0.
fn bent(rows: &[HalfRow; 7]) -> Vec<Net> {
    let side = |first: usize, sign: f64| -> Net {
        std::array::from_fn(|i| {
            let (inner, outer, half) = rows[first + i];
            let row = [(inner, 0.0), (inner, half), (outer, half), (outer, 0.0)]
                .map(|([x, z], y)| DVec3::new(x, sign * y, z));
            // Rows of the mirror image are reversed, so that it faces outward, too.
            if sign < 0.0 { [row[3], row[2], row[1], row[0]] } else { row }
        })
    };
    [0, 3].into_iter().flat_map(|first| [side(first, 1.0), side(first, -1.0)]).collect()
}

/// Body, lid, handle and spout, z up, with one normal per point.
pub fn teapot() -> (Vec<Part>, Vec<Vec<DVec3>>) {
    // A net faces outward if its rows run counter-clockwise from above and go down.
    let named =
        [("body", round(&BODY)), ("lid", round(&LID)), ("handle", bent(&HANDLE)), ("spout", bent(&SPOUT))];
    named
        .into_iter()
        .map(|(name, nets)| {
            let (mut solid, mut normals) = patches::mesh(&nets, STEPS);
            let outwards: f64 = solid
                .triangles()
                .map(|corners| corners.map(|corner| solid.points[corner as usize]))
                .map(|[a, b, c]| (b - a).cross(c - a).dot(a))
                .sum();
            if outwards < 0.0 {
                solid.faces.iter_mut().for_each(|face| face.reverse());
                normals.iter_mut().for_each(|normal| *normal = -*normal);
            }
            (Part::new(name, PORCELAIN, solid), normals)
        })
        .unzip()
}
