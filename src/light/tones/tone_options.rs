//! [`ToneOptions`]: how many tones a shaded surface has, where they change, and their colours.
//! They are style keys of the `[fills]` table.
//!
//! A tone is one flat step of light, as in cel shading. Levels refer to diffuse light: 0 in shadow, 1 where
//! the surface faces a light of brightness 1. Options can differ per material ([`MaterialChange`]).
//!
//! Sources:
//! - Lake et al., Stylized rendering techniques for scalable real-time 3D animation, 2000 (eq. 1).
//! - Gooch et al. 1998 (cool and warm colours).
//! - Ishaya, Real-time cartoon rendering, 2003 (table of two lights).

use serde::{Deserialize, Deserializer};

use super::tone_ramps::{MAX_TONES, Strip, Table};
use crate::colour::colour_factor::ColourFactor;
use crate::colour::srgb::Colour;
use crate::geometry::names::glob::Glob;
use crate::geometry::numbers::checked_number::{checked, fraction};
use crate::light::tolerances;
use crate::scene::material::Gloss;

/// Tones of the surface of a material, and their colours.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ToneOptions {
    /// Light levels between tones. Default: one threshold at 0.5.
    pub scale: ToneScale,
    /// Source of the colours of tones. Default: the material.
    pub colours: Colours,
    /// Share of light in each tone, darkest first: 0 = as in shadow, 1 = lit. A shorter list is interpolated
    /// over the tones; an empty one gives even steps. Default: empty.
    pub tones: Vec<f64>,
    /// Factor on the material's colour in shadow, a_l of Lake et al. 2000, eq. 1. Default: (0.7, 0.66, 0.78),
    /// slightly cooler than the material.
    pub shadow: ColourFactor,
    /// Factor on the material's colour where it is lit; d_l of eq. 1 is this minus `shadow`. Default: 1.
    pub lit: ColourFactor,
    /// Brightness factor for the colours of a palette, ramp or table. Above 0, they are multiplied by the
    /// material's colour and this factor; with 0, they are used unchanged. Default: 0, and 1.5 for a table
    /// (Ishaya 2003).
    pub modulate: Option<f64>,
    /// Highlights.
    pub highlight: Highlight,
    /// Whether surfaces cast shadows on each other. Default: false.
    pub cast_shadows: bool,
    /// Changes for some materials, in order.
    pub materials: Vec<MaterialChange>,
}

/// Light levels between tones.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum ToneScale {
    /// At rising thresholds of the diffuse light.
    Thresholds(Vec<f64>),
    /// At this many even steps of the diffuse light from 0 to 1. A gradient gets fewer if its colours have
    /// fewer shades.
    Steps(usize),
    /// At the borders between the columns of a strip of colours.
    Ramp(Strip),
    /// At the borders between the columns and rows of a table of colours, indexed by the first and the second
    /// light.
    Table(Table),
}

impl ToneScale {
    /// Limits the steps of a gradient to the number of distinct 8-bit colours in it, `shades`, plus one.
    /// Scales with few steps are unchanged.
    #[must_use]
    pub(crate) fn for_shades(self, shades: usize) -> Self {
        match self {
            Self::Steps(steps) if steps > tolerances::MAX_SEPARATE_LEVELS + 2 => {
                Self::Steps(steps.min((shades + 1).max(tolerances::MAX_SEPARATE_LEVELS + 2)))
            }
            other => other,
        }
    }
}

/// Source of the colours of tones. Not used with a ramp or a table, which bring their colours.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Colours {
    /// The material, by eq. 1 of Lake et al. 2000.
    Material,
    /// A list, darkest first, interpolated over the tones.
    Palette(Vec<Colour>),
    /// The material between a cool and a warm colour.
    Gooch(Gooch),
}

