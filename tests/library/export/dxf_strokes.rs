//! DXF files contain each stroke of the drawing once, as lines and arcs, checked with an independent reader.

use std::collections::BTreeSet;

use kurbo::{ParamCurve, ParamCurveNearest, Point, Shape};
use ligne::drawing::{Drawing, LayerKind, Paint};
use ligne::export::{DxfLength, DxfOptions, DxfVersion};
use ligne::{Camera, Scene, Style, render};

use crate::library::support::readers::dxf_reader::{entities, group_codes};

/// Entity of a DXF file as a dense polyline.
struct EntityPath {
    layer: String,
    part: Option<String>,
    points: Vec<Point>,
}

/// Points along a polyline segment with a DXF bulge.
fn bulge_points(from: Point, to: Point, bulge: f64) -> Vec<Point> {
    let steps = if bulge == 0.0 { 1 } else { 400 };
    let turn = 4.0 * kurbo::Vec2::new(1.0, bulge).atan2();
    let chord = to - from;
    let point = |k: i32| {
        let t = f64::from(k) / f64::from(steps);
        if bulge == 0.0 {
            return from.lerp(to, t);
        }
        let half = kurbo::Vec2::from_angle(turn / 2.0);
        let radius = chord.hypot() / 2.0 / half.y;
        let middle = from.midpoint(to);
        let centre = middle + kurbo::Vec2::new(-chord.y, chord.x) / chord.hypot() * radius * half.x;
        let angle = (from - centre).atan2() + turn * t;
        centre + radius.abs() * kurbo::Vec2::from_angle(angle)
    };
    (0..=steps).map(point).collect()
}

fn read_entity_paths(bytes: &[u8]) -> Vec<EntityPath> {
    let entities = entities(&group_codes(bytes));
    let mut inked: Vec<EntityPath> = Vec::new();
    let mut open: Vec<(Point, f64)> = Vec::new();
    let mut closed = false;
    let run = |corners: &[(Point, f64)], closed: bool| {
        let ends = corners.iter().skip(1).chain(corners.first().filter(|_| closed));
        corners
            .iter()
            .zip(ends)
            .flat_map(|((from, bulge), (to, _))| bulge_points(*from, *to, *bulge))
            .collect::<Vec<_>>()
    };
    for entity in &entities {
        let layer = entity.text(8).expect("a layer").to_owned();
        let part = entity.text(1000).map(str::to_owned);
        let at = |code| Point::new(entity.number(code), entity.number(code + 10));
        let points = match entity.kind.as_str() {
            "LINE" => vec![at(10), at(11)],
            "CIRCLE" => kurbo::Circle::new(at(10), entity.number(40))
                .to_path(1e-5)
                .segments()
                .flat_map(sample_curve)
                .collect(),
            "ARC" => {
                let sweep = (entity.number(51) - entity.number(50)).rem_euclid(360.0).to_radians();
                let arc = kurbo::Arc::new(
                    at(10),
                    (entity.number(40), entity.number(40)),
                    entity.number(50).to_radians(),
                    sweep,
                    0.0,
                );
                arc.to_path(1e-5).segments().flat_map(sample_curve).collect()
            }
            "LWPOLYLINE" => {
                let mut corners: Vec<(Point, f64)> = Vec::new();
                for (code, value) in &entity.pairs {
                    let number = || value.parse().expect("a number");
                    match code {
                        10 => corners.push((Point::new(number(), 0.0), 0.0)),
                        20 => corners.last_mut().expect("x").0.y = number(),
                        42 => corners.last_mut().expect("x").1 = number(),
                        _ => {}
                    }
                }
                run(&corners, entity.number(70) == 1.0)
            }
            "POLYLINE" => {
                (open, closed) = (Vec::new(), entity.number(70) == 1.0);
                inked.push(EntityPath { layer, part, points: Vec::new() });
                continue;
            }
            "VERTEX" => {
                open.push((at(10), entity.number(42)));
                continue;
            }
            "SEQEND" => {
                inked.last_mut().expect("a polyline").points = run(&open, closed);
                continue;
            }
            "HATCH" => continue,
            other => panic!("{other}"),
        };
        inked.push(EntityPath { layer, part, points });
    }
    inked
}

