//! Degenerate geometry: dropped faces, lines and vertices do not affect framing.
//! Empty drawings report the reason, and textures are found by file name.

use serde_json::Value;

use crate::folder::{CUBES, TestFolder};

/// Far from the cubes: a face with collinear vertices, one with a repeated vertex, and a line without length.
const DISTANT_DEGENERATE_OBJ: &str =
    "v 5000 10 3\nv 5001 11 4\nv 5002 12 5\nf 17 18 19\nf 17 17 18\nl 19 19\n";

/// An SVG drawing without its title.
fn without_title(svg: &str) -> String {
    svg.lines().filter(|line| !line.starts_with("<title>")).collect::<Vec<_>>().join("\n")
}

#[test]
fn degenerate_faces_do_not_affect_framing() {
    let folder = TestFolder::with_cubes("left-out");
    folder.write("far.obj", &format!("{CUBES}{DISTANT_DEGENERATE_OBJ}"));
    for options in [
        "",
        "--view front",
        "--style technical --view top",
        "--style toon",
        "--style engraving --azimuth 200",
        "--section z --view front",
        "--explode y",
    ] {
        folder.ligne(&format!("draw cubes.obj a.svg {options}")).expect_success();
        let run = folder.ligne(&format!("draw far.obj b.svg {options}"));
        // The section removes the side with the degenerate faces, so no warning is expected.
        let is_told = run.expect_success().err.contains("without area");
        assert_eq!(is_told, !options.starts_with("--section"), "{run:?}");
        assert_eq!(without_title(&folder.text("a.svg")), without_title(&folder.text("b.svg")), "{options}");
    }
    let film = |model: &str| {
        folder.ligne(&format!("animate {model} {model}-%d.svg --turntable 3 --size 200")).expect_success();
        (0..3).map(|k| without_title(&folder.text(&format!("{model}-{k}.svg")))).collect::<Vec<_>>()
    };
    assert_eq!(film("cubes.obj"), film("far.obj"));
    // A sheet shows the name of its model, so both models are called `m.obj`.
    let page = "[page]\nkind = \"sheet\"\nsize = \"A4\"\nmodel = { file = \"m.obj\", up = \"z\" }\n\
                views = [\"front\", \"top\", \"left\"]\nparts_list = true\n";
    let sheet = |name: &str, model: &str| {
        folder.write(&format!("{name}/m.obj"), model);
        folder.write(&format!("{name}/m.toml"), page);
        folder.ligne(&format!("page {name}/m.toml {name}.svg")).expect_success();
        folder.text(&format!("{name}.svg"))
    };
    assert_eq!(sheet("cubes", CUBES), sheet("far", &format!("{CUBES}{DISTANT_DEGENERATE_OBJ}")));
}

#[test]
fn info_reports_degenerate_faces_and_their_position() {
    let folder = TestFolder::with_cubes("left-out-info");
    folder.write("far.obj", &format!("{CUBES}{DISTANT_DEGENERATE_OBJ}v 1 2 3\n"));
    let text = folder.ligne("info far.obj").expect_success().out.clone();
    for wanted in [
        "24 triangles, 16 vertices\n  2 x 3.5 x 2, from (-1, -1, -1) to (1, 2.5, 1)\n",
        "  1 vertex that no face or line uses\n",
        "  left out: 2 faces without area and 1 line without length in knob, the first at (5000, 10, 3)\n",
        "    knob: 12 triangles\n",
    ] {
        assert!(text.contains(wanted), "{text}");
    }
    let json: Value =
        serde_json::from_str(&folder.ligne("info far.obj --json").expect_success().out).expect("JSON");
    let left_out =
        serde_json::json!([{ "part": "knob", "faces": 2, "lines": 1, "first_at": [5000.0, 10.0, 3.0] }]);
    assert_eq!((&json["left_out"], &json["unused_vertices"]), (&left_out, &Value::from(1)));
    assert_eq!(json["bounds"]["max"], serde_json::json!([1.0, 2.5, 1.0]));
}

