//! Border arcs between two patches, and the loops of arcs around each patch.
//!
//! 1. Sides of triangles between two patches become half edges, sorted by their start.
//! 2. Half edges are followed from node to node into arcs; the rest are closed arcs. A node is a point where
//!    three or more patches meet, or where a patch touches itself.
//! 3. At each node the loop of a patch continues with the first half edge met while turning through the
//!    patch.

use super::triangulation::{OUTSIDE, Triangulation};
use crate::regions::arrangement::snap_rounding::Border;

/// Marks the part of the page that is not painted, in place of a patch.
pub(crate) const OUTSIDE_PATCH: u32 = u32::MAX;

/// Border between two patches, from one node to the next. Both patches use it, so there is neither gap nor
/// overlap.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RawArc {
    /// Point ids in the triangulation. A closed arc does not repeat the first one.
    pub points: Vec<u32>,
    /// Whether the side after each point lies on a smooth surface.
    pub soft: Vec<bool>,
    pub closed: bool,
    /// Patch on the left (turning from x to y) and on the right; [`OUTSIDE_PATCH`] where nothing is painted.
    pub sides: [u32; 2],
}

/// Arc in a loop, and whether it is passed from its first point to its last.
pub(crate) type ArcUse = (u32, bool);

/// Arcs between patches, and the loops around each patch.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Borders {
    pub arcs: Vec<RawArc>,
    /// Loops around each patch, with the patch on their left.
    pub loops: Vec<Vec<Vec<ArcUse>>>,
}

/// Side of a triangle on a border, with the patch on its left.
#[derive(Debug, Clone, Copy)]
struct HalfEdge {
    from: u32,
    to: u32,
    left: u32,
    right: u32,
    soft: bool,
}

/// Traces the borders between `label_components` (one per triangle, numbers below `count`).
pub(crate) fn trace(cut: &Triangulation, patches: &[u32], count: usize) -> Borders {
    let mut halves: Vec<HalfEdge> = Vec::new();
    for (triangle, corners) in cut.triangles.iter().enumerate() {
        for side in 0..3 {
            let next = cut.neighbours[triangle][side];
            let left = patches[triangle];
            let right = if next == OUTSIDE { OUTSIDE_PATCH } else { patches[next as usize] };
            if left != right {
                let soft = cut.borders[triangle][side].is_none_or(Border::is_soft);
                let (from, to) = (corners[side], corners[(side + 1) % 3]);
                halves.push(HalfEdge { from, to, left, right, soft });
                if next == OUTSIDE {
                    halves.push(HalfEdge { from: to, to: from, left: OUTSIDE_PATCH, right: left, soft });
                }
            }
        }
    }
    halves.sort_unstable_by_key(|half| (half.from, half.to));
    let mut starts = vec![0u32; cut.points.len() + 1];
    for half in &halves {
        starts[half.from as usize + 1] += 1;
    }
    for k in 1..starts.len() {
        starts[k] += starts[k - 1];
    }
    let tracer = ArcTracer { cut, halves, starts };
    let (arcs, arc_of) = tracer.arcs();
    let loops = tracer.loops(&arcs, &arc_of, count);
    Borders { arcs, loops }
}

struct ArcTracer<'a> {
    cut: &'a Triangulation,
    /// Half edges, sorted by their first point.
    halves: Vec<HalfEdge>,
    starts: Vec<u32>,
}

const NO_ARC: u32 = u32::MAX;

