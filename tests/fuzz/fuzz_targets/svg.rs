//! Fuzzing of `ligne::diff`: any readable drawing equals itself and can be compared with an empty page.
#![no_main]

use libfuzzer_sys::fuzz_target;
use ligne::diff::{DiffOptions, Picture, compare};

fuzz_target!(|bytes: &[u8]| {
    let text = String::from_utf8_lossy(bytes);
    if let Ok(picture) = Picture::from_svg(&text) {
        let empty = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100\" height=\"100\"/>";
        let empty = Picture::from_svg(empty).expect("an empty page is read");
        let _ = compare(&empty, &picture, &DiffOptions::default()).lines();
        assert!(compare(&picture, &picture, &DiffOptions::default()).is_same());
    }
});
