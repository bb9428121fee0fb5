//! Largest distances between marks that count as equal, by layer and class.

use std::collections::BTreeMap;
use std::fmt;

use serde::de::{Error as _, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};

use super::label::Label;
use super::picture::{Picture, ShapeKind};
use crate::diff::tolerances::{MAX_DIFF_STEP_PX, MIN_SET_TOLERANCE_PX, SVG_PRECISION_OF_PAGE};
use crate::drawing::{Length, Unit};
use crate::error::Error;

/// Tolerances for all marks, and for some marks by name.
///
/// A name is a class such as `contour` or `tone-0`, a layer such as `hatching`, or `lines` or `fills`.
/// Classes take precedence over layers, and layers over `lines` and `fills`.
///
/// ```
/// use ligne::diff::Tolerances;
/// use ligne::drawing::Length;
///
/// assert_eq!(Tolerances::parse("0.1px")?.all, Some(Length::px(0.1)));
/// let two = Tolerances::parse("lines=0.05mm, fills=0.2mm")?;
/// assert_eq!(two.named["fills"], Length::mm(0.2));
/// # Ok::<(), ligne::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Tolerances {
    /// Default tolerance. `None`: twice the precision of the less precise drawing.
    pub all: Option<Length>,
    /// Tolerances by name.
    pub named: BTreeMap<String, Length>,
}

impl Tolerances {
    /// Parses `0.1px`, `lines=0.05mm,fills=0.2mm`, or both.
    ///
    /// # Errors
    /// If a part of the text is not a length, or has no name before its `=`.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let mut read = Self::default();
        for part in text.split(',') {
            let (name, length) =
                part.split_once('=').map_or((None, part), |(name, length)| (Some(name), length));
            read.put(name.map(str::trim), length)?;
        }
        Ok(read)
    }

    fn put(&mut self, name: Option<&str>, text: &str) -> Result<(), Error> {
        let remedy = "write a length such as 0.1px, or lines=0.05mm,fills=0.2mm";
        let length = Length::parse(text).filter(|length| length.value >= 0.0);
        let length = length
            .ok_or_else(|| Error::new(format!("`{}` is not a tolerance", text.trim())).remedy(remedy))?;
        match name {
            None | Some("all" | "default") => self.all = Some(length),
            Some("") => return Err(Error::new(format!("`={}` has no name", text.trim())).remedy(remedy)),
            Some(name) => {
                self.named.insert(name.to_owned(), length);
            }
        }
        Ok(())
    }

    /// Replaces tolerances by those set in `over`.
    #[must_use]
    pub fn with(mut self, over: Self) -> Self {
        self.all = over.all.or(self.all);
        self.named.extend(over.named);
        self
    }

    /// Tolerance of a mark in px; `fallback` if none applies.
    pub(crate) fn px(&self, label: &Label, tone: Option<u16>, kind: ShapeKind, fallback: f64) -> f64 {
        let family = match kind {
            ShapeKind::Line => "lines",
            ShapeKind::Region | ShapeKind::Clip => "fills",
        };
        let tone = tone.map(|tone| format!("tone-{tone}"));
        let classes = label.classes.iter().map(AsRef::as_ref).chain(tone.as_deref());
        let mut names = classes.chain([label.layer.as_ref(), family]);
        let named = names.find_map(|name| self.named.get(name));
        named
            .or(self.all.as_ref())
            .map_or(fallback, |length| length.in_unit(Unit::Px).max(fallback.min(MIN_SET_TOLERANCE_PX)))
    }

    /// Names that match no mark of the drawings.
    pub(crate) fn unused(&self, pictures: [&Picture; 2]) -> Vec<String> {
        let known = |name: &str| {
            matches!(name, "lines" | "fills")
                || pictures.iter().flat_map(|picture| picture.shapes.iter()).any(|shape| {
                    shape.label.layer.as_ref() == name
                        || shape.label.classes.iter().any(|class| class.as_ref() == name)
                        || shape.ink.tone.is_some_and(|tone| name == format!("tone-{tone}"))
                })
        };
        self.named.keys().filter(|name| !known(name)).cloned().collect()
    }
}

