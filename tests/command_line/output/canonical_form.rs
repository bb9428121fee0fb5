//! `ligne fmt`, and the canonical form of SVG files that `ligne draw` writes.

use std::fs;

use crate::folder::Folder;
use ligne::diff::canonical_svg;

/// An SVG document of 40 x 40 px with this content.
fn svg(inside: &str) -> String {
    format!("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"40\" height=\"40\">{inside}</svg>")
}

/// Two lines out of canonical order and direction, then the same lines in canonical form.
const TWO: &str = "<path d=\"M9 20L1 20\"/><path d=\"M9 10L1 10\"/>";
const FORM: &str = "<path d=\"M1 10h8\"/><path d=\"M1 20h8\"/>";

#[test]
fn pages_of_the_command_line_are_in_the_form() {
    let folder = Folder::with_cubes("fmt-page");
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
        folder.ligne(&format!("draw cubes.obj page.svg {call}")).done();
        let svg = folder.text("page.svg");
        assert_eq!(canonical_svg(&svg, None).as_deref(), Ok(svg.as_str()), "{call}");
        folder.ligne("fmt --check page.svg").done();
    }
    let svg = |style: &str| {
        folder.ligne(&format!("draw cubes.obj page.svg --style {style}")).done();
        folder.text("page.svg")
    };
    assert!(svg("plotter").contains("data-order=\"travel\""));
    assert!(!svg("technical").contains("data-order"));
}

#[test]
fn the_command_rewrites_checks_and_refuses() {
    let folder = Folder::new("fmt");
    let (before, after) = (
        svg(&format!("<g fill=\"none\" stroke=\"#000\">{TWO}</g>")),
        svg(&format!("<g fill=\"none\" stroke=\"#000\">{FORM}</g>")),
    );
    folder.write("a.svg", &before);
    folder.write("b.svg", &after);
    let checked = folder.ligne("fmt --check a.svg b.svg");
    assert_eq!((checked.status, checked.out.as_str(), checked.err.as_str()), (Some(1), "a.svg\n", ""));
    assert_eq!(folder.text("a.svg"), before);

    assert_eq!(folder.ligne("fmt a.svg -o -").done().out, after);
    folder.ligne("fmt a.svg -o c.svg").done();
    assert_eq!((folder.text("a.svg"), folder.text("c.svg")), (before.clone(), after.clone()));

    // One bad file leaves all files unchanged.
    folder.write("bad.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"><path d=\"M1 1");
    folder.ligne("fmt a.svg bad.svg").refused("bad.svg: line 1");
    folder.ligne("fmt --check a.svg bad.svg").refused("bad.svg");
    folder.ligne("fmt a.svg no-such.svg").refused("no-such.svg: cannot be read");
    fs::write(folder.path("bytes.svg"), [b'<', 0xff, 0xfe]).unwrap();
    folder.ligne("fmt bytes.svg").refused("UTF-8");
    folder.ligne("fmt a.svg b.svg -o c.svg").refused("one output");
    folder.ligne("fmt a.svg --check -o c.svg").refused("--check");
    folder.ligne("fmt a.svg -o no/such/c.svg").refused("create the folder first");
    folder.ligne("fmt a.svg --precision 9").refused("9");
    assert_eq!(folder.text("a.svg"), before);

    let run = folder.ligne("fmt a.svg b.svg");
    assert_eq!(run.done().out, "");
    assert_eq!((folder.text("a.svg"), folder.text("b.svg")), (after.clone(), after));
    folder.ligne("fmt --check a.svg b.svg").done();
    assert_eq!(folder.names(), ["a.svg", "b.svg", "bad.svg", "bytes.svg", "c.svg"]);
    folder.write("d.svg", &svg("<path d=\"M1.26 1L5 5\"/>"));
    folder.ligne("fmt d.svg --precision 1").done();
    assert_eq!(folder.text("d.svg"), svg("<path d=\"M1.3 1l3.7 4\"/>"));
}
