//! [`GlassOptions`]: materials that one sees through, and what becomes of them.

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};

use super::{Geometry, Material, Scene};
use crate::geometry::names::glob::Glob;

/// What becomes of materials that one sees through.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum GlassDraw {
    /// They are drawn like all others.
    #[default]
    Opaque,
    /// They are left out.
    Absent,
    /// They have their lines, and what is behind them is drawn in thinner ones, its colours mixed with theirs.
    Glass,
}

/// What becomes of materials that one sees through: the `[glass]` table of a style sheet.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct GlassOptions {
    /// What becomes of them. Default: opaque.
    pub draw: GlassDraw,
    /// Materials that count as such whatever their file says; `*` stands for any letters. Default: none.
    pub materials: Vec<Glob>,
    /// How much of the colour of those is over what is behind them, 0 to 1, where the file does not say. Default: 0.35.
    #[serde(deserialize_with = "fraction")]
    pub opacity: f64,
    /// The part of their pen's width that lines behind glass have, 0 to 1. Default: 0.5.
    #[serde(deserialize_with = "fraction")]
    pub width: f64,
}

impl Default for GlassOptions {
    fn default() -> Self {
        Self { draw: GlassDraw::Opaque, materials: Vec::new(), opacity: 0.35, width: 0.5 }
    }
}

/// Glass that is as clear as can be has this opacity all the same, so that it is seen.
const LEAST_OPACITY: f64 = 0.15;

impl Material {
    /// How opaque the file says the material is, 0 to 1: by the alpha of its colour, and by how much light it transmits.
    #[must_use]
    pub fn opacity(&self) -> f64 {
        f64::from(self.colour.a) / 255.0 * (1.0 - f64::from(self.transmission))
    }
}

impl GlassOptions {
    /// How opaque a material is that one sees through; none if one does not.
    #[must_use]
    pub fn opacity_of(&self, material: &Material) -> Option<f64> {
        let own = material.opacity();
        if own < 1.0 {
            return Some(own.max(LEAST_OPACITY));
        }
        self.materials.iter().any(|glob| glob.matches(&material.name)).then_some(self.opacity)
    }

    /// How opaque the materials of a scene are that one sees through, by their index; empty if one sees through none, or they are
    /// not to be drawn as `draw` says.
    #[must_use]
    pub fn opacities(&self, scene: &Scene, draw: GlassDraw) -> Vec<Option<f64>> {
        if self.draw != draw {
            return Vec::new();
        }
        let opacities: Vec<Option<f64>> = scene.materials.iter().map(|own| self.opacity_of(own)).collect();
        if opacities.iter().any(Option::is_some) { opacities } else { Vec::new() }
    }
}

/// A scene without the triangles of some materials.
pub(crate) fn without(scene: &Scene, is_gone: impl Fn(usize) -> bool) -> Scene {
    let mut left = scene.clone();
    for geometry in &mut left.geometries {
        let stays: Vec<bool> = (0..geometry.triangles.len())
            .map(|triangle| !geometry.material_of(triangle).is_some_and(|id| is_gone(id as usize)))
            .collect();
        if stays.iter().all(|stays| *stays) {
            continue;
        }
        let Geometry { triangles, triangle_material, corner_normals, corner_uvs, edge_marks, .. } = geometry;
        keep(triangles, &stays);
        keep(triangle_material, &stays);
        keep(corner_normals, &stays);
        keep(corner_uvs, &stays);
        keep(edge_marks, &stays);
    }
    left
}

/// Keeps what stays of a list; one may be empty.
fn keep<T>(list: &mut Vec<T>, stays: &[bool]) {
    let mut stays = stays.iter();
    list.retain(|_| stays.next().copied().unwrap_or(true));
}

fn fraction<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    let value = f64::deserialize(deserializer)?;
    if (0.0..=1.0).contains(&value) {
        Ok(value)
    } else {
        Err(D::Error::custom(format!("{value} is not a share; write a number from 0 to 1")))
    }
}
