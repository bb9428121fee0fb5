//! [`FaceBuffer`]: the nearest face at each pixel of a view (Z-buffer).

use std::sync::atomic::{AtomicU64, Ordering};

use crate::parallel::prelude::*;

use super::PixelGrid;
use super::depth_cell::{self, DepthCell, depth_cell};

/// Triangles per task.
const TRIANGLES_PER_TASK: usize = 1 << 13;

/// Face nearest to the eye at the centre of each pixel, row after row from the top.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FaceBuffer {
    /// Pixels in a row.
    pub columns: usize,
    /// Number of rows.
    pub rows: usize,
    cells: Vec<DepthCell>,
}

impl FaceBuffer {
    /// Draws all triangles of a screen.
    ///
    /// The nearer face wins; of equally near faces, the one with the smaller id. Order and number of threads
    /// have no effect.
    #[must_use]
    pub fn new(screen: &PixelGrid) -> Self {
        Self::of(screen, |_| true)
    }

    /// Draws the triangles of the faces for which `draws` is true, as [`FaceBuffer::new`] does.
    #[must_use]
    pub fn of(screen: &PixelGrid, draws: impl Fn(u32) -> bool + Sync) -> Self {
        let cells: Vec<AtomicU64> = (0..screen.columns * screen.rows).map(|_| AtomicU64::new(0)).collect();
        let count = screen.triangle_count();
        (0..count.div_ceil(TRIANGLES_PER_TASK)).into_par_iter().with_max_len(1).for_each(|task| {
            for id in task * TRIANGLES_PER_TASK..((task + 1) * TRIANGLES_PER_TASK).min(count) {
                let (corners, face) = screen.triangle(id);
                if !draws(face) {
                    continue;
                }
                screen.cover(&corners, |pixel, nearness| {
                    let own = depth_cell(face, nearness);
                    // Most triangles lose, and a load is cheaper than an atomic write.
                    if own > cells[pixel].load(Ordering::Relaxed) {
                        cells[pixel].fetch_max(own, Ordering::Relaxed);
                    }
                });
            }
        });
        let cells = cells.into_iter().map(AtomicU64::into_inner).collect();
        Self { columns: screen.columns, rows: screen.rows, cells }
    }

    /// Nearest face at a pixel.
    #[inline]
    #[must_use]
    pub fn front(&self, pixel: usize) -> Option<u32> {
        depth_cell::front(self.cells[pixel])
    }

    /// Nearness of the nearest face at a pixel, on the screen's scale from 0 to 1.
    #[inline]
    #[must_use]
    pub fn nearness(&self, pixel: usize) -> Option<f32> {
        depth_cell::nearness(self.cells[pixel])
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::super::row_bands::RowBands;
    use super::*;
    use crate::mesh::{FaceId, Mesh, Soup};
    use crate::scene::{Camera, UpAxis};
    use crate::view::View;

    /// Seen from above in a parallel view of 10 × 10 world units.
    fn from_above(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> (Mesh, View) {
        let positions: Vec<DVec3> = positions.iter().map(|p| DVec3::from(*p)).collect();
        let soup = Soup { positions: positions.clone(), triangles: triangles.to_vec(), ..Soup::default() };
        let mesh = Mesh::build(soup);
        let camera = Camera::azimuth_elevation(0.0, 90.0, UpAxis::Z).fit_points(&positions, 0.0);
        let view = View::new(&mesh, &camera);
        (mesh, view)
    }

    fn front_face_per_pixel(buffer: &FaceBuffer) -> Vec<Option<u32>> {
        (0..buffer.columns * buffer.rows).map(|pixel| buffer.front(pixel)).collect()
    }

    #[test]
    fn face_buffer_fills_a_quad_of_two_triangles_without_holes() {
        let corners = [[0.0, 0.0, 0.0], [9.0, 0.0, 0.0], [9.0, 9.0, 0.0], [0.0, 9.0, 0.0]];
        let (mesh, view) = from_above(&corners, &[[0, 1, 2], [0, 2, 3]]);
        let screen = PixelGrid::new(&mesh, &view);
        let buffer = FaceBuffer::new(&screen);
        let (left, right) = (view.points[0].x, view.points[1].x);
        let (top, bottom) = (view.points[2].y, view.points[0].y);
        let per_unit = 1024.0 / view.frame.width.max(view.frame.height);
        for row in 0..buffer.rows {
            for column in 0..buffer.columns {
                let (x, y) = ((column as f64 + 0.5) / per_unit, (row as f64 + 0.5) / per_unit);
                let inside = x > left && x < right && y > top && y < bottom;
                assert_eq!(buffer.front(row * buffer.columns + column).is_some(), inside, "{column} {row}");
            }
        }
        assert!(
            front_face_per_pixel(&buffer).contains(&Some(0))
                && front_face_per_pixel(&buffer).contains(&Some(1))
        );
    }

    #[test]
    fn face_buffer_shows_the_nearer_triangle_in_any_order() {
        // The mesh sorts its faces by their corners, so either the nearer or the farther triangle comes
        // first.
        for (low, high, nearer) in [(0., 9., 1), (-3., 16., 0)] {
            let far = [[0., 0., 0.], [9., 0., 0.], [0., 9., 0.]];
            let near = [[low, low, 1.], [high, low, 1.], [low, high, 1.]];
            let (mesh, view) = from_above(&[far, near].concat(), &[[0, 1, 2], [3, 4, 5]]);
            assert!(mesh.corners(FaceId(nearer))[0].z > 0.0);
            let buffer = FaceBuffer::new(&PixelGrid::new(&mesh, &view));
            let shown = front_face_per_pixel(&buffer);
            let count = |face: u32| shown.iter().filter(|f| **f == Some(face)).count();
            assert!(count(nearer) > 1000);
            assert!(count(1 - nearer) * 20 < count(nearer), "but for what perspective leaves of it");
        }
    }

    /// Thousands of triangles of all heights, over and through each other.
    fn overlapping_triangles() -> (Mesh, View) {
        let mut positions = Vec::new();
        let mut triangles = Vec::new();
        for i in 0..30_000_u32 {
            let x = |k: u32| f64::from((i * 7919 + k * 104_729) % 1000);
            let (a, b, c) = (x(0), x(1), x(2) / 100.0);
            let first = positions.len() as u32;
            positions.extend([[a, b, c], [a + 9.0, b, c], [a, b + 7.0, 0.5 * c]]);
            triangles.push([first, first + 1, first + 2]);
        }
        from_above(&positions, &triangles)
    }

    #[test]
    fn row_bands_draw_the_same_pixels_as_the_face_buffer() {
        let (mesh, view) = overlapping_triangles();
        let screen = PixelGrid::new(&mesh, &view);
        let bands = RowBands::new(&screen);
        let mut cells = vec![0; screen.columns * screen.rows];
        cells.chunks_mut(bands.pixels()).enumerate().for_each(|(band, cells)| bands.draw(band, cells));
        assert!(FaceBuffer::new(&screen).cells == cells);
    }

    #[test]
    fn face_buffer_does_not_depend_on_the_number_of_threads() {
        let (mesh, view) = overlapping_triangles();
        let screen = PixelGrid::new(&mesh, &view);
        let with = |threads: usize| {
            let pool = rayon_core::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            pool.install(|| FaceBuffer::new(&screen))
        };
        assert_eq!(with(1), with(3));
    }
}
