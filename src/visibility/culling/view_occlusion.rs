//! [`ViewCovers`]: the covers of a view, made before its lines are known, and the faces that lie behind them.
//!
//! A face that lies behind the covers of all squares that it may meet is out of sight, and so is every line on it: where only
//! what is seen is drawn, nobody has to ask where it passes through others.

use crate::parallel::prelude::*;
use glam::{DVec2, DVec3};

use super::occlusion_buffer::Covers;
use crate::mesh::Mesh;
use crate::parallel::task_size::GRAIN;
use crate::view::View;
use crate::visibility::occlusion::tiled_triangles::Triangles;
use crate::visibility::tiles::aligned_grid::{grid_over_box, tiles_across};
use crate::visibility::tiles::tile_grid::Grid;
use crate::visibility::view_tolerances::Limits;

/// A face over more squares than this is not asked about.
const MOST_SQUARES: u32 = 256;

/// The covers of a view, and the grid of its tiles.
#[derive(Debug, Clone)]
pub struct ViewCovers {
    pub(crate) grid: Grid,
    pub(crate) covers: Covers,
}

impl ViewCovers {
    /// The covers of what is on the page; none where they would hide less than they cost.
    #[must_use]
    pub fn of(mesh: &Mesh, view: &View) -> Option<Self> {
        let (low, high) = box_on_page(view)?;
        let grid = grid_over_box(low, high, tiles_across(mesh.triangles.len()));
        let limits = Limits::new(&view.frame);
        let covers = Covers::find_soon(&Triangles { mesh, view, grid: &grid, limits: &limits });
        (!covers.is_empty()).then_some(Self { grid, covers })
    }

    /// Whether each face surely is out of sight: behind covers, or off the page. What the near plane cuts is not.
    #[must_use]
    pub fn out_of_sight(&self, mesh: &Mesh, view: &View) -> Vec<bool> {
        let is_hidden = |triangle: &[u32; 3]| {
            let points = triangle.map(|v| view.points[v as usize]);
            !points.iter().any(|p| p.z.is_nan()) && self.covers.hide(&points, MOST_SQUARES)
        };
        mesh.triangles.par_iter().with_min_len(GRAIN).map(is_hidden).collect()
    }
}

/// The box around all vertices, as far as it is on the page; the page itself where the near plane cuts faces.
fn box_on_page(view: &View) -> Option<(DVec2, DVec2)> {
    let page = DVec2::new(view.frame.width, view.frame.height);
    if !view.clipped.is_empty() {
        return Some((DVec2::ZERO, page));
    }
    let nothing = || (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = view
        .points
        .par_iter()
        .with_min_len(GRAIN)
        .filter(|p| !p.z.is_nan())
        .fold(nothing, |(low, high), p| (low.min(*p), high.max(*p)))
        .reduce(nothing, |a, b| (a.0.min(b.0), a.1.max(b.1)));
    let (low, high) = (low.truncate().max(DVec2::ZERO), high.truncate().min(page));
    (low.x <= high.x && low.y <= high.y).then_some((low, high))
}
