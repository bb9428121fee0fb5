use glam::DVec3;

use super::*;

const POSITIONS: &str = "property float x\nproperty float y\nproperty float z\n";
const INDEX_LIST_PROPERTY: &str = "property list uchar int vertex_indices\n";

fn text_ply(elements: &str, rows: &str) -> String {
    format!("ply\nformat ascii 1.0\n{elements}end_header\n{rows}")
}

fn read(bytes: impl AsRef<[u8]>) -> Scene {
    read_bytes(bytes.as_ref(), "stem").unwrap()
}

fn error(bytes: impl AsRef<[u8]>) -> String {
    read_bytes(bytes.as_ref(), "stem").unwrap_err().to_string()
}

#[test]
fn text_ply_with_mixed_properties_is_read() {
    let elements = "comment c\nelement camera 1\nproperty list uchar float view\nelement vertex 4\nproperty uchar red\n\
                    property uchar green\nproperty uchar blue\nproperty double z\nproperty double y\nproperty double x\n\
                    property float nx\nproperty float ny\nproperty float nz\nproperty float u\nproperty float v\n\
                    element face 2\nproperty uchar flag\nproperty list uchar int vertex_index\nproperty float quality\n";
    let rows = "2 1 2\n255 0 0 3 2 1 0 0 1 0.5 0.25\n0 0 0 0 0 1e0 0 0 1 0 0\n0 0 0 0 1 1 0 0 1 0 0\r\n\n0 0 0 1 1 0 0 0 1 0 0\n\
                7 3 0 1 2 0.5\n7 4 0 1 2 3 0.5 extra\n";
    let scene = read(text_ply(elements, rows));
    let geometry = &scene.geometries[0];
    assert_eq!(geometry.positions[0], DVec3::new(1.0, 2.0, 3.0));
    assert_eq!(geometry.triangles.len(), 3);
    assert_eq!(geometry.colours[0], [1.0, 0.0, 0.0, 1.0]);
    assert_eq!((geometry.normals[0], geometry.uvs[0]), ([0.0, 0.0, 1.0], [0.5, 0.25]));
    assert_eq!((&geometry.corner_normals, &geometry.corner_uvs), (&geometry.triangles, &geometry.triangles));
    assert!(!geometry.single_precision && scene.parts[0].name == "stem");
}

/// A triangle and a quad, with extra bytes around, in either byte order.
fn binary_ply(big: bool, wide: bool) -> Vec<u8> {
    let order = if big { "big" } else { "little" };
    let (float, extra) = if wide { ("double", "property uchar extra\n") } else { ("float", "") };
    let mut bytes = format!(
        "ply\nformat binary_{order}_endian 1.0\nelement vertex 4\n{extra}property {float} x\nproperty {float} y\n\
         property {float} z\nelement face 2\n{extra}{INDEX_LIST_PROPERTY}property short quality\nend_header\n"
    )
    .into_bytes();
    let mut put = |little: &[u8]| {
        if big { bytes.extend(little.iter().rev()) } else { bytes.extend(little) }
    };
    for point in [[0.0, 0.0, 0.5], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]] {
        if wide {
            put(&[9]);
        }
        for axis in point {
            if wide { put(&f64::to_le_bytes(axis)) } else { put(&(axis as f32).to_le_bytes()) }
        }
    }
    for face in [&[0, 1, 2][..], &[0, 1, 2, 3]] {
        if wide {
            put(&[9]);
        }
        put(&[face.len() as u8]);
        for index in face {
            put(&i32::to_le_bytes(*index));
        }
        put(&[1, 2]);
    }
    bytes
}

#[test]
fn binary_ply_is_read_in_either_byte_order() {
    for big in [false, true] {
        for wide in [false, true] {
            let scene = read(binary_ply(big, wide));
            let geometry = &scene.geometries[0];
            assert_eq!(geometry.positions[0], DVec3::new(0.0, 0.0, 0.5));
            assert_eq!(geometry.triangles, [[0, 1, 2], [0, 1, 2], [0, 2, 3]], "big {big} wide {wide}");
            assert_eq!(geometry.single_precision, !wide);
        }
    }
}

