//! [`PreparedMesh`]: the mesh of the part of a scene that a style draws.

use std::borrow::Cow;

use crate::mesh::Mesh;
use crate::pipeline::fills::{glass_pass, surface_requirements};
use crate::pipeline::lines::chain_colours;
use crate::scene::Paints;
use crate::scene::textures::cutouts;
use crate::scene::{Scene, Warnings};
use crate::style::Style;

/// The paints of the drawn part of a scene, if the style needs any.
pub(crate) fn paints_of(left: &Scene, style: &Style) -> Option<Paints> {
    let needs_paints =
        surface_requirements::uses_paints(style) || chain_colours::needs_material_colours(style);
    let mut paints = needs_paints.then(|| Paints::of(left, &style.textures));
    if surface_requirements::draws_artist_lines(style) {
        let pictures = &style.lines.artist_texture;
        paints.iter_mut().for_each(|paints| paints.ink(left, pictures, style.textures.colours));
    }
    paints
}

/// The part of a scene that a style draws, and its mesh.
pub(crate) struct PreparedMesh<'a> {
    pub scene: Cow<'a, Scene>,
    pub warnings: Warnings,
    pub paints: Option<Paints>,
    pub mesh: Mesh,
}

impl<'a> PreparedMesh<'a> {
    pub(crate) fn of(scene: &'a Scene, style: &Style) -> Self {
        let (scene, paints, warnings) = visible_scene(scene, style);
        let mesh = Mesh::build(paints.as_ref().map_or_else(|| scene.to_soup(), |p| scene.to_painted_soup(p)));
        Self { scene, warnings, paints, mesh }
    }

    /// Builds the mesh of an owned scene. Its geometry is freed once the mesh is built.
    pub(crate) fn of_all(scene: Scene, style: &Style) -> Self {
        let (left, paints, warnings) = visible_scene(&scene, style);
        let left = match left {
            Cow::Owned(left) => Some(left),
            Cow::Borrowed(_) => None,
        };
        let mut left = left.unwrap_or(scene);
        let mesh = Mesh::build(left.take_soup(paints.as_ref()));
        Self { scene: Cow::Owned(left), warnings, paints, mesh }
    }
}

/// The part of a scene that style and texture cut-outs leave, its paints, and warnings about failed cuts.
fn visible_scene<'a>(scene: &'a Scene, style: &Style) -> (Cow<'a, Scene>, Option<Paints>, Warnings) {
    let left = glass_pass::without_absent_materials(scene, style);
    let mut paints = paints_of(&left, style);
    let cutouts::CutScene { scene, origins, warnings } = glass_pass::cut_textures(scene, &left);
    paints.iter_mut().for_each(|paints| paints.carry(&origins));
    (scene, paints, warnings)
}
