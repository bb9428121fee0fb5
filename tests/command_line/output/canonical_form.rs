//! `ligne fmt`, and the canonical form of SVG files that `ligne draw` writes.

use std::fs;

use crate::folder::TestFolder;
use ligne::diff::canonical_svg;

/// An SVG document of 40 x 40 px with this content.
fn svg_document(inside: &str) -> String {
    format!("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"40\" height=\"40\">{inside}</svg>")
}

/// Two lines out of canonical order and direction, then the same lines in canonical form.
const UNSORTED_PATHS: &str = "<path d=\"M9 20L1 20\"/><path d=\"M9 10L1 10\"/>";
const CANONICAL_PATHS: &str = "<path d=\"M1 10h8\"/><path d=\"M1 20h8\"/>";

#[test]
fn drawings_are_written_in_canonical_form() {
    let folder = TestFolder::with_cubes("fmt-page");
    let calls = [
        "--page A4 --style technical",
        "--page A4 --landscape --style pencil-plain --group part",
        "--page 120x90mm --style toon --precision 5",
        "--style plotter --page A4 --group part",
        "--stage zeros",
        "--stage removed --style suggestive",
        "--stage strengths",
        "--stage field",
    ];
    for call in calls {
        folder.ligne(&format!("draw cubes.obj page.svg {call}")).expect_success();
        let svg = folder.text("page.svg");
        assert_eq!(canonical_svg(&svg, None).as_deref(), Ok(svg.as_str()), "{call}");
        folder.ligne("fmt --check page.svg").expect_success();
    }
    let svg = |style: &str| {
        folder.ligne(&format!("draw cubes.obj page.svg --style {style}")).expect_success();
        folder.text("page.svg")
    };
    assert!(svg("plotter").contains("data-order=\"travel\""));
    assert!(!svg("technical").contains("data-order"));
}

#[test]
fn fmt_rewrites_checks_and_refuses_files() {
    let folder = TestFolder::new("fmt");
    let (before, after) = (
        svg_document(&format!("<g fill=\"none\" stroke=\"#000\">{UNSORTED_PATHS}</g>")),
        svg_document(&format!("<g fill=\"none\" stroke=\"#000\">{CANONICAL_PATHS}</g>")),
    );
    folder.write("a.svg", &before);
    folder.write("b.svg", &after);
    let checked = folder.ligne("fmt --check a.svg b.svg");
    assert_eq!((checked.status, checked.out.as_str(), checked.err.as_str()), (Some(1), "a.svg\n", ""));
    assert_eq!(folder.text("a.svg"), before);

    assert_eq!(folder.ligne("fmt a.svg -o -").expect_success().out, after);
    folder.ligne("fmt a.svg -o c.svg").expect_success();
    assert_eq!((folder.text("a.svg"), folder.text("c.svg")), (before.clone(), after.clone()));

    // One bad file leaves all files unchanged.
    folder.write("bad.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"><path d=\"M1 1");
    folder.ligne("fmt a.svg bad.svg").expect_refusal("bad.svg: line 1");
    folder.ligne("fmt --check a.svg bad.svg").expect_refusal("bad.svg");
    folder.ligne("fmt a.svg no-such.svg").expect_refusal("no-such.svg: cannot be read");
    fs::write(folder.path("bytes.svg"), [b'<', 0xff, 0xfe]).unwrap();
    folder.ligne("fmt bytes.svg").expect_refusal("UTF-8");
    folder.ligne("fmt a.svg b.svg -o c.svg").expect_refusal("one output");
    folder.ligne("fmt a.svg --check -o c.svg").expect_refusal("--check");
    folder.ligne("fmt a.svg -o no/such/c.svg").expect_refusal("create the folder first");
    folder.ligne("fmt a.svg --precision 9").expect_refusal("9");
    assert_eq!(folder.text("a.svg"), before);

    let run = folder.ligne("fmt a.svg b.svg");
    assert_eq!(run.expect_success().out, "");
    assert_eq!((folder.text("a.svg"), folder.text("b.svg")), (after.clone(), after));
    folder.ligne("fmt --check a.svg b.svg").expect_success();
    assert_eq!(folder.names(), ["a.svg", "b.svg", "bad.svg", "bytes.svg", "c.svg"]);
    folder.write("d.svg", &svg_document("<path d=\"M1.26 1L5 5\"/>"));
    folder.ligne("fmt d.svg --precision 1").expect_success();
    assert_eq!(folder.text("d.svg"), svg_document("<path d=\"M1.3 1l3.7 4\"/>"));
}
