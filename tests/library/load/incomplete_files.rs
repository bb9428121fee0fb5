//! Incomplete and redundant files: the valid rest is drawn with a warning, and an edge that the file lists as
//! a line too is drawn once.

use std::fmt::Write as _;

use glam::DVec3;
use ligne::geometry::numbers::portable_math::{cos, sin};
use ligne::lines::LineKind;
use ligne::load::{ModelFormat, gltf};
use ligne::scene::{Paints, Projection, TextureOptions};
use ligne::{Camera, Error, Scene, Style, SvgOptions, render};
use serde_json::{Value, json};

use crate::library::support::readers::glb_writer::glb;

const CORNERS: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];

/// glTF scene with two squares, one of them textured. `change` edits the JSON before it is read.
fn square(change: impl FnOnce(&mut Value)) -> Result<Scene, Error> {
    let mut picture = Vec::new();
    let mut encoder = png::Encoder::new(&mut picture, 1, 1);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header().unwrap().write_image_data(&[255, 0, 0]).unwrap();
    let floats = |values: &[f32]| values.iter().flat_map(|v| v.to_le_bytes()).collect::<Vec<u8>>();
    let indices: Vec<u8> = [0_u16, 1, 2, 0, 2, 3].iter().flat_map(|v| v.to_le_bytes()).collect();
    let uvs: Vec<f32> = CORNERS.iter().flat_map(|[x, y, _]| [*x, *y]).collect();
    let colours: Vec<f32> = CORNERS.iter().flat_map(|_| [1.0, 0.0, 0.0]).collect();
    let blocks = [floats(CORNERS.as_flattened()), indices, floats(&uvs), floats(&colours), picture];
    let (mut bin, mut views) = (Vec::new(), Vec::new());
    for block in blocks {
        views.push(json!({"buffer": 0, "byteOffset": bin.len(), "byteLength": block.len()}));
        bin.extend(block);
        bin.resize(bin.len().next_multiple_of(4), 0);
    }
    let floats = |view: usize, shape: &str| json!({"bufferView": view, "componentType": 5126, "count": 4, "type": shape});
    let mut file = json!({
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0, "name": "plate"}, {"mesh": 1, "name": "lid"}],
        "meshes": [
            {"name": "square", "primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 2}, "indices": 1, "material": 0}]},
            {"name": "cover", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]},
        ],
        "materials": [{"name": "paint", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0}],
        "images": [{"bufferView": 4, "mimeType": "image/png"}],
        "accessors": [
            floats(0, "VEC3"),
            {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
            floats(2, "VEC2"),
            floats(3, "VEC3"),
        ],
        "bufferViews": views,
        "buffers": [{"byteLength": bin.len()}],
    });
    change(&mut file);
    gltf::read_bytes(&glb(file.to_string(), &bin), &|_, _| Err(std::io::ErrorKind::NotFound.into()))
}

fn triangles(scene: &Scene) -> usize {
    scene.triangle_count()
}

#[test]
fn missing_references_drop_only_their_users() {
    let sound = square(|_| {}).unwrap();
    assert!(sound.warnings.is_empty(), "{}", sound.warnings);
    assert_eq!(triangles(&sound), 4);
    for gone in [999_i64, -1] {
        let cases: [(&str, Value, usize, String); 6] = [
            (
                "/meshes/0/primitives/0/material",
                json!(gone),
                4,
                format!("mesh 0 primitive 0 of `square`: has material {gone}, but the file has 1"),
            ),
            (
                "/nodes/1/mesh",
                json!(gone),
                2,
                format!("node 1: has mesh {gone}, but the file has 2; `lid` is left out"),
            ),
            ("/nodes/1/skin", json!(gone), 4, format!("node 1: has skin {gone}, but the file has 0")),
            ("/nodes/1/camera", json!(gone), 4, format!("node 1: has camera {gone}, but the file has 0")),
            (
                "/materials/0/pbrMetallicRoughness/baseColorTexture/index",
                json!(gone),
                4,
                format!("texture {gone} of material `paint`"),
            ),
            ("/textures/0/source", json!(gone), 4, format!("it shows image {gone}, but the file has 1")),
        ];
        for (place, value, left, words) in cases {
            let scene = square(|file| {
                let (above, key) = place.rsplit_once('/').unwrap();
                file.pointer_mut(above).unwrap()[key] = value;
            });
            let scene = scene.unwrap_or_else(|e| panic!("{place}: {e}"));
            assert_eq!(triangles(&scene), left, "{place}");
            let lines = scene.warnings.lines();
            assert_eq!(lines.len(), 1, "{place}: {lines:?}");
            assert!(lines[0].contains(&words), "{place}: {lines:?}");
        }
    }
    let error =
        square(|file| file["nodes"] = json!([{"mesh": 7, "name": "gone"}, {}])).unwrap_err().to_string();
    assert!(error.contains("node 0: has mesh 7") && error.contains("nothing to draw"), "{error}");
}

