use glam::DVec3;

use super::*;
use crate::colour::srgb::Colour;

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

fn try_read(text: impl AsRef<[u8]>) -> Result<Scene, Error> {
    read_bytes(text.as_ref(), "stem", |_| None)
}

fn read(text: impl AsRef<[u8]>) -> Scene {
    try_read(text).unwrap()
}

fn error(text: impl AsRef<[u8]>) -> String {
    try_read(text).unwrap_err().to_string()
}

#[test]
fn obj_faces_become_triangles_and_lines_become_wires() {
    let scene = read("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf 1 2 3\nl 1 3 2\np 1\n");
    let geometry = &scene.geometries[0];
    assert_eq!(geometry.triangles, [[0, 1, 2], [0, 2, 3], [0, 1, 2]]);
    assert_eq!(geometry.wires, [[0, 2], [2, 1]]);
    assert_eq!((scene.parts[0].name.as_str(), scene.format), ("stem", "OBJ"));
    assert_eq!(scene.warnings.lines(), ["1 points left out"]);
}

#[test]
fn obj_lines_may_end_and_continue_in_any_style() {
    let text =
        "\u{feff}# c\r\nv\t0 0\\\r\n 0\r\n  v 1 0 0 # c\r\nv 0 1 0\rf 1 2 \\\n3# c\n\nf -3 -2 -1 \r\nf 1 2 3";
    assert_eq!(read(text).geometries[0].triangles, [[0, 1, 2]; 3]);
}

#[test]
fn obj_corners_have_texture_coordinates_and_normals() {
    let text = format!(
        "{TRIANGLE}vt 0.5\nvt 1 0 0\nvn 0 0 1\nf 1 2 3\nf 1/1 2/2 3/-1\nf 1//1 2//-1 3//1\nf 1/1/1 2/2/1 3//9\nf 1 2 3\n"
    );
    let scene = read(text);
    let geometry = &scene.geometries[0];
    let none = u32::MAX;
    assert_eq!(geometry.uvs, [[0.5, 0.0], [1.0, 0.0]]);
    assert_eq!(geometry.corner_uvs, [[none; 3], [0, 1, 1], [none; 3], [0, 1, none], [none; 3]]);
    assert_eq!(geometry.corner_normals, [[none; 3], [none; 3], [0; 3], [0, 0, none], [none; 3]]);
}

#[test]
fn obj_vertices_may_have_weights_or_colours() {
    let scene = read("v 0 0 0 1.0\nv 1 0 0 1 0 0.5\nv 0 1 0\nf 1 2 3\n");
    let colours = &scene.geometries[0].colours;
    assert_eq!((colours[0], colours[2]), ([1.0; 4], [1.0; 4]));
    assert!((colours[1][2] - 0.214).abs() < 1e-3);
}

#[test]
fn obj_objects_are_parts_and_groups_inside_them_are_not() {
    let scene =
        read(format!("{TRIANGLE}f 1 2 3\no a b\ng x\nf 1 2 3\ng y\nf 1 2 3\no\nv 5 5 5\nf 2 3 4\no empty\n"));
    let names: Vec<_> = scene.parts.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["stem", "a b", "part 3"]);
    assert_eq!(scene.geometries[1].triangles.len(), 2);
    let last = &scene.geometries[2];
    assert_eq!(
        (&last.positions[..], &last.triangles[..]),
        (&[DVec3::X, DVec3::Y, DVec3::splat(5.0)][..], &[[0, 1, 2]][..])
    );
}

#[test]
fn obj_groups_are_parts_and_may_be_continued() {
    let scene = read(format!("g one\n{TRIANGLE}f 1 2 3\ng two\nf 3 2 1\ng one\nf 2 3 1\nl 1 2\n"));
    let names: Vec<_> = scene.parts.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["one", "two"]);
    assert_eq!(scene.geometries[0].triangles, [[0, 1, 2], [1, 2, 0]]);
    assert_eq!(scene.geometries[0].wires, [[0, 1]]);
}

