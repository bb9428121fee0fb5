//! Drops double lines: stretches that run parallel to a longer line within about a pen's width.
//!
//! 1. Every visible line is cut into pieces with a direction, stored in a grid.
//! 2. A line is a double if longer, parallel lines run next to at least 80 % of its length.
//! 3. Uncovered stretches of a double are still drawn if they are long or silhouette.

use crate::parallel::prelude::*;
use rustc_hash::FxHashMap;

use super::piece_grid::{LinePiece, PieceGrid, collect};
use super::raw_line::{RawLine, VertexDegrees};
use super::removed_lines::{RemovalLog, RemovalReason};
use super::short_lines::may_be_noise;
use crate::geometry::plane::planar_distance::length;
use crate::lines::LineKind;
use crate::surface::MeshSource;
use crate::visibility::ViewVertexId;

/// Largest distance between double lines, in tidy lengths.
const MAX_DISTANCE_TIDY_LENGTHS: f64 = 0.3;

/// Minimum share of a line that must run next to others for the line to be a double.
const MIN_COVERED_SHARE: f64 = 0.8;

/// Maximum length of a short overlap, in double distances, and how much larger its distance to other lines
/// may be. For the side of a rim the length of the whole rim counts.
const MAX_FLAKE_DISTANCES: f64 = 21.0;
const FLAKE_DISTANCE_RATIO: f64 = 4.0;

/// Maximum share of silhouette in a short overlap.
const MAX_FLAKE_SILHOUETTE_SHARE: f64 = 0.25;

/// Minimum length of an uncovered stretch of a double that is still drawn, in double distances. One that
/// contains silhouette is drawn if the silhouette is longer than one distance.
const MIN_UNCOVERED_DISTANCES: f64 = 10.0;

/// Minimum number of lines per task.
const MIN_LINES_PER_TASK: usize = 8;

/// Drops smooth contours, and creases of scans and roundings, that double a longer visible line. Their
/// uncovered stretches are kept.
///
/// A line that may be noise covers no other. The middle line of a rounding gives way to any other line and
/// covers none of them.
pub(crate) fn drop_doubles(
    raws: &mut Vec<RawLine>,
    degrees: &mut VertexDegrees,
    tidy: f64,
    removal_log: &mut RemovalLog,
) {
    let distance = MAX_DISTANCE_TIDY_LENGTHS * tidy;
    if !raws.par_iter().any(is_suspect) {
        return;
    }
    let pieces_of = |(i, raw): (usize, &RawLine)| {
        let pieces = if raw.class.hidden { Vec::new() } else { collect(i as u32, &raw.line, distance) };
        (pieces, raw.length())
    };
    let (found, lengths): (Vec<Vec<LinePiece>>, Vec<f64>) = raws
        .par_iter()
        .enumerate()
        .with_min_len(MIN_LINES_PER_TASK)
        .with_max_len(2 * MIN_LINES_PER_TASK)
        .map(pieces_of)
        .unzip();
    let mut ends = 0;
    let end = |pieces: &Vec<LinePiece>| {
        ends += pieces.len();
        ends
    };
    let spans: Vec<usize> = std::iter::once(0).chain(found.iter().map(end)).collect();
    let pieces = found.concat();
    let Some(buckets) = PieceGrid::new(&pieces, 4.0 * distance) else { return };
    let rims = RimLengths::of(raws, &lengths);
    let may_go: Vec<bool> = raws.iter().map(|raw| may_be_noise(raw, tidy)).collect();
    let roundings: Vec<bool> = raws.iter().map(is_rounding).collect();
    // For each side of a double, whether it is uncovered; none for other lines. Only longer lines cover a
    // line, so it does not matter whether these are doubles: the longest of several parallel lines is kept.
    let uncovered_sides = |i: usize| -> Option<Vec<bool>> {
        if !is_suspect(&raws[i]) {
            return None;
        }
        let line_pieces = &pieces[spans[i]..spans[i + 1]];
        let total = lengths[i];
        // A short line is more likely an artefact, but a gap in the silhouette would be worse.
        let rim_length = rims.length(&raws[i], total);
        let is_flake = rim_length < MAX_FLAKE_DISTANCES * distance
            && raws[i].silhouette_part() < MAX_FLAKE_SILHOUETTE_SHARE;
        let distance = if is_flake { FLAKE_DISTANCE_RATIO * distance } else { distance };
        let allowed = (1.0 - MIN_COVERED_SHARE) * total;
        let mut uncovered_length = 0.0;
        let mut is_uncovered = Vec::with_capacity(line_pieces.len());
        for piece in line_pieces {
            let side = length(piece.b - piece.a);
            let parts = (side / distance).ceil().clamp(1.0, 256.0);
            let length_before = uncovered_length;
            for k in 0..parts as usize {
                let point = piece.a.lerp(piece.b, (k as f64 + 0.5) / parts);
                let is_cover = |line_id: u32| {
                    let other = line_id as usize;
                    let goes_before = match [roundings[i], roundings[other]] {
                        [true, false] => true,
                        [false, true] => false,
                        _ => lengths[other] > total,
                    };
                    goes_before && !may_go[other]
                };
                if !buckets.has_parallel_near(&pieces, point, piece.direction, distance, is_cover) {
                    uncovered_length += side / parts;
                }
                if uncovered_length > allowed {
                    return None;
                }
            }
            is_uncovered.push(uncovered_length > length_before);
        }
        (total > 0.0).then_some(is_uncovered)
    };
    let uncovered_parts: Vec<Option<Vec<bool>>> = (0..raws.len())
        .into_par_iter()
        .with_min_len(MIN_LINES_PER_TASK)
        .with_max_len(2 * MIN_LINES_PER_TASK)
        .map(uncovered_sides)
        .collect();
    if uncovered_parts.iter().all(Option::is_none) {
        return;
    }
    let mut remaining = Vec::with_capacity(raws.len());
    for (raw, maybe_uncovered) in std::mem::take(raws).into_iter().zip(uncovered_parts) {
        let Some(uncovered_flags) = maybe_uncovered else {
            remaining.push(raw);
            continue;
        };
        let parts = parts_alone(&raw, &uncovered_flags, distance);
        removal_log.record(&raw, || RemovalReason::Double);
        if parts.is_empty() {
            degrees.remove_line(&raw);
        }
        remaining.extend(parts);
    }
    *raws = remaining;
}

