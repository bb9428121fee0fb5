//! The intersection search that is limited to visible faces draws the same lines as the full search.

use crate::library::support::pipeline::REFINEMENT_TOLERANCE_PX;
use crate::library::support::readers::shared_folder;
use crate::library::support::scenes::solids::{Solid, cuboid, sphere, torus, tube};
use glam::DVec3;
use ligne::lines::intersections::intersection_lines::{
    all_curves, curves_in_sight, curves_of_finer, search, visible_curves,
};
use ligne::lines::{
    self, Contours, FeatureLines, FeatureSegment, LineKind, LineOptions, Role, SharedSearches, Surface,
};
use ligne::mesh::intersect::intersection_curves::IntersectionCurves;
use ligne::mesh::{Mesh, Soup};
use ligne::scene::{Camera, Scene, UpAxis};
use ligne::surface::MeshSource;
use ligne::view::View;
use ligne::visibility::{self, ViewOcclusionBuffer};

/// View directions: azimuth and elevation, degrees.
const VIEW_ANGLES_DEG: [(f64, f64); 4] = [(35.0, 22.0), (200.0, 10.0), (120.0, 50.0), (-60.0, -20.0)];

/// Returns the visible length of the curves in a view, in thousandths of the longer side of the frame.
fn visible_length(mesh: &Mesh, view: &View, curves: &IntersectionCurves) -> f64 {
    let first = mesh.positions.len() as u32;
    let segment = |s: &ligne::mesh::intersect::intersection_curves::IntersectionSegment| FeatureSegment {
        ends: s.ends.map(|end| first + end),
        hosts: s.faces,
        kind: LineKind::Intersection,
        both_seen: true,
        smooth: false,
        origin: MeshSource::default(),
        role: Role::Line,
        strength: 180.0,
        part: mesh.face_part[s.faces[0] as usize],
        material: mesh.face_material[s.faces[0] as usize],
    };
    let lines = FeatureLines {
        points: curves.points.clone(),
        segments: curves.segments.iter().map(segment).collect(),
        ..FeatureLines::default()
    };
    let map = visibility::build(mesh, view, &lines, &LineOptions::default());
    let place = |vertex: visibility::ViewVertexId| map.vertices[vertex.0 as usize].position;
    let visible = map.edges.iter().filter(|edge| edge.invisibility == 0);
    let length: f64 = visible.map(|edge| place(edge.start).distance(place(edge.end))).sum();
    length * 1000.0 / view.frame.width.max(view.frame.height)
}

/// Compares both searches from several directions. Returns the largest visible length.
fn compare(name: &str, mesh: &Mesh, fit: impl Fn(Camera) -> Camera, up: UpAxis) -> f64 {
    let all = all_curves(mesh);
    let mut greatest = 0.0_f64;
    for (azimuth, elevation) in VIEW_ANGLES_DEG {
        let camera = fit(Camera::azimuth_elevation(azimuth, elevation, up));
        let view = View::new(mesh, &camera);
        let visible = visible_curves(mesh, &view);
        let pairs = |curves: &IntersectionCurves| curves.segments.iter().map(|s| s.faces).collect::<Vec<_>>();
        let known = pairs(&all);
        assert!(pairs(&visible).iter().all(|f| known.binary_search(f).is_ok()), "{name}: an unknown pair");
        let (expected, found) = (visible_length(mesh, &view, &all), visible_length(mesh, &view, &visible));
        assert!(
            (expected - found).abs() <= (1e-3 * expected).max(1.0),
            "{name} from {azimuth}°, {elevation}°: {found} px of {expected} px"
        );
        if let Some(covers) = ViewOcclusionBuffer::of(mesh, &view) {
            let out = covers.occluded_faces(mesh, &view);
            assert_hidden(name, mesh, &view, &out);
            let in_sight = curves_in_sight(mesh, out);
            assert!(
                pairs(&in_sight).iter().all(|f| known.binary_search(f).is_ok()),
                "{name}: an unknown pair"
            );
            let found = visible_length(mesh, &view, &in_sight);
            assert!(
                (expected - found).abs() <= 1e-6 * expected,
                "{name}: {found} px in sight of {expected} px"
            );
        }
        greatest = greatest.max(expected);
    }
    greatest
}

