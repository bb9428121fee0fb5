//! Hatching strokes stay in their region, and those fixed to the model persist when the camera turns.

use std::collections::BTreeMap;

use crate::library::support::pipeline;
use crate::library::support::scenes::solids::{cuboid, sphere, torus};
use crate::library::support::styled::{fitted_camera, page_of_camera, style_with};
use glam::DVec3;
use kurbo::{Point, Vec2};
use ligne::drawing::{LayerKind, Paint};
use ligne::hatching::HatchStroke;
use ligne::mesh::{FaceId, Mesh};
use ligne::pipeline::Renderer;
use ligne::regions::HatchRegions;
use ligne::scene::Scene;
use ligne::{Drawing, Style, render};

/// Scenes with contours in front of surfaces, T-junctions, cusps and creases.
fn scenes() -> Vec<(&'static str, Scene)> {
    let boxes = cuboid(DVec3::ZERO, DVec3::new(1.0, 1.0, 1.0));
    vec![
        ("torus", pipeline::scene([torus(96, 48, 1.0, 0.45)])),
        ("sphere", pipeline::scene([sphere(48, 1.0)])),
        ("box", pipeline::scene([boxes])),
    ]
}

#[test]
fn hatching_strokes_stay_inside_their_region() {
    assert_strokes_stay_inside(&["pen"]);
}

#[test]
#[ignore = "long: .ci/nightly"]
fn engraving_and_pencil_strokes_stay_inside_their_region() {
    assert_strokes_stay_inside(&["engraving", "pencil"]);
}

fn assert_strokes_stay_inside(sheets: &[&str]) {
    for (name, scene) in scenes() {
        for sheet in sheets {
            let sets = ["lines.contours=mesh", "hatching.cast_shadows=false"];
            let style = style_with(sheet, &sets);
            let camera = fitted_camera(&scene);
            let prepared = Renderer::new(&scene, &style);
            let (ground, layers) =
                prepared.hatch_strokes(&camera, page_of_camera(&camera)).expect("a hatching");
            let mesh = Mesh::build(scene.to_soup());
            let view = ligne::view::View::new(&mesh, &camera);
            let mut asked = 0;
            for stroke in layers.iter().flat_map(|layer| &layer.strokes) {
                let facet = ground.cells[stroke.cell as usize].facet;
                for p in along(&stroke.points, 2.0) {
                    let own = ground.cells[ground.cell_at(p) as usize].facet;
                    assert!(own == facet || distance(&ground, p) < 0.02, "{name}, {sheet}: {p:?} is outside");
                }
                // Sampled points away from borders must have surface under them.
                let depths: Vec<Option<f64>> = along(&stroke.points, 0.5)
                    .into_iter()
                    .filter(|p| distance(&ground, *p) > 0.1)
                    .map(|p| depth(&mesh, &view, p, asked % 7 == 0))
                    .collect();
                asked += 1;
                for depth in depths.into_iter().flatten() {
                    assert!(depth.is_finite(), "{name}, {sheet}: paper under a stroke");
                }
            }
            assert!(asked > 100, "{name}, {sheet}: {asked} strokes");
        }
    }
}

/// Depth of the surface at a page point by brute force. It is `None` if `is_asked` is false, and infinite on
/// paper.
fn depth(mesh: &Mesh, view: &ligne::view::View, p: Point, is_asked: bool) -> Option<f64> {
    if !is_asked {
        return None;
    }
    let mut nearest = f64::INFINITY;
    for face in 0..mesh.triangles.len() {
        let corners = mesh.triangles[face].map(|v| view.points[v as usize]);
        if mesh.is_degenerate(FaceId(face as u32)) {
            continue;
        }
        let at = |k: usize| Vec2::new(corners[k].x, corners[k].y);
        let (a, b, c, q) = (at(0), at(1), at(2), p.to_vec2());
        let area = (b - a).cross(c - a);
        let weights = [(b - q).cross(c - q), (c - q).cross(a - q), (a - q).cross(b - q)].map(|w| w / area);
        if weights.iter().all(|w| *w >= 0.0) {
            let nearness: f64 = (0..3).map(|k| weights[k] * corners[k].z).sum();
            nearest = nearest.min(view.frame.depth_of(nearness));
        }
    }
    Some(nearest)
}

/// Points along a polyline at most `step` apart, including its ends and corners.
fn along(line: &[Point], step: f64) -> Vec<Point> {
    let mut points = vec![line[0]];
    for pair in line.windows(2) {
        let count = ((pair[1] - pair[0]).hypot() / step).ceil().max(1.0) as usize;
        points.extend((1..=count).map(|k| pair[0].lerp(pair[1], k as f64 / count as f64)));
    }
    points
}

