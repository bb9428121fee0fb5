//! Poses at times of a clip, compared vertex by vertex with a plain, independent glTF evaluator.

use std::path::{Path, PathBuf};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use glam::DVec3;
use ligne::Scene;
use ligne::animation::{Playing, Rigged};
use ligne::geometry::numbers::portable_math::{cos, sin};
use serde_json::{Value, json};

use crate::library::support::readers::plain_gltf::ReferenceGltf;
use crate::library::support::readers::shared_folder;

/// World-space vertices of each part.
fn world_points(scene: &Scene) -> Vec<Vec<DVec3>> {
    let of = |part: &ligne::scene::Part| {
        let positions = &scene.geometries[part.geometry].positions;
        positions.iter().map(|p| part.world_from_part.transform_point3(*p)).collect()
    };
    scene.parts.iter().map(of).collect()
}

/// Largest distance of posed vertices from the plain evaluator, and largest motion from rest. Both are
/// relative to the size of the model, and cover several times of each clip.
fn max_pose_error_and_motion(path: &Path, most_clips: usize) -> (f64, f64) {
    let (rigged, plain) = (Rigged::open(path).unwrap(), ReferenceGltf::open(path));
    let far = |a: &[Vec<DVec3>], b: &[Vec<DVec3>]| {
        assert_eq!(a.len(), b.len(), "{}", path.display());
        let pairs = a.iter().zip(b).flat_map(|(a, b)| {
            assert_eq!(a.len(), b.len(), "{}", path.display());
            a.iter().zip(b)
        });
        pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
    };
    let rest = world_points(&rigged.scene);
    let all = || rest.iter().flatten();
    let low = all().fold(DVec3::INFINITY, |low, p| low.min(*p));
    let size = all().fold(DVec3::NEG_INFINITY, |high, p| high.max(*p)).distance(low);
    let mut worst = far(&rest, &plain.posed_vertices(None)) / size;
    let mut moved = 0.0_f64;
    for (number, clip) in rigged.rig.clips.iter().enumerate().take(most_clips) {
        let [from, to] = clip.span();
        for share in [-0.5, 0.0, 0.213, 0.5, 0.77, 1.0, 1.5] {
            let time = from + (to - from) * share;
            let posed = world_points(&rigged.posed(&[Playing::all(number, time)]).unwrap());
            worst = worst.max(far(&posed, &plain.posed_vertices(Some((number, time)))) / size);
            moved = moved.max(far(&posed, &rest) / size);
        }
    }
    (worst, moved)
}

#[test]
fn poses_of_shared_models_match_an_independent_evaluation() {
    for (name, clips) in [
        ("animated/Fox.glb", 3),
        ("animated/CesiumMan.glb", 1),
        ("animated/Knight.glb", 4),
        ("animated/AnimatedMorphCube/AnimatedMorphCube.gltf", 1),
        ("animated/InterpolationTest/InterpolationTest.gltf", 9),
        ("animated/MorphStressTest.gltf", 3),
    ] {
        let Some(path) = shared_folder::find(name) else { continue };
        let (far, moved) = max_pose_error_and_motion(&path, clips);
        assert!(far < 1e-5, "{name}: {far:e}");
        assert!(moved > 0.01, "{name} hardly moves: {moved}");
    }
}

/// Temporary glTF file: an arm with two joints, a morph target and a flag. Its clips use all channel types
/// and interpolations.
struct ArmFile(PathBuf);

impl ArmFile {
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
        // Strip of nine quads along x that bends between the joints.
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
        // Indices and joints are stored as integers.
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

impl Drop for ArmFile {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0);
    }
}

#[test]
fn poses_of_an_arm_match_an_independent_evaluation() {
    let arm = ArmFile::new("posed", |_| {});
    let (far, moved) = max_pose_error_and_motion(&arm.0, 2);
    assert!(far < 1e-6, "{far:e}");
    assert!(moved > 0.1, "{moved}");
}

