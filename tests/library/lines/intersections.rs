//! Intersections of triangles, tested against closed-form curves and contacts that must give none.

use crate::library::support::scenes::random_dice::Dice;
use crate::library::support::scenes::solids::{Solid, cuboid, sphere, tube};
use glam::DVec3;
use ligne::mesh::PartId;
use ligne::mesh::intersect::intersection_curves::{IntersectionCurves, IntersectionInput, intersections};

pub(crate) fn find(solid: &Solid) -> IntersectionCurves {
    intersections(&IntersectionInput {
        positions: &solid.positions,
        triangles: &solid.triangles,
        active: &[],
        bodies: &[],
    })
}

fn scene(solids: impl IntoIterator<Item = Solid>) -> Solid {
    let mut scene = Solid::default();
    solids.into_iter().for_each(|solid| scene.add(solid));
    scene
}

pub(crate) fn length(curves: &IntersectionCurves) -> f64 {
    curves
        .segments
        .iter()
        .map(|s| curves.points[s.ends[0] as usize].distance(curves.points[s.ends[1] as usize]))
        .sum()
}

/// Returns the number of closed loops. Panics if a point does not join exactly two segments.
fn loops(curves: &IntersectionCurves) -> usize {
    let mut touching = vec![Vec::new(); curves.points.len()];
    for segment in &curves.segments {
        let [a, b] = segment.ends.map(|end| end as usize);
        touching[a].push(b);
        touching[b].push(a);
    }
    for (point, others) in touching.iter().enumerate() {
        assert_eq!(others.len(), 2, "point {point} at {:?}", curves.points[point]);
    }
    let mut seen = vec![false; touching.len()];
    let mut count = 0;
    for start in 0..touching.len() {
        let mut stack = vec![start];
        count += usize::from(!seen[start]);
        while let Some(point) = stack.pop() {
            if !std::mem::replace(&mut seen[point], true) {
                stack.extend(&touching[point]);
            }
        }
    }
    count
}

#[test]
fn boxes_through_each_other_meet_in_two_rectangles() {
    let beam = cuboid(DVec3::new(-3.0, -0.5, -0.25), DVec3::new(3.0, 0.5, 0.25));
    let curves = find(&scene([cuboid(DVec3::splat(-1.0), DVec3::splat(1.0)), beam]));
    assert_eq!(loops(&curves), 2);
    assert!((length(&curves) - 2.0 * 3.0).abs() < 1e-12, "{}", length(&curves));
    for p in &curves.points {
        assert_eq!(p.x.abs(), 1.0);
        assert!((p.y.abs() - 0.5).abs() < 1e-15 || (p.z.abs() - 0.25).abs() < 1e-15, "{p}");
    }
    for corner in [DVec3::new(1.0, 0.5, 0.25), DVec3::new(-1.0, -0.5, 0.25)] {
        assert!(curves.points.iter().any(|p| p.distance(corner) < 1e-15));
    }
}

#[test]
fn edges_that_cross_edges_still_close_the_loop() {
    // All corners of the curve lie where diagonals and edges of both boxes meet.
    let a = cuboid(DVec3::splat(-1.0), DVec3::splat(1.0));
    for b in [
        cuboid(DVec3::new(-0.5, -0.5, 0.0), DVec3::new(0.5, 0.5, 2.0)),
        cuboid(DVec3::new(0.0, 0.0, 0.0), DVec3::new(2.0, 2.0, 2.0)),
        cuboid(DVec3::new(-0.5, -0.25, -3.0), DVec3::new(0.5, 0.25, 3.0)),
    ] {
        let curves = find(&scene([a.clone(), b]));
        assert!(loops(&curves) >= 1);
    }
}

#[test]
fn sphere_through_box_gives_closed_loops() {
    // Each side of the box cuts a cap off the sphere.
    let ball = sphere(40, 1.2).moved(|p| DVec3::new(p.x, 0.8 * p.y - 0.6 * p.z, 0.6 * p.y + 0.8 * p.z));
    let curves = find(&scene([cuboid(DVec3::splat(-1.0), DVec3::splat(1.0)), ball]));
    assert_eq!(loops(&curves), 6);
    let circle = std::f64::consts::TAU * (1.2_f64 * 1.2 - 1.0).sqrt();
    assert!((length(&curves) / (6.0 * circle) - 1.0).abs() < 0.01, "{}", length(&curves));
}

