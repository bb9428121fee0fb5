//! [`Paints`]: the colour of each triangle, where textures or vertex colours give it.
//!
//! A texture that is a palette, as low-polygon models have them, or colours painted on vertices
//! part a material into areas of flat colour. They matter to fills only: lines know materials, and a
//! change of paint within one is no material boundary.

use glam::Vec3;
use rayon::prelude::*;
use rustc_hash::FxHashMap;

use super::swatches::swatches;
use super::texture::Texture;
use super::{Geometry, Material, Scene, Warnings};
use crate::math::colour::{Colour, linear};
use crate::mesh::{MaterialId, PaintId};

/// A material in one of its colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Paint {
    /// The material.
    pub material: MaterialId,
    /// The colour in place of the material's.
    pub colour: Colour,
}

/// The paints of a scene, and which triangle has which.
#[derive(Debug, Clone, Default)]
pub struct Paints {
    /// One for each material and for what has none, with their own ids and colours; then those of
    /// textures and vertex colours, by material and then by colour.
    pub list: Vec<Paint>,
    /// Textures that could not be read.
    pub warnings: Warnings,
    /// Paint of each triangle of each geometry, or empty where each has that of its material.
    triangles: Vec<Vec<PaintId>>,
}

impl Paints {
    /// Finds the paints of a scene; reads textures beside the model.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        let without = Material::default();
        let materials: Vec<&Material> = scene.materials.iter().chain([&without]).collect();
        let mut paints = Self::default();
        paints.list.extend(
            materials
                .iter()
                .enumerate()
                .map(|(id, material)| Paint { material: id.into(), colour: material.colour }),
        );
        let textures: Vec<Option<Result<Texture, String>>> =
            materials.par_iter().map(|material| Texture::of(scene, material)).collect();
        let textures: Vec<Option<Texture>> = textures
            .into_iter()
            .map(|texture| {
                let texture = texture?.map_err(|message| {
                    paints.warnings.note(format!("a texture cannot be painted: {message}"));
                });
                texture.ok()
            })
            .collect();

        // Colours of all triangles that have one, with the material, geometry and triangle.
        let mut coloured: Vec<Vec<Coloured>> = vec![Vec::new(); materials.len()];
        for (index, geometry) in scene.geometries.iter().enumerate() {
            let last = materials.len() - 1;
            let material_of = |triangle: usize| {
                let own = geometry.triangle_material.get(triangle).copied().or(geometry.material);
                own.map_or(last, |id| (id as usize).min(last))
            };
            let colour = |triangle: usize| {
                let id = material_of(triangle);
                let texture = textures.get(id).and_then(Option::as_ref);
                let base = materials.get(id).map_or(Colour::WHITE, |material| material.colour);
                Some((id, colour_of(geometry, triangle, texture, base, scene.format == "glTF")?))
            };
            let found: Vec<Option<(usize, (Colour, bool))>> =
                (0..geometry.triangles.len()).into_par_iter().with_min_len(1 << 12).map(colour).collect();
            for (triangle, (id, colour)) in
                found.into_iter().enumerate().filter_map(|(triangle, found)| Some((triangle, found?)))
            {
                if let Some(list) = coloured.get_mut(id) {
                    list.push((colour, index, triangle));
                }
            }
            paints.triangles.push(Vec::new());
        }
        for (id, list) in coloured.iter().enumerate() {
            paints.add(scene, id, list);
        }
        paints
    }

    /// Gives pieces of triangles the paint of what they were cut out of: one triangle has one.
    pub(crate) fn carry(&mut self, origins: &[Option<Vec<u32>>]) {
        for (paints, origins) in self.triangles.iter_mut().zip(origins) {
            if let (false, Some(origins)) = (paints.is_empty(), origins) {
                *paints = origins.iter().filter_map(|origin| paints.get(*origin as usize).copied()).collect();
            }
        }
    }

    /// The paints of a geometry's triangles, or none where each has that of its material.
    #[must_use]
    pub fn of_geometry(&self, geometry: usize) -> &[PaintId] {
        self.triangles.get(geometry).map_or(&[], Vec::as_slice)
    }

    /// Adds the paints of a material's triangles.
    fn add(&mut self, scene: &Scene, material: usize, triangles: &[Coloured]) {
        let colours: Vec<(Colour, bool)> = triangles.iter().map(|(colour, ..)| *colour).collect();
        let colours = swatches(&colours);
        // By colour, not by the triangle that shows it first.
        let mut distinct = colours.clone();
        distinct.sort_unstable();
        distinct.dedup();
        let mut known: FxHashMap<Colour, PaintId> = FxHashMap::default();
        for colour in distinct {
            if self.list.get(material).is_some_and(|own| own.colour == colour) {
                known.insert(colour, PaintId::from(material));
            } else {
                known.insert(colour, PaintId::from(self.list.len()));
                self.list.push(Paint { material: material.into(), colour });
            }
        }
        for (colour, &(_, geometry, triangle)) in colours.into_iter().zip(triangles) {
            let Some(&paint) = known.get(&colour) else { continue };
            let Some((paints, shape)) = self.triangles.get_mut(geometry).zip(scene.geometries.get(geometry))
            else {
                continue;
            };
            if paints.is_empty() {
                let last = scene.materials.len() as u32;
                let own = |i: usize| shape.triangle_material.get(i).copied().or(shape.material);
                paints.extend((0..shape.triangles.len()).map(|i| PaintId(own(i).unwrap_or(last))));
            }
            if let Some(place) = paints.get_mut(triangle) {
                *place = paint;
            }
        }
    }
}

/// The colour of a triangle and whether it is of one colour; its geometry and its number there.
type Coloured = ((Colour, bool), usize, usize);

