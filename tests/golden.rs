//! Golden drawings: small drawings that must not change unnoticed.
//!
//! After a change that is meant, look at what differs and renew them with
//! `LIGNE_BLESS=1 cargo test --test golden`; that is refused where `CI` is set.

#[path = "support/pipeline.rs"]
mod pipeline;
#[path = "support/solids.rs"]
mod solids;

use std::path::{Path, PathBuf};

use glam::DVec3;
use ligne::export::SvgOptions;
use ligne::render::render;
use ligne::scene::{Camera, Scene};
use ligne::style::Style;
use pipeline::scene;
use solids::{cuboid, sphere, torus};

fn golden(name: &str, scene: &Scene, style: &str) {
    let mut camera = Camera::three_quarter();
    (camera.width, camera.height) = (300.0, 300.0);
    let drawing = render(scene, &camera.fit(scene), &Style::preset(style).unwrap());
    let drawn = drawing.to_svg(&SvgOptions::default());
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden").join(format!("{name}.svg"));
    if std::env::var_os("LIGNE_BLESS").is_some() {
        assert!(std::env::var_os("CI").is_none(), "golden drawings are renewed by people, not by CI");
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, drawn).unwrap();
        return;
    }
    let wanted = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    if drawn != wanted {
        let beside = beside(&path);
        std::fs::write(&beside, &drawn).unwrap();
        panic!("{name} is drawn differently, see {}:\n{}", beside.display(), differences(&wanted, &drawn));
    }
}

/// Where a drawing that differs is kept for looking at.
fn beside(path: &Path) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    folder.join(path.file_name().unwrap_or_default())
}

/// A path of a drawing: what it is, where it runs.
struct Stroke {
    class: String,
    points: Vec<kurbo::Point>,
}

/// The paths of an SVG file as usvg reads them, with their curves flattened.
fn strokes(svg: &str) -> Vec<Stroke> {
    fn gather(group: &usvg::Group, found: &mut Vec<Stroke>) {
        for node in group.children() {
            match node {
                usvg::Node::Group(inner) => gather(inner, found),
                usvg::Node::Path(path) => {
                    let mut points = Vec::new();
                    for segment in path.data().segments() {
                        use usvg::tiny_skia_path::PathSegment::{Close, CubicTo, LineTo, MoveTo, QuadTo};
                        match segment {
                            MoveTo(p) | LineTo(p) | QuadTo(_, p) | CubicTo(_, _, p) => {
                                points.push(kurbo::Point::new(p.x.into(), p.y.into()));
                            }
                            Close => points.extend(points.first().copied()),
                        }
                    }
                    let width = path.stroke().map_or(0.0, |s| s.width().get());
                    found.push(Stroke { class: format!("width {width:.2}"), points });
                }
                _ => {}
            }
        }
    }
    let tree = usvg::Tree::from_str(svg, &usvg::Options::default()).unwrap();
    let mut found = Vec::new();
    gather(tree.root(), &mut found);
    found
}

/// Which paths of the one have no like in the other.
fn differences(wanted: &str, drawn: &str) -> String {
    let (wanted, drawn) = (strokes(wanted), strokes(drawn));
    let mut lines = Vec::new();
    for (sign, ours, theirs) in [("gone", &wanted, &drawn), ("new", &drawn, &wanted)] {
        for stroke in ours {
            let nearest = theirs
                .iter()
                .filter(|other| other.class == stroke.class)
                .map(|other| apart(&stroke.points, &other.points))
                .fold(f64::INFINITY, f64::min);
            if nearest > 0.0 {
                let [start, end] = [stroke.points.first(), stroke.points.last()].map(|p| *p.unwrap());
                let count = stroke.points.len();
                lines.push(format!(
                    "{sign}: {} from {start} to {end}, {count} points, {nearest:.2} px from its like",
                    stroke.class
                ));
            }
        }
    }
    if lines.is_empty() {
        lines.push("all paths lie where they lay; order or attributes differ".to_owned());
    }
    lines.join("\n")
}

/// The largest distance of a point of the one from the nearest point of the other.
fn apart(one: &[kurbo::Point], other: &[kurbo::Point]) -> f64 {
    let from = |p: &kurbo::Point| other.iter().map(|q| (*q - *p).hypot2()).fold(f64::INFINITY, f64::min);
    one.iter().map(from).fold(0.0, f64::max).sqrt()
}

#[test]
fn cubes() {
    let large = cuboid(DVec3::splat(-1.0), DVec3::ONE);
    let small = cuboid(DVec3::new(0.4, 0.2, 0.6), DVec3::new(1.7, 1.4, 1.9));
    golden("cubes", &scene([large.clone(), small.clone()]), "ink");
    golden("cubes-technical", &scene([large, small]), "technical");
}

#[test]
fn ball_in_ring() {
    golden("ball-in-ring", &scene([torus(48, 24, 1.0, 0.3), sphere(16, 0.8)]), "ink");
}

fn example(name: &str) -> Scene {
    Scene::open(Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models").join(name)).unwrap()
}

#[test]
fn gear() {
    golden("gear", &example("gear.obj"), "ink");
}

#[test]
fn teapot_in_two_tones() {
    golden("teapot-toon", &example("teapot.obj"), "toon");
}

#[test]
fn knot_with_cast_shadows() {
    golden("knot-comic-flats", &example("knot.ply"), "comic-flats");
}

#[test]
fn teapot_in_pencil() {
    golden("teapot-pencil-plain", &example("teapot.obj"), "pencil-plain");
}

#[test]
fn cubes_as_patent_and_comic() {
    let cubes =
        || [cuboid(DVec3::ZERO, DVec3::ONE), cuboid(DVec3::new(1.2, 0.0, 0.3), DVec3::new(1.7, 0.6, 0.8))];
    golden("cubes-patent", &scene(cubes()), "patent");
    golden("cubes-comic", &scene(cubes()), "comic");
}

#[test]
fn a_difference_is_told_by_its_path() {
    let svg = |d: &str| {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"9\" height=\"9\"><path d=\"M1 1L8 1\" stroke=\"#000\"/><path d=\"{d}\" stroke=\"#000\"/></svg>"
        )
    };
    let told = differences(&svg("M1 2L8 2"), &svg("M1 2L8 5"));
    assert!(told.contains("gone: width 1.00 from (1, 2) to (8, 2)"), "{told}");
    assert!(told.contains("new: width 1.00 from (1, 2) to (8, 5)") && told.lines().count() == 2, "{told}");
}