#[test]
fn faces_with_unreadable_vertices_are_dropped_with_a_warning() {
    let folder = TestFolder::with_cubes("no-place");
    folder.write("one.obj", &CUBES.replacen("v -1 1 -1\n", "v -1 1 ?\n", 1));
    let run = folder.ligne("draw one.obj one.svg");
    let told = "line 5: `?` is not a number; 3 faces left out, with such a corner";
    assert!(run.expect_success().err.contains(told), "{run:?}");
    let svg = folder.text("one.svg");
    folder.ligne("draw cubes.obj all.svg").expect_success();
    assert!(svg.contains("<path") && svg != folder.text("all.svg"));
    folder.write("none.obj", "v [0] [0] [0]\nv [1] [0] [0]\nv [0] [1] [0]\nf 1 2 3\n");
    let run = folder.ligne("draw none.obj none.svg");
    run.expect_refusal(
        "line 1: `[0]` is not a number; 2 more like it; 1 face left out, with such a corner; nothing to draw",
    );
    assert!(!folder.names().contains(&"none.svg".to_owned()));
}

#[test]
fn empty_drawings_report_the_reason() {
    let folder = TestFolder::with_cubes("empty");
    folder.write("needle.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    folder.write(
        "two.obj",
        &format!("o needle\nv 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n{}", cubes_with_index_offset(3)),
    );
    for (call, wanted) in [
        ("draw needle.obj", "the drawing is empty: no face has an area"),
        ("draw two.obj --only needle", "--only and --hide leave nothing else to draw than needle"),
        (
            "draw cubes.obj --set lines.enabled=false",
            "the drawing is empty: the style draws neither lines nor surfaces",
        ),
        (
            "draw cubes.obj --set lines.kinds=[\"wire\"]",
            "the drawing is empty: no line of the model is visible",
        ),
    ] {
        let mut words: Vec<&str> = call.split_whitespace().collect();
        words.push("a.svg");
        let run = folder.run(&words);
        assert!(run.expect_success().err.contains(wanted), "{run:?}");
    }
}

/// The cubes as OBJ, with indices that start after some vertices of another part.
fn cubes_with_index_offset(vertices: usize) -> String {
    let moved = |line: &str| match line.strip_prefix("f ") {
        Some(face) => {
            let corners = face
                .split_whitespace()
                .map(|v| (v.parse::<usize>().expect("an index") + vertices).to_string());
            format!("f {}\n", corners.collect::<Vec<_>>().join(" "))
        }
        None => format!("{line}\n"),
    };
    CUBES.lines().map(moved).collect()
}

#[test]
fn textures_and_material_libraries_are_found_by_file_name() {
    let folder = TestFolder::new("pictures");
    let png = std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/trellis-hole.png"));
    let png = png.expect("a picture of this project");
    folder.write("Maps/a.txt", "");
    for name in ["Maps/Wall.PNG", "wall.png"] {
        std::fs::write(folder.path(name), &png).expect("a picture");
    }
    folder.write("Q.MTL", "newmtl a\nmap_Kd C:\\work\\maps\\WALL.png\nnewmtl b\nmap_Kd ..\\..\\Wall.Png\nnewmtl c\nmap_Kd /etc/passwd\n");
    let quad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
    let faces: String = ["a", "b", "c"].map(|m| format!("usemtl {m}\nf 1/1 2/2 3/3 4/4\n")).concat();
    folder.write("q.obj", &format!("mtllib C:\\work\\q.mtl\n{quad}{faces}"));
    let run = folder.ligne("draw q.obj q.svg --style flat");
    for wanted in [
        "material library C:\\work\\q.mtl is not there; Q.MTL is used",
        "texture C:\\work\\maps\\WALL.png of material `a` is not there; Maps/Wall.PNG is used",
        "texture ..\\..\\Wall.Png of material `b` is not there; wall.png is used",
        "texture /etc/passwd of material `c` lies outside the model's folder, where no file has its name; it is left out",
    ] {
        assert!(run.expect_success().err.contains(wanted), "{run:?}");
    }
    let json: Value =
        serde_json::from_str(&folder.ligne("info q.obj --json").expect_success().out).expect("JSON");
    assert_eq!(json["materials"][0]["texture"], "Maps/Wall.PNG");
    assert!(json["materials"][0]["texture_size"].is_array(), "{json}");
}
