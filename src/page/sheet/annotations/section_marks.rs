//! Section marks: a chain line with thick ends, arrows in the viewing direction, and letters (ISO 128-3).
//!
//! 1. An end goes as near to the view as its arrow and letter find free paper, away from future extension
//!    lines.
//! 2. An end without such a place is placed after the dimensions, outside their rows.
//! 3. Planes are marked in the direction of their arrows, so the arrow of a plane lies farther out than the
//!    ends of the planes before it.

use kurbo::{Point, Rect, Vec2};

use crate::error::Error;
use crate::page::sheet::canvas::annotation_board::{Board, TEXT_CLEAR, Word};
use crate::page::sheet::canvas::paper_occupancy::{Clear, Kind, Shape};
use crate::page::sheet::canvas::sheet_canvas::{CHAIN, NARROW, WIDE, way};

/// Letter height, mm.
const LETTERS: f64 = 5.0;

/// Distance from the view to the end of the line, mm; outward step, mm; maximum number of steps, near the
/// view and later.
const REACH: f64 = 7.0;
const FARTHER: f64 = 1.0;
const NEAR: u32 = 24;
const FAR: u32 = 240;

/// Length of a thick end, distance from its end to the arrow, length of the arrow, and length of its head,
/// mm.
const THICK: f64 = 5.0;
const INSET: f64 = 1.0;
const TAIL: f64 = 9.0;
const HEAD: f64 = 4.0;

/// Clearance between a letter and future extension lines, mm.
const KEPT: f64 = 0.8;

/// Positions of future extension lines on the side of a view in a direction.
type Kept<'a> = &'a dyn Fn(Vec2) -> Vec<f64>;

/// The section mark of a cutting plane in a view.
pub(crate) struct CutMark {
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

impl CutMark {
    /// A mark through point `on` of a view; its section is seen from the side of `back`.
    pub fn new(label: &str, on: Point, back: Vec2, rect: Rect) -> Self {
        let along = Vec2::new(-back.y, back.x);
        let corners = [(rect.x0, rect.y0), (rect.x1, rect.y0), (rect.x1, rect.y1), (rect.x0, rect.y1)];
        let places = corners.map(|corner| (Point::from(corner) - on).dot(along));
        let least = places.into_iter().fold(f64::INFINITY, f64::min);
        let most = places.into_iter().fold(f64::NEG_INFINITY, f64::max);
        Self {
            label: label.to_owned(),
            on,
            along,
            back,
            open: vec![(-1.0, least), (1.0, most)],
            ends: [None; 2],
        }
    }

    fn at(&self, along: f64) -> Point {
        self.on + self.along * along
    }

    /// Position of the plane along `back`.
    pub fn depth(&self) -> f64 {
        self.on.to_vec2().dot(self.back)
    }

    /// Where the line crosses the side of the view in direction `outward`, if its end there has no place yet:
    /// the x coordinate if `across`, else y.
    pub fn open_at(&self, across: bool, outward: Vec2) -> Option<f64> {
        let passes = self.open.iter().any(|(sign, _)| (self.along * *sign).dot(outward) > 0.7);
        passes.then_some(if across { self.on.x } else { self.on.y })
    }

    /// Marks the paper of the line within the view as occupied.
    pub fn take_inside(&self, board: &mut Board) {
        if let [(_, low), (_, high)] = self.open[..] {
            board.taken.take(Shape::line(self.at(low), self.at(high), NARROW), Kind::Line);
        }
    }

    /// Places ends near the view. `kept` returns the positions of future extension lines for a direction.
    pub fn place_near(&mut self, kept: Kept, board: &mut Board) -> Result<(), Error> {
        self.place(board, NEAR, Some(kept))
    }

