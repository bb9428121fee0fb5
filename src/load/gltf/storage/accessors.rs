//! Reads glTF accessors: typed arrays in binary buffers, such as positions and indices, including sparse
//! ones.
//!
//! Every count, offset and stride is checked before memory is allocated, so that a damaged file cannot
//! exhaust memory.
//!
//! Source: Khronos Group, glTF 2.0 specification, section 3.6.2 (accessors).

use super::buffers::Buffers;
use crate::error::Error;
use crate::load::gltf::json;
use crate::load::gltf::json::lenient_index::DisplayIndex;

/// Type of one component of an element.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ComponentType {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl ComponentType {
    /// Type of a glTF `componentType` code.
    fn new(code: u32) -> Result<Self, Error> {
        Ok(match code {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return Err(Error::new(format!("componentType {code} is not defined in glTF"))),
        })
    }

    /// Size in bytes.
    fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    /// Maximum value of an index type, which restarts a strip. An error for types that cannot hold indices.
    fn restart(self) -> Result<u32, Error> {
        match self {
            Self::U8 => Ok(u32::from(u8::MAX)),
            Self::U16 => Ok(u32::from(u16::MAX)),
            Self::U32 => Ok(u32::MAX),
            other => Err(Error::new(format!("indices must be whole numbers without sign, not {other:?}"))),
        }
    }
}

/// Elements of an accessor in their buffer view, `stride` bytes apart.
#[derive(Debug, Clone, Copy)]
struct Elements<'a> {
    /// `None` if all elements are zero.
    bytes: Option<&'a [u8]>,
    stride: usize,
    count: usize,
    component: ComponentType,
    normalized: bool,
}

/// Indices of a primitive.
#[derive(Debug, Clone)]
pub(crate) struct Indices {
    /// The indices.
    pub values: Vec<u32>,
    /// Maximum value of the index type, which restarts a strip.
    pub restart: u32,
}

