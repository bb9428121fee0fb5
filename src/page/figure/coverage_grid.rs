//! [`CoverageGrid`]: the area of a frame that models and figures cover, on a coarse grid with a summed-area
//! table.
//!
//! It is used to rate places for balloons.

use glam::DVec3;
use kurbo::{Point, Rect, Vec2};

use crate::scene::{Camera, Part, Scene};
use crate::view::Frame;

/// Grid squares per side of the frame.
const SQUARES_PER_SIDE: usize = 48;

/// Weight of a square that a figure covers, and of one that another part covers.
const FIGURE_WEIGHT: u32 = 3;
const OTHER_WEIGHT: u32 = 1;

/// The covered area of a frame on a grid of squares.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CoverageGrid {
    /// The frame on the page.
    frame: Rect,
    /// Weight of each square, row by row; 0 for free squares.
    squares: Vec<u32>,
    /// Summed-area table of the weights, one entry per corner of a square, row by row.
    sums: Vec<u32>,
}

impl CoverageGrid {
    /// Rasterises a scene into the frame of a camera, which is placed at `corner`. `is_figure` selects the
    /// parts with the higher weight.
    #[must_use]
    pub(crate) fn of(
        scene: &Scene,
        camera: &Camera,
        corner: Point,
        is_figure: &dyn Fn(&Part) -> bool,
    ) -> Self {
        let frame = Frame::new(camera, DVec3::ZERO);
        let mut squares = vec![0; SQUARES_PER_SIDE * SQUARES_PER_SIDE];
        let scale =
            Vec2::new(SQUARES_PER_SIDE as f64 / camera.width, SQUARES_PER_SIDE as f64 / camera.height);
        for part in &scene.parts {
            let Some(geometry) = scene.geometry_of(part) else { continue };
            let weight = if is_figure(part) { FIGURE_WEIGHT } else { OTHER_WEIGHT };
            let seen: Vec<Option<Point>> = geometry
                .positions
                .iter()
                .map(|p| {
                    let own = frame.camera_from_local(part.world_from_part.transform_point3(*p));
                    let image = frame.image_from_camera(own);
                    let place = Point::new(image.x * scale.x, image.y * scale.y);
                    (place.is_finite() && !(frame.perspective && own.z <= 0.0)).then_some(place)
                })
                .collect();
            for corners in &geometry.triangles {
                let [a, b, c] = corners.map(|corner| seen.get(corner as usize).copied().flatten());
                if let (Some(a), Some(b), Some(c)) = (a, b, c) {
                    mark_triangle(&mut squares, [a, b, c], weight);
                }
            }
        }
        let frame = Rect::from_origin_size(corner, (camera.width, camera.height));
        Self { frame, sums: summed_area_table(&squares), squares }
    }

    /// Whether a figure covers the square at a point.
    #[must_use]
    pub(crate) fn is_figure(&self, p: Point) -> bool {
        let square =
            |at: f64, from: f64, length: f64| ((at - from) / length * SQUARES_PER_SIDE as f64).floor();
        let x = square(p.x, self.frame.x0, self.frame.width());
        let y = square(p.y, self.frame.y0, self.frame.height());
        let side = 0.0..SQUARES_PER_SIDE as f64;
        let is_within = side.contains(&x) && side.contains(&y);
        is_within && self.squares.get(y as usize * SQUARES_PER_SIDE + x as usize) == Some(&FIGURE_WEIGHT)
    }

    /// Covered share of a box, in whole squares. Parts that are not figures count one third.
    #[must_use]
    pub(crate) fn covered_share(&self, of: Rect) -> f64 {
        let square = |at: f64, from: f64, length: f64| {
            ((at - from) / length * SQUARES_PER_SIDE as f64).round().clamp(0.0, SQUARES_PER_SIDE as f64)
                as usize
        };
        let [x0, x1] = [of.x0, of.x1].map(|x| square(x, self.frame.x0, self.frame.width()));
        let [y0, y1] = [of.y0, of.y1].map(|y| square(y, self.frame.y0, self.frame.height()));
        let sum = |x: usize, y: usize| {
            f64::from(self.sums.get(y * (SQUARES_PER_SIDE + 1) + x).copied().unwrap_or(0))
        };
        let covered = sum(x1, y1) - sum(x0, y1) - sum(x1, y0) + sum(x0, y0);
        covered / ((x1 - x0) * (y1 - y0)).max(1) as f64 / f64::from(FIGURE_WEIGHT)
    }
}

/// Summed-area table of the weights.
fn summed_area_table(squares: &[u32]) -> Vec<u32> {
    let side = SQUARES_PER_SIDE + 1;
    let mut sums = vec![0; side * side];
    for y in 0..SQUARES_PER_SIDE {
        let mut row = 0;
        for x in 0..SQUARES_PER_SIDE {
            row += squares[y * SQUARES_PER_SIDE + x];
            sums[(y + 1) * side + x + 1] = sums[y * side + x + 1] + row;
        }
    }
    sums
}

/// Marks the squares whose centres lie in a triangle. The larger weight wins.
fn mark_triangle(squares: &mut [u32], [a, b, c]: [Point; 3], weight: u32) {
    let range = |values: [f64; 3]| {
        let low = values.into_iter().fold(f64::INFINITY, f64::min).max(0.0);
        let high = values.into_iter().fold(f64::NEG_INFINITY, f64::max).min(SQUARES_PER_SIDE as f64);
        (low as usize)..(high.ceil().max(0.0) as usize).min(SQUARES_PER_SIDE)
    };
    let side = |p: Point, q: Point, r: Point| (q - p).cross(r - p);
    for y in range([a.y, b.y, c.y]) {
        for x in range([a.x, b.x, c.x]) {
            let p = Point::new(x as f64 + 0.5, y as f64 + 0.5);
            let sides = [side(a, b, p), side(b, c, p), side(c, a, p)];
            let within = sides.iter().all(|s| *s >= 0.0) || sides.iter().all(|s| *s <= 0.0);
            if let Some(square) = squares.get_mut(y * SQUARES_PER_SIDE + x).filter(|_| within) {
                *square = weight.max(*square);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn covered_share_counts_squares() {
        let mut squares = vec![0; SQUARES_PER_SIDE * SQUARES_PER_SIDE];
        // A square: the left half of the upper half.
        let half = SQUARES_PER_SIDE as f64 / 2.0;
        mark_triangle(
            &mut squares,
            [Point::new(0.0, 0.0), Point::new(half, 0.0), Point::new(half, half)],
            FIGURE_WEIGHT,
        );
        mark_triangle(
            &mut squares,
            [Point::new(0.0, 0.0), Point::new(half, half), Point::new(0.0, half)],
            FIGURE_WEIGHT,
        );
        let cover = CoverageGrid {
            frame: Rect::new(10.0, 20.0, 110.0, 120.0),
            sums: summed_area_table(&squares),
            squares,
        };
        assert_eq!(cover.covered_share(Rect::new(10.0, 20.0, 60.0, 70.0)), 1.0);
        assert_eq!(cover.covered_share(Rect::new(10.0, 20.0, 110.0, 120.0)), 0.25);
        assert_eq!(cover.covered_share(Rect::new(60.0, 70.0, 110.0, 120.0)), 0.0);
        let is_figure =
            [(15.0, 25.0), (59.0, 69.0), (61.0, 69.0), (0.0, 25.0)].map(|p| cover.is_figure(p.into()));
        assert_eq!(is_figure, [true, true, false, false]);
    }
}
