//! Motion lines lie where vertices were, and are drawn where rays say that nothing hides them.

use std::f64::consts::TAU;

use glam::{DAffine3, DQuat, DVec3};
use kurbo::{ParamCurve, PathSeg, Point};
use ligne::drawing::{Drawing, LayerKind, Mark, Paint};
use ligne::math::function::{cos, sin};
use ligne::pose::body::Influences;
use ligne::pose::rig::{Form, Node, Placement, Skin};
use ligne::pose::{Body, Channel, Clip, Interpolation, Playing, Property, Rig, Rigged, Target, Track};
use ligne::scene::Geometry;
use ligne::{Camera, Scene, Style, SvgOptions, motion, render};

use crate::support::eye::Eye;
use crate::support::pipeline::{geometry, orthographic, perspective, scene_of_geometries};
use crate::support::solids::{Solid, cuboid};

/// How long clips last, and how long lines go back by default, seconds.
const LASTS: f64 = 4.0;
const BACK: f64 = 20.0 / 24.0;

fn channel(node: usize, property: Property, times: &[f64], values: &[f64]) -> Channel {
    let track = Track::new(times.into(), values.into(), Interpolation::Linear).unwrap();
    Channel { target: Target::Node(node, property), track }
}

/// A node that goes evenly.
fn going(node: usize, speed: DVec3) -> Channel {
    let ends = [DVec3::ZERO, speed * LASTS].concat_all();
    channel(node, Property::Translation, &[0.0, LASTS], &ends)
}

/// A node that turns evenly about z, by so many degrees a second.
fn turning(node: usize, degrees: f64) -> Channel {
    let times: Vec<f64> = (0..=40).map(|k| f64::from(k) / 10.0).collect();
    let turn = |time: &f64| {
        let half = (degrees * time / 2.0).to_radians();
        [0.0, 0.0, sin(half), cos(half)]
    };
    let values: Vec<f64> = times.iter().flat_map(turn).collect();
    channel(node, Property::Rotation, &times, &values)
}

trait ConcatAll {
    fn concat_all(self) -> Vec<f64>;
}

impl ConcatAll for [DVec3; 2] {
    fn concat_all(self) -> Vec<f64> {
        self.iter().flat_map(|v| v.to_array()).collect()
    }
}

fn node(name: &str, parent: Option<usize>) -> Node {
    let (translation, rotation, scale) = (DVec3::ZERO, DQuat::IDENTITY, DVec3::ONE);
    let rest = Placement::Parts { translation, rotation, scale };
    Node { name: name.to_owned(), leaves_lines: false, parent, rest, weights: Vec::new(), visible: true }
}

/// Solids that hang on a node each, and what moves these.
fn rigged(solids: Vec<Solid>, channels: Vec<Channel>) -> Rigged {
    let count = solids.len();
    let scene = scene_of_geometries(solids.into_iter().map(geometry).collect());
    let nodes = (0..count).map(|k| node(&format!("node {k}"), None)).collect();
    let forms = (0..count).map(|node| Form { node, ..Form::default() }).collect();
    let parts = (0..count).map(|node| (node, DAffine3::IDENTITY)).collect();
    let clips = vec![Clip { name: "go".to_owned(), channels }];
    Rigged { scene, rig: Rig { nodes, order: (0..count).collect(), forms, parts, clips, ..Rig::default() } }
}

fn style(changes: &[&str]) -> Style {
    let all = [&["motion.enabled=true"], changes].concat();
    Style::load("ink", &all.iter().map(|change| (*change).to_owned()).collect::<Vec<_>>()).unwrap()
}

fn scene_at(rigged: &Rigged, time: f64, style: &Style) -> Scene {
    motion::posed(rigged, &[Playing::all(0, time)], &style.motion, style.seed).unwrap()
}

fn drawn(rigged: &Rigged, time: f64, camera: &Camera, style: &Style) -> Drawing {
    render(&scene_at(rigged, time, style), camera, style).unwrap()
}

