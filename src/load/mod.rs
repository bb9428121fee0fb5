//! Opening models: a reader for each format, and what all readers share.
//!
//! ```
//! use ligne::Scene;
//! use ligne::load::ModelFormat;
//!
//! let scene = Scene::open("examples/models/pump.glb")?;
//! assert!(scene.parts.iter().any(|part| part.name == "base-plate"));
//! let bytes = std::fs::read("examples/models/bracket.stl").expect("a model of this project");
//! assert_eq!(Scene::from_bytes(&bytes, ModelFormat::Stl)?.format, "STL");
//! # Ok::<(), ligne::Error>(())
//! ```
//!
//! 1. The file ending chooses the format; files that are no model, such as web pages, are refused.
//! 2. The reader of the format makes a scene.
//! 3. The precision of the coordinates is measured, for the tolerances of the mesh.
//!
//! Readers: [`obj`], [`ply`], [`stl`], [`gltf`]. Shared: [`text_cursor`] numbers and words of a text;
//! [`polygons`] polygons into triangles; [`triangle_colours`]; [`coordinate_precision`]; [`tolerances`].

mod coordinate_precision;
pub(crate) mod gltf;
pub(crate) mod obj;
pub(crate) mod ply;
mod polygons;
pub(crate) mod stl;
mod text_cursor;
mod tolerances;
mod triangle_colours;

use std::fs;
use std::io::{ErrorKind, Read};
use std::path::Path;

use self::text_cursor::decode;
use crate::animation::Rigged;
use crate::error::{self, Error};
use crate::scene::Scene;

const SUPPORTED_FORMATS: &str = "ligne reads .obj, .gltf, .glb, .stl and .ply";

/// A format of model files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ModelFormat {
    /// Wavefront OBJ, text.
    Obj,
    /// glTF 2.0 as JSON or as one binary file (GLB), told apart by the first bytes.
    Gltf,
    /// STL, text or binary.
    Stl,
    /// PLY, text or binary.
    Ply,
}

impl ModelFormat {
    /// Format of a file ending (without the dot), in any letter case.
    #[must_use]
    pub fn of_ending(ending: &str) -> Option<Self> {
        match ending.to_ascii_lowercase().as_str() {
            "obj" => Some(Self::Obj),
            "gltf" | "glb" => Some(Self::Gltf),
            "stl" => Some(Self::Stl),
            "ply" => Some(Self::Ply),
            _ => None,
        }
    }
}

impl Scene {
    /// Reads a model file; the ending gives the format.
    ///
    /// # Errors
    /// Names the file, the place in it and the remedy if it cannot be read or is damaged. Also if its format
    /// is not one of OBJ, glTF, GLB, STL and PLY.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, Error> {
        open(path.as_ref())
    }

    /// Reads a model from memory, without other files.
    ///
    /// Material libraries and external textures are left out and listed in [`Scene::warnings`]. Buffers of
    /// glTF must be embedded, as in GLB.
    ///
    /// ```
    /// use ligne::Scene;
    /// use ligne::load::ModelFormat;
    ///
    /// let scene = Scene::from_bytes(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", ModelFormat::Obj)?;
    /// assert_eq!(scene.geometries[0].triangles, [[0, 1, 2]]);
    /// # Ok::<(), ligne::Error>(())
    /// ```
    ///
    /// # Errors
    /// Names the place in the bytes and the remedy if they are damaged, or if nothing can be drawn.
    pub fn from_bytes(bytes: &[u8], format: ModelFormat) -> Result<Self, Error> {
        Self::from_bytes_with(bytes, format, |_| None)
    }

    /// Reads a model from memory like [`Scene::from_bytes`]. `files` returns the content of other files that the
    /// model names: material libraries, buffers and pictures. Names are relative to the model, as written in it.
    ///
    /// ```
    /// use ligne::Scene;
    /// use ligne::load::ModelFormat;
    ///
    /// let obj = b"mtllib red.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    /// let files = |name: &str| (name == "red.mtl").then(|| b"newmtl red\nKd 1 0 0\n".to_vec());
    /// let scene = Scene::from_bytes_with(obj, ModelFormat::Obj, files)?;
    /// assert_eq!(scene.materials[0].colour.hex(), "#ff0000");
    /// # Ok::<(), ligne::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Scene::from_bytes`].
    pub fn from_bytes_with(
        bytes: &[u8],
        format: ModelFormat,
        files: impl Fn(&str) -> Option<Vec<u8>>,
    ) -> Result<Self, Error> {
        let mut scene = read_bytes(bytes, format, &files, gltf::read_bytes)?;
        add_pictures(&mut scene, &files);
        Ok(scene)
    }
}

