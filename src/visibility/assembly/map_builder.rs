//! [`ViewMap`] built from segments of known visibility: vertices shared by identity, and the pieces between
//! them.

use crate::parallel::prelude::*;
use kurbo::Point;

use crate::lines::{FeatureLines, FeatureSegment, HiddenLines, LineKind, LineOptions, Role};
use crate::mesh::Mesh;
use crate::view::View;
use crate::visibility::contours::contour_visibility::{self, ContourVisibility, SmoothContours};
use crate::visibility::contours::thin_folds;
use crate::visibility::culling::view_occlusion::ViewOcclusionBuffer;
use crate::visibility::graph::{ViewEdge, ViewMap, ViewVertex, ViewVertexId, ViewVertexKind};
use crate::visibility::occlusion::interval_sweep::{self, HiddenInterval};
use crate::visibility::overlap::coincident_lines;
use crate::visibility::projection::image_segments::{ImageSegment, project};
use crate::visibility::sweep::segment_pieces::{CutSegments, SegmentOcclusion, SegmentPart};
use crate::visibility::sweep::segment_visibility::{self, SegmentVisibility, decide_with};
use crate::visibility::view_tolerances::ViewTolerances;

const NO_VERTEX: u32 = u32::MAX;

/// Segments per task of the cutting step.
const SEGMENTS_PER_TASK: usize = 1 << 10;

/// Hidden pieces that a view map keeps in addition to the visible ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum HiddenPieces {
    /// All of them, with their layer counts.
    All,
    /// Those of contours. Chaining needs them to distinguish a line that continues under a fold from one that
    /// ends.
    Contours,
}

/// Builds the view map of all feature lines.
#[must_use]
pub(crate) fn build(mesh: &Mesh, view: &View, lines: &FeatureLines, options: &LineOptions) -> ViewMap {
    build_with(mesh, view, lines, options, None)
}

/// Like [`build`], with an occlusion buffer of the view that was made earlier.
#[must_use]
pub(crate) fn build_with(
    mesh: &Mesh,
    view: &View,
    lines: &FeatureLines,
    options: &LineOptions,
    covers: Option<&ViewOcclusionBuffer>,
) -> ViewMap {
    let projected = ProjectedLines::new(mesh, view, lines, options);
    let line_visibility = projected.decide(mesh, covers);
    projected.map(&line_visibility, None)
}

/// Builds two view maps of a mesh with see-through faces: all visible lines, and the parts visible only
/// through those faces.
///
/// `clear` is the same mesh, but its see-through faces hide nothing.
#[must_use]
pub(crate) fn build_through(
    mesh: &Mesh,
    clear: &Mesh,
    view: &View,
    lines: &FeatureLines,
    options: &LineOptions,
) -> [ViewMap; 2] {
    let options = LineOptions { hidden: HiddenLines::None, ..options.clone() };
    let projected = ProjectedLines::new(mesh, view, lines, &options);
    let (front, behind) = (projected.decide(mesh, None), projected.decide(clear, None));
    [projected.map(&behind, None), projected.map(&behind, Some(&front))]
}

/// Builds the view map of plain lines whose hidden intervals are given.
pub(crate) fn of_hidden(
    mesh: &Mesh,
    view: &View,
    lines: &FeatureLines,
    segments: &[ImageSegment],
    hidden: &[Vec<HiddenInterval>],
) -> ViewMap {
    let limits = ViewTolerances::new(&view.frame);
    let mut cuts = CutSegments::default();
    for (id, (segment, hidden)) in segments.iter().zip(hidden).enumerate() {
        cuts.add(id, segment, SegmentOcclusion { hidden, non_silhouette: &[] }, limits.piece, false);
    }
    let mut builder = MapBuilder::new(mesh, view, lines);
    builder.add_all(segments, &cuts);
    let mut map = builder.map;
    coincident_lines::remove_coincident(&mut map, limits.double, &view.frame, &mesh.extents);
    map
}

