//! Writers of model files: [`glb`] binary glTF, [`obj`] OBJ and MTL, [`ply`] binary PLY, [`stl`] binary STL.

pub mod glb;
pub mod obj;
pub mod ply;
pub mod stl;
