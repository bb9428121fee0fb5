//! [`Brush`]: a shape that is laid along lines, once or repeatedly.
//!
//! Source: Claes, Di Fiore, Vansichem and Van Reeth, Fast 3D cartoon rendering with improved quality by
//! exploiting graphics hardware, 2001, fig. 5e, for lines with a shape. The mapping by arc length follows Hsu
//! and Lee, Drawing and animation using skeletal strokes, SIGGRAPH 1994.

use std::borrow::Cow;
use std::sync::Arc;

use kurbo::{BezPath, PathEl, Point, Vec2};

use super::brush_core;
use super::brush_image::ImageCopy;
use super::brush_strip::BrushStrip;
use crate::colour::srgb::Colour;
use crate::drawing::{ImagePiece, Length, PieceContent, Unit};
use crate::geometry::numbers::portable_math::cos;
use crate::geometry::plane::planar_distance::{length, unit};
use crate::geometry::plane::polyline_path::polygon;
use crate::strokes::axes::stroke_axis::{StrokeAxis, add_stretch};
use crate::strokes::outlines::stroke_outline::{Nib, outline};
use crate::strokes::tolerances;
use crate::strokes::widths::width_profile::mean;

/// Shape along a line. Its x runs along the line from 0 to 1. Its y runs across, from -0.5 at the left edge
/// of the pen to 0.5 at the right.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Brush {
    /// The shape.
    pub shape: BrushShape,
    /// Whether it is repeated along the line instead of stretched over it.
    pub repeats: bool,
    /// Approximate length of one copy. 0: in proportion to the pen's width.
    pub length: Length,
    /// Shapes that replace it where the line turns, if it is repeated.
    pub turns: Option<TurnShapes>,
}

/// Shapes for pieces of a line that turn, by the angle from a piece to the next.
///
/// Source: Lake, Marshall, Harris and Blackstein, Stylized rendering techniques for scalable real-time 3D
/// animation, 2000, section 4.3, equation 3: straight, leftward and rightward strokes. Their pieces are edges
/// of the mesh; here a piece is one brush length.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TurnShapes {
    /// Shape for turns to the left along the line.
    pub left: BrushShape,
    /// Shape for turns to the right.
    pub right: BrushShape,
    /// Greatest turn that counts as straight, degrees.
    pub degrees: f64,
}

/// The shape of a brush.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum BrushShape {
    /// A filled path, and its length divided by its width.
    Path(BezPath, f64),
    /// Extents of the ink to the left and right of the middle at evenly spaced positions along the line, in
    /// pen widths (0 to 0.5). The second value is length divided by width.
    Profile(Vec<[f64; 2]>, f64),
    /// A picture whose interior is traced, and its length divided by its width.
    Picture(BrushStrip, f64),
    /// A picture that is shown itself, and its length divided by its width.
    Image(Arc<BrushStrip>, f64),
}

impl BrushShape {
    /// Length divided by width.
    #[must_use]
    pub(crate) const fn ratio(&self) -> f64 {
        let (Self::Path(_, ratio)
        | Self::Profile(_, ratio)
        | Self::Picture(_, ratio)
        | Self::Image(_, ratio)) = self;
        *ratio
    }

    /// The shape as a path. `size` is its length and width on the page, px.
    pub(crate) fn path(&self, size: [f64; 2]) -> Cow<'_, BezPath> {
        match self {
            Self::Path(path, _) => Cow::Borrowed(path),
            Self::Profile(profile, _) => Cow::Owned(edges(profile)),
            Self::Picture(strip, _) => Cow::Owned(strip.path(size)),
            Self::Image(strip, _) => Cow::Owned(strip.path(size)),
        }
    }
}

/// The outline of a profile.
fn edges(profile: &[[f64; 2]]) -> BezPath {
    let count = profile.len().clamp(1, MAX_PROFILE_COLUMNS);
    let at = |k: usize, side: usize| {
        let x = (k as f64 / count as f64).min(1.0);
        Point::new(x, sample(profile, x, side, false) * if side == 0 { -1.0 } else { 1.0 })
    };
    let there = (0..=count).map(|k| at(k, 0));
    let back = (0..=count).rev().map(|k| at(k, 1));
    polygon(there.chain(back))
}

