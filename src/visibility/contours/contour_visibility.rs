//! [`ContourVisibility`]: the drawn parts of the contours of rounded surfaces.
//!
//! The mesh contour consists of mesh edges, and its visibility is exact. The smooth contour is the curve on
//! the faces that replaces it in the drawing.
//!
//! 1. [`ContourMatcher`] matches visible parts of the mesh contour to positions on smooth contours.
//! 2. A smooth contour is drawn where a matched part is visible. Small gaps are closed.
//! 3. Visible parts of the mesh contour without a match are drawn themselves, except ripples and spurs of
//!    the mesh.

use crate::parallel::prelude::*;

use super::contour_chains::{ContourChain, contour_chains};
use super::contour_matching::{ContourMatcher, CurveIndex, CurveSpan, MAX_MATCH_DISTANCE_PX, UnmatchedSpan};
use super::contour_spurs::ContourSpurs;
use crate::geometry::lists::csr_lists::{CsrLists, csr_lists};
use crate::lines::{FeatureLines, Role};
use crate::mesh::Mesh;
use crate::view::View;
use crate::visibility::graph::{ContourCounts, ViewVertexKind, VisibleContour};
use crate::visibility::occlusion::interval_sweep::HiddenInterval;
use crate::visibility::occlusion::triangle_occlusion::Interval;
use crate::visibility::projection::image_segments::ImageSegment;
use crate::visibility::sweep::segment_visibility::SegmentVisibility;
use crate::visibility::tolerances;
use crate::visibility::view_tolerances::ViewTolerances;

/// Maximum gap between visible spans of a curve that is closed, px. Such gaps come from sampling a mesh
/// contour that is visible throughout.
const MAX_JOIN_GAP_PX: f64 = 1.0;

/// Drawn parameter ranges of smooth contours and mesh contours, by image segment.
#[derive(Debug, Clone, Default)]
pub(crate) struct ContourVisibility {
    /// Undrawn parts of each image segment of a rounded surface, ascending.
    pub hidden: CsrLists<HiddenInterval>,
    /// Parts of each image segment with a surface, not background, behind its outer side, ascending.
    pub non_silhouette: CsrLists<Interval>,
    /// Whether each segment is a mesh contour with a drawn part.
    has_unmatched: Vec<bool>,
    pub counts: ContourCounts,
    /// Visible parts of all mesh contours, with or without a match.
    pub visible_mesh_contours: Vec<VisibleContour>,
}

impl ContourVisibility {
    /// Whether any part of an image segment of a rounded surface may be drawn.
    pub(crate) fn is_drawn(&self, segment: usize, role: Role) -> bool {
        role == Role::SmoothContour || self.has_unmatched[segment]
    }
}

/// The fields of [`ContourVisibility`], in the order of discovery.
#[derive(Debug, Default)]
struct ContourPieces {
    hidden: Vec<(u32, HiddenInterval)>,
    non_silhouette: Vec<(u32, Interval)>,
    /// Mesh contour segments with a drawn part.
    unmatched: Vec<u32>,
    counts: ContourCounts,
}

impl ContourPieces {
    /// Groups the results by image segment.
    fn sorted(self, segments: usize, visible_contours: Vec<VisibleContour>) -> ContourVisibility {
        let mut is_unmatched = vec![false; segments];
        self.unmatched.iter().for_each(|segment| is_unmatched[*segment as usize] = true);
        let hidden = by_segment(segments, &self.hidden, |layer| layer.interval.start);
        let backed = by_segment(segments, &self.non_silhouette, |interval| interval.start);
        ContourVisibility {
            hidden,
            non_silhouette: backed,
            has_unmatched: is_unmatched,
            counts: self.counts,
            visible_mesh_contours: visible_contours,
        }
    }
}

/// Groups values by segment, sorted by their start.
fn by_segment<T: Copy>(segments: usize, found: &[(u32, T)], start: impl Fn(&T) -> f64) -> CsrLists<T> {
    let mut sorted =
        csr_lists(segments, |put| found.iter().for_each(|(segment, value)| put(*segment as usize, *value)));
    for segment in 0..segments {
        sorted.of_mut(segment).sort_by(|a, b| start(a).total_cmp(&start(b)));
    }
    sorted
}

/// Smooth contours in the image, indexed for lookup.
pub(crate) struct SmoothContours {
    contour_chains: Vec<ContourChain>,
    curve_index: CurveIndex,
}

impl SmoothContours {
    pub(crate) fn new(lines: &FeatureLines, segments: &[ImageSegment], limits: &ViewTolerances) -> Self {
        let runs = contour_chains(lines, segments, tolerances::MIN_CUSP_PX * limits.px);
        Self { curve_index: CurveIndex::new(segments, &runs), contour_chains: runs }
    }
}

