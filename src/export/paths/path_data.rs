//! Path data with relative, rounded coordinates, as short as the grammar of SVG allows.
//!
//! Every coordinate is rounded on the page, and differences are taken of the rounded values. So rounding
//! errors do not accumulate along a path.

use super::path_piece::{PathPiece, PathPoint, PieceKind};
use crate::export::encoding::decimals::Decimals;

/// Writer of the `d` of one path, subpath by subpath.
pub(crate) struct PathWriter<'a> {
    out: &'a mut Vec<u8>,
    decimals: Decimals,
    /// Current point.
    pen: PathPoint,
    /// The control point implied by the shorthand for cubic curves: the mirror image of the last one, or the
    /// current point after a line. `None` after a quadratic curve, where readers disagree.
    mirrored: Option<PathPoint>,
    /// Last command written, or the command implied now.
    command: u8,
    /// Whether the last number had a point; then a number with a leading point needs no blank.
    point_before: bool,
    /// Whether a move was written; the first one is absolute.
    moved: bool,
}

impl<'a> PathWriter<'a> {
    pub(crate) fn new(out: &'a mut Vec<u8>, decimals: Decimals) -> Self {
        let start = PathPoint::default();
        Self { out, decimals, pen: start, mirrored: None, command: 0, point_before: false, moved: false }
    }

    /// Writes a subpath of pieces with nonzero length. Pieces of a closed subpath return to its start.
    pub(crate) fn subpath(&mut self, start: PathPoint, pieces: &[PathPiece], closed: bool) {
        self.move_to(start);
        let drawn = match pieces {
            // Closing draws this line.
            [before @ .., last] if closed && last.kind == PieceKind::Line => before,
            all => all,
        };
        for piece in drawn {
            match piece.kind {
                PieceKind::Line => self.line_to(piece.to),
                PieceKind::Quad => self.quad_to(piece.c1, piece.to),
                PieceKind::Cubic => self.curve_to(piece.c1, piece.c2, piece.to),
            }
        }
        if closed {
            self.out.push(b'z');
            self.command = b'z';
            self.pen = start;
        } else if pieces.is_empty() {
            // A subpath of zero length is a dot, and needs a segment for its caps to be drawn.
            self.out.extend_from_slice(b"h0");
            self.command = b'h';
            self.point_before = false;
        }
    }

    fn move_to(&mut self, to: PathPoint) {
        if self.moved {
            self.out.push(b'm');
            self.pair_after_letter(to.x - self.pen.x, to.y - self.pen.y);
            // Pairs after a relative move are relative lines.
            self.command = b'l';
        } else {
            self.out.push(b'M');
            self.pair_after_letter(to.x, to.y);
            self.command = b'M';
        }
        self.moved = true;
        self.pen = to;
        self.mirrored = Some(to);
    }

    fn line_to(&mut self, to: PathPoint) {
        let (dx, dy) = (to.x - self.pen.x, to.y - self.pen.y);
        if dy == 0 {
            self.letter(b'h');
            self.number(dx);
        } else if dx == 0 {
            self.letter(b'v');
            self.number(dy);
        } else {
            self.letter(b'l');
            self.number(dx);
            self.number(dy);
        }
        self.mirrored = Some(to);
        self.pen = to;
    }

    fn quad_to(&mut self, c: PathPoint, to: PathPoint) {
        self.letter(b'q');
        self.relative(c);
        self.relative(to);
        self.pen = to;
        self.mirrored = None;
    }

    fn curve_to(&mut self, c1: PathPoint, c2: PathPoint, to: PathPoint) {
        if self.mirrored == Some(c1) {
            self.letter(b's');
        } else {
            self.letter(b'c');
            self.relative(c1);
        }
        self.relative(c2);
        self.relative(to);
        self.mirrored = Some(PathPoint { y: 2 * to.y - c2.y, x: 2 * to.x - c2.x });
        self.pen = to;
    }