fn sample_curve(segment: kurbo::PathSeg) -> Vec<Point> {
    (0..=64).map(|k| segment.eval(f64::from(k) / 64.0)).collect()
}

fn length(points: &[Point]) -> f64 {
    points.windows(2).map(|pair| (pair[1] - pair[0]).hypot()).sum()
}

fn drawn(model: &str, style: &str) -> (Drawing, Camera) {
    let scene = Scene::open(model).expect("a model");
    let camera = Camera::named(ligne::scene::NamedView::Iso, scene.up).fit(&scene);
    let style = Style::load(style).expect("a style");
    (render(&scene, &camera, &style).expect("a drawing"), camera)
}

/// Layer kind and mark of each stroke of a drawing.
fn strokes(drawing: &Drawing) -> impl Iterator<Item = (LayerKind, &ligne::drawing::Mark)> {
    let marks = drawing.layers.iter().flat_map(|layer| layer.marks.iter().map(|mark| (layer.kind, mark)));
    marks.filter(|(_, mark)| matches!(mark.paint, Paint::Stroke(_)))
}

const MM_PER_PX: f64 = 25.4 / 96.0;

#[test]
fn dxf_contains_each_stroke_once_and_nothing_else() {
    for (model, style) in [
        ("examples/models/bracket.stl", "technical"),
        ("examples/models/gear.obj", "ink"),
        ("examples/models/teapot.obj", "ink"),
    ] {
        let (drawing, _) = drawn(model, style);
        for version in [DxfVersion::R12, DxfVersion::R2000] {
            let told = read_entity_paths(&drawing.to_dxf(&DxfOptions::default().with_version(version)));
            let wanted: f64 =
                strokes(&drawing).map(|(_, mark)| mark.path.perimeter(1e-4)).sum::<f64>() * MM_PER_PX;
            let found: f64 = told.iter().map(|one| length(&one.points)).sum();
            assert!((wanted - found).abs() < 2e-3 * wanted, "{model}: {wanted} mm drawn, {found} mm written");
            let paths: Vec<Vec<kurbo::PathSeg>> =
                strokes(&drawing).map(|(_, mark)| mark.path.segments().collect()).collect();
            for one in &told {
                // Each entity must lie on one single mark.
                let off = |path: &Vec<kurbo::PathSeg>| {
                    one.points
                        .iter()
                        .step_by(16)
                        .map(|p| {
                            let p = Point::new(p.x / MM_PER_PX, drawing.page.height - p.y / MM_PER_PX);
                            path.iter()
                                .map(|s| s.nearest(p, 1e-6).distance_sq)
                                .fold(f64::INFINITY, f64::min)
                                .sqrt()
                        })
                        .fold(0.0, f64::max)
                };
                // Polygons of the model may be written as circles, and chords run inside their circle.
                let is_near = |path: &Vec<kurbo::PathSeg>| {
                    let chords = path.iter().all(|segment| matches!(segment, kurbo::PathSeg::Line(_)));
                    off(path) < if chords { 0.45 } else { 0.16 }
                };
                assert!(paths.iter().any(is_near), "{model}: off any stroke");
            }
        }
    }
}

#[test]
fn dxf_curves_are_arcs_instead_of_chords() {
    // A gear seen along its axis, with circular holes.
    let scene = Scene::open("examples/models/gear.obj").expect("a gear");
    let camera = Camera::named(ligne::scene::NamedView::Top, scene.up).fit(&scene);
    let drawing = render(&scene, &camera, &Style::default().to_scale()).expect("a drawing");
    let dxf = drawing.to_dxf(&DxfOptions::default());
    let entities = entities(&group_codes(&dxf));
    let vertices = entities.iter().filter(|entity| entity.kind == "VERTEX").count();
    let elements: usize = strokes(&drawing).map(|(_, mark)| mark.path.elements().len()).sum();
    assert!(entities.iter().any(|entity| entity.kind == "CIRCLE"), "no circle");
    assert!(vertices < 3 * elements, "{vertices} corners of {elements} elements");
}