#[test]
fn truncated_ply_files_are_refused() {
    for bytes in [binary_ply(false, false), binary_ply(true, true)] {
        let header = memchr::memmem::find(&bytes, b"end_header\n").unwrap() + 11;
        for length in header..bytes.len() {
            let error = error(&bytes[..length]);
            assert!(error.contains("cut off") || error.contains("fit"), "{error}");
        }
    }
    let elements = format!("element vertex 3\n{POSITIONS}element face 1\n{INDEX_LIST_PROPERTY}");
    assert!(
        error(text_ply(&elements, "0 0 0\n1 0 0\n0 1\n3 0 1 2\n"))
            .contains("line 12: the line has too few values")
    );
    assert!(error(text_ply(&elements, "0 0 0\n1 0 0\n")).contains("element vertex"));
    assert!(error(text_ply(&elements, "0 0 0\n1 0 0\n0 1 0\n")).contains("element face"));
}

#[test]
fn huge_ply_counts_are_refused_without_allocation() {
    for count in ["99999999999", "18446744073709551615", "4294967295"] {
        for format in ["ascii", "binary_little_endian"] {
            let bytes =
                format!("ply\nformat {format} 1.0\nelement vertex {count}\n{POSITIONS}end_header\n0 0 0\n");
            assert!(error(bytes).contains("do not fit"));
        }
    }
    // Rows without properties take no space, in any number.
    assert!(error(text_ply("element nothing 99999999999\n", "")).contains("nothing to draw"));
    let mut bytes = binary_ply(false, false);
    let header = memchr::memmem::find(&bytes, b"end_header\n").unwrap() + 11;
    bytes[header + 48] = 255;
    assert!(error(&bytes).contains("face 0") || error(&bytes).contains("element face"));
    let long = "element vertex 1\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uint int vertex_indices\n";
    assert!(error(text_ply(long, "0 0 0\n4294967295 1 2 3\n")).contains("line 11: a list of 4294967295"));
}

#[test]
fn out_of_range_ply_indices_are_reported_with_their_place() {
    let elements = format!("element vertex 3\n{POSITIONS}element face 2\n{INDEX_LIST_PROPERTY}");
    for bad in ["3", "-1", "77", "0.5", "1e30"] {
        let error = error(text_ply(&elements, &format!("0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 {bad}\n")));
        assert!(error.contains("line 14: vertex"), "{error}");
    }
    let mut bytes = binary_ply(false, false);
    let header = memchr::memmem::find(&bytes, b"end_header\n").unwrap() + 11;
    bytes[header + 49] = 4;
    assert!(error(&bytes).contains("face 0: vertex 4"), "{}", error(&bytes));
}

#[test]
fn triangle_strips_alternate_winding_and_restart_at_minus_one() {
    let elements =
        format!("element vertex 5\n{POSITIONS}element tristrips 1\nproperty list int int vertex_indices\n");
    let rows = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n8 0 1 2 3 -1 2 3 4\n";
    assert_eq!(read(text_ply(&elements, rows)).geometries[0].triangles, [[0, 1, 2], [2, 1, 3], [2, 3, 4]]);
}

#[test]
fn ply_with_only_points_has_nothing_to_draw() {
    let elements = format!("element vertex 1\n{POSITIONS}");
    assert_eq!(error(text_ply(&elements, "0 0 0\n")), "only points; nothing to draw");
}

