//! Reads the rows of a PLY body, in text or binary.

use super::header::{Element, Encoding};
use crate::error::Error;
use crate::load::quoted_start;
use crate::load::text_cursor::Cursor;

/// Values of one row, property by property.
#[derive(Default)]
pub(crate) struct RowValues {
    values: Vec<f64>,
    /// End of each property in `values`.
    ends: Vec<usize>,
}

impl RowValues {
    /// Values of a property.
    pub(crate) fn list(&self, property: usize) -> &[f64] {
        let start = property.checked_sub(1).and_then(|p| self.ends.get(p)).copied().unwrap_or(0);
        let end = self.ends.get(property).copied().unwrap_or(start);
        self.values.get(start..end).unwrap_or_default()
    }

    /// Value of a property that is not a list.
    pub(crate) fn value(&self, property: usize) -> f64 {
        self.list(property).first().copied().unwrap_or(0.0)
    }
}

/// Reading position in a body.
pub(crate) struct ElementReader<'a> {
    pub cursor: Cursor<'a>,
    pub encoding: Encoding,
}

impl<'a> ElementReader<'a> {
    /// Bytes not yet read.
    pub(crate) fn rest(&self) -> &'a [u8] {
        self.cursor.bytes.get(self.cursor.at..).unwrap_or_default()
    }

    /// Returns an error if the rest of the file is too short for the announced rows. Call it before
    /// allocating memory.
    pub(crate) fn check_count(&self, element: &Element) -> Result<usize, Error> {
        let least = element.least_size(self.encoding) as u64;
        let rest = self.rest().len() as u64 + u64::from(self.encoding == Encoding::Text);
        if element.count.checked_mul(least).is_none_or(|needed| needed > rest) {
            let Element { count, name, .. } = element;
            let message =
                format!("{count} rows of {name} do not fit into the {} bytes left", self.rest().len());
            return Err(Error::new(message).at(format!("element {name}")).remedy("the file is truncated"));
        }
        // Rows without properties take no space.
        Ok(if least == 0 { 0 } else { element.count as usize })
    }

    /// Reads the next row; `number` counts from 0 and is used in errors.
    pub(crate) fn row(&mut self, element: &Element, number: usize, row: &mut RowValues) -> Result<(), Error> {
        row.values.clear();
        row.ends.clear();
        if self.encoding == Encoding::Text {
            self.text_row(element, number, row)
        } else {
            self.binary_row(element, number, row)
        }
    }

    /// Position of a row in errors: its line in a text file, and its number in a binary one. `start` is where
    /// the row starts.
    pub(crate) fn place(&self, mut start: Cursor, element: &Element, number: usize) -> String {
        if self.encoding == Encoding::Text {
            start.skip_space();
            format!("line {}", start.line())
        } else {
            place(element, number)
        }
    }

    fn binary_row(&mut self, element: &Element, number: usize, row: &mut RowValues) -> Result<(), Error> {
        for property in &element.properties {
            let mut length = 1;
            if let Some(kind) = property.list {
                let bytes = self.take(kind.size()).ok_or_else(|| cut_off(element, number))?;
                let stated = kind.read(bytes, self.encoding);
                // Memory is allocated only for lists that fit in the file.
                length = stated as usize;
                if stated < 0.0 || stated.fract() != 0.0 || length > self.rest().len() {
                    let message = format!("a list of {stated} does not fit into the file");
                    return Err(Error::new(message).at(place(element, number)));
                }
            }
            let size = property.kind.size();
            let bytes = length
                .checked_mul(size)
                .and_then(|n| self.take(n))
                .ok_or_else(|| cut_off(element, number))?;
            row.values.extend(bytes.chunks_exact(size).map(|b| property.kind.read(b, self.encoding)));
            row.ends.push(row.values.len());
        }
        Ok(())
    }

    fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let bytes = self.rest().get(..count)?;
        self.cursor.at += count;
        Some(bytes)
    }

    /// Reads a row of text, one line; the rest of the line is ignored.
    fn text_row(&mut self, element: &Element, number: usize, row: &mut RowValues) -> Result<(), Error> {
        self.cursor.skip_space();
        if self.cursor.at_end() {
            return Err(cut_off(element, number));
        }
        for property in &element.properties {
            let mut length = 1;
            if property.list.is_some() {
                let stated = self.number()?;
                length = stated as usize;
                if stated < 0.0 || stated.fract() != 0.0 || length > self.rest().len() {
                    return Err(self.at_line(format!("a list of {stated} does not fit into the file")));
                }
            }
            for _ in 0..length {
                let value = self.number()?;
                row.values.push(value);
            }
            row.ends.push(row.values.len());
        }
        self.cursor.rest_of_line();
        Ok(())
    }

    fn number(&mut self) -> Result<f64, Error> {
        self.cursor.skip_blanks();
        let number = self.cursor.number().filter(|_| self.cursor.at_end() || self.cursor.at_word_end());
        number.ok_or_else(|| {
            let word = self.cursor.clone().word();
            self.at_line(if word.is_empty() {
                "the line has too few values".into()
            } else {
                format!("`{}` is not a number", quoted_start(word))
            })
        })
    }

    fn at_line(&self, message: String) -> Error {
        Error::new(message).at(format!("line {}", self.cursor.line()))
    }
}

/// Name of a row in errors.
pub(crate) fn place(element: &Element, number: usize) -> String {
    format!("{} {number}", element.name)
}

/// Error for a file that ends within a row.
pub(crate) fn cut_off(element: &Element, number: usize) -> Error {
    let message = format!("the file ends in row {number} of {}", element.count);
    Error::new(message).at(format!("element {}", element.name)).remedy("it is cut off")
}
