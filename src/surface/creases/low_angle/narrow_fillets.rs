//! [`narrow_roundings`]: the lines that stand for roundings of few steps which are narrow beside the surfaces that they join.
//!
//! A rounding of three or four steps turns by less than a crease at each of them, and would leave a box without edges. On paper it is
//! one edge: the line in its middle.

use crate::parallel::prelude::*;

use super::centre_lines::{Middle, middle_lines};
use super::surface_trace::{Bend, Walk};
use crate::geometry::numbers::portable_math::cos;
use crate::mesh::Mesh;

/// Steps of a rounding turn by more than this share of the one in its middle.
const AGAIN: f64 = 0.35;
/// Steps to be found on one side of an edge.
const MOST_STEPS: usize = 4;
/// How far a rounding turns in all, degrees.
const TURN_DEG: [f64; 2] = [50.0, 130.0];
/// A rounding is narrow if the surfaces beside it are so many times as wide: both of them, and one of them.
const NARROW: [f64; 2] = [1.5, 3.0];
/// Strips of one rounding are as wide as each other but for this factor, and so are the turns between them.
const REGULAR: f64 = 1.3;
/// At its ends a rounding turns by no more than so many times as much as in its middle.
const MOST_AT_END: f64 = 1.6;
/// Turns that differ by less than this share of a whole rounding's are alike.
const ALIKE: f64 = 0.03;
/// One of two surfaces is wider if it is by this factor.
const WIDER: f64 = 1.5;
/// Directions differ along an axis if they do by more than this.
const APART: f32 = 0.1;
/// The smallest piece of work for a thread, in edges.
const GRAIN: usize = 1 << 8;

/// Those of the edges asked that are in the middle of a narrow rounding, in their order: where they are most of its middle line.
pub(crate) fn narrow_roundings(walk: &Walk, asked: &[usize]) -> Vec<usize> {
    let wide_at = |edge: &usize| Some((*edge, Bent::at(walk, *edge)?.wide_if_middle(walk.mesh)?));
    let found: Vec<Middle> = asked.par_iter().with_min_len(GRAIN).filter_map(wide_at).collect();
    if found.is_empty() { Vec::new() } else { middle_lines(walk, asked, &found) }
}

/// An edge at which a surface turns.
#[derive(Clone, Copy)]
struct Step {
    /// How far it is from the edge that is asked.
    reach: f64,
    /// Radians that the surface has turned since then.
    turned: f64,
    /// The face behind it.
    face: u32,
}

/// What is on one side of an edge: the edges after it at which the surface turns the same way in steps as wide as each other, nearest
/// first, and how far it is to where the surface behind the last of them ends.
struct Side {
    steps: [Step; MOST_STEPS],
    count: usize,
    end: f64,
}

impl Side {
    /// What is straight across a face from an edge that is so long; none if no rounding ends there.
    fn new(walk: &Walk, bend: &Bend, length: f64, face: u32) -> Option<Self> {
        let again = cos(AGAIN * bend.turn) as f32;
        let mut last = Step { reach: 0.0, turned: 0.0, face };
        let mut side = Self { steps: [last; MOST_STEPS], count: 0, end: f64::INFINITY };
        for crossing in walk.crossings(bend.edge, face) {
            let crossing = crossing?;
            let (edge, wide) = (crossing.edge, crossing.reach - last.reach);
            side.end = crossing.reach;
            // What is beside a rounding is wide enough, or this is none that is as narrow as the edge is long.
            if wide > NARROW[1] * length {
                break;
            }
            let cosine = walk.turns.of_two(edge);
            let next = walk.bend(edge).filter(|_| cosine >= walk.most && !walk.hard.is_hard(edge));
            if next.is_some() && cosine >= again {
                continue;
            }
            // The first strip tells how wide the others are.
            let is_strip = side.count == 0 || wide <= REGULAR * side.steps[0].reach;
            let Some((next, _)) = next.filter(|(next, _)| next.convex == bend.convex && is_strip) else {
                break;
            };
            let turned = last.turned + next.turn;
            if side.count == MOST_STEPS || crossing.reach > length || turned > TURN_DEG[1].to_radians() {
                break;
            }
            last = Step { reach: crossing.reach, turned, face: walk.over(edge, crossing.before)? };
            side.steps[side.count] = last;
            side.count += 1;
            side.end = f64::INFINITY;
        }
        let ends = |step: usize| side.width(step) >= NARROW[0] * side.steps[step].reach;
        (0..side.count).any(ends).then_some(side)
    }

    /// How far the surface behind a step reaches.
    fn width(&self, step: usize) -> f64 {
        let end = if step + 1 < self.count { self.steps[step + 1].reach } else { self.end };
        end - self.steps[step].reach
    }
}

