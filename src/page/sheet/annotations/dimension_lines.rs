//! Dimensions of lengths: dimension lines, extension lines, arrows and values (ISO 129-1).
//!
//! Lengths along a side stand in rows, from the shortest to the longest:
//!
//! 1. A length takes the innermost row where its value has free paper and crosses no extension line of a
//!    longer length.
//! 2. Lengths that overlap it must stand in inner rows.
//! 3. A value that does not fit between the arrows moves along its line, then past one end, then farther out.
//!
//! Other lengths take the nearest offset, and there the nearest position, where the value has free paper.

use kurbo::{Affine, Point, Rect, Vec2};

use super::dimension_style::{ARROW_LENGTH_MM, VALUE_HEIGHT_MM};
use crate::error::Error;
use crate::page::sheet::canvas::annotation_board::{
    AnnotationBoard, LINE_CLEARANCE_MM, SetWord, TEXT_CLEARANCE_MM,
};
use crate::page::sheet::canvas::paper_occupancy::{Clearance, ConvexShape, Occupancy, OccupantKind};
use crate::page::sheet::canvas::sheet_canvas::THIN_LINE_MM;
use crate::page::sheet::dimensions::dimension_set::SlantedLength;
use crate::page::sheet::view::view_side::SideLength;
use crate::page::tolerances::MAX_ZERO_COMPONENT;

/// Distance from the view to the first row, and from row to row, mm.
const FIRST_ROW_OFFSET_MM: f64 = 9.0;
const ROW_SPACING_MM: f64 = 7.5;

/// Minimum gap between two lengths in a row, mm.
const MIN_ROW_GAP_MM: f64 = 2.0;

/// Maximum number of rows.
const MAX_ROWS: u32 = 40;

/// Gap between the shape and its extension line, and overshoot of the extension line past the dimension line,
/// mm.
const EXTENSION_GAP_MM: f64 = 0.8;
const EXTENSION_OVERSHOOT_MM: f64 = 2.0;

/// Gap between a dimension line and its value, mm.
const VALUE_GAP_MM: f64 = 1.0;

/// Step size of a value along its line, mm, and maximum number of steps.
const VALUE_STEP_MM: f64 = 2.0;
const MAX_VALUE_STEPS: u32 = 40;

/// First offset of a slanted length from its points, and step size of the offset, mm.
const FIRST_SLANTED_OFFSET_MM: f64 = 10.0;
const SLANTED_STEP_MM: f64 = 4.0;

/// Length outside the view that is reserved for extension lines of slanted lengths, mm.
const EXTENSION_REACH_MM: f64 = 40.0;

/// A dimension line with its arrows and extension lines.
struct DimensionLine {
    points: [Point; 2],
    /// The projections of both points on the line.
    feet: [Point; 2],
    /// Unit vector from the first foot to the second.
    way: Vec2,
    length: f64,
    /// Whether both arrows fit between the feet.
    is_inside: bool,
    /// Unit vector along which the value is read.
    reading: Vec2,
}

impl DimensionLine {
    fn new(points: [Point; 2], along: Vec2, through: Point) -> Self {
        let feet = points.map(|p| through + along * (p - through).dot(along));
        let length = (feet[1] - feet[0]).hypot2().sqrt();
        let way = if length > 0.0 { (feet[1] - feet[0]) / length } else { along };
        // Values must be readable from below or from the right.
        let mut reading = along;
        if reading.x < -MAX_ZERO_COMPONENT || reading.x.abs() <= MAX_ZERO_COMPONENT && reading.y > 0.0 {
            reading = -reading;
        }
        Self { points, feet, way, length, is_inside: length >= 2.0 * ARROW_LENGTH_MM + 1.0, reading }
    }

    /// Candidate positions for the centre of a value, along the line from its middle, preferred first.
    fn value_offsets(&self, wide: f64) -> Vec<f64> {
        let mut spots = Vec::new();
        let slack = self.length / 2.0 - ARROW_LENGTH_MM - wide / 2.0;
        if self.is_inside && slack > 0.0 {
            spots.push(0.0);
            let steps = (slack / VALUE_STEP_MM).floor().min(f64::from(MAX_VALUE_STEPS)) as u32;
            spots.extend(
                (1..=steps).flat_map(|k| [VALUE_STEP_MM * f64::from(k), -VALUE_STEP_MM * f64::from(k)]),
            );
        }
        let out = self.length / 2.0 + 2.0 * ARROW_LENGTH_MM + wide / 2.0;
        let outer = (0..MAX_VALUE_STEPS).map(|k| out + VALUE_STEP_MM * f64::from(k));
        spots.extend(outer.flat_map(|out| [out, -out]));
        spots
    }

    /// Both ends of the line, along it from its middle, if the value is at `spot`.
    fn ends(&self, spot: f64, wide: f64) -> [f64; 2] {
        let own = self.length / 2.0 + if self.is_inside { 0.0 } else { 2.0 * ARROW_LENGTH_MM };
        // The line extends below a value that is outside.
        let reach = if spot.abs() < self.length / 2.0 { 0.0 } else { spot.abs() + wide / 2.0 };
        if spot < 0.0 { [-own.max(reach), own] } else { [-own, own.max(reach)] }
    }

