//! Fuzzing of the STL reader: any bytes give an error, or finite positions with valid indices.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(scene) = ligne::load::stl::read_bytes(bytes, "stem") {
        let soup = scene.to_soup();
        let count = soup.positions.len() as u32;
        assert!(soup.triangles.as_flattened().iter().all(|&i| i < count));
        assert!(soup.positions.iter().all(|p| p.is_finite()));
    }
});
