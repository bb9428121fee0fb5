//! From witnesses to curves: the places of smooth contours at which the polyhedron's contour is seen.
//!
//! What is seen of an edge of the polyhedron's contour is known exactly. The smooth contour runs near
//! it, so each seen place of the edge is taken to the nearest place of a curve that may stand for it:
//! of the same body, no farther than what the faces here leave open, turning the same way, and
//! running forward where the edge is convex and backward where it is hollow. It is the edge that goes
//! to the curve and not the other way round, so that ink can stand nowhere but beside what is seen.

use crate::parallel::prelude::*;
use glam::{DVec3, Vec3};

use super::contour_chains::Run;
use crate::geometry::lists::csr_lists::{Grouped, grouped};
use crate::lines::Role;
use crate::mesh::{FaceId, Mesh};
use crate::view::View;
use crate::visibility::graph::{SeenContour, ViewVertexKind};
use crate::visibility::occlusion::interval_sweep::Layer;
use crate::visibility::occlusion::triangle_occlusion::Interval;
use crate::visibility::projection::image_segments::ImageSegment;
use crate::visibility::sweep::segment_visibility::Visibility;
use crate::visibility::tiles::aligned_grid::grid_over;
use crate::visibility::tiles::tile_grid::Grid;

/// A curve this near (px) may stand for an edge: more than smooth and polyhedral contours lie apart
/// wherever a drawing is not coarser than its model.
pub(crate) const REACH_PX: f64 = 2.5;
/// Edges are asked every so many px.
const STEP_PX: f64 = 1.0;
/// A curve nearer than this (px) is the ink of an edge, whatever it stands for.
const INK_PX: f64 = 1.5;
/// The normals of edge and curve turn from each other by no more than this cosine.
const SAME_SIDE_COSINE: f32 = 0.2;
/// Edge and curve are no farther from each other in depth than so many times the longest sides of
/// the faces that hold them, and this many px: where a surface is seen edge-on, a shift of
/// half a px is one of many px in depth.
const DEPTH_OF_FACES: f64 = 2.0;
const DEPTH_PX: f64 = 24.0;
/// From one asked place to the next a curve runs on for no more than so many times their distance, and as
/// much as it may be away: at a corner of the edges the nearest place jumps.
const STRETCH: f64 = 4.0;
/// Tiles across the page in which curves are sought.
const GRID: u32 = 256;

/// Witnesses that one task hears.
const CHUNK: usize = 64;

/// A piece of a run that is seen or hidden beside a witness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Told {
    pub run: u32,
    /// Places along the run.
    pub from: f64,
    pub to: f64,
    /// Why it ends where it does, if the witness says.
    pub kinds: [ViewVertexKind; 2],
    /// Whether there is background beside it.
    pub silhouette: bool,
    /// Number of surfaces in front.
    pub count: u16,
}

/// A seen piece of a witness with no curve for it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bare {
    /// Image segment.
    pub segment: u32,
    pub from: f64,
    pub to: f64,
    pub silhouette: bool,
}

/// What witnesses say.
#[derive(Debug, Clone, Default)]
pub(crate) struct Testimony {
    /// Seen (count 0) and hidden pieces of runs.
    pub told: Vec<Told>,
    /// What has no curve, in the order of segments.
    pub bare: Vec<Bare>,
    /// What is seen of witnesses, curve or not.
    pub seen: Vec<SeenContour>,
}

/// What witnesses are compared with.
pub(crate) struct Court<'a> {
    pub mesh: &'a Mesh,
    pub view: &'a View,
    pub segments: &'a [ImageSegment],
    pub runs: &'a [Run],
    pub sought: Sought,
    pub px: f64,
}

/// The pieces of curves, to be found by place.
pub(crate) struct Sought {
    grid: Grid,
    /// Run and index in it of those in each tile.
    pieces: Grouped<(u32, u32)>,
}

