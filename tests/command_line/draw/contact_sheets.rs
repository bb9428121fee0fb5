//! Contact sheets: several views, styles or times on one sheet, each with a caption.

use crate::folder::TestFolder;

/// The captions of a sheet, in order.
fn captions(svg: &str) -> Vec<String> {
    let (_, callouts) = svg.split_once("id=\"callouts\"").expect("captions");
    let titles = callouts.split("<title>").skip(1).filter_map(|rest| rest.split('<').next());
    titles.map(str::to_owned).collect()
}

/// Width and height of a sheet in px.
fn sheet_size(svg: &str) -> [f64; 2] {
    ["width", "height"].map(|side| {
        let rest = svg.split(&format!(" {side}=\"")).nth(1).expect("a size");
        rest.split('"').next().and_then(|number| number.parse().ok()).expect("a number")
    })
}

/// Checks that no id occurs twice.
fn assert_ids_are_unique(svg: &str) {
    let mut ids: Vec<&str> = svg.split(" id=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
    let count = ids.len();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), count, "ids that are given twice");
}

/// The path data of the picture with this label.
fn path_data<'a>(svg: &'a str, label: &str) -> Vec<&'a str> {
    let group =
        svg.split("<g ").find(|group| group.contains(&format!("label=\"{label}\"")) && group.contains(" d="));
    group.unwrap_or_default().split(" d=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect()
}

#[test]
fn contact_sheet_captions_reproduce_each_view() {
    let folder = TestFolder::with_cubes("contact-views");
    let run = folder.ligne("draw cubes.obj sheet.svg --contact-sheet");
    assert!(run.expect_success().err.starts_with("sheet.svg: 9 views, "), "{run:?}");
    let svg = folder.text("sheet.svg");
    let found = captions(&svg);
    assert_eq!(found.len(), 9);
    assert_eq!(found[4], "--azimuth 35 --elevation 22");
    assert_eq!(sheet_size(&svg), [3.0 * 340.0 + 20.0, 3.0 * 354.0 + 20.0]);
    assert_ids_are_unique(&svg);
    // A caption is a list of options that draws the same view.
    folder.ligne(&format!("draw cubes.obj one.svg --size 320 {}", found[1])).expect_success();
    let (one, label) = (folder.text("one.svg"), "azimuth--100-elevation-22");
    assert_eq!(path_data(&svg, label).len(), path_data(&one, "lines").len());
    // A given view is in the centre of the grid. Other options apply to all views.
    let line = "draw cubes.obj near.svg --contact-sheet --azimuth -35 --elevation 10 --only base --size 100x80 --ortho";
    folder.ligne(line).expect_success();
    let svg = folder.text("near.svg");
    let found = captions(&svg);
    assert_eq!(found[0], "--azimuth -55 --elevation 25");
    assert_eq!(found[4], "--azimuth -35 --elevation 10");
    assert_eq!(found[8], "--azimuth -15 --elevation -5");
    assert_eq!(sheet_size(&svg), [3.0 * 120.0 + 20.0, 3.0 * 114.0 + 20.0]);
    assert!(svg.contains("data-part=\"base\"") && !svg.contains("data-part=\"knob\""), "{svg}");
}

#[test]
fn contact_sheets_support_all_formats_and_refuse_conflicting_options() {
    let folder = TestFolder::with_cubes("contact-formats");
    folder
        .ligne("draw cubes.obj a.png -o a.pdf -o a.dxf -o a.svgz --contact-sheet --size 60")
        .expect_success();
    assert!(folder.read("a.png").starts_with(b"\x89PNG"));
    assert!(folder.read("a.pdf").starts_with(b"%PDF"));
    assert!(folder.read("a.svgz").starts_with(&[0x1f, 0x8b]));
    assert!(folder.text("a.dxf").contains("SECTION"));
    let printed = folder.ligne("draw cubes.obj - --contact-sheet --size 60 --quiet");
    assert!(printed.expect_success().err.is_empty() && printed.out.starts_with("<svg"), "{printed:?}");
    for wrong in [
        "--view iso",
        "--page A4",
        "--camera a.json",
        "--out-dir b",
        "--watch",
        "--report -",
        "--maps b",
        "--save-camera a.json",
    ] {
        let run = folder.ligne(&format!("draw cubes.obj b.svg --contact-sheet {wrong}"));
        assert_eq!(run.status, Some(2), "{wrong}: {run:?}");
    }
    folder.ligne("draw cubes.obj cubes.obj --contact-sheet").expect_refusal("cubes.obj");
    folder.ligne("draw cubes.obj gone/b.svg --contact-sheet").expect_refusal("there is no folder gone");
    folder
        .ligne("draw cubes.obj b.svg --contact-sheet --only kn*b --strict --hide x")
        .expect_refusal("'x' fits no part");
    assert!(!folder.names().contains(&"b.svg".to_owned()));
    // A view in `ligne.toml` does not conflict with a contact sheet.
    folder.write("ligne.toml", "[draw]\nview = 'iso'\nstyle = 'technical'\n");
    folder.ligne("draw cubes.obj b.svg --contact-sheet --size 60").expect_success();
}

