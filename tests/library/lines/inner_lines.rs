//! Curvature, suggestive contours, ridges and valleys against closed forms: sphere, tube, saddle, torus, hill
//! and ellipsoid.

use crate::library::support::pipeline;
use crate::library::support::pipeline::orthographic;
use crate::library::support::readers::shared_folder;
use crate::library::support::scenes::solids::{Solid, torus, tube};
use glam::DVec3;
use ligne::drawing::{Mark, Paint};
use ligne::geometry::numbers::portable_math::{atan2, pow};
use ligne::lines::zero_sets::interior;
use ligne::lines::{FeatureLines, InsideOptions, LineKind, LineOptions};
use ligne::mesh::{Mesh, Soup};
use ligne::scene::{Camera, Scene};
use ligne::style::Style;
use ligne::surface::{Curvature, SmoothNormals};
use ligne::view::View;

fn mesh_of(solid: &Solid) -> Mesh {
    let (positions, triangles) = (solid.positions.clone(), solid.triangles.clone());
    Mesh::build(Soup { positions, triangles, ..Soup::default() })
}

fn curvature_of(solid: &Solid) -> (Mesh, Curvature) {
    let mesh = mesh_of(solid);
    let curvature = Curvature::new(&mesh, &SmoothNormals::rounded(&mesh), 0.0);
    (mesh, curvature)
}

/// A height field over the square from −`half` to `half`.
fn height_field(half: f64, cells: u32, height: impl Fn(f64, f64) -> f64) -> Solid {
    let mut solid = Solid::default();
    let row = cells + 1;
    for y in 0..row {
        for x in 0..row {
            let at = |i: u32| half * (2.0 * f64::from(i) / f64::from(cells) - 1.0);
            solid.positions.push(DVec3::new(at(x), at(y), height(at(x), at(y))));
            if x < cells && y < cells {
                let a = y * row + x;
                solid.triangles.extend([[a, a + 1, a + row + 1], [a, a + row + 1, a + row]]);
            }
        }
    }
    solid
}

/// A sphere without poles: a subdivided cube projected onto the sphere.
fn sphere(cells: u32, radius: f64) -> Solid {
    let mut ball = Solid::default();
    for side in 0..6 {
        let sign = if side < 3 { 1.0 } else { -1.0 };
        let mut face = height_field(1.0, cells, |_, _| sign).moved(|p| match side % 3 {
            0 => p,
            1 => DVec3::new(p.z, p.x, p.y),
            _ => DVec3::new(p.y, p.z, p.x),
        });
        if sign < 0.0 {
            face.triangles.iter_mut().for_each(|t| t.swap(0, 1));
        }
        ball.add(face);
    }
    ball.moved(|p| p.normalize() * radius)
}

/// A sphere with bumps.
fn bumpy(around: u32) -> Solid {
    use ligne::geometry::numbers::portable_math::{cos, sin};
    sphere(around, 1.0).moved(|p| p * (1.0 + 0.06 * sin(4.0 * p.x) * cos(5.0 * p.y) + 0.05 * sin(6.0 * p.z)))
}

fn options(kinds: &[LineKind], inside: InsideOptions) -> LineOptions {
    LineOptions { kinds: kinds.to_vec(), inside, ..LineOptions::default() }
}

fn inside_lines(mesh: &Mesh, camera: &Camera, options: &LineOptions) -> FeatureLines {
    let view = View::new(mesh, camera);
    let smooth = SmoothNormals::rounded(mesh);
    let curvature = interior::curvature(mesh, &smooth, &options.inside);
    let mut lines = FeatureLines::default();
    interior::find(mesh, &view, &smooth, &curvature, options, &mut lines);
    lines
}

/// Returns the world positions of the ends of all segments of a kind.
fn points(mesh: &Mesh, lines: &FeatureLines, kind: LineKind) -> Vec<DVec3> {
    let segments = lines.segments.iter().filter(|s| s.kind == kind);
    segments.flat_map(|s| s.ends).map(|end| lines.position(mesh, end) + mesh.origin).collect()
}

