//! Tests of `ligne info` on scenes in memory.

use glam::{DAffine3, DVec3};

use super::info_args::InfoArgs;
use super::model_contents::ModelInfo;
use crate::animation::rig::{Node, Placement, Skin};
use crate::animation::{AnimationTarget, Clip, ClipChannel, Interpolation, NodeProperty, Rig, Track};
use crate::cli::options::step_args::StepArgs;
use crate::scene::{Geometry, Material, Part, Scene};

fn scene(parts: usize) -> Scene {
    let geometry = Geometry {
        positions: vec![DVec3::ZERO, DVec3::X * 12.5, DVec3::Y],
        triangles: vec![[0, 1, 2]],
        wires: vec![[0, 1]],
        ..Geometry::default()
    };
    let part = |n: usize| Part {
        name: format!("bolt\u{1b}{n}"),
        geometry: 0,
        world_from_part: DAffine3::from_translation(DVec3::Z * n as f64),
    };
    let mut scene = Scene {
        format: "OBJ",
        geometries: vec![geometry],
        parts: (0..parts).map(part).collect(),
        materials: vec![Material::default()],
        ..Scene::default()
    };
    scene.warnings.count("doubled faces", 3);
    scene
}

fn walk_clip() -> Clip {
    let track = Track::new(vec![0.5, 1.0, 2.5], vec![0.0; 9], Interpolation::Linear).unwrap();
    Clip {
        name: "Walk".to_owned(),
        channels: vec![ClipChannel { target: AnimationTarget::Node(0, NodeProperty::Scale), track }],
    }
}

fn rig(clip: Clip) -> Rig {
    Rig { clips: vec![clip], ..Rig::default() }
}

fn args(model: &str) -> InfoArgs {
    InfoArgs { model: model.into(), unit: None, all: false, json: false, step: StepArgs::default() }
}

#[test]
fn info_text_shortens_long_part_lists() {
    let text = ModelInfo::of(&scene(22), &rig(walk_clip()), &args("m.obj")).text(false);
    let start = "m.obj: OBJ, y up\n  22 triangles, 66 vertices\n  12.5 x 1 x 21, from (0, 0, 0) to (12.5, 1, 21)\n  \
                 22 parts:\n    bolt 0: 1 triangle, 1 line\n";
    assert!(text.starts_with(start), "{text}");
    assert!(text.contains("    and 2 more (--all lists them)\n  1 material:\n    (no name): #cccccc\n"));
    assert!(
        text.contains("  1 animation:\n    Walk: 2 s, from 0.5 s, 1 key a second\n")
            && text.contains("    3 doubled faces\n"),
        "{text}"
    );
    assert!(!text.contains("camera") && !text.contains("light"));
}

#[test]
fn info_text_lists_texture_coordinates_and_vertex_colours() {
    let mut scene = scene(1);
    scene.geometries[0].corner_uvs = vec![[0; 3]];
    assert!(
        ModelInfo::of(&scene, &Rig::default(), &args("m.obj"))
            .text(false)
            .contains(": 1 triangle, 1 line, texture coordinates\n")
    );
    scene.geometries[0].colours = vec![[1.0; 4]; 3];
    let text = ModelInfo::of(&scene, &Rig::default(), &args("m.obj")).text(false);
    assert!(text.contains(", texture coordinates, coloured vertices\n"), "{text}");
}

#[test]
fn info_reports_parts_that_are_wound_inward() -> Result<(), serde_json::Error> {
    let mut scene = scene(2);
    scene.geometries[0].positions.push(DVec3::Z);
    // A tetrahedron that is wound inward.
    scene.geometries[0].triangles = vec![[0, 1, 2], [0, 3, 1], [1, 3, 2], [0, 2, 3]];
    scene.geometries[0].wires.clear();
    let mut right = scene.geometries[0].clone();
    right.triangles.iter_mut().for_each(|t| t.swap(1, 2));
    scene.geometries.push(right);
    scene.parts[1].geometry = 1;
    let info = ModelInfo::of(&scene, &Rig::default(), &args("m.obj"));
    let text = info.text(false);
    let wanted = "  4 triangles turned in 1 surface: their winding in the file points inward or contradicts their neighbours\n  2 parts:\n    \
                  bolt 0: 4 triangles, 4 triangles turned in 1 surface\n    bolt 1: 4 triangles\n";
    assert!(text.contains(wanted), "{text}");
    let value: serde_json::Value = serde_json::from_str(&serde_json::to_string(&info)?)?;
    assert_eq!(value["turned"], serde_json::json!({"triangles": 4, "surfaces": 1}));
    assert_eq!(value["parts"][0]["turned"]["triangles"], 4);
    assert_eq!(value["parts"][1]["turned"]["triangles"], 0);
    Ok(())
}

