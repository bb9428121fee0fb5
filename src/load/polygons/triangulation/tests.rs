//! Triangulations of polygons: convex, concave, with collinear corners, huge; and a slow reference for ear
//! clipping.

use super::*;

fn sound_triangulation(points: &[DVec3]) -> Vec<[u32; 3]> {
    let mut triangles = Vec::new();
    assert_eq!(triangulate(points, &mut triangles), CutOutcome::Sound);
    triangles
}

fn points_in_plane(points: &[(f64, f64)]) -> Vec<DVec3> {
    points.iter().map(|&(x, y)| DVec3::new(x, y, 0.0)).collect()
}

/// Sum of the areas, and the smallest area; a triangulation without overlaps has no negative one.
fn areas(points: &[DVec3], triangles: &[[u32; 3]]) -> (f64, f64) {
    let area = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| points[i as usize]);
        (b - a).cross(c - a).z / 2.0
    };
    (triangles.iter().map(area).sum(), triangles.iter().map(area).fold(f64::MAX, f64::min))
}

#[test]
fn triangulate_splits_quads_along_an_inner_diagonal() {
    let square = points_in_plane(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]);
    assert_eq!(sound_triangulation(&square), [[0, 1, 2], [0, 2, 3]]);
    let dart = points_in_plane(&[(0.0, 0.0), (2.0, -1.0), (0.5, 0.0), (2.0, 1.0)]);
    assert_eq!(sound_triangulation(&dart), [[0, 1, 2], [0, 2, 3]]);
    let turned = points_in_plane(&[(2.0, -1.0), (0.5, 0.0), (2.0, 1.0), (0.0, 0.0)]);
    assert_eq!(sound_triangulation(&turned), [[0, 1, 3], [1, 2, 3]]);
}

#[test]
fn triangulate_fans_convex_polygons() {
    let pentagon = points_in_plane(&[(0.0, 0.0), (2.0, 0.0), (3.0, 1.0), (1.0, 2.0), (-1.0, 1.0)]);
    assert_eq!(sound_triangulation(&pentagon), [[0, 1, 2], [0, 2, 3], [0, 3, 4]]);
}

#[test]
fn triangulate_clips_the_first_ears_of_concave_polygons() {
    let ell = points_in_plane(&[(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)]);
    assert_eq!(sound_triangulation(&ell), [[0, 1, 2], [0, 2, 3], [5, 0, 3], [3, 4, 5]]);
    let (sum, least) = areas(&ell, &sound_triangulation(&ell));
    assert!((sum - 3.0).abs() < 1e-12 && least >= 0.0);
}

#[test]
fn triangulate_leaves_a_bridged_hole_open() {
    let outer = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0), (0.0, 0.0)];
    let inner = [(1.0, 1.0), (1.0, 3.0), (3.0, 3.0), (3.0, 1.0), (1.0, 1.0)];
    let ring = points_in_plane(&[outer, inner].concat());
    let (sum, least) = areas(&ring, &sound_triangulation(&ring));
    assert!((sum - 12.0).abs() < 1e-12 && least >= 0.0);
}

#[test]
fn triangulate_works_in_any_plane_and_orientation() {
    let ell = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)];
    let wanted = sound_triangulation(&points_in_plane(&ell));
    for place in [
        |x: f64, y: f64| DVec3::new(5.0, x, y),
        |x: f64, y: f64| DVec3::new(y, 5.0, x),
        |x: f64, y: f64| DVec3::new(-x, y, 5.0),
        |x: f64, y: f64| DVec3::new(x, y, x + y),
    ] {
        let points: Vec<_> = ell.iter().map(|&(x, y)| place(x, y)).collect();
        assert_eq!(sound_triangulation(&points), wanted);
    }
}

/// Reference: the definition of an ear, without caching.
fn slow_ears(p: &[DVec2]) -> Vec<[u32; 3]> {
    let (mut left, mut out): (Vec<usize>, Vec<[u32; 3]>) = ((0..p.len()).collect(), Vec::new());
    while left.len() > 3 {
        let n = left.len();
        let at = |k: usize| (left[(k + n - 1) % n], left[k], left[(k + 1) % n]);
        let ear = (0..n).find(|&k| {
            let (a, b, c) = at(k);
            has_area(p[a], p[b], p[c])
                && !left.iter().any(|&m| {
                    m != a
                        && m != b
                        && m != c
                        && cross(p[a], p[b], p[m]) >= 0.0
                        && cross(p[b], p[c], p[m]) >= 0.0
                        && cross(p[c], p[a], p[m])
                            >= -MAX_COLLINEAR_SINE * (p[a] - p[c]).length() * (p[m] - p[c]).length()
                        && [a, b, c].iter().all(|&o| p[o] != p[m])
                })
        });
        let (a, b, c) = at(ear.unwrap_or(0));
        out.push([a as u32, b as u32, c as u32]);
        left.remove(ear.unwrap_or(0));
    }
    out.push([left[0] as u32, left[1] as u32, left[2] as u32]);
    out
}

