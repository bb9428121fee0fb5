//! Private stages for the benches and model generators of this repository. Not part of the library's interface:
//! anything here may change without notice.

/// Geometry.
pub mod geometry {
    pub use crate::geometry::numbers::noise::{hash, unit_interval, value_noise};
}
/// Light.
pub mod light {
    pub use crate::light::{Caster, ambient_visibility};
}
/// Feature lines.
pub mod lines {
    use crate::lines::edges::edge_lines as found_along_edges;
    use crate::lines::{FeatureSegment, Surface};
    use crate::style::Style;
    use crate::view::View;

    pub use crate::lines::EdgeSearch;

    /// Lines along the edges of a surface.
    #[must_use]
    pub fn edge_lines(surface: &Surface, view: &View, style: &Style) -> Vec<FeatureSegment> {
        found_along_edges::find(surface, view, &style.lines)
    }

    /// Lines along some edges of a surface.
    #[must_use]
    pub fn edge_lines_among(
        edges: &[u32],
        surface: &Surface,
        view: &View,
        style: &Style,
    ) -> Vec<FeatureSegment> {
        found_along_edges::find_among(edges, surface, view, &style.lines)
    }
}
/// Mesh.
pub mod mesh {
    pub use crate::mesh::bvh::ToneTree;
    pub use crate::mesh::intersect::intersection_curves::{IntersectionInput, intersections};
    pub use crate::mesh::{Edges, FaceId, Mesh, Soup};
}
/// Shadows.
pub mod shadows {
    pub use crate::shadows::Shadows;
}
/// Views.
pub mod view {
    pub use crate::view::raster::{FaceBuffer, PixelGrid};
    pub use crate::view::{Frame, View};
}
/// Visibility.
pub mod visibility {
    pub use crate::visibility::ViewMap;
}

/// Edges of a mesh.
#[must_use]
pub fn edges(mesh: &mesh::Mesh) -> &mesh::Edges {
    &mesh.edges
}

/// Projection of a view.
#[must_use]
pub fn frame(view: &view::View) -> &view::Frame {
    &view.frame
}

/// Length of the diagonal of a mesh's bounding box.
#[must_use]
pub fn diagonal(mesh: &mesh::Mesh) -> f64 {
    mesh.extents.diagonal
}

/// Flags of [`SurfaceDecisions::edges`] and [`SurfaceDecisions::faces`].
pub mod decision_flags {
    /// Edge: crease.
    pub const HARD: u32 = 1;
    /// Edge: centre of a narrow fillet.
    pub const FILLET_CENTRE: u32 = 2;
    /// Edge: border of a surface that is no crease.
    pub const BORDER: u32 = 8;
    /// Edge: has two faces.
    pub const TWO_FACES: u32 = 16;
    /// Edge: drawn as a crease.
    pub const DRAWN: u32 = 32;
    /// Face: part of a curved surface.
    pub const ROUNDED: u32 = 1;
    /// Face: part of a figure or scan.
    pub const FIGURE: u32 = 2;
    /// Face: the normals of the file describe the shape.
    pub const TRUSTED: u32 = 4;
    /// Face: constructed, not scanned or modelled.
    pub const CONSTRUCTED: u32 = 8;
}

/// What is decided of each edge and face of a model.
#[derive(Debug, Clone, Default)]
pub struct SurfaceDecisions {
    /// Position of each vertex, world space.
    pub positions: Vec<[f64; 3]>,
    /// Two vertices and [`decision_flags`] of each edge.
    pub edges: Vec<[u32; 3]>,
    /// Three vertices and [`decision_flags`] of each face.
    pub faces: Vec<[u32; 4]>,
}

