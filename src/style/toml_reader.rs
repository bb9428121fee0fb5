//! Deserialises options from TOML, with the position of each error.
//!
//! The text is parsed by `toml`. Its tables become a tree of [`TomlNode`]s with spans, and one small
//! deserialiser walks the tree.
//!
//! The deserialisers of `toml` give the same results. But with them the compiler instantiates the code of
//! every options table four times: for tables, values with spans, dates, and values without spans.

use std::borrow::Cow;
use std::fmt::Display;
use std::ops::Range;
use std::vec;

use serde::de::value::{MapAccessDeserializer, StringDeserializer};
use serde::de::{
    DeserializeOwned, DeserializeSeed, Deserializer, Error as _, MapAccess, SeqAccess, Unexpected, Visitor,
};
use serde::forward_to_deserialize_any;
use toml::de::{DeTable, DeValue};
use toml::{Spanned, Table, Value};

/// An error in a TOML text, with its byte range.
#[derive(Debug, Clone)]
pub(crate) struct TomlFault {
    message: String,
    span: Option<Range<usize>>,
}

impl TomlFault {
    pub(crate) fn message(&self) -> &str {
        &self.message
    }

    pub(crate) fn span(&self) -> Option<Range<usize>> {
        self.span.clone()
    }

    /// Sets the position, unless the error has one.
    fn at(self, span: &Option<Range<usize>>) -> Self {
        Self { span: self.span.or_else(|| span.clone()), ..self }
    }
}

impl Display for TomlFault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for TomlFault {}

impl serde::de::Error for TomlFault {
    fn custom<T: Display>(message: T) -> Self {
        Self { message: message.to_string(), span: None }
    }
}

impl From<toml::de::Error> for TomlFault {
    fn from(error: toml::de::Error) -> Self {
        Self { message: error.message().to_owned(), span: error.span() }
    }
}

/// Deserialises options from a TOML text.
pub(crate) fn from_text<T: DeserializeOwned>(text: &str) -> Result<T, TomlFault> {
    let document = DeTable::parse(text)?;
    let span = document.span();
    T::deserialize(TomlNode::table(document.into_inner(), span)?)
}

/// Deserialises options from a table without spans.
pub(crate) fn from_table<T: DeserializeOwned>(table: Table) -> Result<T, TomlFault> {
    T::deserialize(TomlNode::from(Value::Table(table)))
}

/// Deserialises options from a part of a parsed text.
#[cfg(feature = "page")]
pub(crate) fn from_value<T: DeserializeOwned>(value: Spanned<DeValue>) -> Result<T, TomlFault> {
    T::deserialize(TomlNode::spanned(value)?)
}

/// A value with its position in the text.
struct TomlNode {
    kind: TomlKind,
    span: Option<Range<usize>>,
}

enum TomlKind {
    Bool(bool),
    Integer(i64),
    Unsigned(u64),
    Float(f64),
    Text(String),
    Date,
    List(Vec<TomlNode>),
    Table(Vec<(TomlKey, TomlNode)>),
}

struct TomlKey {
    text: Cow<'static, str>,
    span: Option<Range<usize>>,
}

impl TomlNode {
    fn spanned(value: Spanned<DeValue>) -> Result<Self, TomlFault> {
        let span = value.span();
        let wrong = |message: &str| TomlFault { message: message.to_owned(), span: Some(span.clone()) };
        let kind = match value.into_inner() {
            DeValue::String(text) => TomlKind::Text(text.into_owned()),
            DeValue::Integer(digits) => match i64::from_str_radix(digits.as_str(), digits.radix()) {
                Ok(number) => TomlKind::Integer(number),
                Err(_) => u64::from_str_radix(digits.as_str(), digits.radix())
                    .map(TomlKind::Unsigned)
                    .map_err(|_| wrong("integer number overflowed"))?,
            },
            DeValue::Float(digits) => {
                let number: f64 = digits.as_str().parse().map_err(|_| wrong("not a number"))?;
                if number.is_infinite() && !digits.as_str().contains("inf") {
                    return Err(wrong("floating-point number overflowed"));
                }
                TomlKind::Float(number)
            }
            DeValue::Boolean(value) => TomlKind::Bool(value),
            DeValue::Datetime(_) => TomlKind::Date,
            DeValue::Array(items) => {
                TomlKind::List(items.into_iter().map(Self::spanned).collect::<Result<_, _>>()?)
            }
            DeValue::Table(table) => return Self::table(table, span),
        };
        Ok(Self { kind, span: Some(span) })
    }

