//! Stitches contours on smooth surfaces where one ends on, or just short of, the start of the next.
//!
//! The contour of a mesh consists of many pieces. Each runs out behind the next at a T-junction, about a px
//! from where that one starts. In the drawing they are one line, and the overhang before the junction is
//! dropped.
//!
//! 1. Free ends of one class within reach are candidates, either uncut or with the overhang of one cut off.
//! 2. A candidate must not turn sharply. Larger gaps must be straighter, and shorter than the lines that they
//!    join.
//! 3. Candidates hidden by another surface are dropped. The cheapest of the rest are taken first.
//!
//! All lengths are in tidy lengths (option `tidy`).

use crate::parallel::prelude::*;
use kurbo::Point;

use super::oriented_line::{
    MAX_STUB_TIDY_LENGTHS, MAX_TRIMMED_JUMP_TIDY_LENGTHS, MIN_LONG_STUB_TIDY_LENGTHS, OrientedLine,
    StitchEnd, append_trimmed,
};
use super::raw_line::{RawLine, VertexDegrees};
use super::removed_lines::{RemovalLog, RemovalReason};
use crate::chains::sampled_line::SampledLine;
use crate::geometry::plane::planar_distance::{length, unit};
use crate::visibility::{GapOcclusion, GapSegment};

/// Largest gap without an overhang.
const MAX_JUMP_TIDY_LENGTHS: f64 = 2.5;

/// Gaps above these limits must be roughly straight, straight, and very straight between lines longer than
/// the gap.
const GAP_SMALL_TIDY_LENGTHS: f64 = 0.35;
const GAP_MEDIUM_TIDY_LENGTHS: f64 = 0.8;
const GAP_LARGE_TIDY_LENGTHS: f64 = 1.5;

/// Window for measuring directions.
const DIRECTION_TIDY_LENGTHS: f64 = 1.5;

/// Minimum number of ends per task.
const MIN_ENDS_PER_TASK: usize = 16;

/// Cosine of the sharpest turn (45 degrees) at a stitch.
const MIN_STITCH_COSINE: f64 = 0.707;

/// Cosines of the sharpest turns (53, 30 and 16 degrees) into and out of gaps above the three limits.
const MIN_SMALL_GAP_COSINE: f64 = 0.6;
const MIN_MEDIUM_GAP_COSINE: f64 = 0.866;
const MIN_LARGE_GAP_COSINE: f64 = 0.96;

/// Candidate stitch between two ends (`2 * line + side`), with the cuts on both lines.
#[derive(Debug, Clone, Copy)]
struct Stitch {
    cost: f64,
    a: usize,
    b: usize,
    cut_a: StitchEnd,
    cut_b: StitchEnd,
}

impl Stitch {
    /// The segment that the stitch adds, for the occlusion test.
    fn way(&self, raws: &[RawLine]) -> GapSegment {
        let cuts = [self.cut_a, self.cut_b];
        GapSegment {
            ends: cuts.map(|cut| cut.point),
            depths: cuts.map(|cut| cut.sample.depth),
            segments: [self.a, self.b].map(|end| raws[end / 2].segment),
        }
    }
}

