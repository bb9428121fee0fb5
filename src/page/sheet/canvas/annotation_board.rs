//! [`AnnotationBoard`]: the annotations of a view, and the paper that they occupy.
//!
//! Everything drawn on a board also occupies its paper, so later annotations avoid it. Balloons are drawn on
//! a separate canvas, because they form their own layer.

use kurbo::{Affine, BezPath, PathEl, Point, Rect, Shape as _, Vec2};

use super::paper_occupancy::{Clearance, ConvexShape, Occupancy, OccupantKind};
use super::sheet_canvas::{SheetCanvas, WordAnchor, arrow_corners};
use crate::drawing::{Mark, Paint};
use crate::error::Error;
use crate::text::Font;

/// Clearance around texts, and around lines that pass texts, mm.
pub(crate) const TEXT_CLEARANCE_MM: f64 = 0.6;
pub(crate) const LINE_CLEARANCE_MM: f64 = 0.4;

/// Tolerance of chords along curves that occupy paper, mm.
const CHORD_TOLERANCE_MM: f64 = 0.05;

/// A word as marks, with its baseline starting at the origin.
pub(crate) struct SetWord {
    marks: Vec<Mark>,
    /// Bounding box of its letters.
    pub bounds: Rect,
}

impl SetWord {
    /// The paper that the word occupies at a place.
    pub(crate) fn shape(&self, transform: Affine) -> ConvexShape {
        let transformed = |v: Vec2| transform * v.to_point() - transform * Point::ZERO;
        let half_width = transformed(Vec2::new(self.bounds.width() / 2.0, 0.0));
        let half_height = transformed(Vec2::new(0.0, self.bounds.height() / 2.0));
        ConvexShape::turned(transform * self.bounds.center(), half_width, half_height)
    }

    /// The place that centres the letters at a point.
    pub(crate) fn centred(&self, middle: Point) -> Affine {
        Affine::translate(middle - self.bounds.center())
    }
}

/// The annotations of a view, and the paper that they occupy.
pub(crate) struct AnnotationBoard {
    pub ink: SheetCanvas,
    pub balloons: SheetCanvas,
    pub taken: Occupancy,
    /// Reserved for extension lines that are placed later: texts avoid it.
    pub reserved: Occupancy,
    /// Descriptions of annotations that found no place.
    pub unplaced: Vec<String>,
}

impl AnnotationBoard {
    /// An empty board.
    pub(crate) fn new(font: &Font) -> Self {
        Self {
            ink: SheetCanvas::new(font, "note"),
            balloons: SheetCanvas::new(font, "balloon"),
            taken: Occupancy::default(),
            reserved: Occupancy::default(),
            unplaced: Vec::new(),
        }
    }

    /// Sets a word with a given height of capitals.
    pub(crate) fn word(&self, words: &str, height: f64) -> Result<SetWord, Error> {
        self.word_within(words, height, 0.0)
    }

    /// Sets a word, smaller if it would be wider than `max_width`; 0 sets no limit.
    pub(crate) fn word_within(&self, words: &str, height: f64, max_width: f64) -> Result<SetWord, Error> {
        let mut ink = self.ink.new_like();
        ink.word(words, Point::ZERO, height, WordAnchor::Left, max_width)?;
        let boxes = ink.marks.iter().map(|mark| mark.path.bounding_box());
        let bounds = boxes.reduce(|a, b| a.union(b)).unwrap_or_default();
        Ok(SetWord { marks: ink.marks, bounds })
    }

    /// Whether the paper for a word at a place is free and not reserved.
    pub(crate) fn is_free(&self, word: &SetWord, transform: Affine) -> bool {
        let shape = word.shape(transform).wider(TEXT_CLEARANCE_MM);
        self.taken.is_free(&shape, Clearance::All) && self.reserved.is_free(&shape, Clearance::All)
    }

    /// Adds a word at a place.
    pub(crate) fn write(&mut self, word: &SetWord, transform: Affine) {
        self.taken.take(word.shape(transform), OccupantKind::Solid);
        self.ink.marks.extend(placed_marks(word, transform));
    }

    /// Adds the number of a balloon at a place.
    pub(crate) fn write_in_balloon(&mut self, word: &SetWord, transform: Affine) {
        self.balloons.marks.extend(placed_marks(word, transform));
    }

    /// Whether a line fits between two points, with clearance.
    pub(crate) fn is_line_free(&self, a: Point, b: Point, clearance: Clearance) -> bool {
        self.taken.is_free(&ConvexShape::line(a, b, 0.0).wider(LINE_CLEARANCE_MM), clearance)
    }

    /// Adds a line.
    pub(crate) fn line(&mut self, a: Point, b: Point, width: f64, kind: OccupantKind) {
        self.ink.line(a, b, width);
        self.taken.take(ConvexShape::line(a, b, width), kind);
    }

    /// The paper of an arrow head with its tip at a point.
    pub(crate) fn head(tip: Point, towards: Vec2, length: f64) -> ConvexShape {
        ConvexShape::triangle(arrow_corners(tip, towards, length))
    }

    /// Adds an arrow head.
    pub(crate) fn arrow(&mut self, tip: Point, towards: Vec2, length: f64) {
        self.ink.arrow(tip, towards, length);
        self.taken.take(Self::head(tip, towards, length), OccupantKind::Arrow);
    }

    /// Marks the paper of a path as occupied.
    pub(crate) fn take_path(&mut self, path: &BezPath, width: f64, kind: OccupantKind) {
        for_each_chord(path, |a, b| self.taken.take(ConvexShape::line(a, b, width), kind));
    }

    /// Bounding box of all annotations, including line widths.
    pub(crate) fn extents(&self) -> Option<Rect> {
        let mark_bounds = |mark: &Mark| {
            let half_line_width =
                if let Paint::Stroke(stroke) = &mark.paint { stroke.width / 2.0 } else { 0.0 };
            mark.path.bounding_box().inflate(half_line_width, half_line_width)
        };
        self.ink.marks.iter().chain(&self.balloons.marks).map(mark_bounds).reduce(|a, b| a.union(b))
    }
}

fn placed_marks(word: &SetWord, transform: Affine) -> impl Iterator<Item = Mark> + '_ {
    word.marks.iter().map(move |mark| {
        let mut mark = mark.clone();
        mark.path.apply_affine(transform);
        if let Some(text) = &mut mark.provenance.text {
            text.place = transform * text.place;
        }
        mark
    })
}

/// Calls a function with each chord of a flattened path.
pub(crate) fn for_each_chord(path: &BezPath, mut each: impl FnMut(Point, Point)) {
    let (mut start, mut last) = (Point::ZERO, Point::ZERO);
    kurbo::flatten(path.iter(), CHORD_TOLERANCE_MM, |element| match element {
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