#[test]
fn obj_parts_keep_only_the_vertices_and_normals_they_use() {
    let text = format!("{TRIANGLE}v 9 9 9\nvn 0 0 1\nvn 0 1 0\no a\nf 1//2 2//2 3//7\no b\nf 4 2 3\n");
    let scene = read(text);
    let [a, b] = &scene.geometries[..] else { panic!("two") };
    assert_eq!((&a.normals[..], &a.corner_normals[..]), (&[[0.0, 1.0, 0.0]][..], &[[0, 0, u32::MAX]][..]));
    assert_eq!(b.positions, [DVec3::X, DVec3::Y, DVec3::splat(9.0)]);
    assert_eq!(b.triangles, [[2, 0, 1]]);
    assert!(b.normals.is_empty() && b.corner_normals.is_empty());
}

#[test]
fn obj_materials_are_assigned_per_triangle() {
    let text = format!(
        "mtllib my lib.mtl\n{TRIANGLE}f 1 2 3\nusemtl red\nf 1 2 3\nusemtl\nf 1 2 3\nusemtl red\nf 1 2 3\n"
    );
    let mut asked = Vec::new();
    let scene = read_bytes(text.as_bytes(), "stem", |name| {
        asked.push(name.to_owned());
        Some(b"newmtl unused\nnewmtl red\nKd 1 0 0\n".to_vec())
    })
    .unwrap();
    assert_eq!(asked, ["my lib.mtl"]);
    let names: Vec<_> = scene.materials.iter().map(|m| m.name.as_str()).collect();
    assert_eq!(names, ["red", "", ""]);
    assert_eq!(scene.materials[0].colour, Colour::rgb(255, 0, 0));
    assert_eq!(scene.geometries[0].triangle_material, [2, 0, 1, 0]);
    assert!(scene.warnings.is_empty());
}

#[test]
fn a_single_obj_material_is_stored_once_per_geometry() {
    let scene = read(format!("{TRIANGLE}usemtl m\nf 1 2 3\nf 1 2 3\n"));
    assert_eq!((scene.geometries[0].material, scene.geometries[0].triangle_material.len()), (Some(0), 0));
    assert_eq!(scene.warnings.lines(), ["1 materials that no library defines"]);
}

#[test]
fn missing_and_outside_material_libraries_give_warnings() {
    let scene = read(format!(
        "mtllib none.mtl\nmtllib ../out.mtl\nmtllib a.mtl b.mtl\n{TRIANGLE}usemtl m\nf 1 2 3\n"
    ));
    let lines = scene.warnings.lines().join("; ");
    for wanted in ["none.mtl is missing", "../out.mtl is outside", "a.mtl is missing", "b.mtl is missing"] {
        assert!(lines.contains(wanted), "{lines}");
    }
    assert_eq!(scene.materials[0].name, "m");
}

#[test]
fn obj_faces_may_precede_their_vertices() {
    let scene = read(format!("f 1 2 3 4\n{TRIANGLE}v 1 1 0\nf -4 -3 -2\nf 1 2 4\n"));
    assert_eq!(scene.geometries[0].triangles[2..], [[0, 1, 2], [0, 1, 3]]);
    assert!(
        error(format!("f 1 2 3\n{TRIANGLE}f 1 2 4\n"))
            .contains("line 5: vertex 4 does not exist; the file has 3")
    );
}

#[test]
fn invalid_obj_indices_are_errors_with_a_line() {
    for (index, place) in
        [("0", "line 4"), ("9", "line 4"), ("-4", "line 4"), ("99999999999999999999", "line 4")]
    {
        let error = error(format!("{TRIANGLE}f 1 2 {index}\n"));
        assert!(error.starts_with(place) && error.contains("does not exist"), "{error}");
    }
    for word in ["x", "1x", "1.5", "1/2/3/4", "/1"] {
        let error = error(format!("{TRIANGLE}f 1 2 {word}\n"));
        assert!(error.contains("line 4") && error.contains("not the index"), "{error}");
    }
}

