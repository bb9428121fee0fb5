//! Circles and arcs on pages to scale and in DXF, against the circles of the model: no vertex is off by more
//! than 0.02 mm.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec3;
use kurbo::{ParamCurveNearest, Point};
use ligne::drawing::{Drawing, Page, Unit};
use ligne::export::{DxfLength, DxfOptions};
use ligne::geometry::numbers::portable_math::{cos, sin};
use ligne::load::ModelFormat;
use ligne::pipeline::Renderer;
use ligne::scene::Projection;
use ligne::{Camera, Scene, Style};

use crate::library::support::readers::dxf_reader::{Entity, entities, group_codes};
use crate::library::support::scenes::random_dice::Dice;
use crate::library::support::scenes::sheet_models::obj_text;
use crate::library::support::scenes::solids::Solid;

/// Planar outline with the centres and radii of its arcs.
#[derive(Clone)]
struct Outline {
    corners: Vec<[f64; 2]>,
    arcs: Vec<([f64; 2], f64)>,
    is_circle: bool,
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    Point::new(a[0], a[1]).distance(Point::new(b[0], b[1]))
}

/// Regular polygon with `count` corners on a circle.
fn circle(centre: [f64; 2], radius: f64, count: u32, begin: f64) -> Outline {
    let corner = |k: u32| {
        let turn = begin + TAU * f64::from(k) / f64::from(count);
        [centre[0] + radius * cos(turn), centre[1] + radius * sin(turn)]
    };
    Outline { corners: (0..count).map(corner).collect(), arcs: vec![(centre, radius)], is_circle: true }
}

/// Rectangle with rounded corners of `chords` chords each. It is a slot if its height is two radii.
fn rounded_rectangle([width, height]: [f64; 2], centre: [f64; 2], radius: f64, chords: u32) -> Outline {
    let (x, y) = (width / 2.0 - radius, height / 2.0 - radius);
    let mut own = Outline { corners: Vec::new(), arcs: Vec::new(), is_circle: false };
    for (quarter, [a, b]) in [[x, y], [-x, y], [-x, -y], [x, -y]].into_iter().enumerate() {
        let middle = [centre[0] + a, centre[1] + b];
        if own.arcs.last().is_none_or(|(known, _)| *known != middle) {
            own.arcs.push((middle, radius));
        }
        for k in 0..=chords {
            let turn = FRAC_PI_2 * (quarter as f64 + f64::from(k) / f64::from(chords));
            let corner = [middle[0] + radius * cos(turn), middle[1] + radius * sin(turn)];
            let apart = |known: &[f64; 2]| distance(*known, corner);
            if own.corners.last().is_none_or(|last| apart(last) > 1e-9) {
                own.corners.push(corner);
            }
        }
    }
    if own.arcs.len() > 2 && own.arcs.first() == own.arcs.last() {
        own.arcs.pop();
    }
    own
}

/// Closed prism of height 5 over a convex outline.
fn prism(outline: &Outline) -> Solid {
    let mut solid = Solid::default();
    let n = outline.corners.len() as u32;
    for [x, y] in &outline.corners {
        solid.positions.extend([DVec3::new(*x, *y, 0.0), DVec3::new(*x, *y, 5.0)]);
    }
    for k in 0..n {
        let [a, b] = [2 * k, 2 * ((k + 1) % n)];
        solid.triangles.extend([[a, b, b + 1], [a, b + 1, a + 1]]);
    }
    for k in 1..n - 1 {
        solid.triangles.extend([[0, 2 * k + 2, 2 * k], [1, 2 * k + 1, 2 * k + 3]]);
    }
    solid
}

