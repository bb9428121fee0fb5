//! `ligne info --all`: all parts with bounds and coordinate precision, for models of known precision.

#[path = "../../library/support/readers/glb_writer.rs"]
mod glb;

use std::fmt::Write;
use std::fs;

use serde_json::{Value, json};

use self::glb::glb;
use crate::folder::TestFolder;

const BOX_TRIANGLES: [[usize; 3]; 12] = [
    [0, 2, 3],
    [0, 3, 1],
    [4, 5, 7],
    [4, 7, 6],
    [0, 1, 5],
    [0, 5, 4],
    [2, 6, 7],
    [2, 7, 3],
    [0, 4, 6],
    [0, 6, 2],
    [1, 3, 7],
    [1, 7, 5],
];

/// Distance between neighbouring single-precision numbers, relative to the number.
const SINGLE_PRECISION_STEP: f64 = 1.0 / 8_388_608.0;

/// Cosine and sine of 0.3 rad.
const ROTATED_COS_SIN: [f64; 2] = [0.955_336_489_125_606, 0.295_520_206_661_339_6];

const UNROTATED_COS_SIN: [f64; 2] = [1.0, 0.0];

/// Corners of a box of 20 x 12 x 8, turned about z by an angle with this cosine and sine.
fn box_corners([cos, sin]: [f64; 2]) -> [[f64; 3]; 8] {
    std::array::from_fn(|k| {
        let side = |bit: usize, length: f64| if k >> bit & 1 == 1 { length } else { 0.0 };
        let (x, y) = (side(0, 20.0), side(1, 12.0));
        [x * cos - y * sin, x * sin + y * cos, side(2, 8.0)]
    })
}

/// The largest absolute coordinate.
fn max_coordinate(corners: &[[f64; 3]; 8]) -> f64 {
    corners.as_flattened().iter().fold(0.0, |most, x| most.max(x.abs()))
}

/// The box as OBJ text with this number of decimals.
fn box_obj(corners: &[[f64; 3]; 8], decimals: usize) -> String {
    let mut text = "o box\n".to_owned();
    for [x, y, z] in corners {
        let _ = writeln!(text, "v {x:.decimals$} {y:.decimals$} {z:.decimals$}");
    }
    for side in BOX_TRIANGLES {
        let [a, b, c] = side.map(|corner| corner + 1);
        let _ = writeln!(text, "f {a} {b} {c}");
    }
    text
}

/// The box as binary STL.
fn box_stl(corners: &[[f64; 3]; 8]) -> Vec<u8> {
    let mut bytes = vec![0; 80];
    bytes.extend((BOX_TRIANGLES.len() as u32).to_le_bytes());
    for side in BOX_TRIANGLES {
        bytes.extend([0; 12]);
        for x in side.iter().flat_map(|corner| corners[*corner]) {
            bytes.extend((x as f32).to_le_bytes());
        }
        bytes.extend([0; 2]);
    }
    bytes
}

/// A box as GLB, from the bytes of its eight positions, their component type, and their bounds.
/// The node scales the box and moves it along x.
fn box_glb(
    positions: &[u8],
    component: u32,
    [low, high]: [[f64; 3]; 2],
    [scale, shift]: [f64; 2],
) -> Vec<u8> {
    let mut bin = positions.to_vec();
    let indices = bin.len();
    bin.extend(BOX_TRIANGLES.as_flattened().iter().flat_map(|corner| (*corner as u16).to_le_bytes()));
    let stride = positions.len() / 8;
    let is_quantised = component != 5126;
    let extensions: &[&str] = if is_quantised { &["KHR_mesh_quantization"] } else { &[] };
    let document = json!({
        "asset": { "version": "2.0" },
        "extensionsUsed": extensions,
        "extensionsRequired": extensions,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "name": "box", "mesh": 0, "scale": [scale, scale, scale], "translation": [shift, 0, 0] }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
        "buffers": [{ "byteLength": bin.len() }],
        "bufferViews": [
            { "buffer": 0, "byteLength": indices, "byteStride": stride, "target": 34962 },
            { "buffer": 0, "byteOffset": indices, "byteLength": bin.len() - indices, "target": 34963 },
        ],
        "accessors": [
            { "bufferView": 0, "componentType": component, "count": 8, "type": "VEC3", "min": low, "max": high },
            { "bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR" },
        ],
    });
    glb(document.to_string(), &bin)
}

