//! [`Paints`]: the colour of each triangle where textures or vertex colours give it one.
//!
//! Palette textures, as in low-polygon models, and vertex colours divide a material into areas of flat
//! colour. Other pictures are painted in a few colours, point by point. Paints affect fills only: a change of
//! paint within a material is no material boundary.

use crate::parallel::prelude::*;
use rustc_hash::FxHashMap;

use super::artist_textures::ArtistTextures;
use super::triangle_colour::{MaterialFactor, TriangleColour};
use super::varying_surface::VaryingSurface;
use crate::colour::srgb::Colour;
use crate::mesh::{MaterialId, PaintId};
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::scene::textures::palette::palette_clusters::{MIN_CHANNEL_DIFFERENCE, cluster_colours, mean};
use crate::scene::textures::texture_options::{TextureFill, TextureOptions};
use crate::scene::textures::{EmbeddedTexture, Texture};
use crate::scene::{Material, Scene, Warnings};

/// A material in one of its colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct MaterialPaint {
    /// The material.
    pub material: MaterialId,
    /// Colour that replaces the material's.
    pub colour: Colour,
}

/// The paints of a scene, and the paint of each triangle.
#[derive(Debug, Clone, Default)]
pub(crate) struct Paints {
    /// First one paint per material, and one for triangles without a material, with the same ids and colours.
    /// Then the paints of textures and vertex colours, by material and colour. A picture also has a paint in
    /// its mean colour.
    pub list: Vec<MaterialPaint>,
    /// Textures that could not be read.
    pub warnings: Warnings,
    /// Pictures of the style for lines along colour changes, by material.
    pub(crate) inked: Vec<(MaterialId, VaryingSurface)>,
    /// Paint of each triangle of each geometry; empty if all have the paint of their material.
    triangles: Vec<Vec<PaintId>>,
    /// Surfaces painted point by point, with the paint of their triangles.
    pub(crate) varied: Vec<(PaintId, VaryingSurface)>,
    /// Whether any of them uses vertex colours.
    pub(crate) tinted: bool,
    /// Pictures that are embedded in the drawing.
    pub(crate) images: Vec<EmbeddedTexture>,
}

impl Paints {
    /// Finds the paints of a scene; reads textures next to the model.
    #[must_use]
    pub(crate) fn of(scene: &Scene, options: &TextureOptions) -> Self {
        let without = Material::default();
        let materials: Vec<&Material> = scene.materials.iter().chain([&without]).collect();
        let mut paints = Self::default();
        paints.list.extend(
            materials
                .iter()
                .enumerate()
                .map(|(id, material)| MaterialPaint { material: id.into(), colour: material.colour }),
        );
        let read = |material: &&Material| {
            if options.fill == TextureFill::Off { None } else { Texture::of(scene, material) }
        };
        let textures: Vec<Option<Result<Texture, String>>> = materials.par_iter().map(read).collect();
        let textures: Vec<Option<Texture>> = textures
            .into_iter()
            .map(|texture| {
                let texture = texture?.map_err(|message| {
                    paints.warnings.note(format!("a texture cannot be painted: {message}"));
                });
                texture.ok()
            })
            .collect();

        // Sampled triangles that have a texture or vertex colours, by material.
        let mut coloured: Vec<Vec<TriangleColour>> = vec![Vec::new(); materials.len()];
        for (index, geometry) in scene.geometries.iter().enumerate() {
            let last = materials.len() - 1;
            let material_of =
                |triangle: usize| geometry.material_of(triangle).map_or(last, |id| (id as usize).min(last));
            let colour = |triangle: usize| {
                let id = material_of(triangle);
                let texture = textures.get(id).and_then(Option::as_ref);
                Some((id, TriangleColour::of(geometry, index, triangle, texture)?))
            };
            let found: Vec<Option<(usize, TriangleColour)>> = (0..geometry.triangles.len())
                .into_par_iter()
                .with_min_len(MIN_TASK_ITEMS)
                .map(colour)
                .collect();
            for (id, found) in found.into_iter().flatten() {
                coloured[id].push(found);
            }
            paints.triangles.push(Vec::new());
        }
        let count = materials.len();
        for (id, ((list, texture), material)) in coloured.iter().zip(textures).zip(materials).enumerate() {
            // Without a material, vertex colours are multiplied by white (glTF 2.0, section 3.9.6), not by
            // the default grey. Readers put such a material last.
            let is_none = id + 2 >= count && *material == without;
            let factor =
                MaterialFactor { base: material.colour, multiplies: scene.format == "glTF" && !is_none };
            let is_tinted = list.iter().any(|own| own.painted.is_some());
            let texture = texture.filter(|_| !list.is_empty());
            match (texture, options.fill) {
                (Some(texture), TextureFill::Regions) if !is_tinted => {
                    paints.add_picture(scene, id, list, texture, options.colours, &factor);
                }
                (Some(texture), TextureFill::Image) if !is_tinted => {
                    paints.add_image(scene, id, list, texture, &factor);
                }
                (Some(texture), TextureFill::Regions | TextureFill::Image)
                    if !list.iter().all(TriangleColour::is_flat) =>
                {
                    paints.add_tinted_picture(scene, id, list, texture, options.colours, &factor);
                }
                (None, _) if list.iter().any(TriangleColour::varies) => {
                    paints.add_tints(scene, id, list, options.colours, &factor);
                }
                (texture, fill) => {
                    // If texture and corner colours are constant on each triangle, so is their product.
                    let texture = texture.filter(|_| !is_tinted);
                    let colours: Vec<(Colour, bool)> = list
                        .iter()
                        .map(|own| (factor.of(own), own.spread < MIN_CHANNEL_DIFFERENCE))
                        .collect();
                    let is_one = texture.is_some() && fill == TextureFill::Mean;
                    let colours =
                        if is_one { vec![mean(&colours); list.len()] } else { cluster_colours(&colours) };
                    paints.add(scene, id, &colours, list);
                }
            }
        }
        paints
    }

