//! [`StyleKey`]: a row of the table of keys, and the parser of the table.
//!
//! Format of `table.txt`, by the start of a line:
//!
//! - `@ title | prefixes` starts a section, whose keys exist under each prefix. The first prefix has the
//!   defaults, and the others inherit from it. `=` before a prefix gives it the same defaults.
//! - `! note` is a remark about the section.
//! - `name | type | default | values | unit | help` is a key; `-` stands for an empty cell.
//! - `#` starts a comment.

use std::sync::OnceLock;

/// Text of the table.
const TABLE_TEXT: &str = include_str!("table.txt");

/// A key of a style sheet.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct StyleKey {
    /// Dotted path, such as `lines.crease_deg`. A part that ends in `[]` is a list of tables:
    /// `hatching.layer[].angle`.
    pub path: String,
    /// Type of the value.
    pub kind: KeyType,
    /// The allowed words of a choice; for other types, words that are allowed in addition.
    pub words: Vec<&'static str>,
    /// Range of numbers, such as `0 to 180`; may be empty.
    pub range: &'static str,
    /// Default as TOML; `None` if the key inherits its value or has none.
    pub default: Option<&'static str>,
    /// The key whose value applies if this one is not set.
    pub inherits: Option<String>,
    /// Unit of a bare number; may be empty.
    pub unit: &'static str,
    /// One line of help.
    pub help: &'static str,
    /// Index of its section in [`StyleKey::sections`].
    pub section: usize,
    /// The prefix of its section; empty for top-level keys.
    pub prefix: &'static str,
    /// Name of the key within its section.
    pub name: &'static str,
}

/// Type of a key's value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum KeyType {
    /// `true` or `false`.
    Switch,
    /// A whole number.
    Whole,
    /// A list of whole numbers.
    Wholes,
    /// A number.
    Number,
    /// A list of numbers.
    Numbers,
    /// A length on the page: a number of px, or text with a unit.
    Length,
    /// A list of lengths.
    Lengths,
    /// One of some words.
    Choice,
    /// A list of some words.
    Choices,
    /// A colour.
    Colour,
    /// A list of colours, or the path of a picture.
    Colours,
    /// Rows of colours, or the path of a picture.
    Palette,
    /// A colour, or a shade of the material.
    Ink,
    /// A factor for a colour: a number, three numbers or a colour.
    Factor,
    /// Three numbers.
    Point,
    /// Text.
    Text,
    /// A name pattern with `*` and `?`.
    Name,
    /// A list of name patterns.
    Names,
    /// The path of a file.
    Path,
    /// SVG path data.
    Outline,
    /// A path, or a table of names and paths.
    Texture,
    /// A speed: model units per second, or a length on the page as a string.
    Speed,
    /// A table of further keys, or a word.
    Brush,
    /// A list of tables.
    Tables,
}

/// A section of the table: keys that belong together.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub(crate) struct KeySection {
    /// Its heading.
    pub title: &'static str,
    /// The tables that contain its keys; an empty string for the top level.
    pub prefixes: Vec<&'static str>,
    /// Remarks about all its keys; may be empty.
    pub note: &'static str,
}

