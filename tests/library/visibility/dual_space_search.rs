//! The contour search in dual space finds exactly the lines of testing every edge, and tests few edges.

use crate::library::support::long_run::{is_long, select_for_run};
use crate::library::support::pipeline::{
    REFINEMENT_TOLERANCE_PX, exact_options, orthographic, perspective, scene,
};
use crate::library::support::readers::shared_folder;
use crate::library::support::scenes::random_dice::Dice;
use crate::library::support::scenes::random_scenes::{
    ALL_CAMERA_KINDS, ALL_SCENE_KINDS, random_camera, random_scene,
};
use crate::library::support::scenes::round_solids;
use crate::library::support::scenes::solids::{Solid, cuboid, sphere};
use glam::DVec3;
use ligne::lines::{self, Contours, EdgeSearch, LineKind, LineOptions, SharedSearches, Surface};
use ligne::mesh::bvh::ToneTree;
use ligne::mesh::{EdgeFaces, FaceId, MaterialId, Mesh};
use ligne::scene::{Camera, Projection, Scene};
use ligne::view::View;

/// Asserts that both searches find the same lines and that the candidates are sorted and unique. Returns the
/// number of edges tested for contours and the number of contour segments.
fn check(surface: &Surface, search: &EdgeSearch, camera: &Camera, options: &LineOptions) -> (usize, usize) {
    let view = View::new(&surface.mesh, camera);
    let plain = lines::extract(surface, &view, options);
    let known = SharedSearches { search: Some(search), ..SharedSearches::default() };
    assert_eq!(lines::extract_with(surface, known, &view, options), plain, "{camera:?}");

    let found = search.tree().candidates(view.frame.homogeneous_eye()).items;
    let with_fixed = search.candidates(&surface.mesh, &view).items;
    assert!(with_fixed.is_sorted() && with_fixed.windows(2).all(|w| w[0] != w[1]));
    let of_both = found.len() + search.fixed().len();
    // Edges of faces whose facing is uncertain are added.
    assert!((of_both..=of_both + 3 * view.unsure.len()).contains(&with_fixed.len()));
    let contours = plain.segments.iter().filter(|s| s.kind == LineKind::Contour).count();
    (found.len(), contours)
}

fn check_all(scene: &Scene, cameras: &[Camera], options: &LineOptions) {
    let surface = Surface::new(Mesh::build(scene.to_soup()), options);
    let search = EdgeSearch::new(&surface);
    for camera in cameras {
        check(&surface, &search, camera, options);
    }
}

/// Directions to the 6 faces, 12 edges and 8 corners of a cube.
fn cube_directions() -> Vec<DVec3> {
    let steps = [-1.0, 0.0, 1.0];
    let all = steps.iter().flat_map(|x| steps.map(|y| (*x, y)));
    all.flat_map(|(x, y)| steps.map(|z| DVec3::new(x, y, z))).filter(|d| *d != DVec3::ZERO).collect()
}

/// Orthographic and perspective views from all these directions, including the axes.
fn views(distance: f64) -> Vec<Camera> {
    let both = |d: DVec3| {
        let eye = d.normalize() * distance;
        [orthographic(eye, DVec3::ZERO, 3.0), perspective(eye, DVec3::ZERO, 40.0)]
    };
    cube_directions().into_iter().flat_map(both).collect()
}

#[test]
fn dual_search_finds_the_same_lines_in_random_scenes() {
    let mut dice = Dice::new(31);
    let mut asked_for = [exact_options(), LineOptions::default(), exact_options()];
    asked_for[1].contours = Contours::Smooth;
    asked_for[2].kinds = vec![LineKind::Contour];
    for kind in ALL_SCENE_KINDS {
        for options in &asked_for {
            let scene = random_scene(kind, &mut dice);
            let cameras: Vec<Camera> = ALL_CAMERA_KINDS
                .iter()
                .flat_map(|c| [random_camera(c, &mut dice), random_camera(c, &mut dice)])
                .collect();
            check_all(&scene, &cameras, options);
            check_all(&scene, &views(4.0), options);
        }
    }
}

#[test]
fn dual_search_handles_mixed_winding_materials_and_stitches() {
    let mut dice = Dice::new(5);
    for round in 0..6 {
        let mut solid = sphere(9, 0.8);
        solid.add(cuboid(DVec3::splat(-0.5), DVec3::splat(0.9)));
        // Three faces at one edge, and zero-area triangles.
        let first = solid.triangles[40];
        solid.triangles.push([first[1], first[0], 0]);
        let middle = (solid.positions[first[0] as usize] + solid.positions[first[1] as usize]) / 2.0;
        solid.positions.push(middle);
        solid.triangles.push([first[0], first[1], solid.positions.len() as u32 - 1]);
        for t in &mut solid.triangles {
            if round > 0 && dice.below(4) == 0 {
                t.swap(0, 1);
            }
        }
        let mut soup = scene([solid]).to_soup();
        soup.triangle_material =
            (0..soup.triangles.len()).map(|_| MaterialId(dice.below(9) as u32 / 8)).collect();
        let surface = Surface::new(Mesh::build(soup), &exact_options());
        let search = EdgeSearch::new(&surface);
        for camera in views(3.0) {
            check(&surface, &search, &camera, &exact_options());
        }
    }
}

