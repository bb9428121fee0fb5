//! Fill patterns lie in their tone only, with the set density, size and angle, against closed-form areas.

use std::f64::consts::PI;

use glam::DVec3;
use kurbo::{Point, Shape};
use ligne::drawing::{Drawing, LayerKind, Mark, Page, Paint, Unit};
use ligne::geometry::numbers::portable_math::{cos, sin};
use ligne::pipeline::{Renderer, render};
use ligne::scene::{Camera, Material, Scene};
use ligne::style::Style;

use crate::library::support::measures::line_picture::{flatten_path, sample_segments};
use crate::library::support::measures::segment_sets::total_length;
use crate::library::support::pipeline::{self, orthographic};
use crate::library::support::scenes::solids::cuboid;

fn style(patterns: &str) -> Style {
    let sets = [format!("fills.pattern=[{patterns}]")];
    Style::load_with("toon", &sets).unwrap_or_else(|error| panic!("{error}"))
}

/// Marks of a layer kind.
fn marks(drawing: &Drawing, kind: LayerKind) -> Vec<&Mark> {
    drawing.layers.iter().filter(|layer| layer.kind == kind).flat_map(|layer| &layer.marks).collect()
}

/// A cube of side 4, seen from the front at 100 px per unit.
fn wall() -> (Scene, Camera) {
    let mut scene = pipeline::scene([cuboid(DVec3::splat(-2.0), DVec3::splat(2.0))]);
    scene.materials = vec![Material { name: "wall".to_owned(), ..Material::default() }];
    scene.geometries[0].material = Some(0);
    let mut camera = orthographic(DVec3::new(0.0, 0.0, 9.0), DVec3::ZERO, 5.0);
    (camera.width, camera.height) = (500.0, 500.0);
    (scene, camera)
}

/// Number of sampled points of pattern ink by material, and how many of them lie outside their painted tone.
fn count_pattern_samples(patterns: &str, tones: [Option<u16>; 4]) -> ([usize; 4], usize) {
    let scene = Scene::open("examples/models/castle.obj").unwrap();
    let camera = Camera::three_quarter_of(scene.up).fit(&scene);
    let drawing = render(&scene, &camera, &style(patterns)).unwrap();
    let fills = marks(&drawing, LayerKind::Fills);
    // Topmost fill at a point.
    let at = |p: Point| fills.iter().rev().find(|fill| fill.path.contains(p)).map(|fill| &fill.provenance);
    let (mut asked, mut wrong) = ([0; 4], 0);
    let of =
        |name: &str| ["stone", "roof", "grass", "sandstone"].iter().position(|own| *own == name).unwrap();
    for mark in marks(&drawing, LayerKind::Hatching) {
        assert_eq!(mark.provenance.classes, ["pattern"]);
        let name = mark.provenance.material.as_deref().unwrap();
        let is_filled = matches!(mark.paint, Paint::Fill(_));
        for (p, _) in sample_segments(&flatten_path(&mark.path, 0.05), 25.0) {
            // For filled marks, a point next to the outline and inside it.
            let beside =
                [(0.8, 0.5), (-0.8, -0.5), (-0.5, 0.8), (0.5, -0.8)].map(|way| p + kurbo::Vec2::from(way));
            let inside = beside.into_iter().find(|p| !is_filled || mark.path.contains(*p));
            let Some(p) = inside.map(|inside| if is_filled { inside } else { p }) else { continue };
            // Borders of fills are fitted and reach slightly under their neighbours.
            let near = [(0., 0.), (1.2, 0.), (-1.2, 0.), (0., 1.2), (0., -1.2)];
            let tone = tones[of(name)];
            let fits = near.iter().any(|(x, y)| {
                at(p + kurbo::Vec2::new(*x, *y)).is_some_and(|fill| {
                    fill.material.as_deref() == Some(name) && tone.is_none_or(|tone| fill.tone == Some(tone))
                })
            });
            assert!(fits || is_filled, "{name} {p:?}");
            wrong += usize::from(!fits);
            asked[of(name)] += 1;
        }
    }
    (asked, wrong)
}

