//! Simplified shapes: closed forms keep their shape, borders, creases and seams, and models stay near the
//! original.

use glam::DVec3;
use ligne::Scene;
use ligne::edit::simplify::Detail;
use ligne::scene::{Geometry, Material, Part};

use super::detail_levels::{example, one_part_scene, simplified_to};
use crate::library::support::scenes::random_dice::Dice;

/// Grid of squares, each split in two. `place` maps the unit square into space.
fn grid(side: u32, place: impl Fn(f64, f64) -> DVec3) -> Geometry {
    let (count, number) = (side + 1, |i: u32, j: u32| j * (side + 1) + i);
    let share = |k: u32| f64::from(k) / f64::from(side);
    let positions = (0..count * count).map(|k| place(share(k % count), share(k / count))).collect();
    let squares = (0..side * side).map(|k| (k % side, k / side));
    let cut = |(i, j)| {
        let [a, b, c, d] = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)];
        if (i + j) % 2 == 0 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] }
    };
    Geometry { positions, triangles: squares.flat_map(cut).collect(), ..Geometry::default() }
}

/// Two geometries merged into one. Only positions and triangles are merged.
fn merged_geometry(mut one: Geometry, other: &Geometry) -> Geometry {
    let first = one.positions.len() as u32;
    one.positions.extend(&other.positions);
    one.triangles.extend(other.triangles.iter().map(|corners| corners.map(|corner| corner + first)));
    one
}

fn faces(geometry: &Geometry) -> impl Iterator<Item = [DVec3; 3]> {
    geometry.triangles.iter().map(|corners| corners.map(|corner| geometry.positions[corner as usize]))
}

fn area_vector([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a) / 2.0
}

#[test]
fn a_flat_grid_simplifies_to_two_triangles() {
    let turn = Dice::new(5).turn();
    for place in [DVec3::ZERO, DVec3::new(4e5, -2e5, 7.0)] {
        let scene = one_part_scene(grid(24, |x, y| turn * DVec3::new(3.0 * x, y, 0.0) + place));
        let (coarse, faces_left) = simplified_to(&scene, 2);
        assert_eq!(faces_left, 2);
        let whole: DVec3 = faces(&coarse.geometries[0]).map(area_vector).sum();
        assert!((whole - turn * DVec3::Z * 3.0).length() < 1e-9);
        assert_eq!(coarse.geometries[0].positions.len(), 4, "only the corners are left");
    }
}

#[test]
fn a_cube_keeps_twelve_triangles_and_eight_corners() {
    let sides = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
    let of_side = |normal: DVec3| {
        let (right, up) = normal.any_orthonormal_pair();
        grid(8, move |x, y| normal + right * (2.0 * x - 1.0) + up * (2.0 * y - 1.0))
    };
    let cube = sides.map(of_side).into_iter().reduce(|cube, side| merged_geometry(cube, &side)).unwrap();
    let (coarse, faces_left) = simplified_to(&one_part_scene(cube), 12);
    assert_eq!(faces_left, 12);
    let cube = &coarse.geometries[0];
    let volume: f64 = faces(cube).map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum();
    assert!((volume - 8.0).abs() < 1e-12, "{volume}");
    assert!(cube.positions.iter().all(|p| p.abs() == DVec3::ONE), "{:?}", cube.positions);
}

#[test]
fn simplification_keeps_the_border_of_an_open_sheet() {
    let wave = |x: f64, y: f64| {
        DVec3::new(x, y, 0.05 * ligne::geometry::numbers::portable_math::sin(9.0 * x + 4.0 * y))
    };
    let scene = one_part_scene(grid(40, wave));
    let (coarse, faces_left) = simplified_to(&scene, 320);
    assert!(faces_left > 310, "{faces_left}");
    // The projection from above is still the whole square.
    let above: f64 = faces(&coarse.geometries[0]).map(|face| area_vector(face).z).sum();
    assert!((above - 1.0).abs() < 1e-12, "{above}");
}

