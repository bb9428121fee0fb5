//! The order of collapses: at each moment the one that adds least error.

use crate::parallel::prelude::*;

use super::collapse_record::{NONE, Record};
use super::cost_heap::Heap;
use super::edge_collapse::{Collapser, others};
use super::flat_surface::Flat;
use super::point_constraints::Kind;

/// What keeps faces that cost nothing in shape: a part of the fourth power of the length that a point falls.
const LENGTH_COST: f64 = 1e-10;

/// Where borders and seams meet in a point, how far it falls counts besides, for this share of the faces about it: there what
/// one texture, colour or material covers is covered by another.
const CORNER_SHARE: f64 = 0.1;

/// How often points that could not go are asked again after all others have gone.
const ROUNDS: usize = 8;

/// How many faces a scene has: those of each geometry, as often as it is shown.
pub(crate) struct Budget<'a> {
    /// How often each geometry is shown.
    pub shown: &'a [u64],
    /// How many faces there may be in all.
    pub most: u64,
}

/// The collapses of a surface in their order, until it has no more faces than it may, or none can go.
pub(crate) fn collapses(flat: Flat, budget: &Budget) -> Record {
    let mut queue = Queue::new(Collapser::new(flat), budget);
    queue.start();
    for _ in 0..ROUNDS {
        let before = queue.surface.record.steps.len();
        queue.run();
        if queue.faces <= budget.most || queue.surface.record.steps.len() == before {
            break;
        }
        queue.start();
    }
    queue.surface.record
}

struct Queue<'a> {
    surface: Collapser,
    heap: Heap,
    /// Where each point would fall.
    targets: Vec<u32>,
    budget: &'a Budget<'a>,
    /// How many faces there are now, instances counted.
    faces: u64,
    ring: Vec<u32>,
    choices: Vec<(f64, u32)>,
}

impl<'a> Queue<'a> {
    fn new(surface: Collapser, budget: &'a Budget<'a>) -> Self {
        let shown =
            |face: usize| budget.shown.get(surface.flat.geometry[face] as usize).copied().unwrap_or(0);
        let alive = surface.corners.iter().enumerate().filter(|(_, corners)| corners[0] != NONE);
        let faces = alive.map(|(face, _)| shown(face)).sum();
        let (heap, targets) = (Heap::new(&[]), vec![NONE; surface.fans.len()]);
        Self { surface, heap, targets, budget, faces, ring: Vec::new(), choices: Vec::new() }
    }

    /// Lets all points wait that may go anywhere.
    fn start(&mut self) {
        let best: Vec<Option<(f64, u32)>> =
            (0..self.targets.len() as u32).into_par_iter().map(|point| self.best(point)).collect();
        for (target, best) in self.targets.iter_mut().zip(&best) {
            *target = best.map_or(NONE, |best| best.1);
        }
        self.heap = Heap::new(&best.iter().map(|best| best.map(|best| best.0)).collect::<Vec<_>>());
    }

    fn run(&mut self) {
        while self.faces > self.budget.most {
            let Some((cost, point)) = self.heap.pop() else { return };
            let target = std::mem::replace(&mut self.targets[point as usize], NONE);
            if !self.surface.may(point, target) {
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

    /// What it costs if a point falls onto another: how much farther from all planes that ever were about it it comes to lie.
    #[inline]
    fn cost(&self, from: u32, to: u32) -> f64 {
        let site = &self.surface.sites[from as usize];
        let target = self.surface.sites[to as usize].place;
        let long = site.place.distance_squared(target);
        let covered =
            if site.kind == Kind::Corner { CORNER_SHARE * site.quadric.weight() * long } else { 0.0 };
        site.quadric.at(target) - site.error + LENGTH_COST * long * long + covered
    }

    /// Whether a point that has lines through it may fall onto another.
    fn allows(&self, from: u32, to: u32) -> bool {
        let site = &self.surface.sites[from as usize];
        match site.kind {
            Kind::Plain => true,
            Kind::Line => site.along.contains(&to),
            Kind::Knot => true,
            Kind::Corner => self.surface.sites[to as usize].kind != Kind::Plain,
        }
    }

    /// Where a point falls at the least cost, without a look at whether it may.
    fn best(&self, point: u32) -> Option<(f64, u32)> {
        let mut best = (f64::INFINITY, NONE);
        let mut ask = |other: u32| {
            let choice = (self.cost(point, other), other);
            if choice < best {
                best = choice;
            }
        };
        let is_plain = self.surface.sites[point as usize].kind == Kind::Plain;
        for face in self.surface.fans.about(point) {
            let corners = self.surface.corners[*face as usize];
            if corners[0] == NONE {
                continue;
            }
            let [next, last] = others(corners, point);
            if is_plain {
                // In the middle of a surface each neighbour comes next in one face.
                ask(next);
            } else {
                [next, last].into_iter().filter(|other| self.allows(point, *other)).for_each(&mut ask);
            }
        }
        (best.1 != NONE).then_some(best)
    }

    /// Lets a point that may not fall where it would wait for the next best place of all.
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
        if let Some((cost, target)) = choices.iter().find(|choice| surface.may(point, choice.1)).copied() {
            self.targets[point as usize] = target;
            self.heap.set(point, cost);
        }
        self.ring = ring;
    }

    /// Lets the points wait anew about which a collapse has changed what they may do or what it costs.
    fn renew(&mut self, gone: u32, target: u32) {
        self.wait(target);
        let mut ring = std::mem::take(&mut self.ring);
        self.surface.neighbours(target, &mut ring);
        for &point in &ring {
            let aim = self.targets[point as usize];
            let is_plain = self.surface.sites[point as usize].kind == Kind::Plain;
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
