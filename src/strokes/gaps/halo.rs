//! Halos: farther lines are interrupted where a nearer one passes over them.
//!
//! Source: Appel, Rohlf and Stein, The haloed line effect for hidden line elimination, SIGGRAPH 1979.

use kurbo::Rect;

use crate::geometry::lists::csr_lists::{CsrLists, csr_lists};
use crate::geometry::plane::planar_distance::nearest_parameter;
use crate::geometry::plane::planar_grid::PlanarGrid;
use crate::geometry::plane::polylines::bounds;
use crate::strokes::axes::stroke_axis::StrokeAxis;

/// Least depth difference between a nearer and a farther line, as a share of the depth range of all lines.
const MIN_DEPTH_GAP_OF_RANGE: f64 = 0.01;

/// Distance from a junction within which joined lines do not interrupt each other, in halo reaches.
const JOIN_ZONE_REACHES: f64 = 8.0;

/// Greatest distance of a line's end from the line that it meets, px.
const MAX_TOUCH_PX: f64 = 1.0;

/// Bisections that find where a gap begins and ends.
const GAP_END_BISECTIONS: usize = 24;

/// Line that may have a halo.
pub(crate) struct HaloLine<'a> {
    pub axis: &'a StrokeAxis,
    /// Distance from its axis within which nothing farther is drawn; 0 for no halo.
    pub reach: f64,
}

/// Run of consecutive points of an axis with a halo.
#[derive(Debug, Clone, Copy)]
struct AxisRun {
    line: u32,
    /// Its first point and the point after its last.
    from: u32,
    to: u32,
}

/// Number of points in a run.
const POINTS_PER_RUN: usize = 4;

/// Greatest number of cells along an axis of the page.
const MAX_CELLS_ACROSS: f64 = 1000.0;

/// The gaps in each line as arc lengths, ascending. Gaps over the seam of a closed line start before 0 or end
/// past its length.
pub(crate) fn gaps(lines: &[HaloLine], depths: [f64; 2], px: f64) -> Vec<Vec<[f64; 2]>> {
    use crate::parallel::prelude::*;
    let greatest = lines.iter().map(|line| line.reach).fold(0.0, f64::max);
    if greatest <= 0.0 {
        return vec![Vec::new(); lines.len()];
    }
    let field = HaloGrid::new(lines, greatest, MIN_DEPTH_GAP_OF_RANGE * (depths[1] - depths[0]), px);
    (0..lines.len()).into_par_iter().map(|line| field.gaps(line)).collect()
}

struct HaloGrid<'a> {
    lines: &'a [HaloLine<'a>],
    grid: PlanarGrid,
    /// Runs whose bounding boxes overlap each cell.
    runs: CsrLists<AxisRun>,
    /// Greatest reach of a halo.
    greatest: f64,
    margin: f64,
    px: f64,
}

