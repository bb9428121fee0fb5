//! [`Paints`]: the colour of each triangle, where textures or vertex colours give it.
//!
//! A texture that is a palette, as low-polygon models have them, or colours painted on vertices
//! part a material into areas of flat colour; any other picture is painted in a few colours, point by point. They matter to
//! fills only: lines know materials, and a change of paint within one is no material boundary.

use glam::Vec3;
use rayon::prelude::*;
use rustc_hash::FxHashMap;

use super::texture::options::{TextureFill, TextureOptions};
use super::texture::swatches::{ALIKE, difference, mean, of_palette, swatches};
use super::texture::{Painted, Texture};
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
    /// textures and vertex colours, by material and then by colour. What shows a picture has a paint of its own, in the mean
    /// colour of the picture.
    pub list: Vec<Paint>,
    /// Textures that could not be read.
    pub warnings: Warnings,
    /// Paint of each triangle of each geometry, or empty where each has that of its material.
    triangles: Vec<Vec<PaintId>>,
    /// The pictures that are painted point by point, and the paint of the triangles that show them.
    pub(crate) pictures: Vec<(PaintId, Painted)>,
}

impl Paints {
    /// Finds the paints of a scene; reads textures beside the model.
    #[must_use]
    pub fn of(scene: &Scene, options: &TextureOptions) -> Self {
        let without = Material::default();
        let materials: Vec<&Material> = scene.materials.iter().chain([&without]).collect();
        let mut paints = Self::default();
        paints.list.extend(
            materials
                .iter()
                .enumerate()
                .map(|(id, material)| Paint { material: id.into(), colour: material.colour }),
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

        // Colours of all triangles that have one, by material.
        let mut coloured: Vec<Vec<Coloured>> = vec![Vec::new(); materials.len()];
        for (index, geometry) in scene.geometries.iter().enumerate() {
            let last = materials.len() - 1;
            let material_of =
                |triangle: usize| geometry.material_of(triangle).map_or(last, |id| (id as usize).min(last));
            let colour = |triangle: usize| {
                let id = material_of(triangle);
                let texture = textures.get(id).and_then(Option::as_ref);
                Some((id, colour_of(geometry, index, triangle, texture)?))
            };
            let found: Vec<Option<(usize, Coloured)>> =
                (0..geometry.triangles.len()).into_par_iter().with_min_len(1 << 12).map(colour).collect();
            for (id, found) in found.into_iter().flatten() {
                coloured[id].push(found);
            }
            paints.triangles.push(Vec::new());
        }
        for (id, ((list, texture), material)) in coloured.iter().zip(textures).zip(materials).enumerate() {
            let factor = Factor { base: material.colour, multiplies: scene.format == "glTF" };
            // Where corners are tinted as well a triangle is of one colour.
            let texture = texture.filter(|_| list.iter().all(|own| own.painted.is_none()));
            match (texture, options.fill) {
                (Some(texture), TextureFill::Regions) if !list.is_empty() => {
                    paints.add_picture(scene, id, list, texture, options.colours, &factor);
                }
                (texture, fill) => {
                    let colours: Vec<(Colour, bool)> =
                        list.iter().map(|own| (factor.of(own), own.spread < ALIKE)).collect();
                    let is_one = texture.is_some() && fill == TextureFill::Mean;
                    let colours = if is_one { vec![mean(&colours); list.len()] } else { swatches(&colours) };
                    paints.add(scene, id, &colours, list);
                }
            }
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

    /// Adds the paints of a material's triangles, each in its colour.
    fn add(&mut self, scene: &Scene, material: usize, colours: &[Colour], triangles: &[Coloured]) {
        let known = self.of_colours(material, colours);
        for (colour, own) in colours.iter().zip(triangles) {
            if let Some(paint) = known.get(colour) {
                self.paint(scene, own, *paint);
            }
        }
    }

    /// Adds the paints of a material whose triangles show a picture. Those that are of one colour of a palette have that; all
    /// others are painted point by point.
    fn add_picture(
        &mut self,
        scene: &Scene,
        material: usize,
        triangles: &[Coloured],
        texture: Texture,
        count: usize,
        factor: &Factor,
    ) {
        let seen: Vec<(Colour, bool)> =
            triangles.iter().filter_map(|own| Some((own.shown?, own.spread < ALIKE))).collect();
        let places: Vec<[usize; 2]> = triangles.iter().map(|own| [own.geometry, own.triangle]).collect();
        let shown = texture.shown(scene, material, &places);
        let swatches = of_palette(&seen);
        let mut colours = match &swatches {
            Some(swatches) => swatches.clone(),
            None => texture.few(&shown, count),
        };
        colours.sort_unstable();
        colours.dedup();
        let tinted: Vec<Colour> = colours.iter().map(|colour| factor.tint(*colour)).collect();
        let known = self.of_colours(material, &tinted);
        let with_paint: Vec<(Colour, PaintId)> = colours
            .iter()
            .zip(&tinted)
            .filter_map(|(own, tinted)| Some((*own, *known.get(tinted)?)))
            .collect();
        let paint_of = |colour: Colour| {
            with_paint.iter().min_by_key(|(own, _)| difference(*own, colour)).map(|(_, paint)| *paint)
        };
        // What lies between colours is parted where the picture has it, not where its triangles meet.
        let is_near =
            |own: &Coloured| colours.iter().any(|c| own.shown.is_some_and(|s| difference(*c, s) <= SAME));
        let is_whole = |own: &Coloured| {
            with_paint.len() < 2 || (swatches.is_some() && own.spread <= SAME && is_near(own))
        };
        if triangles.iter().all(is_whole) {
            for own in triangles {
                if let Some(paint) = own.shown.and_then(paint_of) {
                    self.paint(scene, own, paint);
                }
            }
            return;
        }
        let picture = PaintId::from(self.list.len());
        self.list.push(Paint { material: material.into(), colour: factor.tint(mean(&seen)) });
        for own in triangles {
            let own_paint = own.shown.filter(|_| is_whole(own)).and_then(paint_of);
            self.paint(scene, own, own_paint.unwrap_or(picture));
        }
        self.pictures.push((picture, texture.painted(shown, &with_paint)));
    }

    /// The paints of a material in these colours.
    fn of_colours(&mut self, material: usize, colours: &[Colour]) -> FxHashMap<Colour, PaintId> {
        // By colour, not by the triangle that shows it first.
        let mut distinct = colours.to_vec();
        distinct.sort_unstable();
        distinct.dedup();
        let mut known = FxHashMap::default();
        for colour in distinct {
            if self.list.get(material).is_some_and(|own| own.colour == colour) {
                known.insert(colour, PaintId::from(material));
            } else {
                known.insert(colour, PaintId::from(self.list.len()));
                self.list.push(Paint { material: material.into(), colour });
            }
        }
        known
    }

    /// Gives a triangle its paint.
    fn paint(&mut self, scene: &Scene, own: &Coloured, paint: PaintId) {
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

/// Colours that differ by no more than this in any channel are one, but for how they were stored.
const SAME: u32 = 8;

/// A triangle that has a colour other than its material's.
#[derive(Debug, Clone, Copy)]
struct Coloured {
    geometry: usize,
    triangle: usize,
    /// What it shows of a texture.
    shown: Option<Colour>,
    /// How far colours within it differ.
    spread: u32,
    /// The linear light of the colours at its corners, where they are not white.
    painted: Option<Vec3>,
}

/// The colours of a triangle, where a texture or its corners give it one.
fn colour_of(
    geometry: &Geometry,
    index: usize,
    triangle: usize,
    texture: Option<&Texture>,
) -> Option<Coloured> {
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
    // White is no tint of a texture.
    let painted = painted.filter(|light| shown.is_none() || *light != Vec3::ONE);
    if shown.is_none() && painted.is_none() {
        return None;
    }
    let (shown, spread) = shown.map_or((None, 0), |(colour, spread)| (Some(colour), spread));
    Some(Coloured { geometry: index, triangle, shown, spread, painted })
}

/// What the colour of a material does to those of its texture and its corners: in glTF it multiplies them, elsewhere they stand
/// in for it.
struct Factor {
    base: Colour,
    multiplies: bool,
}

impl Factor {
    /// The colour of a triangle.
    fn of(&self, own: &Coloured) -> Colour {
        self.product([own.shown.map(light), own.painted])
    }

    /// The colour of what shows one of the colours of a texture.
    fn tint(&self, colour: Colour) -> Colour {
        self.product([Some(light(colour)), None])
    }

    fn product(&self, factors: [Option<Vec3>; 2]) -> Colour {
        let base = self.multiplies.then(|| light(self.base));
        let product =
            factors.into_iter().chain([base]).flatten().fold(Vec3::ONE, |product, factor| product * factor);
        let opacity = f32::from(self.base.a) / 255.0;
        Colour::from_linear([product.x, product.y, product.z, opacity])
    }
}

/// The linear light of a colour.
fn light(colour: Colour) -> Vec3 {
    let [r, g, b] = [colour.r, colour.g, colour.b].map(|c| linear(f32::from(c) / 255.0));
    Vec3::new(r, g, b)
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
        let paints = Paints::of(&scene, &TextureOptions::default());
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
        let colour = |format| Paints::of(&scene(format, half), &TextureOptions::default()).list[4].colour;
        assert_eq!(colour("glTF"), Colour::rgb(half.r, 0, 0));
        assert_eq!(colour("OBJ"), Colour::rgb(255, 0, 0));
    }

    #[test]
    fn colours_of_vertices_are_paint_too() {
        let mut scene = scene("PLY", Colour::WHITE);
        scene.materials.clear();
        scene.geometries[0].triangle_material.clear();
        scene.geometries[0].colours = vec![[0.0, 1.0, 0.0, 1.0]; 6];
        let paints = Paints::of(&scene, &TextureOptions::default());
        let green = Paint { material: MaterialId(0), colour: Colour::rgb(0, 255, 0) };
        assert_eq!(paints.list[1..], [green]);
        assert_eq!(paints.of_geometry(0), [PaintId(1); 4]);
    }

    #[test]
    fn broken_textures_leave_the_material() {
        let mut scene = scene("glTF", Colour::WHITE);
        scene.materials[0].picture = Some(Arc::from(&b"nothing"[..]));
        let paints = Paints::of(&scene, &TextureOptions::default());
        assert_eq!((paints.list.len(), paints.warnings.lines().len()), (3, 1));
        assert!(paints.of_geometry(0).is_empty());
    }
}
