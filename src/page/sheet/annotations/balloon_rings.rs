//! Balloons around a view, in one ring or two, as near to the view as free paper allows.
//!
//! A ring is a rectangle around the view with slots for balloons.
//!
//! 1. Slots on free paper are assigned to the items so that no two leaders cross ([`assign_leaders`],
//!    [`assign_radially`]).
//! 2. If there are too few slots, or a leader crosses another one, a text or a balloon, the next rings are
//!    tried.
//! 3. The next rings are farther out, or there are two. Slots of two rings are staggered, so leaders of the
//!    outer ring run between the balloons of the inner ring.

use kurbo::{Affine, Circle, Point, Rect, Shape as _, Vec2};

use crate::error::Error;
use crate::geometry::numbers::portable_math::{cos, sin};
use crate::page::sheet::canvas::annotation_board::AnnotationBoard;
use crate::page::sheet::canvas::paper_occupancy::{Clearance, ConvexShape, OccupantKind};
use crate::page::sheet::canvas::sheet_canvas::THIN_LINE_MM;
use crate::page::sheet::part_balloons::leader_assignment::{
    BALLOON_RADIUS_MM, assign_leaders, assign_radially, balloon_slots, passes_through_balloon, segments_meet,
};
use crate::page::sheet::parts_list::parts_list_items::PartsListItem;
use crate::page::tolerances::MAX_CIRCLE_ERROR_MM;

/// Letter height of numbers, mm.
const NUMBER_HEIGHT_MM: f64 = 3.5;

/// Distance from the view to the first ring, and from ring to ring, mm.
const FIRST_RING_OFFSET_MM: f64 = 10.0;
const RING_SPACING_MM: f64 = 9.5;

/// Length of border per balloon in a single ring, mm.
const SINGLE_RING_PITCH_MM: f64 = 10.0;

/// Distance from the centre of a balloon to a leader that passes it, mm: radius, clearance, and the slant of
/// leaders.
const LEADER_PASSING_DISTANCE_MM: f64 = 5.2;

/// Clearance around a balloon, mm.
const BALLOON_CLEARANCE_MM: f64 = 0.8;

/// Maximum number of rings; outward step of the outermost ring, mm; number of such steps.
const MAX_RINGS: u32 = 2;
const OUTWARD_STEP_MM: f64 = 3.0;
const MAX_OUTWARD_STEPS: u32 = 32;