#[test]
fn simultaneous_clips_blend_by_weight() {
    let arm = ArmFile::new("shared", |_| {});
    let rigged = Rigged::open(&arm.0).unwrap();
    let at = |playing: &[Playing]| world_points(&rigged.posed(playing).unwrap());
    let rest = world_points(&rigged.scene);
    assert_eq!(at(&[]), rest);
    let (bend, swell) = (Playing::all(0, 1.3), Playing::all(1, 1.3));
    let of = |playing: Playing, weight: f64| Playing { weight, ..playing };
    // A clip with weight 0 has no effect. The order of clips changes rounding only.
    assert_eq!(at(&[bend, of(swell, 0.0)]), at(&[bend]));
    let far = |a: Vec<Vec<DVec3>>, b: Vec<Vec<DVec3>>| {
        a.concat().iter().zip(b.concat()).map(|(a, b)| a.distance(b)).fold(0.0, f64::max)
    };
    let both = [of(bend, 0.5), of(swell, 0.5)];
    assert!(far(at(&both), at(&[both[1], both[0]])) < 1e-12);
    assert!(far(at(&[bend, swell]), at(&[bend])) > 0.05);
    // Weight 0.25 stays nearer to rest than weight 0.5.
    let [quarter, half] = [0.25, 0.5].map(|weight| far(at(&[of(bend, weight)]), rest.clone()));
    assert!(quarter > 0.0 && quarter < half, "{quarter} {half}");
}

