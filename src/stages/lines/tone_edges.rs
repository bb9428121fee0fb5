//! Edges of the mesh across which the surface looks different: another part or material, or another
//! tone because its normals differ.

use rayon::prelude::*;
use rustc_hash::FxHashSet;

use super::{FeatureLines, FeatureSegment, LineKind, Lit, NO_FACE, Role};
use crate::field::ShadedNormals;
use crate::mesh::{EdgeFaces, EdgeSet, FaceId, MaterialId, Mesh, PaintId, PartId};
use crate::scene::Paints;
use crate::shape::Origin;

/// Places along an edge where both its sides are looked at. What differs between them only ends
/// there: the border runs on to the end of the edge, with the same look on both sides.
const PLACES: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];

/// The edges across which a surface may look different, whatever the light: where parts, materials or
/// normals differ, or what is shown of pictures. The same for all views.
#[must_use]
pub fn candidates(mesh: &Mesh, normals: &ShadedNormals, paints: &Paints) -> EdgeSet {
    let mut has_picture = vec![false; paints.list.len()];
    for (paint, _) in &paints.pictures {
        if let Some(has_picture) = has_picture.get_mut(paint.index()) {
            *has_picture = true;
        }
    }
    let shows_picture =
        |face: u32| has_picture.get(mesh.paint(FaceId(face)).index()).is_some_and(|shows| *shows);
    let uv = |face: u32, v: u32| {
        let corner = mesh.triangles[face as usize].iter().position(|t| *t == v).unwrap_or_default();
        mesh.uvs.get(mesh.corner_uvs.get(face as usize)?[corner] as usize)
    };
    let differ = |[first, second]: [u32; 2], ends: [u32; 2]| {
        let owner = |face: u32| owner(mesh, face);
        let normal = |face: u32, v: u32| {
            let corner = mesh.triangles[face as usize].iter().position(|t| *t == v).unwrap_or_default();
            normals.normals[normals.corners[face as usize][corner] as usize]
        };
        owner(first) != owner(second)
            || ends.iter().any(|v| normal(first, *v) != normal(second, *v))
            || (shows_picture(first) && ends.iter().any(|v| uv(first, *v) != uv(second, *v)))
    };
    EdgeSet::collect(mesh.edges.len(), |edge| match mesh.edges.faces(edge) {
        EdgeFaces::One(_) => false,
        EdgeFaces::Two { faces, .. } => differ(faces, mesh.edges.vertices[edge]),
        EdgeFaces::Many(_) => true,
    })
}

/// Adds those of the candidates that part two looks, for any of these sets of lights that are in
/// shadow, and are no lines yet.
pub fn find(lit: &Lit, candidates: &EdgeSet, shadowed: &[u32], lines: &mut FeatureLines) {
    let edges: Vec<usize> = candidates.iter().collect();
    let mut found: Vec<FeatureSegment> =
        edges.par_iter().with_min_len(1 << 9).filter_map(|edge| parting(lit, *edge, shadowed)).collect();
    if !found.is_empty() {
        let known: FxHashSet<[u32; 2]> = lines.segments.iter().map(|segment| segment.ends).collect();
        found.retain(|segment| !known.contains(&segment.ends));
        lines.segments.extend(found);
    }
}

/// A piece of a line between two tones or paints.
pub(super) fn segment(
    mesh: &Mesh,
    face: u32,
    hosts: [u32; 2],
    kind: LineKind,
    ends: [u32; 2],
) -> FeatureSegment {
    FeatureSegment {
        ends,
        hosts,
        kind,
        both_seen: true,
        smooth: hosts[1] == NO_FACE,
        origin: Origin::default(),
        role: Role::Line,
        strength: 180.0,
        part: mesh.face_part[face as usize],
        material: mesh.face_material[face as usize],
    }
}