impl<'a> HaloGrid<'a> {
    fn new(lines: &'a [HaloLine<'a>], greatest: f64, margin: f64, px: f64) -> Self {
        let haloed = || lines.iter().enumerate().filter(|(_, line)| line.reach > 0.0);
        let points = haloed().flat_map(|(_, line)| line.axis.points.iter().copied());
        let extent = bounds(points).unwrap_or_default();
        let cell = (greatest + POINTS_PER_RUN as f64 * px).max(extent.size().max_side() / MAX_CELLS_ACROSS);
        let grid = PlanarGrid::new(extent, 1.0 / cell);
        let runs = csr_lists(grid.count(), |put| {
            for (i, line) in haloed() {
                let last = line.axis.len().saturating_sub(1);
                for from in (0..last).step_by(POINTS_PER_RUN) {
                    let to = (from + POINTS_PER_RUN).min(last);
                    let run = AxisRun { line: i as u32, from: from as u32, to: to as u32 };
                    let around = bounds(line.axis.points[from..=to].iter().copied());
                    let cells = around.into_iter().flat_map(|around| grid.rows_in(around)).flatten();
                    cells.for_each(|cell| put(cell, run));
                }
            }
        });
        Self { lines, grid, runs, greatest, margin, px }
    }

    fn gaps(&self, line: usize) -> Vec<[f64; 2]> {
        let axis = self.lines[line].axis;
        let n = axis.len();
        if n < 2 {
            return Vec::new();
        }
        let covered: Vec<bool> = axis.arcs.iter().map(|arc| self.covers(line, *arc)).collect();
        // Arc length where the halo ends, between a covered and an uncovered point.
        let border = |mut inside: f64, mut outside: f64| {
            for _ in 0..GAP_END_BISECTIONS {
                let middle = (inside + outside) / 2.0;
                if self.covers(line, middle) {
                    inside = middle;
                } else {
                    outside = middle;
                }
            }
            inside
        };
        let mut gaps = Vec::new();
        let mut i = 0;
        while i < n {
            if !covered[i] {
                i += 1;
                continue;
            }
            let run = covered[i..].iter().take_while(|c| **c).count();
            let last = i + run - 1;
            let from = if i > 0 { border(axis.arcs[i], axis.arcs[i - 1]) } else { axis.arcs[0] };
            let to =
                if last + 1 < n { border(axis.arcs[last], axis.arcs[last + 1]) } else { axis.arcs[n - 1] };
            gaps.push([from, to]);
            i += run;
        }
        let total = axis.length();
        if axis.closed
            && gaps.len() > 1
            && let (Some(first), Some(last)) = (gaps.first().copied(), gaps.last().copied())
            && first[0] <= 0.0
            && last[1] >= total
        {
            gaps.pop();
            gaps[0][0] = last[0] - total;
        }
        gaps
    }

    /// Whether the halo of a nearer line covers a point of a line.
    fn covers(&self, line: usize, arc: f64) -> bool {
        let own_axis = self.lines[line].axis;
        let (p, sample) = own_axis.at(arc);
        let around = Rect::from_points(p, p).inflate(self.greatest, self.greatest);
        self.grid.rows_in(around).flat_map(|cells| self.runs.of_all(cells)).any(|stretch| {
            let haloed_line = &self.lines[stretch.line as usize];
            let reach = haloed_line.reach;
            for i in stretch.from as usize..stretch.to as usize {
                let (a, b) = (haloed_line.axis.points[i], haloed_line.axis.points[i + 1]);
                let t = nearest_parameter(p, a, b);
                if (p - a.lerp(b, t)).hypot2() >= reach * reach {
                    continue;
                }
                let depth = haloed_line.axis.samples[i].lerp(haloed_line.axis.samples[i + 1], t).depth;
                if depth >= sample.depth - self.margin {
                    continue;
                }
                let other_arc =
                    haloed_line.axis.arcs[i] + (haloed_line.axis.arcs[i + 1] - haloed_line.axis.arcs[i]) * t;
                let same = stretch.line as usize == line;
                if same && near_along(own_axis, arc, other_arc, JOIN_ZONE_REACHES * reach) {
                    continue;
                }
                if !same
                    && (self.meets(own_axis, arc, haloed_line, other_arc)
                        || self.meets(haloed_line.axis, other_arc, &HaloLine { axis: own_axis, reach }, arc))
                {
                    continue;
                }
                return true;
            }
            false
        })
    }

    /// Whether a line, near one of its ends, is about to meet another one there.
    fn meets(&self, axis: &StrokeAxis, arc: f64, nearer_line: &HaloLine, other_arc: f64) -> bool {
        if axis.closed {
            return false;
        }
        let search_range = JOIN_ZONE_REACHES * nearer_line.reach;
        let ends = [(arc - axis.arcs[0], 0), (axis.length() - arc, axis.len() - 1)];
        ends.into_iter().filter(|(end_distance, _)| *end_distance < search_range).any(|(_, end)| {
            let (p, depth) = (axis.points[end], axis.samples[end].depth);
            // Search the other line around its current position for a point that touches the end.
            let touch = MAX_TOUCH_PX * self.px;
            let steps = (2.0 * search_range / self.px).ceil() as usize;
            (0..=steps).any(|k| {
                let at = other_arc - search_range + 2.0 * search_range * k as f64 / steps as f64;
                let (q, sample) = nearer_line.axis.at(at);
                (q - p).hypot2() <= touch * touch && (sample.depth - depth).abs() <= self.margin
            })
        })
    }
}

/// Whether two points of a line are less than `most` apart along it.
fn near_along(axis: &StrokeAxis, a: f64, b: f64, most: f64) -> bool {
    let way = (a - b).abs();
    let way = if axis.closed { way.min(axis.length() - way) } else { way };
    way < most
}
