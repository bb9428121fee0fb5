//! [`assign_leaders`]: assigns items to balloon slots around a view so that no two leaders cross.
//!
//! 1. Each anchor takes the nearest free slot.
//! 2. Two leaders that cross are exchanged. By the triangle inequality this shortens both together, so the
//!    process ends without crossings.
//! 3. Tabu search removes the other conflicts, such as a leader through the circle of another balloon.
//!
//! Source of step 3: F. Glover, "Tabu search, part I", ORSA Journal on Computing 1(3), 1989.

use kurbo::{Point, Rect, Vec2};
use robust::{Coord, orient2d};

use crate::page::tolerances::MIN_LEADER_GAIN_MM;

/// Radius of a balloon, and the clearance of leaders around it, mm.
pub(crate) const BALLOON_RADIUS_MM: f64 = 4.0;
const LEADER_CLEARANCE_MM: f64 = 0.6;

/// Maximum number of slots on a border.
const MAX_SLOTS: usize = 2000;

/// The search stops after `MAX_STEPS_WITHOUT_GAIN` steps without a gain. A leader may not return to a slot
/// for `TABU_STEPS` steps.
const MAX_STEPS_WITHOUT_GAIN: usize = 60;
const TABU_STEPS: usize = 8;

/// Maximum number of sweeps over all pairs of leaders.
const MAX_SWEEPS: usize = 1000;

/// Slots for balloons on the border of a rectangle, clockwise from its upper left corner.
///
/// `slot_spacing` is the minimum length of border per slot, `start_share` the offset of the first slot as a fraction of a
/// slot.
#[must_use]
pub(crate) fn balloon_slots(border: Rect, slot_spacing: f64, start_share: f64) -> Vec<Point> {
    let perimeter = 2.0 * (border.width() + border.height());
    let slot_count = ((perimeter / slot_spacing).floor() as usize).clamp(1, MAX_SLOTS);
    let step = perimeter / slot_count as f64;
    let border_point = |offset: f64| {
        let (w, h) = (border.width(), border.height());
        match offset {
            x if x < w => Point::new(border.x0 + x, border.y0),
            x if x < w + h => Point::new(border.x1, border.y0 + x - w),
            x if x < 2.0 * w + h => Point::new(border.x1 - (x - w - h), border.y1),
            x => Point::new(border.x0, border.y1 - (x - 2.0 * w - h)),
        }
    };
    (0..slot_count).map(|k| border_point((k as f64 + start_share) * step)).collect()
}

/// The slot of each anchor.
///
/// Leaders do not cross or touch unless more than two points are collinear. Blocked pairs of anchor and slot
/// are avoided if possible.
#[must_use]
pub(crate) fn assign_leaders(
    anchors: &[Point],
    slots: &[Point],
    is_blocked: &dyn Fn(usize, usize) -> bool,
) -> Vec<usize> {
    let length = |anchor: usize, slot: usize| (anchors[anchor] - slots[slot]).hypot2().sqrt();
    let mut is_free = vec![true; slots.len()];
    let mut assigned_slots: Vec<usize> = Vec::with_capacity(anchors.len());
    for anchor in 0..anchors.len() {
        let nearest = (0..slots.len())
            .filter(|slot| is_free[*slot])
            .min_by(|a, b| length(anchor, *a).total_cmp(&length(anchor, *b)));
        let Some(slot) = nearest else { return assigned_slots };
        is_free[slot] = false;
        assigned_slots.push(slot);
    }
    untangle(anchors, slots, is_blocked, &mut assigned_slots);
    assigned_slots
}

/// The slot of each anchor, with leaders that spread radially, for slots in several rings.
///
/// Anchors and slots are matched in angular order around the centre of the anchors. The rotation with the
/// shortest leaders wins. There must be at least as many slots as anchors.
#[must_use]
pub(crate) fn assign_radially(
    anchors: &[Point],
    slots: &[Point],
    is_blocked: &dyn Fn(usize, usize) -> bool,
) -> Vec<usize> {
    let count = anchors.len();
    let middle = anchors.iter().fold(Vec2::ZERO, |sum, p| sum + p.to_vec2()) / count.max(1) as f64;
    let angle = |p: &Point| crate::geometry::numbers::portable_math::atan2(p.y - middle.y, p.x - middle.x);
    let sorted_by_angle = |points: &[Point]| {
        let mut order: Vec<usize> = (0..points.len()).collect();
        order.sort_by(|a, b| angle(&points[*a]).total_cmp(&angle(&points[*b])).then(a.cmp(b)));
        order
    };
    let (anchor_order, slot_order) = (sorted_by_angle(anchors), sorted_by_angle(slots));
    let assignment_at_turn = |turn: usize| {
        let mut slot_of_anchor = vec![0; count];
        for (k, anchor) in anchor_order.iter().enumerate() {
            slot_of_anchor[*anchor] = slot_order[(k * slot_order.len() / count + turn) % slot_order.len()];
        }
        slot_of_anchor
    };
    let total_length = |assignment: &[usize]| -> f64 {
        anchors.iter().zip(assignment).map(|(p, slot)| (*p - slots[*slot]).hypot2().sqrt()).sum()
    };
    let shortest = (0..slot_order.len())
        .map(assignment_at_turn)
        .min_by(|a, b| total_length(a).total_cmp(&total_length(b)));
    let mut assigned_slots = shortest.unwrap_or_default();
    resolve_conflicts(anchors, slots, is_blocked, &mut assigned_slots);
    assigned_slots
}