#[test]
fn patterns_lie_in_their_tone_and_nowhere_else() {
    let lines = "{ material = 'stone', tones = [0], kind = 'lines', size = 5, angle = 30 }, \
                 { material = 'roof', tones = [-1], kind = 'crosses', size = 7 }, \
                 { material = 'grass', kind = 'tile', path = 'M2 8L5 2L8 8', size = 11, angle = 10 }, \
                 { material = 'sand*', tones = [1], kind = 'lines', fixed = 'surface', size = 6 }";
    let (found, _) = count_pattern_samples(lines, [Some(0), Some(1), None, Some(1)]);
    assert!(found.iter().all(|count| *count > 30), "{found:?}");
    let filled = "{ material = 'stone', tones = [0], kind = 'tile', path = 'M1 1H8V8H1Z', fill = true, size = 9 }, \
                  { material = 'roof', tones = [-1], fixed = 'surface', size = 7, width = 5 }, \
                  { material = 'grass', kind = 'tile', path = 'M2 8L5 2L8 8', fixed = 'surface', size = 11 }, \
                  { material = 'sand*', tones = [1], kind = 'tile', path = 'M1 1H8L3 9Z', fill = true, fixed = 'surface', \
                    size = 6 }";
    let (found, wrong) = count_pattern_samples(filled, [Some(0), Some(1), None, Some(1)]);
    assert!(found.iter().all(|count| *count > 30), "{found:?}");
    // Slivers may be painted like their neighbours.
    assert!(100 * wrong <= found.iter().sum::<usize>(), "{wrong} of {found:?}");
}

#[test]
fn dots_and_lines_have_the_set_density_and_angle() {
    let (scene, camera) = wall();
    let side = 400.0;
    let drawing = render(&scene, &camera, &style("{ size = 10, width = 6, angle = 20 }")).unwrap();
    let dots = marks(&drawing, LayerKind::Hatching);
    let inked: f64 = dots.iter().map(|mark| mark.path.area().abs()).sum();
    let wanted = PI * 9.0 / 100.0 * side * side;
    assert!((inked / wanted - 1.0).abs() < 0.01, "{inked} {wanted}");
    for angle in [0.0_f64, 25.0, 90.0, -60.0] {
        let pattern = format!("{{ kind = 'lines', size = 8, width = 2, angle = {angle} }}");
        let drawing = render(&scene, &camera, &style(&pattern)).unwrap();
        let lines: Vec<[Point; 2]> = marks(&drawing, LayerKind::Hatching)
            .iter()
            .flat_map(|mark| flatten_path(&mark.path, 0.01))
            .collect();
        assert!((total_length(&lines) * 8.0 / (side * side) - 1.0).abs() < 0.02, "{angle}");
        for [a, b] in lines {
            // Angles run counter-clockwise on the page, with y down.
            let along = (b - a).normalize();
            let turn = kurbo::Vec2::new(cos(angle.to_radians()), -sin(angle.to_radians()));
            assert!(along.cross(turn).abs() < 1e-6, "{angle}");
            let row = a.to_vec2().dot(kurbo::Vec2::new(turn.y, -turn.x)) / 8.0;
            assert!((row - row.round()).abs() < 1e-6, "lines keep their place on the page");
        }
    }
}

#[test]
fn pattern_sizes_may_be_in_millimetres() {
    let (scene, mut camera) = wall();
    (camera.width, camera.height) = (100.0, 100.0);
    let page = Page { width: 100.0, height: 100.0, unit: Unit::Mm, background: None };
    let of = |pattern: &str| {
        let (drawing, _) = Renderer::new(&scene, &style(pattern)).draw(&camera, page).unwrap();
        let lines: Vec<[Point; 2]> = marks(&drawing, LayerKind::Hatching)
            .iter()
            .flat_map(|mark| flatten_path(&mark.path, 0.01))
            .collect();
        let widths: Vec<f64> = marks(&drawing, LayerKind::Hatching)
            .iter()
            .filter_map(|mark| match &mark.paint {
                Paint::Stroke(stroke) => Some(stroke.width),
                _ => None,
            })
            .collect();
        (total_length(&lines), widths[0])
    };
    let (lines, width) = of("{ kind = 'lines', size = '2mm', width = '0.3mm' }");
    assert!((lines - 80.0 * 40.0).abs() < 100.0 && (width - 0.3).abs() < 1e-9, "{lines} {width}");
}

