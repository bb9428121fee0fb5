//! OBJ, STL and PLY readers: shared models against their facts table, broken files, and random mutations of
//! small files.

use std::fs;
use std::path::{Path, PathBuf};

use ligne::load::{obj, ply, stl};
use ligne::scene::Scene;

use crate::library::support::readers::shared_folder;

fn has_tested_format(path: &str) -> bool {
    [".obj", ".stl", ".ply"].iter().any(|ending| path.ends_with(ending))
}

/// Rows of facts.tsv, one per file, each as a lookup by column name.
fn facts(folder: &Path) -> Vec<impl Fn(&str) -> String> {
    let text = fs::read_to_string(folder.join("facts.tsv")).unwrap();
    let mut lines = text.lines().map(|line| line.split('\t').map(str::to_owned).collect::<Vec<_>>());
    let names = lines.next().unwrap();
    lines
        .map(|row| {
            let names = names.clone();
            move |name: &str| {
                let column = names.iter().position(|n| n == name).unwrap();
                row.get(column).cloned().unwrap_or_default()
            }
        })
        .collect()
}

#[test]
fn shared_models_match_the_facts_table() {
    let Some(folder) = shared_folder::folder() else { return };
    let mut seen = 0;
    for fact in facts(&folder) {
        let file = fact("file");
        if !has_tested_format(&file) || fact("triangles_drawn") == "0" {
            continue;
        }
        seen += 1;
        let scene = Scene::open(folder.join(&file)).unwrap_or_else(|e| panic!("{e}"));
        // The facts table counts the words of a comment as face corners.
        let wanted = if file == "edge/syntax-variety.obj" { "12".into() } else { fact("triangles_drawn") };
        assert_eq!(scene.triangle_count().to_string(), wanted, "{file}");
        let soup = scene.to_soup();
        assert_eq!(soup.triangles.len(), scene.triangle_count(), "{file}");
        for array in [&soup.corner_normals, &soup.corner_uvs] {
            assert!(array.is_empty() || array.len() == soup.triangles.len(), "{file}");
        }
        let Some((least, greatest)) = scene.bounds() else { panic!("{file} has no bounds") };
        let diagonal = (greatest - least).length();
        for (column, point) in [("min", least), ("max", greatest)] {
            // The facts table includes a face of zero area next to the cube, from 2 to 4. The reader drops
            // it.
            let is_beside = file == "edge/degenerate.obj" && column == "max";
            let fact = if is_beside { "1 1 1".to_owned() } else { fact(column) };
            let wanted: Vec<f64> = fact.split(' ').filter_map(|v| v.parse().ok()).collect();
            for (value, wanted) in point.to_array().iter().zip(wanted) {
                let slack = 1e-4 * wanted.abs() + 1e-4 * diagonal;
                assert!((value - wanted).abs() <= slack, "{file} {column}: {value} for {wanted}");
            }
        }
    }
    assert!(seen > 30, "only {seen} models");
}

#[test]
fn shared_models_have_the_expected_materials_and_parts() {
    let Some(folder) = shared_folder::folder() else { return };
    let open = |file: &str| Scene::open(folder.join(file)).unwrap_or_else(|e| panic!("{e}"));
    let variety = open("edge/syntax-variety.obj");
    assert_eq!(variety.parts[0].name, "first object");
    assert_eq!((variety.materials.len(), variety.geometries[0].wires.len()), (2, 2));
    assert!(variety.warnings.lines().iter().any(|line| line.contains("does-not-exist.mtl")));
    let materials = open("edge/multi-material.obj").materials;
    assert_eq!(materials.len(), 6);
    let of = |name: &str| materials.iter().find(|m| m.name == name).unwrap();
    assert_eq!((of("glass_d").colour.a, of("glass_tr").colour.a), (89, 89));
    assert_eq!(of("textured").texture.as_deref(), Some("checker board.png"));
    assert_eq!(of("emissive").emissive.hex(), "#ffcc33");
    assert_eq!(of("dark illum0").colour.hex(), "#0d0d14");
    assert_eq!(open("edge/ascii-two-solids.stl").parts.len(), 2);
    let ngons: Vec<_> = open("edge/concave-ngons.obj").parts.into_iter().map(|p| p.name).collect();
    assert_eq!(ngons[..3], ["star", "ell", "cee"]);
    assert!(open("edge/colours-ascii.ply").geometries[0].colours.len() == 1152);
}