    /// Places the remaining ends and draws the line.
    pub fn finish(mut self, board: &mut Board) -> Result<(), Error> {
        self.place(board, FAR, None)?;
        for _ in &self.open {
            board.unplaced.push(format!("the letter of the section `{}`", self.label));
        }
        if let [Some(low), Some(high)] = self.ends {
            board.ink.path(way(&[self.at(low), self.at(high)]), NARROW, &CHAIN);
        }
        Ok(())
    }

    fn place(&mut self, board: &mut Board, tries: u32, kept: Option<Kept>) -> Result<(), Error> {
        let word = board.word(&self.label, LETTERS)?;
        for (sign, border) in std::mem::take(&mut self.open) {
            // If nothing else is left, a line may cross an arrow head.
            let ways = [Clear::All, Clear::Solids, Clear::Texts];
            let found =
                ways.into_iter().filter(|clear| kept.is_none() || *clear == Clear::All).find_map(|clear| {
                    (0..tries).find_map(|k| {
                        let end = border + sign * (REACH + FARTHER * f64::from(k));
                        let letter = self.letter((sign, border, end), &word, (clear, kept), board)?;
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
        word: &Word,
        (clear, kept): (Clear, Option<Kept>),
        board: &Board,
    ) -> Option<Point> {
        let tip = self.at(end - sign * INSET);
        let out = self.along * sign;
        let thick = Shape::line(self.at(end), self.at(end - sign * THICK), 2.0 * WIDE).wider(TEXT_CLEAR);
        let shaft = Shape::line(tip + self.back * TAIL, tip + self.back * 3.0, NARROW).wider(TEXT_CLEAR);
        let head = Board::head(tip, -self.back, HEAD).wider(TEXT_CLEAR);
        let solids = if clear == Clear::Texts { Clear::Texts } else { Clear::Solids };
        let is_free = board.taken.is_free(&thick, solids)
            && board.taken.is_free(&head, clear)
            && board.taken.is_free(&shaft, clear)
            && board.is_line_free(self.at(border), self.at(end), solids);
        if !is_free {
            return None;
        }
        let passes = |shape: &Shape| {
            let bounds = shape.bounds().inflate(KEPT, KEPT);
            kept.is_some_and(|kept| {
                let vertical = out.y.abs() > out.x.abs();
                let (low, high) = if vertical { (bounds.x0, bounds.x1) } else { (bounds.y0, bounds.y1) };
                kept(out).iter().any(|x| low <= *x && *x <= high)
            })
        };
        if passes(&head) || passes(&thick) {
            return None;
        }
        let beside = word.bounds.width() / 2.0 + 1.5;
        [
            self.back * 12.0 + out * 1.5,
            self.back * 12.5,
            self.back * 6.5 + out * (beside + 0.5),
            self.back * 6.5 + out * (beside + 2.0),
            self.back * 14.0 + out * 3.0,
            out * (beside + 2.5),
            self.back * -4.5 + out * 1.0,
        ]
        .into_iter()
        .map(|way| tip + way)
        .find(|middle| {
            let place = word.centred(*middle);
            let own = word.shape(place).wider(TEXT_CLEAR);
            board.is_free(word, place)
                && !passes(&own)
                && ![thick, shaft, head].iter().any(|part| part.touches(&own))
        })
    }

    fn draw(&self, (sign, border, end): (f64, f64, f64), (word, letter): (&Word, Point), board: &mut Board) {
        let tip = self.at(end - sign * INSET);
        let (a, b) = (self.at(end), self.at(end - sign * THICK));
        board.ink.line(a, b, 2.0 * WIDE);
        board.taken.take(Shape::line(a, b, 2.0 * WIDE), Kind::Arrow);
        board.taken.take(Shape::line(self.at(border), a, NARROW), Kind::Line);
        board.line(tip + self.back * TAIL, tip + self.back * 3.0, NARROW, Kind::Line);
        board.arrow(tip, -self.back, HEAD);
        // Nothing may pass between the arrow and its letter.
        board.taken.take(Shape::line(tip + self.back * 3.0, letter, NARROW), Kind::Arrow);
        board.write(word, word.centred(letter));
    }
}