#[test]
fn sphere_aligned_with_box_gives_closed_loops() {
    // Vertices of the sphere lie in planes and edges of the box, up to rounding.
    for radius in [1.1, 1.2, 1.3] {
        let curves = find(&scene([cuboid(DVec3::splat(-1.0), DVec3::splat(1.0)), sphere(24, radius)]));
        assert_eq!(loops(&curves), 6, "radius {radius}");
    }
}

#[test]
fn tube_through_plane_gives_one_polygon() {
    let plane = Solid {
        positions: vec![DVec3::new(-5.0, -4.0, 0.1), DVec3::new(5.0, -4.0, 0.1), DVec3::new(0.0, 7.0, 0.1)],
        triangles: vec![[0, 1, 2]],
    };
    let curves = find(&scene([tube(64, 3, 1.0, 2.0), plane]));
    assert_eq!(loops(&curves), 1);
    let polygon = 128.0 * ligne::geometry::numbers::portable_math::sin(std::f64::consts::PI / 64.0);
    assert!((length(&curves) - polygon).abs() < 1e-12);
    assert!(curves.points.iter().all(|p| (p.z - 0.1).abs() < 1e-15));
}

#[test]
fn row_of_vertices_in_the_plane_joins_at_the_vertices() {
    // With four rows, the middle vertices lie exactly in the plane z = 0.
    let plane = cuboid(DVec3::new(-5.0, -5.0, 0.0), DVec3::new(5.0, 5.0, 1.0));
    let tilted = tube(12, 4, 1.0, 2.0).moved(|p| DVec3::new(p.x, p.y, p.z + 0.25 * p.x));
    assert_eq!(loops(&find(&scene([plane, tilted]))), 2);
}

#[test]
fn contacts_are_no_intersections() {
    let unit = || cuboid(DVec3::ZERO, DVec3::ONE);
    let beside = |x: f64, y: f64, z: f64| unit().moved(move |p| p + DVec3::new(x, y, z));
    // In order: face on face, shifted face on face, edge on edge, corner on corner, and two boxes stacked
    // along z.
    for (x, y, z) in [
        (1.0, 0.0, 0.0),
        (1.0, 0.25, 0.5),
        (1.0, 1.0, 0.0),
        (1.0, 1.0, 1.0),
        (0.0, 0.0, 1.0),
        (0.3, 0.4, 1.0),
    ] {
        assert_eq!(find(&scene([unit(), beside(x, y, z)])), IntersectionCurves::default(), "{x} {y} {z}");
    }
}

#[test]
fn neighbours_and_coplanar_triangles_are_no_intersections() {
    assert_eq!(find(&sphere(20, 1.0)), IntersectionCurves::default());
    let flat = |x: f64| Solid {
        positions: vec![
            DVec3::new(x, 0.0, 1.0),
            DVec3::new(x + 2.0, 0.0, 1.0),
            DVec3::new(x + 0.5, 2.0, 1.0),
        ],
        triangles: vec![[0, 1, 2]],
    };
    assert_eq!(find(&scene([flat(0.0), flat(0.5)])), IntersectionCurves::default());
}

#[test]
fn a_vertex_in_the_plane_counts_only_where_the_triangle_goes_through() {
    let wall = [DVec3::new(-2.0, -2.0, 0.0), DVec3::new(2.0, -2.0, 0.0), DVec3::new(0.0, 3.0, 0.0)];
    let with = |triangle: [DVec3; 3]| {
        find(&Solid { positions: [wall, triangle].concat(), triangles: vec![[0, 1, 2], [3, 4, 5]] })
    };
    let tip = DVec3::new(0.1, 0.0, 0.0);
    let touching = [tip, DVec3::new(0.0, 0.5, 1.0), DVec3::new(0.0, -0.5, 1.0)];
    assert_eq!(with(touching), IntersectionCurves::default());
    let through = [tip, DVec3::new(0.0, 0.5, 1.0), DVec3::new(0.0, 0.5, -1.0)];
    let curves = with(through);
    assert_eq!(curves.segments.len(), 1);
    assert!(curves.points.contains(&tip), "the vertex is an end to the last bit");
}

