//! The canonical form of drawings: what is drawn is in it, other ways of writing a drawing come back to it, pictures stay
//! the same, and small changes stay small.

use std::fs;
use std::path::PathBuf;

use crate::support::pipeline::scene;
use crate::support::solids::{cuboid, sphere, torus};
use glam::DVec3;
use kurbo::{BezPath, ParamCurve as _, PathEl, Point};
use ligne::diff::{DiffOptions, Finding, Picture, PixelDiff, canonical_svg, compare};
use ligne::drawing::Drawing;
use ligne::export::{Grouping, SvgOptions};
use ligne::render::render;
use ligne::scene::{Camera, Scene};
use ligne::style::Style;

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn drawn(scene: &Scene, style: &str) -> Drawing {
    let mut camera = Camera::three_quarter();
    (camera.width, camera.height) = (260.0, 220.0);
    render(scene, &camera.fit(scene), &Style::preset(style).unwrap()).unwrap()
}

/// Drawings of each kind: lines, hidden lines, fills, outlines, hatching, the order of a plotter.
fn drawings() -> Vec<(String, Drawing)> {
    let example = |name: &str| Scene::open(root().join("examples/models").join(name)).unwrap();
    let solids = || {
        let cubes =
            [cuboid(DVec3::ZERO, DVec3::ONE), cuboid(DVec3::new(0.4, 0.2, 0.6), DVec3::new(1.7, 1.4, 1.9))];
        scene([cubes[0].clone(), cubes[1].clone(), torus(48, 24, 1.0, 0.3), sphere(16, 0.8)])
    };
    let models = [
        ("gear.obj", example("gear.obj"), vec!["ink", "technical", "plotter"]),
        ("pump.glb", example("pump.glb"), vec!["toon", "comic", "technical"]),
        ("solids", solids(), vec!["ink", "pencil-plain", "comic", "sketch", "patent", "plotter", "noir"]),
    ];
    let mut all = Vec::new();
    for (name, scene, styles) in models {
        for style in styles {
            all.push((format!("{name} in {style}"), drawn(&scene, style)));
        }
    }
    all
}

fn form(svg: &str) -> String {
    canonical_svg(svg, None).unwrap_or_else(|error| panic!("{error}\n{svg}"))
}

/// The first lines that differ, for messages.
fn parting(a: &str, b: &str) -> String {
    let differ = a.lines().zip(b.lines()).enumerate().find(|(_, (a, b))| a != b);
    differ.map_or("lengths differ".to_owned(), |(at, (a, b))| format!("line {}:\n{a}\n{b}", at + 1))
}

#[track_caller]
fn assert_text(found: &str, wanted: &str, name: &str) {
    assert!(found == wanted, "{name}: {}", parting(found, wanted));
}

#[track_caller]
fn assert_same_picture(a: &str, b: &str, name: &str) {
    let [a, b] = [a, b].map(|svg| Picture::from_svg(svg).unwrap_or_else(|error| panic!("{name}: {error}")));
    let diff = compare(&a, &b, &DiffOptions::default().with_pixels());
    // Where outlines of several rings begin elsewhere, their widths are told apart; pixels tell whether they are.
    let wide = |finding: &Finding| finding.changes.iter().all(|change| change.what == "width along the line");
    let finding = diff.findings.iter().find(|finding| finding.changes.is_empty() || !wide(finding));
    assert!(finding.is_none(), "{name}: {finding:?}");
    // Renderers blend lines that run the other way round a little differently, and caps where a curve begins with a
    // control point at its end.
    let few =
        |pixels: PixelDiff| pixels.differing * 2000 <= u64::from(pixels.width) * u64::from(pixels.height);
    assert!(diff.pixels.is_none_or(few), "{name}: {:?}", diff.pixels);
}

#[test]
fn what_is_drawn_is_in_the_form() {
    for (name, drawing) in drawings() {
        for precision in (0..=8).map(Some).chain([None]) {
            for group in [Grouping::Layer, Grouping::Part] {
                let options = SvgOptions::default().grouped_by(group);
                let options = precision.map_or(options.clone(), |decimals| options.with_precision(decimals));
                let svg = drawing.to_svg(&options);
                assert_text(&form(&svg), &svg, &format!("{name}, {options:?}"));
                if let Some(precision) = precision {
                    let named = canonical_svg(&svg, Some(precision)).unwrap();
                    assert_text(&named, &svg, &format!("{name}, {options:?}, precision given"));
                }
            }
        }
    }
}

