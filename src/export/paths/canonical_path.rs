//! Writes a path as SVG path data in canonical form, so that equal shapes give equal text. Drawings can then
//! be compared line by line.
//!
//! 1. Coordinates are rounded to the written precision. All later steps use the rounded values, so text that
//!    is read back is already in canonical form.
//! 2. Pieces of zero length are dropped.
//! 3. Closed subpaths start at their least point, and solid lines run in the direction that sorts first.
//!    Which of these changes is allowed depends on how the path is painted ([`PathForm`]).

use std::cmp::Ordering;

use kurbo::{BezPath, PathEl, Point};

use super::path_data::PathWriter;
use super::path_piece::{PathPiece, PathPoint, PieceKind};
use crate::export::encoding::decimals::Decimals;

/// The changes to a path that do not affect how it is painted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PathForm {
    /// None, except dropping zero-length pieces: for dashes and pen plotters, which depend on start and
    /// direction.
    Kept,
    /// Start of closed subpaths, and direction: for solid lines.
    Stroked,
    /// Start of closed subpaths: for fills. Their direction is kept, because it distinguishes holes from
    /// islands.
    Filled,
}

/// Writes paths in canonical form, reusing its buffers from path to path.
#[derive(Debug)]
pub(crate) struct CanonicalWriter {
    decimals: Decimals,
    form: PathForm,
    /// Start of the current subpath; `None` between subpaths.
    begun: Option<PathPoint>,
    /// Current point.
    pen: PathPoint,
    /// Pieces of the current subpath.
    pieces: Vec<PathPiece>,
    /// Buffer for the reversed subpath.
    turned: Vec<PathPiece>,
    /// Start point of the path as written.
    first: Option<PathPoint>,
    /// Whether points of the path were dropped.
    lost: bool,
}

impl CanonicalWriter {
    pub(crate) fn new(decimals: Decimals) -> Self {
        Self {
            decimals,
            form: PathForm::Kept,
            begun: None,
            pen: PathPoint::default(),
            pieces: Vec::new(),
            turned: Vec::new(),
            first: None,
            lost: false,
        }
    }

    /// Rounds a point to the written precision.
    pub(crate) fn step(&self, point: Point) -> PathPoint {
        PathPoint { y: self.decimals.round(point.y), x: self.decimals.round(point.x) }
    }

    /// Writes the path data (`d`) of a path, and returns the start point as written; `None` for an empty
    /// path.
    pub(crate) fn write(&mut self, out: &mut Vec<u8>, path: &BezPath, form: PathForm) -> Option<PathPoint> {
        let mut writer = PathWriter::new(out, self.decimals);
        self.form = form;
        (self.begun, self.first, self.lost, self.pen) = (None, None, false, PathPoint::default());
        let none = PathPoint::default();
        for element in path.elements() {
            match *element {
                PathEl::MoveTo(to) => {
                    self.end(&mut writer, false);
                    self.pen = self.step(to);
                    self.begun = Some(self.pen);
                }
                PathEl::LineTo(to) => self.piece(PieceKind::Line, none, none, self.step(to)),
                PathEl::QuadTo(c, to) => self.piece(PieceKind::Quad, self.step(c), none, self.step(to)),
                PathEl::CurveTo(c1, c2, to) => {
                    self.piece(PieceKind::Cubic, self.step(c1), self.step(c2), self.step(to));
                }
                PathEl::ClosePath => self.end(&mut writer, true),
            }
        }
        self.end(&mut writer, false);
        self.first
    }

    /// Whether points of the last path were dropped. A file may have had markers there.
    #[cfg(feature = "diff")]
    pub(crate) fn has_lost_points(&self) -> bool {
        self.lost
    }

    /// Adds a piece to the current subpath unless it has no length.
    fn piece(&mut self, kind: PieceKind, c1: PathPoint, c2: PathPoint, to: PathPoint) {
        // Segments after a close without a move start where the closed subpath started.
        self.begun.get_or_insert(self.pen);
        let piece = PathPiece { from: self.pen, to, kind, c1, c2 };
        if piece.has_no_length() {
            self.lost = true;
        } else {
            self.pieces.push(piece);
        }
        self.pen = to;
    }

    /// Ends the current subpath, if any, and writes it.
    fn end(&mut self, writer: &mut PathWriter, closed: bool) {
        let Some(start) = self.begun.take() else { return };
        if closed {
            self.lost |=
                self.pen == start && self.pieces.last().is_some_and(|last| last.kind == PieceKind::Line);
            if self.pen != start {
                let none = PathPoint::default();
                let closing =
                    PathPiece { from: self.pen, to: start, kind: PieceKind::Line, c1: none, c2: none };
                self.pieces.push(closing);
            }
        }
        match (self.form, closed) {
            (PathForm::Kept, _) | (PathForm::Filled, false) => {}
            (PathForm::Stroked, false) => {
                let backwards = self.pieces.iter().rev().map(PathPiece::reversed);
                if backwards.cmp(self.pieces.iter().copied()) == Ordering::Less {
                    self.pieces.reverse();
                    self.pieces.iter_mut().for_each(|piece| *piece = piece.reversed());
                }
            }
            (PathForm::Filled, true) => rotate(&mut self.pieces),
            (PathForm::Stroked, true) => {
                self.turned.clear();
                self.turned.extend(self.pieces.iter().rev().map(PathPiece::reversed));
                rotate(&mut self.pieces);
                rotate(&mut self.turned);
                if self.turned < self.pieces {
                    std::mem::swap(&mut self.turned, &mut self.pieces);
                }
            }
        }
        let first = self.pieces.first().map_or(start, |piece| piece.from);
        self.first.get_or_insert(first);
        writer.subpath(first, &self.pieces, closed);
        self.pieces.clear();
        // The next segment starts at the original start, not at the rotated one.
        self.pen = start;
    }
}