#[test]
fn dual_search_works_at_any_scale_place_and_camera() {
    let grains = |scale: f64, place: DVec3| {
        scene([
            sphere(11, 1.0).moved(|p| p * scale + place),
            cuboid(place, place + DVec3::splat(1.7 * scale)),
        ])
    };
    for scale in [1e-120, 1e-60, 1e-9, 1.0, 1e9, 1e60, 1e110] {
        for place in [DVec3::ZERO, DVec3::new(3e5, -2e6, 1.0) * scale] {
            let scene = grains(scale, place);
            let surface = Surface::new(Mesh::build(scene.to_soup()), &exact_options());
            let search = EdgeSearch::new(&surface);
            let origin = surface.mesh.origin;
            let vertex = origin + surface.mesh.positions[17];
            for distance in [0.0, 1e-9, 0.3, 3.0, 1e12, 1e60] {
                for direction in select_for_run(cube_directions()) {
                    let away = direction.normalize() * (scale * distance);
                    for camera in [
                        perspective(origin + away, origin - direction * scale, 40.0),
                        perspective(vertex + away, vertex - direction * scale, 40.0),
                        orthographic(origin + direction * scale, origin, 3.0 * scale),
                    ] {
                        check(&surface, &search, &camera, &exact_options());
                    }
                }
            }
        }
    }
}

#[test]
fn a_box_has_the_contours_of_its_visible_sides() {
    let boxes = scene([cuboid(DVec3::NEG_ONE, DVec3::ONE)]);
    let options = LineOptions { crease_deg: 180.0, ..exact_options() };
    let surface = Surface::new(Mesh::build(boxes.to_soup()), &options);
    let search = EdgeSearch::new(&surface);
    assert_eq!((search.tree().len(), search.fixed().len()), (18, 0));
    for direction in cube_directions() {
        // One, two or three sides are visible.
        let contours = [4, 6, 6][direction.abs().element_sum() as usize - 1];
        for camera in
            [perspective(direction * 9.0, DVec3::ZERO, 40.0), orthographic(direction * 9.0, DVec3::ZERO, 3.0)]
        {
            let (asked, found) = check(&surface, &search, &camera, &options);
            assert_eq!(found, contours, "{direction}");
            assert!(asked >= found);
        }
    }
}

#[test]
fn dual_search_tests_few_edges_of_round_solids() {
    let mut shares = Vec::new();
    for level in [3, 4, 5, 6] {
        let globe = scene([round_solids::icosphere(level)]);
        let surface = Surface::new(Mesh::build(globe.to_soup()), &exact_options());
        let search = EdgeSearch::new(&surface);
        let (mut asked, mut contours, mut count) = (0, 0, 0);
        for camera in views(4.0) {
            let (a, c) = check(&surface, &search, &camera, &exact_options());
            (asked, contours, count) = (asked + a, contours + c, count + 1);
        }
        assert!(asked >= contours);
        shares.push(asked as f64 / (count * search.tree().len()) as f64);
    }
    println!("shares of the edges asked: {shares:?}");
    // The number of contours grows with the square root of the edges, so a finer level halves their share.
    assert!(shares.windows(2).all(|w| w[1] < 0.65 * w[0]), "{shares:?}");
    assert!(shares[3] < 0.05, "{shares:?}");
}

#[test]
fn edges_left_out_by_the_dual_search_are_no_contours() {
    let mut dice = Dice::new(77);
    let scene = random_scene("mixture", &mut dice);
    let mesh = Mesh::build(scene.to_soup());
    let tree = ligne::mesh::bvh::DualTree::new(&mesh, |_| true);
    assert_eq!(tree.len(), mesh.edges.len());
    for camera in views(2.5) {
        let view = View::new(&mesh, &camera);
        let found = tree.candidates(view.frame.homogeneous_eye());
        let mut left_out = 0;
        for edge in 0..mesh.edges.len() {
            if found.items.binary_search(&(edge as u32)).is_ok() {
                continue;
            }
            left_out += 1;
            let EdgeFaces::Two { faces, same_way } = mesh.edges.faces(edge) else {
                panic!("edge {edge} is no pair");
            };
            assert!(faces.iter().all(|f| !mesh.is_degenerate(FaceId(*f))));
            let [a, b] = faces.map(|f| view.facing[f as usize]);
            assert_eq!(a != b, same_way, "edge {edge}");
        }
        assert!(left_out > mesh.edges.len() / 3, "{left_out} of {}", mesh.edges.len());
    }
}