#[test]
fn styles_sheet_applies_camera_part_and_size_options() {
    let folder = TestFolder::with_cubes("contact-styles");
    folder.write("mine.toml", "extends = 'ink'\n[pen]\ncolour = '#123456'\n");
    let line = "styles --sheet some.svg cubes.obj --style ink,pen* --style mine.toml --azimuth 90 --elevation 0 --ortho --only knob --size 120";
    let run = folder.ligne(line);
    let svg = {
        run.expect_success();
        folder.text("some.svg")
    };
    let found = captions(&svg);
    assert_eq!((found[0].as_str(), found.last().map(String::as_str)), ("ink", Some("mine.toml")));
    assert!(found[1..found.len() - 1].iter().all(|name| name.starts_with("pen")), "{found:?}");
    assert!(run.err.contains(&format!("{} styles", found.len())), "{run:?}");
    assert!(svg.contains("#123456") && svg.contains("label=\"mine\""), "{svg}");
    assert!(!svg.contains("data-part=\"base\""));
    assert_ids_are_unique(&svg);
    assert_eq!(sheet_size(&svg)[0], found.len().min(6) as f64 * 140.0 + 20.0);
    // From the right the knob is a square, drawn as one path.
    let [ink] = path_data(&svg, "ink")[..] else { panic!("{:?}", path_data(&svg, "ink")) };
    folder
        .ligne("draw cubes.obj one.svg --azimuth 90 --elevation 0 --ortho --only knob --size 120")
        .expect_success();
    assert_eq!(path_data(&folder.text("one.svg"), "lines").len(), 1, "{ink}");
    folder.ligne("styles --sheet a.svg cubes.obj --style nonesuch").expect_refusal("nonesuch");
    folder
        .ligne("styles --sheet a.svg cubes.obj --style no*such")
        .expect_refusal("no built-in style matches");
    folder.ligne("styles --sheet a.svg cubes.obj --page A4").expect_refusal("--page");
    assert_eq!(folder.ligne("styles ink --azimuth 20").status, Some(2));
    assert!(!folder.names().contains(&"a.svg".to_owned()));
    // Environment variables change neither the list nor the sheet.
    let with = |line: &str| folder.run_with(&[("LIGNE_STYLE", "toon"), ("LIGNE_THREADS", "1")], line);
    with("styles").expect_success();
    with("styles --sheet v.svg cubes.obj --style ink --size 60").expect_success();
    assert_eq!(captions(&folder.text("v.svg")), ["ink"]);
}

#[test]
fn animation_contact_sheets_caption_each_time() {
    let folder = TestFolder::new("contact-moments");
    let crane = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/crane.glb");
    std::fs::copy(crane, folder.path("crane.glb")).expect("the crane");
    let run = folder.ligne("animate crane.glb sheet.svg --contact-sheet --size 80 --from 0 --to 2");
    assert!(run.expect_success().err.starts_with("sheet.svg: 9 moments, "), "{run:?}");
    let svg = folder.text("sheet.svg");
    let times: Vec<String> = (0..9).map(|moment| format!("--time {}", f64::from(moment) / 4.0)).collect();
    assert_eq!(captions(&svg), times);
    assert_eq!(sheet_size(&svg), [3.0 * 100.0 + 20.0, 3.0 * 114.0 + 20.0]);
    assert_ids_are_unique(&svg);
    assert_ne!(path_data(&svg, "time-0"), path_data(&svg, "time-1"));
    folder.ligne("animate crane.glb sheet.png --contact-sheet --size 40").expect_success();
    assert!(folder.read("sheet.png").starts_with(b"\x89PNG"));
    for wrong in ["--turntable 4", "--fps 3", "--hold 2", "--faces 9", "--page A4", "--to -1"] {
        let run = folder.ligne(&format!("animate crane.glb b.svg --contact-sheet {wrong}"));
        assert_eq!(run.status, Some(2), "{wrong}: {run:?}");
    }
    folder.ligne("animate crane.glb crane.glb --contact-sheet").expect_refusal("crane.glb");
    assert_eq!(folder.names(), ["crane.glb", "sheet.png", "sheet.svg"]);
}
