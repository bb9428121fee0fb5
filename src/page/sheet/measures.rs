//! [`Measures`]: the lengths and diameters that views tell, and where they stand beside them.

use glam::DVec3;
use kurbo::{Point, Rect, Vec2};

use super::arrange::{BETWEEN, Stands, TITLE};
use super::balloons::cross;
use super::dimension::{HIGH, dimension};
use super::ink::{CHAIN, Ink, NARROW, Stand, way};
use super::notes::crossed;
use super::plan::Plan;
use super::precision::{Measured, Precision};
use super::rounds::Round;
use super::rows::{FIRST, STEP, Side, Told, rows};
use crate::error::Error;

/// Room of a cutting plane's letters, mm.
const LETTERS: f64 = 10.0;

/// How far beyond the outline a diameter is written, and the room around its text, mm.
const OUT: f64 = 5.0;
const AROUND: f64 = 1.0;

/// Positions nearer than this to the side, on paper, have no dimension, mm. No side has more dimensions of positions.
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

/// What the views tell.
#[derive(Debug, Clone, Default)]
pub(super) struct Measures {
    pub lengths: Vec<(usize, Told)>,
    pub led: Vec<(usize, Led)>,
}

impl Measures {
    /// Adds a length along a side of a view.
    pub fn add(
        &mut self,
        view: usize,
        ends: [Point; 2],
        side: Side,
        text: String,
        ink: &Ink,
    ) -> Result<(), Error> {
        let wide = ink.width(&text, HIGH)?;
        self.lengths.push((view, Told { ends, side, text, wide }));
        Ok(())
    }

    /// Adds the length, the height and the depth of the whole: below and on the left of the first view, and at one from another side.
    pub fn add_overall(&mut self, plan: &Plan, ink: &Ink) -> Result<(), Error> {
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
                    self.add(view, [from, to].map(|p| sight.page(p.at)), side, text, ink)?;
                }
            }
        }
        Ok(())
    }

    /// Adds diameters, and the places of their axes from the left and from below.
    pub fn add_rounds(&mut self, plan: &Plan, rounds: &[Round], ink: &Ink) -> Result<(), Error> {
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
                    self.add(view, [from, sight.page(at)], side, text, ink)?;
                }
            }
        }
        Ok(())
    }

    /// The room that they need beyond what views have anyway, mm: for each view on the left, above, on the right, below.
    pub fn room(&self, plan: &Plan, ink: &Ink) -> Result<Vec<[f64; 4]>, Error> {
        let mut room = vec![[0.0_f64; 4]; plan.views.len()];
        for (view, told, at) in self.stacked(plan) {
            let side = told.side as usize;
            room[view][side] = room[view][side].max(at + 2.0 - BETWEEN / 2.0);
        }
        for (view, led) in &self.led {
            let wide = ink.width(&led.text, HIGH)? + OUT + 2.0 * AROUND;
            room[*view][2] = room[*view][2].max(wide - BETWEEN / 2.0);
            room[*view][1] = room[*view][1].max(OUT + HIGH - BETWEEN / 2.0);
        }
        Ok(room)
    }

    /// Lengths with the distance of their lines from the view.
    fn stacked(&self, plan: &Plan) -> Vec<(usize, &Told, f64)> {
        let mut found = Vec::new();
        for view in 0..plan.views.len() {
            let own: Vec<&Told> =
                self.lengths.iter().filter(|(of, _)| *of == view).map(|(_, told)| told).collect();
            let told: Vec<Told> = own.iter().map(|told| (*told).clone()).collect();
            for (told, row) in own.into_iter().zip(rows(&told)) {
                let first = FIRST + if is_crossed(plan, view, told.side) { LETTERS } else { 0.0 };
                found.push((view, told, first + STEP * row as f64));
            }
        }
        found
    }

    /// Draws all of them.
    pub fn draw(&self, plan: &Plan, ink: &mut Ink) -> Result<(), Error> {
        let mut taken: Vec<Vec<Rect>> = vec![Vec::new(); plan.views.len()];
        for (view, told, at) in self.stacked(plan) {
            let rect = plan.views[view].sight.rect();
            let (along, through) = match told.side {
                Side::Left => (Vec2::new(0.0, 1.0), Point::new(rect.x0 - at, rect.y0)),
                Side::Right => (Vec2::new(0.0, 1.0), Point::new(rect.x1 + at, rect.y0)),
                Side::Above => (Vec2::new(1.0, 0.0), Point::new(rect.x0, rect.y0 - at)),
                Side::Below => (Vec2::new(1.0, 0.0), Point::new(rect.x0, rect.y1 + at)),
            };
            dimension(told.ends, along, through, &told.text, ink)?;
            let [a, b] = told.ends.map(|p| if told.side.is_across() { p.x } else { p.y });
            let (low, high) = (a.min(b) - told.wide, a.max(b) + told.wide);
            taken[view].push(if told.side.is_across() {
                Rect::new(low, through.y - HIGH - 1.5, high, through.y + 1.0)
            } else {
                Rect::new(through.x - HIGH - 1.5, low, through.x + 1.0, high)
            });
        }
        let mut lines: Vec<[Point; 2]> = Vec::new();
        for (view, led) in &self.led {
            let rect = plan.views[*view].sight.rect();
            let title = plan.views[*view].sight.title.is_some();
            if title {
                taken[*view].push(Rect::new(rect.x0, rect.y0 - TITLE - 2.0, rect.x1, rect.y0 - 1.0));
            }
            let wide = ink.width(&led.text, HIGH)?;
            let place = led_place(led, rect, wide, &taken[*view], &lines);
            if let Some((middle, radius)) = led.pitch {
                ink.path(kurbo::Shape::to_path(&kurbo::Circle::new(middle, radius), 1e-3), NARROW, &CHAIN);
            }
            let LedPlace { tip, knee, text } = place;
            let towards = tip - knee;
            ink.line(knee, tip, NARROW);
            ink.arrow(tip, towards, super::dimension::ARROW);
            let right = text.x0 >= knee.x;
            let shelf = if right { text.x1 } else { text.x0 };
            ink.path(way(&[knee, Point::new(shelf, knee.y)]), NARROW, &[]);
            ink.word(&led.text, Point::new(text.center().x, knee.y - 1.0), HIGH, Stand::Middle, 0.0)?;
            taken[*view].push(text.inflate(AROUND, AROUND));
            lines.push([tip, knee]);
        }
        Ok(())
    }
}

