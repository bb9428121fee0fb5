//! Fuzzing of the PLY reader: any bytes give an error, or finite positions with valid indices.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(scene) = ligne::Scene::from_bytes(bytes, ligne::load::ModelFormat::Ply) {
        for geometry in &scene.geometries {
            let count = geometry.positions.len() as u32;
            assert!(geometry.triangles.as_flattened().iter().all(|&i| i < count));
            assert!(geometry.positions.iter().all(|p| p.is_finite()));
        }
    }
});
