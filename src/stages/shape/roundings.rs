//! [`narrow_roundings`]: the lines that stand for roundings of few steps which are narrow beside the surfaces that they join.
//!
//! A rounding of three or four steps turns by less than a crease at each of them, and would leave a box without edges. On paper it is
//! one edge: the line in its middle.

use rayon::prelude::*;

use super::middle_lines::{Middle, middle_lines};
use super::walk::{Bend, Walk};
use crate::math::function::cos;
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
pub(super) fn narrow_roundings(walk: &Walk, asked: &[usize]) -> Vec<usize> {
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

/// What is on one side of an edge: itself and the edges after it at which the surface turns the same way, nearest first, and how far it
/// is to where the surface behind the last of them ends.
struct Side {
    steps: Vec<Step>,
    end: f64,
}

impl Side {
    /// What is straight across a face from an edge that is so long.
    fn new(walk: &Walk, bend: &Bend, length: f64, face: u32) -> Option<Self> {
        let again = cos(AGAIN * bend.turn) as f32;
        let mut last = Step { reach: 0.0, turned: 0.0, face };
        let mut steps = vec![last];
        for crossing in walk.crossings(bend.edge, face) {
            let crossing = crossing?;
            let (edge, reach) = (crossing.edge, crossing.reach);
            // What is beside a rounding is wide enough, or this is none that is as narrow as the edge is long.
            if reach - last.reach > NARROW[1] * length {
                return Some(Self { steps, end: reach });
            }
            let cosine = walk.turns.of_two(edge);
            let next = walk.bend(edge).filter(|_| cosine >= walk.most && !walk.hard.is_hard(edge));
            match next {
                Some(_) if cosine >= again => {}
                Some((next, _)) if next.convex == bend.convex && steps.len() <= MOST_STEPS => {
                    let face = walk.over(edge, crossing.before)?;
                    last = Step { reach, turned: last.turned + next.turn, face };
                    steps.push(last);
                }
                _ => return Some(Self { steps, end: reach }),
            }
        }
        Some(Self { steps, end: f64::INFINITY })
    }

    /// How far the surface behind a step reaches.
    fn width(&self, step: usize) -> f64 {
        self.steps.get(step + 1).map_or(self.end, |next| next.reach) - self.steps[step].reach
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
        let sides = [Side::new(walk, &bend, length, a)?, Side::new(walk, &bend, length, b)?];
        Some(Self { turn: bend.turn, sides, length })
    }

    /// The narrowest rounding that the edge is of: how many steps there are on each side.
    fn rounding(&self) -> Option<[usize; 2]> {
        let [near, far] = &self.sides;
        let runs = (0..near.steps.len()).flat_map(|i| (0..far.steps.len()).map(move |j| [i, j]));
        let wide = |[i, j]: [usize; 2]| near.steps[i].reach + far.steps[j].reach;
        let is_one = |run: &[usize; 2]| {
            let (wide, beside) = (wide(*run), [near.width(run[0]), far.width(run[1])]);
            let (least, most) = (beside[0].min(beside[1]), beside[0].max(beside[1]));
            *run != [0, 0] && wide <= self.length && least >= NARROW[0] * wide && most >= NARROW[1] * wide
        };
        runs.filter(is_one).min_by(|a, b| wide(*a).total_cmp(&wide(*b)))
    }

    /// Whether the steps of a rounding are those of an arc: there are two at least, all as wide as each other, and the surface turns by as
    /// much between them.
    fn is_arc(&self, run: [usize; 2]) -> bool {
        let steps = |k: usize| self.sides[k].steps[..=run[k]].windows(2);
        let wide = [0, 1].into_iter().flat_map(|k| steps(k).map(|two| two[1].reach - two[0].reach));
        let [narrow, wide] = range(wide);
        // The turns at both ends are those of the surfaces beside as well.
        let turns = |k: usize| steps(k).map(|two| two[1].turned - two[0].turned);
        let inner = [0, 1].into_iter().flat_map(|k| turns(k).take(run[k].saturating_sub(1)));
        let [gentle, steep] = range(inner.chain([self.turn]));
        let most_at_end = [0, 1].into_iter().filter_map(|k| turns(k).last()).fold(0.0, f64::max);
        run[0] + run[1] > 1
            && wide <= REGULAR * narrow
            && steep <= REGULAR * gentle
            && most_at_end <= MOST_AT_END * gentle
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
fn range(numbers: impl Iterator<Item = f64>) -> [f64; 2] {
    numbers.fold([f64::INFINITY, 0.0], |[least, most], x| [x.min(least), x.max(most)])
}
