//! [`TileTriangles`]: the triangles over one tile, loaded in full when a line needs them.

use super::edge_functions::{EdgeFunctions, Window};
use crate::visibility::occlusion::tiled_triangles::{Occluder, Reach, Triangles};
use crate::visibility::tiles::tile_grid::Grid;
use crate::visibility::view_tolerances::Limits;

/// Marks a triangle that is not loaded.
const NOWHERE: u32 = u32::MAX;

/// Triangles of a tile. Only the few that are compared with a line are loaded in full. The buffers are reused
/// for the next tile.
#[derive(Debug, Default)]
pub(crate) struct TileTriangles {
    /// Bounds of each triangle.
    pub(crate) reaches: Vec<Reach>,
    /// Index of each triangle among the loaded ones, if it is loaded.
    places: Vec<u32>,
    looked_up: Vec<LookedUp>,
    /// Area of the tile, with a small margin.
    pub(crate) window: Window,
}

/// Loaded triangle of a tile.
#[derive(Debug)]
pub(crate) struct LookedUp {
    pub(crate) sides: EdgeFunctions,
    pub(crate) whole: Occluder,
}

impl TileTriangles {
    /// Replaces the contents by the triangles of another tile of a grid.
    pub(crate) fn replace(
        &mut self,
        reaches: impl Iterator<Item = Reach>,
        grid: &Grid,
        tile: usize,
        limits: &Limits,
    ) {
        let half = grid.cell / 2.0;
        let corner = grid.corner(tile as u32 % grid.columns, tile as u32 / grid.columns);
        // Lines are also tested slightly next to themselves.
        self.window = Window { middle: corner + half, reach: half * (1.0 + 1e-5) + 2.0 * limits.beside };
        self.reaches.clear();
        self.reaches.extend(reaches);
        self.places.clear();
        self.places.resize(self.reaches.len(), NOWHERE);
        self.looked_up.clear();
    }

    /// Returns a triangle with everything the exact comparison needs, and loads it first if necessary.
    #[inline]
    pub(crate) fn look_up(&mut self, entry: u32, triangles: &Triangles) -> &LookedUp {
        let place = &mut self.places[entry as usize];
        if *place == NOWHERE {
            *place = self.looked_up.len() as u32;
            let whole = triangles.occluder(self.reaches[entry as usize].id);
            let sides = EdgeFunctions::new(&whole.corners, &self.window, triangles.limits);
            self.looked_up.push(LookedUp { sides, whole });
        }
        &self.looked_up[*place as usize]
    }
}
