//! Whole drawings: properties that no change of numbering, place or notation may break, and approved pictures.

mod camera_stability;
mod default_drawings;
mod default_properties;
mod example_models;
mod golden;
mod invariances;
mod rewritten_models;
mod shared_models;
mod shared_preparation;
mod stage_drawings;
