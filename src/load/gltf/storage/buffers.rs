//! Bytes of buffers and buffer views, decompressed where needed.

use std::borrow::Cow;
use std::cell::OnceCell;
use std::io;

use crate::error::Error;
use crate::load::gltf::json::lenient_index::DisplayIndex;
use crate::load::gltf::json::{Buffer, Root};
use crate::load::gltf::{meshopt, uri};

/// Reads up to a number of bytes of a file, given its path relative to the model.
pub(crate) type Fetch<'f> = dyn Fn(&str, usize) -> io::Result<Vec<u8>> + 'f;

/// All buffers of a file.
#[derive(Debug)]
pub(crate) struct Buffers<'a> {
    /// JSON that describes them.
    pub root: &'a Root,
    buffers: Vec<Cow<'a, [u8]>>,
    decompressed: Vec<OnceCell<Result<Vec<u8>, Error>>>,
}

impl<'a> Buffers<'a> {
    /// Collects the buffers: the BIN chunk, data URIs and files next to the model.
    pub(crate) fn gather(root: &'a Root, bin: Option<&'a [u8]>, fetch: &Fetch) -> Result<Self, Error> {
        let mut buffers = Vec::with_capacity(root.buffers.len());
        for (number, buffer) in root.buffers.iter().enumerate() {
            let bin = bin.filter(|_| number == 0);
            let bytes = bytes_of(buffer, bin, fetch).map_err(|error| error.at(format!("buffer {number}")))?;
            buffers.push(bytes);
        }
        let decompressed = root.buffer_views.iter().map(|_| OnceCell::new()).collect();
        Ok(Self { root, buffers, decompressed })
    }

    /// Number of bytes of all buffers: a bound for allocations that the file requests without data.
    pub(crate) fn total(&self) -> usize {
        self.buffers.iter().map(|buffer| buffer.len()).sum()
    }

    /// Bytes of a view, and its stride, if it has one.
    pub(crate) fn view(&self, index: usize) -> Result<(&[u8], Option<usize>), Error> {
        let place = || format!("bufferView {}", DisplayIndex(index));
        let Some((view, cell)) = self.root.buffer_views.get(index).zip(self.decompressed.get(index)) else {
            let count = self.root.buffer_views.len();
            return Err(Error::new(format!("is pointed to, but the file has {count}")).at(place()));
        };
        let packed = view.extensions.ext_meshopt.as_ref().or(view.extensions.khr_meshopt.as_ref());
        if let Some(packed) = packed {
            let unpacked = cell.get_or_init(|| {
                let bytes = self.range(packed.buffer, packed.byte_offset, packed.byte_length)?;
                meshopt::decode(packed, bytes)
            });
            return match unpacked {
                Ok(bytes) => Ok((bytes, view.byte_stride)),
                Err(error) => Err(error.clone().at(place())),
            };
        }
        let bytes = self.range(view.buffer, view.byte_offset, view.byte_length);
        bytes.map(|bytes| (bytes, view.byte_stride)).map_err(|error| error.at(place()))
    }

    fn range(&self, buffer: usize, start: usize, length: usize) -> Result<&[u8], Error> {
        let Some(bytes) = self.buffers.get(buffer) else {
            return Err(Error::new(format!(
                "points to buffer {}, the file has {}",
                DisplayIndex(buffer),
                self.buffers.len()
            )));
        };
        start.checked_add(length).and_then(|end| bytes.get(start..end)).ok_or_else(|| {
            Error::new(format!(
                "{length} bytes from byte {start} do not fit into buffer {buffer} of {} bytes",
                bytes.len()
            ))
        })
    }
}

fn bytes_of<'a>(buffer: &Buffer, bin: Option<&'a [u8]>, fetch: &Fetch) -> Result<Cow<'a, [u8]>, Error> {
    let fallback = [&buffer.extensions.ext_meshopt, &buffer.extensions.khr_meshopt];
    if fallback.into_iter().flatten().any(|extension| extension.fallback) {
        // A fallback buffer only repeats the content of compressed views.
        return Ok(Cow::Borrowed(&[]));
    }
    let bytes: Cow<'a, [u8]> = match &buffer.uri {
        None => Cow::Borrowed(bin.ok_or_else(|| {
            Error::new("has no `uri`, and the file has no BIN chunk for it")
                .remedy("the BIN chunk may have been lost; export the model again")
        })?),
        Some(text) => Cow::Owned(match uri::data(text) {
            Some(data) => data.map_err(Error::new)?,
            None => external(text, buffer.byte_length, fetch)?,
        }),
    };
    if bytes.len() < buffer.byte_length {
        let (announced, found) = (buffer.byte_length, bytes.len());
        return Err(Error::new(format!("the file promises {announced} bytes and has {found}")));
    }
    Ok(bytes)
}

fn external(text: &str, length: usize, fetch: &Fetch) -> Result<Vec<u8>, Error> {
    let path = uri::inside_folder(text).map_err(|message| {
        Error::new(message).remedy("put the file next to the model and use a relative path")
    })?;
    fetch(&path, length).map_err(|error| {
        Error::io(format!("`{path}` cannot be read"), error).remedy("keep it next to the model")
    })
}
