//! The chains of a view, hidden ones without what lies in the ink of others.

use crate::chain::{self, Chain};
use crate::drawing::{Length, Unit};
use crate::lines::HiddenLines;
use crate::mesh::Extents;
use crate::stroke::InkWidths;
use crate::style::Style;
use crate::viewmap::precedence::{self, Ink};
use crate::viewmap::{Ahead, ViewEdge, ViewMap};

/// Links the lines of a view, whose ink is `widths` wide; `extents` are those of the parts, and `perspective` whether depth
/// runs along a line as in perspective.
pub(super) fn chains(
    ahead: &Ahead,
    map: &ViewMap,
    (style, widths): (&Style, &InkWidths),
    unit: Unit,
    (extents, perspective): (&Extents, bool),
) -> Vec<Chain> {
    let link = |map| chain::link_behind(ahead, map, &style.chain, unit, style.lines.hidden);
    let mut chains = link(map);
    if style.lines.hidden == HiddenLines::None {
        return chains;
    }
    // Visible lines are drawn on across gaps by what is hidden there: they are linked with all of it.
    let px = Length::px(1.0).in_unit(unit);
    let half_width = |edge: &ViewEdge| widths.half(map, edge);
    let ink = Ink { half_width: &half_width, extents, perspective, px };
    if let Some(cut) = precedence::apart(map, &ink) {
        chains.retain(|chain| chain.invisibility == 0);
        let stays = |chain: &Chain| chain.invisibility > 0 && length(chain) >= CRUMB_PX * px;
        chains.extend(link(&cut).into_iter().filter(stays));
    }
    chains
}

/// What is left of a hidden line is drawn if it is this long, px: curves that coincide but for rounding leave crumbs.
const CRUMB_PX: f64 = 1.0;

/// The length of a chain on the page.
fn length(chain: &Chain) -> f64 {
    let sides = chain.points.windows(2).map(|pair| match pair {
        [a, b] => (*b - *a).hypot(),
        _ => 0.0,
    });
    let back = chain.points.first().zip(chain.points.last()).filter(|_| chain.closed);
    sides.sum::<f64>() + back.map_or(0.0, |(first, last)| (*last - *first).hypot())
}
