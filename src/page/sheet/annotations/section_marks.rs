//! Section marks: a chain line with thick ends, arrows in the viewing direction, and letters (ISO 128-3).
//!
//! 1. An end goes as near to the view as its arrow and letter find free paper, away from future extension
//!    lines.
//! 2. An end without such a place is placed after the dimensions, outside their rows.
//! 3. Planes are marked in the direction of their arrows, so the arrow of a plane lies farther out than the
//!    ends of the planes before it.

use kurbo::{Point, Rect, Vec2};

use crate::error::Error;
use crate::geometry::plane::polyline_path::polyline;
use crate::page::sheet::canvas::annotation_board::{AnnotationBoard, SetWord, TEXT_CLEARANCE_MM};
use crate::page::sheet::canvas::paper_occupancy::{Clearance, ConvexShape, OccupantKind};
use crate::page::sheet::canvas::sheet_canvas::{CHAIN_DASH_MM, THICK_LINE_MM, THIN_LINE_MM};

/// Letter height, mm.
const LETTER_HEIGHT_MM: f64 = 5.0;

/// Distance from the view to the end of the line, mm; outward step, mm; maximum number of steps, near the
/// view and later.
const FIRST_END_OFFSET_MM: f64 = 7.0;
const OUTWARD_STEP_MM: f64 = 1.0;
const MAX_NEAR_STEPS: u32 = 24;
const MAX_OUTER_STEPS: u32 = 240;

/// Length of a thick end, distance from its end to the arrow, length of the arrow, and length of its head,
/// mm.
const THICK_END_LENGTH_MM: f64 = 5.0;
const ARROW_INSET_MM: f64 = 1.0;
const ARROW_TAIL_MM: f64 = 9.0;
const ARROW_HEAD_MM: f64 = 4.0;

/// Clearance between a letter and future extension lines, mm.
const DIMENSION_CLEARANCE_MM: f64 = 0.8;

/// Positions of future extension lines on the side of a view in a direction.
type DimensionCrossings<'a> = &'a dyn Fn(Vec2) -> Vec<f64>;

/// The section mark of a cutting plane in a view.
pub(crate) struct SectionMark {
    label: String,
    on: Point,
    /// Unit vectors along the line, and across it against the arrows.
    along: Vec2,
    back: Vec2,
    /// Ends without a place: direction (-1 or 1), and where the view ends along the line.
    open: Vec<(f64, f64)>,
    /// Positions of the placed ends along the line.
    ends: [Option<f64>; 2],
}

impl SectionMark {
    /// A mark through point `on` of a view; its section is seen from the side of `back`.
    pub(crate) fn new(label: &str, on: Point, back: Vec2, rect: Rect) -> Self {
        let along = Vec2::new(-back.y, back.x);
        let corners = [(rect.x0, rect.y0), (rect.x1, rect.y0), (rect.x1, rect.y1), (rect.x0, rect.y1)];
        let corner_offsets = corners.map(|corner| (Point::from(corner) - on).dot(along));
        let min_offset = corner_offsets.into_iter().fold(f64::INFINITY, f64::min);
        let max_offset = corner_offsets.into_iter().fold(f64::NEG_INFINITY, f64::max);
        Self {
            label: label.to_owned(),
            on,
            along,
            back,
            open: vec![(-1.0, min_offset), (1.0, max_offset)],
            ends: [None; 2],
        }
    }

    fn at(&self, offset: f64) -> Point {
        self.on + self.along * offset
    }

    /// Position of the plane along `back`.
    pub(crate) fn depth(&self) -> f64 {
        self.on.to_vec2().dot(self.back)
    }

    /// Where the line crosses the side of the view in direction `outward`, if its end there has no place yet:
    /// the x coordinate if `is_across`, else y.
    pub(crate) fn open_crossing(&self, is_across: bool, outward: Vec2) -> Option<f64> {
        let passes = self.open.iter().any(|(sign, _)| (self.along * *sign).dot(outward) > 0.7);
        passes.then_some(if is_across { self.on.x } else { self.on.y })
    }

    /// Marks the paper of the line within the view as occupied.
    pub(crate) fn take_inside(&self, board: &mut AnnotationBoard) {
        if let [(_, low), (_, high)] = self.open[..] {
            board
                .taken
                .take(ConvexShape::line(self.at(low), self.at(high), THIN_LINE_MM), OccupantKind::Line);
        }
    }

    /// Places ends near the view. `crossings` returns the positions of future extension lines for a direction.
    pub(crate) fn place_near(
        &mut self,
        crossings: DimensionCrossings,
        board: &mut AnnotationBoard,
    ) -> Result<(), Error> {
        self.place(board, MAX_NEAR_STEPS, Some(crossings))
    }

    /// Places the remaining ends and draws the line.
    pub(crate) fn finish(mut self, board: &mut AnnotationBoard) -> Result<(), Error> {
        self.place(board, MAX_OUTER_STEPS, None)?;
        for _ in &self.open {
            board.unplaced.push(format!("the letter of the section `{}`", self.label));
        }
        if let [Some(low), Some(high)] = self.ends {
            board.ink.path(polyline(&[self.at(low), self.at(high)]), THIN_LINE_MM, &CHAIN_DASH_MM);
        }
        Ok(())
    }

