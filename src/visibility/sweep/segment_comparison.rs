//! Comparison of one segment part with the triangles of its tile.

use crate::visibility::culling::longest_interval::{NO_INTERVAL, join_or_longer};
use crate::visibility::occlusion::occlusion_input::{OcclusionInput, TileSegment};
use crate::visibility::occlusion::outer_sides::{OuterSide, OuterSides, backdrop, common};
use crate::visibility::occlusion::tiled_triangles::{OccluderBounds, corners};
use crate::visibility::occlusion::triangle_occlusion::{Interval, covered_range, hidden_range};
use crate::visibility::projection::image_segments::ImageSegment;

/// Triangles of a tile to compare.
#[derive(Clone, Copy)]
pub(crate) struct TriangleChoice<'a> {
    pub(crate) chosen: &'a [OccluderBounds],
    /// Whether they are sorted, nearest first.
    pub(crate) ordered: bool,
}

impl OcclusionInput<'_> {
    /// Collects the intervals of a segment part that triangles hide.
    ///
    /// Returns true if one triangle, or several that join, hide all of it and counts are not needed.
    #[inline(never)]
    pub(crate) fn gather_hidden(
        &self,
        segment: &ImageSegment,
        item: &TileSegment,
        entries: TriangleChoice,
        hidden: &mut Vec<Interval>,
        tests: &mut u64,
    ) -> bool {
        let OcclusionInput { triangles, limits, counting, .. } = *self;
        let (p, q) = (segment.at(item.start), segment.at(item.end));
        let (low, high) = (p.min(q), p.max(q));
        let bounds = [
            (low.x as f32).next_down(),
            (high.x as f32).next_up(),
            (low.y as f32).next_down(),
            (high.y as f32).next_up(),
        ];
        let farthest = (low.z as f32).next_down();
        let mut run = NO_INTERVAL;
        for reach in entries.chosen {
            if reach.nearest < farthest {
                if entries.ordered {
                    break;
                }
                continue;
            }
            let b = &reach.bounds;
            if b[0] > bounds[1] || b[1] < bounds[0] || b[2] > bounds[3] || b[3] < bounds[2] {
                continue;
            }
            if triangles.mesh.touches(segment.hosts, triangles.face(reach.id)) {
                continue;
            }
            *tests += 1;
            let (part, view) = ((item.start, item.end), triangles.view);
            let (corners, _) = corners(triangles.mesh, view, reach.id);
            // Most triangles cover nothing of the part, so only the others are read completely.
            let found = covered_range(segment, part, &corners, limits).and_then(|range| {
                hidden_range(segment, part, range, &triangles.occluder(reach.id), &view.frame, limits)
            });
            let Some(found) = found else { continue };
            hidden.push(found);
            if !counting {
                run = join_or_longer(run, (found.start, found.end));
                if run.0 <= item.start && run.1 >= item.end {
                    return true;
                }
            }
        }
        false
    }

    /// Collects the parts of a segment without background next to them: a surface lies next to each of its
    /// open sides.
    #[inline(never)]
    pub(crate) fn gather_backed(
        &self,
        segment: &ImageSegment,
        item: &TileSegment,
        entries: TriangleChoice,
        backed: &mut Vec<(u32, Interval)>,
    ) {
        let sides = OuterSides::of(segment, self.triangles);
        let mut open = sides.open();
        match (open.next(), open.next()) {
            (None, _) => backed.push((item.segment, backdrop(item.start, item.end))),
            (Some(side), None) => self.gather_backdrop(side, item, entries, backed),
            (Some(first), Some(second)) => {
                let [first, second] = [first, second].map(|side| {
                    let mut found = Vec::new();
                    self.gather_backdrop(side, item, entries, &mut found);
                    found.into_iter().map(|(_, interval)| interval).collect()
                });
                backed.extend(common(first, second).map(|(start, end)| (item.segment, backdrop(start, end))));
            }
        }
    }

    /// Collects the ranges where a surface lies next to a segment on one side.
    fn gather_backdrop(
        &self,
        side: &OuterSide,
        item: &TileSegment,
        entries: TriangleChoice,
        backed: &mut Vec<(u32, Interval)>,
    ) {
        let OcclusionInput { triangles, segments, limits, .. } = *self;
        let segment = &segments[item.segment as usize];
        let beside = side.shifted_ends(segment.at(item.start), segment.at(item.end));
        let (low, high) = (beside[0].min(beside[1]), beside[0].max(beside[1]));
        let mut run = NO_INTERVAL;
        for entry in entries.chosen {
            // The range is already complete.
            if run.0 <= item.start && run.1 >= item.end {
                return;
            }
            let OccluderBounds { bounds, id, .. } = *entry;
            let b = bounds.map(f64::from);
            if b[0] > high.x || b[1] < low.x || b[2] > high.y || b[3] < low.y {
                continue;
            }
            let (corners, _) = corners(triangles.mesh, triangles.view, id);
            let Some((start, end)) = side.range(&corners, limits) else { continue };
            let (start, end) = (start.max(item.start), end.min(item.end));
            if start < end {
                backed.push((item.segment, backdrop(start, end)));
                run = join_or_longer(run, (start, end));
            }
        }
    }
}
