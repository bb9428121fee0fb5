//! [`Routes`]: sequences of view edges that continue each other, with every edge in exactly one route.
//!
//! Two edges of one class continue each other if they are the only ones of their class at a view vertex.
//! Where more meet, pieces of one feature segment are paired first, then the straightest pairs. Directions
//! are measured over a few px, so that the zigzag of small triangles does not count.

use std::ops::Range;

use crate::parallel::prelude::*;
use crate::parallel::{self, Parallel};

use super::directed_edge::{DirectedEdge, order};
use super::edge_class::EdgeClass;
use super::junction_pairing::{NO_PARTNER, pair_ends};
use crate::visibility::ViewMap;

/// Edges in the order and direction of the lines through them.
#[derive(Debug, Clone, Default)]
pub(crate) struct Routes {
    steps: Vec<DirectedEdge>,
    spans: Vec<Span>,
}

#[derive(Debug, Clone, Copy)]
struct Span {
    first: u32,
    end: u32,
    closed: bool,
    /// Smallest feature segment of its edges.
    segment: u32,
}

impl Routes {
    pub(crate) fn len(&self) -> usize {
        self.spans.len()
    }

    /// Steps of a route, and whether it is closed.
    pub(crate) fn get(&self, route: usize) -> (&[DirectedEdge], bool) {
        let span = self.spans[route];
        (&self.steps[span.first as usize..span.end as usize], span.closed)
    }

    pub(crate) fn iter(
        &self,
    ) -> Parallel<Range<usize>, impl parallel::Step<Range<usize>, Item = (&[DirectedEdge], bool)>> {
        (0..self.len()).into_par_iter().with_min_len(ROUTES_PER_TASK).map(|route| self.get(route))
    }

    /// Changes every route in place. The routes must still be stored one after another.
    fn each(&mut self, change: impl Fn(&mut [DirectedEdge], &mut Span) + Sync) {
        let mut remaining = &mut self.steps[..];
        let mut tasks = Vec::with_capacity(self.spans.len().div_ceil(ROUTES_PER_TASK));
        for spans in self.spans.chunks_mut(ROUTES_PER_TASK) {
            let (Some(first), Some(last)) = (spans.first(), spans.last()) else { continue };
            let count = (last.end - first.first) as usize;
            let (steps, following) = std::mem::take(&mut remaining).split_at_mut(count);
            remaining = following;
            tasks.push((steps, spans));
        }
        tasks.into_par_iter().with_max_len(1).for_each(|(mut steps, spans)| {
            for span in spans {
                let (route_steps, later_steps) = steps.split_at_mut((span.end - span.first) as usize);
                change(route_steps, span);
                steps = later_steps;
            }
        });
    }
}

/// Routes per task.
const ROUTES_PER_TASK: usize = 1024;

/// Joins the edges that have a class. `window` is the length for measuring directions at junctions.
///
/// The result does not depend on the order or direction of the edges, except for lines that coincide exactly.
pub(crate) fn routes(map: &ViewMap, classes: &[Option<EdgeClass>], window: f64) -> Routes {
    let partner = pair_ends(map, classes, window);
    let mut used: Vec<bool> = classes.iter().map(Option::is_none).collect();
    let mut routes = Routes { steps: Vec::with_capacity(map.edges.len()), spans: Vec::new() };
    // Open routes start at unpaired ends; the remaining edges form closed routes.
    for open in [true, false] {
        for end in 0..partner.len() {
            if used[end / 2] || (open && partner[end] != NO_PARTNER) {
                continue;
            }
            let first = routes.steps.len();
            let mut at = end as u32;
            loop {
                used[(at / 2) as usize] = true;
                routes.steps.push(DirectedEdge { edge: at / 2, reversed: at % 2 == 1 });
                let next = partner[(at ^ 1) as usize];
                if next == NO_PARTNER || used[(next / 2) as usize] {
                    break;
                }
                at = next;
            }
            let end = routes.steps.len() as u32;
            routes.spans.push(Span { first: first as u32, end, closed: !open, segment: NO_PARTNER });
        }
    }
    routes.each(|steps, span| {
        make_canonical(map, steps, span.closed);
        let segments = steps.iter().map(|step| map.edges[step.edge as usize].segment);
        span.segment = segments.min().unwrap_or(NO_PARTNER);
    });
    let steps = &routes.steps;
    routes.spans.par_sort_by(|a, b| {
        let start = |s: &Span| steps[s.first as usize];
        a.segment.cmp(&b.segment).then_with(|| order(map, start(a), start(b)))
    });
    routes
}

/// Gives a route a direction, and a closed route a start, that depend on its geometry only.
fn make_canonical(map: &ViewMap, steps: &mut [DirectedEdge], closed: bool) {
    let reverse = |steps: &mut [DirectedEdge]| {
        steps.reverse();
        for step in steps {
            *step = step.turned();
        }
    };
    if closed {
        let lower = |s: DirectedEdge| if order(map, s, s.turned()).is_le() { s } else { s.turned() };
        let canonical_order = |a: &usize, b: &usize| order(map, lower(steps[*a]), lower(steps[*b]));
        let Some(start) = (0..steps.len()).min_by(canonical_order) else { return };
        if order(map, steps[start], steps[start].turned()).is_le() {
            steps.rotate_left(start);
        } else {
            reverse(steps);
            let last = steps.len() - 1;
            steps.rotate_left(last - start);
        }
    } else if let (Some(first), Some(last)) = (steps.first(), steps.last())
        && order(map, *first, last.turned()).is_gt()
    {
        reverse(steps);
    }
}