#[test]
fn surface_patterns_turn_with_the_surface_and_page_patterns_do_not() {
    let (scene, camera) = wall();
    let count = |camera: &Camera, fixed: &str| {
        let pattern = format!("{{ kind = 'lines', size = 21, fixed = '{fixed}' }}");
        let drawing = render(&scene, camera, &style(&pattern)).unwrap();
        let marks = marks(&drawing, LayerKind::Hatching);
        marks
            .iter()
            .flat_map(|mark| mark.path.elements())
            .filter(|e| matches!(e, kurbo::PathEl::MoveTo(_)))
            .count()
    };
    // Camera rolled about its axis: the same face, turned on the page.
    let rolled = Camera { up: DVec3::new(0.4, 1.0, 0.0).normalize(), ..camera };
    assert_eq!(count(&camera, "surface"), count(&rolled, "surface"));
    assert!(count(&rolled, "page") > count(&camera, "page") + 3);
}

fn ink_area(scene: &Scene, camera: &Camera, pattern: &str) -> f64 {
    let drawing = render(scene, camera, &style(pattern)).unwrap();
    let marks = marks(&drawing, LayerKind::Hatching);
    // Shapes do not overlap, and holes have the opposite direction.
    marks.iter().map(|mark| mark.path.area()).sum::<f64>().abs()
}

