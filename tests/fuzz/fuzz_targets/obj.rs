//! Fuzzing of the OBJ reader: any bytes give an error, or finite positions with valid indices.
//! The same bytes are also the material library.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(scene) = ligne::load::obj::read_bytes(bytes, "stem", |_| Some(bytes.to_vec())) {
        let soup = scene.to_soup();
        let count = soup.positions.len() as u32;
        assert!(soup.triangles.as_flattened().iter().all(|&i| i < count));
        assert!(soup.positions.iter().all(|p| p.is_finite()));
    }
});