/// Total lengths of lines with the same two end vertices, such as the near and the far side of a hole's rim.
struct RimLengths(FxHashMap<[ViewVertexId; 2], f64>);

impl RimLengths {
    fn of(raws: &[RawLine], lengths: &[f64]) -> Self {
        let mut rims = FxHashMap::default();
        for (raw, length) in raws.iter().zip(lengths).filter(|(raw, _)| !raw.class.hidden && !raw.is_ring()) {
            *rims.entry(Self::key(raw)).or_insert(0.0) += length;
        }
        Self(rims)
    }

    fn key(raw: &RawLine) -> [ViewVertexId; 2] {
        let [a, b] = raw.ends;
        [a.min(b), a.max(b)]
    }

    /// Length of the rim that a line is a side of, or its own length.
    fn length(&self, raw: &RawLine, line_length: f64) -> f64 {
        if raw.is_ring() { line_length } else { self.0.get(&Self::key(raw)).copied().unwrap_or(line_length) }
    }
}

/// Stretches of a double that are drawn: long uncovered runs, and runs with silhouette longer than
/// `distance`.
fn parts_alone(raw: &RawLine, uncovered: &[bool], distance: f64) -> Vec<RawLine> {
    if !uncovered.contains(&true) {
        return Vec::new();
    }
    // A closed line is opened at a covered side.
    let start = if raw.line.closed { uncovered.iter().position(|alone| !alone).unwrap_or(0) } else { 0 };
    let open = if raw.line.closed { raw.line.opened_at(start) } else { raw.line.clone() };
    let is_alone = |side: usize| uncovered.get((side + start) % uncovered.len()).copied().unwrap_or(false);
    let sides = open.len() - 1;
    let mut parts = Vec::new();
    let mut first = 0;
    while first < sides {
        if !is_alone(first) {
            first += 1;
            continue;
        }
        let last = (first..sides).take_while(|side| is_alone(*side)).last().unwrap_or(first);
        let long = |side: usize| length(open.points[side + 1] - open.points[side]);
        let all: f64 = (first..=last).map(long).sum();
        let outline: f64 = (first..=last).filter(|side| open.sides[*side].silhouette).map(long).sum();
        if all > MIN_UNCOVERED_DISTANCES * distance || outline > distance {
            let ends = [first == 0, last + 1 == sides];
            let covered = [0, 1].map(|end| !raw.line.closed && ends[end] && raw.covered[end]);
            // Another line continues at the cut, so the vertices keep their degree.
            let part =
                RawLine { line: open.slice(first, last + 1), covered, vertices: Vec::new(), ..raw.clone() };
            parts.push(part);
        }
        first = last + 1;
    }
    parts
}

