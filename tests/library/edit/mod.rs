//! Scenes cut open, taken apart or simplified.

mod detail_levels;
mod exploded_views;
mod section_areas;
mod section_shells;
mod sections;