fn length(mesh: &Mesh, lines: &FeatureLines) -> f64 {
    let ends = |s: &ligne::lines::FeatureSegment| s.ends.map(|end| lines.position(mesh, end));
    lines.segments.iter().map(ends).map(|[a, b]| a.distance(b)).sum()
}

fn is_near(a: f64, b: f64, within: f64) -> bool {
    (a - b).abs() <= within
}

#[test]
fn sphere_curvature_is_constant() {
    let (mesh, curvature) = curvature_of(&sphere(60, 2.0));
    for (v, (p, at)) in curvature.principal.iter().zip(&mesh.positions).enumerate() {
        // Welding leaves vertices without faces.
        if curvature.fans.area(v) > 0.0 {
            assert!(is_near(p.k1, 0.5, 0.01) && is_near(p.k2, 0.5, 0.01), "{p:?} at {at}");
        }
    }
    // The feature size is a hundredth of the radius.
    assert!(is_near(curvature.feature_size(0), 0.02, 0.0005), "{}", curvature.feature_size(0));
}

#[test]
fn tube_curvature_is_zero_along_the_axis() {
    let (mesh, curvature) = curvature_of(&tube(80, 40, 0.5, 2.0));
    for (p, at) in curvature.principal.iter().zip(&mesh.positions) {
        if at.z.abs() < 1.8 {
            assert!(is_near(p.k1, 2.0, 0.02) && is_near(p.k2, 0.0, 0.02), "{p:?} at {at}");
            assert!(p.dir2.z.abs() > 0.999, "{p:?}");
        }
    }
}

#[test]
fn saddle_curvatures_have_opposite_signs() {
    let (mesh, curvature) = curvature_of(&height_field(0.5, 40, |x, y| x * x - y * y));
    let middle = (0..mesh.positions.len()).min_by(|a, b| {
        let away = |v: &usize| (mesh.positions[*v] + mesh.origin).length();
        away(a).total_cmp(&away(b))
    });
    let p = &curvature.principal[middle.unwrap()];
    let (up, down) = if p.k1 < 0.0 { (p.k1, p.k2) } else { (p.k2, p.k1) };
    assert!(is_near(up, -2.0, 0.01) && is_near(down, 2.0, 0.01), "{p:?}");
    let along = if p.k1 < 0.0 { p.dir1 } else { p.dir2 };
    assert!(along.x.abs() > 0.99, "bends towards the normal along x: {p:?}");
}

/// Returns the angle around the tube of a torus (radius 3, axis z), and the unit tangents around the tube and
/// around the axis.
fn torus_frame(p: DVec3) -> (f64, DVec3, DVec3) {
    let out = DVec3::new(p.x, p.y, 0.0).normalize();
    let v = atan2(p.z, p.dot(out) - 3.0);
    let (sin, cos) =
        (ligne::geometry::numbers::portable_math::sin(v), ligne::geometry::numbers::portable_math::cos(v));
    (v, DVec3::Z * cos - out * sin, DVec3::Z.cross(out))
}

#[test]
fn torus_curvatures_and_derivatives_match_closed_forms() {
    let (mesh, curvature) = curvature_of(&torus(240, 120, 3.0, 1.0));
    for (i, p) in curvature.principal.iter().enumerate() {
        let (v, round_tube, _) = torus_frame(mesh.positions[i] + mesh.origin);
        let (sin, cos) = (
            ligne::geometry::numbers::portable_math::sin(v),
            ligne::geometry::numbers::portable_math::cos(v),
        );
        assert!(is_near(p.k1, 1.0, 0.01) && is_near(p.k2, cos / (3.0 + cos), 0.01), "{p:?} at {v}");
        let sense = p.dir1.dot(round_tube);
        assert!(is_near(sense.abs(), 1.0, 1e-3));
        // Only the curvature around the axis changes, and only in the direction around the tube.
        let change = -3.0 * sin / ((3.0 + cos) * (3.0 + cos));
        let wanted = [0.0, 0.0, change * sense.signum(), 0.0];
        let found = curvature.derivative[i];
        assert!((0..4).all(|k| is_near(found[k], wanted[k], 0.02)), "{found:?} for {wanted:?} at {v}");
    }
}

