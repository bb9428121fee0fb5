//! Numbers in unusual notation, and vertices that contain them.
//!
//! A word with a decimal comma or with a unit after the number is read as a number. A vertex with a
//! coordinate that cannot be read is invalid; faces and lines that use it are left out.

use glam::DVec3;

use super::Parser;
use crate::load::quoted_start;
use crate::load::text_cursor::Cursor;
use crate::scene::extent::coordinate_limits::is_drawable;

/// Suffixes that Visual C writes after `1.` for values that are not numbers.
const NAN_SUFFIXES: [&[u8]; 4] = [b"#QNAN", b"#SNAN", b"#IND", b"#INF"];

/// Maximum bytes of a word with a decimal comma.
const MAX_WORD_BYTES: usize = 200;

/// Meaning of a word in place of a number.
#[derive(Debug, Clone, Copy, PartialEq)]
enum UnusualWord {
    /// A number in a notation that OBJ does not have: a decimal comma, or a unit after it.
    Number(f64),
    /// A number, or NaN for a word such as `1.#QNAN`; possibly with a comment right after it.
    Usual(f64),
    /// Nothing: the line ends.
    Missing,
    /// Not a number.
    Unreadable,
}

impl Parser<'_> {
    /// Parses a vertex with more than three numbers, or with unusual ones.
    #[inline(never)]
    pub(crate) fn any_position(&mut self) {
        let place = self.cursor.clone();
        self.is_unplaced = false;
        let (x, y) = (self.coordinate(), self.coordinate());
        self.cursor.skip_blanks();
        let has_z = !self.cursor.at_line_end();
        self.out.flat_vertices += usize::from(!has_z && x.is_finite() && y.is_finite());
        let z = if has_z || !self.is_flat { self.coordinate() } else { 0.0 };
        let point = DVec3::new(x, y, z);
        if !is_drawable(point) {
            self.note_unplaced(&place, |_| "a coordinate is not a number, or too large".to_owned());
        }
        let id = self.position_count;
        self.add_position(point);
        self.cursor.skip_blanks();
        if !self.cursor.at_line_end() {
            self.colour(id);
        }
    }

    #[cold]
    fn colour(&mut self, id: usize) {
        let mut extra = [0.0_f32; 4];
        let mut count = 0;
        while !self.cursor.at_line_end() {
            let start = self.cursor.at;
            let Some(read) = self.cursor.number() else {
                let mut place = self.cursor.clone();
                self.odd_numbers.add(|| {
                    format!(
                        "line {}: `{}` after a vertex is ignored",
                        place.line(),
                        quoted_start(place.word())
                    )
                });
                return self.pass_line();
            };
            let value = self.checked_number(start, Some(read)) as f32;
            if let Some(slot) = extra.get_mut(count) {
                *slot = value;
            }
            count += 1;
            self.cursor.skip_blanks();
        }
        if count >= 3 {
            let [r, g, b, _] = extra;
            // Earlier vertices without a colour are white.
            self.out.colours.resize(id, [1.0; 3]);
            self.out.colours.push([r, g, b]);
        }
    }

    /// Next number of the line, for a texture coordinate or normal. Of an invalid word, the numeric start is
    /// read, or 0, with a warning.
    #[inline]
    pub(crate) fn number(&mut self) -> f64 {
        self.cursor.skip_blanks();
        let start = self.cursor.at;
        let read = self.cursor.number();
        self.checked_number(start, read)
    }

    /// Validates the number `read` at `start`; handles other words like [`Self::number`].
    #[inline]
    pub(crate) fn checked_number(&mut self, start: usize, read: Option<f64>) -> f64 {
        match read {
            Some(value) if self.cursor.at_word_end() && self.cursor.peek() != b'#' => value,
            _ => self.odd_number(start, read),
        }
    }

    #[cold]
    fn odd_number(&mut self, start: usize, read: Option<f64>) -> f64 {
        let from = Cursor { bytes: self.cursor.bytes, at: start };
        let value = match self.odd_word(start, read) {
            UnusualWord::Usual(value) => return value,
            UnusualWord::Number(value) => value,
            UnusualWord::Missing => {
                self.odd_numbers
                    .add(|| format!("line {}: a coordinate is missing and is read as 0", from.line()));
                return 0.0;
            }
            UnusualWord::Unreadable => read.unwrap_or(0.0),
        };
        self.note_odd(&from, value);
        value
    }

    fn note_odd(&mut self, from: &Cursor, value: f64) {
        self.odd_numbers.add(|| {
            let word = quoted_start(from.clone().word());
            format!("line {}: `{word}` is not a number and is read as {value}", from.line())
        });
    }

    /// Next coordinate of a vertex; NaN, with a warning, if it cannot be read.
    ///
    /// A guessed value would move a corner, and the error would not be visible in the drawing.
    #[inline]
    pub(crate) fn coordinate(&mut self) -> f64 {
        self.cursor.skip_blanks();
        let start = self.cursor.at;
        let read = self.cursor.number();
        match read {
            Some(value) if self.cursor.at_word_end() && self.cursor.peek() != b'#' => value,
            _ => self.odd_coordinate(start, read),
        }
    }

    #[cold]
    fn odd_coordinate(&mut self, start: usize, read: Option<f64>) -> f64 {
        let from = Cursor { bytes: self.cursor.bytes, at: start };
        match self.odd_word(start, read) {
            UnusualWord::Usual(value) => value,
            UnusualWord::Number(value) => {
                self.note_odd(&from, value);
                value
            }
            UnusualWord::Missing => {
                self.note_unplaced(&from, |_| "a coordinate is missing".to_owned());
                f64::NAN
            }
            UnusualWord::Unreadable => {
                let word = |at: &Cursor| format!("`{}` is not a number", quoted_start(at.clone().word()));
                self.note_unplaced(&from, word);
                f64::NAN
            }
        }
    }

    /// Records the present vertex, once, as invalid.
    fn note_unplaced(&mut self, at: &Cursor, what: impl FnOnce(&Cursor) -> String) {
        if !self.is_unplaced {
            self.is_unplaced = true;
            self.unplaced.add(|| format!("line {}: {}", at.line(), what(at)));
        }
    }

    /// Skips the word at `start`, with the number `read` at its beginning, and classifies it.
    fn odd_word(&mut self, start: usize, read: Option<f64>) -> UnusualWord {
        let rest = self.cursor.bytes.get(self.cursor.at..).unwrap_or_default();
        if let Some(value) = read.filter(|_| rest.starts_with(b"#")) {
            if !NAN_SUFFIXES.iter().any(|word| rest.starts_with(word)) {
                return UnusualWord::Usual(value);
            }
            self.cursor.skip_word();
            return UnusualWord::Usual(f64::NAN);
        }
        if (Cursor { bytes: self.cursor.bytes, at: start }).at_line_end() {
            return UnusualWord::Missing;
        }
        let end_of_number = self.cursor.at;
        self.cursor.skip_word();
        let word = self.cursor.bytes.get(start..self.cursor.at).unwrap_or_default();
        let tail = self.cursor.bytes.get(end_of_number..self.cursor.at).unwrap_or_default();
        match (read, tail.first()) {
            (Some(value), _) if !value.is_finite() => UnusualWord::Usual(f64::NAN),
            // Decimal comma of a localised program.
            (_, Some(b',')) => comma_number(word).map_or(UnusualWord::Unreadable, UnusualWord::Number),
            (Some(value), Some(_)) if is_unit(tail) => UnusualWord::Number(value),
            _ => UnusualWord::Unreadable,
        }
    }
}

