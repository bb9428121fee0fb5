//! Tests of whole drawings: invariances, checks by ray casts, and approved pictures.

mod camera_stability;
mod default_drawings;
mod default_properties;
mod example_gltf_models;
mod example_models;
mod golden;
mod invariances;
mod rewritten_models;
mod shared_models;
mod shared_preparation;
mod stage_drawings;
