//! From decided segments to the [`ViewMap`]: nodes by identity, pieces between them.

use kurbo::Point;

use super::doubles;
use super::graph::{ViewEdge, ViewMap, ViewVertex, ViewVertexId, ViewVertexKind};
use super::layers::{self, Layer};
use super::limits::Limits;
use super::needles;
use super::occlude::Interval;
use super::project::{ImageSegment, project};
use super::rounded::{self, Rounded, Smooth};
use super::view_covers::ViewCovers;
use super::visibility::{self, Visibility, decide_with};
use crate::lines::{FeatureLines, FeatureSegment, HiddenLines, LineKind, LineOptions, Role};
use crate::mesh::Mesh;
use crate::view::View;

const UNSET: u32 = u32::MAX;

/// Which hidden pieces a view map keeps beside the visible ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum HiddenPieces {
    /// All, with their counts.
    All,
    /// Those of contours, from which chains tell a line that ducks under a fold from one that
    /// ends.
    Contours,
}

/// Builds the view map of all feature lines.
#[must_use]
pub fn build(mesh: &Mesh, view: &View, lines: &FeatureLines, options: &LineOptions) -> ViewMap {
    build_with(mesh, view, lines, options, None)
}

/// The same with the help of covers that were made of the view before.
#[must_use]
pub fn build_with(
    mesh: &Mesh,
    view: &View,
    lines: &FeatureLines,
    options: &LineOptions,
    covers: Option<&ViewCovers>,
) -> ViewMap {
    let asked = Asked::new(mesh, view, lines, options);
    let told = asked.decide(mesh, covers);
    asked.map(&told, None)
}

/// Builds the view map of all feature lines in front of a mesh some of whose faces one sees through, and that of what is seen of
/// them through these faces alone: `clear` is the same mesh, but that those faces hide nothing.
#[must_use]
pub fn build_through(
    mesh: &Mesh,
    clear: &Mesh,
    view: &View,
    lines: &FeatureLines,
    options: &LineOptions,
) -> [ViewMap; 2] {
    let options = LineOptions { hidden: HiddenLines::None, ..options.clone() };
    let asked = Asked::new(mesh, view, lines, &options);
    let (front, behind) = (asked.decide(mesh, None), asked.decide(clear, None));
    [asked.map(&behind, None), asked.map(&behind, Some(&front))]
}

/// The view map of what is seen of plain lines, of which is known what is hidden.
pub(super) fn of_hidden(
    mesh: &Mesh,
    view: &View,
    lines: &FeatureLines,
    segments: &[ImageSegment],
    hidden: &[Vec<Layer>],
) -> ViewMap {
    let limits = Limits::new(&view.frame);
    let mut builder = Builder::new(mesh, view, lines, HiddenPieces::Contours);
    for (segment, hidden) in segments.iter().zip(hidden) {
        builder.add(segment, Seen { hidden, backed: &[] }, limits.piece, true);
    }
    let mut map = builder.map;
    doubles::remove(&mut map, limits.double, view.frame.perspective, &mesh.extents);
    map
}

/// Lines in the image, of which visibility is asked.
struct Asked<'a> {
    mesh: &'a Mesh,
    view: &'a View,
    lines: &'a FeatureLines,
    limits: Limits,
    segments: Vec<ImageSegment>,
    hidden: HiddenPieces,
}

/// What is seen of them, with a mesh before them.
struct Told {
    seen: Visibility,
    rounded: Rounded,
}

impl<'a> Asked<'a> {
    fn new(mesh: &'a Mesh, view: &'a View, lines: &'a FeatureLines, options: &LineOptions) -> Self {
        let segments = project(mesh, view, lines);
        let none = options.hidden == HiddenLines::None;
        let hidden = if none { HiddenPieces::Contours } else { HiddenPieces::All };
        Self { mesh, view, lines, limits: Limits::new(&view.frame), segments, hidden }
    }

    fn decide(&self, mesh: &Mesh, covers: Option<&ViewCovers>) -> Told {
        let Self { view, lines, limits, segments, .. } = self;
        let counting = self.hidden == HiddenPieces::All;
        let is_round = segments.iter().any(|s| s.role != Role::Line);
        let (seen, smooth) = rayon::join(
            || decide_with(mesh, view, segments, limits, counting, covers),
            || is_round.then(|| Smooth::new(lines, segments, limits)),
        );
        let rounded = smooth.map_or_else(Rounded::default, |smooth| {
            rounded::decide(self.mesh, view, smooth, segments, &seen, limits, counting)
        });
        Told { seen, rounded }
    }

