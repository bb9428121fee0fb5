//! Gradients and patterns as text that is equal where they look equal.

use std::fmt::Write as _;
use std::hash::{Hash, Hasher};

use rustc_hash::FxHasher;

use crate::diff::shapes::ink::trimmed;

/// Description of a paint. The position of a gradient is left out, because it moves with its shape.
pub(crate) fn of(paint: &usvg::Paint, alpha: u8) -> String {
    let mut words = match paint {
        usvg::Paint::Color(colour) => {
            format!("#{:02x}{:02x}{:02x}", colour.red, colour.green, colour.blue)
        }
        usvg::Paint::LinearGradient(gradient) => format!("linear gradient {}", stops(gradient.stops())),
        usvg::Paint::RadialGradient(gradient) => format!("radial gradient {}", stops(gradient.stops())),
        usvg::Paint::Pattern(pattern) => {
            let mut hasher = FxHasher::default();
            group(pattern.root(), &mut hasher);
            format!("pattern {:016x}", hasher.finish())
        }
    };
    if alpha < 255 {
        let _ = write!(words, " at {:.0} %", f64::from(alpha) / 2.55);
    }
    words
}

fn stops(stops: &[usvg::Stop]) -> String {
    let word = |stop: &usvg::Stop| {
        let usvg::Color { red, green, blue } = stop.color();
        let (offset, opacity) = (stop.offset().get() * 100.0, stop.opacity().get());
        let faint = if opacity < 1.0 { format!("/{}", trimmed(f64::from(opacity))) } else { String::new() };
        format!("#{red:02x}{green:02x}{blue:02x}{faint} {offset:.1} %")
    };
    stops.iter().map(word).collect::<Vec<_>>().join(", ")
}

/// Hashes the content of a pattern, with coordinates rounded to a hundredth of a px.
fn group(group: &usvg::Group, hasher: &mut FxHasher) {
    for child in group.children() {
        match child {
            usvg::Node::Group(inner) => self::group(inner, hasher),
            usvg::Node::Path(path) => {
                for paint in [path.fill().map(usvg::Fill::paint), path.stroke().map(usvg::Stroke::paint)] {
                    paint.map(|paint| of(paint, 255)).hash(hasher);
                }
                for point in path.data().points() {
                    let steps = [point.x, point.y].map(|value| (f64::from(value) * 100.0).round() as i64);
                    steps.hash(hasher);
                }
            }
            usvg::Node::Image(_) | usvg::Node::Text(_) => {}
        }
    }
}