#[test]
fn info_json_lists_all_parts() -> Result<(), serde_json::Error> {
    let json = serde_json::to_string(&ModelInfo::of(&scene(22), &rig(walk_clip()), &args("m.obj")))?;
    let value: serde_json::Value = serde_json::from_str(&json)?;
    assert_eq!(value["parts"].as_array().map(Vec::len), Some(22));
    assert_eq!(value["parts"][3]["name"], "bolt\u{1b}3");
    assert_eq!(value["bounds"]["max"], serde_json::json!([12.5, 1.0, 21.0]));
    assert_eq!(value["warnings"][0], "3 doubled faces");
    Ok(())
}

#[test]
fn parts_scaled_to_zero_have_no_coordinate_precision() -> Result<(), serde_json::Error> {
    let mut scene = scene(2);
    scene.parts[1].world_from_part = DAffine3::from_scale(DVec3::ZERO);
    let info = ModelInfo::of(&scene, &Rig::default(), &args("m.obj"));
    assert!(
        info.text(true).contains(", exact coordinates\n    bolt 1: 1 triangle, 1 line\n"),
        "{}",
        info.text(true)
    );
    let value: serde_json::Value = serde_json::from_str(&serde_json::to_string(&info)?)?;
    let steps = [&value["parts"][0]["step"], &value["parts"][1]["step"]];
    assert_eq!(steps, [&serde_json::json!(0.0), &serde_json::Value::Null]);
    Ok(())
}

#[test]
fn parts_of_one_body_share_the_coarsest_lattice_step() {
    // Two faces of one tetrahedron in two parts; only the first part has a lattice.
    let mut scene = scene(2);
    let step = 1e-5;
    scene.parts.iter_mut().for_each(|part| part.world_from_part = DAffine3::IDENTITY);
    scene.geometries[0].lattice_step = step;
    scene.geometries[0].wires.clear();
    let mut other = scene.geometries[0].clone();
    other.positions.push(DVec3::Z);
    other.lattice_step = 0.0;
    other.triangles = vec![[1, 0, 3]];
    scene.geometries.push(other);
    scene.parts[1].geometry = 1;
    let text = ModelInfo::of(&scene, &Rig::default(), &args("m.obj")).text(true);
    assert_eq!(text.matches(", step 1e-5 (decimals of the file), rounding 9e-6\n").count(), 2, "{text}");
}

#[test]
fn info_text_of_an_empty_model_reports_zero_triangles() {
    assert!(
        ModelInfo::of(&scene(0), &Rig::default(), &args("m.obj"))
            .text(false)
            .starts_with("m.obj: OBJ, y up\n  0 triangles")
    );
}

#[test]
fn info_text_counts_joints_and_lists_them_with_all() -> Result<(), serde_json::Error> {
    let node = |name: &str, parent| Node {
        name: name.to_owned(),
        leaves_lines: false,
        parent,
        rest: Placement::Matrix(DAffine3::IDENTITY),
        weights: Vec::new(),
        visible: true,
    };
    let rig = Rig {
        nodes: vec![node("hips", None), node("mesh", None), node("spine", Some(0))],
        skins: vec![Skin { joints: vec![2, 0], binds: vec![DAffine3::IDENTITY; 2] }],
        ..rig(walk_clip())
    };
    let info = ModelInfo::of(&scene(1), &rig, &args("m.glb"));
    assert!(info.text(false).contains("  2 joints (--all lists them)\n"), "{}", info.text(false));
    assert!(
        info.text(true).contains("  2 joints:\n    hips\n    spine, below hips\n"),
        "{}",
        info.text(true)
    );
    let value: serde_json::Value = serde_json::from_str(&serde_json::to_string(&info)?)?;
    assert_eq!(value["joints"][1], serde_json::json!({"name": "spine", "parent": "hips"}));
    Ok(())
}

#[test]
fn info_text_lists_more_than_twenty_clips_only_with_all() {
    let clips = vec![walk_clip(); 25];
    let info = ModelInfo::of(&scene(1), &Rig { clips, ..Rig::default() }, &args("m.glb"));
    assert_eq!(info.text(false).matches("    Walk: ").count(), 20);
    assert_eq!(info.text(true).matches("    Walk: ").count(), 25);
}