    /// The map of what is seen; or of what is seen so, but not with another mesh before it.
    fn map(&self, told: &Told, but: Option<&Told>) -> ViewMap {
        let Self { mesh, view, lines, limits, .. } = self;
        let (mut map, needles) = rayon::join(
            || self.map_with_doubles(told, but),
            || needles::find(mesh, view, lines, &self.segments),
        );
        map.tests = told.seen.tests;
        map.contours = told.rounded.counts;
        map.seen_contours = told.rounded.seen.clone();
        map.needles = needles;
        doubles::remove(&mut map, limits.double, view.frame.perspective, &mesh.extents);
        map
    }

    fn map_with_doubles(&self, told: &Told, but: Option<&Told>) -> ViewMap {
        let mut builder = Builder::new(self.mesh, self.view, self.lines, self.hidden);
        // What grows by doubling is copied again and again; most lines are drawn whole, where anything is.
        let is_drawn = |(i, segment): &(usize, &ImageSegment)| {
            told.draws(*i, segment.role) && told.of(*i, segment.role).hidden != visibility::BURIED
        };
        let drawn = self.segments.iter().enumerate().filter(is_drawn).count();
        builder.map.edges.reserve(drawn);
        builder.map.vertices.reserve(drawn + drawn / 8);
        for (i, segment) in self.segments.iter().enumerate() {
            let seen = told.of(i, segment.role);
            let mut drawn = told.draws(i, segment.role);
            let left;
            let seen = match but {
                None => seen,
                Some(but) => {
                    let front = but.of(i, segment.role);
                    let front = if but.draws(i, segment.role) { front.hidden } else { &visibility::BURIED };
                    drawn &= !front.is_empty();
                    left = layers::only_behind(front, seen.hidden);
                    Seen { hidden: &left, backed: seen.backed }
                }
            };
            if drawn {
                builder.add(segment, seen, self.limits.piece, but.is_some());
            }
        }
        builder.map
    }
}

impl Told {
    /// Whether anything of a segment may be drawn.
    fn draws(&self, segment: usize, role: Role) -> bool {
        role == Role::Line || self.rounded.is_drawn(segment, role)
    }

    /// What is known of a segment.
    fn of(&self, segment: usize, role: Role) -> Seen<'_> {
        if role == Role::Line {
            return Seen { hidden: self.seen.hidden(segment), backed: self.seen.backed(segment) };
        }
        Seen { hidden: self.rounded.hidden.of(segment), backed: self.rounded.backed.of(segment) }
    }
}

struct Builder<'a> {
    mesh: &'a Mesh,
    view: &'a View,
    lines: &'a FeatureLines,
    map: ViewMap,
    vertex_of_end: Vec<u32>,
    hidden: HiddenPieces,
    /// The pieces of one segment, kept so that they are allocated once.
    pieces: Vec<SegmentPart>,
}

/// What visibility says of one segment.
#[derive(Clone, Copy)]
struct Seen<'a> {
    hidden: &'a [Layer],
    backed: &'a [Interval],
}

/// A piece of a segment between two parameters.
struct SegmentPart {
    start: f64,
    end: f64,
    end_kind: ViewVertexKind,
    invisibility: u16,
    silhouette: bool,
}

impl<'a> Builder<'a> {
    fn new(mesh: &'a Mesh, view: &'a View, lines: &'a FeatureLines, hidden: HiddenPieces) -> Self {
        let vertex_of_end = vec![UNSET; mesh.positions.len() + lines.points.len()];
        Self { mesh, view, lines, map: ViewMap::default(), vertex_of_end, hidden, pieces: Vec::new() }
    }

    /// Adds what is seen of a segment, and unless `only_seen` what is hidden as far as it is kept.
    fn add(&mut self, segment: &ImageSegment, seen: Seen, shortest: f64, only_seen: bool) {
        let source = &self.lines.segments[segment.source as usize];
        let is_witness = matches!(segment.role, Role::Witness { .. });
        let keeps_hidden = !is_witness
            && !only_seen
            && (self.hidden == HiddenPieces::All || source.kind == LineKind::Contour);
        // Of most lines behind walls nothing is left.
        if !keeps_hidden && seen.hidden == visibility::BURIED {
            return;
        }
        let mut pieces = std::mem::take(&mut self.pieces);
        cut_segment(segment, seen, source.kind == LineKind::Contour, shortest, &mut pieces);
        if keeps_hidden || pieces.iter().any(|p| p.invisibility == 0) {
            self.add_pieces(segment, &pieces, keeps_hidden);
        }
        self.pieces = pieces;
    }

