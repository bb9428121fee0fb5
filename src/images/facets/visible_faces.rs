//! [`VisibleFaces`]: the faces that may be visible, on which a picture must be painted.

use glam::DVec3;

use crate::images::tolerances;
use crate::mesh::{FaceId, Mesh};
use crate::view::raster::{FaceBuffer, PixelGrid, PixelPoint};

/// Twice the area of a face below which it may fall between pixel centres, square pixels of the buffer.
const MIN_SAMPLED_DOUBLE_AREA: f32 = 6.0;

/// Faces of a view that are in front.
#[derive(Debug)]
pub(crate) struct VisibleFaces {
    buffer: FaceBuffer,
    faces: Vec<bool>,
}

impl VisibleFaces {
    /// Finds the faces in front on a screen. `mesh` is the mesh of the screen, with the faces that hide
    /// nothing made degenerate.
    pub(crate) fn new(mesh: &Mesh, screen: &PixelGrid) -> Self {
        let buffer = FaceBuffer::of(screen, |face| !mesh.is_degenerate(FaceId(face)));
        let mut faces = vec![false; mesh.triangles.len()];
        for pixel in 0..buffer.columns * buffer.rows {
            if let Some(face) = buffer.front(pixel) {
                faces[face as usize] = true;
            }
        }
        for (face, seen) in faces.iter_mut().enumerate() {
            if !*seen && !mesh.is_degenerate(FaceId(face as u32)) {
                let (corners, _) = screen.triangle(face);
                *seen = is_small(&corners) && is_unoccluded(&buffer, screen, mean(&corners));
            }
        }
        Self { buffer, faces }
    }

    /// Whether some of a face may be visible.
    pub(crate) fn face(&self, face: u32) -> bool {
        self.faces[face as usize]
    }

    /// Whether some of a piece of a face may be visible.
    pub(crate) fn piece(&self, screen: &PixelGrid, face: u32, corners: [DVec3; 3]) -> bool {
        let corners = corners.map(|corner| screen.point(corner));
        if !is_small(&corners) {
            let mut seen = false;
            screen.cover(&corners, |pixel, _| seen |= self.buffer.front(pixel) == Some(face));
            return seen;
        }
        sample_points(corners).into_iter().any(|point| is_unoccluded(&self.buffer, screen, point))
    }
}

/// The mean of points.
fn mean(points: &[PixelPoint]) -> PixelPoint {
    [0, 1, 2].map(|k| points.iter().map(|p| p[k]).sum::<f32>() / points.len() as f32)
}

/// Centre of a triangle, and the points halfway from there to its corners.
pub(crate) fn sample_points(corners: [PixelPoint; 3]) -> [PixelPoint; 4] {
    let middle = mean(&corners);
    let [a, b, c] = corners.map(|corner| mean(&[corner, middle]));
    [middle, a, b, c]
}

/// Pixel that contains a point.
pub(crate) fn pixel_of(screen: &PixelGrid, [x, y, _]: PixelPoint) -> Option<usize> {
    let is_in = x >= 0.0 && y >= 0.0 && (x as usize) < screen.columns && (y as usize) < screen.rows;
    is_in.then(|| y as usize * screen.columns + x as usize)
}

/// Whether a triangle is small enough to fall between pixel centres.
fn is_small([a, b, c]: &[PixelPoint; 3]) -> bool {
    let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    area.abs() < MIN_SAMPLED_DOUBLE_AREA
}

/// Whether none of the nearest faces around a point is in front of it.
fn is_unoccluded(buffer: &FaceBuffer, screen: &PixelGrid, point: PixelPoint) -> bool {
    let Some(pixel) = pixel_of(screen, point) else { return false };
    let (column, row) = (pixel % screen.columns, pixel / screen.columns);
    let around = (row.saturating_sub(1)..=(row + 1).min(screen.rows - 1)).flat_map(|row| {
        let columns = column.saturating_sub(1)..=(column + 1).min(screen.columns - 1);
        columns.map(move |column| row * screen.columns + column)
    });
    let mut last = None;
    !around
        .filter_map(|pixel| buffer.front(pixel))
        .any(|face| last.replace(face) != Some(face) && is_in_front(&screen.triangle(face as usize).0, point))
}

/// Whether a triangle lies in front of a point.
fn is_in_front(corners: &[PixelPoint; 3], [x, y, near]: PixelPoint) -> bool {
    let [a, b, c] = corners.map(|corner| corner.map(f64::from));
    let cross = |p: [f64; 3], q: [f64; 3]| {
        (q[0] - p[0]) * (f64::from(y) - p[1]) - (q[1] - p[1]) * (f64::from(x) - p[0])
    };
    let [of_a, of_b, of_c] = [cross(b, c), cross(c, a), cross(a, b)];
    let whole = of_a + of_b + of_c;
    let covers = [of_a, of_b, of_c].iter().all(|part| part * whole >= 0.0);
    covers
        && (of_a * a[2] + of_b * b[2] + of_c * c[2]) / whole > f64::from(near + tolerances::MIN_NEARNESS_GAP)
}