#[test]
fn suggestive_contours_of_a_torus_lie_where_radial_curvature_vanishes() {
    let mesh = mesh_of(&torus(240, 120, 3.0, 1.0));
    let eye = DVec3::new(6.0, 3.0, 10.0);
    let camera = orthographic(eye, DVec3::ZERO, 12.0);
    let inside = InsideOptions { smooth: 0.0, suggestive: 0.0, ..InsideOptions::default() };
    let lines = inside_lines(&mesh, &camera, &options(&[LineKind::Suggestive], inside));
    let found = points(&mesh, &lines, LineKind::Suggestive);
    assert!(found.len() > 100, "{}", found.len());
    let to_eye = (camera.eye - camera.target).normalize();
    for p in &found {
        let (v, round_tube, round_axis) = torus_frame(*p);
        let cos = ligne::geometry::numbers::portable_math::cos(v);
        let (a, b) = (to_eye.dot(round_tube), to_eye.dot(round_axis));
        let radial = a * a + b * b * cos / (3.0 + cos);
        assert!(is_near(radial, 0.0, 0.02), "{radial} at {p}");
        assert!(cos < 0.0, "only the inner half bends both ways: {p}");
    }
    // A sphere has no negative curvature, and so no suggestive contours.
    let ball = mesh_of(&sphere(40, 2.0));
    assert!(inside_lines(&ball, &camera, &options(&[LineKind::Suggestive], inside)).segments.is_empty());
}

#[test]
fn highlights_add_the_other_zeros_of_radial_curvature() {
    let mesh = mesh_of(&bumpy(80));
    let camera = orthographic(DVec3::new(5.0, 3.0, 4.0), DVec3::ZERO, 4.0);
    let count = |highlights| {
        let inside = InsideOptions { highlights, ..InsideOptions::default() };
        inside_lines(&mesh, &camera, &options(&[LineKind::Suggestive], inside)).segments.len()
    };
    assert!(count(true) > count(false) && count(false) > 0);
}

#[test]
fn the_crest_of_a_hill_is_a_ridge_and_its_feet_are_valleys() {
    // The height is e^(−4 x²).
    let hill = height_field(2.0, 160, |x, _| pow(std::f64::consts::E, -4.0 * x * x));
    let mesh = mesh_of(&hill);
    let camera = orthographic(DVec3::new(1.0, -2.0, 10.0), DVec3::ZERO, 5.0);
    let inside = InsideOptions { smooth: 0.0, ridge: 0.01, valley: 0.01, ..InsideOptions::default() };
    let lines = inside_lines(&mesh, &camera, &options(&[LineKind::Ridge, LineKind::Valley], inside));
    let inner = |p: &&DVec3| p.y.abs() < 1.9 && p.x.abs() < 1.5;
    let ridges = points(&mesh, &lines, LineKind::Ridge);
    let valleys = points(&mesh, &lines, LineKind::Valley);
    assert!(ridges.iter().filter(inner).count() > 100);
    for p in ridges.iter().filter(inner) {
        assert!(p.x.abs() < 0.03, "a ridge at {p}");
    }
    // The valleys lie at the largest upward curvature of the profile.
    let bend = |x: f64| {
        let z = pow(std::f64::consts::E, -4.0 * x * x);
        let (slope, second) = (-8.0 * x * z, (64.0 * x * x - 8.0) * z);
        second / pow(1.0 + slope * slope, 1.5)
    };
    let steps = (0..2000).map(|i| f64::from(i) / 1000.0);
    let foot = steps.max_by(|a, b| bend(*a).total_cmp(&bend(*b))).unwrap();
    assert!(valleys.iter().filter(inner).count() > 200);
    for p in valleys.iter().filter(inner) {
        assert!(is_near(p.x.abs(), foot, 0.04), "a valley at {p}, not {foot}");
    }
}

