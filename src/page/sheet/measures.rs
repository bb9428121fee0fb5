//! [`Measures`]: the lengths and diameters that views tell.

use glam::DVec3;
use kurbo::{Point, Vec2};

use super::arrange::Stands;
use super::dimension::value;
use super::notes::crossed;
use super::plan::Plan;
use super::rounds::Round;
use super::rows::{Side, Told};
use crate::scene::framing::world_points;

/// Positions nearer than this on paper are one, mm; more of them are told on no side.
const SAME: f64 = 0.05;
const MOST: usize = 6;

/// A diameter or a radius with a line that leads to it.
#[derive(Debug, Clone)]
pub(super) struct Led {
    pub centre: Point,
    /// On the page, mm.
    pub radius: f64,
    pub text: String,
    /// The circle that several stand on.
    pub pitch: Option<(Point, f64)>,
}

/// A length between two points along any direction, or on a line at a given place.
#[derive(Debug, Clone)]
pub(super) struct Slanted {
    pub ends: [Point; 2],
    /// Its direction, of unit length.
    pub along: Vec2,
    /// How far from the points its line is, mm, to the right or below if above 0. Default: where it finds place.
    pub offset: Option<f64>,
    pub text: String,
}

/// What the views tell.
#[derive(Debug, Clone, Default)]
pub(super) struct Measures {
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
        let points = world_points(&plan.sets[0].scene);
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
                let key = |p: &DVec3| {
                    let page = sight.page(*p);
                    if side.is_across() { (page.x, -page.y) } else { (page.y, page.x) }
                };
                let order = |a: &DVec3, b: &DVec3| {
                    let ((a, c), (b, d)) = (key(a), key(b));
                    a.total_cmp(&b).then(c.total_cmp(&d))
                };
                let last = |a: &DVec3, b: &DVec3| {
                    let ((a, c), (b, d)) = (key(a), key(b));
                    a.total_cmp(&b).then(d.total_cmp(&c))
                };
                let ends = (points.iter().copied().min_by(order), points.iter().copied().max_by(last));
                if let (Some(from), Some(to)) = ends {
                    let text = value((to - from).dot(axis).abs() * plan.unit_mm);
                    self.add(view, [sight.page(from), sight.page(to)], side, text);
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
                format!(" / ⌀{}", value(2.0 * radius * plan.unit_mm))
            });
            let text = format!("{count}⌀{}{on}", value(2.0 * round.radius * plan.unit_mm));
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
            let places: Vec<Point> = own
                .iter()
                .filter(|round| round.hollow && round.pitch.is_none())
                .flat_map(|round| round.centres.iter().map(|at| sight.page(*at)))
                .filter(|at| outer.iter().all(|other| (*other - *at).hypot2() > SAME * SAME))
                .collect();
            for side in [Side::Below, Side::Left] {
                let across = side.is_across();
                let from = Point::new(rect.x0, rect.y1);
                let mut done: Vec<f64> = Vec::new();
                let mut sorted = places.clone();
                // Of several in line the one that is nearest to the side.
                sorted.sort_by(|a, b| {
                    let key = |p: &Point| if across { (p.x, -p.y) } else { (-p.y, p.x) };
                    let ((a, c), (b, d)) = (key(a), key(b));
                    a.total_cmp(&b).then(c.total_cmp(&d))
                });
                for at in sorted {
                    let far = if across { at.x - from.x } else { from.y - at.y };
                    if far < SAME || done.len() >= MOST || done.iter().any(|known| (known - far).abs() < SAME)
                    {
                        continue;
                    }
                    done.push(far);
                    let text = value(far / sight.unit * plan.unit_mm);
                    self.add(view, [from, at], side, text);
                }
            }
        }
    }
}
