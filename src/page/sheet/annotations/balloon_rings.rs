//! Balloons around a view, in one ring or two, as near to the view as free paper allows.
//!
//! A ring is a rectangle around the view with slots for balloons.
//!
//! 1. Slots on free paper are assigned to the items so that no two leaders cross ([`leaders`], [`spokes`]).
//! 2. If there are too few slots, or a leader crosses another one, a text or a balloon, the next rings are
//!    tried.
//! 3. The next rings are farther out, or there are two. Slots of two rings are staggered, so leaders of the
//!    outer ring run between the balloons of the inner ring.

use kurbo::{Affine, Circle, Point, Rect, Shape as _, Vec2};

use crate::error::Error;
use crate::geometry::numbers::portable_math::{cos, sin};
use crate::page::sheet::canvas::annotation_board::Board;
use crate::page::sheet::canvas::paper_occupancy::{Clear, Kind, Shape};
use crate::page::sheet::canvas::sheet_canvas::NARROW;
use crate::page::sheet::part_balloons::leader_assignment::{
    RADIUS, cross, leaders, runs_through, slots, spokes,
};
use crate::page::sheet::parts_list::parts_list_items::Item;

/// Letter height of numbers, mm.
const LETTERS: f64 = 3.5;

/// Distance from the view to the first ring, and from ring to ring, mm.
const FIRST: f64 = 10.0;
const STEP: f64 = 9.5;

/// Length of border per balloon in a single ring, mm.
const ALONE: f64 = 10.0;

/// Distance from the centre of a balloon to a leader that passes it, mm: radius, clearance, and the slant of
/// leaders.
const PASSING: f64 = 5.2;

/// Clearance around a balloon, mm.
const CLEAR: f64 = 0.8;

/// Maximum number of rings; outward step of the outermost ring, mm; number of such steps.
const RINGS: u32 = 2;
const FARTHER: f64 = 3.0;
const STEPS: u32 = 32;

/// Draws the balloons of all items that have an anchor.
pub(crate) fn draw(
    rect: Rect,
    items: &[Item],
    anchors: &[Option<Point>],
    board: &mut Board,
) -> Result<(), Error> {
    let seen: Vec<(usize, Point)> =
        anchors.iter().enumerate().filter_map(|(k, anchor)| anchor.map(|anchor| (k, anchor))).collect();
    let points: Vec<Point> = seen.iter().map(|(_, anchor)| *anchor).collect();
    if points.is_empty() {
        return Ok(());
    }
    // The offset of the outermost ring decides, because the view needs that much room. If nothing else fits,
    // leaders may cross those of diameters, and then arrow heads.
    let ways = [(Clear::Leaders, STEPS / 3), (Clear::Solids, STEPS / 3), (Clear::Texts, STEPS)];
    let rings = ways.into_iter().flat_map(|(clear, steps)| {
        (0..steps).flat_map(move |step| {
            let away = FARTHER * f64::from(step);
            let farther = move |rings: u32| (clear, rings, away - STEP * f64::from(rings - 1));
            (1..=RINGS).map(farther).filter(|(.., farther)| *farther >= 0.0)
        })
    });
    let found = rings.into_iter().find_map(|(clear, rings, farther)| {
        let places = places(rect, (rings, farther), board);
        if places.len() < points.len() {
            return None;
        }
        let is_blocked = |p: &Point, place: &Point| {
            !board.taken.is_free(&Shape::line(*p, *place, NARROW).wider(0.3), clear)
        };
        let blocked: Vec<Vec<bool>> =
            points.iter().map(|p| places.iter().map(|place| is_blocked(p, place)).collect()).collect();
        if blocked.iter().any(|places| places.iter().all(|is_blocked| *is_blocked)) {
            return None;
        }
        let lines = |of: &[usize]| -> Vec<[Point; 2]> {
            points.iter().zip(of).map(|(p, slot)| [*p, places[*slot]]).collect()
        };
        let is_clear = |of: &Vec<usize>| {
            let lines = lines(of);
            lines.iter().enumerate().all(|(k, own)| {
                !blocked[k][of[k]]
                    && lines.iter().enumerate().all(|(n, other)| {
                        n == k || !runs_through(*own, other[1]) && (n < k || !cross(*own, *other))
                    })
            })
        };
        let nearest = leaders(&points, &places, &|k, place| blocked[k][place]);
        if is_clear(&nearest) {
            return Some(lines(&nearest));
        }
        let spokes = spokes(&points, &places, &|k, place| blocked[k][place]);
        is_clear(&spokes).then(|| lines(&spokes))
    });
    let Some(lines) = found else {
        let numbers: Vec<&str> = seen.iter().map(|(item, _)| &*items[*item].number).collect();
        let (first, last) = (numbers.first().unwrap_or(&""), numbers.last().unwrap_or(&""));
        board.unplaced.push(match numbers.len() {
            1 => format!("the balloon {first}"),
            count => format!("the {count} balloons {first} to {last}"),
        });
        return Ok(());
    };
    for ((item, _), [anchor, centre]) in seen.iter().zip(lines) {
        let towards = anchor - centre;
        let far = towards.hypot2().sqrt();
        if far > RADIUS {
            let end = centre + towards * (RADIUS / far);
            board.balloons.line(end, anchor, NARROW);
            board.taken.take(Shape::line(end, anchor, NARROW), Kind::Leader);
        }
        board.balloons.fill(Circle::new(anchor, 0.5).to_path(1e-3));
        board.balloons.circle(centre, RADIUS, NARROW);
        board.taken.take(Shape::disc(centre, RADIUS), Kind::Solid);
        let word = board.word_within(&items[*item].number, LETTERS, 2.0 * RADIUS - 1.5)?;
        // All numbers share a baseline, whether or not they have descenders.
        let at = Point::new(centre.x - word.bounds.center().x, centre.y - word.bounds.y0 / 2.0);
        board.write_in_balloon(&word, Affine::translate(at.to_vec2()));
    }
    Ok(())
}

