//! Tone edges: mesh edges across which part, material, paint or tone differ.

use crate::parallel::prelude::*;
use rustc_hash::FxHashSet;

use super::face_borders;
use crate::light::ShadingNormals;
use crate::lines::feature_line::segment;
use crate::lines::textures::textured_face::TexturedFace;
use crate::lines::tolerances;
use crate::lines::{FeatureLines, FeatureSegment, LineKind, Lit};
use crate::mesh::{EdgeFaces, EdgeSet, FaceId, MaterialId, Mesh, PaintId, PartId};
use crate::scene::Paints;

/// Parameters along an edge where both sides are compared. If they differ at any of them, the whole edge is a
/// border.
const SAMPLE_PARAMETERS: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];

/// Edges that may separate two looks in some light. The same for all views.
///
/// These are edges where parts, materials, normals, texture coordinates or vertex colours differ.
#[must_use]
pub(crate) fn candidates(mesh: &Mesh, normals: &ShadingNormals, paints: &Paints) -> EdgeSet {
    let mut varies = vec![false; paints.list.len()];
    for (paint, _) in &paints.varied {
        if let Some(varies) = varies.get_mut(paint.index()) {
            *varies = true;
        }
    }
    let varies = |face: u32| {
        varies.get(mesh.paint(FaceId(face)).index()).is_some_and(|varies| *varies)
            || paints.inked.iter().any(|(material, _)| *material == mesh.face_material[face as usize])
    };
    let uv = |face: u32, v: u32| {
        let corner = mesh.triangles[face as usize].iter().position(|t| *t == v).unwrap_or_default();
        mesh.uvs.get(mesh.corner_uvs.get(face as usize)?[corner] as usize)
    };
    let colour = |face: u32, v: u32| {
        let corner = mesh.triangles[face as usize].iter().position(|t| *t == v).unwrap_or_default();
        mesh.corner_colours.get(face as usize).map(|corners| corners[corner])
    };
    let differ = |[first, second]: [u32; 2], ends: [u32; 2]| {
        let owner = |face: u32| owner(mesh, face);
        let normal = |face: u32, v: u32| {
            let corner = mesh.triangles[face as usize].iter().position(|t| *t == v).unwrap_or_default();
            normals.normals[normals.corners[face as usize][corner] as usize]
        };
        owner(first) != owner(second)
            || ends.iter().any(|v| normal(first, *v) != normal(second, *v))
            || (varies(first)
                && ends
                    .iter()
                    .any(|v| uv(first, *v) != uv(second, *v) || colour(first, *v) != colour(second, *v)))
    };
    EdgeSet::collect(mesh.edges.len(), |edge| match mesh.edges.faces(edge) {
        EdgeFaces::One(_) => false,
        EdgeFaces::Two { faces, .. } => differ(faces, mesh.edges.vertices[edge]),
        EdgeFaces::Many(_) => true,
    })
}

/// Edge that has different kinds along its length.
#[derive(Debug, Clone)]
pub(crate) struct ToneEdge {
    /// The whole edge.
    pub(crate) segment: FeatureSegment,
    /// Pieces from end to end: start and end in barycentric weights of the first face (none at the ends of
    /// the edge), and the kind.
    pub(crate) pieces: Vec<([Option<[f64; 3]>; 2], LineKind)>,
}

/// Adds the candidates that separate two looks, under any of the given sets of shadowed lights, unless they
/// are lines already. Returns the edges with several kinds, which are not added.
pub(crate) fn find(
    lit: &Lit,
    candidates: &EdgeSet,
    shadowed: &[u32],
    lines: &mut FeatureLines,
) -> Vec<ToneEdge> {
    let edges: Vec<usize> = candidates.iter().collect();
    let mut found: Vec<ToneEdge> = edges
        .par_iter()
        .with_min_len(1 << 9)
        .with_max_len(1 << 10)
        .filter_map(|edge| classify_edge(lit, *edge, shadowed))
        .collect();
    if found.is_empty() {
        return found;
    }
    let line_ends: FxHashSet<[u32; 2]> = lines.segments.iter().map(|segment| segment.ends).collect();
    found.retain(|seam| !line_ends.contains(&seam.segment.ends));
    let (cut, uncut): (Vec<ToneEdge>, Vec<ToneEdge>) =
        found.into_iter().partition(|seam| !seam.pieces.is_empty());
    lines.segments.extend(uncut.into_iter().map(|seam| seam.segment));
    cut
}

