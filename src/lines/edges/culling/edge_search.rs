//! [`EdgeSearch`]: candidate edges for feature lines of a view, found without testing all edges.
//!
//! Only for speed: built once for a surface with many views, and gives the same lines as a test of every
//! edge. Edges that are lines from every viewpoint are listed once; contours are searched in dual space.
//! Source: Claes, Di Fiore, Vansichem and Van Reeth, "Fast 3D cartoon rendering with improved quality by
//! exploiting graphics hardware", IVCNZ 2001, section 4.

use crate::lines::Surface;
use crate::mesh::bvh::{DualCandidates, DualTree};
use crate::mesh::{EdgeFaces, Mesh};
use crate::view::View;

/// Edges of a surface, sorted for many views.
#[derive(Debug, Clone, Default)]
pub struct EdgeSearch {
    /// Edges that may be lines from every viewpoint, ascending.
    fixed: Vec<u32>,
    /// Edges that can only be contours.
    tree: DualTree,
    faces: usize,
    edges: usize,
}

/// Kinds of line that an edge may be.
#[derive(Clone, Copy, PartialEq, Eq)]
enum EdgePotential {
    ContourOnly,
    Other,
}

impl EdgeSearch {
    /// Sorts the edges of a surface.
    #[must_use]
    pub fn new(surface: &Surface) -> Self {
        let mesh = &surface.mesh;
        let edges = mesh.edges.len();
        let fixed = (0..edges)
            .filter(|e| edge_potential(surface, *e) == EdgePotential::Other)
            .map(|e| e as u32)
            .collect();
        let tree = DualTree::new(mesh, |edge| edge_potential(surface, edge) == EdgePotential::ContourOnly);
        Self { fixed, tree, faces: mesh.triangles.len(), edges }
    }

    /// Whether the search matches a mesh by its counts. A refined mesh needs a new search.
    #[must_use]
    pub fn fits(&self, mesh: &Mesh) -> bool {
        (self.faces, self.edges) == (mesh.triangles.len(), mesh.edges.len())
    }

    /// Edges that may be lines from every viewpoint, such as creases and borders.
    #[must_use]
    pub fn fixed(&self) -> &[u32] {
        &self.fixed
    }

    /// Edges that can only be contours.
    #[must_use]
    pub fn tree(&self) -> &DualTree {
        &self.tree
    }

    /// All edges that may be lines in a view, ascending, and the number of boxes that were visited.
    #[must_use]
    pub fn candidates(&self, mesh: &Mesh, view: &View) -> DualCandidates {
        let mut found = self.tree.candidates(view.frame.homogeneous_eye());
        if !view.unsure.is_empty() {
            // For these faces the angles in the tree are not reliable.
            let sides = |face: &u32| {
                let [a, b, c] = mesh.triangles[*face as usize];
                [[a, b], [b, c], [c, a]].map(|[v, w]| [v.min(w), v.max(w)])
            };
            let edges = view.unsure.iter().flat_map(sides);
            found
                .items
                .extend(edges.filter_map(|e| mesh.edges.vertices.binary_search(&e).ok()).map(|e| e as u32));
            found.items.sort_unstable();
            found.items.dedup();
        }
        let (mut sorted, mut fixed) =
            (Vec::with_capacity(found.items.len() + self.fixed.len()), self.fixed.iter().copied().peekable());
        for edge in found.items {
            while let Some(before) = fixed.next_if(|f| *f < edge) {
                sorted.push(before);
            }
            sorted.push(edge);
        }
        sorted.extend(fixed);
        sorted.dedup();
        found.items = sorted;
        found
    }
}

/// Kinds of line that an edge may be; mirrors the cases of `edge_lines`.
fn edge_potential(surface: &Surface, edge: usize) -> EdgePotential {
    let Surface { mesh, hard, fillet_centres: roundings, smooth, .. } = surface;
    let EdgeFaces::Two { faces, .. } = mesh.edges.faces(edge) else { return EdgePotential::Other };
    let is_drawn = hard.is_hard(edge) || roundings.contains(edge);
    if is_drawn || faces.iter().any(|f| mesh.face_normals[*f as usize] == [0.0; 3]) {
        return EdgePotential::Other;
    }
    let [first, second] = faces.map(|f| mesh.face_material[f as usize]);
    if first != second {
        return EdgePotential::Other;
    }
    let is_inner =
        faces.iter().all(|f| smooth.corners_of(*f).is_none()) || smooth.across(mesh, edge).is_some();
    if is_inner { EdgePotential::ContourOnly } else { EdgePotential::Other }
}