    fn at(&self, along: f64) -> Point {
        self.feet[0].midpoint(self.feet[1]) + self.way * along
    }

    /// The placement of a value above or below its line.
    fn place(&self, word: &SetWord, spot: f64, is_above: bool) -> Affine {
        let up = Vec2::new(self.reading.y, -self.reading.x);
        // Commas and brackets reach below the baseline.
        let rise =
            if is_above { VALUE_GAP_MM + word.bounds.y1.max(0.0) } else { -VALUE_GAP_MM + word.bounds.y0 };
        let at = self.at(spot) + up * rise;
        let [c, s] = [self.reading.x, self.reading.y];
        Affine::new([c, s, -s, c, at.x, at.y]) * Affine::translate((-word.bounds.center().x, 0.0))
    }

    /// The extension lines.
    fn extension_lines(&self) -> impl Iterator<Item = [Point; 2]> + '_ {
        self.points.iter().zip(self.feet).filter_map(|(p, foot)| {
            let out = foot - *p;
            let far = out.hypot2().sqrt();
            (far > EXTENSION_GAP_MM)
                .then(|| [*p + out * (EXTENSION_GAP_MM / far), foot + out * (EXTENSION_OVERSHOOT_MM / far)])
        })
    }

    /// Tip and direction of both arrow heads.
    fn heads(&self) -> [(Point, Vec2); 2] {
        let sign = if self.is_inside { 1.0 } else { -1.0 };
        [(self.feet[0], -self.way * sign), (self.feet[1], self.way * sign)]
    }

    /// Whether lines and arrow heads touch nothing that `clear` excludes.
    fn is_free(&self, ends: [f64; 2], clear: Clearance, board: &AnnotationBoard) -> bool {
        let heads = self.heads().map(|(tip, towards)| {
            AnnotationBoard::head(tip, towards, ARROW_LENGTH_MM).wider(LINE_CLEARANCE_MM)
        });
        board.is_line_free(self.at(ends[0]), self.at(ends[1]), clear)
            // Extension lines to outer rows may pass arrow heads that start at the same point.
            && self.extension_lines().all(|[a, b]| board.is_line_free(a, b, Clearance::Texts))
            && heads.iter().all(|head| board.taken.is_free(head, Clearance::Texts))
    }

    fn draw(&self, word: &SetWord, (spot, is_above): (f64, bool), board: &mut AnnotationBoard) {
        let [low, high] = self.ends(spot, word.bounds.width());
        for [a, b] in self.extension_lines() {
            board.line(a, b, THIN_LINE_MM, OccupantKind::Line);
        }
        board.line(self.at(low), self.at(high), THIN_LINE_MM, OccupantKind::Line);
        for (tip, towards) in self.heads() {
            board.arrow(tip, towards, ARROW_LENGTH_MM);
        }
        board.write(word, self.place(word, spot, is_above));
    }
}

/// A length that has its row, and its extent along the side.
struct RowPlacement {
    row: u32,
    span: [f64; 2],
}

/// Draws the lengths along one side of a view in rows. `kept` are positions along the side that values must
/// avoid, because lines will pass there.
pub(crate) fn draw_rows(
    rect: Rect,
    told: &[&SideLength],
    kept: &[f64],
    board: &mut AnnotationBoard,
) -> Result<(), Error> {
    let mut order: Vec<usize> = (0..told.len()).collect();
    let long = |k: usize| told[k].span()[1] - told[k].span()[0];
    order.sort_by(|a, b| {
        let low = |k: usize| told[k].span()[0];
        long(*a).total_cmp(&long(*b)).then(low(*a).total_cmp(&low(*b))).then(a.cmp(b))
    });
    let mut done: Vec<RowPlacement> = Vec::new();
    for (n, k) in order.iter().enumerate() {
        let own = told[*k];
        let word = board.word(&own.text, VALUE_HEIGHT_MM)?;
        let wide = word.bounds.width();
        let later = order.iter().skip(n + 1).flat_map(|k| told[*k].span());
        let passing: Vec<f64> = later.chain(kept.iter().copied()).collect();
        let found = (0..MAX_ROWS).find_map(|row| {
            let line = row_line(own, rect, row);
            let spot = line.value_offsets(wide).into_iter().find(|spot| {
                let ends = line.ends(*spot, wide);
                let span = span_along(own, [line.at(ends[0]), line.at(ends[1])]);
                let is_outer = done.iter().all(|other| {
                    other.row < row
                        || other.span[0] - span[1] >= MIN_ROW_GAP_MM
                        || span[0] - other.span[1] >= MIN_ROW_GAP_MM
                });
                let place = line.place(&word, *spot, true);
                let text = word.shape(place).wider(TEXT_CLEARANCE_MM).bounds();
                let text = span_along(own, [Point::new(text.x0, text.y0), Point::new(text.x1, text.y1)]);
                is_outer
                    && !passing.iter().any(|x| text[0] <= *x && *x <= text[1])
                    && board.is_free(&word, place)
                    && line.is_free(ends, Clearance::Solids, board)
            })?;
            Some((row, line, spot))
        });
        let Some((row, line, spot)) = found else {
            board.unplaced.push(format!("the length `{}`", own.text));
            continue;
        };
        let ends = line.ends(spot, wide);
        done.push(RowPlacement { row, span: span_along(own, [line.at(ends[0]), line.at(ends[1])]) });
        line.draw(&word, (spot, true), board);
    }
    Ok(())
}

