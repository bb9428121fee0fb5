//! [`front_faces`]: the nearest face at given points of the image.
//!
//! All lines of sight leave one point. So the points are sorted into a grid over the image, and every face
//! visits the points in its bounding box. No spatial tree is needed.

use std::ops::Range;

use crate::parallel::prelude::*;
use glam::{DVec2, DVec3};

use crate::geometry::lists::csr_lists::{CsrLists, csr_lists_from_pairs};
use crate::mesh::{FaceId, Mesh};
use crate::view::View;
use crate::visibility::tolerances;

/// Nearest face at a point of the image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FrontFace {
    /// Index of the face.
    pub face: u32,
    /// Nearness of the face at the point, in image space.
    pub nearness: f64,
}

/// Faces per task.
const FACES_PER_TASK: usize = 1 << 12;

/// Mean number of points per cell of the grid.
const POINTS_PER_CELL: usize = 2;

/// Largest number of cells across the image.
const MAX_CELLS_ACROSS: usize = 512;

/// Finds the nearest face at each point (user units); `None` where there is no face.
///
/// Faces without area or seen edge-on cover nothing. A point on the edge between two faces gets one of them;
/// of equally near faces, the one with the smaller id. The number of threads has no effect. Where surfaces of
/// different colours overlap in one plane, the top one is returned: see [`Overlay`](crate::mesh::Overlay).
#[must_use]
pub(crate) fn front_faces(mesh: &Mesh, view: &View, points: &[DVec2]) -> Vec<Option<FrontFace>> {
    let Some(grid) = PointGrid::new(points) else { return Vec::new() };
    let face_count = mesh.triangles.len();
    let count = face_count + view.clipped.len();
    let tasks: Vec<Vec<(u32, FrontFace)>> = (0..count.div_ceil(FACES_PER_TASK))
        .into_par_iter()
        .with_max_len(1)
        .map(|task| {
            let mut hits = Vec::new();
            for id in task * FACES_PER_TASK..((task + 1) * FACES_PER_TASK).min(count) {
                match id.checked_sub(face_count) {
                    None => {
                        let t = mesh.triangles[id];
                        if !mesh.is_degenerate(FaceId(id as u32)) {
                            let corners = t.map(|v| view.points[v as usize]);
                            grid.cover(&corners, t, id as u32, &mut hits);
                        }
                    }
                    Some(k) => {
                        let clipped = &view.clipped[k];
                        grid.cover(&clipped.points, [0, 1, 2], clipped.face.0, &mut hits);
                    }
                }
            }
            hits
        })
        .collect();
    let mut fronts: Vec<Option<FrontFace>> = vec![None; points.len()];
    for (point, hit) in tasks.iter().flatten() {
        let front = &mut fronts[*point as usize];
        let nearer =
            |f: &FrontFace| hit.nearness > f.nearness || (hit.nearness == f.nearness && hit.face < f.face);
        if front.as_ref().is_none_or(nearer) {
            *front = Some(*hit);
        }
    }
    // Rounding alone decides which of two surfaces in one plane is nearer, so overlays are applied
    // afterwards.
    for (point, hit) in tasks.iter().flatten().filter(|_| !mesh.overlays.is_empty()) {
        if let Some(front) = &mut fronts[*point as usize]
            && mesh.is_over(hit.face, front.face)
        {
            *front = *hit;
        }
    }
    fronts
}

/// Points of the image in a grid of cells.
struct PointGrid {
    low: DVec2,
    high: DVec2,
    cells_per_unit: DVec2,
    across: usize,
    /// Points of each cell with their indices, row by row, so that the cells of a face in one row are
    /// contiguous.
    cells: CsrLists<(DVec2, u32)>,
}