/// Exchanges slots while that shortens leaders, then resolves the conflicts that remain.
fn untangle(
    anchors: &[Point],
    slots: &[Point],
    is_blocked: &dyn Fn(usize, usize) -> bool,
    assigned_slots: &mut [usize],
) {
    let length = |anchor: usize, slot: usize| (anchors[anchor] - slots[slot]).hypot2().sqrt();
    for _ in 0..MAX_SWEEPS {
        let mut exchanged = false;
        for a in 0..assigned_slots.len() {
            for b in 0..a {
                let gain = length(a, assigned_slots[a]) + length(b, assigned_slots[b])
                    - length(a, assigned_slots[b])
                    - length(b, assigned_slots[a]);
                let crosses = || {
                    segments_meet(
                        [anchors[a], slots[assigned_slots[a]]],
                        [anchors[b], slots[assigned_slots[b]]],
                    )
                };
                if gain > MIN_LEADER_GAIN_MM || gain > 0.0 && crosses() {
                    assigned_slots.swap(a, b);
                    exchanged = true;
                }
            }
        }
        if !exchanged {
            break;
        }
    }
    resolve_conflicts(anchors, slots, is_blocked, assigned_slots);
}

/// Moves leaders to other slots until no conflicts remain or the search stalls. A step may increase the
/// number of conflicts; a tabu list prevents cycles.
///
/// Source: F. Glover, "Tabu search, part I", ORSA Journal on Computing 1(3), 1989.
fn resolve_conflicts(
    anchors: &[Point],
    slots: &[Point],
    is_blocked: &dyn Fn(usize, usize) -> bool,
    assigned_slots: &mut [usize],
) {
    let line = |k: usize, slot: usize| [anchors[k], slots[slot]];
    let leader_length = |k: usize, slot: usize| (anchors[k] - slots[slot]).hypot2().sqrt();
    let mut anchor_of_slot: Vec<Option<usize>> = vec![None; slots.len()];
    for (k, slot) in assigned_slots.iter().enumerate() {
        anchor_of_slot[*slot] = Some(k);
    }
    // For each anchor and slot, the conflicts of that leader with all others.
    let faults_at = |k: usize, slot: usize, of: &[usize]| {
        let others = (0..of.len()).filter(|other| *other != k);
        others.map(|other| count_conflicts(line(k, slot), line(other, of[other]))).sum::<usize>()
            + usize::from(is_blocked(k, slot))
    };
    let row =
        |k: usize| (0..slots.len()).map(|slot| faults_at(k, slot, assigned_slots)).collect::<Vec<usize>>();
    let mut faults: Vec<Vec<usize>> = (0..assigned_slots.len()).map(row).collect();
    let total = |faults: &[Vec<usize>], of: &[usize]| {
        of.iter().enumerate().map(|(k, slot)| faults[k][*slot]).sum::<usize>()
    };
    let mut best = (total(&faults, assigned_slots), assigned_slots.to_vec());
    // The step until which an anchor may not return to a slot.
    let mut barred_until = vec![vec![0_usize; slots.len()]; assigned_slots.len()];
    let (mut step, mut last_gain_step) = (0, 0);
    while best.0 > 0 && step < last_gain_step + MAX_STEPS_WITHOUT_GAIN {
        step += 1;
        // The move that leaves the fewest conflicts; ties go to the smaller increase in length.
        let mut best_move: Option<(usize, usize, f64, usize, usize)> = None;
        for k in (0..assigned_slots.len()).filter(|k| faults[*k][assigned_slots[*k]] > 0) {
            let from = assigned_slots[k];
            for slot in (0..slots.len()).filter(|slot| *slot != from && barred_until[k][*slot] < step) {
                let (mut old_faults, mut new_faults) = (faults[k][from], faults[k][slot]);
                let mut added_length = leader_length(k, slot) - leader_length(k, from);
                if let Some(displaced_anchor) = anchor_of_slot[slot] {
                    old_faults += faults[displaced_anchor][slot]
                        - count_conflicts(line(k, from), line(displaced_anchor, slot));
                    new_faults -= count_conflicts(line(k, slot), line(displaced_anchor, slot));
                    new_faults += faults[displaced_anchor][from]
                        - count_conflicts(line(displaced_anchor, from), line(k, from));
                    new_faults += count_conflicts(line(k, slot), line(displaced_anchor, from));
                    added_length +=
                        leader_length(displaced_anchor, from) - leader_length(displaced_anchor, slot);
                }
                let is_better = best_move.is_none_or(|(its_new, its_old, length, ..)| {
                    let order = (new_faults + its_old).cmp(&(its_new + old_faults));
                    order.is_lt() || order.is_eq() && added_length < length
                });
                if is_better {
                    best_move = Some((new_faults, old_faults, added_length, k, slot));
                }
            }
        }
        let Some((_, _, _, k, slot)) = best_move else { break };
        let from = assigned_slots[k];
        let exchanged_anchor = anchor_of_slot[slot].replace(k);
        anchor_of_slot[from] = exchanged_anchor;
        for (moved, old, new) in
            [Some((k, from, slot)), exchanged_anchor.map(|other| (other, slot, from))].into_iter().flatten()
        {
            assigned_slots[moved] = new;
            barred_until[moved][old] = step + TABU_STEPS;
            let [before, after] = [line(moved, old), line(moved, new)];
            for (k, row) in faults.iter_mut().enumerate().filter(|(k, _)| *k != moved) {
                for (slot, faults) in row.iter_mut().enumerate() {
                    *faults += count_conflicts(line(k, slot), after);
                    *faults -= count_conflicts(line(k, slot), before);
                }
            }
        }
        let fault_count = total(&faults, assigned_slots);
        if fault_count < best.0 {
            (best, last_gain_step) = ((fault_count, assigned_slots.to_vec()), step);
        }
    }
    assigned_slots.copy_from_slice(&best.1);
}

