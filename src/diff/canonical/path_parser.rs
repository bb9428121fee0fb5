//! SVG path data with absolute coordinates, parsed by the crate `svgtypes`. Invalid data is rejected as a whole.

use kurbo::{BezPath, Point, Vec2};
use svgtypes::{PathParser, PathSegment};

/// Parsed path data.
#[derive(Debug, Default)]
pub(crate) struct ParsedPath {
    /// Lines and curves with absolute coordinates.
    pub path: BezPath,
    /// Start point of the data.
    pub start: Option<Point>,
    /// Whether there are arcs. Parsing stops at the first arc.
    pub has_arcs: bool,
    /// Whether there are moves without a following segment.
    pub has_lone_moves: bool,
}

/// Parses path data; `None` if it is invalid.
pub(crate) fn read(data: &str) -> Option<ParsedPath> {
    // The crate accepts a comma at the end.
    if data.trim_end().ends_with(',') {
        return None;
    }
    let mut found = ParsedPath::default();
    // Current point, start of the subpath, and a pending move.
    let (mut pen, mut start, mut move_to) = (Point::ZERO, Point::ZERO, None);
    // Segments after a close without a move start where the closed subpath did.
    let mut closed = false;
    // Last control point of each kind, for the shorthand curve commands.
    let (mut quad, mut cubic) = (None, None);
    for segment in PathParser::from(data) {
        let segment = segment.ok()?;
        let origin = if segment.is_abs() { Vec2::ZERO } else { pen.to_vec2() };
        let at = |x: f64, y: f64| Point::new(x, y) + origin;
        let after_close = std::mem::take(&mut closed);
        if !matches!(segment, PathSegment::MoveTo { .. }) {
            let from = move_to.take().or(after_close.then_some(start));
            from.into_iter().for_each(|from| found.path.move_to(from));
        }
        let (last_quad, last_cubic) = (quad.take(), cubic.take());
        let mirrored = |control: Option<Point>| control.map_or(pen, |c| pen + (pen - c));
        match segment {
            PathSegment::MoveTo { x, y, .. } => {
                pen = at(x, y);
                start = pen;
                found.start.get_or_insert(pen);
                found.has_lone_moves |= move_to.replace(pen).is_some();
            }
            PathSegment::LineTo { x, y, .. } => {
                pen = at(x, y);
                found.path.line_to(pen);
            }
            PathSegment::HorizontalLineTo { x, .. } => {
                pen.x = x + origin.x;
                found.path.line_to(pen);
            }
            PathSegment::VerticalLineTo { y, .. } => {
                pen.y = y + origin.y;
                found.path.line_to(pen);
            }
            PathSegment::Quadratic { x, y, .. } | PathSegment::SmoothQuadratic { x, y, .. } => {
                let control = match segment {
                    PathSegment::Quadratic { x1, y1, .. } => at(x1, y1),
                    _ => mirrored(last_quad),
                };
                pen = at(x, y);
                found.path.quad_to(control, pen);
                quad = Some(control);
            }
            PathSegment::CurveTo { x2, y2, x, y, .. } | PathSegment::SmoothCurveTo { x2, y2, x, y, .. } => {
                let first = match segment {
                    PathSegment::CurveTo { x1, y1, .. } => at(x1, y1),
                    _ => mirrored(last_cubic),
                };
                let second = at(x2, y2);
                pen = at(x, y);
                found.path.curve_to(first, second, pen);
                cubic = Some(second);
            }
            PathSegment::ClosePath { .. } => {
                found.path.close_path();
                (pen, closed) = (start, true);
            }
            PathSegment::EllipticalArc { .. } => {
                found.has_arcs = true;
                return Some(found);
            }
        }
    }
    found.has_lone_moves |= move_to.is_some();
    found.path.elements().iter().all(|element| element.is_finite()).then_some(found)
}

#[cfg(test)]
mod tests {
    use super::read;

    #[test]
    fn path_parser_follows_the_svg_path_grammar() {
        for (data, wanted) in [
            ("M1 2 3 4", "M1,2 L3,4"),
            (" m 1,2 , 3 -4.5.5-1e1 ", "M1,2 L4,-2.5 L4.5,-12.5"),
            ("M1 1h+2v.5H0V0z", "M1,1 L3,1 L3,1.5 L0,1.5 L0,0 Z"),
            ("M0 0q1 1 2 0t2 0T9 9", "M0,0 Q1,1 2,0 Q3,-1 4,0 Q5,1 9,9"),
            ("M0 0c0 1 1 2 2 2s2-1 2-2", "M0,0 C0,1 1,2 2,2 C3,2 4,1 4,0"),
            // The shorthand of one kind does not mirror the other kind.
            ("M0 0q1 1 2 0s1 1 2 0", "M0,0 Q1,1 2,0 C2,0 3,1 4,0"),
            ("M0 0c0 1 1 2 2 2t2 0", "M0,0 C0,1 1,2 2,2 Q2,2 4,2"),
            ("M5 5h1zh2m1 1h1", "M5,5 L6,5 Z M5,5 L7,5 M8,6 L9,6"),
            ("M1 1m2 2h1M9 9", "M3,3 L4,3"),
            ("M1 1L2 2A1 1 0 0 1 4 4", "M1,1 L2,2"),
        ] {
            let found = read(data).map(|found| found.path.to_svg());
            assert_eq!(found.as_deref(), Some(wanted), "{data}");
        }
        assert!(read("M1 1a1 1 0 0 0 1 1").is_some_and(|found| found.has_arcs));
        let lone = |data| read(data).is_some_and(|found| found.has_lone_moves);
        assert!(lone("M1 1m2 2h1") && lone("M1 1h1m1 1") && lone("M1 1") && !lone("M1 1z"));
    }

    #[test]
    fn path_parser_rejects_malformed_path_data() {
        for data in [
            "L1 1",
            "M1",
            "M1 1L2",
            "M1 1L2 2,",
            "M1 1 x",
            "M1 1z5",
            "M1 1 L1 1e999",
            "M,1 1",
            "none",
            "M1 1L1,,2",
            "M1 1l1 1 #",
        ] {
            assert!(read(data).is_none(), "{data}");
        }
    }
}
