//! What is near, and what meets: trees of boxes over faces, their rays, the dual space of views, and where
//! triangles intersect.

pub mod boxes;
mod dual_boxes;
pub mod dual_tree;
mod eight_boxes;
mod face_group;
mod fine_box;
pub mod finer;
pub mod intersect;
pub mod nearest;
pub(crate) mod parallel_rays;
mod ray_grid;
pub mod ray_tree;
pub mod trace;
pub mod triangle_pair;

pub use dual_boxes::DualFound;
pub use dual_tree::{DualTree, ToneTree};
