//! The views of a sheet, and their places on the free paper.
//!
//! 1. `view_plan` lists the views and the scenes that they show: the model, its sections, the exploded
//!    model, the details.
//! 2. `titles_and_notes` writes the notes and the titles of views.
//! 3. `view_arrangement` tries the scales of the series from the largest: views in projection stand in rows
//!    and columns, the others go to the best free rectangles.
//! 4. `free_rectangles` keeps the maximal free rectangles of the paper.
//!
//! Source: ISO 128-3:2020 and ISO 5456-2:1996.

mod free_rectangles;
pub(crate) mod titles_and_notes;
pub(crate) mod view_arrangement;
pub(crate) mod view_plan;
