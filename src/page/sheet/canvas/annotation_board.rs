//! [`Board`]: what is written on a view, and the paper that is taken there.

use kurbo::{Affine, BezPath, PathEl, Point, Rect, Shape as _, Vec2};

use super::paper_occupancy::{Clear, Kind, Occupancy, Shape};
use super::sheet_canvas::{Ink, Stand};
use crate::drawing::{Mark, Paint};
use crate::error::Error;
use crate::text::Font;

/// Clear paper around texts, and around lines that pass texts, mm.
pub(crate) const TEXT_CLEAR: f64 = 0.6;
pub(crate) const LINE_CLEAR: f64 = 0.4;

/// How far chords may be from curves whose paper is taken, mm.
const FLAT: f64 = 0.05;

/// A word that is set, its baseline beginning at zero.
pub(crate) struct Word {
    marks: Vec<Mark>,
    /// The box around its letters.
    pub bounds: Rect,
}

impl Word {
    /// The paper that it takes at a place.
    pub fn shape(&self, place: Affine) -> Shape {
        let turned = |v: Vec2| place * v.to_point() - place * Point::ZERO;
        let along = turned(Vec2::new(self.bounds.width() / 2.0, 0.0));
        let across = turned(Vec2::new(0.0, self.bounds.height() / 2.0));
        Shape::turned(place * self.bounds.center(), along, across)
    }

    /// The place that has the middle of its letters at a point.
    pub fn centred(&self, middle: Point) -> Affine {
        Affine::translate(middle - self.bounds.center())
    }
}

/// What is written on a view, and the paper that is taken there.
pub(crate) struct Board {
    pub ink: Ink,
    pub balloons: Ink,
    pub taken: Occupancy,
    /// Where lines of lengths must pass that have no place yet: texts keep clear of it.
    pub kept: Occupancy,
    /// What found no place.
    pub unplaced: Vec<String>,
}

impl Board {
    /// A view of which nothing is taken yet.
    pub fn new(font: &Font) -> Self {
        Self {
            ink: Ink::new(font, "note"),
            balloons: Ink::new(font, "balloon"),
            taken: Occupancy::default(),
            kept: Occupancy::default(),
            unplaced: Vec::new(),
        }
    }

    /// Sets a word whose capitals are so high.
    pub fn word(&self, words: &str, high: f64) -> Result<Word, Error> {
        self.word_within(words, high, 0.0)
    }

    /// The same, smaller where it would be wider than `most`.
    pub fn word_within(&self, words: &str, high: f64, most: f64) -> Result<Word, Error> {
        let mut ink = self.ink.emptied();
        ink.word(words, Point::ZERO, high, Stand::Left, most)?;
        let boxes = ink.marks.iter().map(|mark| mark.path.bounding_box());
        let bounds = boxes.reduce(|a, b| a.union(b)).unwrap_or_default();
        Ok(Word { marks: ink.marks, bounds })
    }

    /// Whether there is clear paper for a word at a place.
    pub fn is_free(&self, word: &Word, place: Affine) -> bool {
        let shape = word.shape(place).wider(TEXT_CLEAR);
        self.taken.is_free(&shape, Clear::All) && self.kept.is_free(&shape, Clear::All)
    }

    /// Writes a word at a place.
    pub fn write(&mut self, word: &Word, place: Affine) {
        self.taken.take(word.shape(place), Kind::Solid);
        self.ink.marks.extend(stamped(word, place));
    }

    /// Writes a word of a balloon at a place.
    pub fn write_in_balloon(&mut self, word: &Word, place: Affine) {
        self.balloons.marks.extend(stamped(word, place));
    }

    /// Whether a line may run there.
    pub fn is_line_free(&self, a: Point, b: Point, clear: Clear) -> bool {
        self.taken.is_free(&Shape::line(a, b, 0.0).wider(LINE_CLEAR), clear)
    }

    /// Draws a line.
    pub fn line(&mut self, a: Point, b: Point, width: f64, kind: Kind) {
        self.ink.line(a, b, width);
        self.taken.take(Shape::line(a, b, width), kind);
    }

    /// The paper of the head of an arrow.
    pub fn head(tip: Point, towards: Vec2, length: f64) -> Shape {
        let back = -towards * (length / towards.hypot2().sqrt().max(f64::MIN_POSITIVE));
        let side = Vec2::new(-back.y, back.x) * 0.268;
        Shape::triangle([tip, tip + back + side, tip + back - side])
    }

    /// Draws the head of an arrow.
    pub fn arrow(&mut self, tip: Point, towards: Vec2, length: f64) {
        self.ink.arrow(tip, towards, length);
        self.taken.take(Self::head(tip, towards, length), Kind::Arrow);
    }

    /// Takes the paper of a path.
    pub fn take_path(&mut self, path: &BezPath, width: f64, kind: Kind) {
        flat_lines(path, |a, b| self.taken.take(Shape::line(a, b, width), kind));
    }

    /// The box around all that is written.
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

/// Calls a function with each chord of a path.
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
