//! [`Board`]: the annotations of a view, and the paper that they occupy.
//!
//! Everything drawn on a board also occupies its paper, so later annotations avoid it. Balloons are drawn on
//! a separate canvas, because they form their own layer.

use kurbo::{Affine, BezPath, PathEl, Point, Rect, Shape as _, Vec2};

use super::paper_occupancy::{Clear, Kind, Occupancy, Shape};
use super::sheet_canvas::{Ink, Stand};
use crate::drawing::{Mark, Paint};
use crate::error::Error;
use crate::text::Font;

/// Clearance around texts, and around lines that pass texts, mm.
pub(crate) const TEXT_CLEAR: f64 = 0.6;
pub(crate) const LINE_CLEAR: f64 = 0.4;

/// Tolerance of chords along curves that occupy paper, mm.
const FLAT: f64 = 0.05;

/// A word as marks, with its baseline starting at the origin.
pub(crate) struct Word {
    marks: Vec<Mark>,
    /// Bounding box of its letters.
    pub bounds: Rect,
}

impl Word {
    /// The paper that the word occupies at a place.
    pub fn shape(&self, place: Affine) -> Shape {
        let turned = |v: Vec2| place * v.to_point() - place * Point::ZERO;
        let along = turned(Vec2::new(self.bounds.width() / 2.0, 0.0));
        let across = turned(Vec2::new(0.0, self.bounds.height() / 2.0));
        Shape::turned(place * self.bounds.center(), along, across)
    }

    /// The place that centres the letters at a point.
    pub fn centred(&self, middle: Point) -> Affine {
        Affine::translate(middle - self.bounds.center())
    }
}

/// The annotations of a view, and the paper that they occupy.
pub(crate) struct Board {
    pub ink: Ink,
    pub balloons: Ink,
    pub taken: Occupancy,
    /// Reserved for extension lines that are placed later: texts avoid it.
    pub kept: Occupancy,
    /// Descriptions of annotations that found no place.
    pub unplaced: Vec<String>,
}

impl Board {
    /// An empty board.
    pub fn new(font: &Font) -> Self {
        Self {
            ink: Ink::new(font, "note"),
            balloons: Ink::new(font, "balloon"),
            taken: Occupancy::default(),
            kept: Occupancy::default(),
            unplaced: Vec::new(),
        }
    }

    /// Sets a word with a given height of capitals.
    pub fn word(&self, words: &str, high: f64) -> Result<Word, Error> {
        self.word_within(words, high, 0.0)
    }

    /// Sets a word, smaller if it would be wider than `most`; 0 sets no limit.
    pub fn word_within(&self, words: &str, high: f64, most: f64) -> Result<Word, Error> {
        let mut ink = self.ink.emptied();
        ink.word(words, Point::ZERO, high, Stand::Left, most)?;
        let boxes = ink.marks.iter().map(|mark| mark.path.bounding_box());
        let bounds = boxes.reduce(|a, b| a.union(b)).unwrap_or_default();
        Ok(Word { marks: ink.marks, bounds })
    }

    /// Whether the paper for a word at a place is free and not reserved.
    pub fn is_free(&self, word: &Word, place: Affine) -> bool {
        let shape = word.shape(place).wider(TEXT_CLEAR);
        self.taken.is_free(&shape, Clear::All) && self.kept.is_free(&shape, Clear::All)
    }

    /// Adds a word at a place.
    pub fn write(&mut self, word: &Word, place: Affine) {
        self.taken.take(word.shape(place), Kind::Solid);
        self.ink.marks.extend(stamped(word, place));
    }

    /// Adds the number of a balloon at a place.
    pub fn write_in_balloon(&mut self, word: &Word, place: Affine) {
        self.balloons.marks.extend(stamped(word, place));
    }

    /// Whether a line fits between two points, with clearance.
    pub fn is_line_free(&self, a: Point, b: Point, clear: Clear) -> bool {
        self.taken.is_free(&Shape::line(a, b, 0.0).wider(LINE_CLEAR), clear)
    }

    /// Adds a line.
    pub fn line(&mut self, a: Point, b: Point, width: f64, kind: Kind) {
        self.ink.line(a, b, width);
        self.taken.take(Shape::line(a, b, width), kind);
    }

    /// The paper of an arrow head with its tip at a point.
    pub fn head(tip: Point, towards: Vec2, length: f64) -> Shape {
        let back = -towards * (length / towards.hypot2().sqrt().max(f64::MIN_POSITIVE));
        let side = Vec2::new(-back.y, back.x) * 0.268;
        Shape::triangle([tip, tip + back + side, tip + back - side])
    }

    /// Adds an arrow head.
    pub fn arrow(&mut self, tip: Point, towards: Vec2, length: f64) {
        self.ink.arrow(tip, towards, length);
        self.taken.take(Self::head(tip, towards, length), Kind::Arrow);
    }

    /// Marks the paper of a path as occupied.
    pub fn take_path(&mut self, path: &BezPath, width: f64, kind: Kind) {
        flat_lines(path, |a, b| self.taken.take(Shape::line(a, b, width), kind));
    }

    /// Bounding box of all annotations, including line widths.
    pub fn extents(&self) -> Option<Rect> {
        let of = |mark: &Mark| {
            let wide = if let Paint::Stroke(stroke) = &mark.paint { stroke.width / 2.0 } else { 0.0 };
            mark.path.bounding_box().inflate(wide, wide)
        };
        self.ink.marks.iter().chain(&self.balloons.marks).map(of).reduce(|a, b| a.union(b))
    }
}

fn stamped(word: &Word, place: Affine) -> impl Iterator<Item = Mark> + '_ {
    word.marks.iter().map(move |mark| {
        let mut mark = mark.clone();
        mark.path.apply_affine(place);
        if let Some(text) = &mut mark.provenance.text {
            text.place = place * text.place;
        }
        mark
    })
}

/// Calls a function with each chord of a flattened path.
pub(crate) fn flat_lines(path: &BezPath, mut each: impl FnMut(Point, Point)) {
    let (mut start, mut last) = (Point::ZERO, Point::ZERO);
    kurbo::flatten(path.iter(), FLAT, |element| match element {
        PathEl::MoveTo(p) => (start, last) = (p, p),
        PathEl::LineTo(p) => {
            each(last, p);
            last = p;
        }
        PathEl::ClosePath => {
            each(last, start);
            last = start;
        }
        PathEl::QuadTo(..) | PathEl::CurveTo(..) => {}
    });
}
