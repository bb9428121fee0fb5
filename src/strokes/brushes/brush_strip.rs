//! [`Strip`]: the picture of a stroke, as a brush that shows its inside: islands of ink, and paper between bristles.

use kurbo::{BezPath, Point};

use super::brush_core::{COLUMNS, Way, nearest};
use crate::colour::darkness_map::{Shades, Tracing};
use crate::colour::pixel_picture::Picture;
use crate::colour::srgb::Colour;

/// Pixels darker than this, on white, are ink.
pub(crate) const DARK: f64 = 0.5;

/// Pictures of more pixels than this are made smaller.
const MOST_PIXELS: usize = 1 << 20;

/// Pictures are traced with no more pixels to a px of the page than this.
const FINENESS: f64 = 3.0;

/// Pictures that are shown themselves have no more pixels to a px of the page than this.
const PRINT_FINENESS: f64 = 4.0;

/// How far outlines may be off before they are laid along a line, px.
const TOLERANCE_PX: f64 = 0.08;

/// Islands and holes of less than this are left out, px squared.
const SPECK_PX: f64 = 0.35;

/// A stroke of which less than this part is paper is solid.
const SOLID: f64 = 0.01;

/// The picture of a stroke.
#[derive(Debug, Clone, PartialEq)]
pub struct Strip {
    shades: Shades,
    /// How far it is from the middle into the ink, evenly along the picture; bristles count as one.
    pub(crate) ways: Vec<Option<Way>>,
}

impl Strip {
    /// The strip of a picture of a stroke, dark on light, that runs from left to right.
    #[must_use]
    pub fn of(picture: &Picture) -> Self {
        let whole = Shades::of(picture);
        let times = (MOST_PIXELS as f64 / (whole.width * whole.height) as f64).sqrt().min(1.0);
        let smaller = |count: usize| (count as f64 * times).floor() as usize;
        let shades = whole.at_most(smaller(whole.width), smaller(whole.height));
        let wide = shades.at_most(COLUMNS, shades.height);
        let way = |k: usize| {
            let column = k * wide.width / COLUMNS;
            let (top, bottom) = edges(&wide, column)?;
            let [top, bottom] = [top, bottom].map(|row| row / wide.height as f64 - 0.5);
            nearest(&[(top, 1), (bottom, -1)])
        };
        let ways = (0..COLUMNS).map(way).collect();
        Self { shades, ways }
    }

    /// Whether there is hardly any paper between the edges of the stroke.
    #[must_use]
    pub fn is_solid(&self) -> bool {
        let (mut within, mut inked) = (0.0, 0);
        for column in 0..self.shades.width {
            if let Some((top, bottom)) = edges(&self.shades, column) {
                within += bottom - top;
                inked += (0..self.shades.height).filter(|row| is_ink(&self.shades, column, *row)).count();
            }
        }
        within - inked as f64 <= SOLID * within
    }

    /// How many pixels it has along and across, for a pen that is so wide, px: in few sizes, so that lines share them.
    pub(crate) fn pixels(&self, wide: f64) -> [usize; 2] {
        let rows = ((wide * PRINT_FINENESS).clamp(1.0, 1e6) as usize).next_power_of_two();
        let rows = rows.min(self.shades.height) as f64;
        let columns = (rows * self.shades.width as f64 / self.shades.height as f64).round().max(1.0);
        [columns as usize, rows as usize]
    }

    /// Itself in an ink: as opaque as it is dark.
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

    /// The islands of ink and their holes, as a path of a brush that is so long and so wide on the page, in px.
    pub(crate) fn path(&self, [long, wide]: [f64; 2]) -> BezPath {
        let fine = |size: f64| (size * FINENESS).ceil().clamp(1.0, 1e6) as usize;
        let shades = self.shades.at_most(fine(long), fine(wide));
        let size = [shades.width as f64, shades.height as f64];
        let scale = [long / size[0], wide / size[1]];
        let tracing =
            Tracing { level: DARK, scale, tolerance: TOLERANCE_PX, speck: SPECK_PX, repeats: false };
        let rings = shades.outlines(&tracing).unwrap_or_default();
        let place = |p: &Point| Point::new(p.x / size[0], p.y / size[1] - 0.5);
        let mut path = BezPath::new();
        for ring in rings {
            for (k, p) in ring.iter().enumerate() {
                if k == 0 { path.move_to(place(p)) } else { path.line_to(place(p)) }
            }
            path.close_path();
        }
        path
    }
}

fn is_ink(shades: &Shades, column: usize, row: usize) -> bool {
    let [x, y] = [column as f64, row as f64];
    shades.mean([x, y], [x + 1.0, y + 1.0]) > DARK
}

/// Where the ink of a column begins and ends.
fn edges(shades: &Shades, column: usize) -> Option<(f64, f64)> {
    let own = |row: &usize| is_ink(shades, column, *row);
    let top = (0..shades.height).find(own)?;
    let bottom = (0..shades.height).rev().find(own)?;
    Some((top as f64, bottom as f64 + 1.0))
}
