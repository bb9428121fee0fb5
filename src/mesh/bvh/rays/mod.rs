//! Ray queries against a mesh, for many rays of one direction at once.
//!
//! 1. Rays become points on a 2-D grid, and groups of eight projected faces are compared with the rays in the
//!    cells they cover.
//! 2. If faces cover too many cells, the remaining rays use the tree of [`bvh`](super); triangles are tested
//!    by Möller and Trumbore 1997.
//!
//! Files, in reading order: [`parallel_rays`] (the sweep over faces), [`ray_grid`] (grid of rays),
//! [`face_group`] (eight faces in SIMD-friendly layout).

mod face_group;
pub(crate) mod parallel_rays;
mod ray_grid;