/// Slots of one ring or two that are on free paper.
fn places(rect: Rect, (rings, farther): (u32, f64), board: &Board) -> Vec<Point> {
    let inner = rect.inflate(FIRST + farther, FIRST + farther);
    let all = if rings == 1 { slots(inner, ALONE, 0.5) } else { staggered(inner) };
    // At corners, slots of neighbouring sides may be close to each other.
    let mut kept: Vec<Point> = Vec::new();
    for p in all {
        let near = 2.0 * RADIUS + CLEAR;
        let is_free = board.taken.is_free(&Shape::disc(p, RADIUS + CLEAR), Clear::All);
        if is_free && kept.iter().all(|other| Vec2::hypot2(*other - p) >= near * near) {
            kept.push(p);
        }
    }
    kept
}

/// Slots on rays from the centre, alternating between this ring and the one around it. Each ray passes the
/// balloons of its neighbours.
fn staggered(inner: Rect) -> Vec<Point> {
    let outer = inner.inflate(STEP, STEP);
    let middle = inner.center();
    let at = |ring: Rect, turn: f64| {
        let way = Vec2::new(cos(turn), sin(turn));
        let far = (ring.width() / 2.0 / way.x.abs()).min(ring.height() / 2.0 / way.y.abs());
        way * far
    };
    let step = |turn: f64| {
        let far = at(inner, turn).hypot2().sqrt();
        (PASSING / far).min(1.0)
    };
    let mut turns = Vec::new();
    let mut turn = 0.0;
    while turn + step(turn) <= std::f64::consts::TAU {
        turns.push(turn);
        turn += step(turn);
    }
    // An even count, so that the last slot and the first one are on different rings.
    let count = turns.len() - turns.len() % 2;
    let slack = turn / std::f64::consts::TAU;
    let place = |(k, turn): (usize, &f64)| {
        middle + at(if k % 2 == 0 { inner } else { outer }, *turn / slack.max(f64::MIN_POSITIVE))
    };
    turns.iter().take(count).enumerate().map(place).collect()
}
