//! Numbers, and words where a number should stand: what other readers read, these do too.

use super::Parser;
use crate::load::shown;
use crate::load::text::Cursor;

/// What Visual C writes after `1.` where a number is none.
const NO_NUMBERS: [&[u8]; 4] = [b"#QNAN", b"#SNAN", b"#IND", b"#INF"];

impl Parser<'_> {
    /// The next number of the line; what is none is mended and told.
    #[inline]
    pub(super) fn number(&mut self) -> f64 {
        self.cursor.skip_blanks();
        let start = self.cursor.at;
        let read = self.cursor.number();
        self.settled(start, read)
    }

    /// What was read of the word at `start`, if that is all of the word, or else what to take it for.
    #[inline]
    pub(super) fn settled(&mut self, start: usize, read: Option<f64>) -> f64 {
        match read {
            Some(value) if self.cursor.at_word_end() && self.cursor.peek() != b'#' => value,
            _ => self.odd_number(start, read),
        }
    }

    /// A number for a word that is none: as much of it as can be read, or 0. Other readers do the same.
    #[cold]
    fn odd_number(&mut self, start: usize, read: Option<f64>) -> f64 {
        let rest = self.cursor.bytes.get(self.cursor.at..).unwrap_or_default();
        if let Some(value) = read.filter(|_| rest.starts_with(b"#")) {
            if !NO_NUMBERS.iter().any(|word| rest.starts_with(word)) {
                return value;
            }
            self.cursor.skip_word();
            return f64::NAN;
        }
        let mut from = Cursor { bytes: self.cursor.bytes, at: start };
        if from.at_line_end() {
            self.odd_numbers
                .add(|| format!("line {}: a coordinate is missing and is read as 0", from.line()));
            return 0.0;
        }
        self.cursor.skip_word();
        let value = match read {
            // A program of a country that writes commas for points.
            Some(_) if rest.starts_with(b",") => comma_number(self.cursor.bytes.get(start..self.cursor.at)),
            _ => None,
        };
        let value = value.or(read).unwrap_or(0.0);
        self.odd_numbers.add(|| {
            let line = from.line();
            format!("line {line}: `{}` is not a number and is read as {value}", shown(from.word()))
        });
        value
    }
}

/// A number whose decimal point is a comma; words of hundreds of bytes are none.
fn comma_number(word: Option<&[u8]>) -> Option<f64> {
    let word = word?;
    let comma = word.iter().position(|b| *b == b',')?;
    let mut copy = word.get(..word.len().min(200))?.to_vec();
    *copy.get_mut(comma)? = b'.';
    Cursor::new(&copy).number()
}
