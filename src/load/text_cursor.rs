//! [`Cursor`]: reads numbers, words and lines from the bytes of a text format, without copying.

use std::borrow::Cow;

/// Powers of ten that an `f64` represents exactly.
const EXACT_POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18,
    1e19, 1e20, 1e21, 1e22,
];

/// Powers of ten that shift a number by up to eight digits.
const DIGIT_SHIFTS: [u64; 9] = [1, 10, 100, 1_000, 10_000, 100_000, 1_000_000, 10_000_000, 100_000_000];

/// Integers below this are exact in an `f64`.
const MAX_EXACT_MANTISSA: u64 = 1 << 53;

/// Position in a text. After the end it reads newlines, so that every line ends.
#[derive(Clone)]
pub(crate) struct Cursor<'a> {
    /// The whole text.
    pub bytes: &'a [u8],
    /// Index of the next byte.
    pub at: usize,
}

impl<'a> Cursor<'a> {
    /// Starts at the beginning of a text, after a byte-order mark if there is one.
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        let at = if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
        Self { bytes, at }
    }

    /// Whether the end of the text is reached.
    #[inline]
    pub(crate) fn at_end(&self) -> bool {
        self.at >= self.bytes.len()
    }

    /// The next byte.
    #[inline]
    pub(crate) fn peek(&self) -> u8 {
        self.peek_on(0)
    }

    /// The byte `n` after the next.
    #[inline]
    pub(crate) fn peek_on(&self, n: usize) -> u8 {
        self.bytes.get(self.at + n).copied().unwrap_or(b'\n')
    }

    /// Skips blanks and tabs, and a backslash that continues the line.
    #[inline]
    pub(crate) fn skip_blanks(&mut self) {
        loop {
            match self.peek() {
                b' ' | b'\t' => self.at += 1,
                b'\\' if !self.skip_continuation() => return,
                b'\\' => {}
                _ => return,
            }
        }
    }

    #[cold]
    fn skip_continuation(&mut self) -> bool {
        let length = match (self.peek_on(1), self.peek_on(2)) {
            (b'\r', b'\n') => 3,
            (b'\n' | b'\r', _) => 2,
            _ => return false,
        };
        self.at += length;
        true
    }

    /// Skips blanks, tabs and line ends.
    #[inline]
    pub(crate) fn skip_space(&mut self) {
        while !self.at_end() && self.peek().is_ascii_whitespace() {
            self.at += 1;
        }
    }

    /// Whether the line ends here (or a comment begins).
    #[inline]
    pub(crate) fn at_line_end(&self) -> bool {
        matches!(self.peek(), b'\n' | b'\r' | b'#')
    }

    /// Whether a word ends here.
    #[inline]
    pub(crate) fn at_word_end(&self) -> bool {
        matches!(self.peek(), b' ' | b'\t' | b'\n' | b'\r' | b'#' | b'\\')
    }

    /// Moves to the end of the line and returns the rest of it, trimmed.
    pub(crate) fn rest_of_line(&mut self) -> &'a [u8] {
        let rest = self.bytes.get(self.at..).unwrap_or_default();
        let length = memchr::memchr2(b'\n', b'\r', rest).unwrap_or(rest.len());
        self.at += length;
        rest.get(..length).unwrap_or_default().trim_ascii()
    }

    /// Skips the rest of a word, at least one byte, so that parsing always advances.
    pub(crate) fn skip_word(&mut self) {
        self.at += 1;
        while !self.at_word_end() {
            self.at += 1;
        }
    }

    /// Next word of printing characters; empty at the end of a line.
    pub(crate) fn word(&mut self) -> &'a [u8] {
        let start = self.at;
        while !self.at_end() && !self.peek().is_ascii_whitespace() {
            self.at += 1;
        }
        self.bytes.get(start..self.at).unwrap_or_default()
    }

    /// Line number of `at`, counted from 1. Takes time in proportion to the text before it.
    pub(crate) fn line(&self) -> usize {
        let before = self.bytes.get(..self.at).unwrap_or(self.bytes);
        let newlines = memchr::memchr_iter(b'\n', before).count();
        let lone =
            memchr::memchr_iter(b'\r', before).filter(|i| self.bytes.get(i + 1) != Some(&b'\n')).count();
        1 + newlines + lone
    }

    /// Reads a number, correctly rounded; also `nan` and `inf`. If there is none, returns `None` and does not
    /// move.
    #[inline]
    pub(crate) fn number(&mut self) -> Option<f64> {
        if let Some((value, at)) = plain_number(self.bytes, self.at) {
            self.at = at;
            return Some(value);
        }
        self.any_number()
    }

    /// Reads numbers with exponents or long mantissas, and words.
    #[inline(never)]
    fn any_number(&mut self) -> Option<f64> {
        let start = self.at;
        let negative = self.sign();
        let mut mantissa = 0_u64;
        let whole = self.digits(&mut mantissa);
        let mut fraction = 0;
        if self.peek() == b'.' {
            self.at += 1;
            fraction = self.digits(&mut mantissa);
        }
        self.number_with_exponent(start, negative, mantissa, whole + fraction, fraction)
    }

    /// Rest of [`Cursor::number`]: exponents, long mantissas and words.
    fn number_with_exponent(
        &mut self,
        start: usize,
        negative: bool,
        mantissa: u64,
        digits: usize,
        fraction: usize,
    ) -> Option<f64> {
        if (1..=19).contains(&digits) && mantissa < MAX_EXACT_MANTISSA && matches!(self.peek(), b'e' | b'E') {
            let e = self.at;
            self.at += 1;
            let down = self.sign();
            let mut exponent = 0_u64;
            if (1..=4).contains(&self.digits(&mut exponent)) {
                let exponent = if down { -(exponent as i64) } else { exponent as i64 } - fraction as i64;
                let power = usize::try_from(exponent.unsigned_abs()).ok().and_then(|p| EXACT_POWERS.get(p));
                if let Some(power) = power {
                    let m = mantissa as f64;
                    let value = if exponent < 0 { m / power } else { m * power };
                    return Some(if negative { -value } else { value });
                }
            }
            self.at = e;
        }
        self.at = start;
        let signless = start + usize::from(matches!(self.peek(), b'+' | b'-'));
        let parsed = fast_float2::parse_partial::<f64, _>(self.bytes.get(signless..)?);
        let (value, length) = parsed.ok().filter(|&(v, n)| n > 0 && !v.is_sign_negative() || v.is_nan())?;
        self.at = signless + length;
        Some(if negative { -value } else { value })
    }

    /// Skips a sign; returns whether it was a minus.
    #[inline]
    fn sign(&mut self) -> bool {
        let c = self.peek();
        self.at += usize::from(c == b'-' || c == b'+');
        c == b'-'
    }

    /// Reads digits and appends them to `value`, which wraps; returns their number.
    #[inline]
    pub(crate) fn digits(&mut self, value: &mut u64) -> usize {
        let start = self.at;
        (*value, self.at) = digits(self.bytes, start, *value);
        self.at - start
    }

    /// Reads an integer, saturated to the range of `i64`. If there is none, returns `None` and does not move.
    #[inline]
    pub(crate) fn integer(&mut self) -> Option<i64> {
        let start = self.at;
        let negative = self.sign();
        let mut value = 0;
        let digits = self.digits(&mut value);
        if digits == 0 {
            self.at = start;
            return None;
        }
        let value = if digits > 18 { i64::MAX } else { value as i64 };
        Some(if negative { -value } else { value })
    }
}

