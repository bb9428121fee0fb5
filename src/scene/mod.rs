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
//! 1. A reader of the room `load` fills the scene: geometries, parts that instance them, materials, lights
//!    and cameras.
//! 2. A camera is chosen and framed.
//! 3. Cut-outs remove triangles that are transparent; paints give each triangle its colour.
//! 4. All instances become one triangle soup in world space, from which the mesh is built.
//!
//! Files, in reading order: [`parts`] geometries and parts; [`material`]; [`light`]; [`cameras`]; [`extent`]
//! which points count and how precise they are; [`part_selection`] parts by name; [`glass`] see-through
//! materials; [`textures`]; [`paints`]; [`triangle_soup`]; [`motion_trails`]; [`model_folder`] files next to
//! the model; [`warnings`].

pub mod cameras;
pub mod extent;
pub mod glass;
pub mod light;
pub mod material;
pub(crate) mod model_folder;
pub mod motion_trails;
pub mod paints;
pub mod part_selection;
pub mod parts;
pub(crate) mod textures;
pub mod triangle_soup;
pub mod warnings;

use std::path::PathBuf;

use glam::{DAffine3, DVec3};

pub use cameras::camera::{Camera, Projection};
pub use cameras::named_views::NamedView;
pub use glass::{GlassDraw, GlassOptions};
pub use light::{Light, LightKind};
pub use material::{Alpha, Filter, Material, Wrap};
pub use motion_trails::{Mover, Trail};
pub use paints::artist_textures::{ArtistTexture, ArtistTextures};
pub use paints::triangle_paints::{Paint, Paints};
pub use parts::{Geometry, Part};
pub use textures::texture_options::{TextureFill, TextureOptions};
pub use warnings::Warnings;

use crate::error::{Error, ErrorKind};

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
    /// Vertices of the file that no face or line uses and that no geometry holds.
    pub unused_vertices: u64,
    /// What moves at this moment and may leave motion lines; `None` where nobody asked (see [`crate::motion`]).
    pub movers: Option<Vec<Mover>>,
    /// What had to be dropped or mended while reading.
    pub warnings: Warnings,
}

impl Scene {
    /// A scene of one part that a program made: positions, and the corners of each triangle as indices of
    /// them, counter-clockwise seen from outside. Its y axis points up; set [`Scene::up`] if another does.
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
    /// Names the first triangle with an index that points nowhere, or the first position that is not finite;
    /// and says if there is nothing to draw.
    pub fn from_triangles(
        positions: impl IntoIterator<Item = impl Into<DVec3>>,
        triangles: impl IntoIterator<Item = [u32; 3]>,
    ) -> Result<Self, Error> {
        let positions: Vec<DVec3> = positions.into_iter().map(Into::into).collect();
        let triangles: Vec<[u32; 3]> = triangles.into_iter().collect();
        if let Some(k) = positions.iter().position(|p| !p.is_finite()) {
            return Err(Error::new(format!("{} is not a position", positions[k]))
                .at(format!("position {k}"))
                .remedy("give finite numbers"));
        }
        let count = positions.len();
        if let Some(k) = triangles.iter().position(|t| t.iter().any(|v| *v as usize >= count)) {
            return Err(Error::new(format!("{:?} points past the {count} positions", triangles[k]))
                .at(format!("triangle {k}"))
                .remedy("indices count from 0"));
        }
        let part = Part { name: "model".to_owned(), geometry: 0, world_from_part: DAffine3::IDENTITY };
        let geometry = Geometry { positions, triangles, ..Geometry::default() };
        drawable(Self { geometries: vec![geometry], parts: vec![part], ..Self::default() })
    }
}

/// The scene, unless there is nothing in it to draw.
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

/// The error of a file without a face or a line that can be drawn: what was left out of it, or whether it has points.
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
    fn models_made_by_programs_are_checked() {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        assert_eq!(Scene::from_triangles(corners, [[0, 1, 2]]).unwrap().parts.len(), 1);
        let error = Scene::from_triangles(corners, [[0, 1, 2], [0, 1, 3]]).unwrap_err();
        assert_eq!(error.place.as_deref(), Some("triangle 1"), "{error}");
        let error = Scene::from_triangles([[0.0, f64::NAN, 0.0]], [[0, 0, 0]]).unwrap_err();
        assert_eq!(error.place.as_deref(), Some("position 0"), "{error}");
        assert_eq!(Scene::from_triangles(corners, []).unwrap_err().kind, ErrorKind::Empty);
    }
}