/// An edge at which a surface turns, and what is on both sides of it.
struct Bent {
    turn: f64,
    sides: [Side; 2],
    length: f64,
}

impl Bent {
    fn at(walk: &Walk, edge: usize) -> Option<Self> {
        let (bend, [a, b]) = walk.bend(edge)?;
        let [p, q] = walk.mesh.edges.vertices[edge].map(|v| walk.mesh.positions[v as usize]);
        let length = p.distance(q);
        // Facets of cylinders, which are most that is asked, are told by one side.
        let sides = [Side::new(walk, &bend, length, a)?, Side::new(walk, &bend, length, b)?];
        Some(Self { turn: bend.turn, sides, length })
    }

    /// The narrowest rounding that the edge is in, by its last step on each side.
    fn rounding(&self) -> Option<[usize; 2]> {
        let [near, far] = &self.sides;
        let runs = (0..near.count).flat_map(|i| (0..far.count).map(move |j| [i, j]));
        let wide = |[i, j]: [usize; 2]| near.steps[i].reach + far.steps[j].reach;
        let is_one = |run: &[usize; 2]| {
            let (wide, beside) = (wide(*run), [near.width(run[0]), far.width(run[1])]);
            let (least, most) = (beside[0].min(beside[1]), beside[0].max(beside[1]));
            wide <= self.length && least >= NARROW[0] * wide && most >= NARROW[1] * wide
        };
        runs.filter(is_one).min_by(|a, b| wide(*a).total_cmp(&wide(*b)))
    }

    /// Whether the steps of a rounding are those of an arc: as wide as each other, and the surface turns by as much between them.
    fn is_arc(&self, run: [usize; 2]) -> bool {
        let (mut strips, mut inner, mut most_at_end) =
            (Range::default(), Range::default().with(self.turn), 0.0f64);
        for (side, last) in self.sides.iter().zip(run) {
            let mut before = Step { reach: 0.0, turned: 0.0, face: 0 };
            for (k, step) in side.steps[..=last].iter().enumerate() {
                strips = strips.with(step.reach - before.reach);
                let turn = step.turned - before.turned;
                // The turns at both ends are those of the surfaces beside as well.
                if k < last {
                    inner = inner.with(turn);
                } else {
                    most_at_end = most_at_end.max(turn);
                }
                before = *step;
            }
        }
        strips.is_within(REGULAR) && inner.is_within(REGULAR) && most_at_end <= MOST_AT_END * inner.least
    }

    /// How wide the narrow rounding is that the edge is the middle of; of two edges it is the one beside the wider surface.
    fn wide_if_middle(&self, mesh: &Mesh) -> Option<f64> {
        let run = self.rounding().filter(|run| self.is_arc(*run))?;
        let wide = self.sides[0].steps[run[0]].reach + self.sides[1].steps[run[1]].reach;
        self.is_middle(mesh, run).then_some(wide)
    }

    fn is_middle(&self, mesh: &Mesh, run: [usize; 2]) -> bool {
        let ends = [0, 1].map(|k| self.sides[k].steps[run[k]]);
        let whole = ends[0].turned + self.turn + ends[1].turned;
        let [least, most] = TURN_DEG.map(f64::to_radians);
        if whole < least || whole > most {
            return false;
        }
        // How much less than half of the rounding is on each side.
        let less = ends.map(|end| whole / 2.0 - end.turned);
        let alike = ALIKE * whole;
        if less[0].min(less[1]) < -alike {
            return false;
        }
        let Some(other) = less.iter().position(|less| *less < alike) else { return true };
        let own = 1 - other;
        let widths = [own, other].map(|k| self.sides[k].width(run[k]));
        if widths[0] > WIDER * widths[1] || widths[1] > WIDER * widths[0] {
            return widths[0] > widths[1];
        }
        let normals = [own, other].map(|k| mesh.face_normals[ends[k].face as usize]);
        (0..3)
            .rev()
            .map(|axis| normals[0][axis] - normals[1][axis])
            .find(|by| by.abs() > APART)
            .is_some_and(|by| by > 0.0)
    }
}

/// The least and the greatest of numbers.
struct Range {
    least: f64,
    most: f64,
}

impl Default for Range {
    fn default() -> Self {
        Self { least: f64::INFINITY, most: 0.0 }
    }
}

impl Range {
    fn with(self, number: f64) -> Self {
        Self { least: self.least.min(number), most: self.most.max(number) }
    }

    /// Whether they differ by no more than a factor.
    fn is_within(&self, factor: f64) -> bool {
        self.most <= factor * self.least
    }
}
