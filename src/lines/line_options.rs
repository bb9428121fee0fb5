//! Which feature lines are sought and drawn: the `[lines]` table of a style sheet.

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};

use super::{ImageOptions, InsideOptions, LineKind, Source};
use crate::scene::ArtistTextures;

/// What becomes of lines behind surfaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum HiddenLines {
    /// Left out.
    #[default]
    None,
    /// Drawn with the dashes of their pen.
    Dashed,
    /// Drawn without dashes.
    Solid,
}

/// Where the contour of a surface lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Contours {
    /// Smooth on surfaces that are meant to be round, along edges of the mesh on all others: each
    /// part and material by itself, from its dihedral angles and the file's normals.
    #[default]
    Auto,
    /// Smooth everywhere: where the surface of the vertex normals turns away from the eye.
    Smooth,
    /// Along edges of the mesh everywhere: the exact contour of the polyhedron.
    Mesh,
}

/// Whose normals a surface has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Normals {
    /// The file's, but for pieces where these leave the surface, and figures that they shade as if
    /// every face were a plane: these get the normals of their shape.
    #[default]
    Auto,
    /// The file's wherever it has any.
    File,
}

/// Which feature lines are sought and drawn.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LineOptions {
    /// Draw lines at all. Default: true.
    pub enabled: bool,
    /// Where lines are sought: those of `kinds` on the surface, those of kind `image` in maps of normals and depth. Default: object.
    pub source: Source,
    /// Kinds that are drawn. Default: contour, border, crease, material, intersection, wire.
    pub kinds: Vec<LineKind>,
    /// Where contours lie. Default: auto.
    pub contours: Contours,
    /// Whose normals light falls by, and round surfaces are made from. Default: auto.
    pub normals: Normals,
    /// An edge whose faces turn by more than this many degrees is a crease. Default: 40.
    #[serde(deserialize_with = "angle")]
    pub crease_deg: f64,
    /// Painted colours that are nearer to each other than this have no artist line between them: their distance in Oklab, in
    /// which black and white are 1 apart. Default: 0.05.
    #[serde(deserialize_with = "tolerance")]
    pub artist_tolerance: f64,
    /// Pictures that lie on the surfaces by their texture coordinates, and are not painted: on their materials `artist` lines run
    /// where these change their colour, not where the surface does. Default: none.
    pub artist_texture: ArtistTextures,
    /// How much artist lines in pictures are smoothed, px: what is narrower is lost. Default: 0.7.
    #[serde(deserialize_with = "smoothing")]
    pub artist_smooth: f64,
    /// What becomes of lines behind surfaces. Default: none.
    pub hidden: HiddenLines,
    /// Draw the joints of parts of one material: lines where their surfaces continue in one plane. Default: true.
    pub joints: bool,
    /// How suggestive contours, ridges and valleys are found.
    pub inside: InsideOptions,
    /// How lines are found in the image.
    pub image: ImageOptions,
}

impl Default for LineOptions {
    fn default() -> Self {
        Self {
            enabled: true,
            source: Source::Object,
            kinds: vec![
                LineKind::Contour,
                LineKind::Border,
                LineKind::Crease,
                LineKind::Material,
                LineKind::Intersection,
                LineKind::Wire,
            ],
            contours: Contours::Auto,
            normals: Normals::Auto,
            crease_deg: 40.0,
            artist_tolerance: 0.05,
            artist_texture: ArtistTextures::default(),
            artist_smooth: 0.7,
            hidden: HiddenLines::None,
            joints: true,
            inside: InsideOptions::default(),
            image: ImageOptions::default(),
        }
    }
}

/// A distance of colours.
fn tolerance<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    let distance = f64::deserialize(deserializer)?;
    if (0.0..=2.0).contains(&distance) {
        Ok(distance)
    } else {
        Err(D::Error::custom(format!("{distance} is not a colour distance; write a number from 0 to 2")))
    }
}

/// A width in px.
fn smoothing<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    let px = f64::deserialize(deserializer)?;
    if (0.0..=100.0).contains(&px) {
        Ok(px)
    } else {
        Err(D::Error::custom(format!("{px} px is not a smoothing length; write a number from 0 to 100")))
    }
}

/// An angle of 0 to 180 degrees.
fn angle<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    let degrees = f64::deserialize(deserializer)?;
    if (0.0..=180.0).contains(&degrees) {
        Ok(degrees)
    } else {
        Err(D::Error::custom(format!("{degrees} is not the angle of a crease; write degrees from 0 to 180")))
    }
}