#[test]
fn simplification_keeps_the_crease_of_a_bent_sheet() {
    let bent = |x: f64, y: f64| if x < 0.5 { DVec3::new(x, y, 0.0) } else { DVec3::new(0.5, y, x - 0.5) };
    let (coarse, faces_left) = simplified_to(&one_part_scene(grid(20, bent)), 4);
    assert_eq!(faces_left, 4);
    let whole: f64 = faces(&coarse.geometries[0]).map(|face| area_vector(face).length()).sum();
    assert!((whole - 1.0).abs() < 1e-12, "{whole}");
}

/// Two adjacent unit squares. `change` gives the right one other texture coordinates, colours or materials.
fn two_squares(change: impl Fn(&mut Geometry, &dyn Fn(usize) -> bool)) -> Scene {
    let mut geometry = merged_geometry(
        grid(12, |x, y| DVec3::new(x, y, 0.0)),
        &grid(12, |x, y| DVec3::new(1.0 + x, y, 0.0)),
    );
    let half = geometry.positions.len() / 2;
    change(&mut geometry, &|vertex| vertex >= half);
    let mut scene = one_part_scene(geometry);
    let material = Material { texture: Some("picture.png".to_owned()), ..Material::default() };
    scene.materials = vec![material.clone(), material];
    scene
}

fn is_right(face: [DVec3; 3]) -> bool {
    (face[0] + face[1] + face[2]).x > 3.0
}

#[test]
fn simplification_keeps_texture_colour_and_material_seams() {
    let pictured = two_squares(|geometry, is_right| {
        let uv = |(vertex, p): (usize, &DVec3)| {
            [p.x as f32 + if is_right(vertex) { 5.0 } else { 0.0 }, p.y as f32]
        };
        geometry.uvs = geometry.positions.iter().enumerate().map(uv).collect();
        geometry.corner_uvs = geometry.triangles.clone();
    });
    let coloured = two_squares(|geometry, is_right| {
        let colour = |vertex| if is_right(vertex) { [1.0, 0.0, 0.0, 1.0] } else { [0.0, 1.0, 0.0, 1.0] };
        geometry.colours = (0..geometry.positions.len()).map(colour).collect();
    });
    let painted = two_squares(|geometry, is_right| {
        let material = |corners: &[u32; 3]| u32::from(is_right(corners[0] as usize));
        geometry.triangle_material = geometry.triangles.iter().map(material).collect();
    });
    let mut parts = painted.clone();
    let whole = parts.geometries.remove(0);
    for right in [0, 1] {
        let triangles = whole.triangles.iter().zip(&whole.triangle_material);
        let triangles = triangles.filter(|(_, own)| **own == right).map(|(corners, _)| *corners).collect();
        let positions = whole.positions.clone();
        parts.geometries.push(Geometry {
            positions,
            triangles,
            material: Some(right),
            ..Geometry::default()
        });
    }
    parts.parts.push(Part { geometry: 1, ..parts.parts[0].clone() });
    for (what, scene) in
        [("pictures", pictured), ("colours", coloured), ("materials", painted), ("parts", parts)]
    {
        let (coarse, faces_left) = simplified_to(&scene, 4);
        assert_eq!(faces_left, 4, "{what}");
        let mut whole = 0.0;
        for geometry in &coarse.geometries {
            for (k, face) in faces(geometry).enumerate() {
                whole += area_vector(face).z;
                let right = is_right(face);
                for (corner, p) in face.iter().enumerate() {
                    if !geometry.corner_uvs.is_empty() {
                        let [u, v] = geometry.uvs[geometry.corner_uvs[k][corner] as usize];
                        let expected = [p.x as f32 + if right { 5.0 } else { 0.0 }, p.y as f32];
                        assert_eq!([u, v], expected, "{what} at {p}");
                    }
                    if !geometry.colours.is_empty() {
                        let colour = geometry.colours[geometry.triangles[k][corner] as usize];
                        assert_eq!(colour[0] == 1.0, right, "{what} at {p}");
                    }
                }
                let material = geometry.material_of(k);
                assert!(material.is_none_or(|material| material == u32::from(right)), "{what}");
            }
        }
        assert!((whole - 2.0).abs() < 1e-12, "{what}: {whole}");
    }
}