impl Sought {
    pub fn new(segments: &[ImageSegment], runs: &[Run]) -> Self {
        let grid = grid_over(segments.iter(), GRID);
        let pieces = grouped(grid.len(), |put| {
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

/// A place on a run.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place {
    pub run: u32,
    /// How far along it.
    pub at: f64,
}

impl Court<'_> {
    /// Asks all witnesses; hidden pieces are told only if `hidden` has them counted.
    pub fn hear(&self, seen: &Visibility, hidden: bool) -> Testimony {
        let count = self.segments.len();
        let heard: Vec<Testimony> = (0..count.div_ceil(CHUNK))
            .into_par_iter()
            .with_max_len(1)
            .map(|chunk| {
                let mut testimony = Testimony::default();
                for id in chunk * CHUNK..((chunk + 1) * CHUNK).min(count) {
                    self.hear_one(id as u32, seen, hidden, &mut testimony);
                }
                testimony
            })
            .collect();
        let mut all = Testimony::default();
        for one in heard {
            all.told.extend(one.told);
            all.seen.extend(one.seen);
            all.bare.extend(one.bare);
        }
        all
    }

    fn hear_one(&self, id: u32, seen: &Visibility, hidden: bool, out: &mut Testimony) {
        let segment = &self.segments[id as usize];
        let Role::Witness { convex, .. } = segment.role else { return };
        let layers = seen.hidden(id as usize);
        let mut at = 0.0;
        let mut kind = ViewVertexKind::Vertex;
        let end = Layer {
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
                let whole = Told {
                    run: 0,
                    from: at,
                    to: start,
                    kinds: [kind, start_kind],
                    silhouette: true,
                    count: 0,
                };
                let ends = [at, start].map(|t| segment.at(t).truncate());
                out.seen.push(SeenContour { ends, segment: segment.source });
                for piece in backed_pieces(&whole, seen.backed(id as usize)) {
                    self.follow(id, convex, &piece, out);
                }
            }
            if hidden && layer.count > 0 && end > start {
                let kinds = [start_kind, end_kind];
                let piece =
                    Told { run: 0, from: start, to: end, kinds, silhouette: false, count: layer.count };
                self.follow(id, convex, &piece, out);
            }
            (at, kind) = (end, end_kind);
        }
    }

    /// Takes a piece of a witness to the curves. Its `from` and `to` are parameters of the segment.
    fn follow(&self, id: u32, convex: bool, piece: &Told, out: &mut Testimony) {
        let segment = &self.segments[id as usize];
        let steps = ((piece.to - piece.from) * segment.length() / (STEP_PX * self.px)).ceil().max(1.0);
        let t =
            |k: f64| if k >= steps { piece.to } else { piece.from + (piece.to - piece.from) * (k / steps) };
        let mut last = self.nearest(segment, convex, segment.at(piece.from));
        for k in 0..steps as u32 {
            let (from, to) = (t(f64::from(k)), t(f64::from(k + 1)));
            let here = self.nearest(segment, convex, segment.at(to));
            match (last, here) {
                (Some(p), Some(q)) => {
                    let kinds = [
                        if k == 0 { piece.kinds[0] } else { ViewVertexKind::Vertex },
                        if f64::from(k + 1) >= steps { piece.kinds[1] } else { ViewVertexKind::Vertex },
                    ];
                    let way = STRETCH * (to - from) * segment.length() + REACH_PX * self.px;
                    self.tell(p, q, way, kinds, piece, out);
                }
                _ if piece.count == 0 => {
                    out.bare.push(Bare { segment: id, from, to, silhouette: piece.silhouette });
                }
                _ => {}
            }
            last = here;
        }
    }

    /// What lies between two places of a run, if it is no longer than `most`.
    fn tell(
        &self,
        p: Place,
        q: Place,
        most: f64,
        kinds: [ViewVertexKind; 2],
        piece: &Told,
        out: &mut Testimony,
    ) {
        let run = &self.runs[p.run as usize];
        if p.run != q.run || run.between(p.at, q.at) > most {
            return;
        }
        let (from, to, kinds) =
            if p.at <= q.at { (p.at, q.at, kinds) } else { (q.at, p.at, [kinds[1], kinds[0]]) };
        let told = Told { run: p.run, kinds, ..*piece };
        if run.closed && to - from > run.length() / 2.0 {
            // Over the seam.
            let inner = ViewVertexKind::Vertex;
            out.told.push(Told { from: to, to: run.length(), kinds: [kinds[1], inner], ..told });
            out.told.push(Told { from: 0.0, to: from, kinds: [inner, kinds[0]], ..told });
        } else {
            out.told.push(Told { from, to, ..told });
        }
    }

    /// The nearest place of a curve that may stand for a witness at a point of it.
    pub fn place(&self, witness: &ImageSegment, p: DVec3) -> Option<Place> {
        match witness.role {
            Role::Witness { convex, .. } => self.nearest(witness, convex, p),
            _ => None,
        }
    }

    fn nearest(&self, witness: &ImageSegment, convex: bool, p: DVec3) -> Option<Place> {
        let normal = |face: u32| Vec3::from_array(self.mesh.face_normals[face as usize]);
        let outward = (normal(witness.hosts[0]) + normal(witness.hosts[1])).normalize_or_zero();
        let body = |face: u32| self.mesh.body(face);
        let (depth, own_body) = (self.view.frame.depth_of(p.z), body(witness.hosts[0]));
        let reach_own = self.reach(witness.hosts[0]).max(self.reach(witness.hosts[1]));
        let per_px =
            if self.view.frame.perspective { depth.abs() } else { 1.0 } / self.view.frame.scale * self.px;
        let mut best: Option<(f64, Place)> = None;
        self.each_near(p, REACH_PX * self.px, |away, r, k, place| {
            if best.as_ref().is_some_and(|(least, other)| {
                away.total_cmp(least).then(r.cmp(&other.run)).then(place.total_cmp(&other.at)).is_ge()
            }) {
                return;
            }
            let run = &self.runs[r as usize];
            let curve = &self.segments[run.segments[k] as usize];
            let host = curve.hosts[0];
            if run.backward[k] == convex
                || body(host) != own_body
                || outward.dot(normal(host)) < SAME_SIDE_COSINE
            {
                return;
            }
            let t = (place - run.starts[k]) / (run.starts[k + 1] - run.starts[k]).max(f64::MIN_POSITIVE);
            let gap = (self.view.frame.depth_of(curve.at(t).z) - depth).abs();
            if gap <= DEPTH_OF_FACES * (reach_own + self.reach(host)) + DEPTH_PX * per_px {
                best = Some((away, Place { run: r, at: place }));
            }
        });
        best.map(|(_, place)| place)
    }

    /// Whether any seen part of a curve passes by a point of the image as near as ink is. `is_seen`
    /// tells of a run and a place along it.
    pub fn is_inked(&self, p: DVec3, is_seen: impl Fn(u32, f64) -> bool) -> bool {
        let mut inked = false;
        self.each_near(p, INK_PX * self.px, |_, r, _, place| inked = inked || is_seen(r, place));
        inked
    }

    /// Calls `visit(squared distance, run, index in it, place along it)` for the nearest points of
    /// all pieces of curves within a distance.
    fn each_near(&self, p: DVec3, reach: f64, mut visit: impl FnMut(f64, u32, usize, f64)) {
        let Sought { grid, pieces } = &self.sought;
        for (tile, _) in grid.tiles_of(grid.tile_box(p - reach, p + reach)) {
            for (r, k) in pieces.of(tile) {
                let run = &self.runs[*r as usize];
                let segment = &self.segments[run.segments[*k as usize] as usize];
                let (a, along) = (segment.a.truncate(), (segment.b - segment.a).truncate());
                let squared = along.length_squared();
                let way = (p.truncate() - a).dot(along);
                let t = if squared > 0.0 { (way / squared).clamp(0.0, 1.0) } else { 0.0 };
                let away = (a + along * t).distance_squared(p.truncate());
                if away <= reach * reach {
                    let k = *k as usize;
                    visit(away, *r, k, run.starts[k] + (run.starts[k + 1] - run.starts[k]) * t);
                }
            }
        }
    }

    /// The longest side of a face, world units.
    fn reach(&self, face: u32) -> f64 {
        let [a, b, c] = self.mesh.corners(FaceId(face));
        a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a)).sqrt()
    }
}

/// A seen piece, cut where background begins or ends beside it.
fn backed_pieces(whole: &Told, backed: &[Interval]) -> Vec<Told> {
    let mut pieces = Vec::with_capacity(1);
    let mut at = whole.from;
    let inner = ViewVertexKind::Backdrop;
    let mut push = |from: f64, to: f64, silhouette: bool| {
        if to > from {
            let kinds = [
                if from > whole.from { inner } else { whole.kinds[0] },
                if to < whole.to { inner } else { whole.kinds[1] },
            ];
            pieces.push(Told { from, to, kinds, silhouette, ..*whole });
        }
    };
    for interval in backed {
        let (from, to) = (interval.start.max(at), interval.end.min(whole.to));
        if to > from {
            push(at, from, true);
            push(from, to, false);
            at = to;
        }
    }
    push(at, whole.to, true);
    pieces
}
