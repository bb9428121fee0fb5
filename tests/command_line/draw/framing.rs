//! Framing in `ligne draw`: units, stored cameras, aligned instruction steps, and warnings.

use crate::folder::TestFolder;

/// Left, top, right and bottom of everything in a drawing, in user units.
fn drawing_bounds(svg: &str) -> [f64; 4] {
    let tree = usvg::Tree::from_str(svg, &usvg::Options::default()).expect("valid SVG");
    let bounds = tree.root().abs_bounding_box();
    let width = svg.split("viewBox=\"").nth(1).and_then(|rest| rest.split('"').next()).expect("a viewBox");
    let width: f64 = width.split(' ').nth(2).and_then(|width| width.parse().ok()).expect("a width");
    let unit = width / f64::from(tree.size().width());
    [bounds.left(), bounds.top(), bounds.right(), bounds.bottom()].map(|side| f64::from(side) * unit)
}

/// Whether two lengths differ by less than 0.02.
fn is_near(a: f64, b: f64) -> bool {
    (a - b).abs() < 0.02
}

#[test]
fn unit_option_sets_the_real_size_of_scaled_drawings() {
    let folder = TestFolder::with_cubes("units");
    // The base is 2 units wide.
    for (unit, scale, wide) in [
        ("mm", "10:1", 20.0),
        ("cm", "1:1", 20.0),
        ("m", "1:100", 20.0),
        ("in", "1:1", 50.8),
        ("ft", "1:10", 60.96),
    ] {
        folder
            .ligne(&format!(
                "draw cubes.obj a.svg --background none --page 100x100mm --scale {scale} --view front --unit {unit}"
            ))
            .expect_success();
        let [left, _, right, _] = drawing_bounds(&folder.text("a.svg"));
        assert!(is_near(right - left, wide), "{unit}: {}", right - left);
    }
    folder.ligne("draw cubes.obj a.svg --unit furlong").expect_refusal("furlong");
}

#[test]
fn info_applies_the_unit_and_warns_about_doubtful_sizes() {
    let folder = TestFolder::with_cubes("doubt");
    assert!(folder.ligne("info cubes.obj").expect_success().out.contains("\n  2 x 3.5 x 2, from ("));
    let run = folder.ligne("info cubes.obj --unit in");
    assert!(run.expect_success().out.contains("\n  2 x 3.5 x 2 in, from ("), "{run:?}");
    folder.write("small.obj", "v 0 0 0\nv 0.2 0 0\nv 0 0.1 0\nf 1 2 3\n");
    let run = folder.ligne("info small.obj");
    assert!(run.expect_success().out.contains("200 mm (--unit m)"), "{run:?}");
    assert!(!folder.ligne("info small.obj --unit m").expect_success().out.contains("--unit"));
    folder.write("long.obj", "v 0 0 0\nv 20000 0 0\nv 0 10 0\nf 1 2 3\n");
    assert!(folder.ligne("info long.obj").expect_success().out.contains("20 m long"));
    let json = folder.ligne("info small.obj --unit cm --json").expect_success().out.clone();
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!((json["unit"].as_str(), json["bounds"]["size_mm"][0].as_f64()), (Some("cm"), Some(2.0)));
}

#[test]
fn a_saved_camera_reproduces_the_drawing() {
    let folder = TestFolder::with_cubes("save-camera");
    for (view, page) in [
        ("", ""),
        ("--azimuth 12 --elevation -7 --fov 20", "--size 600x400"),
        ("--view iso", "--page A5 --margin 7mm"),
        ("--view front", "--page A5 --scale 3:1"),
    ] {
        folder.ligne(&format!("draw cubes.obj a.svg --save-camera eye.json {view} {page}")).expect_success();
        let page = page.replace("--scale 3:1", "");
        folder.ligne(&format!("draw cubes.obj b.svg --camera eye.json {page}")).expect_success();
        assert_eq!(folder.text("a.svg"), folder.text("b.svg"), "{view} {page}");
    }
    folder.ligne("draw cubes.obj c.svg --save-camera no/eye.json").expect_refusal("there is no folder");
    assert!(!folder.names().contains(&"c.svg".to_owned()));
}

