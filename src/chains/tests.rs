//! Tests of the whole stage on small view maps.

mod random_walks;

use kurbo::{ParamCurve, PathEl, PathSeg};

use super::*;
use crate::geometry::numbers::portable_math::{cos, sin};
use crate::geometry::plane::planar_distance::segment_distance_squared;
use crate::surface::MeshSource;
use crate::visibility::{ViewEdge, ViewVertex, ViewVertexId, ViewVertexKind};

/// Points, kind of line, and whether it lies on a smooth surface.
type Polyline = (Vec<(f64, f64)>, LineKind, bool);

/// A view map of polylines. Points with equal coordinates share a vertex.
fn map_of(lines: &[Polyline]) -> ViewMap {
    let mut map = ViewMap::default();
    for (points, kind, smooth) in lines {
        let ids: Vec<ViewVertexId> = points
            .iter()
            .map(|(x, y)| {
                let position = Point::new(*x, *y);
                let found = map.vertices.iter().position(|v| v.position == position);
                let id = found.unwrap_or_else(|| {
                    map.vertices.push(ViewVertex {
                        position,
                        depth: 1.0,
                        strength: 1.0,
                        kind: ViewVertexKind::Vertex,
                    });
                    map.vertices.len() - 1
                });
                ViewVertexId(id as u32)
            })
            .collect();
        for pair in ids.windows(2) {
            map.edges.push(ViewEdge {
                start: pair[0],
                end: pair[1],
                kind: *kind,
                invisibility: 0,
                silhouette: false,
                both_seen: false,
                smooth: *smooth,
                origin: if *smooth { MeshSource::Scanned } else { MeshSource::Constructed },
                strength: 90.0,
                part: PartId(0),
                material: MaterialId(0),
                segment: map.edges.len() as u32,
            });
        }
    }
    map
}

/// Chains including hidden lines, in px.
fn linked(map: &ViewMap, options: &ChainOptions, unit: Unit) -> Vec<Chain> {
    link(map, options, unit, HiddenLines::Solid)
}

fn off() -> ChainOptions {
    let none = Length::px(0.0);
    ChainOptions { smooth: none, simplify: none, tidy: none, fit: false, ..ChainOptions::default() }
}

/// A circle with the zigzag of a mesh contour.
fn jagged_circle(radius: f64, count: usize, zigzag: f64) -> Vec<(f64, f64)> {
    let mut points: Vec<(f64, f64)> = (0..count)
        .map(|k| {
            let angle = std::f64::consts::TAU * k as f64 / count as f64;
            let r = radius + if k % 2 == 0 { zigzag } else { -zigzag };
            (300.0 + r * cos(angle), 300.0 + r * sin(angle))
        })
        .collect();
    points.push(points[0]);
    points
}

fn length_of(points: &[Point], closed: bool) -> f64 {
    let ring = points.iter().chain(points.first().filter(|_| closed));
    ring.clone().zip(ring.skip(1)).map(|(a, b)| a.distance(*b)).sum()
}

fn samples(path: &BezPath) -> Vec<Point> {
    path.segments()
        .flat_map(|s: PathSeg| (0..=32).map(move |k| s.eval(f64::from(k) / 32.0)).collect::<Vec<_>>())
        .collect()
}

#[test]
fn a_hexagon_with_a_star_inside_is_one_ring_and_three_spokes() {
    let corner = |k: usize| {
        let angle = std::f64::consts::TAU * k as f64 / 6.0;
        (100.0 + 80.0 * cos(angle), 100.0 + 80.0 * sin(angle))
    };
    let ring: Vec<(f64, f64)> = (0..6).chain([0]).map(corner).collect();
    let mut lines = vec![(ring, LineKind::Contour, false)];
    lines.extend([0, 2, 4].map(|k| (vec![(100.0, 100.0), corner(k)], LineKind::Crease, false)));
    let chains = linked(&map_of(&lines), &ChainOptions::default(), Unit::Px);
    assert_eq!(chains.len(), 4);
    assert!(chains[0].closed);
    assert_eq!(chains[0].points.len(), 6);
    assert!(chains.iter().flat_map(|c| c.path.elements()).all(|e| !matches!(e, PathEl::CurveTo(..))));
}