#[test]
fn non_manifold_and_degenerate_meshes_are_simplified() {
    let flat = || grid(10, |x, y| DVec3::new(x, y, 0.0));
    // The same sheet twice, once with reversed winding.
    let mut turned = flat();
    turned.triangles.iter_mut().for_each(|corners| corners.swap(0, 1));
    let (coarse, faces_left) = simplified_to(&one_part_scene(merged_geometry(flat(), &turned)), 4);
    assert_eq!((faces_left, coarse.geometries[0].triangles.len()), (4, 4));
    // Three sheets with a common edge (non-manifold).
    let fins = merged_geometry(
        merged_geometry(flat(), &grid(10, |x, y| DVec3::new(-x, y, 0.0))),
        &grid(10, |x, y| DVec3::new(0.0, y, x)),
    );
    let (coarse, faces_left) = simplified_to(&one_part_scene(fins), 6);
    assert_eq!(faces_left, 6);
    let whole: f64 = faces(&coarse.geometries[0]).map(|face| area_vector(face).length()).sum();
    assert!((whole - 3.0).abs() < 1e-12, "{whole}");
    // Faces of zero area and faces with invalid indices.
    let mut broken = flat();
    broken.triangles.extend([[0, 0, 1], [3, 4, 3], [0, 1, 99_999]]);
    let detail = Detail::of(&one_part_scene(broken.clone()));
    assert!(detail.levels().seek(&one_part_scene(broken), 203).unwrap() <= 203);
    // Empty scene.
    assert_eq!(Detail::of(&Scene::default()).levels().deepest(), 0);
}

/// Squared distance from a point to a triangle.
fn distance_squared_to_triangle(p: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let normal = (b - a).cross(c - a);
    let inside = |p: DVec3, q: DVec3, at: DVec3| (q - p).cross(at - p).dot(normal) >= 0.0;
    if inside(a, b, p) && inside(b, c, p) && inside(c, a, p) && normal != DVec3::ZERO {
        return (p - a).dot(normal).powi(2) / normal.length_squared();
    }
    let from_side = |a: DVec3, b: DVec3| {
        let along = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        p.distance_squared(a.lerp(b, if along.is_finite() { along } else { 0.0 }))
    };
    from_side(a, b).min(from_side(b, c)).min(from_side(c, a))
}

#[test]
fn models_with_a_tenth_of_the_faces_stay_near_the_original() {
    // Largest root mean square distance relative to the size of the model: 1.5 times the measured value.
    for (name, bound) in [("horn.obj", 5.4e-3), ("knot.ply", 3e-3), ("teapot.obj", 4.3e-3)] {
        let scene = example(name);
        let (coarse, _) = simplified_to(&scene, scene.triangle_count() as u64 / 10);
        let (low, high) = scene.bounds().unwrap();
        let left: Vec<[DVec3; 3]> = coarse.geometries.iter().flat_map(faces).collect();
        let points: Vec<DVec3> = scene.geometries.iter().flat_map(faces).flatten().step_by(7).collect();
        let nearest = |p: &DVec3| {
            left.iter().map(|face| distance_squared_to_triangle(*p, *face)).fold(f64::INFINITY, f64::min)
        };
        let mean = points.iter().map(nearest).sum::<f64>() / points.len() as f64;
        let rms = mean.sqrt() / high.distance(low);
        println!("{name}: {rms:e}");
        assert!(rms < bound, "{name}: {rms:e}");
    }
}