#[test]
fn frame_all_aligns_drawings_with_hidden_parts() {
    let folder = TestFolder::with_cubes("steps");
    folder.ligne("draw cubes.obj all.svg --background none --view front").expect_success();
    folder
        .ligne("draw cubes.obj step.svg --background none --view front --hide knob --frame all")
        .expect_success();
    folder.ligne("draw cubes.obj alone.svg --background none --view front --hide knob").expect_success();
    let [all, step, alone] =
        ["all.svg", "step.svg", "alone.svg"].map(|name| drawing_bounds(&folder.text(name)));
    assert!(
        is_near(all[0], step[0]) && is_near(all[2], step[2]) && is_near(all[3], step[3]),
        "{all:?} {step:?}"
    );
    assert!(alone[2] - alone[0] > 1.2 * (step[2] - step[0]), "{alone:?} {step:?}");
}

#[test]
fn orthographic_camera_records_accept_scale_and_centre() {
    let folder = TestFolder::with_cubes("centre");
    folder.ligne("draw cubes.obj a.svg --view front --save-camera front.json").expect_success();
    folder
        .ligne("draw cubes.obj b.svg --background none --camera front.json --page 100x100mm --scale 10:1 --centre 1,1,0")
        .expect_success();
    // The upper right corner of the base is at the centre of the page.
    let [left, _, right, bottom] = drawing_bounds(&folder.text("b.svg"));
    assert!(is_near(left, 30.0) && is_near(right, 50.0) && is_near(bottom, 70.0), "{left} {right} {bottom}");
    folder.ligne("draw cubes.obj c.svg --save-camera eye.json").expect_success();
    folder
        .ligne("draw cubes.obj d.svg --camera eye.json --page A4 --scale 1:1")
        .expect_refusal("needs an orthographic view");
    folder.ligne("draw cubes.obj d.svg --centre 1,1,0").expect_refusal("needs an orthographic view");
}

#[test]
fn empty_or_tiny_drawings_and_unused_options_raise_warnings() {
    let folder = TestFolder::with_cubes("wonder");
    folder.write(
        "inside.json",
        r#"{"type": "perspective", "eye": [0, 0, 0.5], "target": [0, 0, 0], "up": [0, 1, 0], "fov_y_deg": 60, "width": 100, "height": 100}"#,
    );
    folder.write(
        "beside.json",
        r#"{"type": "perspective", "eye": [0, 0, 9], "target": [9, 0, 9], "up": [0, 1, 0], "fov_y_deg": 30, "width": 100, "height": 100}"#,
    );
    for (options, told) in [
        ("--camera inside.json", "the eye is inside `base`"),
        ("--camera beside.json", "the drawing is empty"),
        ("--hide bolt*", "--hide 'bolt*' fits no part"),
        ("--only Knob --only base", "there is `knob`"),
        ("--page A4 --scale 1:5", "the model covers only 0.6 x 0.8 mm"),
        ("--dpi 300", "--dpi changes nothing: no PNG is written"),
    ] {
        let run = folder.ligne(&format!("draw cubes.obj a.svg {options}"));
        assert!(run.expect_success().err.contains(told), "{options}: {run:?}");
        // With `--strict`, the warning is an error.
        folder.ligne(&format!("draw cubes.obj a.svg --strict {options}")).expect_refusal(told);
    }
    let run = folder.ligne("draw cubes.obj a.svg -o a.png --page A6");
    assert!(run.expect_success().err.contains("a.png: 105 x 148 mm as 1240 x 1748 pixels, "), "{run:?}");
    assert!(!run.err.contains("warning"), "{run:?}");
}

#[test]
fn completions_offer_styles_and_page_sizes() {
    let folder = TestFolder::new("offered");
    for shell in ["bash", "zsh", "fish"] {
        let script = folder.ligne(&format!("completions {shell}")).expect_success().out.clone();
        for word in ["comic-flats", "Tabloid", "iso"] {
            assert!(script.contains(word), "{shell}: {word}");
        }
    }
}
