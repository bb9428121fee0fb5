//! Readers of model and output files that share no code with the library.
//!
//! Reading order:
//!
//! 1. [`shared_folder`]: finds the optional shared models.
//! 2. [`example_files`], [`mesh_file`]: read OBJ, PLY, STL and GLB.
//! 3. [`plain_gltf`]: reads and poses animated glTF files. [`glb_writer`]: writes GLB files.
//! 4. [`dxf_reader`], [`pdf_reader`]: read the library's exports.

pub mod dxf_reader;
pub mod example_files;
pub mod glb_writer;
pub mod mesh_file;
pub mod pdf_reader;
pub mod plain_gltf;
pub mod shared_folder;
