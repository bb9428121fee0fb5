//! Sound effects: large outlined letters, rotated, stretched and bent along an arc.

use kurbo::{Affine, BezPath, PathEl, Point, Rect, Shape};

use crate::colour::srgb::Colour;
use crate::drawing::{Cap, Join, Mark, Paint, Provenance, StrokePaint};
use crate::error::Error;
use crate::geometry::numbers::portable_math::{cos, sin};
use crate::page::comic::comic_keys::SoundKeys;
use crate::page::layout::ConvexPolygon;
use crate::page::tolerances::MIN_LETTERING_ARC_RAD;
use crate::text::{Setting, TextBlock};

/// The outlines of the letters in position, and messages about missing glyphs.
///
/// # Errors
/// Returns an error if the text is empty, or no font has a glyph.
pub(crate) fn sound_outlines(
    text: &str,
    setting: &Setting,
    keys: &SoundKeys,
    stretch: f64,
    panel: Rect,
) -> Result<(Vec<BezPath>, Vec<String>), Error> {
    if text.trim().is_empty() {
        return Err(Error::new("this sound has no letters").remedy("write its text, or leave it out"));
    }
    let block = TextBlock::unbroken(text, setting)?;
    let corner = Point::new(-block.width / 2.0, -block.height / 2.0);
    let arc = keys.arc.get_ref().to_radians();
    let [x, y] = *keys.at.get_ref();
    let middle = Point::new(panel.x0 + x * panel.width(), panel.y0 + y * panel.height());
    let place = Affine::translate(middle.to_vec2()) * Affine::rotate(keys.rotate.get_ref().to_radians());
    let radius = block.width * stretch / arc;
    let bent = |p: Point| {
        let p = Point::new(p.x * stretch, p.y);
        if arc.abs() < MIN_LETTERING_ARC_RAD {
            return p;
        }
        let angle = p.x / radius;
        // The centre of the arc is below the text if the arc is positive.
        Point::new((radius - p.y) * sin(angle), radius - (radius - p.y) * cos(angle))
    };
    let letters = block.marks(corner, Colour::BLACK).into_iter().map(|mark| {
        let path: BezPath = mark.path.elements().iter().map(|element| map_element(*element, bent)).collect();
        place * path
    });
    Ok((letters.collect(), block.fallbacks.iter().map(ToString::to_string).collect()))
}

fn map_element(element: PathEl, to: impl Fn(Point) -> Point) -> PathEl {
    match element {
        PathEl::MoveTo(p) => PathEl::MoveTo(to(p)),
        PathEl::LineTo(p) => PathEl::LineTo(to(p)),
        PathEl::QuadTo(a, p) => PathEl::QuadTo(to(a), to(p)),
        PathEl::CurveTo(a, b, p) => PathEl::CurveTo(to(a), to(b), to(p)),
        PathEl::ClosePath => PathEl::ClosePath,
    }
}

/// The painted letters with their outline below, and a box around everything.
pub(crate) fn paint_letters(
    letters: Vec<BezPath>,
    [fill, colour]: [Colour; 2],
    line: f64,
) -> (Vec<Mark>, ConvexPolygon) {
    let boxes = letters.iter().map(Shape::bounding_box);
    let all = boxes.reduce(|a, b| a.union(b)).unwrap_or_default().inset(line);
    let provenance = || Provenance { classes: vec!["sound"], ..Provenance::default() };
    // The letters cover the inner half of the outline.
    let stroke = || Paint::Stroke(StrokePaint::solid(line * 2.0, colour, Cap::Round, Join::Round));
    let below = letters.iter().map(|path| (path.clone(), stroke()));
    let above = letters.iter().map(|path| (path.clone(), Paint::Fill(fill)));
    let marks = below.chain(above).map(|(path, paint)| Mark { path, paint, provenance: provenance() });
    (marks.collect(), ConvexPolygon::from(all))
}
