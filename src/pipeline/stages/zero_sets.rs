//! The zero sets as traced, before hiding, and the mesh edges that decide their visibility.

use super::stage_marks::{PALE, PolylineRuns, line};
use super::{StageInputs, layers};
use crate::colour::srgb::Colour;
use crate::drawing::{Layer, LayerKind};
use crate::lines::{LineKind, Role};

/// Colour of mesh contour edges, which decide the visibility of smooth contours.
const MESH_CONTOUR_COLOUR: Colour = Colour::rgb(0xd6, 0x27, 0x28);
/// Colours of contours that run forward, and of those that run backward between two cusps.
const FORWARD_COLOUR: Colour = Colour::rgb(0x1a, 0x1a, 0x1a);
const BACKWARD_COLOUR: Colour = Colour::rgb(0x9b, 0x3f, 0xc4);

/// Draws contours along their curves, inner lines, mesh contour edges, and everything else pale.
pub(crate) fn draw(inputs: &StageInputs) -> Vec<Layer> {
    let mut lines = Vec::new();
    let mut on_curve = vec![false; inputs.lines.segments.len()];
    for curve in &inputs.lines.curves {
        for backward in [false, true] {
            let mut runs = PolylineRuns::default();
            for (segment, advance) in curve.segments.clone().zip(&curve.advance) {
                on_curve[segment as usize] = true;
                if (*advance < 0.0) == backward
                    && let Some(ends) = inputs.segment(segment)
                {
                    runs.push(ends);
                }
            }
            let (colour, class, note) = if backward {
                (BACKWARD_COLOUR, "backward", "contour, the averted side nearer: between two cusps")
            } else {
                (FORWARD_COLOUR, "forward", "contour")
            };
            let path = runs.finish();
            lines
                .extend(path.map(|path| line(path, colour, inputs.px(1.0), &["contour", class], Some(note))));
        }
    }
    let mut others = Vec::new();
    for kind in LineKind::ALL {
        let mut runs = PolylineRuns::default();
        for (i, segment) in inputs.lines.segments.iter().enumerate() {
            if segment.kind == kind
                && !on_curve[i]
                && !matches!(segment.role, Role::MeshContour { .. })
                && let Some(ends) = inputs.segment(i as u32)
            {
                runs.push(ends);
            }
        }
        let Some(path) = runs.finish() else { continue };
        if kind.is_inside() {
            lines.push(line(path, inside_colour(kind), inputs.px(1.0), &[kind.name()], Some(kind.name())));
        } else {
            others.push(line(path, PALE, inputs.px(0.6), &[kind.name()], None));
        }
    }
    let mut runs = PolylineRuns::default();
    let segments = inputs.lines.segments.iter().enumerate();
    for (i, _) in segments.filter(|(_, s)| matches!(s.role, Role::MeshContour { .. })) {
        inputs.segment(i as u32).into_iter().for_each(|ends| runs.push(ends));
    }
    let note = "edge along which the polyhedron turns from the eye";
    others
        .extend(runs.finish().map(|path| {
            line(path, MESH_CONTOUR_COLOUR, inputs.px(0.6), &["contour", "witness"], Some(note))
        }));
    others.extend(lines);
    layers([(LayerKind::Lines, others)])
}

fn inside_colour(kind: LineKind) -> Colour {
    match kind {
        LineKind::Ridge => Colour::rgb(0xff, 0x7f, 0x0e),
        LineKind::Valley => Colour::rgb(0x17, 0xbe, 0xcf),
        _ => Colour::rgb(0x2c, 0xa0, 0x2c),
    }
}
