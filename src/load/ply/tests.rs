use glam::DVec3;

use super::*;

const POSITIONS: &str = "property float x\nproperty float y\nproperty float z\n";
const LIST: &str = "property list uchar int vertex_indices\n";

fn text(elements: &str, rows: &str) -> String {
    format!("ply\nformat ascii 1.0\n{elements}end_header\n{rows}")
}

fn read(bytes: impl AsRef<[u8]>) -> Scene {
    read_bytes(bytes.as_ref(), "stem").unwrap()
}

fn error(bytes: impl AsRef<[u8]>) -> String {
    read_bytes(bytes.as_ref(), "stem").unwrap_err().to_string()
}

#[test]
fn text_with_all_sorts_of_properties() {
    let elements = "comment c\nelement camera 1\nproperty list uchar float view\nelement vertex 4\nproperty uchar red\n\
                    property uchar green\nproperty uchar blue\nproperty double z\nproperty double y\nproperty double x\n\
                    property float nx\nproperty float ny\nproperty float nz\nproperty float u\nproperty float v\n\
                    element face 2\nproperty uchar flag\nproperty list uchar int vertex_index\nproperty float quality\n";
    let rows = "2 1 2\n255 0 0 3 2 1 0 0 1 0.5 0.25\n0 0 0 0 0 1e0 0 0 1 0 0\n0 0 0 0 1 1 0 0 1 0 0\r\n\n0 0 0 1 1 0 0 0 1 0 0\n\
                7 3 0 1 2 0.5\n7 4 0 1 2 3 0.5 extra\n";
    let scene = read(text(elements, rows));
    let geometry = &scene.geometries[0];
    assert_eq!(geometry.positions[0], DVec3::new(1.0, 2.0, 3.0));
    assert_eq!(geometry.triangles.len(), 3);
    assert_eq!(geometry.colours[0], [1.0, 0.0, 0.0, 1.0]);
    assert_eq!((geometry.normals[0], geometry.uvs[0]), ([0.0, 0.0, 1.0], [0.5, 0.25]));
    assert_eq!((&geometry.corner_normals, &geometry.corner_uvs), (&geometry.triangles, &geometry.triangles));
    assert!(!geometry.single_precision && scene.parts[0].name == "stem");
}