/// Number of leading digits in eight bytes, and their value, without branches. The length of a number is
/// unpredictable, and a mispredicted branch would cost more than the digits.
///
/// Source: Lemire, *Number Parsing at a Gigabyte per Second*, 2021, section 6.
#[inline(always)]
fn leading_digits(bytes: [u8; 8]) -> (usize, u64) {
    let values = u64::from_le_bytes(bytes) ^ 0x3030_3030_3030_3030;
    // High bit of each byte above 9; carries only reach bytes after the first such byte.
    let others = (values.wrapping_add(0x7676_7676_7676_7676) | values) & 0x8080_8080_8080_8080;
    let count = others.trailing_zeros() / 8;
    // Shift the digits to the end; zeros take the place before them, in the least bytes.
    let digits = values.checked_shl(64 - 8 * count).unwrap_or(0);
    let pairs = digits.wrapping_mul(10).wrapping_add(digits >> 8);
    let high = (pairs & 0x0000_00ff_0000_00ff).wrapping_mul(0x000f_4240_0000_0064);
    let low = ((pairs >> 16) & 0x0000_00ff_0000_00ff).wrapping_mul(0x0000_2710_0000_0001);
    (count as usize, high.wrapping_add(low) >> 32)
}

/// Appends the digits at a position to `value`, which wraps; returns the result and the end.
#[inline(always)]
fn digits(bytes: &[u8], mut at: usize, mut value: u64) -> (u64, usize) {
    while let Some(eight) = bytes.get(at..).and_then(|b| b.first_chunk()) {
        let (count, number) = leading_digits(*eight);
        value = value.wrapping_mul(DIGIT_SHIFTS.get(count).copied().unwrap_or(1)).wrapping_add(number);
        at += count;
        if count < 8 {
            return (value, at);
        }
    }
    while let Some(digit) = bytes.get(at).map(|b| b.wrapping_sub(b'0')).filter(|&d| d <= 9) {
        value = value.wrapping_mul(10).wrapping_add(u64::from(digit));
        at += 1;
    }
    (value, at)
}

