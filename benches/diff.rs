//! Comparing drawings of 50,000 segments each: reading them, setting aside what is equal, covering what is not, and pairing
//! what went elsewhere. The floor is reading one of them.
//!
//! `cargo bench --bench diff`

use divan::Bencher;
use kurbo::{Point, Vec2};
use ligne::diff::{DiffOptions, Picture, compare};

fn main() {
    divan::main();
}

/// How the same 50,000 segments are cut into marks.
const CUTS: [(usize, usize); 3] = [(500, 100), (10_000, 5), (50_000, 1)];

/// Curly strokes all over a page, moved to the right.
fn strokes((count, pieces): (usize, usize), shift: f64) -> String {
    let mut state = 7u64;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f64 / f64::from(1u32 << 24)
    };
    let mut svg = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"1000\" height=\"1000\"><g fill=\"none\" stroke=\"#000\">",
    );
    for index in 0..count {
        let mut at = Point::new(next() * 1000.0 + shift, next() * 1000.0);
        let mut angle = next() * std::f64::consts::TAU;
        svg += &format!("<path class=\"crease\" data-part=\"p{}\" d=\"M{:.2} {:.2}L", index % 50, at.x, at.y);
        for _ in 0..pieces {
            angle += (next() - 0.5) * 0.6;
            at += Vec2::from_angle(angle) * 3.0;
            svg += &format!("{:.2} {:.2} ", at.x, at.y);
        }
        svg += "\"/>";
    }
    svg + "</g></svg>"
}

#[divan::bench(args = CUTS, sample_count = 5)]
fn read_one(bencher: Bencher, cut: (usize, usize)) {
    let svg = strokes(cut, 0.0);
    bencher.bench(|| Picture::from_svg(&svg));
}

fn compared(bencher: Bencher, cut: (usize, usize), shift: f64) {
    let before = Picture::from_svg(&strokes(cut, 0.0)).expect("a drawing");
    let after = Picture::from_svg(&(strokes(cut, shift) + "\n")).expect("a drawing");
    bencher.bench(|| compare(&before, &after, &DiffOptions::default()));
}

#[divan::bench(args = CUTS, sample_count = 5)]
fn equal(bencher: Bencher, cut: (usize, usize)) {
    compared(bencher, cut, 0.0);
}

#[divan::bench(args = CUTS, sample_count = 5)]
fn within_tolerance(bencher: Bencher, cut: (usize, usize)) {
    compared(bencher, cut, 0.01);
}

#[divan::bench(args = CUTS, sample_count = 5)]
fn all_moved(bencher: Bencher, cut: (usize, usize)) {
    compared(bencher, cut, 0.3);
}
