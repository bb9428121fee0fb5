//! Faces that coincide, overlap in one plane or touch: each of their lines is drawn once.

use super::closed_forms::{
    MAX_END_ERROR_PX, assert_visible_lines, at, count_visible, cube, from_front, generic_views, joined,
    outline, polygon, rectangle,
};
use crate::library::support::measures::segment_sets::{check_equal_cover, doubled_length, total_length};
use crate::library::support::pipeline::{
    exact_options_with_hidden, orthographic, perspective, run_stages, scene, scene_of_geometries,
    solid_geometry,
};
use crate::library::support::references::textbook_camera::TextbookCamera;
use crate::library::support::scenes::solids::cuboid;
use glam::DVec3;
use ligne::lines::LineKind;
use ligne::scene::{Geometry, Material, Scene};

#[test]
fn a_square_exactly_behind_another_is_hidden() {
    let camera = perspective(at(0.0, 0.0, 4.0), DVec3::ZERO, 60.0);
    let square = |half: f64, z: f64| rectangle([-half, half], [-half, half], z);
    let drawn =
        run_stages(&scene([square(2.0, 0.0), square(1.0, 2.0)]), &camera, &exact_options_with_hidden());
    let front = [at(-1.0, -1.0, 2.0), at(1.0, -1.0, 2.0), at(1.0, 1.0, 2.0), at(-1.0, 1.0, 2.0)];
    assert_visible_lines(&drawn, &camera, &outline(&front));
    assert!((total_length(&drawn.hidden_segments()) - total_length(&drawn.visible_segments())).abs() < 1e-6);
}

#[test]
fn squares_that_overlap_in_one_plane_are_both_drawn_once() {
    let camera = from_front(8.0);
    let squares = [rectangle([0.0, 2.0], [0.0, 2.0], 0.0), rectangle([1.0, 3.0], [1.0, 3.0], 0.0)];
    let drawn = run_stages(&scene(squares), &camera, &exact_options_with_hidden());
    assert!((total_length(&drawn.visible_segments()) - 16.0 * 125.0).abs() < 1e-6);
    assert!(drawn.hidden_segments().is_empty());

    // Two sides coincide over one unit each.
    let squares = [rectangle([0.0, 2.0], [0.0, 2.0], 0.0), rectangle([1.0, 3.0], [0.0, 2.0], 0.0)];
    let drawn = run_stages(&scene(squares), &camera, &exact_options_with_hidden());
    assert!(
        (total_length(&drawn.visible_segments()) - 14.0 * 125.0).abs() < 0.1,
        "{}",
        total_length(&drawn.visible_segments())
    );
}

#[test]
fn nearly_coincident_faces_are_drawn_as_one() {
    for camera in generic_views() {
        let square = |z: f64| rectangle([-1.0, 1.0], [-1.0, 1.0], z);
        let drawn = run_stages(&scene([square(0.0), square(1e-7)]), &camera, &exact_options_with_hidden());
        let corners = [at(-1.0, -1.0, 0.0), at(1.0, -1.0, 0.0), at(1.0, 1.0, 0.0), at(-1.0, 1.0, 0.0)];
        let wanted = TextbookCamera::new(&camera).project_segments(&outline(&corners));
        check_equal_cover(&drawn.visible_segments(), &wanted, 1e-3, 1e-2).unwrap();
        assert!(doubled_length(&drawn.visible_segments(), 1e-3) < 1e-2);
    }
}

#[test]
fn t_vertices_leave_no_visible_cracks() {
    // The left half of the plate has no vertex at the middle of its right side.
    let plate = joined([
        rectangle([-2.0, 0.1], [-2.0, 2.0], 0.0),
        rectangle([0.1, 2.0], [-2.0, 0.3], 0.0),
        rectangle([0.1, 2.0], [0.3, 2.0], 0.0),
    ]);
    let behind = cuboid(at(-0.9, -0.9, -3.0), at(0.9, 0.9, -2.0));
    for camera in [perspective(at(0.3, 0.2, 9.0), DVec3::ZERO, 40.0), from_front(5.0)] {
        let drawn =
            run_stages(&scene([plate.clone(), behind.clone()]), &camera, &exact_options_with_hidden());
        let of_behind = drawn.map.edges.iter().filter(|e| e.part.index() == 1 && e.invisibility == 0);
        let shining: f64 = of_behind.map(|e| total_length(&[drawn.edge_ends(e)])).sum();
        assert_eq!(shining, 0.0);
        assert!(doubled_length(&drawn.visible_segments(), 1e-3) < 1e-2, "{:?}", drawn.visible_segments());
    }
}

