//! Input and result of balloon placement: a [`PlacementRequest`] for each balloon, the [`PlacementArea`] of
//! the panel, and the [`PlacedBalloon`]s.
//!
//! Lengths and positions are in mm on the page, y down.

use kurbo::Point;

use crate::page::figure::CoverageGrid;
use crate::page::layout::{ConvexPolygon, Reading};

/// A speech balloon or caption to be placed.
#[derive(Debug, Clone)]
pub(crate) struct PlacementRequest {
    /// Convex hulls of its possible shapes, preferred first, centred at the origin.
    pub hulls: Vec<ConvexPolygon>,
    /// Convex hull of the part that its tail points at, and the exact point. `None` for a balloon without a
    /// tail.
    pub target: Option<(ConvexPolygon, Point)>,
    /// Em size of its letters, mm.
    pub em: f64,
    /// Minimum length of its tail, mm.
    pub min_tail_length: f64,
    /// Half the width of its tail at the balloon, mm.
    pub tail_half_width: f64,
    /// Centre on the page, if the page file gives one.
    pub at: Option<Point>,
    /// Whether it belongs in the corner where reading starts, as captions do.
    pub is_caption: bool,
}

/// The area for balloons in a panel.
#[derive(Debug, Clone)]
pub(crate) struct PlacementArea {
    /// The outline that contains all balloons.
    pub outline: ConvexPolygon,
    /// Areas that no balloon may cover, such as faces and parts in the key `keep`. A tail may cover only
    /// the area of its target.
    pub protected: Vec<ConvexPolygon>,
    /// Areas that neither balloons nor tails may cover, such as sound effects.
    pub obstacles: Vec<ConvexPolygon>,
    /// The area that models cover; balloons avoid it if possible.
    pub cover: Option<CoverageGrid>,
    /// Minimum gap between balloons and other areas, mm.
    pub gap: f64,
    /// Reading direction.
    pub reading: Reading,
}

/// A placed balloon.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PlacedBalloon {
    /// Index of the chosen shape in [`PlacementRequest::hulls`].
    pub shape: usize,
    /// Its centre.
    pub middle: Point,
    /// End point of its tail; `None` for a balloon without a tail.
    pub tip: Option<Point>,
    /// Its hull on the page.
    pub hull: ConvexPolygon,
}