/// Projected lines of a view, whose visibility can be computed.
struct ProjectedLines<'a> {
    mesh: &'a Mesh,
    view: &'a View,
    lines: &'a FeatureLines,
    limits: ViewTolerances,
    segments: Vec<ImageSegment>,
    hidden: HiddenPieces,
}

/// Visibility of the lines with a given mesh in front of them.
struct LineVisibility {
    segment_visibility: SegmentVisibility,
    rounded: ContourVisibility,
}

impl<'a> ProjectedLines<'a> {
    fn new(mesh: &'a Mesh, view: &'a View, lines: &'a FeatureLines, options: &LineOptions) -> Self {
        let segments = project(mesh, view, lines);
        let none = options.hidden == HiddenLines::None;
        let hidden = if none { HiddenPieces::Contours } else { HiddenPieces::All };
        Self { mesh, view, lines, limits: ViewTolerances::new(&view.frame), segments, hidden }
    }

    fn decide(&self, mesh: &Mesh, covers: Option<&ViewOcclusionBuffer>) -> LineVisibility {
        let Self { view, lines, limits, segments, .. } = self;
        let counting = self.hidden == HiddenPieces::All;
        let is_round = segments.iter().any(|s| s.role != Role::Line);
        let (visibility, smooth) = crate::parallel::join(
            || decide_with(mesh, view, segments, limits, counting, covers),
            || is_round.then(|| SmoothContours::new(lines, segments, limits)),
        );
        let rounded = smooth.map_or_else(ContourVisibility::default, |smooth| {
            contour_visibility::decide_contours(
                self.mesh,
                view,
                smooth,
                segments,
                &visibility,
                limits,
                counting,
            )
        });
        LineVisibility { segment_visibility: visibility, rounded }
    }

    /// Builds the map of the visible pieces. With `but`, only of pieces that are not visible with that other
    /// mesh.
    fn map(&self, line_visibility: &LineVisibility, but: Option<&LineVisibility>) -> ViewMap {
        let Self { mesh, view, lines, limits, .. } = self;
        let (mut map, fold_segments) = crate::parallel::join(
            || self.map_with_doubles(line_visibility, but),
            || thin_folds::find_thin_folds(mesh, view, lines, &self.segments),
        );
        map.tests = line_visibility.segment_visibility.tests;
        map.contours = line_visibility.rounded.counts;
        map.visible_contours = line_visibility.rounded.visible_mesh_contours.clone();
        map.thin_folds = fold_segments;
        coincident_lines::remove_coincident(&mut map, limits.double, &view.frame, &mesh.extents);
        map
    }

    fn map_with_doubles(
        &self,
        line_visibility: &LineVisibility,
        front_visibility: Option<&LineVisibility>,
    ) -> ViewMap {
        let ids: Vec<usize> = (0..self.segments.len()).step_by(SEGMENTS_PER_TASK).collect();
        let cuts: Vec<CutSegments> = ids
            .into_par_iter()
            .with_max_len(1)
            .map(|first| self.cuts(first, line_visibility, front_visibility))
            .collect();
        let mut builder = MapBuilder::new(self.mesh, self.view, self.lines);
        // Reserved up front to avoid repeated copying. Most kept segments have a single piece.
        let drawn = cuts.iter().map(|cuts| cuts.segments.len()).sum::<usize>();
        builder.map.edges.reserve(drawn);
        builder.map.vertices.reserve(drawn + drawn / 8);
        cuts.iter().for_each(|cuts| builder.add_all(&self.segments, cuts));
        builder.map
    }

