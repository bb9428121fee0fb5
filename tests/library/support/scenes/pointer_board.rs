//! [`PointerFile`]: a small glTF file with an animation that uses `KHR_animation_pointer`.

use std::path::PathBuf;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

/// A temporary file with two squares of different materials, two cameras and two lights.
pub(crate) struct PointerFile(pub PathBuf);

/// A pointer, its interpolation, and its values at 0, 1 and 3 s.
pub(crate) type PointerChannel<'a> = (&'a str, &'a str, &'a [f32]);

impl PointerFile {
    /// Writes the file with one channel per entry of `moved`, after `change` has edited the document.
    pub(crate) fn new(name: &str, moved: &[PointerChannel], change: impl FnOnce(&mut Value)) -> Self {
        let mut bytes: Vec<u8> = Vec::new();
        let (mut views, mut accessors) = (Vec::new(), Vec::new());
        let mut add = |width: usize, numbers: &[f32]| {
            views.push(json!({"buffer": 0, "byteOffset": bytes.len(), "byteLength": 4 * numbers.len()}));
            let shape = ["SCALAR", "VEC2", "VEC3", "VEC4"][width - 1];
            let (view, count) = (views.len() - 1, numbers.len() / width);
            accessors.push(json!({"bufferView": view, "componentType": 5126, "count": count, "type": shape}));
            numbers.iter().for_each(|value| bytes.extend(value.to_le_bytes()));
            accessors.len() - 1
        };
        let square =
            |x: f32| [x, 0., 0., x + 1., 0., 0., x + 1., 1., 0., x, 0., 0., x + 1., 1., 0., x, 1., 0.];
        let (left, right) = (add(3, &square(-1.5)), add(3, &square(0.5)));
        let times = add(1, &[0.0, 1.0, 3.0]);
        let (mut samplers, mut channels) = (Vec::new(), Vec::new());
        for (pointer, way, numbers) in moved {
            let keys = if *way == "CUBICSPLINE" { 9 } else { 3 };
            let output = add(numbers.len() / keys, numbers);
            channels.push(json!({"sampler": samplers.len(), "target": {"path": "pointer",
                "extensions": {"KHR_animation_pointer": {"pointer": pointer}}}}));
            samplers.push(json!({"input": times, "output": output, "interpolation": way}));
        }
        let mesh = |position: usize, material: usize| json!({"primitives": [{"attributes": {"POSITION": position}, "material": material}]});
        let mut file = json!({
            "asset": {"version": "2.0"},
            "scenes": [{"nodes": [0, 1, 2, 3, 4, 5]}],
            "nodes": [
                {"name": "left", "mesh": 0}, {"name": "right", "mesh": 1},
                {"camera": 0, "translation": [0.0, 0.5, 6.0]}, {"camera": 1, "translation": [0.0, 0.5, 6.0]},
                {"extensions": {"KHR_lights_punctual": {"light": 0}}},
                {"extensions": {"KHR_lights_punctual": {"light": 1}}, "translation": [1.0, 0.5, 2.0]}
            ],
            "cameras": [
                {"type": "perspective", "name": "eye", "perspective": {"yfov": 0.5, "znear": 0.1, "aspectRatio": 1.5}},
                {"type": "orthographic", "name": "plan", "orthographic": {"xmag": 2.0, "ymag": 1.0, "znear": 0.1, "zfar": 9.0}}
            ],
            "extensions": {"KHR_lights_punctual": {"lights": [
                {"type": "directional", "intensity": 2.0},
                {"type": "spot", "color": [1.0, 0.5, 0.25], "range": 9.0, "spot": {"innerConeAngle": 0.1}}
            ]}},
            "materials": [
                {"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 0.125, 1.0]}},
                {"alphaMode": "MASK", "alphaCutoff": 0.25, "pbrMetallicRoughness": {"baseColorFactor": [0.0, 1.0, 0.0, 0.5]}}
            ],
            "meshes": [mesh(left, 0), mesh(right, 1)],
            "animations": [{"name": "change", "samplers": samplers, "channels": channels}],
            "accessors": accessors, "bufferViews": views,
            "buffers": [{"byteLength": bytes.len(), "uri": format!("data:application/octet-stream;base64,{}", STANDARD.encode(&bytes))}]
        });
        change(&mut file);
        let path = std::env::temp_dir().join(format!("ligne-board-{}-{name}.gltf", std::process::id()));
        std::fs::write(&path, file.to_string()).unwrap();
        Self(path)
    }
}

impl Drop for PointerFile {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0);
    }
}

/// Adds an accessor of vectors with `width` components to a document; returns its index.
pub(crate) fn add_accessor(file: &mut Value, width: usize, numbers: &[f32]) -> usize {
    let bytes: Vec<u8> = numbers.iter().flat_map(|value| value.to_le_bytes()).collect();
    let uri = format!("data:application/octet-stream;base64,{}", STANDARD.encode(&bytes));
    let mut push = |list: &str, entry: Value| {
        let list = file[list].as_array_mut().unwrap();
        list.push(entry);
        list.len() - 1
    };
    let buffer = push("buffers", json!({"byteLength": bytes.len(), "uri": uri}));
    let view = push("bufferViews", json!({"buffer": buffer, "byteLength": bytes.len()}));
    let shape = ["SCALAR", "VEC2", "VEC3", "VEC4"][width - 1];
    let count = numbers.len() / width;
    push("accessors", json!({"bufferView": view, "componentType": 5126, "count": count, "type": shape}))
}
