//! [`clip_polygon`]: a filled shape clipped to a part of the page.
//!
//! The borders near the shape are closed along a box around it. Shape and borders are rounded to a fine grid
//! and split where they cross. All tests are exact in integers ([`super::polygon_boolean`]), so the result is always
//! closed.

use kurbo::{BezPath, Point, Rect};

use super::polygon_boolean::{BoundaryEdges, ClipGridPoint};
use crate::geometry::plane::polyline_path::add_polygon;
use crate::geometry::plane::polylines::bounds;

/// Grid steps along the longer side of the box.
const GRID_STEPS: f64 = 4_194_304.0;

/// Margins of the box as shares of the shape's size. If a border runs into a corner of the box, the next one
/// is tried.
const BOX_MARGINS_OF_SIZE: [f64; 4] = [0.017, 0.031, 0.053, 0.097];

/// Share of the margin on the left, top, right and bottom. They differ because borders may run along
/// diagonals.
const MARGIN_SHARES_BY_SIDE: [f64; 4] = [0.83, 0.62, 0.71, 1.0];

/// The part of a shape, filled by the nonzero rule, inside the domain bounded by `border`. `None` if nothing
/// is left.
///
/// `border` has at least all pieces that enter the shape's box or come near it. `is_in` returns whether a
/// point away from the border lies in the domain.
pub(crate) fn clip_polygon(
    rings: &[Vec<Point>],
    border: &[[Point; 2]],
    is_in: impl Fn(Point) -> bool,
) -> Option<BezPath> {
    let bounds = bounds(rings.iter().flatten().copied())?;
    let tried = BOX_MARGINS_OF_SIZE.iter().find_map(|margin| {
        let grid = ClipGrid::around(bounds, *margin)?;
        let mut edges = BoundaryEdges::default();
        for ring in rings {
            for k in 0..ring.len() {
                edges.add([ring[k], ring[(k + 1) % ring.len()]].map(|p| grid.at(p)), 1, false);
            }
        }
        grid.add_domain(border, &is_in, &mut edges)?;
        let rings = edges.cut()?.intersection_rings();
        let mut path = BezPath::new();
        for ring in rings {
            add_polygon(&mut path, ring.into_iter().map(|p| grid.point(p)));
        }
        Some(path)
    })?;
    (!tried.elements().is_empty()).then_some(tried)
}

/// Fill rule of a shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum WindingRule {
    /// Nonzero: inside where the winding number is not 0.
    NonZero,
    /// Even-odd: inside where the winding number is odd.
    EvenOdd,
}

/// The border of the union of several shapes, with a consistent orientation. `None` if it is empty.
pub(crate) fn unite_shapes(shapes: &[(Vec<Vec<Point>>, WindingRule)]) -> Option<Vec<Vec<Point>>> {
    let points = shapes.iter().flat_map(|(rings, _)| rings).flatten().copied();
    let grid = ClipGrid::around(bounds(points)?, BOX_MARGINS_OF_SIZE[0])?;
    let [right, bottom] = grid.far_corner;
    let frame = [[0, 0], [right, 0], [right, bottom], [0, bottom]];
    let mut all = BoundaryEdges::default();
    for (rings, filling) in shapes {
        let mut edges = BoundaryEdges::default();
        for ring in rings {
            for k in 0..ring.len() {
                let ends = [ring[k], ring[(k + 1) % ring.len()]].map(|p| grid.at(p));
                match filling {
                    WindingRule::NonZero => edges.add(ends, 1, false),
                    WindingRule::EvenOdd => edges.add(ends, 0, true),
                }
            }
        }
        for k in 0..4 {
            let ends = [frame[k], frame[(k + 1) % 4]];
            match filling {
                WindingRule::NonZero => edges.add(ends, 0, true),
                WindingRule::EvenOdd => edges.add(ends, 1, false),
            }
        }
        for ring in edges.cut()?.intersection_rings() {
            (0..ring.len()).for_each(|k| all.add([ring[k], ring[(k + 1) % ring.len()]], 1, false));
        }
    }
    (0..4).for_each(|k| all.add([frame[k], frame[(k + 1) % 4]], 0, true));
    let rings = all.cut()?.intersection_rings();
    Some(rings.iter().map(|ring| ring.iter().map(|p| grid.point(*p)).collect()).collect())
}

/// The area around a shape's bounding box where borders have to be known.
pub(crate) fn clip_reach(bounds: Rect) -> Rect {
    let most =
        bounds.width().max(bounds.height()) * (BOX_MARGINS_OF_SIZE[BOX_MARGINS_OF_SIZE.len() - 1] + 0.01);
    bounds.inflate(most, most)
}

/// Integer grid over a box around a shape.
struct ClipGrid {
    origin: Point,
    step: f64,
    /// Far corner of the box. The near corner is 0.
    far_corner: ClipGridPoint,
}