fn classify_edge(lit: &Lit, edge: usize, shadowed: &[u32]) -> Option<ToneEdge> {
    let mesh = lit.mesh;
    let ends = mesh.edges.vertices[edge];
    let is_real = |face: &u32| !mesh.is_degenerate(FaceId(*face));
    let (first, second) = match mesh.edges.faces(edge) {
        EdgeFaces::One(_) => return None,
        EdgeFaces::Two { faces: [first, second], .. } => (first, second),
        EdgeFaces::Many(faces) => {
            // The first face, and another one that looks different.
            let first = *faces.iter().find(|f| is_real(f))?;
            let differs_from_first =
                |f: &&u32| **f != first && is_real(f) && differ(lit, ends, [first, **f], shadowed);
            (first, *faces.iter().find(differs_from_first)?)
        }
    };
    let faces = [first, second];
    if !faces.iter().all(is_real) {
        return None;
    }
    let is_parting = differ(lit, ends, faces, shadowed);
    if !is_parting && faces.iter().any(|face| lit.textures.ink_on(mesh, *face).is_none()) {
        return None;
    }
    let mut pieces = kinds_along(lit, ends, faces);
    pieces.dedup_by(|next, last| {
        let is_one = next.1 == last.1;
        if is_one {
            last.0[1] = next.0[1];
        }
        is_one
    });
    let kind = pieces.first().map_or(LineKind::Isophote, |(_, kind)| *kind);
    if !is_parting && pieces.len() == 1 && kind == LineKind::Isophote {
        return None;
    }
    pieces.retain(|(piece_ends, _)| piece_ends.iter().any(Option::is_some));
    Some(ToneEdge { segment: segment(mesh, first, faces, kind, ends), pieces })
}

/// Kinds of line along an edge between two faces, piece by piece.
fn kinds_along(lit: &Lit, ends: [u32; 2], faces: [u32; 2]) -> Vec<([Option<[f64; 3]>; 2], LineKind)> {
    let mesh = lit.mesh;
    let [a, b] = faces.map(|face| (mesh.face_part[face as usize], mesh.face_material[face as usize]));
    if a != b || !lit.textures.has_artist() {
        return vec![([None, None], LineKind::Isophote)];
    }
    if let [Some(first), Some(second)] = faces.map(|face| lit.textures.ink_on(mesh, face)) {
        let kind = |at: f64| {
            let [a, b] = [(&first, faces[0]), (&second, faces[1])]
                .map(|(ink, face)| ink.paint(weights_along(mesh, ends, face, at)));
            a.zip(b).map_or(LineKind::Isophote, |(a, b)| {
                lit.textures.picture_line_kind_between(mesh, faces[0], [a, b])
            })
        };
        let ink_stretches = stretches(lit, ends, faces, |face| lit.textures.ink_on(mesh, face));
        return ink_stretches.into_iter().map(|at| (at, kind(middle(lit, ends, faces[0], at)))).collect();
    }
    let kind = |at: f64| {
        let [a, b] = faces.map(|face| paint_along(lit, ends, face, at));
        lit.textures.line_kind_between(a, b)
    };
    let texture_stretches = stretches(lit, ends, faces, |face| lit.textures.face_texture(mesh, face));
    texture_stretches.into_iter().map(|at| (at, kind(middle(lit, ends, faces[0], at)))).collect()
}

/// Paint of a face at a parameter of its edge.
fn paint_along(lit: &Lit, ends: [u32; 2], face: u32, at: f64) -> PaintId {
    let textured = lit.textures.face_texture(lit.mesh, face);
    let weights = weights_along(lit.mesh, ends, face, at);
    textured.and_then(|textured| textured.paint(weights)).unwrap_or_else(|| lit.mesh.paint(FaceId(face)))
}

