//! Clips lines and areas to a region of the page.
//!
//! Lines are cut at their exact intersections with the border, and curves stay curves. Areas are flattened
//! and clipped by the Sutherland-Hodgman algorithm, for convex regions only.

use kurbo::{BezPath, Line, ParamCurve, PathEl, PathSeg, Point, Rect, Shape};

use crate::geometry::plane::polyline_path::{add_polygon, subpaths};

/// A region of the page: the inside of a path with flattened curves.
#[derive(Debug, Clone)]
pub(crate) struct ClipRegion {
    path: BezPath,
    sides: Vec<Line>,
    bounds: Rect,
    /// The corners, in the direction with the inside at non-negative `cross`; `None` unless the region is a
    /// single convex polygon.
    convex: Option<Vec<Point>>,
}

impl ClipRegion {
    /// The inside of a path, flattened with a tolerance.
    pub(crate) fn new(path: &BezPath, tolerance: f64) -> Self {
        let mut flat = BezPath::new();
        kurbo::flatten(path, tolerance, |element| flat.push(element));
        let sides: Vec<Line> = flat
            .segments()
            .filter_map(|segment| match segment {
                PathSeg::Line(line) if line.p0 != line.p1 => Some(line),
                _ => None,
            })
            .collect();
        let loops = flat.elements().iter().filter(|element| matches!(element, PathEl::MoveTo(_))).count();
        let convex = (loops == 1).then(|| convex_corners(&sides)).flatten();
        Self { bounds: flat.bounding_box(), path: flat, sides, convex }
    }

    fn holds(&self, p: Point) -> bool {
        self.path.winding(p) != 0
    }

    fn misses(&self, bounds: Rect) -> bool {
        bounds.x0 > self.bounds.x1
            || bounds.x1 < self.bounds.x0
            || bounds.y0 > self.bounds.y1
            || bounds.y1 < self.bounds.y0
    }

    /// The part of a line inside the region.
    pub(crate) fn line(&self, path: &BezPath) -> BezPath {
        let mut kept = BezPath::new();
        if self.misses(path.bounding_box()) {
            return kept;
        }
        for run in subpaths(path) {
            self.add_run(&run, &mut kept);
        }
        kept
    }

    fn add_run(&self, run: &BezPath, kept: &mut BezPath) {
        let pieces: Vec<(PathSeg, bool)> = run.segments().flat_map(|segment| self.pieces(segment)).collect();
        if pieces.iter().all(|(_, inside)| *inside) {
            kept.extend(run.iter());
            return;
        }
        // A closed line continues over its seam, so it starts where it enters the region.
        let closed = run.elements().last() == Some(&PathEl::ClosePath);
        let begin = if closed { pieces.iter().position(|(_, inside)| !inside).unwrap_or(0) } else { 0 };
        let mut is_open = false;
        for (piece, inside) in pieces.iter().cycle().skip(begin).take(pieces.len()) {
            if *inside {
                if !is_open {
                    kept.move_to(piece.start());
                }
                kept.push(piece.as_path_el());
            }
            is_open = *inside;
        }
    }

    /// The pieces of a segment between its crossings with the border, and whether each is inside.
    fn pieces(&self, segment: PathSeg) -> Vec<(PathSeg, bool)> {
        let bounds = segment.bounding_box();
        let near = self.sides.iter().filter(|side| {
            let side = side.bounding_box();
            side.x0 <= bounds.x1 && side.x1 >= bounds.x0 && side.y0 <= bounds.y1 && side.y1 >= bounds.y0
        });
        let mut cuts: Vec<f64> =
            near.flat_map(|side| segment.intersect_line(*side)).map(|hit| hit.segment_t).collect();
        cuts.retain(|t| *t > 0.0 && *t < 1.0);
        cuts.extend([0.0, 1.0]);
        cuts.sort_by(f64::total_cmp);
        cuts.dedup();
        let piece = |pair: &[f64; 2]| {
            let inside = self.holds(segment.eval(f64::midpoint(pair[0], pair[1])));
            (if *pair == [0.0, 1.0] { segment } else { segment.subsegment(pair[0]..pair[1]) }, inside)
        };
        cuts.array_windows().map(piece).collect()
    }

    /// The part of an area inside a convex region. Its curves become polygons within `tolerance`. If the
    /// region is not convex, an area that touches it is returned unchanged.
    pub(crate) fn area(&self, path: &BezPath, tolerance: f64) -> BezPath {
        let bounds = path.bounding_box();
        if self.misses(bounds) {
            return BezPath::new();
        }
        let corners =
            [(bounds.x0, bounds.y0), (bounds.x1, bounds.y0), (bounds.x1, bounds.y1), (bounds.x0, bounds.y1)];
        let Some(convex) = &self.convex else { return path.clone() };
        if corners.iter().all(|corner| convex_holds(convex, Point::from(*corner))) {
            return path.clone();
        }
        let mut cut = BezPath::new();
        for run in subpaths(path) {
            let mut ring: Vec<Point> = Vec::new();
            kurbo::flatten(&run, tolerance, |element| match element {
                PathEl::MoveTo(p) | PathEl::LineTo(p) => ring.push(p),
                _ => {}
            });
            let ring = sides_of(convex).fold(ring, |ring, side| clip_to_half_plane(&ring, side));
            add_polygon(&mut cut, ring);
        }
        cut
    }
}