/// The motion lines of a drawing.
fn lines(drawing: &Drawing) -> Vec<&Mark> {
    let marks = drawing.layers.iter().filter(|layer| layer.kind == LayerKind::Motion).flat_map(|l| &l.marks);
    marks.inspect(|mark| assert_eq!(mark.provenance.classes, ["motion"])).collect()
}

/// Points along a path, close together.
fn along(mark: &Mark) -> Vec<Point> {
    let path = match &mark.paint {
        Paint::Outline(outline) => &outline.axis,
        _ => &mark.path,
    };
    path.segments().flat_map(|s: PathSeg| (0..=1000).map(move |k| s.eval(f64::from(k) / 1000.0))).collect()
}

/// Where a line begins and ends; the way that it shows goes back along `back`.
fn ends(mark: &Mark, back: kurbo::Vec2) -> [Point; 2] {
    let points = along(mark);
    let (first, last) = (points[0], points[points.len() - 1]);
    if (last - first).dot(back) > 0.0 { [first, last] } else { [last, first] }
}

/// To the left: what comes from there shows it.
const LEFT: kurbo::Vec2 = kurbo::Vec2::new(-1.0, 0.0);

/// A camera before the x-y plane, 100 px a unit, the origin in the middle.
fn before() -> Camera {
    orthographic(DVec3::Z * 50.0, DVec3::ZERO, 10.0)
}

fn unit_box() -> Solid {
    cuboid(DVec3::splat(-0.5), DVec3::splat(0.5))
}

#[test]
fn what_goes_straight_leaves_straight_lines_of_the_right_length() {
    // Slightly turned, so that no two corners go behind each other.
    let slant = DQuat::from_euler(glam::EulerRot::XYZ, 0.3, 0.2, 0.1);
    let solid = unit_box().moved(|p| slant * p);
    let speed = DVec3::new(1.2, 0.6, 0.0);
    let model = rigged(vec![solid.clone()], vec![going(0, speed)]);
    let (camera, time) = (before(), 1.5);
    let eye = Eye::new(&camera);
    let style = style(&["motion.over=true", "motion.lines=8", "chain.tidy=0"]);
    let scene = scene_at(&model, time, &style);
    let movers = scene.movers.as_ref().unwrap();
    assert_eq!((movers.len(), movers[0].trails.len()), (1, 8));
    for trail in &movers[0].trails {
        let start = trail.points[0] - speed * time;
        assert!(solid.positions.iter().any(|p| p.distance(start) < 1e-9), "{start}");
        assert_eq!(trail.points.len(), 81);
    }
    let drawing = drawn(&model, time, &camera, &style);
    let drawn = lines(&drawing);
    let way = eye.image(-speed * BACK) - eye.image(DVec3::ZERO);
    for mark in &drawn {
        let start = along(mark)[0];
        let beside = |p: Point| (p - start).cross(way).abs() / way.hypot();
        assert!(along(mark).into_iter().all(|p| beside(p) < 1e-3), "{:?}", mark.path);
    }
    // Where each corner was as far back as lines go, one ends; what of it is before the box begins where the corner is.
    let mut whole = 0;
    for corner in &solid.positions {
        let [from, to] = [time, time - BACK].map(|time| eye.image(*corner + speed * time));
        let own: Vec<_> = drawn.iter().filter(|mark| ends(mark, way)[1].distance(to) < 1e-3).collect();
        assert_eq!(own.len(), 1, "{to:?}");
        whole += usize::from(ends(own[0], way)[0].distance(from) < 1e-3);
    }
    assert!(whole >= 2, "{whole}");
    assert!((way.hypot() - 100.0 * speed.length() * BACK).abs() < 1e-9);
}

