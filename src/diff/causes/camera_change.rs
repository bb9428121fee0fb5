//! Detects a change of camera before marks are compared one by one.
//!
//! 1. Few marks have an equal in the other drawing.
//! 2. One affine map is fitted to the middles of the parts. A drawing that was moved, scaled or rotated on
//!    the page follows this map, and is rejected.
//! 3. A part keeps its form if its longest line was only shifted, for example because the part moved in the
//!    model. The other parts turned relative to the camera.
//! 4. These parts are off the map in more directions than an edit of the model explains.

use std::collections::BTreeMap;

use kurbo::{BezPath, Point, Rect, Shape as _, Vec2};

use super::cause_sentences::MAX_DIRECTIONS;
use crate::diff::curves::segment::points;
use crate::diff::findings::finding::{Cause, Finding, Verdict};
use crate::diff::matching::equal_shapes::ShapeMatching;
use crate::diff::shapes::label::Label;
use crate::diff::shapes::picture::{Picture, Shape, ShapeKind};
use crate::diff::tolerances;

/// Least number of marks without an equal. Smaller drawings are compared mark by mark in about half a second.
const MIN_UNMATCHED_MARKS: usize = 1000;
/// At most one mark in this number may have an equal. Lines on the axis of rotation keep theirs.
const MIN_MARKS_PER_EQUAL: usize = 20;
/// Largest difference between two shifts of equal direction, as a share of the shift.
const DIRECTION_TOLERANCE_SHARE: f64 = 0.02;
/// The same in px; both are added.
const DIRECTION_TOLERANCE_PX: f64 = 0.05;

/// The lines of one part in one picture that have no equal.
#[derive(Default)]
struct PartLines<'a> {
    /// Sum of the points of all paths, and their number.
    sum: Vec2,
    count: usize,
    longest: Option<(&'a BezPath, f64)>,
}

impl PartLines<'_> {
    /// Mean of all points. Unlike the centre of a bounding box, it follows an affine map exactly.
    fn middle(&self) -> Point {
        (self.sum / self.count.max(1) as f64).to_point()
    }
}

/// The cause and one finding for all marks if the camera changed. Returns `None` for small drawings and for
/// all other changes.
pub(crate) fn find(pictures: [&Picture; 2], parted: &ShapeMatching, reach: f64) -> Option<(Finding, Cause)> {
    let marks = parted.unequal_shapes[0].len().max(parted.unequal_shapes[1].len());
    if marks < MIN_UNMATCHED_MARKS || parted.equal.len() * MIN_MARKS_PER_EQUAL > marks {
        return None;
    }
    let [before, after] =
        [0, 1].map(|side: usize| lines_of_parts(pictures[side], &parted.unequal_shapes[side]));
    let both = before.iter().filter_map(|(part, old)| Some((old, after.get(part)?)));
    let both: Vec<(&PartLines, &PartLines)> = both.collect();
    let middles: Vec<[Point; 2]> = both.iter().map(|(old, new)| [old.middle(), new.middle()]).collect();
    let map = affine(&middles)?;
    let mut ways: Vec<Vec2> = Vec::new();
    for ((old, new), [from, to]) in both.iter().zip(&middles) {
        let way = *to - map(*from);
        let keeps_form = old.longest.zip(new.longest).is_some_and(|(a, b)| is_shifted([a.0, b.0], reach));
        let near = |other: &Vec2| {
            (*other - way).hypot() <= DIRECTION_TOLERANCE_PX + DIRECTION_TOLERANCE_SHARE * way.hypot()
        };
        if !keeps_form && way.hypot() > reach && !ways.iter().any(near) {
            ways.push(way);
        }
    }
    if ways.len() <= MAX_DIRECTIONS {
        return None;
    }
    let place = Rect::new(0.0, 0.0, pictures[0].width, pictures[0].height);
    let finding = Finding::in_place(Verdict::Moved, Label::default(), Vec::new(), place);
    let finding = Finding { kind: ShapeKind::Line, ..finding };
    let sentence = format!("the drawing is seen from another side: {marks} marks of {} parts", both.len());
    Some((finding, Cause { verdict: Verdict::Moved, sentence, findings: vec![0] }))
}

/// Collects the unequal lines of each part.
fn lines_of_parts<'a>(picture: &'a Picture, rest: &[usize]) -> BTreeMap<&'a str, PartLines<'a>> {
    let mut parts: BTreeMap<&str, PartLines> = BTreeMap::new();
    let lines = rest.iter().filter_map(|index| picture.shapes.get(*index));
    for shape in lines.filter(|shape| shape.kind == ShapeKind::Line) {
        let Shape { path, label, .. } = shape;
        let Some(part) = label.part.as_deref() else { continue };
        let own = parts.entry(part).or_default();
        let place = path.bounding_box();
        let points = points(path);
        own.sum += points.iter().map(|p| p.to_vec2()).fold(Vec2::ZERO, |sum, p| sum + p);
        own.count += points.len();
        let length = place.width() + place.height();
        if own.longest.is_none_or(|(_, known)| length > known) {
            own.longest = Some((path, length));
        }
    }
    parts
}

