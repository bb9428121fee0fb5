//! Model readers agree with independent readers (the crates `gltf` and `tobj`) on the shared models.
#![cfg(test)]

use std::path::{Path, PathBuf};

use glam::DVec3;
use ligne::scene::Scene;

/// The folder of shared models, if it exists.
fn models() -> Option<PathBuf> {
    let beside = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/models");
    let folder = std::env::var_os("LIGNE_MODELS").map_or_else(beside, PathBuf::from);
    if !folder.is_dir() {
        println!("skipped: no models in {}", folder.display());
        return None;
    }
    Some(folder)
}

/// All glTF and GLB files under a folder, except those in folders called `bad`.
fn gltf_files(folder: &Path) -> Vec<PathBuf> {
    let (mut folders, mut found) = (vec![folder.to_path_buf()], Vec::new());
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap().flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "glb" || ending == "gltf") {
                found.push(path);
            }
        }
    }
    found.retain(|path| !path.components().any(|folder| folder.as_os_str() == "bad"));
    found.sort();
    found
}

/// Number of triangles, counting every instance of a geometry.
fn triangles(scene: &Scene) -> usize {
    scene.parts.iter().map(|part| scene.geometries[part.geometry].triangles.len()).sum()
}

/// Sums of the world positions equal those of the `gltf` crate, for files that the crate reads.
#[test]
fn a_second_reader_agrees() {
    let Some(folder) = models() else { return };
    let mut compared = 0;
    for path in gltf_files(&folder) {
        let name = path.display().to_string();
        let Ok((document, buffers, _)) = gltf::import(&path) else { continue };
        let Some(scene) = document.default_scene().or(document.scenes().next()) else { continue };
        let morphs = || document.meshes().flat_map(|mesh| mesh.primitives()).any(|p| p.morph_targets().len() > 0);
        let posed = document.skins().len() > 0 || morphs() || name.contains("gpu-instancing");
        if posed || name.contains("deep-hierarchy") {
            continue;
        }
        let mut theirs = Vec::new();
        let mut waiting: Vec<_> = scene.nodes().map(|node| (node, glam::DMat4::IDENTITY)).collect();
        while let Some((node, above)) = waiting.pop() {
            let local = node.transform().matrix().map(|column| column.map(f64::from));
            let world = above * glam::DMat4::from_cols_array_2d(&local);
            for primitive in node.mesh().iter().flat_map(|mesh| mesh.primitives().collect::<Vec<_>>()) {
                let reader = primitive.reader(|buffer| Some(&buffers[buffer.index()]));
                if primitive.mode() != gltf::mesh::Mode::Triangles {
                    continue;
                }
                let positions: Vec<_> = reader.read_positions().unwrap().collect();
                let all = || Box::new(0..positions.len() as u32) as Box<dyn Iterator<Item = u32>>;
                let indices = reader.read_indices().map_or_else(all, |indices| Box::new(indices.into_u32()));
                theirs.extend(
                    indices
                        .map(|i| world.transform_point3(glam::Vec3::from(positions[i as usize]).as_dvec3())),
                );
            }
            waiting.extend(node.children().map(|child| (child, world)));
        }
        let ours = Scene::open(&path).unwrap();
        if theirs.len() != 3 * triangles(&ours) {
            assert!(name.contains("primitive-modes"), "{}", name);
            continue;
        }
        let sum = |points: &mut dyn Iterator<Item = DVec3>| {
            points.fold((DVec3::ZERO, DVec3::ZERO), |(a, b), p| (a + p, b + p.abs()))
        };
        let mine = ours.parts.iter().flat_map(|part| {
            let geometry = &ours.geometries[part.geometry];
            let corners = geometry.triangles.as_flattened().iter();
            corners.map(|corner| part.world_from_part.transform_point3(geometry.positions[*corner as usize]))
        });
        let (mine, theirs) = (sum(&mut mine.into_iter()), sum(&mut theirs.into_iter()));
        let tolerance = 1e-4 * mine.1.max_element();
        assert!((mine.0 - theirs.0).abs().max_element() < tolerance, "{}", name);
        assert!((mine.1 - theirs.1).abs().max_element() < tolerance, "{}", name);
        compared += 1;
    }
    assert!(compared >= 15, "only {compared} files were compared");
}

/// Triangle positions equal those of the `tobj` crate, for OBJ files that contain triangles only.
#[test]
fn another_reader_sees_the_same() {
    let Some(folder) = models() else { return };
    for file in
        ["organic/cow.obj", "organic/stanford-bunny.obj", "mechanical/fandisk.obj", "organic/spot.obj"]
    {
        let path = folder.join(file);
        let (others, _) = tobj::load_obj(&path, &tobj::LoadOptions::default()).unwrap();
        let scene = Scene::open(&path).unwrap();
        let soup = scene.to_soup();
        let ours: Vec<_> =
            soup.triangles.as_flattened().iter().map(|&i| soup.positions[i as usize].as_vec3()).collect();
        let theirs: Vec<_> = others
            .iter()
            .flat_map(|model| {
                model.mesh.indices.iter().map(|&i| &model.mesh.positions[3 * i as usize..][..3])
            })
            .map(glam::Vec3::from_slice)
            .collect();
        assert!(ours == theirs, "{file}");
    }
}
