//! glTF reader on the shared models: triangle counts and bounds against a facts table, refusals, warnings and
//! random mutations.

use std::collections::BTreeMap;
use std::path::Path;

use glam::DVec3;
use ligne::load::gltf;
use ligne::scene::Scene;

use crate::library::support::readers::glb_writer::glb;
use crate::library::support::readers::shared_folder;

/// Rows of facts.tsv for glTF files, by column name.
fn facts(folder: &Path) -> Vec<BTreeMap<String, String>> {
    let text = std::fs::read_to_string(folder.join("facts.tsv")).unwrap();
    let mut lines = text.lines().map(|line| line.split('\t').map(str::to_owned).collect::<Vec<_>>());
    let head = lines.next().unwrap();
    let rows = lines.map(|row| head.iter().cloned().zip(row).collect::<BTreeMap<_, _>>());
    rows.filter(|row| row["file"].ends_with(".gltf") || row["file"].ends_with(".glb")).collect()
}

fn triangles(scene: &Scene) -> usize {
    scene.parts.iter().map(|part| scene.geometries[part.geometry].triangles.len()).sum()
}

fn bounds(scene: &Scene) -> (DVec3, DVec3) {
    let mut bounds = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for part in &scene.parts {
        let geometry = &scene.geometries[part.geometry];
        for corner in geometry.triangles.as_flattened() {
            let point = part.world_from_part.transform_point3(geometry.positions[*corner as usize]);
            assert!(point.is_finite());
            bounds = (bounds.0.min(point), bounds.1.max(point));
        }
    }
    bounds
}

/// Asserts that array lengths match, indices are in range, and numbers are finite.
fn assert_sound(scene: &Scene) {
    for geometry in &scene.geometries {
        let count = geometry.triangles.len();
        for length in [
            geometry.triangle_material.len(),
            geometry.corner_normals.len(),
            geometry.corner_uvs.len(),
            geometry.edge_marks.len(),
        ] {
            assert!(length == 0 || length == count, "{length} of {count}");
        }
        assert!(geometry.colours.is_empty() || geometry.colours.len() == geometry.positions.len());
        let below = |indices: &[[u32; 3]], end: usize, none: bool| {
            indices.as_flattened().iter().all(|i| (*i as usize) < end || (none && *i == u32::MAX))
        };
        assert!(below(&geometry.triangles, geometry.positions.len(), false));
        assert!(below(&geometry.corner_normals, geometry.normals.len(), true));
        assert!(below(&geometry.corner_uvs, geometry.uvs.len(), true));
        assert!(geometry.wires.as_flattened().iter().all(|i| (*i as usize) < geometry.positions.len()));
        assert!(geometry.positions.iter().all(|position| position.is_finite()));
        let materials = geometry.triangle_material.iter().chain(&geometry.material);
        assert!(materials.into_iter().all(|material| (*material as usize) < scene.materials.len()));
    }
    assert!(scene.parts.iter().all(|part| part.geometry < scene.geometries.len()));
    assert!(scene.parts.iter().all(|part| part.world_from_part.is_finite()));
}

/// Bounds of files for which the table ignores sparse values, morph targets, skins and instances. They were
/// computed without this reader, or read from a picture.
const POSED_BOUNDS: [(&str, [f64; 3], [f64; 3]); 5] = [
    ("edge/gpu-instancing.glb", [-1.029_64, 0.0, -1.030_65], [18.885_52, 2.48, 18.916_07]),
    ("edge/morph-sphere.glb", [-1.104_34, -1.143_84, -1.104_4], [4.0, 1.0, 1.104_4]),
    ("edge/skinned-tube.glb", [0.083_004, -0.058_413, -0.15], [1.138_159, 1.900_535, 0.15]),
    ("edge/sparse-accessors.gltf", [-2.0, -0.6, -2.0], [2.0, 0.64, 2.0]),
    ("features/SimpleSparseAccessor/SimpleSparseAccessor.gltf", [0.0; 3], [6.0, 4.0, 0.0]),
];

