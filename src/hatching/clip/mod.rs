//! Exact clipping of lines, dots and polygons to the cells of the page.
//!
//! Nothing is clipped against whole regions: only the border pieces near a shape are compared with it.
//! 1. A line is cut where it crosses border pieces ([`line_clip`]).
//! 2. Cells that a mark may fill are joined into domains ([`domain`]).
//! 3. A dot ([`disc`]) is clipped to its domain by tracing border and circle in turn ([`circle_clip`]; Weiler
//!    and Atherton 1977).
//! 4. A polygon is intersected with its domain on an integer grid ([`polygon_clip`], [`polygon_boolean`];
//!    Margalit and Knott 1989).
//!
//! Files, in reading order: [`line_clip`]; [`domain`]; [`disc`]; [`circle_clip`]; [`polygon_clip`];
//! [`polygon_boolean`].

pub(crate) mod circle_clip;
pub(crate) mod disc;
pub(crate) mod domain;
pub(crate) mod line_clip;
mod polygon_boolean;
pub(crate) mod polygon_clip;
