//! Order of collapses: a greedy search that always takes the collapse with the least added error.

use crate::parallel::prelude::*;

use super::collapse_record::{CollapseRecord, NO_INDEX};
use super::cost_heap::CostHeap;
use super::edge_collapse::{Collapser, opposite_points};
use super::flat_surface::IndexedSurface;
use super::point_constraints::PointConstraint;
use crate::edit::tolerances::LENGTH_COST_WEIGHT;

/// Extra cost of a collapse at a point where borders and seams meet, as a share of the surrounding face area
/// times the squared distance. There one texture, colour or material spreads over another.
const CORNER_COST_SHARE: f64 = 0.1;

/// Maximum number of rounds that try blocked points again.
const MAX_RETRY_ROUNDS: usize = 8;

/// Maximum number of faces of a scene, instances counted.
pub(crate) struct FaceBudget<'a> {
    /// Number of instances of each geometry.
    pub shown: &'a [u64],
    /// Maximum number of faces in all.
    pub max_faces: u64,
}

/// Finds the collapses of a surface in their order, until the budget is met or none is possible.
pub(crate) fn record_collapses(flat: IndexedSurface, budget: &FaceBudget) -> CollapseRecord {
    let mut queue = CollapseQueue::new(Collapser::new(flat), budget);
    queue.start();
    for _ in 0..MAX_RETRY_ROUNDS {
        let before = queue.surface.record.steps.len();
        queue.run();
        if queue.faces <= budget.max_faces || queue.surface.record.steps.len() == before {
            break;
        }
        queue.start();
    }
    queue.surface.record
}

struct CollapseQueue<'a> {
    surface: Collapser,
    heap: CostHeap,
    /// Neighbour onto which each point would collapse.
    targets: Vec<u32>,
    budget: &'a FaceBudget<'a>,
    /// Present number of faces, instances counted.
    faces: u64,
    ring: Vec<u32>,
    choices: Vec<(f64, u32)>,
}

impl<'a> CollapseQueue<'a> {
    fn new(surface: Collapser, budget: &'a FaceBudget<'a>) -> Self {
        let shown =
            |face: usize| budget.shown.get(surface.flat.geometry[face] as usize).copied().unwrap_or(0);
        let alive = surface.corners.iter().enumerate().filter(|(_, corners)| corners[0] != NO_INDEX);
        let faces = alive.map(|(face, _)| shown(face)).sum();
        let (heap, targets) = (CostHeap::new(&[]), vec![NO_INDEX; surface.fans.len()]);
        Self { surface, heap, targets, budget, faces, ring: Vec::new(), choices: Vec::new() }
    }

    /// Queues all points that may collapse.
    fn start(&mut self) {
        let best: Vec<Option<(f64, u32)>> =
            (0..self.targets.len() as u32).into_par_iter().map(|point| self.best(point)).collect();
        for (target, best) in self.targets.iter_mut().zip(&best) {
            *target = best.map_or(NO_INDEX, |best| best.1);
        }
        self.heap = CostHeap::new(&best.iter().map(|best| best.map(|best| best.0)).collect::<Vec<_>>());
    }

    fn run(&mut self) {
        while self.faces > self.budget.max_faces {
            let Some((cost, point)) = self.heap.pop() else { return };
            let target = std::mem::replace(&mut self.targets[point as usize], NO_INDEX);
            if !self.surface.can_collapse(point, target) {
                self.wait_for_next(point, (cost, target));
                continue;
            }
            self.surface.collapse(point, target);
            for face in self.surface.removed() {
                let geometry = self.surface.flat.geometry[*face as usize] as usize;
                self.faces -= self.budget.shown.get(geometry).copied().unwrap_or(0);
            }
            self.renew(point, target);
        }
    }

    /// Cost of collapsing a point onto another: the increase of its quadric error, plus the penalties for
    /// distance and corners.
    #[inline]
    fn cost(&self, from: u32, to: u32) -> f64 {
        let site = &self.surface.sites[from as usize];
        let target = self.surface.sites[to as usize].place;
        let long = site.place.distance_squared(target);
        let covered = if site.kind == PointConstraint::Corner {
            CORNER_COST_SHARE * site.quadric.weight() * long
        } else {
            0.0
        };
        site.quadric.at(target) - site.error + LENGTH_COST_WEIGHT * long * long + covered
    }

    /// Whether the borders and seams at a point allow a collapse onto another point.
    fn allows(&self, from: u32, to: u32) -> bool {
        let site = &self.surface.sites[from as usize];
        match site.kind {
            PointConstraint::Plain => true,
            PointConstraint::Line => site.along.contains(&to),
            PointConstraint::Knot => true,
            PointConstraint::Corner => self.surface.sites[to as usize].kind != PointConstraint::Plain,
        }
    }

    /// Cheapest collapse of a point, without checking that it is possible.
    fn best(&self, point: u32) -> Option<(f64, u32)> {
        let mut best = (f64::INFINITY, NO_INDEX);
        let mut ask = |other: u32| {
            let choice = (self.cost(point, other), other);
            if choice < best {
                best = choice;
            }
        };
        let is_plain = self.surface.sites[point as usize].kind == PointConstraint::Plain;
        for face in self.surface.fans.about(point) {
            let corners = self.surface.corners[*face as usize];
            if corners[0] == NO_INDEX {
                continue;
            }
            let [next, last] = opposite_points(corners, point);
            if is_plain {
                // Inside a surface each neighbour is the next corner in exactly one face.
                ask(next);
            } else {
                [next, last].into_iter().filter(|other| self.allows(point, *other)).for_each(&mut ask);
            }
        }
        (best.1 != NO_INDEX).then_some(best)
    }

    /// Queues a point whose first choice is impossible at its next best possible target.
    fn wait_for_next(&mut self, point: u32, refused: (f64, u32)) {
        let mut ring = std::mem::take(&mut self.ring);
        self.surface.neighbours(point, &mut ring);
        self.choices.clear();
        for other in &ring {
            if *other != refused.1 && self.allows(point, *other) {
                self.choices.push((self.cost(point, *other), *other));
            }
        }
        self.choices.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let (surface, choices) = (&mut self.surface, &self.choices);
        if let Some((cost, target)) =
            choices.iter().find(|choice| surface.can_collapse(point, choice.1)).copied()
        {
            self.targets[point as usize] = target;
            self.heap.set(point, cost);
        }
        self.ring = ring;
    }

    /// Updates the queue entries of points around a collapse, whose costs or targets may have changed.
    fn renew(&mut self, gone: u32, target: u32) {
        self.wait(target);
        let mut ring = std::mem::take(&mut self.ring);
        self.surface.neighbours(target, &mut ring);
        for &point in &ring {
            let aim = self.targets[point as usize];
            let is_plain = self.surface.sites[point as usize].kind == PointConstraint::Plain;
            match self.heap.cost(point) {
                Some(cost) if is_plain && aim != gone => {
                    let new = self.cost(point, target);
                    if new < cost {
                        self.targets[point as usize] = target;
                        self.heap.set(point, new);
                    }
                }
                _ => self.wait(point),
            }
        }
        self.ring = ring;
    }

    fn wait(&mut self, point: u32) {
        match self.best(point) {
            Some((cost, target)) => {
                self.targets[point as usize] = target;
                self.heap.set(point, cost);
            }
            None => self.heap.remove(point),
        }
    }
}
