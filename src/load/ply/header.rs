//! Parses the header of a PLY file: its encoding and the elements of its body.

use crate::error::Error;
use crate::load::quoted_start;
use crate::load::text_cursor::{Cursor, decode};
use crate::scene::Warnings;
use crate::scene::warnings::WarningExamples;

/// Maximum words of a statement that are read; further words are ignored.
const MAX_STATEMENT_WORDS: usize = 6;

/// Encoding of the body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Encoding {
    Text,
    Little,
    Big,
}

/// Type of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ScalarType {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl ScalarType {
    fn parse(word: &[u8]) -> Option<Self> {
        Some(match word {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"float" | b"float32" => Self::F32,
            b"double" | b"float64" => Self::F64,
            _ => return None,
        })
    }

    /// Bytes of one number in a binary body.
    pub(crate) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    /// Value that represents 1 in a colour.
    pub(crate) fn full(self) -> f64 {
        match self {
            Self::I8 => 127.0,
            Self::U8 => 255.0,
            Self::I16 => 32_767.0,
            Self::U16 => 65_535.0,
            Self::I32 => 2_147_483_647.0,
            Self::U32 => 4_294_967_295.0,
            Self::F32 | Self::F64 => 1.0,
        }
    }

    /// Reads a number of this type at the start of some bytes; 0 if they are too few.
    #[inline]
    pub(crate) fn read(self, bytes: &[u8], encoding: Encoding) -> f64 {
        macro_rules! number {
            ($kind:ty) => {{
                let array = bytes.first_chunk().copied().unwrap_or_default();
                if encoding == Encoding::Big {
                    <$kind>::from_be_bytes(array)
                } else {
                    <$kind>::from_le_bytes(array)
                }
                .into()
            }};
        }
        match self {
            Self::I8 => number!(i8),
            Self::U8 => number!(u8),
            Self::I16 => number!(i16),
            Self::U16 => number!(u16),
            Self::I32 => number!(i32),
            Self::U32 => number!(u32),
            Self::F32 => number!(f32),
            Self::F64 => number!(f64),
        }
    }
}

/// Property of an element: a number or a list of numbers.
#[derive(Debug, Clone)]
pub(crate) struct Property {
    pub name: String,
    /// Type of the length, if it is a list.
    pub list: Option<ScalarType>,
    pub kind: ScalarType,
}

/// Rows with the same properties.
#[derive(Debug, Clone)]
pub(crate) struct Element {
    pub name: String,
    pub count: u64,
    pub properties: Vec<Property>,
}

impl Element {
    /// First property with one of these names.
    pub(crate) fn find(&self, names: &[&str]) -> Option<usize> {
        self.properties.iter().position(|p| names.contains(&p.name.as_str()))
    }

    /// Minimum bytes of a row.
    pub(crate) fn least_size(&self, encoding: Encoding) -> usize {
        match encoding {
            // A digit and a blank.
            Encoding::Text => 2 * self.properties.len(),
            _ => self.properties.iter().map(|p| p.list.unwrap_or(p.kind).size()).sum(),
        }
    }

    /// Byte offset of a property in a row, if no list comes before it.
    pub(crate) fn offset(&self, property: usize) -> Option<usize> {
        self.properties.iter().take(property).map(|p| p.list.is_none().then(|| p.kind.size())).sum()
    }
}

/// Content of the header.
#[derive(Debug, Clone)]
pub(crate) struct Header {
    pub encoding: Encoding,
    pub elements: Vec<Element>,
    /// Byte index of the body.
    pub body: usize,
    /// Things that were ignored.
    pub warnings: Warnings,
}

