//! Methods that build a scene from geometries, materials and named parts, for models that a program generates.

use glam::{DAffine3, DVec3};

use crate::colour::srgb::Colour;
use crate::error::Error;
use crate::scene::{Geometry, Material, Part, Scene, UpAxis};

impl Geometry {
    /// Triangles over positions, counter-clockwise from outside, of one material.
    ///
    /// # Errors
    /// Names the first triangle with an index out of range, or the first position that is not finite.
    pub fn from_triangles(
        positions: impl IntoIterator<Item = impl Into<DVec3>>,
        triangles: impl IntoIterator<Item = [u32; 3]>,
        material: Option<u32>,
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
        Ok(Self { positions, triangles, material, ..Self::default() })
    }
}

impl Scene {
    /// An empty scene. Add geometries, materials and parts.
    ///
    /// ```
    /// use ligne::glam::{DAffine3, DVec3};
    /// use ligne::scene::{Geometry, UpAxis};
    /// use ligne::{Camera, Colour, Scene, Style, render};
    ///
    /// let mut scene = Scene::new(UpAxis::Z);
    /// let steel = scene.add_material("steel", Colour::rgb(199, 201, 207));
    /// let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    /// let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    /// let wedge = scene.add_geometry(Geometry::from_triangles(corners, faces, Some(steel))?);
    /// scene.add_part("left", wedge, DAffine3::IDENTITY);
    /// scene.add_part("right", wedge, DAffine3::from_translation(DVec3::X * 2.0));
    /// scene.add_polyline("axis", [[-1.0, 0.5, 0.5], [4.0, 0.5, 0.5]]);
    /// let drawing = render(&scene, &Camera::three_quarter_of(scene.up).fit(&scene), &Style::default())?;
    /// # let svg = drawing.to_svg(&Default::default());
    /// # assert!(svg.contains("data-part=\"right\"") && svg.contains("data-part=\"axis\""));
    /// # Ok::<(), ligne::Error>(())
    /// ```
    #[must_use]
    pub fn new(up: UpAxis) -> Self {
        Self { up, ..Self::default() }
    }

    /// Adds a material of one colour. Returns its index.
    pub fn add_material(&mut self, name: impl Into<String>, colour: Colour) -> u32 {
        self.materials.push(Material { name: name.into(), colour, ..Material::default() });
        self.materials.len() as u32 - 1
    }

    /// Adds a geometry for parts to show. Returns its index.
    pub fn add_geometry(&mut self, geometry: Geometry) -> usize {
        self.geometries.push(geometry);
        self.geometries.len() - 1
    }

    /// Adds a part that shows a geometry.
    pub fn add_part(&mut self, name: impl Into<String>, geometry: usize, world_from_part: DAffine3) {
        self.parts.push(Part { name: name.into(), geometry, world_from_part });
    }

    /// Adds a line through points in world space, as a separate part. Surfaces hide it like other lines. It is
    /// drawn with `pen.wire`, which rules for its part and pen functions may change.
    pub fn add_polyline(
        &mut self,
        name: impl Into<String>,
        points: impl IntoIterator<Item = impl Into<DVec3>>,
    ) {
        let positions: Vec<DVec3> = points.into_iter().map(Into::into).collect();
        let wires = (1..positions.len() as u32).map(|end| [end - 1, end]).collect();
        let geometry = self.add_geometry(Geometry { positions, wires, ..Geometry::default() });
        self.add_part(name, geometry, DAffine3::IDENTITY);
    }
}
