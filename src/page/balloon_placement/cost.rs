//! The cost of a place for a balloon, in ems of additional tail length.

use kurbo::Rect;

use super::request::{Room, Wish};
use super::tail::Tail;
use crate::page::layout::Reading;

/// Tails up to this length cost nothing, ems.
const SHORT: f64 = 3.0;

/// Cost of a balloon that covers figures completely, and the margin around it that counts, ems.
const COVERING: f64 = 45.0;
const AROUND: f64 = 1.0;

/// Costs per em of a tail over a figure, and per em between the tip and the target.
const OVER: f64 = 2.0;
const SHORT_OF: f64 = 0.25;

/// Costs of a horizontal tail instead of one that hangs down, and of one that points up.
const FLAT: f64 = 3.0;
const UPWARD: f64 = 7.0;

/// Costs per em of distance from the top, and from the side where reading starts.
const DOWN: f64 = 0.18;
const LATE: f64 = 0.05;

/// Cost of the next shape instead of the first one.
const SHAPE: f64 = 2.5;

/// The cost of a place. It grows with the tail length, the distance from the start of reading, and the area
/// of models that the balloon covers.
pub(crate) fn cost(bounds: Rect, shape: usize, tail: Option<&Tail>, wish: &Wish, room: &Room) -> f64 {
    let panel = room.outline.bounds();
    let down = (bounds.y0 - panel.y0) / wish.em;
    let late = match room.reading {
        Reading::Ltr => bounds.x0 - panel.x0,
        Reading::Rtl => panel.x1 - bounds.x1,
    } / wish.em;
    let covers =
        COVERING * room.cover.as_ref().map_or(0.0, |cover| cover.share(bounds.inset(AROUND * wish.em)));
    let own = covers + SHAPE * shape as f64;
    if wish.cornered {
        return own + down + 0.5 * late;
    }
    let pointing = tail.map_or(0.0, |tail| {
        let long = (tail.length / wish.em - SHORT).max(0.0);
        // 1 if the tail points straight down.
        let steep = tail.way.y;
        let aside = FLAT * (1.0 - steep.max(0.0)) + UPWARD * (-steep).max(0.0);
        long + aside + OVER * tail.over / wish.em + SHORT_OF * tail.short / wish.em
    });
    own + pointing + DOWN * down + LATE * late
}
