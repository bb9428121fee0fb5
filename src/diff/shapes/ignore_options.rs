//! [`Ignore`]: what does not count where drawings are compared.

use std::sync::Arc;

use super::ink::{Ink, Paint};
use super::label::Label;
use super::picture::Shape;
use crate::colour::srgb::Colour;
use crate::drawing::{Cap, Join};
use crate::error::Error;

/// Properties of texts that are colours.
const COLOURS: [&str; 6] = ["fill", "stroke", "color", "opacity", "fill-opacity", "stroke-opacity"];

/// What does not count.
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
    /// Parts, classes, layers, tones and how many surfaces hide a line: what the file says of its marks.
    pub labels: bool,
    /// What marks are painted with; texts and pictures still count.
    pub colours: bool,
    /// Widths of lines, and with them dashes, ends and corners: the pen.
    pub widths: bool,
    /// Texts.
    pub text: bool,
}

impl Ignore {
    /// Reads a list such as `labels,widths`.
    ///
    /// # Errors
    /// Where a word is none of `labels`, `colours`, `widths`, `text`.
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

    /// What either ignores.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        Self {
            labels: self.labels || other.labels,
            colours: self.colours || other.colours,
            widths: self.widths || other.widths,
            text: self.text || other.text,
        }
    }

    /// The label as it counts.
    pub(crate) fn label(self, label: &Label) -> Label {
        if self.labels { Label::default() } else { label.clone() }
    }

    /// The ink as it counts.
    pub(crate) fn ink(self, ink: &Ink) -> Ink {
        let mut ink = ink.clone();
        if self.labels {
            (ink.tone, ink.invisibility) = (None, 0);
        }
        if self.colours && !ink.is_stand_in() {
            ink.paint = Paint::Colour(Colour::BLACK);
        }
        if let Some(details) = ink.details.as_mut().filter(|_| self.colours) {
            let is_colour = |name: &String| COLOURS.contains(&name.as_str());
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

    /// Whether a change counts.
    pub(crate) fn counts(self, what: &str) -> bool {
        !match what {
            "part" | "class" | "layer" | "tone" | "hidden by" => self.labels,
            "colour" => self.colours,
            _ if COLOURS.contains(&what) => self.colours,
            "width" | "dash" | "ends" | "corners" => self.widths,
            _ => false,
        }
    }

    /// Whether a shape does not count at all.
    pub(crate) fn leaves_out(self, shape: &Shape) -> bool {
        self.text && shape.ink.is_text()
    }
}