#[test]
fn lines_begin_where_their_body_ends() {
    let speed = DVec3::X * 2.0;
    let model = rigged(vec![unit_box()], vec![going(0, speed)]);
    let camera = perspective(DVec3::new(0.0, 0.0, 12.0), DVec3::ZERO, 50.0);
    let eye = Eye::new(&camera);
    let drawing = drawn(&model, 1.0, &camera, &style(&["motion.lines=8"]));
    let drawn = lines(&drawing);
    let [back, front] = [-0.5, 0.5].map(|z| eye.image(DVec3::new(1.5, 0.0, z)).x);
    // Those of corners one behind the other along the way coincide in part, and are drawn once.
    let starts: Vec<Point> = drawn.iter().map(|mark| ends(mark, LEFT)[0]).collect();
    assert!(starts.iter().all(|start| start.x < front + 2e-3), "{starts:?} {front}");
    for height in [0.5, -0.5].map(|y| eye.image(DVec3::new(1.5, y, 0.5)).y) {
        let first = starts.iter().filter(|start| (start.y - height).abs() < 1e-2).map(|start| start.x);
        assert!((first.fold(0.0, f64::max) - front).abs() < 2e-3, "{starts:?} {front}");
    }
    assert!(starts.iter().filter(|start| (start.x - back).abs() < 2e-3 || start.x > back).count() >= 2);
}

#[test]
fn what_turns_leaves_arcs() {
    for (solid, degrees) in [(cuboid(DVec3::splat(-1.5), DVec3::splat(1.5)), 90.0), (unit_box(), 150.0)] {
        let model = rigged(vec![solid.clone()], vec![turning(0, degrees)]);
        let style = style(&["motion.over=true", "motion.lines=8", "motion.speed=0.1"]);
        let camera = before();
        let drawing = drawn(&model, 2.03, &camera, &style);
        let drawn = lines(&drawing);
        let radius = 100.0 * solid.positions[0].truncate().length();
        let middle = Point::new(500.0, 500.0);
        assert!(!drawn.is_empty());
        for mark in &drawn {
            let points = along(mark);
            for point in &points {
                assert!((point.distance(middle) - radius).abs() < 0.1, "{} {radius}", point.distance(middle));
            }
            let curves = mark.path.elements().len();
            assert!(curves < 12, "a smooth curve of {curves} pieces");
        }
        let arcs = drawn.iter().map(|mark| along(mark).windows(2).map(|p| p[0].distance(p[1])).sum::<f64>());
        let longest = arcs.fold(0.0, f64::max);
        let whole = radius * (degrees * BACK).to_radians();
        assert!((longest - whole).abs() < 0.2, "{longest} {whole}");
    }
    // Where the way ran elsewhere than now by more than 60 degrees, lines end.
    let model = rigged(vec![unit_box()], vec![turning(0, 150.0)]);
    let style = style(&["motion.over=true", "motion.turn=60", "motion.speed=0"]);
    for mark in lines(&drawn(&model, 2.0, &before(), &style)) {
        let angle =
            along(mark).windows(2).map(|p| p[0].distance(p[1])).sum::<f64>() / (50.0 * 2.0_f64.sqrt());
        assert!(angle < 61_f64.to_radians(), "{}", angle.to_degrees());
    }
    // The way of the middle of what turns about it is none.
    let own = self::style(&["motion.path=body", "motion.speed=0"]);
    assert!(lines(&drawn(&model, 2.0, &before(), &own)).is_empty());
}

