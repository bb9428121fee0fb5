//! The glTF models in `examples/models` are made of solids, and their clips move parts as computed.

use std::collections::BTreeSet;

use super::example_models::assert_solid;
use crate::library::support::readers::example_files::{
    FilePart, Glb, example_bytes, example_path, weld_points,
};

/// Asserts that every mesh of a glTF file is solid, with unit normals if any.
fn assert_meshes_solid(glb: &Glb) {
    for mesh in glb.list("meshes") {
        let name = mesh["name"].as_str().unwrap().to_owned();
        let mut part = FilePart { name, points: Vec::new(), faces: Vec::new() };
        for primitive in mesh["primitives"].as_array().unwrap() {
            let attributes = &primitive["attributes"];
            part.points.extend(glb.points(&attributes["POSITION"]));
            let corners = glb.indices(&primitive["indices"]);
            part.faces.extend(corners.chunks_exact(3).map(|face| [face[0], face[1], face[2]]));
            if !attributes["NORMAL"].is_null() {
                let mut normals = glb.points(&attributes["NORMAL"]);
                assert!(normals.all(|n| (n.map(|v| v * v).iter().sum::<f64>() - 1.0).abs() < 1e-4));
            }
        }
        assert_solid(&weld_points(&part));
    }
}

#[test]
fn pump_is_made_of_named_solids() {
    let glb = Glb::read("pump.glb");
    assert_meshes_solid(&glb);
    let nodes = glb.list("nodes");
    let names: BTreeSet<&str> = nodes.iter().map(|node| node["name"].as_str().unwrap()).collect();
    assert_eq!(names.len(), nodes.len(), "names are unique");
    for name in ["base-plate", "volute", "motor-housing", "coupling-star", "cover-bolt-10", "camera"] {
        assert!(names.contains(name), "no node {name}");
    }
    assert_eq!(glb.list("cameras").len(), 1);
    let bolt = glb.list("meshes").iter().position(|mesh| mesh["name"] == "bolt").unwrap();
    let shown = nodes.iter().filter(|node| node["mesh"] == bolt);
    assert!(shown.count() >= 20, "bolts are instanced");
}

#[test]
fn drive_is_made_of_named_solids_and_is_small() {
    let glb = Glb::read("drive.glb");
    assert_meshes_solid(&glb);
    let nodes = glb.list("nodes");
    let names: BTreeSet<&str> = nodes.iter().map(|node| node["name"].as_str().unwrap()).collect();
    assert_eq!(names.len(), nodes.len(), "names are unique");
    for name in ["housing", "disc-2", "ring-pin-12", "input-shaft", "output-flange", "cap-screw-6"] {
        assert!(names.contains(name), "no node {name}");
    }
    assert!(example_bytes("drive.glb").len() < 300_000, "{} bytes", example_bytes("drive.glb").len());
}

#[test]
fn street_is_made_of_many_solids_without_normals() {
    let glb = Glb::read("street.glb");
    assert_meshes_solid(&glb);
    assert!(glb.list("nodes").iter().filter(|node| !node["mesh"].is_null()).count() > 100);
    let mut primitives = glb.list("meshes").iter().flat_map(|mesh| mesh["primitives"].as_array().unwrap());
    assert!(primitives.all(|primitive| primitive["attributes"]["NORMAL"].is_null()));
}

#[test]
fn crane_is_made_of_solids_and_its_clip_loops() {
    let glb = Glb::read("crane.glb");
    assert_meshes_solid(&glb);
    let rigged = ligne::animation::Rigged::open(example_path("crane.glb")).unwrap();
    let [clip] = &rigged.rig.clips[..] else { panic!("one clip") };
    assert_eq!((clip.name.as_str(), clip.span(), clip.channels.len()), ("lift", [0.0, 4.0], 4));
    let at = |time: f64| {
        let scene = rigged.posed(&[ligne::animation::Playing::all(0, time)]).unwrap();
        scene.parts.iter().find(|part| part.name == "hook").unwrap().world_from_part
    };
    // Forward kinematics of the hook at 1 s: an arm of length 4 at 60 degrees and one of 2.6 at -20 degrees.
    let hook = at(1.0).translation;
    let along = |length: f64, degrees: f64| {
        use ligne::geometry::numbers::portable_math::{cos, sin};
        glam::DVec3::new(cos(degrees.to_radians()), sin(degrees.to_radians()), 0.0) * length
    };
    let expected = glam::DVec3::new(0.5, 1.9, 0.0) + along(4.0, 60.0) + along(2.6, -20.0);
    assert!(hook.distance(expected) < 1e-5, "{hook} {expected}");
    assert!(at(0.0).abs_diff_eq(at(4.0), 1e-6) && !at(0.0).abs_diff_eq(at(2.0), 1.0));
}

#[test]
fn brick_is_made_of_solids_and_flies_along_a_parabola() {
    let glb = Glb::read("brick.glb");
    assert_meshes_solid(&glb);
    let rigged = ligne::animation::Rigged::open(example_path("brick.glb")).unwrap();
    let [clip] = &rigged.rig.clips[..] else { panic!("one clip") };
    assert_eq!((clip.name.as_str(), clip.span()), ("fly", [0.0, 1.5]));
    let marked: Vec<&str> =
        rigged.rig.nodes.iter().filter(|node| node.leaves_lines).map(|node| node.name.as_str()).collect();
    assert_eq!(marked, ["brick"]);
    for time in [0.0, 0.4, 0.75, 1.1, 1.5] {
        let scene = rigged.posed(&[ligne::animation::Playing::all(0, time)]).unwrap();
        let at = scene.parts.iter().find(|part| part.name == "brick").unwrap().world_from_part.translation;
        let thrown = glam::DVec3::new(-2.2 + 2.9 * time, 1.2 + (2.0 - 1.3 * time) * time, -0.42);
        assert!(at.distance(thrown) < 1e-5, "{time}: {at} {thrown}");
    }
}
