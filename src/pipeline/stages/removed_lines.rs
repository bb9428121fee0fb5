//! The finished lines in grey, and over them the lines removed on the way, with one colour per reason.

use super::stage_marks::{HUES, PALE, line, polyline};
use super::{Made, layers};
use crate::chains::{Reason, link_and_keep};
use crate::colour::srgb::Colour;
use crate::drawing::{Layer, LayerKind};

fn colour(reason: Reason) -> Colour {
    HUES[reason as usize % HUES.len()]
}

fn note(reason: Reason) -> &'static str {
    match reason {
        Reason::Crumb => "crumb: short, and hangs on nothing",
        Reason::Spur => "spur: short, and hangs on another line by one end",
        Reason::Stub => "stub: beyond the place where the line is sewn to another",
        Reason::Loop => "loop: a short ring",
        Reason::Double => "double: runs beside a longer line",
        Reason::Noise => "noise: a crease of a scan that turns too little for its length",
        Reason::Weak => "weak: a line inside that is too short for how weak it is",
        Reason::Point => "point: less than a dot of the pen",
    }
}

/// The remaining lines, and the lines that tidying removed.
pub(crate) fn draw(made: &Made) -> Vec<Layer> {
    let style = made.style;
    let (chains, removed) =
        link_and_keep(Some(made.ahead), made.map, &style.chain, made.page.unit, style.lines.hidden);
    let seen = chains.iter().filter(|chain| chain.invisibility == 0);
    let mut marks: Vec<_> =
        seen.map(|chain| line(chain.path.clone(), PALE, made.px(1.2), &[chain.kind.name()], None)).collect();
    for removed in &removed {
        let mut path = polyline(&removed.points);
        if removed.closed {
            path.close_path();
        }
        let classes = [removed.kind.name(), "removed", removed.reason.name()];
        marks.push(line(path, colour(removed.reason), made.px(3.5), &classes, Some(note(removed.reason))));
    }
    layers([(LayerKind::Lines, marks)])
}
