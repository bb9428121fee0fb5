//! The zero sets as they are traced, before anything is hidden, and where visibility may change.

use kurbo::Point;

use super::ink::{PALE, Runs, dot, fill, line, square};
use super::{Made, layers};
use crate::drawing::{Layer, LayerKind};
use crate::lines::LineKind;
use crate::math::colour::Colour;
use crate::viewmap::{ViewVertexKind, places};

/// Contours that run forward, and those that run backward between one cusp and the next.
const FORWARD: Colour = Colour::rgb(0x1a, 0x1a, 0x1a);
const BACKWARD: Colour = Colour::rgb(0x9b, 0x3f, 0xc4);

/// Radius of the marks of events, px.
const EVENT_PX: f64 = 2.6;

/// Contours from curve to curve, lines inside, all else pale, and the events.
pub(super) fn draw(made: &Made) -> Vec<Layer> {
    let mut lines = Vec::new();
    let mut on_curve = vec![false; made.lines.segments.len()];
    for curve in &made.lines.curves {
        for backward in [false, true] {
            let mut runs = Runs::default();
            for (segment, advance) in curve.segments.clone().zip(&curve.advance) {
                on_curve[segment as usize] = true;
                if (*advance < 0.0) == backward
                    && let Some(ends) = made.segment(segment)
                {
                    runs.push(ends);
                }
            }
            let (colour, class, note) = if backward {
                (BACKWARD, "backward", "contour, the averted side nearer: between two cusps")
            } else {
                (FORWARD, "forward", "contour")
            };
            let path = runs.finish();
            lines.extend(path.map(|path| line(path, colour, made.px(1.0), &["contour", class], Some(note))));
        }
    }
    let mut others = Vec::new();
    for kind in LineKind::ALL {
        let mut runs = Runs::default();
        for (i, segment) in made.lines.segments.iter().enumerate() {
            if segment.kind == kind
                && !on_curve[i]
                && let Some(ends) = made.segment(i as u32)
            {
                runs.push(ends);
            }
        }
        let Some(path) = runs.finish() else { continue };
        if kind.is_inside() {
            lines.push(line(path, inside_colour(kind), made.px(1.0), &[kind.name()], Some(kind.name())));
        } else {
            others.push(line(path, PALE, made.px(0.6), &[kind.name()], None));
        }
    }
    others.extend(lines);
    let places = places(&made.surface.mesh, made.view, made.lines);
    let events = places.iter().filter_map(|place| {
        let at: Point = place.position + made.margin();
        let radius = made.px(EVENT_PX);
        let (path, colour, class, note) = match place.kind {
            ViewVertexKind::Cusp => (dot(at, radius), Colour::rgb(0xd6, 0x27, 0x28), "cusp", "cusp"),
            ViewVertexKind::TJunction => {
                (square(at, radius, true), Colour::rgb(0x1f, 0x77, 0xb4), "t-junction", "T-junction")
            }
            ViewVertexKind::Piercing => {
                (square(at, radius, false), Colour::rgb(0x2c, 0xa0, 0x2c), "piercing", "piercing")
            }
            _ => return None,
        };
        Some(fill(path, colour, &["event", class], Some(note)))
    });
    layers([(LayerKind::Lines, others), (LayerKind::Callouts, events.collect())])
}

fn inside_colour(kind: LineKind) -> Colour {
    match kind {
        LineKind::Ridge => Colour::rgb(0xff, 0x7f, 0x0e),
        LineKind::Valley => Colour::rgb(0x17, 0xbe, 0xcf),
        _ => Colour::rgb(0x2c, 0xa0, 0x2c),
    }
}
