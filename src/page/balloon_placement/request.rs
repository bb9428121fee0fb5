//! Input and result of balloon placement: [`PlacementRequest`], [`PlacementArea`] and [`PlacedBalloon`].

use kurbo::Point;

use crate::page::figure::CoverageGrid;
use crate::page::layout::{ConvexPolygon, Reading};

/// A balloon that needs a place.
#[derive(Debug, Clone)]
pub struct PlacementRequest {
    /// Hulls of its possible shapes, preferred first, centred at the origin.
    pub hulls: Vec<ConvexPolygon>,
    /// Hull of the target of its tail, and the point that the tail points to.
    pub target: Option<(ConvexPolygon, Point)>,
    /// Em size of its letters.
    pub em: f64,
    /// Minimum length of its tail.
    pub tail: f64,
    /// Half the width of its tail at the balloon.
    pub foot: f64,
    /// Centre from the page file, if given.
    pub at: Option<Point>,
    /// Whether it belongs in the corner where reading starts, as captions do.
    pub is_caption: bool,
}

/// The area for balloons in a panel.
#[derive(Debug, Clone)]
pub struct PlacementArea {
    /// The outline that contains all balloons.
    pub outline: ConvexPolygon,
    /// Areas that balloons and the tails of others must not cover.
    pub kept: Vec<ConvexPolygon>,
    /// Areas that neither balloons nor tails may cover.
    pub obstacles: Vec<ConvexPolygon>,
    /// The area that models cover; balloons avoid it if possible.
    pub cover: Option<CoverageGrid>,
    /// Minimum gap between balloons and other areas.
    pub gap: f64,
    /// Reading direction.
    pub reading: Reading,
}

/// A placed balloon.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacedBalloon {
    /// Index of its shape.
    pub shape: usize,
    /// Its centre.
    pub middle: Point,
    /// End of its tail.
    pub tip: Option<Point>,
    /// Its hull on the page.
    pub hull: ConvexPolygon,
}