    fn table(table: DeTable, span: Range<usize>) -> Result<Self, TomlFault> {
        let entry = |(key, value): (Spanned<_>, Spanned<DeValue>)| {
            let (span, key): (_, Cow<str>) = (key.span(), key.into_inner());
            Ok((TomlKey { text: Cow::Owned(key.into_owned()), span: Some(span) }, Self::spanned(value)?))
        };
        let entries = table.into_iter().map(entry).collect::<Result<_, TomlFault>>()?;
        Ok(Self { kind: TomlKind::Table(entries), span: Some(span) })
    }
}

impl From<Value> for TomlNode {
    fn from(value: Value) -> Self {
        let kind = match value {
            Value::String(text) => TomlKind::Text(text),
            Value::Integer(number) => TomlKind::Integer(number),
            Value::Float(number) => TomlKind::Float(number),
            Value::Boolean(value) => TomlKind::Bool(value),
            Value::Datetime(_) => TomlKind::Date,
            Value::Array(items) => TomlKind::List(items.into_iter().map(Self::from).collect()),
            Value::Table(table) => {
                let entry =
                    |(text, value)| (TomlKey { text: Cow::Owned(text), span: None }, Self::from(value));
                TomlKind::Table(table.into_iter().map(entry).collect())
            }
        };
        Self { kind, span: None }
    }
}