impl Buffers<'_> {
    fn accessor(&self, index: usize) -> Result<&json::Accessor, Error> {
        self.root.accessors.get(index).ok_or_else(|| {
            let count = self.root.accessors.len();
            Error::new(format!("is pointed to, but the file has {count}"))
                .at(format!("accessor {}", DisplayIndex(index)))
        })
    }

    /// Number of components of an element, such as 4 for `VEC4`.
    pub(crate) fn lanes(&self, index: usize) -> Result<usize, Error> {
        let accessor = self.accessor(index)?;
        lanes(&accessor.shape).map_err(|error| error.at(format!("accessor {index}")))
    }

    /// Number of elements according to the JSON, unchecked.
    #[cfg(feature = "draco")]
    pub(crate) fn announced(&self, index: usize) -> Option<usize> {
        self.root.accessors.get(index).map(|accessor| accessor.count)
    }

    /// Whether the data of an accessor is in a buffer view, and not in a compressed stream.
    pub(crate) fn is_stored(&self, index: usize) -> bool {
        self.root.accessors.get(index).is_some_and(|accessor| accessor.buffer_view.is_some())
    }

    /// Reads elements of `N` components as `f64` and converts them by `make`. Normalised integers become -1
    /// to 1.
    pub(crate) fn read<const N: usize, R: Clone>(
        &self,
        index: usize,
        make: impl Fn([f64; N]) -> R + Copy,
    ) -> Result<Vec<R>, Error> {
        let place = |error: Error| error.within(format!("accessor {index}"));
        let accessor = self.accessor(index)?;
        let found = self.lanes(index)?;
        if found != N {
            let message = format!("it has {} components per element, but {N} are needed", accessor.shape);
            return Err(place(Error::new(message)));
        }
        let elements = self.elements(accessor, N).map_err(place)?;
        let mut values = elements.collect(make);
        if let Some(sparse) = &accessor.sparse {
            self.apply_sparse(&mut values, sparse, elements, make).map_err(place)?;
        }
        Ok(values)
    }

    /// Quantisation step of the values of an accessor with integer components; 0 for floating point.
    pub(crate) fn step(&self, index: usize) -> f64 {
        let Ok(accessor) = self.accessor(index) else { return 0.0 };
        let largest = match ComponentType::new(accessor.component_type) {
            Ok(ComponentType::I8) => f64::from(i8::MAX),
            Ok(ComponentType::U8) => f64::from(u8::MAX),
            Ok(ComponentType::I16) => f64::from(i16::MAX),
            Ok(ComponentType::U16) => f64::from(u16::MAX),
            Ok(ComponentType::U32) => f64::from(u32::MAX),
            Ok(ComponentType::F32) | Err(_) => return 0.0,
        };
        if accessor.normalized { 1.0 / largest } else { 1.0 }
    }

    /// Reads the indices of a primitive.
    pub(crate) fn indices(&self, index: usize) -> Result<Indices, Error> {
        let place = |error: Error| error.within(format!("accessor {index}"));
        let accessor = self.accessor(index)?;
        if accessor.shape != "SCALAR" {
            return Err(place(Error::new(format!("indices must be SCALAR, not {}", accessor.shape))));
        }
        let restart =
            ComponentType::new(accessor.component_type).and_then(ComponentType::restart).map_err(place)?;
        if accessor.sparse.is_some() {
            let values = self.read(index, |[value]: [f64; 1]| value as u32)?;
            return Ok(Indices { values, restart });
        }
        let elements = self.elements(accessor, 1).map_err(place)?;
        elements.whole_numbers().map_err(place)
    }

    /// Reads one byte per scalar: bit fields of some extensions, never normalised.
    pub(crate) fn bytes(&self, index: usize) -> Result<Vec<u8>, Error> {
        let accessor = self.accessor(index)?;
        if ComponentType::new(accessor.component_type).is_ok_and(|component| component != ComponentType::U8) {
            let message =
                format!("bits are stored in unsigned bytes, not componentType {}", accessor.component_type);
            return Err(Error::new(message).at(format!("accessor {index}")));
        }
        if accessor.normalized {
            return self.read(index, |[value]: [f64; 1]| (value * 255.0).round() as u8);
        }
        self.read(index, |[value]: [f64; 1]| value as u8)
    }

    fn elements(&self, accessor: &json::Accessor, lanes: usize) -> Result<Elements<'_>, Error> {
        let component = ComponentType::new(accessor.component_type)?;
        let size = lanes * component.size();
        let mut elements = Elements {
            bytes: None,
            stride: size,
            count: accessor.count,
            component,
            normalized: accessor.normalized,
        };
        let Some(view) = accessor.buffer_view else {
            // Zeros take no space in the file, so their number is limited by the size of its data.
            if accessor.count > self.total().max(1 << 16) {
                let message = format!("it has {} elements without data", accessor.count);
                return Err(Error::new(message));
            }
            return Ok(elements);
        };
        let (bytes, stride) = self.view(view)?;
        elements.stride = stride.unwrap_or(size);
        elements.bytes = Some(elements.within(bytes, accessor.byte_offset, size).map_err(|message| {
            Error::new(format!("{message} in bufferView {view} of {} bytes", bytes.len()))
        })?);
        Ok(elements)
    }

    /// Replaces the elements that a sparse accessor lists. `like` gives the type of the new values.
    fn apply_sparse<const N: usize, R: Clone>(
        &self,
        values: &mut [R],
        sparse: &json::Sparse,
        like: Elements,
        make: impl Fn([f64; N]) -> R,
    ) -> Result<(), Error> {
        let part = |view: usize, offset: usize, component: ComponentType, lanes: usize, normalized: bool| {
            let (bytes, _) = self.view(view)?;
            let stride = lanes * component.size();
            let mut part = Elements { bytes: None, stride, count: sparse.count, component, normalized };
            part.bytes = Some(part.within(bytes, offset, stride).map_err(|message| {
                Error::new(format!("sparse: {message} in bufferView {view} of {} bytes", bytes.len()))
            })?);
            Ok::<_, Error>(part)
        };
        let index_type = ComponentType::new(sparse.indices.component_type)?;
        let sparse_indices =
            part(sparse.indices.buffer_view, sparse.indices.byte_offset, index_type, 1, false)?;
        let changed =
            part(sparse.values.buffer_view, sparse.values.byte_offset, like.component, N, like.normalized)?;
        let count = values.len();
        for (element_index, value) in
            sparse_indices.whole_numbers()?.values.into_iter().zip(changed.collect(make))
        {
            match values.get_mut(element_index as usize) {
                Some(old) => *old = value,
                None => {
                    let message =
                        format!("sparse index {element_index} is out of range, there are {count} elements");
                    return Err(Error::new(message));
                }
            }
        }
        Ok(())
    }
}

