//! [`ReferenceGltf`]: reference reader for glTF files that evaluates poses directly from the specification's
//! formulas.

use std::path::Path;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use glam::{DMat4, DVec3};
use libm::{acos, sin};
use serde_json::Value;

/// A glTF file: its JSON document and its buffers.
pub(crate) struct ReferenceGltf {
    json: Value,
    buffers: Vec<Vec<u8>>,
}

impl ReferenceGltf {
    pub(crate) fn open(path: &Path) -> Self {
        let bytes = std::fs::read(path).unwrap();
        let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
        let (text, bin) = if bytes.starts_with(b"glTF") {
            let json = 20 + word(12);
            (bytes[20..json].to_vec(), bytes.get(json + 8..).unwrap_or_default().to_vec())
        } else {
            (bytes.clone(), Vec::new())
        };
        let json: Value = serde_json::from_slice(&text).unwrap();
        let buffer = |buffer: &Value| match buffer["uri"].as_str() {
            None => bin.clone(),
            Some(uri) => match uri.split_once("base64,") {
                Some((_, data)) => STANDARD.decode(data).unwrap(),
                None => std::fs::read(path.parent().unwrap().join(uri)).unwrap(),
            },
        };
        let buffers = list(&json["buffers"]).iter().map(buffer).collect();
        Self { json, buffers }
    }

    /// The elements of an accessor, with sparse values applied.
    fn accessor_elements(&self, accessor: &Value) -> Vec<Vec<f64>> {
        let own = &self.json["accessors"][index(accessor).unwrap()];
        let width = match own["type"].as_str().unwrap() {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            "VEC4" => 4,
            _ => 16,
        };
        let count = index(&own["count"]).unwrap();
        let kind = own["componentType"].as_u64().unwrap();
        let mut all = match index(&own["bufferView"]) {
            Some(view) => {
                let offset = index(&own["byteOffset"]).unwrap_or(0);
                self.buffer_elements(view, offset, kind, width, count, own["normalized"] == true)
            }
            None => vec![vec![0.0; width]; count],
        };
        let sparse = &own["sparse"];
        if let Some(count) = index(&sparse["count"]) {
            let part = |part: &Value, kind: u64, width: usize| {
                let offset = index(&part["byteOffset"]).unwrap_or(0);
                self.buffer_elements(index(&part["bufferView"]).unwrap(), offset, kind, width, count, false)
            };
            let places = part(&sparse["indices"], sparse["indices"]["componentType"].as_u64().unwrap(), 1);
            for (place, value) in places.iter().zip(part(&sparse["values"], kind, width)) {
                all[place[0] as usize] = value;
            }
        }
        all
    }

    /// Elements of `width` numbers from a buffer view; normalised integers are scaled if `part` is set.
    fn buffer_elements(
        &self,
        view: usize,
        offset: usize,
        kind: u64,
        width: usize,
        count: usize,
        part: bool,
    ) -> Vec<Vec<f64>> {
        let view = &self.json["bufferViews"][view];
        let bytes = &self.buffers[index(&view["buffer"]).unwrap()];
        let begin = index(&view["byteOffset"]).unwrap_or(0) + offset;
        let size = match kind {
            5120 | 5121 => 1,
            5122 | 5123 => 2,
            _ => 4,
        };
        let stride = index(&view["byteStride"]).unwrap_or(size * width);
        let one = |at: usize| {
            let b = &bytes[at..at + size];
            let share = |value: f64, most: f64| if part { (value / most).max(-1.0) } else { value };
            match kind {
                5120 => share(f64::from(b[0] as i8), 127.0),
                5121 => share(f64::from(b[0]), 255.0),
                5122 => share(f64::from(i16::from_le_bytes(b.try_into().unwrap())), 32767.0),
                5123 => share(f64::from(u16::from_le_bytes(b.try_into().unwrap())), 65535.0),
                5125 => f64::from(u32::from_le_bytes(b.try_into().unwrap())),
                _ => f64::from(f32::from_le_bytes(b.try_into().unwrap())),
            }
        };
        (0..count).map(|k| (0..width).map(|i| one(begin + k * stride + i * size)).collect()).collect()
    }