/// Computes the drawn parts of smooth contours and mesh contours from `seen`, the visibility of the mesh
/// contours. With `counting`, hidden parts get the number of surfaces in front of them.
pub(crate) fn decide_contours(
    mesh: &Mesh,
    view: &View,
    SmoothContours { contour_chains: runs, curve_index: curve_lookup }: SmoothContours,
    segments: &[ImageSegment],
    seen: &SegmentVisibility,
    limits: &ViewTolerances,
    counting: bool,
) -> ContourVisibility {
    let court = ContourMatcher {
        mesh,
        view,
        segments,
        contour_chains: &runs,
        curve_index: curve_lookup,
        px: limits.px,
    };
    let mut testimony = court.match_contours(seen, counting);
    testimony.matched.par_sort_by(|a, b| {
        a.run
            .cmp(&b.run)
            .then(a.from.total_cmp(&b.from))
            .then(b.to.total_cmp(&a.to))
            .then(a.kinds.cmp(&b.kinds))
    });
    let mut found = ContourPieces::default();
    found.counts.curves = runs.len() as u64;
    let mut seen_of_run: Vec<Vec<CurveSpan>> = Vec::with_capacity(runs.len());
    let mut told = testimony.matched.as_slice();
    for (r, run) in runs.iter().enumerate() {
        let count = told.partition_point(|t| t.run as usize == r);
        let (own, rest) = told.split_at(count);
        told = rest;
        let visible = joined(own.iter().filter(|t| t.count == 0), MAX_JOIN_GAP_PX * limits.px);
        let silhouette = joined(own.iter().filter(|t| t.silhouette), MAX_JOIN_GAP_PX * limits.px);
        found.add_run(run, [&visible, &silhouette, own], MAX_MATCH_DISTANCE_PX * limits.px);
        seen_of_run.push(visible);
    }
    found.add_unmatched(&court, segments, &testimony.unmatched, &seen_of_run);
    found.sorted(segments.len(), testimony.visible_contours)
}

/// Merges spans that overlap or nearly meet; they must be sorted by start.
fn joined<'a>(pieces: impl Iterator<Item = &'a CurveSpan>, gap: f64) -> Vec<CurveSpan> {
    let mut joined: Vec<CurveSpan> = Vec::new();
    for piece in pieces {
        match joined.last_mut() {
            Some(last) if piece.from <= last.to + gap => {
                if piece.to > last.to || (piece.to == last.to && piece.kinds[1] > last.kinds[1]) {
                    last.to = piece.to;
                    last.kinds[1] = piece.kinds[1];
                }
            }
            _ => joined.push(*piece),
        }
    }
    joined
}

/// Visible spans of each run (chain of a smooth contour), ascending.
struct VisibleChains<'a> {
    contour_chains: &'a [ContourChain],
    pieces: &'a [Vec<CurveSpan>],
}

impl VisibleChains<'_> {
    fn is_visible_at(&self, run: u32, arc_length: f64) -> bool {
        let pieces = &self.pieces[run as usize];
        let next = pieces.partition_point(|t| t.to < arc_length);
        pieces.get(next).is_some_and(|t| t.from <= arc_length)
    }

    /// Whether a run is visible throughout between two places. On a closed run, either way round is enough.
    fn between(&self, run: u32, from: f64, to: f64) -> bool {
        let holds =
            |from: f64, to: f64| self.pieces[run as usize].iter().any(|t| t.from <= from && t.to >= to);
        let run = &self.contour_chains[run as usize];
        holds(from, to) || (run.closed && holds(0.0, from) && holds(to, run.length()))
    }
}

impl ContourPieces {
    /// Adds the visible parts of the mesh contour without a matching smooth contour.
    ///
    /// Two kinds of parts are left out: those near a visible part of a smooth contour, and ripples of the
    /// mesh in front of another surface.
    fn add_unmatched(
        &mut self,
        matcher: &ContourMatcher,
        segments: &[ImageSegment],
        unmatched_spans: &[UnmatchedSpan],
        spans_by_chain: &[Vec<CurveSpan>],
    ) {
        let visible_chains = VisibleChains { contour_chains: matcher.contour_chains, pieces: spans_by_chain };
        let spurs = ContourSpurs::new(matcher, segments);
        let is_ripple = |id: u32| {
            matches!(segments[id as usize].role, Role::MeshContour { fold: true, .. })
                || spurs.contains(id, |run, from, to| visible_chains.between(run, from, to))
        };
        let mut drawn: Vec<UnmatchedSpan> = Vec::new();
        for segment_spans in unmatched_spans.chunk_by(|a, b| a.segment == b.segment) {
            let segment = &segments[segment_spans[0].segment as usize];
            let mut ripple = None;
            for piece in segment_spans {
                let middle = segment.at((piece.from + piece.to) / 2.0);
                if matcher
                    .has_ink_near(middle, |run, arc_length| visible_chains.is_visible_at(run, arc_length))
                {
                    continue;
                }
                if !piece.silhouette && *ripple.get_or_insert_with(|| is_ripple(piece.segment)) {
                    self.counts.folds += 1;
                    continue;
                }
                match drawn.last_mut() {
                    Some(last)
                        if last.segment == piece.segment
                            && last.to == piece.from
                            && last.silhouette == piece.silhouette =>
                    {
                        last.to = piece.to;
                    }
                    _ => drawn.push(*piece),
                }
            }
        }
        self.counts.unmatched = drawn.len() as u64;
        for drawn_spans in drawn.chunk_by(|a, b| a.segment == b.segment) {
            self.add_mesh_contour(drawn_spans);
            self.unmatched.push(drawn_spans[0].segment);
        }
    }

