//! [`BrushStrip`]: the picture of a stroke as a brush that keeps its interior: islands of ink, with paper between
//! bristles.

use kurbo::{BezPath, Point};

use super::brush_core::{BRUSH_COLUMNS, InkOffset, nearest_ink};
use crate::colour::darkness_map::{DarknessMap, OutlineTracing};
use crate::colour::pixel_picture::Picture;
use crate::colour::srgb::Colour;
use crate::geometry::plane::polyline_path::add_polygon;

/// Darkness on white above which a pixel is ink.
pub(crate) const MIN_INK_DARKNESS: f64 = 0.5;

/// Greatest number of pixels. Larger pictures are scaled down.
const MAX_PIXELS: usize = 1 << 20;

/// Greatest number of pixels per page px in traced pictures.
const TRACED_PIXELS_PER_PX: f64 = 3.0;

/// Greatest number of pixels per page px in pictures that are shown themselves.
const IMAGE_PIXELS_PER_PX: f64 = 4.0;

/// Greatest error of traced outlines before they are mapped, px.
const OUTLINE_TOLERANCE_PX: f64 = 0.08;

/// Least area of islands and holes, px². Smaller ones are dropped.
const MIN_ISLAND_AREA_PX2: f64 = 0.35;

/// Share of paper below which a stroke is solid.
const MAX_SOLID_PAPER_SHARE: f64 = 0.01;

/// Picture of a stroke.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BrushStrip {
    shades: DarknessMap,
    /// Distances from the middle into the ink, evenly along the picture. Bristles count as one.
    pub(crate) ink_offsets: Vec<Option<InkOffset>>,
}

impl BrushStrip {
    /// The strip of a picture of a stroke, dark on light, running from left to right.
    #[must_use]
    pub(crate) fn of(picture: &Picture) -> Self {
        let full_map = DarknessMap::of(picture);
        let times = (MAX_PIXELS as f64 / (full_map.width * full_map.height) as f64).sqrt().min(1.0);
        let smaller = |count: usize| (count as f64 * times).floor() as usize;
        let shades = full_map.at_most(smaller(full_map.width), smaller(full_map.height));
        let wide = shades.at_most(BRUSH_COLUMNS, shades.height);
        let ink_of_column = |k: usize| {
            let column = k * wide.width / BRUSH_COLUMNS;
            let (top, bottom) = edges(&wide, column)?;
            let [top, bottom] = [top, bottom].map(|row| row / wide.height as f64 - 0.5);
            nearest_ink(&[(top, 1), (bottom, -1)])
        };
        let column_offsets = (0..BRUSH_COLUMNS).map(ink_of_column).collect();
        Self { shades, ink_offsets: column_offsets }
    }

    /// Whether the stroke has almost no paper between its edges.
    #[must_use]
    pub(crate) fn is_solid(&self) -> bool {
        let (mut within, mut inked) = (0.0, 0);
        for column in 0..self.shades.width {
            if let Some((top, bottom)) = edges(&self.shades, column) {
                within += bottom - top;
                inked += (0..self.shades.height).filter(|row| is_ink(&self.shades, column, *row)).count();
            }
        }
        within - inked as f64 <= MAX_SOLID_PAPER_SHARE * within
    }

    /// Pixels along and across for a pen `wide` px wide. Sizes are rounded so that lines share pictures.
    pub(crate) fn pixels(&self, wide: f64) -> [usize; 2] {
        let rows = ((wide * IMAGE_PIXELS_PER_PX).clamp(1.0, 1e6) as usize).next_power_of_two();
        let rows = rows.min(self.shades.height) as f64;
        let columns = (rows * self.shades.width as f64 / self.shades.height as f64).round().max(1.0);
        [columns as usize, rows as usize]
    }

    /// The strip in an ink. Its darkness becomes opacity.
    pub(crate) fn picture(&self, [width, height]: [usize; 2], ink: Colour) -> Picture {
        let shades = self.shades.at_most(width, height);
        let at = |k: usize| {
            let [x, y] = [k % shades.width, k / shades.width].map(|at| at as f64);
            let dark = shades.mean([x, y], [x + 1.0, y + 1.0]).clamp(0.0, 1.0);
            Colour { a: (dark * f64::from(ink.a)).round() as u8, ..ink }
        };
        let pixels = (0..shades.width * shades.height).map(at).collect();
        Picture { width: shades.width, height: shades.height, pixels }
    }

    /// The islands of ink and their holes as a brush path. The arguments are its length and width on the
    /// page, px.
    pub(crate) fn path(&self, [long, wide]: [f64; 2]) -> BezPath {
        let fine = |size: f64| (size * TRACED_PIXELS_PER_PX).ceil().clamp(1.0, 1e6) as usize;
        let shades = self.shades.at_most(fine(long), fine(wide));
        let size = [shades.width as f64, shades.height as f64];
        let scale = [long / size[0], wide / size[1]];
        let tracing = OutlineTracing {
            level: MIN_INK_DARKNESS,
            scale,
            tolerance: OUTLINE_TOLERANCE_PX,
            speck: MIN_ISLAND_AREA_PX2,
            repeats: false,
        };
        let rings = shades.outlines(&tracing).unwrap_or_default();
        let place = |p: Point| Point::new(p.x / size[0], p.y / size[1] - 0.5);
        let mut path = BezPath::new();
        for ring in rings {
            add_polygon(&mut path, ring.into_iter().map(place));
        }
        path
    }
}

fn is_ink(shades: &DarknessMap, column: usize, row: usize) -> bool {
    let [x, y] = [column as f64, row as f64];
    shades.mean([x, y], [x + 1.0, y + 1.0]) > MIN_INK_DARKNESS
}

/// First and last row of ink in a column.
fn edges(shades: &DarknessMap, column: usize) -> Option<(f64, f64)> {
    let own = |row: &usize| is_ink(shades, column, *row);
    let top = (0..shades.height).find(own)?;
    let bottom = (0..shades.height).rev().find(own)?;
    Some((top as f64, bottom as f64 + 1.0))
}
