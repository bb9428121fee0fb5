//! Binary data of a glTF file: every count, offset and stride is checked before memory is allocated.
//!
//! Files, in reading order: [`container`] splits a GLB file into JSON and binary chunk; [`buffers`] the bytes
//! of buffers and buffer views, decompressed where needed; [`accessors`] typed values of accessors, sparse
//! ones included.

mod accessors;
pub(crate) mod buffers;
pub(crate) mod container;
