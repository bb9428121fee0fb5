//! Makes one [`Geometry`] from all primitives of a mesh, in the stored pose.

use std::collections::BTreeMap;

use glam::{DAffine3, DVec3};

use super::primitive_modes::{PrimitiveElements, PrimitiveMode};
use super::{edge_visibility, skin_and_morphs, vertex_reader};
use crate::animation::DeformableMesh;
use crate::error::Error;
use crate::load::gltf::json::Primitive;
use crate::load::gltf::json::lenient_index::DisplayIndex;
use crate::load::gltf::missing_references::MissingReferences;
use crate::load::gltf::storage::buffers::Buffers;
use crate::load::gltf::{material_reader, uri};
use crate::mesh::EdgeMark;
use crate::scene::{Geometry, Warnings};

/// No normals or texture coordinates.
const NO_INDICES: [u32; 3] = [u32::MAX; 3];

/// Reads mesh `number`, and its deformable vertices if requested. `joints` transform its vertices to world
/// space if its node has a skin.
///
/// Triangles without a material get the index after the last material of the file, if other triangles of the
/// mesh have one.
pub(crate) fn geometry(
    buffers: &Buffers,
    number: usize,
    (weights, joints, rigged): (&[f64], Option<&[DAffine3]>, bool),
    warnings: &mut Warnings,
    missing: &mut MissingReferences,
) -> Result<(Geometry, Vec<DeformableMesh>), Error> {
    let Some(mesh) = buffers.root.meshes.get(number) else {
        let message = format!("is pointed to, but the file has {}", buffers.root.meshes.len());
        return Err(Error::new(message).at(format!("mesh {number}")));
    };
    let mut builder = MeshBuilder {
        buffers,
        weights,
        joints,
        rigged,
        bodies: Vec::new(),
        geometry: Geometry::default(),
        blocks: Vec::new(),
        painted: Vec::new(),
        wire_material: None,
    };
    let name = mesh.name.as_deref().filter(|name| !name.is_empty());
    let name = name.map_or_else(String::new, |name| format!(" of `{}`", uri::shortened(name)));
    for (index, primitive) in mesh.primitives.iter().enumerate() {
        let here = || format!("mesh {number} primitive {index}{name}");
        builder.add(primitive, &here, warnings, missing).map_err(|error| error.within(here()))?;
    }
    Ok(builder.finish())
}

/// Identity of a primitive's vertices: attributes, morph targets and set of texture coordinates.
type VertexKey<'a> = (&'a BTreeMap<String, usize>, &'a [BTreeMap<String, usize>], Option<usize>);

/// Corners of triangles.
type Triangles = Vec<[u32; 3]>;

struct MeshBuilder<'a> {
    buffers: &'a Buffers<'a>,
    weights: &'a [f64],
    joints: Option<&'a [DAffine3]>,
    /// Whether deformable vertices are returned.
    rigged: bool,
    bodies: Vec<DeformableMesh>,
    geometry: Geometry,
    /// Vertices that were read already; exporters often share them among primitives.
    blocks: Vec<(VertexKey<'a>, VertexBlock)>,
    /// Material and number of triangles of each primitive.
    painted: Vec<(Option<usize>, usize)>,
    wire_material: Option<usize>,
}

/// Range of a primitive's vertices in the geometry, and its attributes.
#[derive(Debug, Clone, Copy)]
struct VertexBlock {
    start: u32,
    count: u32,
    normals: bool,
    uvs: bool,
}

impl<'a> MeshBuilder<'a> {
    /// Adds a primitive; `describe_location` names it in messages.
    fn add(
        &mut self,
        primitive: &'a Primitive,
        describe_location: &dyn Fn() -> String,
        warnings: &mut Warnings,
        missing: &mut MissingReferences,
    ) -> Result<(), Error> {
        let materials = self.buffers.root.materials.len();
        let material = primitive.material.filter(|material| *material < materials);
        if let (Some(number), None) = (primitive.material, material) {
            missing.materials.add(|| {
                let (here, number) = (describe_location(), DisplayIndex(number));
                format!("{here}: has material {number}, but the file has {materials}; it is drawn without a material")
            });
        }
        let mode = PrimitiveMode::new(primitive.mode)?;
        if mode == PrimitiveMode::Points {
            warnings.note("points are not drawn");
            return Ok(());
        }
        let (block, ready) = self.vertices(primitive)?;
        let mut shape = self.shape(primitive, mode, block, ready, warnings)?;
        let mut marks = match &primitive.extensions.edges {
            Some(edges) if !edges.is_empty() => {
                let block_positions = self.geometry.positions.get(block.start as usize..).unwrap_or_default();
                let block_positions = block_positions.get(..block.count as usize).unwrap_or_default();
                edge_visibility::marks(self.buffers, edges, &shape.triangles, block_positions, warnings)?
            }
            _ => Vec::new(),
        };
        for index in shape.triangles.as_flattened_mut().iter_mut().chain(shape.wires.as_flattened_mut()) {
            *index += block.start;
        }
        self.drop_unsound(block, &mut shape, &mut marks, warnings);
        if !shape.wires.is_empty() {
            self.wire_material = self.wire_material.or(material);
        }
        if !block.uvs && !shape.triangles.is_empty() && self.wants_uvs(material) {
            missing.uvs.add(|| {
                let (here, uv_set_name) = (describe_location(), vertex_reader::uv_name(self.buffers, primitive));
                format!("{here}: its texture wants {uv_set_name}, which it does not have; the plain colour is drawn instead")
            });
        }
        self.painted.push((material, shape.triangles.len()));
        self.append(block, shape, marks);
        Ok(())
    }

