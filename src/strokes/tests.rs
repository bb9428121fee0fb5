use super::*;
use std::sync::Arc;

use crate::chains::Sample;
use crate::lines::LineKind;
use crate::mesh::{MaterialId, PartId};
use crate::style::Style;
use kurbo::Point;

fn chain(kind: LineKind, x: f64) -> Chain {
    let points = vec![Point::new(x, 0.0), Point::new(x, 100.0)];
    let mut path = BezPath::new();
    path.move_to(points[0]);
    path.line_to(points[1]);
    Chain {
        samples: vec![Sample::new(1.0, 1.0); 2],
        points,
        closed: false,
        kind,
        silhouette: false,
        invisibility: 0,
        veiled: false,
        both_seen: false,
        part: PartId(0),
        material: MaterialId(0),
        smooth: false,
        covered: [false; 2],
        segment: 0,
        identity: 0,
        rest_cells: Arc::default(),
        path,
    }
}

fn layers(chains: &[Chain], style: &str, sets: &[&str]) -> Vec<Layer> {
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
    let style = Style::load_with(style, &sets).unwrap();
    let parts: Vec<Arc<str>> = vec!["body".into(), "bolt-1".into(), "".into()];
    let materials = [("steel".into(), Colour::rgb(100, 200, 50)), ("brass".into(), Colour::WHITE)];
    let context = InkContext {
        unit: Unit::Px,
        parts: &parts,
        materials: &materials,
        hidden: style.lines.hidden,
        behind_glass: 0.5,
        seed: style.seed,
        painted: false,
        depths: [1.0, 2.0],
        names: &[],
        parting: None,
        frame: None,
    };
    ink(chains, &context, &style.stroke)
}

fn stroke_paint(mark: &Mark) -> &StrokePaint {
    match &mark.paint {
        Paint::Stroke(stroke) => stroke,
        Paint::Fill(_) | Paint::Gradient(_) | Paint::Image(_) | Paint::Outline(_) => panic!("no stroke"),
    }
}

#[test]
fn silhouettes_are_painted_over_weaker_line_kinds() {
    let mut silhouette = chain(LineKind::Contour, 0.0);
    silhouette.silhouette = true;
    let chains = [
        silhouette,
        chain(LineKind::Contour, 1.0),
        chain(LineKind::Crease, 2.0),
        chain(LineKind::Wire, 3.0),
        chain(LineKind::Crease, 4.0),
    ];
    let layers = layers(&chains, "ink", &[]);
    assert_eq!(layers.len(), 1);
    assert_eq!(layers[0].kind, LayerKind::Lines);
    let order: Vec<f64> =
        layers[0].marks.iter().filter_map(|m| m.path.elements()[0].end_point()).map(|p| p.x).collect();
    assert_eq!(order, [3.0, 2.0, 4.0, 1.0, 0.0]);
    let widths: Vec<f64> = layers[0].marks.iter().map(|m| stroke_paint(m).width).collect();
    assert_eq!(widths, [0.8, 1.0, 1.0, 1.6, 2.2]);
    assert_eq!(layers[0].marks[4].provenance.classes, ["contour", "silhouette"]);
}

#[test]
fn hidden_lines_have_their_own_layer_behind() {
    let mut hidden = chain(LineKind::Crease, 0.0);
    hidden.invisibility = 2;
    let chains = [chain(LineKind::Crease, 1.0), hidden];
    assert_eq!(layers(&chains, "ink", &[]).len(), 1);
    let dashed = layers(&chains, "ink", &["lines.hidden=dashed"]);
    assert_eq!(dashed[0].kind, LayerKind::HiddenLines);
    assert_eq!(dashed[1].kind, LayerKind::Lines);
    assert_eq!(dashed[0].marks[0].provenance.invisibility, 2);
    assert_eq!(stroke_paint(&dashed[0].marks[0]).dash.len(), 2);
    let solid = layers(&chains, "ink", &["lines.hidden=solid"]);
    assert!(stroke_paint(&solid[0].marks[0]).dash.is_empty());
}

#[test]
fn technical_style_uses_thick_and_thin_line_widths() {
    let mut both = chain(LineKind::Crease, 0.0);
    both.both_seen = true;
    let layers = layers(&[both, chain(LineKind::Crease, 1.0), chain(LineKind::Wire, 2.0)], "technical", &[]);
    let widths: Vec<f64> =
        layers[0].marks.iter().map(|m| stroke_paint(m).width * crate::drawing::length::MM_PER_PX).collect();
    for (width, wanted) in widths.iter().zip([0.25, 0.25, 0.5]) {
        assert!((width - wanted).abs() < 1e-12, "{widths:?}");
    }
}

#[test]
fn rules_select_by_name_and_override_single_fields() {
    let mut bolt = chain(LineKind::Crease, 1.0);
    bolt.part = PartId(1);
    bolt.material = MaterialId(1);
    let sets = [
        "rule=[{when={part=\"bolt*\"}, pen={width=3, colour={shade=0.5}}}]",
        "rule=[{when={material=\"br?ss\"}, pen={opacity=0.5}}]",
    ];
    let layers = layers(&[chain(LineKind::Crease, 0.0), bolt], "ink", &sets);
    let pens: Vec<&StrokePaint> = layers[0].marks.iter().map(stroke_paint).collect();
    assert_eq!((pens[0].width, pens[0].colour), (1.0, Colour::rgb(26, 26, 26)));
    assert_eq!((pens[1].width, pens[1].colour), (3.0, Colour { r: 128, g: 128, b: 128, a: 128 }));
    assert_eq!(layers[0].marks[1].provenance.part.as_deref(), Some("bolt-1"));
    assert_eq!(layers[0].marks[1].provenance.material.as_deref(), Some("brass"));
}

#[test]
fn zero_width_pens_draw_nothing_and_unknown_ids_are_harmless() {
    assert!(layers(&[chain(LineKind::Crease, 0.0)], "ink", &["pen.crease.width=0"]).is_empty());
    let mut lost = chain(LineKind::Crease, 0.0);
    lost.part = PartId(9);
    lost.material = MaterialId(9);
    let found = layers(&[lost], "ink", &["pen.colour={shade=1}"]);
    assert_eq!(found[0].marks[0].provenance.part, None);
    assert_eq!(stroke_paint(&found[0].marks[0]).colour, Colour::BLACK);
}

#[test]
fn plotter_style_has_one_layer_per_pen() {
    let chains = [chain(LineKind::Crease, 0.0), chain(LineKind::Contour, 5.0), chain(LineKind::Crease, 2.0)];
    let one = layers(&chains, "plotter", &[]);
    assert_eq!(one.len(), 1);
    let starts: Vec<Point> = one[0].marks.iter().filter_map(|m| m.path.elements()[0].end_point()).collect();
    assert_eq!(starts, [Point::new(0.0, 0.0), Point::new(2.0, 100.0), Point::new(5.0, 0.0)]);
    let two = layers(&chains, "plotter", &["pen.contour.width=1"]);
    let labels: Vec<&str> = two.iter().filter_map(|layer| layer.pen.as_deref()).collect();
    assert_eq!(labels, ["1 1.323 px #000000", "2 1 px #000000"]);
}