/// A drawing as another program might have written it: neighbours with the same paint the other way round, lines
/// backwards, rings begun elsewhere, and absolute numbers.
fn otherwise(svg: &str, decimals: usize) -> String {
    let paint = |line: &str| {
        let word =
            |name: &str| line.split(&format!(" {name}=\"")).nth(1).and_then(|rest| rest.split('"').next());
        [
            "fill",
            "fill-opacity",
            "stroke",
            "stroke-opacity",
            "stroke-width",
            "stroke-linecap",
            "stroke-linejoin",
        ]
        .map(|name| word(name).map(str::to_owned))
    };
    let mut filled = vec![true];
    let mut lines: Vec<(String, Option<[Option<String>; 7]>)> = Vec::new();
    for line in svg.lines() {
        let around = *filled.last().unwrap();
        let fill = |line: &str| paint(line)[0].as_ref().map_or(around, |fill| fill != "none");
        if line.starts_with("<g") {
            filled.push(fill(line));
        } else if line.starts_with("</g") {
            filled.pop();
        }
        if line.starts_with("<path") {
            let (fill, dashed) = (fill(line), line.contains("dasharray"));
            let mut line = rewritten(
                line,
                " d=\"",
                |path| match (fill, dashed) {
                    (_, true) => path.clone(),
                    (true, false) => path_turned(path, false),
                    (false, false) => path_turned(path, true),
                },
                decimals,
            );
            line = rewritten(&line, " data-axis=\"", |path| path_turned(path, true), decimals);
            let key = paint(&line);
            lines.push((line, Some(key)));
        } else {
            lines.push((line.to_owned(), None));
        }
    }
    let mut out = String::new();
    for run in lines.chunk_by(|a, b| a.1.is_some() && a.1 == b.1) {
        // Not just backwards: every third one first.
        let mixed = (0..3).flat_map(|rest| run.iter().skip(rest).step_by(3)).rev();
        mixed.for_each(|(line, _)| out += &format!("{line}\n"));
    }
    out
}

fn rewritten(line: &str, open: &str, change: impl Fn(&BezPath) -> BezPath, decimals: usize) -> String {
    let Some((before, rest)) = line.split_once(open) else { return line.to_owned() };
    let (data, after) = rest.split_once('"').unwrap();
    let path = change(&BezPath::from_svg(data).unwrap());
    let point = |p: Point| format!("{:.decimals$},{:.decimals$}", p.x, p.y);
    let data: String = path
        .elements()
        .iter()
        .map(|element| match *element {
            PathEl::MoveTo(p) => format!("M {} ", point(p)),
            PathEl::LineTo(p) => format!("L {} ", point(p)),
            PathEl::QuadTo(a, p) => format!("Q {} {} ", point(a), point(p)),
            PathEl::CurveTo(a, b, p) => format!("C {} {} {} ", point(a), point(b), point(p)),
            PathEl::ClosePath => "Z ".to_owned(),
        })
        .collect();
    format!("{before}{open}{}\"{after}", data.trim_end())
}

/// Each closed subpath begun one piece later; with `reversed`, every subpath the other way round.
fn path_turned(path: &BezPath, reversed: bool) -> BezPath {
    let mut out = BezPath::new();
    let elements = path.elements();
    for subpath in elements.chunk_by(|_, next| !matches!(next, PathEl::MoveTo(_))) {
        let closed = matches!(subpath.last(), Some(PathEl::ClosePath));
        let mut pieces: Vec<kurbo::PathSeg> = BezPath::from_vec(subpath.to_vec())
            .segments()
            .filter(|piece| piece.start() != piece.end() || !matches!(piece, kurbo::PathSeg::Line(_)))
            .collect();
        if pieces.is_empty() {
            out.extend(subpath.iter().copied());
            continue;
        }
        if closed {
            pieces.rotate_left(1);
        }
        if reversed {
            pieces.reverse();
            pieces.iter_mut().for_each(|piece| *piece = piece.reverse());
        }
        out.move_to(pieces[0].start());
        pieces.iter().for_each(|piece| out.push(piece.as_path_el()));
        if closed {
            out.close_path();
        }
    }
    out
}

