//! Ink of a shape in a form that can be compared.

use std::collections::BTreeSet;
use std::fmt;
use std::sync::Arc;

use super::placeholder::{Details, LINKED_PICTURE_PREFIX};
use crate::colour::srgb::Colour;
use crate::diff::tolerances::{MAX_DASH_DIFFERENCE_PX, MAX_WIDTH_DIFFERENCE_PX};
use crate::drawing::{Cap, Join};

/// Paint of a shape.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum ShapePaint {
    /// One colour, including the opacity of groups.
    Colour(Colour),
    /// Gradients, patterns, pictures and texts as a description. Equal descriptions mean equal paint.
    Other(Arc<str>),
}

impl ShapePaint {
    /// Whether two paints look equal. Opacities are rounded several times in a file, so they may differ by 1.
    fn is_like(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Colour(a), Self::Colour(b)) => {
                (a.r, a.g, a.b) == (b.r, b.g, b.b) && a.a.abs_diff(b.a) <= 1
            }
            _ => self == other,
        }
    }

    /// Target of a linked picture.
    pub(crate) fn link(&self) -> Option<&str> {
        match self {
            Self::Other(words) => words.strip_prefix(LINKED_PICTURE_PREFIX)?.split('`').next(),
            Self::Colour(_) => None,
        }
    }
}

impl fmt::Display for ShapePaint {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Colour(colour) if colour.a == 255 => f.write_str(&colour.hex()),
            Self::Colour(colour) => {
                let opaque = Colour { a: 255, ..*colour }.hex();
                write!(f, "{opaque} at {:.0} %", f64::from(colour.a) / 2.55)
            }
            Self::Other(text) => f.write_str(text),
        }
    }
}

/// How a shape is painted; lengths in px.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ShapeInk {
    /// Colour, or the description of another paint.
    pub paint: ShapePaint,
    /// Line width; 0 for regions.
    pub width: f64,
    /// Lengths of dashes and gaps in turn; empty for solid lines.
    pub dash: Vec<f64>,
    /// Line ends.
    pub cap: Cap,
    /// Line corners.
    pub join: Join,
    /// Whether a line of varying width is drawn as a filled outline.
    pub outlined: bool,
    /// Tone of a region; 0 is the darkest.
    pub tone: Option<u16>,
    /// Number of surfaces that hide the line.
    pub invisibility: u16,
    /// Whether edges are not anti-aliased (`shape-rendering`).
    pub(crate) is_crisp: bool,
    /// Properties of a text or a picture that change its look.
    pub(crate) details: Option<Arc<Details>>,
}

/// Whether a description stands for a text.
pub(crate) fn is_text(words: &str) -> bool {
    words.starts_with("the text ")
}

impl ShapeInk {
    /// Ink of a region.
    #[must_use]
    pub(crate) const fn region(paint: ShapePaint, tone: Option<u16>) -> Self {
        Self {
            paint,
            width: 0.0,
            dash: Vec::new(),
            cap: Cap::Butt,
            join: Join::Miter,
            outlined: false,
            tone,
            invisibility: 0,
            is_crisp: false,
            details: None,
        }
    }

    /// Whether the ink stands for a text.
    pub(crate) fn is_text(&self) -> bool {
        matches!(&self.paint, ShapePaint::Other(words) if is_text(words))
    }

    /// Whether the ink stands for a text or a picture.
    pub(crate) fn is_stand_in(&self) -> bool {
        matches!(&self.paint, ShapePaint::Other(words) if words.starts_with("the "))
    }

    /// Whether two inks look equal.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        self.paint.is_like(&other.paint)
            && (self.width - other.width).abs() <= MAX_WIDTH_DIFFERENCE_PX
            && same_dash(&self.dash, &other.dash)
            && (self.cap, self.join, self.outlined) == (other.cap, other.join, other.outlined)
            && (self.tone, self.invisibility, self.is_crisp)
                == (other.tone, other.invisibility, other.is_crisp)
            && self.details == other.details
    }

    /// Changed properties as name, old value and new value.
    pub(crate) fn changes(&self, other: &Self) -> Vec<(String, String, String)> {
        let mut changes = Vec::new();
        let mut note = |what: &str, differs: bool, word: &dyn Fn(&Self) -> String| {
            if differs {
                changes.push((what.to_owned(), word(self), word(other)));
            }
        };
        note("colour", !self.paint.is_like(&other.paint), &|ink| ink.paint.to_string());
        note("width", (self.width - other.width).abs() > MAX_WIDTH_DIFFERENCE_PX, &|ink| {
            format!("{} px", trimmed(ink.width))
        });
        note("dash", !same_dash(&self.dash, &other.dash), &|ink| match ink.dash.as_slice() {
            [] => "solid".to_owned(),
            dash => dash.iter().map(|length| trimmed(*length)).collect::<Vec<_>>().join(" "),
        });
        note("tone", self.tone != other.tone, &|ink| {
            ink.tone.map_or_else(|| "none".to_owned(), |tone| tone.to_string())
        });
        note("ends", self.cap != other.cap, &|ink| format!("{:?}", ink.cap).to_lowercase());
        note("corners", self.join != other.join, &|ink| format!("{:?}", ink.join).to_lowercase());
        note("drawn as", self.outlined != other.outlined, &|ink| {
            if ink.outlined { "outline" } else { "stroke" }.to_owned()
        });
        note("edges", self.is_crisp != other.is_crisp, &|ink| {
            if ink.is_crisp { "sharp" } else { "smooth" }.to_owned()
        });
        note("hidden by", self.invisibility != other.invisibility, &|ink| ink.invisibility.to_string());
        let detail =
            |ink: &Self, name: &str| ink.details.as_ref().and_then(|details| details.get(name).cloned());
        let names = [self, other].into_iter().filter_map(|ink| ink.details.as_ref());
        let names: BTreeSet<&String> = names.flat_map(|details| details.keys()).collect();
        for name in names {
            let [was, is] = [self, other].map(|ink| detail(ink, name));
            if was != is {
                let word = |value: Option<String>| value.unwrap_or_else(|| "not set".to_owned());
                changes.push((name.clone(), word(was), word(is)));
            }
        }
        changes
    }
}

/// Whether two dash patterns are equal within a tolerance.
fn same_dash(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() <= MAX_DASH_DIFFERENCE_PX)
}

/// A number with at most three decimals, without trailing zeros.
pub(crate) fn trimmed(number: f64) -> String {
    let text = format!("{number:.3}");
    match text.trim_end_matches('0').trim_end_matches('.') {
        "" | "-0" => "0".to_owned(),
        short => short.to_owned(),
    }
}
