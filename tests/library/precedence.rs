//! Hidden lines do not lie in the ink of others: closed forms, and point by point against every line there is.

use glam::DVec3;
use kurbo::{Point, Vec2};
use ligne::drawing::{Drawing, LayerKind};
use ligne::math::tolerance::{BEHIND_INK_PX, BEHIND_INK_SINE};
use ligne::scene::{NamedView, UpAxis};
use ligne::stages::viewmap::{ViewEdge, ViewMap, precedence};
use ligne::{Camera, Scene, Style, render};

use crate::support::dice::Dice;
use crate::support::pipeline::{counting, orthographic, scene, stages};
use crate::support::scenes::{SCENES, random_camera, random_scene};
use crate::support::solids::{Solid, cuboid};

fn marks(drawing: &Drawing, kind: LayerKind) -> usize {
    drawing.layers.iter().filter(|layer| layer.kind == kind).map(|layer| layer.marks.len()).sum()
}

fn technical(scene: &Scene, view: NamedView) -> Drawing {
    let camera = Camera::named(view, UpAxis::Y).fit(scene);
    render(scene, &camera, &Style::preset("technical").unwrap()).unwrap()
}

#[test]
fn a_box_seen_square_on_has_no_hidden_line() {
    let scene = scene([cuboid(DVec3::ZERO, DVec3::new(1.0, 0.7, 2.0))]);
    for view in [NamedView::Front, NamedView::Back, NamedView::Left, NamedView::Top, NamedView::Bottom] {
        let drawing = technical(&scene, view);
        assert_eq!(marks(&drawing, LayerKind::HiddenLines), 0, "{view:?}");
        assert!(marks(&drawing, LayerKind::Lines) > 0);
    }
    // From a corner three edges meet behind it.
    assert!(marks(&technical(&scene, NamedView::Iso), LayerKind::HiddenLines) > 0);
}

/// Boxes that stand straight, with edges behind edges as seen along an axis.
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

/// The ends of an edge in the image.
fn ends(map: &ViewMap, edge: &ViewEdge) -> [Point; 2] {
    [edge.start, edge.end].map(|end| map.vertices[end.index()].position)
}

/// How far a point is from the nearest place of an edge that is beside it, where the edge runs in its direction.
fn off(map: &ViewMap, edge: &ViewEdge, point: Point, way: Vec2) -> Option<f64> {
    let [a, b] = ends(map, edge);
    let along = b - a;
    let length = along.hypot();
    let place = (point - a).dot(along) / length;
    // Near its ends rounding may decide.
    let beside = length > 0.0 && place > 1e-3 && place < length - 1e-3;
    let parallel = along.cross(way).abs() / length <= BEHIND_INK_SINE * 0.999;
    (beside && parallel).then(|| (along.cross(point - a) / length).abs())
}

#[test]
fn a_hidden_point_is_drawn_unless_a_visible_line_runs_there() {
    let mut dice = Dice::new(41);
    let (mut covered, mut kept) = (0, 0);
    for kind in SCENES {
        for turn in 0..4 {
            let scene = if turn < 2 { straight_boxes(&mut dice) } else { random_scene(kind, &mut dice) };
            let camera = match turn {
                0 => orthographic(DVec3::Z * 5.0, DVec3::ZERO, 3.0),
                1 => orthographic(DVec3::X * 5.0, DVec3::ZERO, 3.0),
                _ => random_camera("perspective", &mut dice),
            };
            let map = stages(&scene, &camera, &counting()).map;
            let apart = precedence::apart(&map, turn > 1, 1.0);
            let apart = apart.as_ref().unwrap_or(&map);
            let visible: Vec<&ViewEdge> = map.edges.iter().filter(|edge| edge.invisibility == 0).collect();
            let same = apart.edges.iter().filter(|edge| edge.invisibility == 0);
            assert!(same.zip(&visible).all(|(a, b)| a == *b), "{kind}: a visible line changed");
            for edge in map.edges.iter().filter(|edge| edge.invisibility > 0) {
                let [a, b] = ends(&map, edge);
                let way = (b - a) / (b - a).hypot().max(1e-12);
                for share in [0.13, 0.37, 0.5, 0.71, 0.93] {
                    let point = a.lerp(b, share);
                    let near = visible.iter().filter_map(|other| off(&map, other, point, way));
                    let nearest = near.fold(f64::INFINITY, f64::min);
                    let mine = |other: &&ViewEdge| other.invisibility > 0 && other.segment == edge.segment;
                    let drawn =
                        apart.edges.iter().filter(mine).any(|own| off(apart, own, point, way).is_some());
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
fn what_is_cut_away_runs_along_a_line_that_stays() {
    let mut dice = Dice::new(42);
    for kind in SCENES {
        let scene = straight_boxes(&mut dice);
        let map = stages(&scene, &orthographic(DVec3::Z * 5.0, DVec3::ZERO, 3.0), &counting()).map;
        let Some(apart) = precedence::apart(&map, false, 1.0) else { continue };
        for edge in map.edges.iter().filter(|edge| edge.invisibility > 0) {
            let [a, b] = ends(&map, edge);
            // Distances may add up where a line gives way to one that gives way itself.
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
fn visible_lines_are_those_without_hidden_ones_cut() {
    let bracket = std::path::Path::new("../shared/models/cad/bracket.glb");
    if !bracket.exists() {
        eprintln!("skipped: {} is absent", bracket.display());
        return;
    }
    let scene = Scene::open(bracket).unwrap();
    // From the side half of the hidden lines lie behind the outline; none of what is left does.
    let drawing = technical(&scene, NamedView::Front);
    let hidden = marks(&drawing, LayerKind::HiddenLines);
    assert!((1..30).contains(&hidden), "{hidden}");
}
