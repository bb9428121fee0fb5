//! [`TriangleBlocks`]: lookup of the triangles over a few tiles, by blocks of triangles.
//!
//! Gaps are queried several times per view. Faces are stored in spatial order, so the squares that each block
//! of faces meets are computed once for all queries. Most blocks are then skipped as a whole.

use crate::parallel::prelude::*;
use glam::{DVec2, DVec3};

use crate::geometry::lists::csr_lists::{CsrLists, csr_lists_from_pairs};
use crate::mesh::Mesh;
use crate::view::View;
use crate::visibility::occlusion::tiled_triangles::{TiledTriangles, corners};
use crate::visibility::tiles::tile_grid::{TileBox, TileGrid};
use crate::visibility::tiles::tile_set::TileSet;
use crate::visibility::tolerances;
use crate::visibility::view_tolerances::ViewTolerances;

/// Squares along the longer side of the frame.
const CELLS_ACROSS: u32 = 256;

/// Triangles per block.
const TRIANGLES_PER_BLOCK: usize = 32;

/// Squares of the frame that the bounding box of each block of triangles meets.
#[derive(Debug)]
pub(crate) struct TriangleBlocks {
    grid: TileGrid,
    blocks: Vec<TileBox>,
}

impl TriangleBlocks {
    /// Computes the squares of all blocks of a view.
    #[must_use]
    pub(crate) fn new(mesh: &Mesh, view: &View, limits: &ViewTolerances) -> Self {
        let size = DVec2::new(view.frame.width, view.frame.height);
        // Lines end at the frame, up to rounding.
        let grid = TileGrid::new(-DVec2::splat(limits.px), size + limits.px, CELLS_ACROSS);
        let triangles = TiledTriangles { mesh, view, grid: &grid, limits };
        let (count, slack) = (triangles.count(), triangles.slack());
        let of_block = |block: usize| {
            let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
            for id in block * TRIANGLES_PER_BLOCK..((block + 1) * TRIANGLES_PER_BLOCK).min(count) {
                let (points, _) = corners(mesh, view, id as u32);
                // Faces cut by the near plane are represented by their clipped parts, at the end of the list.
                if points.iter().all(|p| !p.z.is_nan()) {
                    low = points.iter().fold(low, |low, p| low.min(*p));
                    high = points.iter().fold(high, |high, p| high.max(*p));
                }
            }
            if low.x <= high.x { grid.tile_box(low - slack, high + slack) } else { TileBox::EMPTY }
        };
        let blocks = (0..count.div_ceil(TRIANGLES_PER_BLOCK))
            .into_par_iter()
            .with_min_len(1 << 7)
            .map(of_block)
            .collect();
        Self { grid, blocks }
    }

    /// Ids of the triangles over each wanted tile, ascending, by the number of the tile in `wanted`.
    ///
    /// Equals [`TiledTriangles::fill`] without a cover.
    #[must_use]
    pub(crate) fn fill(&self, triangles: &TiledTriangles, wanted: &TileSet) -> CsrLists<u32> {
        let found = match self.squares(triangles, wanted) {
            Some(squares) => triangles.pairs_of(&self.over(&squares, triangles.count()), wanted),
            None => triangles.pairs(triangles.tile_boxes(), wanted, None),
        };
        let numbered = |(tile, id): &(u32, u32)| (wanted.number(*tile as usize), *id);
        csr_lists_from_pairs(wanted.count(), found.iter().flatten().map(numbered))
    }

