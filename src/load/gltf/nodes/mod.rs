//! The node hierarchy of a glTF file, resolved into world space.
//!
//! 1. [`product_names`] gives unnamed nodes of CAD exports the name of their product.
//! 2. [`hierarchy`] finds the nodes of the scene, their order and world transforms.
//! 3. [`part_assembly`] makes a part of each node with a mesh and of each of its [`instances`].
//! 4. [`cameras_and_lights`] places the cameras and lights of nodes.

pub(crate) mod cameras_and_lights;
pub(crate) mod hierarchy;
mod instances;
pub(crate) mod part_assembly;
pub(crate) mod product_names;