    /// The interpolated value of a channel at a time.
    fn channel_value(&self, animation: &Value, channel: &Value, time: f64) -> Vec<f64> {
        let sampler = &animation["samplers"][index(&channel["sampler"]).unwrap()];
        let times: Vec<f64> = self.accessor_elements(&sampler["input"]).concat();
        let cubic = sampler["interpolation"] == "CUBICSPLINE";
        let numbers: Vec<f64> = self.accessor_elements(&sampler["output"]).concat();
        let width = numbers.len() / times.len() / if cubic { 3 } else { 1 };
        let row = |k: usize| numbers[k * width..(k + 1) * width].to_vec();
        let value = |k: usize| if cubic { row(3 * k + 1) } else { row(k) };
        let last = times.len() - 1;
        let turns = channel["target"]["path"] == "rotation";
        let found = if time <= times[0] {
            value(0)
        } else if time >= times[last] {
            value(last)
        } else {
            let k = (0..last).find(|k| times[*k] <= time && time < times[k + 1]).unwrap();
            let span = times[k + 1] - times[k];
            let t = (time - times[k]) / span;
            let (a, b) = (value(k), value(k + 1));
            match sampler["interpolation"].as_str() {
                Some("STEP") => a,
                Some("CUBICSPLINE") => {
                    // The cubic spline equation of the specification.
                    let (b_k, a_next) = (row(3 * k + 2), row(3 * (k + 1)));
                    (0..width)
                        .map(|i| {
                            (2.0 * t.powi(3) - 3.0 * t.powi(2) + 1.0) * a[i]
                                + span * (t.powi(3) - 2.0 * t.powi(2) + t) * b_k[i]
                                + (-2.0 * t.powi(3) + 3.0 * t.powi(2)) * b[i]
                                + span * (t.powi(3) - t.powi(2)) * a_next[i]
                        })
                        .collect()
                }
                _ if turns => {
                    let dot: f64 = a.iter().zip(&b).map(|(a, b)| a * b).sum();
                    let angle = acos(dot.abs().min(1.0));
                    let sign = dot.signum();
                    if angle < 1e-7 {
                        a
                    } else {
                        let (u, v) = (sin((1.0 - t) * angle), sign * sin(t * angle));
                        (0..4).map(|i| (u * a[i] + v * b[i]) / sin(angle)).collect()
                    }
                }
                _ => (0..width).map(|i| a[i] * (1.0 - t) + b[i] * t).collect(),
            }
        };
        if turns {
            let length = found.iter().map(|v| v * v).sum::<f64>().sqrt();
            return found.iter().map(|v| v / length).collect();
        }
        found
    }

    /// The value of an animation pointer at a time of a clip.
    pub(crate) fn pointer_value(&self, clip: usize, pointer: &str, time: f64) -> Vec<f64> {
        let animation = &self.json["animations"][clip];
        let leads =
            |channel: &&Value| channel["target"]["extensions"]["KHR_animation_pointer"]["pointer"] == pointer;
        let channel = list(&animation["channels"]).iter().find(leads).unwrap();
        self.channel_value(animation, channel, time)
    }

    /// A property of a node at a time: from the clip, else from the node, else the default.
    fn node_property(
        &self,
        node: usize,
        path: &str,
        playing: Option<(usize, f64)>,
        default: &[f64],
    ) -> Vec<f64> {
        if let Some((clip, time)) = playing {
            let animation = &self.json["animations"][clip];
            let target = |channel: &&Value| {
                index(&channel["target"]["node"]) == Some(node) && channel["target"]["path"] == path
            };
            if let Some(channel) = list(&animation["channels"]).iter().find(target) {
                return self.channel_value(animation, channel, time);
            }
        }
        let own = &self.json["nodes"][node][path];
        if own.is_null() { default.to_vec() } else { floats(own) }
    }

