//! The border line of a panel, straight or wavy as if hand-drawn.
//!
//! A wavy side is a Catmull-Rom spline through points that smooth noise moves sideways. The seed comes from
//! the side, so the same page gives the same border. Sides along the edge of the printed area are left out.

use kurbo::{Affine, BezPath, Point, Rect, Vec2};

use crate::colour::srgb::Colour;
use crate::drawing::{
    Cap, Drawing, Join, Layer, LayerKind, Mark, Page, Paint, PlacedDrawing, Provenance, StrokePaint, Unit,
};
use crate::geometry::numbers::noise::{hash, value_noise};
use crate::page::layout::ConvexPolygon;
use crate::page::tolerances::POSITION_ROUNDING_MM;

/// Distance between two bends of a hand-drawn line, mm.
const BEND_SPACING_MM: f64 = 18.0;

/// Curve points between two bends.
const POINTS_PER_BEND: f64 = 4.0;

/// The border of a panel as a drawing of the whole page. `hand` is the maximum deviation of a hand-drawn
/// line, mm.
pub(crate) fn panel_border(
    name: &str,
    outline: &ConvexPolygon,
    [width, hand]: [f64; 2],
    colour: Colour,
    sheet: Rect,
) -> PlacedDrawing {
    let path = border_path(outline, hand, sheet);
    let paint = Paint::Stroke(StrokePaint::solid(width, colour, Cap::Round, Join::Miter));
    let provenance = Provenance { classes: vec!["panel-border"], ..Provenance::default() };
    let marks = vec![Mark { path, paint, provenance }];
    let layers = vec![Layer { kind: LayerKind::Lines, pen: None, ordered: false, marks }];
    let page = Page { width: sheet.width(), height: sheet.height(), unit: Unit::Mm, background: None };
    let drawing = Drawing::new(name, page, layers);
    PlacedDrawing { name: name.to_owned(), drawing, place: Affine::IDENTITY, clip: None }
}

/// The sides of an outline, except those along the edge of the printed area. With `hand` above 0 the sides
/// are wavy between fixed corners.
fn border_path(outline: &ConvexPolygon, hand: f64, sheet: Rect) -> BezPath {
    let sides: Vec<(Point, Point)> = outline.sides().collect();
    let is_edge = |(a, b): &(Point, Point)| {
        let is_at = |a: f64, edge: f64| (a - edge).abs() < POSITION_ROUNDING_MM;
        let along = |a: f64, b: f64, edge: f64| is_at(a, edge) && is_at(b, edge);
        along(a.x, b.x, sheet.x0)
            || along(a.x, b.x, sheet.x1)
            || along(a.y, b.y, sheet.y0)
            || along(a.y, b.y, sheet.y1)
    };
    // An open border starts after a side that is left out.
    let first = sides.iter().position(is_edge).map_or(0, |edge| edge + 1);
    let mut path = BezPath::new();
    let mut goes_on = false;
    for number in (0..sides.len()).map(|k| (k + first) % sides.len()) {
        let side = sides[number];
        if is_edge(&side) {
            goes_on = false;
            continue;
        }
        if !goes_on {
            path.move_to(side.0);
        }
        goes_on = true;
        if hand > 0.0 { add_wavy_side(&mut path, side, number, hand) } else { path.line_to(side.1) }
    }
    if !sides.iter().any(is_edge) {
        path.close_path();
    }
    path
}

/// Adds a side that deviates by at most `hand`.
fn add_wavy_side(path: &mut BezPath, (a, b): (Point, Point), number: usize, hand: f64) {
    let length = a.distance(b);
    let across = Vec2::new(b.y - a.y, a.x - b.x) / length.max(f64::MIN_POSITIVE);
    let seed = hash(number as u64, &[a.x.to_bits(), a.y.to_bits()]);
    let steps = (length / BEND_SPACING_MM * POINTS_PER_BEND).ceil().max(1.0);
    let at = |step: f64| -> Point {
        let share = step / steps;
        // The amplitude is 0 at both ends and full at a distance of one bend.
        let pinned = (share.min(1.0 - share) * length / BEND_SPACING_MM).min(1.0);
        a.lerp(b, share) + across * (hand * pinned * value_noise(seed, share * length / BEND_SPACING_MM))
    };
    // Catmull-Rom spline through the points.
    for step in 0..steps as usize {
        let step = step as f64;
        let [p, q, r, s] = [step - 1.0, step, step + 1.0, step + 2.0].map(|k| at(k.clamp(0.0, steps)));
        path.curve_to(q + (r - p) / 6.0, r - (s - q) / 6.0, r);
    }
}