/// The number of conflicts between two leaders: a crossing, and each leader that passes through the other
/// balloon.
fn count_conflicts([a, b]: [Point; 2], [c, d]: [Point; 2]) -> usize {
    const MIN_LEADER_DISTANCE_MM: f64 = BALLOON_RADIUS_MM + LEADER_CLEARANCE_MM;
    let is_apart = a.x.max(b.x) + MIN_LEADER_DISTANCE_MM < c.x.min(d.x)
        || c.x.max(d.x) + MIN_LEADER_DISTANCE_MM < a.x.min(b.x)
        || a.y.max(b.y) + MIN_LEADER_DISTANCE_MM < c.y.min(d.y)
        || c.y.max(d.y) + MIN_LEADER_DISTANCE_MM < a.y.min(b.y);
    if is_apart {
        return 0;
    }
    usize::from(segments_meet([a, b], [c, d]))
        + usize::from(passes_through_balloon([a, b], d))
        + usize::from(passes_through_balloon([c, d], b))
}

/// Whether a leader passes through the circle of a balloon at `centre`, with clearance.
#[must_use]
pub(crate) fn passes_through_balloon([a, b]: [Point; 2], centre: Point) -> bool {
    let direction = b - a;
    let share = ((centre - a).dot(direction) / direction.hypot2().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    (a + direction * share - centre).hypot2().sqrt() < BALLOON_RADIUS_MM + LEADER_CLEARANCE_MM
}

/// Whether two segments have a common point, by exact predicates.
#[must_use]
pub(crate) fn segments_meet([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    let side = |p: Point, q: Point, r: Point| orient2d(coord(p), coord(q), coord(r));
    let [c_side, d_side] = [side(a, b, c), side(a, b, d)];
    if c_side > 0.0 && d_side > 0.0 || c_side < 0.0 && d_side < 0.0 {
        return false;
    }
    let [a_side, b_side] = [side(c, d, a), side(c, d, b)];
    let on = |turn: f64, p: Point, q: Point, r: Point| {
        turn == 0.0
            && (p.x.min(q.x)..=p.x.max(q.x)).contains(&r.x)
            && (p.y.min(q.y)..=p.y.max(q.y)).contains(&r.y)
    };
    let opposite = |one: f64, other: f64| one > 0.0 && other < 0.0 || one < 0.0 && other > 0.0;
    opposite(c_side, d_side) && opposite(a_side, b_side)
        || on(c_side, a, b, c)
        || on(d_side, a, b, d)
        || on(a_side, c, d, a)
        || on(b_side, c, d, b)
}

fn coord(p: Point) -> Coord<f64> {
    Coord { x: p.x, y: p.y }
}
