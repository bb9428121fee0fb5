//! Which triangles may hide something in which tile.
//!
//! Only tiles that hold a segment not yet decided are filled. Where one triangle covers a whole
//! tile, everything behind it there is hidden by it alone, so neither segments nor triangles
//! behind such a *cover* need to be looked at.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::grid::{Grid, TileBox};
use super::occlude::Limits;
use crate::mesh::{FaceId, Mesh};
use crate::view::View;

/// A triangle in a tile, with its box in the image rounded outward.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Occluder {
    /// Least x, greatest x, least y, greatest y.
    pub bounds: [f32; 4],
    /// Greatest nearness of any of its points, rounded towards the eye.
    pub nearest: f32,
    /// A face, or beyond those, an entry of [`View::clipped`].
    pub id: u32,
}

/// The triangles of a view over a grid of tiles.
#[derive(Debug, Clone, Copy)]
pub struct Triangles<'a> {
    /// The mesh.
    pub mesh: &'a Mesh,
    /// The view of it.
    pub view: &'a View,
    /// The tiles.
    pub grid: &'a Grid,
    /// The tolerances of the view.
    pub limits: &'a Limits,
}

/// The occluders of every tile, tile after tile.
#[derive(Debug, Clone, Default)]
pub struct Occluders {
    starts: Vec<u32>,
    entries: Vec<Occluder>,
}

impl Occluders {
    /// The occluders of a tile.
    #[inline]
    #[must_use]
    pub fn of_tile(&self, tile: usize) -> &[Occluder] {
        &self.entries[self.starts[tile] as usize..self.starts[tile + 1] as usize]
    }
}

/// The corners in image space and the face of an occluder.
#[inline]
#[must_use]
pub fn corners(mesh: &Mesh, view: &View, id: u32) -> ([DVec3; 3], u32) {
    match mesh.triangles.get(id as usize) {
        Some(t) => (t.map(|v| view.points[v as usize]), id),
        None => {
            let clipped = &view.clipped[id as usize - mesh.triangles.len()];
            (clipped.points, clipped.face.0)
        }
    }
}