/// Stitches lines where possible. A stitched line takes the place and direction of its first piece.
///
/// No stitch passes behind another surface.
pub(crate) fn stitch(
    mut raws: Vec<RawLine>,
    degrees: &mut VertexDegrees,
    tidy: f64,
    occlusion: Option<&GapOcclusion>,
    removal_log: &mut RemovalLog,
) -> Vec<RawLine> {
    let stitches = cheapest_stitches(&raws, degrees, tidy, occlusion);
    if stitches.is_empty() {
        return raws;
    }
    let mut link: Vec<Option<(usize, StitchEnd)>> = vec![None; 2 * raws.len()];
    for s in stitches {
        for (end, cut) in [(s.a, s.cut_a), (s.b, s.cut_b)] {
            if cut.trimmed > 0.0 {
                let walk = OrientedLine::new(&raws[end / 2].line, end % 2);
                let stub = || (0..cut.next).map(|k| walk.point(k)).chain([cut.point]).collect();
                removal_log.record_part(&raws[end / 2], RemovalReason::Stub, stub);
                degrees.cut_off(raws[end / 2].ends[end % 2]);
            }
        }
        link[s.a] = Some((s.b, s.cut_a));
        link[s.b] = Some((s.a, s.cut_b));
    }
    let mut used = vec![false; raws.len()];
    let mut sewn = Vec::with_capacity(raws.len());
    for i in 0..raws.len() {
        if used[i] {
            continue;
        }
        // Walk back to the start of the stitched line, then along all of it.
        let mut start = 2 * i;
        while let Some((other, _)) = link[start] {
            start = other ^ 1;
            if start / 2 == i {
                break;
            }
        }
        let closed = link[start].is_some();
        let first = std::mem::take(&mut raws[i].line);
        let vertices = std::mem::take(&mut raws[i].vertices);
        let mut sewn_line = RawLine { line: SampledLine::default(), vertices, ..raws[i] };
        if !closed && link[start ^ 1].is_none() {
            used[i] = true;
            sewn.push(RawLine { line: first, ..sewn_line });
            continue;
        }
        raws[i].line = first;
        let end = |end: usize| (raws[end / 2].ends[end % 2], raws[end / 2].covered[end % 2]);
        let mut at = start;
        let last = loop {
            used[at / 2] = true;
            if at / 2 != i {
                sewn_line.pronounced += raws[at / 2].pronounced;
                sewn_line.segment = sewn_line.segment.min(raws[at / 2].segment);
                sewn_line.vertices.extend(&raws[at / 2].vertices);
            }
            let line = &raws[at / 2].line;
            append_trimmed(
                &mut sewn_line.line,
                line,
                at % 2 == 1,
                link[at].map(|l| l.1),
                link[at ^ 1].map(|l| l.1),
            );
            match link[at ^ 1] {
                Some((next, _)) if !used[next / 2] => at = next,
                _ => break at ^ 1,
            }
        };
        let ((from, covered_from), (to, covered_to)) = (end(start), end(last));
        sewn_line.ends = [from, to];
        sewn_line.covered = [covered_from, covered_to];
        if closed && sewn_line.line.points.first() == sewn_line.line.points.last() {
            sewn_line.line.pop();
        }
        sewn_line.line.closed = closed && sewn_line.line.len() > 2;
        sewn.push(sewn_line);
    }
    sewn
}

/// The cheapest stitches, with each end in at most one.
fn cheapest_stitches(
    raws: &[RawLine],
    degrees: &VertexDegrees,
    tidy: f64,
    gap_occlusion: Option<&GapOcclusion>,
) -> Vec<Stitch> {
    let mut ends: Vec<(Point, usize)> = Vec::new();
    for (i, raw) in raws.iter().enumerate() {
        if raw.smooth && !raw.class.hidden && !raw.line.closed && raw.line.len() > 1 {
            let points = &raw.line.points;
            for (side, point) in [points.first(), points.last()].into_iter().enumerate() {
                if let (true, Some(p)) = (degrees.is_free(raw.ends[side]), point) {
                    ends.push((*p, 2 * i + side));
                }
            }
        }
    }
    ends.sort_by(|a, b| a.0.x.total_cmp(&b.0.x).then(a.0.y.total_cmp(&b.0.y)).then(a.1.cmp(&b.1)));
    let reach = MAX_STUB_TIDY_LENGTHS * tidy;
    let of_end = |(k, (p, a)): (usize, &(Point, usize))| {
        let (p, a) = (*p, *a);
        let close_ends = ends[k + 1..].iter().take_while(move |(q, _)| q.x - p.x <= reach);
        close_ends.filter_map(move |(q, b)| {
            let is_candidate = (q.y - p.y).abs() <= reach && raws[a / 2].class == raws[b / 2].class;
            if is_candidate { best_stitch(raws, a, *b, tidy) } else { None }
        })
    };
    let all = ends.par_iter().enumerate().with_min_len(MIN_ENDS_PER_TASK);
    let mut found: Vec<Stitch> = all.flat_map_iter(of_end).collect();
    if let Some(occlusion) = gap_occlusion {
        let gaps: Vec<GapSegment> = found.iter().map(|stitch| stitch.way(raws)).collect();
        let mut hidden = occlusion.occluded_gaps(&gaps).into_iter();
        found.retain(|_| !hidden.next().unwrap_or(false));
    }
    found.sort_by(|s, u| s.cost.total_cmp(&u.cost).then((s.a, s.b).cmp(&(u.a, u.b))));
    let mut is_used = vec![false; 2 * raws.len()];
    found.retain(|s| {
        let free = !is_used[s.a] && !is_used[s.b];
        if free {
            is_used[s.a] = true;
            is_used[s.b] = true;
        }
        free
    });
    found
}

