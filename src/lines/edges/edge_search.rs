//! [`EdgeSearch`]: which edges of a surface may be feature lines in a view, found without asking all
//! of them.
//!
//! Source: Claes, Di Fiore, Vansichem and Van Reeth, "Fast 3D cartoon rendering with improved
//! quality by exploiting graphics hardware", IVCNZ 2001: sharp and border edges are gathered once,
//! and contours are sought in the dual space (section 4). Made once for a surface of which many views
//! are drawn. It only proposes edges, and finds the same lines as asking every edge.

use crate::lines::Surface;
use crate::mesh::bvh::{DualFound, DualTree};
use crate::mesh::{EdgeFaces, Mesh};
use crate::view::View;

/// The edges of a surface, ready for many views.
#[derive(Debug, Clone, Default)]
pub struct EdgeSearch {
    /// Edges that may be lines whatever they turn to the eye, ascending.
    fixed: Vec<u32>,
    /// Edges that can be nothing but contours, or witnesses of them.
    tree: DualTree,
    faces: usize,
    edges: usize,
}

/// What an edge may be.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Chance {
    OnlyContour,
    Other,
}

impl EdgeSearch {
    /// Sorts the edges of a surface.
    #[must_use]
    pub fn new(surface: &Surface) -> Self {
        let mesh = &surface.mesh;
        let edges = mesh.edges.len();
        let fixed = (0..edges).filter(|e| chance(surface, *e) == Chance::Other).map(|e| e as u32).collect();
        let tree = DualTree::new(mesh, |edge| chance(surface, edge) == Chance::OnlyContour);
        Self { fixed, tree, faces: mesh.triangles.len(), edges }
    }

    /// Whether this may be the search of a mesh: a refined mesh needs one of its own.
    #[must_use]
    pub fn fits(&self, mesh: &Mesh) -> bool {
        (self.faces, self.edges) == (mesh.triangles.len(), mesh.edges.len())
    }

    /// Edges that are lines or not whatever they turn to the eye: creases, borders and the like.
    #[must_use]
    pub fn fixed(&self) -> &[u32] {
        &self.fixed
    }

    /// The edges that can be nothing but contours.
    #[must_use]
    pub fn tree(&self) -> &DualTree {
        &self.tree
    }

    /// All edges of the mesh that may be lines in a view of it, ascending, and how many boxes were looked at to find them.
    #[must_use]
    pub fn candidates(&self, mesh: &Mesh, view: &View) -> DualFound {
        let mut found = self.tree.candidates(view.frame.homogeneous_eye());
        if !view.unsure.is_empty() {
            // The tree knows only the angles of these faces, which do not decide about them.
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

/// What an edge may be; the cases are those of `edge_lines`.
fn chance(surface: &Surface, edge: usize) -> Chance {
    let Surface { mesh, hard, roundings, smooth, .. } = surface;
    let EdgeFaces::Two { faces, .. } = mesh.edges.faces(edge) else { return Chance::Other };
    let is_drawn = hard.is_hard(edge) || roundings.contains(edge);
    if is_drawn || faces.iter().any(|f| mesh.face_normals[*f as usize] == [0.0; 3]) {
        return Chance::Other;
    }
    let [first, second] = faces.map(|f| mesh.face_material[f as usize]);
    if first != second {
        return Chance::Other;
    }
    let is_inner =
        faces.iter().all(|f| smooth.corners_of(*f).is_none()) || smooth.across(mesh, edge).is_some();
    if is_inner { Chance::OnlyContour } else { Chance::Other }
}