#[test]
fn inactive_faces_have_no_intersections() {
    let both = scene([
        cuboid(DVec3::splat(-1.0), DVec3::splat(1.0)),
        cuboid(DVec3::splat(0.0), DVec3::new(2.0, 2.1, 2.2)),
    ]);
    let all = find(&both);
    let active: Vec<bool> = (0..both.triangles.len()).map(|face| face % 3 != 0).collect();
    let some = intersections(&IntersectionInput {
        positions: &both.positions,
        triangles: &both.triangles,
        active: &active,
        bodies: &[],
    });
    let expected: Vec<[u32; 2]> =
        all.segments.iter().map(|s| s.faces).filter(|f| f.iter().all(|&face| face % 3 != 0)).collect();
    assert_eq!(some.segments.iter().map(|s| s.faces).collect::<Vec<_>>(), expected);
}

#[test]
fn intersections_do_not_depend_on_scale_or_offset() {
    let both = scene([sphere(16, 1.0), tube(20, 3, 0.3, 2.0)]);
    let segments = find(&both).segments;
    assert!(!segments.is_empty());
    for (scale, offset) in [(1e-9, 0.0), (1e9, 0.0), (1.0, 4096.0)] {
        let moved = both.clone().moved(|p| p * scale + DVec3::splat(offset));
        let faces = |s: &[ligne::mesh::intersect::intersection_curves::IntersectionSegment]| {
            s.iter().map(|s| s.faces).collect::<Vec<_>>()
        };
        assert_eq!(faces(&find(&moved).segments), faces(&segments), "scale {scale}, offset {offset}");
    }
}

#[test]
fn intersections_do_not_depend_on_the_thread_count() {
    let both = scene([sphere(60, 1.0), tube(80, 30, 0.3, 2.0)]);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| find(&both))
    };
    assert_eq!(with(1), with(4));
}

#[test]
fn empty_input_has_no_intersections() {
    assert_eq!(find(&Solid::default()), IntersectionCurves::default());
    let point = Solid { positions: vec![DVec3::ONE; 6], triangles: vec![[0, 1, 2], [3, 4, 5]] };
    assert_eq!(find(&point), IntersectionCurves::default());
}

/// A face split into triangles along the x axis, one per entry of `halves`, and a wall in the plane y = 0
/// that crosses the split.
fn faces_crossed_on_a_diagonal(halves: &[f64], turn: glam::DQuat) -> Solid {
    let mut solid = Solid {
        positions: vec![
            DVec3::new(-1.0, 0.0, 0.0),
            DVec3::new(2.0, 0.0, 0.0),
            // The wall stands in the plane y = 0.
            DVec3::new(0.1, 0.0, -0.7),
            DVec3::new(0.9, 0.0, -0.5),
            DVec3::new(0.4, 0.0, 0.8),
        ],
        triangles: vec![[2, 3, 4]],
    };
    for side in halves {
        solid.positions.push(DVec3::new(0.3, *side, 0.0));
        solid.triangles.push([0, 1, solid.positions.len() as u32 - 1]);
    }
    solid.positions.iter_mut().for_each(|p| *p = turn * *p);
    solid
}

