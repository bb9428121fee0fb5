//! [`Planes`]: the flats of a mesh, regions of several faces that lie in one plane.
//!
//! Machined parts have them, scans and figures do not: their triangles turn a little at almost every
//! edge.

use std::sync::atomic::AtomicU32;
use std::sync::atomic::Ordering::Relaxed;

use crate::parallel::prelude::*;

use super::group_sums::sums;
use crate::mesh::components::disjoint_sets::{Groups, Numbered};
use crate::mesh::edges::edge_set::EdgeSet;
use crate::mesh::{EdgeFaces, FaceId, Mesh, Turns};
use crate::parallel::task_size::GRAIN;

/// The cosine above which an edge counts as flat: a tenth of a degree.
const FLAT_COSINE: f32 = 0.999_998_5;
/// Fewer faces than this in one plane are chance: two halves of a quad, three where a corner was cut.
const LEAST_FACES: u32 = 4;
/// The least area of a compact flat, as a part of its outline squared: a circle has 0.08, a square
/// 0.0625, a strip that is ten times as long as wide 0.02.
const COMPACT: f64 = 0.025;

/// In [`Planes::of_face`]: the face is in no flat.
const NONE: u32 = u32::MAX;
/// In [`Planes::of_face`]: the face lies in one plane with a neighbour, but they are too few for a flat.
const FEW: u32 = u32::MAX - 1;

/// The flats of a mesh.
#[derive(Debug, Clone, Default)]
pub(crate) struct Planes {
    /// Edges at which the surface does not turn.
    pub flat: EdgeSet,
    /// The number of the flat each face is in.
    of_face: Vec<u32>,
    /// Whether each flat is no strip.
    compact: Vec<bool>,
}

impl Planes {
    pub fn new(mesh: &Mesh, turns: &Turns) -> Self {
        let faces = mesh.triangles.len();
        let flat = EdgeSet::collect(mesh.edges.len(), |edge| turns.of_two(edge) > FLAT_COSINE);
        let groups = Groups::new(faces, |join| {
            flat.par_for_each(|edge| {
                if let EdgeFaces::Two { faces: [a, b], .. } = mesh.edges.faces(edge) {
                    join(a, b);
                }
            });
        });
        let sizes = sizes(&groups, faces);
        let Numbered { of_face, first } = groups.numbered(|face| match sizes[face as usize].load(Relaxed) {
            LEAST_FACES.. => None,
            2.. => Some(FEW),
            _ => Some(NONE),
        });
        drop(sizes);
        let in_flat = |face: u32| Some(of_face[face as usize]).filter(|flat| *flat < FEW);
        // Scans have no flats at all.
        let asked = |count: usize| if first.is_empty() { 0 } else { count };
        let area_of = |face: usize| in_flat(face as u32).map(|flat| (flat, area(mesh, face as u32)));
        let length = |edge: usize| {
            let [a, b] = mesh.edges.vertices[edge].map(|v| mesh.positions[v as usize]);
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
        let is_compact = |(area, outline): (f64, f64)| area >= COMPACT * outline * outline;
        let compact = areas.into_iter().zip(outlines).map(is_compact).collect();
        Self { flat, of_face, compact }
    }

    /// The number of the flat that a face is in.
    #[inline]
    pub fn of(&self, face: u32) -> Option<u32> {
        Some(self.of_face[face as usize]).filter(|flat| *flat < FEW)
    }

    /// Whether a face lies in one plane with a neighbour.
    #[inline]
    pub fn is_level(&self, face: u32) -> bool {
        self.of_face[face as usize] != NONE
    }

    /// The flat that holds a face, unless it is a strip.
    #[inline]
    pub fn compact(&self, face: u32) -> Option<u32> {
        self.of(face).filter(|flat| self.compact[*flat as usize])
    }
}

/// How many faces each group has, at its least face.
fn sizes(groups: &Groups, faces: usize) -> Vec<AtomicU32> {
    let faces = (0..faces as u32).into_par_iter().with_min_len(GRAIN);
    let sizes: Vec<AtomicU32> = faces.clone().map(|_| AtomicU32::new(0)).collect();
    // Neighbours mostly are of one group, so that a whole run of them is added at once.
    let add = |(group, size): (u32, u32)| {
        if size > 0 {
            sizes[group as usize].fetch_add(size, Relaxed);
        }
    };
    let last_run = faces.fold(
        || (0, 0),
        |(group, size), face| {
            let own = groups.of(face);
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

/// The area of a face, world units squared.
#[inline]
pub(crate) fn area(mesh: &Mesh, face: u32) -> f64 {
    let [a, b, c] = mesh.corners(FaceId(face));
    (b - a).cross(c - a).length() / 2.0
}