    /// Adds the style's pictures for lines along colour changes, each reduced to at most `colours` colours.
    pub(crate) fn ink(&mut self, scene: &Scene, pictures: &ArtistTextures, colours: usize) {
        self.inked = pictures.on(scene, colours);
    }

    /// Gives pieces of cut triangles the paint of their original triangle.
    pub(crate) fn carry(&mut self, origins: &[Option<Vec<u32>>]) {
        for (paints, origins) in self.triangles.iter_mut().zip(origins) {
            if let (false, Some(origins)) = (paints.is_empty(), origins) {
                *paints = origins.iter().filter_map(|origin| paints.get(*origin as usize).copied()).collect();
            }
        }
    }

    /// Paints of a geometry's triangles; empty if all have the paint of their material.
    #[must_use]
    pub(crate) fn of_geometry(&self, geometry: usize) -> &[PaintId] {
        self.triangles.get(geometry).map_or(&[], Vec::as_slice)
    }

    /// Whether all triangles have the same paint ids in both; the colours may differ.
    pub(crate) fn has_same_layout(&self, other: &Self) -> bool {
        let materials = |paints: &Self| paints.list.iter().map(|paint| paint.material).collect::<Vec<_>>();
        self.triangles == other.triangles
            && self.tinted == other.tinted
            && materials(self) == materials(other)
    }

    /// Adds paints for triangles of a material, each with its colour.
    fn add(&mut self, scene: &Scene, material: usize, colours: &[Colour], triangles: &[TriangleColour]) {
        let known = self.of_colours(material, colours);
        for (colour, own) in colours.iter().zip(triangles) {
            if let Some(paint) = known.get(colour) {
                self.paint(scene, own, *paint);
            }
        }
    }

    /// Paints of a material for a list of colours, added where needed.
    pub(crate) fn of_colours(&mut self, material: usize, colours: &[Colour]) -> FxHashMap<Colour, PaintId> {
        // Sort by colour, so that ids do not depend on the order of triangles.
        let mut distinct = colours.to_vec();
        distinct.sort_unstable();
        distinct.dedup();
        let mut known = FxHashMap::default();
        for colour in distinct {
            if self.list.get(material).is_some_and(|own| own.colour == colour) {
                known.insert(colour, PaintId::from(material));
            } else {
                known.insert(colour, PaintId::from(self.list.len()));
                self.list.push(MaterialPaint { material: material.into(), colour });
            }
        }
        known
    }

