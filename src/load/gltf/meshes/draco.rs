//! Decodes primitives compressed by Draco (KHR_draco_mesh_compression).

use draco_core::{DataType, DecodeLimits, DecoderBuffer, Mesh, MeshDecoder};
use glam::DVec3;

use super::vertex_streams::VertexStreams;
use crate::error::Error;
use crate::load::gltf::json::{Draco, Primitive};
use crate::load::gltf::storage::buffers::Buffers;
use crate::mesh::quantization;

/// Maximum number of triangles, and of vertices, in a compressed stream, independent of its header.
const MAX_DECODED_ELEMENTS: u64 = 1 << 26;

/// Decodes the stream of a primitive.
pub(crate) fn decode(
    buffers: &Buffers,
    primitive: &Primitive,
    packed: &Draco,
    uv_name: &str,
) -> Result<VertexStreams, Error> {
    let broken = |message: String| {
        Error::new(format!("the Draco stream cannot be decoded ({message})"))
            .remedy("export the model again without Draco compression")
    };
    let (bytes, _) = buffers.view(packed.buffer_view)?;
    let announced = |accessor: Option<usize>| {
        accessor
            .and_then(|accessor| buffers.announced(accessor))
            .map_or(MAX_DECODED_ELEMENTS, |count| (count as u64).min(MAX_DECODED_ELEMENTS))
    };
    let position = primitive.attributes.get("POSITION").copied();
    // The counts of the accessors limit the output; some exporters give too small counts.
    let limits = DecodeLimits::default()
        .with_max_points(announced(position).saturating_mul(4).min(MAX_DECODED_ELEMENTS))
        .with_max_faces(announced(primitive.indices).min(MAX_DECODED_ELEMENTS))
        .with_max_decoded_bytes(announced(position).saturating_mul(1024).min(1 << 31));
    let mut mesh = Mesh::new();
    MeshDecoder::new()
        .decode(&mut DecoderBuffer::new(bytes).with_limits(limits), &mut mesh)
        .map_err(|error| broken(error.message().to_owned()))?;

    let count = mesh.num_points();
    let values = |name: &str, lanes: usize| -> Result<Vec<f32>, Error> {
        let Some(&id) = packed.attributes.get(name) else { return Ok(Vec::new()) };
        let Some(attribute) = mesh.attribute_by_unique_id(id) else {
            return Err(broken(format!("it has no attribute {id} for {name}")));
        };
        let accessor = primitive.attributes.get(name).and_then(|index| buffers.root.accessors.get(*index));
        let full = match attribute.data_type() {
            DataType::Int8 => 127.0,
            DataType::Uint8 => 255.0,
            DataType::Int16 => 32767.0,
            DataType::Uint16 => 65535.0,
            _ => 1.0,
        };
        let scale = if accessor.is_some_and(|accessor| accessor.normalized) { 1.0 / full } else { 1.0 };
        let mut values = attribute.read_f32s(count, lanes);
        if scale != 1.0 {
            values.iter_mut().for_each(|value| *value *= scale);
        }
        Ok(values)
    };
    let colours = match primitive.attributes.get("COLOR_0").map(|index| buffers.lanes(*index)).transpose()? {
        Some(3) => {
            let rgb = values("COLOR_0", 3)?;
            rgb.as_chunks().0.iter().map(|[r, g, b]| [*r, *g, *b, 1.0]).collect()
        }
        Some(_) => values("COLOR_0", 4)?.as_chunks().0.to_vec(),
        None => Vec::new(),
    };
    let positions = values("POSITION", 3)?;
    let positions = positions.as_chunks().0.iter();
    let mut positions: Vec<DVec3> =
        positions.map(|p: &[f32; 3]| DVec3::from_array(p.map(f64::from))).collect();
    let normals = values("NORMAL", 3)?.as_chunks().0.to_vec();
    let triangles: Vec<[u32; 3]> = mesh.faces().iter().map(|face| face.map(|point| point.0)).collect();
    quantization::dequantize(&mut positions, &triangles, &normals);
    Ok(VertexStreams {
        positions,
        normals,
        uvs: values(uv_name, 2)?.as_chunks().0.to_vec(),
        colours,
        triangles: Some(triangles),
    })
}