/// Asserts by rays that another face lies in front of each sample point of the culled faces.
fn assert_hidden(name: &str, mesh: &Mesh, view: &View, out: &[bool]) {
    let corners = |face: usize| mesh.triangles[face].map(|v| view.points[v as usize]);
    let hidden: Vec<usize> = (0..out.len()).filter(|face| out[*face]).collect();
    // A few hundred faces are a sufficient sample.
    for face in hidden.iter().step_by((hidden.len() / 300).max(1)) {
        let [a, b, c] = corners(*face);
        for [s, t] in [[0.01, 0.01], [0.98, 0.01], [0.01, 0.98], [0.33, 0.34]] {
            let p = a + (b - a) * s + (c - a) * t;
            let is_before = |other: usize| {
                let [a, b, c] = corners(other);
                let [u, v, w] = [b - a, c - a, p - a].map(DVec3::truncate);
                let area = u.perp_dot(v);
                let (s, t) = (w.perp_dot(v) / area, u.perp_dot(w) / area);
                s >= 0.0 && t >= 0.0 && s + t <= 1.0 && (a + (b - a) * s + (c - a) * t).z > p.z
            };
            assert!(
                (0..out.len()).any(|other| other != *face && is_before(other)),
                "{name}: {face} shows at {p}"
            );
        }
    }
}

fn compare_solids(name: &str, solids: impl IntoIterator<Item = Solid>) -> f64 {
    let mut all = Solid::default();
    solids.into_iter().for_each(|solid| all.add(solid));
    let mesh = mesh_of(&all);
    let points = all.positions.clone();
    compare(name, &mesh, |camera| camera.fit_points(&points, 0.05), UpAxis::Z)
}

fn mesh_of(solid: &Solid) -> Mesh {
    Mesh::build(Soup {
        positions: solid.positions.clone(),
        triangles: solid.triangles.clone(),
        ..Soup::default()
    })
}

#[test]
fn visible_curves_of_boxes_balls_and_tubes_match_the_full_search() {
    let tilted = |p: DVec3| DVec3::new(p.x, 0.8 * p.y - 0.6 * p.z, 0.6 * p.y + 0.8 * p.z);
    let block = || cuboid(DVec3::splat(-1.0), DVec3::splat(1.0));
    let beam = cuboid(DVec3::new(-3.0, -0.5, -0.25), DVec3::new(3.0, 0.5, 0.25)).moved(tilted);
    assert!(compare_solids("beam", [block(), beam]) > 100.0);
    assert!(compare_solids("ball", [block(), sphere(40, 1.2).moved(tilted)]) > 100.0);
    assert!(compare_solids("tubes", [tube(60, 4, 0.5, 2.0), tube(60, 4, 0.4, 2.0).moved(tilted)]) > 100.0);
}

#[test]
fn visible_curves_of_fine_meshes_match_the_full_search() {
    let upright = |p: DVec3| DVec3::new(p.x + 0.3, p.z, p.y);
    let tori = [torus(400, 150, 1.0, 0.3), torus(300, 150, 1.0, 0.3).moved(upright)];
    assert!(compare_solids("tori", tori) > 100.0);
}

#[test]
fn visible_curves_of_sunken_boxes_match_the_full_search() {
    let ground = cuboid(DVec3::new(-1.0, -1.0, -1.0), DVec3::new(31.0, 31.0, 0.0));
    let house = |i: usize| {
        let low = DVec3::new((i % 30) as f64, (i / 30) as f64, -0.01);
        let turned = |p: DVec3| low + DVec3::new(0.8 * p.x - 0.3 * p.y, 0.3 * p.x + 0.8 * p.y, p.z);
        cuboid(DVec3::ZERO, DVec3::new(0.9, 0.7, 0.3 + (i * 7 % 17) as f64 / 10.0)).moved(turned)
    };
    assert!(compare_solids("field", std::iter::once(ground).chain((0..900).map(house))) > 1000.0);
}