#[test]
fn ply_faces_with_non_finite_vertices_are_left_out() {
    let elements = format!("element vertex 4\n{POSITIONS}element face 2\n{INDEX_LIST_PROPERTY}");
    let scene = read(text_ply(&elements, "0 0 0\n1 0 0\n0 1 0\nnan inf 1e200\n3 0 1 2\n3 0 1 3\n"));
    assert_eq!(scene.geometries[0].triangles, [[0, 1, 2]]);
    assert!(scene.geometries[0].positions.iter().all(|p| p.is_finite()));
    assert_eq!(scene.warnings.lines().len(), 1);
}

/// Many triangles in sequence, with other faces where `other` returns one.
fn many_triangles(count: usize, other: impl Fn(usize) -> Option<Vec<i32>>) -> (Vec<u8>, Vec<Vec<i32>>) {
    let head = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex 5\n{POSITIONS}element face {count}\n{INDEX_LIST_PROPERTY}end_header\n"
    );
    let mut bytes = head.into_bytes();
    for point in [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.5, 0.5, 1.0]] {
        bytes.extend(point.into_iter().flat_map(f32::to_le_bytes));
    }
    let faces: Vec<Vec<i32>> = (0..count)
        .map(|k| other(k).unwrap_or_else(|| [0, 1, 2].map(|c| (k as i32 + c) % 5).to_vec()))
        .collect();
    for face in &faces {
        bytes.push(face.len() as u8);
        bytes.extend(face.iter().flat_map(|corner| corner.to_le_bytes()));
    }
    (bytes, faces)
}

#[test]
fn ply_triangles_keep_their_order_around_other_faces() {
    for at in [None, Some(0), Some(12_345), Some(29_999)] {
        let (bytes, faces) = many_triangles(30_000, |k| (at == Some(k)).then(|| vec![0, 1, 2, 3]));
        let triangles = &read(bytes).geometries[0].triangles;
        let before = at.unwrap_or(faces.len());
        let as_read = |face: &Vec<i32>| [0, 1, 2].map(|c| face[c] as u32);
        let expected: Vec<[u32; 3]> = faces[..before].iter().map(as_read).collect();
        assert!(triangles[..before] == expected, "{at:?}");
        let expected: Vec<[u32; 3]> =
            faces.get(before + 1..).unwrap_or_default().iter().map(as_read).collect();
        assert!(triangles.ends_with(&expected) && triangles.len() == faces.len() + usize::from(at.is_some()));
    }
}

#[test]
fn first_ply_triangle_with_a_missing_vertex_is_reported() {
    let (bytes, _) = many_triangles(30_000, |k| (k == 23_456 || k == 29_000).then(|| vec![0, 1, 5]));
    let error = error(bytes);
    assert!(error.contains("vertex 5 does not exist") && error.contains("23456"), "{error}");
}

/// An element: its name, its properties, and rows of numbers.
type ElementTable<'a> = (&'a str, &'a [&'a str], &'a [&'a [f64]]);

/// Encodes a table of elements as text or binary. The first number of a list property is its length.
fn encode_ply(format: &str, elements: &[ElementTable]) -> Vec<u8> {
    let mut head = format!("ply\nformat {format} 1.0\n");
    let mut body = Vec::new();
    for (name, properties, rows) in elements {
        head += &format!("element {name} {}\n", rows.len());
        for property in *properties {
            head += &format!("property {property}\n");
        }
        for row in *rows {
            if format == "ascii" {
                let words: Vec<String> = row.iter().map(f64::to_string).collect();
                body.extend(format!("{}\n", words.join(" ")).into_bytes());
                continue;
            }
            let mut numbers = row.iter().copied();
            let mut put = |kind: &str, value: f64| {
                let little: Vec<u8> = match kind {
                    "uchar" => vec![value as u8],
                    "ushort" => (value as u16).to_le_bytes().to_vec(),
                    "int" => (value as i32).to_le_bytes().to_vec(),
                    _ => (value as f32).to_le_bytes().to_vec(),
                };
                if format.contains("big") { body.extend(little.iter().rev()) } else { body.extend(little) }
            };
            for property in *properties {
                match *property.split(' ').collect::<Vec<_>>() {
                    ["list", length, kind, _] => {
                        let count = numbers.next().unwrap();
                        put(length, count);
                        (0..count as usize).for_each(|_| put(kind, numbers.next().unwrap()));
                    }
                    [kind, _] => put(kind, numbers.next().unwrap()),
                    _ => unreachable!(),
                }
            }
        }
    }
    [head.into_bytes(), b"end_header\n".to_vec(), body].concat()
}