#[test]
fn ridges_of_an_ellipsoid_lie_in_the_plane_of_its_long_axes() {
    let mesh = mesh_of(&sphere(100, 1.0).moved(|p| DVec3::new(3.0 * p.x, p.z, -2.0 * p.y)));
    let camera = orthographic(DVec3::new(3.0, 8.0, 4.0), DVec3::ZERO, 8.0);
    let curvature = Curvature::new(&mesh, &SmoothNormals::rounded(&mesh), 0.0);
    // Half of the smallest curvature across the waist.
    let ridge = 1.0 * curvature.feature_size(0);
    let inside = InsideOptions { smooth: 0.0, ridge, ..InsideOptions::default() };
    let lines = inside_lines(&mesh, &camera, &options(&[LineKind::Ridge], inside));
    let found = points(&mesh, &lines, LineKind::Ridge);
    assert!(found.len() > 50, "{}", found.len());
    let off = found.iter().filter(|p| p.y.abs() > 0.05).count();
    assert!(off * 20 < found.len(), "{off} of {} off the plane of the long axes", found.len());
}

#[test]
fn apparent_ridges_gather_near_the_contour_of_a_tube() {
    // The curvature of a tube is constant around it; its view-dependent curvature is largest near the
    // contour.
    let mesh = mesh_of(&tube(200, 40, 1.0, 2.0));
    let camera = orthographic(DVec3::new(10.0, 0.0, 0.0), DVec3::ZERO, 5.0);
    let inside =
        InsideOptions { smooth: 0.0, apparent: true, apparent_ridge: 1e-5, ..InsideOptions::default() };
    let lines = inside_lines(&mesh, &camera, &options(&[LineKind::Ridge], inside));
    for p in points(&mesh, &lines, LineKind::Ridge).iter().filter(|p| p.z.abs() < 1.5) {
        assert!(p.y.abs() > 0.99, "{p}");
    }
}

#[test]
fn lines_do_not_depend_on_the_unit_or_the_order_of_faces() {
    let solid = bumpy(80);
    let all = options(
        &[LineKind::Suggestive, LineKind::Ridge, LineKind::Valley],
        InsideOptions { ridge: 0.01, valley: 0.01, ..InsideOptions::default() },
    );
    let eye = DVec3::new(5.0, 3.0, 4.0);
    let mesh = mesh_of(&solid);
    let lines = inside_lines(&mesh, &orthographic(eye, DVec3::ZERO, 4.0), &all);
    assert!(lines.segments.len() > 100);

    let large = mesh_of(&solid.clone().moved(|p| p * 1024.0));
    let of_large = inside_lines(&large, &orthographic(eye * 1024.0, DVec3::ZERO, 4096.0), &all);
    assert_eq!(lines.segments.len(), of_large.segments.len());
    for (small, large) in lines.points.iter().zip(&of_large.points) {
        assert!((*small * 1024.0).distance(*large) < 1e-5, "{small} {large}");
    }
    assert!(lines.strengths.iter().zip(&of_large.strengths).all(|(a, b)| (a - b).abs() < 1e-4));

    let mut turned = solid;
    turned.triangles.reverse();
    let mesh_of_turned = mesh_of(&turned);
    let of_turned = inside_lines(&mesh_of_turned, &orthographic(eye, DVec3::ZERO, 4.0), &all);
    let (one, other) = (length(&mesh, &lines), length(&mesh_of_turned, &of_turned));
    assert!(is_near(one, other, 1e-4 * one), "{one} {other}");
}

