//! Motion lines follow the paths of vertices and are hidden where ray casts find geometry in front of them.

use std::f64::consts::TAU;

use glam::{DQuat, DVec3};
use kurbo::Point;
use ligne::animation::Rigged;
use ligne::geometry::numbers::portable_math::{cos, sin};
use ligne::scene::Geometry;
use ligne::{Scene, SvgOptions, render};

use crate::library::support::pipeline::perspective;
use crate::library::support::references::textbook_camera::TextbookCamera;
use crate::library::support::scenes::moving_boxes::*;
use crate::library::support::scenes::solids::cuboid;

#[test]
fn straight_motion_leaves_straight_lines_of_the_right_length() {
    // Slightly rotated: no corner travels behind another one.
    let slant = DQuat::from_euler(glam::EulerRot::XYZ, 0.3, 0.2, 0.1);
    let solid = unit_cube().moved(|p| slant * p);
    let speed = DVec3::new(1.2, 0.6, 0.0);
    let model = rig_solids(vec![solid.clone()], vec![translation_channel(0, speed)]);
    let (camera, time) = (front_camera(), 1.5);
    let eye = TextbookCamera::new(&camera);
    let style = motion_style(&["motion.over=true", "motion.lines=8", "chain.tidy=0"]);
    let scene = posed_scene(&model, time, &style);
    let movers = scene.movers.as_ref().unwrap();
    assert_eq!((movers.len(), movers[0].trails.len()), (1, 8));
    for trail in &movers[0].trails {
        let start = trail.points[0] - speed * time;
        assert!(solid.positions.iter().any(|p| p.distance(start) < 1e-9), "{start}");
        assert_eq!(trail.points.len(), 81);
    }
    let drawing = draw_at(&model, time, &camera, &style);
    let drawn = motion_lines(&drawing);
    let way = eye.project(-speed * DEFAULT_TRAIL_SECONDS) - eye.project(DVec3::ZERO);
    for mark in &drawn {
        let start = points_along(mark)[0];
        let beside = |p: Point| (p - start).cross(way).abs() / way.hypot();
        assert!(points_along(mark).into_iter().all(|p| beside(p) < 1e-3), "{:?}", mark.path);
    }
    // One line ends where each corner was `DEFAULT_TRAIL_SECONDS` seconds ago. A line in front of the box starts at its
    // corner.
    let mut whole = 0;
    for corner in &solid.positions {
        let [from, to] = [time, time - DEFAULT_TRAIL_SECONDS].map(|time| eye.project(*corner + speed * time));
        let own: Vec<_> =
            drawn.iter().filter(|mark| motion_line_ends(mark, way)[1].distance(to) < 1e-3).collect();
        assert_eq!(own.len(), 1, "{to:?}");
        whole += usize::from(motion_line_ends(own[0], way)[0].distance(from) < 1e-3);
    }
    assert!(whole >= 2, "{whole}");
    assert!((way.hypot() - 100.0 * speed.length() * DEFAULT_TRAIL_SECONDS).abs() < 1e-9);
}

#[test]
fn motion_lines_begin_at_the_outline_of_their_body() {
    let speed = DVec3::X * 2.0;
    let model = rig_solids(vec![unit_cube()], vec![translation_channel(0, speed)]);
    let camera = perspective(DVec3::new(0.0, 0.0, 12.0), DVec3::ZERO, 50.0);
    let eye = TextbookCamera::new(&camera);
    let drawing = draw_at(&model, 1.0, &camera, &motion_style(&["motion.lines=8"]));
    let drawn = motion_lines(&drawing);
    let [back, front] = [-0.5, 0.5].map(|z| eye.project(DVec3::new(1.5, 0.0, z)).x);
    // Lines of corners that follow each other on the same path overlap in part and are drawn once.
    let starts: Vec<Point> = drawn.iter().map(|mark| motion_line_ends(mark, TRAIL_LEFT)[0]).collect();
    assert!(starts.iter().all(|start| start.x < front + 2e-3), "{starts:?} {front}");
    for height in [0.5, -0.5].map(|y| eye.project(DVec3::new(1.5, y, 0.5)).y) {
        let first = starts.iter().filter(|start| (start.y - height).abs() < 1e-2).map(|start| start.x);
        assert!((first.fold(0.0, f64::max) - front).abs() < 2e-3, "{starts:?} {front}");
    }
    assert!(starts.iter().filter(|start| (start.x - back).abs() < 2e-3 || start.x > back).count() >= 2);
}

