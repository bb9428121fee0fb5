//! One geometry from the primitives of a glTF mesh.
//!
//! 1. [`vertex_reader`] reads positions, normals, colours and texture coordinates into [`vertex_streams`];
//!    `draco` decompresses primitives of KHR_draco_mesh_compression, and `no_draco` replaces it in builds
//!    without that feature.
//! 2. [`primitive_modes`] makes triangles and wires from indices.
//! 3. [`edge_visibility`] reads which triangle sides the file hides or marks as hard.
//! 4. [`skin_and_morphs`] reads morph targets and joint weights.
//! 5. [`mesh_geometry`] joins the primitives, sharing vertices that several of them use.

#[cfg(feature = "draco")]
mod draco;
#[cfg(not(feature = "draco"))]
#[path = "no_draco.rs"]
mod draco;
mod edge_visibility;
pub(crate) mod mesh_geometry;
mod primitive_modes;
pub(crate) mod skin_and_morphs;
mod vertex_reader;
mod vertex_streams;