/// Whether a line may be a double. Lines of exact models are all drawn.
fn is_suspect(raw: &RawLine) -> bool {
    !raw.class.hidden
        && match raw.class.kind {
            LineKind::Contour => raw.smooth,
            LineKind::Crease => raw.class.origin == MeshSource::Scanned || is_rounding(raw),
            _ => false,
        }
}

/// Whether a line is the middle line of a rounding: a crease on a surface that is smooth across it.
fn is_rounding(raw: &RawLine) -> bool {
    raw.class.kind == LineKind::Crease && raw.smooth && raw.class.origin != MeshSource::Scanned
}

#[cfg(test)]
mod tests {
    use kurbo::Point;

    use super::*;
    use crate::chains::link::edge_class::EdgeClass;
    use crate::chains::sample::Sample;
    use crate::chains::sampled_line::{LineSide, SampledLine};
    use crate::mesh::{MaterialId, PartId};
    use crate::visibility::ViewMap;

    fn contour(points: &[(f64, f64)], ends: [u32; 2]) -> RawLine {
        let mut line = SampledLine::default();
        points
            .iter()
            .for_each(|p| line.push(Point::new(p.0, p.1), Sample::new(0.0, 1.0), LineSide::soft(true)));
        let class = EdgeClass {
            kind: LineKind::Contour,
            body: PartId(0),
            material: MaterialId(0),
            hidden: false,
            silhouette: false,
            both_seen: false,
            origin: MeshSource::Scanned,
        };
        RawLine {
            line,
            class,
            invisibility: 0,
            smooth: true,
            ends: ends.map(ViewVertexId),
            vertices: Vec::new(),
            covered: [false; 2],
            pronounced: 0.0,
            segment: 0,
        }
    }

    #[test]
    fn drop_doubles_keeps_the_rim_of_a_small_hole_near_an_outline() {
        // Each side of the rim is short enough to be dropped, both together are not.
        let left = |far_ends: [u32; 2]| {
            let outline = contour(&[(0.0, 0.0), (200.0, 0.0)], [0, 1]);
            let near = contour(&[(50.0, 3.0), (65.0, 3.0)], [2, 3]);
            let far = contour(&[(50.0, 3.0), (57.0, 7.0), (65.0, 3.0)], far_ends);
            let mut raws = vec![outline, near, far];
            let mut degrees = VertexDegrees::new(&ViewMap::default(), &[]);
            drop_doubles(&mut raws, &mut degrees, 4.0, &mut RemovalLog::default());
            raws.iter().map(|raw| raw.ends[0].0).collect::<Vec<_>>()
        };
        assert_eq!(left([3, 2]), [0, 2, 3], "both sides of a rim end in the same two places");
        assert_eq!(left([4, 5]), [0, 4], "a flake beside the outline");
    }

    #[test]
    fn drop_doubles_keeps_a_contour_next_to_a_weak_crease() {
        let left = |pronounced: f64| {
            let rim = contour(&[(50.0, 3.0), (120.0, 3.0)], [0, 1]);
            let mut crease = contour(&[(0.0, 2.5), (200.0, 2.5)], [2, 3]);
            crease.class.kind = LineKind::Crease;
            crease.smooth = false;
            crease.pronounced = pronounced;
            let mut raws = vec![rim, crease];
            let mut degrees = VertexDegrees::new(&ViewMap::default(), &[]);
            drop_doubles(&mut raws, &mut degrees, 4.0, &mut RemovalLog::default());
            raws.iter().map(|raw| raw.ends[0].0).collect::<Vec<_>>()
        };
        assert_eq!(left(100.0), [2], "a sharp crease beside a contour");
        assert_eq!(left(3.0), [0, 2], "one that turns too little for its length");
    }

    #[test]
    fn drop_doubles_drops_a_rounding_crease_next_to_a_contour() {
        let left = |is_rounding: bool| {
            let outline = contour(&[(50.0, 3.0), (120.0, 3.0)], [0, 1]);
            let mut crease = contour(&[(50.0, 2.5), (119.0, 2.5), (123.0, 2.5)], [2, 3]);
            crease.class.kind = LineKind::Crease;
            (crease.class.origin, crease.smooth, crease.pronounced) =
                (MeshSource::Constructed, is_rounding, 100.0);
            let mut raws = vec![outline, crease];
            let mut degrees = VertexDegrees::new(&ViewMap::default(), &[]);
            drop_doubles(&mut raws, &mut degrees, 4.0, &mut RemovalLog::default());
            raws.iter().map(|raw| raw.ends[0].0).collect::<Vec<_>>()
        };
        assert_eq!(left(true), [0]);
        assert_eq!(left(false), [2], "a crease that is longer");
    }
}