impl Header {
    /// Parses the header at the start of a file.
    pub(crate) fn parse(bytes: &[u8]) -> Result<Self, Error> {
        let mut cursor = Cursor::new(bytes);
        if cursor.rest_of_line() != b"ply" {
            return Err(Error::new("the file does not begin with `ply`")
                .at("line 1")
                .remedy("it is not a PLY file"));
        }
        // A binary body may begin with the byte of a newline, so the first line decides whether single
        // carriage returns end lines.
        let returns_only = cursor.peek() == b'\r' && cursor.peek_on(1) != b'\n';
        let pass_line_end = |cursor: &mut Cursor| {
            let both = !returns_only && (cursor.peek(), cursor.peek_on(1)) == (b'\r', b'\n');
            cursor.at += if both { 2 } else { 1 };
        };
        let mut encoding = None;
        let mut elements: Vec<Element> = Vec::new();
        let mut strange = WarningExamples::default();
        // Set after a line that is an element only if properties follow.
        let mut doubt: Option<(Cursor, &[u8])> = None;
        loop {
            pass_line_end(&mut cursor);
            if cursor.at_end() {
                return Err(Error::new("the header has no `end_header`").remedy("the file is truncated"));
            }
            let place = cursor.clone();
            let fail = |message: String| Err(Error::new(message).at(format!("line {}", place.line())));
            let line = cursor.rest_of_line();
            let words = line.split(u8::is_ascii_whitespace).filter(|w| !w.is_empty());
            let words: Vec<&[u8]> = words.take(MAX_STATEMENT_WORDS).collect();
            // Text after a statement does not describe the data.
            let (statement, remark) = words.split_at(words.len().min(length(&words)));
            if let [word, ..] = remark {
                strange.add(|| format!("line {}: `{}` is ignored", place.line(), quoted_start(word)));
            }
            if let (Some((place, line)), [b"property", ..]) = (&doubt, statement) {
                return Err(does_not_belong(place, line));
            }
            match *statement {
                [b"end_header"] => break,
                [b"format", name, version] => {
                    encoding = Some(match name {
                        b"ascii" => Encoding::Text,
                        b"binary_little_endian" => Encoding::Little,
                        b"binary_big_endian" => Encoding::Big,
                        _ => return fail(format!("`{}` is not a PLY format", quoted_start(name))),
                    });
                    if version != b"1.0" {
                        return fail(format!(
                            "version {} of PLY is not known; 1.0 is",
                            quoted_start(version)
                        ));
                    }
                }
                [b"element", name, count] => {
                    let Some(count) = std::str::from_utf8(count).ok().and_then(|c| c.parse().ok()) else {
                        return fail(format!("`{}` is not a number of rows", quoted_start(count)));
                    };
                    elements.push(Element { name: decode(name).into_owned(), count, properties: Vec::new() });
                    doubt = None;
                }
                [b"property", b"list", _, kind, name] | [b"property", kind, name] => {
                    let length = (statement.len() == 5).then(|| ScalarType::parse(statement[2]));
                    let (list, kind) = match (length, ScalarType::parse(kind)) {
                        (None, Some(kind)) => (None, kind),
                        (Some(Some(list)), Some(kind)) => (Some(list), kind),
                        (None, None) => return fail(format!("`{}` is not a type", quoted_start(kind))),
                        _ => return fail(format!("`{}` has an unknown type", quoted_start(line))),
                    };
                    let Some(element) = elements.last_mut() else {
                        return fail("a property without an element".into());
                    };
                    element.properties.push(Property { name: decode(name).into_owned(), list, kind });
                }
                [] | [b"comment" | b"obj_info", ..] => {}
                _ if is_statement(&words) => return Err(does_not_belong(&place, line)),
                // Other readers ignore unknown lines too.
                _ => {
                    if is_like_element(&words) {
                        doubt = Some((place.clone(), line));
                    }
                    strange.add(|| format!("line {}: `{}` is ignored", place.line(), quoted_start(line)));
                }
            }
        }
        let Some(encoding) = encoding else { return Err(Error::new("the header has no format")) };
        pass_line_end(&mut cursor);
        let mut warnings = Warnings::default();
        strange.warn(&mut warnings);
        Ok(Self { encoding, elements, body: cursor.at.min(bytes.len()), warnings })
    }
}

fn does_not_belong(place: &Cursor, line: &[u8]) -> Error {
    Error::new(format!("`{}` is not a header line", quoted_start(line))).at(format!("line {}", place.line()))
}

/// Number of words of a statement; all words of any other line.
fn length(words: &[&[u8]]) -> usize {
    match *words {
        [b"end_header", ..] => 1,
        [b"format" | b"element", ..] => 3,
        [b"property", b"list", ..] => 5,
        [b"property", ..] => 3,
        _ => words.len(),
    }
}