#[test]
fn other_ways_of_writing_come_back() {
    let mut changed = 0;
    for (name, drawing) in drawings() {
        if drawing.layers.iter().any(|layer| layer.ordered) {
            continue;
        }
        for (group, decimals) in [(Grouping::Layer, 2), (Grouping::Part, 4)] {
            let options = SvgOptions::default().with_precision(decimals).grouped_by(group);
            let svg = drawing.to_svg(&options);
            let other = otherwise(&svg, decimals.into());
            changed += usize::from(other.lines().zip(svg.lines()).filter(|(a, b)| a != b).count() > 5);
            // Numbers that end in zeros may have been all.
            assert_text(&canonical_svg(&other, Some(decimals)).unwrap(), &svg, &name);
            assert_same_picture(&other, &svg, &name);
        }
    }
    assert!(changed > 10, "{changed}");
}

#[test]
fn pictures_of_the_documents_stay_the_same() {
    let mut pictures = 0;
    for folder in ["docs/pictures", "tests/golden"] {
        for entry in fs::read_dir(root().join(folder)).unwrap().flatten() {
            let path = entry.path();
            if path.extension().is_none_or(|ending| ending != "svg") {
                continue;
            }
            let svg = fs::read_to_string(&path).unwrap();
            let name = path.display().to_string();
            let once = form(&svg);
            assert_text(&form(&once), &once, &name);
            let coarse = canonical_svg(&svg, Some(1)).unwrap();
            assert_text(&canonical_svg(&coarse, Some(1)).unwrap(), &coarse, &name);
            if svg.len() < 150_000 {
                assert_same_picture(&svg, &once, &name);
            }
            pictures += 1;
        }
    }
    assert!(pictures > 20, "{pictures}");
}

fn svg(inside: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"40\" height=\"40\">{inside}</svg>"
    )
}

/// Lines that would change places and begin elsewhere.
const TWO: &str = "<path d=\"M9 20L1 20\"/><path d=\"M9 10L1 10\"/>";
/// The same as they are rounded only, and in the form.
const ROUNDED: &str = "<path d=\"M9 20h-8\"/><path d=\"M9 10h-8\"/>";
const FORM: &str = "<path d=\"M1 10h8\"/><path d=\"M1 20h8\"/>";