/// The colour of a triangle and whether it is of one colour, where a texture or its corners give it. In glTF they multiply the
/// material's, elsewhere they stand in for it.
fn colour_of(
    geometry: &Geometry,
    triangle: usize,
    texture: Option<&Texture>,
    base: Colour,
    multiplies: bool,
) -> Option<(Colour, bool)> {
    let uvs = geometry.corner_uvs.get(triangle).and_then(|corners| {
        let [a, b, c] = corners.map(|corner| geometry.uvs.get(corner as usize).copied());
        Some([a?, b?, c?])
    });
    let shown = texture.zip(uvs).map(|(texture, uvs)| texture.of_triangle(uvs));
    let painted = geometry.triangles.get(triangle).and_then(|corners| {
        let [a, b, c] = corners.map(|corner| geometry.colours.get(corner as usize).copied());
        // Rounded once, so that it does not matter which corner comes first.
        let [a, b, c] = [a?, b?, c?].map(|[r, g, b, _]| Vec3::new(r, g, b).as_dvec3());
        Some(((a + b + c) / 3.0).as_vec3())
    });
    if shown.is_none() && painted.is_none() {
        return None;
    }
    let light = |colour: Colour| {
        let [r, g, b] = [colour.r, colour.g, colour.b].map(|c| linear(f32::from(c) / 255.0));
        Vec3::new(r, g, b)
    };
    let factors = [shown.map(|(colour, _)| light(colour)), painted, multiplies.then(|| light(base))];
    let product = factors.into_iter().flatten().fold(Vec3::ONE, |product, factor| product * factor);
    let opacity = f32::from(base.a) / 255.0;
    let flat = shown.is_none_or(|(_, flat)| flat);
    Some((Colour::from_linear([product.x, product.y, product.z, opacity]), flat))
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use glam::{DAffine3, DVec3};

    use super::*;
    use crate::mesh::Mesh;
    use crate::scene::Part;

    const NONE: u32 = u32::MAX;

    /// A strip of four triangles, of which two show the palette and one nothing of it.
    fn scene(format: &'static str, base: Colour) -> Scene {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 2, 1);
        encoder.set_color(png::ColorType::Rgb);
        encoder.write_header().unwrap().write_image_data(&[255, 0, 0, 0, 0, 255]).unwrap();
        let material = Material {
            name: "palette".to_owned(),
            colour: base,
            picture: Some(Arc::from(bytes)),
            ..Material::default()
        };
        let geometry = Geometry {
            positions: (0..6).map(|i| DVec3::new(f64::from(i / 2), f64::from(i % 2), 0.0)).collect(),
            triangles: vec![[0, 2, 1], [1, 2, 3], [2, 4, 3], [3, 4, 5]],
            triangle_material: vec![0, 0, 0, 1],
            uvs: vec![[0.25, 0.5], [0.75, 0.5]],
            corner_uvs: vec![[0, 0, 0], [1, 1, 1], [NONE; 3], [0, 0, 0]],
            ..Geometry::default()
        };
        let part = Part { name: "strip".to_owned(), geometry: 0, world_from_part: DAffine3::IDENTITY };
        let materials = vec![material, Material::default()];
        Scene { format, materials, geometries: vec![geometry], parts: vec![part], ..Scene::default() }
    }

    #[test]
    fn palettes_give_triangles_their_paint() {
        let scene = scene("glTF", Colour::WHITE);
        let paints = Paints::of(&scene);
        assert_eq!(paints.list.len(), 5);
        let mesh = Mesh::build(scene.to_painted_soup(&paints));
        assert_eq!(paints.of_geometry(0), [4, 3, 0, 1].map(PaintId));
        assert_eq!(mesh.face_paint, [4, 3, 0, 1].map(PaintId));
        assert_eq!(paints.list[3], Paint { material: MaterialId(0), colour: Colour::rgb(0, 0, 255) });
        assert_eq!(paints.list[4].colour, Colour::rgb(255, 0, 0));
        // Lines see one material.
        assert_eq!(mesh.face_material, [0, 0, 0, 1].map(MaterialId));
        assert!(scene.to_soup().triangle_paint.is_empty());
        assert_eq!(Mesh::build(scene.to_soup()).paint(3.into()), PaintId(1));
    }

    #[test]
    fn textures_multiply_the_material_in_gltf_only() {
        let half = Colour::from_linear([0.5, 0.5, 0.5, 1.0]);
        let colour = |format| Paints::of(&scene(format, half)).list[4].colour;
        assert_eq!(colour("glTF"), Colour::rgb(half.r, 0, 0));
        assert_eq!(colour("OBJ"), Colour::rgb(255, 0, 0));
    }

    #[test]
    fn colours_of_vertices_are_paint_too() {
        let mut scene = scene("PLY", Colour::WHITE);
        scene.materials.clear();
        scene.geometries[0].triangle_material.clear();
        scene.geometries[0].colours = vec![[0.0, 1.0, 0.0, 1.0]; 6];
        let paints = Paints::of(&scene);
        let green = Paint { material: MaterialId(0), colour: Colour::rgb(0, 255, 0) };
        assert_eq!(paints.list[1..], [green]);
        assert_eq!(paints.of_geometry(0), [PaintId(1); 4]);
    }

    #[test]
    fn broken_textures_leave_the_material() {
        let mut scene = scene("glTF", Colour::WHITE);
        scene.materials[0].picture = Some(Arc::from(&b"nothing"[..]));
        let paints = Paints::of(&scene);
        assert_eq!((paints.list.len(), paints.warnings.lines().len()), (3, 1));
        assert!(paints.of_geometry(0).is_empty());
    }
}
