//! [`ContourMatcher`]: matching of mesh contours to smooth contours.
//!
//! The visibility of an edge of the mesh contour is known exactly, and the smooth contour runs near it. Each
//! visible point of the edge is matched to the nearest place of a curve that
//! - belongs to the same body,
//! - is no farther away in depth than the faces there allow,
//! - has a similar normal, and
//! - runs forward where the edge is convex and backward where it is concave.
//!
//! Matching goes from the edge to the curve and not the other way round. So there is ink only next to visible
//! parts of the mesh contour.

use crate::parallel::prelude::*;
use glam::{DVec3, Vec3};

use super::contour_chains::ContourChain;
use crate::geometry::lists::csr_lists::{CsrLists, csr_lists};
use crate::lines::Role;
use crate::mesh::{FaceId, Mesh};
use crate::view::View;
use crate::visibility::graph::{ViewVertexKind, VisibleContour};
use crate::visibility::occlusion::interval_sweep::HiddenInterval;
use crate::visibility::occlusion::triangle_occlusion::Interval;
use crate::visibility::projection::image_segments::ImageSegment;
use crate::visibility::sweep::segment_visibility::SegmentVisibility;
use crate::visibility::tiles::aligned_grid::grid_over;
use crate::visibility::tiles::tile_grid::TileGrid;

/// Largest distance of a curve that may stand for an edge, px. Smooth contour and mesh contour are closer
/// together if the drawing is not coarser than its model.
pub(crate) const MAX_MATCH_DISTANCE_PX: f64 = 2.5;
/// Sampling step along edges, px.
const SAMPLE_STEP_PX: f64 = 1.0;
/// Distance below which a curve counts as the ink of an edge, px, even if it is matched to another.
const MAX_INK_DISTANCE_PX: f64 = 1.5;
/// Smallest cosine between the normals of an edge and its curve.
const MIN_NORMAL_COSINE: f32 = 0.2;
/// Largest difference in depth between an edge and its curve, in multiples of the longest sides of their
/// faces, plus [`MAX_DEPTH_GAP_PX`] px.
///
/// Where a surface is seen edge-on, a shift of half a px is one of many px in depth.
const MAX_DEPTH_GAP_FACES: f64 = 2.0;
const MAX_DEPTH_GAP_PX: f64 = 24.0;
/// Largest ratio between a step along a curve and the step along its edge, apart from the match distance. At
/// a corner of the edges the nearest place jumps.
const MAX_STRETCH: f64 = 4.0;
/// Tiles across the page in the lookup of curves.
const TILES_ACROSS: u32 = 256;

/// Mesh contour segments per task.
const CONTOURS_PER_TASK: usize = 64;

/// Visible or hidden span of a run, next to an edge of the mesh contour.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CurveSpan {
    pub run: u32,
    /// Start and end, as places along the run.
    pub from: f64,
    pub to: f64,
    /// Reasons for the ends, where the mesh contour gives them.
    pub kinds: [ViewVertexKind; 2],
    /// Whether there is background next to it.
    pub silhouette: bool,
    /// Number of surfaces in front.
    pub count: u16,
}

/// Visible part of a mesh contour edge without a matching curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct UnmatchedSpan {
    /// Image segment.
    pub segment: u32,
    pub from: f64,
    pub to: f64,
    pub silhouette: bool,
}

/// Result of the matching.
#[derive(Debug, Clone, Default)]
pub(crate) struct MatchResult {
    /// Visible (count 0) and hidden spans of runs.
    pub matched: Vec<CurveSpan>,
    /// Visible parts without a curve, in the order of segments.
    pub unmatched: Vec<UnmatchedSpan>,
    /// Visible parts of all mesh contours, with or without a curve.
    pub visible_contours: Vec<VisibleContour>,
}