/// Barycentric weights in a face of a point on its edge.
fn weights_along(mesh: &Mesh, ends: [u32; 2], face: u32, at: f64) -> [f64; 3] {
    mesh.triangles[face as usize].map(|v| match v {
        v if v == ends[0] => 1.0 - at,
        v if v == ends[1] => at,
        _ => 0.0,
    })
}

/// Parameter of the middle of a stretch of an edge.
fn middle(lit: &Lit, ends: [u32; 2], face: u32, piece_ends: [Option<[f64; 3]>; 2]) -> f64 {
    let corner = lit.mesh.triangles[face as usize].iter().position(|v| *v == ends[1]).unwrap_or_default();
    let [from, to] =
        [(piece_ends[0], 0.0), (piece_ends[1], 1.0)].map(|(at, end)| at.map_or(end, |at| at[corner]));
    f64::midpoint(from, to)
}

/// Stretches of an edge where neither face changes its colour: start and end in barycentric weights of the
/// first face (none at the ends of the edge).
fn stretches<'a>(
    lit: &Lit,
    ends: [u32; 2],
    faces: [u32; 2],
    shown: impl Fn(u32) -> Option<TexturedFace<'a>>,
) -> Vec<[Option<[f64; 3]>; 2]> {
    let corners = faces.map(|face| {
        let corner = |v: u32| lit.mesh.triangles[face as usize].iter().position(|vertex| *vertex == v);
        [corner(ends[0]).unwrap_or_default(), corner(ends[1]).unwrap_or_default()]
    });
    let mut cut_weights: Vec<[f64; 3]> = Vec::new();
    for (face, end_corners) in faces.into_iter().zip(corners) {
        let Some(textured) = shown(face) else { continue };
        for at in face_borders::changes_along(lit, face, &textured, ends) {
            let mut weights = [0.0; 3];
            weights[corners[0][0]] = at[end_corners[0]];
            weights[corners[0][1]] = at[end_corners[1]];
            cut_weights.push(weights);
        }
    }
    let to = corners[0][1];
    cut_weights.sort_by(|a, b| a[to].total_cmp(&b[to]));
    cut_weights.dedup_by(|b, a| b[to] - a[to] < tolerances::MIN_CUT_DISTANCE_OF_SEGMENT);
    let ends = [None].into_iter().chain(cut_weights.into_iter().map(Some)).chain([None]);
    let ends: Vec<Option<[f64; 3]>> = ends.collect();
    ends.windows(2).map(|pair| [pair[0], pair[1]]).collect()
}

/// Part, material and paint of a face.
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
    if shown_colours_differ(lit, ends, faces) {
        return true;
    }
    let end_corners = |face: u32| Some([corner(face, ends[0])?, corner(face, ends[1])?]);
    let (Some(a), Some(b)) = (end_corners(faces[0]), end_corners(faces[1])) else { return false };
    let normals = faces.map(|face| lit.normals.of(face));
    if (0..2).all(|k| normals[0][a[k]] == normals[1][b[k]]) {
        return false;
    }
    // Both faces have the same part, material and paint, so only tones may differ.
    let tone_at = |face: u32, at: [usize; 2], t: f64, shadowed: u32| {
        let mut weights = [0.0; 3];
        weights[at[0]] = 1.0 - t;
        weights[at[1]] = t;
        lit.tone(mesh.paint(FaceId(face)), &lit.point(face, weights), shadowed)
    };
    let differs =
        |t: f64, shadowed: u32| tone_at(faces[0], a, t, shadowed) != tone_at(faces[1], b, t, shadowed);
    shadowed.iter().any(|shadowed| SAMPLE_PARAMETERS.iter().any(|t| differs(*t, *shadowed)))
}

/// Whether two faces show different colours anywhere along their edge.
fn shown_colours_differ(lit: &Lit, ends: [u32; 2], faces: [u32; 2]) -> bool {
    if faces.iter().any(|face| lit.textures.face_texture(lit.mesh, *face).is_none()) {
        return false;
    }
    stretches(lit, ends, faces, |face| lit.textures.face_texture(lit.mesh, face)).into_iter().any(|stretch| {
        let at = middle(lit, ends, faces[0], stretch);
        let [a, b] = faces.map(|face| paint_along(lit, ends, face, at));
        a != b
    })
}
