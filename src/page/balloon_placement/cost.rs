//! The cost of a place for a balloon, in ems of additional tail length.

use kurbo::Rect;

use super::request::{PlacementArea, PlacementRequest};
use super::tail::BalloonTail;
use crate::page::layout::Reading;

/// Tails up to this length cost nothing, ems.
const FREE_TAIL_LENGTH_EM: f64 = 3.0;

/// Cost of a balloon that covers figures completely, and the margin around it that counts, ems.
const COVER_COST: f64 = 45.0;
const COVER_MARGIN_EM: f64 = 1.0;

/// Costs per em of a tail over a figure, and per em between the tip and the target.
const TAIL_OVER_FIGURE_COST: f64 = 2.0;
const TAIL_GAP_COST: f64 = 0.25;

/// Costs of a horizontal tail instead of one that hangs down, and of one that points up.
const FLAT_TAIL_COST: f64 = 3.0;
const UPWARD_TAIL_COST: f64 = 7.0;

/// Costs per em of distance from the top, and from the side where reading starts.
const DOWN_COST: f64 = 0.18;
const READING_OFFSET_COST: f64 = 0.05;

/// Cost of the next shape instead of the first one.
const NEXT_SHAPE_COST: f64 = 2.5;

/// The cost of a place. It grows with the tail length, the distance from the start of reading, and the area
/// of models that the balloon covers.
pub(crate) fn cost(
    bounds: Rect,
    shape: usize,
    tail: Option<&BalloonTail>,
    request: &PlacementRequest,
    area: &PlacementArea,
) -> f64 {
    let panel = area.outline.bounds();
    let offset_down = (bounds.y0 - panel.y0) / request.em;
    let offset_in_reading = match area.reading {
        Reading::Ltr => bounds.x0 - panel.x0,
        Reading::Rtl => panel.x1 - bounds.x1,
    } / request.em;
    let cover_cost = COVER_COST
        * area
            .cover
            .as_ref()
            .map_or(0.0, |cover| cover.covered_share(bounds.inset(COVER_MARGIN_EM * request.em)));
    let base_cost = cover_cost + NEXT_SHAPE_COST * shape as f64;
    if request.is_caption {
        return base_cost + offset_down + 0.5 * offset_in_reading;
    }
    let tail_cost = tail.map_or(0.0, |tail| {
        let excess_length = (tail.length / request.em - FREE_TAIL_LENGTH_EM).max(0.0);
        // 1 if the tail points straight down.
        let downwardness = tail.way.y;
        let direction_cost =
            FLAT_TAIL_COST * (1.0 - downwardness.max(0.0)) + UPWARD_TAIL_COST * (-downwardness).max(0.0);
        excess_length
            + direction_cost
            + TAIL_OVER_FIGURE_COST * tail.over / request.em
            + TAIL_GAP_COST * tail.short / request.em
    });
    base_cost + tail_cost + DOWN_COST * offset_down + READING_OFFSET_COST * offset_in_reading
}