impl KeyType {
    /// For each type its name in `table.txt`, and how to write a value.
    const TYPE_NAMES: [(Self, &'static str, &'static str); 24] = [
        (Self::Switch, "switch", "true or false"),
        (Self::Whole, "whole", "a whole number"),
        (Self::Wholes, "wholes", "a list of whole numbers, such as [0, 1]"),
        (Self::Number, "number", "a number"),
        (Self::Numbers, "numbers", "a list of numbers, such as [0.3, 0.7]"),
        (Self::Length, "length", "a number of px, or text with a unit such as \"0.35mm\""),
        (Self::Lengths, "lengths", "a list of lengths, such as [6, 4] or [\"2mm\", \"1mm\"]"),
        (Self::Choice, "choice", "one of these words"),
        (Self::Choices, "choices", "a list of these words"),
        (Self::Colour, "colour", "a colour such as \"#1a1a1a\" or \"teal\""),
        (Self::Colours, "colours", "a list of colours such as [\"#000\", \"#fff\"], or a picture's path"),
        (Self::Palette, "palette", "rows of colours such as [[\"#000\", \"#fff\"]], or a picture's path"),
        (Self::Ink, "ink", "a colour such as \"#1a1a1a\", or { shade = 0.5 }"),
        (Self::Factor, "factor", "a number, three numbers for red, green and blue, or a colour"),
        (Self::Point, "point", "three numbers, such as [0, 1, 0]"),
        (Self::Text, "text", "text in quotes"),
        (Self::Name, "name", "a name in quotes; * stands for any text"),
        (Self::Names, "names", "a list of names, such as [\"bolt*\"]"),
        (Self::Path, "path", "the path of a file, in quotes"),
        (Self::Outline, "outline", "SVG path data in quotes"),
        (Self::Texture, "texture", "the path of a picture, or a table of material names and paths"),
        (Self::Speed, "speed", "a number, or text with a unit of the page such as \"200px\""),
        (Self::Brush, "brush", "\"none\", or a table such as { path = \"M0 0L10 1L0 2Z\" }"),
        (Self::Tables, "tables", "a list of tables"),
    ];

    /// All types.
    pub fn all() -> impl Iterator<Item = Self> {
        Self::TYPE_NAMES.iter().map(|(kind, ..)| *kind)
    }

    fn row(self) -> &'static (Self, &'static str, &'static str) {
        Self::TYPE_NAMES.iter().find(|(kind, ..)| *kind == self).unwrap_or(&Self::TYPE_NAMES[0])
    }

    /// Name of the type in the table.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.row().1
    }

    /// How to write a value of this type.
    #[must_use]
    pub fn form(self) -> &'static str {
        self.row().2
    }
}

impl StyleKey {
    /// All keys, in the order of the reference.
    #[must_use]
    pub fn all() -> &'static [Self] {
        &table().1
    }

    /// The sections of the table, in the same order.
    #[must_use]
    pub(crate) fn sections() -> &'static [KeySection] {
        &table().0
    }

    /// The key at a path. Paths from a sheet omit `[]`.
    #[must_use]
    pub fn find(path: &str) -> Option<&'static Self> {
        Self::all().iter().find(|key| key.path == path || key.is_at(path))
    }

    /// Whether the path without `[]` equals `path`.
    fn is_at(&self, path: &str) -> bool {
        let mut rest = Some(path);
        for piece in self.path.split("[]") {
            rest = rest.and_then(|rest| rest.strip_prefix(piece));
        }
        rest == Some("")
    }

    /// The path without `[]`.
    #[must_use]
    pub fn bare_path(&self) -> String {
        self.path.replace("[]", "")
    }

    /// Whether `--set` can set the key: not if it is in a list of tables.
    #[must_use]
    pub fn is_settable(&self) -> bool {
        !self.path.contains("[]") && self.path != "extends"
    }

    /// The help text, followed by the allowed values.
    #[must_use]
    pub fn full_help(&self) -> String {
        let values = [self.values(), self.unit.to_owned()];
        let values: Vec<&str> = values.iter().map(String::as_str).filter(|text| !text.is_empty()).collect();
        match values[..] {
            [] => self.help.to_owned(),
            // The help text already contains these words.
            _ if self.kind == KeyType::Switch || self.values().starts_with("or ") => self.help.to_owned(),
            _ => format!("{} ({})", self.help, values.join(" ")),
        }
    }

    /// The allowed values in one line: words, or a range.
    #[must_use]
    pub fn values(&self) -> String {
        let words = self.words.join(", ");
        match (self.kind, self.range) {
            (KeyType::Choice | KeyType::Choices, _) => words,
            (KeyType::Switch, _) => "true, false".to_owned(),
            (_, "") if words.is_empty() => String::new(),
            (_, "") => format!("or {words}"),
            (_, range) => range.to_owned(),
        }
    }
}

