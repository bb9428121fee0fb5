//! [`Mark`]: one painted path.
//!
//! A mark has a path, a [`Paint`] (stroke, fill, gradient, line of varying width or picture) and a
//! [`Provenance`], its origin in the model.

use std::sync::Arc;

use kurbo::{Affine, BezPath, Point};
use serde::{Deserialize, Serialize};

use super::TextRun;
use crate::colour::pixel_picture::Picture;
use crate::colour::srgb::Colour;

/// Shape of line ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Cap {
    /// Cut off at the end point.
    Butt,
    /// A half circle round the end point.
    #[default]
    Round,
    /// Extended by half a width.
    Square,
}

/// Shape of line corners.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Join {
    /// Pointed.
    Miter,
    /// Rounded.
    #[default]
    Round,
    /// Cut off at the corner.
    Bevel,
}

/// Paint of a stroked path; lengths in user units.
#[derive(Debug, Clone, PartialEq)]
pub struct StrokePaint {
    /// Width.
    pub width: f64,
    /// Colour and opacity.
    pub colour: Colour,
    /// Shape of the ends.
    pub cap: Cap,
    /// Shape of the corners.
    pub join: Join,
    /// Lengths of dashes and gaps in turn; empty for a solid line.
    pub dash: Vec<f64>,
    /// Offset of the path's start in the dash pattern.
    pub dash_offset: f64,
}

impl StrokePaint {
    /// A solid line.
    pub(crate) fn solid(width: f64, colour: Colour, cap: Cap, join: Join) -> Self {
        Self { width, colour, cap, join, dash: Vec::new(), dash_offset: 0.0 }
    }
}

/// Paint of a line with varying width; the mark's path is its outline. Lengths in user units.
#[derive(Debug, Clone, PartialEq)]
pub struct OutlinePaint {
    /// Colour and opacity.
    pub colour: Colour,
    /// Centre line.
    pub axis: BezPath,
    /// Mean width.
    pub width: f64,
    /// Largest width, that of the pen.
    pub pen_width: f64,
}

/// A picture in pieces, clipped to the mark's path. Where pieces overlap, the last one is visible.
#[derive(Debug, Clone, PartialEq)]
pub struct ImagePaint {
    /// Pixels of all pieces. Marks share a picture, so a drawing stores it once.
    pub picture: Arc<Picture>,
    /// The pieces, painted first to last.
    pub pieces: Vec<ImagePiece>,
}

/// A piece of the page, and its part of a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct ImagePiece {
    /// Its outline in user units.
    pub outline: BezPath,
    /// Content of the piece.
    pub shows: PieceContent,
}

/// Content of a piece of a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PieceContent {
    /// The picture under this transform; pixel (0, 0) covers the square from (0, 0) to (1, 1) before it.
    Pixels(Affine),
    /// One colour.
    Colour(Colour),
}

/// A linear gradient.
#[derive(Debug, Clone, PartialEq)]
pub struct Gradient {
    /// Position of the first stop.
    pub start: Point,
    /// Position of the last stop.
    pub end: Point,
    /// Offsets from 0 to 1 in rising order, and their colours.
    ///
    /// Colours are interpolated linearly in sRGB. All have the opacity of the first one. Outside the ends the
    /// colour is constant.
    pub stops: Vec<(f64, Colour)>,
}

impl Gradient {
    /// The colour at offset 0.5.
    #[must_use]
    pub fn middle(&self) -> Colour {
        self.at(0.5)
    }

    /// The colour at an offset from 0 to 1.
    #[must_use]
    pub fn at(&self, place: f64) -> Colour {
        let after = self.stops.partition_point(|(at, _)| *at <= place);
        let below = after.checked_sub(1).and_then(|k| self.stops.get(k));
        match (below, self.stops.get(after)) {
            (Some((from, a)), Some((to, b))) => a.mix(*b, (place - from) / (to - from)),
            (Some((_, one)), None) | (None, Some((_, one))) => *one,
            (None, None) => Colour::BLACK,
        }
    }
}

/// Paint of a mark.
#[derive(Debug, Clone, PartialEq)]
pub enum Paint {
    /// A line of constant width.
    Stroke(StrokePaint),
    /// A filled outline.
    Fill(Colour),
    /// A filled outline with a linear gradient.
    Gradient(Gradient),
    /// A line of varying width: the filled outline of a line.
    Outline(OutlinePaint),
    /// A picture.
    Image(ImagePaint),
}

/// The origin of a mark: classes and `data-` attributes in SVG, and the basis for comparing drawings.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Provenance {
    /// Classes: the line kind first, then `silhouette`.
    pub classes: Vec<&'static str>,
    /// Tone of a region; 0 is the darkest.
    pub tone: Option<u16>,
    /// Name of the part.
    pub part: Option<Arc<str>>,
    /// Name of the material.
    pub material: Option<Arc<str>>,
    /// Number of surfaces in front of the line; 0 if it is visible.
    pub invisibility: u16,
    /// Identity of the line, equal in all frames of an animation; 0 for none.
    pub identity: u64,
    /// The cells of the rest-pose model that the line passes, as numbers in rising order; empty if unknown.
    pub places: Arc<[u64]>,
    /// A note about the mark, its title in SVG.
    pub note: Option<Arc<str>>,
    /// The text whose letters the mark outlines. PDF sets it in its font. Other formats keep the outline, and
    /// SVG adds the words.
    pub text: Option<TextRun>,
}

impl Provenance {
    /// Provenance of a mark on a part and a material; empty names are left out.
    pub(crate) fn of_names(part: Option<&Arc<str>>, material: Option<&Arc<str>>) -> Self {
        let known = |name: Option<&Arc<str>>| name.filter(|name| !name.is_empty()).cloned();
        Self { part: known(part), material: known(material), ..Self::default() }
    }
}

/// One painted path.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// Path in user units, x right, y down.
    pub path: BezPath,
    /// Its paint.
    pub paint: Paint,
    /// Its origin.
    pub provenance: Provenance,
}