impl ClipGrid {
    fn around(bounds: Rect, margin: f64) -> Option<Self> {
        let size = bounds.width().max(bounds.height());
        let [left, top, right, bottom] = MARGIN_SHARES_BY_SIDE.map(|part| size * margin * part);
        let bounds = bounds + kurbo::Insets::new(left, top, right, bottom);
        let step = bounds.width().max(bounds.height()) / GRID_STEPS;
        (step > 0.0 && step.is_finite()).then(|| Self {
            origin: bounds.origin(),
            step,
            far_corner: [bounds.width(), bounds.height()].map(|side| (side / step).round() as i64),
        })
    }

    fn at(&self, p: Point) -> ClipGridPoint {
        let from = (p - self.origin) / self.step;
        [from.x.round() as i64, from.y.round() as i64]
    }

    fn point(&self, [x, y]: ClipGridPoint) -> Point {
        self.origin + kurbo::Vec2::new(x as f64, y as f64) * self.step
    }

    /// Adds the border of the domain inside the box, closed along the box. `None` if it runs into a corner.
    fn add_domain(
        &self,
        border: &[[Point; 2]],
        is_in: &impl Fn(Point) -> bool,
        edges: &mut BoundaryEdges,
    ) -> Option<()> {
        let [right, bottom] = self.far_corner;
        // Crossings with the box, as distances around its border, clockwise.
        let mut gates: Vec<i64> = Vec::new();
        for [a, b] in border {
            let Some([from, to]) = self.within([*a, *b]) else { continue };
            for (p, is_cut) in [from, to] {
                if is_cut {
                    gates.push(match p {
                        [x, 0] => x,
                        [x, y] if x == right => right + y,
                        [x, y] if y == bottom => 2 * right + bottom - x,
                        [_, y] => 2 * (right + bottom) - y,
                    });
                }
            }
            edges.add([from.0, to.0], 0, true);
        }
        let corners = [0, right, right + bottom, 2 * right + bottom, 2 * (right + bottom)];
        gates.sort_unstable();
        if gates.len() % 2 == 1 || gates.iter().any(|gate| corners.contains(gate)) {
            return None;
        }
        // The middle of the widest stretch of the box between crossings is tested. Stretches alternate from
        // there.
        let round = corners[4];
        let around = |position: i64| -> ClipGridPoint {
            let wrapped = position.rem_euclid(round);
            if wrapped < right {
                [wrapped, 0]
            } else if wrapped < right + bottom {
                [right, wrapped - right]
            } else if wrapped < 2 * right + bottom {
                [2 * right + bottom - wrapped, bottom]
            } else {
                [0, round - wrapped]
            }
        };
        let count = gates.len();
        let next = |k: usize| if k + 1 < count { gates[k + 1] } else { gates[0] + round };
        let Some(widest) = (0..count).max_by_key(|k| (next(*k) - gates[*k], *k)) else {
            if is_in(self.point([0, 0])) {
                (0..4).for_each(|k| edges.add([corners[k], corners[k + 1]].map(around), 0, true));
            }
            return Some(());
        };
        let starts_inside = is_in(self.point(around(gates[widest].midpoint(next(widest)))));
        for k in (0..count).filter(|k| starts_inside == ((*k % 2) == (widest % 2))) {
            let mut stretch_start = gates[k];
            let turns = corners.iter().flat_map(|corner| [*corner, corner + round]);
            let mut stops: Vec<i64> =
                turns.filter(|at| stretch_start < *at && *at < next(k)).chain([next(k)]).collect();
            stops.sort_unstable();
            stops.dedup();
            for stop in stops {
                edges.add([stretch_start, stop].map(around), 0, true);
                stretch_start = stop;
            }
        }
        Some(())
    }

    /// The part of a segment inside the box, and whether each end was cut off.
    fn within(&self, [a, b]: [Point; 2]) -> Option<[(ClipGridPoint, bool); 2]> {
        let [a, b] = [a, b].map(|p| (p - self.origin) / self.step);
        let segment = b - a;
        let (mut from, mut to) = (0.0_f64, 1.0_f64);
        for (start, component, limit) in
            [(a.x, segment.x, self.far_corner[0]), (a.y, segment.y, self.far_corner[1])]
        {
            let axis_limit = limit as f64;
            if component == 0.0 {
                if !(0.0..=axis_limit).contains(&start) {
                    return None;
                }
                continue;
            }
            let (s, t) = (-start / component, (axis_limit - start) / component);
            from = from.max(s.min(t));
            to = to.min(s.max(t));
        }
        let grid_end = |t: f64, is_cut: bool| {
            let p = a + segment * t;
            let [mut x, mut y] = [p.x.round() as i64, p.y.round() as i64].map(|v| v.max(0));
            (x, y) = (x.min(self.far_corner[0]), y.min(self.far_corner[1]));
            if is_cut {
                // Snap a cut end to the nearest side of the box, against rounding.
                let off = [(0, x), (1, self.far_corner[0] - x), (2, y), (3, self.far_corner[1] - y)];
                match off.into_iter().min_by_key(|(_, off)| *off) {
                    Some((0, _)) => x = 0,
                    Some((1, _)) => x = self.far_corner[0],
                    Some((2, _)) => y = 0,
                    _ => y = self.far_corner[1],
                }
            }
            ([x, y], is_cut)
        };
        (from < to).then(|| [grid_end(from, from > 0.0), grid_end(to, to < 1.0)])
    }
}

