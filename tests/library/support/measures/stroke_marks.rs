//! Chains made of points, the marks that a style paints for them, and measures of these marks.

use kurbo::{BezPath, ParamCurve, ParamCurveNearest, Point, Shape};
use libm::{cos, sin};
use ligne::chains::{Chain, Sample};
use ligne::drawing::{Mark, OutlinePaint, Paint, Unit};
use ligne::lines::LineKind;
use ligne::mesh::{MaterialId, PartId};
use ligne::strokes::{InkContext, ink};
use ligne::style::Style;
use std::f64::consts::TAU;
use std::sync::Arc;

/// The ink style with pens of 4 px and overrides.
pub(crate) fn ink_style(sets: &[&str]) -> Style {
    let plain = ["pen.contour.width=4", "pen.silhouette.width=4", "pen.width=4"];
    let sets: Vec<String> = plain.iter().chain(sets).map(|set| (*set).to_owned()).collect();
    Style::load_with("ink", &sets).unwrap_or_else(|error| panic!("{error}"))
}

/// A polyline as a chain whose depth runs linearly from the first to the second number.
pub(crate) fn polyline_chain(points: &[(f64, f64)], depths: [f64; 2]) -> Chain {
    let points: Vec<Point> = points.iter().map(|p| Point::from(*p)).collect();
    let closed = points.len() > 2 && points.first() == points.last();
    let mut path = BezPath::new();
    path.move_to(points[0]);
    points[1..].iter().for_each(|p| path.line_to(*p));
    let last = points.len() - 1;
    let depth = |i: usize| depths[0] + (depths[1] - depths[0]) * i as f64 / last as f64;
    let samples: Vec<Sample> = (0..=last).map(|i| Sample::new(depth(i), 1.0)).collect();
    let mut chain = Chain {
        identity: 0,
        rest_cells: Arc::default(),
        points,
        samples,
        closed,
        kind: LineKind::Crease,
        silhouette: false,
        invisibility: 0,
        veiled: false,
        both_seen: false,
        part: PartId(0),
        material: MaterialId(0),
        smooth: false,
        covered: [false; 2],
        segment: 0,
        path,
    };
    if closed {
        chain.points.pop();
        chain.samples.pop();
        chain.path.close_path();
    }
    chain
}

/// A circle of 720 sides, turning from x to y, with an exact path.
pub(crate) fn circle_chain(radius: f64) -> Chain {
    let at = |i: u32| {
        let angle = TAU * f64::from(i % 720) / 720.0;
        (200.0 + radius * cos(angle), 200.0 + radius * sin(angle))
    };
    let mut chain = polyline_chain(&(0..=720).map(at).collect::<Vec<_>>(), [1.0; 2]);
    chain.path = kurbo::Circle::new((200.0, 200.0), radius).to_path(1e-3);
    chain
}

/// The ink context of a drawing without a scene.
pub(crate) fn ink_context(style: &Style) -> InkContext<'static> {
    InkContext {
        unit: Unit::Px,
        parts: &[],
        materials: &[],
        hidden: style.lines.hidden,
        behind_glass: 0.5,
        seed: style.seed,
        painted: style.region.enabled,
        depths: [2.0, 4.0],
        names: &[],
        parting: None,
        frame: None,
    }
}

/// The marks that a style paints for chains.
pub(crate) fn marks(chains: &[Chain], style: &Style) -> Vec<Mark> {
    ink(chains, &ink_context(style), &style.stroke).into_iter().flat_map(|layer| layer.marks).collect()
}

/// The outline paint of a mark of varying width.
pub(crate) fn outline_paint(mark: &Mark) -> &OutlinePaint {
    match &mark.paint {
        Paint::Outline(outline) => outline,
        _ => panic!("not a line of varying width: {mark:?}"),
    }
}

/// The centre line of a mark.
pub(crate) fn centre_line(mark: &Mark) -> &BezPath {
    match &mark.paint {
        Paint::Outline(outline) => &outline.axis,
        _ => &mark.path,
    }
}

/// Vertical extent of an outline at `x`, around the point (`x`, `y`) inside it.
pub(crate) fn width_at(mark: &Mark, x: f64, y: f64) -> f64 {
    let inside = |y: f64| mark.path.winding(Point::new(x, y)) != 0;
    assert!(inside(y), "no ink at {x}, {y}");
    let edge = |sign: f64| {
        let (mut low, mut high) = (0.0, 20.0);
        for _ in 0..40 {
            let middle = (low + high) / 2.0;
            if inside(y + sign * middle) { low = middle } else { high = middle }
        }
        low
    };
    edge(1.0) + edge(-1.0)
}

/// Points on a path, at most about `step` apart.
pub(crate) fn sample_path(path: &BezPath, step: f64) -> Vec<Point> {
    let mut places = Vec::new();
    for segment in path.segments() {
        let count = (kurbo::ParamCurveArclen::arclen(&segment, 1e-3) / step).ceil().max(1.0) as usize;
        places.extend((0..=count).map(|k| segment.eval(k as f64 / count as f64)));
    }
    places
}

/// The distance from a point to a path.
pub(crate) fn path_distance(path: &BezPath, p: Point) -> f64 {
    path.segments().map(|s| s.nearest(p, 1e-6).distance_sq).fold(f64::INFINITY, f64::min).sqrt()
}

pub(crate) fn path_length(path: &BezPath) -> f64 {
    path.segments().map(|s| kurbo::ParamCurveArclen::arclen(&s, 1e-3)).sum()
}
