//! Writer of binary glTF 2.0: meshes with materials, a tree of named nodes, a camera, and a clip.

use glam::{DMat3, DQuat, DVec3};
use serde_json::{Value, json};

use crate::geometry::part::{Material, Part};
use crate::geometry::smooth_normals;

/// Node of an assembly: its transform and its mesh.
#[derive(Debug, Clone)]
pub struct Node {
    pub name: String,
    pub translation: DVec3,
    pub rotation: DQuat,
    pub scale: f64,
    /// Index of its mesh in the assembly.
    pub mesh: Option<usize>,
    /// Whether the file marks the node for motion lines.
    pub leaves_lines: bool,
    pub children: Vec<Node>,
}

impl Node {
    /// Node without a mesh, with children.
    pub fn group(name: &str, children: Vec<Node>) -> Node {
        let (translation, rotation) = (DVec3::ZERO, DQuat::IDENTITY);
        Node {
            name: name.to_owned(),
            translation,
            rotation,
            scale: 1.0,
            mesh: None,
            leaves_lines: false,
            children,
        }
    }
}

/// Meshes, the tree of nodes that shows them, and a camera in world space.
pub struct Assembly {
    pub meshes: Vec<Part>,
    pub root: Node,
    /// Whether the file contains normals, split at sharp edges.
    pub with_normals: bool,
    pub eye: DVec3,
    pub target: DVec3,
    /// Vertical field of view, radians.
    pub fov_y: f64,
    pub aspect: f64,
    /// Name of the clip, and the nodes that move in it.
    pub clip: Option<(String, Vec<Moving>)>,
}

/// Movement of a node.
pub struct Moving {
    pub node: String,
    pub way: Way,
}

/// Animated property of a node, with times in seconds.
pub enum Way {
    /// Rotation.
    Turns(Vec<(f64, DQuat)>),
    /// Position and velocity, metres per second.
    Flies(Vec<(f64, DVec3, DVec3)>),
}

const FLOAT: u32 = 5126;
const SHORT: u32 = 5123;
const VERTICES: u32 = 34962;
const INDICES: u32 = 34963;

/// Linear value of an sRGB colour channel, as glTF requires, rounded to keep the text short.
fn linear(channel: f64) -> f64 {
    let value = if channel <= 0.04045 { channel / 12.92 } else { libm::pow((channel + 0.055) / 1.055, 2.4) };
    (value * 1e4).round() / 1e4
}

