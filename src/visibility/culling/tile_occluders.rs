//! [`TileTriangles`]: the triangles over one tile, as its lines ask for them.

use super::edge_functions::{EdgeFunctions, Window};
use crate::visibility::occlusion::tiled_triangles::{Occluder, Reach, Triangles};
use crate::visibility::tiles::tile_grid::Grid;
use crate::visibility::view_tolerances::Limits;

/// Stands for no place.
const NOWHERE: u32 = u32::MAX;

/// The triangles of a tile. Few of them are compared with a line, and only these are looked up whole. Those of the next tile
/// take the memory over.
#[derive(Debug, Default)]
pub(crate) struct TileTriangles {
    /// How far each reaches.
    pub(crate) reaches: Vec<Reach>,
    /// The place of each among those that were looked up, if it was.
    places: Vec<u32>,
    looked_up: Vec<LookedUp>,
    /// The tile, with what lies just beside it.
    pub(crate) window: Window,
}

/// A triangle of a tile that was looked up.
#[derive(Debug)]
pub(crate) struct LookedUp {
    pub(crate) sides: EdgeFunctions,
    pub(crate) whole: Occluder,
}

impl TileTriangles {
    /// Makes these the triangles of another tile of a grid.
    pub(crate) fn replace(
        &mut self,
        reaches: impl Iterator<Item = Reach>,
        grid: &Grid,
        tile: usize,
        limits: &Limits,
    ) {
        let half = grid.cell / 2.0;
        let corner = grid.corner(tile as u32 % grid.columns, tile as u32 / grid.columns);
        // Lines are also asked about a little beside themselves.
        self.window = Window { middle: corner + half, reach: half * (1.0 + 1e-5) + 2.0 * limits.beside };
        self.reaches.clear();
        self.reaches.extend(reaches);
        self.places.clear();
        self.places.resize(self.reaches.len(), NOWHERE);
        self.looked_up.clear();
    }

    /// A triangle with all that the comparison needs.
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