/// Distance from a point to the nearest border.
fn distance(ground: &HatchRegions, p: Point) -> f64 {
    let of = |number: u32| {
        let [a, b] = ground.pieces[number as usize].ends;
        let way = b - a;
        let t = ((p - a).dot(way) / way.hypot2()).clamp(0.0, 1.0);
        (a + way * t - p).hypot()
    };
    ground.pieces_near(p, 1.0).into_iter().map(of).fold(f64::INFINITY, f64::min)
}

/// Style with strokes that are fixed to the model.
fn style_with_fixed_strokes() -> Style {
    let layer = "hatching.layer=[{ direction = 'object', angle = 30, spacing = 5, width = 1.2 }]";
    style_with("pen", &[layer, "hatching.cast_shadows=false"])
}

#[test]
fn strokes_fixed_to_the_model_persist_when_the_camera_turns() {
    for (name, scene) in [
        ("torus", pipeline::scene([torus(120, 60, 1.0, 0.4)])),
        ("box", pipeline::scene([cuboid(DVec3::ZERO, DVec3::new(1.0, 0.7, 1.3))])),
    ] {
        let style = style_with_fixed_strokes();
        let prepared = Renderer::new(&scene, &style);
        let drawn = |turn: f64| {
            let mut camera = fitted_camera(&scene);
            let (s, c) = (
                ligne::geometry::numbers::portable_math::sin(turn),
                ligne::geometry::numbers::portable_math::cos(turn),
            );
            let to_eye = camera.eye - camera.target;
            let turned = DVec3::new(to_eye.x * c + to_eye.z * s, to_eye.y, to_eye.z * c - to_eye.x * s);
            camera.eye = camera.target + turned;
            let (_, layers) = prepared.hatch_strokes(&camera, page_of_camera(&camera)).expect("a hatching");
            let strokes = layers.into_iter().flat_map(|layer| layer.strokes);
            strokes.map(|stroke| (stroke.id, stroke)).collect::<BTreeMap<u64, HatchStroke>>()
        };
        // Several turns both ways, because in a single one some strokes begin or end at a border.
        let turned: Vec<_> = (-5..=5).map(|k| drawn((0.1 * f64::from(k)).to_radians())).collect();
        let pairs = || turned.iter().zip(&turned[1..]);
        let both = |(before, after): (&BTreeMap<u64, _>, &BTreeMap<u64, _>)| {
            before.keys().filter(|id| after.contains_key(id)).count()
        };
        let stay: usize = pairs().map(both).sum();
        let all: usize = pairs().map(|(before, after)| before.len().max(after.len())).sum();
        let share = stay as f64 / all as f64;
        assert!(all > 400, "{name}: {all} strokes");
        assert!(share >= 0.95, "{name}: {share:.3} of {all} strokes stay");
        let (before, after) = (&turned[5], &turned[6]);
        let kept: Vec<_> = before.iter().filter_map(|(id, stroke)| Some((stroke, after.get(id)?))).collect();
        // Points of the model move by up to 0.7 px.
        let mut moves: Vec<f64> = kept
            .iter()
            .map(|(a, b)| {
                let middle = a.points[a.points.len() / 2];
                along(&b.points, 0.25).into_iter().map(|p| (p - middle).hypot()).fold(f64::INFINITY, f64::min)
            })
            .collect();
        moves.sort_by(f64::total_cmp);
        let most = moves[moves.len() * 98 / 100];
        assert!(most < 3.0, "{name}: 98 % of strokes move by up to {most} px");
    }
}

#[test]
fn the_seed_changes_only_hatching() {
    let scene = pipeline::scene([torus(64, 32, 1.0, 0.4)]);
    let camera = fitted_camera(&scene);
    for name in ["pencil", "engraving"] {
        let style = style_with(name, &[]);
        let drawn = |seed: u64| render(&scene, &camera, &Style { seed, ..style.clone() }).unwrap();
        let (a, b) = (drawn(0), drawn(1));
        let others = |drawing: &Drawing| {
            let layers = drawing.layers.iter().filter(|layer| layer.kind != LayerKind::Hatching);
            layers.cloned().collect::<Vec<_>>()
        };
        assert_eq!(others(&a), others(&b));
        if name == "pencil" {
            assert_ne!(a, b);
        }
    }
}

#[test]
fn pencil_hatching_marks_are_tapered_outlines() {
    let scene = pipeline::scene([torus(64, 32, 1.0, 0.4)]);
    let drawing = render(&scene, &fitted_camera(&scene), &style_with("pencil", &[])).unwrap();
    let layer = drawing.layers.iter().find(|layer| layer.kind == LayerKind::Hatching).expect("hatching");
    for mark in &layer.marks {
        assert_eq!(mark.provenance.classes, ["hatch"]);
        let Paint::Outline(outline) = &mark.paint else { panic!("pencil strokes taper") };
        assert!(outline.width > 0.0 && !outline.axis.elements().is_empty());
    }
}
