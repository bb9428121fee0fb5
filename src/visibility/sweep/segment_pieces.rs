//! [`CutSegments`]: segments cut into visible and hidden pieces.

use super::segment_visibility;
use crate::lines::Role;
use crate::visibility::graph::ViewVertexKind;
use crate::visibility::occlusion::interval_sweep::HiddenInterval;
use crate::visibility::occlusion::triangle_occlusion::Interval;
use crate::visibility::projection::image_segments::ImageSegment;

/// Hidden and backed intervals of one segment.
#[derive(Clone, Copy)]
pub(crate) struct SegmentOcclusion<'a> {
    pub hidden: &'a [HiddenInterval],
    pub non_silhouette: &'a [Interval],
}

/// Piece of a segment between two parameters.
pub(crate) struct SegmentPart {
    pub start: f64,
    pub end: f64,
    pub end_kind: ViewVertexKind,
    pub invisibility: u16,
    pub silhouette: bool,
}

/// Segments with at least one kept piece, in order, and their pieces one after the other.
#[derive(Default)]
pub(crate) struct CutSegments {
    pub segments: Vec<CutSegment>,
    pub pieces: Vec<SegmentPart>,
}

/// Cut segment: its index and its number of pieces.
pub(crate) struct CutSegment {
    pub segment: usize,
    pub count: usize,
    pub keeps_hidden: bool,
}

impl CutSegments {
    /// Cuts a segment and keeps it, unless nothing of it is visible and hidden pieces are not kept.
    pub(crate) fn add(
        &mut self,
        id: usize,
        segment: &ImageSegment,
        occlusion: SegmentOcclusion,
        shortest: f64,
        keeps_hidden: bool,
    ) {
        // Most lines behind walls are hidden throughout.
        if !keeps_hidden && occlusion.hidden == segment_visibility::FULLY_HIDDEN {
            return;
        }
        let first = self.pieces.len();
        // The background next to a smooth contour comes from the mesh contour matched to it.
        let bounds = segment.bounds || segment.role == Role::SmoothContour;
        cut_segment(segment, occlusion, bounds, shortest, &mut self.pieces);
        if keeps_hidden || self.pieces[first..].iter().any(|p| p.invisibility == 0) {
            self.segments.push(CutSegment { segment: id, count: self.pieces.len() - first, keeps_hidden });
        } else {
            self.pieces.truncate(first);
        }
    }
}

/// Cuts a segment where its invisibility changes.
///
/// If it `bounds` a surface, the visible parts are also cut where background begins or ends next to them.
fn cut_segment(
    segment: &ImageSegment,
    occlusion: SegmentOcclusion,
    bounds: bool,
    shortest: f64,
    out: &mut Vec<SegmentPart>,
) {
    let shortest = shortest / segment.length().max(shortest);
    let mut at = 0.0;
    for layer in occlusion.hidden {
        let interval = &layer.interval;
        let start = if interval.start - at <= shortest { at } else { interval.start };
        if start > at {
            visible(out, occlusion, bounds, at, start, interval.start_kind, shortest);
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
        visible(out, occlusion, bounds, at, 1.0, ViewVertexKind::Vertex, shortest);
    }
}

fn visible(
    out: &mut Vec<SegmentPart>,
    occlusion: SegmentOcclusion,
    bounds: bool,
    start: f64,
    end: f64,
    end_kind: ViewVertexKind,
    shortest: f64,
) {
    let mut push = |start: f64, end: f64, end_kind, silhouette| {
        out.push(SegmentPart { start, end, end_kind, invisibility: 0, silhouette });
    };
    let mut at = start;
    if bounds {
        // A line behind many thin parts has many visible pieces and many backed intervals, hence the binary
        // search.
        let first = occlusion.non_silhouette.partition_point(|backed| backed.end <= start);
        for backed in occlusion.non_silhouette[first..].iter().take_while(|backed| backed.start < end) {
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
        push(at, end, end_kind, bounds);
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    const KIND: ViewVertexKind = ViewVertexKind::TJunction;

    fn interval(start: f64, end: f64) -> Interval {
        Interval { start, end, start_kind: KIND, end_kind: KIND }
    }

    fn hidden_interval(start: f64, end: f64, count: u16) -> HiddenInterval {
        HiddenInterval { interval: interval(start, end), count }
    }

    /// Start, end, layers in front and silhouette flag of each piece of each kept segment.
    fn kept_pieces(
        bounds: bool,
        keeps_hidden: bool,
        hidden: &[&[HiddenInterval]],
    ) -> Vec<Vec<(f64, f64, u16, bool)>> {
        let segment = ImageSegment {
            a: DVec3::ZERO,
            b: DVec3::new(100.0, 0.0, 0.0),
            ends: [0, 1],
            cut: [false; 2],
            hosts: [0, 1],
            source: 0,
            bounds,
            role: Role::Line,
        };
        let mut cuts = CutSegments::default();
        for (id, hidden) in hidden.iter().enumerate() {
            cuts.add(
                id,
                &segment,
                SegmentOcclusion { hidden, non_silhouette: &[interval(0.7, 0.8)] },
                0.1,
                keeps_hidden,
            );
        }
        let mut remaining = cuts.pieces.as_slice();
        let pieces = |cut: &CutSegment| {
            let cut_pieces;
            (cut_pieces, remaining) = remaining.split_at(cut.count);
            assert_eq!(cut.keeps_hidden, keeps_hidden);
            cut_pieces
                .iter()
                .map(|piece| (piece.start, piece.end, piece.invisibility, piece.silhouette))
                .collect()
        };
        let all = cuts.segments.iter().map(pieces).collect();
        assert!(remaining.is_empty());
        all
    }

    #[test]
    fn segments_are_cut_at_hidden_intervals_and_silhouette_ends() {
        let hidden: [&[HiddenInterval]; 1] = [&[hidden_interval(0.2, 0.6, 2)]];
        let inner = [(0.0, 0.2, 0, false), (0.2, 0.6, 2, false), (0.6, 1.0, 0, false)];
        assert_eq!(kept_pieces(false, false, &hidden), [inner]);
        let outline = [
            (0.0, 0.2, 0, true),
            (0.2, 0.6, 2, false),
            (0.6, 0.7, 0, true),
            (0.7, 0.8, 0, false),
            (0.8, 1.0, 0, true),
        ];
        assert_eq!(kept_pieces(true, true, &hidden), [outline]);
    }

    #[test]
    fn fully_hidden_segments_are_kept_only_on_request() {
        let hidden: [&[HiddenInterval]; 4] = [
            &segment_visibility::FULLY_HIDDEN,
            &[],
            &[hidden_interval(0.0, 0.5, 1), hidden_interval(0.5, 1.0, 2)],
            &[hidden_interval(0.0, 0.9995, 3)],
        ];
        let visible_piece = (0.0, 1.0, 0, false);
        assert_eq!(kept_pieces(false, false, &hidden), [[visible_piece]]);
        let found = kept_pieces(false, true, &hidden);
        assert_eq!(found[0], [(0.0, 1.0, 1, false)]);
        assert_eq!(found[1], [visible_piece]);
        assert_eq!(found[2], [(0.0, 0.5, 1, false), (0.5, 1.0, 2, false)]);
        assert_eq!(found[3], [(0.0, 1.0, 3, false)]);
    }
}