/// Greatest number of columns in the outline of a profile.
const MAX_PROFILE_COLUMNS: usize = 512;

/// Greatest number of copies along a line.
const MAX_COPIES: f64 = 10_000.0;

/// Greatest deviation of mapped brush edges, px.
const EDGE_TOLERANCE_PX: f64 = 0.06;

/// Approximate distance between points on brush edges, px.
const EDGE_STEP_PX: f64 = 1.0;

/// Reach of direction samples to either side, in half widths of the pen.
const DIRECTION_REACH_HALF_WIDTHS: f64 = 1.0;

/// Cosine of the least turn that makes a corner of a brush, 20 degrees.
const CORNER_COSINE: f64 = 0.94;

/// Line drawn with a brush.
pub(crate) struct BrushOutline {
    pub path: BezPath,
    /// Mean width.
    pub width: f64,
    /// Picture visible inside the outline: the strip, its pixels along and across, and the pieces of it.
    pub image: Option<(Arc<BrushStrip>, [usize; 2], Vec<ImagePiece>)>,
}

/// Draws a line with a brush.
///
/// `thick` holds the width at each point of the axis. `reach` holds how far the ink must extend to either
/// side, without a gap, in every inked part.
pub(crate) fn brush_outline(
    brush: &Brush,
    axis: &StrokeAxis,
    thick: &[f64],
    reach: &[f64],
    nib: &Nib,
    (unit, colour): (Unit, Colour),
) -> Option<BrushOutline> {
    let total = axis.length();
    let pen = mean(axis, thick);
    if total <= 0.0 || axis.len() < 3 {
        return None;
    }
    let ratio = brush.shape.ratio();
    let one = match brush.length.in_unit(unit) {
        length if length > 0.0 => length,
        _ => ratio * pen,
    };
    let copies = if brush.repeats { (total / one).round().clamp(1.0, MAX_COPIES) } else { 1.0 };
    // On a line shorter than the brush's proportions, a single copy is made thinner, to avoid a blot.
    let thinner = if brush.repeats { 1.0 } else { (total / (ratio * pen).max(f64::MIN_POSITIVE)).min(1.0) };
    let thick: Vec<f64> = thick.iter().map(|width| width * thinner).collect();
    let thick = &thick[..];
    match (&brush.shape, &brush.turns) {
        (BrushShape::Profile(profile, _), None) => {
            let around = brush.repeats || axis.closed;
            let at = |side: usize| -> Vec<f64> {
                let of = |(arc, width): (&f64, &f64)| {
                    let position = (arc - axis.arcs[0]) / total * copies;
                    width * sample(profile, position, side, around)
                };
                axis.arcs.iter().zip(thick).map(of).collect()
            };
            let (left, right) = (at(0), at(1));
            let is_inked = |i: usize| !brush.repeats || left[i] + right[i] > 0.0;
            let at_least = |side: &[f64]| -> Vec<f64> {
                let reaching_half =
                    |(i, half): (usize, &f64)| if is_inked(i) { half.max(reach[i]) } else { *half };
                side.iter().enumerate().map(reaching_half).collect()
            };
            let (left, right) = (at_least(&left), at_least(&right));
            let full_widths: Vec<f64> = left.iter().zip(&right).map(|(l, r)| l + r).collect();
            let path = outline(axis, [&left, &right], nib)?;
            Some(BrushOutline { path, width: mean(axis, &full_widths), image: None })
        }
        (shape, turns) => {
            let map = BrushMap { axis, thick, copies, total, step: total / (axis.len() - 1) as f64 };
            let size = [total / copies, pen * thinner].map(|side_length| side_length / nib.px);
            let straight = shape.path(size);
            let turned = turns
                .as_ref()
                .map(|turns| [&turns.left, &turns.right].map(|turned_shape| turned_shape.path(size)));
            let mut path = BezPath::new();
            let mut image = match shape {
                BrushShape::Image(strip, _) => Some((Arc::clone(strip), strip.pixels(size[1]), Vec::new())),
                _ => None,
            };
            let solid = |outline: BezPath| ImagePiece { outline, shows: PieceContent::Colour(colour) };
            for number in 0..copies as usize {
                let turn = turns.as_ref().and_then(|turns| map.turn(turns.degrees, number));
                let turned_path = turned.as_ref().zip(turn).map(|(turned, turn)| &turned[turn as usize]);
                match (&mut image, turned_path) {
                    (None, own) => map.add(own.unwrap_or(&straight), number, nib.px, &mut path),
                    (Some((.., pieces)), Some(own)) => {
                        let mut outline = BezPath::new();
                        map.add(own, number, nib.px, &mut outline);
                        path.extend(outline.iter());
                        pieces.push(solid(outline));
                    }
                    (Some((_, pixels, pieces)), None) => {
                        map.add(&edges(&[[0.5; 2]]), number, nib.px, &mut path);
                        let size = [total / copies, pen * thinner];
                        let at = |p: Point| map.at(p);
                        pieces.extend(
                            ImageCopy { at: &at, number, size, pixels: *pixels, px: nib.px }.pieces(),
                        );
                    }
                }
            }
            use kurbo::Shape;
            let area = path.area();
            if reach.iter().any(|reach| *reach > 0.0) {
                let core_share = if brush.repeats { 0.0 } else { 1.0 };
                let half = |i: usize, ink_offset: Option<[f64; 2]>| match ink_offset {
                    Some(way) => way.map(|way| reach[i].max(way * thick[i])),
                    None => [reach[i] * core_share; 2],
                };
                let brush_position = |i: usize| (axis.arcs[i] - axis.arcs[0]) / total * copies;
                let columns = match shape {
                    BrushShape::Picture(strip, _) => Cow::Borrowed(&strip.ink_offsets),
                    BrushShape::Image(strip, _) => Cow::Borrowed(&strip.ink_offsets),
                    _ => Cow::Owned(brush_core::columns(&straight)),
                };
                let mut core = BezPath::new();
                brush_core::add(&mut core, &columns, axis, half, brush_position, nib);
                path.extend(core.iter());
                if let Some((.., pieces)) = image.as_mut().filter(|_| !core.elements().is_empty()) {
                    pieces.push(solid(core));
                }
            }
            let width = area.abs() / total;
            (path.elements().len() > 2).then_some(BrushOutline { path, width, image })
        }
    }
}

