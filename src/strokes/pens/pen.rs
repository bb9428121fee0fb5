//! [`Pen`]: width, colour, caps, joins and dashes of strokes, and the changes that rules make.

use std::sync::Arc;

use serde::de::{Error as _, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};

use super::hand::{Hand, HandChange};
use crate::colour::srgb::Colour;
use crate::drawing::{Cap, Join, Length};
use crate::geometry::numbers::checked_number::some_fraction;
use crate::strokes::brushes::brush::Brush;
use crate::strokes::brushes::brush_source::BrushChange;
use crate::strokes::widths::swell::{Swell, SwellChange};

/// Colour of a pen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Ink {
    /// One colour. Written `"#1a1a1a"`.
    Fixed(Colour),
    /// A darker shade of the material next to the line: its channels times this factor, 0 for black and 1 for
    /// the material's colour. Written `{ shade = 0.5 }`.
    Shade(f64),
}

/// Appearance of strokes.
#[derive(Debug, Clone, PartialEq)]
pub struct Pen {
    /// Width of the line; 0 draws nothing. Default: 1 px.
    pub width: Length,
    /// Colour. Default: `#1a1a1a`.
    pub colour: Ink,
    /// Caps. Default: round.
    pub cap: Cap,
    /// Joins. Default: round.
    pub join: Join,
    /// Dashes and gaps in turn; empty means solid. Default: solid.
    pub dash: Vec<Length>,
    /// Opacity, 0 to 1; multiplies the colour's alpha. Default: 1.
    pub opacity: f64,
    /// Share of the width that a line loses where its strength is 0. Only suggestive contours, ridges and
    /// valleys vary in strength. Default: 1.
    pub(crate) fade: f64,
    /// Variation of the width along a line. Default: none.
    pub(crate) swell: Swell,
    /// Random hand-drawn effects. Default: none.
    pub(crate) hand: Hand,
    /// Distance from the line within which no farther line is drawn; 0 for no halo. Default: 0.
    pub(crate) halo: Length,
    /// Shape laid along lines in place of a plain width. Default: none.
    pub(crate) brush: Option<Arc<Brush>>,
}

impl Pen {
    /// Whether strokes differ from plain or fading lines of the pen's width.
    #[must_use]
    pub fn has_hand(&self) -> bool {
        self.swell.is_on() || self.hand.is_on() || self.halo.value > 0.0 || self.brush.is_some()
    }
}

impl Default for Pen {
    fn default() -> Self {
        Self {
            width: Length::px(1.0),
            colour: Ink::Fixed(Colour::rgb(0x1a, 0x1a, 0x1a)),
            cap: Cap::Round,
            join: Join::Round,
            dash: Vec::new(),
            opacity: 1.0,
            fade: 1.0,
            swell: Swell::default(),
            hand: Hand::default(),
            halo: Length::px(0.0),
            brush: None,
        }
    }
}

/// Fields of a pen to be changed. Absent ones stay.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct PenChange {
    /// Width of the line.
    pub width: Option<Length>,
    /// Colour.
    #[serde(alias = "color")]
    pub colour: Option<Ink>,
    /// Caps.
    pub cap: Option<Cap>,
    /// Joins.
    pub join: Option<Join>,
    /// Dashes and gaps in turn.
    #[serde(deserialize_with = "dash")]
    pub dash: Option<Vec<Length>>,
    /// Opacity, 0 to 1.
    #[serde(deserialize_with = "some_fraction")]
    pub opacity: Option<f64>,
    /// Share of the width lost where strength is 0, 0 to 1.
    #[serde(deserialize_with = "some_fraction")]
    pub fade: Option<f64>,
    /// Variation of the width.
    pub swell: SwellChange,
    /// Hand-drawn effects.
    pub hand: HandChange,
    /// Width of the halo.
    pub halo: Option<Length>,
    /// Shape laid along lines.
    pub brush: Option<BrushChange>,
}

impl PenChange {
    /// Applies the present fields to a pen.
    pub(crate) fn apply(&self, pen: &mut Pen) {
        if let Some(width) = self.width {
            pen.width = width;
        }
        if let Some(colour) = self.colour {
            pen.colour = colour;
        }
        if let Some(cap) = self.cap {
            pen.cap = cap;
        }
        if let Some(join) = self.join {
            pen.join = join;
        }
        if let Some(dash) = &self.dash {
            pen.dash.clone_from(dash);
        }
        if let Some(opacity) = self.opacity {
            pen.opacity = opacity;
        }
        if let Some(fade) = self.fade {
            pen.fade = fade;
        }
        self.swell.apply(&mut pen.swell);
        self.hand.apply(&mut pen.hand);
        if let Some(halo) = self.halo {
            pen.halo = halo;
        }
        if let Some(brush) = &self.brush {
            pen.brush = brush.brush();
        }
    }
}

/// Reads lengths of dashes and gaps: an empty list, or at least one length above 0.
pub(crate) fn dash<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Vec<Length>>, D::Error> {
    let lengths = Vec::<Length>::deserialize(deserializer)?;
    if lengths.is_empty() || lengths.iter().any(|length| length.value > 0.0) {
        Ok(Some(lengths))
    } else {
        Err(D::Error::custom("a dash pattern needs a length above 0; write [] for a solid line"))
    }
}

impl<'de> Deserialize<'de> for Ink {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(InkVisitor)
    }
}

/// Reads either form by its type, so that errors keep their position in the sheet.
struct InkVisitor;

impl<'de> Visitor<'de> for InkVisitor {
    type Value = Ink;

    fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str("a colour such as \"#1a1a1a\", or { shade = 0.5 } for a darker shade of the material")
    }

    fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<Ink, E> {
        Colour::try_from(text.to_owned()).map(Ink::Fixed).map_err(E::custom)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Ink, A::Error> {
        #[derive(Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Shade {
            #[serde(deserialize_with = "some_fraction")]
            shade: Option<f64>,
        }
        let read = Shade::deserialize(serde::de::value::MapAccessDeserializer::new(map))?;
        Ok(Ink::Shade(read.shade.unwrap_or(0.5)))
    }
}
