//! Aspects that are left out of a comparison.

use std::sync::Arc;

use super::ink::{ShapeInk, ShapePaint};
use super::label::Label;
use super::picture::Shape;
use crate::colour::srgb::Colour;
use crate::drawing::{Cap, Join};
use crate::error::Error;

/// Properties of texts that are colours.
const COLOUR_PROPERTIES: [&str; 6] = ["fill", "stroke", "color", "opacity", "fill-opacity", "stroke-opacity"];

/// Aspects that are left out of a comparison.
///
/// ```
/// use ligne::diff::Ignore;
///
/// let ignore = Ignore::parse("labels, widths")?;
/// assert!(ignore.labels && ignore.widths && !ignore.colours && !ignore.text);
/// assert!(Ignore::parse("shapes").is_err());
/// # Ok::<(), ligne::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct Ignore {
    /// Parts, classes, layers, tones and the number of hiding surfaces.
    pub labels: bool,
    /// Colours of marks. Texts and embedded pictures still count.
    pub colours: bool,
    /// Line widths, dashes, ends and corners.
    pub widths: bool,
    /// Texts.
    pub text: bool,
}

impl Ignore {
    /// Parses a list such as `labels,widths`.
    ///
    /// # Errors
    /// If a word is not `labels`, `colours`, `widths` or `text`.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let mut ignore = Self::default();
        for word in text.split(',').map(str::trim) {
            match word {
                "labels" => ignore.labels = true,
                "colours" | "colors" => ignore.colours = true,
                "widths" => ignore.widths = true,
                "text" => ignore.text = true,
                _ => {
                    return Err(Error::new(format!("`{word}` cannot be ignored"))
                        .remedy("write labels, colours, widths or text, or several with commas between"));
                }
            }
        }
        Ok(ignore)
    }

    /// Ignores what either of two options ignores.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        Self {
            labels: self.labels || other.labels,
            colours: self.colours || other.colours,
            widths: self.widths || other.widths,
            text: self.text || other.text,
        }
    }

    /// The label without ignored aspects.
    pub(crate) fn label(self, label: &Label) -> Label {
        if self.labels { Label::default() } else { label.clone() }
    }

    /// The ink without ignored aspects.
    pub(crate) fn ink(self, ink: &ShapeInk) -> ShapeInk {
        let mut ink = ink.clone();
        if self.labels {
            (ink.tone, ink.invisibility) = (None, 0);
        }
        if self.colours && !ink.is_stand_in() {
            ink.paint = ShapePaint::Colour(Colour::BLACK);
        }
        if let Some(details) = ink.details.as_mut().filter(|_| self.colours) {
            let is_colour = |name: &String| COLOUR_PROPERTIES.contains(&name.as_str());
            if details.keys().any(is_colour) {
                Arc::make_mut(details).retain(|name, _| !is_colour(name));
            }
        }
        if self.widths {
            ink.width = ink.width.min(1.0);
            if ink.width > 0.0 {
                ink.width = 1.0;
            }
            ink.dash.clear();
            (ink.cap, ink.join) = (Cap::Butt, Join::Miter);
        }
        ink
    }

    /// Whether a changed property counts.
    pub(crate) fn counts(self, what: &str) -> bool {
        !match what {
            "part" | "class" | "layer" | "tone" | "hidden by" => self.labels,
            "colour" => self.colours,
            _ if COLOUR_PROPERTIES.contains(&what) => self.colours,
            "width" | "dash" | "ends" | "corners" => self.widths,
            _ => false,
        }
    }

    /// Whether a shape is ignored completely.
    pub(crate) fn leaves_out(self, shape: &Shape) -> bool {
        self.text && shape.ink.is_text()
    }
}