#[test]
fn rotating_bodies_leave_arcs() {
    for (solid, degrees) in [(cuboid(DVec3::splat(-1.5), DVec3::splat(1.5)), 90.0), (unit_cube(), 150.0)] {
        let model = rig_solids(vec![solid.clone()], vec![rotation_channel(0, degrees)]);
        let style = motion_style(&["motion.over=true", "motion.lines=8", "motion.speed=0.1"]);
        let camera = front_camera();
        let drawing = draw_at(&model, 2.03, &camera, &style);
        let drawn = motion_lines(&drawing);
        let radius = 100.0 * solid.positions[0].truncate().length();
        let middle = Point::new(500.0, 500.0);
        assert!(!drawn.is_empty());
        for mark in &drawn {
            let points = points_along(mark);
            for point in &points {
                assert!((point.distance(middle) - radius).abs() < 0.1, "{} {radius}", point.distance(middle));
            }
            let curves = mark.path.elements().len();
            assert!(curves < 12, "a smooth curve of {curves} pieces");
        }
        let arcs =
            drawn.iter().map(|mark| points_along(mark).windows(2).map(|p| p[0].distance(p[1])).sum::<f64>());
        let longest = arcs.fold(0.0, f64::max);
        let whole = radius * (degrees * DEFAULT_TRAIL_SECONDS).to_radians();
        assert!((longest - whole).abs() < 0.2, "{longest} {whole}");
    }
    // Lines end where the direction of travel differs by more than 60 degrees from the current one.
    let model = rig_solids(vec![unit_cube()], vec![rotation_channel(0, 150.0)]);
    let style = motion_style(&["motion.over=true", "motion.turn=60", "motion.speed=0"]);
    for mark in motion_lines(&draw_at(&model, 2.0, &front_camera(), &style)) {
        let angle =
            points_along(mark).windows(2).map(|p| p[0].distance(p[1])).sum::<f64>() / (50.0 * 2.0_f64.sqrt());
        assert!(angle < 61_f64.to_radians(), "{}", angle.to_degrees());
    }
    // The centre of a body that rotates about it has no path.
    let own = self::motion_style(&["motion.path=body", "motion.speed=0"]);
    assert!(motion_lines(&draw_at(&model, 2.0, &front_camera(), &own)).is_empty());
}

#[test]
fn motion_lines_are_hidden_exactly_behind_occluders() {
    let board = cuboid(DVec3::new(0.1, -3.0, 2.0), DVec3::new(0.6, 3.0, 2.1));
    let model = rig_solids(vec![unit_cube(), board], vec![translation_channel(0, DVec3::X * 3.0)]);
    let style = motion_style(&["motion.lines=8", "motion.speed=1", "lines.hidden=dashed"]);
    // The box is at x = 3 now, and was at x = 0.5 at the far end of its lines, with its left side at x = 0.
    // The lines pass behind the board.
    let drawing = draw_at(&model, 1.0, &front_camera(), &style);
    let drawn = motion_lines(&drawing);
    for height in [450.0, 550.0] {
        let own = drawn
            .iter()
            .map(|mark| motion_line_ends(mark, TRAIL_LEFT))
            .filter(|[start, _]| (start.y - height).abs() < 1e-2);
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
            drawn.iter().map(|m| motion_line_ends(m, TRAIL_LEFT)).collect::<Vec<_>>()
        );
        for (x, expected) in pieces.iter().flatten().zip([500.0, 510.0, 560.0, 750.0]) {
            assert!((x - expected).abs() < 1e-2, "{pieces:?}");
        }
    }
}