    /// The local matrix of a node.
    fn local_matrix(&self, node: usize, playing: Option<(usize, f64)>) -> DMat4 {
        let matrix = &self.json["nodes"][node]["matrix"];
        if !matrix.is_null() {
            return DMat4::from_cols_slice(&floats(matrix));
        }
        let t = self.node_property(node, "translation", playing, &[0.0; 3]);
        let q = self.node_property(node, "rotation", playing, &[0.0, 0.0, 0.0, 1.0]);
        let s = self.node_property(node, "scale", playing, &[1.0; 3]);
        let [x, y, z, w] = [q[0], q[1], q[2], q[3]];
        // The rotation matrix of a quaternion.
        let turn = [
            [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)],
            [2.0 * (x * y - z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * w)],
            [2.0 * (x * z + y * w), 2.0 * (y * z - x * w), 1.0 - 2.0 * (x * x + y * y)],
        ];
        let column = |k: usize| [turn[k][0] * s[k], turn[k][1] * s[k], turn[k][2] * s[k], 0.0];
        DMat4::from_cols_array_2d(&[column(0), column(1), column(2), [t[0], t[1], t[2], 1.0]])
    }

    /// The world-space vertices of each node with a mesh, in depth-first order.
    pub(crate) fn posed_vertices(&self, playing: Option<(usize, f64)>) -> Vec<Vec<DVec3>> {
        let nodes = list(&self.json["nodes"]).len();
        let mut parents = vec![None; nodes];
        for node in 0..nodes {
            for child in list(&self.json["nodes"][node]["children"]) {
                parents[index(child).unwrap()] = Some(node);
            }
        }
        let world = |node: usize| {
            let mut matrix = self.local_matrix(node, playing);
            let mut at = node;
            while let Some(parent) = parents[at] {
                matrix = self.local_matrix(parent, playing) * matrix;
                at = parent;
            }
            matrix
        };
        let all: Vec<DMat4> = (0..nodes).map(world).collect();
        let mut waiting: Vec<usize> =
            list(&self.json["scenes"][index(&self.json["scene"]).unwrap_or(0)]["nodes"])
                .iter()
                .rev()
                .map(|n| index(n).unwrap())
                .collect();
        let mut found = Vec::new();
        while let Some(node) = waiting.pop() {
            waiting
                .extend(list(&self.json["nodes"][node]["children"]).iter().rev().map(|n| index(n).unwrap()));
            if let Some(mesh) = index(&self.json["nodes"][node]["mesh"]) {
                found.push(self.mesh_vertices(node, mesh, &all, playing));
            }
        }
        found
    }

    /// The world-space vertices of a mesh, with morph targets and skinning applied.
    fn mesh_vertices(
        &self,
        node: usize,
        mesh: usize,
        world: &[DMat4],
        playing: Option<(usize, f64)>,
    ) -> Vec<DVec3> {
        let mesh = &self.json["meshes"][mesh];
        let resting = if mesh["weights"].is_null() { Vec::new() } else { floats(&mesh["weights"]) };
        let weights = self.node_property(node, "weights", playing, &resting);
        let skin = index(&self.json["nodes"][node]["skin"]).map(|skin| &self.json["skins"][skin]);
        let joints: Vec<DMat4> = skin.map_or_else(Vec::new, |skin| {
            let binds = self.accessor_elements(&skin["inverseBindMatrices"]);
            let joints = list(&skin["joints"]).iter().zip(binds);
            joints.map(|(joint, bind)| world[index(joint).unwrap()] * DMat4::from_cols_slice(&bind)).collect()
        });
        let mut points = Vec::new();
        let mut known: Vec<&Value> = Vec::new();
        for primitive in list(&mesh["primitives"]) {
            let attributes = &primitive["attributes"];
            if known.contains(&attributes) {
                continue;
            }
            known.push(attributes);
            let mut own: Vec<DVec3> = self
                .accessor_elements(&attributes["POSITION"])
                .iter()
                .map(|p| DVec3::new(p[0], p[1], p[2]))
                .collect();
            for (target, weight) in list(&primitive["targets"]).iter().zip(&weights) {
                if !target["POSITION"].is_null() {
                    let moves = self.accessor_elements(&target["POSITION"]);
                    own.iter_mut().zip(moves).for_each(|(p, m)| *p += DVec3::new(m[0], m[1], m[2]) * *weight);
                }
            }
            if skin.is_some() {
                let sets: Vec<[Vec<Vec<f64>>; 2]> = (0..4)
                    .filter(|k| !attributes[format!("JOINTS_{k}")].is_null())
                    .map(|k| {
                        let read = |name: &str| self.accessor_elements(&attributes[format!("{name}_{k}")]);
                        [read("JOINTS"), read("WEIGHTS")]
                    })
                    .collect();
                for (vertex, p) in own.iter_mut().enumerate() {
                    let (mut sum, mut total) = (DVec3::ZERO, 0.0);
                    for [numbers, shares] in &sets {
                        for (joint, share) in numbers[vertex].iter().zip(&shares[vertex]) {
                            sum += joints[*joint as usize].transform_point3(*p) * *share;
                            total += share;
                        }
                    }
                    *p = sum / total;
                }
            } else {
                own.iter_mut().for_each(|p| *p = world[node].transform_point3(*p));
            }
            points.extend(own);
        }
        points
    }
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

fn index(value: &Value) -> Option<usize> {
    value.as_u64().map(|value| value as usize)
}

fn floats(value: &Value) -> Vec<f64> {
    list(value).iter().map(|value| value.as_f64().unwrap()).collect()
}
