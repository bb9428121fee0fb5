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
        let direction = if length > 0.0 { (feet[1] - feet[0]) / length } else { along };
        // Values must be readable from below or from the right.
        let mut reading = along;
        if reading.x < -MAX_ZERO_COMPONENT || reading.x.abs() <= MAX_ZERO_COMPONENT && reading.y > 0.0 {
            reading = -reading;
        }
        Self {
            points,
            feet,
            way: direction,
            length,
            is_inside: length >= 2.0 * ARROW_LENGTH_MM + 1.0,
            reading,
        }
    }

    /// Candidate positions for the centre of a value, along the line from its middle, preferred first.
    fn value_offsets(&self, text_width: f64) -> Vec<f64> {
        let mut offsets = Vec::new();
        let slack = self.length / 2.0 - ARROW_LENGTH_MM - text_width / 2.0;
        if self.is_inside && slack > 0.0 {
            offsets.push(0.0);
            let steps = (slack / VALUE_STEP_MM).floor().min(f64::from(MAX_VALUE_STEPS)) as u32;
            offsets.extend(
                (1..=steps).flat_map(|k| [VALUE_STEP_MM * f64::from(k), -VALUE_STEP_MM * f64::from(k)]),
            );
        }
        let first_outer_offset = self.length / 2.0 + 2.0 * ARROW_LENGTH_MM + text_width / 2.0;
        let outer_offsets = (0..MAX_VALUE_STEPS).map(|k| first_outer_offset + VALUE_STEP_MM * f64::from(k));
        offsets.extend(outer_offsets.flat_map(|out| [out, -out]));
        offsets
    }

    /// Both ends of the line, along it from its middle, if the value is at `offset`.
    fn ends(&self, offset: f64, text_width: f64) -> [f64; 2] {
        let line_end = self.length / 2.0 + if self.is_inside { 0.0 } else { 2.0 * ARROW_LENGTH_MM };
        // The line extends below a value that is outside.
        let text_end = if offset.abs() < self.length / 2.0 { 0.0 } else { offset.abs() + text_width / 2.0 };
        if offset < 0.0 { [-line_end.max(text_end), line_end] } else { [-line_end, line_end.max(text_end)] }
    }

    fn at(&self, offset: f64) -> Point {
        self.feet[0].midpoint(self.feet[1]) + self.way * offset
    }

    /// The placement of a value above or below its line.
    fn place(&self, word: &SetWord, offset: f64, is_above: bool) -> Affine {
        let up = Vec2::new(self.reading.y, -self.reading.x);
        // Commas and brackets reach below the baseline.
        let rise =
            if is_above { VALUE_GAP_MM + word.bounds.y1.max(0.0) } else { -VALUE_GAP_MM + word.bounds.y0 };
        let text_point = self.at(offset) + up * rise;
        let [c, s] = [self.reading.x, self.reading.y];
        Affine::new([c, s, -s, c, text_point.x, text_point.y])
            * Affine::translate((-word.bounds.center().x, 0.0))
    }

    /// The extension lines.
    fn extension_lines(&self) -> impl Iterator<Item = [Point; 2]> + '_ {
        self.points.iter().zip(self.feet).filter_map(|(p, foot)| {
            let to_foot = foot - *p;
            let distance = to_foot.hypot2().sqrt();
            (distance > EXTENSION_GAP_MM).then(|| {
                [
                    *p + to_foot * (EXTENSION_GAP_MM / distance),
                    foot + to_foot * (EXTENSION_OVERSHOOT_MM / distance),
                ]
            })
        })
    }

    /// Tip and direction of both arrow heads.
    fn heads(&self) -> [(Point, Vec2); 2] {
        let sign = if self.is_inside { 1.0 } else { -1.0 };
        [(self.feet[0], -self.way * sign), (self.feet[1], self.way * sign)]
    }

    /// Whether lines and arrow heads touch nothing that `clearance` excludes.
    fn is_free(&self, ends: [f64; 2], clearance: Clearance, board: &AnnotationBoard) -> bool {
        let heads = self.heads().map(|(tip, towards)| {
            AnnotationBoard::head(tip, towards, ARROW_LENGTH_MM).wider(LINE_CLEARANCE_MM)
        });
        board.is_line_free(self.at(ends[0]), self.at(ends[1]), clearance)
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

/// Draws the lengths along one side of a view in rows. `crossings` are positions along the side that values must
/// avoid, because lines will pass there.
pub(crate) fn draw_rows(
    rect: Rect,
    side_lengths: &[&SideLength],
    crossings: &[f64],
    board: &mut AnnotationBoard,
) -> Result<(), Error> {
    let mut order: Vec<usize> = (0..side_lengths.len()).collect();
    let span_length = |k: usize| side_lengths[k].span()[1] - side_lengths[k].span()[0];
    order.sort_by(|a, b| {
        let low = |k: usize| side_lengths[k].span()[0];
        span_length(*a).total_cmp(&span_length(*b)).then(low(*a).total_cmp(&low(*b))).then(a.cmp(b))
    });
    let mut placed_rows: Vec<RowPlacement> = Vec::new();
    for (n, k) in order.iter().enumerate() {
        let side_length = side_lengths[*k];
        let word = board.word(&side_length.text, VALUE_HEIGHT_MM)?;
        let text_width = word.bounds.width();
        let later = order.iter().skip(n + 1).flat_map(|k| side_lengths[*k].span());
        let passing: Vec<f64> = later.chain(crossings.iter().copied()).collect();
        let placement = (0..MAX_ROWS).find_map(|row| {
            let line = row_line(side_length, rect, row);
            let spot = line.value_offsets(text_width).into_iter().find(|spot| {
                let ends = line.ends(*spot, text_width);
                let span = span_along(side_length, [line.at(ends[0]), line.at(ends[1])]);
                let is_outer = placed_rows.iter().all(|placed_row| {
                    placed_row.row < row
                        || placed_row.span[0] - span[1] >= MIN_ROW_GAP_MM
                        || span[0] - placed_row.span[1] >= MIN_ROW_GAP_MM
                });
                let text_transform = line.place(&word, *spot, true);
                let text_bounds = word.shape(text_transform).wider(TEXT_CLEARANCE_MM).bounds();
                let text_span = span_along(
                    side_length,
                    [Point::new(text_bounds.x0, text_bounds.y0), Point::new(text_bounds.x1, text_bounds.y1)],
                );
                is_outer
                    && !passing.iter().any(|x| text_span[0] <= *x && *x <= text_span[1])
                    && board.is_free(&word, text_transform)
                    && line.is_free(ends, Clearance::Solids, board)
            })?;
            Some((row, line, spot))
        });
        let Some((row, line, spot)) = placement else {
            board.unplaced.push(format!("the length `{}`", side_length.text));
            continue;
        };
        let ends = line.ends(spot, text_width);
        placed_rows
            .push(RowPlacement { row, span: span_along(side_length, [line.at(ends[0]), line.at(ends[1])]) });
        line.draw(&word, (spot, true), board);
    }
    Ok(())
}

/// Two positions along the side of a length, in rising order.
fn span_along(side_length: &SideLength, [a, b]: [Point; 2]) -> [f64; 2] {
    let [a, b] = [a, b].map(|p| if side_length.side.is_across() { p.x } else { p.y });
    [a.min(b), a.max(b)]
}

fn row_line(side_length: &SideLength, rect: Rect, row: u32) -> DimensionLine {
    let row_offset = FIRST_ROW_OFFSET_MM + ROW_SPACING_MM * f64::from(row);
    let outward_direction = side_length.side.outward();
    let corner = if outward_direction.x + outward_direction.y < 0.0 {
        rect.origin()
    } else {
        Point::new(rect.x1, rect.y1)
    };
    let along = if side_length.side.is_across() { Vec2::new(1.0, 0.0) } else { Vec2::new(0.0, 1.0) };
    DimensionLine::new(side_length.ends, along, corner + outward_direction * row_offset)
}

/// The paper that extension lines of slanted lengths may need.
pub(crate) fn extension_line_paper<'a>(
    rect: Rect,
    slanted_lengths: impl Iterator<Item = &'a SlantedLength>,
) -> Occupancy {
    let mut occupancy = Occupancy::default();
    let max_length = rect.size().to_vec2().hypot2().sqrt() + EXTENSION_REACH_MM;
    for slanted_length in slanted_lengths {
        let direction = outward(slanted_length.along);
        for p in slanted_length.ends {
            occupancy.take(
                ConvexShape::line(p - direction * max_length, p + direction * max_length, THIN_LINE_MM)
                    .wider(LINE_CLEARANCE_MM),
                OccupantKind::Line,
            );
        }
    }
    occupancy
}

