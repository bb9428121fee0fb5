//! The frame of a sheet with zones, centring marks and trimming marks.
//!
//! Source: ISO 5457:1999, Technical product documentation, Sizes and layout of drawing sheets, 4.

use kurbo::{Point, Rect, Shape};

use crate::error::Error;
use crate::page::page_size::PageSize;
use crate::page::sheet::canvas::sheet_canvas::{SheetCanvas, WordAnchor};

/// Distance from the edge of the trimmed sheet to the frame: the filing margin on the left, and the others,
/// mm.
const FILING_MARGIN_MM: f64 = 20.0;
const MARGIN_MM: f64 = 10.0;

/// Line width of the frame and the centring marks, and of the zone borders, mm.
const FRAME_LINE_WIDTH_MM: f64 = 0.7;
const ZONE_LINE_WIDTH_MM: f64 = 0.35;

/// Width of the zone band around the frame, length of a zone, and height of its letters, mm.
const ZONE_BAND_MM: f64 = 5.0;
const ZONE_LENGTH_MM: f64 = 50.0;
const ZONE_LETTER_HEIGHT_MM: f64 = 3.5;

/// A shorter rest at the end of a row of zones is merged into the last zone, mm.
const MIN_ZONE_LENGTH_MM: f64 = 20.0;

/// Length of centring marks inside the frame, mm.
const CENTRING_MARK_LENGTH_MM: f64 = 10.0;

/// Sides of the two rectangles of a trimming mark, mm.
const TRIMMING_MARK_SIDES_MM: [f64; 2] = [10.0, 5.0];

/// The drawing space of a sheet, mm.
#[must_use]
pub(crate) fn drawing_space(size: PageSize) -> Rect {
    Rect::new(FILING_MARGIN_MM, MARGIN_MM, size.width - MARGIN_MM, size.height - MARGIN_MM)
}

/// Zone borders along a side of the frame from `low` to `high`, both ends included.
///
/// Zones are 50 mm long, counted from the middle of the sheet. The end zones take up the rest.
#[must_use]
pub(crate) fn zone_ends(low: f64, high: f64, middle: f64) -> Vec<f64> {
    let count = |length: f64| {
        let whole = (length / ZONE_LENGTH_MM).floor();
        if length - whole * ZONE_LENGTH_MM >= MIN_ZONE_LENGTH_MM || whole == 0.0 {
            whole
        } else {
            whole - 1.0
        }
    };
    let (before, after) = (count(middle - low) as i64, count(high - middle) as i64);
    let inner = (-before..=after).map(|k| middle + k as f64 * ZONE_LENGTH_MM);
    [low].into_iter().chain(inner).chain([high]).collect()
}

/// The drawing space of a sheet, the middle of the sheet, and the outside of the zones.
fn frame_middle_outer(size: PageSize) -> (Rect, Point, Rect) {
    let (frame, middle) = (drawing_space(size), Point::new(size.width / 2.0, size.height / 2.0));
    (frame, middle, frame.inflate(ZONE_BAND_MM, ZONE_BAND_MM))
}

/// The centring marks of a sheet. They reach into the drawing space, except where a table is.
pub(crate) fn centring_marks(size: PageSize, tables: &[Rect]) -> [[Point; 2]; 4] {
    let (frame, middle, outer) = frame_middle_outer(size);
    [
        [Point::new(outer.x0, middle.y), Point::new(frame.x0 + CENTRING_MARK_LENGTH_MM, middle.y)],
        [Point::new(outer.x1, middle.y), Point::new(frame.x1 - CENTRING_MARK_LENGTH_MM, middle.y)],
        [Point::new(middle.x, outer.y0), Point::new(middle.x, frame.y0 + CENTRING_MARK_LENGTH_MM)],
        [Point::new(middle.x, outer.y1), Point::new(middle.x, frame.y1 - CENTRING_MARK_LENGTH_MM)],
    ]
    .map(|[from, to]| {
        let mark = Rect::from_points(from, to).inflate(FRAME_LINE_WIDTH_MM, FRAME_LINE_WIDTH_MM);
        let is_in_table = tables.iter().any(|table| table.overlaps(mark));
        let inward = (to - from).normalize();
        [from, if is_in_table { from + inward * ZONE_BAND_MM } else { to }]
    })
}

