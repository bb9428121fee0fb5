//! Malformed and malicious SVG files are refused with a message, in bounded time and memory, without a panic.
//!
//! Without a limit on expansion these tests would not end.

use std::path::Path;

use crate::library::support::scenes::random_dice::Dice;
use ligne::diff::{self, DiffOptions, Picture, View};

fn svg_with(text: &str) -> String {
    format!("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100\" height=\"100\">{text}</svg>")
}

fn refusal(svg: &str) -> Option<String> {
    Picture::from_svg(svg).err().map(|error| error.to_string())
}

#[test]
fn unreadable_files_are_refused_with_the_reason() {
    let path = "<path stroke=\"#000\" d=\"M0 0L9 9\"/>";
    let levels = |count: usize| {
        let mut text = format!("<g id=\"g0\">{path}</g>");
        for level in 1..count {
            text +=
                &format!("<g id=\"g{level}\">{}</g>", format!("<use href=\"#g{}\"/>", level - 1).repeat(10));
        }
        svg_with(&text)
    };
    let entity = |value: &str, text: &str| format!("<!DOCTYPE svg [{value}]>{}", svg_with(text));
    let cases = [
        ("nothing", String::new(), "empty"),
        ("a model", "solid lid\nfacet normal 0 0 1".to_owned(), "not SVG"),
        ("JSON", "{\"same\": true}".to_owned(), "not SVG"),
        ("a page", "<!DOCTYPE html><html><body/></html>".to_owned(), "`html`"),
        ("cut off", svg_with(path)[..90].to_owned(), "line 1"),
        (
            "no size",
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"0\" height=\"-4\"/>".to_owned(),
            "size",
        ),
        ("deep nesting", svg_with(&("<g>".repeat(100_000) + path + &"</g>".repeat(100_000))), "256 deep"),
        ("references that multiply", levels(12), "multiply"),
        ("a reference to itself", svg_with("<g id=\"a\"><use href=\"#a\"/></g>"), "refers to itself"),
        ("entities of entities", entity("<!ENTITY a \"x\"><!ENTITY b \"&a;&a;\">", "&b;"), "entities"),
        ("an unknown entity", svg_with("&lol;"), "well-formed"),
        ("a giant number", svg_with("<path stroke=\"#000\" d=\"M0 0L1e30 5\"/>"), "1e30"),
        (
            "a giant width",
            svg_with("<path stroke=\"#000\" stroke-width=\"99999999999\" d=\"M0 0L1 5\"/>"),
            "out of range",
        ),
        (
            "giant steps",
            svg_with(&format!("<path stroke=\"#000\" d=\"M0 0{}\"/>", "l9999999 0".repeat(200))),
            "from the page",
        ),
        (
            "a giant transform",
            svg_with(&format!("<g transform=\"scale(99999999)\">{path}</g>")),
            "from the page",
        ),
    ];
    for (what, svg, words) in cases {
        let told = refusal(&svg).unwrap_or_else(|| panic!("{what}: was read"));
        assert!(told.contains(words), "{what}: {told}");
        assert!(told.contains(';'), "{what}: no remedy: {told}");
    }
}

#[test]
fn unusual_but_valid_files_are_compared() {
    let cases = [
        ("a billion dashes", "<path stroke=\"#000\" stroke-dasharray=\"1e-6 1e-6\" d=\"M0 0L1000000 5\"/>".to_owned()),
        ("many lengths of dashes", format!("<path stroke=\"#000\" stroke-dasharray=\"{}\" d=\"M0 0H9\"/>", "1 ".repeat(200_000))),
        ("a curve as long as allowed", "<path stroke=\"#000\" d=\"M0 0C0 90000000 90000000 0 90000000 90000000\"/>".to_owned()),
        ("many curves as long as allowed", format!("<path stroke=\"#000\" d=\"M0 0{}\"/>", "C0 90000000 90000000 0 0 0".repeat(100))),
        ("a blur", "<filter id=\"f\"><feGaussianBlur stdDeviation=\"1e6\"/></filter><rect filter=\"url(#f)\" width=\"9\" height=\"9\"/>".to_owned()),
        ("a file that is not there", "<image href=\"/no/such/file.png\" width=\"9\" height=\"9\"/>".to_owned()),
        ("no marks", String::new()),
        ("a dot", "<path stroke=\"#000\" d=\"M5 5h0\"/>".to_owned()),
        ("path data that breaks off", "<path stroke=\"#000\" d=\"M0 0L5 5 Lx\"/>".to_owned()),
        ("an axis that is none", "<path data-axis=\"nonsense\" data-width=\"wide\" d=\"M0 0H5V5z\"/>".to_owned()),
    ];
    let plain = Picture::from_svg(&svg_with("<path stroke=\"#000\" d=\"M0 0L9 9\"/>")).unwrap();
    let options = DiffOptions::default().with_pixels();
    for (what, text) in cases {
        let picture = Picture::from_svg(&svg_with(&text)).unwrap_or_else(|error| panic!("{what}: {error}"));
        assert!(diff::compare(&picture, &picture, &options).is_same(), "{what}");
        let told = diff::compare(&plain, &picture, &options);
        assert!(!told.findings.is_empty(), "{what}");
    }
}