/// Input of the matching.
pub(crate) struct ContourMatcher<'a> {
    pub mesh: &'a Mesh,
    pub view: &'a View,
    pub segments: &'a [ImageSegment],
    pub contour_chains: &'a [ContourChain],
    pub curve_index: CurveIndex,
    pub px: f64,
}

/// Pieces of curves in a grid, for lookup by position.
pub(crate) struct CurveIndex {
    grid: TileGrid,
    /// Run, and index within the run, of the pieces in each tile.
    pieces: CsrLists<(u32, u32)>,
}

impl CurveIndex {
    pub(crate) fn new(segments: &[ImageSegment], runs: &[ContourChain]) -> Self {
        let grid = grid_over(segments.iter(), TILES_ACROSS);
        let pieces = csr_lists(grid.len(), |put| {
            for (r, run) in runs.iter().enumerate() {
                for (k, id) in run.segments.iter().enumerate() {
                    let segment = &segments[*id as usize];
                    grid.walk(segment.a, segment.b, |tile, _, _| put(tile, (r as u32, k as u32)));
                }
            }
        });
        Self { grid, pieces }
    }
}

/// Place on a run.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ContourPosition {
    pub chain: u32,
    /// Arc length along the run, user units.
    pub arc_length: f64,
}

impl ContourMatcher<'_> {
    /// Matches all mesh contours. Hidden spans are included only with `hidden`.
    pub(crate) fn match_contours(&self, visibility: &SegmentVisibility, hidden: bool) -> MatchResult {
        let count = self.segments.len();
        let results: Vec<MatchResult> = (0..count.div_ceil(CONTOURS_PER_TASK))
            .into_par_iter()
            .with_max_len(1)
            .map(|chunk| {
                let mut task_result = MatchResult::default();
                for id in chunk * CONTOURS_PER_TASK..((chunk + 1) * CONTOURS_PER_TASK).min(count) {
                    self.match_contour(id as u32, visibility, hidden, &mut task_result);
                }
                task_result
            })
            .collect();
        let mut all = MatchResult::default();
        for result in results {
            all.matched.extend(result.matched);
            all.visible_contours.extend(result.visible_contours);
            all.unmatched.extend(result.unmatched);
        }
        all
    }

    fn match_contour(&self, id: u32, visibility: &SegmentVisibility, hidden: bool, out: &mut MatchResult) {
        let segment = &self.segments[id as usize];
        let Role::MeshContour { convex, .. } = segment.role else { return };
        let layers = visibility.hidden(id as usize);
        let mut at = 0.0;
        let mut kind = ViewVertexKind::Vertex;
        let end = HiddenInterval {
            interval: Interval {
                start: 1.0,
                end: 1.0,
                start_kind: ViewVertexKind::Vertex,
                end_kind: ViewVertexKind::Vertex,
            },
            count: 0,
        };
        for layer in layers.iter().chain([&end]) {
            let Interval { start, end, start_kind, end_kind } = layer.interval;
            if start > at {
                let visible_span = CurveSpan {
                    run: 0,
                    from: at,
                    to: start,
                    kinds: [kind, start_kind],
                    silhouette: true,
                    count: 0,
                };
                let ends = [at, start].map(|t| segment.at(t).truncate());
                out.visible_contours.push(VisibleContour { ends, segment: segment.source });
                for piece in backed_pieces(&visible_span, visibility.backed(id as usize)) {
                    self.match_part(id, convex, &piece, out);
                }
            }
            if hidden && layer.count > 0 && end > start {
                let kinds = [start_kind, end_kind];
                let piece =
                    CurveSpan { run: 0, from: start, to: end, kinds, silhouette: false, count: layer.count };
                self.match_part(id, convex, &piece, out);
            }
            (at, kind) = (end, end_kind);
        }
    }

    /// Matches a part of a mesh contour edge to the curves. Its `from` and `to` are parameters of the
    /// segment.
    fn match_part(&self, id: u32, convex: bool, piece: &CurveSpan, out: &mut MatchResult) {
        let segment = &self.segments[id as usize];
        let steps = ((piece.to - piece.from) * segment.length() / (SAMPLE_STEP_PX * self.px)).ceil().max(1.0);
        let t =
            |k: f64| if k >= steps { piece.to } else { piece.from + (piece.to - piece.from) * (k / steps) };
        let mut previous = self.nearest(segment, convex, segment.at(piece.from));
        for k in 0..steps as u32 {
            let (from, to) = (t(f64::from(k)), t(f64::from(k + 1)));
            let position = self.nearest(segment, convex, segment.at(to));
            match (previous, position) {
                (Some(p), Some(q)) => {
                    let kinds = [
                        if k == 0 { piece.kinds[0] } else { ViewVertexKind::Vertex },
                        if f64::from(k + 1) >= steps { piece.kinds[1] } else { ViewVertexKind::Vertex },
                    ];
                    let max_advance =
                        MAX_STRETCH * (to - from) * segment.length() + MAX_MATCH_DISTANCE_PX * self.px;
                    self.add_curve_span(p, q, max_advance, kinds, piece, out);
                }
                _ if piece.count == 0 => {
                    out.unmatched.push(UnmatchedSpan { segment: id, from, to, silhouette: piece.silhouette });
                }
                _ => {}
            }
            previous = position;
        }
    }

    /// Adds the span between two places of a run, if it is no longer than `max_length`.
    fn add_curve_span(
        &self,
        p: ContourPosition,
        q: ContourPosition,
        max_length: f64,
        kinds: [ViewVertexKind; 2],
        piece: &CurveSpan,
        out: &mut MatchResult,
    ) {
        let run = &self.contour_chains[p.chain as usize];
        if p.chain != q.chain || run.between(p.arc_length, q.arc_length) > max_length {
            return;
        }
        let (from, to, kinds) = if p.arc_length <= q.arc_length {
            (p.arc_length, q.arc_length, kinds)
        } else {
            (q.arc_length, p.arc_length, [kinds[1], kinds[0]])
        };
        let matched_span = CurveSpan { run: p.chain, kinds, ..*piece };
        if run.closed && to - from > run.length() / 2.0 {
            // The span crosses the seam of the closed run.
            let inner = ViewVertexKind::Vertex;
            out.matched.push(CurveSpan {
                from: to,
                to: run.length(),
                kinds: [kinds[1], inner],
                ..matched_span
            });
            out.matched.push(CurveSpan { from: 0.0, to: from, kinds: [inner, kinds[0]], ..matched_span });
        } else {
            out.matched.push(CurveSpan { from, to, ..matched_span });
        }
    }

    /// Nearest place of a curve that may stand for a mesh contour edge at one of its points.
    pub(crate) fn match_point(&self, mesh_contour: &ImageSegment, p: DVec3) -> Option<ContourPosition> {
        match mesh_contour.role {
            Role::MeshContour { convex, .. } => self.nearest(mesh_contour, convex, p),
            _ => None,
        }
    }

    fn nearest(&self, mesh_contour: &ImageSegment, convex: bool, p: DVec3) -> Option<ContourPosition> {
        let normal = |face: u32| Vec3::from_array(self.mesh.face_normals[face as usize]);
        let outward = (normal(mesh_contour.hosts[0]) + normal(mesh_contour.hosts[1])).normalize_or_zero();
        let body = |face: u32| self.mesh.body(face);
        let (depth, own_body) = (self.view.frame.depth_of(p.z), body(mesh_contour.hosts[0]));
        let reach_own = self.reach(mesh_contour.hosts[0]).max(self.reach(mesh_contour.hosts[1]));
        let per_px =
            if self.view.frame.perspective { depth.abs() } else { 1.0 } / self.view.frame.scale * self.px;
        let mut best: Option<(f64, ContourPosition)> = None;
        self.visit_near(p, MAX_MATCH_DISTANCE_PX * self.px, |squared_distance, r, k, distance_along| {
            if best.as_ref().is_some_and(|(best_distance, best_position)| {
                squared_distance
                    .total_cmp(best_distance)
                    .then(r.cmp(&best_position.chain))
                    .then(distance_along.total_cmp(&best_position.arc_length))
                    .is_ge()
            }) {
                return;
            }
            let run = &self.contour_chains[r as usize];
            let curve = &self.segments[run.segments[k] as usize];
            let host = curve.hosts[0];
            if run.backward[k] == convex
                || body(host) != own_body
                || outward.dot(normal(host)) < MIN_NORMAL_COSINE
            {
                return;
            }
            let t =
                (distance_along - run.starts[k]) / (run.starts[k + 1] - run.starts[k]).max(f64::MIN_POSITIVE);
            let gap = (self.view.frame.depth_of(curve.at(t).z) - depth).abs();
            if gap <= MAX_DEPTH_GAP_FACES * (reach_own + self.reach(host)) + MAX_DEPTH_GAP_PX * per_px {
                best = Some((squared_distance, ContourPosition { chain: r, arc_length: distance_along }));
            }
        });
        best.map(|(_, position)| position)
    }

    /// Whether a visible part of a curve passes a point of the image within ink distance. `is_seen` takes a
    /// run and a place along it.
    pub(crate) fn has_ink_near(&self, p: DVec3, is_seen: impl Fn(u32, f64) -> bool) -> bool {
        let mut inked = false;
        self.visit_near(p, MAX_INK_DISTANCE_PX * self.px, |_, r, _, distance_along| {
            inked = inked || is_seen(r, distance_along)
        });
        inked
    }

    /// Calls `visit(squared distance, run, index in it, place along it)` for the nearest points of all curve
    /// pieces within a distance.
    fn visit_near(&self, p: DVec3, reach: f64, mut visit: impl FnMut(f64, u32, usize, f64)) {
        let CurveIndex { grid, pieces } = &self.curve_index;
        for (tile, _) in grid.tiles_of(grid.tile_box(p - reach, p + reach)) {
            for (r, k) in pieces.of(tile) {
                let run = &self.contour_chains[*r as usize];
                let segment = &self.segments[run.segments[*k as usize] as usize];
                let (a, along) = (segment.a.truncate(), (segment.b - segment.a).truncate());
                let squared = along.length_squared();
                let projection = (p.truncate() - a).dot(along);
                let t = if squared > 0.0 { (projection / squared).clamp(0.0, 1.0) } else { 0.0 };
                let distance2 = (a + along * t).distance_squared(p.truncate());
                if distance2 <= reach * reach {
                    let k = *k as usize;
                    visit(distance2, *r, k, run.starts[k] + (run.starts[k + 1] - run.starts[k]) * t);
                }
            }
        }
    }

    /// Longest side of a face, world units.
    fn reach(&self, face: u32) -> f64 {
        let [a, b, c] = self.mesh.corners(FaceId(face));
        a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a)).sqrt()
    }
}

/// Splits a visible part where background begins or ends next to it.
fn backed_pieces(span: &CurveSpan, backed: &[Interval]) -> Vec<CurveSpan> {
    let mut pieces = Vec::with_capacity(1);
    let mut at = span.from;
    let inner = ViewVertexKind::Backdrop;
    let mut push = |from: f64, to: f64, silhouette: bool| {
        if to > from {
            let kinds = [
                if from > span.from { inner } else { span.kinds[0] },
                if to < span.to { inner } else { span.kinds[1] },
            ];
            pieces.push(CurveSpan { from, to, kinds, silhouette, ..*span });
        }
    };
    for interval in backed {
        let (from, to) = (interval.start.max(at), interval.end.min(span.to));
        if to > from {
            push(at, from, true);
            push(from, to, false);
            at = to;
        }
    }
    push(at, span.to, true);
    pieces
}