impl Triangles<'_> {
    /// Faces and, after them, what the near plane left of faces it cuts.
    fn count(&self) -> usize {
        self.mesh.triangles.len() + self.view.clipped.len()
    }

    /// Triangles a task takes: a share of all that depends on nothing but their number.
    fn chunk(&self) -> usize {
        self.count().div_ceil(16).max(1 << 13)
    }

    /// The tiles that each triangle's box meets; an empty box for triangles that hide nothing or
    /// lie off the grid.
    #[must_use]
    pub fn tile_boxes(&self) -> Vec<TileBox> {
        (0..self.count()).into_par_iter().with_min_len(1 << 12).map(|id| self.tile_box(id as u32)).collect()
    }

    #[inline]
    fn tile_box(&self, id: u32) -> TileBox {
        let (points, face) = corners(self.mesh, self.view, id);
        let cut = points[0].z.is_nan() || points[1].z.is_nan() || points[2].z.is_nan();
        if cut || self.mesh.is_degenerate(FaceId(face)) {
            return TileBox::EMPTY;
        }
        // Lines are also asked about a little beside themselves.
        let slack = (self.grid.cell * 1e-6).max(2.0 * self.limits.beside);
        let low = points[0].min(points[1]).min(points[2]) - slack;
        let high = points[0].max(points[1]).max(points[2]) + slack;
        self.grid.tile_box(low, high)
    }

    /// For each tile the nearness behind which everything is hidden by one triangle, or −∞.
    #[must_use]
    pub fn covers(&self, boxes: &[TileBox], wanted: &[bool]) -> Vec<f64> {
        // A triangle that covers a tile reaches into its neighbours, or there are none.
        let may_cover = |b: &TileBox| {
            let spans =
                |first: u16, last: u16, count: u32| last >= first && (last - first >= 2 || count <= 2);
            spans(b.left, b.right, self.grid.columns) && spans(b.top, b.bottom, self.grid.rows)
                || b.meets_edge(self.grid) && !b.is_empty()
        };
        let large: Vec<u32> = boxes
            .par_iter()
            .enumerate()
            .with_min_len(1 << 14)
            .filter(|(_, b)| may_cover(b))
            .map(|(id, _)| id as u32)
            .collect();
        let nothing = || vec![f64::NEG_INFINITY; self.grid.len()];
        let share = large.len().div_ceil(rayon::current_num_threads()).max(1 << 10);
        // The largest of all covers is taken, so the shares do not matter.
        large
            .par_chunks(share)
            .map(|ids| {
                let mut cover = nothing();
                for id in ids {
                    self.add_cover(*id, boxes[*id as usize], wanted, &mut cover);
                }
                cover
            })
            .reduce_with(|mut a, b| {
                a.iter_mut().zip(b).for_each(|(a, b)| *a = a.max(b));
                a
            })
            .unwrap_or_else(nothing)
    }

    fn add_cover(&self, id: u32, tiles: TileBox, wanted: &[bool], cover: &mut [f64]) {
        let (points, _) = corners(self.mesh, self.view, id);
        let (u, v) = (points[1] - points[0], points[2] - points[0]);
        let area = u.truncate().perp_dot(v.truncate());
        if area.abs() <= self.limits.height * u.truncate().length().max(v.truncate().length()) {
            return;
        }
        let slope = DVec2::new(u.z * v.y - v.z * u.y, v.z * u.x - u.z * v.x) / area;
        let farthest = points[0].z.min(points[1].z).min(points[2].z);
        let sides = Sides::new(&points);
        let half = self.grid.cell / 2.0;
        for (tile, corner) in self.grid.tiles_of(tiles) {
            let centre = corner + half;
            if wanted[tile] && sides.contains(centre, half) {
                let middle = points[0].z + slope.dot(centre - points[0].truncate());
                let least = (middle - (slope.x.abs() + slope.y.abs()) * half).max(farthest);
                let least = least - self.view.frame.nearness_step(least, 2.0 * self.limits.contact);
                cover[tile] = cover[tile].max(least);
            }
        }
    }

    /// Fills the wanted tiles with the triangles that reach before their covers.
    #[must_use]
    pub fn fill(&self, boxes: &[TileBox], wanted: &[bool], cover: &[f64]) -> Occluders {
        let chunk = self.chunk();
        let found: Vec<Vec<(u32, u32)>> = boxes
            .par_chunks(chunk)
            .enumerate()
            .map(|(k, boxes)| {
                let mut pairs = Vec::new();
                for (i, tiles) in boxes.iter().enumerate() {
                    self.add_tiles((k * chunk + i) as u32, *tiles, wanted, cover, &mut pairs);
                }
                pairs
            })
            .collect();
        // Counting sort by tile; chunks follow the order of the triangles, so tiles do too.
        let mut starts = vec![0u32; self.grid.len() + 1];
        for (tile, _) in found.iter().flatten() {
            starts[*tile as usize + 1] += 1;
        }
        for tile in 0..self.grid.len() {
            starts[tile + 1] += starts[tile];
        }
        let mut next = starts.clone();
        let mut ids = vec![0u32; starts[self.grid.len()] as usize];
        for (tile, id) in found.into_iter().flatten() {
            let at = &mut next[tile as usize];
            ids[*at as usize] = id;
            *at += 1;
        }
        let entries = ids.par_iter().with_min_len(1 << 12).map(|id| self.occluder(*id)).collect();
        Occluders { starts, entries }
    }

    #[inline]
    fn occluder(&self, id: u32) -> Occluder {
        let (points, _) = corners(self.mesh, self.view, id);
        let nearest = points[0].z.max(points[1].z).max(points[2].z);
        Occluder { bounds: outward_box(&points), nearest: (nearest as f32).next_up(), id }
    }

    /// Adds a pair of tile and triangle for each wanted tile in which the triangle may matter.
    #[inline]
    fn add_tiles(
        &self,
        id: u32,
        tiles: TileBox,
        wanted: &[bool],
        cover: &[f64],
        pairs: &mut Vec<(u32, u32)>,
    ) {
        if tiles.is_empty() {
            return;
        }
        // For boxes of few tiles the exact test costs more than it saves.
        if tiles.area() <= 4 {
            for (tile, _) in self.grid.tiles_of(tiles) {
                if wanted[tile] && (cover[tile] == f64::NEG_INFINITY || self.nearest(id) >= cover[tile]) {
                    pairs.push((tile as u32, id));
                }
            }
            return;
        }
        let (points, _) = corners(self.mesh, self.view, id);
        let nearest = points[0].z.max(points[1].z).max(points[2].z);
        let sides = Sides::new(&points);
        let half = self.grid.cell / 2.0;
        for (tile, corner) in self.grid.tiles_of(tiles) {
            if wanted[tile]
                && nearest >= cover[tile]
                && !sides.misses(corner + half, half * (1.0 + 1e-5) + 2.0 * self.limits.beside)
            {
                pairs.push((tile as u32, id));
            }
        }
    }

    fn nearest(&self, id: u32) -> f64 {
        let (points, _) = corners(self.mesh, self.view, id);
        points[0].z.max(points[1].z).max(points[2].z)
    }
}

/// The three sides of a projected triangle as inward half planes: positive inside.
struct Sides {
    normals: [DVec2; 3],
    offsets: [f64; 3],
}

impl Sides {
    fn new(points: &[DVec3; 3]) -> Self {
        let [a, b, c] = points.map(DVec3::truncate);
        let sign = (b - a).perp_dot(c - a).signum();
        let normal = |p: DVec2, q: DVec2| (q - p).perp() * sign;
        let normals = [normal(a, b), normal(b, c), normal(c, a)];
        Self { normals, offsets: [-normals[0].dot(a), -normals[1].dot(b), -normals[2].dot(c)] }
    }

    /// Whether the square lies wholly outside one side.
    fn misses(&self, centre: DVec2, half: f64) -> bool {
        (0..3).any(|i| {
            let n = self.normals[i];
            n.dot(centre) + self.offsets[i] + (n.x.abs() + n.y.abs()) * half < 0.0
        })
    }

    /// Whether the square lies wholly inside all sides.
    fn contains(&self, centre: DVec2, half: f64) -> bool {
        (0..3).all(|i| {
            let n = self.normals[i];
            n.dot(centre) + self.offsets[i] - (n.x.abs() + n.y.abs()) * half > 0.0
        })
    }
}

fn outward_box(points: &[DVec3; 3]) -> [f32; 4] {
    let low = points[0].min(points[1]).min(points[2]);
    let high = points[0].max(points[1]).max(points[2]);
    // A little wider than rounding, so that what lies on the border is still looked at.
    let pad = 1e-4;
    [
        ((low.x - pad) as f32).next_down(),
        ((high.x + pad) as f32).next_up(),
        ((low.y - pad) as f32).next_down(),
        ((high.y + pad) as f32).next_up(),
    ]
}