#[test]
fn pieces_of_a_straight_edge_become_one_segment() {
    let line: Vec<(f64, f64)> = (0..10).map(|k| (10.0 + f64::from(k), 20.0 + 2.0 * f64::from(k))).collect();
    for options in [off(), ChainOptions::default()] {
        let chains = linked(&map_of(&[(line.clone(), LineKind::Border, false)]), &options, Unit::Px);
        assert_eq!(chains.len(), 1);
        assert_eq!(chains[0].path.elements().len(), 2);
        assert_eq!(chains[0].points, [Point::new(10.0, 20.0), Point::new(19.0, 38.0)]);
    }
}

#[test]
fn a_crossing_is_passed_straight_on() {
    let lines = [
        (vec![(0.0, 0.0), (10.0, 11.0), (21.0, 20.0)], LineKind::Crease, false),
        (vec![(0.0, 20.0), (10.0, 11.0), (20.0, 0.0)], LineKind::Crease, false),
    ];
    let chains = linked(&map_of(&lines), &off(), Unit::Px);
    assert_eq!(chains.len(), 2);
    assert_eq!(chains[0].points.len(), 3);
    assert_eq!((chains[0].points[0], chains[0].points[2]), (Point::new(0.0, 0.0), Point::new(21.0, 20.0)));
}

#[test]
fn a_jagged_circle_becomes_a_round_one_of_few_cubics() {
    let map = map_of(&[(jagged_circle(120.0, 300, 0.35), LineKind::Contour, true)]);
    let chains = linked(&map, &ChainOptions::default(), Unit::Px);
    assert_eq!(chains.len(), 1);
    assert!(chains[0].closed);
    let cubics = chains[0].path.elements().iter().filter(|e| matches!(e, PathEl::CurveTo(..))).count();
    assert!((3..=12).contains(&cubics), "{cubics} cubics");
    for p in samples(&chains[0].path) {
        let r = p.distance(Point::new(300.0, 300.0));
        assert!((r - 120.0).abs() < 0.25, "radius {r}");
    }
    // There is no corner anywhere, including the seam.
    let segments: Vec<PathSeg> = chains[0].path.segments().collect();
    for (a, b) in segments.iter().zip(segments.iter().cycle().skip(1)) {
        let (a, b) = (a.to_cubic(), b.to_cubic());
        let (u, v) = (
            crate::chains::fit::bezier_fit::unit(a.p3 - a.p2),
            crate::chains::fit::bezier_fit::unit(b.p1 - b.p0),
        );
        assert!(u.dot(v) > 0.9999, "kink of cosine {}", u.dot(v));
    }
}

#[test]
fn a_tessellated_rim_becomes_a_curve_and_an_octagon_stays_one() {
    let fine = linked(
        &map_of(&[(jagged_circle(50.0, 64, 0.0), LineKind::Crease, false)]),
        &ChainOptions::default(),
        Unit::Px,
    );
    assert!(fine[0].path.elements().iter().all(|e| !matches!(e, PathEl::LineTo(_))));
    let coarse = linked(
        &map_of(&[(jagged_circle(50.0, 8, 0.0), LineKind::Crease, false)]),
        &ChainOptions::default(),
        Unit::Px,
    );
    assert!(coarse[0].path.elements().iter().all(|e| !matches!(e, PathEl::CurveTo(..))));
    assert_eq!(coarse[0].path.segments().count(), 8);
}