    /// Whether a material has a texture, so that texture coordinates are needed.
    fn wants_uvs(&self, material: Option<usize>) -> bool {
        let root = self.buffers.root;
        let material = material.and_then(|material| root.materials.get(material));
        let texture = material.and_then(material_reader::base_texture);
        texture.is_some_and(|texture| texture.index < root.textures.len())
    }

    /// Vertices of a primitive, reused if an earlier primitive had the same; and the triangles of a
    /// compressed primitive.
    fn vertices(&mut self, primitive: &'a Primitive) -> Result<(VertexBlock, Option<Triangles>), Error> {
        let variant = vertex_reader::uv_variant(self.buffers, primitive);
        let key: VertexKey = (&primitive.attributes, &primitive.targets, variant);
        let shareable = primitive.extensions.draco.is_none();
        if let Some((_, block)) = self.blocks.iter().find(|(known, _)| shareable && *known == key) {
            return Ok((*block, None));
        }
        let mut streams = vertex_reader::read(self.buffers, primitive)?;
        let (weights, joints) = (self.weights, self.joints);
        let asked = (weights, self.rigged);
        let mut body =
            skin_and_morphs::body(&streams, self.buffers, primitive, asked, joints.map(<[_]>::len))?;
        if self.rigged && (!body.targets.is_empty() || joints.is_some()) {
            body.start = self.geometry.positions.len();
            (body.positions, body.normals) = (streams.positions.clone(), streams.normals.clone());
        }
        body.pose((&mut streams.positions, &mut streams.normals), weights, joints);
        if !body.positions.is_empty() {
            self.bodies.push(body);
        }
        let (start, count) = (self.geometry.positions.len(), streams.positions.len());
        if start.saturating_add(count) >= u32::MAX as usize {
            return Err(Error::new("the mesh has more vertices than can be numbered"));
        }
        let block = VertexBlock {
            start: start as u32,
            count: count as u32,
            normals: !streams.normals.is_empty(),
            uvs: !streams.uvs.is_empty(),
        };
        let geometry = &mut self.geometry;
        // glTF stores single precision or less.
        geometry.single_precision = true;
        let position = primitive.attributes.get("POSITION");
        // Joints move the vertices at another scale.
        let position = position.filter(|_| joints.is_none());
        let step = position.map_or(0.0, |position| self.buffers.step(*position));
        geometry.lattice_step = geometry.lattice_step.max(step);
        append_or_take(&mut geometry.normals, start, streams.normals, [0.0; 3]);
        append_or_take(&mut geometry.uvs, start, streams.uvs, [0.0; 2]);
        append_or_take(&mut geometry.colours, start, streams.colours, [f32::NAN; 4]);
        append_or_take(&mut geometry.positions, start, streams.positions, DVec3::ZERO);
        if shareable {
            self.blocks.push((key, block));
        }
        Ok((block, streams.triangles))
    }

    /// Triangles and wires, with indices relative to the block's first vertex.
    fn shape(
        &self,
        primitive: &Primitive,
        mode: PrimitiveMode,
        block: VertexBlock,
        ready: Option<Triangles>,
        warnings: &mut Warnings,
    ) -> Result<PrimitiveElements, Error> {
        let mut shape = PrimitiveElements::default();
        if let Some(triangles) = ready {
            let wrong = triangles.as_flattened().iter().find(|index| **index >= block.count);
            if let Some(index) = wrong {
                return Err(Error::new(format!("index {index}, but the mesh has {} vertices", block.count)));
            }
            shape.triangles = triangles;
            return Ok(shape);
        }
        let Some(accessor) = primitive.indices else {
            let run: Vec<u32> = (0..block.count).collect();
            shape.add(mode, &run, warnings);
            return Ok(shape);
        };
        let indices = self.buffers.indices(accessor)?;
        let check = |run: &[u32]| match run.iter().copied().max() {
            Some(most) if most >= block.count => {
                let at = indices.values.iter().position(|index| *index == most).unwrap_or_default();
                let message =
                    format!("index {most} (number {at}), but the mesh has {} vertices", block.count);
                Err(Error::new(message).at(format!("accessor {accessor}")))
            }
            _ => Ok(()),
        };
        if mode.runs() {
            for run in indices.values.split(|index| *index == indices.restart) {
                check(run)?;
                shape.add(mode, run, warnings);
            }
        } else {
            check(&indices.values)?;
            shape.add(mode, &indices.values, warnings);
        }
        Ok(shape)
    }