/// Draws the frame, the zones and the marks.
pub(crate) fn draw_frame(size: PageSize, marks: &[[Point; 2]], ink: &mut SheetCanvas) -> Result<(), Error> {
    let (frame, middle, outer) = frame_middle_outer(size);
    ink.rect(frame, FRAME_LINE_WIDTH_MM);
    ink.rect(outer, ZONE_LINE_WIDTH_MM);
    // A4 has zone letters and numbers only at the top and on the right.
    let small = size.width.max(size.height) <= 297.0;
    let columns = zone_ends(frame.x0, frame.x1, middle.x);
    for (k, pair) in columns.windows(2).enumerate() {
        let number = (k + 1).to_string();
        for (from, to, named) in [(outer.y0, frame.y0, true), (frame.y1, outer.y1, !small)] {
            if k > 0 {
                ink.line(Point::new(pair[0], from), Point::new(pair[0], to), ZONE_LINE_WIDTH_MM);
            }
            let at = Point::new((pair[0] + pair[1]) / 2.0, (from + to + ZONE_LETTER_HEIGHT_MM) / 2.0);
            if named {
                ink.word(&number, at, ZONE_LETTER_HEIGHT_MM, WordAnchor::Middle, ZONE_LENGTH_MM)?;
            }
        }
    }
    // I and O are not used, as the standard requires.
    let letters: Vec<char> = ('A'..='Z').filter(|c| !matches!(c, 'I' | 'O')).collect();
    for (k, pair) in zone_ends(frame.y0, frame.y1, middle.y).windows(2).enumerate() {
        let letter = letters[k % letters.len()].to_string();
        for (from, to, named) in [(outer.x0, frame.x0, !small), (frame.x1, outer.x1, true)] {
            if k > 0 {
                ink.line(Point::new(from, pair[0]), Point::new(to, pair[0]), ZONE_LINE_WIDTH_MM);
            }
            let at = Point::new((from + to) / 2.0, (pair[0] + pair[1] + ZONE_LETTER_HEIGHT_MM) / 2.0);
            if named {
                ink.word(&letter, at, ZONE_LETTER_HEIGHT_MM, WordAnchor::Middle, ZONE_BAND_MM)?;
            }
        }
    }
    for [from, to] in marks {
        ink.line(*from, *to, FRAME_LINE_WIDTH_MM);
    }
    for x in [0.0, 1.0] {
        for y in [0.0, 1.0] {
            for [w, h] in [TRIMMING_MARK_SIDES_MM, [TRIMMING_MARK_SIDES_MM[1], TRIMMING_MARK_SIDES_MM[0]]] {
                let corner = Point::new(x * (size.width - w), y * (size.height - h));
                ink.fill(Rect::from_origin_size(corner, (w, h)).to_path(0.1));
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zone_counts_match_iso_5457() {
        // ISO 5457:1999, table 2: along the longer side, along the shorter side.
        for (name, long, short) in [("A0", 24, 16), ("A1", 16, 12), ("A2", 12, 8), ("A3", 8, 6), ("A4", 6, 4)]
        {
            let size = PageSize::parse(name).unwrap();
            let size = if name == "A4" { size } else { size.landscape() };
            let frame = drawing_space(size);
            let across = zone_ends(frame.x0, frame.x1, size.width / 2.0).len() - 1;
            let down = zone_ends(frame.y0, frame.y1, size.height / 2.0).len() - 1;
            assert_eq!([across.max(down), across.min(down)], [long, short], "{name}");
        }
        assert_eq!(
            zone_ends(20.0, 410.0, 210.0),
            [20.0, 60.0, 110.0, 160.0, 210.0, 260.0, 310.0, 360.0, 410.0]
        );
    }
}
