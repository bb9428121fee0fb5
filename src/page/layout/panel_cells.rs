//! [`cells`]: the panels of a layout on a page.
//!
//! A panel is the intersection of half planes, one for each gutter around it. A slanted gutter turns about
//! its centre, so adjacent panels keep their areas as long as the gutter ends on the same two sides.

use std::ops::Range;

use kurbo::{Point, Rect, Vec2};

use super::grammar::{LayoutFault, PanelShare, Stack, StackAxis, parse};
use super::polygon::{ConvexPolygon, HalfPlane};
use crate::geometry::numbers::portable_math::{cos, sin};

/// Minimum side of a panel, mm.
const MIN_PANEL_SIDE_MM: f64 = 2.0;

/// Reading direction of a page.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Reading {
    /// From left to right.
    #[default]
    Ltr,
    /// From right to left.
    Rtl,
}

/// The area that a layout divides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LayoutGrid {
    /// The rectangle to divide.
    pub frame: Rect,
    /// Gap between columns, and between rows.
    pub gutter: [f64; 2],
    /// Order of columns.
    pub reading: Reading,
}

/// A panel of a layout.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PanelCell {
    /// Its rectangle if no gutter is slanted.
    pub nominal: Rect,
    /// The half planes of the gutters around it.
    pub sides: Vec<HalfPlane>,
    /// Its position in the layout text, bytes.
    pub span: Range<usize>,
}

impl PanelCell {
    /// The outline within a frame: the divided area, or a larger one for panels with bleed.
    #[must_use]
    pub(crate) fn outline(&self, frame: Rect) -> ConvexPolygon {
        self.sides.iter().fold(ConvexPolygon::from(frame), |rest, side| rest.cut(side))
    }
}

/// The panels of a layout in reading order.
///
/// # Errors
/// Returns an error at the position of a syntax error or of a panel that is too small.
pub(crate) fn cells(layout: &str, grid: &LayoutGrid) -> Result<Vec<PanelCell>, LayoutFault> {
    let stack = parse(layout)?;
    let mut cells = Vec::new();
    split_stack(&stack, grid.frame, &[], grid, &mut cells)?;
    if grid.reading == Reading::Rtl {
        let x = grid.frame.center().x;
        for cell in &mut cells {
            let Rect { x0, y0, x1, y1 } = cell.nominal;
            cell.nominal = Rect::new(2.0 * x - x1, y0, 2.0 * x - x0, y1);
            cell.sides.iter_mut().for_each(|side| *side = side.mirrored(x));
        }
    }
    for cell in &cells {
        let PanelCell { nominal, span, .. } = cell;
        let bounds = cell.outline(grid.frame).bounds();
        let shortest = bounds.width().min(bounds.height()).min(nominal.width()).min(nominal.height());
        if shortest.is_nan() || shortest < MIN_PANEL_SIDE_MM {
            return Err(LayoutFault {
                span: span.clone(),
                message: format!(
                    "this panel has no size: {:.1} x {:.1} mm",
                    nominal.width().max(0.0),
                    nominal.height().max(0.0)
                ),
                advice: "give it a larger share, or make gutters narrower or less slanted".to_owned(),
            });
        }
    }
    Ok(cells)
}

fn split_stack(
    stack: &Stack,
    rect: Rect,
    sides: &[HalfPlane],
    grid: &LayoutGrid,
    cells: &mut Vec<PanelCell>,
) -> Result<(), LayoutFault> {
    let rows = stack.axis == StackAxis::Rows;
    let (gutter, from, to) =
        if rows { (grid.gutter[1], rect.y0, rect.y1) } else { (grid.gutter[0], rect.x0, rect.x1) };
    let length = to - from - gutter * (stack.items.len() - 1) as f64;
    let shares = item_shares(stack)?;
    let within = sides.iter().fold(ConvexPolygon::from(grid.frame), |rest, side| rest.cut(side));
    let mut begin = from;
    let last = stack.items.len() - 1;
    // The half plane of the gutter before the current item.
    let mut before: Option<HalfPlane> = None;
    for (number, (item, share)) in stack.items.iter().zip(shares).enumerate() {
        let end = if number == last { to } else { begin + share * length };
        let own = match rows {
            true => Rect { y0: begin, y1: end, ..rect },
            false => Rect { x0: begin, x1: end, ..rect },
        };
        let slant = stack.slants.get(number).copied().unwrap_or(0.0).to_radians();
        let (sine, cosine) = (sin(slant), cos(slant));
        let middle = end + gutter / 2.0;
        let (centre, across) = match rows {
            true => (Point::new(rect.center().x, middle), Vec2::new(sine, cosine)),
            false => (Point::new(middle, rect.center().y), Vec2::new(cosine, sine)),
        };
        let side =
            |way: f64| HalfPlane { point: centre + across * (way * gutter / 2.0), normal: across * way };
        if number < last && before.as_ref().is_some_and(|before| gutters_meet(before, &side(-1.0), &within)) {
            return Err(LayoutFault {
                span: item.span.clone(),
                message: "the gutters around this panel meet on the page".to_owned(),
                advice: "reduce their slant, or make it more similar".to_owned(),
            });
        }
        let mut own_sides = sides.to_vec();
        own_sides.extend(before.take());
        if number < last {
            own_sides.push(side(-1.0));
            before = Some(side(1.0));
        }
        match &item.within {
            Some(within) => split_stack(within, own, &own_sides, grid, cells)?,
            None => cells.push(PanelCell { nominal: own, sides: own_sides, span: item.span.clone() }),
        }
        begin = end + gutter;
    }
    Ok(())
}

/// Whether two boundary lines intersect within a polygon.
fn gutters_meet(a: &HalfPlane, b: &HalfPlane, within: &ConvexPolygon) -> bool {
    let area = a.normal.cross(b.normal);
    if area == 0.0 {
        return false;
    }
    // The point with both depths 0, by Cramer's rule.
    let [u, v] = [a, b].map(|side| side.point.to_vec2().dot(side.normal));
    let x = (u * b.normal.y - v * a.normal.y) / area;
    let y = (v * a.normal.x - u * b.normal.x) / area;
    within.holds(Point::new(x, y))
}

/// The shares of the items of a stack; their sum is 1.
fn item_shares(stack: &Stack) -> Result<Vec<f64>, LayoutFault> {
    let numbers = stack.items.iter().filter_map(|item| match item.share {
        PanelShare::Number(number) => Some(number),
        PanelShare::Rest => None,
    });
    let told: f64 = numbers.sum();
    let resting = stack.items.iter().filter(|item| item.share == PanelShare::Rest).count();
    let all_rest = resting == stack.items.len();
    let whole = if resting == 0 { told } else { 100.0 };
    if resting > 0 && !all_rest && told >= 100.0 {
        let first = stack.items.iter().find(|item| item.share == PanelShare::Rest);
        return Err(LayoutFault {
            span: first.map_or(0..0, |item| item.span.clone()),
            message: format!("no room is left for the rest: the other shares add up to {told} %"),
            advice: "with *, shares are percent and must add up to less than 100".to_owned(),
        });
    }
    let rest = (whole - told) / resting.max(1) as f64;
    let share = |share: PanelShare| match share {
        PanelShare::Number(number) => number / whole,
        PanelShare::Rest => rest / whole,
    };
    Ok(stack.items.iter().map(|item| share(item.share)).collect())
}
