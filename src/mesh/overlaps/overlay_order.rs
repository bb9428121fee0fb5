//! [`Overlay`]: stacking order of coplanar surfaces of different colours, such as a label on a wall.
//!
//! A surface is a connected flat patch of one part, material and paint. Surfaces that overlap, directly or
//! through others, form a plane. In it the smaller surface is on top. Equal ones are ordered by part and then
//! material, the later one on top. The order is the same in every view and from both sides.
//!
//! 1. Flat edges join faces to surfaces.
//! 2. Surfaces are sorted into cells by their plane: squares of normal coordinates, and distance from the
//!    middle.
//! 3. In each cell with different colours, bounding boxes are swept along an axis. Triangles of surfaces that
//!    meet are clipped by each other.
//! 4. Two surfaces overlap if the common area exceeds the slivers between two facetted borders along one
//!    curve (`arcs`). Their planes must be within contact distance all over it.

use crate::geometry::lists::disjoint_sets::{DisjointSets, UnionFind};
use crate::geometry::space::bounds::Bounds;
use crate::geometry::space::triangles::area;
use crate::parallel::prelude::*;
use glam::DVec3;

use self::plane_key::{OverlapCandidate, PlaneKey, widest_axis};
use super::border_curves::{BorderArc, arcs};
use super::colour_grid::faces_near_other_colours;
use super::common_area::common_area;
use crate::geometry::lists::csr_lists::{CsrLists, csr_lists_from_pairs};
use crate::mesh::normals::dihedral::{Dihedral, runs_up};
use crate::mesh::{EdgeFaces, FaceId, MaterialId, Mesh, PaintId, PartId};
use crate::parallel::task_size::MIN_TASK_ITEMS;

mod plane_key;

/// Stacking position of a face among coplanar surfaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Overlay {
    /// Number of the plane, from 1; 0 where the face overlaps nothing.
    pub plane: u32,
    /// Rank of its surface in the plane, lowest first.
    pub rank: u32,
}

/// Minimum cosine between the normals of flat neighbours.
const MIN_FLAT_COSINE: f32 = 0.999;

/// Maximum number of tests of surface pairs and triangle pairs, after which the search stops.
const MAX_PAIR_TESTS: usize = 50_000_000;

/// Stacking position of each face; empty if no surfaces overlap.
pub(crate) fn overlays(mesh: &Mesh) -> Vec<Overlay> {
    let colour = |face: u32| colour(mesh, face);
    let count = mesh.triangles.len() as u32;
    let is_alike = |face: u32| colour(face) == colour(0);
    if count == 0 || (0..count).into_par_iter().with_min_len(MIN_TASK_ITEMS).all(is_alike) {
        return Vec::new();
    }
    let surfaces = CoplanarPatches::of(mesh);
    let planes = UnionFind::new(surfaces.all.len());
    let related = surfaces.join_overlapping(mesh, &planes);
    if !related {
        return Vec::new();
    }
    let mut numbers: Vec<(u32, u32)> =
        (0..surfaces.all.len() as u32).map(|surface| (planes.root(surface), surface)).collect();
    numbers.sort_unstable();
    let mut of_surface = vec![Overlay::default(); surfaces.all.len()];
    let shared = numbers.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() > 1);
    for (same, plane) in shared.zip(1..) {
        let mut order: Vec<u32> = same.iter().map(|(_, surface)| *surface).collect();
        surfaces.sort_upwards(&mut order);
        for (surface, rank) in order.into_iter().zip(0..) {
            of_surface[surface as usize] = Overlay { plane, rank };
        }
    }
    let of_face = |surface: &u32| of_surface.get(*surface as usize).copied().unwrap_or_default();
    surfaces.of_face.iter().map(of_face).collect()
}

impl Mesh {
    /// Stacking position of a face.
    #[inline]
    #[must_use]
    pub fn overlay(&self, face: u32) -> Overlay {
        self.overlays.get(face as usize).copied().unwrap_or_default()
    }

    /// Whether two faces belong to the same plane of overlapping surfaces.
    #[inline]
    #[must_use]
    pub fn share_plane(&self, a: u32, b: u32) -> bool {
        let plane = self.overlay(a).plane;
        plane != 0 && plane == self.overlay(b).plane
    }

    /// Whether a face is one of the two hosts of a line, or coplanar with one of them. Such a face never
    /// hides the line.
    #[inline]
    #[must_use]
    pub fn touches(&self, hosts: [u32; 2], face: u32) -> bool {
        hosts.contains(&face)
            || (!self.overlays.is_empty() && hosts.iter().any(|host| self.share_plane(*host, face)))
    }

    /// Whether a face is on top of another one in the same plane.
    #[inline]
    #[must_use]
    pub fn is_over(&self, face: u32, other: u32) -> bool {
        self.share_plane(face, other) && self.overlay(face).rank > self.overlay(other).rank
    }
}

