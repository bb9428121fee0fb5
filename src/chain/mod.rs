//! [`Chain`]: view edges joined end to end, tidied, smoothed and fitted with curves.

pub mod options;

pub use options::ChainOptions;

use kurbo::{BezPath, Point};

use crate::lines::LineKind;
use crate::mesh::{MaterialId, PartId};

/// What a chain knows of the world at one of its points; travels with the chain so that strokes
/// never look back into the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Distance from the eye along the optical axis, world units.
    pub depth: f64,
}

/// View edges of one kind joined end to end.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    /// Points in user units of the page, x right, y down; a closed chain does not repeat its
    /// first point.
    pub points: Vec<Point>,
    /// One a point.
    pub samples: Vec<Sample>,
    /// Whether the last point joins the first.
    pub closed: bool,
    /// What line it is.
    pub kind: LineKind,
    /// A contour with background behind it.
    pub silhouette: bool,
    /// Number of surfaces that hide it; 0 = visible.
    pub invisibility: u16,
    /// Whether both surfaces that meet in it face the eye.
    pub both_seen: bool,
    /// Part it belongs to.
    pub part: PartId,
    /// Material beside it.
    pub material: MaterialId,
    /// Whether it lies on a smooth surface.
    pub smooth: bool,
    /// The curve that is drawn: fitted Béziers, or the polyline of `points`.
    pub path: BezPath,
}
