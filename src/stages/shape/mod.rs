//! The surface a mesh stands for: where it is creased and where it is round, its normals, how it bends, and
//! finer faces where it does.

pub mod bends;
mod beyond;
mod crease_chains;
pub mod curvature;
mod curvature_derivative;
mod cut_pieces;
mod cylinder;
pub mod cylinders;
mod diffusion;
pub mod edge_arc;
pub mod fans;
pub mod feature_size;
pub mod file_normals;
mod free_forms;
pub mod hard_edges;
pub mod marking;
mod middle_lines;
mod near_rays;
mod normal_sum;
mod parting;
pub mod patches;
mod planes;
mod principal;
pub mod refine;
mod rims;
mod roughness;
mod rounded;
mod roundings;
mod shallow;
mod slender;
pub mod smooth_normals;
mod smooth_vertices;
pub mod splice;
mod straight;
mod thickness;
mod walk;
mod wrinkles;

pub use curvature::Curvature;
pub use cylinders::{Cylinder, cylinders};
pub use edge_arc::EdgeArc;
pub use hard_edges::HardEdges;
pub use patches::Patches;
pub use principal::Principal;
pub use rounded::Origin;
pub use smooth_normals::SmoothNormals;