#[test]
fn surfaces_that_cross_along_a_diagonal_have_a_curve_there() {
    let mut dice = Dice::new(12);
    for round in 0..200 {
        let turn = glam::DQuat::from_axis_angle(dice.direction(), dice.between(0.0, 3.0));
        let both = find(&faces_crossed_on_a_diagonal(&[1.0, -1.5], turn));
        let strict = {
            let mut solid = faces_crossed_on_a_diagonal(&[1.0, -1.5], turn);
            let aside = turn * DVec3::Y * 1e-6;
            solid.positions[2..5].iter_mut().for_each(|p| *p += aside);
            find(&solid)
        };
        assert!(
            (length(&both) - length(&strict)).abs() < 1e-5,
            "{round}: {} {}",
            length(&both),
            length(&strict)
        );
        assert!(length(&both) > 0.4, "{round}");
        // Surfaces that only touch have no curve.
        assert!(find(&faces_crossed_on_a_diagonal(&[1.0], turn)).segments.is_empty(), "{round}");
        assert!(find(&faces_crossed_on_a_diagonal(&[1.0, 1.5], turn)).segments.is_empty(), "{round}");
    }
}

/// Two faces with a common side along x, and two walls with a shorter side on the same line. Each triangle is
/// given by the y and z of its third corner.
fn faces_and_walls_on_a_line(faces: [[f64; 2]; 2], walls: [[f64; 2]; 2], turn: glam::DQuat) -> Solid {
    let on_line = [-1.0, 2.0, 0.1, 0.9].map(|x| DVec3::new(x, 0.0, 0.0));
    let mut solid = Solid { positions: on_line.to_vec(), triangles: Vec::new() };
    for ([from, to], thirds) in [([0, 1], faces), ([2, 3], walls)] {
        for [y, z] in thirds {
            solid.positions.push(DVec3::new(0.4, y, z));
            solid.triangles.push([from, to, solid.positions.len() as u32 - 1]);
        }
    }
    solid.positions.iter_mut().for_each(|p| *p = turn * *p);
    solid
}

#[test]
fn surfaces_that_cross_along_an_edge_of_each_have_a_curve_there() {
    let mut dice = Dice::new(13);
    let flat = [[1.0, 0.0], [-1.5, 0.0]];
    let ridge = [[1.0, -1.0], [-1.0, -1.0]];
    for round in 0..200 {
        let turn = glam::DQuat::from_axis_angle(dice.direction(), dice.between(0.0, 3.0));
        let crossing = [(flat, [[0.1, 0.8], [-0.1, -0.7]]), (ridge, [[0.9, -0.1], [0.1, -0.9]])];
        for (faces, walls) in crossing {
            let curves = find(&faces_and_walls_on_a_line(faces, walls, turn));
            assert_eq!(curves.segments.len(), 1, "{round}");
            assert!((length(&curves) - 0.8).abs() < 1e-9, "{round}");
        }
        // Surfaces that only touch: an inverted roof on another ridge, and two pairs of coplanar surfaces.
        let touching = [(flat, [[0.3, 0.8], [-0.3, 0.7]]), (ridge, [[0.9, -0.1], [-0.9, -0.1]])];
        for (faces, walls) in touching.into_iter().chain([(flat, flat), (ridge, ridge)]) {
            assert!(find(&faces_and_walls_on_a_line(faces, walls, turn)).segments.is_empty(), "{round}");
        }
    }
}

#[test]
fn bodies_with_a_common_vertex_intersect_from_there_on() {
    let mut dice = Dice::new(14);
    for round in 0..200 {
        let turn = glam::DQuat::from_axis_angle(dice.direction(), dice.between(0.0, 3.0));
        // Two faces that cross along x for one unit, starting at their common vertex.
        let corners = [[0.0, 0.0, 0.0], [3.0, 1.0, 0.0], [3.0, -1.0, 0.0], [1.0, 0.0, 1.0], [1.0, 0.0, -1.0]];
        let positions = corners.map(|corner| turn * DVec3::from(corner));
        let found = |bodies: &[PartId]| {
            let triangles = &[[0, 1, 2], [0, 3, 4]];
            intersections(&IntersectionInput { positions: &positions, triangles, active: &[], bodies })
        };
        let curves = found(&[PartId(0), PartId(1)]);
        assert_eq!(curves.segments.len(), 1, "{round}");
        assert!((length(&curves) - 1.0).abs() < 1e-9, "{round}");
        // Within one body, they are neighbours.
        assert!(found(&[]).segments.is_empty() && found(&[PartId(1); 2]).segments.is_empty(), "{round}");
    }
}