#[derive(Default)]
struct Buffers {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Buffers {
    fn add(&mut self, bytes: &[u8], target: u32, mut accessor: Value) -> usize {
        accessor["bufferView"] = json!(self.views.len());
        let offset = self.bytes.len();
        self.views
            .push(json!({ "buffer": 0, "byteOffset": offset, "byteLength": bytes.len(), "target": target }));
        self.bytes.extend(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    fn vectors(&mut self, vectors: &[DVec3]) -> usize {
        let vectors: Vec<glam::Vec3> = vectors.iter().map(|vector| vector.as_vec3() + 0.0).collect();
        let bytes: Vec<u8> = vectors.iter().flat_map(|v| v.to_array()).flat_map(f32::to_le_bytes).collect();
        let low = vectors.iter().copied().fold(glam::Vec3::INFINITY, glam::Vec3::min);
        let high = vectors.iter().copied().fold(glam::Vec3::NEG_INFINITY, glam::Vec3::max);
        let accessor = json!({
            "componentType": FLOAT, "count": vectors.len(), "type": "VEC3",
            "min": low.to_array(), "max": high.to_array(),
        });
        self.add(&bytes, VERTICES, accessor)
    }

    /// Adds the numbers of a clip, `width` per element. Returns the accessor.
    fn keys(&mut self, shape: &str, width: usize, numbers: &[f64]) -> usize {
        let numbers: Vec<f32> = numbers.iter().map(|value| *value as f32).collect();
        let bytes: Vec<u8> = numbers.iter().flat_map(|value| value.to_le_bytes()).collect();
        let (low, high) = (numbers.first(), numbers.last());
        let mut accessor = json!({ "componentType": FLOAT, "count": numbers.len() / width, "type": shape });
        if width == 1 {
            (accessor["min"], accessor["max"]) = (json!([low]), json!([high]));
        }
        accessor["bufferView"] = json!(self.views.len());
        let offset = self.bytes.len();
        self.views.push(json!({ "buffer": 0, "byteOffset": offset, "byteLength": bytes.len() }));
        self.bytes.extend(bytes);
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// Clip of nodes that move from key to key.
    fn clip(&mut self, (name, moving): &(String, Vec<Moving>), nodes: &[Value]) -> Value {
        let (mut samplers, mut channels) = (Vec::new(), Vec::new());
        for Moving { node, way } in moving {
            let (input, output, how, what) = match way {
                Way::Turns(keys) => {
                    let times: Vec<f64> = keys.iter().map(|(time, _)| *time).collect();
                    let turns: Vec<f64> = keys.iter().flat_map(|(_, turn)| turn.to_array()).collect();
                    (self.keys("SCALAR", 1, &times), self.keys("VEC4", 4, &turns), "LINEAR", "rotation")
                }
                Way::Flies(keys) => {
                    let times: Vec<f64> = keys.iter().map(|(time, ..)| *time).collect();
                    // Each key has its velocity as incoming and outgoing tangent.
                    let ways = keys.iter().flat_map(|(_, at, speed)| [*speed, *at, *speed]);
                    let ways: Vec<f64> = ways.flat_map(|vector| vector.to_array()).collect();
                    let input = self.keys("SCALAR", 1, &times);
                    (input, self.keys("VEC3", 3, &ways), "CUBICSPLINE", "translation")
                }
            };
            samplers.push(json!({ "input": input, "output": output, "interpolation": how }));
            let number = nodes.iter().position(|known| known["name"] == node.as_str());
            let target = json!({ "node": number, "path": what });
            channels.push(json!({ "sampler": samplers.len() - 1, "target": target }));
        }
        json!({ "name": name, "samplers": samplers, "channels": channels })
    }

    fn mesh(&mut self, part: &Part, material: usize, with_normals: bool) -> Value {
        let (attributes, corners): (Value, Vec<u32>) = if with_normals {
            let vertices = smooth_normals::vertices(&part.solid);
            let position = self.vectors(&vertices.positions);
            let normal = self.vectors(&vertices.normals);
            let corners = vertices.triangles.into_iter().flatten().collect();
            (json!({ "POSITION": position, "NORMAL": normal }), corners)
        } else {
            let position = self.vectors(&part.solid.points);
            (json!({ "POSITION": position }), part.solid.triangles().flatten().collect())
        };
        let bytes: Vec<u8> = corners.iter().flat_map(|corner| (*corner as u16).to_le_bytes()).collect();
        let accessor = json!({ "componentType": SHORT, "count": corners.len(), "type": "SCALAR" });
        let indices = self.add(&bytes, INDICES, accessor);
        json!({
            "name": part.name,
            "primitives": [{ "attributes": attributes, "indices": indices, "material": material }],
        })
    }
}

/// Adds a node after its children. Returns its index.
fn flatten(node: &Node, nodes: &mut Vec<Value>) -> usize {
    let children: Vec<usize> = node.children.iter().map(|child| flatten(child, nodes)).collect();
    let mut record = json!({ "name": node.name });
    if node.translation != DVec3::ZERO {
        record["translation"] = json!(node.translation.to_array());
    }
    if node.rotation != DQuat::IDENTITY {
        record["rotation"] = json!(node.rotation.to_array());
    }
    if node.scale != 1.0 {
        record["scale"] = json!(DVec3::splat(node.scale).to_array());
    }
    if let Some(mesh) = node.mesh {
        record["mesh"] = json!(mesh);
    }
    if node.leaves_lines {
        record["extras"] = json!({ "motion": true });
    }
    if !children.is_empty() {
        record["children"] = json!(children);
    }
    nodes.push(record);
    nodes.len() - 1
}

/// Bytes of the file.
pub fn bytes(title: &str, assembly: &Assembly) -> Vec<u8> {
    let mut materials: Vec<Material> = Vec::new();
    let mut buffers = Buffers::default();
    let mut meshes = Vec::new();
    for part in &assembly.meshes {
        let known = materials.iter().position(|material| *material == part.material);
        let material = known.unwrap_or_else(|| {
            materials.push(part.material);
            materials.len() - 1
        });
        meshes.push(buffers.mesh(part, material, assembly.with_normals));
    }
    let mut nodes = Vec::new();
    let root = flatten(&assembly.root, &mut nodes);
    let back = (assembly.eye - assembly.target).normalize();
    let right = DVec3::Y.cross(back).normalize();
    let axes = DMat3::from_cols(right, back.cross(right), back);
    nodes.push(json!({
        "name": "camera",
        "camera": 0,
        "translation": assembly.eye.to_array(),
        "rotation": DQuat::from_mat3(&axes).to_array(),
    }));
    let materials: Vec<Value> = materials
        .iter()
        .map(|material| {
            let [r, g, b] = material.colour.map(linear);
            json!({
                "name": material.name,
                "pbrMetallicRoughness": {
                    "baseColorFactor": [r, g, b, 1.0],
                    "metallicFactor": material.metallic,
                    "roughnessFactor": material.roughness,
                },
            })
        })
        .collect();
    let lens = json!({ "yfov": assembly.fov_y, "aspectRatio": assembly.aspect, "znear": 0.01 });
    let clip = assembly.clip.as_ref().map(|clip| buffers.clip(clip, &nodes));
    let mut document = json!({
        "asset": { "version": "2.0", "generator": title },
        "scene": 0,
        "scenes": [{ "nodes": [root, nodes.len() - 1] }],
        "nodes": nodes,
        "cameras": [{ "name": "camera", "type": "perspective", "perspective": lens }],
        "materials": materials,
        "meshes": meshes,
        "accessors": buffers.accessors,
        "bufferViews": buffers.views,
        "buffers": [{ "byteLength": buffers.bytes.len() }],
    });
    if let Some(clip) = clip {
        document["animations"] = json!([clip]);
    }
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut out = b"glTF".to_vec();
    let length = 12 + 8 + text.len() + 8 + buffers.bytes.len();
    for word in [2, length as u32, text.len() as u32, 0x4E4F_534A] {
        out.extend(word.to_le_bytes());
    }
    out.extend(&text);
    for word in [buffers.bytes.len() as u32, 0x004E_4942] {
        out.extend(word.to_le_bytes());
    }
    out.extend(&buffers.bytes);
    out
}