/// Number without exponent and with few digits, and its end; `None` for other notations.
#[inline(always)]
pub(crate) fn plain_number(bytes: &[u8], start: usize) -> Option<(f64, usize)> {
    let negative = *bytes.get(start)? == b'-';
    let first = start + usize::from(negative);
    let (mut mantissa, mut at) = digits(bytes, first, 0);
    let mut count = at - first;
    let mut fraction = 0;
    if bytes.get(at) == Some(&b'.') {
        let point = at + 1;
        (mantissa, at) = digits(bytes, point, mantissa);
        fraction = at - point;
        count += fraction;
    }
    // One division of two exact numbers is rounded once, so the result is correct.
    let exact = count.wrapping_sub(1) < 19 && mantissa < MAX_EXACT_MANTISSA;
    if !exact || matches!(bytes.get(at), Some(b'e' | b'E')) {
        return None;
    }
    let value = mantissa as f64 / EXACT_POWERS.get(fraction)?;
    Some((if negative { -value } else { value }, at))
}

/// Digits after one or more blanks: their value, and their end.
#[inline(always)]
pub(crate) fn plain_index(bytes: &[u8], mut start: usize) -> Option<(u64, usize)> {
    while *bytes.get(start)? == b' ' {
        start += 1;
    }
    let (value, at) = digits(bytes, start, 0);
    ((at - start).wrapping_sub(1) < 18).then_some((value, at))
}

/// Converts text to UTF-8 if it begins with the byte-order mark of UTF-16.
///
/// Unpaired surrogates become U+FFFD; half a unit at the end is ignored.
pub(crate) fn utf8(bytes: &[u8]) -> Cow<'_, [u8]> {
    let unit = match bytes {
        [0xff, 0xfe, ..] => u16::from_le_bytes,
        [0xfe, 0xff, ..] => u16::from_be_bytes,
        _ => return Cow::Borrowed(bytes),
    };
    let units = bytes.as_chunks().0.iter().skip(1).map(|pair| unit(*pair));
    let characters = char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER));
    Cow::Owned(characters.collect::<String>().into_bytes())
}

/// Decodes text as UTF-8, or else as Latin-1.
pub(crate) fn decode(bytes: &[u8]) -> Cow<'_, str> {
    match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(bytes.iter().map(|&b| char::from(b)).collect()),
    }
}

#[cfg(test)]
mod tests;