/// The normal of a length that points below, or to the right if the length is vertical.
fn outward(along: Vec2) -> Vec2 {
    let normal = Vec2::new(-along.y, along.x);
    let is_above = normal.y < -MAX_ZERO_COMPONENT;
    let is_vertical = normal.y.abs() <= MAX_ZERO_COMPONENT;
    if is_above || is_vertical && normal.x < 0.0 { -normal } else { normal }
}

/// Draws a length that is not in a row.
pub(crate) fn draw_slanted(
    rect: Rect,
    slanted_length: &SlantedLength,
    board: &mut AnnotationBoard,
) -> Result<(), Error> {
    let word = board.word(&slanted_length.text, VALUE_HEIGHT_MM)?;
    let text_width = word.bounds.width();
    let outward_direction = outward(slanted_length.along);
    let end_offsets = slanted_length.ends.map(|p| p.to_vec2().dot(outward_direction));
    let line = |offset: f64| {
        let outermost = if offset > 0.0 {
            end_offsets[0].max(end_offsets[1])
        } else {
            end_offsets[0].min(end_offsets[1])
        };
        DimensionLine::new(
            slanted_length.ends,
            slanted_length.along,
            slanted_length.ends[0] + outward_direction * (outermost - end_offsets[0] + offset),
        )
    };
    let offsets: Vec<f64> = slanted_length.offset.map_or_else(
        || {
            let step_count =
                (rect.size().to_vec2().hypot2().sqrt() / SLANTED_STEP_MM).ceil().min(200.0) as u32 + 10;
            let outward_offsets =
                (0..step_count).map(|k| FIRST_SLANTED_OFFSET_MM + SLANTED_STEP_MM * f64::from(k));
            outward_offsets.flat_map(|offset| [offset, -offset]).collect()
        },
        |offset| vec![offset],
    );
    for clearance in [Clearance::Solids, Clearance::Texts] {
        for offset in &offsets {
            let line = line(*offset);
            for spot in line.value_offsets(text_width) {
                for is_above in [true, false] {
                    let is_free = board.is_free(&word, line.place(&word, spot, is_above))
                        && line.is_free(line.ends(spot, text_width), clearance, board);
                    if is_free {
                        line.draw(&word, (spot, is_above), board);
                        return Ok(());
                    }
                }
            }
        }
    }
    board.unplaced.push(format!("the length `{}`", slanted_length.text));
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
