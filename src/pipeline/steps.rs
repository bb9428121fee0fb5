//! Intermediate results of a drawing, each with one constructor, for programs that use a single stage.
//!
//! [`Renderer`](super::Renderer) runs the same stages, shares work between views and draws fills.

use crate::chains::{self, Chain};
use crate::drawing::Unit;
use crate::lines::{self, FeatureLines, Surface};
use crate::mesh::Mesh;
use crate::pipeline::report::mesh_defects;
use crate::scene::{Camera, Scene, Warnings};
use crate::style::Style;
use crate::view::View;
use crate::visibility::{self, ViewMap};

impl Mesh {
    /// The welded mesh of all parts of a scene, in world space.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        Self::build(scene.to_soup())
    }

    /// Defects of the mesh of a scene: open edges, repaired faces and others, with their counts.
    #[must_use]
    pub fn warnings(&self, scene: &Scene) -> Warnings {
        mesh_defects::of_mesh(self, scene)
    }
}

impl Surface {
    /// The mesh with its creases and smooth normals, as the style defines them.
    #[must_use]
    pub fn of(mesh: Mesh, style: &Style) -> Self {
        Self::new(mesh, &style.lines)
    }
}

impl View {
    /// The projection of a surface by a camera.
    #[must_use]
    pub fn of(surface: &Surface, camera: &Camera) -> Self {
        Self::new(&surface.mesh, camera)
    }
}

impl FeatureLines {
    /// All lines of the kinds that the style draws, visible or not.
    #[must_use]
    pub fn of(surface: &Surface, view: &View, style: &Style) -> Self {
        lines::extract(surface, view, &style.lines)
    }
}

impl ViewMap {
    /// The lines divided where their visibility changes. Hidden pieces are kept if the style draws them.
    #[must_use]
    pub fn of(surface: &Surface, view: &View, lines: &FeatureLines, style: &Style) -> Self {
        visibility::build(&surface.mesh, view, lines, &style.lines)
    }
}

impl Chain {
    /// The pieces of a map joined end to end, tidied, smoothed and fitted as the style says. `unit` is that of
    /// the map's points.
    #[must_use]
    pub fn link(map: &ViewMap, style: &Style, unit: Unit) -> Vec<Self> {
        chains::link(map, &style.chain, unit, style.lines.hidden)
    }
}