impl PointGrid {
    fn new(points: &[DVec2]) -> Option<Self> {
        let first = *points.first()?;
        let (low, high) = points.iter().fold((first, first), |(low, high), p| (low.min(*p), high.max(*p)));
        let across = ((points.len() / POINTS_PER_CELL) as f64).sqrt() as usize;
        let across = across.clamp(1, MAX_CELLS_ACROSS);
        let size = high - low;
        let per_unit = |size: f64| if size > 0.0 { across as f64 / size } else { 0.0 };
        let cells_per_unit = DVec2::new(per_unit(size.x), per_unit(size.y));
        let grid = Self { low, high, cells_per_unit, across, cells: CsrLists::default() };
        let in_cell = |(i, p): (usize, &DVec2)| {
            let [x, y] = grid.cell(*p);
            (y * across + x, (*p, i as u32))
        };
        let cells = csr_lists_from_pairs(across * across, points.iter().enumerate().map(in_cell));
        Some(Self { cells, ..grid })
    }

    fn cell(&self, p: DVec2) -> [usize; 2] {
        let at = (p - self.low) * self.cells_per_unit;
        [at.x, at.y].map(|x| (x.max(0.0) as usize).min(self.across - 1))
    }

    /// Columns and rows of the cells that the box from `low` to `high` touches.
    fn touched(&self, low: DVec2, high: DVec2) -> Option<[Range<usize>; 2]> {
        if low.cmpgt(self.high).any() || high.cmplt(self.low).any() {
            return None;
        }
        let ([x0, y0], [x1, y1]) = (self.cell(low), self.cell(high));
        Some([x0..x1 + 1, y0..y1 + 1])
    }