#[test]
fn shared_models_have_the_expected_triangles_and_bounds() {
    let Some(folder) = shared_folder::folder() else { return };
    let mut wrong = Vec::new();
    for row in facts(&folder) {
        let file = &row["file"];
        let scene = match gltf::read(&folder.join(file)) {
            Ok(scene) => scene,
            Err(error) => {
                wrong.push(error.to_string());
                continue;
            }
        };
        assert_sound(&scene);
        let (found, wanted) = (triangles(&scene), row["triangles_drawn"].parse::<usize>().unwrap());
        if found != wanted {
            wrong.push(format!("{file}: {found} triangles, not {wanted}"));
        }
        let corner = |key: &str| {
            let values: Vec<f64> = row[key].split_whitespace().filter_map(|v| v.parse().ok()).collect();
            <[f64; 3]>::try_from(values).ok().map(DVec3::from_array)
        };
        let posed = POSED_BOUNDS.iter().find(|(name, _, _)| name == file);
        let posed = posed.map(|(_, low, high)| (DVec3::from_array(*low), DVec3::from_array(*high)));
        let Some((low, high)) = posed.or(corner("min").zip(corner("max"))) else { continue };
        let (found_low, found_high) = bounds(&scene);
        // The table has five digits. Quantized files are rounded to a few thousandths.
        let tolerance = 1e-4 * (high - low).max_element().max(low.abs().max_element());
        if (found_low - low).abs().max_element() > tolerance
            || (found_high - high).abs().max_element() > tolerance
        {
            wrong.push(format!("{file}: {found_low} to {found_high}, not {low} to {high}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn cad_models_have_the_expected_parts() {
    let Some(folder) = shared_folder::folder() else { return };
    for (file, parts, geometries, count) in [
        ("bracket", 1, 1, 23_276),
        ("drive", 23, 13, 40_854),
        ("conveyor", 300, 15, 279_768),
        ("knot_100k", 1, 1, 100_000),
    ] {
        let scene = gltf::read(&folder.join(format!("cad/{file}.glb"))).unwrap();
        assert_sound(&scene);
        assert_eq!(
            (scene.parts.len(), scene.geometries.len(), triangles(&scene)),
            (parts, geometries, count),
            "{file}"
        );
    }
}

#[test]
fn broken_files_are_refused_by_name_or_drawn_with_a_warning() {
    let Some(folder) = shared_folder::folder() else { return };
    let refused = [
        ("empty.glb", "nothing to draw"),
        ("empty.gltf", "nothing to draw"),
        ("empty-scene.gltf", "nothing to draw"),
        ("index-out-of-range.gltf", "mesh 0 primitive 0: accessor 2: index"),
        ("mesh-index-out-of-range.gltf", "node 0: has mesh 5"),
        ("not-json.gltf", "JSON line 2"),
        ("wrong-types.gltf", "JSON line 1"),
        ("html-instead.glb", "web page"),
        ("git-lfs-pointer.glb", "Git LFS"),
        ("truncated-half.glb", "GLB header: the header promises 1676 bytes"),
        ("truncated-header.glb", "GLB header"),
        ("wrong-total-length.glb", "promises 6704 bytes"),
        ("json-chunk-too-long.glb", "chunk 0"),
        ("bin-chunk-missing.glb", "buffer 0: has no `uri`"),
        ("version-1.glb", "GLB version 1"),
        ("asset-version-3.gltf", "glTF version 3.0"),
        ("bad-base64.gltf", "buffer 0: the data URI is not valid base64"),
        ("missing-bin.gltf", "buffer 0: `missing.bin` cannot be read"),
        ("accessor-beyond-buffer.gltf", "accessor 0: 100000 elements"),
        ("accessor-count-huge.gltf", "accessor 2: 4294967295 elements"),
        ("bufferview-beyond-buffer.gltf", "1000000000 bytes"),
        ("float-indices.gltf", "accessor 2: indices must be whole numbers"),
        ("no-position.gltf", "mesh 0 primitive 0: it has no POSITION"),
        ("cyclic-nodes.gltf", "cycle"),
        ("unknown-required-extension.gltf", "EXAMPLE_not_real"),
    ];
    for (file, words) in refused {
        let error = Scene::open(folder.join("bad").join(file)).map(|_| ()).expect_err(file).to_string();
        assert!(error.contains(words) && error.contains(file), "{file}: {error}");
    }
    let drawn = [
        ("nan-positions.gltf", Some("triangles left out, with a corner that is not a number")),
        ("indices-not-multiple-of-three.gltf", Some("left over")),
        ("missing-texture.gltf", Some("missing-texture.png")),
        ("corrupt-texture.gltf", Some("damaged")),
        ("texture-path-escapes-folder.gltf", Some("leads out")),
        ("node-with-two-parents.gltf", Some("more than one parent")),
        ("zero-quaternion.gltf", Some("quaternion")),
        ("no-scenes.gltf", None),
        ("huge-scale.gltf", None),
        ("ok-cube.glb", None),
    ];
    for (file, warning) in drawn {
        let scene = gltf::read(&folder.join("bad").join(file)).expect(file);
        assert_sound(&scene);
        let lines = scene.warnings.lines().join("\n");
        assert!(warning.map_or(lines.is_empty(), |words| lines.contains(words)), "{file}: {lines}");
        assert!(triangles(&scene) >= if file == "nan-positions.gltf" { 1 } else { 11 }, "{file}");
    }
}

#[test]
fn compressed_models_equal_their_uncompressed_versions() {
    let Some(folder) = shared_folder::folder() else { return };
    let read = |file: &str| gltf::read(&folder.join(file)).unwrap();
    let (plain, packed) = (read("features/Duck-quantized.glb"), read("features/Duck-meshopt.glb"));
    let size = bounds(&plain).1 - bounds(&plain).0;
    let points = |scene: &Scene| {
        let part = &scene.parts[0];
        let geometry = &scene.geometries[part.geometry];
        let corners = geometry.triangles.as_flattened().iter();
        let place =
            |corner: &u32| part.world_from_part.transform_point3(geometry.positions[*corner as usize]);
        let mut points: Vec<_> =
            corners.map(place).map(|p| (p / size.max_element() * 1024.0).round().to_array()).collect();
        points.sort_by(|a, b| a.partial_cmp(b).unwrap());
        points
    };
    let (plain, packed) = (points(&plain), points(&packed));
    assert_eq!(plain.len(), packed.len());
    let same = plain
        .iter()
        .zip(&packed)
        .filter(|(a, b)| (DVec3::from_array(**a) - DVec3::from_array(**b)).length() < 3.0);
    assert!(same.count() > plain.len() * 95 / 100);

    let drawn = read("features/Box_Draco.glb");
    let corners: Vec<DVec3> = drawn.geometries[0].positions.clone();
    assert!(corners.iter().all(|corner| (corner.abs() - 0.5).abs().max_element() < 1e-6));
    assert_eq!(drawn.geometries[0].corner_normals.len(), 12);
}

#[test]
fn cameras_and_lights_have_world_positions() {
    let Some(folder) = shared_folder::folder() else { return };
    let scene = gltf::read(&folder.join("edge/cameras-lights.gltf")).unwrap();
    let names: Vec<&str> = scene.cameras.iter().map(|camera| camera.name.as_str()).collect();
    assert_eq!(names, ["perspective", "orthographic", "endless, no aspect"]);
    let camera = &scene.cameras[0].camera;
    assert_eq!((camera.width, camera.height, camera.eye), (1500.0, 1000.0, DVec3::new(5.0, 3.0, 7.0)));
    let direction = (camera.target - camera.eye).normalize();
    assert!((direction - DVec3::new(-0.548_821, -0.329_293, -0.768_35)).length() < 1e-5);
    assert_eq!(scene.cameras[1].camera.projection, ligne::scene::Projection::Orthographic { height: 6.0 });
    assert_eq!(scene.cameras[2].camera.width, 1000.0);
    assert_eq!(
        scene.lights.iter().map(|light| light.name.as_str()).collect::<Vec<_>>(),
        ["sun", "bulb", "spot"]
    );
}

/// GLB with two triangles, a skin, a morph target, sparse values and a triangle strip.
fn small_glb() -> Vec<u8> {
    let mut bin: Vec<u8> = [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.5]
        .into_iter()
        .flat_map(f32::to_le_bytes)
        .collect();
    bin.extend([0_u16, 1, 2, 1, 3, 2].into_iter().flat_map(u16::to_le_bytes));
    bin.extend([0_u8, 1, 2, 3, 0, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0]);
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
        "nodes":[{{"mesh":0,"children":[1],"rotation":[0,0,0,1]}},{{"mesh":0,"skin":0,"weights":[0.5]}}],
        "skins":[{{"joints":[0,1,0,1]}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"JOINTS_0":3,"WEIGHTS_0":4}},"indices":1,
            "targets":[{{"POSITION":2}}]}},{{"mode":5,"attributes":{{"POSITION":0,"JOINTS_0":3,"WEIGHTS_0":4}}}}]}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}},
            {{"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}},
            {{"componentType":5126,"count":4,"type":"VEC3","sparse":{{"count":2,
                "indices":{{"bufferView":2,"componentType":5121}},"values":{{"bufferView":0}}}}}},
            {{"componentType":5121,"count":4,"type":"VEC4"}},
            {{"bufferView":2,"byteOffset":8,"componentType":5121,"normalized":true,"count":4,"type":"VEC4"}}],
        "bufferViews":[{{"buffer":0,"byteLength":48,"byteStride":12}},{{"buffer":0,"byteOffset":48,"byteLength":12}},
            {{"buffer":0,"byteOffset":60,"byteLength":24}}],
        "buffers":[{{"byteLength":{}}}]}}"#,
        bin.len()
    );
    glb(json, &bin)
}

