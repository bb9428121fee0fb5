//! SVG: Inkscape layers or groups of parts, compact and in canonical order.
//!
//! 1. The path data of all marks is written in canonical form, in parallel chunks of fixed size
//!    (`mark_order::MarkPaths`, with `export::paths`).
//! 2. Marks of equal paint are collected into runs and sorted by path data; their order inside a run makes no
//!    difference (`mark_order`).
//! 3. Painting attributes shared by most marks move to the group (`paint_attributes`).
//! 4. Groups and marks are written (`svg_drawing`, `mark_elements`).
//!
//! Files, in reading order: `svg_options`; `svg_drawing` one drawing; `mark_elements` one mark;
//! `paint_attributes`; `mark_order`; `part_groups` marks grouped by part without changing the picture;
//! `page_cells` a conservative test whether marks may touch; `svg_images` marks that show pictures;
//! `hotspots` areas that answer the pointer; `svg_composition` pages of several drawings.

mod hotspots;
mod mark_elements;
pub(crate) mod mark_order;
mod page_cells;
mod paint_attributes;
mod part_groups;
mod svg_composition;
pub(crate) mod svg_drawing;
mod svg_images;
pub(crate) mod svg_options;
