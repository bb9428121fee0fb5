//! The visible view edges by strength: creases by their angle, inner lines by their strength, and kinds
//! without strength in grey.

use super::stage_marks::{PALE, PolylineRuns, line};
use super::{StageInputs, layers};
use crate::colour::srgb::Colour;
use crate::drawing::{Layer, LayerKind};
use crate::lines::LineKind;
use crate::visibility::ViewEdge;

/// Colours from weak to strong. They darken steadily, so that the order can be read without hues.
const RAMP: [Colour; 6] = [
    Colour::rgb(0xf2, 0xae, 0x2e),
    Colour::rgb(0xe8, 0x7a, 0x3e),
    Colour::rgb(0xd1, 0x4b, 0x5a),
    Colour::rgb(0x9c, 0x36, 0x72),
    Colour::rgb(0x62, 0x2a, 0x7c),
    Colour::rgb(0x26, 0x18, 0x5a),
];

/// A view edge's step on the ramp; `None` if its kind has no strength.
fn step(inputs: &StageInputs, edge: &ViewEdge) -> Option<usize> {
    let share = match edge.kind {
        LineKind::Crease => f64::from(edge.strength) / 180.0,
        kind if kind.is_inside() => {
            let ends = [edge.start, edge.end].map(|v| inputs.map.vertices[v.index()].strength);
            f64::from(ends[0] + ends[1]) / 2.0
        }
        _ => return None,
    };
    Some(((share * RAMP.len() as f64).max(0.0) as usize).min(RAMP.len() - 1))
}

/// Title of the marks of a step.
fn note(kind: LineKind, step: usize) -> String {
    let share = |k: usize| k as f64 / RAMP.len() as f64;
    if kind == LineKind::Crease {
        format!("crease that turns by {} to {} degrees", 180.0 * share(step), 180.0 * share(step + 1))
    } else {
        format!("{}, {:.2} to {:.2} of full strength", kind.name(), share(step), share(step + 1))
    }
}

/// Draws weak edges first, so that strong ones lie over them.
pub(crate) fn draw(inputs: &StageInputs) -> Vec<Layer> {
    let mut steps: Vec<Option<usize>> = vec![None];
    steps.extend((0..RAMP.len()).map(Some));
    let visible: Vec<(&ViewEdge, Option<usize>)> =
        inputs.map.edges.iter().filter(|e| e.invisibility == 0).map(|e| (e, step(inputs, e))).collect();
    let mut marks = Vec::new();
    for wanted in steps {
        for kind in LineKind::ALL {
            let mut runs = PolylineRuns::default();
            for (edge, _) in visible.iter().filter(|(e, step)| e.kind == kind && *step == wanted) {
                runs.push([edge.start, edge.end].map(|v| inputs.map.vertices[v.index()].position));
            }
            let Some(path) = runs.finish() else { continue };
            marks.push(match wanted {
                None => line(path, PALE, inputs.px(1.0), &[kind.name()], None),
                Some(step) => line(path, RAMP[step], inputs.px(1.6), &[kind.name()], Some(&note(kind, step))),
            });
        }
    }
    layers([(LayerKind::Lines, marks)])
}
