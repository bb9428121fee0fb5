//! Times of computing the collapse order of a surface, reading it from a file, and changing the level.

use divan::{Bencher, black_box};
use glam::DVec3;
use libm::{cos, sin};
use ligne::Scene;
use ligne::edit::simplify::Detail;

/// Squares along a side: 69,938 and 1,002,528 triangles.
const SIDES: [u32; 2] = [187, 708];

fn main() {
    divan::main();
}

/// Wavy ring, closed in both directions.
fn ring(side: u32) -> Scene {
    let turn = |k: u32| std::f64::consts::TAU * f64::from(k) / f64::from(side);
    let point = |i: u32, j: u32| {
        let (a, b) = (turn(i), turn(j));
        let thick = 1.0 + 0.1 * sin(7.0 * a) * sin(5.0 * b);
        let far = 3.0 + thick * cos(b);
        DVec3::new(far * cos(a), far * sin(a), thick * sin(b))
    };
    let number = |i: u32, j: u32| (j % side) * side + i % side;
    let squares = || (0..side).flat_map(|j| (0..side).map(move |i| (i, j)));
    let triangles = squares().flat_map(|(i, j)| {
        let [a, b, c, d] = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    Scene::from_triangles(squares().map(|(i, j)| point(i, j)), triangles).expect("a sound scene")
}

#[divan::bench(args = SIDES, sample_count = 5)]
fn to_a_tenth(bencher: Bencher, side: u32) {
    let scene = ring(side);
    bencher.bench_local(|| black_box(Detail::down_to(&scene, u64::from(side * side / 5))));
}

#[divan::bench(args = SIDES, sample_count = 5)]
fn all(bencher: Bencher, side: u32) {
    let scene = ring(side);
    bencher.bench_local(|| black_box(Detail::of(&scene)));
}

#[divan::bench(args = SIDES, sample_count = 5)]
fn from_a_file(bencher: Bencher, side: u32) {
    let scene = ring(side);
    let bytes = Detail::of(&scene).to_bytes(&scene);
    bencher.bench_local(|| black_box(Detail::read(&bytes, &scene)));
}

#[divan::bench(args = SIDES, sample_count = 20)]
fn down_and_up(bencher: Bencher, side: u32) {
    let scene = ring(side);
    let detail = Detail::of(&scene);
    let mut levels = detail.levels();
    bencher.bench_local(|| {
        black_box(levels.seek(&scene, 0).ok());
        black_box(levels.seek(&scene, u64::MAX).ok());
    });
}

#[divan::bench(args = SIDES, sample_count = 20)]
fn scene_of_a_tenth(bencher: Bencher, side: u32) {
    let scene = ring(side);
    let detail = Detail::of(&scene);
    let mut levels = detail.levels();
    let _ = levels.seek(&scene, u64::from(side * side / 5));
    bencher.bench_local(|| black_box(levels.scene(&scene)));
}