    fn place(
        &mut self,
        board: &mut AnnotationBoard,
        tries: u32,
        crossings: Option<DimensionCrossings>,
    ) -> Result<(), Error> {
        let word = board.word(&self.label, LETTER_HEIGHT_MM)?;
        for (sign, border) in std::mem::take(&mut self.open) {
            // If nothing else is left, a line may cross an arrow head.
            let clearances = [Clearance::All, Clearance::Solids, Clearance::Texts];
            let found = clearances
                .into_iter()
                .filter(|candidate_clearance| crossings.is_none() || *candidate_clearance == Clearance::All)
                .find_map(|clearance| {
                    (0..tries).find_map(|k| {
                        let end = border + sign * (FIRST_END_OFFSET_MM + OUTWARD_STEP_MM * f64::from(k));
                        let letter =
                            self.letter((sign, border, end), &word, (clearance, crossings), board)?;
                        Some((end, letter))
                    })
                });
            let Some((end, letter)) = found else {
                self.open.push((sign, border));
                continue;
            };
            self.draw((sign, border, end), (&word, letter), board);
            self.ends[usize::from(sign > 0.0)] = Some(end);
        }
        Ok(())
    }

    /// The centre of the letter at an end, if the whole end fits.
    fn letter(
        &self,
        (sign, border, end): (f64, f64, f64),
        word: &SetWord,
        (clearance, crossings): (Clearance, Option<DimensionCrossings>),
        board: &AnnotationBoard,
    ) -> Option<Point> {
        let tip = self.at(end - sign * ARROW_INSET_MM);
        let outward = self.along * sign;
        let thick_end =
            ConvexShape::line(self.at(end), self.at(end - sign * THICK_END_LENGTH_MM), 2.0 * THICK_LINE_MM)
                .wider(TEXT_CLEARANCE_MM);
        let shaft = ConvexShape::line(tip + self.back * ARROW_TAIL_MM, tip + self.back * 3.0, THIN_LINE_MM)
            .wider(TEXT_CLEARANCE_MM);
        let head = AnnotationBoard::head(tip, -self.back, ARROW_HEAD_MM).wider(TEXT_CLEARANCE_MM);
        let solid_clearance =
            if clearance == Clearance::Texts { Clearance::Texts } else { Clearance::Solids };
        let is_free = board.taken.is_free(&thick_end, solid_clearance)
            && board.taken.is_free(&head, clearance)
            && board.taken.is_free(&shaft, clearance)
            && board.is_line_free(self.at(border), self.at(end), solid_clearance);
        if !is_free {
            return None;
        }
        let crosses_dimension = |shape: &ConvexShape| {
            let bounds = shape.bounds().inflate(DIMENSION_CLEARANCE_MM, DIMENSION_CLEARANCE_MM);
            crossings.is_some_and(|kept| {
                let vertical = outward.y.abs() > outward.x.abs();
                let (low, high) = if vertical { (bounds.x0, bounds.x1) } else { (bounds.y0, bounds.y1) };
                kept(outward).iter().any(|x| low <= *x && *x <= high)
            })
        };
        if crosses_dimension(&head) || crosses_dimension(&thick_end) {
            return None;
        }
        let side_offset = word.bounds.width() / 2.0 + 1.5;
        [
            self.back * 12.0 + outward * 1.5,
            self.back * 12.5,
            self.back * 6.5 + outward * (side_offset + 0.5),
            self.back * 6.5 + outward * (side_offset + 2.0),
            self.back * 14.0 + outward * 3.0,
            outward * (side_offset + 2.5),
            self.back * -4.5 + outward * 1.0,
        ]
        .into_iter()
        .map(|letter_offset| tip + letter_offset)
        .find(|middle| {
            let letter_transform = word.centred(*middle);
            let letter_shape = word.shape(letter_transform).wider(TEXT_CLEARANCE_MM);
            board.is_free(word, letter_transform)
                && !crosses_dimension(&letter_shape)
                && ![thick_end, shaft, head].iter().any(|part| part.touches(&letter_shape))
        })
    }

    fn draw(
        &self,
        (sign, border, end): (f64, f64, f64),
        (word, letter): (&SetWord, Point),
        board: &mut AnnotationBoard,
    ) {
        let tip = self.at(end - sign * ARROW_INSET_MM);
        let (a, b) = (self.at(end), self.at(end - sign * THICK_END_LENGTH_MM));
        board.ink.line(a, b, 2.0 * THICK_LINE_MM);
        board.taken.take(ConvexShape::line(a, b, 2.0 * THICK_LINE_MM), OccupantKind::Arrow);
        board.taken.take(ConvexShape::line(self.at(border), a, THIN_LINE_MM), OccupantKind::Line);
        board.line(tip + self.back * ARROW_TAIL_MM, tip + self.back * 3.0, THIN_LINE_MM, OccupantKind::Line);
        board.arrow(tip, -self.back, ARROW_HEAD_MM);
        // Nothing may pass between the arrow and its letter.
        board.taken.take(ConvexShape::line(tip + self.back * 3.0, letter, THIN_LINE_MM), OccupantKind::Arrow);
        board.write(word, word.centred(letter));
    }
}
