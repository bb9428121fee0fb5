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
fn view_map_of(lines: &[Polyline]) -> ViewMap {
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
fn link_with_hidden_lines(map: &ViewMap, options: &ChainOptions, unit: Unit) -> Vec<Chain> {
    link(map, options, unit, HiddenLines::Solid)
}

fn all_options_off() -> ChainOptions {
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

fn polyline_length(points: &[Point], closed: bool) -> f64 {
    let ring = points.iter().chain(points.first().filter(|_| closed));
    ring.clone().zip(ring.skip(1)).map(|(a, b)| a.distance(*b)).sum()
}

fn sample_path(path: &BezPath) -> Vec<Point> {
    path.segments()
        .flat_map(|s: PathSeg| (0..=32).map(move |k| s.eval(f64::from(k) / 32.0)).collect::<Vec<_>>())
        .collect()
}

#[test]
fn link_joins_a_hexagon_with_spokes_into_a_ring_and_three_lines() {
    let corner = |k: usize| {
        let angle = std::f64::consts::TAU * k as f64 / 6.0;
        (100.0 + 80.0 * cos(angle), 100.0 + 80.0 * sin(angle))
    };
    let ring: Vec<(f64, f64)> = (0..6).chain([0]).map(corner).collect();
    let mut lines = vec![(ring, LineKind::Contour, false)];
    lines.extend([0, 2, 4].map(|k| (vec![(100.0, 100.0), corner(k)], LineKind::Crease, false)));
    let chains = link_with_hidden_lines(&view_map_of(&lines), &ChainOptions::default(), Unit::Px);
    assert_eq!(chains.len(), 4);
    assert!(chains[0].closed);
    assert_eq!(chains[0].points.len(), 6);
    assert!(chains.iter().flat_map(|c| c.path.elements()).all(|e| !matches!(e, PathEl::CurveTo(..))));
}

#[test]
fn collinear_view_edges_become_one_segment() {
    let line: Vec<(f64, f64)> = (0..10).map(|k| (10.0 + f64::from(k), 20.0 + 2.0 * f64::from(k))).collect();
    for options in [all_options_off(), ChainOptions::default()] {
        let chains = link_with_hidden_lines(
            &view_map_of(&[(line.clone(), LineKind::Border, false)]),
            &options,
            Unit::Px,
        );
        assert_eq!(chains.len(), 1);
        assert_eq!(chains[0].path.elements().len(), 2);
        assert_eq!(chains[0].points, [Point::new(10.0, 20.0), Point::new(19.0, 38.0)]);
    }
}

#[test]
fn chains_continue_straight_through_a_crossing() {
    let lines = [
        (vec![(0.0, 0.0), (10.0, 11.0), (21.0, 20.0)], LineKind::Crease, false),
        (vec![(0.0, 20.0), (10.0, 11.0), (20.0, 0.0)], LineKind::Crease, false),
    ];
    let chains = link_with_hidden_lines(&view_map_of(&lines), &all_options_off(), Unit::Px);
    assert_eq!(chains.len(), 2);
    assert_eq!(chains[0].points.len(), 3);
    assert_eq!((chains[0].points[0], chains[0].points[2]), (Point::new(0.0, 0.0), Point::new(21.0, 20.0)));
}

#[test]
fn jagged_contour_circle_is_fitted_by_few_smooth_cubics() {
    let map = view_map_of(&[(jagged_circle(120.0, 300, 0.35), LineKind::Contour, true)]);
    let chains = link_with_hidden_lines(&map, &ChainOptions::default(), Unit::Px);
    assert_eq!(chains.len(), 1);
    assert!(chains[0].closed);
    let cubics = chains[0].path.elements().iter().filter(|e| matches!(e, PathEl::CurveTo(..))).count();
    assert!((3..=12).contains(&cubics), "{cubics} cubics");
    for p in sample_path(&chains[0].path) {
        let r = p.distance(Point::new(300.0, 300.0));
        assert!((r - 120.0).abs() < 0.25, "radius {r}");
    }
    // There is no corner anywhere, including the seam.
    let segments: Vec<PathSeg> = chains[0].path.segments().collect();
    for (a, b) in segments.iter().zip(segments.iter().cycle().skip(1)) {
        let (a, b) = (a.to_cubic(), b.to_cubic());
        let (u, v) = (
            crate::geometry::plane::planar_distance::unit(a.p3 - a.p2),
            crate::geometry::plane::planar_distance::unit(b.p1 - b.p0),
        );
        assert!(u.dot(v) > 0.9999, "kink of cosine {}", u.dot(v));
    }
}

#[test]
fn rim_of_64_sides_is_fitted_by_curves_and_an_octagon_by_lines() {
    let fine = link_with_hidden_lines(
        &view_map_of(&[(jagged_circle(50.0, 64, 0.0), LineKind::Crease, false)]),
        &ChainOptions::default(),
        Unit::Px,
    );
    assert!(fine[0].path.elements().iter().all(|e| !matches!(e, PathEl::LineTo(_))));
    let coarse = link_with_hidden_lines(
        &view_map_of(&[(jagged_circle(50.0, 8, 0.0), LineKind::Crease, false)]),
        &ChainOptions::default(),
        Unit::Px,
    );
    assert!(coarse[0].path.elements().iter().all(|e| !matches!(e, PathEl::CurveTo(..))));
    assert_eq!(coarse[0].path.segments().count(), 8);
}

#[test]
fn short_hidden_gap_is_bridged_and_longer_hidden_line_is_a_chain() {
    let line: Vec<(f64, f64)> = (0..100).map(|k| (f64::from(k), 50.0)).collect();
    let mut map = view_map_of(&[(line, LineKind::Contour, true)]);
    map.edges[30].invisibility = 1;
    let chains = link_with_hidden_lines(&map, &ChainOptions::default(), Unit::Px);
    assert_eq!(chains.len(), 1);
    assert_eq!(chains[0].invisibility, 0);
    for edge in &mut map.edges[40..60] {
        edge.invisibility = 2;
    }
    map.edges[50].invisibility = 1;
    let chains = link_with_hidden_lines(&map, &ChainOptions::default(), Unit::Px);
    let hidden: Vec<u16> = chains.iter().map(|c| c.invisibility).collect();
    assert_eq!(hidden, [0, 1, 0]);
}

#[test]
fn tidying_removes_spurs_and_crumbs_and_keeps_the_contour() {
    let outline = jagged_circle(120.0, 300, 0.1);
    let spur = vec![outline[10], (outline[10].0 - 2.0, outline[10].1 + 1.0)];
    let crumb = vec![(300.0, 300.0), (302.0, 300.5)];
    let map = view_map_of(&[
        (outline, LineKind::Contour, true),
        (spur, LineKind::Contour, true),
        (crumb, LineKind::Crease, false),
    ]);
    let chains = link_with_hidden_lines(&map, &ChainOptions::default(), Unit::Px);
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
fn smoothing_keeps_the_corner_of_a_contour() {
    let mut line: Vec<(f64, f64)> = (0..80).map(|k| (f64::from(k), 0.2 * f64::from(k % 2))).collect();
    line.extend((0..80).map(|k| (80.0 + 0.2 * f64::from(k % 2), f64::from(k))));
    let chains = link_with_hidden_lines(
        &view_map_of(&[(line, LineKind::Contour, true)]),
        &ChainOptions::default(),
        Unit::Px,
    );
    assert_eq!(chains.len(), 1);
    let near = sample_path(&chains[0].path)
        .into_iter()
        .map(|p| p.distance(Point::new(80.0, 0.0)))
        .fold(f64::MAX, f64::min);
    assert!(near < 0.4, "corner cut by {near}");
}

#[test]
fn contours_on_both_sides_of_a_gap_are_extended_until_they_meet() {
    // A silhouette, a gap of 5 px, and an inner contour that continues it.
    let wave = |k: i32| (f64::from(k), 50.0 + 5.0 * sin(f64::from(k) / 20.0));
    let lines = [
        ((0..100).map(wave).collect(), LineKind::Contour, true),
        ((105..200).map(wave).collect(), LineKind::Contour, true),
    ];
    let mut map = view_map_of(&lines);
    map.edges[..99].iter_mut().for_each(|edge| edge.silhouette = true);
    let chains = link_with_hidden_lines(&map, &ChainOptions::default(), Unit::Px);
    assert_eq!(chains.iter().map(|c| c.silhouette).collect::<Vec<_>>(), [true, false]);
    let (end, start) = (chains[0].points.last(), chains[1].points.first());
    assert!(end.is_some() && end == start, "{end:?} {start:?}");
}

#[test]
fn contour_absorbs_a_short_non_silhouette_run_next_to_a_gap() {
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
        let mut map = view_map_of(&[turned(&outline, turn_first), turned(&short, turn_second)]);
        map.edges.iter_mut().for_each(|edge| edge.silhouette = true);
        map.edges[if turn_second { 100 } else { 101 }].silhouette = false;
        let chains = link_with_hidden_lines(&map, &ChainOptions::default(), Unit::Px);
        assert_eq!(
            chains.iter().map(|c| c.silhouette).collect::<Vec<_>>(),
            [true],
            "{turn_first} {turn_second}"
        );
    }
}

#[test]
fn overlapping_ends_of_two_contours_are_merged_into_one_chain() {
    let first: Vec<(f64, f64)> = (0..=110).map(|k| (f64::from(k), 50.0)).collect();
    let second: Vec<(f64, f64)> = (100..=200).map(|k| (f64::from(k), 50.8)).collect();
    let map = view_map_of(&[(first, LineKind::Contour, true), (second, LineKind::Contour, true)]);
    let chains = link_with_hidden_lines(&map, &ChainOptions::default(), Unit::Px);
    assert_eq!(chains.len(), 1);
    let drawn = polyline_length(&chains[0].points, false);
    assert!((199.0..202.0).contains(&drawn), "{drawn}");
}

#[test]
fn short_contour_close_to_a_longer_one_is_removed_as_double() {
    let outline: Vec<(f64, f64)> = (0..200).map(|k| (f64::from(k), 50.0)).collect();
    let beside = |y: f64, end: u32| (80..end).map(|k| (f64::from(k), y)).collect::<Vec<_>>();
    let count = |y: f64, end: u32| {
        let lines = [(outline.clone(), LineKind::Contour, true), (beside(y, end), LineKind::Contour, true)];
        link_with_hidden_lines(&view_map_of(&lines), &ChainOptions::default(), Unit::Px).len()
    };
    assert_eq!((count(53.0, 100), count(62.0, 110)), (1, 2));
    let lines = [(outline.clone(), LineKind::Contour, true), (beside(53.0, 100), LineKind::Contour, true)];
    let map = view_map_of(&lines);
    let (_, removed) = link_with_removed(None, &map, &ChainOptions::default(), Unit::Px, HiddenLines::None);
    assert_eq!(removed.iter().map(|r| r.reason).collect::<Vec<_>>(), [RemovalReason::Double]);
}

#[test]
fn link_makes_no_chains_of_hidden_lines_unless_they_are_drawn() {
    let mut map = view_map_of(&[((0..60).map(|k| (f64::from(k), 50.0)).collect(), LineKind::Border, false)]);
    map.edges[20..40].iter_mut().for_each(|edge| edge.invisibility = 1);
    for options in [all_options_off(), ChainOptions::default()] {
        assert_eq!(link(&map, &options, Unit::Px, HiddenLines::None).len(), 2);
        assert_eq!(link(&map, &options, Unit::Px, HiddenLines::Dashed).len(), 3);
    }
}

#[test]
fn chain_ends_stay_at_t_junctions_under_all_options() {
    let front: Vec<(f64, f64)> = (0..120).map(|k| (f64::from(k), 50.0 + 0.2 * f64::from(k % 2))).collect();
    let behind: Vec<(f64, f64)> = (0..80).map(|k| (60.3, 50.2 + f64::from(k))).collect();
    let mut map = view_map_of(&[(front, LineKind::Contour, true), (behind, LineKind::Contour, true)]);
    let junction = Point::new(60.3, 50.2);
    for vertex in map.vertices.iter_mut().filter(|v| v.position == junction) {
        vertex.kind = ViewVertexKind::TJunction;
    }
    let default = ChainOptions::default();
    let none = Length::px(0.0);
    let all = [
        all_options_off(),
        ChainOptions { smooth: none, ..default.clone() },
        ChainOptions { simplify: none, ..default.clone() },
        ChainOptions { tidy: none, ..default.clone() },
        ChainOptions { fit: false, ..default.clone() },
        default,
    ];
    for options in all {
        let chains = link_with_hidden_lines(&map, &options, Unit::Px);
        let ends = chains.iter().flat_map(|c| [c.points.first(), c.points.last()]).flatten();
        let nearest = ends.map(|p| p.distance(junction)).fold(f64::MAX, f64::min);
        assert!(nearest <= options.smooth.value + 1e-9, "{nearest} with {options:?}");
    }
}

/// Largest distance from the points to the polyline.
fn max_distance_to_polyline(points: &[Point], line: &[Point]) -> f64 {
    let to_line = |p: &Point| {
        let sides = line.windows(2).map(|s| segment_distance_squared(*p, s[0], s[1]));
        sides.fold(f64::MAX, f64::min).sqrt()
    };
    points.iter().map(to_line).fold(0.0, f64::max)
}

#[test]
fn smoothing_and_curve_fitting_stay_within_their_tolerances() {
    let jagged = |k: i32| {
        let x = f64::from(k);
        let noise = f64::from((k * 7919) % 13 - 6) / 20.0;
        Point::new(x, 100.0 + 30.0 * sin(x / 40.0) + noise)
    };
    let points: Vec<Point> = (0..400).map(jagged).collect();
    let smoothed = crate::chains::fit::whittaker_smoothing::smooth(&points, false, 0.5);
    assert!(max_distance_to_polyline(&smoothed, &points) <= 0.5 + 1e-9);
    assert!(max_distance_to_polyline(&points, &smoothed) <= 0.5 + 1e-9);
    let mut path = BezPath::new();
    path.move_to(smoothed[0]);
    crate::chains::fit::curve_path::add_smooth(&smoothed, 0.15, &mut path);
    let dense = |s: PathSeg| (0..=512).map(move |k| s.eval(f64::from(k) / 512.0)).collect::<Vec<_>>();
    let drawn: Vec<Point> = path.segments().flat_map(dense).collect();
    let (out, back) =
        (max_distance_to_polyline(&drawn, &smoothed), max_distance_to_polyline(&smoothed, &drawn));
    assert!(back <= 0.15 + 1e-3, "{back}");
    // Between the points, where the line is a chord of the curve, the error may be slightly larger.
    assert!(out <= 0.15 + 0.02, "{out}");
    assert!(path.elements().len() < 40, "{} elements", path.elements().len());
}

#[test]
fn long_uncovered_stretch_of_a_double_line_is_drawn() {
    let straight = |from: i32, to: i32, y: f64| (from..=to).map(move |k| (10.0 * f64::from(k), y));
    let drawn = |off: f64| {
        let long = straight(0, 40, 100.0).collect();
        let beside: Vec<(f64, f64)> = straight(10, 30, 100.8).chain([(300.0 + off, 100.8 + off)]).collect();
        let lines = [(long, LineKind::Contour, true), (beside, LineKind::Contour, true)];
        let chains = link_with_hidden_lines(&view_map_of(&lines), &ChainOptions::default(), Unit::Px);
        chains.iter().flat_map(|chain| &chain.points).map(|p| p.y).fold(0.0, f64::max)
    };
    assert!((drawn(30.0) - 130.8).abs() < 0.5, "{}", drawn(30.0));
    // A short uncovered stretch is not drawn.
    assert!((drawn(5.0) - 100.0).abs() < 0.5, "{}", drawn(5.0));
}

#[test]
fn crease_that_completes_a_contour_rim_is_not_removed() {
    let half = |from: usize, joined: bool| -> Vec<(f64, f64)> {
        let at = |k: usize| {
            let angle = std::f64::consts::TAU * k as f64 / 12.0;
            (50.0 + 4.0 * cos(angle), if joined { 50.0 } else { 80.0 } + 4.0 * sin(angle))
        };
        (from..=from + 6).map(|k| at(k % 12)).collect()
    };
    let creases = |joined: bool| {
        let lines = [(half(0, true), LineKind::Contour, false), (half(6, joined), LineKind::Crease, true)];
        let chains = link_with_hidden_lines(&view_map_of(&lines), &ChainOptions::default(), Unit::Px);
        chains.iter().filter(|chain| chain.kind == LineKind::Crease).count()
    };
    assert_eq!((creases(true), creases(false)), (1, 0));
}
