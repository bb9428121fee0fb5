//! Tone changes: which pieces of tone borders change the tone. Only those are drawn as isophotes.
//!
//! Tone borders are traced over the whole surface, for every set of lights that may be in shadow, and so are
//! shadow borders. Regions need all of them. But an isophote of the lit surface has no effect inside a
//! shadow. A shadow border has none where both tones are equal, and neither has an edge.
//!
//! 1. Borders on a face are cut where they cross each other.
//! 2. Edges are cut where borders end at them.
//! 3. At the middle of each piece the tones on both sides are compared, under the lights that reach it.

use std::ops::Range;

use crate::parallel::prelude::*;
use glam::{DVec2, DVec3};

use crate::light::SurfacePoint;
use crate::lines::shared_points::PointIds;
use crate::lines::tolerances::{self, MIN_CUT_DISTANCE_OF_SEGMENT, SHADOW_PROBE_SHIFT_SHARE};
use crate::lines::{FeatureLines, FeatureSegment, Lit, NO_FACE};
use crate::mesh::{FaceId, PaintId};

/// Reason why an isophote was traced.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct TraceReason {
    /// Channel of the shading.
    pub channel: usize,
    /// Mask of the shadowed lights.
    pub shadowed: u32,
}

/// Positions of the tone borders among all segments.
#[derive(Debug, Clone, Default)]
pub(crate) struct ToneBorderRanges {
    /// Uncut edges between tones.
    pub edges: Range<usize>,
    /// Isophotes.
    pub isophotes: Range<usize>,
    /// Reason for each isophote.
    pub traced: Vec<TraceReason>,
    /// Shadow borders.
    pub shadows: Range<usize>,
    /// Light that casts each shadow border.
    pub casters: Vec<u32>,
}

/// Effects of cast shadows.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ShadowEffects {
    /// Tones of fills.
    pub tones: bool,
    /// Hatching bins.
    pub bins: bool,
}

/// Type of a border.
#[derive(Clone, Copy, PartialEq, Eq)]
enum ToneBorderClass {
    Edge,
    Isophote(TraceReason),
    Shadow(u32),
}

/// Cuts tone borders where they start or stop changing the tone, and returns the segments without effect,
/// ascending.
///
/// `shadowed` returns a mask of the lights that do not reach each point.
#[must_use]
pub(crate) fn unchanged(
    lit: &Lit,
    borders: &ToneBorderRanges,
    darkens: ShadowEffects,
    shadowed: impl Fn(&[(u32, DVec3)]) -> Vec<u32>,
    lines: &mut FeatureLines,
) -> Vec<u32> {
    let finder = ToneChangeFinder { lit, borders, darkens, lines };
    let mut cuts = finder.cuts_on_faces();
    cuts.extend(finder.cuts_on_edges());
    cuts.sort_by(|a, b| a.segment.cmp(&b.segment).then(a.at.total_cmp(&b.at)));
    cuts.dedup_by(|b, a| a.segment == b.segment && b.at - a.at < MIN_CUT_DISTANCE_OF_SEGMENT);

    let pieces = finder.pieces(&cuts);
    let probe_points: Vec<[Option<(u32, DVec3)>; 2]> =
        pieces.par_iter().map(|piece| finder.shadow_points(piece)).collect();
    let points: Vec<(u32, DVec3)> = probe_points.iter().flatten().flatten().copied().collect();
    let mut masks = shadowed(&points).into_iter();
    let masks: Vec<[u32; 2]> = probe_points
        .iter()
        .map(|sides| sides.map(|side| side.and_then(|_| masks.next()).unwrap_or_default()))
        .collect();
    let changes: Vec<bool> =
        pieces.par_iter().zip(&masks).map(|(piece, masks)| finder.changes(piece, *masks)).collect();
    rewrite(lit, &pieces, &changes, lines)
}

/// Position where a segment is cut.
#[derive(Clone, Copy)]
struct SegmentCut {
    segment: usize,
    at: f64,
    point: DVec3,
}

/// Piece of a segment between two cuts or ends.
#[derive(Clone, Copy)]
struct ToneBorderPiece {
    segment: usize,
    ends: [Option<DVec3>; 2],
    middle: DVec3,
}

struct ToneChangeFinder<'a> {
    lit: &'a Lit<'a>,
    borders: &'a ToneBorderRanges,
    darkens: ShadowEffects,
    lines: &'a FeatureLines,
}