/// Colours from cool to warm: cool + `cool_share` of the material in shadow, warm + `warm_share` of the
/// material where it is lit.
///
/// Source: Gooch et al., A non-photorealistic lighting model for automatic technical illustration, 1998.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Gooch {
    /// Whether colours go from cool to warm. Default: false.
    pub enabled: bool,
    /// Colour of the shadow, k_blue. Default: `#00008c`.
    pub cool: Colour,
    /// Colour of the light, k_yellow. Default: `#4d4d00`.
    pub warm: Colour,
    /// Share of the material's colour in the shadow, α. Default: 0.25.
    #[serde(deserialize_with = "fraction")]
    pub cool_share: f64,
    /// Share of the material's colour in the light, β. Default: 0.5.
    #[serde(deserialize_with = "fraction")]
    pub warm_share: f64,
}

/// Specular highlights, where a surface mirrors a light towards the camera.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Highlight {
    /// Whether highlights are drawn. Default: false.
    pub enabled: bool,
    /// Rising thresholds of (n·h)^exponent, with h the half vector (Blinn 1977). Default: 0.5.
    pub thresholds: Vec<f64>,
    /// Exponent; higher values give smaller highlights. Default: 40.
    pub exponent: f64,
    /// Colour that is mixed into the brightest tone of the material. Default: white.
    pub colour: Colour,
    /// Share of that colour in the brightest highlight, 0 to 1; weaker ones have less. Default: 0.7.
    pub strength: f64,
    /// Colours over the highlight's strength from 0 to 1, added to the brightest tone of the material. It
    /// replaces thresholds, colour and strength. Default: none.
    pub ramp: Option<Strip>,
    /// Whether exponent and strength come from the material where its file has them. Default: false.
    pub material: bool,
    /// Distance of the camera and of parallel lights from the camera's target, in sides of the frame, when
    /// highlights are computed. Flat faces then show a spot instead of all or nothing. 0 = true positions.
    /// Default: 0.
    pub near: f64,
}

/// Changes of the highlights of some materials.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct HighlightChange {
    /// Whether highlights are drawn.
    pub enabled: Option<bool>,
    /// Rising thresholds of (n·h)^exponent.
    pub thresholds: Option<Vec<f64>>,
    /// Exponent; higher values give smaller highlights.
    pub exponent: Option<f64>,
    /// Colour that is mixed into the brightest tone.
    pub colour: Option<Colour>,
    /// Share of that colour in the brightest highlight.
    pub strength: Option<f64>,
    /// Colours over the highlight's strength.
    pub ramp: Option<Strip>,
    /// Whether exponent and strength come from the material.
    pub material: Option<bool>,
}

impl Highlight {
    /// Applies a change. If it sets exponent or strength, the values of the material's file are ignored.
    pub(crate) fn change(&mut self, change: HighlightChange) {
        let HighlightChange { enabled, thresholds, exponent, colour, strength, ramp, material } = change;
        self.enabled = enabled.unwrap_or(self.enabled);
        self.material = material.unwrap_or(self.material && exponent.is_none() && strength.is_none());
        if thresholds.is_some() || colour.is_some() || strength.is_some() {
            self.ramp = None;
        }
        self.thresholds = thresholds.unwrap_or(std::mem::take(&mut self.thresholds));
        self.exponent = exponent.unwrap_or(self.exponent);
        self.colour = colour.unwrap_or(self.colour);
        self.strength = strength.unwrap_or(self.strength);
        self.ramp = ramp.or(self.ramp.take());
    }

    /// Highlights of a material with this gloss; `None` if it has none.
    #[must_use]
    pub(crate) fn of(&self, gloss: Option<Gloss>) -> Option<Self> {
        let mut own = self.clone();
        if let Some(gloss) = gloss.filter(|_| self.material) {
            own.exponent = f64::from(gloss.exponent).clamp(MIN_EXPONENT, MAX_EXPONENT);
            own.strength *= f64::from(gloss.strength).clamp(0.0, 1.0);
        }
        (own.enabled && (own.strength > 0.0 || own.ramp.is_some())).then_some(own)
    }
}