    /// Sets the paint of a triangle.
    pub(crate) fn paint(&mut self, scene: &Scene, own: &TriangleColour, paint: PaintId) {
        let Some((paints, shape)) =
            self.triangles.get_mut(own.geometry).zip(scene.geometries.get(own.geometry))
        else {
            return;
        };
        if paints.is_empty() {
            let last = scene.materials.len() as u32;
            paints.extend((0..shape.triangles.len()).map(|i| PaintId(shape.material_of(i).unwrap_or(last))));
        }
        if let Some(place) = paints.get_mut(own.triangle) {
            *place = paint;
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use glam::{DAffine3, DVec3};

    use super::*;
    use crate::mesh::Mesh;
    use crate::scene::{Geometry, Part};

    const NO_INDEX: u32 = u32::MAX;

    /// Strip of four triangles: two show the palette, one shows nothing of it.
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
            corner_uvs: vec![[0, 0, 0], [1, 1, 1], [NO_INDEX; 3], [0, 0, 0]],
            ..Geometry::default()
        };
        let part = Part { name: "strip".to_owned(), geometry: 0, world_from_part: DAffine3::IDENTITY };
        let materials = vec![material, Material::default()];
        Scene { format, materials, geometries: vec![geometry], parts: vec![part], ..Scene::default() }
    }

    #[test]
    fn palette_textures_give_each_triangle_its_paint() {
        let scene = scene("glTF", Colour::WHITE);
        let paints = Paints::of(&scene, &TextureOptions::default());
        assert_eq!(paints.list.len(), 5);
        let mesh = Mesh::build(scene.to_painted_soup(&paints));
        assert_eq!(paints.of_geometry(0), [4, 3, 0, 1].map(PaintId));
        assert_eq!(mesh.face_paint, [4, 3, 0, 1].map(PaintId));
        assert_eq!(paints.list[3], MaterialPaint { material: MaterialId(0), colour: Colour::rgb(0, 0, 255) });
        assert_eq!(paints.list[4].colour, Colour::rgb(255, 0, 0));
        // Lines distinguish materials only.
        assert_eq!(mesh.face_material, [0, 0, 0, 1].map(MaterialId));
        assert!(scene.to_soup().triangle_paint.is_empty());
        assert_eq!(Mesh::build(scene.to_soup()).paint(3.into()), PaintId(1));
    }

    #[test]
    fn textures_multiply_the_material_colour_only_in_gltf() {
        let half = Colour::from_linear([0.5, 0.5, 0.5, 1.0]);
        let colour = |format| Paints::of(&scene(format, half), &TextureOptions::default()).list[4].colour;
        assert_eq!(colour("glTF"), Colour::rgb(half.r, 0, 0));
        assert_eq!(colour("OBJ"), Colour::rgb(255, 0, 0));
    }

    #[test]
    fn vertex_colours_become_paints() {
        let mut scene = scene("PLY", Colour::WHITE);
        scene.materials.clear();
        scene.geometries[0].triangle_material.clear();
        scene.geometries[0].colours = vec![[0.0, 1.0, 0.0, 1.0]; 6];
        let paints = Paints::of(&scene, &TextureOptions::default());
        let green = MaterialPaint { material: MaterialId(0), colour: Colour::rgb(0, 255, 0) };
        assert_eq!(paints.list[1..], [green]);
        assert_eq!(paints.of_geometry(0), [PaintId(1); 4]);
    }

    #[test]
    fn undecodable_textures_leave_the_material_colour() {
        let mut scene = scene("glTF", Colour::WHITE);
        scene.materials[0].picture = Some(Arc::from(&b"nothing"[..]));
        let paints = Paints::of(&scene, &TextureOptions::default());
        assert_eq!((paints.list.len(), paints.warnings.lines().len()), (3, 1));
        assert!(paints.of_geometry(0).is_empty());
    }
}