#[test]
fn what_is_before_lines_hides_them_exactly() {
    let board = cuboid(DVec3::new(0.1, -3.0, 2.0), DVec3::new(0.6, 3.0, 2.1));
    let model = rigged(vec![unit_box(), board], vec![going(0, DVec3::X * 3.0)]);
    let style = style(&["motion.lines=8", "motion.speed=1", "lines.hidden=dashed"]);
    // The box is at 3 now and was at 0.5 as far back as lines go, its left side at 0: these pass the board.
    let drawing = drawn(&model, 1.0, &before(), &style);
    let drawn = lines(&drawing);
    for height in [450.0, 550.0] {
        let own =
            drawn.iter().map(|mark| ends(mark, LEFT)).filter(|[start, _]| (start.y - height).abs() < 1e-2);
        let mut pieces: Vec<[f64; 2]> = own.map(|[a, b]| [a.x.min(b.x), a.x.max(b.x)]).collect();
        pieces.sort_by(|a, b| a[0].total_cmp(&b[0]));
        pieces.dedup_by(|next, last| {
            let touches = (next[0] - last[1]).abs() < 1e-2;
            last[1] = if touches { next[1] } else { last[1] };
            touches
        });
        assert_eq!(
            pieces.len(),
            2,
            "{pieces:?} {:?}",
            drawn.iter().map(|m| ends(m, LEFT)).collect::<Vec<_>>()
        );
        for (x, expected) in pieces.iter().flatten().zip([500.0, 510.0, 560.0, 750.0]) {
            assert!((x - expected).abs() < 1e-2, "{pieces:?}");
        }
    }
}

/// Whether a ray through a place of the image meets a triangle nearer than a depth.
fn is_covered(eye: &Eye, at: Point, depth: f64, triangles: &[[DVec3; 3]]) -> bool {
    let (near, far) = (eye.world(at, 0.0), eye.world(at, 1.0));
    let (from, way) = if eye.perspective { (eye.eye, far - eye.eye) } else { (near, far - near) };
    triangles.iter().any(|[a, b, c]| {
        let (u, v) = (*b - *a, *c - *a);
        let p = way.cross(v);
        let det = u.dot(p);
        if det.abs() < 1e-14 {
            return false;
        }
        let s = from - *a;
        let (x, q) = (s.dot(p) / det, s.cross(u));
        let (y, t) = (way.dot(q) / det, v.dot(q) / det);
        x >= 0.0 && y >= 0.0 && x + y <= 1.0 && t > 0.0 && eye.depth(from + way * t) < depth
    })
}

fn world_triangles(scene: &Scene, part: usize) -> Vec<[DVec3; 3]> {
    let shown = &scene.parts[part];
    let Geometry { positions, triangles, .. } = &scene.geometries[shown.geometry];
    let corner = |v: u32| shown.world_from_part.transform_point3(positions[v as usize]);
    triangles.iter().map(|t| t.map(corner)).collect()
}

#[test]
fn lines_are_drawn_where_rays_say_so() {
    let model = Rigged::open("examples/models/brick.glb").unwrap();
    let own = style(&["motion.parts=['brick', 'fist-*', 'hat']", "chain.tidy=0", "motion.lines=3"]);
    let (mut seen, mut hidden) = (0, 0);
    for (time, eye_at) in [
        (0.7, DVec3::new(0.5, 1.7, 6.4)),
        (1.0, DVec3::new(-4.0, 2.5, 4.0)),
        (1.3, DVec3::new(3.0, 0.7, 3.5)),
        (1.5, DVec3::new(1.0, 4.0, -5.0)),
    ] {
        let camera = perspective(eye_at, DVec3::new(0.05, 1.2, 0.0), 40.0);
        let eye = Eye::new(&camera);
        let scene = scene_at(&model, time, &own);
        let all: Vec<[DVec3; 3]> = (0..scene.parts.len()).flat_map(|p| world_triangles(&scene, p)).collect();
        let drawing = render(&scene, &camera, &own).unwrap();
        let drawn: Vec<Point> = lines(&drawing).into_iter().flat_map(along).collect();
        let near = |at: Point| drawn.iter().any(|p| p.distance(at) < 0.5);
        let movers = scene.movers.as_ref().unwrap();
        let trails: Vec<(usize, &ligne::scene::Trail)> =
            movers.iter().flat_map(|m| m.trails.iter().map(|trail| (m.part, trail))).collect();
        for (number, (part, trail)) in trails.iter().enumerate() {
            let body = world_triangles(&scene, *part);
            for pair in trail.points.array_windows::<2>().step_by(2) {
                let middle = pair[0].midpoint(pair[1]);
                let (at, depth) = (eye.image(middle), eye.depth(middle));
                if !(5.0..995.0).contains(&at.x) || !(5.0..995.0).contains(&at.y) {
                    continue;
                }
                // Close to where it changes, either may be.
                let covered = |at: Point| {
                    is_covered(&eye, at, depth - 1e-4, &all) || is_covered(&eye, at, f64::INFINITY, &body)
                };
                let truth = covered(at);
                let around = (0..8).map(|k| f64::from(k) / 8.0 * TAU);
                let firm =
                    around.map(|a| at + kurbo::Vec2::new(cos(a), sin(a)) * 2.5).all(|p| covered(p) == truth);
                let crowded = trails.iter().enumerate().any(|(other, (_, t))| {
                    other != number && t.points.iter().any(|p| eye.image(*p).distance(at) < 6.0)
                });
                if !firm || crowded {
                    continue;
                }
                assert_eq!(near(at), !truth, "{time} s: line {} of part {part} at {at:?}", trail.line);
                if truth { hidden += 1 } else { seen += 1 }
            }
        }
    }
    assert!(seen > 100 && hidden > 30, "{seen} {hidden}");
}