#[test]
fn files_of_others_keep_what_may_make_a_difference() {
    let line = "fill=\"none\" stroke=\"#000\"";
    let lines = |paths: &str| format!("<g {line}>{paths}</g>");
    let as_it_is = |text: &str| (text.to_owned(), text.to_owned());
    let marked = "<marker id=\"m\"><path d=\"M0 0L1 0\"/></marker>";
    let cases: Vec<(String, String)> = vec![
        (lines(TWO), lines(FORM)),
        // Layout, comments, other attributes and quotes stay.
        (
            lines("\r\n  <path d='M9 20L1 20' id='a' class=\"x\"/>\n\t<path\n d='M9 10L1 10'></path>\n"),
            lines("\r\n  <path\n d='M1 10h8'></path>\n\t<path d='M1 20h8' id='a' class=\"x\"/>\n"),
        ),
        (
            lines("<path d=\"M9 20L1 20\"/><!-- a --><path d=\"M9 10L1 10\"/>"),
            lines("<path d=\"M1 20h8\"/><!-- a --><path d=\"M1 10h8\"/>"),
        ),
        // Different paint, other elements and other groups between.
        (
            lines("<path stroke=\"red\" d=\"M9 20L1 20\"/><path d=\"M9 10L1 10\"/>"),
            lines("<path stroke=\"red\" d=\"M1 20h8\"/><path d=\"M1 10h8\"/>"),
        ),
        (
            lines("<path d=\"M9 20L1 20\"/><rect width=\"2\" height=\"3\"/><path d=\"M9 10L1 10\"/>"),
            lines("<path d=\"M1 20h8\"/><rect width=\"2\" height=\"3\"/><path d=\"M1 10h8\"/>"),
        ),
        // Styles become attributes; what scripts may do, and sheets for some media, is not known.
        (format!("<g style=\"fill : none; stroke:#123\">{TWO}</g>"), format!("<g fill=\"none\" stroke=\"#123\">{FORM}</g>")),
        (
            format!("<style>path {{ stroke-dasharray: 3 }}</style>{}", lines(TWO)),
            // Dashed lines keep their directions, and may change places.
            lines("<path d=\"M9 10h-8\"/><path d=\"M9 20h-8\"/>").replace("<path", "<path stroke-dasharray=\"3\""),
        ),
        (
            format!("<style>g &gt; .a {{ stroke:red; fill:none !important }} path {{ stroke: blue }}</style><g><path class=\"a\" fill=\"#000\" stroke=\"#000\" style='stroke-width:2;fill:green' d=\"M1 1h2\"/>{TWO}</g>"),
            format!("<g><path stroke=\"red\" fill=\"none\" stroke-width=\"2\" class=\"a\" d=\"M1 1h2\"/>{}</g>", ROUNDED.replace("<path", "<path stroke=\"blue\"")),
        ),
        (
            format!("<style>@media print {{ path {{ stroke: red }} }}</style><g style=\"fill:none\">{TWO}</g>"),
            format!("<style>@media print {{ path {{ stroke: red }} }}</style><g style=\"fill:none\">{ROUNDED}</g>"),
        ),
        (
            format!("<style>path:hover {{ stroke: red }}</style><g style=\"fill:none\">{TWO}</g>"),
            format!("<style>path:hover {{ stroke: red }}</style><g style=\"fill:none\">{ROUNDED}</g>"),
        ),
        (
            format!("<g style=\"fill:none;stroke:#000;-inkscape-stroke:none\">{TWO}</g>"),
            format!("<g fill=\"none\" stroke=\"#000\" style=\"-inkscape-stroke:none\">{FORM}</g>"),
        ),
        (format!("<script>x</script>{}", lines(TWO)), format!("<script>x</script>{}", lines(ROUNDED))),
        (
            format!("<g style=\"fill:none;stroke:var(--ink)\">{TWO}</g>"),
            format!("<g style=\"fill:none;stroke:var(--ink)\">{ROUNDED}</g>"),
        ),
        // Two colours, and those that are not the same everywhere, do not change places.
        (
            "<path fill=\"red\" stroke=\"#000\" d=\"M5 5H9V9Z\"/><path fill=\"red\" stroke=\"#000\" d=\"M3 1H7V7Z\"/>".into(),
            "<path fill=\"red\" stroke=\"#000\" d=\"M5 5h4v4z\"/><path fill=\"red\" stroke=\"#000\" d=\"M3 1h4v6z\"/>".into(),
        ),
        (
            "<linearGradient id=\"g\"/><path fill=\"url(#g)\" d=\"M5 5H9V9Z\"/><path fill=\"url(#g)\" d=\"M3 1H7V7Z\"/>".into(),
            "<linearGradient id=\"g\"/><path fill=\"url(#g)\" d=\"M5 5h4v4z\"/><path fill=\"url(#g)\" d=\"M3 1h4v6z\"/>".into(),
        ),
        (
            "<path style=\"mix-blend-mode:difference\" d=\"M5 5H9V9Z\"/><path style=\"mix-blend-mode:difference\" d=\"M3 1H7V7Z\"/>".into(),
            "<path style=\"mix-blend-mode:difference\" d=\"M5 5h4v4z\"/><path style=\"mix-blend-mode:difference\" d=\"M3 1h4v6z\"/>".into(),
        ),
        // Holes stay holes; regions begin at their least point.
        ("<path d=\"M9 9V1H1V9ZM3 3V5H5V3Z\"/>".into(), "<path d=\"M1 1v8h8v-8zm2 2v2h2v-2z\"/>".into()),
        ("<path fill=\"red\" stroke=\"#000\" d=\"M9 9L1 1L9 1\"/>".into(), "<path fill=\"red\" stroke=\"#000\" d=\"M9 9l-8-8h8\"/>".into()),
        // Dashes begin where the path does.
        (
            lines("<path stroke-dasharray=\"2 1\" d=\"M9 20L1 20\"/>"),
            lines("<path stroke-dasharray=\"2 1\" d=\"M9 20h-8\"/>"),
        ),
        (
            format!("<g stroke-dasharray=\"2 1\">{}</g>", lines("<path stroke-dasharray=\"none\" d=\"M9 20L1 20\"/>")),
            format!("<g stroke-dasharray=\"2 1\">{}</g>", lines("<path stroke-dasharray=\"none\" d=\"M1 20h8\"/>")),
        ),
        // What is used elsewhere, bears markers or moves.
        (
            format!("<g id=\"a\">{}</g><use xlink:href=\"#a\" stroke-dasharray=\"2\"/>", lines(TWO)),
            format!("<g id=\"a\">{}</g><use xlink:href=\"#a\" stroke-dasharray=\"2\"/>", lines(ROUNDED)),
        ),
        (
            format!("{marked}<g marker-start=\"url(#m)\">{}</g>", lines(TWO)),
            format!("{}<g marker-start=\"url(#m)\">{}</g>", marked.replace("L1 0", "h1"), lines(ROUNDED)),
        ),
        as_it_is(&format!("{}<path marker-mid=\"url(#m)\" d=\"M9 20L1 20L1 20.0Z\"/>", marked.replace("L1 0", "h1"))),
        as_it_is(&format!("{}<path marker-mid=\"url(#m)\" d=\"M9 20L1 20L3 5L9 20Z\"/>", marked.replace("L1 0", "h1"))),
        (
            lines("<path d=\"M9 20L1 20\"><animate attributeName=\"d\" values=\"M9 20L1 20;M1 1L2 2\"/></path>"),
            lines("<path d=\"M9 20h-8\"><animate attributeName=\"d\" values=\"M9 20L1 20;M1 1L2 2\"/></path>"),
        ),
        (
            "<defs><path id=\"t\" d=\"M9 20L1 20\"/></defs><text><textPath href=\"#t\">x</textPath></text>".into(),
            "<defs><path id=\"t\" d=\"M9 20h-8\"/></defs><text><textPath href=\"#t\">x</textPath></text>".into(),
        ),
        (
            "<clipPath id=\"c\"><path fill=\"none\" stroke=\"#000\" d=\"M9 9V1H1V9ZM3 3V5H5V3Z\"/></clipPath>".into(),
            "<clipPath id=\"c\"><path fill=\"none\" stroke=\"#000\" d=\"M9 9v-8h-8v8zm-6-6v2h2v-2z\"/></clipPath>".into(),
        ),
        (
            format!("<switch {line}><path d=\"M9 20L1 20\"/><path d=\"M9 10L1 10\"/></switch>"),
            format!("<switch {line}><path d=\"M1 20h8\"/><path d=\"M1 10h8\"/></switch>"),
        ),
        // The order of a plotter.
        (format!("<g data-order=\"travel\">{}</g>", lines(TWO)), format!("<g data-order=\"travel\">{}</g>", lines(ROUNDED))),
        // Arcs and what is wrong stay, and do not keep others from their form.
        (
            lines("<path d=\"M9 20A4 4 0 0 1 1 20\"/><path d=\"M9 10L1 10\"/>"),
            lines("<path d=\"M1 10h8\"/><path d=\"M9 20A4 4 0 0 1 1 20\"/>"),
        ),
        as_it_is("<path d=\"\"/><path/><path d=\"M1 1 L 5 5 6\"/><path d=\"M9 20L 1\"/><path d=\"none\"/>"),
        as_it_is("<path d=\"M99999999.12345678 1L 5 5.12345678\"/>"),
        // A move that nothing is drawn from is no dot, and something of no length is.
        as_it_is(&lines("<path d=\"M3 3M9 20L1 20M5 5\"/>")),
        (lines("<path d=\"M3 3L3 3\"/>"), lines("<path d=\"M3 3h0\"/>")),
    ];
    for (before, after) in cases {
        let (before, after) = (svg(&before), svg(&after));
        let found = form(&before);
        assert_eq!(found, after, "of {before}");
        assert_eq!(form(&found), found);
        if !before.contains("99999999") {
            assert_same_picture(&before, &after, &before);
        }
    }
}

