//! Numbers in unusual notation, and vertices that contain them.
//!
//! A word with a decimal comma or with a unit after the number is read as a number. A vertex with a
//! coordinate that cannot be read is invalid; faces and lines that use it are left out.

use glam::DVec3;

use super::Parser;
use crate::load::shown;
use crate::load::text_cursor::Cursor;
use crate::scene::extent::coordinate_limits::is_drawable;

/// Suffixes that Visual C writes after `1.` for values that are not numbers.
const NO_NUMBERS: [&[u8]; 4] = [b"#QNAN", b"#SNAN", b"#IND", b"#INF"];

/// Maximum bytes of a word with a decimal comma.
const LONGEST_WORD: usize = 200;

/// Meaning of a word in place of a number.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Odd {
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
                    format!("line {}: `{}` after a vertex is ignored", place.line(), shown(place.word()))
                });
                return self.pass_line();
            };
            let value = self.settled(start, Some(read)) as f32;
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
        self.settled(start, read)
    }

    /// Validates the number `read` at `start`; handles other words like [`Self::number`].
    #[inline]
    pub(crate) fn settled(&mut self, start: usize, read: Option<f64>) -> f64 {
        match read {
            Some(value) if self.cursor.at_word_end() && self.cursor.peek() != b'#' => value,
            _ => self.odd_number(start, read),
        }
    }

    #[cold]
    fn odd_number(&mut self, start: usize, read: Option<f64>) -> f64 {
        let from = Cursor { bytes: self.cursor.bytes, at: start };
        let value = match self.odd_word(start, read) {
            Odd::Usual(value) => return value,
            Odd::Number(value) => value,
            Odd::Missing => {
                self.odd_numbers
                    .add(|| format!("line {}: a coordinate is missing and is read as 0", from.line()));
                return 0.0;
            }
            Odd::Unreadable => read.unwrap_or(0.0),
        };
        self.note_odd(&from, value);
        value
    }

    fn note_odd(&mut self, from: &Cursor, value: f64) {
        self.odd_numbers.add(|| {
            let word = shown(from.clone().word());
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
            Odd::Usual(value) => value,
            Odd::Number(value) => {
                self.note_odd(&from, value);
                value
            }
            Odd::Missing => {
                self.note_unplaced(&from, |_| "a coordinate is missing".to_owned());
                f64::NAN
            }
            Odd::Unreadable => {
                let word = |at: &Cursor| format!("`{}` is not a number", shown(at.clone().word()));
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
    fn odd_word(&mut self, start: usize, read: Option<f64>) -> Odd {
        let rest = self.cursor.bytes.get(self.cursor.at..).unwrap_or_default();
        if let Some(value) = read.filter(|_| rest.starts_with(b"#")) {
            if !NO_NUMBERS.iter().any(|word| rest.starts_with(word)) {
                return Odd::Usual(value);
            }
            self.cursor.skip_word();
            return Odd::Usual(f64::NAN);
        }
        if (Cursor { bytes: self.cursor.bytes, at: start }).at_line_end() {
            return Odd::Missing;
        }
        let end_of_number = self.cursor.at;
        self.cursor.skip_word();
        let word = self.cursor.bytes.get(start..self.cursor.at).unwrap_or_default();
        let tail = self.cursor.bytes.get(end_of_number..self.cursor.at).unwrap_or_default();
        match (read, tail.first()) {
            (Some(value), _) if !value.is_finite() => Odd::Usual(f64::NAN),
            // Decimal comma of a localised program.
            (_, Some(b',')) => comma_number(word).map_or(Odd::Unreadable, Odd::Number),
            (Some(value), Some(_)) if is_unit(tail) => Odd::Number(value),
            _ => Odd::Unreadable,
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
    let comma = word.iter().position(|b| *b == b',').filter(|_| word.len() <= LONGEST_WORD)?;
    let mut copy = word.to_vec();
    match word.len() - comma {
        1 => _ = copy.pop(),
        _ => *copy.get_mut(comma)? = b'.',
    }
    let mut cursor = Cursor::new(&copy);
    cursor.number().filter(|_| cursor.at == copy.len())
}

/// Describes the number of faces and lines that were left out because of their corners.
pub(crate) fn left_out([faces, lines]: [u64; 2]) -> String {
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