/// Smallest and largest coordinates of the corners.
fn bounds(corners: &[[f64; 3]; 8]) -> [[f64; 3]; 2] {
    let along = |axis: usize| corners.iter().map(move |corner| corner[axis]);
    [0, 1].map(|end| {
        let pick = |axis| match end {
            0 => along(axis).fold(f64::INFINITY, f64::min),
            _ => along(axis).fold(f64::NEG_INFINITY, f64::max),
        };
        [0, 1, 2].map(pick)
    })
}

/// The first part in `ligne info`: its precision in the text of `--all`, and its JSON entry.
fn first_part(folder: &TestFolder, model: &str) -> (String, Value) {
    let plain = folder.ligne(&format!("info {model}")).expect_success().out.clone();
    assert!(!plain.contains("step") && !plain.contains("exact"), "{plain}");
    let text = folder.ligne(&format!("info --all {model}")).expect_success().out.clone();
    let lines: Vec<&str> = text.lines().collect();
    let heading = lines.iter().position(|line| line.trim() == "1 part:").expect("a list of parts");
    let (_, bounds) = lines[heading + 1].split_once(": 12 triangles, ").expect("the bounds of the part");
    let (_, said) =
        bounds.split_once(" to (").and_then(|(_, corner)| corner.split_once("), ")).expect("the precision");
    let json = folder.ligne(&format!("info --json {model}")).expect_success().out.clone();
    let json: Value = serde_json::from_str(&json).expect("JSON");
    (said.to_owned(), json["parts"][0].clone())
}

/// Checks the step of a part, the source of the step, and the reach of rounding in steps.
fn check_precision(part: &Value, step: f64, source: &str, rounding: f64) {
    let is_near = |found: &Value, wanted: f64| {
        found.as_f64().is_some_and(|found| (found - wanted).abs() <= 1e-6 * wanted)
    };
    assert!(is_near(&part["step"], step), "{step} in {part}");
    assert!(is_near(&part["rounding"], rounding * step), "{rounding} steps in {part}");
    assert_eq!(part["step_from"], source);
}

#[test]
fn text_coordinates_have_the_step_of_their_decimals() {
    let folder = TestFolder::new("info-decimals");
    folder.write("box.obj", &box_obj(&box_corners(ROTATED_COS_SIN), 3));
    let (said, part) = first_part(&folder, "box.obj");
    assert_eq!(said, "step 0.001 (decimals of the file), rounding 0.0009");
    check_precision(&part, 1e-3, "decimals", 0.9);
}

#[test]
fn single_precision_has_the_step_of_its_largest_coordinate() {
    let folder = TestFolder::new("info-single");
    let corners = box_corners(ROTATED_COS_SIN);
    fs::write(folder.path("box.stl"), box_stl(&corners)).expect("a model");
    let (said, part) = first_part(&folder, "box.stl");
    assert_eq!(said, "step 2.28e-6 (single precision), rounding 3.99e-6");
    check_precision(&part, SINGLE_PRECISION_STEP * max_coordinate(&corners), "single-precision", 1.75);

    // The node scales the box by 10 and moves it by 5000.
    let positions: Vec<u8> = corners.as_flattened().iter().flat_map(|x| (*x as f32).to_le_bytes()).collect();
    let model = box_glb(&positions, 5126, bounds(&corners), [10.0, 5000.0]);
    fs::write(folder.path("box.glb"), model).expect("a model");
    let (said, part) = first_part(&folder, "box.glb");
    assert!(said.contains("(single precision)"), "{said}");
    let [_, high] = bounds(&corners);
    check_precision(&part, SINGLE_PRECISION_STEP * (5000.0 + 10.0 * high[0]), "single-precision", 1.75);
}

