//! Tree of segments by both end points, so that thousands of nearly coincident segments are tested as one.

use kurbo::{Point, Rect};

use super::segment::{Segment, nearest_on};
use crate::diff::tolerances;

/// Most segments of a leaf.
const MAX_LEAF_SEGMENTS: usize = 4;

/// One step of a search in [`SegmentClusters`].
#[derive(Debug, Clone, Copy)]
pub(crate) enum ClusterVisit {
    /// Segments that all lie within `radius` of the segment `from`–`to`, point by point. The visitor returns
    /// whether to descend.
    Bundle { from: Point, to: Point, radius: f64 },
    /// One segment, by its number. The visitor returns whether to stop.
    One(u32),
}

/// Binary tree of segments, halved along the end coordinate with the largest extent.
#[derive(Debug)]
pub(crate) struct SegmentClusters {
    nodes: Vec<ClusterNode>,
    /// Segment numbers, grouped by node.
    items: Vec<u32>,
}

/// A node of the tree.
#[derive(Debug, Clone, Copy)]
struct ClusterNode {
    /// Bounding boxes of the starts and of the ends.
    starts: Rect,
    ends: Rect,
    items: (usize, usize),
    /// Index of the second child; the first child is the next node. `None` for leaves.
    second: Option<usize>,
}

impl SegmentClusters {
    pub(crate) fn new(segments: &[Segment]) -> Self {
        let mut tree =
            Self { nodes: Vec::new(), items: (0..segments.len()).map(|item| item as u32).collect() };
        if !segments.is_empty() {
            tree.split(segments, 0, segments.len());
        }
        tree
    }

    /// Adds the node of a range of `items` and its descendants.
    fn split(&mut self, segments: &[Segment], first: usize, last: usize) {
        let segment_of = |item: u32| segments[item as usize];
        let bounds = |end: fn(&Segment) -> Point, items: &[u32]| {
            let first_end = items.first().map(|item| end(&segment_of(*item))).unwrap_or_default();
            items.iter().fold(Rect::from_points(first_end, first_end), |enclosing_rect, item| {
                enclosing_rect.union_pt(end(&segment_of(*item)))
            })
        };
        let (starts, ends) =
            (bounds(|s| s.from, &self.items[first..last]), bounds(|s| s.to, &self.items[first..last]));
        let index = self.nodes.len();
        self.nodes.push(ClusterNode { starts, ends, items: (first, last), second: None });
        if last - first <= MAX_LEAF_SEGMENTS {
            return;
        }
        let widths = [starts.width(), starts.height(), ends.width(), ends.height()];
        let widest = (0..4).max_by(|a, b| widths[*a].total_cmp(&widths[*b])).unwrap_or(0);
        let key = |item: u32| {
            let segment = segment_of(item);
            [segment.from.x, segment.from.y, segment.to.x, segment.to.y][widest]
        };
        let middle = first + (last - first) / 2;
        self.items[first..last]
            .select_nth_unstable_by((last - first) / 2, |a, b| key(*a).total_cmp(&key(*b)).then(a.cmp(b)));
        self.split(segments, first, middle);
        self.nodes[index].second = Some(self.nodes.len());
        self.split(segments, middle, last);
    }

    /// Visits clusters and descends where the visitor returns `true`, until one segment stops the search.
    /// Returns whether one did.
    pub(crate) fn search(&self, mut visit: impl FnMut(ClusterVisit) -> bool) -> bool {
        let mut pending_nodes = if self.nodes.is_empty() { Vec::new() } else { vec![0] };
        while let Some(index) = pending_nodes.pop() {
            let node = self.nodes[index];
            let radius = [node.starts, node.ends].map(|ends| ends.size().to_vec2().hypot() / 2.0);
            let bundle = ClusterVisit::Bundle {
                from: node.starts.center(),
                to: node.ends.center(),
                radius: radius[0].max(radius[1]),
            };
            if !visit(bundle) {
                continue;
            }
            match node.second {
                Some(second) => pending_nodes.extend([second, index + 1]),
                None => {
                    if self.items[node.items.0..node.items.1]
                        .iter()
                        .any(|item| visit(ClusterVisit::One(*item)))
                    {
                        return true;
                    }
                }
            }
        }
        false
    }

    /// Whether any segment is within `max_distance` of a point. `segments` must be those of [`Self::new`].
    pub(crate) fn any(&self, segments: &[Segment], p: Point, max_distance: f64) -> bool {
        let within = |from: Point, to: Point, reach: f64| p.distance(nearest_on(from, to, p)) <= reach;
        self.search(|visited| match visited {
            // A small margin for rounding.
            ClusterVisit::Bundle { from, to, radius } => {
                within(from, to, (max_distance + radius) * (1.0 + tolerances::CLUSTER_MARGIN_SHARE))
            }
            ClusterVisit::One(item) => segments
                .get(item as usize)
                .is_some_and(|segment| within(segment.from, segment.to, max_distance)),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Segments from one point whose ends are `step` px apart.
    fn segment_fan(count: u32, step: f64) -> Vec<Segment> {
        let segment = |chain: u32| Segment {
            chain,
            from: Point::new(60.0, 40.0),
            to: Point::new(90.0, 20.0 + step * f64::from(chain)),
        };
        (0..count).map(segment).collect()
    }

    #[test]
    fn cluster_search_matches_a_test_of_all_segments() {
        let segments = segment_fan(500, 0.1);
        let tree = SegmentClusters::new(&segments);
        let mut hits = 0;
        for i in 0..900 {
            let p = Point::new(50.0 + f64::from(i % 30) * 1.7, 10.0 + f64::from(i / 30) * 2.3);
            let wanted = segments.iter().any(|s| p.distance(nearest_on(s.from, s.to, p)) <= 0.01);
            assert_eq!(tree.any(&segments, p, 0.01), wanted, "{p:?}");
            hits += u32::from(wanted);
        }
        assert!(hits > 50);
    }

    #[test]
    fn nearly_coincident_segments_are_tested_as_one_cluster() {
        let segments = segment_fan(10_000, 1e-5);
        let tree = SegmentClusters::new(&segments);
        let p = Point::new(75.0, 32.0);
        let mut asked = 0;
        let found = tree.search(|met| {
            asked += 1;
            match met {
                ClusterVisit::Bundle { from, to, radius } => {
                    p.distance(nearest_on(from, to, p)) <= 0.02 + radius
                }
                ClusterVisit::One(_) => true,
            }
        });
        assert!(!found && asked == 1, "{asked}");
    }
}
