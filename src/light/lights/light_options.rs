//! [`LightOptions`]: the lights of a drawing, from the `[light]` table of a style sheet.

use glam::DVec3;
use serde::Deserialize;

use crate::colour::colour_factor::ColourFactor;
use crate::colour::srgb::Colour;
use crate::geometry::numbers::checked_number::fraction;

/// Lights of a drawing.
///
/// Lights of the model and of the style sheet shine together. Without any, a light fixed to the camera shines
/// from the upper left.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct LightOptions {
    /// Whether the model file's lights shine, if it has any. Default: true.
    pub from_model: bool,
    /// Further lights. Default: none.
    pub sources: Vec<LightSource>,
    /// Light from all directions, a_g of Lake et al. 2000, eq. 1. Default: 0.
    pub ambient: ColourFactor,
    /// Wrap of light round a surface, 0 to 1: the diffuse light is (L·n + wrap)/(1 + wrap), at least 0.
    /// Default: 0.
    #[serde(deserialize_with = "fraction")]
    pub wrap: f64,
    /// Darkening of a point that sees none of the sky, 0 to 1. Default: 0.
    #[serde(deserialize_with = "fraction")]
    pub occlusion: f64,
}

impl Default for LightOptions {
    fn default() -> Self {
        Self { from_model: true, sources: Vec::new(), ambient: ColourFactor::NONE, wrap: 0.0, occlusion: 0.0 }
    }
}

/// A light of a style sheet.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(try_from = "SourceTable")]
pub(crate) struct LightSource {
    /// Directional or point, with direction or position.
    pub kind: SourceKind,
    /// Space of its direction or position.
    pub space: Space,
    /// Tint of lit surfaces; does not change where tones end.
    pub colour: Colour,
    /// Brightness factor, at least 0. Default: 1.
    pub brightness: f64,
    /// Whether it casts shadows where shadows are drawn. Default: true.
    pub shadows: bool,
}

/// Direction or position of a light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum SourceKind {
    /// Parallel light.
    Directional {
        /// Towards the light, any length.
        direction: DVec3,
    },
    /// Light from a point.
    Point {
        /// Its position.
        position: DVec3,
        /// Distance D where half its light is left: 1/(1 + (d/D)²). `None`: no fall-off.
        falloff: Option<f64>,
    },
}

/// Space of directions and positions of lights.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Space {
    /// The model's own axes and origin.
    #[default]
    World,
    /// The eye's axes, in world units: x right, y up, z to the viewer.
    Camera,
}

impl Default for LightSource {
    /// The key light, from the upper left of the viewer.
    fn default() -> Self {
        Self {
            kind: SourceKind::Directional { direction: DVec3::new(-0.4, 0.6, 0.7) },
            space: Space::Camera,
            colour: Colour::WHITE,
            brightness: 1.0,
            shadows: true,
        }
    }
}

/// Light as written in a style sheet.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SourceTable {
    kind: SourceTag,
    direction: Option<[f64; 3]>,
    position: Option<[f64; 3]>,
    #[serde(default)]
    space: Space,
    falloff: Option<f64>,
    #[serde(alias = "color")]
    colour: Option<Colour>,
    brightness: Option<f64>,
    shadows: Option<bool>,
}

#[derive(Deserialize, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
enum SourceTag {
    Directional,
    Point,
}

impl TryFrom<SourceTable> for LightSource {
    type Error = String;

    fn try_from(table: SourceTable) -> Result<Self, String> {
        let kind = match (table.kind, table.direction, table.position, table.falloff) {
            (SourceTag::Directional, Some(direction), None, None) => {
                let direction = DVec3::from(direction);
                if direction.try_normalize().is_none() {
                    return Err("the direction of a light has no length; write [x, y, z] towards it".into());
                }
                SourceKind::Directional { direction }
            }
            (SourceTag::Directional, None, ..) => {
                return Err("a directional light needs a `direction`; write [x, y, z] towards it".into());
            }
            (SourceTag::Directional, ..) => {
                return Err("a directional light has no `position` and no `falloff`; leave them out".into());
            }
            (SourceTag::Point, None, Some(position), falloff) => {
                if falloff.is_some_and(|d| !(d.is_finite() && d > 0.0)) {
                    return Err("`falloff` is the distance at which half the light is left; \
                                write a number above 0"
                        .into());
                }
                let position = DVec3::from(position);
                if !position.is_finite() {
                    return Err("the position of a light is not finite; write [x, y, z]".into());
                }
                SourceKind::Point { position, falloff }
            }
            (SourceTag::Point, _, None, _) => {
                return Err("a point light needs a `position`; write [x, y, z]".into());
            }
            (SourceTag::Point, Some(_), ..) => {
                return Err("a point light has no `direction`; leave it out".into());
            }
        };
        let brightness = table.brightness.unwrap_or(1.0);
        if !(brightness.is_finite() && brightness >= 0.0) {
            return Err(format!("{brightness} is not a brightness; write a number of at least 0"));
        }
        Ok(Self {
            kind,
            space: table.space,
            colour: table.colour.unwrap_or(Colour::WHITE),
            brightness,
            shadows: table.shadows.unwrap_or(true),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<LightOptions, String> {
        toml::from_str(text).map_err(|error: toml::de::Error| error.message().to_owned())
    }

    #[test]
    fn light_options_read_directional_and_point_sources() {
        let options = read(
            "sources = [{ kind = \"directional\", direction = [0, 0, 1], space = \"camera\", color = \"#f00\" }, \
             { kind = \"point\", position = [1, 2, 3], falloff = 4, brightness = 0.5 }]",
        )
        .unwrap();
        let [sun, lamp] = &options.sources[..] else { panic!() };
        assert_eq!(sun.kind, SourceKind::Directional { direction: DVec3::Z });
        assert_eq!((sun.space, sun.colour), (Space::Camera, Colour::rgb(255, 0, 0)));
        let position = DVec3::new(1.0, 2.0, 3.0);
        assert_eq!(lamp.kind, SourceKind::Point { position, falloff: Some(4.0) });
        assert_eq!((lamp.space, lamp.brightness, lamp.shadows), (Space::World, 0.5, true));
        assert_eq!(read("").unwrap(), LightOptions::default());
    }

    #[test]
    fn invalid_light_options_are_refused_with_a_reason() {
        for (source, wanted) in [
            ("kind = \"directional\"", "needs a `direction`"),
            ("kind = \"directional\", direction = [0, 0, 0]", "no length"),
            ("kind = \"directional\", direction = [0, 0, 1], falloff = 1", "no `position`"),
            ("kind = \"point\"", "needs a `position`"),
            ("kind = \"point\", position = [0, 0, 1], direction = [0, 0, 1]", "no `direction`"),
            ("kind = \"point\", position = [0, 0, 1], falloff = 0", "above 0"),
            ("kind = \"point\", position = [0, 0, 1], brightness = -1", "at least 0"),
            ("kind = \"moon\"", "unknown variant"),
            ("kind = \"point\", position = [0, 0, 1], size = 1", "unknown field"),
        ] {
            let error = read(&format!("sources = [{{ {source} }}]")).unwrap_err();
            assert!(error.contains(wanted), "{source}: {error}");
        }
        assert!(read("wrap = 2").is_err() && read("occlusion = -1").is_err());
    }
}