impl<'a> Elements<'a> {
    /// The bytes of a view that these elements occupy, from `offset` to the end of the last element of `size`
    /// bytes; an error if they do not fit.
    fn within(&self, bytes: &'a [u8], offset: usize, size: usize) -> Result<&'a [u8], String> {
        if self.count == 0 {
            return Ok(&[]);
        }
        if self.stride < size {
            return Err(format!("elements of {size} bytes do not fit into the stride {}", self.stride));
        }
        let end = (self.count - 1).checked_mul(self.stride).and_then(|last| last.checked_add(size));
        let end = end.and_then(|length| length.checked_add(offset));
        end.and_then(|end| bytes.get(offset..end)).ok_or_else(|| {
            format!("{} elements of {size} bytes from byte {offset} on do not fit", self.count)
        })
    }

    /// Converts all elements; the component type is matched once, not for each element.
    fn collect<const N: usize, R: Clone>(&self, make: impl Fn([f64; N]) -> R) -> Vec<R> {
        let Some(bytes) = self.bytes else {
            return vec![make([0.0; N]); self.count];
        };
        let stride = self.stride;
        match (self.component, self.normalized) {
            (ComponentType::F32, _) => {
                gather(bytes, stride, |b: [u8; 4]| f64::from(f32::from_le_bytes(b)), make)
            }
            (ComponentType::U32, false) => {
                gather(bytes, stride, |b: [u8; 4]| f64::from(u32::from_le_bytes(b)), make)
            }
            (ComponentType::U16, false) => {
                gather(bytes, stride, |b: [u8; 2]| f64::from(u16::from_le_bytes(b)), make)
            }
            (ComponentType::I16, false) => {
                gather(bytes, stride, |b: [u8; 2]| f64::from(i16::from_le_bytes(b)), make)
            }
            (ComponentType::U8, false) => gather(bytes, stride, |[b]: [u8; 1]| f64::from(b), make),
            (ComponentType::I8, false) => {
                gather(bytes, stride, |b: [u8; 1]| f64::from(i8::from_le_bytes(b)), make)
            }
            (ComponentType::U32, true) => {
                gather(bytes, stride, |b: [u8; 4]| f64::from(u32::from_le_bytes(b)) / 4_294_967_295.0, make)
            }
            (ComponentType::U16, true) => {
                gather(bytes, stride, |b: [u8; 2]| f64::from(u16::from_le_bytes(b)) / 65535.0, make)
            }
            (ComponentType::I16, true) => gather(
                bytes,
                stride,
                |b: [u8; 2]| (f64::from(i16::from_le_bytes(b)) / 32767.0).max(-1.0),
                make,
            ),
            (ComponentType::U8, true) => gather(bytes, stride, |[b]: [u8; 1]| f64::from(b) / 255.0, make),
            (ComponentType::I8, true) => {
                gather(bytes, stride, |b: [u8; 1]| (f64::from(i8::from_le_bytes(b)) / 127.0).max(-1.0), make)
            }
        }
    }

    /// Reads scalars of an unsigned integer type.
    fn whole_numbers(&self) -> Result<Indices, Error> {
        let restart = self.component.restart()?;
        let Some(bytes) = self.bytes else {
            return Ok(Indices { values: vec![0; self.count], restart });
        };
        let size = self.component.size();
        let values = match self.component {
            ComponentType::U32 if self.stride == size => {
                bytes.as_chunks().0.iter().map(|b| u32::from_le_bytes(*b)).collect()
            }
            ComponentType::U16 if self.stride == size => {
                bytes.as_chunks().0.iter().map(|b| u32::from(u16::from_le_bytes(*b))).collect()
            }
            ComponentType::U32 => bytes
                .chunks(self.stride)
                .filter_map(|b| b.first_chunk())
                .map(|b| u32::from_le_bytes(*b))
                .collect(),
            ComponentType::U16 => bytes
                .chunks(self.stride)
                .filter_map(|b| b.first_chunk())
                .map(|b| u32::from(u16::from_le_bytes(*b)))
                .collect(),
            _ => bytes.iter().step_by(self.stride.max(1)).map(|b| u32::from(*b)).collect(),
        };
        Ok(Indices { values, restart })
    }
}

/// Converts elements of `N` components of `S` bytes each; `bytes` ends with the last element.
fn gather<const N: usize, const S: usize, R>(
    bytes: &[u8],
    stride: usize,
    decode: impl Fn([u8; S]) -> f64,
    make: impl Fn([f64; N]) -> R,
) -> Vec<R> {
    let element = |chunk: &[u8]| {
        let chunk = chunk.get(..N * S).unwrap_or_default();
        let (lanes, _) = chunk.as_chunks::<S>();
        make(std::array::from_fn(|lane| lanes.get(lane).map_or(0.0, |b| decode(*b))))
    };
    if stride == N * S {
        // Usual case, with a chunk length known at compile time.
        bytes.chunks_exact(N * S).map(element).collect()
    } else {
        bytes.chunks(stride.max(1)).map(element).collect()
    }
}

/// Number of components of a glTF accessor `type`.
fn lanes(shape: &str) -> Result<usize, Error> {
    Ok(match shape {
        "SCALAR" => 1,
        "VEC2" => 2,
        "VEC3" => 3,
        "VEC4" | "MAT2" => 4,
        "MAT3" => 9,
        "MAT4" => 16,
        _ => {
            return Err(Error::new(format!(
                "type `{}` is not defined in glTF",
                crate::load::gltf::uri::shortened(shape)
            )));
        }
    })
}