    /// Adds the points that a triangle covers.
    fn cover(&self, corners: &[DVec3; 3], ids: [u32; 3], face: u32, hits: &mut Vec<(u32, FrontFace)>) {
        if corners.iter().any(|c| c.z.is_nan()) {
            return;
        }
        let [a, b, c] = [corners[0].truncate(), corners[1].truncate(), corners[2].truncate()];
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let Some([columns, rows]) = self.touched(low, high) else { return };
        let area = (b - a).perp_dot(c - a);
        if area == 0.0 {
            return;
        }
        // Each side is evaluated from its vertex with the smaller id, so both its faces get the same sign.
        let side = |i: usize, j: usize, p: DVec2| {
            let turn = |from: DVec3, to: DVec3| {
                let from = from.truncate();
                (to.truncate() - from).perp_dot(p - from)
            };
            let turn =
                if ids[i] < ids[j] { turn(corners[i], corners[j]) } else { -turn(corners[j], corners[i]) };
            if area > 0.0 { turn } else { -turn }
        };
        // Most points of these cells are outside the bounding box, which is cheaper to test than the sides.
        // The margin exceeds the rounding error of the side test.
        let margin = low.abs().max(high.abs()) * tolerances::FACE_BOX_OF_COORDINATE;
        let (low, high) = (low - margin, high + margin);
        for row in rows {
            let first = row * self.across;
            for (p, point) in self.cells.of_all(first + columns.start..first + columns.end) {
                if p.x < low.x || p.x > high.x || p.y < low.y || p.y > high.y {
                    continue;
                }
                let weights = [side(1, 2, *p), side(2, 0, *p), side(0, 1, *p)];
                if weights.iter().all(|w| *w >= 0.0) {
                    let sum: f64 = weights.iter().sum();
                    let nearness: f64 = (0..3).map(|k| corners[k].z * (weights[k] / sum)).sum();
                    hits.push((*point, FrontFace { face, nearness }));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::dice::Dice;
    use crate::mesh::Soup;
    use crate::scene::{Camera, UpAxis};

    #[test]
    fn front_faces_finds_the_nearest_face_of_stacked_sheets() {
        // Three stacked sheets, each smaller than the one below.
        let mut positions = Vec::new();
        let mut triangles = Vec::new();
        for (height, half) in [(0.0, 4.0), (1.0, 2.0), (2.0, 1.0)] {
            let first = positions.len() as u32;
            for (x, y) in [(-half, -half), (half, -half), (half, half), (-half, half)] {
                positions.push(DVec3::new(x, y, height));
            }
            triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        }
        let mesh = Mesh::build(Soup { positions: positions.clone(), triangles, ..Soup::default() });
        let camera = Camera::azimuth_elevation(0.0, 90.0, UpAxis::Z).fit_points(&positions, 0.1);
        let view = View::new(&mesh, &camera);
        let mut query_points = Vec::new();
        let mut wanted = Vec::new();
        for i in 0..60 {
            for k in 0..60 {
                let (x, y) = (-4.9 + 9.8 * f64::from(i) / 59.0, -4.9 + 9.8 * f64::from(k) / 59.0);
                let reach = x.abs().max(y.abs());
                let sheet = [1.0, 2.0, 4.0].iter().position(|half| reach < *half).map(|k| 2 - k);
                let height = sheet.map_or(0.0, |sheet| sheet as f64);
                let image = view.frame.image_from_local(DVec3::new(x, y, height) - mesh.origin);
                query_points.push(image.truncate());
                wanted.push(sheet);
            }
        }
        let found = front_faces(&mesh, &view, &query_points);
        let perspective_hides = |sheet: Option<usize>, front: Option<usize>| front > sheet;
        for (front, sheet) in found.iter().zip(&wanted) {
            let front = front.map(|front| front.face as usize / 2);
            assert!(front == *sheet || perspective_hides(*sheet, front), "{front:?} {sheet:?}");
        }
        assert!(
            found.iter().zip(&wanted).filter(|(f, w)| f.map(|f| f.face as usize / 2) == **w).count() > 3000
        );
    }

    #[test]
    fn front_faces_matches_brute_force_over_all_faces() {
        let mut dice = Dice::new(3);
        for size in [0.02, 0.3, 2.0] {
            let mut positions = Vec::new();
            for _ in 0..300 {
                let middle = dice.point(1.0);
                positions.extend([0, 1, 2].map(|_| middle + dice.point(size)));
            }
            let triangles: Vec<[u32; 3]> = (0..300).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
            let mesh = Mesh::build(Soup { positions: positions.clone(), triangles, ..Soup::default() });
            let camera = Camera::azimuth_elevation(30.0, 20.0, UpAxis::Z).fit_points(&positions, 0.1);
            let view = View::new(&mesh, &camera);
            // Random points, and the corners of faces.
            let (width, height) = (camera.width, camera.height);
            let anywhere = || DVec2::new(dice.between(0.0, width), dice.between(0.0, height));
            let mut query_points: Vec<DVec2> = std::iter::repeat_with(anywhere).take(2000).collect();
            query_points.extend(view.points.iter().map(|p| p.truncate()));
            let found = front_faces(&mesh, &view, &query_points);
            let mut covered = 0;
            for (k, (p, found)) in query_points.iter().zip(&found).enumerate() {
                let covering = mesh.triangles.iter().filter_map(|t| {
                    let [a, b, c] = t.map(|v| view.points[v as usize]);
                    let side = |a: DVec3, b: DVec3| (b - a).truncate().perp_dot(*p - a.truncate());
                    let weights = [side(b, c), side(c, a), side(a, b)];
                    let sum: f64 = weights.iter().sum();
                    let min_weight = weights.iter().map(|w| w / sum).fold(f64::INFINITY, f64::min);
                    (min_weight >= 1e-9).then(|| (a * weights[0] + b * weights[1] + c * weights[2]).z / sum)
                });
                let inside = covering.fold(f64::NEG_INFINITY, f64::max);
                let corner = k.checked_sub(2000).map_or(f64::NEG_INFINITY, |v| view.points[v].z);
                let nearest = inside.max(corner);
                let told = found.map_or(f64::NEG_INFINITY, |front| front.nearness);
                assert!(told == nearest || (told - nearest).abs() < 1e-9, "{p} {told} {nearest}");
                covered += usize::from(nearest.is_finite());
            }
            assert!(covered > 900, "{covered}");
        }
    }
}