    fn relative(&mut self, to: PathPoint) {
        self.number(to.x - self.pen.x);
        self.number(to.y - self.pen.y);
    }

    fn letter(&mut self, letter: u8) {
        if self.command != letter {
            self.out.push(letter);
            self.command = letter;
            self.point_before = false;
            // No blank before the first number.
            self.fresh();
        }
    }

    /// Marks that the first number after a command follows.
    fn fresh(&mut self) {
        self.command |= FIRST_NUMBER_FLAG;
    }

    fn pair_after_letter(&mut self, x: i64, y: i64) {
        self.fresh();
        self.number(x);
        self.number(y);
    }

    #[inline]
    fn number(&mut self, number: i64) {
        let decimals = self.decimals;
        if self.command & FIRST_NUMBER_FLAG != 0 {
            self.command &= !FIRST_NUMBER_FLAG;
        } else if number >= 0 && !(self.point_before && decimals.starts_with_point(number)) {
            self.out.push(b' ');
        }
        self.point_before = decimals.write(self.out, number);
    }
}

/// Flag of a command whose first number follows. Letters are ASCII and leave this bit free.
const FIRST_NUMBER_FLAG: u8 = 0x80;

#[cfg(test)]
mod tests {
    use kurbo::BezPath;

    use super::super::canonical_path::{CanonicalWriter, PathForm};
    use super::*;

    fn write_path(path: &BezPath, decimals: u8) -> String {
        let mut out = Vec::new();
        CanonicalWriter::new(Decimals::new(decimals)).write(&mut out, path, PathForm::Kept);
        String::from_utf8(out).unwrap()
    }

    fn rewritten_data(text: &str, decimals: u8) -> String {
        write_path(&BezPath::from_svg(text).unwrap(), decimals)
    }

    #[test]
    fn path_data_uses_short_commands() {
        for (read, written) in [
            ("M1 2 L3 4", "M1 2l2 2"),
            ("M1 2 L3 2 L7 2 L7 .5", "M1 2h2 4v-1.5"),
            ("M.5 .25 L1.25 .75", "M.5.25l.75.5"),
            ("M0 0 L1 1 L2 3 Z", "M0 0l1 1 1 2z"),
            ("M0 0 L5 0 L5 5 L0 0 Z", "M0 0h5v5z"),
            ("M0 0 L1 1 M5 5 L6 7", "M0 0l1 1m4 4 1 2"),
            ("M0 0 C1 0 2 1 2 2 C2 3 3 4 4 4", "M0 0c1 0 2 1 2 2s1 2 2 2"),
            ("M0 0 C0 0 1 1 2 0", "M0 0s1 1 2 0"),
            ("M0 0 L1 0 C1 0 2 1 2 2", "M0 0h1s1 1 1 2"),
            ("M0 0 Q1 1 2 0 C2 0 3 1 4 1", "M0 0q1 1 2 0c0 0 1 1 2 1"),
            ("M0 0 Q1 1 2 0", "M0 0q1 1 2 0"),
            ("M1 1 L1.001 1", "M1 1h0"),
            ("M1 1", "M1 1h0"),
            ("M-1 -1 L-2 -3", "M-1-1l-1-2"),
            ("M0 0 L1 0 Z M5 5 L6 6", "M0 0h1zm5 5 1 1"),
        ] {
            assert_eq!(rewritten_data(read, 2), written);
        }
    }

    #[test]
    fn rounding_does_not_add_up() {
        let mut path = BezPath::new();
        path.move_to((0.0, 0.0));
        for i in 1..=1000 {
            path.line_to((f64::from(i) * 0.0149, f64::from(i % 2)));
        }
        let read = BezPath::from_svg(&write_path(&path, 2)).unwrap();
        let end = read.current_position().unwrap();
        assert!((end.x - 14.9).abs() < 0.005 + 1e-9, "{}", end.x);
    }
}
