//! [`PartColours`]: colours that a page assigns to the parts of a model.

use std::collections::BTreeMap;

use serde::Deserialize;
use toml::Spanned;

use crate::colour::srgb::Colour;
use crate::error::Error;
use crate::geometry::names::glob::glob_matches;
use crate::page::page_source::PageSource;
use crate::scene::{Material, Scene};

/// Colours that replace the materials of a model: one for all parts, or one for each pattern of part names.
#[derive(Debug, Clone, Deserialize)]
#[serde(
    untagged,
    expecting = "this is not a colour; write one, or a table such as { \"*\" = \"white\", \"leg*\" = \"orange\" }"
)]
pub(crate) enum PartColours {
    /// One colour for all parts.
    All(Colour),
    /// Colours by pattern; the longest matching pattern applies.
    Parts(BTreeMap<String, Colour>),
}

impl PartColours {
    fn of(&self, part: &str) -> Option<Colour> {
        match self {
            Self::All(colour) => Some(*colour),
            Self::Parts(parts) => {
                let meant = parts.iter().filter(|(glob, _)| glob_matches(glob, part));
                meant.max_by_key(|(glob, _)| glob.len()).map(|(_, colour)| *colour)
            }
        }
    }
}

/// Replaces materials, textures and vertex colours of parts by these colours.
///
/// # Errors
/// Returns an error if a pattern matches no part.
pub(crate) fn paint(
    scene: &mut Scene,
    colours: &Spanned<PartColours>,
    source: &PageSource,
) -> Result<(), Error> {
    if let PartColours::Parts(parts) = colours.get_ref() {
        let is_there = |glob: &str| scene.parts.iter().any(|part| glob_matches(glob, &part.name));
        if let Some(glob) = parts.keys().find(|glob| !is_there(glob)) {
            return Err(unknown(glob, scene, colours, source));
        }
    }
    let own = scene.materials.len();
    for number in 0..scene.parts.len() {
        let part = &scene.parts[number];
        let Some(colour) = colours.get_ref().of(&part.name) else { continue };
        let known = scene.materials.iter().skip(own).position(|material| material.colour == colour);
        let material = own + known.unwrap_or(scene.materials.len() - own);
        if known.is_none() {
            scene.materials.push(Material { name: colour.hex(), colour, ..Material::default() });
        }
        let Some(mut geometry) = scene.geometry_of(part).cloned() else { continue };
        geometry.triangle_material.clear();
        geometry.colours.clear();
        geometry.material = u32::try_from(material).ok();
        let is_shared = scene.parts.iter().filter(|other| other.geometry == part.geometry).count() > 1;
        let place = if is_shared { scene.geometries.len() } else { part.geometry };
        match scene.geometries.get_mut(place) {
            Some(there) => *there = geometry,
            None => scene.geometries.push(geometry),
        }
        scene.parts[number].geometry = place;
    }
    Ok(())
}

/// The error about a pattern that matches no part.
fn unknown(glob: &str, scene: &Scene, colours: &Spanned<PartColours>, source: &PageSource) -> Error {
    let span = colours.span();
    let text = source.text.get(span.clone()).unwrap_or_default();
    let start = text.find(glob).map_or(span.start, |at| span.start + at);
    super::camera_spec::unknown_part(&Spanned::new(start..start + glob.len(), glob.to_owned()), scene, source)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn part_colours_use_the_longest_matching_pattern() {
        let parts = [("*", Colour::WHITE), ("leg*", Colour::BLACK), ("l*", Colour::rgb(1, 2, 3))];
        let colours = PartColours::Parts(parts.map(|(glob, colour)| (glob.to_owned(), colour)).into());
        assert_eq!(
            ["leg-left", "lid", "head"].map(|part| colours.of(part).unwrap()),
            [Colour::BLACK, Colour::rgb(1, 2, 3), Colour::WHITE]
        );
    }
}