/// Whether the ray through an image point hits a triangle nearer than `depth`.
fn is_covered(eye: &TextbookCamera, at: Point, depth: f64, triangles: &[[DVec3; 3]]) -> bool {
    let (near, far) = (eye.unproject(at, 0.0), eye.unproject(at, 1.0));
    let (from, way) = if eye.perspective { (eye.position, far - eye.position) } else { (near, far - near) };
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
fn visibility_of_motion_lines_matches_rays() {
    let model = Rigged::open("examples/models/brick.glb").unwrap();
    let own = motion_style(&["motion.parts=['brick', 'fist-*', 'hat']", "chain.tidy=0", "motion.lines=3"]);
    let (mut seen, mut hidden) = (0, 0);
    for (time, eye_at) in [
        (0.7, DVec3::new(0.5, 1.7, 6.4)),
        (1.0, DVec3::new(-4.0, 2.5, 4.0)),
        (1.3, DVec3::new(3.0, 0.7, 3.5)),
        (1.5, DVec3::new(1.0, 4.0, -5.0)),
    ] {
        let camera = perspective(eye_at, DVec3::new(0.05, 1.2, 0.0), 40.0);
        let eye = TextbookCamera::new(&camera);
        let scene = posed_scene(&model, time, &own);
        let all: Vec<[DVec3; 3]> = (0..scene.parts.len()).flat_map(|p| world_triangles(&scene, p)).collect();
        let drawing = render(&scene, &camera, &own).unwrap();
        let drawn: Vec<Point> = motion_lines(&drawing).into_iter().flat_map(points_along).collect();
        let near = |at: Point| drawn.iter().any(|p| p.distance(at) < 0.5);
        let movers = scene.movers.as_ref().unwrap();
        let trails: Vec<(usize, &ligne::scene::Trail)> =
            movers.iter().flat_map(|m| m.trails.iter().map(|trail| (m.part, trail))).collect();
        for (number, (part, trail)) in trails.iter().enumerate() {
            let body = world_triangles(&scene, *part);
            for pair in trail.points.array_windows::<2>().step_by(2) {
                let middle = pair[0].midpoint(pair[1]);
                let (at, depth) = (eye.project(middle), eye.depth(middle));
                if !(5.0..995.0).contains(&at.x) || !(5.0..995.0).contains(&at.y) {
                    continue;
                }
                // Near a change of visibility either result is accepted.
                let covered = |at: Point| {
                    is_covered(&eye, at, depth - 1e-4, &all) || is_covered(&eye, at, f64::INFINITY, &body)
                };
                let truth = covered(at);
                let around = (0..8).map(|k| f64::from(k) / 8.0 * TAU);
                let firm =
                    around.map(|a| at + kurbo::Vec2::new(cos(a), sin(a)) * 2.5).all(|p| covered(p) == truth);
                let crowded = trails.iter().enumerate().any(|(other, (_, t))| {
                    other != number && t.points.iter().any(|p| eye.project(*p).distance(at) < 6.0)
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
fn motion_lines_keep_their_vertices_over_time() {
    let speed = DVec3::new(1.0, 0.3, -0.2);
    let model = rig_solids(vec![unit_cube()], vec![translation_channel(0, speed)]);
    let starts = |time: f64, changes: &[&str]| -> Vec<DVec3> {
        let scene = posed_scene(&model, time, &motion_style(changes));
        let trails = &scene.movers.as_ref().unwrap()[0].trails;
        trails.iter().map(|trail| (2.0 * (trail.points[0] - speed * time)).round() + DVec3::ZERO).collect()
    };
    let first = starts(0.5, &["motion.lines=4"]);
    assert_eq!(first.len(), 4);
    assert!([0.9, 1.7, 3.1].iter().all(|time| starts(*time, &["motion.lines=4"]) == first));
    assert!((1..6).any(|seed| starts(0.5, &["motion.lines=4", &format!("seed={seed}")]) != first));
    // A larger line count keeps the lines of a smaller one.
    assert_eq!(starts(0.5, &[])[..4], first);
    // The vertex order of the file has no effect.
    let mut solid = unit_cube();
    solid.positions.reverse();
    solid.triangles.iter_mut().for_each(|t| *t = t.map(|v| 7 - v));
    let other = rig_solids(vec![solid], vec![translation_channel(0, speed)]);
    let svg = |model: &Rigged| {
        draw_at(model, 1.0, &front_camera(), &motion_style(&[])).to_svg(&SvgOptions::default())
    };
    assert_eq!(svg(&model), svg(&other));
}