/// Material and paint of a face.
fn colour(mesh: &Mesh, face: u32) -> (MaterialId, PaintId) {
    (mesh.face_material[face as usize], mesh.paint(FaceId(face)))
}

/// Connected flat patch of one part, material and paint.
#[derive(Debug, Clone, Copy)]
struct CoplanarPatch {
    part: PartId,
    colour: (MaterialId, PaintId),
    area: f64,
    around: Bounds,
    /// Its largest face, with the area.
    largest: (u32, f64),
    contact: f64,
}

struct CoplanarPatches {
    all: Vec<CoplanarPatch>,
    /// Surface of each face; `u32::MAX` without area, and where no other colour is near.
    of_face: Vec<u32>,
    faces: CsrLists<u32>,
    /// Whether each face is near another colour. Only such faces can overlap one.
    near: Vec<bool>,
}

impl CoplanarPatches {
    fn of(mesh: &Mesh) -> Self {
        let owner = |face: u32| (mesh.face_part[face as usize], colour(mesh, face));
        let is_one = |[a, b]: [u32; 2], same_way: bool, edge: usize| {
            let dihedral = Dihedral::of(mesh, [a, b], same_way);
            owner(a) == owner(b) && dihedral.cosine > MIN_FLAT_COSINE && dihedral.is_flat(mesh, edge)
        };
        let is_up = |edge: usize, face: u32| runs_up(mesh, edge, face);
        let groups = DisjointSets::new(mesh.triangles.len(), |join| {
            (0..mesh.edges.len()).into_par_iter().with_min_len(MIN_TASK_ITEMS).for_each(|edge| {
                match mesh.edges.faces(edge) {
                    EdgeFaces::One(_) => {}
                    EdgeFaces::Two { faces: [a, b], same_way } => {
                        if is_one([a, b], same_way, edge) {
                            join(a, b);
                        }
                    }
                    EdgeFaces::Many(faces) => {
                        // Eight neighbours in the list are enough where all faces are one surface. Otherwise
                        // some patches stay separate.
                        for (k, a) in faces.iter().enumerate() {
                            for b in faces[..k].iter().rev().take(8) {
                                if is_one([*b, *a], is_up(edge, *a) == is_up(edge, *b), edge) {
                                    join(*a, *b);
                                }
                            }
                        }
                    }
                }
            });
        });
        // Patches without a face near another colour are skipped.
        let near = faces_near_other_colours(mesh, |face| mesh.paint(FaceId(face)).0);
        let mut is_asked = vec![false; near.len()];
        for face in (0..near.len() as u32).filter(|face| near[*face as usize]) {
            is_asked[groups.representative(face) as usize] = true;
        }
        let (mut all, mut of_face): (Vec<CoplanarPatch>, Vec<u32>) = (Vec::new(), Vec::new());
        for face in 0..mesh.triangles.len() as u32 {
            let root = groups.representative(face);
            if mesh.is_degenerate(FaceId(face)) || !is_asked[root as usize] {
                of_face.push(u32::MAX);
                continue;
            }
            let corners = mesh.corners(FaceId(face));
            let area = area(corners);
            let surface = if root == face { all.len() as u32 } else { of_face[root as usize] };
            of_face.push(surface);
            if root == face {
                let (part, colour) = owner(face);
                let contact = mesh.extent(FaceId(face)).contact;
                let (around, largest) = (Bounds::EMPTY, (face, area));
                all.push(CoplanarPatch { part, colour, area: 0.0, around, largest, contact });
            }
            let own = &mut all[surface as usize];
            own.area += area;
            own.around = own.around.union(Bounds::of(corners));
            if area > own.largest.1 {
                own.largest = (face, area);
            }
        }
        let is_real = |(surface, _): &(usize, u32)| *surface < all.len();
        let numbered = of_face.iter().map(|surface| *surface as usize).zip(0..).filter(is_real);
        let faces = csr_lists_from_pairs(all.len(), numbered);
        Self { all, of_face, faces, near }
    }

    /// Sorts surfaces of a plane, lowest first.
    fn sort_upwards(&self, order: &mut [u32]) {
        let of = |surface: &u32| &self.all[*surface as usize];
        let in_file = |surface: &u32| (of(surface).part, of(surface).colour, of(surface).largest.0);
        order.sort_by(|a, b| of(b).area.total_cmp(&of(a).area).then_with(|| in_file(a).cmp(&in_file(b))));
        // Areas that differ only by rounding are equal.
        let is_equal = |a: &u32, b: &u32| {
            let reach = |own: &CoplanarPatch| 2.0 * own.contact * own.around.diagonal();
            (of(a).area - of(b).area).abs() <= reach(of(a)) + reach(of(b))
        };
        order.chunk_by_mut(is_equal).for_each(|equal| equal.sort_by_key(in_file));
    }