/// Default tolerance in px: twice the precision of the less precise drawing, or four times if only one
/// drawing has arcs. It is at least the precision of reading.
pub(crate) fn default_px(before: &Picture, after: &Picture) -> f64 {
    let step = before.step_px.max(after.step_px).min(MAX_DIFF_STEP_PX);
    let sides = [before.width, before.height, after.width, after.height];
    // If only one drawing has arcs, a program replaced curves by arcs. They are off by up to two and a half
    // units of the last decimal.
    let steps = if before.has_arcs == after.has_arcs { 2.0 } else { 4.0 };
    (steps * step).max(sides.into_iter().fold(0.0, f64::max) * SVG_PRECISION_OF_PAGE)
}

impl<'de> Deserialize<'de> for Tolerances {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ToleranceVisitor)
    }
}

/// Deserialises `"0.1px"`, `0.1` or `{ default = "0.1px", lines = "0.05mm" }`.
struct ToleranceVisitor;

impl<'de> Visitor<'de> for ToleranceVisitor {
    type Value = Tolerances;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(
            "a length such as \"0.1px\", or a table such as { lines = \"0.05mm\", fills = \"0.2mm\" }",
        )
    }

    fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<Tolerances, E> {
        Tolerances::parse(text).map_err(E::custom)
    }

    fn visit_f64<E: serde::de::Error>(self, px: f64) -> Result<Tolerances, E> {
        self.visit_str(&px.to_string())
    }

    fn visit_i64<E: serde::de::Error>(self, px: i64) -> Result<Tolerances, E> {
        self.visit_str(&px.to_string())
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Tolerances, A::Error> {
        let mut read = Tolerances::default();
        while let Some((name, length)) = map.next_entry::<String, Length>()? {
            let unit = length.unit.name();
            read.put(Some(&name), &format!("{}{unit}", length.value)).map_err(A::Error::custom)?;
        }
        Ok(read)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tolerance_of_the_most_specific_name_applies() -> Result<(), Error> {
        let read = Tolerances::parse("1px, lines=2px, hatching=3px, contour=4px")?;
        let label = |layer: &str, class: &str| Label {
            layer: layer.into(),
            classes: vec![class.into()],
            ..Label::default()
        };
        let px = |label: &Label, kind| read.px(label, None, kind, 0.02);
        assert_eq!(px(&label("hatching", "contour"), ShapeKind::Line), 4.0);
        assert_eq!(px(&label("hatching", "crease"), ShapeKind::Line), 3.0);
        assert_eq!(px(&label("lines", "crease"), ShapeKind::Line), 2.0);
        assert_eq!(px(&label("fills", ""), ShapeKind::Region), 1.0);
        assert_eq!(Tolerances::default().px(&label("", ""), None, ShapeKind::Line, 0.02), 0.02);
        Ok(())
    }

    #[test]
    fn tolerances_parse_from_text_and_tables() {
        for wrong in ["", "wide", "lines=", "=1px", "-1px", "lines=nan", "1px,,2px"] {
            assert!(Tolerances::parse(wrong).is_err(), "{wrong}");
        }
        #[derive(Deserialize)]
        struct Sheet {
            tolerance: Tolerances,
        }
        let read = |text: &str| toml::from_str::<Sheet>(text).map(|sheet| sheet.tolerance);
        let table = read("tolerance = { default = 0.1, lines = \"0.05mm\" }");
        assert_eq!(table.ok(), Tolerances::parse("0.1px,lines=0.05mm").ok());
        assert_eq!(read("tolerance = \"0.1px\"").ok(), Tolerances::parse("0.1").ok());
        assert!(read("tolerance = true").is_err());
    }
}
