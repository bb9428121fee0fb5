//! Hidden lines do not overlap the ink of visible lines; tested against closed forms and point by point
//! against every line.

use glam::DVec3;
use kurbo::{Point, Vec2};
use ligne::drawing::{Drawing, LayerKind};
use ligne::mesh::MeshMetrics;
use ligne::scene::{NamedView, UpAxis};
use ligne::visibility::overlap::hidden_line_precedence::{self, LineInk};
use ligne::visibility::tolerances::{BEHIND_INK_PX, BEHIND_INK_SINE};
use ligne::visibility::{ViewEdge, ViewMap};
use ligne::{Camera, Scene, Style, render};

use crate::library::support::pipeline::{exact_options_with_hidden, orthographic, run_stages, scene};
use crate::library::support::scenes::random_dice::Dice;
use crate::library::support::scenes::random_scenes::{ALL_SCENE_KINDS, random_camera, random_scene};
use crate::library::support::scenes::solids::{Solid, cuboid, tube};

fn marks(drawing: &Drawing, kind: LayerKind) -> usize {
    drawing.layers.iter().filter(|layer| layer.kind == kind).map(|layer| layer.marks.len()).sum()
}

fn technical(scene: &Scene, view: NamedView) -> Drawing {
    let camera = Camera::named(view, UpAxis::Y).fit(scene);
    render(scene, &camera, &Style::preset("technical").unwrap()).unwrap()
}

#[test]
fn a_box_seen_face_on_has_no_hidden_lines() {
    let scene = scene([cuboid(DVec3::ZERO, DVec3::new(1.0, 0.7, 2.0))]);
    for view in [NamedView::Front, NamedView::Back, NamedView::Left, NamedView::Top, NamedView::Bottom] {
        let drawing = technical(&scene, view);
        assert_eq!(marks(&drawing, LayerKind::HiddenLines), 0, "{view:?}");
        assert!(marks(&drawing, LayerKind::Lines) > 0);
    }
    // From a corner, three edges meet behind the box.
    assert!(marks(&technical(&scene, NamedView::Iso), LayerKind::HiddenLines) > 0);
}

/// Returns the map without hidden lines inside the ink of visible lines, for lines of zero width.
fn without_covered_hidden_lines(map: &ViewMap, extents: &MeshMetrics, perspective: bool) -> Option<ViewMap> {
    hidden_line_precedence::without_hidden_in_ink(
        map,
        &LineInk { half_width: &|_: &ViewEdge| 0.0, extents, perspective, px: 1.0 },
    )
}

/// Returns the length of all hidden lines of a drawing, px.
fn hidden_length(drawing: &Drawing) -> f64 {
    let hidden = drawing.layers.iter().filter(|layer| layer.kind == LayerKind::HiddenLines);
    let paths = hidden.flat_map(|layer| &layer.marks).flat_map(|mark| mark.path.segments());
    paths.map(|segment| kurbo::ParamCurveArclen::arclen(&segment, 1e-6)).sum()
}

/// Draws in the style `technical` at 100 px per unit, seen along −z towards the origin.
fn from_above(solids: Vec<Solid>) -> Drawing {
    let camera = orthographic(DVec3::Z * 20.0, DVec3::ZERO, 10.0).with_frame(1000.0, 1000.0);
    render(&scene(solids), &camera, &Style::preset("technical").unwrap()).unwrap()
}

#[test]
fn hidden_lines_that_coincide_are_drawn_once() {
    let mut dice = Dice::new(571);
    for round in 0..20 {
        // Blocks under a plate. The upper and lower edges of each block coincide in the image, and so do the
        // edges of both blocks.
        let mut number = |low: f64, high: f64| (dice.between(low, high) * 100.0).round() / 100.0;
        let (low, high) = ([number(-3.0, -1.0), number(-3.0, -1.0)], [number(0.5, 3.0), number(0.5, 3.0)]);
        let at = |[x, y]: [f64; 2], z: f64| DVec3::new(x, y, z);
        let plate = cuboid(DVec3::new(-4.0, -4.0, 0.0), DVec3::new(4.0, 4.0, 1.0));
        let upper = cuboid(at(low, -2.0), at(high, -1.0));
        let lower = cuboid(at(low, -5.0), at([high[0], high[1] - 0.2], -3.0));
        let drawing = from_above(vec![plate, upper, lower]);
        let (width, height) = (high[0] - low[0], high[1] - low[1]);
        let once = 100.0 * (2.0 * (width + height) + width);
        let found = hidden_length(&drawing);
        assert!((found - once).abs() < 0.2, "{round}: {found} px of {once}");
    }
}