    /// Joins the overlapping surfaces of different colours. Returns whether there are any.
    fn join_overlapping(&self, mesh: &Mesh, planes: &UnionFind) -> bool {
        let surfaces = (0..self.all.len() as u32).into_par_iter().with_min_len(MIN_TASK_ITEMS);
        let keys: Vec<PlaneKey> = surfaces.clone().map(|surface| self.key(mesh, surface)).collect();
        let of_surface = |surface: u32| keys[surface as usize].cells().map(move |cell| (cell, surface));
        let mut cells: Vec<([i64; 3], u32)> = surfaces.flat_map_iter(of_surface).collect();
        cells.par_sort_unstable();
        let (mut tests, mut related) = (0, false);
        let mut arcs: Vec<Option<Vec<BorderArc>>> = vec![None; self.all.len()];
        let mut own: Vec<OverlapCandidate> = Vec::new();
        for cell in cells.chunk_by(|a, b| a.0 == b.0) {
            let colour = |at: &([i64; 3], u32)| self.all[at.1 as usize].colour;
            if cell.iter().all(|at| colour(at) == colour(&cell[0])) {
                continue;
            }
            own.clear();
            own.extend(cell.iter().map(|(_, surface)| {
                let CoplanarPatch { around, colour, contact, .. } = self.all[*surface as usize];
                OverlapCandidate {
                    around: around.grown(contact),
                    key: keys[*surface as usize],
                    colour,
                    surface: *surface,
                }
            }));
            let axis = widest_axis(&own);
            own.sort_by(|a, b| {
                a.around.low[axis].total_cmp(&b.around.low[axis]).then(a.surface.cmp(&b.surface))
            });
            for (k, first) in own.iter().enumerate() {
                for other in
                    own[k + 1..].iter().take_while(|other| other.around.low[axis] <= first.around.high[axis])
                {
                    tests += 1;
                    if tests > MAX_PAIR_TESTS {
                        return related;
                    }
                    if first.may_overlap(other)
                        && planes.root(first.surface) != planes.root(other.surface)
                        && self.overlap(mesh, first.surface, other.surface, &mut arcs, &mut tests)
                    {
                        planes.join(first.surface, other.surface);
                        related = true;
                    }
                }
            }
        }
        related
    }

    /// Plane key of a surface, from its largest face.
    fn key(&self, mesh: &Mesh, surface: u32) -> PlaneKey {
        let own = &self.all[surface as usize];
        PlaneKey::of(mesh, own.largest.0)
    }

    /// Whether triangles of two surfaces have a common area in one plane that exceeds slivers. `arcs` caches
    /// the curved borders of surfaces.
    fn overlap(
        &self,
        mesh: &Mesh,
        first: u32,
        other: u32,
        arcs: &mut [Option<Vec<BorderArc>>],
        tests: &mut usize,
    ) -> bool {
        let (one, two) = (&self.all[first as usize], &self.all[other as usize]);
        let contact = one.contact.max(two.contact);
        let meet = |a: Bounds, b: Bounds| a.meets(&b.grown(contact));
        let (one_box, two_box) = (one.around, two.around);
        if !meet(one_box, two_box) {
            return false;
        }
        // Triangles near the other surface, with their boxes.
        let near = |surface: u32, other: Bounds| -> Vec<([DVec3; 3], Bounds)> {
            let faces = self.faces.of(surface as usize).iter().filter(|face| self.near[**face as usize]);
            let corners = faces.map(|face| mesh.corners(FaceId(*face)));
            let boxed = corners.map(|own| (own, Bounds::of(own)));
            boxed.filter(|(_, own)| meet(*own, other)).collect()
        };
        *tests += self.faces.of(first as usize).len() + self.faces.of(other as usize).len();
        let (one, two) = (near(first, two_box), near(other, one_box));
        let (mut common, mut slivers) = (0.0, None);
        for (a, a_box) in &one {
            *tests += two.len();
            if *tests > MAX_PAIR_TESTS {
                return false;
            }
            for (b, _) in two.iter().filter(|(_, b_box)| meet(*a_box, *b_box)) {
                common += common_area(a, b, contact);
                if common == 0.0 {
                    continue;
                }
                let slivers = slivers.get_or_insert_with(|| {
                    let mut near = |surface: u32, other| -> f64 {
                        let own = arcs[surface as usize].get_or_insert_with(|| self.arcs(mesh, surface));
                        own.iter().filter(|arc| meet(Bounds::of(arc.ends), other)).map(|arc| arc.area).sum()
                    };
                    near(first, two_box) + near(other, one_box)
                });
                if common > *slivers {
                    return true;
                }
            }
        }
        false
    }

    /// Curved borders of a surface.
    fn arcs(&self, mesh: &Mesh, surface: u32) -> Vec<BorderArc> {
        arcs(mesh, self.faces.of(surface as usize), |face| self.of_face[face as usize] == surface)
    }
}

#[cfg(test)]
mod tests;