fn parting(lit: &Lit, edge: usize, shadowed: &[u32]) -> Option<FeatureSegment> {
    let mesh = lit.mesh;
    let ends = mesh.edges.vertices[edge];
    let is_real = |face: &u32| !mesh.is_degenerate(FaceId(*face));
    let (first, second) = match mesh.edges.faces(edge) {
        EdgeFaces::One(_) => return None,
        EdgeFaces::Two { faces: [first, second], .. } => (first, second),
        EdgeFaces::Many(faces) => {
            // The first face, and one that looks different.
            let first = *faces.iter().find(|f| is_real(f))?;
            let other = |f: &&u32| **f != first && is_real(f) && differ(lit, ends, [first, **f], shadowed);
            (first, *faces.iter().find(other)?)
        }
    };
    let faces = [first, second];
    let parts = faces.iter().all(is_real) && differ(lit, ends, faces, shadowed);
    parts.then(|| segment(mesh, first, faces, parting_kind(lit, ends, faces), ends))
}

/// What the line is on an edge that parts two faces.
fn parting_kind(lit: &Lit, ends: [u32; 2], faces: [u32; 2]) -> LineKind {
    let mesh = lit.mesh;
    let is_within = |[a, b]: [u32; 2]| {
        mesh.face_part[a as usize] == mesh.face_part[b as usize]
            && mesh.face_material[a as usize] == mesh.face_material[b as usize]
    };
    let middle = (mesh.positions[ends[0] as usize] + mesh.positions[ends[1] as usize]) / 2.0;
    let [a, b] = faces.map(|face| lit.paint(face, middle));
    if is_within(faces) { lit.textures.parting(a, b) } else { LineKind::Isophote }
}

/// What a face belongs to, and its paint.
fn owner(mesh: &Mesh, face: u32) -> (PartId, MaterialId, PaintId) {
    (mesh.face_part[face as usize], mesh.face_material[face as usize], mesh.paint(FaceId(face)))
}

/// Whether two faces look different anywhere along their edge.
fn differ(lit: &Lit, ends: [u32; 2], faces: [u32; 2], shadowed: &[u32]) -> bool {
    let mesh = lit.mesh;
    let owner = |face: u32| owner(mesh, face);
    if owner(faces[0]) != owner(faces[1]) {
        return true;
    }
    let corner = |face: u32, v: u32| mesh.triangles[face as usize].iter().position(|t| *t == v);
    if show_different(lit, ends, faces) {
        return true;
    }
    let place = |face: u32| Some([corner(face, ends[0])?, corner(face, ends[1])?]);
    let (Some(a), Some(b)) = (place(faces[0]), place(faces[1])) else { return false };
    let normals = faces.map(|face| lit.normals.of(face));
    if (0..2).all(|k| normals[0][a[k]] == normals[1][b[k]]) {
        return false;
    }
    // Both sides belong to the same and have the same paint: only their tones may differ.
    let look = |face: u32, at: [usize; 2], t: f64, shadowed: u32| {
        let mut weights = [0.0; 3];
        weights[at[0]] = 1.0 - t;
        weights[at[1]] = t;
        lit.tone(mesh.paint(FaceId(face)), &lit.point(face, weights), shadowed)
    };
    let differs = |t: f64, shadowed: u32| look(faces[0], a, t, shadowed) != look(faces[1], b, t, shadowed);
    shadowed.iter().any(|shadowed| PLACES.iter().any(|t| differs(*t, *shadowed)))
}

/// Whether two faces show different colours of a picture anywhere along their edge.
fn show_different(lit: &Lit, ends: [u32; 2], faces: [u32; 2]) -> bool {
    let shown = faces.map(|face| lit.textures.on(lit.mesh, face));
    let [Some(a), Some(b)] = &shown else { return false };
    let weights = |face: u32, t: f64| {
        lit.mesh.triangles[face as usize].map(|v| match v {
            v if v == ends[0] => 1.0 - t,
            v if v == ends[1] => t,
            _ => 0.0,
        })
    };
    let steps = a.texels_along([0.0, 1.0].map(|t| weights(faces[0], t))).clamp(4.0, MOST_STEPS).ceil();
    (0..steps as u32).any(|k| {
        let t = (f64::from(k) + 0.5) / steps;
        a.paint(weights(faces[0], t)) != b.paint(weights(faces[1], t))
    })
}

/// Places along the edge of a picture that are compared, at most.
const MOST_STEPS: f64 = 256.0;
