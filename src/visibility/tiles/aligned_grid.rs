//! Grids over the image whose tiles stay in place when lines come and go.

use glam::{DVec2, DVec3};

use super::tile_grid::TileGrid;
use crate::geometry::numbers::powers_of_two::power_of_two_above;
use crate::visibility::projection::image_segments::ImageSegment;

/// Grid over the bounding box of some segments.
///
/// Tiles are a power of two wide and lie on multiples of their width, so they rarely move when lines change.
pub(crate) fn grid_over<'a>(segments: impl Iterator<Item = &'a ImageSegment>, across: u32) -> TileGrid {
    let around = segments.fold(None, |around: Option<(DVec3, DVec3)>, s| {
        let (low, high) = around.unwrap_or((s.a, s.a));
        Some((low.min(s.a).min(s.b), high.max(s.a).max(s.b)))
    });
    let (low, high) = around.unwrap_or_default();
    grid_over_box(low.truncate(), high.truncate(), across)
}

/// Grid over a box, with the same alignment.
pub(crate) fn grid_over_box(low: DVec2, high: DVec2, across: u32) -> TileGrid {
    let size = (high - low).max_element();
    if !(size > 0.0 && size.is_finite()) {
        return TileGrid::new(low, high, across);
    }
    // Gives 0.7 to 1.4 times the requested number of tiles.
    let cell = power_of_two_above(size / f64::from(across) * std::f64::consts::FRAC_1_SQRT_2);
    TileGrid::of_cells((low / cell).floor() * cell, high, cell)
}

/// Tiles across the page for a number of triangles. Denser meshes get smaller tiles; crowded tiles are
/// subdivided later.
pub(crate) fn tiles_across(triangles: usize) -> u32 {
    match triangles {
        0..=2_000 => 32,
        2_001..=30_000 => 64,
        30_001..=200_000 => 128,
        _ => 256,
    }
}

/// Squares of the occlusion buffer along each side of a tile.
///
/// Smaller squares hide more lines and cost more. They pay where a mesh is so dense that its lines are short.
pub(crate) fn squares_per_tile(triangles: usize) -> u32 {
    if triangles > 200_000 { 6 } else { 2 }
}
