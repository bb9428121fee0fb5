//! Sections and exploded views of `ligne draw` and `ligne animate`, and `ligne page --new sheet`.

use crate::folder::Folder;

#[test]
fn sections_are_hatched_and_closed() {
    let folder = Folder::with_cubes("section");
    folder.ligne("draw cubes.obj whole.svg --view front").done();
    let cut = folder.ligne("draw cubes.obj cut.svg --view front --section z --quiet");
    assert!(cut.done().err.is_empty());
    let svg = folder.text("cut.svg");
    let hatched =
        |svg: &str, part: &str| svg.contains(&format!("<path class=\"pattern\" data-part=\"{part}\""));
    assert!(hatched(&svg, "base") && hatched(&svg, "knob"), "{svg}");
    assert!(!folder.text("whole.svg").contains("pattern"));
    folder.ligne("draw cubes.obj one.svg --view front --section z --uncut knob").done();
    let svg = folder.text("one.svg");
    assert!(hatched(&svg, "base") && !hatched(&svg, "knob"), "{svg}");
    // A sign selects the side that is removed. Every notation of a plane is accepted.
    for plane in ["x=0.5", "+x=0.5", "-x=0.5", "y=20%", "x=1mm", "normal:1,1,0@0.2"] {
        folder.ligne(&format!("draw cubes.obj a.svg --section {plane}")).done();
    }
    assert_ne!(folder.text("a.svg"), svg);
}

/// Centre of the bounding box around the silhouettes of a drawing.
fn middle(folder: &Folder, name: &str) -> [f64; 2] {
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
fn the_frame_holds_what_a_section_leaves() {
    let folder = Folder::new("section-frame");
    folder.write(
        "bar.obj",
        "v 0 0 0\nv 9 0 0\nv 9 2 0\nv 0 2 0\nv 0 0 1\nv 9 0 1\nv 9 2 1\nv 0 2 1\n\
         f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n",
    );
    let centred = |[x, y]: [f64; 2]| (x - 500.0).abs() < 1.0 && (y - 500.0).abs() < 1.0;
    // `+x=3` removes two thirds of the bar. The remaining third is centred in the frame.
    folder.ligne("draw bar.obj a.svg --view front --up z --section +x=3 --style technical").done();
    assert!(centred(middle(&folder, "a.svg")), "{:?}", middle(&folder, "a.svg"));
    folder
        .ligne("draw bar.obj b.svg --view front --up z --section +x=3 --style technical --frame all")
        .done();
    assert!(!centred(middle(&folder, "b.svg")), "{:?}", middle(&folder, "b.svg"));
    // A stored camera is not framed again.
    folder.ligne("draw bar.obj whole.svg --view front --up z --save-camera camera.json").done();
    folder.ligne("draw bar.obj c.svg --camera camera.json --section +x=3 --style technical").done();
    assert!(!centred(middle(&folder, "c.svg")), "{:?}", middle(&folder, "c.svg"));
    folder.ligne("draw bar.obj --out-dir d --view front,top --up z --section +x=3 --style technical").done();
    for name in folder.names_in("d") {
        assert!(centred(middle(&folder, &format!("d/{name}"))), "{name}");
    }
}

#[test]
fn explosions_have_trails() {
    let folder = Folder::with_cubes("explode");
    folder.ligne("draw cubes.obj a.svg --view front --explode y:20").done();
    let svg = folder.text("a.svg");
    assert!(svg.contains("class=\"wire\"") && svg.contains("data-part=\"trail\""), "{svg}");
    folder.ligne("draw cubes.obj b.svg --view front --explode y:30").done();
    assert_ne!(svg, folder.text("b.svg"));
    folder.ligne("draw cubes.obj c.svg --view front --explode auto").done();
    folder.ligne("draw cubes.obj d.svg --view front --explode y:20 --explode-part *:distance=0").done();
    assert!(!folder.text("d.svg").contains("data-part=\"trail\""));
}

#[test]
fn wrong_planes_and_axes_are_refused() {
    let folder = Folder::with_cubes("section-wrong");
    folder.ligne("draw cubes.obj a.svg --section w").refused("write a plane such as");
    folder.ligne("draw cubes.obj a.svg --section x=99").refused("misses the model");
    folder.ligne("draw cubes.obj a.svg --uncut knob").refused("--section");
    folder.ligne("draw cubes.obj a.svg --explode w").refused("or auto");
    folder.ligne("draw cubes.obj a.svg --explode z --explode-part nut").refused("there is no colon");
    folder
        .ligne("draw cubes.obj a.svg --explode z --explode-part wheel:distance=2")
        .refused("no part has the name");
    folder.ligne("draw cubes.obj a.svg --explode-part base:distance=2").refused("--explode");
    folder.ligne("animate cubes.obj a.gif --section x").refused("neither cut nor exploded");
    folder
        .ligne("animate cubes.obj a.gif --turntable 3 --explode z --faces 20")
        .refused("cannot be simplified");
}

#[test]
fn turns_round_a_model_show_it_cut_open_or_taken_apart() {
    let folder = Folder::with_cubes("section-turn");
    folder.ligne("animate cubes.obj cut-%d.svg --turntable 2 --section z --view front").done();
    let svg = folder.text("cut-0.svg");
    assert!(svg.contains("<path class=\"pattern\" data-part=\"base\""), "{svg}");
    folder.ligne("animate cubes.obj apart-%d.svg --turntable 2 --explode y:20 --view front").done();
    assert!(folder.text("apart-0.svg").contains("data-part=\"trail\""));
}

#[test]
fn a_sheet_to_start_from_draws_at_once() {
    let folder = Folder::new("new-sheet");
    folder.ligne("page --new sheet sheet.toml").done();
    folder.ligne("page sheet.toml a.svg").done();
    let svg = folder.text("a.svg");
    for name in ["frame", "title-block", "parts-list", "balloons", "section-A", "exploded", "top", "left"] {
        assert!(svg.contains(&format!("id=\"{name}\"")), "{name}");
    }
}
