//! [`TileOccluders`]: the triangles over one tile, loaded in full when a line needs them.

use super::edge_functions::{EdgeFunctions, Window};
use crate::visibility::occlusion::tiled_triangles::{Occluder, OccluderBounds, TiledTriangles};
use crate::visibility::tiles::tile_grid::TileGrid;
use crate::visibility::tolerances;
use crate::visibility::view_tolerances::ViewTolerances;

/// Marks a triangle that is not loaded.
const NOT_LOADED: u32 = u32::MAX;

/// Triangles of a tile. Only the few that are compared with a line are loaded in full. The buffers are reused
/// for the next tile.
#[derive(Debug, Default)]
pub(crate) struct TileOccluders {
    /// Bounds of each triangle.
    pub(crate) reaches: Vec<OccluderBounds>,
    /// Index of each triangle among the loaded ones, if it is loaded.
    loaded_indices: Vec<u32>,
    loaded: Vec<LoadedTriangle>,
    /// Area of the tile, with a small margin.
    pub(crate) window: Window,
}

/// Loaded triangle of a tile.
#[derive(Debug)]
pub(crate) struct LoadedTriangle {
    pub(crate) sides: EdgeFunctions,
    pub(crate) whole: Occluder,
}

impl TileOccluders {
    /// Replaces the contents by the triangles of another tile of a grid.
    pub(crate) fn replace(
        &mut self,
        reaches: impl Iterator<Item = OccluderBounds>,
        grid: &TileGrid,
        tile: usize,
        limits: &ViewTolerances,
    ) {
        let half = grid.cell / 2.0;
        let corner = grid.corner(tile as u32 % grid.columns, tile as u32 / grid.columns);
        // Lines are also tested slightly next to themselves.
        self.window = Window {
            middle: corner + half,
            reach: half * (1.0 + tolerances::TILE_MARGIN_OF_TILE) + 2.0 * limits.side_offset,
        };
        self.reaches.clear();
        self.reaches.extend(reaches);
        self.loaded_indices.clear();
        self.loaded_indices.resize(self.reaches.len(), NOT_LOADED);
        self.loaded.clear();
    }

    /// Returns a triangle with everything the exact comparison needs, and loads it first if necessary.
    #[inline]
    pub(crate) fn load_triangle(&mut self, entry: u32, triangles: &TiledTriangles) -> &LoadedTriangle {
        let place = &mut self.loaded_indices[entry as usize];
        if *place == NOT_LOADED {
            *place = self.loaded.len() as u32;
            let whole = triangles.occluder(self.reaches[entry as usize].id);
            let sides = EdgeFunctions::new(&whole.corners, &self.window, triangles.limits);
            self.loaded.push(LoadedTriangle { sides, whole });
        }
        &self.loaded[*place as usize]
    }
}
