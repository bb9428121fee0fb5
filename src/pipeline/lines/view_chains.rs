//! The chains of a view. Hidden chains exclude stretches under the ink of others.

use crate::chains::{self, Chain, Rounding};
use crate::drawing::{Length, Unit};
use crate::lines::HiddenLines;
use crate::mesh::MeshMetrics;
use crate::mesh::PartMetrics;
use crate::pipeline::tolerances;
use crate::scene::triangle_soup::longest_axis;
use crate::scene::{Geometry, Part, Scene};
use crate::strokes::InkWidths;
use crate::style::Style;
use crate::view::Frame;
use crate::visibility::overlap::hidden_line_precedence::{self, LineInk};
use crate::visibility::{GapOcclusion, ViewEdge, ViewMap};

/// Links the lines of a view. `widths` gives their ink widths; `extents` are those of the scene's parts.
pub(crate) fn chains(
    ahead: &GapOcclusion,
    map: &ViewMap,
    (style, widths): (&Style, &InkWidths),
    unit: Unit,
    (scene, extents, frame): (&Scene, &MeshMetrics, &Frame),
) -> Vec<Chain> {
    let perspective = frame.perspective;
    let rounding =
        (style.chain.circles && !perspective).then(|| corner_rounding(scene, extents, frame.scale));
    let chained = (&style.chain, Rounding(rounding.as_deref()));
    let link = |map| chains::link_with_arcs(ahead, map, chained, unit, style.lines.hidden);
    let mut chains = link(map);
    if style.lines.hidden == HiddenLines::None {
        return chains;
    }
    // Visible lines are extended across gaps by the hidden lines there, so they are linked with all of them.
    let px = Length::px(1.0).in_unit(unit);
    let half_width = |edge: &ViewEdge| widths.half(map, edge);
    let ink = LineInk { half_width: &half_width, extents, perspective, px };
    if let Some(cut) = hidden_line_precedence::without_hidden_in_ink(map, &ink) {
        chains.retain(|chain| chain.invisibility == 0);
        let stays = |chain: &Chain| chain.invisibility > 0 && length(chain) >= MIN_HIDDEN_LENGTH_PX * px;
        chains.extend(link(&cut).into_iter().filter(stays));
    }
    chains
}

/// Displacement of corners by the rounding of the file's numbers, for each part. `scale` is user units per
/// world unit.
///
/// Numbers with few decimals may be rounded to these, even if exact or in single precision.
fn corner_rounding(scene: &Scene, extents: &MeshMetrics, scale: f64) -> Vec<f64> {
    let own = |(extent, part): (&PartMetrics, &Part)| {
        let decimals = |geometry: &Geometry| geometry.decimal_step() * longest_axis(&part.world_from_part);
        let step = scene.geometry_of(part).map_or(0.0, decimals).max(extent.step);
        (tolerances::MAX_CIRCLE_CORNER_STEPS * step).max(crate::mesh::tolerances::WELD_OF_PART * extent.scale)
    };
    extents.all().iter().zip(&scene.parts).map(|both| own(both) * scale).collect()
}

/// Least length of a remaining hidden line, px. Curves that coincide except for rounding leave short pieces.
const MIN_HIDDEN_LENGTH_PX: f64 = 1.0;

/// Length of a chain on the page.
fn length(chain: &Chain) -> f64 {
    let sides = chain.points.windows(2).map(|pair| match pair {
        [a, b] => (*b - *a).hypot(),
        _ => 0.0,
    });
    let back = chain.points.first().zip(chain.points.last()).filter(|_| chain.closed);
    sides.sum::<f64>() + back.map_or(0.0, |(first, last)| (*last - *first).hypot())
}
