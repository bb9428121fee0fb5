//! [`Overruled`]: pieces of contours that single faces would show and the decision for their whole arc
//! hides, for looking at.

use kurbo::Point;

use super::build::decide_rounded;
use super::occlude::Limits;
use super::project::project;
use crate::lines::FeatureLines;
use crate::mesh::Mesh;
use crate::view::View;

/// A piece of a contour that is hidden though no face is found before it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Overruled {
    /// Where it begins in the image, user units.
    pub start: Point,
    /// Where it ends.
    pub end: Point,
}

/// All such pieces of a view, in the order of the feature segments.
#[must_use]
pub fn overruled(mesh: &Mesh, view: &View, lines: &FeatureLines) -> Vec<Overruled> {
    if lines.curves.is_empty() {
        return Vec::new();
    }
    let segments = project(mesh, view, lines);
    let limits = Limits::new(&view.frame);
    let (seen, rounded) = decide_rounded(mesh, view, lines, &segments, &limits, false);
    let mut found = Vec::new();
    for (i, segment) in segments.iter().enumerate().filter(|(_, segment)| segment.is_rounded()) {
        let point = |t: f64| Point::new(segment.at(t).x, segment.at(t).y);
        let mut push = |from: f64, to: f64| {
            if (to - from) * segment.length() > limits.piece {
                found.push(Overruled { start: point(from), end: point(to) });
            }
        };
        for decided in rounded.of(i as u32) {
            let mut at = decided.interval.start;
            for layer in seen.hidden(i) {
                push(at, layer.interval.start.min(decided.interval.end));
                at = at.max(layer.interval.end);
            }
            push(at, decided.interval.end);
        }
    }
    found
}