#[test]
fn mutated_files_never_panic() {
    let fetch = |_: &str, _: usize| Err(std::io::ErrorKind::NotFound.into());
    let glb = small_glb();
    let scene = gltf::read_bytes(&glb, &fetch).unwrap();
    assert_sound(&scene);
    assert_eq!((scene.parts.len(), triangles(&scene)), (2, 8));
    for end in 0..glb.len() {
        assert!(gltf::read_bytes(&glb[..end], &fetch).is_err());
    }
    let mut seed = 0x2545_f491_4f6c_dd1d_u64;
    let mut drawn = 0;
    for round in 0..6000 {
        let mut mutated = glb.clone();
        for _ in 0..1 + round % 3 {
            seed ^= seed << 13;
            seed ^= seed >> 7;
            seed ^= seed << 17;
            let at = (seed >> 8) as usize % mutated.len();
            // Digits are replaced by digits, so the JSON often stays valid with another meaning.
            let digit = mutated[at].is_ascii_digit();
            mutated[at] = if digit { b'0' + (seed % 10) as u8 } else { mutated[at] ^ (1 << (seed % 8)) };
        }
        if let Ok(scene) = gltf::read_bytes(&mutated, &fetch) {
            assert_sound(&scene);
            drawn += 1;
        }
    }
    assert!(drawn > 100, "only {drawn} were drawn");
}

#[test]
fn mutated_draco_streams_never_panic() {
    let Some(folder) = shared_folder::folder() else { return };
    let fetch = |_: &str, _: usize| Err(std::io::ErrorKind::NotFound.into());
    let bytes = std::fs::read(folder.join("features/Box_Draco.glb")).unwrap();
    let stream = bytes.len() - 152;
    for at in stream..bytes.len() {
        for change in [1, 0x80, 0xff, 0x55] {
            let mut mutated = bytes.clone();
            mutated[at] ^= change;
            if let Ok(scene) = gltf::read_bytes(&mutated, &fetch) {
                assert_sound(&scene);
            }
        }
    }
}