#[test]
fn quantised_coordinates_have_the_step_of_their_integers() {
    let folder = TestFolder::new("info-quantised");
    let corners = box_corners(UNROTATED_COS_SIN).map(|corner| corner.map(|x| 1000.0 * x));
    let mut positions = Vec::new();
    for corner in &corners {
        positions.extend(corner.iter().flat_map(|x| (*x as u16).to_le_bytes()));
        // Byte strides are multiples of four.
        positions.extend([0; 2]);
    }
    let model = box_glb(&positions, 5123, bounds(&corners), [0.001, 0.0]);
    fs::write(folder.path("box.glb"), model).expect("a model");
    let (said, part) = first_part(&folder, "box.glb");
    assert_eq!(said, "step 0.001 (quantisation), rounding 0.0009");
    check_precision(&part, 1e-3, "quantisation", 0.9);
}

#[test]
fn unrounded_coordinates_are_reported_as_exact() {
    let folder = TestFolder::new("info-exact");
    folder.write("whole.obj", &box_obj(&box_corners(UNROTATED_COS_SIN), 0));
    folder.write("double.obj", &box_obj(&box_corners(ROTATED_COS_SIN), 15));
    for model in ["whole.obj", "double.obj"] {
        let (said, part) = first_part(&folder, model);
        assert_eq!(said, "exact coordinates", "{model}");
        assert_eq!((&part["step"], &part["rounding"]), (&json!(0.0), &json!(0.0)), "{model}");
        assert!(part["step_from"].is_null(), "{part}");
    }
}

#[test]
fn info_all_lists_every_part_and_every_degenerate_face() {
    let folder = TestFolder::new("info-all");
    let (mut text, count) = (String::new(), 25);
    for k in 0..count {
        let first = 5 * k + 1;
        let _ = writeln!(text, "o part{k}\nv {k} 0 0\nv {k} 1 0\nv {k} 0 1\nv {k} 0 2\nv {k} 0 3");
        // The second face has no area.
        let _ =
            writeln!(text, "f {first} {} {}\nf {first} {} {}", first + 1, first + 2, first + 2, first + 3);
    }
    folder.write("many.obj", &text);
    let short = folder.ligne("info many.obj").expect_success().out.clone();
    for wanted in ["    and 5 more (--all lists them)\n", "  left out in 5 more parts (--all lists them)\n"] {
        assert!(short.contains(wanted), "{short}");
    }
    assert!(!short.contains("part24"), "{short}");
    let full = folder.ligne("info --all many.obj").expect_success().out.clone();
    assert!(!full.contains(" more "), "{full}");
    for k in 0..count {
        assert!(
            full.contains(&format!(
                "    part{k}: 1 triangle, 0 x 1 x 1 from ({k}, 0, 0) to ({k}, 1, 1), exact coordinates\n"
            )),
            "{full}"
        );
        assert!(
            full.contains(&format!("  left out: 1 face without area in part{k}, at ({k}, 0, 0)\n")),
            "{full}"
        );
    }
    // JSON output is complete with and without `--all`.
    let json =
        |options: &str| folder.ligne(&format!("info many.obj --json {options}")).expect_success().out.clone();
    assert_eq!(json(""), json("--all"));
}

#[test]
fn info_all_lists_part_bounds() {
    let folder = TestFolder::with_cubes("info-all");
    let all = folder.ligne("info cubes.obj --all").expect_success().out.clone();
    assert!(all.contains("knob: 12 triangles, 1 x 1 x 1 from (-0.5, 1.5, -0.5) to (0.5, 2.5, 0.5)"), "{all}");
    assert!(!folder.ligne("info cubes.obj").expect_success().out.contains("1 x 1 x 1"));
    let json: Value =
        serde_json::from_str(&folder.ligne("info cubes.obj --json").expect_success().out).unwrap();
    assert_eq!(json["parts"][1]["bounds"], json!({"min": [-0.5, 1.5, -0.5], "max": [0.5, 2.5, 0.5]}));
}
