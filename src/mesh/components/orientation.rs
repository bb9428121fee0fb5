//! [`OrientedSurfaces`]: connected surfaces of a mesh, and the faces to turn so that each surface shows its
//! outside.
//!
//! 1. Faces are connected where exactly two faces meet at an edge, counted over all parts or within one part.
//! 2. Windings within a surface are made consistent by union-find with parity. One-sided surfaces (Möbius
//!    strips) stay unchanged.
//! 3. A closed surface must enclose a positive volume. Each one counts separately, also inside another one.
//! 4. An open surface is closed by a cone over its border. If the volume has the same sign for every apex in
//!    the ball around the surface, that sign decides, as for a box without a lid. Otherwise, as for sheets,
//!    the winding of the larger area is kept.
//!
//! All sums have a fixed order, so that the number of threads has no effect.

use std::ops::AddAssign;
use std::sync::atomic::AtomicBool;
use std::sync::atomic::Ordering::Relaxed;

use crate::geometry::lists::disjoint_sets::{DisjointSets, NumberedSets};
use crate::geometry::lists::group_sums;
use crate::geometry::space::triangles::area_vector;
use crate::mesh::edges::triangle_sides::runs_along;
use crate::parallel::prelude::*;
use glam::DVec3;

use super::parity_union_find::ParityUnionFind;
use crate::mesh::tolerances;
use crate::mesh::{EdgeFaces, Edges, PartId, Soup};
use crate::parallel::task_size::MIN_TASK_ITEMS;

/// Faces that were wound inward, or against their neighbours, in one part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct TurnedFaces {
    /// The part.
    pub part: PartId,
    /// Number of faces that were turned.
    pub faces: u64,
    /// Number of connected surfaces that these faces belong to.
    pub surfaces: u64,
}

/// Triangles and their edges.
pub(crate) struct ConnectedTriangles<'a> {
    pub positions: &'a [DVec3],
    pub triangles: &'a [[u32; 3]],
    /// Part of each triangle, or empty.
    pub parts: &'a [PartId],
    pub edges: &'a Edges,
}

/// The connected surfaces of a mesh.
#[derive(Debug, Default)]
pub(crate) struct OrientedSurfaces {
    /// Surface of each face.
    pub surface_of_face: NumberedSets,
    /// Whether each surface is closed and two-sided.
    pub is_closed: Vec<bool>,
    /// Whether each face must be turned; empty if none must.
    pub is_turned: Vec<bool>,
}

impl OrientedSurfaces {
    /// Finds the surfaces of a mesh.
    pub(crate) fn new(mesh: &ConnectedTriangles) -> Self {
        let of_face = mesh.connected();
        let count = of_face.first.len();
        let SurfaceFlags { open, mixed } = mesh.joints(&of_face);
        let mut turned = Vec::new();
        let mut twisted = vec![false; count];
        if mixed.contains(&true) {
            turned = mesh.agreeing(&of_face, &mixed, &mut twisted);
        }
        let is_turned = |face: usize| turned.get(face).copied().unwrap_or_default();
        let mut sums = mesh.sums(&of_face, is_turned);
        let is_closed: Vec<bool> =
            open.iter().zip(&twisted).map(|(open, twisted)| !open && !twisted).collect();
        mesh.add_radii(&of_face, &is_closed, &mut sums);
        let turns = |surface: usize| !twisted[surface] && sums[surface].turns();
        let turns: Vec<bool> = (0..count).map(turns).collect();
        if turns.contains(&true) {
            turned.resize(mesh.triangles.len(), false);
            let of_face = of_face.set_of_face.par_iter().with_min_len(MIN_TASK_ITEMS);
            turned
                .par_iter_mut()
                .zip(of_face)
                .for_each(|(turned, surface)| *turned ^= turns[*surface as usize]);
        }
        if !turned.contains(&true) {
            turned.clear();
        }
        Self { surface_of_face: of_face, is_closed, is_turned: turned }
    }

    /// Whether any surface is open.
    pub(crate) fn has_open(&self) -> bool {
        self.is_closed.contains(&false)
    }

    /// Restricts the turns to closed surfaces. Returns the turns of faces of open surfaces; empty if there
    /// are none.
    pub(crate) fn turn_closed_only(&mut self) -> Vec<bool> {
        let is_open = |surface: &u32| !self.is_closed[*surface as usize];
        let of_face = &self.surface_of_face.set_of_face;
        let mut of_open: Vec<bool> =
            self.is_turned.iter().zip(of_face).map(|(turned, of)| *turned && is_open(of)).collect();
        self.is_turned.iter_mut().zip(&of_open).for_each(|(turned, open)| *turned &= !*open);
        for list in [&mut self.is_turned, &mut of_open] {
            if !list.contains(&true) {
                list.clear();
            }
        }
        of_open
    }