/// A triangle and a quad, with extra bytes around, in either order of bytes.
fn binary(big: bool, wide: bool) -> Vec<u8> {
    let order = if big { "big" } else { "little" };
    let (float, extra) = if wide { ("double", "property uchar extra\n") } else { ("float", "") };
    let mut bytes = format!(
        "ply\nformat binary_{order}_endian 1.0\nelement vertex 4\n{extra}property {float} x\nproperty {float} y\n\
         property {float} z\nelement face 2\n{extra}{LIST}property short quality\nend_header\n"
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
fn binary_of_either_order() {
    for big in [false, true] {
        for wide in [false, true] {
            let scene = read(binary(big, wide));
            let geometry = &scene.geometries[0];
            assert_eq!(geometry.positions[0], DVec3::new(0.0, 0.0, 0.5));
            assert_eq!(geometry.triangles, [[0, 1, 2], [0, 1, 2], [0, 2, 3]], "big {big} wide {wide}");
            assert_eq!(geometry.single_precision, !wide);
        }
    }
}

#[test]
fn short_files_are_refused() {
    for bytes in [binary(false, false), binary(true, true)] {
        let header = memchr::memmem::find(&bytes, b"end_header\n").unwrap() + 11;
        for length in header..bytes.len() {
            let error = error(&bytes[..length]);
            assert!(error.contains("cut off") || error.contains("fit"), "{error}");
        }
    }
    let elements = format!("element vertex 3\n{POSITIONS}element face 1\n{LIST}");
    assert!(
        error(text(&elements, "0 0 0\n1 0 0\n0 1\n3 0 1 2\n"))
            .contains("line 12: the line has too few values")
    );
    assert!(error(text(&elements, "0 0 0\n1 0 0\n")).contains("element vertex"));
    assert!(error(text(&elements, "0 0 0\n1 0 0\n0 1 0\n")).contains("element face"));
}

#[test]
fn huge_counts_ask_for_no_memory() {
    for count in ["99999999999", "18446744073709551615", "4294967295"] {
        for format in ["ascii", "binary_little_endian"] {
            let bytes =
                format!("ply\nformat {format} 1.0\nelement vertex {count}\n{POSITIONS}end_header\n0 0 0\n");
            assert!(error(bytes).contains("do not fit"));
        }
    }
    // Rows without properties cost nothing, however many there are.
    assert!(error(text("element nothing 99999999999\n", "")).contains("nothing to draw"));
    let mut bytes = binary(false, false);
    let header = memchr::memmem::find(&bytes, b"end_header\n").unwrap() + 11;
    bytes[header + 48] = 255;
    assert!(error(&bytes).contains("face 0") || error(&bytes).contains("element face"));
    let long = "element vertex 1\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uint int vertex_indices\n";
    assert!(error(text(long, "0 0 0\n4294967295 1 2 3\n")).contains("line 11: a list of 4294967295"));
}

#[test]
fn indices_that_point_nowhere_are_named() {
    let elements = format!("element vertex 3\n{POSITIONS}element face 2\n{LIST}");
    for bad in ["3", "-1", "77", "0.5", "1e30"] {
        let error = error(text(&elements, &format!("0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 {bad}\n")));
        assert!(error.contains("line 14: vertex"), "{error}");
    }
    let mut bytes = binary(false, false);
    let header = memchr::memmem::find(&bytes, b"end_header\n").unwrap() + 11;
    bytes[header + 49] = 4;
    assert!(error(&bytes).contains("face 0: vertex 4"), "{}", error(&bytes));
}

#[test]
fn strips_alternate_and_restart() {
    let elements =
        format!("element vertex 5\n{POSITIONS}element tristrips 1\nproperty list int int vertex_indices\n");
    let rows = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n8 0 1 2 3 -1 2 3 4\n";
    assert_eq!(read(text(&elements, rows)).geometries[0].triangles, [[0, 1, 2], [2, 1, 3], [2, 3, 4]]);
}

#[test]
fn points_only_are_nothing_to_draw() {
    let elements = format!("element vertex 1\n{POSITIONS}");
    assert_eq!(error(text(&elements, "0 0 0\n")), "only points; nothing to draw");
}

#[test]
fn what_is_no_number_is_left_out() {
    let elements = format!("element vertex 4\n{POSITIONS}element face 2\n{LIST}");
    let scene = read(text(&elements, "0 0 0\n1 0 0\n0 1 0\nnan inf 1e200\n3 0 1 2\n3 0 1 3\n"));
    assert_eq!(scene.geometries[0].triangles, [[0, 1, 2]]);
    assert!(scene.geometries[0].positions.iter().all(|p| p.is_finite()));
    assert_eq!(scene.warnings.lines().len(), 1);
}

/// Many triangles, one after the other, and other faces where `other` has them.
fn many(count: usize, other: impl Fn(usize) -> Option<Vec<i32>>) -> (Vec<u8>, Vec<Vec<i32>>) {
    let head = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex 5\n{POSITIONS}element face {count}\n{LIST}end_header\n"
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
fn triangles_come_in_order_before_and_after_other_faces() {
    for at in [None, Some(0), Some(12_345), Some(29_999)] {
        let (bytes, faces) = many(30_000, |k| (at == Some(k)).then(|| vec![0, 1, 2, 3]));
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
fn the_first_triangle_of_many_that_points_nowhere_is_named() {
    let (bytes, _) = many(30_000, |k| (k == 23_456 || k == 29_000).then(|| vec![0, 1, 5]));
    let error = error(bytes);
    assert!(error.contains("vertex 5 does not exist") && error.contains("23456"), "{error}");
}
