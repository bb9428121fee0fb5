//! From decided segments to the [`ViewMap`]: nodes by identity, pieces between them.

use kurbo::Point;

use super::doubles;
use super::graph::{ViewEdge, ViewMap, ViewVertex, ViewVertexId, ViewVertexKind};
use super::layers::Layer;
use super::limits::Limits;
use super::occlude::Interval;
use super::project::{ImageSegment, project};
use super::rounded::{self, Rounded};
use super::visibility::decide;
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
    let limits = Limits::new(&view.frame);
    let segments = project(mesh, view, lines);
    let hidden = if options.hidden == HiddenLines::None { HiddenPieces::Contours } else { HiddenPieces::All };
    let counting = hidden == HiddenPieces::All;
    // Smooth contours are not asked themselves.
    let asked: Vec<u32> =
        (0..segments.len() as u32).filter(|i| segments[*i as usize].role != Role::Curve).collect();
    let questions: Vec<ImageSegment> = asked.iter().map(|i| segments[*i as usize]).collect();
    let seen = decide(mesh, view, &questions, &limits, counting);
    let is_rounded = segments.iter().any(|s| s.role != Role::Line);
    let rounded = if is_rounded {
        rounded::decide(mesh, view, lines, &segments, (&seen, &asked), &limits, counting)
    } else {
        Rounded::default()
    };
    let mut builder = Builder {
        mesh,
        view,
        lines,
        map: ViewMap::default(),
        vertex_of_end: vec![UNSET; mesh.positions.len() + lines.points.len()],
        hidden,
    };
    let (mut layers, mut beside): (Vec<Layer>, Vec<Interval>) = (Vec::new(), Vec::new());
    let mut question = 0;
    for (i, segment) in segments.iter().enumerate() {
        let seen_here = if segment.role == Role::Line {
            Seen { hidden: seen.hidden(question), backed: seen.backed(question) }
        } else {
            layers.clear();
            layers.extend(rounded.hidden(i as u32));
            beside.clear();
            beside.extend(rounded.backed(i as u32));
            Seen { hidden: &layers, backed: &beside }
        };
        if segment.role == Role::Line || rounded.is_drawn(i as u32, segment.role) {
            builder.add(segment, seen_here, limits.piece);
        }
        question += usize::from(segment.role != Role::Curve);
    }
    let mut map = builder.map;
    map.tests = seen.tests;
    map.contours = rounded.counts;
    map.seen_contours = rounded.seen;
    doubles::remove(&mut map, limits.double, view.frame.perspective, &mesh.extents);
    map
}

struct Builder<'a> {
    mesh: &'a Mesh,
    view: &'a View,
    lines: &'a FeatureLines,
    map: ViewMap,
    vertex_of_end: Vec<u32>,
    hidden: HiddenPieces,
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

impl Builder<'_> {
    fn add(&mut self, segment: &ImageSegment, seen: Seen, shortest: f64) {
        let source = &self.lines.segments[segment.source as usize];
        let is_witness = matches!(segment.role, Role::Witness { .. });
        let keeps_hidden =
            !is_witness && (self.hidden == HiddenPieces::All || source.kind == LineKind::Contour);
        let pieces = pieces(segment, seen, source.kind == LineKind::Contour, shortest);
        if !keeps_hidden && pieces.iter().all(|p| p.invisibility > 0) {
            return;
        }
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
fn pieces(segment: &ImageSegment, seen: Seen, contour: bool, shortest: f64) -> Vec<SegmentPart> {
    let shortest = shortest / segment.length().max(shortest);
    let mut out = Vec::with_capacity(1);
    let mut at = 0.0;
    for layer in seen.hidden {
        let interval = &layer.interval;
        let start = if interval.start - at <= shortest { at } else { interval.start };
        if start > at {
            visible(&mut out, seen, contour, at, start, interval.start_kind, shortest);
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
        visible(&mut out, seen, contour, at, 1.0, ViewVertexKind::Vertex, shortest);
    }
    out
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
        for backed in seen.backed {
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
