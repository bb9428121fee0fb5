//! Area of a region, without its holes.

use kurbo::{Point, Shape as _};

use super::chain::flatten;
use crate::diff::shapes::picture::Shape;

/// Regions with more rings are measured by their signed area. Nesting tests are quadratic in the number of
/// rings.
const MAX_NESTED_RINGS: usize = 200;
/// Flatness of curves in px; areas are reported to about one square px.
const FLATNESS_PX: f64 = 0.05;

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
    let depth = |index: usize| {
        let point = rings[index].first().copied().unwrap_or_default();
        let around = |other: &usize| *other != index && winds_round(&rings[*other], point);
        (0..rings.len()).filter(around).count()
    };
    let signed = |index: usize| ring_area(&rings[index]) * if depth(index) % 2 == 0 { 1.0 } else { -1.0 };
    (0..rings.len()).map(signed).sum()
}

/// Area enclosed by a ring.
pub(crate) fn ring_area(ring: &[Point]) -> f64 {
    ring.windows(2).map(|pair| pair[0].to_vec2().cross(pair[1].to_vec2())).sum::<f64>().abs() / 2.0
}

/// Whether a ray from the point crosses the ring an odd number of times.
pub(crate) fn winds_round(ring: &[Point], p: Point) -> bool {
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
    use crate::diff::shapes::picture::ShapeKind;

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