/// Vertical plates one behind the other, with rods through all of them.
fn pierced_plates() -> Solid {
    let mut all = Solid::default();
    for k in 0..9 {
        let y = f64::from(k);
        // The plates in front are lower, so the upper edge of each is visible.
        all.add(cuboid(DVec3::new(-8.0, y, -4.0), DVec3::new(8.0, y + 0.2, 4.0 + 0.3 * y)));
        // Many small faces, behind and in front.
        let ball = sphere(24, 0.7).moved(|p| p + DVec3::new(1.7 * y - 7.0, y + 0.3, 3.9 + 0.3 * y));
        all.add(ball);
    }
    for k in 0..24 {
        let (x, z) = (f64::from(k % 8) * 2.0 - 7.0, f64::from(k / 8) * 2.5 - 2.0);
        all.add(cuboid(DVec3::new(x, -1.0, z), DVec3::new(x + 0.6, 10.0, z + 0.5)));
    }
    all
}

#[test]
fn culled_faces_are_hidden_from_every_ray() {
    let solid = pierced_plates();
    let mesh = mesh_of(&solid);
    let mut told = 0;
    for (azimuth, elevation) in VIEW_ANGLES_DEG {
        let camera =
            Camera::azimuth_elevation(azimuth, elevation, UpAxis::Z).fit_points(&solid.positions, 0.05);
        // Once with the whole model on the page, once with the model larger than the page.
        for camera in [camera, Camera { width: 400.0, ..camera }] {
            let view = View::new(&mesh, &camera);
            let covers = ViewOcclusionBuffer::of(&mesh, &view).expect("there are many layers");
            let out = covers.occluded_faces(&mesh, &view);
            told += out.iter().filter(|out| **out).count();
            assert!(curves_in_sight(&mesh, out).segments.len() < all_curves(&mesh).segments.len());
        }
    }
    assert!(told > mesh.triangles.len(), "{told}");
    assert!(compare_solids("plates", [solid]) > 1000.0);
}

/// The first view searches only the visible faces; later views use the full search. All drawings are equal.
#[test]
fn redrawing_a_view_gives_the_same_drawing() {
    let solid = pierced_plates();
    let corners = solid.positions.iter().map(|p| p.to_array());
    let scene = Scene::from_triangles(corners, solid.triangles.iter().copied()).expect("a scene");
    for style in ["ink", "toon", "technical"] {
        let style = ligne::Style::load(style).expect("a style");
        let prepared = ligne::pipeline::Renderer::new(&scene, &style);
        for turn in [30.0, 200.0] {
            let camera = Camera::azimuth_elevation(turn, 20.0, UpAxis::Z).fit_points(&solid.positions, 0.05);
            let page = ligne::drawing::Page {
                width: camera.width,
                height: camera.height,
                unit: ligne::drawing::Unit::Px,
                background: None,
            };
            let draw =
                |prepared: &ligne::pipeline::Renderer| prepared.draw(&camera, page).expect("a drawing").0;
            let alone = draw(&ligne::pipeline::Renderer::new(&scene, &style));
            assert!(draw(&prepared) == alone && draw(&prepared) == alone, "{turn}");
        }
    }
}