const FORMATS: [&str; 3] = ["ascii", "binary_little_endian", "binary_big_endian"];

const XYZ: &[&str] = &["float x", "float y", "float z"];

const SQUARE: &[&[f64]] = &[&[0.0, 0.0, 0.0], &[1.0, 0.0, 0.0], &[1.0, 1.0, 0.0], &[0.0, 1.0, 0.0]];

#[test]
fn ply_elements_may_come_in_any_order() {
    let vertices = ("vertex", XYZ, SQUARE);
    let faces: (&str, &[&str], &[&[f64]]) =
        ("face", &["list uchar int vertex_indices"], &[&[3.0, 0.0, 1.0, 2.0], &[4.0, 0.0, 1.0, 2.0, 3.0]]);
    let strips: (&str, &[&str], &[&[f64]]) =
        ("tristrips", &["list int int vertex_indices"], &[&[3.0, 1.0, 2.0, 3.0]]);
    let edges: (&str, &[&str], &[&[f64]]) = ("edge", &["int vertex1", "int vertex2"], &[&[1.0, 3.0]]);
    let other: (&str, &[&str], &[&[f64]]) =
        ("camera", &["float view", "list uchar float more"], &[&[0.5, 2.0, 1.0, 2.0], &[0.5, 0.0]]);
    for format in FORMATS {
        let usual = read(encode_ply(format, &[vertices, other, faces, strips, edges]));
        let usual = &usual.geometries[0];
        assert_eq!((usual.triangles.len(), usual.wires.as_slice()), (4, &[[1, 3]][..]));
        for order in [[faces, strips, other, edges, vertices], [other, faces, strips, vertices, edges]] {
            let scene = read(encode_ply(format, &order));
            let geometry = &scene.geometries[0];
            assert_eq!(geometry.positions, usual.positions, "{format}");
            assert_eq!((&geometry.triangles, &geometry.wires), (&usual.triangles, &usual.wires), "{format}");
        }
        let lost = encode_ply(format, &[other, faces]);
        assert!(error(&lost).contains("element face: the file has no vertices"), "{}", error(&lost));
        let bad: ElementTable = ("face", &["list uchar int vertex_indices"], &[&[3.0, 0.0, 1.0, 4.0]]);
        let text = error(encode_ply(format, &[bad, vertices]));
        assert!(text.contains("vertex 4 does not exist"), "{text}");
        assert!(text.contains(if format == "ascii" { "line 10" } else { "face 0" }), "{text}");
        let whole = encode_ply(format, &[faces, vertices]);
        assert!(read_bytes(&whole[..whole.len() - 4], "").is_err());
    }
}