/// Random byte mutations of golden drawings.
#[test]
fn mutated_drawings_never_panic() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden");
    let originals: Vec<Vec<u8>> = ["cubes.svg", "cubes-comic.svg", "ball-in-ring.svg"]
        .iter()
        .map(|name| std::fs::read(folder.join(name)).unwrap())
        .collect();
    let words: [&[u8]; 12] = [
        b"<g>",
        b"</g>",
        b"\"",
        b"/>",
        b"1e9",
        b"-",
        b"&#0;",
        b"<use href=\"#lines\"/>",
        b"nan",
        b"z",
        b"M",
        b"<style>*{",
    ];
    let mut dice = Dice::new(6);
    let mut read = 0;
    for round in 0..400 {
        let original = &originals[round % originals.len()];
        // The start of a large drawing is enough.
        let mut bytes = original[..original.len().min(6000)].to_vec();
        if original.len() > 6000 && dice.below(4) > 0 {
            let end = bytes.iter().rposition(|byte| *byte == b'\n').unwrap_or(0);
            bytes.truncate(end);
            bytes.extend_from_slice(b"</g></svg>");
        }
        for _ in 0..1 + dice.below(4) {
            let at = dice.below(bytes.len());
            match dice.below(4) {
                0 => bytes[at] = dice.below(256) as u8,
                1 => drop(bytes.remove(at)),
                2 => bytes.truncate(at.max(1)),
                _ => {
                    let word = words[dice.below(words.len())];
                    bytes.splice(at..at, word.iter().copied());
                }
            }
        }
        let before = String::from_utf8_lossy(original).into_owned();
        if let Ok(picture) = Picture::from_svg(&String::from_utf8_lossy(&bytes)) {
            read += 1;
            let told = diff::compare(&Picture::from_svg(&before).unwrap(), &picture, &DiffOptions::default());
            let _ = (told.to_json(), told.to_markdown("mutated"), told.lines());
            let _ = told.picture(View::SideBySide);
        }
    }
    assert!(read > 40, "{read} of 400 were read");
}

/// A naive matcher searches all ancestors again for each step of a selector, with combinatorial cost.
#[test]
fn deep_descendant_selectors_are_matched_in_bounded_time() {
    let groups = |count: usize, inner: &str| "<g>".repeat(count) + inner + &"</g>".repeat(count);
    let path = "<path stroke=\"#000\" d=\"M0 0L9 9\"/>";
    for (rules, count) in [(1, 60), (2000, 200)] {
        let sheet = format!("x {}path{{stroke:red}}", "g ".repeat(40)).repeat(rules);
        let svg = svg_with(&format!("<style>{sheet} g g path{{stroke:#00f}}</style>{}", groups(count, path)));
        let picture = Picture::from_svg(&svg).unwrap();
        assert_eq!(picture.shapes.last().unwrap().ink.paint.to_string(), "#0000ff");
        let again = Picture::from_svg(&svg.replace("M0 0", "M0 1")).unwrap();
        let told = diff::compare(&picture, &again, &DiffOptions::default().with_pixels());
        assert!(told.pixels.is_some_and(|pixels| pixels.differing > 0));
        assert!(ligne::diff::canonical_svg(&svg, None).is_ok());
    }
    let many = format!("<style>{}</style>{}", "*{fill:red}".repeat(20_000), path.repeat(20_000));
    let told = refusal(&svg_with(&many)).unwrap();
    assert!(told.contains("style rules"), "{told}");
}

/// Repeated declarations, which take quadratic time in a naive reader.
#[test]
fn repeated_declarations_are_read_in_bounded_time() {
    let paths = "<path stroke=\"#000\" d=\"M0 0L9 9\"/>".repeat(1000);
    let own = format!("<g style=\"{}\">{paths}</g>", "stroke:red;stroke:#00f;".repeat(100_000));
    let sheets = format!("<style>{}</style>{paths}", "path{stroke:#00f}".repeat(1000));
    for text in [own, sheets] {
        let picture = Picture::from_svg(&svg_with(&text)).unwrap();
        assert!(picture.shapes.len() >= 1000);
    }
    let names: String = (0..50_000).map(|i| format!("p{i}:1;")).collect();
    let told = refusal(&svg_with(&format!("<g style=\"{names}\">{paths}</g>"))).unwrap();
    assert!(told.contains("declarations in a style") && told.contains(';'), "{told}");
}

/// Thousands of coincident or nearly coincident paths, which a naive comparison matches pairwise.
#[test]
fn coincident_paths_are_compared_in_bounded_time() {
    let many = |d: &dyn Fn(usize) -> String, colour: &str| {
        let paths: String = (0..10_000).map(|i| format!("<path d=\"{}\"/>", d(i))).collect();
        svg_with(&format!("<g fill=\"none\" stroke=\"{colour}\">{paths}</g>"))
    };
    let read = |svg: &str| Picture::from_svg(svg).unwrap();
    let same = |_: usize| "M10 10L60 40 90 20".to_owned();
    let near = |i: usize| format!("M10 10L60 40 90 20.{i:05}");
    let moved = |_: usize| "M10 12L60 42 90 22".to_owned();
    let before = read(&many(&same, "#000"));
    let told = |after: &str| diff::compare(&before, &read(after), &DiffOptions::default());
    assert_eq!(told(&many(&same, "#c00")).summary(), "10000 restyled");
    assert!(told(&many(&moved, "#000")).summary().starts_with("10000 moved"));
    _ = told(&many(&near, "#000"));
    // Two bundles of lines that all differ, and a bundle of equal lines of another shape.
    let after = |i: usize| format!("M10 12L60 42 90 22.{i:05}");
    let bent = |_: usize| "M10 10L60 45 90 20".to_owned();
    let bundle = read(&many(&near, "#000"));
    let told = |other: &str| diff::compare(&bundle, &read(other), &DiffOptions::default());
    assert!(told(&many(&after, "#000")).summary().starts_with("10000 moved"));
    assert_eq!(told(&many(&bent, "#000")).summary(), "10000 removed, 10000 added");
}
