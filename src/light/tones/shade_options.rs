//! [`ShadeOptions`]: bins of light for a hatched surface, part of the `[hatching]` table.

use crate::colour::srgb::Colour;
use crate::geometry::names::glob::Glob;

/// Bins of light for a hatched surface.
///
/// Source: Lake, Marshall, Harris, Blackstein, Stylized rendering techniques for scalable real-time 3D
/// animation, 2000, section 3.3: the edges of the bins are free, so light and dark can be weighted against
/// each other.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ShadeOptions {
    /// Rising edges of the bins on the diffuse light, which is 0 in shadow and 1 where one light falls
    /// straight on. n edges give n + 1 bins. Default: 0.25, 0.5, 0.75.
    pub thresholds: Vec<f64>,
    /// Influence of a material's lightness on hatching: 0 = none, 1 = the light is multiplied by the
    /// lightness. Default: 0.
    pub materials_count: f64,
    /// Edges for some materials, in order.
    pub materials: Vec<(Glob, Vec<f64>)>,
}

impl Default for ShadeOptions {
    fn default() -> Self {
        Self { thresholds: vec![0.25, 0.5, 0.75], materials_count: 0.0, materials: Vec::new() }
    }
}

impl ShadeOptions {
    /// Edges of the bins for a material with this name and colour.
    #[must_use]
    pub(crate) fn levels(&self, material: &str, colour: Colour) -> Vec<f64> {
        let own = self.materials.iter().rev().find(|(name, _)| name.matches(material));
        let edges = own.map_or(&self.thresholds, |(_, edges)| edges);
        let [r, g, b] = colour.channels();
        let lightness = 0.2126 * r + 0.7152 * g + 0.0722 * b;
        let counts = 1.0 - self.materials_count * (1.0 - lightness);
        edges.iter().map(|edge| edge / counts.max(MIN_MATERIAL_LIGHT)).collect()
    }
}

/// Smallest share of the light on the blackest material, so that its shape is visible.
const MIN_MATERIAL_LIGHT: f64 = 0.05;
