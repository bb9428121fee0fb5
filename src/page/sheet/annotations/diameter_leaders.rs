//! Dimensions of diameters and radii: a leader with an arrow to the circle, and the value on a shelf outside
//! the view.
//!
//! Leaders start radially in all directions. The cheapest one that touches nothing solid and whose value has
//! free paper is taken. The cost is the length; values on the left or below cost more, because lengths stand
//! there.

use kurbo::{Circle, Point, Rect, Shape as _, Vec2};

use super::dimension_style::{ARROW, HIGH};
use crate::error::Error;
use crate::geometry::numbers::portable_math::{cos, sin};
use crate::page::sheet::canvas::annotation_board::{Board, Word};
use crate::page::sheet::canvas::paper_occupancy::{Clear, Kind};
use crate::page::sheet::canvas::sheet_canvas::{CHAIN, NARROW, way};
use crate::page::sheet::dimensions::dimension_set::Led;

/// First distance of a value from the view, step size of the distance, mm, and number of steps.
const OUT: f64 = 5.0;
const FARTHER: f64 = 5.0;
const STEPS: u32 = 16;

/// Number of leader directions.
const WAYS: u32 = 72;

/// Extra cost of a value on the left and below, in mm of leader.
const LEFT: f64 = 25.0;
const BELOW: f64 = 15.0;

struct Leader {
    tip: Point,
    knee: Point,
    shelf: Point,
    /// Centre of the value.
    middle: Point,
    cost: f64,
}

/// Draws a diameter or a radius.
pub(crate) fn draw(rect: Rect, led: &Led, board: &mut Board) -> Result<(), Error> {
    let word = board.word(&led.text, HIGH)?;
    if let Some((middle, radius)) = led.pitch {
        let circle = Circle::new(middle, radius).to_path(1e-3);
        board.take_path(&circle, NARROW, Kind::Line);
        board.ink.path(circle, NARROW, &CHAIN);
    }
    let mut leaders: Vec<Leader> = (0..STEPS)
        .flat_map(|step| (0..WAYS).map(move |k| (k, f64::from(step) * FARTHER)))
        .map(|(k, more)| leader(led, rect, &word, (k, more)))
        .collect();
    leaders.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    let is_free = |leader: &&Leader, clear: Clear| {
        let both = rect.intersect(word.shape(word.centred(leader.middle)).bounds());
        (both.width() <= 0.0 || both.height() <= 0.0)
            && board.is_free(&word, word.centred(leader.middle))
            && board.is_line_free(leader.tip, leader.knee, clear)
            && board.is_line_free(leader.knee, leader.shelf, Clear::Solids)
            && board.taken.is_free(&Board::head(leader.tip, leader.tip - leader.knee, ARROW), Clear::Texts)
    };
    let found = [Clear::Leaders, Clear::Solids, Clear::Texts]
        .into_iter()
        .find_map(|clear| leaders.iter().find(|leader| is_free(leader, clear)));
    let Some(Leader { tip, knee, shelf, middle, .. }) = found else {
        board.unplaced.push(format!("the diameter `{}`", led.text));
        return Ok(());
    };
    board.ink.line(*knee, *tip, NARROW);
    board
        .taken
        .take(crate::page::sheet::canvas::paper_occupancy::Shape::line(*knee, *tip, NARROW), Kind::Leader);
    board.arrow(*tip, *tip - *knee, ARROW);
    board.ink.path(way(&[*knee, *shelf]), NARROW, &[]);
    board
        .taken
        .take(crate::page::sheet::canvas::paper_occupancy::Shape::line(*knee, *shelf, NARROW), Kind::Leader);
    let place = word.centred(*middle);
    board.write(&word, place);
    Ok(())
}

fn leader(led: &Led, rect: Rect, word: &Word, (k, more): (u32, f64)) -> Leader {
    let outer = rect.inflate(OUT, OUT);
    let turn = std::f64::consts::TAU * (f64::from(k) + 0.5) / f64::from(WAYS);
    let out = Vec2::new(cos(turn), -sin(turn));
    // Distances to the border of the view.
    let reach = |p: f64, d: f64, low: f64, high: f64| match d {
        d if d > 1e-9 => (high - p) / d,
        d if d < -1e-9 => (low - p) / d,
        _ => f64::INFINITY,
    };
    let (x, y) = (led.centre.x, led.centre.y);
    let far = reach(x, out.x, outer.x0, outer.x1).min(reach(y, out.y, outer.y0, outer.y1));
    let tip = led.centre + out * led.radius;
    let knee = led.centre + out * (far.max(led.radius + OUT) + more);
    let wide = word.bounds.width() + 2.0;
    let side = if out.x >= 0.0 { 1.0 } else { -1.0 };
    let shelf = knee + Vec2::new(side * wide, 0.0);
    let rise = 1.0 + word.bounds.y1.max(0.0) + word.bounds.height() / 2.0;
    let middle = knee + Vec2::new(side * wide / 2.0, -rise);
    let aside = if side > 0.0 { 0.0 } else { LEFT };
    let below = if knee.y <= rect.y1 { 0.0 } else { BELOW };
    Leader { tip, knee, shelf, middle, cost: far + more + aside + below }
}