#[test]
fn obj_numbers_with_units_or_decimal_commas_are_read() {
    for (written, wanted) in [
        ("3cm", 3.0),
        ("1.5f", 1.5),
        ("1,5", 1.5),
        ("-0,25e1", -2.5),
        ("4,", 4.0),
        ("0.5,", 0.5),
        (",5", 0.5),
    ] {
        let scene = read(format!("{TRIANGLE}v 7 {written} 9\nf 1 2 3\nf 1 2 4\n"));
        let geometry = &scene.geometries[0];
        assert_eq!(
            (geometry.positions[3], geometry.triangles.len()),
            (DVec3::new(7.0, wanted, 9.0), 2),
            "{written}"
        );
        let told = format!("line 4: `{written}` is not a number and is read as {wanted}");
        assert_eq!(scene.warnings.lines(), [told]);
    }
}

#[test]
fn elements_with_unreadable_obj_coordinates_are_left_out() {
    for written in
        ["?", "[0]", "abc", "--1", "+e2", "1.5.2", "-2e", "1d3", "0x10", "1,2,3", "1,234.5", "1.234,5", "\\x"]
    {
        for text in [
            format!("{TRIANGLE}v 7 {written} 9\nf 1 2 3\nf 1 2 4\nf 1 2 3 4\nl 1 2 4\np 4\n"),
            // Vertices after the faces.
            format!("f 1 2 3\nf 1 2 4\nf 1 2 3 4\nl 1 2 4\np 4\n{TRIANGLE}v 7 {written} 9\n"),
        ] {
            let scene = read(&text);
            let geometry = &scene.geometries[0];
            assert_eq!((&geometry.triangles[..], &geometry.wires[..]), (&[[0, 1, 2]][..], &[[0, 1]][..]));
            assert_eq!(geometry.positions, [DVec3::ZERO, DVec3::X, DVec3::Y], "{written}");
            let line = text.lines().position(|line| line.starts_with("v 7")).unwrap() + 1;
            let told = format!(
                "line {line}: `{}` is not a number; 2 faces and 1 line left out, with such a corner",
                written.escape_debug()
            );
            assert_eq!(scene.warnings.lines(), ["1 points left out".to_owned(), told]);
        }
    }
}

#[test]
fn unreadable_obj_vertices_are_counted_once_each() {
    let scene = read(format!("{TRIANGLE}v ? ? ?\nv\nv 0 nan 1\nv 1 2\nf 1 2 3\n"));
    let told = "line 4: `?` is not a number; 3 more like it; no face or line has such a corner";
    assert_eq!(scene.warnings.lines(), [told]);
    assert_eq!(scene.unused_vertices, 4);
    let brackets = "v [0] [0] [0]\nv [1] [0] [0]\nv [0] [1] [0]\nf 1 2 3\n";
    let told =
        "line 1: `[0]` is not a number; 2 more like it; 1 face left out, with such a corner; nothing to draw";
    assert_eq!(error(brackets), told);
}

#[test]
fn obj_vertices_without_z_lie_at_z_0() {
    for text in ["v 0 0\nv 1 0 # 5\nv 0 1\nf 1 2 3\n", "f 1 2 3\nv 0 0\nv 1 0\nv 0 1"] {
        let scene = read(text);
        assert_eq!(scene.geometries[0].positions, [DVec3::ZERO, DVec3::X, DVec3::Y]);
        assert_eq!(scene.warnings.lines(), ["no vertex has a z coordinate; all are drawn at z = 0"]);
    }
    // If only some vertices lack z, it was lost.
    let scene = read(format!("{TRIANGLE}v 1 1\nf 1 2 3\nf 2 3 4\n"));
    assert_eq!(scene.geometries[0].triangles, [[0, 1, 2]]);
    let told = "line 4: a coordinate is missing; 1 face left out, with such a corner";
    assert_eq!(scene.warnings.lines(), [told]);
}

