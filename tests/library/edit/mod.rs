//! Tests of scene edits: sections, exploded views and levels of detail.

mod detail_levels;
mod exploded_views;
mod section_areas;
mod section_hatching;
mod section_shells;
mod sections;
mod simplified_shapes;