#[test]
fn hidden_lines_in_the_ink_of_visible_ones_are_left_out() {
    // The outlines of `technical` are 1.89 px wide.
    let half = 0.945;
    for (off, is_left_out) in [(0.3, true), (0.8, true), (0.95, true), (1.1, false), (3.0, false)] {
        let inset = off * half / 100.0;
        let plate = cuboid(DVec3::new(-4.0, -3.0, 0.0), DVec3::new(4.0, 3.0, 1.0));
        let below = cuboid(DVec3::new(-4.0 + inset, -1.0, -2.0), DVec3::new(2.0, 1.0, -1.0));
        let sides = 100.0 * (2.0 * (6.0 - inset) + 2.0);
        let expected = sides + if is_left_out { 0.0 } else { 200.0 };
        let found = hidden_length(&from_above(vec![plate, below]));
        assert!((found - expected).abs() < 2.5, "at {off} of half the width: {found} px of {expected}");
    }
}

#[test]
fn hidden_lines_that_cross_or_touch_visible_ones_stay() {
    // A plate with a long edge along x, above a bar rotated so that its sides cross that edge.
    let plate = || cuboid(DVec3::new(-4.5, -4.0, 0.0), DVec3::new(4.5, 0.0, 1.0));
    for degrees in [2.0_f64, 5.0, 30.0, 90.0] {
        let (sin, cos) = (
            ligne::geometry::numbers::portable_math::sin(degrees.to_radians()),
            ligne::geometry::numbers::portable_math::cos(degrees.to_radians()),
        );
        let turn = move |p: DVec3| DVec3::new(p.x * cos - p.y * sin, p.x * sin + p.y * cos, p.z);
        let bar = cuboid(DVec3::new(-3.0, -0.4, -2.0), DVec3::new(3.0, 0.4, -1.0)).moved(turn);
        let hidden = hidden_length(&from_above(vec![plate(), bar]));
        // Only the part of the bar under the plate is hidden.
        let corners =
            [(-3.0, -0.4), (3.0, -0.4), (3.0, 0.4), (-3.0, 0.4)].map(|(x, y)| turn(DVec3::new(x, y, 0.0)));
        let under = |k: usize| {
            let (a, b) = (corners[k], corners[(k + 1) % 4]);
            let share = |y: f64| ((y - a.y) / (b.y - a.y)).clamp(0.0, 1.0);
            let (from, to) = (share(-4.0), share(0.0));
            (b - a).length() * (to - from).abs()
        };
        let expected: f64 = 100.0 * (0..4).map(under).sum::<f64>();
        assert!((hidden - expected).abs() < 2.5, "{degrees} degrees: {hidden} px of {expected}");
    }
    // A round post under the plate that touches its edge from below.
    let radius = 2.0;
    let post = tube(128, 1, radius, 0.5).moved(|p| DVec3::new(p.x, p.y - radius, p.z - 2.0));
    let hidden = hidden_length(&from_above(vec![plate(), post]));
    let whole = std::f64::consts::TAU * radius * 100.0;
    assert!(hidden > whole - 25.0 && hidden < whole + 1.0, "{hidden} px of {whole}");
}

/// Axis-aligned boxes, with edges behind edges in views along an axis.
fn straight_boxes(dice: &mut Dice) -> Scene {
    let boxes: Vec<Solid> = (0..7)
        .map(|_| {
            let low = DVec3::from_array([0; 3].map(|_: i32| dice.below(5) as f64 / 4.0 - 0.9));
            let size = DVec3::from_array([0; 3].map(|_: i32| (1 + dice.below(3)) as f64 / 4.0));
            cuboid(low, low + size)
        })
        .collect();
    scene(boxes)
}

/// Returns the ends of an edge in the image.
fn ends(map: &ViewMap, edge: &ViewEdge) -> [Point; 2] {
    [edge.start, edge.end].map(|end| map.vertices[end.index()].position)
}

/// Returns the distance of a point from the line of an edge. Returns `None` unless the point lies next to the
/// edge and `way` is parallel to it.
fn distance_if_parallel(map: &ViewMap, edge: &ViewEdge, point: Point, way: Vec2) -> Option<f64> {
    let [a, b] = ends(map, edge);
    let along = b - a;
    let length = along.hypot();
    let place = (point - a).dot(along) / length;
    // Near its ends, rounding decides.
    let beside = length > 0.0 && place > 1e-3 && place < length - 1e-3;
    let parallel = along.cross(way).abs() / length <= BEHIND_INK_SINE * 0.999;
    (beside && parallel).then(|| (along.cross(point - a) / length).abs())
}

