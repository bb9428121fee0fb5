//! [`TiledTriangles`]: the triangles over each tile that may hide something there.
//!
//! Only tiles with undecided segments are filled, and only with triangles in front of the occlusion buffer
//! (see [`crate::visibility::culling::occlusion_buffer`]).

use crate::parallel::prelude::*;
use glam::DVec3;

use crate::geometry::lists::csr_lists::{CsrLists, csr_lists_from_pairs};
use crate::mesh::{FaceId, Mesh};
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::view::View;
use crate::visibility::tiles::tile_grid::{TileBox, TileGrid, TileReach};
use crate::visibility::tiles::triangle_columns::TriangleHalfPlanes;
use crate::visibility::tolerances;
use crate::visibility::view_tolerances::{FaceTolerances, ViewTolerances};

/// Bounds of a triangle in the image, enough to reject most comparisons.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct OccluderBounds {
    /// Minimum x, maximum x, minimum y and maximum y in the image, rounded outward.
    pub bounds: [f32; 4],
    /// Maximum nearness, rounded towards the eye.
    pub nearest: f32,
    /// Triangle id: a face, or after all faces an entry of [`View::clipped`].
    pub id: u32,
}

/// Triangle that may hide lines, with everything the exact comparison needs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Occluder {
    /// Face it belongs to.
    pub face: u32,
    /// Vertex ids of that face.
    pub ids: [u32; 3],
    /// Corners in image space.
    pub corners: [DVec3; 3],
    /// Tolerances for touching it, independent of the view.
    pub slack: FaceTolerances,
}

/// The triangles of a view over a grid of tiles.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TiledTriangles<'a> {
    /// The mesh.
    pub mesh: &'a Mesh,
    /// The view of it.
    pub view: &'a View,
    /// The tiles.
    pub grid: &'a TileGrid,
    /// The tolerances of the view.
    pub limits: &'a ViewTolerances,
}

/// Corners in image space and face of a triangle id.
#[inline]
#[must_use]
pub(crate) fn corners(mesh: &Mesh, view: &View, id: u32) -> ([DVec3; 3], u32) {
    match mesh.triangles.get(id as usize) {
        Some(t) => (t.map(|v| view.points[v as usize]), id),
        None => {
            let clipped = &view.clipped[id as usize - mesh.triangles.len()];
            (clipped.points, clipped.face.0)
        }
    }
}