#[test]
fn lines_begin_at_the_same_vertices_all_the_time() {
    let speed = DVec3::new(1.0, 0.3, -0.2);
    let model = rigged(vec![unit_box()], vec![going(0, speed)]);
    let starts = |time: f64, changes: &[&str]| -> Vec<DVec3> {
        let scene = scene_at(&model, time, &style(changes));
        let trails = &scene.movers.as_ref().unwrap()[0].trails;
        trails.iter().map(|trail| (2.0 * (trail.points[0] - speed * time)).round() + DVec3::ZERO).collect()
    };
    let first = starts(0.5, &["motion.lines=4"]);
    assert_eq!(first.len(), 4);
    assert!([0.9, 1.7, 3.1].iter().all(|time| starts(*time, &["motion.lines=4"]) == first));
    assert!((1..6).any(|seed| starts(0.5, &["motion.lines=4", &format!("seed={seed}")]) != first));
    // More lines leave those there are where they are.
    assert_eq!(starts(0.5, &[])[..4], first);
    // How the file numbers its vertices does not matter.
    let mut solid = unit_box();
    solid.positions.reverse();
    solid.triangles.iter_mut().for_each(|t| *t = t.map(|v| 7 - v));
    let other = rigged(vec![solid], vec![going(0, speed)]);
    let svg = |model: &Rigged| drawn(model, 1.0, &before(), &style(&[])).to_svg(&SvgOptions::default());
    assert_eq!(svg(&model), svg(&other));
}