/// One side of a profile at a position, where each copy has length 1.
fn sample(profile: &[[f64; 2]], place: f64, side: usize, around: bool) -> f64 {
    let n = profile.len();
    if n == 0 {
        return 0.5;
    }
    // A position at the very end belongs to the last copy.
    let within = if place > 0.0 && place == place.floor() && !around { 1.0 } else { place - place.floor() };
    let at = within * n as f64 - 0.5;
    let (low, t) = (at.floor(), at - at.floor());
    let get = |i: f64| {
        let i = if around { i.rem_euclid(n as f64) } else { i.clamp(0.0, n as f64 - 1.0) };
        profile[(i as usize).min(n - 1)][side]
    };
    get(low) + (get(low + 1.0) - get(low)) * t
}

/// Turning direction of a copy of a brush.
#[derive(Clone, Copy)]
enum TurnSide {
    Left,
    Right,
}

/// Map from brush space to the page.
struct BrushMap<'a> {
    axis: &'a StrokeAxis,
    thick: &'a [f64],
    copies: f64,
    total: f64,
    /// Distance between points of the axis.
    step: f64,
}

impl BrushMap<'_> {
    /// The page position of a brush point. Whole numbers of x count copies.
    fn at(&self, p: Point) -> Point {
        let axis = self.axis;
        let beyond = (p.x.clamp(0.0, self.copies) - p.x) / self.copies * self.total;
        let mut arc = axis.arcs[0] + p.x.clamp(0.0, self.copies) / self.copies * self.total;
        arc = arc.clamp(axis.arcs[0], axis.arcs[axis.len() - 1]);
        let next = axis.arcs.partition_point(|a| *a < arc).clamp(1, axis.len() - 1);
        let (a, b) = (axis.arcs[next - 1], axis.arcs[next]);
        let t = if b > a { (arc - a) / (b - a) } else { 0.0 };
        let width = self.thick[next - 1] + (self.thick[next] - self.thick[next - 1]) * t;
        let along = self.along(next - 1).lerp(self.along(next), t);
        let along = unit(along);
        let middle = axis.points[next - 1].lerp(axis.points[next], t);
        middle - along * beyond + Vec2::new(-along.y, along.x) * (p.y * width)
    }

    /// Direction at a point over about one pen width, across corners as well.
    fn along(&self, i: usize) -> Vec2 {
        let reach = (self.thick[i] / 2.0 * DIRECTION_REACH_HALF_WIDTHS / self.step).ceil().max(2.0) as isize;
        let k = i as isize;
        unit(self.axis.point(k + reach) - self.axis.point(k - reach))
    }

    /// Turning direction from a copy to its successor; `None` for turns of at most `degrees`.
    fn turn(&self, degrees: f64, copy: usize) -> Option<TurnSide> {
        let copies = self.copies as usize;
        let chord = |copy: usize| {
            let end = |k: usize| self.at(Point::new(k as f64, 0.0));
            end(copy + 1) - end(copy)
        };
        let next = match (copy + 1 < copies, self.axis.closed) {
            (true, _) => copy + 1,
            (false, true) => 0,
            (false, false) => return None,
        };
        let (own, next) = (unit(chord(copy)), unit(chord(next)));
        if own.dot(next) >= cos(degrees.to_radians()) {
            return None;
        }
        // The page's y points down, so a positive turn is to the right.
        Some(if own.cross(next) > 0.0 { TurnSide::Right } else { TurnSide::Left })
    }

    /// Adds a copy of the brush to a path.
    fn add(&self, shape: &BezPath, copy: usize, px: f64, path: &mut BezPath) {
        let mapped = |p: Point| self.at(Point::new(p.x + copy as f64, p.y));
        let long = self.total / self.copies;
        let mut run: Vec<Point> = Vec::new();
        let mut last: Option<Vec2> = None;
        let mut start = Point::ZERO;
        let tolerance = EDGE_TOLERANCE_PX * px;
        let flush = |run: &mut Vec<Point>, path: &mut BezPath| {
            if run.len() > 1 {
                add_stretch(run, tolerance, path);
            }
            run.clear();
        };
        let mut current = Point::ZERO;
        for element in shape.elements() {
            let cubic = match *element {
                PathEl::MoveTo(p) => {
                    flush(&mut run, path);
                    (current, start, last) = (p, p, None);
                    path.move_to(mapped(p));
                    continue;
                }
                PathEl::LineTo(p) => line(current, p),
                PathEl::QuadTo(q, p) => kurbo::QuadBez::new(current, q, p).raise(),
                PathEl::CurveTo(q, r, p) => kurbo::CubicBez::new(current, q, r, p),
                PathEl::ClosePath => line(current, start),
            };
            let end_tangents = [cubic.p1 - cubic.p0, cubic.p3 - cubic.p2];
            let tangents = end_tangents.map(|way| if way.hypot2() > 0.0 { way } else { cubic.p3 - cubic.p0 });
            if last.is_some_and(|last| unit(last).dot(unit(tangents[0])) < CORNER_COSINE) {
                flush(&mut run, path);
            }
            if run.is_empty() {
                run.push(mapped(cubic.p0));
            }
            let extent = [cubic.p1 - cubic.p0, cubic.p2 - cubic.p1, cubic.p3 - cubic.p2];
            let size: f64 = extent.iter().map(|v| (v.x.abs() * long) + v.y.abs() * self.thick[0]).sum();
            let count = (size / (EDGE_STEP_PX * px)).ceil().clamp(4.0, 4096.0) as usize;
            for k in 1..=count {
                let p = mapped(kurbo::ParamCurve::eval(&cubic, k as f64 / count as f64));
                if run.last().is_none_or(|q| length(p - *q) > tolerances::MIN_OUTLINE_STEP_PX * px) {
                    run.push(p);
                }
            }
            last = Some(tangents[1]);
            current = cubic.p3;
            if matches!(element, PathEl::ClosePath) {
                flush(&mut run, path);
                path.close_path();
                last = None;
            }
        }
        flush(&mut run, path);
        if !matches!(path.elements().last(), Some(PathEl::ClosePath) | None) {
            path.close_path();
        }
    }
}

fn line(a: Point, b: Point) -> kurbo::CubicBez {
    kurbo::CubicBez::new(a, a.lerp(b, 1.0 / 3.0), a.lerp(b, 2.0 / 3.0), b)
}
