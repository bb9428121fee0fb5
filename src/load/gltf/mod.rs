//! Reads glTF 2.0 and GLB into a `Scene`, in the stored pose, and on request the rig that animates it.
//!
//! Source: Khronos Group, glTF 2.0 specification, and the extensions listed in [`required_extensions`].
//!
//! 1. [`storage`] splits the container and gives checked access to buffers and accessors; [`meshopt`]
//!    decompresses buffer views.
//! 2. [`json`] is the schema of the JSON.
//! 3. [`material_reader`] reads materials and textures; [`meshes`] reads primitives into geometries.
//! 4. [`nodes`] resolves the node hierarchy into parts, cameras and lights.
//! 5. [`animations`] reads the clips.
//!
//! Shared: [`uri`] data URIs and paths; [`missing_references`] counts references to things that the file
//! lacks.

mod animations;
mod json;
mod material_reader;
mod meshes;
mod meshopt;
mod missing_references;
mod nodes;
mod required_extensions;
mod storage;
mod uri;

use std::borrow::Cow;
use std::fs::{self, File};
use std::io::{self, Read as _};
use std::path::Path;

use self::json::Root;
use self::material_reader::ModelFiles;
use self::storage::buffers::{Buffers, Fetch};
use crate::animation::{Rig, Rigged};
use crate::error::Error;
use crate::scene::extent::precision_warning;
use crate::scene::model_folder::ModelFolder;
use crate::scene::{Scene, UpAxis, Warnings};

/// Reads a `.gltf` or `.glb` file, and buffers in its folder.
///
/// # Errors
/// Names the file, the place in it (chunk, accessor, mesh, node ...) and what is wrong.
pub(crate) fn read(path: &Path) -> Result<Scene, Error> {
    Ok(read_file(path, false)?.scene)
}

/// Reads a `.gltf` or `.glb` file like [`read`], with its animations and the rig that they move.
///
/// # Errors
/// As [`read`].
pub(crate) fn read_rigged(path: &Path) -> Result<Rigged, Error> {
    read_file(path, true)
}

fn read_file(path: &Path, rigged: bool) -> Result<Rigged, Error> {
    let bytes = fs::read(path).map_err(|error| Error::io("cannot be read", error).in_file(path))?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let fetch = |name: &str, most: usize| head_of(&folder.join(name), most);
    let all = ModelFolder::of(path);
    let files = ModelFiles { fetch: &fetch, all: Some(&all) };
    let mut read = read_all(&bytes, files, rigged).map_err(|error| error.in_file(path))?;
    read.scene.file = Some(path.to_path_buf());
    Ok(read)
}

/// Reads the bytes of a `.gltf` or `.glb` file.
///
/// `fetch` returns up to a number of bytes of a file, given its path relative to the model. The path never
/// leads out of the model's folder.
///
/// # Errors
/// As [`read`], without the name of the file.
pub(crate) fn read_bytes(bytes: &[u8], fetch: &Fetch) -> Result<Scene, Error> {
    Ok(read_all(bytes, ModelFiles { fetch, all: None }, false)?.scene)
}

/// Reads bytes like [`read_bytes`], with the animations and the rig that they move.
///
/// # Errors
/// As [`read_bytes`].
pub(crate) fn read_rigged_bytes(bytes: &[u8], fetch: &Fetch) -> Result<Rigged, Error> {
    read_all(bytes, ModelFiles { fetch, all: None }, true)
}

/// Reads the scene, and the rig if `rigged`.
fn read_all(bytes: &[u8], files: ModelFiles, rigged: bool) -> Result<Rigged, Error> {
    let mut warnings = Warnings::default();
    let container = storage::container::split(bytes, &mut warnings)?;
    let mut root = root(container.json, &mut warnings)?;
    nodes::product_names::name_after_products(&mut root);
    required_extensions::check(&root.extensions_required)?;
    let buffers = Buffers::gather(&root, container.bin, files.fetch)?;
    let mut nodes = nodes::hierarchy::Hierarchy::new(&root, &mut warnings)?;
    let clips = if rigged {
        animations::clip_reader::clips(&buffers, &nodes.rest, &mut warnings)
    } else {
        Vec::new()
    };
    nodes.add_animated_visibility(&root, &clips)?;
    let materials = material_reader::materials(&buffers, files, &mut warnings);
    let (cameras, of_cameras) = nodes::cameras_and_lights::cameras(&root, &nodes, &mut warnings);
    let (lights, of_lights) = nodes::cameras_and_lights::lights(&root, &nodes, &mut warnings);
    let (format, up) = ("glTF", UpAxis::Y);
    let mut scene = Scene { format, up, materials, cameras, lights, warnings, ..Scene::default() };
    let mut rig = Rig { clips, cameras: of_cameras, lights: of_lights, ..Rig::default() };
    nodes::part_assembly::add(&mut scene, &mut rig, &buffers, &nodes)?;
    if rig.clips.is_empty() {
        rig = Rig::default();
    } else {
        (rig.nodes, rig.order) = (nodes.rest, nodes.order);
        rig.materials = root.materials.iter().map(material_reader::factors).collect();
    }
    precision_warning::warn_of_coarse_steps(&mut scene);
    Ok(Rigged { scene, rig })
}

fn head_of(path: &Path, most: usize) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(path)?.take(most as u64).read_to_end(&mut bytes)?;
    Ok(bytes)
}

fn root(json: &[u8], warnings: &mut Warnings) -> Result<Root, Error> {
    let text = String::from_utf8_lossy(json);
    if let Cow::Owned(_) = text {
        warnings.note("the file is not UTF-8; some names are shown with replacement characters");
    }
    // GLB pads its JSON with spaces; some exporters pad with zeros.
    let root: Root = serde_json::from_str(text.trim_end_matches('\0')).map_err(|error| {
        let place = format!("JSON line {} column {}", error.line(), error.column());
        let read = Error::json("", &error).at(place);
        match error.is_data() {
            true => read,
            false => read.remedy("the file may be cut off or damaged; export it again"),
        }
    })?;
    let version = root.asset.min_version.as_ref().or(root.asset.version.as_ref());
    match version.map(|version| version.split('.').next().unwrap_or_default()) {
        Some("2") => Ok(root),
        Some(_) => {
            let version = version.map_or("", String::as_str);
            Err(Error::new(format!("glTF version {}; only 2.0 can be read", uri::shortened(version)))
                .at("asset")
                .remedy("export the model again as glTF 2.0"))
        }
        None => Err(Error::new("no `asset.version`: this is JSON, but not glTF 2.0").at("asset")),
    }
}
