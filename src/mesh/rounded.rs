//! Which surfaces of a model are meant to be round: statistics of dihedral angles and of the file's
//! normals, for each part and material.
//!
//! Machined parts are made of planes and of strips that turn one way, so that many edges are flat
//! and many are sharp. Scans and modelled figures turn a little at almost every edge.

use std::collections::BTreeMap;

use glam::Vec3;
use rayon::prelude::*;

use super::{EdgeFaces, Mesh};

/// The cosine above which an edge counts as flat: a tenth of a degree.
const FLAT_COSINE: f32 = 0.999_998_5;
/// The cosine below which an edge counts as sharp: 60 degrees.
const SHARP_COSINE: f32 = 0.5;
/// With at most this share of flat edges a surface is rounded, however many are sharp.
const FEW_FLAT: f64 = 0.25;
/// The same where the file has normals: then armour and tools are shaded round over sharp edges, and
/// their flats tell them from figures.
const FEW_FLAT_SHADED: f64 = 0.08;
/// With more than this share of flat edges it is not, however few are sharp.
const MANY_FLAT: f64 = 0.45;
/// In between, it is with at most this share of sharp edges.
const FEW_SHARP: f64 = 0.045;
/// Fewer edges than this are no statistics: such a group is a block or a plate.
const LEAST_EDGES: u32 = 60;
/// The cosine above which a corner's normal is that of its face.
const OWN_NORMAL_COSINE: f32 = 0.9999;
/// A file whose normals say of fewer faces than this share that they are curved means them flat.
const FEW_CURVED: f64 = 0.05;

/// What is counted of the faces of one part and material.
#[derive(Debug, Clone, Copy, Default)]
struct Count {
    edges: u32,
    flat: u32,
    sharp: u32,
    faces: u32,
    curved: u32,
    with_normals: u32,
}

impl Count {
    fn plus(self, other: &Self) -> Self {
        Self {
            edges: self.edges + other.edges,
            flat: self.flat + other.flat,
            sharp: self.sharp + other.sharp,
            faces: self.faces + other.faces,
            curved: self.curved + other.curved,
            with_normals: self.with_normals + other.with_normals,
        }
    }

    fn is_rounded(&self) -> bool {
        let share = |of: u32, all: u32| f64::from(of) / f64::from(all.max(1));
        let (flat, sharp) = (share(self.flat, self.edges), share(self.sharp, self.edges));
        let faceted = self.with_normals == self.faces && share(self.curved, self.faces) < FEW_CURVED;
        let shaded = share(self.with_normals, self.faces) > 0.5;
        let few = if shaded { FEW_FLAT_SHADED } else { FEW_FLAT };
        self.edges >= LEAST_EDGES && !faceted && (flat <= few || (flat <= MANY_FLAT && sharp <= FEW_SHARP))
    }
}

/// For each face, whether it belongs to a rounded surface.
#[must_use]
pub fn rounded_faces(mesh: &Mesh) -> Vec<bool> {
    let key = |face: u32| (mesh.face_part[face as usize], mesh.face_material[face as usize]);
    type Counts = BTreeMap<(super::PartId, super::MaterialId), Count>;
    const CHUNK: usize = 1 << 15;
    let chunks =
        |n: usize| (0..n.div_ceil(CHUNK)).into_par_iter().map(move |k| k * CHUNK..((k + 1) * CHUNK).min(n));
    let join = |mut a: Counts, b: Counts| {
        for (key, count) in b {
            let sum = a.entry(key).or_default();
            *sum = sum.plus(&count);
        }
        a
    };
    let of_edges = chunks(mesh.edges.len()).map(|edges| {
        let mut counts = Counts::new();
        let mut at = None;
        let mut run = Count::default();
        for edge in edges {
            let EdgeFaces::Two { faces: [first, second], same_way } = mesh.edges.faces(edge) else {
                continue;
            };
            let normals = [first, second].map(|f| Vec3::from_array(mesh.face_normals[f as usize]));
            if normals.contains(&Vec3::ZERO) {
                continue;
            }
            // Neighbouring edges mostly lie in one group.
            if at != Some(key(first)) {
                add(&mut counts, at.replace(key(first)), &std::mem::take(&mut run));
            }
            let cosine = if same_way { -normals[0].dot(normals[1]) } else { normals[0].dot(normals[1]) };
            run.edges += 1;
            run.flat += u32::from(cosine > FLAT_COSINE);
            run.sharp += u32::from(cosine < SHARP_COSINE);
        }
        add(&mut counts, at, &run);
        counts
    });
    let mut counts = of_edges.reduce(Counts::new, join);
    if !mesh.corner_normals.is_empty() {
        for face in 0..mesh.triangles.len() {
            let own = Vec3::from_array(mesh.face_normals[face]);
            let normals = mesh.corner_normals[face].map(|id| mesh.normals.get(id as usize));
            let count = counts.entry(key(face as u32)).or_default();
            count.faces += 1;
            count.with_normals += u32::from(normals.iter().all(Option::is_some));
            let leaves = |n: &[f32; 3]| Vec3::from_array(*n).dot(own).abs() < OWN_NORMAL_COSINE;
            count.curved += u32::from(normals.iter().flatten().any(|n| leaves(n)));
        }
    } else {
        counts.values_mut().for_each(|count| count.faces = 1);
    }
    let mut at = None;
    let mut rounded = false;
    (0..mesh.triangles.len() as u32)
        .map(|face| {
            if at != Some(key(face)) {
                at = Some(key(face));
                rounded = counts.get(&key(face)).is_some_and(Count::is_rounded);
            }
            rounded
        })
        .collect()
}

fn add<K: Ord>(counts: &mut BTreeMap<K, Count>, key: Option<K>, count: &Count) {
    if let Some(key) = key {
        let sum = counts.entry(key).or_default();
        *sum = sum.plus(count);
    }
}