#[test]
fn what_is_slower_than_the_threshold_leaves_none() {
    // One goes 2 units, 200 px, a second; one half as fast; one stands.
    let at = |x: f64| unit_box().moved(|p| p + DVec3::new(0.0, x, 0.0));
    let model =
        rigged(vec![at(-2.0), at(0.0), at(2.0)], vec![going(0, DVec3::X * 2.0), going(1, DVec3::X * 1.0)]);
    let parts = |changes: &[&str]| -> Vec<String> {
        let drawing = drawn(&model, 1.0, &before(), &style(changes));
        let mut names: Vec<String> =
            lines(&drawing).iter().map(|mark| mark.provenance.part.as_ref().unwrap().to_string()).collect();
        names.dedup();
        names
    };
    assert_eq!(parts(&["motion.speed=1.99"]), ["part 0"]);
    assert_eq!(parts(&["motion.speed=0.99"]), ["part 0", "part 1"]);
    assert!(parts(&["motion.speed=2.01"]).is_empty());
    assert_eq!(parts(&["motion.speed=199px"]), ["part 0"]);
    assert_eq!(parts(&["motion.speed=99px"]), ["part 0", "part 1"]);
    assert_eq!(parts(&["motion.speed=53mm"]), Vec::<String>::new());
    // By names, of parts or nodes; and either way.
    assert_eq!(parts(&["motion.parts=part 1"]), ["part 1"]);
    assert_eq!(parts(&["motion.parts=['node 1', '*2']"]), ["part 1"]);
    assert_eq!(parts(&["motion.parts=part 1", "motion.speed=1.5"]), ["part 0", "part 1"]);
    // Half the model's size, 5.2 units, a second.
    assert!(parts(&[]).is_empty());
    assert!(parts(&["motion.enabled=false", "motion.speed=1"]).is_empty());
    // The file says it too, of all that hangs on a node.
    let mut told = model.clone();
    told.rig.nodes[1].leaves_lines = true;
    assert!(!lines(&drawn(&told, 1.0, &before(), &style(&[]))).is_empty());
    // What is left out leaves none, and others keep theirs.
    let style = style(&["motion.speed=0.5"]);
    let mut scene = scene_at(&model, 1.0, &style);
    scene.keep_parts(&[], &["part 0".to_owned()]);
    let left = render(&scene, &before(), &style).unwrap();
    assert!(lines(&left).iter().all(|mark| mark.provenance.part.as_deref() == Some("part 1")));
    assert!(!lines(&left).is_empty());
}

/// An arm along x of one part, whose far half a second joint swings about the origin.
fn arm(upper: f64, lower: f64) -> Rigged {
    let solid = cuboid(DVec3::new(-2.0, -0.2, -0.2), DVec3::new(2.0, 0.2, 0.2));
    let mut model = rigged(vec![solid.clone()], vec![turning(1, upper), turning(2, lower)]);
    let far: Vec<u32> = solid.positions.iter().map(|p| u32::from(p.x > 0.0)).collect();
    let rig = &mut model.rig;
    rig.nodes = vec![node("arm", None), node("shoulder", None), node("hand", Some(1))];
    rig.order = vec![0, 1, 2];
    rig.skins = vec![Skin { joints: vec![1, 2], binds: vec![DAffine3::IDENTITY; 2] }];
    let sets = vec![Influences {
        joints: far.iter().map(|joint| [*joint, 1 - *joint, 0, 0]).collect(),
        weights: vec![[0.75, 0.25, 0.0, 0.0]; 8],
    }];
    let body = Body { positions: solid.positions, sets, ..Body::default() };
    rig.forms = vec![Form { node: 0, skin: Some(0), bodies: vec![body] }];
    model
}

#[test]
fn joints_leave_lines_by_themselves() {
    let model = arm(0.0, 60.0);
    let own = style(&["motion.speed=0.9", "motion.over=true"]);
    let scene = scene_at(&model, 1.0, &own);
    let movers = scene.movers.as_ref().unwrap();
    let chosen: Vec<_> = movers.iter().filter(|mover| mover.chosen).collect();
    assert_eq!(chosen.len(), 1, "the hand alone is fast");
    assert_eq!(chosen[0].trails.len(), 4, "it has four corners");
    let drawing = render(&scene, &before(), &own).unwrap();
    assert!(!lines(&drawing).is_empty());
    // By the name of the joint, and of one above it.
    for name in ["hand", "h?nd", "shoulder"] {
        let own = style(&[&format!("motion.parts={name}"), "motion.over=true"]);
        let named = drawn(&model, 1.0, &before(), &own);
        assert!(!lines(&named).is_empty(), "{name}");
    }
    // Joints that move together share the lines of one body, the outermost first.
    let model = arm(50.0, 50.0);
    let own = style(&["motion.speed=0.1", "motion.over=true", "motion.lines=3", "chain.tidy=0"]);
    let both = drawn(&model, 1.0, &orthographic(DVec3::new(3.0, 5.0, 50.0), DVec3::ZERO, 10.0), &own);
    let names: Vec<_> = lines(&both);
    assert!(!names.is_empty() && names.len() <= 6, "{}", names.len());
    let scene = scene_at(&model, 1.0, &own);
    let above: Vec<Option<usize>> = scene.movers.as_ref().unwrap().iter().map(|m| m.above).collect();
    assert_eq!(above, [None, Some(0)]);
}