/// Rotates a closed subpath to its least rotation, which starts at its least point.
fn rotate(pieces: &mut [PathPiece]) {
    let turns = least_rotation(pieces);
    pieces.rotate_left(turns);
}

/// Left rotation of a cycle that makes it lexicographically least, as a number of items, in linear time.
///
/// Two candidate starts are compared. Where they differ, the greater one and all starts up to that place are
/// discarded.
fn least_rotation<T: Ord>(cycle: &[T]) -> usize {
    let count = cycle.len();
    let (mut a, mut b, mut same) = (0, 1, 0);
    while a < count && b < count && same < count {
        match cycle[(a + same) % count].cmp(&cycle[(b + same) % count]) {
            Ordering::Equal => same += 1,
            order => {
                let out = if order == Ordering::Greater { &mut a } else { &mut b };
                *out += same + 1;
                if a == b {
                    b += 1;
                }
                same = 0;
            }
        }
    }
    a.min(b)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn canonical_form(text: &str, form: PathForm) -> String {
        let mut out = Vec::new();
        CanonicalWriter::new(Decimals::new(2)).write(&mut out, &BezPath::from_svg(text).unwrap(), form);
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn canonical_lines_begin_at_their_lesser_end() {
        for text in ["M5 5 L3 9 L1 2", "M1 2 L3 9 L5 5"] {
            assert_eq!(canonical_form(text, PathForm::Stroked), "M1 2l2 7 2-4");
        }
        assert_eq!(canonical_form("M9 1 C8 2 7 3 1 1", PathForm::Stroked), "M1 1c6 2 7 1 8 0");
        assert_eq!(canonical_form("M5 5 L3 9 L1 2", PathForm::Kept), "M5 5l-2 4-2-7");
        assert_eq!(canonical_form("M5 5 L3 9 L1 2", PathForm::Filled), "M5 5l-2 4-2-7");
    }

    #[test]
    fn canonical_rings_begin_at_their_least_point() {
        // A square written from every corner, in both directions, with and without its last side.
        let corners = ["1 1", "5 1", "5 4", "1 4"];
        for first in 0..4 {
            for step in [1, 3] {
                let at = |index: usize| corners[(first + index * step) % 4];
                for last in ["", " L"] {
                    let last = if last.is_empty() { String::new() } else { format!("{last}{}", at(0)) };
                    let text = format!("M{} L{} L{} L{}{last} Z", at(0), at(1), at(2), at(3));
                    assert_eq!(canonical_form(&text, PathForm::Stroked), "M1 1h4v3h-4z", "{text}");
                    let filled = if step == 1 { "M1 1h4v3h-4z" } else { "M1 1v3h4v-3z" };
                    assert_eq!(canonical_form(&text, PathForm::Filled), filled, "{text}");
                }
            }
        }
        // The order of subpaths is kept, and segments after a close start at the old start.
        assert_eq!(canonical_form("M5 5 L1 1 L9 1 Z L7 7", PathForm::Filled), "M1 1h8l-4 4zm4 4 2 2");
    }

    #[test]
    fn figure_of_eight_has_one_canonical_form() {
        let eight = ["2 2", "4 1", "4 3", "2 2", "0 3", "0 1"];
        let mut forms: Vec<String> = Vec::new();
        for first in 0..6 {
            for step in [1, 5] {
                let points: Vec<&str> = (0..6).map(|index| eight[(first + index * step) % 6]).collect();
                forms.push(canonical_form(&format!("M{}Z", points.join(" L")), PathForm::Stroked));
            }
        }
        forms.dedup();
        assert_eq!(forms.len(), 1, "{forms:?}");
        for (cycle, turns) in [("abab", 0), ("baba", 1), ("cabaab", 3), ("aaa", 0), ("", 0), ("b", 0)] {
            assert_eq!(least_rotation(cycle.as_bytes()), turns, "{cycle}");
        }
    }

    #[test]
    fn canonical_path_drops_segments_of_zero_length() {
        assert_eq!(canonical_form("M1 1 L1.001 1 L5 1 C5 1 5 1 5 1", PathForm::Stroked), "M1 1h4");
        assert_eq!(canonical_form("M1 1 L1.001 1 Z", PathForm::Stroked), "M1 1z");
        assert_eq!(canonical_form("M1 1 L1.001 1", PathForm::Filled), "M1 1h0");
        // A loop has equal ends but a nonzero length.
        assert_eq!(canonical_form("M1 1 C3 1 1 3 1 1", PathForm::Filled), "M1 1c2 0 0 2 0 0");
    }
}
