//! [`NormalDepthMaps`]: the normals and the depth at each pixel of a view.
//!
//! Source: Scheelk, Non-Photorealistic Rendering, sections 3.4.1 and 3.4.2: images are made from the surface
//! first, and edges are detected in them afterwards.

use crate::parallel::prelude::*;
use glam::DVec3;

use super::PixelGrid;
use super::depth_cell::{front, nearness};
use super::row_bands::RowBands;
use crate::mesh::{FaceId, Mesh};
use crate::view::View;

/// Stands for the absence of a face at a pixel.
pub(crate) const NO_FRONT: u32 = u32::MAX;

/// The depth of pixels that show no face.
pub(crate) const BACKGROUND_DEPTH: f32 = 1.0;

/// Largest number of pixels along the longer side of a map.
pub(crate) const MAX_SIDE_PIXELS: f64 = 4096.0;

/// Margin of the depth map in front of the nearest point, and [`DEPTH_MARGIN_BEHIND`] after the farthest, as shares of the
/// depth range.
///
/// The nearest point is not at depth 0, where a threshold proportional to depth would vanish. Background has
/// a depth that no surface has.
const DEPTH_MARGIN_IN_FRONT: f64 = 0.15;
const DEPTH_MARGIN_BEHIND: f64 = 0.1;

/// Normals computed at a time.
const LANES: usize = 4;

/// Nearest surface at the centre of each pixel, row after row from the top.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct NormalDepthMaps {
    /// Pixels in a row.
    pub columns: usize,
    /// Number of rows.
    pub rows: usize,
    /// Pixels per user unit.
    pub scale: f64,
    /// Nearest face, [`NO_FRONT`] for none.
    pub faces: Vec<u32>,
    /// Unit normals on the visible side, in camera axes: right, up, towards the eye. Zero where there is no
    /// face.
    pub normals: Vec<[f32; 3]>,
    /// Depth along the optical axis, linear, 0 to 1. Surfaces lie between 0.12 and 0.92, background at 1.
    pub depths: Vec<f32>,
    /// World depths that correspond to 0 and 1, along the optical axis.
    pub planes: [f64; 2],
}

impl NormalDepthMaps {
    /// Draws the maps of a view with `per_unit` pixels per user unit, or fewer where a side would exceed 4096
    /// pixels.
    ///
    /// `normals` returns the normals at the corners of a face, on its outer side, in local space.
    #[must_use]
    pub(crate) fn new(
        mesh: &Mesh,
        view: &View,
        per_unit: f64,
        normals: impl Fn(u32) -> [DVec3; 3] + Sync,
    ) -> Self {
        let side = (view.frame.width.max(view.frame.height) * per_unit).clamp(1.0, MAX_SIDE_PIXELS);
        let screen = PixelGrid::of_side(mesh, view, side);
        let bands = RowBands::new(&screen);
        let planes = planes(&screen, view);
        let (columns, rows) = (screen.columns, screen.rows);
        // Zeroed memory costs nothing until it is written, and each band writes its own part.
        let mut maps = Self {
            columns,
            rows,
            scale: screen.scale(),
            faces: vec![0; columns * rows],
            normals: vec![[0.0; 3]; columns * rows],
            depths: vec![0.0; columns * rows],
            planes,
        };
        let per_depth = 1.0 / (planes[1] - planes[0]);
        let depth_at = |nearness: f32| {
            let depth = view.frame.depth_of(screen.image_nearness(nearness));
            (((depth - planes[0]) * per_depth) as f32).clamp(0.0, BACKGROUND_DEPTH)
        };
        let centre = |i: usize| (i as f64 + 0.5) / maps.scale;
        let across: Vec<f64> = (0..columns).map(centre).collect();
        let band = bands.pixels();
        let of_band = maps.faces.par_chunks_mut(band).zip(maps.normals.par_chunks_mut(band));
        let of_band = of_band.zip(maps.depths.par_chunks_mut(band)).enumerate();
        of_band.for_each_init(
            || (vec![0; band], FaceNormalCache::new()),
            |(cells, shown), (number, ((faces, band_normals), depths))| {
                cells.fill(0);
                bands.draw(number, cells);
                let mut next = 0;
                for (cells, row) in cells.chunks(columns).zip(bands.rows(number)) {
                    let first = next;
                    for cells in cells.chunk_by(|a, b| front(*a) == front(*b)) {
                        let own = next..next + cells.len();
                        next = own.end;
                        let Some(face) = front(cells[0]) else {
                            faces[own.clone()].fill(NO_FRONT);
                            depths[own].fill(BACKGROUND_DEPTH);
                            continue;
                        };
                        faces[own.clone()].fill(face);
                        let on_face = shown.of(face, || FaceNormals::new(mesh, view, face, normals(face)));
                        let across = &across[own.start - first..own.end - first];
                        on_face.along(across, centre(row), &mut band_normals[own.clone()]);
                        for (depth, cell) in depths[own].iter_mut().zip(cells) {
                            *depth = nearness(*cell).map_or(BACKGROUND_DEPTH, depth_at);
                        }
                    }
                }
            },
        );
        maps
    }