#[test]
fn concave_polygons_keep_their_area() {
    let Some(folder) = shared_folder::folder() else { return };
    let scene = Scene::open(folder.join("edge/concave-ngons.obj")).unwrap();
    for (part, geometry) in scene.parts.iter().zip(&scene.geometries) {
        // All positions in order form the polygon, and the triangles must have its area.
        if part.name == "warped_quad" {
            continue;
        }
        let p = &geometry.positions;
        let ring: f64 = (0..p.len()).map(|i| p[i].cross(p[(i + 1) % p.len()]).z / 2.0).sum();
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|i| p[i as usize]);
            (b - a).cross(c - a).length() / 2.0
        };
        let sum: f64 = geometry.triangles.iter().map(area).sum();
        assert!((sum - ring).abs() < 1e-9, "{}: {sum} for {ring}", part.name);
    }
}

#[test]
fn broken_models_are_refused_or_repaired() {
    let Some(folder) = shared_folder::folder() else { return };
    let loads = ["latin1-and-bom.obj", "nan-and-inf.obj", "one-long-line.obj"];
    for entry in fs::read_dir(folder.join("bad")).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if !has_tested_format(&name) && name != "unknown-format.xyz" {
            continue;
        }
        match Scene::open(&path) {
            Ok(scene) => {
                assert!(loads.contains(&name.as_str()), "{name} loads");
                assert!(scene.bounds().is_some());
            }
            Err(error) => {
                assert!(!loads.contains(&name.as_str()), "{error}");
                assert_eq!(error.file.as_deref(), Some(path.as_path()));
                if ["empty", "only", "vertices"].iter().any(|start| name.starts_with(start)) {
                    assert!(error.message.contains("nothing to draw"), "{error}");
                }
                if name.starts_with("index") || name.starts_with("negative") {
                    assert!(error.place.as_deref().is_some_and(|p| p.contains("line")), "{error}");
                }
            }
        }
    }
    let error = Scene::open(folder.join("edge/points-only.ply")).unwrap_err();
    assert!(error.message.contains("only points; nothing to draw"), "{error}");
}

/// Runs every reader on the bytes and asserts that each scene is valid and no larger than the bytes allow.
fn read_with_all_readers(bytes: &[u8]) {
    let library = |_: &str| Some(bytes.to_vec());
    for scene in [
        obj::read_bytes(bytes, "stem", library),
        stl::read_bytes(bytes, "stem"),
        ply::read_bytes(bytes, "stem"),
    ]
    .into_iter()
    .flatten()
    {
        let soup = scene.to_soup();
        let count = soup.positions.len() as u32;
        assert!(soup.triangles.as_flattened().iter().all(|&i| i < count));
        assert!(soup.wires.iter().all(|w| w.vertices.iter().all(|&i| i < count)));
        assert!(soup.positions.iter().all(|p| p.is_finite()));
        assert!(soup.triangles.len() <= bytes.len() && soup.positions.len() <= 3 * bytes.len());
        assert!(scene.bounds().is_some());
    }
}

fn corpus() -> Vec<(PathBuf, Vec<u8>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus");
    let mut paths: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths.into_iter().filter(|p| p.is_file()).map(|p| (p.clone(), fs::read(p).unwrap())).collect()
}

/// Files named `ok-…` load and the others are refused. No reader panics on any of them.
#[test]
fn corpus_files_load_or_are_refused_by_name() {
    let mut seen = 0;
    for (path, bytes) in corpus() {
        read_with_all_readers(&bytes);
        let name = path.file_name().unwrap().to_string_lossy();
        if has_tested_format(&name) {
            let result = Scene::open(&path);
            assert_eq!(result.is_ok(), name.starts_with("ok-"), "{name}: {:?}", result.err());
            seen += 1;
        }
    }
    assert!(seen >= 20, "only {seen} files");
}

#[test]
fn mutated_files_never_panic() {
    let mut state = 0x2545_f491_4f6c_dd1d_u64;
    let mut random = move |below: usize| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 20) as usize % below.max(1)
    };
    let telling = b"0123456789-+.e/#\\ \n\r\tvflnogpst\0\xff";
    for (_, seed) in corpus().into_iter().filter(|(_, bytes)| bytes.len() < 2000) {
        for _ in 0..150 {
            let mut bytes = seed.clone();
            for _ in 0..=random(4) {
                let at = random(bytes.len());
                match random(6) {
                    0 => bytes.truncate(at),
                    1 => bytes.insert(at.min(bytes.len()), telling[random(telling.len())]),
                    2 if !bytes.is_empty() => bytes[at] = telling[random(telling.len())],
                    3 if !bytes.is_empty() => bytes[at] ^= 1 << random(8),
                    4 if !bytes.is_empty() => drop(bytes.remove(at)),
                    5 => {
                        let end = (at + random(40)).min(bytes.len());
                        let piece = bytes[at.min(end)..end].to_vec();
                        bytes.extend(piece);
                    }
                    _ => {}
                }
            }
            read_with_all_readers(&bytes);
        }
    }
}
