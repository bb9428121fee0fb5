//! Poses at a time of a clip: an own reader of glTF, which evaluates slowly and plainly, puts every vertex in the same place.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use glam::{DMat4, DVec3};
use ligne::Scene;
use ligne::math::function::{acos, cos, sin};
use ligne::pose::{Playing, Rigged};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

use crate::support::models;

/// A glTF file read for the second time, by other code.
struct Plain {
    json: Value,
    buffers: Vec<Vec<u8>>,
}

impl Plain {
    fn open(path: &Path) -> Self {
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

    /// The elements of an accessor.
    fn read(&self, accessor: &Value) -> Vec<Vec<f64>> {
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
                self.numbers(view, offset, kind, width, count, own["normalized"] == true)
            }
            None => vec![vec![0.0; width]; count],
        };
        let sparse = &own["sparse"];
        if let Some(count) = index(&sparse["count"]) {
            let part = |part: &Value, kind: u64, width: usize| {
                let offset = index(&part["byteOffset"]).unwrap_or(0);
                self.numbers(index(&part["bufferView"]).unwrap(), offset, kind, width, count, false)
            };
            let places = part(&sparse["indices"], sparse["indices"]["componentType"].as_u64().unwrap(), 1);
            for (place, value) in places.iter().zip(part(&sparse["values"], kind, width)) {
                all[place[0] as usize] = value;
            }
        }
        all
    }

    fn numbers(
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

    /// The value of a channel at a time.
    fn value(&self, animation: &Value, channel: &Value, time: f64) -> Vec<f64> {
        let sampler = &animation["samplers"][index(&channel["sampler"]).unwrap()];
        let times: Vec<f64> = self.read(&sampler["input"]).concat();
        let cubic = sampler["interpolation"] == "CUBICSPLINE";
        let numbers: Vec<f64> = self.read(&sampler["output"]).concat();
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
                    // The equation as the specification prints it.
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

    /// A number of a node at a time: what a clip says, else what the node says, else a default.
    fn property(&self, node: usize, path: &str, playing: Option<(usize, f64)>, default: &[f64]) -> Vec<f64> {
        if let Some((clip, time)) = playing {
            let animation = &self.json["animations"][clip];
            let target = |channel: &&Value| {
                index(&channel["target"]["node"]) == Some(node) && channel["target"]["path"] == path
            };
            if let Some(channel) = list(&animation["channels"]).iter().find(target) {
                return self.value(animation, channel, time);
            }
        }
        let own = &self.json["nodes"][node][path];
        if own.is_null() { default.to_vec() } else { floats(own) }
    }

    fn local(&self, node: usize, playing: Option<(usize, f64)>) -> DMat4 {
        let matrix = &self.json["nodes"][node]["matrix"];
        if !matrix.is_null() {
            return DMat4::from_cols_slice(&floats(matrix));
        }
        let t = self.property(node, "translation", playing, &[0.0; 3]);
        let q = self.property(node, "rotation", playing, &[0.0, 0.0, 0.0, 1.0]);
        let s = self.property(node, "scale", playing, &[1.0; 3]);
        let [x, y, z, w] = [q[0], q[1], q[2], q[3]];
        // The matrix of a quaternion, written out.
        let turn = [
            [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)],
            [2.0 * (x * y - z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * w)],
            [2.0 * (x * z + y * w), 2.0 * (y * z - x * w), 1.0 - 2.0 * (x * x + y * y)],
        ];
        let column = |k: usize| [turn[k][0] * s[k], turn[k][1] * s[k], turn[k][2] * s[k], 0.0];
        DMat4::from_cols_array_2d(&[column(0), column(1), column(2), [t[0], t[1], t[2], 1.0]])
    }

    /// The vertices of each node that has a mesh, depth first.
    fn points(&self, playing: Option<(usize, f64)>) -> Vec<Vec<DVec3>> {
        let nodes = list(&self.json["nodes"]).len();
        let mut parents = vec![None; nodes];
        for node in 0..nodes {
            for child in list(&self.json["nodes"][node]["children"]) {
                parents[index(child).unwrap()] = Some(node);
            }
        }
        let world = |node: usize| {
            let mut matrix = self.local(node, playing);
            let mut at = node;
            while let Some(parent) = parents[at] {
                matrix = self.local(parent, playing) * matrix;
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
                found.push(self.mesh(node, mesh, &all, playing));
            }
        }
        found
    }

    fn mesh(&self, node: usize, mesh: usize, world: &[DMat4], playing: Option<(usize, f64)>) -> Vec<DVec3> {
        let mesh = &self.json["meshes"][mesh];
        let resting = if mesh["weights"].is_null() { Vec::new() } else { floats(&mesh["weights"]) };
        let weights = self.property(node, "weights", playing, &resting);
        let skin = index(&self.json["nodes"][node]["skin"]).map(|skin| &self.json["skins"][skin]);
        let joints: Vec<DMat4> = skin.map_or_else(Vec::new, |skin| {
            let binds = self.read(&skin["inverseBindMatrices"]);
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
            let mut own: Vec<DVec3> =
                self.read(&attributes["POSITION"]).iter().map(|p| DVec3::new(p[0], p[1], p[2])).collect();
            for (target, weight) in list(&primitive["targets"]).iter().zip(&weights) {
                if !target["POSITION"].is_null() {
                    let moves = self.read(&target["POSITION"]);
                    own.iter_mut().zip(moves).for_each(|(p, m)| *p += DVec3::new(m[0], m[1], m[2]) * *weight);
                }
            }
            if skin.is_some() {
                let sets: Vec<[Vec<Vec<f64>>; 2]> = (0..4)
                    .filter(|k| !attributes[format!("JOINTS_{k}")].is_null())
                    .map(|k| {
                        let read = |name: &str| self.read(&attributes[format!("{name}_{k}")]);
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

/// The vertices of each part in the world.
fn points(scene: &Scene) -> Vec<Vec<DVec3>> {
    let of = |part: &ligne::scene::Part| {
        let positions = &scene.geometries[part.geometry].positions;
        positions.iter().map(|p| part.world_from_part.transform_point3(*p)).collect()
    };
    scene.parts.iter().map(of).collect()
}

/// How far poses of all clips at some times are from what is evaluated plainly, in sizes of the model, and whether anything moves.
fn farthest(path: &Path, most_clips: usize) -> (f64, f64) {
    let (rigged, plain) = (Rigged::open(path).unwrap(), Plain::open(path));
    let far = |a: &[Vec<DVec3>], b: &[Vec<DVec3>]| {
        assert_eq!(a.len(), b.len(), "{}", path.display());
        let pairs = a.iter().zip(b).flat_map(|(a, b)| {
            assert_eq!(a.len(), b.len(), "{}", path.display());
            a.iter().zip(b)
        });
        pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
    };
    let rest = points(&rigged.scene);
    let all = || rest.iter().flatten();
    let low = all().fold(DVec3::INFINITY, |low, p| low.min(*p));
    let size = all().fold(DVec3::NEG_INFINITY, |high, p| high.max(*p)).distance(low);
    let mut worst = far(&rest, &plain.points(None)) / size;
    let mut moved = 0.0_f64;
    for (number, clip) in rigged.rig.clips.iter().enumerate().take(most_clips) {
        let [from, to] = clip.span();
        for share in [-0.5, 0.0, 0.213, 0.5, 0.77, 1.0, 1.5] {
            let time = from + (to - from) * share;
            let posed = points(&rigged.posed(&[Playing::all(number, time)]).unwrap());
            worst = worst.max(far(&posed, &plain.points(Some((number, time)))) / size);
            moved = moved.max(far(&posed, &rest) / size);
        }
    }
    (worst, moved)
}

#[test]
fn shared_models_are_posed_as_an_independent_evaluation_says() {
    for (name, clips) in [
        ("animated/Fox.glb", 3),
        ("animated/CesiumMan.glb", 1),
        ("animated/Knight.glb", 4),
        ("animated/AnimatedMorphCube/AnimatedMorphCube.gltf", 1),
        ("animated/InterpolationTest/InterpolationTest.gltf", 9),
        ("animated/MorphStressTest.gltf", 3),
    ] {
        let Some(path) = models::find(name) else { continue };
        let (far, moved) = farthest(&path, clips);
        assert!(far < 1e-5, "{name}: {far:e}");
        assert!(moved > 0.01, "{name} hardly moves: {moved}");
    }
}

/// A file of our own: an arm of two joints, with a swelling and a flag on it, moved in all ways there are.
struct Arm(PathBuf);

impl Arm {
    fn new(name: &str, change: impl FnOnce(&mut Value)) -> Self {
        let mut bytes: Vec<u8> = Vec::new();
        let (mut views, mut accessors) = (Vec::new(), Vec::new());
        let mut add = |shape: &str, width: usize, numbers: &[f32]| {
            views.push(json!({"buffer": 0, "byteOffset": bytes.len(), "byteLength": 4 * numbers.len()}));
            let count = numbers.len() / width;
            let view = views.len() - 1;
            accessors.push(json!({"bufferView": view, "componentType": 5126, "count": count, "type": shape}));
            numbers.iter().for_each(|value| bytes.extend(value.to_le_bytes()));
            accessors.len() - 1
        };
        // A strip of nine steps along x, which bends between its joints.
        let steps: Vec<f32> = (0..=9).map(|k| k as f32 / 3.0).collect();
        let strip = |of: &dyn Fn(f32) -> [f32; 3]| -> Vec<f32> {
            steps
                .iter()
                .flat_map(|x| {
                    [of(*x), {
                        let [a, b, c] = of(*x);
                        [a, b + 0.4, c]
                    }]
                })
                .flatten()
                .collect()
        };
        let position = add("VEC3", 3, &strip(&|x| [x, 0.0, 0.1 * x]));
        let swelling: Vec<f32> = steps.iter().flat_map(|x| [0.0, -x * 0.1, 0.2, 0.0, x * 0.1, 0.2]).collect();
        let target = add("VEC3", 3, &swelling);
        let shares: Vec<f32> = steps
            .iter()
            .flat_map(|x| {
                let s = (x / 3.0).min(1.0);
                [1.0 - s, s, 0.0, 0.0].repeat(2)
            })
            .collect();
        let weights = add("VEC4", 4, &shares);
        let joints = add("VEC4", 4, &[0.0, 1.0, 0.0, 0.0].repeat(20));
        let mut binds = vec![1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1.];
        binds.extend([1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., 0., -1.5, 0., 0., 1.]);
        let bind = add("MAT4", 16, &binds);
        let indices: Vec<f32> =
            (0..9_u8).flat_map(|k| [0, 2, 1, 1, 2, 3].map(|i| f32::from(2 * k + i))).collect();
        let index = add("SCALAR", 1, &indices);
        let times = add("SCALAR", 1, &[0.5, 1.0, 2.0]);
        let turn = |degrees: f64| {
            let half = degrees.to_radians() / 2.0;
            [0.0, 0.0, sin(half) as f32, cos(half) as f32]
        };
        let turns = add("VEC4", 4, &[turn(0.0), turn(70.0), turn(-100.0)].concat());
        let moves = add(
            "VEC3",
            3,
            &[
                0., 0., 0., 0., 0., 0., 2., 1., 0., 1., 0., 0., 0., 1., 0., 0., 3., 0., 0., 1., 2., 0., 0.,
                1., 0., 0., 0.,
            ],
        );
        let scales = add("VEC3", 3, &[1., 1., 1., 1., 2., 1., 3., 1., 1.]);
        let swells = add("SCALAR", 1, &[0.0, 1.0, 0.25]);
        // Indices and joints are whole numbers in a file.
        for (accessor, kind) in [(index, 5125), (joints, 5125)] {
            let view = &views[accessors[accessor]["bufferView"].as_u64().unwrap() as usize];
            let begin = view["byteOffset"].as_u64().unwrap() as usize;
            for word in
                bytes[begin..begin + view["byteLength"].as_u64().unwrap() as usize].as_chunks_mut::<4>().0
            {
                *word = (f32::from_le_bytes(*word) as u32).to_le_bytes();
            }
            accessors[accessor]["componentType"] = json!(kind);
        }
        let sampler =
            |output: usize, way: &str| json!({"input": times, "output": output, "interpolation": way});
        let channel = |sampler: usize, node: usize, path: &str| json!({"sampler": sampler, "target": {"node": node, "path": path}});
        let attributes = json!({"POSITION": position, "JOINTS_0": joints, "WEIGHTS_0": weights});
        let mut file = json!({
            "asset": {"version": "2.0"},
            "scenes": [{"nodes": [0, 3]}],
            "nodes": [
                {"name": "shoulder", "children": [1], "translation": [0.0, 0.2, 0.0]},
                {"name": "elbow", "children": [2], "translation": [1.5, 0.0, 0.0]},
                {"name": "flag", "mesh": 1, "scale": [0.2, 0.5, 1.0], "rotation": [0.0, 0.6, 0.0, 0.8]},
                {"name": "arm", "mesh": 0, "skin": 0}
            ],
            "meshes": [
                {"primitives": [{"attributes": attributes, "indices": index, "targets": [{"POSITION": target}]}]},
                {"primitives": [{"attributes": {"POSITION": position}, "indices": index}]}
            ],
            "skins": [{"joints": [0, 1], "inverseBindMatrices": bind}],
            "animations": [
                {"name": "bend", "samplers": [sampler(turns, "LINEAR"), sampler(moves, "CUBICSPLINE")],
                 "channels": [channel(0, 1, "rotation"), channel(1, 0, "translation")]},
                {"name": "swell", "samplers": [sampler(swells, "LINEAR"), sampler(scales, "STEP"), sampler(turns, "STEP")],
                 "channels": [channel(0, 3, "weights"), channel(1, 2, "scale"), channel(2, 1, "rotation")]}
            ],
            "accessors": accessors, "bufferViews": views,
            "buffers": [{"byteLength": bytes.len(), "uri": format!("data:application/octet-stream;base64,{}", STANDARD.encode(&bytes))}]
        });
        change(&mut file);
        let path = std::env::temp_dir().join(format!("ligne-arm-{}-{name}.gltf", std::process::id()));
        std::fs::write(&path, file.to_string()).unwrap();
        Self(path)
    }
}

impl Drop for Arm {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0);
    }
}

#[test]
fn an_arm_is_posed_as_an_independent_evaluation_says() {
    let arm = Arm::new("posed", |_| {});
    let (far, moved) = farthest(&arm.0, 2);
    assert!(far < 1e-6, "{far:e}");
    assert!(moved > 0.1, "{moved}");
}

#[test]
fn clips_that_play_together_share_what_they_move() {
    let arm = Arm::new("shared", |_| {});
    let rigged = Rigged::open(&arm.0).unwrap();
    let at = |playing: &[Playing]| points(&rigged.posed(playing).unwrap());
    let rest = points(&rigged.scene);
    assert_eq!(at(&[]), rest);
    let (bend, swell) = (Playing::all(0, 1.3), Playing::all(1, 1.3));
    let of = |playing: Playing, weight: f64| Playing { weight, ..playing };
    // Nothing of a clip is nothing, all of one is itself, and the order does not matter much.
    assert_eq!(at(&[bend, of(swell, 0.0)]), at(&[bend]));
    let far = |a: Vec<Vec<DVec3>>, b: Vec<Vec<DVec3>>| {
        a.concat().iter().zip(b.concat()).map(|(a, b)| a.distance(b)).fold(0.0, f64::max)
    };
    let both = [of(bend, 0.5), of(swell, 0.5)];
    assert!(far(at(&both), at(&[both[1], both[0]])) < 1e-12);
    assert!(far(at(&[bend, swell]), at(&[bend])) > 0.05);
    // A quarter is nearer to rest than a half.
    let [quarter, half] = [0.25, 0.5].map(|weight| far(at(&[of(bend, weight)]), rest.clone()));
    assert!(quarter > 0.0 && quarter < half, "{quarter} {half}");
}

#[test]
fn broken_animations_leave_the_stored_pose_and_a_warning() {
    let warned = |name: &str, change: &dyn Fn(&mut Value), expected: &str| {
        let arm = Arm::new(name, |file| change(file));
        let rigged = Rigged::open(&arm.0).unwrap();
        let lines = rigged.scene.warnings.lines();
        assert!(lines.iter().any(|line| line.contains(expected)), "{name}: {lines:?}");
        for clip in 0..rigged.rig.clips.len() {
            rigged.posed(&[Playing::all(clip, 1.0)]).unwrap();
        }
        // A drawing without a time does not mind.
        assert!(Scene::open(&arm.0).unwrap().warnings.is_empty());
    };
    let channel =
        |file: &mut Value, key: &str, value: Value| file["animations"][0]["channels"][0][key] = value;
    warned(
        "node",
        &|file| channel(file, "target", json!({"node": 9, "path": "rotation"})),
        "it moves node 9",
    );
    warned("path", &|file| channel(file, "target", json!({"node": 0, "path": "colour"})), "path `colour`");
    warned("sampler", &|file| channel(file, "sampler", json!(7)), "sampler 7 of 2");
    warned("width", &|file| channel(file, "sampler", json!(1)), "accessor");
    warned(
        "way",
        &|file| file["animations"][0]["samplers"][0]["interpolation"] = json!("SPLINE"),
        "`SPLINE`",
    );
    warned("times", &|file| file["animations"][0]["samplers"][0]["input"] = json!(99), "accessor 99");
    let pointer =
        json!({"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": "/materials/0/x"}}});
    warned("pointer", &|file| channel(file, "target", pointer.clone()), "not drawn");
    let arm = Arm::new("errors", |_| {});
    let rigged = Rigged::open(&arm.0).unwrap();
    for playing in
        [Playing::all(2, 0.0), Playing::all(0, f64::NAN), Playing { clip: 0, time: 0.0, weight: -1.0 }]
    {
        assert!(rigged.posed(&[playing]).is_err());
    }
}

#[test]
fn pointers_move_nodes_and_hide_them() {
    let arm = Arm::new("pointers", |file| {
        let pointer =
            |to: &str| json!({"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": to}}});
        file["animations"][0]["channels"][0]["target"] = pointer("/nodes/1/rotation");
        let swells = file["animations"][1]["samplers"][0].clone();
        file["animations"][1]["channels"][0]["target"] =
            pointer("/nodes/1/extensions/KHR_node_visibility/visible");
        file["animations"][1]["samplers"][0] = swells;
    });
    let rigged = Rigged::open(&arm.0).unwrap();
    let plain = Arm::new("plain", |_| {});
    let same = Rigged::open(&plain.0).unwrap();
    let bend = [Playing::all(0, 0.8)];
    assert_eq!(points(&rigged.posed(&bend).unwrap()), points(&same.posed(&bend).unwrap()));
    // The elbow is hidden at first, and the flag with it.
    let names = |time: f64| {
        let scene = rigged.posed(&[Playing::all(1, time)]).unwrap();
        scene.parts.iter().map(|part| part.name.clone()).collect::<Vec<_>>()
    };
    assert_eq!(names(0.5), ["arm"]);
    assert_eq!(names(1.0), ["flag", "arm"]);
}