#[test]
fn ear_clipping_matches_a_slow_reference() {
    let mut state = 7_u64;
    for round in 0..300 {
        let n = 5 + round % 40;
        // Stars, some with coinciding corners, and self-intersecting polygons.
        let points: Vec<DVec2> = (0..n)
            .map(|i| {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                let r = f64::from((state >> 40) as u32 % 8) / 4.0;
                let turn = if round % 3 == 0 { 2.0 } else { 1.0 };
                let angle = std::f64::consts::TAU * turn * i as f64 / n as f64;
                DVec2::new(
                    crate::geometry::numbers::portable_math::cos(angle),
                    crate::geometry::numbers::portable_math::sin(angle),
                ) * r
            })
            .collect();
        let mut quick = Vec::new();
        Ears::new(&points).clip(&mut quick);
        assert_eq!(quick, slow_ears(&points), "round {round}");
    }
}

#[test]
fn triangulate_handles_huge_polygons_quickly() {
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let points: Vec<_> = (0..60_000).map(|i| corners[i % 3]).collect();
    let mut triangles = Vec::new();
    assert_eq!(triangulate(&points, &mut triangles), CutOutcome::Sound);
    triangles.clear();
    // A corner pushed inwards makes it concave.
    let jagged: Vec<_> = points.iter().copied().chain([DVec3::new(0.1, 0.2, 0.0)]).collect();
    assert_eq!(triangulate(&jagged, &mut triangles), CutOutcome::TooLarge);
    assert_eq!(triangles.len(), jagged.len() - 2);
    // Repeated corners do not count.
    let ell = [(2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0), (0.0, 0.0)];
    let repeated: Vec<_> =
        points_in_plane(&ell).into_iter().flat_map(|p| std::iter::repeat_n(p, 9_000)).collect();
    assert_eq!(sound_triangulation(&repeated).len(), 4);
    // A comb has few ears at a time, all of them late in the order.
    let comb = |n: usize| -> Vec<DVec3> {
        let teeth = (0..n).map(|i| DVec3::new(i as f64, if i % 2 == 0 { 0.0 } else { 9.0 }, 0.0));
        teeth.rev().chain([DVec3::new(0.0, -1.0, 0.0), DVec3::new(n as f64, -1.0, 0.0)]).collect()
    };
    let points = comb(4000);
    let triangles = sound_triangulation(&points);
    assert_eq!(triangles.len(), points.len() - 2);
    assert!(areas(&points, &triangles).1 >= 0.0);
}

#[test]
fn collinear_corners_give_no_degenerate_triangles() {
    // Triangles, quads and a concave polygon, with corners in the middle of their sides.
    let shapes: [&[(f64, f64)]; 3] = [
        &[(0.0, 0.0), (3.0, 0.1), (1.0, 2.0)],
        &[(0.0, 0.0), (3.0, 0.0), (3.0, 2.0), (0.0, 2.0)],
        &[(0.0, 0.0), (4.0, 0.0), (4.0, 1.0), (1.0, 1.0), (1.0, 3.0), (0.0, 3.0)],
    ];
    // Corners of a plus. Some are collinear across it.
    let plus = [
        (1.0, 0.0),
        (2.0, 0.0),
        (2.0, 1.0),
        (3.0, 1.0),
        (3.0, 2.0),
        (2.0, 2.0),
        (2.0, 3.0),
        (1.0, 3.0),
        (1.0, 2.0),
        (0.0, 2.0),
        (0.0, 1.0),
        (1.0, 1.0),
    ];
    let mut state = 3_u64;
    for _ in 0..500 {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        let angle = (state >> 40) as f64 / 1e5;
        let (sin, cos) = (
            crate::geometry::numbers::portable_math::sin(angle),
            crate::geometry::numbers::portable_math::cos(angle),
        );
        let first = (state >> 20) as usize % 12;
        let at = |k: usize| plus[(first + k) % 12];
        let points: Vec<DVec3> = (0..12)
            .map(|k| DVec3::new(at(k).0 * cos - at(k).1 * sin, at(k).0 * sin + at(k).1 * cos, 0.0))
            .collect();
        let triangles = sound_triangulation(&points);
        let least = triangles.iter().map(|t| {
            let [a, b, c] = t.map(|k| points[k as usize]);
            (b - a).cross(c - a).z
        });
        assert!(least.fold(f64::INFINITY, f64::min) > 1e-3, "{points:?}");
    }
    for shape in shapes {
        for pattern in 1..1_u32 << (2 * shape.len()) {
            let mut points = Vec::new();
            for k in 0..shape.len() {
                let (p, q) = (DVec2::from(shape[k]), DVec2::from(shape[(k + 1) % shape.len()]));
                points.push(p);
                // Zero, one or two corners, off the side by single-precision rounding.
                for t in [0.37, 0.71].into_iter().take((pattern >> (2 * k) & 3) as usize) {
                    points.push(p.lerp(q, t).as_vec2().as_dvec2());
                }
            }
            let points: Vec<DVec3> = points.iter().map(|p| p.extend(0.0)).collect();
            let triangles = sound_triangulation(&points);
            assert_eq!(triangles.len(), points.len() - 2);
            let least = triangles.iter().map(|t| {
                let [a, b, c] = t.map(|k| points[k as usize]);
                (b - a).cross(c - a).z
            });
            let least = least.fold(f64::INFINITY, f64::min);
            assert!(least > 1e-3, "{points:?}: {triangles:?} {least}");
        }
    }
}

#[test]
fn triangulate_fans_polygons_without_area() {
    let line: Vec<_> = (0..5).map(|i| DVec3::splat(f64::from(i))).collect();
    assert_eq!(sound_triangulation(&line), [[0, 1, 2], [0, 2, 3], [0, 3, 4]]);
}