impl ToneChangeFinder<'_> {
    fn class(&self, segment: usize) -> ToneBorderClass {
        let ToneBorderRanges { isophotes, traced, shadows, casters, .. } = self.borders;
        if isophotes.contains(&segment) {
            return traced
                .get(segment - isophotes.start)
                .map_or(ToneBorderClass::Edge, |reason| ToneBorderClass::Isophote(*reason));
        }
        match shadows.contains(&segment) {
            true => casters
                .get(segment - shadows.start)
                .map_or(ToneBorderClass::Edge, |caster| ToneBorderClass::Shadow(*caster)),
            false => ToneBorderClass::Edge,
        }
    }

    fn ends(&self, segment: usize) -> [DVec3; 2] {
        self.lines.segments[segment].ends.map(|end| self.lines.position(self.lit.mesh, end))
    }

    /// Isophotes and shadow borders, sorted by face.
    fn segments_by_face(&self) -> Vec<(u32, usize)> {
        let ToneBorderRanges { isophotes, shadows, .. } = self.borders;
        let all = isophotes.clone().chain(shadows.clone());
        let mut on_faces: Vec<(u32, usize)> =
            all.map(|segment| (self.lines.segments[segment].hosts[0], segment)).collect();
        on_faces.par_sort_unstable();
        on_faces
    }

    /// Crossings of borders on a face.
    fn cuts_on_faces(&self) -> Vec<SegmentCut> {
        let on_faces = self.segments_by_face();
        let faces: Vec<&[(u32, usize)]> =
            on_faces.chunk_by(|a, b| a.0 == b.0).filter(|face_segments| face_segments.len() > 1).collect();
        faces.into_par_iter().flat_map_iter(|same_face| self.crossings(same_face)).collect()
    }

    fn crossings(&self, face_segments: &[(u32, usize)]) -> Vec<SegmentCut> {
        let [a, b, c] = self.lit.mesh.corners(FaceId(face_segments[0].0));
        let right = (b - a).normalize_or_zero();
        let up = (b - a).cross(c - a).cross(right).normalize_or_zero();
        let flat = |p: DVec3| DVec2::new((p - a).dot(right), (p - a).dot(up));
        let mut flattened: Vec<(usize, ToneBorderClass, [DVec2; 2])> = face_segments
            .iter()
            .map(|(_, segment)| (*segment, self.class(*segment), self.ends(*segment).map(flat)))
            .collect();
        let low = |ends: &[DVec2; 2]| ends[0].x.min(ends[1].x);
        flattened.sort_by(|a, b| low(&a.2).total_cmp(&low(&b.2)).then(a.0.cmp(&b.0)));
        let mut cuts = Vec::new();
        for (k, (first, class, [p, q])) in flattened.iter().enumerate() {
            let reach = p.x.max(q.x);
            for (its_segment, its_class, [r, s]) in
                flattened[k + 1..].iter().take_while(|(_, _, ends)| low(ends) <= reach)
            {
                if class == its_class {
                    continue;
                }
                let (u, v) = (*q - *p, *s - *r);
                let turn = u.perp_dot(v);
                let (at, its) = ((*r - *p).perp_dot(v) / turn, (*r - *p).perp_dot(u) / turn);
                if turn == 0.0 || !(0.0..=1.0).contains(&at) || !(0.0..=1.0).contains(&its) {
                    continue;
                }
                // Shadow borders lie exactly on the face.
                let (on, t) = if matches!(its_class, ToneBorderClass::Shadow(_)) {
                    (*its_segment, its)
                } else {
                    (*first, at)
                };
                let [from, to] = self.ends(on);
                let point = from.lerp(to, t);
                cuts.push(SegmentCut { segment: *first, at, point });
                cuts.push(SegmentCut { segment: *its_segment, at: its, point });
            }
        }
        cuts.retain(|cut| cut.at > MIN_CUT_DISTANCE_OF_SEGMENT && cut.at < 1.0 - MIN_CUT_DISTANCE_OF_SEGMENT);
        cuts
    }

    /// Ends of borders at an edge of their face.
    fn cuts_on_edges(&self) -> Vec<SegmentCut> {
        let on_faces = self.segments_by_face();
        let frame = &self.lit.view.frame;
        let px = frame.width.max(frame.height) / 1000.0;
        let of_edge = |segment: usize| {
            let [from, to] = self.ends(segment);
            let (direction, hosts) = (to - from, self.lines.segments[segment].hosts);
            let per_px = if frame.perspective { frame.depth(from).abs() } else { 1.0 } * px / frame.scale;
            let near = tolerances::MAX_SURFACE_LIFT_PX * per_px;
            let border_segments = hosts.into_iter().flat_map(|face| {
                let first = on_faces.partition_point(|entry| entry.0 < face);
                on_faces[first..].iter().take_while(move |host_entry| host_entry.0 == face)
            });
            let mut cuts = Vec::new();
            for p in border_segments.flat_map(|(_, border)| self.ends(*border)) {
                let at = (p - from).dot(direction) / direction.length_squared();
                let point = from + direction * at;
                if at > MIN_CUT_DISTANCE_OF_SEGMENT
                    && at < 1.0 - MIN_CUT_DISTANCE_OF_SEGMENT
                    && point.distance(p) <= near
                {
                    cuts.push(SegmentCut { segment, at, point });
                }
            }
            cuts
        };
        self.borders.edges.clone().into_par_iter().flat_map_iter(of_edge).collect()
    }

    /// Pieces of all tone borders, in order.
    fn pieces(&self, cuts: &[SegmentCut]) -> Vec<ToneBorderPiece> {
        let ToneBorderRanges { edges, isophotes, shadows, .. } = self.borders;
        let mut pieces = Vec::new();
        let mut next = cuts.iter().peekable();
        for segment in edges.clone().chain(isophotes.clone()).chain(shadows.clone()) {
            let [a, b] = self.ends(segment);
            let (mut from, mut start) = (0.0, None);
            loop {
                let cut = next.next_if(|cut| cut.segment == segment);
                let to = cut.map_or(1.0, |cut| cut.at);
                let end = cut.map(|cut| cut.point);
                let middle = a.lerp(b, f64::midpoint(from, to));
                pieces.push(ToneBorderPiece { segment, ends: [start, end], middle });
                (from, start) = (to, end);
                if cut.is_none() {
                    break;
                }
            }
        }
        pieces
    }

    /// For both faces of a piece, the point where the shadowed lights are tested.
    fn shadow_points(&self, piece: &ToneBorderPiece) -> [Option<(u32, DVec3)>; 2] {
        let mesh = self.lit.mesh;
        let hosts = self.lines.segments[piece.segment].hosts;
        let on_edge = self.class(piece.segment) == ToneBorderClass::Edge;
        hosts.map(|face| {
            let corners = (face != NO_FACE).then(|| mesh.corners(FaceId(face)))?;
            let middle = corners.into_iter().sum::<DVec3>() / 3.0;
            let inward =
                if on_edge { (middle - piece.middle) * SHADOW_PROBE_SHIFT_SHARE } else { DVec3::ZERO };
            let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize_or_zero();
            let p = piece.middle + inward;
            Some((face, p - normal * (p - corners[0]).dot(normal)))
        })
    }

    /// Whether a piece changes the tone, given the shadowed lights on both faces.
    fn changes(&self, piece: &ToneBorderPiece, masks: [u32; 2]) -> bool {
        let FeatureSegment { hosts, .. } = self.lines.segments[piece.segment];
        let sides = |face: u32| self.point(face, piece.middle);
        match self.class(piece.segment) {
            ToneBorderClass::Edge => {
                let (Some(first), Some(second)) = (sides(hosts[0]), sides(hosts[1])) else { return true };
                let mesh = self.lit.mesh;
                let paint = |face: u32| mesh.paint(FaceId(face));
                let is_plain = |face: u32| self.lit.textures.face_texture(mesh, face).is_none();
                paint(hosts[0]) != paint(hosts[1])
                    || !hosts.into_iter().all(is_plain)
                    || self.tone_and_bin_at(first.0, &first.1, masks[0])
                        != self.tone_and_bin_at(second.0, &second.1, masks[1])
            }
            ToneBorderClass::Shadow(caster) => sides(hosts[0]).is_none_or(|(paint, point)| {
                let bit = 1 << caster;
                self.tone_and_bin_at(paint, &point, masks[0] | bit)
                    != self.tone_and_bin_at(paint, &point, masks[0] & !bit)
            }),
            ToneBorderClass::Isophote(traced) => {
                sides(hosts[0]).is_none_or(|(paint, point)| self.is_level(paint, &point, traced, masks[0]))
            }
        }
    }

    /// Paint and surface point at a point of a face.
    fn point(&self, face: u32, p: DVec3) -> Option<(PaintId, SurfacePoint)> {
        let lit = self.lit;
        let [a, b, c] = lit.mesh.corners(FaceId(face));
        let normal = (b - a).cross(c - a);
        let twice = normal.length_squared();
        let share = |from: DVec3, to: DVec3| (to - from).cross(p - from).dot(normal) / twice;
        let weights = [share(b, c), share(c, a), share(a, b)].map(|share| share.clamp(0.0, 1.0));
        let sum: f64 = weights.iter().sum();
        (twice > 0.0 && sum > 0.0)
            .then(|| (lit.paint(face, p), lit.point(face, weights.map(|weight| weight / sum))))
    }

    /// Shadowed lights that count for a channel.
    fn mask(&self, channel: usize, shadowed: u32) -> u32 {
        let is_bin = self.lit.shading.bin_channel() == Some(channel);
        let darkens = if is_bin { self.darkens.bins } else { self.darkens.tones };
        if darkens { shadowed } else { 0 }
    }

    fn bands(&self, paint: PaintId, point: &SurfacePoint, shadowed: u32) -> Vec<u16> {
        let shading = self.lit.shading;
        let band = |channel: usize| {
            let value = shading.value(channel, paint, point, self.mask(channel, shadowed));
            shading.levels(paint, channel).partition_point(|level| *level <= value) as u16
        };
        (0..shading.channels()).map(band).collect()
    }

    /// Tone and hatching bin of a point.
    fn tone_and_bin_at(&self, paint: PaintId, point: &SurfacePoint, shadowed: u32) -> (u16, Option<u16>) {
        let bands = self.bands(paint, point, shadowed);
        self.tone_and_bin_of_bands(paint, &bands)
    }

    fn tone_and_bin_of_bands(&self, paint: PaintId, bands: &[u16]) -> (u16, Option<u16>) {
        let shading = self.lit.shading;
        let bin = shading.bin_channel().and_then(|channel| bands.get(channel)).copied();
        (shading.tone(paint, bands), bin)
    }

    /// Whether a traced level exists under the lights that reach the point, and separates two tones.
    fn is_level(&self, paint: PaintId, point: &SurfacePoint, traced: TraceReason, shadowed: u32) -> bool {
        let shading = self.lit.shading;
        let TraceReason { channel, shadowed: assumed } = traced;
        let value = |shadowed: u32| shading.value(channel, paint, point, shadowed);
        let own_value = value(self.mask(channel, shadowed));
        if (own_value - value(assumed)).abs() > tolerances::MAX_ISOPHOTE_ERROR_TONE {
            return false;
        }
        let levels = shading.levels(paint, channel);
        let off = |level: &f64| (level - own_value).abs();
        let Some((nearest, _)) = levels.iter().enumerate().min_by(|a, b| off(a.1).total_cmp(&off(b.1)))
        else {
            return false;
        };
        let mut bands = self.bands(paint, point, shadowed);
        let mut tone_with_band = |band: usize| {
            bands[channel] = band as u16;
            self.tone_and_bin_of_bands(paint, &bands)
        };
        tone_with_band(nearest) != tone_with_band(nearest + 1)
    }
}

