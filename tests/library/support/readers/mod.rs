//! Readers of model and output files that share no code with the library.
//!
//! Reading order:
//!
//! 1. [`shared_folder`]: finds the optional shared models.
//! 2. [`example_files`], [`mesh_file`]: read OBJ, PLY, STL and GLB.
//! 3. [`plain_gltf`]: reads and poses animated glTF files. [`glb_writer`]: writes GLB files.
//! 4. [`dxf_reader`], [`pdf_reader`]: read the library's exports.

pub(crate) mod dxf_reader;
pub(crate) mod example_files;
pub(crate) mod glb_writer;
pub(crate) mod mesh_file;
pub(crate) mod pdf_reader;
pub(crate) mod plain_gltf;
pub(crate) mod shared_folder;
