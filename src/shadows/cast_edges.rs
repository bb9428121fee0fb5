//! [`CastEdge`]: a piece of a contour or border visible from a light, which casts a shadow behind it.

use glam::{DVec2, DVec3};
use kurbo::Point;

use super::light_views::LightView;
use crate::lines::{self, Contours, HiddenLines, LineKind, LineOptions, NO_FACE, Surface};
use crate::mesh::Mesh;
use crate::view::View;
use crate::visibility::projection::image_segments::between;
use crate::visibility::{self, ViewMap, ViewVertexId};

/// Piece of a contour or border visible from a light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CastEdge {
    /// Start in the light's image space.
    pub a: DVec3,
    /// End in the light's image space.
    pub b: DVec3,
    /// Vertices of the mesh edge it is a piece of.
    pub vertices: [u32; 2],
    /// Whether it starts and ends at those vertices.
    pub whole: [bool; 2],
    /// Faces that meet in it.
    pub hosts: [u32; 2],
    /// Vertices of the light's view map at its start and end.
    pub nodes: [u32; 2],
    /// Unit vector across it in the image, away from its faces.
    pub outward: DVec2,
}

impl CastEdge {
    /// The image-space point at parameter `t`, 0 to 1.
    #[inline]
    pub(crate) fn at(&self, t: f64) -> DVec3 {
        between(self.a, self.b, t)
    }
}

/// Options for contours along mesh edges and for borders, where the depth seen from a light may jump.
fn options() -> LineOptions {
    LineOptions {
        kinds: vec![LineKind::Contour, LineKind::Border],
        contours: Contours::Mesh,
        hidden: HiddenLines::None,
        ..LineOptions::default()
    }
}

/// All edges that cast the shadow of a light.
pub(crate) fn edges(surface: &Surface, light: &LightView) -> Vec<CastEdge> {
    let Surface { mesh, .. } = surface;
    let view = &light.view;
    let options = options();
    let lines = lines::extract(surface, view, &options);
    let map = visibility::build(mesh, view, &lines, &options);
    let mut found = Vec::new();
    for edge in &map.edges {
        // Behind a silhouette there is no surface for a shadow to fall on.
        if edge.invisibility > 0 || (edge.silhouette && edge.kind == LineKind::Contour) {
            continue;
        }
        let source = &lines.segments[edge.segment as usize];
        let [a, b] = [edge.start, edge.end].map(|v| image_point(&map, view, v));
        let whole = [(a, source.ends[0]), (b, source.ends[1])]
            .map(|(p, end)| view.points.get(end as usize).is_some_and(|own| own.truncate() == p.truncate()));
        let mut cast = CastEdge {
            a,
            b,
            vertices: source.ends,
            whole,
            hosts: source.hosts,
            nodes: [edge.start, edge.end].map(|v| v.0),
            outward: DVec2::ZERO,
        };
        if let Some(outward) = outward(mesh, view, &cast) {
            cast.outward = outward;
            found.push(cast);
        }
    }
    found
}

fn image_point(map: &ViewMap, view: &View, vertex: ViewVertexId) -> DVec3 {
    let vertex = &map.vertices[vertex.index()];
    let Point { x, y } = vertex.position;
    DVec3::new(x, y, if view.frame.perspective { 1.0 / vertex.depth } else { -vertex.depth })
}

/// Unit vector across an edge, away from the host that extends farthest from it. `None` for a point, or where
/// no host extends to either side.
fn outward(mesh: &Mesh, view: &View, edge: &CastEdge) -> Option<DVec2> {
    let across = (edge.b - edge.a).truncate().perp().try_normalize()?;
    let mut farthest = 0.0_f64;
    for face in edge.hosts.iter().filter(|face| **face != NO_FACE) {
        let Some(third) = mesh.apex(*face, edge.vertices) else { continue };
        let height = (view.points[third as usize] - edge.a).truncate().dot(across);
        if height.abs() > farthest.abs() {
            farthest = height;
        }
    }
    if farthest > 0.0 {
        Some(-across)
    } else if farthest < 0.0 {
        Some(across)
    } else {
        None
    }
}
