//! [`Measures`]: the lengths and diameters that views tell.

use glam::DVec3;
use kurbo::{Point, Vec2};

use super::hole_dimensions::Round;
use crate::page::sheet::arrangement::titles_and_notes::crossed;
use crate::page::sheet::arrangement::view_arrangement::Stands;
use crate::page::sheet::arrangement::view_plan::Plan;
use crate::page::sheet::lengths::length_precision::{Measured, Precision};
use crate::page::sheet::view::view_side::{Side, Told};

/// Positions nearer than this to the side, on paper, have no dimension, mm. No side has more dimensions of positions.
const SAME: f64 = 0.05;
const MOST: usize = 6;

/// A diameter or a radius with a line that leads to it.
#[derive(Debug, Clone)]
pub(crate) struct Led {
    pub centre: Point,
    /// On the page, mm.
    pub radius: f64,
    pub text: String,
    /// The circle that several stand on.
    pub pitch: Option<(Point, f64)>,
}

/// A length between two points along any direction, or on a line at a given place.
#[derive(Debug, Clone)]
pub(crate) struct Slanted {
    pub ends: [Point; 2],
    /// Its direction, of unit length.
    pub along: Vec2,
    /// How far from the points its line is, mm, to the right or below if above 0. Default: where it finds place.
    pub offset: Option<f64>,
    pub text: String,
}

/// What the views tell.
#[derive(Debug, Clone, Default)]
pub(crate) struct Measures {
    pub lengths: Vec<(usize, Told)>,
    pub slanted: Vec<(usize, Slanted)>,
    pub led: Vec<(usize, Led)>,
}

impl Measures {
    /// Adds a length along a side of a view.
    pub fn add(&mut self, view: usize, ends: [Point; 2], side: Side, text: String) {
        self.lengths.push((view, Told { ends, side, text }));
    }

    /// Adds the length, the height and the depth of the whole: below and on the left of the first view, and at one from another side.
    pub fn add_overall(&mut self, plan: &Plan) {
        let points = Measured::of_parts(&plan.sets[0].scene, |_| true);
        let mut told: Vec<DVec3> = Vec::new();
        let is_side = |k: &usize| matches!(plan.views[*k].stands, Stands::Beside(_));
        let mut sides: Vec<usize> = (0..plan.views.len()).filter(is_side).collect();
        // Lines of cutting planes stand in the way.
        sides.sort_by_key(|k| plan.cuts.iter().any(|cut| crossed(plan, cut) == Some(*k)));
        for view in sides {
            let sight = &plan.views[view].sight;
            let [right, up, _] = sight.axes();
            for (axis, side) in [(right, Side::Below), (up, Side::Left)] {
                if told.iter().any(|known| known.dot(axis).abs() > 1.0 - 1e-9) {
                    continue;
                }
                told.push(axis);
                // From the outermost points that are nearest to the line.
                let key = |p: &Measured| {
                    let page = sight.page(p.at);
                    if side.is_across() { (page.x, -page.y) } else { (page.y, page.x) }
                };
                let order = |a: &Measured, b: &Measured| {
                    let ((a, c), (b, d)) = (key(a), key(b));
                    a.total_cmp(&b).then(c.total_cmp(&d))
                };
                let last = |a: &Measured, b: &Measured| {
                    let ((a, c), (b, d)) = (key(a), key(b));
                    a.total_cmp(&b).then(d.total_cmp(&c))
                };
                let ends = (points.iter().copied().min_by(order), points.iter().copied().max_by(last));
                if let (Some(from), Some(to)) = ends {
                    let length = (to.at - from.at).dot(axis).abs();
                    let text = plan.values.written(length, Precision::between([from, to], axis));
                    self.add(view, [from, to].map(|p| sight.page(p.at)), side, text);
                }
            }
        }
    }

    /// Adds diameters, and the places of their axes from the left and from below.
    pub fn add_rounds(&mut self, plan: &Plan, rounds: &[Round]) {
        for round in rounds {
            let sight = &plan.views[round.view].sight;
            let count =
                if round.centres.len() > 1 { format!("{}× ", round.centres.len()) } else { String::new() };
            let pitch = round.pitch.map(|(middle, radius)| (sight.page(middle), radius * sight.unit));
            let on = round.pitch.map_or_else(String::new, |(_, radius)| {
                format!(" / ⌀{}", plan.values.written(2.0 * radius, round.precision))
            });
            let text = format!("{count}⌀{}{on}", plan.values.written(2.0 * round.radius, round.precision));
            let centres: Vec<Point> = round.centres.iter().map(|at| sight.page(*at)).collect();
            // The one that is nearest to the upper right corner.
            let high = |p: &Point| p.x - p.y;
            let Some(centre) = centres.iter().copied().max_by(|a, b| high(a).total_cmp(&high(b))) else {
                continue;
            };
            let radius = round.radius * sight.unit;
            self.led.push((round.view, Led { centre, radius, text, pitch }));
        }
        let mut views: Vec<usize> = rounds.iter().map(|round| round.view).collect();
        views.dedup();
        let step = if views.is_empty() { 0.0 } else { Measured::coarsest(&plan.sets[0].scene) };
        for view in views {
            let sight = &plan.views[view].sight;
            let rect = sight.rect();
            let own: Vec<&Round> = rounds.iter().filter(|round| round.view == view).collect();
            // Axes of holes, but of those in the middle of something round, which stand where it does.
            let outer: Vec<Point> = own
                .iter()
                .filter(|round| !round.hollow)
                .flat_map(|round| round.centres.iter().map(|at| sight.page(*at)))
                .collect();
            let places: Vec<(DVec3, Precision)> = own
                .iter()
                .filter(|round| round.hollow && round.pitch.is_none())
                .flat_map(|round| round.centres.iter().map(|at| (*at, round.precision)))
                .filter(|(at, _)| outer.iter().all(|other| (*other - sight.page(*at)).hypot2() > SAME * SAME))
                .collect();
            let [right, up, _] = sight.axes();
            let corner = plan.middle + right * sight.low.x + up * sight.low.y;
            for (side, axis) in [(Side::Below, right), (Side::Left, up)] {
                let mut done: Vec<String> = Vec::new();
                let mut sorted = places.clone();
                // Of several in line the one that is nearest to the side.
                sorted.sort_by(|(a, _), (b, _)| {
                    let along = |p: &DVec3| (p.dot(axis), p.dot(right + up - axis));
                    let ((a, c), (b, d)) = (along(a), along(b));
                    a.total_cmp(&b).then(c.total_cmp(&d))
                });
                for (at, precision) in sorted {
                    let far = (at - corner).dot(axis);
                    let ends = [Measured { at: corner, step }, Measured::exact(at)];
                    let text = plan.values.written(far, Precision::between(ends, axis).coarser(precision));
                    if far * sight.unit < SAME || done.len() >= MOST || done.contains(&text) {
                        continue;
                    }
                    done.push(text.clone());
                    let from = Point::new(rect.x0, rect.y1);
                    self.add(view, [from, sight.page(at)], side, text);
                }
            }
        }
    }
}
