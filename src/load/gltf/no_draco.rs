//! Stands for `draco` where the library is built without it.

use super::buffers::Buffers;
use super::json::{Draco, Primitive};
use super::streams::Streams;
use crate::error::{Error, ErrorKind};

/// Refuses the stream of a primitive.
pub fn decode(_: &Buffers, _: &Primitive, _: &Draco, _: &str) -> Result<Streams, Error> {
    Err(Error::new(
        "the model is compressed by Draco, which this program was built without (feature `draco`)",
    )
    .of_kind(ErrorKind::Unsupported)
    .remedy("export the model again without Draco compression"))
}
