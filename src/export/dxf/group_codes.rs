//! [`GroupCodes`]: writer for the pairs of group code and value that a DXF file consists of.
//!
//! A pair is two lines of ASCII text: a whole number that states the meaning of the value, then the value.

/// Decimals of lengths. Millimetres need three, the precision of machines; drawings in metres need six.
const LENGTH_DECIMALS: usize = 6;

/// Text of a DXF file, or of a part of it.
#[derive(Default)]
pub(crate) struct GroupCodes(Vec<u8>);

impl GroupCodes {
    /// Writes a pair with a text value, which must be one line of ASCII.
    pub(crate) fn text(&mut self, code: u16, value: &str) {
        self.0.extend_from_slice(format!("{code}\r\n{value}\r\n").as_bytes());
    }

    pub(crate) fn whole(&mut self, code: u16, value: usize) {
        self.text(code, &value.to_string());
    }

    /// Writes a pair with the handle (id) of an object, in hexadecimal.
    pub(crate) fn handle(&mut self, code: u16, handle: u32) {
        self.text(code, &format!("{handle:X}"));
    }

    pub(crate) fn number(&mut self, code: u16, value: f64) {
        self.text(code, &number(value));
    }

    /// Writes a point on the page; `code` is the group code of x.
    pub(crate) fn point(&mut self, code: u16, [x, y]: [f64; 2]) {
        self.number(code, x);
        self.number(code + 10, y);
    }

    /// Writes a point of the page as a point in space, with z = 0. `code` is the group code of x.
    pub(crate) fn point_in_space(&mut self, code: u16, point: [f64; 2]) {
        self.point(code, point);
        self.number(code + 20, 0.0);
    }

    pub(crate) fn section(&mut self, name: &str) {
        self.text(0, "SECTION");
        self.text(2, name);
    }

    pub(crate) fn end_section(&mut self) {
        self.text(0, "ENDSEC");
    }

    pub(crate) fn extend(&mut self, other: &Self) {
        self.0.extend_from_slice(&other.0);
    }

    pub(crate) fn into_bytes(self) -> Vec<u8> {
        self.0
    }
}

/// Formats a number with a decimal point, because some readers take numbers without one as integers.
fn number(value: f64) -> String {
    let text = format!("{value:.LENGTH_DECIMALS$}");
    let short = text.trim_end_matches('0');
    let short = if short == "-0." { "0." } else { short };
    if short.ends_with('.') { format!("{short}0") } else { short.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::number;

    #[test]
    fn numbers_have_a_point_and_no_needless_zeros() {
        let cases = [
            (0.0, "0.0"),
            (-0.0, "0.0"),
            (1.5, "1.5"),
            (-2.0, "-2.0"),
            (-1e-9, "0.0"),
            (1.0 / 3.0, "0.333333"),
        ];
        for (value, text) in cases {
            assert_eq!(number(value), text);
        }
    }
}