    /// Adds the hidden parts of a run: everything outside its visible spans.
    fn add_run(
        &mut self,
        run: &ContourChain,
        [visible, silhouette, chain_spans]: [&[CurveSpan]; 3],
        cusp: f64,
    ) {
        let mut at = 0.0;
        let mut kind = ViewVertexKind::Vertex;
        // A contour end that no line covers is a cusp if the contour turns back in the image there.
        let ended = |arc_length: f64, kind: ViewVertexKind| match kind {
            ViewVertexKind::Vertex if run.turns_near(arc_length, cusp) => ViewVertexKind::Cusp,
            kind => kind,
        };
        for piece in visible {
            self.hide(run, [at, piece.from], [kind, ended(piece.from, piece.kinds[0])], chain_spans);
            (at, kind) = (piece.to, ended(piece.to, piece.kinds[1]));
        }
        self.hide(run, [at, run.length()], [kind, ViewVertexKind::Vertex], chain_spans);
        let mut at = 0.0;
        let ends = silhouette.iter().map(|piece| (piece.from, piece.to));
        for (from, to) in ends.chain([(run.length(), run.length())]) {
            let backdrop = ViewVertexKind::Backdrop;
            each_part(run, at, from, |segment, start, end| {
                let interval = Interval { start, end, start_kind: backdrop, end_kind: backdrop };
                self.non_silhouette.push((segment, interval));
            });
            at = to;
        }
    }

    /// Adds a hidden range of a run, with the kinds of its ends. `chain_spans` gives the number of surfaces in
    /// front.
    fn hide(
        &mut self,
        run: &ContourChain,
        [from, to]: [f64; 2],
        kinds: [ViewVertexKind; 2],
        chain_spans: &[CurveSpan],
    ) {
        // Parts without a match are behind at least one surface.
        let count = |from: f64, to: f64| {
            let hidden = chain_spans.iter().filter(|t| t.count > 0 && t.from < to && t.to > from);
            hidden.map(|t| t.count).max().unwrap_or(1)
        };
        let counted = chain_spans.iter().any(|t| t.count > 0);
        each_part(run, from, to, |segment, start, end| {
            let interval = Interval { start, end, start_kind: kinds[0], end_kind: kinds[1] };
            let count = if counted { count(from, to) } else { 1 };
            self.hidden.push((segment, HiddenInterval { interval, count }));
        });
    }

    /// Adds the undrawn parts of a mesh contour segment: everything outside its unmatched visible spans.
    fn add_mesh_contour(&mut self, unmatched_spans: &[UnmatchedSpan]) {
        let inner = ViewVertexKind::Vertex;
        let mut at = 0.0;
        let segment = unmatched_spans[0].segment;
        let end = UnmatchedSpan { segment, from: 1.0, to: 1.0, silhouette: true };
        for piece in unmatched_spans.iter().chain([&end]) {
            if piece.from > at {
                let interval = Interval { start: at, end: piece.from, start_kind: inner, end_kind: inner };
                self.hidden.push((segment, HiddenInterval { interval, count: 1 }));
            }
            if !piece.silhouette {
                let kind = ViewVertexKind::Backdrop;
                let interval =
                    Interval { start: piece.from, end: piece.to, start_kind: kind, end_kind: kind };
                self.non_silhouette.push((segment, interval));
            }
            at = piece.to;
        }
    }
}

/// Calls `visit(image segment, from, to)` for the segment parts between two places of a run.
fn each_part(run: &ContourChain, from: f64, to: f64, mut visit: impl FnMut(u32, f64, f64)) {
    if to <= from {
        return;
    }
    let first = run.starts.partition_point(|start| *start <= from).saturating_sub(1);
    for (k, id) in run.segments.iter().enumerate().skip(first) {
        let (start, end) = (run.starts[k], run.starts[k + 1]);
        if start >= to {
            break;
        }
        let length = end - start;
        if length > 0.0 {
            let at = |arc_length: f64| ((arc_length - start) / length).clamp(0.0, 1.0);
            if at(to) > at(from) {
                visit(*id, at(from), at(to));
            }
        }
    }
}
