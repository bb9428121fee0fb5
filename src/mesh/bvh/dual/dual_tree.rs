//! [`DualTree`]: finds the edges of a mesh that may be contours for a camera, without testing all edges.
//!
//! The plane of a face is a point in four dimensions: its unit normal and its offset. An edge is the pair of
//! points of its two faces. A camera position in homogeneous coordinates is a hyperplane through the origin,
//! and contours are the pairs that it separates. The tree returns candidates; the caller tests the faces.
//!
//! Source: Claes, Di Fiore, Vansichem and Van Reeth, "Fast 3D cartoon rendering with improved quality by
//! exploiting graphics hardware", IVCNZ 2001, section 4.

use crate::parallel::prelude::*;
use glam::{DVec3, DVec4};

use super::dual_boxes::{DualBoxes, DualCandidates, DualItem};
use crate::mesh::tolerances;
use crate::mesh::{EdgeFaces, FaceId, Mesh};

/// Squared areas above this, or below its inverse, lose precision. Edges of such faces are always candidates.
const MAX_SQUARED_AREA: f64 = 1e180;

/// Edges of a mesh, indexed by the planes of their two faces.
#[derive(Debug, Clone, Default)]
pub struct DualTree {
    boxes: DualBoxes,
    /// Edges that are always candidates, ascending.
    always: Vec<u32>,
    /// Unit of length for offsets.
    radius: f64,
    len: usize,
}

impl DualTree {
    /// Builds the tree over the edges for which `active` holds.
    ///
    /// Edges that do not join two faces with area are always candidates.
    #[must_use]
    pub fn new(mesh: &Mesh, active: impl Fn(usize) -> bool + Sync) -> Self {
        let radius = mesh.extents.ball().1;
        // The same operations as in the contour test, so that rounding is identical.
        let plane = |face: u32| {
            let [a, b, c] = mesh.corners(FaceId(face));
            let normal = (b - a).cross(c - a);
            let square = normal.length_squared();
            let sound = |x: f64| x < MAX_SQUARED_AREA && x > 1.0 / MAX_SQUARED_AREA;
            if mesh.is_degenerate(FaceId(face)) || !sound(square) || !sound(square * radius * radius) {
                return None;
            }
            let unit = normal / square.sqrt();
            Some(unit.extend(-unit.dot(a) / radius))
        };
        let planes: Vec<Option<DVec4>> =
            (0..mesh.triangles.len() as u32).into_par_iter().with_min_len(1 << 10).map(plane).collect();
        let plane = |face: u32| planes[face as usize];
        let placed: Vec<Result<DualItem, u32>> = (0..mesh.edges.len())
            .into_par_iter()
            .with_min_len(1 << 10)
            .filter(|edge| active(*edge))
            .map(|edge| {
                let id = edge as u32;
                let EdgeFaces::Two { faces, same_way } = mesh.edges.faces(edge) else { return Err(id) };
                let (Some(p), Some(q)) = (plane(faces[0]), plane(faces[1])) else { return Err(id) };
                let q = if same_way { -q } else { q };
                Ok(DualItem { low: p.min(q), high: p.max(q), id })
            })
            .collect();
        let always: Vec<u32> = placed.iter().filter_map(|p| p.err()).collect();
        let len = placed.len();
        let items: Vec<DualItem> = placed.into_iter().flatten().collect();
        Self { boxes: DualBoxes::new(items), always, radius, len }
    }

    /// Number of edges.
    #[must_use]
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether the tree has no edges.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Number of cubes of the tree.
    #[must_use]
    pub fn cubes(&self) -> usize {
        self.boxes.cubes()
    }

    /// All edges that may be contours. May contain others.
    ///
    /// `eye` is in homogeneous coordinates, local space: a point with w = 1, or with w = 0 the direction
    /// towards a camera at infinity. For an edge that is not returned, both faces turn the same side to the
    /// camera (different sides if they run along the edge in the same direction), and neither is seen
    /// edge-on.
    #[must_use]
    pub fn candidates(&self, eye: DVec4) -> DualCandidates {
        // Normal of the hyperplane of the camera. Offsets are in units of the radius.
        let plane = if eye.w == 0.0 { eye } else { (eye.truncate() / self.radius).extend(1.0) };
        let reach = plane.truncate().length() + plane.w;
        let margin = tolerances::EDGE_ON_PLANE_OF_REACH * reach;
        // Outside this range, products in the computation of a face may overflow.
        let mut found = if reach < 1e40 && reach > tolerances::MIN_DUAL_PLANE_SIZE {
            self.boxes.find(plane, -margin, margin)
        } else {
            self.boxes.find(DVec4::ZERO, 0.0, 0.0)
        };
        if !self.always.is_empty() {
            found.items.extend(&self.always);
            found.items.sort_unstable();
        }
        found
    }
}

/// Triangles of a curved surface, indexed by their corner normals, to find those that may contain a tone
/// border.
///
/// Source: section 4 of the same paper. A tone border is a plane in the space of normals. Triangles whose
/// corners it separates contain a part of the border.
#[derive(Debug, Clone, Default)]
pub struct ToneTree {
    boxes: DualBoxes,
    len: usize,
}

impl ToneTree {
    /// Builds the tree from the unit normals at the corners of each triangle.
    ///
    /// The boxes cover both interpolated normals and renormalised ones.
    #[must_use]
    pub fn new(corner_normals: &[[DVec3; 3]]) -> Self {
        let items: Vec<DualItem> = corner_normals
            .par_iter()
            .copied()
            .enumerate()
            .map(|(id, normals)| {
                let [a, b, c] = normals;
                let (mut low, mut high) = (a.min(b).min(c), a.max(b).max(c));
                let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
                // |m|² = Σ wᵢ|nᵢ|² − Σ wᵢwⱼ|nᵢ − nⱼ|² for m = Σ wᵢnᵢ, and the last sum of weights is at most
                // a third. Normalisation moves m by 1 − |m|.
                let shortest = (1.0 - longest / 3.0).max(0.0).sqrt();
                let widen = 1.0 - shortest + tolerances::EDGE_ON_PLANE_OF_REACH;
                let is_unit =
                    |n: &DVec3| (n.length_squared() - 1.0).abs() <= tolerances::MAX_UNIT_LENGTH_ERROR;
                let are_units = normals.iter().all(is_unit);
                if shortest <= 0.1 || !are_units {
                    // Normals in opposite directions, or zero.
                    (low, high) = (DVec3::NEG_ONE, DVec3::ONE);
                }
                let (low, high) = ((low - widen).max(DVec3::NEG_ONE), (high + widen).min(DVec3::ONE));
                DualItem { low: low.extend(0.0), high: high.extend(0.0), id: id as u32 }
            })
            .collect();
        Self { len: items.len(), boxes: DualBoxes::new(items) }
    }

    /// Number of triangles.
    #[must_use]
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether the tree has no triangles.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The triangles where L·n may take the value `level`, for the unit vector `towards_light`.
    #[must_use]
    pub fn candidates(&self, towards_light: DVec3, level: f64) -> DualCandidates {
        let margin = tolerances::EDGE_ON_PLANE_OF_REACH * 2.0;
        self.boxes.find(towards_light.extend(0.0), level - margin, level + margin)
    }
}
