//! Hatching together with fills: separate cast shadows, horizontal strokes on flat faces, white lines in
//! black areas, and colours.

use crate::library::support::pipeline;
use crate::library::support::styled::{fitted_camera, page_of_camera, style_with};
use std::collections::BTreeMap;

use crate::library::support::scenes::solids::{Solid, cuboid};
use glam::DVec3;
use ligne::colour::srgb::Colour;
use ligne::drawing::{LayerKind, Paint};
use ligne::pipeline::Renderer;
use ligne::scene::{Camera, Geometry, NamedView, Scene};
use ligne::{Drawing, Style};

/// A pillar on a floor, under a light high on the left.
fn pillar(sets: &[&str]) -> Drawing {
    let floor = cuboid(DVec3::new(-4.0, -0.2, -4.0), DVec3::new(4.0, 0.0, 4.0));
    let pillar = cuboid(DVec3::new(-0.5, 0.0, -0.5), DVec3::new(0.5, 3.0, 0.5));
    let scene = pipeline::scene([floor, pillar]);
    let light = "light.sources=[{kind=\"directional\", direction=[-1, 1, 0.4]}]";
    let style = style_with("comic", &[&[light], sets].concat());
    ligne::render(&scene, &fitted_camera(&scene), &style).unwrap()
}

/// Total area of the marks of a layer kind.
fn area(drawing: &Drawing, kind: LayerKind) -> f64 {
    let marks = drawing.layers.iter().filter(|layer| layer.kind == kind).flat_map(|layer| &layer.marks);
    marks.map(|mark| kurbo::Shape::area(&mark.path).abs()).sum()
}

#[test]
fn fills_and_hatching_have_separate_cast_shadows() {
    let switches = |fills: bool, hatching: bool| {
        let sets = [format!("fills.cast_shadows={fills}"), format!("hatching.cast_shadows={hatching}")];
        let drawing = pillar(&[&sets[0], &sets[1]]);
        (area(&drawing, LayerKind::Shadows), area(&drawing, LayerKind::Hatching))
    };
    let ((both, hatched), (painted, plain)) = (switches(true, true), switches(true, false));
    let ((none, hatched_alone), (off, least)) = (switches(false, true), switches(false, false));
    assert!(both > 2000.0 && (painted - both).abs() < 0.01 * both, "{both} {painted}");
    assert_eq!((none, off), (0.0, 0.0));
    assert!(hatched > plain + 2000.0, "{hatched} {plain}");
    assert!((plain - least).abs() < 0.01 * least, "{plain} {least}");
    assert!((hatched - hatched_alone).abs() < 0.01 * hatched, "{hatched} {hatched_alone}");
}

/// A wall in one sheet. Its upper part leans back slightly, and each part has its own normal.
fn leaning_wall() -> Scene {
    let positions = [(0.0, 0.0), (2.0, 0.0), (3.0, -0.45)]
        .into_iter()
        .flat_map(|(y, z)| [DVec3::new(-1.5, y, z), DVec3::new(1.5, y, z)])
        .collect();
    let geometry = Geometry {
        positions,
        triangles: vec![[0, 1, 3], [0, 3, 2], [2, 3, 5], [2, 5, 4]],
        normals: vec![[0.0, 0.0, 1.0], [0.0, 0.45, 1.0]],
        corner_normals: vec![[0; 3], [0; 3], [1; 3], [1; 3]],
        ..Geometry::default()
    };
    pipeline::scene_of_geometries(vec![geometry])
}

#[test]
fn flat_faces_have_horizontal_hatching() {
    let scene = leaning_wall();
    let camera = Camera::named(NamedView::Front, scene.up).fit(&scene);
    for name in ["engraving", "woodcut"] {
        // Light from the side and above, so that every part is hatched.
        let light = "light.sources=[{kind=\"directional\", direction=[-1, 0.5, 0.3]}]";
        let style = style_with(name, &[light]);
        let (_, layers) =
            Renderer::new(&scene, &style).hatch_strokes(&camera, page_of_camera(&camera)).expect("hatching");
        let (mut whole, mut level) = (0.0, 0.0);
        for stroke in layers.iter().flat_map(|layer| &layer.strokes) {
            for pair in stroke.points.windows(2) {
                let way = pair[1] - pair[0];
                whole += way.hypot();
                level += if way.y.abs() <= 0.02 * way.x.abs() { way.hypot() } else { 0.0 };
            }
        }
        assert!(whole > 10_000.0, "{name}: {whole}");
        assert!(level > 0.99 * whole, "{name}: {level} of {whole} px are level");
    }
}