/// Whether a line is an incomplete statement about the data, or a property with a misspelt keyword. The body
/// could not be read without it.
fn is_statement(words: &[&[u8]]) -> bool {
    match *words {
        [b"format" | b"element" | b"property", ..] | [_, b"list", _, _, _] => true,
        [_, kind, _] => ScalarType::parse(kind).is_some(),
        _ => false,
    }
}

/// Whether a line may be an element with a misspelt keyword.
fn is_like_element(words: &[&[u8]]) -> bool {
    matches!(*words, [_, _, count] if count.iter().all(u8::is_ascii_digit))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(text: &str) -> String {
        Header::parse(text.as_bytes()).unwrap_err().to_string()
    }

    #[test]
    fn header_elements_and_properties_are_read() {
        let text = "ply\r\nformat binary_big_endian 1.0\r\ncomment a b\r\nelement vertex 3\r\nproperty double x\r\n\
                    property list uchar short l\r\nproperty int8 y\r\nend_header\r\n\n\n";
        let header = Header::parse(text.as_bytes()).unwrap();
        assert_eq!((header.encoding, header.body), (Encoding::Big, text.len() - 2));
        let element = &header.elements[0];
        assert_eq!((element.name.as_str(), element.count, element.find(&["q", "y"])), ("vertex", 3, Some(2)));
        assert_eq!(
            (element.least_size(Encoding::Big), element.offset(1), element.offset(2)),
            (10, Some(8), None)
        );
    }

    #[test]
    fn unknown_header_lines_are_ignored_with_a_warning() {
        let text = "ply  \r\nMade by hand\r\nformat ascii 1.0 \r\n\r\n  obj_info number of 3\r\nelement vertex 3  # corners\r\n\
                    comment\r\nquality\r\nproperty float x [mm]\r\n\tproperty float y\t\r\nend_header now\r\n1";
        let header = Header::parse(text.as_bytes()).unwrap();
        let element = &header.elements[0];
        assert_eq!((element.count, element.properties.len(), header.body), (3, 2, text.len() - 1));
        assert_eq!(header.warnings.lines(), ["line 2: `Made by hand` is ignored; 4 more like it"]);
    }

    #[test]
    fn header_lines_may_end_in_lf_crlf_or_cr() {
        for (text, body) in [
            ("ply\nformat ascii 1.0\r\nelement v 1\rend_header\r\n\n", 1),
            ("ply\r\nformat ascii 1.0\nelement v 1\r\nend_header\n\n", 1),
            ("ply\rformat ascii 1.0\relement v 1\rend_header\r\n", 1),
        ] {
            let header = Header::parse(text.as_bytes()).unwrap();
            assert_eq!((header.elements.len(), text.len() - header.body), (1, body), "{text:?}");
        }
    }

    #[test]
    fn header_errors_name_the_line() {
        for line in [
            "elment face 2\n\nproperty int x",
            "proprety float x",
            "Property list uchar int l",
            "element v",
            "property int",
        ] {
            let error = error(&format!("ply\nformat ascii 1.0\nelement vertex 3\n{line}\nend_header\n"));
            assert!(error.contains(&format!("line 4: `{}", &line[..9])), "{error}");
        }
        let free = "ply\nformat ascii 1.0\nelement vertex 3\nproperty int x\nMade in 2024\nelement face 1\nproperty int y\n\
                    end_header\n";
        assert_eq!(Header::parse(free.as_bytes()).unwrap().elements.len(), 2);
        assert!(error("plx").contains("line 1"));
        assert!(error("ply\nformat ascii 1.0\nelement vertex many").contains("line 3: `many`"));
        assert!(error("ply\nformat ascii 9.9\n").contains("line 2: version 9.9"));
        assert!(error("ply\nformat text 1.0\n").contains("`text`"));
        assert!(error("ply\nproperty int x\n").contains("line 2: a property without an element"));
        assert!(error("ply\nelement v 1\nproperty real x\n").contains("`real` is not a type"));
        assert!(error("ply\nformat ascii 1.0\nelement vertex 3").contains("end_header"));
        assert!(error("ply\nend_header\n").contains("format"));
    }
}