/// Replaces segments by their pieces. Returns the indices of those without effect, ascending.
fn rewrite(lit: &Lit, pieces: &[ToneBorderPiece], changes: &[bool], lines: &mut FeatureLines) -> Vec<u32> {
    let mut unchanged = Vec::new();
    let first = lit.mesh.positions.len() as u32;
    let mut ids = PointIds::default();
    let mut at = 0;
    for segment_pieces in pieces.chunk_by(|a, b| a.segment == b.segment) {
        let verdicts = &changes[at..at + segment_pieces.len()];
        at += segment_pieces.len();
        let number = segment_pieces[0].segment;
        let original = lines.segments[number];
        let mut k = 0;
        while k < segment_pieces.len() {
            // Consecutive pieces with the same result are merged.
            let run = verdicts[k..].iter().take_while(|verdict| **verdict == verdicts[k]).count();
            let mut end = |point: Option<DVec3>, fallback: u32| {
                point.map_or(fallback, |p| ids.of(&mut lines.points, first, p))
            };
            let ends = [
                end(segment_pieces[k].ends[0], original.ends[0]),
                end(segment_pieces[k + run - 1].ends[1], original.ends[1]),
            ];
            let segment = FeatureSegment { ends, ..original };
            let id = if k == 0 {
                lines.segments[number] = segment;
                number
            } else {
                lines.segments.push(segment);
                lines.segments.len() - 1
            };
            if !verdicts[k] {
                unchanged.push(id as u32);
            }
            k += run;
        }
    }
    unchanged.sort_unstable();
    unchanged
}