    fn add_pieces(&mut self, segment: &ImageSegment, pieces: &[SegmentPart], keeps_hidden: bool) {
        let source = &self.lines.segments[segment.source as usize];
        let mut start: Option<ViewVertexId> = None;
        for (i, piece) in pieces.iter().enumerate() {
            if piece.invisibility > 0 && !keeps_hidden {
                start = None;
                continue;
            }
            let from = match start {
                Some(vertex) => vertex,
                None if i == 0 => self.end_vertex(segment, 0),
                None => self.cut_vertex(segment, piece.start, pieces[i - 1].end_kind),
            };
            let to = if i + 1 == pieces.len() {
                self.end_vertex(segment, 1)
            } else {
                self.cut_vertex(segment, piece.end, piece.end_kind)
            };
            self.map.edges.push(view_edge(source, segment.source, from, to, piece));
            start = Some(to);
        }
    }

    /// The node at an end of a segment: shared by all segments that end there.
    fn end_vertex(&mut self, segment: &ImageSegment, end: usize) -> ViewVertexId {
        let point = if end == 0 { segment.a } else { segment.b };
        let source = &self.lines.segments[segment.source as usize];
        let strength = self.lines.strength(self.mesh, source.ends[end]);
        if segment.cut[end] {
            return self.push_vertex(point, strength, ViewVertexKind::Frame);
        }
        let slot = segment.ends[end] as usize;
        if self.vertex_of_end[slot] == UNSET {
            self.vertex_of_end[slot] = self.map.vertices.len() as u32;
            self.push_vertex(point, strength, ViewVertexKind::Vertex);
        }
        ViewVertexId(self.vertex_of_end[slot])
    }

    fn cut_vertex(&mut self, segment: &ImageSegment, t: f64, kind: ViewVertexKind) -> ViewVertexId {
        let ends = self.lines.segments[segment.source as usize].ends;
        let [from, to] = ends.map(|end| self.lines.strength(self.mesh, end));
        self.push_vertex(segment.at(t), from + (to - from) * t as f32, kind)
    }

    fn push_vertex(&mut self, point: glam::DVec3, strength: f32, kind: ViewVertexKind) -> ViewVertexId {
        let id = ViewVertexId(self.map.vertices.len() as u32);
        let depth = self.view.frame.depth_of(point.z);
        self.map.vertices.push(ViewVertex { position: Point::new(point.x, point.y), depth, strength, kind });
        id
    }
}

fn view_edge(
    source: &FeatureSegment,
    segment: u32,
    start: ViewVertexId,
    end: ViewVertexId,
    piece: &SegmentPart,
) -> ViewEdge {
    ViewEdge {
        start,
        end,
        kind: source.kind,
        invisibility: piece.invisibility,
        silhouette: piece.silhouette,
        both_seen: source.both_seen,
        smooth: source.smooth,
        origin: source.origin,
        strength: source.strength,
        part: source.part,
        material: source.material,
        segment,
    }
}

/// Cuts a segment where its invisibility changes, and visible contours also where background
/// begins or ends behind them.
fn cut_segment(segment: &ImageSegment, seen: Seen, contour: bool, shortest: f64, out: &mut Vec<SegmentPart>) {
    let shortest = shortest / segment.length().max(shortest);
    out.clear();
    let mut at = 0.0;
    for layer in seen.hidden {
        let interval = &layer.interval;
        let start = if interval.start - at <= shortest { at } else { interval.start };
        if start > at {
            visible(out, seen, contour, at, start, interval.start_kind, shortest);
        }
        let end = if 1.0 - interval.end <= shortest { 1.0 } else { interval.end };
        out.push(SegmentPart {
            start,
            end,
            end_kind: interval.end_kind,
            invisibility: layer.count,
            silhouette: false,
        });
        at = end;
    }
    if at < 1.0 {
        visible(out, seen, contour, at, 1.0, ViewVertexKind::Vertex, shortest);
    }
}

fn visible(
    out: &mut Vec<SegmentPart>,
    seen: Seen,
    contour: bool,
    start: f64,
    end: f64,
    end_kind: ViewVertexKind,
    shortest: f64,
) {
    let mut push = |start: f64, end: f64, end_kind, silhouette| {
        out.push(SegmentPart { start, end, end_kind, invisibility: 0, silhouette });
    };
    let mut at = start;
    if contour {
        // A line that many thin things cross has many stretches, and as many others beside it.
        let first = seen.backed.partition_point(|backed| backed.end <= start);
        for backed in seen.backed[first..].iter().take_while(|backed| backed.start < end) {
            let (from, to) = (backed.start.max(at), backed.end.min(end));
            if to - from <= shortest {
                continue;
            }
            let from = if from - at <= shortest { at } else { from };
            let to = if end - to <= shortest { end } else { to };
            if from > at {
                push(at, from, ViewVertexKind::Backdrop, true);
            }
            let kind = if to < end { ViewVertexKind::Backdrop } else { end_kind };
            push(from, to, kind, false);
            at = to;
        }
    }
    if at < end {
        push(at, end, end_kind, contour);
    }
}
