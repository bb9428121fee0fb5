//! Levels of detail do not depend on the direction of seeking or the number of threads.
//!
//! Also checks that instances share one face budget and that detail files are bound to their model.

use std::path::Path;

use glam::{DAffine3, DVec3};
use ligne::Scene;
use ligne::animation::{Playing, Rigged};
use ligne::edit::simplify::Detail;
use ligne::scene::{Geometry, Part};

use crate::library::support::long_run::is_long;
use crate::library::support::readers::shared_folder;
use crate::library::support::scenes::random_dice::Dice;

pub(crate) fn example(name: &str) -> Scene {
    Scene::open(Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models").join(name)).unwrap()
}

/// The scene simplified to at most `most` faces, and its number of faces.
pub(crate) fn simplified_to(scene: &Scene, most: u64) -> (Scene, u64) {
    let detail = Detail::of(scene);
    let mut levels = detail.levels();
    let faces = levels.seek(scene, most).unwrap();
    let coarse = levels.scene(scene).unwrap();
    assert_eq!(coarse.triangle_count() as u64, faces);
    (coarse, faces)
}

/// Scene with one part.
pub(crate) fn one_part_scene(geometry: Geometry) -> Scene {
    let part = Part { name: "model".to_owned(), geometry: 0, world_from_part: DAffine3::IDENTITY };
    Scene { geometries: vec![geometry], parts: vec![part], ..Scene::default() }
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
            direct.seek(&scene, *most).unwrap();
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
        levels.seek(&scene, u64::MAX).unwrap();
        assert!(all_bits(&levels.scene(&scene).unwrap()) == all_bits(&scene), "{name}");
        assert!(Detail::read(&detail.to_bytes(&scene), &scene).unwrap() == detail, "{name}");
    }
}
