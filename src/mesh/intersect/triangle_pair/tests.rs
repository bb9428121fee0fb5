//! Comparison of the early rejections with exact predicates.

use super::*;
use crate::geometry::dice::Dice;

#[test]
fn early_rejections_of_triangle_pairs_agree_with_exact_signs() {
    let mut dice = Dice::new(1);
    let (mut early, mut exact) = (0, 0);
    for k in 0..20_000 {
        let rounding = [0.0, 1e-9, 1e-7][k as usize % 3];
        let tolerance = PairTolerance { rounding, ..PairTolerance::of_exact(1.0) };
        // From regular triangles to slivers whose plane is not resolved by rounded products, with points that
        // close to the plane.
        let height = 0.1f64.powi(k % 8);
        let (a, b) = (dice.point(1.0), dice.point(1.0));
        let across = (b - a).cross(dice.point(1.0)).normalize_or_zero();
        let positions = [a, b, a + (b - a) * 0.4 + across * height];
        let triangle = Triangle::new(&positions, [0, 1, 2]);
        let length = triangle.normal.length();
        if length <= 0.0 {
            continue;
        }
        let out = triangle.normal / length;
        let points = [0, 1, 2].map(|_| {
            let off = 0.1f64.powi(7 + (k / 8) % 7) * dice.between(-1.0, 1.0);
            let inside = (b - a) * dice.between(-1.0, 1.0) + across * (height * dice.between(-1.0, 1.0));
            a + inside + out * off
        });
        for point in points {
            let far = positions.iter().map(|p| p.distance(point)).fold(0.0, f64::max);
            let within = triangle.plane_tolerance(point, length, tolerance) * length;
            assert!(within <= far_tolerance(far, length, tolerance) * (1.0 + 1e-12), "{positions:?} {point}");
        }
        let signs = points.map(|p| triangle.distance(p, length, tolerance));
        let is_crossed = signs.iter().any(|d| *d < 0.0) && signs.iter().any(|d| *d > 0.0);
        match triangle.distances(&points, length, tolerance) {
            Some(distances) => assert_eq!(distances, signs, "{positions:?} {points:?}"),
            None => assert!(!is_crossed, "{positions:?} {points:?}"),
        }
        early += u32::from(triangle.distances(&points, length, tolerance).is_none());
        exact += u32::from(is_crossed);
    }
    assert!(early > 500 && exact > 2000, "{early} {exact}");
}
