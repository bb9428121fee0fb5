//! [`level_curves`]: curves on the visible surface along which a function is an integer.
//!
//! Examples are section planes fixed to the model, and lines of texture coordinates. The curves are traced
//! through the faces, joined end to end and projected to the page. Callers cut them at the borders of the
//! ground; there the face in front at the middle of each piece decides on visibility.

use crate::geometry::lists::linked_lines::linked_lines;
use crate::parallel::prelude::*;
use glam::{DVec2, DVec3};
use kurbo::{Point, Vec2};
use rustc_hash::FxHashMap;

use crate::lines::{Lit, shows_inside};
use crate::mesh::{FaceId, PartId};
use crate::visibility::front_faces;

/// Curve on the page.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LevelCurve {
    /// Points, page units.
    pub line: Vec<Point>,
    /// Number of its level. Neighbouring levels differ by 1.
    pub level: i64,
    /// Levels per page unit across the curve, one per point.
    pub density: Vec<f64>,
    /// Part that it lies on.
    pub part: PartId,
    /// Points in local space, one per point of `line`.
    pub points: Vec<DVec3>,
    /// Image-space nearness, one per point.
    pub nearness: Vec<f64>,
}

/// Piece of a level inside a face.
struct LevelPiece {
    ends: [DVec3; 2],
    level: i64,
    density: f64,
    part: PartId,
}

/// Curves on visible faces along which `value` (one per corner of a face) is an integer.
///
/// Levels for which `is_wanted` (level, levels per page unit) is false are skipped on that face.
#[must_use]
pub(crate) fn level_curves(
    lit: &Lit,
    offset: Vec2,
    value: impl Fn(u32) -> Option<[f64; 3]> + Sync,
    is_wanted: impl Fn(i64, f64) -> bool + Sync,
) -> Vec<LevelCurve> {
    const FACES_PER_TASK: usize = 1 << 11;
    let count = lit.mesh.triangles.len();
    let inside = shows_inside(lit);
    let shows = |face: usize| lit.view.facing[face] || inside[lit.mesh.face_part[face].index()];
    let found: Vec<Vec<LevelPiece>> = (0..count.div_ceil(FACES_PER_TASK))
        .into_par_iter()
        .with_max_len(1)
        .map(|chunk| {
            let mut pieces = Vec::new();
            for face in chunk * FACES_PER_TASK..((chunk + 1) * FACES_PER_TASK).min(count) {
                if shows(face) && !lit.mesh.is_degenerate(FaceId(face as u32)) {
                    trace(lit, face as u32, &value, &is_wanted, &mut pieces);
                }
            }
            pieces
        })
        .collect();
    let pieces: Vec<LevelPiece> = found.into_iter().flatten().collect();
    chains(lit, offset, &pieces)
}

/// Pieces of the levels inside a face.
fn trace(
    lit: &Lit,
    face: u32,
    value: &impl Fn(u32) -> Option<[f64; 3]>,
    is_wanted: &impl Fn(i64, f64) -> bool,
    pieces: &mut Vec<LevelPiece>,
) {
    let Some(values) = value(face) else { return };
    let t = lit.mesh.triangles[face as usize];
    let image = t.map(|v| lit.view.points[v as usize]);
    let (low, high) = (
        values.into_iter().fold(f64::INFINITY, f64::min),
        values.into_iter().fold(f64::NEG_INFINITY, f64::max),
    );
    // Not finite: behind the camera, or without coordinates.
    let is_sound = high - low < MAX_LEVELS_PER_FACE && image.iter().all(|p| p.is_finite());
    if !is_sound || low.ceil() > high.floor() {
        return;
    }
    let (a, b) = ((image[1] - image[0]).truncate(), (image[2] - image[0]).truncate());
    let (da, db) = (values[1] - values[0], values[2] - values[0]);
    let area = a.perp_dot(b);
    let slope = DVec2::new(da * b.y - db * a.y, db * a.x - da * b.x) / area;
    let density = slope.length();
    if !density.is_finite() {
        return;
    }
    let corners = lit.mesh.corners(FaceId(face));
    for level in low.ceil() as i64..=high.floor() as i64 {
        if !is_wanted(level, density) {
            continue;
        }
        let mut ends: Vec<DVec3> = Vec::with_capacity(2);
        for side in 0..3 {
            // In a fixed order of the ends, so that both faces of an edge compute the same bits.
            let (mut i, mut j) = (side, (side + 1) % 3);
            if t[i] > t[j] {
                std::mem::swap(&mut i, &mut j);
            }
            let (from, to) = (values[i] - level as f64, values[j] - level as f64);
            if (from >= 0.0) != (to >= 0.0) {
                ends.push(corners[i] + (corners[j] - corners[i]) * (from / (from - to)));
            }
        }
        if let [from, to] = ends[..]
            && from != to
        {
            let part = lit.mesh.face_part[face as usize];
            pieces.push(LevelPiece { ends: [from, to], level, density, part });
        }
    }
}