#[test]
fn single_lines_differ_as_the_style_says() {
    let speed = DVec3::X * 2.0;
    let model = rigged(vec![unit_box()], vec![going(0, speed)]);
    let list = "[{ start = 6, length = 6, width = 3, colour = '#ff0000' }, { visible = false }, { part = 'other*' }]";
    let own = style(&["motion.lines=2", "motion.over=true", &format!("motion.line={list}")]);
    let scene = scene_at(&model, 1.0, &own);
    let trails = &scene.movers.as_ref().unwrap()[0].trails;
    assert_eq!(trails.len(), 1, "one of two is not drawn");
    assert_eq!(trails[0].points[0], unit_box().positions[6] + speed);
    assert_eq!(trails[0].points.len(), 6 * motion::POINTS_A_SEGMENT + 1);
    let drawing = render(&scene, &before(), &own).unwrap();
    let [mark] = lines(&drawing)[..] else { panic!("one line") };
    let Paint::Stroke(stroke) = &mark.paint else { panic!("{:?}", mark.paint) };
    assert_eq!((stroke.width, stroke.colour), (3.0, ligne::math::colour::Colour::rgb(255, 0, 0)));
    // A vertex that is not there is told.
    let own = style(&["motion.line=[{ start = 99 }]"]);
    let scene = scene_at(&model, 1.0, &own);
    assert!(
        scene.warnings.lines().iter().any(|line| line.contains("vertex 99")),
        "{:?}",
        scene.warnings.lines()
    );
}

#[test]
fn lines_are_black_and_1_px_and_may_taper() {
    let model = rigged(vec![unit_box()], vec![going(0, DVec3::X * 2.0)]);
    let plain = drawn(&model, 1.0, &before(), &style(&["motion.over=true"]));
    for mark in lines(&plain) {
        let Paint::Stroke(stroke) = &mark.paint else { panic!("{:?}", mark.paint) };
        assert_eq!((stroke.width, stroke.colour), (1.0, ligne::math::colour::Colour::BLACK));
    }
    let tapered = drawn(
        &model,
        1.0,
        &before(),
        &style(&["motion.lines=1", "motion.line=[{ start = 6 }]", "motion.taper=1", "motion.width=4"]),
    );
    for mark in lines(&tapered) {
        let Paint::Outline(outline) = &mark.paint else { panic!("{:?}", mark.paint) };
        assert!(outline.width > 0.5 && outline.width < 3.0, "{}", outline.width);
        let [start, end] = ends(mark, LEFT);
        let wide = |at: f64| {
            let near = mark.path.segments().flat_map(|s| (0..=50).map(move |k| s.eval(f64::from(k) / 50.0)));
            near.filter(|p| (p.x - at).abs() < 3.0).map(|p| (p.y - start.y).abs()).fold(0.0, f64::max)
        };
        let [near, far] = [wide(start.x - 8.0), wide(end.x + 8.0)];
        assert!(far < 0.3 && near > far + 0.5, "{near} {far} {start:?} {end:?}");
    }
    assert!(!lines(&tapered).is_empty());
    // A rule for this kind of line changes its pen; one for all kinds does not.
    let ruled = drawn(&model, 1.0, &before(), &style(&["pen.motion.dash=[4, 2]", "pen.width=9"]));
    let strokes: Vec<_> = lines(&ruled)
        .iter()
        .map(|mark| match &mark.paint {
            Paint::Stroke(stroke) => (stroke.width, stroke.dash.is_empty()),
            other => panic!("{other:?}"),
        })
        .collect();
    assert!(strokes.iter().all(|(width, _)| *width == 1.0) && strokes.iter().any(|(_, solid)| !solid));
}

