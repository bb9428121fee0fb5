//! [`Mark`]: one painted path.

use std::sync::Arc;

use kurbo::{Affine, BezPath, Point};
use serde::{Deserialize, Serialize};

use super::TextRun;
use crate::colour::pixel_picture::Picture;
use crate::colour::srgb::Colour;

/// How a line ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Cap {
    /// Cut off at the end point.
    Butt,
    /// A half circle round the end point.
    #[default]
    Round,
    /// Half a width beyond the end point.
    Square,
}

/// How a line turns a corner.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Join {
    /// Pointed.
    Miter,
    /// Rounded.
    #[default]
    Round,
    /// Cut off.
    Bevel,
}

/// Ink of a stroked path; lengths in user units.
#[derive(Debug, Clone, PartialEq)]
pub struct StrokePaint {
    /// Width.
    pub width: f64,
    /// Colour and opacity.
    pub colour: Colour,
    /// Ends.
    pub cap: Cap,
    /// Corners.
    pub join: Join,
    /// Lengths of dashes and gaps in turn; empty = solid.
    pub dash: Vec<f64>,
    /// Where in the dash pattern the path starts.
    pub dash_offset: f64,
}

/// Ink of a line of varying width, whose outline is the mark's path; lengths in user units.
#[derive(Debug, Clone, PartialEq)]
pub struct OutlinePaint {
    /// Colour and opacity.
    pub colour: Colour,
    /// The middle of the line.
    pub axis: BezPath,
    /// Mean width.
    pub width: f64,
    /// Width where the line is strongest: that of its pen.
    pub pen_width: f64,
}

/// A picture in pieces, of which that is seen which lies inside the mark's path. Pieces may cover each other: the last one is seen.
#[derive(Debug, Clone, PartialEq)]
pub struct ImagePaint {
    /// The pixels that all pieces show. A drawing holds a picture once, whatever the number of its marks.
    pub picture: Arc<Picture>,
    /// The pieces, painted first to last.
    pub pieces: Vec<ImagePiece>,
}

/// A piece of the page, and what of a picture it shows.
#[derive(Debug, Clone, PartialEq)]
pub struct ImagePiece {
    /// Its outline in user units.
    pub outline: BezPath,
    /// What it shows.
    pub shows: Shows,
}

/// What a piece of the page shows of a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shows {
    /// The picture, whose pixels lie where this brings them: the first one covers the square from (0, 0) to (1, 1).
    Pixels(Affine),
    /// One colour.
    Colour(Colour),
}

/// Colours that change along a line, and are the same across it.
#[derive(Debug, Clone, PartialEq)]
pub struct Gradient {
    /// Where the first stop is.
    pub start: Point,
    /// Where the last stop is.
    pub end: Point,
    /// Places from 0 at the start to 1 at the end, rising, and their colours, between which channels as written are linear. All are
    /// as opaque as the first; beyond the ends the colour stays.
    pub stops: Vec<(f64, Colour)>,
}

impl Gradient {
    /// The colour in its middle.
    #[must_use]
    pub fn middle(&self) -> Colour {
        self.at(0.5)
    }

    /// The colour at a place from 0 to 1.
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

/// How a mark is painted.
#[derive(Debug, Clone, PartialEq)]
pub enum Paint {
    /// A line of constant width.
    Stroke(StrokePaint),
    /// A filled outline.
    Fill(Colour),
    /// A filled outline whose colour changes along a line.
    Gradient(Gradient),
    /// A line of varying width: the filled outline of a line.
    Outline(OutlinePaint),
    /// A picture.
    Image(ImagePaint),
}

/// Where a mark comes from, as plain text: becomes classes and `data-` attributes in SVG, and is
/// what drawings are compared by.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Provenance {
    /// Classes: the line kind first, then `silhouette`.
    pub classes: Vec<&'static str>,
    /// The tone of a region, 0 the darkest.
    pub tone: Option<u16>,
    /// Name of the part of the model.
    pub part: Option<Arc<str>>,
    /// Name of the material.
    pub material: Option<Arc<str>>,
    /// How many surfaces hide the line; 0 for visible ones.
    pub invisibility: u16,
    /// What the line is known by in all frames of an animation; 0 for none.
    pub identity: u64,
    /// Where on the model at rest the line runs, as numbers of cells, in rising order; empty where nobody knows.
    pub places: Arc<[u64]>,
    /// What there is to say of the mark: its title in SVG, which viewers show beside it.
    pub note: Option<Arc<str>>,
    /// The words whose letters the mark is the filled outline of. PDF sets them in their font; other files hold the outline, and SVG
    /// the words beside it.
    pub text: Option<TextRun>,
}

/// One painted path.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// Geometry in user units, x right, y down.
    pub path: BezPath,
    /// How it is painted.
    pub paint: Paint,
    /// Where it comes from.
    pub provenance: Provenance,
}