    /// Adds the turned faces to the counts per part, which are in part order.
    pub(crate) fn count(&self, parts: &[PartId], counts: &mut Vec<TurnedFaces>) {
        let part = |face: usize| parts.get(face).copied().unwrap_or_default();
        let faces = (0..self.is_turned.len()).filter(|face| self.is_turned[*face]);
        let mut found: Vec<(PartId, u32)> =
            faces.map(|face| (part(face), self.surface_of_face.set_of_face[face])).collect();
        found.sort_unstable();
        for own in found.chunk_by(|a, b| a.0 == b.0) {
            let (part, faces) = (own[0].0, own.len() as u64);
            let surfaces = own.chunk_by(|a, b| a.1 == b.1).count() as u64;
            match counts.binary_search_by_key(&part, |known| known.part) {
                Ok(at) => {
                    counts[at].faces += faces;
                    counts[at].surfaces += surfaces;
                }
                Err(at) => counts.insert(at, TurnedFaces { part, faces, surfaces }),
            }
        }
    }
}

/// Turns faces of a soup, with all attributes of their corners and sides.
pub(crate) fn turn_faces(soup: &mut Soup, turned: &[bool]) {
    fn turn<T: Send>(list: &mut [[T; 3]], turned: &[bool], [one, other]: [usize; 2]) {
        let all = list.par_iter_mut().zip(turned).with_min_len(MIN_TASK_ITEMS);
        all.filter(|(_, turned)| **turned).for_each(|(own, _)| own.swap(one, other));
    }
    turn(&mut soup.triangles, turned, [1, 2]);
    turn(&mut soup.corner_normals, turned, [1, 2]);
    turn(&mut soup.corner_uvs, turned, [1, 2]);
    turn(&mut soup.corner_colours, turned, [1, 2]);
    // The sides 0-1, 1-2, 2-0 become 0-2, 2-1, 1-0.
    turn(&mut soup.edge_marks, turned, [0, 2]);
}

/// Properties of each surface, found at its edges.
struct SurfaceFlags {
    /// Whether it has a border.
    open: Vec<bool>,
    /// Whether some neighbours have opposite windings.
    mixed: Vec<bool>,
}

/// Sums over the faces of a surface, relative to one of its corners.
#[derive(Clone, Copy, Default)]
struct SurfaceSums {
    faces: u32,
    area: f64,
    /// Area of the faces turned for consistency with their neighbours.
    turned_area: f64,
    /// Sum of the face normals, each with the length of the area.
    normal: DVec3,
    /// Volume of the cone from the corner over the surface.
    volume: f64,
    /// Largest distance from the corner.
    reach: f64,
    /// Sum of the face centroids, weighted by area.
    moment: DVec3,
    /// Largest distance from the centroid; 0 for closed surfaces.
    radius: f64,
}

impl AddAssign<&SurfaceSums> for SurfaceSums {
    fn add_assign(&mut self, other: &Self) {
        self.faces += other.faces;
        self.area += other.area;
        self.turned_area += other.turned_area;
        self.normal += other.normal;
        self.volume += other.volume;
        self.reach = self.reach.max(other.reach);
        self.moment += other.moment;
        self.radius = self.radius.max(other.radius);
    }
}

impl SurfaceSums {
    /// Centroid of the surface, relative to the corner.
    fn centroid(&self) -> DVec3 {
        if self.area > 0.0 { self.moment / self.area } else { DVec3::ZERO }
    }

    /// Whether a surface must be turned as a whole.
    fn turns(&self) -> bool {
        // The error of a sum of n numbers is at most n units in the last place of the sum of their sizes.
        let rounding = f64::from(self.faces.saturating_add(8))
            * tolerances::SUM_ROUNDING_PER_TERM
            * self.area
            * self.reach;
        // For another apex, the volume of the cone changes by the dot product of the offset and the sum of
        // normals.
        let volume = self.volume - self.centroid().dot(self.normal) / 3.0;
        let most = self.normal.length() * self.radius / 3.0 + rounding;
        if volume.abs() > most { volume < 0.0 } else { self.turned_area > self.area - self.turned_area }
    }
}

/// Number of edges per task.
const EDGES_PER_TASK: usize = 1 << 12;