#[test]
fn a_hidden_dip_is_bridged_and_hidden_lines_stay_apart() {
    let line: Vec<(f64, f64)> = (0..100).map(|k| (f64::from(k), 50.0)).collect();
    let mut map = map_of(&[(line, LineKind::Contour, true)]);
    map.edges[30].invisibility = 1;
    let chains = linked(&map, &ChainOptions::default(), Unit::Px);
    assert_eq!(chains.len(), 1);
    assert_eq!(chains[0].invisibility, 0);
    for edge in &mut map.edges[40..60] {
        edge.invisibility = 2;
    }
    map.edges[50].invisibility = 1;
    let chains = linked(&map, &ChainOptions::default(), Unit::Px);
    let hidden: Vec<u16> = chains.iter().map(|c| c.invisibility).collect();
    assert_eq!(hidden, [0, 1, 0]);
}

#[test]
fn crumbs_and_spurs_go_and_the_outline_stays() {
    let outline = jagged_circle(120.0, 300, 0.1);
    let spur = vec![outline[10], (outline[10].0 - 2.0, outline[10].1 + 1.0)];
    let crumb = vec![(300.0, 300.0), (302.0, 300.5)];
    let map = map_of(&[
        (outline, LineKind::Contour, true),
        (spur, LineKind::Contour, true),
        (crumb, LineKind::Crease, false),
    ]);
    let chains = linked(&map, &ChainOptions::default(), Unit::Px);
    assert_eq!(chains.len(), 1);
    assert!(chains[0].closed);
    let (kept, removed) =
        link_with_removed(None, &map, &ChainOptions::default(), Unit::Px, HiddenLines::Solid);
    assert_eq!(kept, chains);
    let reasons: Vec<_> = removed.iter().map(|r| (r.kind, r.reason)).collect();
    assert_eq!(reasons, [(LineKind::Contour, RemovalReason::Spur), (LineKind::Crease, RemovalReason::Crumb)]);
    assert_eq!(removed[1].points, [Point::new(300.0, 300.0), Point::new(302.0, 300.5)]);
}

#[test]
fn a_corner_of_a_smooth_line_is_kept() {
    let mut line: Vec<(f64, f64)> = (0..80).map(|k| (f64::from(k), 0.2 * f64::from(k % 2))).collect();
    line.extend((0..80).map(|k| (80.0 + 0.2 * f64::from(k % 2), f64::from(k))));
    let chains = linked(&map_of(&[(line, LineKind::Contour, true)]), &ChainOptions::default(), Unit::Px);
    assert_eq!(chains.len(), 1);
    let near = samples(&chains[0].path)
        .into_iter()
        .map(|p| p.distance(Point::new(80.0, 0.0)))
        .fold(f64::MAX, f64::min);
    assert!(near < 0.4, "corner cut by {near}");
}

#[test]
fn contours_that_face_each_other_across_a_gap_are_one_line() {
    // A silhouette, a gap of 5 px, and an inner contour that continues it.
    let wave = |k: i32| (f64::from(k), 50.0 + 5.0 * sin(f64::from(k) / 20.0));
    let lines = [
        ((0..100).map(wave).collect(), LineKind::Contour, true),
        ((105..200).map(wave).collect(), LineKind::Contour, true),
    ];
    let mut map = map_of(&lines);
    map.edges[..99].iter_mut().for_each(|edge| edge.silhouette = true);
    let chains = linked(&map, &ChainOptions::default(), Unit::Px);
    assert_eq!(chains.iter().map(|c| c.silhouette).collect::<Vec<_>>(), [true, false]);
    let (end, start) = (chains[0].points.last(), chains[1].points.first());
    assert!(end.is_some() && end == start, "{end:?} {start:?}");
}

#[test]
fn a_long_side_beside_a_seam_keeps_its_silhouette() {
    let wave = |k: i32| (f64::from(k), 50.0 + 5.0 * sin(f64::from(k) / 20.0));
    let outline: Vec<(f64, f64)> = (0..=100).map(wave).collect();
    let (x, y) = wave(103);
    // One side is silhouette, followed by a short non-silhouette stretch that is not drawn separately.
    let short = vec![(x, y), (x + 60.0, y - 20.0), (x + 60.1, y - 20.05)];
    for (turn_first, turn_second) in [(false, false), (false, true), (true, false), (true, true)] {
        let turned = |line: &[(f64, f64)], turn: bool| {
            let mut line = line.to_vec();
            if turn {
                line.reverse();
            }
            (line, LineKind::Contour, true)
        };
        let mut map = map_of(&[turned(&outline, turn_first), turned(&short, turn_second)]);
        map.edges.iter_mut().for_each(|edge| edge.silhouette = true);
        map.edges[if turn_second { 100 } else { 101 }].silhouette = false;
        let chains = linked(&map, &ChainOptions::default(), Unit::Px);
        assert_eq!(
            chains.iter().map(|c| c.silhouette).collect::<Vec<_>>(),
            [true],
            "{turn_first} {turn_second}"
        );
    }
}