    /// Drops triangles and wires with a corner that is not finite.
    fn drop_unsound(
        &mut self,
        block: VertexBlock,
        shape: &mut PrimitiveElements,
        marks: &mut Vec<[EdgeMark; 3]>,
        warnings: &mut Warnings,
    ) {
        let positions = &self.geometry.positions;
        let block_positions =
            positions.get(block.start as usize..(block.start + block.count) as usize).unwrap_or_default();
        if block_positions.iter().all(|position| position.is_finite()) {
            return;
        }
        let sound = |index: &u32| positions.get(*index as usize).is_some_and(|position| position.is_finite());
        let keep: Vec<bool> = shape.triangles.iter().map(|corners| corners.iter().all(sound)).collect();
        let before = (shape.triangles.len(), shape.wires.len());
        retain(&mut shape.triangles, &keep);
        retain(marks, &keep);
        shape.wires.retain(|ends| ends.iter().all(sound));
        let dropped = |before: usize, after: usize| (before - after) as u64;
        let (triangles, lines) =
            (dropped(before.0, shape.triangles.len()), dropped(before.1, shape.wires.len()));
        warnings.count("triangles left out, with a corner that is not a number", triangles);
        warnings.count("lines left out, with an end that is not a number", lines);
    }

    fn append(&mut self, block: VertexBlock, shape: PrimitiveElements, marks: Vec<[EdgeMark; 3]>) {
        let geometry = &mut self.geometry;
        let start = geometry.triangles.len();
        let corners = |has: bool| if has { shape.triangles.clone() } else { Vec::new() };
        let (normals, uvs) = (corners(block.normals), corners(block.uvs));
        pad_after(&mut geometry.corner_normals, start, normals, shape.triangles.len(), NO_INDICES);
        pad_after(&mut geometry.corner_uvs, start, uvs, shape.triangles.len(), NO_INDICES);
        pad_after(&mut geometry.edge_marks, start, marks, shape.triangles.len(), [EdgeMark::Unmarked; 3]);
        append_or_take(&mut geometry.triangles, start, shape.triangles, NO_INDICES);
        geometry.wires.extend(shape.wires);
    }

    fn finish(self) -> (Geometry, Vec<DeformableMesh>) {
        let mut geometry = self.geometry;
        // Replace unused invalid positions, which would widen the bounds.
        let sound = geometry.positions.iter().copied().find(|position| position.is_finite());
        for position in geometry.positions.iter_mut().filter(|position| !position.is_finite()) {
            *position = sound.unwrap_or_default();
        }
        if !geometry.colours.is_empty() {
            geometry.colours.resize(geometry.positions.len(), [f32::NAN; 4]);
        }
        let plain = self.buffers.root.materials.len();
        let mut used =
            self.painted.iter().filter(|(_, triangles)| *triangles > 0).map(|(material, _)| *material);
        let first = used.next().unwrap_or(self.wire_material);
        geometry.material = self.wire_material.or(first).map(|material| material as u32);
        if used.any(|material| material != first)
            || (first != self.wire_material && !geometry.wires.is_empty())
        {
            for (material, triangles) in self.painted {
                let length = geometry.triangle_material.len() + triangles;
                geometry.triangle_material.resize(length, material.unwrap_or(plain) as u32);
            }
        }
        (geometry, self.bodies)
    }
}

/// Appends `more` after `start` elements, filling missing ones. Moves the data without a copy if `all` is
/// empty.
fn append_or_take<T: Copy>(all: &mut Vec<T>, start: usize, more: Vec<T>, filler: T) {
    if more.is_empty() {
        return;
    }
    if start == 0 {
        *all = more;
    } else {
        all.resize(start, filler);
        all.extend(more);
    }
}

/// Appends `more` to an optional per-triangle array. The array stays empty until it has data; then it has one
/// entry for every triangle.
fn pad_after<T: Copy>(all: &mut Vec<T>, start: usize, more: Vec<T>, count: usize, filler: T) {
    append_or_take(all, start, more, filler);
    if !all.is_empty() {
        all.resize(start + count, filler);
    }
}

/// Keeps the marked items.
pub(crate) fn retain<T>(all: &mut Vec<T>, keep: &[bool]) {
    let mut next = keep.iter();
    all.retain(|_| next.next().copied().unwrap_or(true));
}
