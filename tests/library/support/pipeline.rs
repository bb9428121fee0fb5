//! Scenes from solids, simple cameras, and all pipeline stages up to the view map in one call.

use glam::{DAffine3, DVec3};
use kurbo::Point;
use ligne::lines::{self, Contours, FeatureLines, HiddenLines, LineKind, LineOptions, Surface};
use ligne::mesh::Mesh;
use ligne::scene::{Camera, Geometry, Part, Projection, Scene};
use ligne::view::View;
use ligne::visibility::{self, ViewEdge, ViewMap};

use crate::library::support::scenes::solids::Solid;

/// Results of all pipeline stages up to the view map.
pub(crate) struct Stages {
    pub mesh: Mesh,
    pub view: View,
    pub lines: FeatureLines,
    pub map: ViewMap,
}

/// Tolerance of refined surfaces: the default of `chain.fit_tolerance`, px.
pub(crate) const REFINEMENT_TOLERANCE_PX: f64 = 0.15;

/// Options for the exact drawing of a polyhedron: contours along mesh edges, and unmerged creases.
pub(crate) fn exact_options() -> LineOptions {
    LineOptions { contours: Contours::Mesh, ..LineOptions::default() }
}

/// Options as in [`exact_options`], with hidden lines kept and their invisibility counted.
pub(crate) fn exact_options_with_hidden() -> LineOptions {
    LineOptions { hidden: HiddenLines::Dashed, ..exact_options() }
}

/// Runs the pipeline on a scene up to the view map.
pub(crate) fn run_stages(scene: &Scene, camera: &Camera, options: &LineOptions) -> Stages {
    let surface =
        Surface::new(Mesh::build(scene.to_soup()), options).finer_for(camera, REFINEMENT_TOLERANCE_PX);
    let view = View::new(&surface.mesh, camera);
    let lines = lines::extract(&surface, &view, options);
    let map = visibility::build(&surface.mesh, &view, &lines, options);
    Stages { mesh: surface.mesh, view, lines, map }
}

impl Stages {
    /// The image positions of a view edge's two ends, px.
    pub(crate) fn edge_ends(&self, edge: &ViewEdge) -> [Point; 2] {
        [edge.start, edge.end].map(|v| self.map.vertices[v.index()].position)
    }

    /// The visible view edges, as image segments.
    pub(crate) fn visible_segments(&self) -> Vec<[Point; 2]> {
        self.map.edges.iter().filter(|e| e.invisibility == 0).map(|e| self.edge_ends(e)).collect()
    }

    /// The visible view edges of one kind, as image segments.
    pub(crate) fn visible_segments_of_kind(&self, kind: LineKind) -> Vec<[Point; 2]> {
        let of_kind = |e: &&ViewEdge| e.kind == kind && e.invisibility == 0;
        self.map.edges.iter().filter(of_kind).map(|e| self.edge_ends(e)).collect()
    }

    /// The visible silhouette edges: those with background on one side.
    pub(crate) fn silhouette_segments(&self) -> Vec<[Point; 2]> {
        let of_outline = |e: &&ViewEdge| e.silhouette && e.invisibility == 0;
        self.map.edges.iter().filter(of_outline).map(|e| self.edge_ends(e)).collect()
    }

    /// The hidden view edges, as image segments.
    pub(crate) fn hidden_segments(&self) -> Vec<[Point; 2]> {
        self.map.edges.iter().filter(|e| e.invisibility > 0).map(|e| self.edge_ends(e)).collect()
    }
}

/// A geometry with the positions and triangles of a solid.
pub(crate) fn solid_geometry(solid: Solid) -> Geometry {
    Geometry { positions: solid.positions, triangles: solid.triangles, ..Geometry::default() }
}

/// A scene with one part per geometry, each placed by the identity transform.
pub(crate) fn scene_of_geometries(geometries: Vec<Geometry>) -> Scene {
    let part = |geometry: usize| Part {
        name: format!("part {geometry}"),
        geometry,
        world_from_part: DAffine3::IDENTITY,
    };
    Scene { parts: (0..geometries.len()).map(part).collect(), geometries, ..Scene::default() }
}

/// A scene with one part per solid.
pub(crate) fn scene(solids: impl IntoIterator<Item = Solid>) -> Scene {
    scene_of_geometries(solids.into_iter().map(solid_geometry).collect())
}

/// A perspective camera with a frame of 1000 x 1000 px.
pub(crate) fn perspective(eye: DVec3, target: DVec3, fov_y_deg: f64) -> Camera {
    look_at_camera(eye, target, Projection::Perspective { fov_y_deg })
}

/// An orthographic camera with a frame of 1000 x 1000 px; `height` is in world units.
pub(crate) fn orthographic(eye: DVec3, target: DVec3, height: f64) -> Camera {
    look_at_camera(eye, target, Projection::Orthographic { height })
}

fn look_at_camera(eye: DVec3, target: DVec3, projection: Projection) -> Camera {
    let axis = (target - eye).normalize();
    let up = if axis.cross(DVec3::Y).length() < 0.1 { DVec3::X } else { DVec3::Y };
    Camera { eye, target, up, projection, width: 1000.0, height: 1000.0, near: None }
}
