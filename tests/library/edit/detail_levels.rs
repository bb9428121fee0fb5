//! Levels of detail: closed forms keep their shape, borders, creases and seams, and simplified models stay
//! near the original.
//!
//! Also checks that levels do not depend on the direction of seeking and that detail files are bound to their
//! model.

use std::path::Path;

use glam::{DAffine3, DVec3};
use ligne::Scene;
use ligne::animation::{Playing, Rigged};
use ligne::edit::simplify::Detail;
use ligne::scene::{Geometry, Material, Part};

use crate::support::long_run::is_long;
use crate::support::readers::shared_folder;
use crate::support::scenes::random_dice::Dice;

fn example(name: &str) -> Scene {
    Scene::open(Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models").join(name)).unwrap()
}

/// The scene simplified to at most `most` faces, and its number of faces.
fn simplified_to(scene: &Scene, most: u64) -> (Scene, u64) {
    let detail = Detail::of(scene);
    let mut levels = detail.levels();
    let faces = levels.seek(scene, most).unwrap();
    let coarse = levels.scene(scene).unwrap();
    assert_eq!(coarse.triangle_count() as u64, faces);
    (coarse, faces)
}

/// Scene with one part.
fn one_part_scene(geometry: Geometry) -> Scene {
    let part = Part { name: "model".to_owned(), geometry: 0, world_from_part: DAffine3::IDENTITY };
    Scene { geometries: vec![geometry], parts: vec![part], ..Scene::default() }
}

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

/// Text that is equal only for bitwise equal geometries.
fn bits(geometry: &Geometry) -> String {
    let places: Vec<[u64; 3]> = geometry.positions.iter().map(|p| p.to_array().map(f64::to_bits)).collect();
    format!("{places:?} {geometry:?}")
}

fn all_bits(scene: &Scene) -> Vec<String> {
    scene.geometries.iter().map(bits).collect()
}

#[test]
fn detail_levels_do_not_depend_on_seek_direction() {
    for name in ["horn.obj", "bear.ply", "castle.obj", "pump.glb", "picnic.obj", "shelf.ply", "street.glb"] {
        let scene = example(name);
        let full = scene.triangle_count() as u64;
        let detail = Detail::of(&scene);
        let mut levels = detail.levels();
        let stops: Vec<u64> = (0..=8).map(|k| full * (8 - k) / 8).collect();
        let down: Vec<_> = stops
            .iter()
            .map(|most| {
                (
                    levels.seek(&scene, *most).unwrap(),
                    levels.level(),
                    all_bits(&levels.scene(&scene).unwrap()),
                )
            })
            .collect();
        assert_eq!(levels.level(), levels.deepest(), "{name}: the last stop is at no faces");
        for (most, seen) in stops.iter().zip(&down).rev() {
            let faces = levels.seek(&scene, *most).unwrap();
            let now = (faces, levels.level(), all_bits(&levels.scene(&scene).unwrap()));
            assert!(now == *seen, "{name} at {most} faces");
            let mut direct = detail.levels();
            direct.go_to(seen.1);
            assert!(all_bits(&direct.scene(&scene).unwrap()) == seen.2, "{name} at {most} faces, at once");
        }
        assert_eq!(levels.level(), 0);
        assert!(all_bits(&levels.scene(&scene).unwrap()) == all_bits(&scene), "{name} in full");
        // A simplification that stops at a number of faces is a prefix of the full one.
        let begun = Detail::down_to(&scene, full / 3);
        let mut begun = begun.levels();
        assert_eq!(begun.seek(&scene, full / 3), levels.seek(&scene, full / 3), "{name}");
        assert!(
            all_bits(&begun.scene(&scene).unwrap()) == all_bits(&levels.scene(&scene).unwrap()),
            "{name}"
        );
    }
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

#[test]
fn instances_share_one_face_budget() {
    let ball = example("horn.obj").geometries.remove(0);
    let count = ball.triangles.len() as u64;
    let mut scene = one_part_scene(ball.clone());
    scene.geometries.push(ball);
    for k in 1..4 {
        let place = DAffine3::from_scale_rotation_translation(
            DVec3::splat(0.1),
            glam::DQuat::IDENTITY,
            DVec3::X * 9.0 * f64::from(k),
        );
        scene.parts.push(Part { name: format!("small {k}"), geometry: 1, world_from_part: place });
    }
    let (coarse, faces_left) = simplified_to(&scene, count);
    let left: Vec<u64> = coarse.geometries.iter().map(|geometry| geometry.triangles.len() as u64).collect();
    assert_eq!(faces_left, left[0] + 3 * left[1]);
    assert!(faces_left <= count && faces_left + 6 > count, "{faces_left}");
    assert!(left[0] > 4 * left[1], "small copies have fewer: {left:?}");
    // Removed parts do not use the budget.
    let detail = Detail::of(&scene);
    scene.parts.truncate(1);
    assert!(detail.levels().seek(&scene, count).unwrap() > count - 3);
}

#[test]
fn simplification_does_not_depend_on_thread_count() {
    for name in ["knot.ply", "castle.obj"] {
        let scene = example(name);
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| Detail::of(&scene))
        };
        assert!(with(1) == with(4), "{name}");
    }
}