#[test]
fn line_strengths_are_in_0_to_1_and_fade_at_line_ends() {
    let mesh = mesh_of(&bumpy(80));
    let camera = orthographic(DVec3::new(5.0, 3.0, 4.0), DVec3::ZERO, 4.0);
    let lines = inside_lines(&mesh, &camera, &options(&[LineKind::Suggestive], InsideOptions::default()));
    assert_eq!(mesh.cleaning.borders, 0);
    assert_eq!(lines.strengths.len(), lines.points.len());
    assert!(lines.strengths.iter().all(|s| (0.0..=1.0).contains(s)));
    let mut degrees = vec![0; lines.points.len()];
    let ends = lines.segments.iter().flat_map(|s| s.ends);
    ends.for_each(|end| degrees[end as usize - mesh.positions.len()] += 1);
    let view = View::new(&mesh, &camera);
    for (point, degree) in degrees.iter().enumerate().filter(|(_, degree)| **degree == 1) {
        // A line that ends at a contour does not fade.
        let at = lines.points[point];
        let beside =
            lines.segments.iter().find(|s| s.ends.contains(&((mesh.positions.len() + point) as u32)));
        let face = mesh.corners(ligne::mesh::FaceId(beside.unwrap().hosts[0]));
        let normal = (face[1] - face[0]).cross(face[2] - face[0]).normalize();
        let towards = normal.dot(-view.frame.forward);
        assert!(lines.strengths[point] < 0.01 || towards < 0.2, "{degree} {at} {towards}");
    }
}

fn draw(solid: &Solid, sets: &[&str]) -> Vec<Mark> {
    let scene: Scene = pipeline::scene([solid.clone()]);
    let camera = orthographic(DVec3::new(5.0, 3.0, 4.0), DVec3::ZERO, 3.0);
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
    let style = Style::load_with("suggestive", &sets).unwrap();
    let drawing = ligne::render(&scene, &camera, &style).unwrap();
    drawing.layers.into_iter().flat_map(|layer| layer.marks).collect()
}

#[test]
fn fading_lines_are_outlines_with_an_axis() {
    let marks = draw(&bumpy(80), &[]);
    let outlines: Vec<&Mark> = marks.iter().filter(|m| matches!(m.paint, Paint::Outline(_))).collect();
    assert!(!outlines.is_empty());
    for mark in &outlines {
        let Paint::Outline(paint) = &mark.paint else { continue };
        assert_eq!(mark.provenance.classes, ["suggestive"]);
        assert_eq!(mark.path.elements().last(), Some(&kurbo::PathEl::ClosePath));
        assert!(paint.width > 0.0 && paint.width <= paint.pen_width);
        use kurbo::Shape;
        let (area, along) = (mark.path.area().abs(), paint.axis.perimeter(1e-3));
        let caps = paint.pen_width * paint.pen_width;
        assert!(is_near(area, paint.width * along, 0.05 * area + caps), "{area} {along} {}", paint.width);
    }
    let even = draw(&bumpy(80), &["pen.fade=0"]);
    assert!(even.iter().all(|m| matches!(m.paint, Paint::Stroke(_))));
    assert_eq!(even.len(), marks.len());
    let none = draw(&bumpy(80), &["lines.inside.suggestive=1000"]);
    assert!(none.iter().all(|m| m.provenance.classes[0] != "suggestive"));
}

#[test]
fn scans_show_few_and_long_suggestive_contours() {
    let Some(file) = shared_folder::find("organic/stanford-bunny.obj") else { return };
    let scene = Scene::open(&file).unwrap();
    let camera = Camera::three_quarter_of(scene.up).fit(&scene);
    let style = Style::load("suggestive").unwrap();
    let drawing = ligne::render(&scene, &camera, &style).unwrap();
    let svg = drawing.to_svg(&ligne::SvgOptions::default());
    let count = svg.matches("class=\"suggestive\"").count();
    assert!((8..=90).contains(&count), "{count}");
    assert!(svg.contains(" data-axis=\"M") && svg.contains(" data-width=\""));
}
