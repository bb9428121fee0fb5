//! Area of a region, without its holes.

use kurbo::{Point, Shape as _};

use super::chain::flatten;
use crate::diff::shapes::picture::{Shape, ShapeKind};
use crate::diff::tolerances::MAX_LENGTH_ERROR_PX;

/// Regions with more rings are measured by their signed area. Nesting tests are quadratic in the number of
/// rings.
const MAX_NESTED_RINGS: usize = 200;
/// Flatness of curves in px; areas are reported to about one square px.
const FLATNESS_PX: f64 = 0.05;

/// Length of a line in px, or area of a region in square px.
pub(crate) fn size(shape: &Shape) -> f64 {
    match shape.kind {
        ShapeKind::Line => shape.path.perimeter(MAX_LENGTH_ERROR_PX),
        ShapeKind::Region | ShapeKind::Clip => area(shape),
    }
}

/// Area of a region in square px.
pub(crate) fn area(shape: &Shape) -> f64 {
    let turned = || shape.path.area().abs();
    if !shape.even_odd || shape.path.elements().len() < 5 {
        return turned();
    }
    let rings: Vec<Vec<Point>> =
        flatten(&shape.path, FLATNESS_PX, true).into_iter().map(|(ring, _)| ring).collect();
    if rings.len() < 2 || rings.len() > MAX_NESTED_RINGS {
        return turned();
    }
    let others = |index: usize| rings.iter().enumerate().filter(move |(other, _)| *other != index);
    let signed = |index: usize| ring_area(&rings[index], others(index).map(|(_, ring)| ring.as_slice()));
    (0..rings.len()).map(signed).sum()
}

/// Area enclosed by a ring. It is negative for holes: rings inside an odd number of the others.
pub(crate) fn ring_area<'a>(ring: &[Point], others: impl Iterator<Item = &'a [Point]>) -> f64 {
    let start = ring.first().copied().unwrap_or_default();
    let is_hole = others.filter(|other| winds_round(other, start)).count() % 2 == 1;
    let crosses = ring.windows(2).map(|pair| pair[0].to_vec2().cross(pair[1].to_vec2()));
    crosses.sum::<f64>().abs() / 2.0 * if is_hole { -1.0 } else { 1.0 }
}

/// Whether a ray from the point crosses the ring an odd number of times.
fn winds_round(ring: &[Point], p: Point) -> bool {
    let crosses = |pair: &&[Point]| {
        let (a, b) = (pair[0], pair[1]);
        (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
    };
    ring.windows(2).filter(crosses).count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::colour::srgb::Colour;
    use crate::diff::shapes::ink::{ShapeInk, ShapePaint};

    #[test]
    fn region_area_subtracts_holes() {
        for (path, even_odd, wanted) in [
            ("M0 0H10V10H0Z", false, 100.0),
            ("M0 0H10V10H0ZM2 2H4V4H2Z", true, 96.0),
            ("M0 0H10V10H0ZM2 2V4H4V2Z", false, 96.0),
            ("M0 0H10V10H0ZM2 2H8V8H2ZM4 4H6V6H4Z", true, 68.0),
        ] {
            let shape = Shape {
                path: kurbo::BezPath::from_svg(path).unwrap(),
                outline: None,
                kind: ShapeKind::Region,
                even_odd,
                ink: ShapeInk::region(ShapePaint::Colour(Colour::BLACK), None),
                label: Arc::default(),
                material: None,
            };
            assert!((area(&shape) - wanted).abs() < 1e-9, "{path}: {}", area(&shape));
        }
    }
}
