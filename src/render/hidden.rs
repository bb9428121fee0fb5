//! The chains of a view, hidden ones without what lies in the ink of others.

use crate::chain::{self, Chain};
use crate::drawing::{Length, Unit};
use crate::lines::HiddenLines;
use crate::mesh::Extents;
use crate::style::Style;
use crate::viewmap::{Ahead, ViewMap, precedence};

/// Links the lines of a view. `extents` says which of two parts in one place comes first, `perspective` how depth runs along a line.
pub(super) fn chains(
    ahead: &Ahead,
    map: &ViewMap,
    style: &Style,
    unit: Unit,
    (extents, perspective): (&Extents, bool),
) -> Vec<Chain> {
    let link = |map| chain::link_behind(ahead, map, &style.chain, unit, style.lines.hidden);
    let mut chains = link(map);
    if style.lines.hidden == HiddenLines::None {
        return chains;
    }
    // Visible lines are drawn on across gaps by what is hidden there: they are linked with all of it.
    if let Some(cut) = precedence::apart(map, extents, perspective, Length::px(1.0).in_unit(unit)) {
        chains.retain(|chain| chain.invisibility == 0);
        chains.extend(link(&cut).into_iter().filter(|chain| chain.invisibility > 0));
    }
    chains
}
