//! The finished lines in grey, and over them the lines removed on the way, with one colour per reason.

use super::stage_marks::{HUES, PALE, line, polyline};
use super::{StageInputs, layers};
use crate::chains::{RemovalReason, link_with_removed};
use crate::colour::srgb::Colour;
use crate::drawing::{Layer, LayerKind};

fn colour(reason: RemovalReason) -> Colour {
    HUES[reason as usize % HUES.len()]
}

fn note(reason: RemovalReason) -> &'static str {
    match reason {
        RemovalReason::Crumb => "crumb: short, and hangs on nothing",
        RemovalReason::Spur => "spur: short, and hangs on another line by one end",
        RemovalReason::Stub => "stub: beyond the place where the line is sewn to another",
        RemovalReason::Loop => "loop: a short ring",
        RemovalReason::Double => "double: runs beside a longer line",
        RemovalReason::Noise => "noise: a crease of a scan that turns too little for its length",
        RemovalReason::Weak => "weak: a line inside that is too short for how weak it is",
        RemovalReason::Point => "point: less than a dot of the pen",
    }
}

/// The remaining lines, and the lines that tidying removed.
pub(crate) fn draw(inputs: &StageInputs) -> Vec<Layer> {
    let style = inputs.style;
    let (chains, removed) = link_with_removed(
        Some(inputs.gap_occlusion),
        inputs.map,
        &style.chain,
        inputs.page.unit,
        style.lines.hidden,
    );
    let seen = chains.iter().filter(|chain| chain.invisibility == 0);
    let mut marks: Vec<_> = seen
        .map(|chain| line(chain.path.clone(), PALE, inputs.px(1.2), &[chain.kind.name()], None))
        .collect();
    for removed in &removed {
        let mut path = polyline(&removed.points);
        if removed.closed {
            path.close_path();
        }
        let classes = [removed.kind.name(), "removed", removed.reason.name()];
        marks.push(line(path, colour(removed.reason), inputs.px(3.5), &classes, Some(note(removed.reason))));
    }
    layers([(LayerKind::Lines, marks)])
}
