//! Scenes with drawings in closed form: visible lines and their end points.

use crate::library::support::measures::segment_sets::{
    check_equal_cover, distance, doubled_length, total_length,
};
use crate::library::support::pipeline::{
    Stages, exact_options, exact_options_with_hidden, orthographic, perspective, run_stages, scene,
    scene_of_geometries, solid_geometry,
};
use crate::library::support::references::textbook_camera::TextbookCamera;
use crate::library::support::scenes::solids::{Solid, cuboid, sphere, torus};
use glam::DVec3;
use kurbo::Point;
use ligne::chains::{self, ChainOptions};
use ligne::drawing::{Length, Unit};
use ligne::lines::{HiddenLines, LineKind};
use ligne::mesh::EdgeMark;
use ligne::scene::{Camera, Geometry, Material, Scene};
use ligne::visibility::ViewVertexKind;

/// Largest distance of a computed end point from the known one, px.
pub(crate) const MAX_END_ERROR_PX: f64 = 1e-6;

pub(crate) fn at(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

pub(crate) fn cube() -> Solid {
    cuboid(DVec3::splat(-1.0), DVec3::ONE)
}

/// Two views that show three sides of a cube.
pub(crate) fn generic_views() -> [Camera; 2] {
    let eye = at(3.1, 2.3, 4.7);
    [perspective(eye, at(0.1, 0.0, -0.1), 40.0), orthographic(eye, DVec3::ZERO, 5.0)]
}

pub(crate) fn from_front(height: f64) -> Camera {
    orthographic(at(0.0, 0.0, 10.0), DVec3::ZERO, height)
}

/// A polygon in space, triangulated as a fan.
pub(crate) fn polygon(corners: &[DVec3]) -> Solid {
    let triangles = (1..corners.len() as u32 - 1).map(|k| [0, k, k + 1]).collect();
    Solid { positions: corners.to_vec(), triangles }
}

/// An axis-aligned rectangle in the plane at height `z`.
pub(crate) fn rectangle(x: [f64; 2], y: [f64; 2], z: f64) -> Solid {
    polygon(&[at(x[0], y[0], z), at(x[1], y[0], z), at(x[1], y[1], z), at(x[0], y[1], z)])
}

/// Merges polygons into one solid. The mesh later welds equal corners.
pub(crate) fn joined(solids: impl IntoIterator<Item = Solid>) -> Solid {
    let mut sum = Solid::default();
    solids.into_iter().for_each(|solid| sum.add(solid));
    sum
}

pub(crate) fn outline(corners: &[DVec3]) -> Vec<[DVec3; 2]> {
    (0..corners.len()).map(|i| [corners[i], corners[(i + 1) % corners.len()]]).collect()
}

/// Asserts that the visible lines cover exactly the given world segments, each once.
pub(crate) fn assert_visible_lines(stages: &Stages, camera: &Camera, wanted: &[[DVec3; 2]]) {
    let wanted = TextbookCamera::new(camera).project_segments(wanted);
    let visible = stages.visible_segments();
    check_equal_cover(&visible, &wanted, MAX_END_ERROR_PX, 1e-5)
        .unwrap_or_else(|message| panic!("{message}: {visible:?}"));
    assert!(doubled_length(&visible, 1e-3) < 1e-2, "ink twice: {visible:?}");
}

/// Counts visible view edges longer than a hundredth of a px. This skips lines seen end-on.
pub(crate) fn count_visible(stages: &Stages) -> usize {
    stages.visible_segments().iter().filter(|[a, b]| distance(*a, *b) > 0.01).count()
}

#[test]
fn a_cube_shows_nine_edges_and_hides_three() {
    for camera in generic_views() {
        let drawn = run_stages(&scene([cube()]), &camera, &exact_options_with_hidden());
        assert_eq!((count_visible(&drawn), drawn.hidden_segments().len()), (9, 3));
        assert!(drawn.map.edges.iter().all(|e| e.invisibility <= 1), "one face lies before the hidden edges");
        let contours = drawn.visible_segments_of_kind(LineKind::Contour).len();
        assert_eq!((contours, drawn.visible_segments_of_kind(LineKind::Crease).len()), (6, 3));
        assert!(drawn.map.edges.iter().all(|e| e.silhouette == (e.kind == LineKind::Contour)));
    }
}

#[test]
fn a_cube_from_the_front_is_a_square() {
    let camera = from_front(4.0);
    let drawn = run_stages(&scene([cube()]), &camera, &exact_options_with_hidden());
    let front = [at(-1.0, -1.0, 1.0), at(1.0, -1.0, 1.0), at(1.0, 1.0, 1.0), at(-1.0, 1.0, 1.0)];
    assert_visible_lines(&drawn, &camera, &outline(&front));
    assert_eq!(drawn.visible_segments().iter().filter(|[a, b]| distance(*a, *b) > 1.0).count(), 4);
    // The back square lies exactly behind the front one.
    assert!((total_length(&drawn.hidden_segments()) - 4.0 * 500.0).abs() < 1e-6);
}

#[test]
fn the_contour_of_a_sphere_is_a_circle() {
    let around = 24;
    // The angle on the sphere that the longest edge spans.
    let span = std::f64::consts::PI / around as f64 * std::f64::consts::SQRT_2;
    let (eye, distance_of_eye) = (at(1.0, 2.0, 5.0), 30.0_f64.sqrt());
    let perspective_view = perspective(eye, DVec3::ZERO, 40.0);
    let scale = TextbookCamera::new(&perspective_view).scale;
    let circles = [
        (perspective_view, scale / (distance_of_eye * distance_of_eye - 1.0).sqrt()),
        (orthographic(eye, DVec3::ZERO, 4.0), 250.0),
    ];
    for (camera, radius) in circles {
        let drawn = run_stages(&scene([sphere(around, 1.0)]), &camera, &exact_options_with_hidden());
        let centre = Point::new(500.0, 500.0);
        let mut turned = 0.0;
        for edge in &drawn.map.edges {
            assert_eq!(edge.kind, LineKind::Contour);
            let [a, b] = drawn.edge_ends(edge);
            for p in [a, b] {
                let r = distance(p, centre);
                let sagitta = radius * (1.0 - ligne::geometry::numbers::portable_math::cos(span)) * 1.3;
                assert!(r <= radius + 1e-9 && r >= radius - sagitta, "{r} of {radius}, {sagitta}");
            }
            if edge.invisibility == 0 {
                let (u, v) = (a - centre, b - centre);
                turned += ligne::geometry::numbers::portable_math::atan2(u.cross(v), u.dot(v)).abs();
            }
        }
        let whole = std::f64::consts::TAU;
        assert!(turned > 0.999 * whole && turned < 1.1 * whole, "{turned}");
    }
}

#[test]
fn a_post_in_front_of_a_plate_has_t_junctions_at_computed_points() {
    let plate = cuboid(at(-2.0, -1.0, -1.0), at(2.0, 1.0, 0.0));
    let post = cuboid(at(-0.3, -3.0, 2.0), at(0.5, 3.0, 3.0));
    let eye_point = at(0.7, 0.4, 10.0);
    let camera = perspective(eye_point, at(0.7, 0.4, 0.0), 40.0);
    let drawn = run_stages(&scene([plate, post]), &camera, &exact_options_with_hidden());
    let eye = TextbookCamera::new(&camera);
    // The post's contours, projected from the camera onto the plane z = 0.
    let shadow = |x: f64, z: f64| 0.7 + (x - 0.7) * 10.0 / (10.0 - z);
    let mut wanted = Vec::new();
    for x in [shadow(-0.3, 3.0), shadow(0.5, 2.0)] {
        wanted.extend([-1.0, 1.0].map(|y| eye.project(at(x, y, 0.0))));
    }
    let visible = drawn.map.edges.iter().filter(|e| e.invisibility == 0);
    let nodes = visible.flat_map(|e| [e.start, e.end]).map(|v| drawn.map.vertices[v.index()]);
    let found: Vec<Point> =
        nodes.filter(|v| v.kind == ViewVertexKind::TJunction).map(|v| v.position).collect();
    assert_eq!(found.len(), 4, "{found:?}");
    for point in wanted {
        let nearest = found.iter().map(|p| distance(*p, point)).fold(f64::INFINITY, f64::min);
        assert!(nearest < MAX_END_ERROR_PX, "no T-junction at {point}, {found:?}");
    }
}

#[test]
fn a_bar_is_seen_through_a_hole() {
    let frame = joined([
        rectangle([-3.0, -1.0], [-3.0, 3.0], 2.0),
        rectangle([1.0, 3.0], [-3.0, 3.0], 2.0),
        rectangle([-1.0, 1.0], [1.0, 3.0], 2.0),
        rectangle([-1.0, 1.0], [-3.0, -1.0], 2.0),
    ]);
    let bar = rectangle([-2.5, 2.5], [-0.25, 0.5], 0.0);
    let camera = from_front(8.0);
    let drawn = run_stages(&scene([frame, bar]), &camera, &exact_options_with_hidden());
    let eye = TextbookCamera::new(&camera);
    let inside = |[a, b]: &[Point; 2]| {
        let middle = a.midpoint(*b) - Point::new(500.0, 500.0);
        middle.x.abs() < 124.0 && middle.y.abs() < 124.0
    };
    let seen: Vec<[Point; 2]> = drawn.visible_segments().into_iter().filter(|s| inside(s)).collect();
    let wanted = [-0.25, 0.5].map(|y| [at(-1.0, y, 0.0), at(1.0, y, 0.0)]);
    check_equal_cover(&seen, &eye.project_segments(&wanted), MAX_END_ERROR_PX, 1e-5).unwrap();
}

#[test]
fn a_torus_has_cusps_when_its_tube_is_thick_enough() {
    // Seen at an elevation, the contours are offset curves of an ellipse with axes 1 and s, at the tube's
    // radius. If the tube is thicker than s * s, the curvature radius at the ends of the ellipse, the inner
    // curve has four cusps. Two of them are visible.
    use ligne::geometry::numbers::portable_math::{cos, pow, sin};
    for (elevation, tube) in [(60.0_f64, 0.3), (80.0, 0.4), (25.0, 0.3), (20.0, 0.25)] {
        let (s, c) = (sin(elevation.to_radians()), cos(elevation.to_radians()));
        let thick = tube > s * s;
        let camera = orthographic(at(0.0, -10.0 * c, 10.0 * s), DVec3::ZERO, 4.0);
        let drawn = run_stages(&scene([torus(128, 64, 1.0, tube)]), &camera, &exact_options());
        let chains = chains::link(&drawn.map, &ChainOptions::default(), Unit::Px, HiddenLines::None);
        let open: Vec<_> = chains.iter().filter(|c| !c.closed && c.invisibility == 0).collect();
        let ends: Vec<Point> =
            open.iter().flat_map(|c| [c.points[0], c.points[c.points.len() - 1]]).collect();

        if thick {
            // The cusps lie where the radius of curvature of the ellipse equals that of the tube.
            let sin2 = (pow(tube * s, 2.0 / 3.0) - s * s) / (1.0 - s * s);
            let (x, y) = ((1.0 - sin2).sqrt(), sin2.sqrt());
            let normal = kurbo::Vec2::new(s * x, y) / (s * s * x * x + y * y).sqrt();
            let (u, v) = (x - tube * normal.x, s * y - tube * normal.y);
            let cusps = [(u, v), (-u, v), (u, -v), (-u, -v)]
                .map(|(u, v)| Point::new(500.0 + 250.0 * u, 500.0 + 250.0 * v));
            let nearest = |p: &Point| ends.iter().map(|e| distance(*e, *p)).fold(f64::INFINITY, f64::min);
            let seen = cusps.iter().filter(|p| nearest(p) < 8.0).count();
            assert_eq!(seen, 2, "elevation {elevation}, tube {tube}: {cusps:?}, {ends:?}");
        } else {
            let closed = chains.iter().filter(|c| c.closed && c.invisibility == 0).count();
            assert_eq!((closed, open.len()), (2, 0), "elevation {elevation}, tube {tube}");
        }
        // The outermost points of the image.
        let reach =
            drawn.visible_segments().iter().flatten().map(|p| (p.x - 500.0).abs()).fold(0.0, f64::max);
        let known = 250.0 * (1.0 + tube);
        assert!(reach <= known + 1e-6 && reach > known * 0.998, "{reach} of {known}");
    }
}

#[test]
fn a_beam_through_a_cube_has_intersection_lines() {
    let camera = perspective(at(5.0, 3.0, 4.0), DVec3::ZERO, 50.0);
    let beam = cuboid(at(-3.0, -0.5, -0.25), at(3.0, 0.5, 0.25));
    let drawn = run_stages(&scene([cube(), beam]), &camera, &exact_options_with_hidden());
    let seen = [[at(1.0, 0.5, -0.25), at(1.0, 0.5, 0.25)], [at(1.0, -0.5, 0.25), at(1.0, 0.5, 0.25)]];
    let found = drawn.visible_segments_of_kind(LineKind::Intersection);
    check_equal_cover(&found, &TextbookCamera::new(&camera).project_segments(&seen), MAX_END_ERROR_PX, 2e-3)
        .unwrap();
}

/// A strip with half a twist.
fn moebius(around: usize) -> Solid {
    use ligne::geometry::numbers::portable_math::{cos, sin};
    let mut strip = Solid::default();
    for i in 0..around {
        let u = i as f64 / around as f64 * std::f64::consts::TAU;
        for w in [-0.3, 0.3] {
            let r = 1.0 + w * cos(u / 2.0);
            strip.positions.push(at(r * cos(u), r * sin(u), w * sin(u / 2.0)));
        }
        // The last quad joins the sides of the first one crosswise.
        let [a, b] = [2 * i as u32, 2 * i as u32 + 1];
        let [c, d] = if i + 1 == around { [1, 0] } else { [a + 2, b + 2] };
        strip.triangles.extend([[a, c, d], [a, d, b]]);
    }
    strip
}

#[test]
fn a_moebius_strip_has_one_border_and_no_crease() {
    let around = 120;
    for camera in generic_views() {
        let drawn = run_stages(&scene([moebius(around)]), &camera, &exact_options_with_hidden());
        let mut borders: Vec<u32> =
            drawn.map.edges.iter().filter(|e| e.kind == LineKind::Border).map(|e| e.segment).collect();
        borders.dedup();
        assert_eq!(borders.len(), 2 * around);
        assert!(drawn.map.edges.iter().all(|e| e.kind == LineKind::Border || e.kind == LineKind::Contour));
        assert!(!drawn.visible_segments_of_kind(LineKind::Contour).is_empty(), "it turns away somewhere");
    }
}

#[test]
fn the_near_plane_clips_at_computed_points() {
    // A rail from the side of the camera into the distance. The near plane lies 2 in front of the camera.
    let rail = rectangle([-1.0, 1.0], [-0.1, 0.1], 0.0).moved(|p| at(p.x, -0.5, 5.0 * p.y * 2.0));
    let camera = Camera { near: Some(2.0), ..perspective(at(0.0, 0.0, 2.0), at(0.0, 0.0, 0.0), 90.0) };
    let drawn = run_stages(&scene([rail]), &camera, &exact_options_with_hidden());
    // The rail reaches from z = −1 to 1. The part nearer than z = 0 is clipped.
    let wanted = [
        [at(-1.0, -0.5, -1.0), at(1.0, -0.5, -1.0)],
        [at(-1.0, -0.5, -1.0), at(-1.0, -0.5, 0.0)],
        [at(1.0, -0.5, -1.0), at(1.0, -0.5, 0.0)],
    ];
    assert_visible_lines(&drawn, &camera, &wanted);
    let cut = drawn.map.vertices.iter().filter(|v| v.kind == ViewVertexKind::Frame);
    let depths: Vec<f64> = cut.map(|v| v.depth).collect();
    assert_eq!(depths.len(), 2);
    assert!(depths.iter().all(|d| (d - 2.0).abs() < 1e-12));
}

#[test]
fn a_camera_inside_a_cube_shows_its_edges() {
    let camera = perspective(DVec3::ZERO, at(0.0, 0.0, -1.0), 120.0);
    let drawn = run_stages(&scene([cube()]), &camera, &exact_options_with_hidden());
    // The edges towards the camera continue outside the frame.
    let tan = ligne::geometry::numbers::portable_math::tan(60.0_f64.to_radians());
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let far: Vec<DVec3> = corners.iter().map(|(x, y)| at(*x, *y, -1.0)).collect();
    let mut wanted = outline(&far);
    wanted.extend(corners.iter().map(|(x, y)| [at(*x, *y, -1.0), at(*x, *y, -1.0 / tan)]));
    assert_visible_lines(&drawn, &camera, &wanted);
    assert!(drawn.map.edges.iter().all(|e| e.kind == LineKind::Crease && e.invisibility == 0));
}

#[test]
fn wires_are_visible_or_hidden_like_other_lines() {
    let wire = Geometry {
        positions: vec![at(-2.0, 0.25, -1.0), at(2.0, 0.25, -1.0), at(-2.0, -0.25, 1.0), at(2.0, -0.25, 1.0)],
        wires: vec![[0, 1], [2, 3]],
        ..Geometry::default()
    };
    let plate = solid_geometry(rectangle([-1.0, 0.5], [-1.0, 1.0], 0.0));
    let camera = from_front(5.0);
    let drawn = run_stages(&scene_of_geometries(vec![wire, plate]), &camera, &exact_options_with_hidden());
    let wanted = [
        [at(-2.0, -0.25, 1.0), at(2.0, -0.25, 1.0)],
        [at(-2.0, 0.25, -1.0), at(-1.0, 0.25, -1.0)],
        [at(0.5, 0.25, -1.0), at(2.0, 0.25, -1.0)],
    ];
    check_equal_cover(
        &drawn.visible_segments_of_kind(LineKind::Wire),
        &TextbookCamera::new(&camera).project_segments(&wanted),
        MAX_END_ERROR_PX,
        1e-5,
    )
    .unwrap();
}

#[test]
fn a_border_between_materials_is_a_line() {
    let two = Geometry {
        triangle_material: vec![0, 1],
        ..solid_geometry(rectangle([-1.0, 1.0], [-1.0, 1.0], 0.0))
    };
    let with_materials = Scene { materials: vec![Material::default(); 2], ..scene_of_geometries(vec![two]) };
    let camera = from_front(4.0);
    let drawn = run_stages(&with_materials, &camera, &exact_options_with_hidden());
    let diagonal = [[at(-1.0, -1.0, 0.0), at(1.0, 1.0, 0.0)]];
    check_equal_cover(
        &drawn.visible_segments_of_kind(LineKind::Material),
        &TextbookCamera::new(&camera).project_segments(&diagonal),
        MAX_END_ERROR_PX,
        1e-5,
    )
    .unwrap();
    assert_eq!(count_visible(&drawn), 5);
}

#[test]
fn edge_marks_of_the_file_add_and_remove_creases() {
    let mut square = solid_geometry(rectangle([-1.0, 1.0], [-1.0, 1.0], 0.0));
    let plain = EdgeMark::Unmarked;
    square.edge_marks = vec![[plain, plain, EdgeMark::Hard], [plain; 3]];
    let drawn =
        run_stages(&scene_of_geometries(vec![square]), &from_front(4.0), &exact_options_with_hidden());
    assert_eq!(drawn.visible_segments_of_kind(LineKind::Crease).len(), 1);

    for camera in generic_views() {
        let mut soft = solid_geometry(cube());
        soft.edge_marks = vec![[EdgeMark::Hidden; 3]; soft.triangles.len()];
        let drawn = run_stages(&scene_of_geometries(vec![soft]), &camera, &exact_options_with_hidden());
        assert_eq!((count_visible(&drawn), drawn.visible_segments_of_kind(LineKind::Contour).len()), (6, 6));
    }
}

#[test]
fn lines_seen_end_on_leave_no_dots() {
    let camera = from_front(5.0);
    let plate = cuboid(at(-2.0, -2.0, 0.0), at(2.0, 2.0, 0.5));
    let drawn = run_stages(
        &scene([plate, cuboid(at(-1.0, -1.0, -3.0), at(1.0, 1.0, -2.0))]),
        &camera,
        &exact_options_with_hidden(),
    );
    let off = Length::px(0.0);
    let plain = ChainOptions { smooth: off, simplify: off, tidy: off, fit: false, ..ChainOptions::default() };
    let chains = chains::link(&drawn.map, &plain, Unit::Px, HiddenLines::None);
    let visible: Vec<_> = chains.iter().filter(|c| c.invisibility == 0).collect();
    assert!(visible.iter().all(|c| c.part.index() == 0), "only the plate is seen: {visible:?}");
    assert_eq!(visible.len(), 1, "{visible:?}");
}