/// Number of lines in a colour, by class.
fn lines_in(drawing: &Drawing, wanted: Colour) -> BTreeMap<&'static str, usize> {
    let layers = drawing.layers.iter().filter(|layer| layer.kind == LayerKind::Lines);
    let mut count = BTreeMap::new();
    for mark in layers.flat_map(|layer| &layer.marks) {
        let colour = match &mark.paint {
            Paint::Stroke(stroke) => stroke.colour,
            Paint::Outline(outline) => outline.colour,
            Paint::Fill(colour) => *colour,
            Paint::Image(_) => panic!("a picture"),
            Paint::Gradient(_) => panic!("hatching has one colour"),
        };
        if colour == wanted {
            *count.entry(mark.provenance.classes[0]).or_default() += 1;
        }
    }
    count
}

#[test]
fn white_lines_appear_only_between_black_areas() {
    let unit = cuboid(DVec3::ZERO, DVec3::ONE);
    let (scene, paper) = (pipeline::scene([unit]), Colour::WHITE);
    let from = |direction: &str, more: &[&str]| {
        let light =
            format!("light.sources=[{{kind=\"directional\", direction={direction}, space=\"camera\"}}]");
        let sets = [&["pen.colour=\"#101014\"", &light], more].concat();
        ligne::render(&scene, &fitted_camera(&scene), &style_with("comic", &sets)).unwrap()
    };
    // Lit from behind, all three sides are black. Two of the three edges between them form one line.
    let dark = from("[0, 0, -1]", &[]);
    assert_eq!(lines_in(&dark, paper), BTreeMap::from([("crease", 2)]));
    assert!(lines_in(&dark, Colour::rgb(0x10, 0x10, 0x14)).contains_key("contour"));
    // `hatching.parting` scales their width relative to ink, and 0 removes them.
    let width = |drawing: &Drawing| {
        let marks = drawing.layers.iter().flat_map(|layer| &layer.marks);
        let widths = marks.filter_map(|mark| match &mark.paint {
            Paint::Outline(line) if line.colour == paper => Some(line.width),
            _ => None,
        });
        widths.fold(0.0, f64::max)
    };
    let plain = "pen.swell={taper=0, bend=0, lit=0}";
    let (half, whole) = (["hatching.parting=0.5", plain], ["hatching.parting=1", plain]);
    assert!((width(&from("[0, 0, -1]", &half)) - 0.9).abs() < 0.02);
    assert!((width(&from("[0, 0, -1]", &whole)) - 1.8).abs() < 0.02);
    assert!(lines_in(&from("[0, 0, -1]", &["hatching.parting=0"]), paper).is_empty());
    // In full light nothing is black, so no line is white.
    assert!(lines_in(&from("[0, 0.2, 1]", &[]), paper).is_empty());
    // The same holds for black fills (`noir`) and for pens without hand-drawn effects (`woodcut`).
    let noir = style_with(
        "noir",
        &["light.sources=[{kind=\"directional\", direction=[0, 0, -1], space=\"camera\"}]"],
    );
    let noir = ligne::render(&scene, &fitted_camera(&scene), &noir).unwrap();
    assert_eq!(lines_in(&noir, paper), BTreeMap::from([("crease", 2)]));
    let sets =
        ["light.sources=[{kind=\"directional\", direction=[0, 0, -1], space=\"camera\"}]", "light.wrap=0"];
    let woodcut = ligne::render(&scene, &fitted_camera(&scene), &style_with("woodcut", &sets)).unwrap();
    assert_eq!(lines_in(&woodcut, paper), BTreeMap::from([("crease", 2)]));
}

#[test]
fn shaded_strokes_use_the_painted_colour() {
    let Solid { positions, triangles } = cuboid(DVec3::ZERO, DVec3::ONE);
    let colours = vec![[1.0, 0.0, 0.0, 1.0]; positions.len()];
    let geometry = Geometry { positions, triangles, colours, ..Geometry::default() };
    let scene = pipeline::scene_of_geometries(vec![geometry]);
    let style = Style::from_toml(
        "[pen]\ncolour = { shade = 0.5 }\n[hatching]\nenabled = true\ncoverage = [0.5, 0.4, 0.3, 0.2]\n\
         [[hatching.layer]]\ncolour = { shade = 0.25 }\n",
    )
    .expect("a style");
    let drawing = ligne::render(&scene, &fitted_camera(&scene), &style).unwrap();
    for (kind, red) in [(LayerKind::Hatching, 64), (LayerKind::Lines, 128)] {
        let layer = drawing.layers.iter().find(|layer| layer.kind == kind).expect("a layer");
        for mark in &layer.marks {
            let Paint::Stroke(stroke) = &mark.paint else { panic!("no plain stroke: {mark:?}") };
            assert_eq!(stroke.colour, Colour::rgb(red, 0, 0), "{kind:?}");
        }
    }
}
