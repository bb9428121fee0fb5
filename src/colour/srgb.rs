//! [`Colour`]: an sRGB colour of eight bits a channel, with opacity.

use serde::{Deserialize, Serialize};

/// sRGB colour with opacity, each channel 0 to 255.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Colour {
    /// Red.
    pub r: u8,
    /// Green.
    pub g: u8,
    /// Blue.
    pub b: u8,
    /// Opacity, 255 = opaque.
    pub a: u8,
}

impl Colour {
    /// Black, opaque.
    pub const BLACK: Self = Self::rgb(0, 0, 0);
    /// White, opaque.
    pub const WHITE: Self = Self::rgb(255, 255, 255);

    /// An opaque colour.
    #[must_use]
    pub const fn rgb(r: u8, g: u8, b: u8) -> Self {
        Self { r, g, b, a: 255 }
    }

    /// Converts linear-light channels, 0 to 1, as glTF stores them.
    #[must_use]
    pub fn from_linear([r, g, b, a]: [f32; 4]) -> Self {
        let encode = |c: f32| {
            let c = f64::from(c.clamp(0.0, 1.0));
            let s = if c <= 0.003_130_8 {
                12.92 * c
            } else {
                1.055 * crate::geometry::numbers::portable_math::pow(c, 1.0 / 2.4) - 0.055
            };
            (s * 255.0).round() as u8
        };
        Self { r: encode(r), g: encode(g), b: encode(b), a: (a.clamp(0.0, 1.0) * 255.0).round() as u8 }
    }

    /// Returns a darker shade of the same hue: the channels times `factor` (0 = black, 1 = unchanged).
    #[must_use]
    pub fn darker(self, factor: f64) -> Self {
        let scale = |c: u8| (f64::from(c) * factor.clamp(0.0, 1.0)).round() as u8;
        Self { r: scale(self.r), g: scale(self.g), b: scale(self.b), a: self.a }
    }

    /// Red, green and blue in sRGB, each 0 to 1.
    #[must_use]
    pub fn channels(self) -> [f64; 3] {
        [self.r, self.g, self.b].map(|c| f64::from(c) / 255.0)
    }

    /// Opaque colour of sRGB channels, clamped to 0..=1.
    #[must_use]
    pub fn from_channels(channels: [f64; 3]) -> Self {
        let [r, g, b] = channels.map(|c| (c.clamp(0.0, 1.0) * 255.0).round() as u8);
        Self::rgb(r, g, b)
    }

    /// Linear interpolation to another colour, opacity included: 0 returns this one, 1 the other.
    #[must_use]
    pub fn mix(self, other: Self, share: f64) -> Self {
        let share = share.clamp(0.0, 1.0);
        let mix = |a: u8, b: u8| (f64::from(a) + (f64::from(b) - f64::from(a)) * share).round() as u8;
        Self {
            r: mix(self.r, other.r),
            g: mix(self.g, other.g),
            b: mix(self.b, other.b),
            a: mix(self.a, other.a),
        }
    }

    /// Luma, 0 to 1: the weighted sum of the sRGB channels (Rec. 709).
    #[must_use]
    pub fn luma(self) -> f64 {
        let [r, g, b] = self.channels();
        g + 0.2126 * (r - g) + 0.0722 * (b - g)
    }

    /// Parses `#rgb`, `#rgba`, `#rrggbb`, `#rrggbbaa` or a CSS name such as `teal`.
    ///
    /// `transparent` and `none` are not colours.
    #[must_use]
    pub fn parse(text: &str) -> Option<Self> {
        let text = text.trim();
        let Some(hex) = text.strip_prefix('#') else {
            return super::css_names::css_colour(text).map(|[r, g, b]| Self::rgb(r, g, b));
        };
        if !hex.is_ascii() {
            return None;
        }
        let digit = |i: usize| u8::from_str_radix(hex.get(i..=i)?, 16).ok().map(|v| v * 17);
        let pair = |i: usize| u8::from_str_radix(hex.get(i..i + 2)?, 16).ok();
        match hex.len() {
            3 => Some(Self::rgb(digit(0)?, digit(1)?, digit(2)?)),
            4 => Some(Self { r: digit(0)?, g: digit(1)?, b: digit(2)?, a: digit(3)? }),
            6 => Some(Self::rgb(pair(0)?, pair(2)?, pair(4)?)),
            8 => Some(Self { r: pair(0)?, g: pair(2)?, b: pair(4)?, a: pair(6)? }),
            _ => None,
        }
    }

    /// Formats the colour as `#rrggbb`, without the opacity.
    #[must_use]
    pub fn hex(self) -> String {
        format!("#{:02x}{:02x}{:02x}", self.r, self.g, self.b)
    }
}

/// Converts an sRGB channel, 0 to 1, to linear light, 0 to 1.
#[must_use]
pub(crate) fn linear(channel: f32) -> f32 {
    let c = f64::from(channel.clamp(0.0, 1.0));
    let l = if c <= 0.040_45 {
        c / 12.92
    } else {
        crate::geometry::numbers::portable_math::pow((c + 0.055) / 1.055, 2.4)
    };
    l as f32
}

impl TryFrom<String> for Colour {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        Self::parse(&text)
            .ok_or_else(|| format!("`{text}` is not a colour; write it as #rrggbb, or by its name in CSS"))
    }
}

impl From<Colour> for String {
    fn from(c: Colour) -> Self {
        if c.a == 255 { c.hex() } else { format!("{}{:02x}", c.hex(), c.a) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mix_returns_its_end_colours_at_zero_and_one() {
        let (a, b) = (Colour::rgb(10, 200, 30), Colour { r: 0, g: 0, b: 255, a: 0 });
        assert_eq!((a.mix(b, 0.0), a.mix(b, 1.0)), (a, b));
        assert_eq!(a.mix(b, 0.5), Colour { r: 5, g: 100, b: 143, a: 128 });
        assert_eq!(Colour::from_channels(a.channels()), a);
        assert_eq!((Colour::WHITE.luma(), Colour::BLACK.luma()), (1.0, 0.0));
    }
}