#[test]
fn duplicated_faces_change_no_lines() {
    for camera in generic_views() {
        let mut twice = cube();
        let flipped = twice.triangles.iter().map(|&[a, b, c]| [b, a, c]).collect::<Vec<_>>();
        twice.triangles.extend(flipped);
        let drawn = run_stages(&scene([twice]), &camera, &exact_options_with_hidden());
        assert_eq!((count_visible(&drawn), drawn.hidden_segments().len()), (9, 3));
    }
}

#[test]
fn cubes_that_share_an_edge_or_a_vertex_show_all_their_lines() {
    let eye = at(6.3, -5.9, 2.4);
    let first = || cuboid(DVec3::ZERO, DVec3::ONE);
    for camera in [orthographic(eye, at(1.0, 1.0, 0.5), 5.0), perspective(eye, at(1.0, 1.0, 0.5), 35.0)] {
        let second = cuboid(at(1.0, 1.0, 0.0), at(2.0, 2.0, 1.0));
        let drawn = run_stages(&scene([joined([first(), second])]), &camera, &exact_options_with_hidden());
        assert_eq!(count_visible(&drawn), 17, "an edge");
        let second = cuboid(at(1.0, 1.0, 1.0), at(2.0, 2.0, 2.0));
        let drawn = run_stages(&scene([joined([first(), second])]), &camera, &exact_options_with_hidden());
        assert_eq!(count_visible(&drawn), 18, "a vertex");
    }
}

#[test]
fn inner_walls_are_not_visible() {
    // A box of two chambers. The outer sides are split where the wall meets them.
    let halves = joined([
        cuboid(at(-1.0, -0.5, -0.5), at(0.0, 0.5, 0.5)),
        cuboid(at(0.0, -0.5, -0.5), at(1.0, 0.5, 0.5)),
    ]);
    for camera in generic_views() {
        let drawn = run_stages(&scene([halves.clone()]), &camera, &exact_options_with_hidden());
        let plain = run_stages(
            &scene([cuboid(at(-1.0, -0.5, -0.5), at(1.0, 0.5, 0.5))]),
            &camera,
            &exact_options_with_hidden(),
        );
        check_equal_cover(&drawn.visible_segments(), &plain.visible_segments(), MAX_END_ERROR_PX, 1e-5)
            .unwrap();
    }
}

#[test]
fn a_bow_tie_shows_its_six_sides() {
    let camera = from_front(4.0);
    let left = [at(0.0, 0.0, 0.0), at(-1.0, 0.5, 0.0), at(-1.0, -0.5, 0.0)];
    let right = [at(0.0, 0.0, 0.0), at(1.0, -0.5, 0.0), at(1.0, 0.5, 0.0)];
    let drawn = run_stages(
        &scene([joined([polygon(&left), polygon(&right)])]),
        &camera,
        &exact_options_with_hidden(),
    );
    assert_eq!(count_visible(&drawn), 6);
    assert_visible_lines(&drawn, &camera, &[outline(&left), outline(&right)].concat());
}

#[test]
fn coincident_parts_of_two_materials_have_no_inner_border() {
    let sheet = |material: u32| Geometry {
        triangle_material: vec![material; 2],
        ..solid_geometry(rectangle([-1.0, 1.0], [-1.0, 1.0], 0.0))
    };
    let both =
        Scene { materials: vec![Material::default(); 2], ..scene_of_geometries(vec![sheet(0), sheet(1)]) };
    let drawn = run_stages(&both, &from_front(4.0), &exact_options_with_hidden());
    assert_eq!((count_visible(&drawn), drawn.visible_segments_of_kind(LineKind::Material).len()), (4, 0));

    // If one of them ends inside the other, there is a border.
    let half = Geometry { triangles: vec![[0, 1, 2]], triangle_material: vec![1], ..sheet(1) };
    let both = Scene { materials: vec![Material::default(); 2], ..scene_of_geometries(vec![sheet(0), half]) };
    let drawn = run_stages(&both, &from_front(4.0), &exact_options_with_hidden());
    assert_eq!((count_visible(&drawn), drawn.visible_segments_of_kind(LineKind::Material).len()), (5, 1));
}
