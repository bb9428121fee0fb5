//! Model files: the formats, broken files, and files that lack something.

mod gltf_reader;
mod incomplete_files;
mod model_files;
