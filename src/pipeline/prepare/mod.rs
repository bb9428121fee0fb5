//! A scene prepared for a style: everything that does not depend on the camera.
//!
//! 1. Materials that the style leaves out are removed, and the rest is welded into a mesh ([`prepare_mesh`]).
//! 2. Creases, smooth patches and paints are found ([`prepared_scene`]).
//! 3. For animations this is done once at rest; poses reuse topology, creases and paints ([`rigged_scene`]).
//!
//! Files, in reading order: [`prepare_mesh`]; [`prepared_scene`]; [`rigged_scene`].

mod prepare_mesh;
pub(crate) mod prepared_scene;
pub(crate) mod rigged_scene;