#[test]
fn broken_animations_leave_the_stored_pose_and_a_warning() {
    let warned = |name: &str, change: &dyn Fn(&mut Value), expected: &str| {
        let arm = ArmFile::new(name, |file| change(file));
        let rigged = Rigged::open(&arm.0).unwrap();
        let lines = rigged.scene.warnings.lines();
        assert!(lines.iter().any(|line| line.contains(expected)), "{name}: {lines:?}");
        for clip in 0..rigged.rig.clips.len() {
            rigged.posed(&[Playing::all(clip, 1.0)]).unwrap();
        }
        // Opening the file as a still scene gives no warning.
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
    let arm = ArmFile::new("errors", |_| {});
    let rigged = Rigged::open(&arm.0).unwrap();
    for playing in
        [Playing::all(2, 0.0), Playing::all(0, f64::NAN), Playing { clip: 0, time: 0.0, weight: -1.0 }]
    {
        assert!(rigged.posed(&[playing]).is_err());
    }
}

/// Appends numbers in a new buffer and returns the index of their accessor.
fn append_accessor(file: &mut Value, shape: &str, width: usize, numbers: &[f32]) -> usize {
    let bytes: Vec<u8> = numbers.iter().flat_map(|value| value.to_le_bytes()).collect();
    let mut add = |list: &str, value: Value| {
        let list = file[list].as_array_mut().unwrap();
        list.push(value);
        list.len() - 1
    };
    let uri = format!("data:application/octet-stream;base64,{}", STANDARD.encode(&bytes));
    let buffer = add("buffers", json!({"byteLength": bytes.len(), "uri": uri}));
    let view = add("bufferViews", json!({"buffer": buffer, "byteLength": bytes.len()}));
    let count = numbers.len() / width;
    add("accessors", json!({"bufferView": view, "componentType": 5126, "count": count, "type": shape}))
}

#[test]
fn channels_with_invalid_keys_are_left_out() {
    let arm = |name: &str, key: &str, shape: &str, width: usize, numbers: &[f32]| {
        ArmFile::new(name, |file| {
            let accessor = append_accessor(file, shape, width, numbers);
            file["animations"][1]["samplers"][0][key] = json!(accessor);
        })
    };
    for (name, key, numbers, expected) in [
        ("nan-times", "input", [0.5, f32::NAN, 2.0], "the time of key 1 is not a number"),
        ("falling-times", "input", [0.5, 2.0, 1.0], "key 2 is earlier than the one before it"),
        ("nan-values", "output", [0.0, 1.0, f32::INFINITY], "key 2 has a value that is not a number"),
    ] {
        let arm = arm(name, key, "SCALAR", 1, &numbers);
        let rigged = Rigged::open(&arm.0).unwrap();
        let lines = rigged.scene.warnings.lines();
        assert!(lines.iter().any(|line| line.contains(expected)), "{name}: {lines:?}");
        // The weights keep their stored values. All other channels still play.
        let all = ArmFile::new(&format!("{name}-whole"), |file| {
            file["animations"][1]["channels"].as_array_mut().unwrap().remove(0);
        });
        let other = Rigged::open(&all.0).unwrap();
        let at = |rigged: &Rigged| world_points(&rigged.posed(&[Playing::all(1, 1.5)]).unwrap());
        assert_eq!(at(&rigged), at(&other), "{name}");
    }
}

#[test]
fn clips_of_zero_length_and_of_a_million_keys_play() {
    let still = ArmFile::new("no-length", |file| {
        let (time, value) =
            (append_accessor(file, "SCALAR", 1, &[1.0]), append_accessor(file, "SCALAR", 1, &[0.75]));
        let clip = &mut file["animations"][1];
        clip["samplers"] = json!([{"input": time, "output": value}]);
        clip["channels"] = json!([{"sampler": 0, "target": {"node": 3, "path": "weights"}}]);
    });
    let rigged = Rigged::open(&still.0).unwrap();
    assert_eq!(rigged.rig.clips[1].span(), [1.0, 1.0]);
    let at = |rigged: &Rigged, time: f64| world_points(&rigged.posed(&[Playing::all(1, time)]).unwrap());
    assert_eq!(at(&rigged, 1.0), at(&rigged, -7.0));
    assert_eq!(at(&rigged, 1.0), at(&rigged, 1e9));
    assert_ne!(at(&rigged, 1.0), world_points(&rigged.scene));
    let many = ArmFile::new("many-keys", |file| {
        // Weight that grows linearly from 0 at 0 s to 1 at 10 s.
        let times: Vec<f32> = (0..1_000_000).map(|k| k as f32 * 1e-5).collect();
        let values: Vec<f32> = (0..1_000_000).map(|k| k as f32 * 1e-6).collect();
        let (time, value) =
            (append_accessor(file, "SCALAR", 1, &times), append_accessor(file, "SCALAR", 1, &values));
        let clip = &mut file["animations"][1];
        clip["samplers"] = json!([{"input": time, "output": value}]);
        clip["channels"] = json!([{"sampler": 0, "target": {"node": 3, "path": "weights"}}]);
    });
    let keys = Rigged::open(&many.0).unwrap();
    let far = at(&keys, 7.5)
        .concat()
        .iter()
        .zip(at(&rigged, 1.0).concat())
        .map(|(a, b)| a.distance(b))
        .fold(0.0, f64::max);
    assert!(far < 1e-5, "{far:e}");
}

#[test]
fn skins_without_joints_are_refused_by_name() {
    for (name, skin, expected) in [
        ("no-joints", json!({"joints": []}), "the skin has 0"),
        ("joints-nowhere", json!({"joints": [0, 77]}), "joint 77 is not a node of the file"),
        ("joints-missing", json!({}), "`joints` is missing; add \"joints\": …"),
    ] {
        let arm = ArmFile::new(name, |file| file["skins"][0] = skin);
        let error = Rigged::open(&arm.0).unwrap_err().to_string();
        assert!(error.contains(expected), "{name}: {error}");
    }
}

#[test]
fn animation_pointers_move_and_hide_nodes() {
    let arm = ArmFile::new("pointers", |file| {
        let pointer =
            |to: &str| json!({"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": to}}});
        file["animations"][0]["channels"][0]["target"] = pointer("/nodes/1/rotation");
        let swells = file["animations"][1]["samplers"][0].clone();
        file["animations"][1]["channels"][0]["target"] =
            pointer("/nodes/1/extensions/KHR_node_visibility/visible");
        file["animations"][1]["samplers"][0] = swells;
    });
    let rigged = Rigged::open(&arm.0).unwrap();
    let plain = ArmFile::new("plain", |_| {});
    let same = Rigged::open(&plain.0).unwrap();
    let bend = [Playing::all(0, 0.8)];
    assert_eq!(world_points(&rigged.posed(&bend).unwrap()), world_points(&same.posed(&bend).unwrap()));
    // The elbow is hidden at first, and the flag with it.
    let names = |time: f64| {
        let scene = rigged.posed(&[Playing::all(1, time)]).unwrap();
        scene.parts.iter().map(|part| part.name.clone()).collect::<Vec<_>>()
    };
    assert_eq!(names(0.5), ["arm"]);
    assert_eq!(names(1.0), ["flag", "arm"]);
}