#[test]
fn malformed_obj_attributes_do_not_refuse_the_file() {
    let text =
        "v 0 0 0 1 0.5x 0\nv 1 0 0 made by hand\nv 0 1 0\nvt 1,5 x\nvt\nvn 0 o 1\nf 1/1/1 2/2/1 3/1/1\n";
    let scene = read(text);
    let geometry = &scene.geometries[0];
    assert_eq!((&geometry.uvs[..], geometry.normals[0]), (&[[1.5, 0.0], [0.0, 0.0]][..], [0.0, 0.0, 1.0]));
    assert_eq!(geometry.colours[1..], [[1.0; 4]; 2]);
    assert_eq!(scene.warnings.lines(), ["line 1: `0.5x` is not a number and is read as 0.5; 5 more like it"]);
}

#[test]
fn obj_nan_and_infinity_spellings_are_not_numbers() {
    for word in ["1.#QNAN", "-1.#IND", "1.#INF00", "-nan(ind)", "nan"] {
        let scene = read(format!("{TRIANGLE}v 7 {word} 9\nf 1 2 3\nf 1 2 4\n"));
        assert_eq!(scene.geometries[0].triangles, [[0, 1, 2]], "{word}");
    }
    assert!(read(format!("v 0 0 1.#c\n{TRIANGLE}f 2 3 4\n")).warnings.is_empty());
}

#[test]
fn obj_text_may_be_utf16() {
    let text = format!("\u{feff}o é\r\n{TRIANGLE}f 1 2 3\r\n");
    let units = || text.encode_utf16();
    let (little, big) = (units().flat_map(u16::to_le_bytes), units().flat_map(u16::to_be_bytes));
    for bytes in [little.collect::<Vec<_>>(), big.collect()] {
        let scene = read(&bytes);
        assert_eq!((scene.parts[0].name.as_str(), scene.triangle_count()), ("é", 1));
        assert!(scene.warnings.is_empty());
        for length in 0..bytes.len() {
            _ = try_read(&bytes[..length]);
        }
    }
}

#[test]
fn obj_elements_with_non_finite_vertices_are_left_out() {
    let scene = read(
        "v nan 0 0\nv 1 inf 0\nv 0 1e400 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 4 5 6\nf 4 5 6 1\nl 1 4\n",
    );
    let geometry = &scene.geometries[0];
    assert_eq!((geometry.positions.len(), &geometry.triangles[..]), (3, &[[0, 1, 2]][..]));
    let told = "line 1: a coordinate is not a number, or too large; 2 more like it; 2 faces and 1 line left out, with such a \
                corner";
    assert_eq!(scene.warnings.lines(), [told]);
    assert!(error("v 1e400 0 0\nv 1 1e39 0\nv 0 1 0\nf 1 2 3\n").contains("nothing to draw"));
}

#[test]
fn obj_files_with_nothing_to_draw_are_refused() {
    for text in ["# c\n", TRIANGLE, &format!("{TRIANGLE}f 1\n"), "garbage\n", "p 1\n", "\0\0\0"] {
        assert!(error(text).contains("nothing to draw"), "{}", error(text));
    }
}

#[test]
fn obj_names_may_be_latin1() {
    assert_eq!(read([b"o caf\xe9\n", TRIANGLE.as_bytes(), b"f 1 2 3"].concat()).parts[0].name, "café");
}

#[test]
fn obj_free_forms_and_unknown_statements_are_ignored() {
    let scene = read(format!("{TRIANGLE}vp 0.5\ncurv2 ignored \\\nf 9 9 9\ns off\n\u{1}\u{2}\nf 1 2 3\n"));
    assert_eq!(scene.warnings.lines(), ["1 lines left out that are not OBJ statements"]);
}

#[test]
fn huge_obj_polygons_are_triangulated_quickly() {
    let face = "1 2 3 ".repeat(20_000);
    let scene = read(format!("{TRIANGLE}f {face}\n"));
    assert_eq!(scene.geometries[0].triangles.len(), 59_998);
    let scene = read(format!("{TRIANGLE}v 0.1 0.2 0\nf {face} 4\n"));
    assert_eq!(scene.warnings.lines(), ["1 concave polygons with too many corners, triangulated roughly"]);
}