impl Rigged {
    /// Reads a model file like [`Scene::open`], with its animations and rig, if its format has any.
    ///
    /// # Errors
    /// As [`Scene::open`].
    pub fn open(path: impl AsRef<Path>) -> Result<Self, Error> {
        open_with(path.as_ref(), gltf::read_rigged)
    }

    /// Reads a model from memory like [`Scene::from_bytes`], with its animations and rig.
    ///
    /// # Errors
    /// As [`Scene::from_bytes`].
    pub fn from_bytes(bytes: &[u8], format: ModelFormat) -> Result<Self, Error> {
        read_bytes(bytes, format, &|_| None, gltf::read_rigged_bytes)
    }
}

/// Reads a model with the reader for its ending.
fn open(path: &Path) -> Result<Scene, Error> {
    open_with(path, gltf::read)
}

/// Like [`open`], with a given reader for glTF; models of other formats have no animations.
fn open_with<T: From<Scene>>(
    path: &Path,
    read_gltf: impl FnOnce(&Path) -> Result<T, Error>,
) -> Result<T, Error> {
    let ending = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
    let scene = refuse_other_files(path).and_then(|()| match ModelFormat::of_ending(&ending) {
        Some(ModelFormat::Obj) => obj::read(path).map(T::from),
        Some(ModelFormat::Gltf) => read_gltf(path),
        Some(ModelFormat::Stl) => read_with(path, stl::read_bytes).map(T::from),
        Some(ModelFormat::Ply) => read_with(path, ply::read_bytes).map(T::from),
        None if ["step", "stp"].contains(&&*ending) => {
            Err(unknown("the library does not read STEP; the program `ligne` does, through a converter"))
        }
        None if ending.is_empty() => Err(unknown("the file name has no ending")),
        None => Err(unknown(format!("the format .{ending} is not known"))),
    });
    scene.map_err(|error| error.or_in_file(path))
}

/// Stores the pictures that materials name and that are not in the model.
fn add_pictures(scene: &mut Scene, files: &impl Fn(&str) -> Option<Vec<u8>>) {
    for material in &mut scene.materials {
        if let (Some(name), None) = (&material.texture, &material.picture) {
            material.picture = files(name).map(Into::into);
        }
    }
}

/// Reads a model from memory, with the other files that it names.
fn read_bytes<T: From<Scene>>(
    bytes: &[u8],
    format: ModelFormat,
    files: &dyn Fn(&str) -> Option<Vec<u8>>,
    read_gltf: impl FnOnce(&[u8], &dyn Fn(&str, usize) -> Result<Vec<u8>, std::io::Error>) -> Result<T, Error>,
) -> Result<T, Error> {
    const STEM: &str = "model";
    refuse_other_content(bytes)?;
    match format {
        ModelFormat::Obj => with_precision(obj::read_bytes(bytes, STEM, files)).map(T::from),
        ModelFormat::Gltf => {
            read_gltf(bytes, &|name, _| files(name).ok_or_else(|| ErrorKind::NotFound.into()))
        }
        ModelFormat::Stl => with_precision(stl::read_bytes(bytes, STEM)).map(T::from),
        ModelFormat::Ply => with_precision(ply::read_bytes(bytes, STEM)).map(T::from),
    }
}

fn unknown(message: impl Into<String>) -> Error {
    Error::new(message).of_kind(error::ErrorKind::Unsupported).remedy(SUPPORTED_FORMATS)
}

/// Reads a file and passes its bytes and the stem of its name to a reader.
pub(crate) fn read_with(
    path: &Path,
    reader: impl FnOnce(&[u8], &str) -> Result<Scene, Error>,
) -> Result<Scene, Error> {
    let bytes = fs::read(path).map_err(|e| cannot_be_read(e).in_file(path))?;
    let stem = path.file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default();
    let mut scene = with_precision(reader(&bytes, &stem)).map_err(|error| error.in_file(path))?;
    scene.file = Some(path.to_path_buf());
    Ok(scene)
}