#[test]
fn textures_without_coordinates_give_a_warning() {
    let wanted = "mesh 0 primitive 0 of `square`: its texture wants TEXCOORD_1";
    let second = square(|file| {
        file["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = json!(1);
    });
    let none = square(|file| {
        file["meshes"][0]["primitives"][0]["attributes"] = json!({"POSITION": 0});
    });
    let moved = square(|file| {
        file["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] =
            json!({"KHR_texture_transform": {"texCoord": 1}});
    });
    for (scene, words) in [(second, wanted), (none, "wants TEXCOORD_0"), (moved, wanted)] {
        let scene = scene.unwrap();
        let lines = scene.warnings.lines();
        assert!(lines.len() == 1 && lines[0].contains(words), "{lines:?}");
        assert_eq!(triangles(&scene), 4);
    }
}

#[test]
fn a_bad_accessor_names_its_mesh_and_primitive() {
    for (key, value) in
        [("POSITION", json!(-1)), ("POSITION", json!(99)), ("indices", json!(-1)), ("NORMAL", json!(77))]
    {
        let error = square(|file| {
            let primitive = &mut file["meshes"][1]["primitives"][0];
            let place =
                if key == "indices" { &mut primitive["indices"] } else { &mut primitive["attributes"][key] };
            *place = value.clone();
        });
        let error = error.unwrap_err().to_string();
        let words =
            format!("mesh 1 primitive 0 of `cover`: accessor {value}: is pointed to, but the file has 4");
        assert!(error.contains(&words), "{error}");
    }
    let error = square(|file| file["accessors"][0]["bufferView"] = json!(-1)).unwrap_err().to_string();
    assert!(error.contains("mesh 0 primitive 0 of `square`: accessor 0: bufferView -1"), "{error}");
}

#[test]
fn vertex_colours_without_a_material_multiply_white() {
    let colours = |change: &dyn Fn(&mut Value)| {
        let scene = square(change).unwrap();
        let paints = Paints::of(&scene, &TextureOptions::default());
        let last = scene.materials.len();
        let mesh = ligne::mesh::Mesh::build(scene.to_painted_soup(&paints));
        let mut seen: Vec<String> = (0..mesh.triangles.len())
            .map(|face| paints.list[mesh.paint(face.into()).index()].colour.hex())
            .collect();
        seen.sort();
        seen.dedup();
        (seen, last)
    };
    let tint = json!({"POSITION": 0, "COLOR_0": 3});
    // Each primitive draws one triangle of the square, because the reader drops one of two coincident
    // triangles.
    let half = |from: usize| json!({"bufferView": 1, "byteOffset": from, "componentType": 5123, "count": 3, "type": "SCALAR"});
    let only = |primitives: Value| {
        let halves = [half(0), half(6)];
        move |file: &mut Value| {
            file["accessors"].as_array_mut().unwrap().extend(halves.clone());
            file["meshes"][0]["primitives"] = primitives.clone();
            file["nodes"] = json!([{"mesh": 0}, {}]);
        }
    };
    let plain = json!({"attributes": {"POSITION": 0}, "indices": 4});
    let tinted = json!({"attributes": tint, "indices": 5});
    let dim = json!({"attributes": tint, "indices": 5, "material": 0});
    let painted = json!({"attributes": {"POSITION": 0}, "indices": 4, "material": 0});
    assert_eq!(colours(&only(json!([tinted]))).0, ["#ff0000"]);
    assert_eq!(colours(&only(json!([plain]))).0, ["#cccccc"]);
    // A primitive without colours and material keeps the default colour, before or after one with colours.
    for primitives in [json!([tinted, plain]), json!([plain, tinted])] {
        assert_eq!(colours(&only(primitives)).0, ["#cccccc", "#ff0000"]);
    }
    let grey = |primitives: Value| {
        let only = only(primitives);
        move |file: &mut Value| {
            file["materials"][0] = json!({"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.5, 0.5, 1.0]}});
            only(file);
        }
    };
    assert_eq!(colours(&grey(json!([dim]))).0, ["#bc0000"]);
    assert_eq!(colours(&grey(json!([tinted, painted]))).0, ["#bcbcbc", "#ff0000"]);
}

/// OBJ prism over a regular polygon. `rims` adds polylines along both rims: their number of steps, and their
/// rotation in steps.
fn prism(sides: usize, rims: Option<(usize, f64)>) -> Scene {
    let mut text = String::from("o prism\n");
    let ring = |text: &mut String, steps: usize, turned: f64, z: f64| {
        for k in 0..steps {
            let angle = (k as f64 + turned) / steps as f64 * std::f64::consts::TAU;
            writeln!(text, "v {:.9} {:.9} {z}", 10.0 * cos(angle), 10.0 * sin(angle)).unwrap();
        }
    };
    ring(&mut text, sides, 0.0, 0.0);
    ring(&mut text, sides, 0.0, 8.0);
    let list = |numbers: &mut dyn Iterator<Item = usize>| {
        numbers.map(|k| k.to_string()).collect::<Vec<_>>().join(" ")
    };
    writeln!(text, "f {}", list(&mut (1..=sides).rev())).unwrap();
    writeln!(text, "f {}", list(&mut (sides + 1..=2 * sides))).unwrap();
    for k in 0..sides {
        let next = (k + 1) % sides;
        writeln!(text, "f {} {} {} {}", k + 1, next + 1, sides + next + 1, sides + k + 1).unwrap();
    }
    if let Some((steps, turned)) = rims {
        let mut first = 2 * sides + 1;
        for z in [0.0, 8.0] {
            ring(&mut text, steps, turned, z);
            writeln!(text, "l {} {first}", list(&mut (first..first + steps))).unwrap();
            first += steps;
        }
    }
    Scene::from_bytes(text.as_bytes(), ModelFormat::Obj).unwrap()
}

fn drawn_paths(scene: &Scene, style: &Style) -> Vec<String> {
    let camera = Camera {
        eye: DVec3::new(24.0, -31.0, 19.0),
        target: DVec3::new(0.0, 0.0, 4.0),
        up: DVec3::Z,
        projection: Projection::Perspective { fov_y_deg: 40.0 },
        width: 600.0,
        height: 600.0,
        near: None,
    };
    let drawing = render(scene, &camera, style).unwrap();
    let svg = drawing.to_svg(&SvgOptions::default());
    let mut paths: Vec<String> =
        svg.lines().filter(|line| line.starts_with("<path")).map(str::to_owned).collect();
    paths.sort();
    paths
}

#[test]
fn edges_also_listed_as_lines_are_drawn_once() {
    let style = Style::default();
    for sides in [4, 12, 16, 24, 48] {
        let plain = drawn_paths(&prism(sides, None), &style);
        let own: &[(usize, f64)] = if sides == 4 {
            &[(4, 0.0)]
        } else {
            &[(1, 0.0), (2, 0.0), (4, 0.0)].map(|(times, turned)| (sides * times, turned))
        };
        let others: &[(usize, f64)] =
            if sides < 12 { &[] } else { &[(64, 0.0), (64, 0.3), (sides, 0.5), (36, 0.25)] };
        for rims in own.iter().chain(others) {
            assert_eq!(drawn_paths(&prism(sides, Some(*rims)), &style), plain, "{sides} {rims:?}");
        }
    }
}

#[test]
fn file_lines_that_match_no_edge_are_drawn() {
    let style = Style::default();
    let wires = |paths: &[String]| paths.iter().filter(|path| path.contains("class=\"wire\"")).count();
    // A circle around a square, one next to the rim, and a line across a face.
    assert!(wires(&drawn_paths(&prism(4, Some((64, 0.0))), &style)) > 0);
    let mut inner = prism(48, Some((48, 0.0)));
    for position in &mut inner.geometries[0].positions[96..] {
        *position *= DVec3::new(0.97, 0.97, 1.0);
    }
    assert!(wires(&drawn_paths(&inner, &style)) > 0);
    let mut across = prism(4, None);
    across.geometries[0].wires.push([4, 6]);
    assert_eq!(wires(&drawn_paths(&across, &style)), 1);
    // If the style draws no creases, the lines of the file are drawn.
    let mut style = Style::default();
    style.lines.kinds = vec![LineKind::Wire];
    assert!(wires(&drawn_paths(&prism(16, Some((64, 0.0))), &style)) > 0);
}