/// Maximum number of levels on a face. Faces with more are skipped.
const MAX_LEVELS_PER_FACE: f64 = 1e4;

/// Joins pieces end to end and projects them to the page.
fn chains(lit: &Lit, offset: Vec2, pieces: &[LevelPiece]) -> Vec<LevelCurve> {
    let key = |piece: &LevelPiece, end: usize| (piece.level, piece.ends[end].to_array().map(f64::to_bits));
    let mut at: FxHashMap<(i64, [u64; 3]), [u32; 2]> = FxHashMap::default();
    for (k, piece) in pieces.iter().enumerate() {
        for end in 0..2 {
            let slots = at.entry(key(piece, end)).or_insert([u32::MAX; 2]);
            // A third piece at a point is a branch, and starts another curve.
            let slot = if slots[0] == u32::MAX { 0 } else { 1 };
            if slots[slot] == u32::MAX {
                slots[slot] = k as u32;
            }
        }
    }
    let next = |k: usize, end: usize| {
        let point = key(&pieces[k], end);
        let [a, b] = at.get(&point).copied().unwrap_or([u32::MAX; 2]);
        let other = if a as usize == k { b } else { a };
        (other != u32::MAX && pieces[other as usize].part == pieces[k].part)
            .then(|| (other as usize, usize::from(key(&pieces[other as usize], 0) != point)))
    };
    let mut curves = Vec::new();
    linked_lines(pieces.len(), next, |line| {
        let (first, from) = line[0];
        let mut points = vec![pieces[first].ends[from]];
        points.extend(line.iter().map(|(k, from)| pieces[*k].ends[1 - from]));
        let densities: Vec<f64> = line.iter().map(|(k, _)| pieces[*k].density).collect();
        let image: Vec<DVec3> = points.iter().map(|p| lit.view.frame.image_from_local(*p)).collect();
        let line = image.iter().map(|q| Point::new(q.x, q.y) + offset).collect();
        let nearness = image.iter().map(|q| q.z).collect();
        // At a point, the mean of both sides.
        let density = (0..points.len())
            .map(|k| {
                let (before, after) = (k.saturating_sub(1), k.min(densities.len() - 1));
                f64::midpoint(densities[before], densities[after])
            })
            .collect();
        let LevelPiece { level, part, .. } = pieces[first];
        curves.push(LevelCurve { line, points, level, density, part, nearness });
    });
    curves
}

/// Whether each surface point is visible, given its position on the page and its nearness.
#[must_use]
pub(crate) fn are_visible(lit: &Lit, offset: Vec2, points: &[(Point, f64)]) -> Vec<bool> {
    let at: Vec<DVec2> = points.iter().map(|(p, _)| DVec2::new(p.x - offset.x, p.y - offset.y)).collect();
    let frame = &lit.view.frame;
    let fronts = front_faces(lit.mesh, lit.view, &at);
    let own = points.iter().map(|(_, nearness)| *nearness);
    fronts
        .iter()
        .zip(own)
        .map(|(front, own)| {
            front.is_some_and(|front| {
                frame.depth_of(own) - frame.depth_of(front.nearness)
                    < frame.px_at(frame.depth_of(own)) * MAX_DEPTH_DIFFERENCE_PX
            })
        })
        .collect()
}

/// Largest depth difference of two points on the same surface, px.
const MAX_DEPTH_DIFFERENCE_PX: f64 = 0.1;
