//! Times of reading and flattening a million triangles.

use std::fmt::Write as _;

use divan::{Bencher, black_box};
use ligne::load::ModelFormat;
use ligne::scene::Scene;

/// Side of the wavy grid in quads: 708 x 708 quads are 1,002,528 triangles.
const SIDE: usize = 708;

fn main() {
    divan::main();
}

fn point(i: usize, j: usize) -> [f32; 3] {
    let wave = ((i * 37 + j * 91) % 257) as f32 / 257.0;
    [i as f32 * 0.013_7, j as f32 * 0.011_3 - 4.0, wave * 0.173]
}

fn points() -> impl Iterator<Item = [f32; 3]> {
    (0..=SIDE).flat_map(|j| (0..=SIDE).map(move |i| point(i, j)))
}

fn triangles() -> impl Iterator<Item = [usize; 3]> {
    (0..SIDE).flat_map(|j| (0..SIDE).map(move |i| j * (SIDE + 1) + i)).flat_map(|a| {
        let (b, c, d) = (a + 1, a + SIDE + 2, a + SIDE + 1);
        [[a, b, c], [a, c, d]]
    })
}

fn obj_text() -> Vec<u8> {
    let mut text = String::new();
    for [x, y, z] in points() {
        let _ = writeln!(text, "v {x:.6} {y:.6} {z:.6}");
    }
    for [a, b, c] in triangles() {
        let _ = writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1);
    }
    text.into_bytes()
}

fn ply_bytes() -> Vec<u8> {
    let (v, f) = ((SIDE + 1) * (SIDE + 1), 2 * SIDE * SIDE);
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {v}\nproperty float x\nproperty float y\n\
         property float z\nelement face {f}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    .into_bytes();
    bytes.extend(points().flatten().flat_map(f32::to_le_bytes));
    for triangle in triangles() {
        bytes.push(3);
        bytes.extend(triangle.iter().flat_map(|&i| (i as i32).to_le_bytes()));
    }
    bytes
}

fn stl_bytes() -> Vec<u8> {
    let mut bytes = vec![0; 80];
    bytes.extend((2 * SIDE as u32 * SIDE as u32).to_le_bytes());
    for triangle in triangles() {
        bytes.extend([0; 12]);
        for i in triangle {
            bytes.extend(point(i % (SIDE + 1), i / (SIDE + 1)).iter().flat_map(|v| v.to_le_bytes()));
        }
        bytes.extend([0; 2]);
    }
    bytes
}

fn bench(bencher: Bencher, bytes: Vec<u8>, read: impl Fn(&[u8]) -> Option<Scene> + Sync) {
    assert_eq!(read(&bytes).map(|scene| scene.triangle_count()), Some(2 * SIDE * SIDE));
    bencher.bench(|| read(black_box(&bytes)));
}

#[divan::bench]
fn obj_million(bencher: Bencher) {
    bench(bencher, obj_text(), |bytes| Scene::from_bytes(bytes, ModelFormat::Obj).ok());
}

#[divan::bench]
fn ply_million(bencher: Bencher) {
    bench(bencher, ply_bytes(), |bytes| Scene::from_bytes(bytes, ModelFormat::Ply).ok());
}

#[divan::bench]
fn stl_million(bencher: Bencher) {
    bench(bencher, stl_bytes(), |bytes| Scene::from_bytes(bytes, ModelFormat::Stl).ok());
}

#[divan::bench]
fn flatten_million(bencher: Bencher) {
    let Ok(scene) = Scene::from_bytes(&ply_bytes(), ModelFormat::Ply) else { return };
    bencher.bench(|| ligne::internals::soup(black_box(&scene)));
}

#[divan::bench]
fn bounds_million(bencher: Bencher) {
    let Ok(scene) = Scene::from_bytes(&ply_bytes(), ModelFormat::Ply) else { return };
    bencher.bench(|| black_box(&scene).bounds());
}
