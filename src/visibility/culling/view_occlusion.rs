//! [`ViewOcclusionBuffer`]: an occlusion buffer made before the lines of a view are known, and the faces it hides.
//!
//! A face behind the buffer in all squares that it may meet is out of sight, and so is every line on it.
//! Where only visible lines are drawn, its intersections need not be computed.

use crate::parallel::prelude::*;
use glam::{DVec2, DVec3};

use super::occlusion_buffer::OcclusionBuffer;
use crate::mesh::Mesh;
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::view::View;
use crate::visibility::occlusion::tiled_triangles::TiledTriangles;
use crate::visibility::tiles::aligned_grid::{grid_over_box, tiles_across};
use crate::visibility::tiles::tile_grid::TileGrid;
use crate::visibility::view_tolerances::ViewTolerances;

/// Largest number of squares tested for a face.
const MAX_FACE_CELLS: u32 = 256;

/// Occlusion buffer of a view, with its grid of tiles.
#[derive(Debug, Clone)]
pub(crate) struct ViewOcclusionBuffer {
    pub(crate) grid: TileGrid,
    pub(crate) covers: OcclusionBuffer,
}

impl ViewOcclusionBuffer {
    /// Fills the buffer with everything on the page; `None` where it would cost more than it saves.
    #[must_use]
    pub(crate) fn of(mesh: &Mesh, view: &View) -> Option<Self> {
        let (low, high) = box_on_page(view)?;
        let grid = grid_over_box(low, high, tiles_across(mesh.triangles.len()));
        let limits = ViewTolerances::new(&view.frame);
        let covers =
            OcclusionBuffer::find_before_lines(&TiledTriangles { mesh, view, grid: &grid, limits: &limits });
        (!covers.is_empty()).then_some(Self { grid, covers })
    }

    /// Whether each face is certainly out of sight: behind the buffer or off the page. Faces cut by the near
    /// plane are not.
    #[must_use]
    pub(crate) fn occluded_faces(&self, mesh: &Mesh, view: &View) -> Vec<bool> {
        let is_hidden = |triangle: &[u32; 3]| {
            let points = triangle.map(|v| view.points[v as usize]);
            !points.iter().any(|p| p.z.is_nan()) && self.covers.hides_triangle(&points, MAX_FACE_CELLS)
        };
        mesh.triangles.par_iter().with_min_len(MIN_TASK_ITEMS).map(is_hidden).collect()
    }
}

/// Bounding box of all vertices, clipped to the page; the page itself where the near plane cuts faces.
fn box_on_page(view: &View) -> Option<(DVec2, DVec2)> {
    let page = DVec2::new(view.frame.width, view.frame.height);
    if !view.clipped.is_empty() {
        return Some((DVec2::ZERO, page));
    }
    let nothing = || (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = view
        .points
        .par_iter()
        .with_min_len(MIN_TASK_ITEMS)
        .filter(|p| !p.z.is_nan())
        .fold(nothing, |(low, high), p| (low.min(*p), high.max(*p)))
        .reduce(nothing, |a, b| (a.0.min(b.0), a.1.max(b.1)));
    let (low, high) = (low.truncate().max(DVec2::ZERO), high.truncate().min(page));
    (low.x <= high.x && low.y <= high.y).then_some((low, high))
}
