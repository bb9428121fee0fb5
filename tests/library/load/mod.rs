//! Tests of the model readers: formats, broken files and incomplete files.

mod gltf_reader;
mod incomplete_files;
mod model_files;
