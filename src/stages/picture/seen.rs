//! Which faces may be seen: what all of a picture is painted on, and no more.

use crate::mesh::{FaceId, Mesh};
use crate::raster::{FaceBuffer, Screen};

/// Faces smaller than this, pixels of the buffer squared, may fall between the middles of its pixels.
const SMALL: f32 = 6.0;

/// For each face, whether some of it may be in front. `mesh` is that of the screen, but that faces that hide nothing are degenerate.
pub(crate) fn may_be_seen(mesh: &Mesh, screen: &Screen) -> Vec<bool> {
    let buffer = FaceBuffer::of(screen, |face| !mesh.is_degenerate(FaceId(face)));
    let mut seen = vec![false; mesh.triangles.len()];
    for pixel in 0..buffer.columns * buffer.rows {
        if let Some(face) = buffer.front(pixel) {
            seen[face as usize] = true;
        }
    }
    for (face, seen) in seen.iter_mut().enumerate() {
        if *seen || mesh.is_degenerate(FaceId(face as u32)) {
            continue;
        }
        let ([a, b, c], _) = screen.triangle(face);
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        if area.abs() < SMALL {
            let middle = [0, 1, 2].map(|k| (a[k] + b[k] + c[k]) / 3.0);
            *seen = is_near_front(&buffer, middle);
        }
    }
    seen
}

/// Whether a point is about as near as what is in front around it.
fn is_near_front(buffer: &FaceBuffer, [x, y, near]: [f32; 3]) -> bool {
    if !(x >= 0.0 && y >= 0.0 && (x as usize) < buffer.columns && (y as usize) < buffer.rows) {
        return false;
    }
    let (column, row) = (x as usize, y as usize);
    let (mut low, mut high, mut empty) = (f32::INFINITY, f32::NEG_INFINITY, false);
    for row in row.saturating_sub(1)..=(row + 1).min(buffer.rows - 1) {
        for column in column.saturating_sub(1)..=(column + 1).min(buffer.columns - 1) {
            match buffer.nearness(row * buffer.columns + column) {
                Some(front) => (low, high) = (low.min(front), high.max(front)),
                None => empty = true,
            }
        }
    }
    empty || near >= low - (high - low) - 1e-4
}
