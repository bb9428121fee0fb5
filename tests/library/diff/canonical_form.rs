//! Canonical SVG form: it equals what the exporter writes, undoes equivalent rewrites, and keeps the picture.
//! A small change of the model changes few lines.

use std::fs;
use std::path::PathBuf;

use crate::library::support::measures::canonical_checks::{
    assert_same_picture, assert_same_text, canonical_form,
};
use crate::library::support::pipeline::scene;
use crate::library::support::scenes::solids::{cuboid, sphere, torus};
use glam::DVec3;
use kurbo::{BezPath, ParamCurve as _, PathEl, Point};
use ligne::diff::canonical_svg;
use ligne::drawing::Drawing;
use ligne::export::{Grouping, SvgOptions};
use ligne::pipeline::render;
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

/// Drawings with visible and hidden lines, fills, outlines, hatching and a plotter order.
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

#[test]
fn exported_svg_is_in_canonical_form() {
    for (name, drawing) in drawings() {
        for precision in (0..=8).map(Some).chain([None]) {
            for group in [Grouping::Layer, Grouping::Part] {
                let options = SvgOptions::default().grouped_by(group);
                let options = precision.map_or(options.clone(), |decimals| options.with_precision(decimals));
                let svg = drawing.to_svg(&options);
                assert_same_text(&canonical_form(&svg), &svg, &format!("{name}, {options:?}"));
                if let Some(precision) = precision {
                    let named = canonical_svg(&svg, Some(precision)).unwrap();
                    assert_same_text(&named, &svg, &format!("{name}, {options:?}, precision given"));
                }
            }
        }
    }
}

/// Rewrites an SVG as another program might: it shuffles neighbours with equal paint, reverses lines, starts
/// rings at another point, and writes absolute coordinates.
fn rewrite_equivalently(svg: &str, decimals: usize) -> String {
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
            let mut line = rewrite_path_attribute(
                line,
                " d=\"",
                |path| match (fill, dashed) {
                    (_, true) => path.clone(),
                    (true, false) => turn_subpaths(path, false),
                    (false, false) => turn_subpaths(path, true),
                },
                decimals,
            );
            line = rewrite_path_attribute(&line, " data-axis=\"", |path| turn_subpaths(path, true), decimals);
            let key = paint(&line);
            lines.push((line, Some(key)));
        } else {
            lines.push((line.to_owned(), None));
        }
    }
    let mut out = String::new();
    for run in lines.chunk_by(|a, b| a.1.is_some() && a.1 == b.1) {
        // Every third line first, then all reversed.
        let mixed = (0..3).flat_map(|rest| run.iter().skip(rest).step_by(3)).rev();
        mixed.for_each(|(line, _)| out += &format!("{line}\n"));
    }
    out
}

fn rewrite_path_attribute(
    line: &str,
    open: &str,
    change: impl Fn(&BezPath) -> BezPath,
    decimals: usize,
) -> String {
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

/// Starts each closed subpath one segment later. With `reversed`, it also reverses every subpath.
fn turn_subpaths(path: &BezPath, reversed: bool) -> BezPath {
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
fn equivalent_rewrites_have_the_same_canonical_form() {
    let mut changed = 0;
    for (name, drawing) in drawings() {
        if drawing.layers.iter().any(|layer| layer.ordered) {
            continue;
        }
        for (group, decimals) in [(Grouping::Layer, 2), (Grouping::Part, 4)] {
            let options = SvgOptions::default().with_precision(decimals).grouped_by(group);
            let svg = drawing.to_svg(&options);
            let other = rewrite_equivalently(&svg, decimals.into());
            changed += usize::from(other.lines().zip(svg.lines()).filter(|(a, b)| a != b).count() > 5);
            // The precision is given because it cannot be inferred if all numbers end in zero.
            assert_same_text(&canonical_svg(&other, Some(decimals)).unwrap(), &svg, &name);
            assert_same_picture(&other, &svg, &name);
        }
    }
    assert!(changed > 10, "{changed}");
}

#[test]
fn canonical_form_keeps_the_pictures_of_the_docs() {
    let mut pictures = 0;
    for folder in ["docs/pictures", "tests/golden"] {
        for entry in fs::read_dir(root().join(folder)).unwrap().flatten() {
            let path = entry.path();
            if path.extension().is_none_or(|ending| ending != "svg") {
                continue;
            }
            let svg = fs::read_to_string(&path).unwrap();
            let name = path.display().to_string();
            let once = canonical_form(&svg);
            assert_same_text(&canonical_form(&once), &once, &name);
            let coarse = canonical_svg(&svg, Some(1)).unwrap();
            assert_same_text(&canonical_svg(&coarse, Some(1)).unwrap(), &coarse, &name);
            if svg.len() < 150_000 {
                assert_same_picture(&svg, &once, &name);
            }
            pictures += 1;
        }
    }
    assert!(pictures > 20, "{pictures}");
}

/// Number of changed lines by longest common subsequence, as version control shows them.
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
fn small_model_changes_change_few_lines_of_svg() {
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
    // The order of parts does not change the text.
    let mut changed = cubes;
    changed.reverse();
    assert_same_text(&drawn(&changed), &before, "the same parts in another order");
    // A part that grows changes its own lines and few others.
    changed[15].1 = 1.2;
    let lines = changed_lines(&before, &drawn(&changed));
    assert!(lines > 0 && lines * 5 < all, "{lines} of {all} lines");
}
