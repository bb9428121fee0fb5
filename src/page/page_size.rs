//! [`PageSize`]: the trimmed size of a page, by name or as lengths.

use std::fmt;

use serde::de::{Error, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};

use super::mm_length::Mm;

/// Named sizes in portrait format: width and height, mm.
const NAMED_SIZES: [(&str, f64, f64); 17] = [
    ("A0", 841.0, 1189.0),
    ("A1", 594.0, 841.0),
    ("A2", 420.0, 594.0),
    ("A3", 297.0, 420.0),
    ("A4", 210.0, 297.0),
    ("A5", 148.0, 210.0),
    ("A6", 105.0, 148.0),
    ("B4", 250.0, 353.0),
    ("B5", 176.0, 250.0),
    ("JIS B4", 257.0, 364.0),
    ("JIS B5", 182.0, 257.0),
    ("US comic", 168.275, 260.35),
    ("US digest", 139.7, 215.9),
    ("Letter", 215.9, 279.4),
    ("Legal", 215.9, 355.6),
    ("Tabloid", 279.4, 431.8),
    ("square", 210.0, 210.0),
];

/// The trimmed size of a page in mm: a name (`"A4"`, `"US comic"`), `"170x260mm"` or `[170, 260]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PageSize {
    /// Width, mm.
    pub width: f64,
    /// Height, mm.
    pub height: f64,
}

impl Default for PageSize {
    /// A4 in portrait format.
    fn default() -> Self {
        Self { width: 210.0, height: 297.0 }
    }
}

impl PageSize {
    /// All named sizes.
    pub(crate) fn names() -> impl Iterator<Item = &'static str> {
        NAMED_SIZES.iter().map(|(name, ..)| *name)
    }

    /// The size with a name.
    pub(crate) fn named(text: &str) -> Option<Self> {
        let mut sizes = NAMED_SIZES.into_iter();
        let (_, width, height) = sizes.find(|(name, ..)| name.eq_ignore_ascii_case(text.trim()))?;
        Some(Self { width, height })
    }

    /// Parses a name or `170x260mm`.
    #[must_use]
    pub(crate) fn parse(text: &str) -> Option<Self> {
        if let Some(size) = Self::named(text) {
            return Some(size);
        }
        let (width, height) = text.split_once(['x', 'X', '×'])?;
        let unit = height.trim().trim_start_matches(|c: char| !c.is_ascii_alphabetic());
        let bare = width.trim().ends_with(|c: char| c.is_ascii_digit() || c == '.');
        let width = if bare { Mm::parse(&format!("{}{unit}", width.trim())) } else { Mm::parse(width) };
        Some(Self { width: width?.0, height: Mm::parse(height)?.0 }).filter(Self::is_in_range)
    }

    /// The same size in landscape format.
    #[must_use]
    pub(crate) fn landscape(self) -> Self {
        Self { width: self.width.max(self.height), height: self.width.min(self.height) }
    }

    fn is_in_range(&self) -> bool {
        [self.width, self.height].into_iter().all(|side| (1.0..=20_000.0).contains(&side))
    }
}

impl<'de> Deserialize<'de> for PageSize {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(SizeVisitor)
    }
}

struct SizeVisitor;

impl<'de> Visitor<'de> for SizeVisitor {
    type Value = PageSize;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("the size of a page, such as \"A4\", \"170x260mm\" or [170, 260]")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<PageSize, E> {
        PageSize::parse(text).ok_or_else(|| {
            let names: Vec<&str> = PageSize::names().collect();
            E::custom(format!(
                "`{text}` is not a page size; write one of {}, or such as \"170x260mm\"",
                names.join(", ")
            ))
        })
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut sides: A) -> Result<PageSize, A::Error> {
        let wrong = || A::Error::custom("a size has two sides of 1 to 20000 mm; write such as [170, 260]");
        let width: Mm = sides.next_element()?.ok_or_else(wrong)?;
        let height: Mm = sides.next_element()?.ok_or_else(wrong)?;
        if sides.next_element::<Mm>()?.is_some() {
            return Err(wrong());
        }
        Some(PageSize { width: width.0, height: height.0 }).filter(PageSize::is_in_range).ok_or_else(wrong)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn page_sizes_are_parsed() {
        let sides = |text| PageSize::parse(text).map(|size| [size.width, size.height]);
        assert_eq!(sides("a4"), Some([210.0, 297.0]));
        assert_eq!(sides("us Comic"), Some([168.275, 260.35]));
        assert_eq!(sides("170x260"), Some([170.0, 260.0]));
        assert_eq!(sides("6.625x10.25in"), Some([6.625 * 25.4, 10.25 * 25.4]));
        assert_eq!([sides("0x5"), sides("A99"), sides("5")], [None; 3]);
    }
}
