//! Sections and exploded views of `ligne draw` and `ligne animate`, and `ligne page --new sheet`.

use crate::folder::TestFolder;

#[test]
fn section_faces_are_hatched_except_on_uncut_parts() {
    let folder = TestFolder::with_cubes("section");
    folder.ligne("draw cubes.obj whole.svg --view front").expect_success();
    let cut = folder.ligne("draw cubes.obj cut.svg --view front --section z --quiet");
    assert!(cut.expect_success().err.is_empty());
    let svg = folder.text("cut.svg");
    let hatched =
        |svg: &str, part: &str| svg.contains(&format!("<path class=\"pattern\" data-part=\"{part}\""));
    assert!(hatched(&svg, "base") && hatched(&svg, "knob"), "{svg}");
    assert!(!folder.text("whole.svg").contains("pattern"));
    folder.ligne("draw cubes.obj one.svg --view front --section z --uncut knob").expect_success();
    let svg = folder.text("one.svg");
    assert!(hatched(&svg, "base") && !hatched(&svg, "knob"), "{svg}");
    // A sign selects the side that is removed. Every notation of a plane is accepted.
    for plane in ["x=0.5", "+x=0.5", "-x=0.5", "y=20%", "x=1mm", "normal:1,1,0@0.2"] {
        folder.ligne(&format!("draw cubes.obj a.svg --section {plane}")).expect_success();
    }
    assert_ne!(folder.text("a.svg"), svg);
}

/// Centre of the bounding box around the silhouettes of a drawing.
fn outline_centre(folder: &TestFolder, name: &str) -> [f64; 2] {
    use ligne::kurbo::Shape as _;
    let svg = folder.text(name);
    let outlines = svg.lines().filter(|line| line.contains("silhouette"));
    let path = |line: &str| {
        let from = line.find(" d=\"")? + 4;
        let data = &line[from..from + line[from..].find('"')?];
        Some(ligne::kurbo::BezPath::from_svg(data).ok()?.bounding_box())
    };
    let bounds = outlines.filter_map(path).reduce(|a, b| a.union(b)).expect("an outline");
    [bounds.center().x, bounds.center().y]
}

#[test]
fn sectioned_models_are_framed_by_the_remaining_geometry() {
    let folder = TestFolder::new("section-frame");
    folder.write(
        "bar.obj",
        "v 0 0 0\nv 9 0 0\nv 9 2 0\nv 0 2 0\nv 0 0 1\nv 9 0 1\nv 9 2 1\nv 0 2 1\n\
         f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n",
    );
    let centred = |[x, y]: [f64; 2]| (x - 500.0).abs() < 1.0 && (y - 500.0).abs() < 1.0;
    // `+x=3` removes two thirds of the bar. The remaining third is centred in the frame.
    folder.ligne("draw bar.obj a.svg --view front --up z --section +x=3 --style technical").expect_success();
    assert!(centred(outline_centre(&folder, "a.svg")), "{:?}", outline_centre(&folder, "a.svg"));
    folder
        .ligne("draw bar.obj b.svg --view front --up z --section +x=3 --style technical --frame all")
        .expect_success();
    assert!(!centred(outline_centre(&folder, "b.svg")), "{:?}", outline_centre(&folder, "b.svg"));
    // A stored camera is not framed again.
    folder.ligne("draw bar.obj whole.svg --view front --up z --save-camera camera.json").expect_success();
    folder.ligne("draw bar.obj c.svg --camera camera.json --section +x=3 --style technical").expect_success();
    assert!(!centred(outline_centre(&folder, "c.svg")), "{:?}", outline_centre(&folder, "c.svg"));
    folder
        .ligne("draw bar.obj --out-dir d --view front,top --up z --section +x=3 --style technical")
        .expect_success();
    for name in folder.names_in("d") {
        assert!(centred(outline_centre(&folder, &format!("d/{name}"))), "{name}");
    }
}

#[test]
fn exploded_views_draw_trails() {
    let folder = TestFolder::with_cubes("explode");
    folder.ligne("draw cubes.obj a.svg --view front --explode y:20").expect_success();
    let svg = folder.text("a.svg");
    assert!(svg.contains("class=\"wire\"") && svg.contains("data-part=\"trail\""), "{svg}");
    folder.ligne("draw cubes.obj b.svg --view front --explode y:30").expect_success();
    assert_ne!(svg, folder.text("b.svg"));
    folder.ligne("draw cubes.obj c.svg --view front --explode auto").expect_success();
    folder
        .ligne("draw cubes.obj d.svg --view front --explode y:20 --explode-part *:distance=0")
        .expect_success();
    assert!(!folder.text("d.svg").contains("data-part=\"trail\""));
}

#[test]
fn invalid_section_planes_and_explode_axes_are_refused() {
    let folder = TestFolder::with_cubes("section-wrong");
    folder.ligne("draw cubes.obj a.svg --section w").expect_refusal("write a plane such as");
    folder.ligne("draw cubes.obj a.svg --section x=99").expect_refusal("misses the model");
    folder.ligne("draw cubes.obj a.svg --uncut knob").expect_refusal("--section");
    folder.ligne("draw cubes.obj a.svg --explode w").expect_refusal("or auto");
    folder.ligne("draw cubes.obj a.svg --explode z --explode-part nut").expect_refusal("there is no colon");
    folder
        .ligne("draw cubes.obj a.svg --explode z --explode-part wheel:distance=2")
        .expect_refusal("no part has the name");
    folder.ligne("draw cubes.obj a.svg --explode-part base:distance=2").expect_refusal("--explode");
    folder.ligne("animate cubes.obj a.gif --section x").expect_refusal("neither cut nor exploded");
    folder
        .ligne("animate cubes.obj a.gif --turntable 3 --explode z --faces 20")
        .expect_refusal("cannot be simplified");
}

#[test]
fn turntables_support_sections_and_exploded_views() {
    let folder = TestFolder::with_cubes("section-turn");
    folder.ligne("animate cubes.obj cut-%d.svg --turntable 2 --section z --view front").expect_success();
    let svg = folder.text("cut-0.svg");
    assert!(svg.contains("<path class=\"pattern\" data-part=\"base\""), "{svg}");
    folder.ligne("animate cubes.obj apart-%d.svg --turntable 2 --explode y:20 --view front").expect_success();
    assert!(folder.text("apart-0.svg").contains("data-part=\"trail\""));
}

#[test]
fn page_new_sheet_writes_a_page_file_that_draws() {
    let folder = TestFolder::new("new-sheet");
    folder.ligne("page --new sheet sheet.toml").expect_success();
    folder.ligne("page sheet.toml a.svg").expect_success();
    let svg = folder.text("a.svg");
    for name in ["frame", "title-block", "parts-list", "balloons", "section-A", "exploded", "top", "left"] {
        assert!(svg.contains(&format!("id=\"{name}\"")), "{name}");
    }
}