/// What is decided of each edge and face of a model with the default crease angle, by evidence or as by default
/// (see `lines.surfaces`).
#[must_use]
pub fn surface_decisions(scene: &crate::scene::Scene, by_evidence: bool) -> SurfaceDecisions {
    use crate::mesh::EdgeFaces;
    use crate::surface::MeshSource;
    use crate::surface::evidence::evidence_layout::patches_by_evidence;
    use decision_flags::{
        BORDER, CONSTRUCTED, DRAWN, FIGURE, FILLET_CENTRE, HARD, ROUNDED, TRUSTED, TWO_FACES,
    };
    let mut mesh = mesh::Mesh::build(scene.to_soup());
    let crease_deg = crate::lines::LineOptions::default().crease_deg;
    let patches = patches_by_evidence(&mut mesh, crease_deg, !by_evidence);
    let flag = |is: bool, flag: u32| if is { flag } else { 0 };
    let edge = |edge: usize| {
        let [a, b] = mesh.edges.vertices[edge];
        let (hard, centre) = (patches.hard.is_hard(edge), patches.fillet_centres.contains(edge));
        let flags = flag(hard, HARD)
            | flag(centre, FILLET_CENTRE)
            | flag(patches.rims.contains(edge), BORDER)
            | flag(matches!(mesh.edges.faces(edge), EdgeFaces::Two { .. }), TWO_FACES)
            | flag(hard || centre, DRAWN);
        [a, b, flags]
    };
    let face = |face: usize| {
        let [a, b, c] = mesh.triangles[face];
        let is_constructed = patches.origins.get(face).is_none_or(|o| *o == MeshSource::Constructed);
        let flags = flag(patches.rounded[face], ROUNDED)
            | flag(patches.figure[face], FIGURE)
            | flag(patches.trusts_file_normals[face], TRUSTED)
            | flag(is_constructed, CONSTRUCTED);
        [a, b, c, flags]
    };
    SurfaceDecisions {
        positions: mesh.positions.iter().map(|p| (*p + mesh.origin).to_array()).collect(),
        edges: (0..mesh.edges.len()).map(edge).collect(),
        faces: (0..mesh.triangles.len()).map(face).collect(),
    }
}

/// Number of hatching strokes of a view.
#[must_use]
pub fn hatch_strokes(renderer: &crate::pipeline::Renderer, camera: &crate::scene::Camera) -> usize {
    let page = crate::drawing::Page::px(camera.width, camera.height);
    let layers = renderer.hatch_strokes(camera, page).map(|(_, layers)| layers).unwrap_or_default();
    layers.iter().map(|layer| layer.strokes.len()).sum()
}

/// Adds a visible line of one kind through points to a map.
pub fn add_line(
    map: &mut visibility::ViewMap,
    points: &[kurbo::Point],
    closed: bool,
    kind: crate::lines::LineKind,
) {
    use crate::mesh::{MaterialId, PartId};
    use crate::surface::MeshSource::{Constructed, Scanned};
    use crate::visibility::{ViewEdge, ViewVertex, ViewVertexId, ViewVertexKind};
    let first = map.vertices.len() as u32;
    let vertex = |position: &kurbo::Point| ViewVertex {
        position: *position,
        depth: 1.0,
        strength: 1.0,
        kind: ViewVertexKind::Vertex,
    };
    map.vertices.extend(points.iter().map(vertex));
    let count = points.len() as u32;
    for k in 0..if closed { count } else { count - 1 } {
        map.edges.push(ViewEdge {
            start: ViewVertexId(first + k),
            end: ViewVertexId(first + (k + 1) % count),
            kind,
            invisibility: 0,
            silhouette: false,
            both_seen: kind == crate::lines::LineKind::Crease,
            smooth: kind == crate::lines::LineKind::Contour,
            origin: if kind == crate::lines::LineKind::Contour { Scanned } else { Constructed },
            strength: 90.0,
            part: PartId(0),
            material: MaterialId(0),
            segment: map.edges.len() as u32,
        });
    }
}

/// All triangles of a scene in world space.
#[must_use]
pub fn soup(scene: &crate::scene::Scene) -> mesh::Soup {
    scene.to_soup()
}