#[test]
fn lines_that_pass_each_other_are_one_line() {
    let first: Vec<(f64, f64)> = (0..=110).map(|k| (f64::from(k), 50.0)).collect();
    let second: Vec<(f64, f64)> = (100..=200).map(|k| (f64::from(k), 50.8)).collect();
    let map = map_of(&[(first, LineKind::Contour, true), (second, LineKind::Contour, true)]);
    let chains = linked(&map, &ChainOptions::default(), Unit::Px);
    assert_eq!(chains.len(), 1);
    let drawn = length_of(&chains[0].points, false);
    assert!((199.0..202.0).contains(&drawn), "{drawn}");
}

#[test]
fn a_flake_beside_an_outline_goes_and_a_line_apart_stays() {
    let outline: Vec<(f64, f64)> = (0..200).map(|k| (f64::from(k), 50.0)).collect();
    let beside = |y: f64, end: u32| (80..end).map(|k| (f64::from(k), y)).collect::<Vec<_>>();
    let count = |y: f64, end: u32| {
        let lines = [(outline.clone(), LineKind::Contour, true), (beside(y, end), LineKind::Contour, true)];
        linked(&map_of(&lines), &ChainOptions::default(), Unit::Px).len()
    };
    assert_eq!((count(53.0, 100), count(62.0, 110)), (1, 2));
    let lines = [(outline.clone(), LineKind::Contour, true), (beside(53.0, 100), LineKind::Contour, true)];
    let map = map_of(&lines);
    let (_, removed) = link_with_removed(None, &map, &ChainOptions::default(), Unit::Px, HiddenLines::None);
    assert_eq!(removed.iter().map(|r| r.reason).collect::<Vec<_>>(), [RemovalReason::Double]);
}

#[test]
fn hidden_lines_that_are_not_drawn_are_not_made() {
    let mut map = map_of(&[((0..60).map(|k| (f64::from(k), 50.0)).collect(), LineKind::Border, false)]);
    map.edges[20..40].iter_mut().for_each(|edge| edge.invisibility = 1);
    for options in [off(), ChainOptions::default()] {
        assert_eq!(link(&map, &options, Unit::Px, HiddenLines::None).len(), 2);
        assert_eq!(link(&map, &options, Unit::Px, HiddenLines::Dashed).len(), 3);
    }
}

#[test]
fn a_line_ends_at_its_t_junctions_whatever_is_done_to_it() {
    let front: Vec<(f64, f64)> = (0..120).map(|k| (f64::from(k), 50.0 + 0.2 * f64::from(k % 2))).collect();
    let behind: Vec<(f64, f64)> = (0..80).map(|k| (60.3, 50.2 + f64::from(k))).collect();
    let mut map = map_of(&[(front, LineKind::Contour, true), (behind, LineKind::Contour, true)]);
    let junction = Point::new(60.3, 50.2);
    for vertex in map.vertices.iter_mut().filter(|v| v.position == junction) {
        vertex.kind = ViewVertexKind::TJunction;
    }
    let default = ChainOptions::default();
    let none = Length::px(0.0);
    let all = [
        off(),
        ChainOptions { smooth: none, ..default.clone() },
        ChainOptions { simplify: none, ..default.clone() },
        ChainOptions { tidy: none, ..default.clone() },
        ChainOptions { fit: false, ..default.clone() },
        default,
    ];
    for options in all {
        let chains = linked(&map, &options, Unit::Px);
        let ends = chains.iter().flat_map(|c| [c.points.first(), c.points.last()]).flatten();
        let nearest = ends.map(|p| p.distance(junction)).fold(f64::MAX, f64::min);
        assert!(nearest <= options.smooth.value + 1e-9, "{nearest} with {options:?}");
    }
}

