//! Which feature lines are found and drawn: the `[lines]` table of a style sheet.

use serde::{Deserialize, Deserializer, Serialize};

use super::{ImageOptions, InsideOptions, LineKind, Source};
use crate::geometry::numbers::checked_number::checked;
use crate::scene::ArtistTextures;

/// Treatment of hidden lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum HiddenLines {
    /// Left out.
    #[default]
    None,
    /// Drawn with the dashes of their pen.
    Dashed,
    /// Drawn without dashes.
    Solid,
}

/// Type of contours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Contours {
    /// Smooth on rounded surfaces, along mesh edges on all others. Each part and material is judged on its
    /// own, by its dihedral angles and the file's normals.
    #[default]
    Auto,
    /// Smooth everywhere: where the surface of the vertex normals turns away from the camera.
    Smooth,
    /// Along mesh edges everywhere: the exact contour of the polyhedron.
    Mesh,
}

/// How creases and curved surfaces are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Surfaces {
    /// By statistics of each connected component.
    Statistics,
    /// By evidence in constructed components that the file shades smoothly; by statistics in figures and
    /// elsewhere.
    #[default]
    Shaded,
    /// By the normals of the file, edge by edge and patch by patch; without normals by the turns around an edge
    /// and the shape of a patch.
    Evidence,
}

/// Whether circles of coarse meshes are drawn round, where surfaces are found by evidence.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum RoundRims {
    /// Rims that turn evenly, between curved surfaces or a curved and a flat one, are drawn as curves.
    #[default]
    Auto,
    /// Rims are drawn along the edges of the mesh.
    Off,
}

/// Source of a surface's normals.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Normals {
    /// The file's normals, with two exceptions that get the normals of their shape: components where the
    /// file's normals contradict the surface, and figures that it shades face by face.
    #[default]
    Auto,
    /// The file's normals, where it has any.
    File,
}

/// Which feature lines are found and drawn.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct LineOptions {
    /// Draw lines at all. Default: true.
    pub enabled: bool,
    /// Where lines are found: those of `kinds` on the surface, those of kind `image` in maps of normals and
    /// depth. Default: object.
    pub source: Source,
    /// Kinds that are drawn. Default: contour, border, crease, material, intersection, wire.
    pub kinds: Vec<LineKind>,
    /// Type of contours. Default: auto.
    pub contours: Contours,
    /// Source of the normals for light and rounded surfaces. Default: auto.
    pub normals: Normals,
    /// How creases and curved surfaces are found. Default: shaded.
    pub surfaces: Surfaces,
    /// Draw rims of curved surfaces as curves, where surfaces are found by evidence. Default: auto.
    pub round_rims: RoundRims,
    /// Smallest turn of a crease, degrees. Default: 40.
    #[serde(deserialize_with = "angle")]
    pub crease_deg: f64,
    /// Smallest distance of two painted colours with an artist line between them, in Oklab (black and white
    /// are 1 apart). Default: 0.05.
    #[serde(deserialize_with = "tolerance")]
    pub artist_tolerance: f64,
    /// Pictures by texture coordinates that are not painted themselves. On their materials `artist` lines run
    /// where these pictures change colour, and not where the surface does. Default: none.
    pub artist_texture: ArtistTextures,
    /// Smoothing of artist lines in pictures, px. Narrower details are lost. Default: 0.7.
    #[serde(deserialize_with = "smoothing")]
    pub artist_smooth: f64,
    /// Treatment of hidden lines. Default: none.
    pub hidden: HiddenLines,
    /// Draw the joints of parts of one material: lines where their surfaces continue in one plane. Default:
    /// true.
    pub joints: bool,
    /// Search mesh contours and tone borders with trees in dual space from the second view on. The lines are
    /// the same. The tree of contours saves its cost after about a hundred views of one model, that of tones
    /// none that could be measured. Default: false.
    pub edge_tree: bool,
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
            surfaces: Surfaces::Shaded,
            round_rims: RoundRims::Auto,
            crease_deg: 40.0,
            artist_tolerance: 0.05,
            artist_texture: ArtistTextures::default(),
            artist_smooth: 0.7,
            hidden: HiddenLines::None,
            joints: true,
            edge_tree: false,
            inside: InsideOptions::default(),
            image: ImageOptions::default(),
        }
    }
}

/// Reads a colour distance.
fn tolerance<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    checked(
        deserializer,
        |value| (0.0..=2.0).contains(&value),
        "is not a colour distance; write a number from 0 to 2",
    )
}

/// Reads a length in px.
fn smoothing<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    checked(
        deserializer,
        |value| (0.0..=100.0).contains(&value),
        "px is not a smoothing length; write a number from 0 to 100",
    )
}

/// Reads an angle from 0 to 180 degrees.
fn angle<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    checked(
        deserializer,
        |value| (0.0..=180.0).contains(&value),
        "is not the angle of a crease; write degrees from 0 to 180",
    )
}