/// Two positions along the side of a length, in rising order.
fn span_along(told: &SideLength, [a, b]: [Point; 2]) -> [f64; 2] {
    let [a, b] = [a, b].map(|p| if told.side.is_across() { p.x } else { p.y });
    [a.min(b), a.max(b)]
}

fn row_line(told: &SideLength, rect: Rect, row: u32) -> DimensionLine {
    let away = FIRST_ROW_OFFSET_MM + ROW_SPACING_MM * f64::from(row);
    let out = told.side.outward();
    let corner = if out.x + out.y < 0.0 { rect.origin() } else { Point::new(rect.x1, rect.y1) };
    let along = if told.side.is_across() { Vec2::new(1.0, 0.0) } else { Vec2::new(0.0, 1.0) };
    DimensionLine::new(told.ends, along, corner + out * away)
}

/// The paper that extension lines of slanted lengths may need.
pub(crate) fn extension_line_paper<'a>(
    rect: Rect,
    told: impl Iterator<Item = &'a SlantedLength>,
) -> Occupancy {
    let mut kept = Occupancy::default();
    let far = rect.size().to_vec2().hypot2().sqrt() + EXTENSION_REACH_MM;
    for told in told {
        let out = outward(told.along);
        for p in told.ends {
            kept.take(
                ConvexShape::line(p - out * far, p + out * far, THIN_LINE_MM).wider(LINE_CLEARANCE_MM),
                OccupantKind::Line,
            );
        }
    }
    kept
}

/// The normal of a length that points below, or to the right if the length is vertical.
fn outward(along: Vec2) -> Vec2 {
    let out = Vec2::new(-along.y, along.x);
    let is_above = out.y < -MAX_ZERO_COMPONENT;
    let is_vertical = out.y.abs() <= MAX_ZERO_COMPONENT;
    if is_above || is_vertical && out.x < 0.0 { -out } else { out }
}

/// Draws a length that is not in a row.
pub(crate) fn draw_slanted(
    rect: Rect,
    told: &SlantedLength,
    board: &mut AnnotationBoard,
) -> Result<(), Error> {
    let word = board.word(&told.text, VALUE_HEIGHT_MM)?;
    let wide = word.bounds.width();
    let out = outward(told.along);
    let outer = told.ends.map(|p| p.to_vec2().dot(out));
    let line = |offset: f64| {
        let reach = if offset > 0.0 { outer[0].max(outer[1]) } else { outer[0].min(outer[1]) };
        DimensionLine::new(told.ends, told.along, told.ends[0] + out * (reach - outer[0] + offset))
    };
    let offsets: Vec<f64> = told.offset.map_or_else(
        || {
            let most =
                (rect.size().to_vec2().hypot2().sqrt() / SLANTED_STEP_MM).ceil().min(200.0) as u32 + 10;
            let farther = (0..most).map(|k| FIRST_SLANTED_OFFSET_MM + SLANTED_STEP_MM * f64::from(k));
            farther.flat_map(|offset| [offset, -offset]).collect()
        },
        |offset| vec![offset],
    );
    for clear in [Clearance::Solids, Clearance::Texts] {
        for offset in &offsets {
            let line = line(*offset);
            for spot in line.value_offsets(wide) {
                for is_above in [true, false] {
                    let is_free = board.is_free(&word, line.place(&word, spot, is_above))
                        && line.is_free(line.ends(spot, wide), clear, board);
                    if is_free {
                        line.draw(&word, (spot, is_above), board);
                        return Ok(());
                    }
                }
            }
        }
    }
    board.unplaced.push(format!("the length `{}`", told.text));
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dimension_values_move_along_their_line_and_then_outside() {
        let line = DimensionLine::new(
            [Point::new(0.0, 0.0), Point::new(30.0, 0.0)],
            Vec2::new(1.0, 0.0),
            Point::new(0.0, 10.0),
        );
        let spots = line.value_offsets(10.0);
        assert_eq!(spots[..3], [0.0, 2.0, -2.0]);
        assert!(spots.contains(&26.0) && spots.contains(&-26.0));
        assert_eq!(line.ends(0.0, 10.0), [-15.0, 15.0]);
        assert_eq!(line.ends(26.0, 10.0), [-15.0, 31.0]);
        let short = DimensionLine::new([Point::ZERO, Point::new(2.0, 0.0)], Vec2::new(1.0, 0.0), Point::ZERO);
        assert!(!short.is_inside);
        assert_eq!(short.value_offsets(4.0)[0], 1.0 + 2.0 * ARROW_LENGTH_MM + 2.0);
    }
}
