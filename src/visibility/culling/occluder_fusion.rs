//! [`FusedOccluders`]: large occluders fused from faces across edges where the image of the surface does not fold.
//!
//! 1. Neighbouring faces with the same winding in the image are joined (union-find).
//! 2. A group fills every square that it meets and that none of its border edges passes.
//! 3. Such a square gets the nearness of the farthest face of the group that meets it.
//!
//! Many small faces thus hide together what none of them hides alone, except in the squares along their
//! contours.

use crate::geometry::lists::disjoint_sets::DisjointSets;
use crate::parallel::prelude::*;
use glam::{DVec2, DVec3};
use robust::{Coord, orient2d};

use super::nearness_bound::{NearnessBound, UNCOVERED, raise, step};
use crate::geometry::lists::csr_lists::{CsrLists, csr_lists, csr_lists_from_pairs};
use crate::mesh::EdgeSet;
use crate::mesh::{EdgeFaces, FaceId, Mesh};
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::view::View;
use crate::visibility::occlusion::tiled_triangles::TiledTriangles;
use crate::visibility::tiles::tile_grid::{TileBox, TileGrid};
use crate::visibility::tiles::triangle_columns::TriangleHalfPlanes;
use crate::visibility::tolerances;
use crate::visibility::view_tolerances::{FaceTolerances, ViewTolerances};

/// Largest mean face area of a group, in squares. Larger faces fill most of the squares on their own.
const MAX_MEAN_FACE_AREA_CELLS: f64 = 16.0;
/// Largest number of squares in the bounding box of a group, per face. Each group may also use its share of
/// [`CELL_BUDGET`].
const MAX_CELLS_PER_FACE: usize = 64;
const CELL_BUDGET: usize = 4_000_000;

/// Groups of fused faces that may fill a square.
pub(crate) struct FusedOccluders {
    /// Faces of each group.
    faces: CsrLists<u32>,
    /// Border edges of each group.
    ends: CsrLists<u32>,
}

impl FusedOccluders {
    pub(crate) fn new(triangles: &TiledTriangles, cell: f64) -> Self {
        let TiledTriangles { mesh, view, .. } = *triangles;
        let turns: Vec<i8> = (0..mesh.triangles.len())
            .into_par_iter()
            .with_min_len(MIN_TASK_ITEMS)
            .map(|face| winding(mesh, view, face as u32))
            .collect();
        let runs_on = |edge: usize| match mesh.edges.faces(edge) {
            EdgeFaces::Two { faces: [a, b], same_way: false } => {
                let turns = [a, b].map(|face| turns[face as usize]);
                (turns[0] == turns[1] && turns[0] != 0).then_some([a, b])
            }
            _ => None,
        };
        let inner = EdgeSet::collect(mesh.edges.len(), |edge| runs_on(edge).is_some());
        let groups = DisjointSets::new(mesh.triangles.len(), |join| {
            inner.par_for_each(|edge| {
                if let Some([a, b]) = runs_on(edge) {
                    join(a, b);
                }
            });
        });
        let ids = Self::large(view, mesh, &turns, &groups, cell);
        let count = ids.iter().filter(|id| **id != NO_GROUP).max().map_or(0, |id| *id as usize + 1);
        let of = |face: u32| Some(ids[groups.representative(face) as usize]).filter(|id| *id != NO_GROUP);
        let of_face = |face: u32| of(face).map(|id| (id as usize, face));
        let (faces, ends) = crate::parallel::join(
            || csr_lists_from_pairs(count, (0..turns.len() as u32).filter_map(of_face)),
            || {
                csr_lists(count, |put| {
                    for edge in (0..mesh.edges.len()).filter(|edge| !inner.contains(*edge)) {
                        let mut last = None;
                        for id in mesh.edges.faces(edge).list().iter().filter_map(|face| of(*face)) {
                            if last.replace(id) != Some(id) {
                                put(id as usize, edge as u32);
                            }
                        }
                    }
                })
            },
        );
        Self { faces, ends }
    }

