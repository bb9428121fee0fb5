//! [`Scene`]: what a model file holds, whatever its format.

pub mod camera;
pub mod camera_record;
pub mod coordinate;
pub mod flatten;
pub mod framing;
pub mod geometry;
pub mod gltf;
pub mod light;
pub mod material;
pub mod obj;
pub mod open;
pub mod paint;
pub mod ply;
pub mod polygon;
pub mod select;
pub mod stl;
mod swatches;
mod text;
mod texture;
pub mod views;
pub mod warnings;

use std::path::{Path, PathBuf};

pub use camera::{Camera, Projection};
pub use geometry::{Geometry, Part};
pub use light::{Light, LightKind};
pub use material::Material;
pub use paint::{Paint, Paints};
pub use views::NamedView;
pub use warnings::Warnings;

use crate::error::Error;

/// Which axis of the file points up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum UpAxis {
    /// y, as glTF demands.
    #[default]
    Y,
    /// z, as CAD programs have it.
    Z,
}

/// A camera of the model file, with its name.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedCamera {
    /// The name in the file; `camera 0` and so on where it has none.
    pub name: String,
    /// The camera, with a frame of 1000 x 1000 px or of the file's aspect ratio.
    pub camera: Camera,
}

/// What a model file holds: parts that instance geometries, materials, lights, cameras.
#[derive(Debug, Clone, Default)]
pub struct Scene {
    /// The file it was read from.
    pub file: Option<PathBuf>,
    /// `OBJ`, `glTF`, `STL`, `PLY`.
    pub format: &'static str,
    /// Which axis points up.
    pub up: UpAxis,
    /// Shapes, each stored once however often it is shown.
    pub geometries: Vec<Geometry>,
    /// What is shown: one entry an instance, in file order.
    pub parts: Vec<Part>,
    /// Materials that geometries point to by index; may be empty.
    pub materials: Vec<Material>,
    /// The file's lights, in world space.
    pub lights: Vec<Light>,
    /// The file's cameras, in world space.
    pub cameras: Vec<NamedCamera>,
    /// Names of the file's animations.
    pub animations: Vec<String>,
    /// What had to be dropped or mended while reading.
    pub warnings: Warnings,
}

impl Scene {
    /// Reads a model file; the format is told by its ending.
    ///
    /// # Errors
    /// Names the file, the place in it and the remedy if it cannot be read, if it is broken, or
    /// if its format is not one of OBJ, glTF, GLB, STL and PLY.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, Error> {
        open::open(path.as_ref())
    }
}