#[test]
fn no_other_ink_changes() {
    let model = Rigged::open("examples/models/brick.glb").unwrap();
    let camera = model.scene.cameras[0].camera;
    for name in ["ink", "toon", "comic"] {
        let load = |sets: &[&str]| {
            let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
            Style::load(name, &sets).unwrap()
        };
        let with = drawn(&model, 1.0, &camera, &load(&["motion.enabled=true"]));
        let without = drawn(&model, 1.0, &camera, &load(&[]));
        let kinds: Vec<LayerKind> = with.layers.iter().map(|layer| layer.kind).collect();
        assert!(kinds.contains(&LayerKind::Motion) && kinds.is_sorted(), "{kinds:?}");
        let others: Vec<_> =
            with.layers.iter().filter(|layer| layer.kind != LayerKind::Motion).cloned().collect();
        assert_eq!(others, without.layers);
        // The file says that the brick leaves lines, and nothing else.
        assert!(lines(&with).iter().all(|mark| mark.provenance.part.as_deref() == Some("brick")));
    }
}

#[test]
fn the_same_bytes_with_any_number_of_threads() {
    let model = Rigged::open("examples/models/brick.glb").unwrap();
    let camera = model.scene.cameras[0].camera;
    let own = style(&["motion.speed=0.5", "motion.taper=1"]);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| drawn(&model, 1.1, &camera, &own).to_svg(&SvgOptions::default()))
    };
    let one = with(1);
    assert!(one.contains(r#"class="motion""#) && one.contains("data-axis"));
    assert_eq!(one, with(2));
    assert_eq!(one, with(7));
}

#[test]
fn without_a_moment_there_are_none_and_a_warning() {
    let own = style(&[]);
    let model = rigged(vec![unit_box()], vec![going(0, DVec3::X)]);
    let told = |drawing: &Drawing| drawing.warnings.iter().any(|warning| warning.contains("no motion lines"));
    let still = render(&model.scene, &before(), &own).unwrap();
    assert!(told(&still) && lines(&still).is_empty());
    assert!(!told(&drawn(&model, 0.0, &before(), &own)));
    assert!(!told(&render(&model.scene, &before(), &Style::default()).unwrap()));
    let none = Rigged::from(model.scene);
    assert!(told(&render(&motion::posed(&none, &[], &own.motion, 0).unwrap(), &before(), &own).unwrap()));
}

#[test]
fn wrong_values_are_refused() {
    for (change, what, remedy) in [
        ("motion.lines=0", "0 is not so many", "a whole number from 1 to 1000"),
        ("motion.segments=2.5", "2.5 is not so many", "a whole number from 1 to 1000"),
        ("motion.rate=0", "0 segments a second", "a number from 0.001 to 10000"),
        ("motion.turn=200", "200 is not how far a way turns", "degrees from 0 to 180"),
        ("motion.taper=2", "2 is not a fraction", "a number from 0 to 1"),
        ("motion.speed=-1", "-1 is no speed", "model units a second, at least 0"),
        ("motion.speed=fast", "`fast` is no speed", "such as \"200px\""),
        ("motion.path=way", "unknown value `way`", "known values: vertex, body"),
        ("motion.line=[{ lenght = 3 }]", "unknown key `lenght`", "did you mean `length`?"),
        ("motion.segmnts=3", "unknown key `segmnts`", "did you mean `segments`?"),
        ("motion.line=[{ length = 0 }]", "0 is not so many", "a whole number"),
    ] {
        let error = Style::load("ink", &[change.to_owned()]).unwrap_err().to_string();
        assert!(error.contains(&format!("--set {change}")) && error.contains(what), "{change}: {error}");
        assert!(error.contains(remedy), "{change}: {error}");
    }
}
