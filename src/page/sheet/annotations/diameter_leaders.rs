//! Dimensions of diameters and radii: a leader with an arrow to the circle, and the value on a shelf outside
//! the view.
//!
//! 1. Candidate leaders leave the circle radially, in [`LEADER_DIRECTIONS`] directions and at several
//!    distances from the view.
//! 2. They are sorted by cost: the length from the centre, plus a penalty for values on the left or below,
//!    where linear dimensions stand.
//! 3. The first candidate with free paper for its value and its lines is drawn. The radial line may cross
//!    other leaders, and then also arrow heads, only if no candidate is free of them.
//! 4. If no candidate fits, the dimension is reported as not placed.
//!
//! All lengths are mm on the page, y down.

use kurbo::{Circle, Point, Rect, Shape as _, Vec2};

use super::dimension_style::{ARROW_LENGTH_MM, VALUE_HEIGHT_MM};
use crate::error::Error;
use crate::geometry::numbers::portable_math::{cos, sin};
use crate::geometry::plane::polyline_path::polyline;
use crate::page::sheet::canvas::annotation_board::{AnnotationBoard, SetWord};
use crate::page::sheet::canvas::paper_occupancy::{Clearance, OccupantKind};
use crate::page::sheet::canvas::sheet_canvas::{CHAIN_DASH_MM, THIN_LINE_MM};
use crate::page::sheet::dimensions::dimension_set::DiameterLeader;
use crate::page::tolerances;

/// Smallest distance of a value from the view.
const FIRST_VALUE_OFFSET_MM: f64 = 5.0;
/// Difference between successive distances.
const OUTWARD_STEP_MM: f64 = 5.0;
/// Number of distances tried.
const MAX_OUTWARD_STEPS: u32 = 16;

/// Number of leader directions.
const LEADER_DIRECTIONS: u32 = 72;

/// Extra cost of a value on the left of the circle, in mm of leader.
const LEFT_COST_MM: f64 = 25.0;
/// Extra cost of a value below the view, in mm of leader.
const BELOW_COST_MM: f64 = 15.0;

/// A possible leader: a radial line from `tip` to `knee`, then a horizontal shelf under the value.
struct LeaderCandidate {
    /// Arrow tip on the circle.
    tip: Point,
    knee: Point,
    /// Outer end of the shelf.
    shelf: Point,
    /// Centre of the value.
    middle: Point,
    cost: f64,
}

/// Draws the dimension of a diameter or radius, and the pitch circle of a hole pattern.
///
/// `rect` is the view's rectangle on the page. If no candidate fits, the dimension is added to
/// `board.unplaced`.
///
/// # Errors
/// Returns an error if the value cannot be set in the font.
pub(crate) fn draw_diameter(
    rect: Rect,
    led: &DiameterLeader,
    board: &mut AnnotationBoard,
) -> Result<(), Error> {
    let word = board.word(&led.text, VALUE_HEIGHT_MM)?;
    if let Some((middle, radius)) = led.pitch {
        let circle = Circle::new(middle, radius).to_path(tolerances::MAX_CIRCLE_ERROR_MM);
        board.take_path(&circle, THIN_LINE_MM, OccupantKind::Line);
        board.ink.path(circle, THIN_LINE_MM, &CHAIN_DASH_MM);
    }
    let mut leaders: Vec<LeaderCandidate> = (0..MAX_OUTWARD_STEPS)
        .flat_map(|step| (0..LEADER_DIRECTIONS).map(move |k| (k, f64::from(step) * OUTWARD_STEP_MM)))
        .map(|(k, more)| leader_candidate(led, rect, &word, (k, more)))
        .collect();
    leaders.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    let is_free = |leader: &&LeaderCandidate, clear: Clearance| {
        let both = rect.intersect(word.shape(word.centred(leader.middle)).bounds());
        (both.width() <= 0.0 || both.height() <= 0.0)
            && board.is_free(&word, word.centred(leader.middle))
            && board.is_line_free(leader.tip, leader.knee, clear)
            && board.is_line_free(leader.knee, leader.shelf, Clearance::Solids)
            && board.taken.is_free(
                &AnnotationBoard::head(leader.tip, leader.tip - leader.knee, ARROW_LENGTH_MM),
                Clearance::Texts,
            )
    };
    let found = [Clearance::Leaders, Clearance::Solids, Clearance::Texts]
        .into_iter()
        .find_map(|clear| leaders.iter().find(|leader| is_free(leader, clear)));
    let Some(LeaderCandidate { tip, knee, shelf, middle, .. }) = found else {
        board.unplaced.push(format!("the diameter `{}`", led.text));
        return Ok(());
    };
    board.ink.line(*knee, *tip, THIN_LINE_MM);
    board.taken.take(
        crate::page::sheet::canvas::paper_occupancy::ConvexShape::line(*knee, *tip, THIN_LINE_MM),
        OccupantKind::Leader,
    );
    board.arrow(*tip, *tip - *knee, ARROW_LENGTH_MM);
    board.ink.path(polyline(&[*knee, *shelf]), THIN_LINE_MM, &[]);
    board.taken.take(
        crate::page::sheet::canvas::paper_occupancy::ConvexShape::line(*knee, *shelf, THIN_LINE_MM),
        OccupantKind::Leader,
    );
    let place = word.centred(*middle);
    board.write(&word, place);
    Ok(())
}

/// The candidate in direction number `k`, with its knee `more` mm farther out than the first distance.
fn leader_candidate(
    led: &DiameterLeader,
    rect: Rect,
    word: &SetWord,
    (k, more): (u32, f64),
) -> LeaderCandidate {
    let outer = rect.inflate(FIRST_VALUE_OFFSET_MM, FIRST_VALUE_OFFSET_MM);
    let turn = std::f64::consts::TAU * (f64::from(k) + 0.5) / f64::from(LEADER_DIRECTIONS);
    let out = Vec2::new(cos(turn), -sin(turn));
    // Distances to the border of the view.
    let reach = |p: f64, d: f64, low: f64, high: f64| match d {
        d if d > tolerances::MAX_ZERO_COMPONENT => (high - p) / d,
        d if d < -tolerances::MAX_ZERO_COMPONENT => (low - p) / d,
        _ => f64::INFINITY,
    };
    let (x, y) = (led.centre.x, led.centre.y);
    let far = reach(x, out.x, outer.x0, outer.x1).min(reach(y, out.y, outer.y0, outer.y1));
    let tip = led.centre + out * led.radius;
    let knee = led.centre + out * (far.max(led.radius + FIRST_VALUE_OFFSET_MM) + more);
    let wide = word.bounds.width() + 2.0;
    let side = if out.x >= 0.0 { 1.0 } else { -1.0 };
    let shelf = knee + Vec2::new(side * wide, 0.0);
    let rise = 1.0 + word.bounds.y1.max(0.0) + word.bounds.height() / 2.0;
    let middle = knee + Vec2::new(side * wide / 2.0, -rise);
    let aside = if side > 0.0 { 0.0 } else { LEFT_COST_MM };
    let below = if knee.y <= rect.y1 { 0.0 } else { BELOW_COST_MM };
    LeaderCandidate { tip, knee, shelf, middle, cost: far + more + aside + below }
}
