//! Numbers, and words where a number should stand; vertices with one of them.
//!
//! A word is read if it says one number: with a decimal comma, or with a unit behind it. A vertex with a coordinate that says
//! none, or several, has no place, and what needs it as a corner is left out.

use glam::DVec3;

use super::Parser;
use crate::load::shown;
use crate::load::text_cursor::Cursor;
use crate::scene::extent::coordinate_limits::is_drawable;

/// What Visual C writes after `1.` where a number is none.
const NO_NUMBERS: [&[u8]; 4] = [b"#QNAN", b"#SNAN", b"#IND", b"#INF"];

/// Longer words are no numbers, in bytes.
const LONGEST_WORD: usize = 200;

/// What a word where a number should stand says.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Odd {
    /// A number, in another notation than that of OBJ: a decimal comma, or a unit behind it.
    Number(f64),
    /// A word for no number, such as `1.#QNAN`, or a comment right behind a number.
    Usual(f64),
    /// Nothing: the line ends.
    Missing,
    /// Neither.
    Unreadable,
}

impl Parser<'_> {
    /// A vertex whose statement has more than three usual numbers, or others.
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
            // White for those before it that have none.
            self.out.colours.resize(id, [1.0; 3]);
            self.out.colours.push([r, g, b]);
        }
    }

    /// The next number of the line, of a texture coordinate or a normal. A word that is none is read as far as it goes,
    /// or as 0, with a warning.
    #[inline]
    pub(crate) fn number(&mut self) -> f64 {
        self.cursor.skip_blanks();
        let start = self.cursor.at;
        let read = self.cursor.number();
        self.settled(start, read)
    }

    /// The number at `start`, of which `read` was read; as [`Self::number`] has it.
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

    /// The next coordinate of a vertex; NaN, with a warning, where none can be read.
    ///
    /// A guess would move the corner of a face, and nothing in the drawing would show it.
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

    /// Counts the vertex at hand, once, among those that have no place.
    fn note_unplaced(&mut self, at: &Cursor, what: impl FnOnce(&Cursor) -> String) {
        if !self.is_unplaced {
            self.is_unplaced = true;
            self.unplaced.add(|| format!("line {}: {}", at.line(), what(at)));
        }
    }

    /// Passes the word at `start`, of which `read` was read as a number, and says what it is.
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
            // A program of a country that writes commas for points.
            (_, Some(b',')) => comma_number(word).map_or(Odd::Unreadable, Odd::Number),
            (Some(value), Some(_)) if is_unit(tail) => Odd::Number(value),
            _ => Odd::Unreadable,
        }
    }
}

/// Whether letters behind a number name its unit, as in `3cm` or `1.5f`, and do not change its value: `1e`, `0x` and `1d`
/// begin an exponent or another base.
fn is_unit(tail: &[u8]) -> bool {
    let begins = tail.first().is_some_and(|c| !matches!(c.to_ascii_lowercase(), b'd' | b'e' | b'x'));
    begins && tail.iter().all(u8::is_ascii_alphabetic)
}

/// A number whose decimal point is a comma, or with a comma behind it; words of hundreds of bytes are none.
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

/// What is left out because of its corners: so many faces, and so many lines.
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
