//! Faces that may be visible: gradients are not traced on faces that are surely covered by nearer ones.
//!
//! The test uses a pixel buffer and only skips work. Lines get exact visibility later. The test can miss a
//! step of a gradient in a sliver narrower than a px only.

use crate::parallel::prelude::*;

use crate::lines::Lit;
use crate::lines::tolerances;
use crate::mesh::Mesh;
use crate::view::View;
use crate::view::raster::{FaceBuffer, PixelGrid};

/// Whether any of each face may be visible.
pub(crate) fn visible_faces_of(mesh: &Mesh, view: &View) -> Vec<bool> {
    let screen = PixelGrid::new(mesh, view);
    let buffer = FaceBuffer::new(&screen);
    // Pixels that an extent touches, plus one on each side.
    let pixels = |low: f32, high: f32, count: usize| {
        (low - 1.0).max(0.0) as usize..((high + 2.0).max(0.0) as usize).min(count)
    };
    let is_in_sight = |face: usize| {
        let (corners, _) = screen.triangle(face);
        if corners.iter().flatten().any(|x| !x.is_finite()) {
            return true;
        }
        let low = |axis: usize| corners[0][axis].min(corners[1][axis]).min(corners[2][axis]);
        let high = |axis: usize| corners[0][axis].max(corners[1][axis]).max(corners[2][axis]);
        let columns = pixels(low(0), high(0), buffer.columns);
        let rows = pixels(low(1), high(1), buffer.rows);
        let nearest = high(2) + tolerances::MAX_NEARNESS_ERROR;
        let in_front = |pixel: usize| buffer.nearness(pixel).is_none_or(|nearness| nearness <= nearest);
        columns.len() * rows.len() > MAX_TESTED_PIXELS
            || rows
                .into_iter()
                .any(|row| columns.clone().any(|column| in_front(row * buffer.columns + column)))
    };
    (0..mesh.triangles.len())
        .into_par_iter()
        .with_min_len(1 << 10)
        .with_max_len(1 << 11)
        .map(is_in_sight)
        .collect()
}

/// For each part, whether its faces are drawn where they show their inside: never for solid parts, and for
/// others if the inside covers any pixel. Strokes on hidden insides would disturb their neighbours.
pub(crate) fn shows_inside(lit: &Lit) -> Vec<bool> {
    let Lit { mesh, view, solid, .. } = *lit;
    let count = mesh.face_part.iter().map(|part| part.index() + 1).max().unwrap_or(0);
    // If the near plane cuts a part open, none counts as solid.
    if solid.is_empty() {
        return vec![true; count];
    }
    let mut shows = vec![false; count];
    if (0..mesh.triangles.len()).any(|face| !view.facing[face] && lit.may_be_seen(face)) {
        let buffer = FaceBuffer::new(&PixelGrid::new(mesh, view));
        let fronts = (0..buffer.columns * buffer.rows).filter_map(|pixel| buffer.front(pixel));
        let insides =
            fronts.map(|face| face as usize).filter(|face| !view.facing[*face] && lit.may_be_seen(*face));
        insides.for_each(|face| shows[mesh.face_part[face].index()] = true);
    }
    shows
}

/// Faces whose bounding box has more pixels than this are not tested, and count as visible.
const MAX_TESTED_PIXELS: usize = 1 << 14;

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::mesh::{FaceId, Soup};
    use crate::scene::{Camera, UpAxis};

    #[test]
    fn visible_faces_of_leaves_out_faces_behind_a_sheet() {
        // Three small squares: on the sheet, under it, and under its border.
        let mut positions = Vec::new();
        let mut triangles = Vec::new();
        let squares = [(4.0, 0.0, 0.0), (0.4, 0.0, 1.0), (0.4, 0.0, -0.3), (0.4, 4.4, -0.3)];
        for (half, x, z) in squares {
            let first = positions.len() as u32;
            for (dx, dy) in [(-half, -half), (half, -half), (half, half), (-half, half)] {
                positions.push(DVec3::new(x + dx, dy, z));
            }
            triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        }
        let mesh = Mesh::build(Soup { positions: positions.clone(), triangles, ..Soup::default() });
        let camera = Camera::azimuth_elevation(0.0, 90.0, UpAxis::Z).fit_points(&positions, 0.1);
        let view = View::new(&mesh, &camera);
        for (face, is_in_sight) in visible_faces_of(&mesh, &view).into_iter().enumerate() {
            let middle = mesh.corners(FaceId(face as u32)).into_iter().sum::<DVec3>() / 3.0;
            let middle = middle + mesh.origin;
            let is_under = middle.z < -0.1 && middle.x.abs() < 1.0;
            assert_eq!(is_in_sight, !is_under, "{middle}");
        }
    }
}