#[test]
fn dxf_lines_have_layers_by_kind_and_part_names() {
    let (drawing, _) = drawn("examples/models/pump.glb", "technical");
    let told = read_entity_paths(&drawing.to_dxf(&DxfOptions::default()));
    let layers: BTreeSet<&str> = told.iter().map(|one| one.layer.as_str()).collect();
    for layer in ["SILHOUETTE", "CREASE", "HIDDEN-CREASE"] {
        assert!(layers.contains(layer), "{layers:?}");
    }
    let parts: BTreeSet<&str> = told.iter().filter_map(|one| one.part.as_deref()).collect();
    assert!(parts.contains("terminal-box"), "{parts:?}");
    // Hidden lines have a line type with gaps, visible ones a continuous type.
    let bytes = drawing.to_dxf(&DxfOptions::default());
    let pairs = group_codes(&bytes);
    let type_of = |layer: &str| {
        let at = pairs
            .windows(2)
            .position(|pair| pair[0] == (0, "LAYER".to_owned()) && pair[1] == (2, layer.to_owned()));
        pairs[at.expect("a layer")..].iter().find(|pair| pair.0 == 6).expect("a type").1.clone()
    };
    assert_eq!(type_of("CREASE"), "CONTINUOUS");
    assert_eq!(type_of("HIDDEN-CREASE"), "HIDDEN-CREASE_DASHES");
}

#[test]
fn dxf_lengths_in_model_units_match_the_model() {
    let scene = Scene::open("examples/models/gear.obj").expect("a gear");
    let camera = Camera::named(ligne::scene::NamedView::Front, scene.up).fit(&scene);
    let drawing = render(&scene, &camera, &Style::default()).expect("a drawing");
    let ligne::scene::cameras::camera::Projection::Orthographic { height } = camera.projection else {
        panic!("parallel")
    };
    let options = DxfOptions::default().with_length(DxfLength::Model(camera.height / height));
    let told = read_entity_paths(&drawing.to_dxf(&options));
    let xs = || told.iter().flat_map(|one| one.points.iter().map(|point| point.x));
    let width = xs().fold(f64::NEG_INFINITY, f64::max) - xs().fold(f64::INFINITY, f64::min);
    let points = ligne::scene::cameras::framing::world_points(&scene);
    let across = |of: fn(&ligne::glam::DVec3) -> f64| {
        points.iter().map(of).fold(f64::NEG_INFINITY, f64::max)
            - points.iter().map(of).fold(f64::INFINITY, f64::min)
    };
    let wanted = across(|point| point.x);
    assert!((width - wanted).abs() < 1e-3 * wanted, "{width} written, {wanted} wide");
}

#[test]
fn fills_are_hatches_in_dxf_r2000_only() {
    let (drawing, _) = drawn("examples/models/gear.obj", "toon");
    let old = DxfOptions::default();
    let new = old.clone().with_version(DxfVersion::R2000);
    let fills = drawing
        .layers
        .iter()
        .flat_map(|layer| &layer.marks)
        .filter(|mark| matches!(mark.paint, Paint::Fill(_)));
    let fills = fills.count();
    assert!(fills > 0);
    let hatches = |options: &DxfOptions| {
        entities(&group_codes(&drawing.to_dxf(options))).iter().filter(|e| e.kind == "HATCH").count()
    };
    assert_eq!((hatches(&old), drawing.left_out_of_dxf(&old)), (0, fills));
    assert_eq!((hatches(&new), drawing.left_out_of_dxf(&new)), (fills, 0));
}

/// Handles are unique in the file and smaller than `$HANDSEED`.
#[test]
fn dxf_handles_are_unique() {
    let (drawing, _) = drawn("examples/models/pump.glb", "technical");
    let pairs = group_codes(&drawing.to_dxf(&DxfOptions::default().with_version(DxfVersion::R2000)));
    let mut seen = BTreeSet::new();
    let mut seed = String::new();
    for pair in pairs.windows(2) {
        if pair[0].1 == "$HANDSEED" {
            seed.clone_from(&pair[1].1);
        } else if (pair[1].0 == 5 || pair[1].0 == 105) && pair[0].1 != "$HANDSEED" {
            assert!(seen.insert(u32::from_str_radix(&pair[1].1, 16).expect("a handle")), "{}", pair[1].1);
        }
    }
    assert!(seen.last() < Some(&u32::from_str_radix(&seed, 16).expect("a seed")));
}