#[test]
fn declarations_and_entities_stay() {
    let declared = "<?xml version=\"1.0\"?>\n<!DOCTYPE svg [<!ENTITY ns \"http://x\"><!ENTITY two '<path d=\"M9 9L1 9\"/><path d=\"M9 1L1 1\"/>'>]>\n";
    let body = |paths: &str| {
        format!(
            "{declared}{}",
            svg(&format!("<g fill=\"none\" stroke=\"#000\" data-x=\"&ns;\">{paths}</g>\n<!-- end -->"))
                + "\n<!-- after -->\n"
        )
    };
    let before = body("&two;<path d=\"M9 20L1 20\"/> &two; <path d=\"M9&#32;10L1&#10;10\"/>");
    let after = body("&two;<path d=\"M1 20h8\"/> &two; <path d=\"M1 10h8\"/>");
    assert_eq!(form(&before), after);
    let marked = format!("\u{feff}{}", svg(TWO));
    assert_eq!(form(&marked), format!("\u{feff}{}", svg("<path d=\"M9 10h-8\"/><path d=\"M9 20h-8\"/>")));
}

/// Numbers without a pattern.
struct Random(u64);

impl Random {
    fn below(&mut self, n: u64) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0 % n
    }

    /// Coordinates meet often.
    fn number(&mut self) -> String {
        let digits = self.below(4) as usize;
        format!("{:.digits$}", self.below(40_000) as f64 / if self.below(3) == 0 { 1000.0 } else { 10_000.0 })
    }

    fn data(&mut self) -> String {
        let mut data = format!("M{} {}", self.number(), self.number());
        for _ in 0..self.below(7) {
            let letter = b"LLLHVCSQTZMlhvcsqtzm"[self.below(20) as usize];
            data.push(char::from(letter));
            let count = match letter.to_ascii_uppercase() {
                b'L' | b'T' | b'M' => 2,
                b'H' | b'V' => 1,
                b'C' => 6,
                b'S' | b'Q' => 4,
                _ => 0,
            };
            (0..count).for_each(|_| data += &format!("{} ", self.number()));
        }
        data
    }
}

