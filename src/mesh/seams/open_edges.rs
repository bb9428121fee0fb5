//! [`OpenEdge`]: a side of a face that no other face of its part shares, and the tests whether two of them lie
//! along each other.

use super::sagitta::MIN_SEAM_COSINE;
use crate::geometry::space::triangles::unit_normal;
use crate::mesh::edges::triangle_sides::sides;
use crate::parallel::prelude::*;
use glam::DVec3;

use crate::mesh::soup::Soup;
use crate::mesh::tolerances;
use crate::mesh::{EdgeFaces, Edges, PartId};
use crate::parallel::task_size::MIN_TASK_ITEMS;

/// Maximum cosine (120 degrees) between the normals of faces that fold back onto each other. Such edges form
/// a seam only if their borders separate at a common corner and meet again at another.
const MAX_FOLD_COSINE: f64 = -0.5;

/// Side of a face that no other face of the part shares.
pub(crate) struct OpenEdge {
    /// Its vertices, in the order of the face.
    pub ends: [u32; 2],
    pub face: u32,
    pub part: PartId,
    /// Whether faces of other parts share it.
    pub is_shared: bool,
    /// Unit direction from the first to the second vertex.
    pub along: DVec3,
    pub length: f64,
    pub normal: DVec3,
    /// Paint at its ends.
    pub paint: [CornerPaint; 2],
}

/// Texture coordinates and colour at a corner of a face.
pub(crate) type CornerPaint = (Option<[f32; 2]>, Option<[f32; 3]>);

/// The sides of faces that no other face of the same part shares. Other parts may touch there.
pub(crate) fn open_edges(soup: &Soup, edges: &Edges) -> Vec<OpenEdge> {
    let part = |face: u32| soup.triangle_part.get(face as usize).copied().unwrap_or_default();
    let open = |edge: usize, face: u32, is_shared: bool| {
        let triangle = soup.triangles[face as usize];
        let [lo, hi] = edges.vertices[edge];
        let ends = sides(triangle).into_iter().find(|side| [[lo, hi], [hi, lo]].contains(side))?;
        let side = soup.positions[ends[1] as usize] - soup.positions[ends[0] as usize];
        let normal = unit_normal(triangle.map(|v| soup.positions[v as usize]));
        let along = side.normalize_or_zero();
        let paint = ends.map(|v| painted(soup, face, v));
        Some(OpenEdge {
            ends,
            face,
            part: part(face),
            is_shared,
            along,
            length: side.length(),
            normal,
            paint,
        })
    };
    let sides = |edge: usize| {
        let (border_faces, more) = match edges.faces(edge) {
            EdgeFaces::One(face) => ([Some(face), None], &[][..]),
            EdgeFaces::Two { faces: [a, b], .. } if part(a) == part(b) => ([None; 2], &[][..]),
            EdgeFaces::Two { faces, .. } => (faces.map(Some), &[][..]),
            EdgeFaces::Many(faces) => ([None; 2], faces),
        };
        let is_shared = border_faces[0].is_none() || border_faces[1].is_some();
        let is_alone =
            |face: &u32| more.iter().filter(|other_face| part(**other_face) == part(*face)).count() == 1;
        let alone = more.iter().copied().filter(is_alone);
        border_faces.into_iter().flatten().chain(alone).filter_map(move |face| open(edge, face, is_shared))
    };
    (0..edges.len()).into_par_iter().with_min_len(MIN_TASK_ITEMS).flat_map_iter(sides).collect()
}

pub(crate) fn painted(soup: &Soup, face: u32, vertex: u32) -> CornerPaint {
    let face = face as usize;
    let Some(corner) = soup.triangles[face].iter().position(|v| *v == vertex) else { return (None, None) };
    let uv = soup.corner_uvs.get(face).and_then(|ids| soup.uvs.get(ids[corner] as usize));
    (uv.copied(), soup.corner_colours.get(face).map(|colours| colours[corner]))
}

impl OpenEdge {
    /// Whether another open edge of the part runs in the opposite direction.
    pub(crate) fn runs_against(&self, other: &Self) -> bool {
        other.face != self.face && other.part == self.part && other.along.dot(self.along) < -MIN_SEAM_COSINE
    }

    /// Whether the surface would fold back across a seam with another open edge.
    pub(crate) fn folds(&self, other: &Self) -> bool {
        other.normal.dot(self.normal) <= MAX_FOLD_COSINE
    }

    /// Whether another open edge may be the other side of a seam: opposite in direction, without a fold.
    pub(crate) fn faces_across(&self, other: &Self) -> bool {
        self.runs_against(other) && !self.folds(other)
    }

    /// Whether the paint of a corner at parameter `t` matches the paint interpolated between both ends.
    pub(crate) fn matches_paint(&self, t: f64, corner: CornerPaint) -> bool {
        fn alike<const N: usize>(t: f64, ends: [Option<[f32; N]>; 2], corner: Option<[f32; N]>) -> bool {
            match (ends, corner) {
                ([Some(a), Some(b)], Some(c)) => {
                    let difference = |k: usize| (a[k] + (b[k] - a[k]) * t as f32 - c[k]).abs();
                    (0..N).all(|k| difference(k) <= tolerances::MAX_SEAM_PAINT_DIFFERENCE)
                }
                ([a, b], c) => a.is_none() && b.is_none() && c.is_none(),
            }
        }
        alike(t, self.paint.map(|p| p.0), corner.0) && alike(t, self.paint.map(|p| p.1), corner.1)
    }
}
