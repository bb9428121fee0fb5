//! [`leaders`]: which balloon around a view each item gets, so that no two leaders cross.
//!
//! Leaders are straight. Exchanging the balloons of two leaders that cross makes both together shorter (triangle inequality), so that
//! doing it as long as it can be done ends with none that cross. Those that then run through the circle of another balloon go to other
//! places, as long as that leaves fewer that do.

use kurbo::{Point, Rect};
use robust::{Coord, orient2d};

/// Room that a balloon takes along the border, as little as may be, mm.
pub(super) const ROOM: f64 = 10.0;

/// Radius of a balloon, and what leaders keep clear around it, mm.
pub const RADIUS: f64 = 4.0;
const CLEAR: f64 = 0.6;

/// More exchanges than this are made by no sheet.
const MOST: usize = 100_000;

/// Places for balloons on the border of a rectangle, clockwise from its upper left corner; at least `count`, closer together than 10 mm
/// only where there is no more room.
#[must_use]
pub fn slots(border: Rect, count: usize) -> Vec<Point> {
    let around = 2.0 * (border.width() + border.height());
    let number = ((around / ROOM).floor() as usize).max(count).max(1);
    let step = around / number as f64;
    let at = |along: f64| {
        let (w, h) = (border.width(), border.height());
        match along {
            x if x < w => Point::new(border.x0 + x, border.y0),
            x if x < w + h => Point::new(border.x1, border.y0 + x - w),
            x if x < 2.0 * w + h => Point::new(border.x1 - (x - w - h), border.y1),
            x => Point::new(border.x0, border.y1 - (x - 2.0 * w - h)),
        }
    };
    (0..number).map(|k| at((k as f64 + 0.5) * step)).collect()
}

/// For each anchor the number of its slot: no two leaders cross or touch, but where more than two points lie on one line.
#[must_use]
pub fn leaders(anchors: &[Point], slots: &[Point]) -> Vec<usize> {
    let length = |anchor: usize, slot: usize| (anchors[anchor] - slots[slot]).hypot2().sqrt();
    let mut free = vec![true; slots.len()];
    let mut of: Vec<usize> = Vec::with_capacity(anchors.len());
    for anchor in 0..anchors.len() {
        let nearest = (0..slots.len())
            .filter(|slot| free[*slot])
            .min_by(|a, b| length(anchor, *a).total_cmp(&length(anchor, *b)));
        let Some(slot) = nearest else { return of };
        free[slot] = false;
        of.push(slot);
    }
    for _ in 0..MOST {
        // The pair that crosses, or that gains by exchange.
        let pair = (0..of.len()).flat_map(|a| (0..a).map(move |b| (a, b))).find(|(a, b)| {
            let [one, other] = [[anchors[*a], slots[of[*a]]], [anchors[*b], slots[of[*b]]]];
            let gain = length(*a, of[*a]) + length(*b, of[*b]) - length(*a, of[*b]) - length(*b, of[*a]);
            gain > 1e-9 || cross(one, other) && gain > 0.0
        });
        let Some((a, b)) = pair else { break };
        of.swap(a, b);
    }
    clear(anchors, slots, &mut of);
    of
}

/// Moves balloons whose leaders cross others or run through their circles, or others through theirs, to places where fewer do.
fn clear(anchors: &[Point], slots: &[Point], of: &mut [usize]) {
    let between = |of: &[usize], k: usize, other: usize| {
        let [own, its] = [k, other].map(|k| [anchors[k], slots[of[k]]]);
        usize::from(cross(own, its))
            + usize::from(runs_through(own, its[1]))
            + usize::from(runs_through(its, own[1]))
    };
    let faults = |of: &[usize], k: usize| -> usize {
        (0..of.len()).filter(|other| *other != k).map(|other| between(of, k, other)).sum()
    };
    let long = |of: &[usize], k: usize| (anchors[k] - slots[of[k]]).hypot2().sqrt();
    loop {
        // The change that leaves fewest, of those the one by which leaders grow least.
        let mut best: Option<(usize, f64, usize, usize)> = None;
        for k in 0..of.len() {
            let own = faults(of, k);
            let from = of[k];
            for slot in (0..slots.len()).filter(|slot| own > 0 && *slot != from) {
                let other = of.iter().position(|taken| *taken == slot);
                let both = |of: &[usize]| match other {
                    None => (faults(of, k), long(of, k)),
                    Some(other) => (
                        faults(of, k) + faults(of, other) - between(of, k, other),
                        long(of, k) + long(of, other),
                    ),
                };
                let before = both(of);
                of[k] = slot;
                other.iter().for_each(|other| of[*other] = from);
                let after = both(of);
                of[k] = from;
                other.iter().for_each(|other| of[*other] = slot);
                let (gain, longer) = (before.0.saturating_sub(after.0), after.1 - before.1);
                let is_better =
                    best.is_none_or(|(known, length, ..)| gain > known || gain == known && longer < length);
                if gain > 0 && is_better {
                    best = Some((gain, longer, k, slot));
                }
            }
        }
        let Some((_, _, k, slot)) = best else { return };
        if let Some(other) = of.iter().position(|taken| *taken == slot) {
            of[other] = of[k];
        }
        of[k] = slot;
    }
}

/// Whether a leader runs through the circle of a balloon that it does not lead to.
#[must_use]
pub fn runs_through([a, b]: [Point; 2], centre: Point) -> bool {
    let way = b - a;
    let share = ((centre - a).dot(way) / way.hypot2().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    (a + way * share - centre).hypot2().sqrt() < RADIUS + CLEAR
}

/// Whether two segments have a point in common, exactly.
#[must_use]
pub fn cross([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    let coord = |p: Point| Coord { x: p.x, y: p.y };
    let side = |p: Point, q: Point, r: Point| {
        let turn = orient2d(coord(p), coord(q), coord(r));
        i8::from(turn > 0.0) - i8::from(turn < 0.0)
    };
    let on = |p: Point, q: Point, r: Point| {
        side(p, q, r) == 0
            && (p.x.min(q.x)..=p.x.max(q.x)).contains(&r.x)
            && (p.y.min(q.y)..=p.y.max(q.y)).contains(&r.y)
    };
    let apart = side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
    apart || on(a, b, c) || on(a, b, d) || on(c, d, a) || on(c, d, b)
}
