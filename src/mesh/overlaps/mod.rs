//! Stacking order of coplanar surfaces of different colours, such as a label on a wall.
//!
//! 1. A coarse grid finds the faces near another colour.
//! 2. Flat edges join faces to surfaces; surfaces are sorted into cells by their plane.
//! 3. In each cell, bounding boxes are swept along an axis, and triangles are clipped by triangles.
//! 4. Overlaps no larger than the slivers between two facetted copies of one curve are ignored.
//! 5. Of overlapping surfaces the smaller one is on top, in every view.
//!
//! Files, in reading order: [`overlay_order`] (steps 2, 3 and 5), [`colour_grid`] (step 1), [`common_area`]
//! (polygon clipping; Sutherland and Hodgman 1974), [`border_curves`] (step 4).

mod border_curves;
mod colour_grid;
mod common_area;
pub(crate) mod overlay_order;