#[test]
fn tone_tree_finds_all_triangles_with_a_tone_border() {
    let mut dice = Dice::new(8);
    let ball = round_solids::icosphere(5);
    let corners: Vec<[DVec3; 3]> =
        ball.triangles.iter().map(|t| t.map(|v| ball.positions[v as usize])).collect();
    let tree = ToneTree::new(&corners);
    for level in [-0.4, 0.0, 0.3, 0.6, 0.95] {
        let light = dice.direction();
        let found = tree.candidates(light, level).items;
        let mut holding = 0;
        for (id, normals) in corners.iter().enumerate() {
            let mut sides = normals.map(|n| n.dot(light) >= level).to_vec();
            for _ in 0..6 {
                let (u, v) = (dice.between(0.0, 1.0), dice.between(0.0, 1.0));
                let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
                let [a, b, c] = *normals;
                let inside = a * (1.0 - u - v) + b * u + c * v;
                sides.extend([inside.dot(light) >= level, inside.normalize().dot(light) >= level]);
            }
            if sides.contains(&true) && sides.contains(&false) {
                holding += 1;
                assert!(found.binary_search(&(id as u32)).is_ok(), "triangle {id} at {level}");
            }
        }
        // The border is a circle, and its triangles form a band one triangle wide.
        assert!(holding > 80 && found.len() < 8 * holding, "{} for {holding}", found.len());
    }
    // Normals in all directions, or zero normals, are candidates for every light.
    let wild = [[DVec3::X, DVec3::NEG_X, DVec3::Y], [DVec3::ZERO; 3]];
    let wild = ToneTree::new(&wild);
    assert_eq!(wild.candidates(DVec3::Z, 0.9).items, [0, 1]);
}

#[test]
fn dual_search_finds_the_same_lines_in_models() {
    let own = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/");
    let own = ["gear.obj", "pump.glb", "knot.ply", "bracket.stl", "bear.ply", "castle.obj", "teapot.obj"]
        .map(|name| Some(std::path::PathBuf::from(format!("{own}{name}"))));
    let shared = ["cad/drive.glb", "mechanical/rocker-arm.obj", "organic/armadillo.obj"];
    let shared = if is_long() { shared.map(shared_folder::find).to_vec() } else { Vec::new() };
    for path in own.into_iter().chain(shared).flatten() {
        let scene = Scene::open(&path).expect("a model");
        let mesh = Mesh::build(scene.to_soup());
        for options in [exact_options(), LineOptions::default()] {
            let surface = Surface::new(mesh.clone(), &options);
            let search = EdgeSearch::new(&surface);
            for direction in cube_directions().into_iter().step_by(5) {
                let camera =
                    Camera { eye: direction.normalize(), target: DVec3::ZERO, ..Camera::three_quarter() };
                let parallel = camera.with_projection(Projection::Orthographic { height: 1.0 }).fit(&scene);
                for camera in [camera.fit(&scene), parallel] {
                    check(&surface, &search, &camera, &options);
                    // A refined mesh does not fit the search, so every edge is tested.
                    let finer = surface.clone().finer_for(&camera, REFINEMENT_TOLERANCE_PX);
                    if finer.mesh.edges.len() != surface.mesh.edges.len() {
                        assert!(!search.fits(&finer.mesh));
                    }
                }
            }
        }
    }
}

#[test]
fn dual_search_accepts_an_empty_surface() {
    let surface = Surface::new(Mesh::build(scene([Solid::default()]).to_soup()), &exact_options());
    let search = EdgeSearch::new(&surface);
    assert_eq!(check(&surface, &search, &perspective(DVec3::Z, DVec3::ZERO, 30.0), &exact_options()), (0, 0));
}

/// Repeated views build the search trees. They must not change any drawing.
#[test]
fn cached_dual_search_does_not_change_drawings() {
    let ball = scene([round_solids::icosphere(5)]);
    let style = ligne::style::Style::load_with("technical", &["lines.contours=mesh".to_owned()]).unwrap();
    let page = |camera: &Camera| ligne::drawing::Page {
        width: camera.width,
        height: camera.height,
        unit: ligne::drawing::Unit::Px,
        background: None,
    };
    let prepared = ligne::pipeline::Renderer::new(&ball, &style);
    assert!(edge_count(&ball) > 20_000);
    // The trees are built for the hundredth view.
    let small = Camera { width: 40.0, height: 40.0, ..views(4.0)[0] };
    (0..100).for_each(|_| drop(prepared.draw(&small, page(&small)).unwrap()));
    for camera in views(4.0).into_iter().take(12) {
        let (drawing, _) = prepared.draw(&camera, page(&camera)).unwrap();
        let alone = ligne::pipeline::Renderer::new(&ball, &style).draw(&camera, page(&camera)).unwrap().0;
        assert!(drawing == alone, "{camera:?}");
    }
}

/// Returns the number of edges of a scene's mesh.
fn edge_count(scene: &Scene) -> usize {
    Mesh::build(scene.to_soup()).edges.len()
}
