//! Reads the vertices of a primitive, with the texture coordinates that its material uses.

use glam::DVec3;

use super::draco;
use super::vertex_streams::VertexStreams;
use crate::error::Error;
use crate::geometry::numbers::portable_math;
use crate::load::gltf::json::{Primitive, TextureTransform};
use crate::load::gltf::material_reader;
use crate::load::gltf::storage::buffers::Buffers;

/// Reads the vertex attributes that a drawing needs.
pub(crate) fn read(buffers: &Buffers, primitive: &Primitive) -> Result<VertexStreams, Error> {
    let attribute = |name: &str| primitive.attributes.get(name).copied();
    let position = attribute("POSITION").ok_or_else(|| Error::new("it has no POSITION"))?;
    let uv_name = uv_name(buffers, primitive);
    let mut streams = match &primitive.extensions.draco {
        Some(packed) if !buffers.is_stored(position) => draco::decode(buffers, primitive, packed, &uv_name)?,
        _ => VertexStreams {
            positions: buffers.read(position, DVec3::from_array)?,
            normals: match attribute("NORMAL") {
                Some(normal) => buffers.read(normal, |n: [f64; 3]| n.map(|v| v as f32))?,
                None => Vec::new(),
            },
            uvs: match attribute(&uv_name) {
                Some(uv) => buffers.read(uv, |uv: [f64; 2]| uv.map(|v| v as f32))?,
                None => Vec::new(),
            },
            colours: match attribute("COLOR_0") {
                Some(colour) => colours(buffers, colour)?,
                None => Vec::new(),
            },
            triangles: None,
        },
    };
    streams.check()?;
    if let Some(transform) = uv_transform(buffers, primitive) {
        turn_uvs(&mut streams.uvs, transform);
    }
    Ok(streams)
}

fn colours(buffers: &Buffers, accessor: usize) -> Result<Vec<[f32; 4]>, Error> {
    if buffers.lanes(accessor)? == 3 {
        return buffers.read(accessor, |[r, g, b]: [f64; 3]| [r as f32, g as f32, b as f32, 1.0]);
    }
    buffers.read(accessor, |rgba: [f64; 4]| rgba.map(|v| v as f32))
}

/// Attribute with the texture coordinates of the base-colour texture.
pub(crate) fn uv_name(buffers: &Buffers, primitive: &Primitive) -> String {
    let material = primitive.material.and_then(|material| buffers.root.materials.get(material));
    let texture = material.and_then(material_reader::base_texture);
    let moved = texture.and_then(|texture| texture.extensions.transform.as_ref()?.tex_coord);
    let set = moved.or_else(|| texture.map(|texture| texture.tex_coord)).unwrap_or(0);
    format!("TEXCOORD_{set}")
}

/// Material of a primitive whose texture coordinates are not simply the first set.
pub(crate) fn uv_variant(buffers: &Buffers, primitive: &Primitive) -> Option<usize> {
    let plain = uv_transform(buffers, primitive).is_none() && uv_name(buffers, primitive) == "TEXCOORD_0";
    primitive.material.filter(|_| !plain)
}

/// Transform of the base-colour texture's coordinates (KHR_texture_transform).
fn uv_transform<'a>(buffers: &Buffers<'a>, primitive: &Primitive) -> Option<&'a TextureTransform> {
    let root = buffers.root;
    let texture = material_reader::base_texture(root.materials.get(primitive.material?)?)?;
    texture.extensions.transform.as_ref()
}

fn turn_uvs(uvs: &mut [[f32; 2]], transform: &TextureTransform) {
    let [right, down] = transform.offset.unwrap_or_default();
    let [wide, high] = transform.scale.unwrap_or([1.0; 2]);
    let angle = transform.rotation.unwrap_or(0.0);
    let (sin, cos) = (portable_math::sin(angle), portable_math::cos(angle));
    for uv in uvs {
        let [u, v] = [f64::from(uv[0]) * wide, f64::from(uv[1]) * high];
        *uv = [(u * cos + v * sin + right) as f32, (v * cos - u * sin + down) as f32];
    }
}