#[test]
fn the_form_of_the_form_is_itself() {
    let mut random = Random(88_172_645_463_325_252);
    let paints = [
        "fill=\"none\" stroke=\"#000\" stroke-width=\".3\"",
        "fill=\"none\" stroke=\"#000\" stroke-opacity=\".5\" stroke-width=\".3\"",
        "fill=\"#a00\" fill-opacity=\".5\"",
        "fill=\"#a00\" fill-rule=\"evenodd\"",
        "fill=\"#a00\" stroke=\"#00a\" stroke-width=\".2\"",
        "fill=\"none\" stroke=\"#000\" stroke-width=\".2\" stroke-dasharray=\"1 .5\"",
        "style=\"fill:none;stroke:#00a;stroke-linecap:round;stroke-width:0.4\"",
    ];
    for round in 0..400 {
        let paths: String = (0..1 + random.below(12))
            .map(|_| {
                format!(
                    "<path {} d=\"{}\"/>\n",
                    paints[random.below(3) as usize + (round % 5)],
                    random.data()
                )
            })
            .collect();
        let before = svg(&paths)
            .replace("width=\"40\" height=\"40\"", "width=\"200\" height=\"200\" viewBox=\"0 0 8 8\"");
        for precision in [None, Some(3), Some(1), Some(8)] {
            let once = canonical_svg(&before, precision).unwrap();
            let twice = canonical_svg(&once, precision).unwrap();
            assert_eq!(once, twice, "{precision:?} {before}");
        }
        if round % 4 == 0 {
            assert_same_picture(&before, &canonical_svg(&before, Some(8)).unwrap(), &before);
        }
    }
}

/// How many lines of the one are not in the other, in order: those that a version control would show.
fn changed_lines(a: &str, b: &str) -> usize {
    let (a, b): (Vec<&str>, Vec<&str>) = (a.lines().collect(), b.lines().collect());
    let mut common = vec![0usize; b.len() + 1];
    for line in &a {
        let mut diagonal = 0;
        for (index, other) in b.iter().enumerate() {
            let above = common[index + 1];
            common[index + 1] = if line == other { diagonal + 1 } else { above.max(common[index]) };
            diagonal = above;
        }
    }
    a.len() + b.len() - 2 * common[b.len()]
}

#[test]
fn a_small_change_of_the_model_is_a_small_change_of_the_text() {
    let cube = |i: usize, side: f64| {
        let (x, y) = ((i % 6) as f64 * 2.0, (i / 6) as f64 * 2.0);
        cuboid(DVec3::new(x, y, 0.0), DVec3::new(x + side, y + side, side))
    };
    let named = |cubes: Vec<(usize, f64)>| {
        let mut scene = scene(cubes.iter().map(|(i, side)| cube(*i, *side)));
        scene.parts.iter_mut().zip(&cubes).for_each(|(part, (i, _))| part.name = format!("cube {i}"));
        scene
    };
    let cubes: Vec<(usize, f64)> = (0..36).map(|i| (i, 1.0)).collect();
    let mut camera = Camera::three_quarter();
    (camera.width, camera.height) = (600.0, 500.0);
    let camera = camera.fit(&named(cubes.clone()));
    let drawn = |cubes: &[(usize, f64)]| {
        render(&named(cubes.to_vec()), &camera, &Style::preset("ink").unwrap())
            .unwrap()
            .to_svg(&SvgOptions::default())
    };
    let before = drawn(&cubes);
    let all = before.lines().count();
    // Parts that are found in another order do not show.
    let mut changed = cubes;
    changed.reverse();
    assert_text(&drawn(&changed), &before, "the same parts in another order");
    // One that grows does, and little else.
    changed[15].1 = 1.2;
    let lines = changed_lines(&before, &drawn(&changed));
    assert!(lines > 0 && lines * 5 < all, "{lines} of {all} lines");
}