    /// Indices of the usable groups, by root face; [`NO_GROUP`] for all other faces.
    ///
    /// A usable group is at least as large as a square, and respects the limits on box size and face area.
    fn large(view: &View, mesh: &Mesh, turns: &[i8], groups: &DisjointSets, cell: f64) -> Vec<u32> {
        let mut found: Vec<(u32, [f32; 4], u32, f64)> = Vec::new();
        let mut ids = vec![NO_GROUP; turns.len()];
        for face in (0..turns.len()).filter(|face| turns[*face] != 0) {
            let id = &mut ids[groups.representative(face as u32) as usize];
            if *id == NO_GROUP {
                *id = found.len() as u32;
                found.push((
                    face as u32,
                    [f32::INFINITY, f32::INFINITY, f32::NEG_INFINITY, f32::NEG_INFINITY],
                    0,
                    0.0,
                ));
            }
            let (_, bounds, count, area) = &mut found[*id as usize];
            let [a, b, c] = mesh.triangles[face].map(|v| view.points[v as usize].truncate());
            *count += 1;
            *area += (b - a).perp_dot(c - a).abs() / 2.0;
            for v in mesh.triangles[face] {
                let p = view.points[v as usize];
                let (x, y) = (p.x as f32, p.y as f32);
                *bounds = [bounds[0].min(x), bounds[1].min(y), bounds[2].max(x), bounds[3].max(y)];
            }
        }
        let share = CELL_BUDGET / found.len().max(1);
        let mut next = 0;
        for (root, [left, top, right, bottom], count, area) in found {
            let (width, height) = (f64::from(right - left) / cell, f64::from(bottom - top) / cell);
            let max_cells = (MAX_CELLS_PER_FACE * count as usize + share) as f64;
            let is_fine = area <= MAX_MEAN_FACE_AREA_CELLS * cell * cell * f64::from(count);
            let is_wanted =
                is_fine && width >= 1.0 && height >= 1.0 && (width + 2.0) * (height + 2.0) <= max_cells;
            ids[root as usize] = if is_wanted { next } else { NO_GROUP };
            next += u32::from(is_wanted);
        }
        ids
    }

    pub(crate) fn count(&self) -> usize {
        self.faces.count()
    }

    /// Raises the value of each square that a group fills.
    pub(crate) fn add(
        &self,
        expanse: usize,
        triangles: &TiledTriangles,
        squares: &TileGrid,
        buffer: &mut Vec<f32>,
        cover: &mut [f32],
    ) {
        let TiledTriangles { mesh, view, limits, .. } = *triangles;
        let corners = |face: u32| mesh.triangles[face as usize].map(|v| view.points[v as usize]);
        let all = self.faces.of(expanse).iter().flat_map(|face| corners(*face));
        let (low, high) =
            all.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
        let covered_box = squares.tile_box(low, high);
        if covered_box.is_empty() {
            return;
        }
        let filled = &mut FillBuffer::new(squares, covered_box, buffer);
        for face in self.faces.of(expanse) {
            let slack = FaceTolerances::of(mesh.extent(FaceId(*face)));
            let corners = corners(*face);
            filled.meet(&corners, step(&corners, limits, &slack, &view.frame), limits);
        }
        for edge in self.ends.of(expanse) {
            let ends = mesh.edges.vertices[*edge as usize].map(|v| view.points[v as usize].truncate());
            filled.end(ends);
        }
        for row in covered_box.top..=covered_box.bottom {
            let first = squares.tile(u32::from(covered_box.left), u32::from(row));
            let (offset, width) = (filled.place(row, covered_box.left), filled.width);
            for (cover, lowest) in
                cover[first..first + width].iter_mut().zip(&filled.lowest_nearness[offset..offset + width])
            {
                raise(cover, if *lowest < f32::INFINITY { *lowest } else { UNCOVERED });
            }
        }
    }
}

const NO_GROUP: u32 = u32::MAX;

/// Squares in the bounding box of a group.
///
/// `lowest_nearness` holds the nearness of the farthest face that meets each square: ∞ if none does, −∞ where the group
/// ends.
struct FillBuffer<'a> {
    squares: &'a TileGrid,
    region: TileBox,
    width: usize,
    lowest_nearness: &'a mut [f32],
}

