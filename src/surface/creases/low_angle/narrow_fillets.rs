//! [`narrow_fillets`]: centre lines of fillets that have few steps and are narrow compared with the
//! surfaces they join.
//!
//! A fillet of three or four steps turns by less than the crease angle at each of them, so a box with such
//! fillets would show no edges. In a drawing such a fillet is one line, along its middle.

use crate::parallel::prelude::*;

use super::fillet_centre_lines::{CentreEdge, centre_lines};
use super::surface_trace::{BentEdge, SurfaceTracer};
use crate::geometry::numbers::portable_math::cos;
use crate::mesh::Mesh;

/// Minimum turn of a step, as a share of the turn at the middle edge.
const MIN_TURN_RATIO: f64 = 0.35;
/// Maximum number of steps on one side of the middle edge.
const MAX_STEPS_PER_SIDE: usize = 4;
/// Range of the total turn of a fillet, degrees.
const FILLET_TURN_RANGE_DEG: [f64; 2] = [50.0, 130.0];
/// Minimum width of the surfaces next to a narrow fillet, in fillet widths: of both, and of the wider one.
const MIN_NEIGHBOUR_WIDTH_RATIOS: [f64; 2] = [1.5, 3.0];
/// Maximum ratio between the widths of the strips of one fillet, and between its inner turns.
const MAX_STEP_RATIO: f64 = 1.3;
/// Maximum turn at the ends of a fillet, in turns of its middle.
const MAX_END_TURN_RATIO: f64 = 1.6;
/// Maximum difference between two half turns that count as equal, as a share of the total turn.
const MAX_TURN_DIFFERENCE_OF_FILLET: f64 = 0.03;
/// Minimum ratio of widths for one of two surfaces to count as wider.
const MIN_WIDER_RATIO: f64 = 1.5;
/// Minimum difference between two normals along an axis.
const MIN_NORMAL_DIFFERENCE: f32 = 0.1;
/// Minimum number of edges per task.
const MIN_EDGES_PER_TASK: usize = 1 << 8;

/// The edges of `candidate_edges`, in order, that lie in the middle of a narrow fillet and cover most of its centre
/// line.
pub(crate) fn narrow_fillets(walk: &SurfaceTracer, candidate_edges: &[usize]) -> Vec<usize> {
    let wide_at = |edge: &usize| Some((*edge, FilletCandidate::at(walk, *edge)?.wide_if_middle(walk.mesh)?));
    let found: Vec<CentreEdge> =
        candidate_edges.par_iter().with_min_len(MIN_EDGES_PER_TASK).filter_map(wide_at).collect();
    if found.is_empty() { Vec::new() } else { centre_lines(walk, candidate_edges, &found) }
}

/// Edge where the surface turns.
#[derive(Clone, Copy)]
struct FilletStep {
    /// Distance from the start edge, world units.
    reach: f64,
    /// Total turn since the start edge, radians.
    turned: f64,
    /// The face behind it.
    face: u32,
}

/// One side of an edge: the following steps of a fillet, nearest first, and the distance to the end of the
/// surface behind the last step.
struct FilletSide {
    steps: [FilletStep; MAX_STEPS_PER_SIDE],
    count: usize,
    end: f64,
}

impl FilletSide {
    /// Traces across `face` from an edge of the given length. `None` if no fillet ends on this side.
    fn new(walk: &SurfaceTracer, bend: &BentEdge, length: f64, face: u32) -> Option<Self> {
        let bend_cosine = cos(MIN_TURN_RATIO * bend.turn) as f32;
        let mut last = FilletStep { reach: 0.0, turned: 0.0, face };
        let mut side = Self { steps: [last; MAX_STEPS_PER_SIDE], count: 0, end: f64::INFINITY };
        for crossing in walk.crossings(bend.edge, face) {
            let crossing = crossing?;
            let (edge, wide) = (crossing.edge, crossing.reach - last.reach);
            side.end = crossing.reach;
            // A gap this wide is a neighbouring surface of any fillet that is narrower than the edge is long.
            if wide > MIN_NEIGHBOUR_WIDTH_RATIOS[1] * length {
                break;
            }
            let cosine = walk.turns.of_two(edge);
            let next = walk.bend(edge).filter(|_| cosine >= walk.crease_cosine && !walk.hard.is_hard(edge));
            if next.is_some() && cosine >= bend_cosine {
                continue;
            }
            // The first strip sets the width of the others.
            let is_strip = side.count == 0 || wide <= MAX_STEP_RATIO * side.steps[0].reach;
            let Some((next, _)) = next.filter(|(next, _)| next.convex == bend.convex && is_strip) else {
                break;
            };
            let turned = last.turned + next.turn;
            if side.count == MAX_STEPS_PER_SIDE
                || crossing.reach > length
                || turned > FILLET_TURN_RANGE_DEG[1].to_radians()
            {
                break;
            }
            last = FilletStep {
                reach: crossing.reach,
                turned,
                face: walk.mesh.edges.faces(edge).across(crossing.before)?,
            };
            side.steps[side.count] = last;
            side.count += 1;
            side.end = f64::INFINITY;
        }
        let ends = |step: usize| side.width(step) >= MIN_NEIGHBOUR_WIDTH_RATIOS[0] * side.steps[step].reach;
        (0..side.count).any(ends).then_some(side)
    }