/// Whether letters after a number are a unit, as in `3cm` or `1.5f`. Letters that may begin an exponent or
/// another base, as in `1e`, `0x` and `1d`, are not.
fn is_unit(tail: &[u8]) -> bool {
    let begins = tail.first().is_some_and(|c| !matches!(c.to_ascii_lowercase(), b'd' | b'e' | b'x'));
    begins && tail.iter().all(u8::is_ascii_alphabetic)
}

/// Number with a decimal comma, or with a comma after it.
fn comma_number(word: &[u8]) -> Option<f64> {
    let comma = word.iter().position(|b| *b == b',').filter(|_| word.len() <= MAX_WORD_BYTES)?;
    let mut copy = word.to_vec();
    match word.len() - comma {
        1 => _ = copy.pop(),
        _ => *copy.get_mut(comma)? = b'.',
    }
    let mut cursor = Cursor::new(&copy);
    cursor.number().filter(|_| cursor.at == copy.len())
}

/// Describes the number of faces and lines that were left out because of their corners.
pub(crate) fn left_out_sentence([faces, lines]: [u64; 2]) -> String {
    let counted = |n: u64, noun: &str| match n {
        0 => None,
        1 => Some(format!("1 {noun}")),
        _ => Some(format!("{n} {noun}s")),
    };
    match (counted(faces, "face"), counted(lines, "line")) {
        (None, None) => "no face or line has such a corner".to_owned(),
        (Some(only), None) | (None, Some(only)) => format!("{only} left out, with such a corner"),
        (Some(faces), Some(lines)) => format!("{faces} and {lines} left out, with such a corner"),
    }
}
