//! Ray queries against a mesh.
//!
//! 1. `ray_tree` walks an 8-wide bounding volume hierarchy; triangles are tested by Möller and Trumbore
//!    1997.
//! 2. `parallel_rays` handles many rays of one direction: rays become points on a 2-D grid, and groups of
//!    eight projected faces are compared with the rays in the cells they cover.
//! 3. If faces cover too many cells, the remaining rays use the tree.
//!
//! Files, in reading order: [`ray_tree`], [`parallel_rays`] (the sweep over faces), [`ray_grid`] (grid of
//! rays), [`face_group`] (eight faces in SIMD-friendly layout).

mod face_group;
pub(crate) mod parallel_rays;
mod ray_grid;
pub(crate) mod ray_tree;
