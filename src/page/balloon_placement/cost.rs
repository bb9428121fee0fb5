//! What a place of a balloon costs, in ems of a longer tail.

use kurbo::Rect;

use super::request::{Room, Wish};
use super::tail::Tail;
use crate::page::layout::Reading;

/// A tail so long costs nothing, ems.
const SHORT: f64 = 3.0;

/// A balloon that covers figures wholly, with so many ems around it.
const COVERING: f64 = 45.0;
const AROUND: f64 = 1.0;

/// An em of a tail over a figure, and an em by which it ends short of what it points at.
const OVER: f64 = 2.0;
const SHORT_OF: f64 = 0.25;

/// A tail that lies flat rather than hangs down, and one that points up.
const FLAT: f64 = 3.0;
const UPWARD: f64 = 7.0;

/// An em further down, and an em later in the line.
const DOWN: f64 = 0.18;
const LATE: f64 = 0.05;

/// The next shape rather than the first one.
const SHAPE: f64 = 2.5;

/// How bad a place is: far from what speaks, low, late in its line, and on what models cover.
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
        // 1 where it hangs straight down.
        let steep = tail.way.y;
        let aside = FLAT * (1.0 - steep.max(0.0)) + UPWARD * (-steep).max(0.0);
        long + aside + OVER * tail.over / wish.em + SHORT_OF * tail.short / wish.em
    });
    own + pointing + DOWN * down + LATE * late
}
