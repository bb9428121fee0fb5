//! Which triangles may hide something in which tile.
//!
//! Only tiles that hold a segment not yet decided are filled. Where one triangle covers a whole
//! tile, everything behind it there is hidden by it alone, so neither segments nor triangles
//! behind such a *cover* need to be looked at.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::grid::Grid;
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

/// The triangle with this id if it can hide anything: it has area and is not cut.
#[inline]
fn sound_corners(mesh: &Mesh, view: &View, id: u32) -> Option<[DVec3; 3]> {
    let (points, face) = corners(mesh, view, id);
    let whole = !(points[0].z.is_nan() || points[1].z.is_nan() || points[2].z.is_nan());
    (whole && !mesh.is_degenerate(FaceId(face))).then_some(points)
}

/// The tiles that a triangle's box meets: first and last column, first and last row.
#[inline]
fn tile_box(grid: &Grid, points: &[DVec3; 3], slack: f64) -> Option<[u32; 4]> {
    let low = points[0].min(points[1]).min(points[2]) - slack;
    let high = points[0].max(points[1]).max(points[2]) + slack;
    let (width, height) = (f64::from(grid.columns) * grid.cell, f64::from(grid.rows) * grid.cell);
    (high.x >= 0.0 && low.x <= width && high.y >= 0.0 && low.y <= height)
        .then(|| [grid.column(low.x), grid.column(high.x), grid.row(low.y), grid.row(high.y)])
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

/// For each tile the nearness behind which everything is hidden by one triangle, or −∞.
///
/// The result does not depend on the number of threads: the largest of all covers is taken.
#[must_use]
pub fn covers(mesh: &Mesh, view: &View, grid: &Grid, wanted: &[bool], limits: &Limits) -> Vec<f64> {
    let nothing = || vec![f64::NEG_INFINITY; grid.len()];
    let count = mesh.triangles.len() + view.clipped.len();
    let chunk = count.div_ceil(rayon::current_num_threads()).max(1 << 14);
    (0..count.div_ceil(chunk))
        .into_par_iter()
        .map(|k| {
            let mut cover = nothing();
            for id in k * chunk..((k + 1) * chunk).min(count) {
                add_cover(mesh, view, grid, wanted, limits, id as u32, &mut cover);
            }
            cover
        })
        .reduce_with(|mut a, b| {
            a.iter_mut().zip(b).for_each(|(a, b)| *a = a.max(b));
            a
        })
        .unwrap_or_else(nothing)
}

fn add_cover(
    mesh: &Mesh,
    view: &View,
    grid: &Grid,
    wanted: &[bool],
    limits: &Limits,
    id: u32,
    cover: &mut [f64],
) {
    let Some(points) = sound_corners(mesh, view, id) else { return };
    let Some([left, right, top, bottom]) = tile_box(grid, &points, 0.0) else { return };
    let farthest = points[0].z.min(points[1].z).min(points[2].z);
    // A triangle that covers a tile reaches beyond it on all sides, or ends at the page's edge.
    if right - left < 1 || bottom - top < 1 {
        return;
    }
    let sides = Sides::new(&points);
    let half = grid.cell / 2.0;
    let (u, v) = (points[1] - points[0], points[2] - points[0]);
    let area = u.truncate().perp_dot(v.truncate());
    if area.abs() <= limits.height * u.length().max(v.length()) {
        return;
    }
    let slope = DVec2::new(u.z * v.y - v.z * u.y, v.z * u.x - u.z * v.x) / area;
    for row in top..=bottom {
        for column in left..=right {
            let tile = grid.tile(column, row);
            let centre = grid.corner(column, row) + half;
            if wanted[tile] && sides.contains(centre, half) {
                let middle = points[0].z + slope.dot(centre - points[0].truncate());
                let least = (middle - (slope.x.abs() + slope.y.abs()) * half).max(farthest);
                let least = least - view.frame.nearness_step(least, 2.0 * limits.contact);
                cover[tile] = cover[tile].max(least);
            }
        }
    }
}

/// Fills the wanted tiles with the triangles that reach before their covers.
#[must_use]
pub fn fill(mesh: &Mesh, view: &View, grid: &Grid, wanted: &[bool], cover: &[f64]) -> Occluders {
    let count = mesh.triangles.len() + view.clipped.len();
    let chunk = count.div_ceil(rayon::current_num_threads()).max(1 << 14);
    let found: Vec<Vec<(u32, Occluder)>> = (0..count.div_ceil(chunk))
        .into_par_iter()
        .map(|k| {
            let mut entries = Vec::new();
            for id in k * chunk..((k + 1) * chunk).min(count) {
                add_entries(mesh, view, grid, wanted, cover, id as u32, &mut entries);
            }
            entries
        })
        .collect();
    // Counting sort by tile; chunks follow the order of the triangles, so tiles do too.
    let mut starts = vec![0u32; grid.len() + 1];
    for (tile, _) in found.iter().flatten() {
        starts[*tile as usize + 1] += 1;
    }
    for tile in 0..grid.len() {
        starts[tile + 1] += starts[tile];
    }
    let mut next = starts.clone();
    let blank = Occluder { bounds: [0.0; 4], nearest: 0.0, id: 0 };
    let mut entries = vec![blank; starts[grid.len()] as usize];
    for chunk in found {
        for (tile, occluder) in chunk {
            let at = &mut next[tile as usize];
            entries[*at as usize] = occluder;
            *at += 1;
        }
    }
    Occluders { starts, entries }
}

fn add_entries(
    mesh: &Mesh,
    view: &View,
    grid: &Grid,
    wanted: &[bool],
    cover: &[f64],
    id: u32,
    entries: &mut Vec<(u32, Occluder)>,
) {
    let Some(points) = sound_corners(mesh, view, id) else { return };
    let slack = grid.cell * 1e-6;
    let Some([left, right, top, bottom]) = tile_box(grid, &points, slack) else { return };
    let nearest = points[0].z.max(points[1].z).max(points[2].z);
    let few = right - left <= 1 && bottom - top <= 1;
    let mut occluder = None;
    let mut sides = None;
    for row in top..=bottom {
        for column in left..=right {
            let tile = grid.tile(column, row);
            if !wanted[tile] || nearest < cover[tile] {
                continue;
            }
            if !few {
                let sides = sides.get_or_insert_with(|| Sides::new(&points));
                let half = grid.cell / 2.0;
                if sides.misses(grid.corner(column, row) + half, half + slack) {
                    continue;
                }
            }
            let occluder = occluder.get_or_insert_with(|| Occluder {
                bounds: outward_box(&points),
                nearest: (nearest as f32).next_up(),
                id,
            });
            entries.push((tile as u32, *occluder));
        }
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