#[test]
fn cached_curves_give_the_lines_of_every_view() {
    let mut both = cuboid(DVec3::splat(-1.0), DVec3::splat(1.0));
    both.add(sphere(40, 1.2));
    let options = LineOptions::default();
    let surface = Surface::new(mesh_of(&both), &options);
    let curves = all_curves(&surface.mesh);
    assert!(curves.segments.len() > 100);
    for (azimuth, elevation) in VIEW_ANGLES_DEG {
        let camera = Camera::azimuth_elevation(azimuth, elevation, UpAxis::Z);
        let view = View::new(&surface.mesh, &camera.fit_points(&both.positions, 0.05));
        let with = |intersections| {
            let known = SharedSearches { intersections: Some(intersections), ..SharedSearches::default() };
            lines::extract_with(&surface, known, &view, &options)
        };
        let plain = lines::extract(&surface, &view, &options);
        assert_eq!(with(&curves), plain);
        // Curves that are given are not searched again.
        assert_ne!(with(&IntersectionCurves::default()), plain);
    }
}

#[test]
fn visible_curves_do_not_depend_on_the_thread_count() {
    let mut both = sphere(60, 1.0);
    both.add(tube(80, 30, 0.3, 2.0));
    let mesh = mesh_of(&both);
    let camera = Camera::azimuth_elevation(35.0, 22.0, UpAxis::Z).fit_points(&both.positions, 0.05);
    let view = View::new(&mesh, &camera);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| visible_curves(&mesh, &view))
    };
    let one = with(1);
    assert!(!one.segments.is_empty());
    assert_eq!(one, with(3));
}

#[test]
fn visible_curves_of_models_match_the_full_search() {
    for name in [
        "organic/teapot.obj",
        "edge/self-intersecting.obj",
        "scene/CesiumMilkTruck.glb",
        "scene/retroufo.gltf",
    ] {
        let Some(path) = shared_folder::find(name) else { continue };
        let scene = Scene::open(&path).expect("a model");
        let mesh = Mesh::build(scene.to_soup());
        compare(name, &mesh, |camera| camera.fit(&scene), scene.up);
    }
}

#[test]
fn coarse_search_results_give_the_curves_of_refined_surfaces() {
    let tilted = |p: DVec3| DVec3::new(p.x + 0.3, 0.8 * p.y - 0.6 * p.z, 0.6 * p.y + 0.8 * p.z);
    let mut all = cuboid(DVec3::splat(-1.0), DVec3::splat(1.0));
    all.add(torus(24, 12, 1.1, 0.4));
    all.add(torus(24, 12, 1.1, 0.4).moved(tilted));
    // A degenerate face, which has no intersections.
    let first = all.positions.len() as u32;
    all.positions.extend([DVec3::new(-0.5, 0.0, 0.3), DVec3::new(0.5, 0.0, 0.3), DVec3::new(1.5, 0.0, 0.3)]);
    all.triangles.push([first, first + 1, first + 2]);
    let options = LineOptions { contours: Contours::Smooth, ..LineOptions::default() };
    let surface = Surface::new(mesh_of(&all), &options);
    let known = search(&surface.mesh);
    assert_eq!(known.curves(), all_curves(&surface.mesh));
    let mut found = [0, 0];
    for (azimuth, elevation) in VIEW_ANGLES_DEG {
        let camera = Camera::azimuth_elevation(azimuth, elevation, UpAxis::Z);
        let finer = surface
            .refined_for(&camera.fit_points(&all.positions, 0.05), REFINEMENT_TOLERANCE_PX)
            .expect("it is coarse");
        let (kept, faces) = (finer.kept_count, finer.surface.mesh.triangles.len());
        assert!(kept > 0 && faces > kept);
        let curves = all_curves(&finer.surface.mesh);
        for segment in &curves.segments {
            let pieces = segment.faces.iter().filter(|face| **face as usize >= kept).count();
            found[0] += usize::from(pieces == 1);
            found[1] += usize::from(pieces == 2);
        }
        assert_eq!(curves_of_finer(&known, &finer), curves);
    }
    // Refined faces crossing unrefined faces, and refined faces crossing each other.
    assert!(found.iter().all(|count| *count > 0), "{found:?}");
}