impl ArcTracer<'_> {
    fn from(&self, point: u32) -> std::ops::Range<usize> {
        self.starts[point as usize] as usize..self.starts[point as usize + 1] as usize
    }

    /// Whether more or fewer than two half edges start at the point.
    fn is_node(&self, point: u32) -> bool {
        self.from(point).len() != 2
    }

    fn find(&self, from: u32, to: u32) -> Option<usize> {
        let range = self.from(from);
        let own = &self.halves[range.clone()];
        own.binary_search_by_key(&to, |half| half.to).ok().map(|k| range.start + k)
    }

    /// All arcs, and for each half edge its arc and whether it runs along it.
    fn arcs(&self) -> (Vec<RawArc>, Vec<ArcUse>) {
        let mut arcs = Vec::new();
        let mut arc_of: Vec<ArcUse> = vec![(NO_ARC, false); self.halves.len()];
        // Arcs between nodes first, then closed arcs.
        for closed in [false, true] {
            for first in 0..self.halves.len() {
                if arc_of[first].0 != NO_ARC || (!closed && !self.is_node(self.halves[first].from)) {
                    continue;
                }
                arcs.push(self.follow(first, arcs.len() as u32, &mut arc_of));
            }
        }
        (arcs, arc_of)
    }

    fn follow(&self, first: usize, arc: u32, arc_of: &mut [ArcUse]) -> RawArc {
        let start = self.halves[first];
        let mut found = RawArc {
            points: vec![start.from],
            soft: Vec::new(),
            closed: false,
            sides: [start.left, start.right],
        };
        let mut at = first;
        loop {
            let half = self.halves[at];
            found.soft.push(half.soft);
            arc_of[at] = (arc, true);
            if let Some(back) = self.find(half.to, half.from) {
                arc_of[back] = (arc, false);
            }
            if half.to == start.from && !self.is_node(half.to) {
                found.closed = true;
                return found;
            }
            found.points.push(half.to);
            let next = self.from(half.to).find(|k| self.halves[*k].to != half.from);
            match next {
                Some(next) if !self.is_node(half.to) && arc_of[next].0 == NO_ARC => at = next,
                _ => {
                    found.soft.push(half.soft);
                    return found;
                }
            }
        }
    }

    /// Loops around each patch.
    fn loops(&self, arcs: &[RawArc], arc_of: &[ArcUse], count: usize) -> Vec<Vec<Vec<ArcUse>>> {
        let mut loops: Vec<Vec<Vec<ArcUse>>> = vec![Vec::new(); count];
        let mut done = vec![[false; 2]; arcs.len()];
        for arc in 0..arcs.len() {
            for along in [true, false] {
                let patch = arcs[arc].sides[usize::from(!along)];
                if patch == OUTSIDE_PATCH || done[arc][usize::from(!along)] {
                    continue;
                }
                let mut uses: Vec<ArcUse> = Vec::new();
                let mut next = (arc as u32, along);
                while !done[next.0 as usize][usize::from(!next.1)] {
                    done[next.0 as usize][usize::from(!next.1)] = true;
                    uses.push(next);
                    let raw = &arcs[next.0 as usize];
                    if raw.closed {
                        break;
                    }
                    let n = raw.points.len();
                    let (before, node) = if next.1 { (n - 2, n - 1) } else { (1, 0) };
                    let Some(half) = self.turn(raw.points[before], raw.points[node], patch) else { break };
                    next = arc_of[half];
                }
                loops[patch as usize].push(uses);
            }
        }
        loops
    }

    /// Half edge that continues the border from `before` past `node`, with `patch` on its left.
    fn turn(&self, before: u32, node: u32, patch: u32) -> Option<usize> {
        let point = |v: u32| self.cut.points[v as usize];
        let origin = point(node);
        let direction = |v: u32| [point(v)[0] - origin[0], point(v)[1] - origin[1]];
        let back = direction(before);
        let own = self.from(node).filter(|k| self.halves[*k].left == patch);
        // The smallest turn from the way back, from y to x.
        own.min_by(|a, b| {
            let (a, b) = (direction(self.halves[*a].to), direction(self.halves[*b].to));
            backward(back, a, b)
        })
    }
}

/// Orders directions by their angle from `back`, turning from y to x; `back` itself comes last.
fn backward(back: [i64; 2], a: [i64; 2], b: [i64; 2]) -> std::cmp::Ordering {
    let cross = |u: [i64; 2], v: [i64; 2]| u[0] * v[1] - u[1] * v[0];
    let dot = |u: [i64; 2], v: [i64; 2]| u[0] * v[0] + u[1] * v[1];
    // 0: less than half a turn; 1: exactly half; 2: more than half; 3: a full turn.
    let part = |d: [i64; 2]| match (cross(back, d), dot(back, d)) {
        (c, _) if c < 0 => 0,
        (0, d) if d < 0 => 1,
        (0, _) => 3,
        _ => 2,
    };
    part(a).cmp(&part(b)).then_with(|| cross(a, b).cmp(&0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn backward_orders_directions_by_angle() {
        use std::cmp::Ordering::Less;
        let back = [1, 0];
        let around = [[1, -1], [0, -1], [-1, -1], [-1, 0], [-1, 1], [0, 1], [1, 1], [1, 0]];
        for pair in around.windows(2) {
            assert_eq!(backward(back, pair[0], pair[1]), Less, "{pair:?}");
        }
    }
}