impl<'a> FillBuffer<'a> {
    fn new(squares: &'a TileGrid, own: TileBox, buffer: &'a mut Vec<f32>) -> Self {
        let width = usize::from(own.right - own.left) + 1;
        let height = usize::from(own.bottom - own.top) + 1;
        buffer.clear();
        buffer.resize(width * height, f32::INFINITY);
        Self { squares, region: own, width, lowest_nearness: buffer }
    }

    fn place(&self, row: u16, column: u16) -> usize {
        usize::from(row - self.region.top) * self.width + usize::from(column - self.region.left)
    }

    fn meet(&mut self, points: &[DVec3; 3], step: f64, limits: &ViewTolerances) {
        let (squares, cell) = (self.squares, self.squares.cell);
        let low = points[0].min(points[1]).min(points[2]);
        let high = points[0].max(points[1]).max(points[2]);
        let tiles = squares
            .tile_box(
                low - cell * tolerances::FUSED_FACE_MARGIN_OF_SQUARE,
                high + cell * tolerances::FUSED_FACE_MARGIN_OF_SQUARE,
            )
            .within(self.region);
        if tiles.is_empty() {
            return;
        }
        let half = cell * (0.5 + 2.0 * tolerances::FUSED_FACE_MARGIN_OF_SQUARE);
        let slope = NearnessBound::new(points, half, step, limits);
        let sides = (tiles.area() > 1).then(|| TriangleHalfPlanes::new(points));
        for row in tiles.top..=tiles.bottom {
            let all_columns = u32::from(tiles.left)..u32::from(tiles.right) + 1;
            let columns =
                sides.as_ref().map_or(all_columns, |sides| sides.columns(squares, tiles, row, half));
            if columns.is_empty() {
                continue;
            }
            let centre = squares.corner(columns.start, u32::from(row)) + cell / 2.0;
            let first = self.place(row, columns.start as u16);
            let row_nearness = &mut self.lowest_nearness[first..first + columns.len()];
            let over = slope.over(centre, cell, columns.len());
            row_nearness
                .iter_mut()
                .zip(over)
                .for_each(|(own, bound)| *own = if bound < *own { bound } else { *own });
        }
    }

    /// Marks the squares that a border edge passes.
    fn end(&mut self, [a, b]: [DVec2; 2]) {
        let (squares, reach) = (self.squares, self.squares.cell * tolerances::FUSED_BORDER_MARGIN_OF_SQUARE);
        let (low, high) = (a.min(b) - reach, a.max(b) + reach);
        let tiles = squares.tile_box(low.extend(0.0), high.extend(0.0)).within(self.region);
        if tiles.is_empty() {
            return;
        }
        let direction = b - a;
        for row in tiles.top..=tiles.bottom {
            let top = squares.corner(0, u32::from(row)).y - reach;
            let bottom = top + squares.cell + 2.0 * reach;
            // Part of the edge within the row.
            let (mut from, mut to) = (0.0, 1.0);
            if direction.y != 0.0 {
                let at = [top, bottom].map(|y| (y - a.y) / direction.y);
                (from, to) = (at[0].min(at[1]).clamp(0.0, 1.0), at[0].max(at[1]).clamp(0.0, 1.0));
            }
            let at = [from, to].map(|t| a.x + direction.x * t);
            let left = squares.column(at[0].min(at[1]) - reach).max(u32::from(tiles.left)) as u16;
            let right = squares.column(at[0].max(at[1]) + reach).min(u32::from(tiles.right)) as u16;
            if left <= right {
                let first = self.place(row, left);
                self.lowest_nearness[first..=first + usize::from(right - left)].fill(f32::NEG_INFINITY);
            }
        }
    }
}