#[cfg(test)]
mod tests {
    use crate::geometry::plane::polyline_path::polygon;
    use kurbo::Shape;

    use super::*;
    use crate::geometry::numbers::noise::{hash, unit_interval};
    use crate::geometry::numbers::portable_math::{cos, sin};

    /// Star with the given number of corners, some of them on whole numbers.
    fn star(case: u64, corners: u64, middle: Point, size: f64) -> Vec<Point> {
        let corner = |k: u64| {
            let angle = std::f64::consts::TAU * k as f64 / corners as f64;
            let far = size * (0.2 + 0.8 * unit_interval(hash(case, &[corners, k])));
            let p = middle + kurbo::Vec2::new(cos(angle), sin(angle)) * far;
            if hash(case, &[k, 7]).is_multiple_of(3) { p.round() } else { p }
        };
        (0..corners).map(corner).collect()
    }

    fn path_of(ring: &[Point]) -> BezPath {
        polygon(ring.iter().copied())
    }

    #[test]
    fn clip_polygon_returns_the_intersection_of_random_stars() {
        let mut inside = 0;
        for case in 0..60 {
            let middle = |k: u64| {
                Point::new(
                    20.0 * unit_interval(hash(case, &[1, k])),
                    20.0 * unit_interval(hash(case, &[2, k])),
                )
            };
            // A star with a smaller one cut out of it, or with an overlapping one of the same orientation.
            let mut rings = vec![star(case, 9, middle(0), 12.0), star(case, 5, middle(0), 4.0)];
            if case % 2 == 0 {
                rings[1].reverse();
            }
            let domain = [star(case, 12, middle(1), 15.0), star(case, 7, middle(2), 9.0)];
            let border: Vec<[Point; 2]> = domain
                .iter()
                .flat_map(|ring| (0..ring.len()).map(|k| [ring[k], ring[(k + 1) % ring.len()]]))
                .collect();
            let shapes: Vec<BezPath> = rings.iter().map(|ring| path_of(ring)).collect();
            let domains: Vec<BezPath> = domain.iter().map(|ring| path_of(ring)).collect();
            let is_in = |p: Point| domains.iter().filter(|path| path.contains(p)).count() % 2 == 1;
            let wanted = |p: Point| shapes.iter().map(|path| path.winding(p)).sum::<i32>() != 0 && is_in(p);
            let found = clip_polygon(&rings, &border, is_in).unwrap_or_default();
            let near = |p: Point| {
                let sides = rings.iter().chain(&domain).flat_map(|ring| {
                    (0..ring.len()).map(|k| {
                        crate::geometry::plane::planar_distance::segment_distance_squared(
                            p,
                            ring[k],
                            ring[(k + 1) % ring.len()],
                        )
                    })
                });
                sides.fold(f64::INFINITY, f64::min) < 1e-6
            };
            for k in 0..2500 {
                let p = Point::new(f64::from(k % 50) * 0.73 - 8.0, f64::from(k / 50) * 0.73 - 8.0);
                if !near(p) {
                    let winding = found.winding(p);
                    assert_eq!(winding != 0, wanted(p), "{case} {p:?} {found:?}");
                    assert!(winding.abs() <= 1, "all turn alike");
                    inside += i32::from(winding != 0);
                }
            }
        }
        assert!(inside > 4_000, "{inside}");
    }

    #[test]
    fn clip_polygon_accepts_borders_along_sides_and_through_corners() {
        let square = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)];
        let square: Vec<Point> = square.map(Point::from).to_vec();
        let left = |x: f64| {
            let border = [[Point::new(x, -9.0), Point::new(x, 9.0)]];
            clip_polygon(std::slice::from_ref(&square), &border, |p| p.x < x)
                .map_or(0.0, |path| path.area().abs())
        };
        for (x, area) in [(-1.0, 0.0), (0.0, 0.0), (1.0, 4.0), (4.0, 16.0), (4.0 + 1e-9, 16.0), (5.0, 16.0)] {
            assert!((left(x) - area).abs() < 1e-4, "{x}: {}", left(x));
        }
        let border = [[Point::new(-9.0, -9.0), Point::new(9.0, 9.0)]];
        let half = clip_polygon(std::slice::from_ref(&square), &border, |p| p.x < p.y).unwrap();
        assert!((half.area().abs() - 8.0).abs() < 1e-4);
        let all = clip_polygon(std::slice::from_ref(&square), &[], |_| true).unwrap();
        assert!((all.area().abs() - 16.0).abs() < 1e-4 && clip_polygon(&[square], &[], |_| false).is_none());
    }
}