#[test]
fn filled_tiles_cover_their_exact_area() {
    let (scene, camera) = wall();
    let folder = std::env::temp_dir().join(format!("ligne-tiles-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let [image, file] = ["tile.png", "tile.svg"].map(|name| folder.join(name));
    // Disc of radius 18 pixels in a tile of 48, with an edge one pixel soft.
    let disc = |k: u32| {
        let [x, y] = [k % 48, k / 48].map(|v| f64::from(v) + 0.5 - 24.0);
        (255.0 * ((x * x + y * y).sqrt() - 17.5).clamp(0.0, 1.0)).round() as u8
    };
    let mut encoder = png::Encoder::new(std::fs::File::create(&image).unwrap(), 48, 48);
    encoder.set_color(png::ColorType::Grayscale);
    let pixels: Vec<u8> = (0..48 * 48).map(disc).collect();
    encoder.write_header().unwrap().write_image_data(&pixels).unwrap();
    // A stroked ring, a square and a white corner, in a tile twice as wide as high.
    std::fs::write(
        &file,
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 40 20'><circle cx='10' cy='10' r='6' fill='none' \
         stroke='#111' stroke-width='2'/><path d='M24 4H36V16H24Z'/><path d='M0 0H5V5Z' fill='#fff'/></svg>",
    )
    .unwrap();
    let literal = |path: &std::path::Path| path.display().to_string().replace('\\', "/");
    let cases = [
        ("path = 'M2 2H8V8H2Z', fill = true".to_owned(), 0.36),
        // Reaches across its cell and joins its neighbours.
        ("path = 'M0 4H10V6H0Z', fill = true".to_owned(), 0.2),
        (format!("image = '{}'", literal(&image)), PI * 18.0 * 18.0 / (48.0 * 48.0)),
        (format!("file = '{}'", literal(&file)), (PI * (49.0 - 25.0) + 144.0) / 800.0),
    ];
    for (tile, covered) in cases {
        for angle in [0, 20] {
            for fixed in ["page", "surface"] {
                let pattern =
                    format!("{{ kind = 'tile', {tile}, size = 12.5, angle = {angle}, fixed = '{fixed}' }}");
                let part = ink_area(&scene, &camera, &pattern) / (400.0 * 400.0);
                assert!((part / covered - 1.0).abs() < 0.01, "{pattern}: {part} {covered}");
            }
        }
    }
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn surface_dots_are_foreshortened() {
    let (scene, _) = wall();
    // Two faces of the cube, each at 45 degrees to the view direction.
    let mut camera = orthographic(DVec3::new(9.0, 0.0, 9.0), DVec3::ZERO, 8.0);
    (camera.width, camera.height) = (500.0, 500.0);
    let seen = (4.0 * 2.0_f64.sqrt() * 4.0) * (500.0 / 8.0) * (500.0 / 8.0);
    // A face is 250 px wide, a whole number of rows. Its borders run between rows or through row centres.
    for rows in [25.0, 26.0] {
        let size = 250.0 / rows;
        let part =
            ink_area(&scene, &camera, &format!("{{ fixed = 'surface', size = {size}, width = 5 }}")) / seen;
        let wanted = PI * 2.5 * 2.5 / (size * size);
        assert!((part / wanted - 1.0).abs() < 0.01, "{rows}: {part} {wanted}");
    }
}

#[test]
fn surface_patterns_do_not_depend_on_world_orientation() {
    let (scene, camera) = wall();
    let turn = glam::DQuat::from_euler(glam::EulerRot::XYZ, 0.5, -0.8, 1.9);
    let tilted = Camera { eye: DVec3::new(4.0, 3.0, 8.0), ..camera };
    let mut turned = scene.clone();
    for part in &mut turned.parts {
        part.world_from_part = glam::DAffine3::from_quat(turn) * part.world_from_part;
    }
    let aside =
        Camera { eye: turn * tilted.eye, target: turn * tilted.target, up: turn * tilted.up, ..tilted };
    let drawn = |scene: &Scene, camera: &Camera| {
        let pattern = "{ fixed = 'surface', size = 30, width = 12, angle = 15 }";
        let drawing = render(scene, camera, &style(pattern)).unwrap();
        let mut middles: Vec<[i64; 2]> = Vec::new();
        for mark in marks(&drawing, LayerKind::Hatching) {
            for dot in mark.path.to_svg().split_inclusive('Z') {
                let middle = kurbo::BezPath::from_svg(dot).unwrap().bounding_box().center();
                middles.push([middle.x, middle.y].map(|v| (v * 100.0).round() as i64));
            }
        }
        middles.sort_unstable();
        middles
    };
    let (own, other) = (drawn(&scene, &tilted), drawn(&turned, &aside));
    assert!(own.len() > 60 && own.len() == other.len(), "{} {}", own.len(), other.len());
    // Clipped dots may differ slightly.
    let near = |p: &&[i64; 2]| other.iter().any(|q| (p[0] - q[0]).abs() <= 2 && (p[1] - q[1]).abs() <= 2);
    let same = own.iter().filter(near).count();
    assert!(same == own.len(), "{same} of {}", own.len());
}

#[test]
fn invalid_patterns_are_refused_by_name() {
    for (pattern, word) in [
        ("{ kind = 'spots' }", "kind"),
        ("{ size = 0 }", "size above 0"),
        ("{ kind = 'tile', path = 'M0 0 Q' }", "tile"),
        ("{ kind = 'tile', path = '' }", "no lines"),
        ("{ opacity = 2 }", "from 0 to 1"),
        ("{ tone = [1] }", "tones"),
        ("{ kind = 'tile', path = 'M0 0C1e300 0 1 1 2 2' }", "far outside"),
        ("{ kind = 'tile', path = 'M0 0C1e999 0 1 1 2 2', fill = true }", "tile"),
        ("{ kind = 'tile' }", "one of `path`"),
        ("{ kind = 'tile', path = 'M0 0H9', image = 'a.png' }", "one of `path`"),
        ("{ kind = 'tile', path = 'M0 0H9', fill = true }", "no dark area"),
        ("{ image = 'a.png' }", "kind"),
        ("{ kind = 'tile', image = 'lost.png' }", "lost.png"),
        ("{ kind = 'tile', file = 'Cargo.toml' }", "not SVG"),
    ] {
        let error =
            Style::load_with("toon", &[format!("fills.pattern=[{pattern}]")]).unwrap_err().to_string();
        assert!(error.contains(word), "{pattern}: {error}");
    }
}