    /// Width of the surface behind a step.
    fn width(&self, step: usize) -> f64 {
        let end = if step + 1 < self.count { self.steps[step + 1].reach } else { self.end };
        end - self.steps[step].reach
    }
}

/// Bent edge, with the steps on both sides.
struct FilletCandidate {
    turn: f64,
    sides: [FilletSide; 2],
    length: f64,
}

impl FilletCandidate {
    fn at(walk: &SurfaceTracer, edge: usize) -> Option<Self> {
        let (bend, [a, b]) = walk.bend(edge)?;
        let [p, q] = walk.mesh.ends(edge);
        let length = p.distance(q);
        // Most candidates are facets of cylinders, which the first side already rules out.
        let sides = [FilletSide::new(walk, &bend, length, a)?, FilletSide::new(walk, &bend, length, b)?];
        Some(Self { turn: bend.turn, sides, length })
    }

    /// The narrowest fillet that contains the edge, as its last step on each side.
    fn rounding(&self) -> Option<[usize; 2]> {
        let [near, far] = &self.sides;
        let runs = (0..near.count).flat_map(|i| (0..far.count).map(move |j| [i, j]));
        let wide = |[i, j]: [usize; 2]| near.steps[i].reach + far.steps[j].reach;
        let is_one = |run: &[usize; 2]| {
            let (wide, neighbour_widths) = (wide(*run), [near.width(run[0]), far.width(run[1])]);
            let (narrower, wider) =
                (neighbour_widths[0].min(neighbour_widths[1]), neighbour_widths[0].max(neighbour_widths[1]));
            wide <= self.length
                && narrower >= MIN_NEIGHBOUR_WIDTH_RATIOS[0] * wide
                && wider >= MIN_NEIGHBOUR_WIDTH_RATIOS[1] * wide
        };
        runs.filter(is_one).min_by(|a, b| wide(*a).total_cmp(&wide(*b)))
    }

    /// Whether the steps form an arc: strips of similar width, with similar turns between them.
    fn is_arc(&self, run: [usize; 2]) -> bool {
        let (mut strips, mut inner, mut most_at_end) =
            (ValueRange::default(), ValueRange::default().with(self.turn), 0.0f64);
        for (side, last) in self.sides.iter().zip(run) {
            let mut before = FilletStep { reach: 0.0, turned: 0.0, face: 0 };
            for (k, step) in side.steps[..=last].iter().enumerate() {
                strips = strips.with(step.reach - before.reach);
                let turn = step.turned - before.turned;
                // The turns at both ends also belong to the neighbouring surfaces.
                if k < last {
                    inner = inner.with(turn);
                } else {
                    most_at_end = most_at_end.max(turn);
                }
                before = *step;
            }
        }
        strips.is_within(MAX_STEP_RATIO)
            && inner.is_within(MAX_STEP_RATIO)
            && most_at_end <= MAX_END_TURN_RATIO * inner.lowest
    }

    /// Width of the narrow fillet whose middle edge this is. Of two middle edges, the one next to the wider
    /// surface is taken.
    fn wide_if_middle(&self, mesh: &Mesh) -> Option<f64> {
        let run = self.rounding().filter(|run| self.is_arc(*run))?;
        let wide = self.sides[0].steps[run[0]].reach + self.sides[1].steps[run[1]].reach;
        self.is_middle(mesh, run).then_some(wide)
    }

    fn is_middle(&self, mesh: &Mesh, run: [usize; 2]) -> bool {
        let ends = [0, 1].map(|k| self.sides[k].steps[run[k]]);
        let total_turn = ends[0].turned + self.turn + ends[1].turned;
        let [min_turn, max_turn] = FILLET_TURN_RANGE_DEG.map(f64::to_radians);
        if total_turn < min_turn || total_turn > max_turn {
            return false;
        }
        // Half of the total turn, minus the turn on each side.
        let less = ends.map(|end| total_turn / 2.0 - end.turned);
        let turn_tolerance = MAX_TURN_DIFFERENCE_OF_FILLET * total_turn;
        if less[0].min(less[1]) < -turn_tolerance {
            return false;
        }
        let Some(tied_side) = less.iter().position(|less| *less < turn_tolerance) else { return true };
        let opposite_side = 1 - tied_side;
        let widths = [opposite_side, tied_side].map(|k| self.sides[k].width(run[k]));
        if widths[0] > MIN_WIDER_RATIO * widths[1] || widths[1] > MIN_WIDER_RATIO * widths[0] {
            return widths[0] > widths[1];
        }
        let normals = [opposite_side, tied_side].map(|k| mesh.face_normals[ends[k].face as usize]);
        (0..3)
            .rev()
            .map(|axis| normals[0][axis] - normals[1][axis])
            .find(|by| by.abs() > MIN_NORMAL_DIFFERENCE)
            .is_some_and(|by| by > 0.0)
    }
}

/// Range of some numbers.
struct ValueRange {
    lowest: f64,
    highest: f64,
}

impl Default for ValueRange {
    fn default() -> Self {
        Self { lowest: f64::INFINITY, highest: 0.0 }
    }
}

impl ValueRange {
    fn with(self, number: f64) -> Self {
        Self { lowest: self.lowest.min(number), highest: self.highest.max(number) }
    }

    /// Whether the largest is at most `factor` times the smallest.
    fn is_within(&self, factor: f64) -> bool {
        self.highest <= factor * self.lowest
    }
}