#[test]
fn poses_share_the_detail_levels_of_the_rest_pose() {
    let crane =
        Rigged::open(Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models/crane.glb")).unwrap();
    let detail = Detail::of(&crane.scene);
    let mut levels = detail.levels();
    let faces = levels.seek(&crane.scene, 150).unwrap();
    let rest = levels.scene(&crane.scene).unwrap();
    let posed = crane.posed(&[Playing::all(0, 1.0)]).unwrap();
    assert_eq!(levels.seek(&posed, 150), Ok(faces));
    let moved = levels.scene(&posed).unwrap();
    assert!(rest.parts != moved.parts);
    assert_eq!(all_bits(&rest), all_bits(&moved));
    let other = example("horn.obj");
    assert!(levels.scene(&other).is_err() && levels.seek(&other, 9).is_err());
}

#[test]
fn detail_files_read_back_exactly_and_only_for_their_model() {
    for name in ["horn.obj", "castle.obj", "pump.glb", "picnic.obj", "shelf.ply"] {
        let scene = example(name);
        let detail = Detail::of(&scene);
        let bytes = detail.to_bytes(&scene);
        assert!(Detail::read(&bytes, &scene).unwrap() == detail, "{name}");
        let mut moved = scene.clone();
        moved.geometries[0].positions[0].x += 1e-3;
        let error = Detail::read(&bytes, &moved).unwrap_err();
        assert!(error.message.contains("another model"), "{error}");
    }
}

#[test]
fn damaged_detail_files_are_refused() {
    let scene = example("bear.ply");
    let detail = Detail::of(&scene);
    let bytes = detail.to_bytes(&scene);
    let refused = |bytes: &[u8]| match Detail::read(bytes, &scene) {
        Err(error) => assert!(!error.message.is_empty()),
        Ok(read) => assert!(read == detail, "damaged bytes lead elsewhere"),
    };
    (0..bytes.len()).for_each(|end| refused(&bytes[..end]));
    let mut dice = Dice::new(11);
    for _ in 0..if is_long() { 20_000 } else { 600 } {
        let mut broken = bytes.clone();
        for _ in 0..=dice.below(3) {
            let at = if dice.below(2) == 0 { dice.below(broken.len()) } else { dice.below(40) };
            broken[at] = dice.below(256) as u8;
        }
        if dice.below(4) == 0 {
            broken.truncate(dice.below(broken.len()));
        }
        refused(&broken);
    }
    let mut later = bytes.clone();
    later[9] = 2;
    let error = Detail::read(&later, &scene).unwrap_err();
    assert_eq!(error.kind, ligne::ErrorKind::Unsupported, "{error}");
    assert!(Detail::read(b"", &scene).is_err() && Detail::read(b"ligne-lod", &scene).is_err());
    let huge = [&bytes[..18], &[0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x7f]].concat();
    assert!(Detail::read(&huge, &scene).is_err());
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

#[test]
fn shared_models_are_restored_exactly_after_simplification() {
    for name in [
        "organic/stanford-bunny.obj",
        "mechanical/2CylinderEngine.glb",
        "mechanical/featuretype.stl",
        "scene/dutch-ship/dutch_ship_medium_1k.gltf",
        "edge/nonmanifold.obj",
        "edge/degenerate.obj",
        "edge/soup.stl",
        "edge/moebius.obj",
        "edge/many-instances.glb",
        "features/voxel-knight.glb",
    ] {
        let Some(path) = shared_folder::find(name) else { continue };
        let scene = Scene::open(&path).unwrap();
        let detail = Detail::of(&scene);
        let mut levels = detail.levels();
        let fewest = levels.seek(&scene, 0).unwrap();
        let coarse = levels.scene(&scene).unwrap();
        println!("{name}: {} to {fewest}", scene.triangle_count());
        for geometry in &coarse.geometries {
            let count = geometry.positions.len();
            assert!(
                geometry.triangles.as_flattened().iter().all(|corner| (*corner as usize) < count),
                "{name}"
            );
        }
        levels.go_to(0);
        assert!(all_bits(&levels.scene(&scene).unwrap()) == all_bits(&scene), "{name}");
        assert!(Detail::read(&detail.to_bytes(&scene), &scene).unwrap() == detail, "{name}");
    }
}