/// Whether a line is a shifted copy of another line, point by point.
fn is_shifted([old, new]: [&BezPath; 2], reach: f64) -> bool {
    let (old, new) = (points(old), points(new));
    let (Some(from), Some(to)) = (old.first(), new.first()) else { return false };
    let shift = *to - *from;
    old.len() == new.len() && old.iter().zip(&new).all(|(p, q)| (*p + shift).distance(*q) <= 2.0 * reach)
}

/// Affine map from points to points by least squares; `None` if the points are collinear.
fn affine(pairs: &[[Point; 2]]) -> Option<impl Fn(Point) -> Point + use<>> {
    let count = pairs.len() as f64;
    let mean = |side: usize| pairs.iter().fold(Vec2::ZERO, |sum, pair| sum + pair[side].to_vec2()) / count;
    let (from, to) = (mean(0), mean(1));
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    let (mut by_x, mut by_y) = (Vec2::ZERO, Vec2::ZERO);
    for [p, q] in pairs {
        let (p, q) = (p.to_vec2() - from, q.to_vec2() - to);
        (xx, xy, yy) = (xx + p.x * p.x, xy + p.x * p.y, yy + p.y * p.y);
        (by_x, by_y) = (by_x + q * p.x, by_y + q * p.y);
    }
    let determinant = xx * yy - xy * xy;
    if determinant.is_nan() || determinant <= tolerances::MIN_SPREAD_DETERMINANT_SHARE * xx * yy {
        return None;
    }
    let along_x = (by_x * yy - by_y * xy) / determinant;
    let along_y = (by_y * xx - by_x * xy) / determinant;
    Some(move |p: Point| {
        let p = p.to_vec2() - from;
        (to + along_x * p.x + along_y * p.y).to_point()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diff::{DiffOptions, compare};
    use crate::geometry::numbers::portable_math::{cos, sin};

    /// Boxes of lines in space, in a parallel view rotated by `degrees`. Each box moves along x by `apart`
    /// times its position.
    fn picture_of_boxes(degrees: f64, apart: f64, scale: f64) -> Picture {
        let (sin, cos) = (sin(degrees.to_radians()), cos(degrees.to_radians()));
        let mut paths = String::new();
        for part in 0..300 {
            let of = |step: usize, count: usize| (part / step % count) as f64;
            let middle = [of(1, 10) * 80.0 * (1.0 + apart), of(10, 10) * 80.0, of(100, 3) * 120.0];
            for line in 0..4 {
                let corner = |k: usize| {
                    let along =
                        [(k & 1) as f64 * 30.0, (k >> 1 & 1) as f64 * 20.0, (k >> 2 & 1) as f64 * 25.0];
                    let [x, y, z] = [0, 1, 2].map(|axis: usize| middle[axis] + along[axis]);
                    let (x, y) = (x * cos + z * sin, y * 0.9 + (z * cos - x * sin) * 0.4);
                    format!("{:.2} {:.2}", 100.0 + x * scale, 400.0 + y * scale)
                };
                let (a, b) = (corner(line), corner(7 - line));
                paths += &format!(r#"<path class="crease" data-part="box-{part}" d="M{a}L{b}"/>"#);
            }
        }
        let head = r#"<svg xmlns="http://www.w3.org/2000/svg" width="2400" height="2400">"#;
        Picture::from_svg(&format!(r##"{head}<g fill="none" stroke="#000">{paths}</g></svg>"##)).unwrap()
    }

    fn brief_cause(after: &Picture) -> Option<String> {
        let brief = compare(&picture_of_boxes(20.0, 0.0, 1.0), after, &DiffOptions::default().in_brief());
        assert!(!brief.is_same());
        brief.is_brief.then(|| brief.causes[0].sentence.clone())
    }

    #[test]
    fn rotated_camera_is_reported_in_one_sentence() {
        let said = brief_cause(&picture_of_boxes(21.0, 0.0, 1.0));
        assert_eq!(said.as_deref(), Some("the drawing is seen from another side: 1200 marks of 300 parts"));
    }

    #[test]
    fn moved_parts_and_page_transforms_are_not_camera_changes() {
        assert_eq!(brief_cause(&picture_of_boxes(20.0, 0.1, 1.0)), None);
        assert_eq!(brief_cause(&picture_of_boxes(20.0, 0.0, 1.1)), None);
        let old = picture_of_boxes(20.0, 0.0, 1.0);
        let turned = old.svg.replacen("<g ", r#"<g transform="rotate(2 500 400)" "#, 1);
        assert_eq!(brief_cause(&Picture::from_svg(&turned).unwrap()), None);
    }
}