/// Winding of a face in the image, 1 or −1; 0 if the near plane cuts it or it has no area.
fn winding(mesh: &Mesh, view: &View, face: u32) -> i8 {
    let points = mesh.triangles[face as usize].map(|v| view.points[v as usize]);
    if points.iter().any(|p| p.z.is_nan()) || mesh.is_degenerate(FaceId(face)) {
        return 0;
    }
    let [a, b, c] = points.map(|p| Coord { x: p.x, y: p.y });
    let area = orient2d(a, b, c);
    i8::from(area > 0.0) - i8::from(area < 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Soup;
    use crate::scene::Camera;

    /// Dented ball of many faces with a wavy sheet through it, in one view.
    fn scene() -> (Mesh, View) {
        let mut soup = Soup::default();
        let n = 24u32;
        let mut surface = |point: &dyn Fn(f64, f64) -> DVec3, closed: bool| {
            let first = soup.positions.len() as u32;
            for i in 0..=n {
                let count = if closed { n } else { n + 1 };
                soup.positions.extend(
                    (0..count).map(|k| point(f64::from(i) / f64::from(n), f64::from(k) / f64::from(n))),
                );
                let at = |i: u32, k: u32| first + i * count + if closed { k % n } else { k };
                if i < n {
                    for k in 0..n {
                        soup.triangles.push([at(i, k), at(i + 1, k), at(i + 1, k + 1)]);
                        soup.triangles.push([at(i, k), at(i + 1, k + 1), at(i, k + 1)]);
                    }
                }
            }
        };
        let turn = std::f64::consts::TAU;
        let (sin, cos) =
            (crate::geometry::numbers::portable_math::sin, crate::geometry::numbers::portable_math::cos);
        surface(
            &|i, k| {
                let (up, round) = (turn / 2.0 * i, turn * k);
                let radius = 1.0 + 0.15 * sin(5.0 * round) * sin(3.0 * up);
                DVec3::new(sin(up) * cos(round), sin(up) * sin(round), cos(up)) * radius
            },
            true,
        );
        surface(&|i, k| DVec3::new(3.0 * i - 1.5, 3.0 * k - 1.5, 0.4 * sin(9.0 * i) * cos(7.0 * k)), false);
        let mesh = Mesh::build(soup);
        let points: Vec<DVec3> = mesh.positions.iter().map(|p| *p + mesh.origin).collect();
        let camera = Camera::three_quarter().with_frame(200.0, 200.0).fit_points(&points, 0.05);
        let view = View::new(&mesh, &camera);
        (mesh, view)
    }

    #[test]
    fn fused_occluder_bounds_lie_behind_the_nearest_face() {
        let (mesh, view) = scene();
        let limits = ViewTolerances::new(&view.frame);
        for across in [20, 64, 100] {
            let grid = TileGrid::new(DVec2::ZERO, DVec2::splat(200.0), across);
            let triangles = TiledTriangles { mesh: &mesh, view: &view, grid: &grid, limits: &limits };
            let expanses = FusedOccluders::new(&triangles, grid.cell);
            let mut cover = vec![UNCOVERED; grid.len()];
            for expanse in 0..expanses.count() {
                expanses.add(expanse, &triangles, &grid, &mut Vec::new(), &mut cover);
            }
            let mut filled = 0;
            for square in (0..grid.len()).filter(|square| cover[*square].is_finite()) {
                filled += 1;
                let corner = grid.corner(square as u32 % grid.columns, square as u32 / grid.columns);
                for (x, y) in [(0.01, 0.01), (0.99, 0.02), (0.03, 0.98), (0.97, 0.99), (0.5, 0.5), (0.3, 0.8)]
                {
                    let p = corner + DVec2::new(x, y) * grid.cell;
                    let nearness = |face: &[u32; 3]| {
                        let [a, b, c] = face.map(|v| view.points[v as usize]);
                        let (u, v, w) = ((b - a).truncate(), (c - a).truncate(), p - a.truncate());
                        let (s, t) = (w.perp_dot(v) / u.perp_dot(v), u.perp_dot(w) / u.perp_dot(v));
                        (s >= 0.0 && t >= 0.0 && s + t <= 1.0)
                            .then_some(a.z + s * (b.z - a.z) + t * (c.z - a.z))
                    };
                    let nearest =
                        mesh.triangles.iter().filter_map(nearness).fold(f64::NEG_INFINITY, f64::max);
                    assert!(
                        nearest > f64::from(cover[square]),
                        "{across}: {nearest} before {} at {p}",
                        cover[square]
                    );
                }
            }
            // The ball and the sheet cover about four tenths of the image.
            assert!(filled * 4 > grid.len(), "{across}: {filled} of {}", grid.len());
        }
    }
}
