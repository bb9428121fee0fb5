//! [`TileSet`]: a set of tiles of a grid, with ranks and queries by block.

use super::tile_grid::{TileBox, TileGrid};
use crate::geometry::lists::rank_bitset::RankBitset;

/// Set of tiles of a grid, numbered row by row.
#[derive(Debug)]
pub(crate) struct TileSet {
    /// Rows begin at whole words.
    held: RankBitset,
    columns: usize,
    stride: usize,
}

impl TileSet {
    /// Set of the listed tiles, in any order and with repetitions.
    pub(crate) fn new(grid: &TileGrid, listed: impl IntoIterator<Item = usize>) -> Self {
        let columns = grid.columns as usize;
        let stride = columns.next_multiple_of(64);
        let place = |tile: usize| tile / columns * stride + tile % columns;
        Self {
            held: RankBitset::new(grid.rows as usize * stride, listed.into_iter().map(place)),
            columns,
            stride,
        }
    }

    /// Number of tiles.
    pub(crate) fn count(&self) -> usize {
        self.held.count()
    }

    /// Whether it contains the tile in a column and row.
    #[inline]
    pub(crate) fn has(&self, column: usize, row: usize) -> bool {
        self.held.contains(row * self.stride + column)
    }

    /// Rank of one of its tiles, from 0 on in the order of tiles.
    #[inline]
    pub(crate) fn number(&self, tile: usize) -> usize {
        self.held.of(tile / self.columns * self.stride + tile % self.columns) as usize
    }

    /// Whether it contains any tile of a block, which must not be empty.
    #[inline]
    pub(crate) fn has_any(&self, tiles: TileBox) -> bool {
        (usize::from(tiles.top)..=usize::from(tiles.bottom)).any(|row| {
            let first = row * self.stride;
            self.held.any_within(first + usize::from(tiles.left), first + usize::from(tiles.right))
        })
    }

    /// Ranks of its tiles in a block, ascending.
    pub(crate) fn within(&self, tiles: TileBox) -> impl Iterator<Item = usize> + '_ {
        (usize::from(tiles.top)..=usize::from(tiles.bottom)).flat_map(move |row| {
            let places = (usize::from(tiles.left)..=usize::from(tiles.right))
                .map(move |column| row * self.stride + column);
            places.filter(|place| self.held.contains(*place)).map(|place| self.held.of(place) as usize)
        })
    }

    /// All its tiles, ascending.
    pub(crate) fn iter(&self) -> impl Iterator<Item = usize> + '_ {
        self.held.iter().map(|place| place / self.stride * self.columns + place % self.stride)
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::geometry::numbers::noise::hash;

    #[test]
    fn tile_set_queries_match_a_plain_list_of_tiles() {
        // With 3 and with 150 columns, so rows take one word or several.
        for (size, of) in [((3.0, 50.0), 9), ((50.0, 3.0), 40), ((150.0, 20.0), 100), ((150.0, 150.0), 3)] {
            let grid = TileGrid::of_cells(DVec2::ZERO, DVec2::from(size) - 0.5, 1.0);
            let is_held = |tile: &usize| hash(1, &[*tile as u64]).is_multiple_of(of);
            let plain: Vec<usize> = (0..grid.len()).filter(is_held).collect();
            let set = TileSet::new(&grid, plain.iter().copied());
            assert_eq!((set.iter().collect::<Vec<_>>(), set.count()), (plain.clone(), plain.len()));
            for (number, tile) in plain.iter().enumerate() {
                assert_eq!(set.number(*tile), number);
            }
            for k in 0..4000u64 {
                let pick = |salt: u64, below: u32| (hash(salt, &[k]) % u64::from(below)) as u16;
                let (columns, rows) = (grid.columns, grid.rows);
                let [a, b] = [0, 1].map(|salt| pick(salt, columns));
                let [c, d] = [2, 3].map(|salt| pick(salt, rows));
                let tiles = TileBox { left: a.min(b), right: a.max(b), top: c.min(d), bottom: c.max(d) };
                let any = grid.tiles_of(tiles).any(|(tile, _)| is_held(&tile));
                assert_eq!(set.has_any(tiles), any);
                let within = grid.tiles_of(tiles).map(|(tile, _)| tile).filter(is_held);
                assert!(set.within(tiles).eq(within.map(|tile| set.number(tile))));
                assert_eq!(set.has(usize::from(a), usize::from(c)), is_held(&grid.tile(a.into(), c.into())));
            }
        }
    }
}
