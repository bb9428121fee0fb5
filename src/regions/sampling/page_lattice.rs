//! [`LightLattice`]: facet and light at the points of a lattice on the page.
//!
//! They determine the direction, width and density of strokes. Where strokes end is decided by the borders of
//! the [`HatchRegions`] only.

use crate::parallel::prelude::*;
use glam::{DVec2, DVec3};
use kurbo::{Point, Vec2};

use crate::light::SurfacePoint;
use crate::lines::Lit;
use crate::mesh::FaceId;
use crate::regions::HatchRegions;
use crate::regions::tolerances;
use crate::visibility::front_faces;

/// Samples of the page at the points of a lattice, row by row.
#[derive(Debug, Clone, Default)]
pub(crate) struct LightLattice {
    /// Distance between points, page units.
    pub pitch: f64,
    /// First point.
    pub origin: Point,
    /// Points per row.
    pub columns: usize,
    /// Number of rows.
    pub rows: usize,
    /// Cell of the ground at each point.
    pub cells: Vec<u32>,
    /// Facet at each point; 0 = paper.
    pub facets: Vec<u32>,
    /// Diffuse light at each point; 0 on paper.
    pub lights: Vec<f32>,
}

/// Surface points and normals at the lattice points.
pub(crate) struct LatticeProbe<'a> {
    pub(crate) lit: &'a Lit<'a>,
    /// Visible surface point at each lattice point: its face and position.
    pub(crate) hits: Vec<Option<(u32, DVec3)>>,
    /// Shading normal; zero where no surface is seen.
    pub(crate) normals: Vec<DVec3>,
    /// Face normal where the face is not part of a rounded surface; otherwise the shading normal.
    pub(crate) as_built: Vec<DVec3>,
}

