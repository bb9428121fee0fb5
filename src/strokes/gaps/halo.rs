//! Halos: farther lines are interrupted where a nearer one passes over them.
//!
//! Source: Appel, Rohlf and Stein, The haloed line effect for hidden line elimination, SIGGRAPH 1979.

use kurbo::Point;
use rustc_hash::FxHashMap;

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
    cells: FxHashMap<(i64, i64), Vec<AxisRun>>,
    cell: f64,
    margin: f64,
    px: f64,
}

impl<'a> HaloGrid<'a> {
    fn new(lines: &'a [HaloLine<'a>], greatest: f64, margin: f64, px: f64) -> Self {
        let cell = (greatest + POINTS_PER_RUN as f64 * px).max(4.0 * px);
        let mut field = Self { lines, cells: FxHashMap::default(), cell, margin, px };
        for (i, line) in lines.iter().enumerate().filter(|(_, line)| line.reach > 0.0) {
            let last = line.axis.len().saturating_sub(1);
            for from in (0..last).step_by(POINTS_PER_RUN) {
                let to = (from + POINTS_PER_RUN).min(last);
                let stretch = AxisRun { line: i as u32, from: from as u32, to: to as u32 };
                let (mut low, mut high) =
                    (field.at(line.axis.points[from]), field.at(line.axis.points[from]));
                for p in &line.axis.points[from..=to] {
                    let at = field.at(*p);
                    low = (low.0.min(at.0), low.1.min(at.1));
                    high = (high.0.max(at.0), high.1.max(at.1));
                }
                for x in low.0..=high.0 {
                    for y in low.1..=high.1 {
                        field.cells.entry((x, y)).or_default().push(stretch);
                    }
                }
            }
        }
        field
    }

    fn at(&self, p: Point) -> (i64, i64) {
        ((p.x / self.cell).floor() as i64, (p.y / self.cell).floor() as i64)
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
        let (x, y) = self.at(p);
        let around = (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| (x, y)));
        around.filter_map(|cell| self.cells.get(&cell)).flatten().any(|stretch| {
            let haloed_line = &self.lines[stretch.line as usize];
            let reach = haloed_line.reach;
            for i in stretch.from as usize..stretch.to as usize {
                let (a, b) = (haloed_line.axis.points[i], haloed_line.axis.points[i + 1]);
                let segment = b - a;
                let t = if segment.hypot2() > 0.0 {
                    ((p - a).dot(segment) / segment.hypot2()).clamp(0.0, 1.0)
                } else {
                    0.0
                };
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
