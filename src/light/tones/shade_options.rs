//! Into how many bins of light a hatched surface falls: part of the `[hatching]` table.

use crate::colour::srgb::Colour;
use crate::geometry::names::glob::Glob;

/// Into which bins of light a hatched surface falls.
///
/// Source: Lake, Marshall, Harris, Blackstein, Stylized rendering techniques for scalable real-time 3D
/// animation, 2000, section 3.3: edges of the bins are free, so that light and dark can be weighed
/// against each other.
#[derive(Debug, Clone, PartialEq)]
pub struct ShadeOptions {
    /// Rising edges of the bins on the diffuse light, which is 0 in the shadow and 1 where one light falls
    /// straight on; n edges part n + 1 bins. Default: 0.25, 0.5, 0.75.
    pub thresholds: Vec<f64>,
    /// How much a dark material is hatched more than a light one: 0 = alike, 1 = the light counts times
    /// the material's lightness. Default: 0.
    pub materials_count: f64,
    /// Edges of their own for some materials, in order.
    pub materials: Vec<(Glob, Vec<f64>)>,
}

impl Default for ShadeOptions {
    fn default() -> Self {
        Self { thresholds: vec![0.25, 0.5, 0.75], materials_count: 0.0, materials: Vec::new() }
    }
}

impl ShadeOptions {
    /// The edges of the bins for a material of this name, painted in a colour.
    #[must_use]
    pub fn levels(&self, material: &str, colour: Colour) -> Vec<f64> {
        let own = self.materials.iter().rev().find(|(name, _)| name.matches(material));
        let edges = own.map_or(&self.thresholds, |(_, edges)| edges);
        let [r, g, b] = colour.channels();
        let lightness = 0.2126 * r + 0.7152 * g + 0.0722 * b;
        let counts = 1.0 - self.materials_count * (1.0 - lightness);
        edges.iter().map(|edge| edge / counts.max(LEAST_LIGHT)).collect()
    }
}

/// The blackest material still takes this part of the light, so that its shape is seen.
const LEAST_LIGHT: f64 = 0.05;