#[test]
fn a_hidden_point_is_drawn_unless_a_visible_line_runs_there() {
    let mut dice = Dice::new(41);
    let (mut covered, mut kept) = (0, 0);
    for kind in ALL_SCENE_KINDS {
        for turn in 0..4 {
            let scene = if turn < 2 { straight_boxes(&mut dice) } else { random_scene(kind, &mut dice) };
            let camera = match turn {
                0 => orthographic(DVec3::Z * 5.0, DVec3::ZERO, 3.0),
                1 => orthographic(DVec3::X * 5.0, DVec3::ZERO, 3.0),
                _ => random_camera("perspective", &mut dice),
            };
            let made = run_stages(&scene, &camera, &exact_options_with_hidden());
            let (map, extents) = (made.map, made.mesh.extents);
            let apart = without_covered_hidden_lines(&map, &extents, turn > 1);
            let apart = apart.as_ref().unwrap_or(&map);
            let visible: Vec<&ViewEdge> = map.edges.iter().filter(|edge| edge.invisibility == 0).collect();
            let same = apart.edges.iter().filter(|edge| edge.invisibility == 0);
            assert!(same.zip(&visible).all(|(a, b)| a == *b), "{kind}: a visible line changed");
            for edge in map.edges.iter().filter(|edge| edge.invisibility > 0) {
                let [a, b] = ends(&map, edge);
                let way = (b - a) / (b - a).hypot().max(1e-12);
                for share in [0.13, 0.37, 0.5, 0.71, 0.93] {
                    let point = a.lerp(b, share);
                    let near =
                        visible.iter().filter_map(|other| distance_if_parallel(&map, other, point, way));
                    let nearest = near.fold(f64::INFINITY, f64::min);
                    let mine = |other: &&ViewEdge| other.invisibility > 0 && other.segment == edge.segment;
                    let drawn = apart
                        .edges
                        .iter()
                        .filter(mine)
                        .any(|own| distance_if_parallel(apart, own, point, way).is_some());
                    if nearest < BEHIND_INK_PX * 0.99 {
                        assert!(!drawn, "{kind} {turn}: {point:?} lies in ink");
                        covered += 1;
                    } else if nearest.is_infinite() && drawn {
                        kept += 1;
                    }
                }
            }
        }
    }
    assert!(covered > 20 && kept > 1000, "{covered} covered, {kept} kept");
}

#[test]
fn removed_hidden_lines_run_along_remaining_lines() {
    let mut dice = Dice::new(42);
    for kind in ALL_SCENE_KINDS {
        let scene = straight_boxes(&mut dice);
        let made =
            run_stages(&scene, &orthographic(DVec3::Z * 5.0, DVec3::ZERO, 3.0), &exact_options_with_hidden());
        let (map, extents) = (made.map, made.mesh.extents);
        let Some(apart) = without_covered_hidden_lines(&map, &extents, false) else { continue };
        for edge in map.edges.iter().filter(|edge| edge.invisibility > 0) {
            let [a, b] = ends(&map, edge);
            // Distances may add up if a line yields to one that itself yields.
            let far = |other: &ViewEdge, point: Point| {
                let [p, q] = ends(&apart, other);
                let along = q - p;
                let share = (point - p).dot(along) / along.hypot2().max(1e-12);
                (p + along * share.clamp(0.0, 1.0) - point).hypot()
            };
            for share in [0.21, 0.5, 0.83] {
                let point = a.lerp(b, share);
                let nearest = apart.edges.iter().map(|other| far(other, point)).fold(f64::INFINITY, f64::min);
                assert!(nearest < 4.0 * BEHIND_INK_PX, "{kind}: nothing is drawn at {point:?}: {nearest}");
            }
        }
    }
}

#[test]
fn hidden_lines_behind_the_outline_of_a_bracket_are_left_out() {
    let bracket = std::path::Path::new("../shared/models/cad/bracket.glb");
    if !bracket.exists() {
        eprintln!("skipped: {} is absent", bracket.display());
        return;
    }
    let scene = Scene::open(bracket).unwrap();
    // From the side, half of the hidden lines lie behind the outline, and none of these remain.
    let drawing = technical(&scene, NamedView::Front);
    let hidden = marks(&drawing, LayerKind::HiddenLines);
    assert!((1..30).contains(&hidden), "{hidden}");
}
