//! Tests of placed, mirrored and incomplete geometries in a soup.

use super::*;
use crate::scene::Material;

fn triangle() -> Geometry {
    Geometry {
        positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::splat(99.0)],
        triangles: vec![[0, 1, 2]],
        normals: vec![[0.0, 0.0, 2.0], [0.0; 3]],
        corner_normals: vec![[0, 0, 1]],
        edge_marks: vec![[EdgeMark::Hidden, EdgeMark::Hard, EdgeMark::Contour]],
        ..Geometry::default()
    }
}

fn scene(places: &[DAffine3]) -> Scene {
    let part =
        |(i, &world_from_part): (usize, _)| Part { name: format!("p{i}"), geometry: 0, world_from_part };
    let parts = places.iter().enumerate().map(part).collect();
    Scene { geometries: vec![triangle()], parts, materials: vec![Material::default()], ..Scene::default() }
}

#[test]
fn to_soup_with_identity_copies_the_geometry() {
    let soup = scene(&[DAffine3::IDENTITY]).to_soup();
    assert_eq!(soup.triangles, [[0, 1, 2]]);
    assert_eq!(soup.normals[0], [0.0, 0.0, 1.0]);
    assert_eq!(soup.corner_normals, [[0, 0, NO_INDEX]]);
    assert_eq!(soup.triangle_material, [MaterialId(1)]);
}

#[test]
fn take_soup_equals_to_soup() {
    let mirror = DAffine3::from_scale(DVec3::new(1.0, 1.0, -4.0));
    for places in [&[DAffine3::IDENTITY][..], &[mirror], &[mirror, DAffine3::IDENTITY]] {
        let mut model = scene(places);
        let copied = model.to_soup();
        assert_eq!(format!("{:?}", model.take_soup(None)), format!("{copied:?}"));
        assert!(model.geometries[0].positions.is_empty());
    }
}

#[test]
fn to_soup_reverses_the_winding_of_mirrored_parts() {
    let mirror = DAffine3::from_scale(DVec3::new(1.0, 1.0, -4.0));
    let soup = scene(&[DAffine3::from_translation(DVec3::Z), mirror]).to_soup();
    assert_eq!(soup.triangles, [[0, 1, 2], [4, 6, 5]]);
    assert_eq!(soup.triangle_part, [PartId(0), PartId(1)]);
    assert_eq!(soup.positions[0], DVec3::Z);
    assert_eq!(soup.corner_normals[1], [2, NO_INDEX, 2]);
    assert_eq!(soup.normals[2], [0.0, 0.0, -1.0]);
    assert_eq!(soup.edge_marks[1], [EdgeMark::Contour, EdgeMark::Hard, EdgeMark::Hidden]);
}

#[test]
fn to_soup_keeps_normals_perpendicular_under_scaling() {
    let mut model = scene(&[DAffine3::from_scale(DVec3::new(1.0, 3.0, 1.0))]);
    model.geometries[0].normals[0] = [1.0, 1.0, 0.0];
    let [x, y, _] = model.to_soup().normals[0];
    assert!((x - 3.0 * y).abs() < 1e-6);
}

#[test]
fn parts_with_degenerate_transforms_are_left_out_of_the_soup() {
    let huge = DAffine3::from_scale(DVec3::splat(1e100));
    let flat = DAffine3::from_scale(DVec3::new(1.0, 0.0, 1.0));
    let model =
        scene(&[DAffine3::from_scale(DVec3::ZERO), flat, huge, DAffine3::from_translation(DVec3::NAN)]);
    let soup = model.to_soup();
    assert!(soup.triangles.is_empty() && soup.positions.is_empty());
    assert_eq!(model.bounds(), None);
}

#[test]
fn scene_bounds_contain_only_drawn_geometry() {
    let model = scene(&[DAffine3::IDENTITY, DAffine3::from_translation(DVec3::new(5.0, -1.0, 0.0))]);
    assert_eq!(model.bounds(), Some((DVec3::new(0.0, -1.0, 0.0), DVec3::new(6.0, 1.0, 0.0))));
    assert_eq!(model.triangle_count(), 2);
    assert_eq!(Scene::default().bounds(), None);
}

#[test]
fn to_soup_fills_in_missing_attributes_of_parts() {
    let mut model = scene(&[DAffine3::IDENTITY; 2]);
    let plain = Geometry {
        positions: vec![DVec3::ZERO; 3],
        triangles: vec![[0, 1, 2]],
        wires: vec![[1, 2]],
        ..Geometry::default()
    };
    model.geometries.push(plain);
    model.parts[1].geometry = 1;
    let soup = model.to_soup();
    assert_eq!(soup.corner_normals[1], [NO_INDEX; 3]);
    assert_eq!(soup.edge_marks[1], [EdgeMark::Unmarked; 3]);
    assert_eq!(soup.wires, [Wire { vertices: [5, 6], part: PartId(1), material: MaterialId(1) }]);
    model.parts.reverse();
    let soup = model.to_soup();
    assert_eq!(soup.corner_normals, [[NO_INDEX; 3], [0, 0, NO_INDEX]]);
}
