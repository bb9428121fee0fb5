//! [`JumpTiles`]: the jumps of an image, stored in tiles. Lines pass all rows but few tiles, and untouched
//! memory is free.

use crate::parallel::prelude::*;

/// Rows and columns of a tile, which fills a memory page.
const TILE_ROWS: usize = 16;
const TILE_COLUMNS: usize = 32;

/// Jumps between neighbouring pixels that may be edges; 0 elsewhere.
pub(crate) struct JumpTiles {
    pub columns: usize,
    pub rows: usize,
    /// Columns with jumps, for each row.
    pub with_jumps: Vec<Vec<u32>>,
    /// Jumps to each pixel from the left and from above. Tile by tile, and row by row inside a tile.
    jumps: Vec<[f32; 2]>,
}

impl JumpTiles {
    /// Builds the map; `of_row` reports the jumps of a row, each with its column.
    pub(crate) fn new(
        columns: usize,
        rows: usize,
        of_row: impl Fn(usize, &mut dyn FnMut(usize, [f32; 2])) + Sync + Send,
    ) -> Self {
        let band = columns.next_multiple_of(TILE_COLUMNS) * TILE_ROWS;
        let mut jumps = vec![[0.0; 2]; band * rows.div_ceil(TILE_ROWS)];
        let of_band = |(number, own): (usize, &mut [[f32; 2]])| {
            let in_row = |row: usize| {
                let mut found = Vec::new();
                of_row(row, &mut |column, jumps| {
                    own[in_band(column, row)] = jumps;
                    found.push(column as u32);
                });
                found
            };
            (number * TILE_ROWS..((number + 1) * TILE_ROWS).min(rows)).map(in_row).collect::<Vec<_>>()
        };
        let with_jumps = jumps.par_chunks_mut(band).enumerate().flat_map_iter(of_band).collect();
        Self { columns, rows, with_jumps, jumps }
    }

    fn at(&self, column: usize, row: usize) -> [f32; 2] {
        let band = self.columns.next_multiple_of(TILE_COLUMNS) * TILE_ROWS;
        self.jumps[row / TILE_ROWS * band + in_band(column, row)]
    }

    /// Jump from the left neighbour to a pixel.
    #[inline]
    pub(crate) fn across(&self, column: usize, row: usize) -> f32 {
        self.at(column, row)[0]
    }

    /// Jump from the upper neighbour to a pixel.
    #[inline]
    pub(crate) fn down(&self, column: usize, row: usize) -> f32 {
        self.at(column, row)[1]
    }
}

/// Index of a pixel's jumps within its row of tiles.
#[inline]
fn in_band(column: usize, row: usize) -> usize {
    column / TILE_COLUMNS * (TILE_COLUMNS * TILE_ROWS)
        + row % TILE_ROWS * TILE_COLUMNS
        + column % TILE_COLUMNS
}