#[test]
fn ply_face_colours_become_materials() {
    let red_and_blue: &[&[f64]] =
        &[&[4.0, 0.0, 1.0, 2.0, 3.0, 255.0, 0.0, 0.0, 255.0], &[3.0, 0.0, 1.0, 2.0, 0.0, 0.0, 255.0, 255.0]];
    let shares: Vec<Vec<f64>> = red_and_blue
        .iter()
        .map(|row| {
            let colour = row.len() - 4;
            row.iter().enumerate().map(|(k, v)| if k < colour { *v } else { v / 255.0 }).collect()
        })
        .collect();
    let shares: Vec<&[f64]> = shares.iter().map(Vec::as_slice).collect();
    let list = "list uchar int vertex_indices";
    let tables: [(&[&str], &[&[f64]]); 3] = [
        (&[list, "uchar red", "uchar green", "uchar blue", "uchar alpha"], red_and_blue),
        (&[list, "uchar r", "uchar g", "uchar b", "uchar a"], red_and_blue),
        (
            &[list, "float diffuse_red", "float diffuse_green", "float diffuse_blue", "float diffuse_alpha"],
            &shares,
        ),
    ];
    for format in FORMATS {
        for (properties, rows) in tables {
            let scene = read(encode_ply(format, &[("face", properties, rows), ("vertex", XYZ, SQUARE)]));
            let names: Vec<_> = scene.materials.iter().map(|own| own.name.as_str()).collect();
            assert_eq!(names, ["#0000ff", "#ff0000"], "{format} {properties:?}");
            assert_eq!(scene.geometries[0].triangle_material, [1, 1, 0], "{format}");
            assert!(scene.warnings.is_empty());
        }
    }
    // Vertex colours have precedence over face colours, unless all of them are white.
    let coloured = ["float x", "float y", "float z", "uchar red", "uchar green", "uchar blue"];
    for (green, materials) in [(0.0, 0), (255.0, 2)] {
        let vertices: Vec<Vec<f64>> =
            SQUARE.iter().map(|p| [p, &[255.0, green, 255.0][..]].concat()).collect();
        let vertices: Vec<&[f64]> = vertices.iter().map(Vec::as_slice).collect();
        let scene = read(encode_ply(
            "ascii",
            &[("vertex", &coloured, &vertices), ("face", tables[0].0, red_and_blue)],
        ));
        assert_eq!(
            (scene.materials.len(), scene.warnings.lines().len()),
            (materials, usize::from(materials == 0))
        );
        assert_eq!(scene.geometries[0].colours.is_empty(), materials > 0);
    }
}

#[test]
fn ply_edges_become_wires() {
    for names in [["vertex1", "vertex2"], ["v1", "v2"], ["v0", "v1"]] {
        for format in FORMATS {
            let ends = names.map(|name| format!("ushort {name}"));
            let properties = [ends[0].as_str(), ends[1].as_str(), "uchar red", "uchar green", "uchar blue"];
            let rows: &[&[f64]] = &[&[0.0, 1.0, 255.0, 0.0, 0.0], &[2.0, 3.0, 0.0, 0.0, 255.0]];
            let scene = read(encode_ply(format, &[("vertex", XYZ, SQUARE), ("edge", &properties, rows)]));
            assert_eq!(scene.geometries[0].wires, [[0, 1], [2, 3]], "{format} {names:?}");
            assert!(scene.warnings.lines()[0].contains("colours of edges"));
        }
    }
    let ends: &[&str] = &["int vertex1", "int vertex2"];
    let text = error(encode_ply("ascii", &[("vertex", XYZ, SQUARE), ("edge", ends, &[&[0.0, 4.0]])]));
    assert!(text.contains("line 15: vertex 4 does not exist"), "{text}");
    let text =
        error(encode_ply("binary_big_endian", &[("edge", ends, &[&[-1.0, 0.0]]), ("vertex", XYZ, SQUARE)]));
    assert!(text.contains("edge 0: vertex -1 does not exist"), "{text}");
    let text = error(encode_ply(
        "ascii",
        &[("vertex", XYZ, SQUARE), ("edge", &["int from", "int to"], &[&[0.0, 1.0]])],
    ));
    assert!(text.contains("edges without vertex1 and vertex2 left out; nothing to draw"), "{text}");
    let lost: &[&[f64]] = &[&[f64::NAN, 0.0, 0.0], &[1.0, 0.0, 0.0], &[0.0, 1.0, 0.0]];
    let scene =
        read(encode_ply("ascii", &[("vertex", XYZ, lost), ("edge", ends, &[&[0.0, 1.0], &[1.0, 2.0]])]));
    assert_eq!((scene.geometries[0].wires.as_slice(), scene.warnings.lines().len()), (&[[1, 2]][..], 1));
}