/// Disc of height 5 with a hole. Both outlines must have the same number of corners.
fn ring(outer: &Outline, inner: &Outline) -> Solid {
    let mut solid = Solid::default();
    let n = outer.corners.len() as u32;
    for ([a, b], [c, d]) in outer.corners.iter().zip(&inner.corners) {
        let at = |x: &f64, y: &f64, z: f64| DVec3::new(*x, *y, z);
        solid.positions.extend([at(a, b, 0.0), at(a, b, 5.0), at(c, d, 0.0), at(c, d, 5.0)]);
    }
    for k in 0..n {
        let [i, j] = [4 * k, 4 * ((k + 1) % n)];
        for [a, b, c, d] in [
            [i, j, j + 1, i + 1],
            [j + 2, i + 2, i + 3, j + 3],
            [i + 1, j + 1, j + 3, i + 3],
            [j, i, i + 2, j + 2],
        ] {
            solid.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    solid
}

/// Scene with coordinates rounded as in a file: to single precision, 6, 4 or 3 decimals, or not at all.
fn scene(solids: &[Solid], written: usize) -> Scene {
    let decimals = |x: f64, count: i32| (x * 10_f64.powi(count)).round() / 10_f64.powi(count);
    let round = |x: f64| match written {
        0 => f64::from(x as f32),
        1 => decimals(x, 6),
        2 => decimals(x, 4),
        3 => decimals(x, 3),
        _ => x,
    };
    let parts: Vec<(String, Solid)> = solids
        .iter()
        .enumerate()
        .map(|(k, solid)| {
            let rounded = |p: DVec3| DVec3::from_array(p.to_array().map(round));
            (format!("part-{k}"), solid.clone().moved(rounded))
        })
        .collect();
    let mut scene = Scene::from_bytes(obj_text(&parts).as_bytes(), ModelFormat::Obj).expect("a scene");
    scene.up = ligne::scene::UpAxis::Z;
    scene
}

/// Orthographic drawing from above at `scale` on a page in mm, and its camera.
fn view(scene: &Scene, scale: f64, [width, height]: [f64; 2], middle: [f64; 2]) -> (Drawing, Camera) {
    let target = DVec3::new(middle[0], middle[1], 0.0);
    let camera = Camera {
        eye: target + DVec3::Z * 100.0,
        target,
        up: DVec3::Y,
        projection: Projection::Orthographic { height: height / scale },
        width,
        height,
        near: None,
    };
    let style = Style::preset("technical").expect("a style").to_scale();
    let page = Page { width, height, unit: Unit::Mm, background: None };
    (Renderer::new(scene, &style).draw(&camera, page).expect("a drawing").0, camera)
}

/// Distance from a point to the nearest drawn path.
fn distance_to_drawing(drawing: &Drawing, p: Point) -> f64 {
    let marks = drawing.layers.iter().flat_map(|layer| &layer.marks);
    let segments = marks.flat_map(|mark| mark.path.segments());
    segments.map(|segment| segment.nearest(p, 1e-9).distance_sq).fold(f64::INFINITY, f64::min).sqrt()
}

/// Circles and arcs of a DXF file: centre, radius, and whether it is a full circle.
fn round_entities(entities: &[Entity]) -> Vec<([f64; 2], f64, bool)> {
    let mut found = Vec::new();
    let number = |entity: &Entity, code: u16| entity.number(code);
    let mut at = 0;
    while let Some(entity) = entities.get(at) {
        match entity.kind.as_str() {
            "CIRCLE" | "ARC" => {
                let centre = [number(entity, 10), number(entity, 20)];
                found.push((centre, number(entity, 40), entity.kind == "CIRCLE"));
            }
            "POLYLINE" => {
                let own: Vec<&Entity> =
                    entities[at + 1..].iter().take_while(|next| next.kind == "VERTEX").collect();
                for (k, vertex) in own.iter().enumerate() {
                    let (next, bulge) = (own[(k + 1) % own.len()], number(vertex, 42));
                    if bulge == 0.0 {
                        continue;
                    }
                    let [a, b] = [vertex, next].map(|v| Point::new(number(v, 10), number(v, 20)));
                    let chord = b - a;
                    let factor = (1.0 - bulge * bulge) / (4.0 * bulge);
                    let centre = a.midpoint(b) + kurbo::Vec2::new(-chord.y, chord.x) * factor;
                    found.push(([centre.x, centre.y], (a - centre).hypot(), false));
                }
            }
            _ => {}
        }
        at += 1;
    }
    found
}

/// Draws the solids and asserts that every corner lies on a line and that the DXF file has exactly the
/// expected circles and arcs.
fn assert_circles_and_arcs(
    name: &str,
    outlines: &[Outline],
    solids: &[Solid],
    (written, scale, page): (usize, f64, [f64; 2]),
) {
    let scene = scene(solids, written);
    let all = || outlines.iter().flat_map(|outline| &outline.corners);
    let span = |axis: usize| {
        let of = all().map(|p| p[axis]);
        of.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
    };
    let middle = [0, 1].map(|axis| span(axis).iter().sum::<f64>() / 2.0);
    let (drawing, camera) = view(&scene, scale, page, middle);
    for [x, y] in all() {
        let at = Point::new(page[0] / 2.0 + (x - middle[0]) * scale, page[1] / 2.0 - (y - middle[1]) * scale);
        let off = distance_to_drawing(&drawing, at);
        assert!(off < 0.02, "{name}: a corner is off by {off}");
    }
    // In model units, relative to the origin of the model.
    let [right, up, _] = camera.axes();
    let origin = [page[0] / 2.0 - camera.eye.dot(right) * scale, page[1] / 2.0 + camera.eye.dot(up) * scale];
    let options = DxfOptions::default().with_length(DxfLength::Model(scale)).with_origin(origin);
    let found = round_entities(&entities(&group_codes(&drawing.to_dxf(&options))));
    let wanted: Vec<([f64; 2], f64, bool)> = outlines
        .iter()
        .flat_map(|own| own.arcs.iter().map(|(centre, radius)| (*centre, *radius, own.is_circle)))
        .collect();
    assert_eq!(found.len(), wanted.len(), "{name}: {found:?} of {wanted:?}");
    // With three decimals the radii of short arcs are less exact.
    let near = 0.002 / scale + if written == 3 { 0.004 } else { 0.0 };
    for (centre, radius, is_circle) in &wanted {
        let is_it = |(other, length, whole): &([f64; 2], f64, bool)| {
            let apart = distance(*other, *centre);
            apart < near && (length - radius).abs() < near && whole == is_circle
        };
        assert_eq!(
            found.iter().filter(|own| is_it(own)).count(),
            1,
            "{name}: {centre:?} {radius} in {found:?}"
        );
    }
}

const PAGE_SIZES_MM: [[f64; 2]; 3] = [[210.0, 297.0], [420.0, 297.0], [841.0, 594.0]];

#[test]
fn polygons_of_16_corners_or_more_become_circles() {
    let mut dice = Dice::new(31);
    for round in 0..100 {
        let scale = [1.0, 0.5, 2.0, 0.1, 0.2, 5.0][dice.below(6)];
        let place = [dice.between(-200.0, 200.0), dice.between(-200.0, 200.0)];
        let (mut outlines, mut solids) = (Vec::new(), Vec::new());
        for k in 0..3 {
            let count = [16, 17, 18, 20, 24, 32, 36, 45, 64, 96, 180][dice.below(11)];
            let outer = dice.between(4.0, 19.0) / scale;
            let inner = outer * dice.between(0.2, 0.8);
            let centre = [place[0] + 40.0 / scale * f64::from(k), place[1]];
            let begin = dice.between(0.0, 1.0);
            let [outer, inner] = [outer, inner].map(|radius| circle(centre, radius, count, begin));
            solids.push(ring(&outer, &inner));
            outlines.extend([outer, inner]);
        }
        let way = (dice.below(5), scale, PAGE_SIZES_MM[dice.below(3)]);
        assert_circles_and_arcs(&format!("{round}: {way:?}"), &outlines, &solids, way);
    }
}

#[test]
fn slots_and_rounded_corners_become_arcs() {
    let mut dice = Dice::new(32);
    for round in 0..100 {
        let scale = [1.0, 0.5, 2.0, 0.1, 5.0][dice.below(5)];
        let place = [dice.between(-200.0, 200.0), dice.between(-200.0, 200.0)];
        let chords = [4, 5, 6, 8, 12, 24][dice.below(6)];
        let radius = dice.between(1.0, 9.0) / scale;
        let height =
            if dice.below(2) == 0 { 2.0 * radius } else { 2.0 * radius + dice.between(2.0, 20.0) / scale };
        let width = 2.0 * radius + dice.between(3.0, 90.0) / scale;
        let outline = rounded_rectangle([width, height], place, radius, chords);
        let way = (dice.below(5), scale, PAGE_SIZES_MM[dice.below(3)]);
        let solid = prism(&outline);
        assert_circles_and_arcs(&format!("{round}: {chords} {way:?}"), &[outline], &[solid], way);
    }
}

#[test]
fn coarse_polygons_and_ellipses_do_not_become_circles() {
    let mut dice = Dice::new(33);
    for count in [6, 8, 12, 15] {
        let nut = circle([dice.between(-50.0, 50.0), 7.0], 12.0, count, 0.1);
        let drawing = view(&scene(&[prism(&nut)], 4), 1.0, PAGE_SIZES_MM[0], nut.arcs[0].0).0;
        let found = round_entities(&entities(&group_codes(&drawing.to_dxf(&DxfOptions::default()))));
        assert!(found.is_empty(), "{count}: {found:?}");
    }
    for written in 0..5 {
        for count in [48, 200, 720] {
            let mut oval = circle([0.0, 0.0], 40.0, count, 0.0);
            oval.corners.iter_mut().for_each(|p| p[1] *= 0.7);
            let drawing = view(&scene(&[prism(&oval)], written), 1.0, PAGE_SIZES_MM[0], [0.0; 2]).0;
            let cubics =
                drawing.layers.iter().flat_map(|layer| &layer.marks).map(|mark| mark.path.segments().count());
            assert!(cubics.sum::<usize>() < 80, "{written}: {count}");
            for [x, y] in &oval.corners {
                let off = distance_to_drawing(&drawing, Point::new(105.0 + x, 148.5 - y));
                assert!(off < 0.02, "{written}: {count}: {off}");
            }
        }
    }
}

/// The visible part of a partly hidden circle is an arc.
#[test]
fn partly_hidden_circles_leave_arcs() {
    let mut dice = Dice::new(34);
    for round in 0..30 {
        let count = [32, 48, 64, 90][dice.below(4)];
        let radius = dice.between(1.0, 4.0);
        let disc = circle([3.0, -8.0], radius, count, dice.between(0.0, 1.0));
        // Block above the disc that covers one side of it.
        let from = 3.0 + radius * dice.between(-0.7, 0.7);
        let block =
            crate::library::support::scenes::sheet_models::block([from, -30.0, 6.0], [40.0, 30.0, 8.0]);
        let scene = scene(&[prism(&disc), block], dice.below(5));
        let (drawing, _) = view(&scene, 1.0, PAGE_SIZES_MM[0], [0.0; 2]);
        let own = entities(&group_codes(&drawing.to_dxf(&DxfOptions::default())));
        let arcs: Vec<f64> =
            own.iter().filter(|entity| entity.kind == "ARC").map(|entity| entity.number(40)).collect();
        let visible = arcs.iter().filter(|length| (*length - radius).abs() < 0.005).count();
        assert!(visible >= 1, "{round}: {count} {radius}: {arcs:?}");
    }
}

/// Views of one model at other scales and in other frames have the same DXF coordinates.
#[test]
fn dxf_files_in_model_units_share_coordinates() {
    let whole = circle([31.5, -12.25], 6.0, 32, 0.0);
    let other = rounded_rectangle([50.0, 30.0], [140.0, 60.0], 4.0, 6);
    let both = scene(&[prism(&whole), prism(&other)], 4);
    for (scale, page, middle) in
        [(1.0, PAGE_SIZES_MM[0], [60.0, 20.0]), (0.5, PAGE_SIZES_MM[1], [-20.0, 3.7])]
    {
        let (drawing, camera) = view(&both, scale, page, middle);
        let [right, up, _] = camera.axes();
        let origin =
            [page[0] / 2.0 - camera.eye.dot(right) * scale, page[1] / 2.0 + camera.eye.dot(up) * scale];
        let options = DxfOptions::default().with_length(DxfLength::Model(scale)).with_origin(origin);
        let found = round_entities(&entities(&group_codes(&drawing.to_dxf(&options))));
        let hole = found.iter().find(|(_, _, is_circle)| *is_circle).expect("a circle");
        assert!((hole.0[0] - 31.5).abs() < 1e-5 && (hole.0[1] + 12.25).abs() < 1e-5, "{hole:?}");
    }
}
