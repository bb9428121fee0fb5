//! Readers of model and drawing files that share no code with the library.

pub mod dxf_reader;
pub mod example_files;
pub mod glb_writer;
pub mod mesh_file;
pub mod pdf_reader;
pub mod plain_gltf;
pub mod shared_folder;