impl<'de> Deserializer<'de> for TomlNode {
    type Error = TomlFault;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, TomlFault> {
        let Self { kind, span } = self;
        let read = match kind {
            TomlKind::Bool(value) => visitor.visit_bool(value),
            TomlKind::Integer(number) => visitor.visit_i64(number),
            TomlKind::Unsigned(number) => visitor.visit_u64(number),
            TomlKind::Float(number) => visitor.visit_f64(number),
            TomlKind::Text(text) => visitor.visit_string(text),
            TomlKind::Date => Err(TomlFault::invalid_type(Unexpected::Other("a date"), &visitor)),
            TomlKind::List(items) => visitor.visit_seq(ListItems(items.into_iter())),
            TomlKind::Table(entries) => visitor.visit_map(TableEntries::new(entries)),
        };
        read.map_err(|fault| fault.at(&span))
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, TomlFault> {
        visitor.visit_some(self)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> Result<V::Value, TomlFault> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, TomlFault> {
        match fields {
            // `Spanned` requests its two ends and its value by three private names.
            [start, end, value] if name.starts_with("$__serde_spanned") => {
                let span = self.span.clone();
                let range = span.clone().unwrap_or_default();
                let place = |at: usize| Self { kind: TomlKind::Unsigned(at as u64), span: None };
                let key = |name| TomlKey { text: Cow::Borrowed(name), span: None };
                let entries =
                    vec![(key(start), place(range.start)), (key(end), place(range.end)), (key(value), self)];
                visitor.visit_map(TableEntries::new(entries)).map_err(|fault| fault.at(&span))
            }
            _ => self.deserialize_any(visitor),
        }
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        name: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, TomlFault> {
        let Self { kind, span } = self;
        let read = match kind {
            TomlKind::Text(text) => visitor.visit_enum(StringDeserializer::new(text)),
            TomlKind::Table(entries) => MapAccessDeserializer::new(TableEntries::new(entries))
                .deserialize_enum(name, variants, visitor),
            kind => Self { kind, span: span.clone() }.deserialize_any(visitor),
        };
        read.map_err(|fault| fault.at(&span))
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit unit_struct seq tuple
        tuple_struct map identifier ignored_any
    }
}

impl<'de> Deserializer<'de> for TomlKey {
    type Error = TomlFault;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, TomlFault> {
        match self.text {
            Cow::Borrowed(text) => visitor.visit_borrowed_str(text),
            Cow::Owned(text) => visitor.visit_string(text),
        }
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, TomlFault> {
        visitor.visit_enum(StringDeserializer::new(self.text.into_owned()))
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option unit unit_struct
        newtype_struct seq tuple tuple_struct map struct identifier ignored_any
    }
}

/// The items of a list.
struct ListItems(vec::IntoIter<TomlNode>);

impl<'de> SeqAccess<'de> for ListItems {
    type Error = TomlFault;

    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>, TomlFault> {
        self.0.next().map(|item| seed.deserialize(item)).transpose()
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.0.len())
    }
}

/// The entries of a table.
struct TableEntries {
    rest: vec::IntoIter<(TomlKey, TomlNode)>,
    /// The value of the key that was read last, with the position of the key.
    next: Option<(Option<Range<usize>>, TomlNode)>,
}

impl TableEntries {
    fn new(entries: Vec<(TomlKey, TomlNode)>) -> Self {
        Self { rest: entries.into_iter(), next: None }
    }
}

impl<'de> MapAccess<'de> for TableEntries {
    type Error = TomlFault;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, TomlFault> {
        let Some((key, value)) = self.rest.next() else { return Ok(None) };
        self.next = Some((key.span.clone(), value));
        let span = key.span.clone();
        seed.deserialize(key).map(Some).map_err(|fault| fault.at(&span))
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, TomlFault> {
        let (key, value) = self.next.take().ok_or_else(|| TomlFault::custom("a value without a key"))?;
        let span = value.span.clone().or(key);
        seed.deserialize(value).map_err(|fault| fault.at(&span))
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.rest.len())
    }
}

#[cfg(test)]
mod tests {
    use std::fmt::Debug;

    use serde::Deserialize;

    use super::*;

    #[derive(Debug, PartialEq, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Options {
        width: f64,
        #[serde(default)]
        kind: Option<Kind>,
        #[serde(default)]
        names: Vec<Spanned<String>>,
        #[serde(default)]
        nested: std::collections::BTreeMap<String, [u8; 2]>,
    }

    #[derive(Debug, PartialEq, Deserialize)]
    #[serde(rename_all = "lowercase")]
    enum Kind {
        Plain,
        Dotted(f64),
    }

    /// The result of `toml` for a text: the value, or the message and the position.
    fn expected<T: DeserializeOwned>(text: &str) -> Result<T, (String, Option<Range<usize>>)> {
        toml::from_str(text).map_err(|error| (error.message().to_owned(), error.span()))
    }

    fn assert_agrees_with_toml<T: DeserializeOwned + PartialEq + Debug>(text: &str) {
        let read = from_text::<T>(text).map_err(|fault| (fault.message().to_owned(), fault.span()));
        assert_eq!(read, expected::<T>(text), "{text}");
    }

    #[test]
    fn results_and_errors_match_toml() {
        for text in [
            "width = 1.5",
            "width = 2\nkind = \"plain\"\nnames = [\"a\", \"b\"]",
            "width = 1e3\nkind = { dotted = 3 }\n[nested]\na = [1, 2]\nb = [0x10, 0o7]",
            "width = inf",
            "",
            "width = \"wide\"",
            "width = 1\nhight = 2",
            "width = 1\nkind = \"dashed\"",
            "width = 1\nkind = { dotted = \"x\" }",
            "width = 1\nnames = [1]",
            "width = 1\nnames = \"a\"",
            "width = 1\n[nested]\na = [1, 300]",
            "width = 1\n[nested]\na = [1]",
            "width = 1\nwidth = 2",
            "width = ",
            "width = 99999999999999999999999999999999999999999",
        ] {
            assert_agrees_with_toml::<Options>(text);
        }
        assert!(from_text::<Options>("width = 2020-01-02").is_err());
    }

    #[test]
    fn built_in_sheets_parse_equally_as_text_and_table() {
        for name in crate::Style::names() {
            let text = crate::Style::sheet_text(name).unwrap();
            let table = toml::from_str::<Table>(text).unwrap();
            let sheet = from_text::<crate::style::tables::style_sheet::StyleSheet>(text).unwrap();
            let merged: crate::style::tables::style_sheet::StyleSheet = from_table(table).unwrap();
            assert_eq!(format!("{sheet:?}"), format!("{merged:?}"), "{name}");
        }
    }
}