    /// Depth along the optical axis at a pixel, world units.
    #[must_use]
    pub(crate) fn depth(&self, pixel: usize) -> f64 {
        self.planes[0] + f64::from(self.depths[pixel]) * (self.planes[1] - self.planes[0])
    }
}

/// World depths that correspond to 0 and 1 in the depth map.
fn planes(screen: &PixelGrid, view: &View) -> [f64; 2] {
    let Some([near, far]) = screen.depths() else { return [0.0, 1.0] };
    // A flat object seen square on has no depth range.
    let range = (far - near).max(view.frame.px_at(far)).max(f64::MIN_POSITIVE);
    [near - DEPTH_MARGIN_IN_FRONT * range, far + DEPTH_MARGIN_BEHIND * range]
}

/// Cache of face normals, one face per slot. The same faces recur in the next row.
struct FaceNormalCache {
    faces: Vec<u32>,
    normals: Vec<FaceNormals>,
}

impl FaceNormalCache {
    /// Number of slots: a power of two, small enough for the CPU cache.
    const CACHE_SLOTS: usize = 1 << 10;

    fn new() -> Self {
        let none = FaceNormals { weights: [[0.0; 3]; 3], normals: [DVec3::ZERO; 3] };
        Self { faces: vec![NO_FRONT; Self::CACHE_SLOTS], normals: vec![none; Self::CACHE_SLOTS] }
    }

    #[inline]
    fn of(&mut self, face: u32, make: impl FnOnce() -> FaceNormals) -> &FaceNormals {
        let slot = face as usize % Self::CACHE_SLOTS;
        if self.faces[slot] != face {
            self.faces[slot] = face;
            self.normals[slot] = make();
        }
        &self.normals[slot]
    }
}

/// Normals of a face in the image. The weights of its corners, times 1/depth in perspective, are linear
/// there.
#[derive(Debug, Clone, Copy)]
struct FaceNormals {
    /// For each corner, its weight at the origin and the change to the right and down.
    weights: [[f64; 3]; 3],
    /// In camera axes, on the visible side.
    normals: [DVec3; 3],
}

impl FaceNormals {
    fn new(mesh: &Mesh, view: &View, face: u32, normals: [DVec3; 3]) -> Self {
        let side = if view.facing[face as usize] { 1.0 } else { -1.0 };
        let frame = &view.frame;
        let to_camera =
            |n: DVec3| DVec3::new(n.dot(frame.right), n.dot(frame.up), -n.dot(frame.forward)) * side;
        let normals = normals.map(to_camera);
        let corners = mesh.triangles[FaceId(face).index()].map(|v| view.points[v as usize]);
        // A face that the near plane cuts gets the mean of its corners.
        let even = Self { weights: [[1.0, 0.0, 0.0]; 3], normals };
        let [a, b, c] = corners;
        let area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        if area == 0.0 || !area.is_finite() || corners.iter().any(|corner| corner.z.is_nan()) {
            return even;
        }
        let weight = |p: DVec3, q: DVec3, opposite: DVec3| {
            let nearness = if frame.perspective { opposite.z } else { 1.0 };
            let k = nearness / area;
            [k * (p.x * q.y - q.x * p.y), k * (p.y - q.y), k * (q.x - p.x)]
        };
        Self { weights: [weight(b, c, a), weight(c, a, b), weight(a, b, c)], normals }
    }

    /// Writes the normals at the given positions of a row.
    fn along(&self, across: &[f64], y: f64, to: &mut [[f32; 3]]) {
        // Several at a time, one per lane.
        for (across, to) in across.chunks(LANES).zip(to.chunks_mut(LANES)) {
            let mut x = [0.0; LANES];
            x[..across.len()].copy_from_slice(across);
            let mut sums = [[0.0; LANES]; 3];
            for (weight, normal) in self.weights.iter().zip(self.normals) {
                for lane in 0..LANES {
                    // Pixel centres may be outside their face by rounding.
                    let weight = (weight[0] + weight[1] * x[lane] + weight[2] * y).max(0.0);
                    sums[0][lane] += normal.x * weight;
                    sums[1][lane] += normal.y * weight;
                    sums[2][lane] += normal.z * weight;
                }
            }
            let [xs, ys, zs] = sums;
            let mut per_length = [0.0; LANES];
            for lane in 0..LANES {
                let [x, y, z] = [xs[lane], ys[lane], zs[lane]];
                per_length[lane] = 1.0 / (x * x + y * y + z * z).sqrt();
            }
            for (lane, to) in to.iter_mut().enumerate() {
                let sum = DVec3::new(xs[lane], ys[lane], zs[lane]);
                let k = per_length[lane];
                let normal = if k > 0.0 && k.is_finite() { sum * k } else { self.normals[0] };
                *to = normal.to_array().map(|x| x as f32);
            }
        }
    }
}
