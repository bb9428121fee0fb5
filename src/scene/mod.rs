//! [`Scene`]: everything that a model file contains, independent of its format.
//!
//! ```
//! use ligne::scene::{NamedView, UpAxis};
//! use ligne::{Camera, Scene};
//!
//! let mut scene = Scene::open("examples/models/bracket.stl")?;
//! scene.up = UpAxis::Z;
//! let camera = Camera::named(NamedView::Iso, scene.up).with_frame(800.0, 600.0).fit(&scene);
//! assert_eq!(camera.validate(), Ok(()));
//! # Ok::<(), ligne::Error>(())
//! ```
//!
//! 1. A reader in `load` fills the scene: geometries, parts that instance them, materials, lights
//!    and cameras.
//! 2. A camera is chosen and framed.
//! 3. Cut-outs remove triangles that are transparent; paints give each triangle its colour.
//! 4. All instances become one triangle soup in world space. The mesh is built from it.
//!
//! Files, in reading order: [`parts`] geometries and parts; [`material`]; [`light`]; [`cameras`]; [`extent`]
//! which points count and how precise they are; [`part_selection`] parts by name; [`scene_builder`] scenes made by a program; [`glass`] see-through
//! materials; [`textures`]; [`paints`]; [`triangle_soup`]; [`motion_trails`]; [`model_folder`] files next to
//! the model; [`warnings`]; [`tolerances`].

pub(crate) mod cameras;
pub(crate) mod extent;
pub(crate) mod glass;
pub(crate) mod light;
pub(crate) mod material;
pub(crate) mod model_folder;
pub(crate) mod motion_trails;
pub(crate) mod paints;
pub(crate) mod part_selection;
pub(crate) mod parts;
mod scene_builder;
pub(crate) mod textures;
mod tolerances;
pub(crate) mod triangle_soup;
pub(crate) mod warnings;

use std::path::PathBuf;

use glam::{DAffine3, DVec3};

pub use crate::mesh::EdgeMark;
pub use cameras::camera::{Camera, Projection};
pub use cameras::named_views::NamedView;
pub(crate) use glass::{GlassDraw, GlassOptions};
pub use light::{Light, LightKind};
pub use material::{Alpha, Filter, Gloss, Material, Placing, Wrap};
pub(crate) use motion_trails::{Mover, Trail};
pub(crate) use paints::artist_textures::ArtistTextures;
pub(crate) use paints::triangle_paints::{MaterialPaint, Paints};
pub use parts::{Geometry, Part};
pub(crate) use textures::texture_options::{TextureFill, TextureOptions};
pub use warnings::{Warning, WarningKind, Warnings};

use crate::error::{Error, ErrorKind};

/// Axis of the file that points up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum UpAxis {
    /// y, as glTF specifies.
    #[default]
    Y,
    /// z, as is usual in CAD.
    Z,
}

/// A camera of the model file, with its name.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedCamera {
    /// Name in the file, or `camera 0` and so on.
    pub name: String,
    /// The camera, with a frame of 1000 x 1000 px or the aspect ratio of the file.
    pub camera: Camera,
}

/// Content of a model file: parts that instance geometries, materials, lights, cameras.
#[derive(Debug, Clone, Default)]
pub struct Scene {
    /// File that it was read from.
    pub file: Option<PathBuf>,
    /// Format: `OBJ`, `glTF`, `STL` or `PLY`.
    pub format: &'static str,
    /// Axis that points up.
    pub up: UpAxis,
    /// Geometries, each stored once regardless of its number of instances.
    pub geometries: Vec<Geometry>,
    /// Instances of geometries, in file order.
    pub parts: Vec<Part>,
    /// Materials, indexed by geometries; may be empty.
    pub materials: Vec<Material>,
    /// Lights of the file, in world space.
    pub lights: Vec<Light>,
    /// Cameras of the file, in world space.
    pub cameras: Vec<NamedCamera>,
    /// Number of vertices that no face or line uses and that no geometry contains.
    pub unused_vertices: u64,
    /// Moving bodies at this moment that may leave motion lines; `None` if motion was not requested (see
    /// [`crate::motion`]).
    pub(crate) movers: Option<Vec<Mover>>,
    /// Things that were dropped or repaired while reading.
    pub warnings: Warnings,
}

impl Scene {
    /// Makes a scene of one part from positions and triangles, for models that a program generates.
    ///
    /// Triangles are indices of positions, counter-clockwise from outside. The y axis points up; set
    /// [`Scene::up`] for another axis.
    ///
    /// ```
    /// use ligne::{Camera, Scene, Style, render};
    ///
    /// let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    /// let scene = Scene::from_triangles(corners, [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])?;
    /// let drawing = render(&scene, &Camera::three_quarter().fit(&scene), &Style::default())?;
    /// assert!(drawing.to_svg(&Default::default()).contains("contour"));
    /// # Ok::<(), ligne::Error>(())
    /// ```
    ///
    /// # Errors
    /// Names the first triangle with an index out of range, or the first position that is not finite. Also
    /// fails if there is nothing to draw.
    pub fn from_triangles(
        positions: impl IntoIterator<Item = impl Into<DVec3>>,
        triangles: impl IntoIterator<Item = [u32; 3]>,
    ) -> Result<Self, Error> {
        let mut scene = Self::default();
        let geometry = scene.add_geometry(Geometry::from_triangles(positions, triangles, None)?);
        scene.add_part("model", geometry, DAffine3::IDENTITY);
        drawable(scene)
    }
}

/// Returns the scene, unless it has nothing to draw.
///
/// # Errors
/// If it has neither triangles nor wires.
pub(crate) fn drawable(scene: Scene) -> Result<Scene, Error> {
    if scene.geometries.iter().any(|g| !g.triangles.is_empty() || !g.wires.is_empty()) {
        return Ok(scene);
    }
    let points = scene.geometries.iter().any(|g| !g.positions.is_empty());
    Err(nothing_to_draw(&scene.warnings, points))
}

/// Error for a file without a drawable face or line: lists the elements that were left out, or mentions
/// points.
pub(crate) fn nothing_to_draw(warnings: &Warnings, has_points: bool) -> Error {
    let left_out: Vec<String> =
        warnings.lines().into_iter().filter(|line| line.contains("left out")).collect();
    let message = match (left_out.is_empty(), has_points) {
        (false, _) => format!("{}; nothing to draw", left_out.join("; ")),
        (true, false) => "no faces and no lines; nothing to draw".to_owned(),
        (true, true) => "only points; nothing to draw".to_owned(),
    };
    Error::new(message).of_kind(ErrorKind::Empty)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn from_triangles_checks_indices_and_positions() {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        assert_eq!(Scene::from_triangles(corners, [[0, 1, 2]]).unwrap().parts.len(), 1);
        let error = Scene::from_triangles(corners, [[0, 1, 2], [0, 1, 3]]).unwrap_err();
        assert_eq!(error.place.as_deref(), Some("triangle 1"), "{error}");
        let error = Scene::from_triangles([[0.0, f64::NAN, 0.0]], [[0, 0, 0]]).unwrap_err();
        assert_eq!(error.place.as_deref(), Some("position 0"), "{error}");
        assert_eq!(Scene::from_triangles(corners, []).unwrap_err().kind, ErrorKind::Empty);
    }
}