impl TiledTriangles<'_> {
    /// Number of faces plus clipped parts of faces.
    pub(crate) fn count(&self) -> usize {
        self.mesh.triangles.len() + self.view.clipped.len()
    }

    /// Triangles per task; depends only on their number.
    fn chunk(&self) -> usize {
        self.count().div_ceil(16).max(1 << 11)
    }

    /// Tiles that each triangle's bounding box meets; an empty block for triangles that hide nothing or are
    /// off the grid.
    #[must_use]
    pub(crate) fn tile_boxes(&self) -> Vec<TileBox> {
        // A vertex is a corner of six triangles on average, so its range of tiles is computed once.
        let slack = self.slack();
        let of_vertex = |p: &DVec3| if p.z.is_nan() { TileReach::CUT } else { self.grid.around(*p, slack) };
        let vertices: Vec<TileReach> =
            self.view.points.par_iter().with_min_len(MIN_TASK_ITEMS).map(of_vertex).collect();
        let of_triangle = |id: usize| match self.mesh.triangles.get(id) {
            Some(_) if self.mesh.is_degenerate(FaceId(id as u32)) => TileBox::EMPTY,
            Some(t) => self.grid.tiles_within(TileReach::of_all(t.map(|v| vertices[v as usize]))),
            None => self.tile_box(id as u32),
        };
        (0..self.count()).into_par_iter().with_min_len(MIN_TASK_ITEMS).map(of_triangle).collect()
    }

    /// Margin of the bounding boxes, user units, because lines are also tested slightly next to themselves.
    pub(crate) fn slack(&self) -> f64 {
        (self.grid.cell * tolerances::BOX_MARGIN_OF_TILE).max(2.0 * self.limits.side_offset)
    }

    #[inline]
    fn tile_box(&self, id: u32) -> TileBox {
        let (points, face) = corners(self.mesh, self.view, id);
        let cut = points[0].z.is_nan() || points[1].z.is_nan() || points[2].z.is_nan();
        if cut || self.mesh.is_degenerate(FaceId(face)) {
            return TileBox::EMPTY;
        }
        let slack = self.slack();
        let low = points[0].min(points[1]).min(points[2]) - slack;
        let high = points[0].max(points[1]).max(points[2]) + slack;
        self.grid.tile_box(low, high)
    }

    /// Mean number of triangles over each other, over the grid.
    pub(crate) fn mean_layers(&self) -> f64 {
        // A sample is enough; its order is fixed.
        let step = (self.count() / 4_000).max(1);
        step as f64 * self.layers_of((0..self.count() as u32).step_by(step))
    }

    /// Area of a triangle in the image; 0 where the near plane cuts it.
    pub(crate) fn area(&self, id: u32) -> f64 {
        let ([a, b, c], _) = corners(self.mesh, self.view, id);
        let area = (b - a).truncate().perp_dot((c - a).truncate()).abs() / 2.0;
        if area.is_finite() { area } else { 0.0 }
    }

    /// Mean number of layers of the given triangles, over the grid.
    pub(crate) fn layers_of(&self, ids: impl Iterator<Item = u32>) -> f64 {
        let tile = self.grid.cell * self.grid.cell;
        ids.map(|id| self.area(id)).sum::<f64>() / (tile * self.grid.len() as f64)
    }

    /// Triangle with this id: a face, or after all faces an entry of [`View::clipped`].
    #[inline]
    #[must_use]
    pub(crate) fn occluder(&self, id: u32) -> Occluder {
        let (corners, face) = corners(self.mesh, self.view, id);
        Occluder {
            face,
            ids: self.mesh.triangles[face as usize],
            corners,
            slack: FaceTolerances::of(self.mesh.extent(FaceId(face))),
        }
    }

    /// Bounds of the triangle with this id.
    #[inline]
    #[must_use]
    pub(crate) fn reach(&self, id: u32) -> OccluderBounds {
        let (corners, _) = corners(self.mesh, self.view, id);
        let nearest = corners[0].z.max(corners[1].z).max(corners[2].z);
        OccluderBounds { bounds: outward_box(&corners), nearest: (nearest as f32).next_up(), id }
    }

    /// Face that a triangle belongs to.
    #[inline]
    pub(crate) fn face(&self, id: u32) -> u32 {
        match (id as usize).checked_sub(self.mesh.triangles.len()) {
            None => id,
            Some(clipped) => self.view.clipped[clipped].face.0,
        }
    }

    /// Ids of the triangles over each tile that are at least as near as its value in `farthest`, ascending.
    /// Nothing is listed where that is ∞.
    ///
    /// Takes `boxes` by value, so they are freed before the result is built.
    #[must_use]
    pub(crate) fn fill(&self, boxes: Vec<TileBox>, farthest: &[f64]) -> CsrLists<u32> {
        let chunk = self.chunk();
        let found: Vec<Vec<(u32, u32)>> = boxes
            .par_chunks(chunk)
            .with_max_len(1)
            .enumerate()
            .map(|(k, boxes)| {
                let mut pairs = Vec::new();
                for (i, tiles) in boxes.iter().enumerate() {
                    self.add_tiles((k * chunk + i) as u32, *tiles, farthest, &mut pairs);
                }
                pairs
            })
            .collect();
        drop(boxes);
        csr_lists_from_pairs(self.grid.len(), found.iter().flatten().map(|(tile, id)| (*tile as usize, *id)))
    }

    /// Adds a pair of tile and triangle for each tile where the triangle may matter.
    #[inline]
    fn add_tiles(&self, id: u32, tiles: TileBox, farthest: &[f64], pairs: &mut Vec<(u32, u32)>) {
        if tiles.is_empty() {
            return;
        }
        // For boxes of few tiles, the exact test costs more than it saves.
        if tiles.area() <= 4 {
            for row in tiles.top..=tiles.bottom {
                for column in tiles.left..=tiles.right {
                    let tile = self.grid.tile(u32::from(column), u32::from(row));
                    let least = farthest[tile];
                    if least == f64::NEG_INFINITY || (least < f64::INFINITY && self.nearest(id) >= least) {
                        pairs.push((tile as u32, id));
                    }
                }
            }
            return;
        }
        let (points, _) = corners(self.mesh, self.view, id);
        let nearest = points[0].z.max(points[1].z).max(points[2].z);
        let sides = TriangleHalfPlanes::new(&points);
        let reach =
            self.grid.cell / 2.0 * (1.0 + tolerances::TILE_MARGIN_OF_TILE) + 2.0 * self.limits.side_offset;
        for row in tiles.top..=tiles.bottom {
            for column in sides.columns(self.grid, tiles, row, reach) {
                let tile = self.grid.tile(column, u32::from(row));
                if nearest >= farthest[tile] {
                    pairs.push((tile as u32, id));
                }
            }
        }
    }

    fn nearest(&self, id: u32) -> f64 {
        let (points, _) = corners(self.mesh, self.view, id);
        points[0].z.max(points[1].z).max(points[2].z)
    }
}

fn outward_box(points: &[DVec3; 3]) -> [f32; 4] {
    let low = points[0].min(points[1]).min(points[2]);
    let high = points[0].max(points[1]).max(points[2]);
    let pad = tolerances::BOX_MARGIN_UNITS;
    [
        ((low.x - pad) as f32).next_down(),
        ((high.x + pad) as f32).next_up(),
        ((low.y - pad) as f32).next_down(),
        ((high.y + pad) as f32).next_up(),
    ]
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::geometry::dice::Dice;
    use crate::mesh::Soup;
    use crate::scene::Camera;

    #[test]
    fn tile_boxes_match_the_box_of_each_triangle() {
        let mut dice = Dice::new(3);
        let mut soup = Soup::default();
        for k in 0..3000u32 {
            let middle = dice.point(2.0);
            soup.positions.extend([0; 3].map(|_| middle + dice.point(0.4)));
            soup.triangles.push([3 * k, 3 * k + 1, 3 * k + 2]);
        }
        let mesh = Mesh::build(soup);
        // The camera is among the triangles, so some are behind the eye and some are cut.
        let camera = Camera { eye: glam::DVec3::new(0.3, -1.2, 0.4), ..Camera::three_quarter() };
        let view = View::new(&mesh, &camera);
        let limits = ViewTolerances::new(&view.frame);
        assert!(!view.clipped.is_empty() && view.points.iter().any(|p| p.z.is_nan()));
        for (low, high, across) in [(100.0, 400.0, 64), (-2000.0, 3000.0, 300), (480.0, 481.0, 7)] {
            let grid = TileGrid::new(DVec2::splat(low), DVec2::splat(high), across);
            let triangles = TiledTriangles { mesh: &mesh, view: &view, grid: &grid, limits: &limits };
            let boxes = triangles.tile_boxes();
            assert!(
                boxes.iter().any(|tiles| !tiles.is_empty()) && boxes.iter().any(|tiles| tiles.is_empty())
            );
            for (id, tiles) in boxes.iter().enumerate() {
                assert_eq!(*tiles, triangles.tile_box(id as u32), "{id} from {low} to {high}");
            }
        }
    }
}