/// Adds the precision of the coordinates to a scene.
fn with_precision(scene: Result<Scene, Error>) -> Result<Scene, Error> {
    scene.map(|mut scene| {
        coordinate_precision::measure(&mut scene);
        scene
    })
}

fn cannot_be_read(error: std::io::Error) -> Error {
    Error::io("cannot be read", error)
}

/// Returns an error if the beginning of a file shows that it is not a model.
fn refuse_other_files(path: &Path) -> Result<(), Error> {
    let mut head = Vec::new();
    let file = fs::File::open(path).map_err(cannot_be_read)?;
    file.take(256).read_to_end(&mut head).map_err(cannot_be_read)?;
    refuse_other_content(&head)
}

/// Returns an error for the usual results of a failed download.
fn refuse_other_content(bytes: &[u8]) -> Result<(), Error> {
    let start = bytes.trim_ascii_start();
    let start = start.strip_prefix(b"\xef\xbb\xbf").unwrap_or(start);
    let begins =
        |what: &str| start.get(..what.len()).is_some_and(|b| b.eq_ignore_ascii_case(what.as_bytes()));
    if bytes.is_empty() {
        return Err(Error::new("the file is empty; nothing to draw").of_kind(error::ErrorKind::Empty));
    }
    if begins("version https://git-lfs") {
        return Err(
            Error::new("this is a Git LFS pointer, not the model").remedy("fetch it with `git lfs pull`")
        );
    }
    if begins("<!doctype html") || begins("<html") {
        return Err(Error::new("this is a web page, not a model").remedy("download the file itself"));
    }
    Ok(())
}

/// The first 20 bytes of a word, escaped for error messages.
pub(crate) fn quoted_start(word: &[u8]) -> String {
    let start: Vec<u8> = word.iter().copied().take(20).collect();
    decode(&start).escape_debug().to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn from_bytes_reads_the_same_scene_as_open() {
        use ModelFormat::{Gltf, Obj, Ply, Stl};
        let names = [("gear.obj", Obj), ("bracket.stl", Stl), ("knot.ply", Ply), ("pump.glb", Gltf)];
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models");
        for (name, format) in names {
            let path = folder.join(name);
            let bytes = std::fs::read(&path).unwrap();
            let (read, opened) = (Scene::from_bytes(&bytes, format).unwrap(), Scene::open(&path).unwrap());
            assert_eq!(read.geometries[0].triangles, opened.geometries[0].triangles);
        }
        let error = Scene::from_bytes(b"", ModelFormat::Stl).unwrap_err();
        assert_eq!(error.kind, error::ErrorKind::Empty);
        let json = br#"{"asset":{"version":"2.0"},"buffers":[{"uri":"far.bin","byteLength":12}]}"#;
        let error = Scene::from_bytes(json, ModelFormat::Gltf).unwrap_err();
        assert!(error.to_string().contains("far.bin"), "{error}");
    }

    #[test]
    fn refuse_other_content_names_lfs_pointers_and_web_pages() {
        for (bytes, wanted) in [
            ("version https://git-lfs.github.com/spec/v1\noid", "git lfs pull"),
            ("\n <!DOCTYPE html><html>", "web page"),
            ("\u{feff}<HTML>", "web page"),
            ("", "nothing to draw"),
        ] {
            let error = refuse_other_content(bytes.as_bytes()).unwrap_err().to_string();
            assert!(error.contains(wanted), "{error}");
        }
        assert!(refuse_other_content(b"v 0 0 0").is_ok());
    }

    #[test]
    fn unknown_file_extensions_list_the_supported_formats() {
        for name in ["Cargo.toml", ".gitignore"] {
            let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(name);
            let error = open(&path).unwrap_err().to_string();
            assert!(error.contains(".obj, .gltf, .glb, .stl and .ply"), "{error}");
        }
        let error = open(Path::new("missing.OBJ")).unwrap_err().to_string();
        assert!(error.starts_with("missing.OBJ: cannot be read"), "{error}");
    }
}
