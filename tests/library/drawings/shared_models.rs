//! Shared models: every valid file is drawn, and every broken file is refused or repaired as its README says.

use crate::library::support::long_run::is_long;
use crate::library::support::readers::shared_folder;
use std::path::{Path, PathBuf};

use ligne::drawing::Drawing;
use ligne::export::SvgOptions;
use ligne::pipeline::Renderer;
use ligne::scene::{Camera, Scene};
use ligne::style::Style;

/// Largest model of the short runs, in triangles.
const MAX_SHORT_RUN_TRIANGLES: usize = 60_000;

fn files_below(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).into_iter().flatten().flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

fn is_model(path: &Path) -> bool {
    path.extension().is_some_and(|e| ["obj", "gltf", "glb", "stl", "ply"].iter().any(|known| e == *known))
}

/// Drawing of a scene in ink, and the warnings of reading and drawing it.
fn draw(scene: &Scene) -> (Drawing, Vec<String>) {
    let camera = Camera::three_quarter().fit(scene);
    let style = Style::preset("ink").unwrap();
    let page = ligne::drawing::Page {
        width: camera.width,
        height: camera.height,
        unit: ligne::drawing::Unit::Px,
        background: None,
    };
    let (drawing, report) = Renderer::new(scene, &style).draw(&camera, page).unwrap();
    let mut warnings = scene.warnings.lines();
    warnings.extend(report.warnings);
    (drawing, warnings)
}

fn marks(drawing: &Drawing) -> usize {
    drawing.layers.iter().map(|layer| layer.marks.len()).sum()
}

/// Whether all numbers are finite and the SVG can be read back.
fn is_sound(drawing: &Drawing) -> bool {
    let finite = drawing.layers.iter().flat_map(|layer| &layer.marks).all(|mark| mark.path.is_finite());
    finite && usvg::Tree::from_str(&drawing.to_svg(&SvgOptions::default()), &usvg::Options::default()).is_ok()
}

#[test]
fn every_shared_model_is_drawn() {
    let Some(folder) = shared_folder::folder() else { return };
    let all = is_long();
    let bad = folder.join("bad");
    let mut faults = Vec::new();
    let mut drawn = 0;
    for path in files_below(&folder).iter().filter(|p| is_model(p) && !p.starts_with(&bad)) {
        // Large files take long to read in debug builds.
        if !all && std::fs::metadata(path).is_ok_and(|data| data.len() > 4_000_000) {
            continue;
        }
        let name = path.strip_prefix(&folder).unwrap().display().to_string();
        let scene = match Scene::open(path) {
            Ok(scene) => scene,
            // Point clouds and files with unreadable corners have nothing to draw, and the error says so.
            Err(error)
                if error.message.contains("nothing to draw")
                    && ["points-only", "all-in-brackets"].iter().any(|kind| name.contains(kind)) =>
            {
                continue;
            }
            // The error names the missing accessor.
            Err(error) if name.ends_with("plate-minus1.glb") && error.to_string().contains("accessor -1") => {
                continue;
            }
            Err(error) => {
                faults.push(format!("{name}: {error}"));
                continue;
            }
        };
        if !all && scene.triangle_count() > MAX_SHORT_RUN_TRIANGLES {
            continue;
        }
        let (drawing, warnings) = draw(&scene);
        if marks(&drawing) == 0 && warnings.is_empty() {
            faults.push(format!("{name}: an empty drawing without a warning"));
        }
        if !is_sound(&drawing) {
            faults.push(format!("{name}: the SVG is not sound"));
        }
        drawn += 1;
        println!("{name}: {} marks, {warnings:?}", marks(&drawing));
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(drawn > 40, "only {drawn} models drawn");
}

/// Expected result for a broken file, by the README of the models.
enum ExpectedResult {
    /// Error that contains one of these words, in upper or lower case.
    Error(&'static [&'static str]),
    /// Drawing with a warning that contains one of these words.
    Warning(&'static [&'static str]),
    /// Drawing.
    Picture,
    /// Error, or a drawing with finite numbers.
    Either,
}

fn expected_result(name: &str) -> ExpectedResult {
    use ExpectedResult::{Either, Error, Picture, Warning};
    match name {
        "ok-cube.glb" | "latin1-and-bom.obj" => Picture,
        "empty-scene.gltf" | "only-comments.obj" | "vertices-only.obj" => Error(&["nothing to draw"]),
        n if n.starts_with("empty.") => Error(&["nothing to draw"]),
        "index-out-of-range.obj" | "index-zero.obj" | "index-huge.obj" | "negative-index-too-far.obj" => {
            Error(&["line "])
        }
        "index-out-of-range.ply" | "index-out-of-range.gltf" | "mesh-index-out-of-range.gltf" => {
            Error(&["byte", "face", "accessor", "node", "mesh", "line"])
        }
        "nan-and-inf.obj" | "nan-positions.gltf" | "ascii-nan.stl" | "overflowing-numbers.obj" => Either,
        "one-long-line.obj" | "no-scenes.gltf" | "zero-quaternion.gltf" | "huge-scale.gltf" => Either,
        "node-with-two-parents.gltf" => Either,
        "indices-not-multiple-of-three.gltf" => Warning(&["three", "indices", "triangle"]),
        "missing-texture.gltf" | "corrupt-texture.gltf" | "texture-path-escapes-folder.gltf" => {
            Warning(&["texture", "image", "folder", "missing"])
        }
        "unknown-required-extension.gltf" => Error(&["extension"]),
        "git-lfs-pointer.glb" => Error(&["git-lfs"]),
        "html-instead.glb" => Error(&["web page", "html"]),
        "unknown-format.xyz" => Error(&[".obj"]),
        "missing-bin.gltf" => Error(&[".bin"]),
        _ => Error(&[""]),
    }
}

#[test]
fn broken_shared_files_are_refused_or_repaired() {
    let Some(folder) = shared_folder::folder() else { return };
    let mut faults = Vec::new();
    let broken: Vec<PathBuf> = files_below(&folder.join("bad"))
        .into_iter()
        .filter(|p| is_model(p) || p.extension().is_some_and(|e| e == "xyz"))
        .collect();
    assert!(broken.len() > 50);
    for path in broken {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let result = Scene::open(&path).map(|scene| draw(&scene));
        let holds = |text: &str, words: &[&str]| words.iter().any(|w| text.to_lowercase().contains(w));
        let fault = match (expected_result(&name), &result) {
            (ExpectedResult::Error(words), Err(error)) if !holds(&error.to_string(), words) => {
                Some(format!("none of {words:?} in '{error}'"))
            }
            (_, Err(error)) if !error.to_string().contains(&name) => {
                Some(format!("no file named in '{error}'"))
            }
            (ExpectedResult::Error(_) | ExpectedResult::Either, Err(_)) => None,
            (_, Err(error)) => Some(format!("refused: {error}")),
            (ExpectedResult::Error(_), Ok((drawing, warnings))) => {
                Some(format!("drawn with {} marks and {warnings:?}", marks(drawing)))
            }
            (_, Ok((drawing, _))) if !is_sound(drawing) => Some("the SVG is not sound".to_owned()),
            (ExpectedResult::Either, Ok(_)) => None,
            (_, Ok((drawing, _))) if marks(drawing) == 0 => Some("an empty drawing".to_owned()),
            (ExpectedResult::Warning(words), Ok((_, warnings))) if !holds(&warnings.join("; "), words) => {
                Some(format!("none of {words:?} in {warnings:?}"))
            }
            (_, Ok(_)) => None,
        };
        faults.extend(fault.map(|fault| format!("{name}: {fault}")));
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
