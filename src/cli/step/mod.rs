//! STEP models, read through an external converter.
//!
//! 1. The file is read and hashed. The hash, the tolerance and the converter form the key of the result.
//! 2. [`conversion_cache`] is searched for a GLB with this key. A damaged entry counts as missing.
//! 3. Otherwise [`converter`] lists the programs that can convert: the named one, or cascadio, occt-import-js
//!    and FreeCAD in this order. [`converter_process`] runs one with limits on time and memory.
//! 4. The GLB is read. GLB uses metres, and most converters turn the model to y up. The scene is converted
//!    back to the millimetres and the z-up axis of STEP.
//!
//! Models in other formats are passed to the library, which never runs a converter.

mod conversion_cache;
mod converter;
mod converter_process;

use std::fs;
use std::path::Path;

use glam::{DAffine3, DMat3, DVec3};

use self::conversion_cache::{ConversionCache, ConversionKey};
use self::converter::{ConversionResult, candidates};
use crate::animation::Rigged;
use crate::cli::options::step_args::StepArgs;
use crate::cli::output::file_stamp::stamp;
use crate::error::{Error, ErrorKind};
use crate::load::ModelFormat;
use crate::scene::{Scene, UpAxis};

/// File endings of STEP files.
pub(crate) const STEP_ENDINGS: [&str; 2] = ["step", "stp"];

/// First bytes of a STEP file.
const STEP_MAGIC: &[u8] = b"ISO-10303-21";

/// Version of the conversion, part of the cache key. Increase it if results change for other reasons than
/// their key.
const RESULT_VERSION: &[u8] = b"1";

/// Millimetres in a metre.
const MM_PER_M: f64 = 1000.0;

/// Whether a model is a STEP file, by its ending.
pub(crate) fn is_step(model: &Path) -> bool {
    model
        .extension()
        .is_some_and(|ending| STEP_ENDINGS.iter().any(|known| ending.eq_ignore_ascii_case(known)))
}

/// Reads a model of any format.
///
/// # Errors
/// As [`Scene::open`]; for STEP also if there is no converter, or if it fails.
pub(crate) fn open_scene(model: &Path, args: &StepArgs) -> Result<Scene, Error> {
    if is_step(model) { open(model, args) } else { Scene::open(model) }
}

/// Reads a model of any format with its animations. STEP has none.
///
/// # Errors
/// As [`open_scene`].
pub(crate) fn open_rigged(model: &Path, args: &StepArgs) -> Result<Rigged, Error> {
    if is_step(model) { open(model, args).map(Rigged::from) } else { Rigged::open(model) }
}

/// Reads a model that the library cannot read; none if the library can.
///
/// # Errors
/// As [`open_scene`].
pub(crate) fn open_other(model: &Path, args: &StepArgs) -> Result<Option<Scene>, Error> {
    is_step(model).then(|| open(model, args)).transpose()
}

fn open(model: &Path, args: &StepArgs) -> Result<Scene, Error> {
    converted(model, args).map_err(|error| error.or_in_file(model))
}

fn converted(model: &Path, args: &StepArgs) -> Result<Scene, Error> {
    let before = stamp(model);
    let bytes = fs::read(model).map_err(|error| Error::io("cannot be read", error))?;
    let start = bytes.trim_ascii_start();
    if !start.strip_prefix(b"\xef\xbb\xbf").unwrap_or(start).starts_with(STEP_MAGIC) {
        return Err(Error::new("this is not a STEP file: it does not begin with ISO-10303-21")
            .remedy("export it again as STEP (AP214 or AP242)"));
    }
    let cache = ConversionCache::open()?;
    let is_converter_chosen = args.converter().is_some();
    let candidates = candidates(args)?;
    let identity: Vec<u8> = if is_converter_chosen {
        candidates.iter().flat_map(|one| one.identity()).collect()
    } else {
        Vec::new()
    };
    let quality = format!("{} mm, {} rad", args.tolerance_mm(), args.angle());
    let key = ConversionKey::of(&[RESULT_VERSION, &bytes, quality.as_bytes(), &identity]);
    if let Some(scene) = cache.get(key).and_then(|(glb, up)| read(model, &glb, up).ok()) {
        return Ok(scene);
    }
    let mut missing = None;
    for candidate in candidates {
        let glb_path = cache.unfinished("glb");
        let outcome = candidate.convert(model, &glb_path, args).and_then(|made| match made {
            ConversionResult::NotInstalled(reason) => Ok(Err(reason)),
            ConversionResult::Done(up) => {
                let glb = fs::read(&glb_path)
                    .map_err(|error| Error::io("cannot read the converted model", error))?;
                Ok(Ok((glb, up)))
            }
        });
        // Files that cannot be removed are pruned later.
        let _ = fs::remove_file(&glb_path);
        match outcome? {
            Err(reason) => missing = missing.or(Some((candidate, reason))),
            Ok((glb, up)) => {
                let scene = read(model, &glb, up).map_err(|error| {
                    Error::new(format!("{} wrote a GLB that cannot be read: {error}", candidate.name()))
                        .remedy("try another --step-converter")
                })?;
                // If the file changed meanwhile, the hash does not match it.
                if stamp(model) == before {
                    cache.put(key, &glb, up);
                }
                return Ok(scene);
            }
        }
    }
    let error = match missing.filter(|_| is_converter_chosen) {
        Some((candidate, reason)) => Error::new(format!("{} is not installed: {reason}", candidate.name())),
        None => Error::new("STEP is read through a converter, and none was found"),
    };
    Err(error.of_kind(ErrorKind::Unsupported).remedy(converter::INSTALL_REMEDY))
}

/// Reads a converted model, and restores the millimetres and the z-up axis of STEP.
fn read(model: &Path, glb: &[u8], up: UpAxis) -> Result<Scene, Error> {
    let mut scene = Scene::from_bytes(glb, ModelFormat::Gltf)?;
    let turn = match up {
        UpAxis::Z => DMat3::IDENTITY,
        UpAxis::Y => DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y),
    };
    let to = DAffine3::from_mat3(turn * MM_PER_M);
    for part in &mut scene.parts {
        part.world_from_part = to * part.world_from_part;
    }
    scene.lights.clear();
    scene.cameras.clear();
    scene.up = UpAxis::Z;
    scene.format = "STEP";
    scene.file = Some(model.to_path_buf());
    Ok(scene)
}
