//! What tests share: scenes, references that are slow and obvious, and measures.

pub mod dice;
pub mod eye;
pub mod hard_scenes;
pub mod imports;
pub mod ink;
pub mod judge;
pub mod long_run;
pub mod mesh_file;
pub mod models;
pub mod patches;
pub mod piercings;
pub mod pipeline;
pub mod polygon_lines;
pub mod polygon_truth;
pub mod polygons;
pub mod properties;
pub mod rays;
pub mod round_solids;
pub mod scenes;
pub mod seen;
pub mod segments;
pub mod solids;
pub mod torus_truth;
pub mod truth;
pub mod turning;
pub mod validity;
