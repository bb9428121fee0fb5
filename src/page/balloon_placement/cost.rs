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
    wish: &PlacementRequest,
    room: &PlacementArea,
) -> f64 {
    let panel = room.outline.bounds();
    let down = (bounds.y0 - panel.y0) / wish.em;
    let late = match room.reading {
        Reading::Ltr => bounds.x0 - panel.x0,
        Reading::Rtl => panel.x1 - bounds.x1,
    } / wish.em;
    let covers = COVER_COST
        * room
            .cover
            .as_ref()
            .map_or(0.0, |cover| cover.covered_share(bounds.inset(COVER_MARGIN_EM * wish.em)));
    let own = covers + NEXT_SHAPE_COST * shape as f64;
    if wish.is_caption {
        return own + down + 0.5 * late;
    }
    let pointing = tail.map_or(0.0, |tail| {
        let long = (tail.length / wish.em - FREE_TAIL_LENGTH_EM).max(0.0);
        // 1 if the tail points straight down.
        let steep = tail.way.y;
        let aside = FLAT_TAIL_COST * (1.0 - steep.max(0.0)) + UPWARD_TAIL_COST * (-steep).max(0.0);
        long + aside + TAIL_OVER_FIGURE_COST * tail.over / wish.em + TAIL_GAP_COST * tail.short / wish.em
    });
    own + pointing + DOWN_COST * down + READING_OFFSET_COST * late
}