impl ConnectedTriangles<'_> {
    fn part(&self, face: u32) -> PartId {
        self.parts.get(face as usize).copied().unwrap_or_default()
    }

    /// Whether a face runs along an edge from the smaller vertex to the larger one.
    fn runs_up(&self, edge: usize, face: u32) -> bool {
        runs_along(self.triangles[face as usize], self.edges.vertices[edge])
    }

    /// Calls `call` with each pair of faces that an edge connects, and whether both run along it in the same
    /// direction.
    #[inline]
    fn each_pair(&self, edge: usize, mut call: impl FnMut(u32, u32, bool)) {
        match self.edges.faces(edge) {
            EdgeFaces::One(_) => {}
            EdgeFaces::Two { faces: [a, b], same_way } => call(a, b, same_way),
            EdgeFaces::Many(faces) => {
                // Parts that touch are paired separately.
                let mut by_part: Vec<(PartId, u32)> =
                    faces.iter().map(|face| (self.part(*face), *face)).collect();
                by_part.sort_unstable();
                for same_part in by_part.chunk_by(|a, b| a.0 == b.0) {
                    if let [(_, a), (_, b)] = *same_part {
                        call(a, b, self.runs_up(edge, a) == self.runs_up(edge, b));
                    }
                }
            }
        }
    }

    fn connected(&self) -> NumberedSets {
        let groups = DisjointSets::new(self.triangles.len(), |join| {
            let edges = (0..self.edges.len()).into_par_iter().with_min_len(EDGES_PER_TASK);
            edges.for_each(|edge| self.each_pair(edge, |a, b, _| join(a, b)));
        });
        groups.numbered(|_| None)
    }

    fn joints(&self, surfaces: &NumberedSets) -> SurfaceFlags {
        let flags = || -> Vec<AtomicBool> { surfaces.first.iter().map(|_| AtomicBool::new(false)).collect() };
        let (open, mixed) = (flags(), flags());
        let of = |face: u32| surfaces.set_of_face[face as usize] as usize;
        (0..self.edges.len()).into_par_iter().with_min_len(EDGES_PER_TASK).for_each(|edge| {
            match self.edges.faces(edge) {
                EdgeFaces::One(face) => open[of(face)].store(true, Relaxed),
                EdgeFaces::Two { same_way: false, .. } => {}
                EdgeFaces::Two { faces, .. } => mixed[of(faces[0])].store(true, Relaxed),
                EdgeFaces::Many(faces) => {
                    let mut face_surfaces: Vec<usize> = faces.iter().map(|face| of(*face)).collect();
                    face_surfaces.sort_unstable();
                    let odd = face_surfaces.chunk_by(|a, b| a == b).filter(|own| own.len() % 2 == 1);
                    odd.for_each(|same_surface| open[same_surface[0]].store(true, Relaxed));
                    self.each_pair(edge, |a, _, same_way| {
                        if same_way {
                            mixed[of(a)].store(true, Relaxed);
                        }
                    });
                }
            }
        });
        let values = |flags: Vec<AtomicBool>| flags.into_iter().map(AtomicBool::into_inner).collect();
        SurfaceFlags { open: values(open), mixed: values(mixed) }
    }

    /// The faces to turn for consistent windings. Surfaces where this is impossible are marked as `twisted`
    /// and stay unchanged.
    fn agreeing(&self, surfaces: &NumberedSets, mixed: &[bool], twisted: &mut [bool]) -> Vec<bool> {
        let of = |face: u32| surfaces.set_of_face[face as usize] as usize;
        let mut parities = ParityUnionFind::new(self.triangles.len());
        for edge in 0..self.edges.len() {
            self.each_pair(edge, |a, b, same_way| {
                if mixed[of(a)] && !parities.join(a, b, same_way) {
                    twisted[of(a)] = true;
                }
            });
        }
        let faces = 0..self.triangles.len() as u32;
        faces.map(|face| mixed[of(face)] && !twisted[of(face)] && parities.root(face).1).collect()
    }

    /// The sums over the faces of each surface.
    fn sums(&self, surfaces: &NumberedSets, is_turned: impl Fn(usize) -> bool + Sync) -> Vec<SurfaceSums> {
        group_sums::sums(surfaces.first.len(), self.triangles.len(), |face| {
            let surface = surfaces.set_of_face[face];
            let corners @ [a, b, c] = self.corners_relative_to_first(surfaces, surface, face);
            let turned = is_turned(face);
            let across = area_vector(corners) / 2.0;
            let (area, normal) = (across.length(), if turned { -across } else { across });
            let own = SurfaceSums {
                faces: 1,
                area,
                turned_area: if turned { area } else { 0.0 },
                normal,
                volume: a.dot(normal) / 3.0,
                reach: a.length_squared().max(b.length_squared()).max(c.length_squared()).sqrt(),
                moment: (a + b + c) / 3.0 * area,
                radius: 0.0,
            };
            Some((surface, own))
        })
    }

    /// Adds the radius of each open surface around its centroid.
    fn add_radii(&self, surfaces: &NumberedSets, is_closed: &[bool], sums: &mut [SurfaceSums]) {
        if !is_closed.contains(&false) {
            return;
        }
        let centroids: Vec<DVec3> = sums.iter().map(SurfaceSums::centroid).collect();
        let radii = group_sums::sums(surfaces.first.len(), self.triangles.len(), |face| {
            let surface = surfaces.set_of_face[face];
            let centroid = centroids[surface as usize];
            let corners =
                self.corners_relative_to_first(surfaces, surface, face).map(|p| p.distance(centroid));
            let radius = corners.into_iter().fold(0.0, f64::max);
            (!is_closed[surface as usize])
                .then(|| (surface, SurfaceSums { radius, ..SurfaceSums::default() }))
        });
        sums.iter_mut().zip(&radii).for_each(|(sums, radius)| *sums += radius);
    }

    /// Corners of a face, relative to the first corner of its surface.
    #[inline]
    fn corners_relative_to_first(&self, surfaces: &NumberedSets, surface: u32, face: usize) -> [DVec3; 3] {
        let first = self.triangles[surfaces.first[surface as usize] as usize][0];
        let from = self.positions[first as usize];
        self.triangles[face].map(|v| self.positions[v as usize] - from)
    }
}

#[cfg(test)]
mod tests;
