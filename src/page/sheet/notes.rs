//! What is written beside the views: titles, cutting planes, circles of details, dimensions, balloons, the parts list.

use kurbo::{Circle, Point, Rect, Vec2};

use super::arrange::Stands;
use super::balloons::{RADIUS, leaders, slots};
use super::ink::{CHAIN, Ink, NARROW, Stand, WIDE, way};
use super::list::Item;
use super::plan::{Circled, CutLine, Plan};
use super::scales;
use super::sight::Sight;
use crate::error::Error;

/// Height of letters that name views, and of others, mm.
const TITLES: f64 = 5.0;
const LETTERS: f64 = 3.5;
const SMALL: f64 = 2.5;

/// Titles above views: what they show, and their scale where it is another one.
pub(super) fn titles(plan: &Plan, scale: f64, ink: &mut Ink) -> Result<(), Error> {
    for (k, placed) in plan.views.iter().enumerate() {
        let own = placed.sight.unit / plan.unit_mm();
        let other =
            !matches!(placed.stands, Stands::Free | Stands::Pictorial) && (own / scale - 1.0).abs() > 1e-9;
        let scale = other.then(|| scales::written(own));
        let words = match (&placed.sight.title, scale) {
            (Some(title), Some(scale)) => format!("{title} ({scale})"),
            (Some(title), None) => title.clone(),
            (None, Some(scale)) => format!("({scale})"),
            (None, None) => continue,
        };
        let rect = placed.sight.rect();
        let aside = if plan.balloons == Some(k) { placed.margin } else { 0.0 };
        let at = Point::new(rect.center().x, rect.y0 - aside - 3.0);
        ink.word(&words, at, TITLES, Stand::Middle, 0.0)?;
    }
    Ok(())
}

/// The view in which the line of a cutting plane is drawn: the first one in which it is seen edge-on.
pub(super) fn crossed(plan: &Plan, cut: &CutLine) -> Option<usize> {
    let edge_on = |sight: &Sight| cut.plane.normal().dot(sight.axes()[2]).abs() < 1e-9;
    plan.views.iter().position(|placed| edge_on(&placed.sight) && placed.sight.title.is_none())
}

/// The line of a cutting plane in the first view in which it is seen edge-on, with arrows in the direction of sight (ISO 128-3).
pub(super) fn cutting_plane(plan: &Plan, cut: &CutLine, ink: &mut Ink) -> Result<(), Error> {
    let normal = cut.plane.normal();
    let Some(view) = crossed(plan, cut) else { return Ok(()) };
    let sight = &plan.views[view].sight;
    // Towards the eye of the section, on the page.
    let back = sight.page(plan.middle + normal) - sight.page(plan.middle);
    let back = back / back.hypot2().sqrt();
    let along = Vec2::new(-back.y, back.x);
    let on = sight.page(plan.middle - normal * cut.plane.distance(plan.middle));
    let rect = sight.rect();
    let corners =
        [(rect.x0, rect.y0), (rect.x1, rect.y0), (rect.x1, rect.y1), (rect.x0, rect.y1)].map(Point::from);
    let places = corners.map(|corner| (corner - on).dot(along));
    let least = places.into_iter().fold(f64::INFINITY, f64::min) - 7.0;
    let most = places.into_iter().fold(f64::NEG_INFINITY, f64::max) + 7.0;
    let at = |x: f64| on + along * x;
    ink.path(way(&[at(least), at(most)]), NARROW, &CHAIN);
    for (end, inner) in [(least, least + 5.0), (most, most - 5.0)] {
        ink.line(at(end), at(inner), 2.0 * WIDE);
        let tip = at(end) + along * (inner - end).signum() * 1.0;
        ink.line(tip + back * 9.0, tip + back * 3.0, NARROW);
        ink.arrow(tip, -back, 4.0);
        let letter = tip + back * 12.0 + along * (end - inner).signum() * 1.5;
        ink.word(&cut.label, letter + Vec2::new(0.0, TITLES / 2.0), TITLES, Stand::Middle, 0.0)?;
    }
    Ok(())
}