/// The cheapest way to stitch two ends: without a cut, or with the overhang of either line cut off.
fn best_stitch(raws: &[RawLine], a: usize, b: usize, tidy: f64) -> Option<Stitch> {
    let (from, to) = (OrientedLine::new(&raws[a / 2].line, a), OrientedLine::new(&raws[b / 2].line, b));
    let same = a / 2 == b / 2;
    let total = |walk: &OrientedLine| walk.arc(6.0 * tidy);
    if same && total(&from) < 6.0 * tidy {
        return None;
    }
    let untrimmed = |walk: &OrientedLine| walk.cut(0, 0.0, 0.0);
    let cut_pairs = [
        Some((untrimmed(&from), untrimmed(&to))),
        to.nearest(from.point(0), MAX_STUB_TIDY_LENGTHS * tidy).map(|cut| (untrimmed(&from), cut)),
        from.nearest(to.point(0), MAX_STUB_TIDY_LENGTHS * tidy).map(|cut| (cut, untrimmed(&to))),
    ];
    let stitches = cut_pairs.into_iter().flatten().filter_map(|(cut_a, cut_b)| {
        let jump = cut_b.point - cut_a.point;
        let trimmed = cut_a.trimmed + cut_b.trimmed;
        let max_jump = if trimmed > 0.0 { MAX_TRIMMED_JUMP_TIDY_LENGTHS } else { MAX_JUMP_TIDY_LENGTHS };
        if length(jump) > max_jump * tidy {
            return None;
        }
        let back = from.direction(&cut_a, DIRECTION_TIDY_LENGTHS * tidy);
        let forward = to.direction(&cut_b, DIRECTION_TIDY_LENGTHS * tidy);
        let bent = -back.dot(forward) < MIN_STITCH_COSINE;
        let jump_direction = unit(jump);
        let min_cosine = match length(jump) / tidy {
            far if far > GAP_LARGE_TIDY_LENGTHS => MIN_LARGE_GAP_COSINE,
            far if far > GAP_MEDIUM_TIDY_LENGTHS => MIN_MEDIUM_GAP_COSINE,
            far if far > GAP_SMALL_TIDY_LENGTHS => MIN_SMALL_GAP_COSINE,
            _ => -1.0,
        };
        let is_askew =
            trimmed <= 0.0 && jump_direction.dot(forward).min(-jump_direction.dot(back)) < min_cosine;
        // A line that is mostly overhang is a separate line.
        let eaten = |walk: &OrientedLine, cut: &StitchEnd| {
            cut.trimmed > 0.0 && walk.arc(2.0 * cut.trimmed) < 2.0 * cut.trimmed
        };
        let consumed =
            trimmed > MIN_LONG_STUB_TIDY_LENGTHS * tidy && (eaten(&from, &cut_a) || eaten(&to, &cut_b));
        // Two short lines are not joined by a longer gap.
        let jump_length = length(jump);
        let arcs = [from.arc(1.5 * jump_length), to.arc(1.5 * jump_length)];
        let thin = arcs[0].max(arcs[1]) < jump_length
            || (jump_length > GAP_LARGE_TIDY_LENGTHS * tidy && arcs[0].min(arcs[1]) < 1.5 * jump_length);
        // An overhang is cut off only if it runs next to the other line.
        let apart = from.stub_leaves(&cut_a, &to, tidy) || to.stub_leaves(&cut_b, &from, tidy);
        (!bent && !is_askew && !thin && !consumed && !apart).then(|| Stitch {
            cost: length(jump) + 0.25 * trimmed,
            a,
            b,
            cut_a,
            cut_b,
        })
    });
    stitches.min_by(|s, u| s.cost.total_cmp(&u.cost))
}
