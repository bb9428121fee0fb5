//! [`ArtistTextures`]: pictures named by a style, whose colour changes are drawn as lines on the surfaces of
//! a model.

use std::fmt;
use std::path::PathBuf;
use std::sync::Arc;

use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

use super::varying_surface::VaryingSurface;
use crate::colour::pixel_picture::Picture;
use crate::geometry::names::glob::Glob;
use crate::mesh::{MaterialId, PaintId};
use crate::scene::textures::Texture;
use crate::scene::{Material, Scene};

/// A picture whose colour changes are drawn as lines.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct ArtistTexture {
    /// Pattern for the names of the materials that it covers.
    pub materials: String,
    /// Path of the file.
    pub path: PathBuf,
    /// Decoded picture, once it is read.
    #[serde(skip)]
    pub picture: Option<Arc<Picture>>,
}

/// Pictures whose colour changes are drawn as lines: one for all materials, or one per pattern of material
/// names. The longest matching pattern applies.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(crate) struct ArtistTextures(pub Vec<ArtistTexture>);

impl ArtistTextures {
    /// Picture of a material.
    fn of(&self, material: &Material) -> Option<&Arc<Picture>> {
        let fits = |own: &&ArtistTexture| Glob::new(own.materials.as_str()).matches(&material.name);
        // Of equally long patterns, the first.
        self.0.iter().rev().filter(fits).max_by_key(|own| own.materials.len())?.picture.as_ref()
    }

    /// Picture of each material that has one, reduced to at most `count` colours. The colour numbers serve as
    /// paint ids.
    pub(crate) fn on(&self, scene: &Scene, count: usize) -> Vec<(MaterialId, VaryingSurface)> {
        if self.0.is_empty() {
            return Vec::new();
        }
        let without = Material::default();
        let last = scene.materials.len();
        let mut shown_by: Vec<Vec<[usize; 2]>> = vec![Vec::new(); last + 1];
        for (index, geometry) in scene.geometries.iter().enumerate() {
            for triangle in 0..geometry.corner_uvs.len().min(geometry.triangles.len()) {
                let material = geometry.material_of(triangle).map_or(last, |id| (id as usize).min(last));
                shown_by[material].push([index, triangle]);
            }
        }
        let materials = scene.materials.iter().chain([&without]).enumerate();
        let inked = materials.filter_map(|(id, material)| {
            let picture = self.of(material).filter(|_| !shown_by[id].is_empty())?;
            let texture = Texture::with_picture(scene, material, picture);
            let shown = texture.unmasked_coverage(scene, &shown_by[id]);
            let colours = texture.representative_colours(&shown, count);
            // The mean colour comes last.
            let paints = (0..=colours.len()).map(PaintId::from).collect();
            let mean = texture.mean(&shown);
            Some((id.into(), VaryingSurface::new(Some(texture.painted(shown, &colours, mean)), None, paints)))
        });
        inked.collect()
    }
}

impl<'de> Deserialize<'de> for ArtistTextures {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(PathsVisitor)
    }
}

/// Reads one path, or a table of patterns and paths.
struct PathsVisitor;

impl<'de> Visitor<'de> for PathsVisitor {
    type Value = ArtistTextures;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("the path of a picture, or a table of material names and paths")
    }

    fn visit_str<E: serde::de::Error>(self, path: &str) -> Result<ArtistTextures, E> {
        let all = ArtistTexture { materials: "*".to_owned(), path: path.into(), picture: None };
        Ok(ArtistTextures(if path.is_empty() { Vec::new() } else { vec![all] }))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<ArtistTextures, A::Error> {
        let mut all = Vec::new();
        while let Some((materials, path)) = map.next_entry()? {
            all.push(ArtistTexture { materials, path, picture: None });
        }
        Ok(ArtistTextures(all))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn artist_texture_is_chosen_by_the_longest_matching_pattern() {
        let picture = |width: usize| {
            Some(Arc::new(Picture {
                width,
                height: 1,
                pixels: vec![crate::colour::srgb::Colour::WHITE; width],
            }))
        };
        let of = |materials: &str, width: usize| ArtistTexture {
            materials: materials.to_owned(),
            path: PathBuf::new(),
            picture: picture(width),
        };
        let all = ArtistTextures(vec![of("*", 1), of("bo*", 2), of("b*", 3)]);
        let width = |name: &str| {
            let material = Material { name: name.to_owned(), ..Material::default() };
            all.of(&material).map(|picture| picture.width)
        };
        assert_eq!(["body", "base", "leg"].map(width), [Some(2), Some(3), Some(1)]);
    }
}
