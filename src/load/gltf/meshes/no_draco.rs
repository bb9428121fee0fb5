//! Replaces `draco` in builds without the feature.

use super::vertex_streams::VertexStreams;
use crate::error::{Error, ErrorKind};
use crate::load::gltf::json::{Draco, Primitive};
use crate::load::gltf::storage::buffers::Buffers;

/// Returns an error for a compressed primitive.
pub fn decode(_: &Buffers, _: &Primitive, _: &Draco, _: &str) -> Result<VertexStreams, Error> {
    Err(Error::new(
        "the model is compressed by Draco, which this program was built without (feature `draco`)",
    )
    .of_kind(ErrorKind::Unsupported)
    .remedy("export the model again without Draco compression"))
}
