//! Times of comparing drawings of 50,000 segments each, as multiples of reading them.
//!
//! `cargo bench --bench diff`

use std::time::Instant;

use divan::Bencher;
use kurbo::{Point, Vec2};
use ligne::diff::{DiffOptions, Picture, compare};

fn main() {
    ratios();
    divan::main();
}

/// Shortest of several runs, ms.
fn best(mut act: impl FnMut()) -> f64 {
    let one = |act: &mut dyn FnMut()| {
        let began = Instant::now();
        act();
        began.elapsed().as_secs_f64() * 1e3
    };
    (0..TRIES).map(|_| one(&mut act)).fold(f64::INFINITY, f64::min)
}

const TRIES: usize = 3;

/// Prints each comparison as a multiple of reading both files.
fn ratios() {
    let coincident = |d: &str| {
        let paths = format!("<path d=\"{d}\"/>").repeat(30_000);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100\" height=\"100\"><g fill=\"none\" stroke=\"#000\">{paths}</g></svg>"
        )
    };
    let mut cases: Vec<(String, String, String)> = Vec::new();
    for cut in CUTS {
        let marks = cut.0;
        for (what, shift) in [("equal", 0.0), ("within tolerance", 0.01), ("all moved", 0.3)] {
            cases.push((format!("{marks} marks, {what}"), strokes(cut, 0.0), strokes(cut, shift) + "\n"));
        }
    }
    let (here, there) = (coincident("M10 10L60 40 90 20"), coincident("M10 12L60 42 90 22"));
    cases.push(("30,000 paths in one place, repainted".into(), here.clone(), here.replace("#000", "#c00")));
    cases.push(("30,000 paths in one place, moved".into(), here, there));
    println!("{:<40} {:>12} {:>12} {:>8}", "", "reading both", "comparing", "ratio");
    for (what, before, after) in cases {
        let read = |svg: &str| Picture::from_svg(svg).expect("a drawing");
        let reading = best(|| drop((read(&before), read(&after))));
        let (old, new) = (read(&before), read(&after));
        let comparing = best(|| drop(compare(&old, &new, &DiffOptions::default())));
        println!("{what:<40} {reading:>9.0} ms {comparing:>9.0} ms {:>8.2}", comparing / reading);
    }
}

/// Number of marks, and segments per mark; 50,000 segments in total.
const CUTS: [(usize, usize); 3] = [(500, 100), (10_000, 5), (50_000, 1)];

/// Curly strokes all over a page, shifted to the right.
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