/// The corners of a convex polygon, in the direction with the inside at non-negative `cross`; `None` if it is
/// not convex.
fn convex_corners(sides: &[Line]) -> Option<Vec<Point>> {
    let turn = |a: &Line, b: &Line| (a.p1 - a.p0).cross(b.p1 - b.p0);
    let next = sides.iter().cycle().skip(1);
    let turns: Vec<f64> = sides.iter().zip(next).map(|(a, b)| turn(a, b)).collect();
    let mut corners: Vec<Point> = sides.iter().map(|side| side.p0).collect();
    if turns.iter().all(|turn| *turn <= 0.0) {
        corners.reverse();
    } else if !turns.iter().all(|turn| *turn >= 0.0) {
        return None;
    }
    (corners.len() >= 3).then_some(corners)
}

fn sides_of(corners: &[Point]) -> impl Iterator<Item = [Point; 2]> + '_ {
    corners.iter().zip(corners.iter().cycle().skip(1)).map(|(a, b)| [*a, *b])
}

fn convex_holds(corners: &[Point], p: Point) -> bool {
    sides_of(corners).all(|[a, b]| (b - a).cross(p - a) >= 0.0)
}

/// The part of a polygon on the inner side of a line.
///
/// Source: I. Sutherland and G. Hodgman, "Reentrant polygon clipping", CACM 17(1), 1974.
fn clip_to_half_plane(ring: &[Point], [a, b]: [Point; 2]) -> Vec<Point> {
    let side = |p: Point| (b - a).cross(p - a);
    let mut kept = Vec::with_capacity(ring.len() + 2);
    for (from, to) in ring.iter().zip(ring.iter().cycle().skip(1)) {
        let (of_from, of_to) = (side(*from), side(*to));
        if of_from >= 0.0 {
            kept.push(*from);
        }
        if (of_from >= 0.0) != (of_to >= 0.0) {
            kept.push(from.lerp(*to, of_from / (of_from - of_to)));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use kurbo::Circle;

    use super::*;

    fn path(data: &str) -> BezPath {
        BezPath::from_svg(data).unwrap()
    }

    #[test]
    fn clipped_lines_end_at_the_region_border() {
        let region = ClipRegion::new(&path("M0 0H10V10H0Z"), 0.01);
        assert_eq!(region.line(&path("M-5 5H15")).to_svg(), "M0,5 L10,5");
        assert_eq!(region.line(&path("M1 1H9V9")).to_svg(), "M1,1 L9,1 L9,9");
        assert!(region.line(&path("M11 1H19")).elements().is_empty());
        // A closed line that starts inside stays in one piece.
        assert_eq!(region.line(&path("M5 5H15V8H5Z")).to_svg(), "M10,8 L5,8 L5,5 L10,5");
        let both = region.line(&path("M-5 2H5V-5M20 20H30"));
        assert_eq!(both.to_svg(), "M0,2 L5,2 L5,0");
    }

    #[test]
    fn clipped_curves_stay_curves() {
        let region = ClipRegion::new(&path("M0 0H10V10H0Z"), 0.01);
        let kept = region.line(&path("M-2 5C4 0 8 10 12 5"));
        assert_eq!(kept.elements().len(), 2, "{}", kept.to_svg());
        assert!(matches!(kept.elements()[1], PathEl::CurveTo(..)));
        let ends = [kept.segments().next().unwrap().start(), kept.segments().next().unwrap().end()];
        assert!(ends[0].x.abs() < 1e-9 && (ends[1].x - 10.0).abs() < 1e-9);
    }

    #[test]
    fn clipped_areas_are_intersections() {
        let region = ClipRegion::new(&Circle::new((0.0, 0.0), 5.0).to_path(1e-4), 1e-4);
        let half = region.area(&path("M0 -20H20V20H0Z"), 1e-4);
        assert!((half.area().abs() - std::f64::consts::PI * 12.5).abs() < 1e-2, "{}", half.area());
        // A hole stays a hole.
        let ring = region.area(&path("M-9 -9H9V9H-9ZM-1 -1V1H1V-1Z"), 1e-4);
        assert!((ring.area().abs() - (std::f64::consts::PI * 25.0 - 4.0)).abs() < 1e-2, "{}", ring.area());
        assert!(region.area(&path("M8 8H9V9H8Z"), 1e-4).elements().is_empty());
    }
}
