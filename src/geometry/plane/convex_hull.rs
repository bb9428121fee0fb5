//! [`convex_hull`]: the convex hull of points in the plane.

use kurbo::Point;

/// Convex hull of points, clockwise where y points down (Andrew's monotone chain).
pub(crate) fn convex_hull(mut points: Vec<Point>) -> Vec<Point> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let turns = |a: Point, b: Point, c: Point| (b - a).cross(c - a) > 0.0;
    let chain = |points: &mut dyn Iterator<Item = Point>| {
        let mut chain: Vec<Point> = Vec::new();
        for p in points {
            while let [.., a, b] = chain.as_slice() {
                if turns(*a, *b, p) {
                    break;
                }
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut lower = chain(&mut points.iter().copied());
    lower.extend(chain(&mut points.iter().rev().copied()));
    lower
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn convex_hull_of_a_square_has_four_corners() {
        let points = [(0.0, 0.0), (2.0, 0.0), (1.0, 1.0), (2.0, 2.0), (0.0, 2.0), (1.0, 0.0)];
        let found = convex_hull(points.iter().map(|p| Point::new(p.0, p.1)).collect());
        assert_eq!(found.len(), 4, "{found:?}");
    }
}
