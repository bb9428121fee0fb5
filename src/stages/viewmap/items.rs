//! [`Items`]: what lies of each line in each tile, but for what lies behind covers.

use rayon::prelude::*;

use super::compared::Item;
use super::cover::Covers;
use super::grid::Grid;
use super::project::ImageSegment;
use crate::lines::Role;
use crate::math::grouped::{Grouped, grouped_pairs};

/// Segments that are walked as one piece of work.
const CHUNK: usize = 1 << 10;

/// The items of all segments of which visibility is asked.
#[derive(Debug)]
pub(super) struct Items {
    /// By tile, those that have to be compared with triangles.
    pub open: Grouped<Item>,
    /// Those that lie behind covers: one of a segment all of which does.
    pub buried: Vec<Item>,
}

/// The same of some segments, each with its tile.
#[derive(Default)]
struct Walked {
    open: Vec<(u32, Item)>,
    buried: Vec<Item>,
}

impl Items {
    /// Walks all segments through the tiles but smooth contours, whose witnesses are asked.
    pub fn new(segments: &[ImageSegment], grid: &Grid, covers: &Covers) -> Self {
        let walked: Vec<Walked> = (0..segments.len().div_ceil(CHUNK))
            .into_par_iter()
            .with_max_len(1)
            .map(|k| walked(segments, k * CHUNK..((k + 1) * CHUNK).min(segments.len()), grid, covers))
            .collect();
        let pairs = walked.iter().flat_map(|walked| &walked.open).map(|(tile, item)| (*tile as usize, *item));
        let open = grouped_pairs(grid.len(), pairs);
        let buried = walked.iter().flat_map(|walked| &walked.buried).copied().collect();
        Self { open, buried }
    }
}

fn walked(segments: &[ImageSegment], some: std::ops::Range<usize>, grid: &Grid, covers: &Covers) -> Walked {
    let Walked { mut open, mut buried } = Walked::default();
    for (segment, s) in some.map(|k| (k as u32, &segments[k])).filter(|(_, s)| s.role != Role::Curve) {
        let before = (open.len(), buried.len());
        grid.walk(s.a, s.b, |tile, start, end| {
            let item = Item { segment, start, end };
            if covers.bury(s, tile, start, end) {
                buried.push(item);
            } else {
                open.push((tile as u32, item));
            }
        });
        if open.len() == before.0 && buried.len() > before.1 {
            buried.truncate(before.1);
            buried.push(Item { segment, start: 0.0, end: 1.0 });
        }
    }
    Walked { open, buried }
}