/// The circle around what is shown larger, and the one that bounds that.
pub(super) fn circled(plan: &Plan, circled: &Circled, ink: &mut Ink) -> Result<(), Error> {
    let of = &plan.views[circled.of].sight;
    let (centre, radius) = (of.page(circled.at), circled.radius * of.unit);
    ink.circle(centre, radius, NARROW);
    let out = Vec2::new(0.8, -0.8) * radius;
    let end = centre + out + Vec2::new(3.0, -3.0);
    ink.line(centre + out / (out.hypot2().sqrt() / radius), end, NARROW);
    ink.word(&circled.label, end + Vec2::new(0.8, 0.0), TITLES, Stand::Left, 0.0)?;
    let shown = &plan.views[circled.shown].sight;
    ink.path(kurbo::Shape::to_path(&circle_of(shown), 1e-3), NARROW, &[]);
    Ok(())
}

/// The circle of a detail.
pub(super) fn circle_of(shown: &Sight) -> Circle {
    Circle::new(shown.rect().center(), shown.rect().width() / 2.0)
}

/// Balloons round a view, with the number of each item that has an anchor.
pub(super) fn balloons(
    rect: Rect,
    items: &[Item],
    anchors: &[Option<Point>],
    ink: &mut Ink,
) -> Result<(), Error> {
    let seen: Vec<(usize, Point)> =
        anchors.iter().enumerate().filter_map(|(k, anchor)| anchor.map(|anchor| (k, anchor))).collect();
    let points: Vec<Point> = seen.iter().map(|(_, anchor)| *anchor).collect();
    let slots = slots(rect.inflate(10.0, 10.0), points.len());
    for ((item, anchor), slot) in seen.iter().zip(leaders(&points, &slots)) {
        let centre = slots[slot];
        let towards = *anchor - centre;
        let far = towards.hypot2().sqrt();
        if far > RADIUS {
            ink.line(centre + towards * (RADIUS / far), *anchor, NARROW);
        }
        ink.fill(kurbo::Shape::to_path(&Circle::new(*anchor, 0.5), 1e-3));
        ink.circle(centre, RADIUS, NARROW);
        let at = centre + Vec2::new(0.0, LETTERS / 2.0);
        ink.word(&items[*item].number, at, LETTERS, Stand::Middle, 2.0 * RADIUS - 1.5)?;
    }
    Ok(())
}

/// Height of a row of the parts list, mm.
const ROW: f64 = 6.0;

/// A parts list of so many items above a place: how many columns, rows and how high.
pub(super) fn list_size(items: usize, most: f64) -> (usize, usize, f64) {
    let of = |columns: usize| {
        let rows = items.div_ceil(columns);
        (columns, rows, (rows + 1) as f64 * ROW)
    };
    [1, 2].map(of).into_iter().find(|(_, _, height)| *height <= most).unwrap_or_else(|| of(3))
}

/// The parts list in a rectangle: read from below, as new items are added above (ISO 7573), or from above where there are several columns.
pub(super) fn list(
    place: Rect,
    items: &[Item],
    (columns, rows): (usize, usize),
    ink: &mut Ink,
) -> Result<(), Error> {
    let width = place.width() / columns as f64;
    let remarked = items.iter().any(|item| !item.remark.is_empty());
    let [material, remark] = match (columns, remarked) {
        (1 | 2, false) => [0.28, 0.0],
        (1 | 2, true) => [0.22, 0.22],
        (_, false) => [0.0, 0.0],
        (_, true) => [0.0, 0.3],
    }
    .map(|share| share * width);
    let ends = [0.0, 9.0, 18.0, width - material - remark, width - remark, width];
    for (k, column) in items.chunks(rows.max(1)).enumerate() {
        let left = place.x0 + k as f64 * width;
        let mut row = |words: [&str; 5], top: f64, high: f64| -> Result<(), Error> {
            for (n, words) in words.into_iter().enumerate() {
                let cell = Rect::new(left + ends[n], top, left + ends[n + 1], top + ROW);
                if cell.width() > 0.0 {
                    ink.rect(cell, NARROW);
                    let at = Point::new(cell.x0 + 1.0, cell.y1 - (ROW - high) / 2.0);
                    ink.word(words, at, high, Stand::Left, cell.width() - 2.0)?;
                }
            }
            Ok(())
        };
        row(["Item", "Qty", "Name", "Material", "Remark"], place.y1 - ROW, 1.8)?;
        for (n, item) in column.iter().enumerate() {
            let count = item.count.to_string();
            row(
                [&item.number, &count, &item.name, &item.material, &item.remark],
                place.y1 - ROW * (n + 2) as f64,
                SMALL,
            )?;
        }
    }
    ink.rect(place, WIDE);
    Ok(())
}
