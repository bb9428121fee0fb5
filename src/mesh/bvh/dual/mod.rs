//! Search for contour edges and tone borders in dual space.
//!
//! The plane of a face is a point in four dimensions: its unit normal and its offset. An edge is the box
//! around the points of its two faces. A camera is a hyperplane through the origin, and contour edges are
//! the boxes it cuts.
//!
//! 1. Each box is stored in the smallest cube of a 16-ary tree that contains it.
//! 2. A query descends into the cubes whose bounding boxes the hyperplane cuts, and returns candidates.
//!
//! Source: Claes, Di Fiore, Vansichem and Van Reeth, IVCNZ 2001, section 4.
//!
//! Files, in reading order: [`dual_tree`] (`DualTree` for contours, `ToneTree` for tone borders),
//! [`dual_boxes`] (the tree).

pub(crate) mod dual_boxes;
pub(crate) mod dual_tree;