    /// Cuts one task's share of the segments, from `first` on, and keeps those with anything to draw.
    fn cuts(
        &self,
        first: usize,
        line_visibility: &LineVisibility,
        front_visibility: Option<&LineVisibility>,
    ) -> CutSegments {
        let mut cuts = CutSegments::default();
        let end = (first + SEGMENTS_PER_TASK).min(self.segments.len());
        for (i, segment) in (first..end).zip(&self.segments[first..end]) {
            let full_occlusion = line_visibility.occlusion_of(i, segment.role);
            let mut drawn = line_visibility.draws(i, segment.role);
            let remaining;
            let occlusion = match front_visibility {
                None => full_occlusion,
                Some(front_lines) => {
                    let front = front_lines.occlusion_of(i, segment.role);
                    let front = if front_lines.draws(i, segment.role) {
                        front.hidden
                    } else {
                        &segment_visibility::FULLY_HIDDEN
                    };
                    drawn &= !front.is_empty();
                    remaining = interval_sweep::only_behind(front, full_occlusion.hidden);
                    SegmentOcclusion { hidden: &remaining, non_silhouette: full_occlusion.non_silhouette }
                }
            };
            if drawn {
                let source = &self.lines.segments[segment.source as usize];
                let keeps_hidden =
                    front_visibility.is_none() && keeps_hidden(self.hidden, segment, source.kind);
                cuts.add(i, segment, occlusion, self.limits.piece, keeps_hidden);
            }
        }
        cuts
    }
}

/// Whether the hidden parts of a segment are kept in addition to the visible ones.
fn keeps_hidden(hidden: HiddenPieces, segment: &ImageSegment, kind: LineKind) -> bool {
    let is_witness = matches!(segment.role, Role::MeshContour { .. });
    !is_witness && (hidden == HiddenPieces::All || kind == LineKind::Contour)
}

impl LineVisibility {
    /// Whether any part of a segment may be drawn.
    fn draws(&self, segment: usize, role: Role) -> bool {
        role == Role::Line || self.rounded.is_drawn(segment, role)
    }

    /// Hidden and backed intervals of a segment.
    fn occlusion_of(&self, segment: usize, role: Role) -> SegmentOcclusion<'_> {
        if role == Role::Line {
            return SegmentOcclusion {
                hidden: self.segment_visibility.hidden(segment),
                non_silhouette: self.segment_visibility.backed(segment),
            };
        }
        SegmentOcclusion {
            hidden: self.rounded.hidden.of(segment),
            non_silhouette: self.rounded.non_silhouette.of(segment),
        }
    }
}

struct MapBuilder<'a> {
    mesh: &'a Mesh,
    view: &'a View,
    lines: &'a FeatureLines,
    map: ViewMap,
    vertex_of_end: Vec<u32>,
}

impl<'a> MapBuilder<'a> {
    fn new(mesh: &'a Mesh, view: &'a View, lines: &'a FeatureLines) -> Self {
        let vertex_of_end = vec![NO_VERTEX; mesh.positions.len() + lines.points.len()];
        let map = ViewMap { bodies: mesh.bodies.clone(), ..ViewMap::default() };
        Self { mesh, view, lines, map, vertex_of_end }
    }

    /// Adds the pieces of all cut segments.
    fn add_all(&mut self, segments: &[ImageSegment], cuts: &CutSegments) {
        let mut pieces = cuts.pieces.as_slice();
        for cut in &cuts.segments {
            let cut_pieces;
            (cut_pieces, pieces) = pieces.split_at(cut.count);
            self.add(&segments[cut.segment], cut_pieces, cut.keeps_hidden);
        }
    }

    /// Adds the visible pieces of a segment, and with `keeps_hidden` the hidden ones.
    fn add(&mut self, segment: &ImageSegment, pieces: &[SegmentPart], keeps_hidden: bool) {
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

    /// Vertex at an end of a segment, shared by all segments that end there.
    fn end_vertex(&mut self, segment: &ImageSegment, end: usize) -> ViewVertexId {
        let point = if end == 0 { segment.a } else { segment.b };
        let source = &self.lines.segments[segment.source as usize];
        let strength = self.lines.strength(self.mesh, source.ends[end]);
        if segment.cut[end] {
            return self.push_vertex(point, strength, ViewVertexKind::Frame);
        }
        let slot = segment.ends[end] as usize;
        if self.vertex_of_end[slot] == NO_VERTEX {
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
        // With background on one side, only one of the two surfaces is visible.
        both_seen: source.both_seen && !piece.silhouette,
        smooth: source.smooth,
        origin: source.origin,
        strength: source.strength,
        part: source.part,
        material: source.material,
        segment,
    }
}