fn table() -> &'static (Vec<KeySection>, Vec<StyleKey>) {
    static TABLE: OnceLock<(Vec<KeySection>, Vec<StyleKey>)> = OnceLock::new();
    TABLE.get_or_init(|| parse(TABLE_TEXT))
}

/// Parses the table. Invalid lines are ignored; tests report them.
fn parse(text: &'static str) -> (Vec<KeySection>, Vec<StyleKey>) {
    let mut sections: Vec<KeySection> = Vec::new();
    let mut keys = Vec::new();
    // Rows of the current section. At its end they are expanded for each prefix.
    let mut rows: Vec<Vec<&'static str>> = Vec::new();
    for line in text.lines().chain(["@ | "]) {
        if let Some(head) = line.strip_prefix("@ ") {
            expand(&sections, &rows, &mut keys);
            rows.clear();
            let (title, prefixes) = head.split_once(" | ").unwrap_or((head, ""));
            let prefixes = prefixes.split_whitespace().map(|prefix| if prefix == "-" { "" } else { prefix });
            sections.push(KeySection { title, prefixes: prefixes.collect(), note: "" });
        } else if let Some(note) = line.strip_prefix("! ") {
            sections.iter_mut().last().into_iter().for_each(|section| section.note = note);
        } else if !line.starts_with('#') && line.contains(" | ") {
            rows.push(line.splitn(6, " | ").collect());
        }
    }
    sections.pop();
    for section in &mut sections {
        section.prefixes.iter_mut().for_each(|prefix| *prefix = prefix.trim_start_matches('='));
    }
    (sections, keys)
}

/// Adds the rows of the last section for each of its prefixes.
fn expand(sections: &[KeySection], rows: &[Vec<&'static str>], keys: &mut Vec<StyleKey>) {
    let Some(section) = sections.last() else { return };
    let first = section.prefixes.first().copied().unwrap_or_default();
    let joined = |prefix: &str, name: &str| match prefix {
        "" => name.to_owned(),
        _ => format!("{prefix}.{name}"),
    };
    for (number, prefix) in section.prefixes.iter().enumerate() {
        let own_defaults = number == 0 || prefix.starts_with('=');
        let prefix = prefix.trim_start_matches('=');
        for row in rows {
            let [name, kind, default, values, unit, help] = row[..] else { continue };
            let kind =
                KeyType::TYPE_NAMES.iter().find(|(_, known, _)| *known == kind).map(|(kind, ..)| *kind);
            let Some(kind) = kind else { continue };
            let given = |text: &'static str| Some(text).filter(|text| *text != "-");
            let values = given(values).unwrap_or_default();
            let is_range = values.contains(|c: char| c.is_ascii_digit()) || values == "any";
            let unit = match kind {
                KeyType::Length | KeyType::Lengths => "px",
                _ => given(unit).unwrap_or_default(),
            };
            // The fields of a brush are set together, so each table has its own defaults.
            let own_defaults = own_defaults || name.starts_with("brush.");
            let inherits = (!own_defaults).then(|| joined(first, name));
            let key = StyleKey {
                path: joined(prefix, name),
                kind,
                words: if is_range { Vec::new() } else { values.split_whitespace().collect() },
                range: if is_range { values } else { "" },
                default: given(default).filter(|_| own_defaults),
                inherits,
                unit,
                help,
                section: sections.len() - 1,
                prefix,
                name,
            };
            // A section may repeat a key of an earlier one with another default.
            let is_alone = section.prefixes.len() == 1;
            match keys.iter_mut().find(|other| is_alone && other.path == key.path) {
                Some(other) => *other = key,
                None => keys.push(key),
            }
        }
    }
}
