//! The JSON of a glTF file, limited to what a drawing needs; unknown keys are ignored.
//!
//! Files: [`buffer_schema`] accessors, buffer views and buffers; [`material_schema`] materials, textures and
//! images; [`lenient_index`] indices, where some exporters write -1 for "none".

mod buffer_schema;
pub(crate) mod lenient_index;
mod material_schema;

use std::collections::BTreeMap;

use serde::Deserialize;

pub(crate) use buffer_schema::{Accessor, Buffer, BufferView, Meshopt, Sparse};
pub(crate) use material_schema::{Image, Material, Sampler, Texture, TextureTransform, TextureUse};

/// Top level of the JSON.
#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(crate) struct Root {
    pub asset: Asset,
    pub scene: Option<usize>,
    pub scenes: Vec<SceneNodes>,
    pub nodes: Vec<Node>,
    pub meshes: Vec<Mesh>,
    pub accessors: Vec<Accessor>,
    pub buffer_views: Vec<BufferView>,
    pub buffers: Vec<Buffer>,
    pub materials: Vec<Material>,
    pub textures: Vec<Texture>,
    pub samplers: Vec<Sampler>,
    pub images: Vec<Image>,
    pub cameras: Vec<Camera>,
    pub skins: Vec<Skin>,
    pub animations: Vec<Animation>,
    pub extensions_required: Vec<String>,
    pub extensions: RootExtensions,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(crate) struct Asset {
    pub version: Option<String>,
    pub min_version: Option<String>,
    pub generator: Option<String>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct RootExtensions {
    #[serde(rename = "KHR_lights_punctual")]
    pub lights: Option<Lights>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Lights {
    pub lights: Vec<Light>,
}

#[derive(Debug, Deserialize)]
pub(crate) struct Light {
    #[serde(rename = "type")]
    pub kind: String,
    pub name: Option<String>,
    pub color: Option<[f32; 3]>,
    pub intensity: Option<f64>,
    pub range: Option<f64>,
    #[serde(default)]
    pub spot: Spot,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(crate) struct Spot {
    pub inner_cone_angle: Option<f64>,
    pub outer_cone_angle: Option<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Animation {
    pub name: Option<String>,
    pub channels: Vec<Channel>,
    pub samplers: Vec<AnimationSampler>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Channel {
    pub sampler: Option<usize>,
    pub target: ChannelTarget,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct ChannelTarget {
    pub node: Option<usize>,
    pub path: String,
    pub extensions: TargetExtensions,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct TargetExtensions {
    #[serde(rename = "KHR_animation_pointer")]
    pub pointer: Option<Pointer>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Pointer {
    pub pointer: String,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct AnimationSampler {
    pub input: Option<usize>,
    pub output: Option<usize>,
    pub interpolation: Option<String>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct SceneNodes {
    pub nodes: Vec<usize>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Node {
    pub name: Option<String>,
    pub children: Vec<usize>,
    #[serde(deserialize_with = "lenient_index::optional")]
    pub mesh: Option<usize>,
    #[serde(deserialize_with = "lenient_index::optional")]
    pub skin: Option<usize>,
    #[serde(deserialize_with = "lenient_index::optional")]
    pub camera: Option<usize>,
    pub matrix: Option<[f64; 16]>,
    pub translation: Option<[f64; 3]>,
    pub rotation: Option<[f64; 4]>,
    pub scale: Option<[f64; 3]>,
    pub weights: Option<Vec<f64>>,
    pub extras: serde_json::Value,
    pub extensions: NodeExtensions,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct NodeExtensions {
    #[serde(rename = "KHR_lights_punctual")]
    pub light: Option<LightUse>,
    #[serde(rename = "EXT_mesh_gpu_instancing")]
    pub instancing: Option<Instancing>,
    #[serde(rename = "KHR_node_visibility")]
    pub visibility: Option<Visibility>,
}

#[derive(Debug, Deserialize)]
pub(crate) struct LightUse {
    #[serde(deserialize_with = "lenient_index::one")]
    pub light: usize,
}

#[derive(Debug, Deserialize)]
pub(crate) struct Instancing {
    #[serde(deserialize_with = "lenient_index::named")]
    pub attributes: BTreeMap<String, usize>,
}

#[derive(Debug, Deserialize)]
pub(crate) struct Visibility {
    pub visible: Option<bool>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Mesh {
    pub name: Option<String>,
    pub primitives: Vec<Primitive>,
    pub weights: Vec<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Primitive {
    #[serde(deserialize_with = "lenient_index::named")]
    pub attributes: BTreeMap<String, usize>,
    #[serde(deserialize_with = "lenient_index::optional")]
    pub indices: Option<usize>,
    #[serde(deserialize_with = "lenient_index::optional")]
    pub material: Option<usize>,
    pub mode: Option<u32>,
    #[serde(deserialize_with = "lenient_index::all_named")]
    pub targets: Vec<BTreeMap<String, usize>>,
    pub extensions: PrimitiveExtensions,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct PrimitiveExtensions {
    #[serde(rename = "KHR_draco_mesh_compression")]
    pub draco: Option<Draco>,
    #[serde(rename = "EXT_mesh_primitive_edge_visibility")]
    pub edges: Option<Edges>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
#[cfg_attr(not(feature = "draco"), expect(dead_code, reason = "distinguishes undecodable data"))]
pub(crate) struct Draco {
    pub buffer_view: usize,
    pub attributes: BTreeMap<String, u32>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(crate) struct Edges {
    pub visibility: Option<usize>,
    pub line_strings: Vec<LineString>,
}

impl Edges {
    /// Whether no edges are marked.
    pub(crate) fn is_empty(&self) -> bool {
        self.visibility.is_none() && self.line_strings.is_empty()
    }
}

#[derive(Debug, Deserialize)]
pub(crate) struct LineString {
    pub indices: usize,
}

#[derive(Debug, Deserialize)]
pub(crate) struct Camera {
    pub name: Option<String>,
    #[serde(default)]
    pub perspective: Option<Perspective>,
    #[serde(default)]
    pub orthographic: Option<Orthographic>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Perspective {
    pub yfov: f64,
    pub aspect_ratio: Option<f64>,
    pub znear: Option<f64>,
}

#[derive(Debug, Deserialize)]
pub(crate) struct Orthographic {
    pub xmag: f64,
    pub ymag: f64,
    pub znear: Option<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Skin {
    pub joints: Vec<usize>,
    pub inverse_bind_matrices: Option<usize>,
}
