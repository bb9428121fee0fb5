//! Findings about lines.

use crate::diff::tolerances;
use crate::parallel::prelude::*;
use kurbo::{BezPath, Rect, Shape as _};

use super::finding_writer::FindingWriter;
use crate::diff::curves::chain::OutlineChain;
use crate::diff::curves::segment::bounds;
use crate::diff::findings::finding::{Finding, Verdict};
use crate::diff::matching::chain_events::ChainEvent;

/// One finding for each change of a line.
pub(crate) fn findings(teller: &FindingWriter, events: Vec<ChainEvent>) -> Vec<Finding> {
    events.into_par_iter().map(|event| line_finding(teller, event)).collect()
}

/// The finding for one change of a line.
fn line_finding(teller: &FindingWriter, event: ChainEvent) -> Finding {
    let chain = |side: usize, index: Option<usize>| index.map(|index| &teller.sides[side].chains[index]);
    let (old, new) = (chain(0, event.old), chain(1, event.new));
    let shapes = [old.and_then(|c| teller.shape(0, c)), new.and_then(|c| teller.shape(1, c))];
    let length = |chain: Option<&OutlineChain>| chain.map_or(0.0, OutlineChain::length);
    let boxes = [old, new].into_iter().flatten().map(|chain| bounds(&chain.points));
    // If only a piece changed, its box is the place.
    let bare = [&event.removed, &event.added].into_iter().filter(|path| !path.elements().is_empty());
    let bare: Vec<Rect> = bare.map(BezPath::bounding_box).collect();
    let whole = boxes.reduce(|a, b| a.union(b));
    let place = match event.verdict {
        Verdict::Moved => whole,
        _ => bare.into_iter().reduce(|a, b| a.union(b)).or(whole),
    };
    let size = match event.verdict {
        Verdict::Reshaped | Verdict::Moved => length(old).max(0.0),
        _ => event.size,
    };
    let pieces = match event.verdict {
        Verdict::Moved | Verdict::Reshaped => {
            [&event.removed, &event.added].map(|path| path.perimeter(tolerances::MAX_LENGTH_ERROR_PX))
        }
        _ => [0.0; 2],
    };
    let pieces = if old.is_some() && new.is_some() { pieces } else { [0.0; 2] };
    Finding {
        size,
        growth: pieces[1] - pieces[0],
        pieces,
        largest: event.largest,
        p95: event.p95,
        shift: event.shift,
        removed_path: event.removed,
        added_path: event.added,
        ..teller.finding(event.verdict, shapes, place.unwrap_or_default())
    }
}