/// Largest distance from the points to the polyline.
fn farthest(points: &[Point], line: &[Point]) -> f64 {
    let to_line = |p: &Point| {
        let sides = line.windows(2).map(|s| segment_distance_squared(*p, s[0], s[1]));
        sides.fold(f64::MAX, f64::min).sqrt()
    };
    points.iter().map(to_line).fold(0.0, f64::max)
}

#[test]
fn smoothing_and_fitting_keep_their_tolerances_both_ways() {
    let jagged = |k: i32| {
        let x = f64::from(k);
        let noise = f64::from((k * 7919) % 13 - 6) / 20.0;
        Point::new(x, 100.0 + 30.0 * sin(x / 40.0) + noise)
    };
    let points: Vec<Point> = (0..400).map(jagged).collect();
    let smoothed = crate::chains::fit::whittaker_smoothing::smooth(&points, false, 0.5);
    assert!(farthest(&smoothed, &points) <= 0.5 + 1e-9);
    assert!(farthest(&points, &smoothed) <= 0.5 + 1e-9);
    let mut path = BezPath::new();
    path.move_to(smoothed[0]);
    crate::chains::fit::curve_path::add_smooth(&smoothed, 0.15, &mut path);
    let dense = |s: PathSeg| (0..=512).map(move |k| s.eval(f64::from(k) / 512.0)).collect::<Vec<_>>();
    let drawn: Vec<Point> = path.segments().flat_map(dense).collect();
    let (out, back) = (farthest(&drawn, &smoothed), farthest(&smoothed, &drawn));
    assert!(back <= 0.15 + 1e-3, "{back}");
    // Between the points, where the line is a chord of the curve, the error may be slightly larger.
    assert!(out <= 0.15 + 0.02, "{out}");
    assert!(path.elements().len() < 40, "{} elements", path.elements().len());
}

#[test]
fn what_of_a_double_runs_by_itself_is_drawn() {
    let straight = |from: i32, to: i32, y: f64| (from..=to).map(move |k| (10.0 * f64::from(k), y));
    let drawn = |off: f64| {
        let long = straight(0, 40, 100.0).collect();
        let beside: Vec<(f64, f64)> = straight(10, 30, 100.8).chain([(300.0 + off, 100.8 + off)]).collect();
        let lines = [(long, LineKind::Contour, true), (beside, LineKind::Contour, true)];
        let chains = linked(&map_of(&lines), &ChainOptions::default(), Unit::Px);
        chains.iter().flat_map(|chain| &chain.points).map(|p| p.y).fold(0.0, f64::max)
    };
    assert!((drawn(30.0) - 130.8).abs() < 0.5, "{}", drawn(30.0));
    // A short uncovered stretch is not drawn.
    assert!((drawn(5.0) - 100.0).abs() < 0.5, "{}", drawn(5.0));
}

#[test]
fn half_a_rim_is_no_noise() {
    let half = |from: usize, joined: bool| -> Vec<(f64, f64)> {
        let at = |k: usize| {
            let angle = std::f64::consts::TAU * k as f64 / 12.0;
            (50.0 + 4.0 * cos(angle), if joined { 50.0 } else { 80.0 } + 4.0 * sin(angle))
        };
        (from..=from + 6).map(|k| at(k % 12)).collect()
    };
    let creases = |joined: bool| {
        let lines = [(half(0, true), LineKind::Contour, false), (half(6, joined), LineKind::Crease, true)];
        let chains = linked(&map_of(&lines), &ChainOptions::default(), Unit::Px);
        chains.iter().filter(|chain| chain.kind == LineKind::Crease).count()
    };
    assert_eq!((creases(true), creases(false)), (1, 0));
}