    /// Squares whose triangles may reach a wanted tile; `None` if a tile is outside the frame.
    fn squares(&self, triangles: &TiledTriangles, wanted: &TileSet) -> Option<TileSet> {
        let (grid, own) = (triangles.grid, &self.grid);
        // Margin between a tile and a triangle whose bounding box meets it, and a little for rounding.
        let slack = (grid.cell.max(own.cell) * tolerances::BLOCK_MARGIN_OF_TILE)
            .max(4.0 * triangles.limits.side_offset);
        let (low, high) = (own.corner(0, 0), own.corner(own.columns, own.rows));
        let over = |tile: usize| {
            let (column, row) = (tile as u32 % grid.columns, tile as u32 / grid.columns);
            let (from, to) = (grid.corner(column, row) - slack, grid.corner(column + 1, row + 1) + slack);
            let is_in_frame = from.cmpge(low).all() && to.cmple(high).all();
            is_in_frame.then(|| own.tile_box(from.extend(0.0), to.extend(0.0)))
        };
        let over: Vec<TileBox> = wanted.iter().map(over).collect::<Option<_>>()?;
        Some(TileSet::new(
            own,
            over.into_iter().flat_map(|tiles| own.tiles_of(tiles).map(|(square, _)| square)),
        ))
    }

    /// Triangles of the blocks whose bounding boxes meet one of the squares, ascending.
    fn over(&self, squares: &TileSet, count: usize) -> Vec<u32> {
        let is_near = |(_, tiles): &(usize, &TileBox)| !tiles.is_empty() && squares.has_any(**tiles);
        let near = self.blocks.iter().enumerate().filter(is_near);
        near.flat_map(|(k, _)| {
            (k * TRIANGLES_PER_BLOCK) as u32..((k + 1) * TRIANGLES_PER_BLOCK).min(count) as u32
        })
        .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::dice::Dice;
    use crate::mesh::Soup;
    use crate::scene::Camera;

    /// Triangles of many sizes, inside and outside the frame.
    fn scene() -> (Mesh, View) {
        let mut dice = Dice::new(1);
        let mut soup = Soup::default();
        for k in 0..6000u32 {
            let middle = dice.point(1.0);
            let size = 0.3 * 0.5f64.powi((k % 8) as i32);
            soup.positions.extend([0; 3].map(|_| middle + dice.point(size)));
            soup.triangles.push([3 * k, 3 * k + 1, 3 * k + 2]);
        }
        let mesh = Mesh::build(soup);
        let camera = Camera::three_quarter().fit_points(&mesh.positions, 0.0);
        let view = View::new(&mesh, &camera);
        (mesh, view)
    }

    #[test]
    fn triangle_blocks_fill_tiles_like_a_full_scan() {
        let (mesh, view) = scene();
        let limits = ViewTolerances::new(&view.frame);
        let near = TriangleBlocks::new(&mesh, &view, &limits);
        let mut wholly_near = 0;
        for (low, high) in [(100.0, 400.0), (0.0, 1000.0), (-50.0, 200.0), (480.0, 481.0)] {
            let grid = TileGrid::new(DVec2::splat(low), DVec2::splat(high), 64);
            let triangles = TiledTriangles { mesh: &mesh, view: &view, grid: &grid, limits: &limits };
            // Many tiles all over the grid, and single tiles, mostly with few blocks.
            let single = (0..60).map(|k| (k * 4097 / 60, usize::MAX));
            for (first, step) in std::iter::once((0, 37)).chain(single) {
                let wanted = TileSet::new(&grid, (first..grid.len()).step_by(step));
                let is_in_frame = wanted.iter().all(|tile| {
                    let (column, row) = (tile as u32 % grid.columns, tile as u32 / grid.columns);
                    grid.corner(column, row).cmpge(DVec2::ZERO).all()
                });
                let squares = near.squares(&triangles, &wanted);
                assert!(squares.is_some() || !is_in_frame);
                wholly_near += usize::from(squares.is_some());
                let all =
                    triangles.fill(triangles.tile_boxes(), &wanted, &vec![f64::NEG_INFINITY; grid.len()]);
                let found = near.fill(&triangles, &wanted);
                assert_eq!(found.value_count(), all.value_count());
                for (number, tile) in wanted.iter().enumerate() {
                    assert_eq!(found.of(number), all.of(tile), "{tile} of {low} to {high}");
                }
            }
        }
        assert!((180..244).contains(&wholly_near), "{wholly_near}");
    }
}
