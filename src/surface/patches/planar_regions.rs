//! [`PlanarRegions`]: planar regions of a mesh, made of several coplanar faces.
//!
//! Machined parts have planar regions. Scans and figures have none: their triangles turn a little at almost
//! every edge.

use std::sync::atomic::AtomicU32;
use std::sync::atomic::Ordering::Relaxed;

use crate::geometry::lists::disjoint_sets::{DisjointSets, NumberedSets};
use crate::parallel::prelude::*;

use crate::geometry::lists::group_sums::sums;
use crate::mesh::EdgeSet;
use crate::mesh::{DihedralCosines, EdgeFaces, FaceId, Mesh};
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::surface::tolerances::MIN_FLAT_COSINE;

/// Minimum number of faces of a planar region. Fewer may be coplanar at random: two halves of a quad, or
/// three faces at a cut corner.
const MIN_REGION_FACES: u32 = 4;
/// Minimum area of a compact region, as a share of its squared outline length. A circle has 0.08, a square
/// 0.0625, a strip ten times longer than wide 0.02.
const MIN_AREA_PER_SQUARED_OUTLINE: f64 = 0.025;

/// In [`PlanarRegions::of_face`]: the face is in no planar region.
const NO_REGION: u32 = u32::MAX;
/// In [`PlanarRegions::of_face`]: the face is coplanar with a neighbour, but the group is too small for a region.
const TOO_SMALL_REGION: u32 = u32::MAX - 1;

/// The planar regions of a mesh.
#[derive(Debug, Clone, Default)]
pub(crate) struct PlanarRegions {
    /// Edges where the surface is flat.
    pub flat: EdgeSet,
    /// Planar region of each face.
    region_of_face: Vec<u32>,
    /// Whether each region is compact, not a strip.
    compact: Vec<bool>,
}

impl PlanarRegions {
    pub(crate) fn new(mesh: &Mesh, turns: &DihedralCosines) -> Self {
        let faces = mesh.triangles.len();
        let flat = EdgeSet::collect(mesh.edges.len(), |edge| turns.of_two(edge) > MIN_FLAT_COSINE);
        let groups = DisjointSets::new(faces, |join| {
            flat.par_for_each(|edge| {
                if let EdgeFaces::Two { faces: [a, b], .. } = mesh.edges.faces(edge) {
                    join(a, b);
                }
            });
        });
        let sizes = sizes(&groups, faces);
        let NumberedSets { set_of_face: of_face, first } =
            groups.numbered(|face| match sizes[face as usize].load(Relaxed) {
                MIN_REGION_FACES.. => None,
                2.. => Some(TOO_SMALL_REGION),
                _ => Some(NO_REGION),
            });
        drop(sizes);
        let in_flat = |face: u32| Some(of_face[face as usize]).filter(|flat| *flat < TOO_SMALL_REGION);
        // Scans have no planar regions.
        let asked = |count: usize| if first.is_empty() { 0 } else { count };
        let area_of = |face: usize| in_flat(face as u32).map(|flat| (flat, mesh.area(FaceId(face as u32))));
        let length = |edge: usize| {
            let [a, b] = mesh.ends(edge);
            a.distance(b)
        };
        let bounded_by = |edge: usize| {
            let (in_flat, length, turns) = (&in_flat, &length, !flat.contains(edge));
            let bounds = move |face| in_flat(face).filter(|_| turns).map(|flat| (flat, length(edge)));
            mesh.edges.faces(edge).each().filter_map(bounds)
        };
        let (areas, outlines): (Vec<f64>, Vec<f64>) = crate::parallel::join(
            || sums(first.len(), asked(faces), area_of),
            || sums(first.len(), asked(mesh.edges.len()), bounded_by),
        );
        let is_compact =
            |(area, outline): (f64, f64)| area >= MIN_AREA_PER_SQUARED_OUTLINE * outline * outline;
        let compact = areas.into_iter().zip(outlines).map(is_compact).collect();
        Self { flat, region_of_face: of_face, compact }
    }

    /// The planar region that contains a face.
    #[inline]
    pub(crate) fn region_at(&self, face: u32) -> Option<u32> {
        Some(self.region_of_face[face as usize]).filter(|flat| *flat < TOO_SMALL_REGION)
    }

    /// Whether a face is coplanar with a neighbour.
    #[inline]
    pub(crate) fn is_level(&self, face: u32) -> bool {
        self.region_of_face[face as usize] != NO_REGION
    }

    /// The planar region that contains a face, unless it is a strip.
    #[inline]
    pub(crate) fn compact(&self, face: u32) -> Option<u32> {
        self.region_at(face).filter(|flat| self.compact[*flat as usize])
    }
}

/// Number of faces in each group, stored at its smallest face.
fn sizes(groups: &DisjointSets, faces: usize) -> Vec<AtomicU32> {
    let faces = (0..faces as u32).into_par_iter().with_min_len(MIN_TASK_ITEMS);
    let sizes: Vec<AtomicU32> = faces.clone().map(|_| AtomicU32::new(0)).collect();
    // Consecutive faces mostly belong to one group, so whole runs are added at once.
    let add = |(group, size): (u32, u32)| {
        if size > 0 {
            sizes[group as usize].fetch_add(size, Relaxed);
        }
    };
    let last_run = faces.fold(
        || (0, 0),
        |(group, size), face| {
            let own = groups.representative(face);
            if own == group {
                (group, size + 1)
            } else {
                add((group, size));
                (own, 1)
            }
        },
    );
    last_run.for_each(add);
    sizes
}