/// Allowed exponents of highlights.
const MIN_EXPONENT: f64 = 1.0;
const MAX_EXPONENT: f64 = 10_000.0;

/// Changes for the materials whose name matches a pattern: `[[fills.material]]`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct MaterialChange {
    /// The pattern.
    pub name: Glob,
    /// Colour that replaces the material's.
    pub colour: Option<Colour>,
    /// Light levels between tones.
    pub scale: Option<ToneScale>,
    /// Source of the colours of tones.
    pub colours: Option<Colours>,
    /// Share of light in each tone.
    pub tones: Option<Vec<f64>>,
    /// Factor on the colour in shadow.
    pub shadow: Option<ColourFactor>,
    /// Factor on the colour where it is lit.
    pub lit: Option<ColourFactor>,
    /// Brightness factor of a palette, ramp or table on the material.
    pub modulate: Option<f64>,
    /// Changes of the highlights.
    pub highlight: HighlightChange,
}

impl Default for ToneOptions {
    fn default() -> Self {
        Self {
            scale: ToneScale::Thresholds(vec![0.5]),
            colours: Colours::Material,
            tones: Vec::new(),
            shadow: ColourFactor([0.7, 0.66, 0.78]),
            lit: ColourFactor::ALL,
            modulate: None,
            highlight: Highlight::default(),
            cast_shadows: false,
            materials: Vec::new(),
        }
    }
}

impl Default for Gooch {
    fn default() -> Self {
        Self {
            enabled: false,
            cool: Colour::rgb(0, 0, 0x8c),
            warm: Colour::rgb(0x4d, 0x4d, 0),
            cool_share: 0.25,
            warm_share: 0.5,
        }
    }
}

impl Default for Highlight {
    fn default() -> Self {
        Self {
            enabled: false,
            thresholds: vec![0.5],
            exponent: 40.0,
            colour: Colour::WHITE,
            strength: 0.7,
            ramp: None,
            material: false,
            near: 0.0,
        }
    }
}

impl ToneOptions {
    /// Options of a material of this name with its changes applied, and the colour that replaces its own.
    #[must_use]
    pub(crate) fn for_material(&self, name: &str) -> (Self, Option<Colour>) {
        let mut own = Self { materials: Vec::new(), ..self.clone() };
        let mut colour = None;
        for change in self.materials.iter().filter(|change| change.name.matches(name)) {
            let change = change.clone();
            colour = change.colour.or(colour);
            own.scale = change.scale.unwrap_or(own.scale);
            // Explicit colours replace those of a ramp or table.
            if let (Some(_), ToneScale::Ramp(_) | ToneScale::Table(_)) = (&change.colours, &own.scale) {
                own.scale = Self::default().scale;
            }
            own.colours = change.colours.unwrap_or(own.colours);
            own.tones = change.tones.unwrap_or(own.tones);
            own.shadow = change.shadow.unwrap_or(own.shadow);
            own.lit = change.lit.unwrap_or(own.lit);
            own.modulate = change.modulate.or(own.modulate);
            own.highlight.change(change.highlight);
        }
        (own, colour)
    }
}

/// Reads rising numbers above 0.
///
/// # Errors
/// Describes valid thresholds.
pub(crate) fn thresholds<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<f64>, D::Error> {
    let list = Vec::<f64>::deserialize(deserializer)?;
    let rising = list.windows(2).all(|pair| pair[0] < pair[1]);
    if list.iter().all(|t| t.is_finite() && *t > 0.0) && rising && list.len() < MAX_TONES {
        return Ok(list);
    }
    Err(serde::de::Error::custom("thresholds are rising numbers above 0; write such as [0.3, 0.7]"))
}

/// Reads the exponent of a highlight.
///
/// # Errors
/// Describes valid exponents.
pub(crate) fn exponent<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    let advice = "is not the exponent of a highlight; write a number from 1 to 10000";
    checked(deserializer, |value| (MIN_EXPONENT..=MAX_EXPONENT).contains(&value), advice)
}
