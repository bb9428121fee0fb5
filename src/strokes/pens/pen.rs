//! [`Pen`]: width, colour, ends, corners and dashes of strokes, and the changes that rules make to it.

use std::sync::Arc;

use serde::de::{Error as _, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};

use super::hand::{Hand, HandChange};
use crate::colour::srgb::Colour;
use crate::drawing::{Cap, Join, Length};
use crate::strokes::brushes::brush::Brush;
use crate::strokes::brushes::brush_source::BrushChange;
use crate::strokes::fraction::fraction;
use crate::strokes::widths::swell::{Swell, SwellChange};

/// What a pen is filled with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Ink {
    /// One colour. Written `"#1a1a1a"`.
    Fixed(Colour),
    /// A darker shade of the material beside the line: its channels times this factor, 0 = black,
    /// 1 = the material's own colour. Written `{ shade = 0.5 }`.
    Shade(f64),
}

/// How strokes are drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Pen {
    /// Width of the line; 0 draws nothing. Default: 1 px.
    pub width: Length,
    /// Colour. Default: `#1a1a1a`.
    pub colour: Ink,
    /// Ends. Default: round.
    pub cap: Cap,
    /// Corners. Default: round.
    pub join: Join,
    /// Dashes and gaps in turn; empty = solid. Default: solid.
    pub dash: Vec<Length>,
    /// 0 = invisible, 1 = opaque; multiplies the colour's own. Default: 1.
    pub opacity: f64,
    /// How much of its width a line loses where it is weakest: 0 = none, 1 = all. Only suggestive
    /// contours, ridges and valleys are ever weak. Default: 1.
    pub fade: f64,
    /// How the width varies along a line. Default: not.
    pub swell: Swell,
    /// What chance does to a line. Default: nothing.
    pub hand: Hand,
    /// How far beside the line nothing farther is drawn where it passes over; 0 = no halo. Default: 0.
    pub halo: Length,
    /// A shape that is laid along lines in place of a plain width. Default: none.
    pub brush: Option<Arc<Brush>>,
}

impl Pen {
    /// Whether lines are more than strokes of the pen's width that fade.
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

/// The fields of a pen that are to change; the others stay.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PenChange {
    /// Width of the line.
    pub width: Option<Length>,
    /// Colour.
    #[serde(alias = "color")]
    pub colour: Option<Ink>,
    /// Ends.
    pub cap: Option<Cap>,
    /// Corners.
    pub join: Option<Join>,
    /// Dashes and gaps in turn.
    #[serde(deserialize_with = "dash")]
    pub dash: Option<Vec<Length>>,
    /// Opacity, 0 to 1.
    #[serde(deserialize_with = "fraction")]
    pub opacity: Option<f64>,
    /// Part of the width that is lost where a line is weakest, 0 to 1.
    #[serde(deserialize_with = "fraction")]
    pub fade: Option<f64>,
    /// How the width varies.
    pub swell: SwellChange,
    /// What chance does.
    pub hand: HandChange,
    /// How wide the halo is.
    pub halo: Option<Length>,
    /// The shape along lines.
    pub brush: Option<BrushChange>,
}

impl PenChange {
    /// Changes the fields of a pen that are named.
    pub fn apply(&self, pen: &mut Pen) {
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

/// Lengths of dashes and gaps: none, or such that something is drawn and something is not.
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

/// Reads either form by what it meets, so that errors keep their place in the sheet.
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
            #[serde(deserialize_with = "fraction")]
            shade: Option<f64>,
        }
        let read = Shade::deserialize(serde::de::value::MapAccessDeserializer::new(map))?;
        Ok(Ink::Shade(read.shade.unwrap_or(0.5)))
    }
}
