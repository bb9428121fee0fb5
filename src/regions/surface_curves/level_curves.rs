//! [`level_curves`]: curves on the visible surface along which a number is constant: cuts by planes that
//! are fixed to the model, or lines of its texture coordinates.
//!
//! They are traced through the faces, led to the page, and cut where visibility may change, at the borders
//! of the ground; the face in front in the middle of each piece decides.

use crate::parallel::prelude::*;
use glam::{DVec2, DVec3};
use kurbo::{Point, Vec2};
use rustc_hash::FxHashMap;

use crate::lines::{Lit, shows_inside};
use crate::mesh::{FaceId, PartId};
use crate::visibility::front_faces;

/// A curve on the page.
#[derive(Debug, Clone, PartialEq)]
pub struct LevelCurve {
    /// Its points, page units.
    pub line: Vec<Point>,
    /// The number of its level: neighbours differ by 1.
    pub level: i64,
    /// How many levels there are to a page unit, across the curve, at each point.
    pub density: Vec<f64>,
    /// The part of the model on which it lies.
    pub part: PartId,
    /// Its points in the model, local space.
    pub points: Vec<DVec3>,
    /// How near each point is, as image space has it.
    pub nearness: Vec<f64>,
}

/// One piece: a level in a face.
struct LevelPiece {
    ends: [DVec3; 2],
    level: i64,
    density: f64,
    part: PartId,
}

/// The curves on visible faces along which `value` (for each corner of a face) is a whole number. Levels
/// for which `is_wanted` (level, levels to a page unit) is false are left out of a face.
#[must_use]
pub fn level_curves(
    lit: &Lit,
    offset: Vec2,
    value: impl Fn(u32) -> Option<[f64; 3]> + Sync,
    is_wanted: impl Fn(i64, f64) -> bool + Sync,
) -> Vec<LevelCurve> {
    const CHUNK: usize = 1 << 11;
    let count = lit.mesh.triangles.len();
    let inside = shows_inside(lit);
    let shows = |face: usize| lit.view.facing[face] || inside[lit.mesh.face_part[face].index()];
    let found: Vec<Vec<LevelPiece>> = (0..count.div_ceil(CHUNK))
        .into_par_iter()
        .with_max_len(1)
        .map(|chunk| {
            let mut pieces = Vec::new();
            for face in chunk * CHUNK..((chunk + 1) * CHUNK).min(count) {
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

/// The pieces of the levels in a face.
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
    // Not a number: behind the eye, or without coordinates.
    let is_sound = high - low < MOST_LEVELS && image.iter().all(|p| p.is_finite());
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
            // In one order of the ends, so that both faces of an edge find the same bits.
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

/// Faces that are cut more often than this are no surface to draw on.
const MOST_LEVELS: f64 = 1e4;

/// Joins pieces end to end and leads them to the page.
fn chains(lit: &Lit, offset: Vec2, pieces: &[LevelPiece]) -> Vec<LevelCurve> {
    let key = |piece: &LevelPiece, end: usize| (piece.level, piece.ends[end].to_array().map(f64::to_bits));
    let mut at: FxHashMap<(i64, [u64; 3]), [u32; 2]> = FxHashMap::default();
    for (k, piece) in pieces.iter().enumerate() {
        for end in 0..2 {
            let slots = at.entry(key(piece, end)).or_insert([u32::MAX; 2]);
            // A third one would be a fork; it starts a curve of its own.
            let slot = if slots[0] == u32::MAX { 0 } else { 1 };
            if slots[slot] == u32::MAX {
                slots[slot] = k as u32;
            }
        }
    }
    let next = |k: usize, end: usize| {
        let [a, b] = at.get(&key(&pieces[k], end)).copied().unwrap_or([u32::MAX; 2]);
        let other = if a as usize == k { b } else { a };
        (other != u32::MAX && pieces[other as usize].part == pieces[k].part).then_some(other as usize)
    };
    let mut done = vec![false; pieces.len()];
    let mut curves = Vec::new();
    for closed in [false, true] {
        for first in 0..pieces.len() {
            let Some(end) = (0..2).find(|end| closed || next(first, *end).is_none()) else { continue };
            if done[first] {
                continue;
            }
            let mut points = vec![pieces[first].ends[end]];
            let mut densities: Vec<f64> = Vec::new();
            let (mut k, mut from) = (first, end);
            loop {
                done[k] = true;
                points.push(pieces[k].ends[1 - from]);
                densities.push(pieces[k].density);
                let Some(other) = next(k, 1 - from).filter(|other| !done[*other]) else { break };
                from = usize::from(key(&pieces[other], 0) != key(&pieces[k], 1 - from));
                k = other;
            }
            let image: Vec<DVec3> = points.iter().map(|p| lit.view.frame.image_from_local(*p)).collect();
            let line = image.iter().map(|q| Point::new(q.x, q.y) + offset).collect();
            let nearness = image.iter().map(|q| q.z).collect();
            // At a point the mean of both sides.
            let density = (0..points.len())
                .map(|k| {
                    let (before, after) = (k.saturating_sub(1), k.min(densities.len() - 1));
                    f64::midpoint(densities[before], densities[after])
                })
                .collect();
            let LevelPiece { level, part, .. } = pieces[first];
            curves.push(LevelCurve { line, points, level, density, part, nearness });
        }
    }
    curves
}

/// Whether nothing is in front of points of the surface, given by their place on the page and their
/// nearness in the image.
#[must_use]
pub fn are_seen(lit: &Lit, offset: Vec2, points: &[(Point, f64)]) -> Vec<bool> {
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
                    < frame.px_at(frame.depth_of(own)) * SAME_DEPTH_PX
            })
        })
        .collect()
}

/// Depths that differ by no more than this (px) are the same surface.
const SAME_DEPTH_PX: f64 = 0.1;
