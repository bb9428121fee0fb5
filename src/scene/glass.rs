//! [`GlassOptions`]: treatment of see-through materials.

use serde::{Deserialize, Serialize};

use super::{Geometry, Material, Scene};
use crate::geometry::names::glob::Glob;
use crate::geometry::numbers::checked_number::share;

/// How see-through materials are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum GlassDraw {
    /// Like all other materials.
    #[default]
    Opaque,
    /// Left out.
    Absent,
    /// As glass: their own lines are drawn, and things behind them get thinner lines and mixed colours.
    Glass,
}

/// Treatment of see-through materials: the `[glass]` table of a style sheet.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct GlassOptions {
    /// How they are drawn. Default: opaque.
    pub draw: GlassDraw,
    /// Materials that count as glass regardless of their opacity in the file; `*` matches any text. Default:
    /// none.
    pub materials: Vec<Glob>,
    /// Opacity of these materials, 0 to 1, if the file does not give one. Default: 0.35.
    #[serde(deserialize_with = "share")]
    pub opacity: f64,
    /// Width of lines behind glass, as a fraction of their pen's width, 0 to 1. Default: 0.5.
    #[serde(deserialize_with = "share")]
    pub width: f64,
}

impl Default for GlassOptions {
    fn default() -> Self {
        Self { draw: GlassDraw::Opaque, materials: Vec::new(), opacity: 0.35, width: 0.5 }
    }
}

/// Minimum opacity of glass, so that fully transparent glass stays visible.
const MIN_GLASS_OPACITY: f64 = 0.15;

impl Material {
    /// Opacity of the material in the file, 0 to 1: alpha of its colour times the share of light that it does
    /// not transmit.
    #[must_use]
    pub fn opacity(&self) -> f64 {
        f64::from(self.colour.a) / 255.0 * (1.0 - f64::from(self.transmission))
    }
}

impl GlassOptions {
    /// Opacity of a see-through material; `None` for an opaque one.
    #[must_use]
    pub(crate) fn opacity_of(&self, material: &Material) -> Option<f64> {
        let own = material.opacity();
        if own < 1.0 {
            return Some(own.max(MIN_GLASS_OPACITY));
        }
        self.materials.iter().any(|glob| glob.matches(&material.name)).then_some(self.opacity)
    }

    /// Opacity of each see-through material of a scene, by index. Empty if there is none, or if they are
    /// drawn in another way than `draw`.
    #[must_use]
    pub(crate) fn opacities(&self, scene: &Scene, draw: GlassDraw) -> Vec<Option<f64>> {
        if self.draw != draw {
            return Vec::new();
        }
        let opacities: Vec<Option<f64>> = scene.materials.iter().map(|own| self.opacity_of(own)).collect();
        if opacities.iter().any(Option::is_some) { opacities } else { Vec::new() }
    }
}

/// Copy of a scene without the triangles of some materials.
pub(crate) fn without_materials(scene: &Scene, is_gone: impl Fn(usize) -> bool) -> Scene {
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

/// Keeps the marked items of a list that may be empty.
fn keep<T>(list: &mut Vec<T>, stays: &[bool]) {
    let mut stays = stays.iter();
    list.retain(|_| stays.next().copied().unwrap_or(true));
}