/// Draws the balloons of all items that have an anchor.
pub(crate) fn draw_balloons(
    rect: Rect,
    items: &[PartsListItem],
    anchors: &[Option<Point>],
    board: &mut AnnotationBoard,
) -> Result<(), Error> {
    let visible_items: Vec<(usize, Point)> =
        anchors.iter().enumerate().filter_map(|(k, anchor)| anchor.map(|anchor| (k, anchor))).collect();
    let points: Vec<Point> = visible_items.iter().map(|(_, anchor)| *anchor).collect();
    if points.is_empty() {
        return Ok(());
    }
    // The offset of the outermost ring decides, because the view needs that much room. If nothing else fits,
    // leaders may cross those of diameters, and then arrow heads.
    let clearances_and_steps = [
        (Clearance::Leaders, MAX_OUTWARD_STEPS / 3),
        (Clearance::Solids, MAX_OUTWARD_STEPS / 3),
        (Clearance::Texts, MAX_OUTWARD_STEPS),
    ];
    let attempts = clearances_and_steps.into_iter().flat_map(|(attempt_clearance, steps)| {
        (0..steps).flat_map(move |step| {
            let step_offset = OUTWARD_STEP_MM * f64::from(step);
            let farther = move |rings: u32| {
                (attempt_clearance, rings, step_offset - RING_SPACING_MM * f64::from(rings - 1))
            };
            (1..=MAX_RINGS).map(farther).filter(|(.., farther)| *farther >= 0.0)
        })
    });
    let leader_lines = attempts.into_iter().find_map(|(clearance, rings, farther)| {
        let slots = free_slots(rect, (rings, farther), board);
        if slots.len() < points.len() {
            return None;
        }
        let is_blocked = |p: &Point, place: &Point| {
            !board.taken.is_free(&ConvexShape::line(*p, *place, THIN_LINE_MM).wider(0.3), clearance)
        };
        let blocked: Vec<Vec<bool>> =
            points.iter().map(|p| slots.iter().map(|place| is_blocked(p, place)).collect()).collect();
        if blocked.iter().any(|places| places.iter().all(|is_blocked| *is_blocked)) {
            return None;
        }
        let lines = |assignment: &[usize]| -> Vec<[Point; 2]> {
            points.iter().zip(assignment).map(|(p, slot)| [*p, slots[*slot]]).collect()
        };
        let is_clear = |assigned_slots: &Vec<usize>| {
            let lines = lines(assigned_slots);
            lines.iter().enumerate().all(|(k, leader)| {
                !blocked[k][assigned_slots[k]]
                    && lines.iter().enumerate().all(|(n, other_leader)| {
                        n == k
                            || !passes_through_balloon(*leader, other_leader[1])
                                && (n < k || !segments_meet(*leader, *other_leader))
                    })
            })
        };
        let nearest = assign_leaders(&points, &slots, &|k, place| blocked[k][place]);
        if is_clear(&nearest) {
            return Some(lines(&nearest));
        }
        let radial_assignment = assign_radially(&points, &slots, &|k, place| blocked[k][place]);
        is_clear(&radial_assignment).then(|| lines(&radial_assignment))
    });
    let Some(lines) = leader_lines else {
        let numbers: Vec<&str> = visible_items.iter().map(|(item, _)| &*items[*item].number).collect();
        let (first, last) = (numbers.first().unwrap_or(&""), numbers.last().unwrap_or(&""));
        board.unplaced.push(match numbers.len() {
            1 => format!("the balloon {first}"),
            count => format!("the {count} balloons {first} to {last}"),
        });
        return Ok(());
    };
    for ((item, _), [anchor, centre]) in visible_items.iter().zip(lines) {
        let towards = anchor - centre;
        let distance = towards.hypot2().sqrt();
        if distance > BALLOON_RADIUS_MM {
            let end = centre + towards * (BALLOON_RADIUS_MM / distance);
            board.balloons.line(end, anchor, THIN_LINE_MM);
            board.taken.take(ConvexShape::line(end, anchor, THIN_LINE_MM), OccupantKind::Leader);
        }
        board.balloons.fill(Circle::new(anchor, 0.5).to_path(MAX_CIRCLE_ERROR_MM));
        board.balloons.circle(centre, BALLOON_RADIUS_MM, THIN_LINE_MM);
        board.taken.take(ConvexShape::disc(centre, BALLOON_RADIUS_MM), OccupantKind::Solid);
        let word =
            board.word_within(&items[*item].number, NUMBER_HEIGHT_MM, 2.0 * BALLOON_RADIUS_MM - 1.5)?;
        // All numbers share a baseline, whether or not they have descenders.
        let text_origin = Point::new(centre.x - word.bounds.center().x, centre.y - word.bounds.y0 / 2.0);
        board.write_in_balloon(&word, Affine::translate(text_origin.to_vec2()));
    }
    Ok(())
}

/// Slots of one ring or two that are on free paper.
fn free_slots(rect: Rect, (rings, extra_offset): (u32, f64), board: &AnnotationBoard) -> Vec<Point> {
    let inner = rect.inflate(FIRST_RING_OFFSET_MM + extra_offset, FIRST_RING_OFFSET_MM + extra_offset);
    let candidate_slots =
        if rings == 1 { balloon_slots(inner, SINGLE_RING_PITCH_MM, 0.5) } else { staggered_slots(inner) };
    // At corners, slots of neighbouring sides may be close to each other.
    let mut free_places: Vec<Point> = Vec::new();
    for p in candidate_slots {
        let min_distance = 2.0 * BALLOON_RADIUS_MM + BALLOON_CLEARANCE_MM;
        let is_free = board
            .taken
            .is_free(&ConvexShape::disc(p, BALLOON_RADIUS_MM + BALLOON_CLEARANCE_MM), Clearance::All);
        if is_free && free_places.iter().all(|other| Vec2::hypot2(*other - p) >= min_distance * min_distance)
        {
            free_places.push(p);
        }
    }
    free_places
}

/// Slots on rays from the centre, alternating between this ring and the one around it. Each ray passes the
/// balloons of its neighbours.
fn staggered_slots(inner: Rect) -> Vec<Point> {
    let outer = inner.inflate(RING_SPACING_MM, RING_SPACING_MM);
    let middle = inner.center();
    let offset_on_ring = |ring: Rect, turn: f64| {
        let direction = Vec2::new(cos(turn), sin(turn));
        let distance = (ring.width() / 2.0 / direction.x.abs()).min(ring.height() / 2.0 / direction.y.abs());
        direction * distance
    };
    let step = |turn: f64| {
        let ring_radius = offset_on_ring(inner, turn).hypot2().sqrt();
        (LEADER_PASSING_DISTANCE_MM / ring_radius).min(1.0)
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
    let slot_centre = |(k, turn): (usize, &f64)| {
        middle + offset_on_ring(if k % 2 == 0 { inner } else { outer }, *turn / slack.max(f64::MIN_POSITIVE))
    };
    turns.iter().take(count).enumerate().map(slot_centre).collect()
}