impl LightLattice {
    /// Samples the page at points `pitch` apart.
    ///
    /// `shadowed` returns a mask of the lights that do not reach each point. `is_round` says which faces are
    /// part of a rounded surface. `offset` moves the image on the page.
    pub(crate) fn new<'a>(
        lit: &'a Lit,
        ground: &HatchRegions,
        shadowed: impl Fn(&[(u32, DVec3)]) -> Vec<u32>,
        is_round: impl Fn(u32) -> bool + Sync,
        offset: Vec2,
        pitch: f64,
    ) -> (Self, LatticeProbe<'a>) {
        let frame = &lit.view.frame;
        let count = |length: f64| ((length / pitch).ceil().max(1.0)) as usize;
        let (columns, rows) = (count(frame.width), count(frame.height));
        let first = DVec2::splat(pitch / 2.0);
        let points: Vec<DVec2> = (0..columns * rows)
            .map(|k| first + DVec2::new((k % columns) as f64, (k / columns) as f64) * pitch)
            .collect();
        let origin = Point::new(first.x, first.y) + offset;
        let cells = ground.raster(origin, pitch, columns, rows);
        let facets = cells.iter().map(|cell| ground.cells[*cell as usize].facet).collect();
        let hits: Vec<Option<(u32, DVec3)>> = front_faces(lit.mesh, lit.view, &points)
            .into_iter()
            .zip(&points)
            .map(|(front, p)| front.map(|f| (f.face, frame.local_from_image(p.extend(f.nearness)))))
            .collect();
        let shadow_queries: Vec<(u32, DVec3)> = hits.iter().flatten().copied().collect();
        let masks = shadowed(&shadow_queries);
        let mut hit_count = 0;
        let mask_of: Vec<u32> = hits
            .iter()
            .map(|hit| {
                hit_count += usize::from(hit.is_some());
                if hit.is_some() { masks.get(hit_count - 1).copied().unwrap_or_default() } else { 0 }
            })
            .collect();
        let channel = lit.shading.bin_channel().unwrap_or(0);
        let lights = hits
            .par_iter()
            .zip(&mask_of)
            .with_min_len(1 << 10)
            .map(|(hit, mask)| {
                let Some((face, at)) = hit else { return 0.0 };
                let (paint, point) = (lit.mesh.paint(FaceId(*face)), lit.at(*face, *at));
                lit.shading.value(channel, paint, &point, *mask) as f32
            })
            .collect();
        let normals: Vec<DVec3> = hits
            .par_iter()
            .with_min_len(1 << 10)
            .map(|hit| hit.map_or(DVec3::ZERO, |(face, at)| lit.at(face, at).normal))
            .collect();
        // Faces of a polyhedron are flat, even where their light is interpolated.
        let own = |face: u32| DVec3::from_array(lit.mesh.face_normals[face as usize].map(f64::from));
        let as_built = hits
            .iter()
            .zip(&normals)
            .map(|(hit, shaded)| {
                hit.filter(|(face, _)| !is_round(*face)).map_or(*shaded, |(face, _)| own(face))
            })
            .collect();
        let samples = Self { pitch, origin, columns, rows, cells, facets, lights };
        (samples, LatticeProbe { lit, hits, normals, as_built })
    }

    /// Position of point `k`.
    #[must_use]
    pub(crate) fn point(&self, k: usize) -> Point {
        self.origin + Vec2::new((k % self.columns) as f64, (k / self.columns) as f64) * self.pitch
    }

    /// The four lattice points around a position and their bilinear weights. Positions outside are clamped.
    #[must_use]
    pub(crate) fn around(&self, p: Point) -> [(usize, f64); 4] {
        let at = (p - self.origin) / self.pitch;
        let clamp = |x: f64, count: usize| x.clamp(0.0, count.saturating_sub(1) as f64);
        let (x, y) = (clamp(at.x, self.columns), clamp(at.y, self.rows));
        let (column, row) = (x as usize, y as usize);
        let (u, v) = (x - column as f64, y - row as f64);
        let (right, below) = ((column + 1).min(self.columns - 1), (row + 1).min(self.rows - 1));
        [
            (row * self.columns + column, (1.0 - u) * (1.0 - v)),
            (row * self.columns + right, u * (1.0 - v)),
            (below * self.columns + column, (1.0 - u) * v),
            (below * self.columns + right, u * v),
        ]
    }

    /// Iterates a function over the lattice for a number of rounds.
    ///
    /// `anew` gets the point's index, its value, and the values of its left, right, upper and lower
    /// neighbours (`None` on another facet).
    #[must_use]
    pub(crate) fn spread<T: Copy + Send + Sync>(
        &self,
        mut now: Vec<T>,
        rounds: usize,
        anew: impl Fn(usize, T, [Option<T>; 4]) -> T + Sync,
    ) -> Vec<T> {
        let (columns, rows) = (self.columns, self.rows);
        let mut next = now.clone();
        for _ in 0..rounds {
            next.par_chunks_mut(columns.max(1)).enumerate().with_min_len(8).for_each(|(row, out)| {
                for (column, out) in out.iter_mut().enumerate() {
                    let k = row * columns + column;
                    let of = |is_there: bool, other: usize| {
                        (is_there && self.facets[other] == self.facets[k]).then(|| now[other])
                    };
                    let around = [
                        of(column > 0, k.wrapping_sub(1)),
                        of(column + 1 < columns, k + 1),
                        of(row > 0, k.wrapping_sub(columns)),
                        of(row + 1 < rows, k + columns),
                    ];
                    *out = anew(k, now[k], around);
                }
            });
            std::mem::swap(&mut now, &mut next);
        }
        now
    }

    /// Interpolated light on a facet at a position; `None` if the facet is not seen nearby.
    #[must_use]
    pub(crate) fn light(&self, facet: u32, p: Point) -> Option<f64> {
        let own = self.around(p).into_iter().filter(|(k, _)| self.facets[*k] == facet);
        let (sum, weight) = own.fold((0.0, 0.0), |(sum, weight), (k, w)| {
            let w = w + tolerances::MIN_SAMPLE_WEIGHT;
            (sum + f64::from(self.lights[k]) * w, weight + w)
        });
        (weight > 0.0).then(|| sum / weight)
    }
}

impl Lit<'_> {
    /// Surface point of a face at a position on it.
    pub(crate) fn at(&self, face: u32, at: DVec3) -> SurfacePoint {
        self.point(face, self.mesh.weights(FaceId(face), at))
    }
}