/// Whether the line of a cutting plane ends on that side of a view.
fn is_crossed(plan: &Plan, view: usize, side: Side) -> bool {
    plan.cuts.iter().filter(|cut| crossed(plan, cut) == Some(view)).any(|cut| {
        let sight = &plan.views[view].sight;
        let back = sight.page(plan.middle + cut.plane.normal()) - sight.page(plan.middle);
        // It runs across what it is looked at along.
        (back.x.abs() < back.y.abs()) != side.is_across()
    })
}

/// Where a diameter is written.
struct LedPlace {
    tip: Point,
    knee: Point,
    text: Rect,
}

/// A place outside the outline where neither the text nor the line to it meets others; the shortest line of those.
fn led_place(led: &Led, rect: Rect, wide: f64, taken: &[Rect], lines: &[[Point; 2]]) -> LedPlace {
    const WAYS: u32 = 36;
    let outer = rect.inflate(OUT, OUT);
    let of = |k: u32, more: f64| {
        let turn = std::f64::consts::TAU * (f64::from(k) + 0.5) / f64::from(WAYS);
        let out = Vec2::new(crate::math::function::cos(turn), -crate::math::function::sin(turn));
        let tip = led.centre + out * led.radius;
        // To the border of the outline.
        let reach = |p: f64, d: f64, low: f64, high: f64| match d {
            d if d > 1e-9 => (high - p) / d,
            d if d < -1e-9 => (low - p) / d,
            _ => f64::INFINITY,
        };
        let far = reach(led.centre.x, out.x, outer.x0, outer.x1).min(reach(
            led.centre.y,
            out.y,
            outer.y0,
            outer.y1,
        ));
        let knee = led.centre + out * (far.max(led.radius + OUT) + more);
        let x = if out.x >= 0.0 { [knee.x, knee.x + wide + 2.0] } else { [knee.x - wide - 2.0, knee.x] };
        (LedPlace { tip, knee, text: Rect::new(x[0], knee.y - HIGH - 1.0, x[1], knee.y) }, far + more)
    };
    let is_free = |place: &LedPlace| {
        let room = place.text.inflate(AROUND, AROUND);
        let meets = |other: &Rect| {
            let both = other.intersect(room);
            both.width() > 0.0 && both.height() > 0.0
        };
        let within = rect.intersect(place.text);
        let through = |other: &Rect| {
            let sides =
                [[(other.x0, other.y0), (other.x1, other.y1)], [(other.x0, other.y1), (other.x1, other.y0)]];
            sides.iter().any(|side| cross([place.tip, place.knee], side.map(Point::from)))
        };
        let is_outside = within.width() <= 0.0 || within.height() <= 0.0;
        is_outside
            && !taken.iter().any(|other| meets(other) || through(other))
            && !lines.iter().any(|line| cross(*line, [place.tip, place.knee]))
    };
    let candidates = || {
        let steps = (0..4).flat_map(|step| (0..WAYS).map(move |k| (k, f64::from(step) * 6.0)));
        steps.map(|(k, more)| {
            let (place, far) = of(k, more);
            // To the right and upwards rather than where lengths stand.
            let aside = if place.text.x0 >= place.knee.x { 0.0 } else { 25.0 };
            let below = if place.knee.y <= rect.y1 { 0.0 } else { 15.0 };
            (place, far + aside + below)
        })
    };
    let best = candidates().filter(|(place, _)| is_free(place)).min_by(|a, b| a.1.total_cmp(&b.1));
    best.map_or_else(|| of(2, 0.0).0, |(place, _)| place)
}
