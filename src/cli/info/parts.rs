//! [`PartInfo`]: one part of a model in the output of `ligne info`, as JSON or as a line of text: its
//! contents, bounds and coordinate precision.

use glam::DVec3;
use serde::Serialize;

use super::precision::PrecisionInfo;
use super::text_lists::named;
use crate::cli::options::values::model_unit::ModelUnit;
use crate::cli::output::number_text::{counted, short};
use crate::mesh::TurnedFaces;
use crate::scene::Scene;
use crate::scene::extent::drawn_points::DegenerateCounts;

/// Contents, bounds and precision of a part, serialised as JSON.
#[derive(Debug, Serialize)]
pub(crate) struct PartInfo {
    pub name: String,
    pub triangles: u64,
    pub wires: u64,
    /// Whether the part has texture coordinates.
    pub texture_coordinates: bool,
    /// Whether the part has vertex colours.
    pub vertex_colours: bool,
    /// Triangles whose winding was reversed when the model was read.
    pub turned: TurnedInfo,
    /// World-space bounding box; none if nothing of the part is drawn.
    pub bounds: Option<BoundsInfo>,
    #[serde(flatten)]
    pub precision: PrecisionInfo,
}

/// Bounding box of everything that is drawn, or of a part, in world space.
#[derive(Debug, Serialize)]
pub(crate) struct BoundsInfo {
    pub min: [f64; 3],
    pub max: [f64; 3],
    /// Extent along x, y and z in mm, if the unit is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub size_mm: Option<[f64; 3]>,
}

impl BoundsInfo {
    pub(crate) fn new((min, max): (DVec3, DVec3), unit: Option<ModelUnit>) -> Self {
        let size_mm = unit.map(|unit| ((max - min) * unit.mm()).to_array());
        Self { min: min.to_array(), max: max.to_array(), size_mm }
    }

    /// Size and corners as text: `20 x 12 x 8 from (0, 0, 0) to (20, 12, 8)`; `unit` follows the size.
    pub(crate) fn words(&self, unit: &str) -> String {
        let size: Vec<String> = self.min.iter().zip(self.max).map(|(low, high)| short(high - low)).collect();
        let corner = |corner: [f64; 3]| corner.map(short).join(", ");
        format!("{}{unit} from ({}) to ({})", size.join(" x "), corner(self.min), corner(self.max))
    }
}

/// Triangles that were wound inward or against their neighbours, and were reversed: their number, and the
/// number of connected surfaces they belong to.
#[derive(Debug, Clone, Copy, Default, Serialize)]
pub(crate) struct TurnedInfo {
    pub triangles: u64,
    pub surfaces: u64,
}

impl PartInfo {
    /// Describes part `number` of a scene; `None` if there is no such part.
    ///
    /// `left_out` counts the degenerate elements of the part, which are not drawn. `turned` covers all parts.
    pub(crate) fn of(
        scene: &Scene,
        number: usize,
        left_out: &DegenerateCounts,
        turned: &[TurnedFaces],
        precision: PrecisionInfo,
        bounds: Option<(DVec3, DVec3)>,
    ) -> Option<Self> {
        let part = scene.parts.get(number)?;
        let geometry = scene.geometries.get(part.geometry);
        let triangles = geometry.map_or(0, |geometry| geometry.triangles.len() as u64);
        let wires = geometry.map_or(0, |geometry| geometry.wires.len() as u64);
        let turned = turned.iter().filter(|own| own.part.index() == number);
        Some(Self {
            name: part.name.clone(),
            triangles: triangles - left_out.faces,
            wires: wires - left_out.wires,
            texture_coordinates: geometry.is_some_and(|geometry| !geometry.corner_uvs.is_empty()),
            vertex_colours: geometry.is_some_and(|geometry| !geometry.colours.is_empty()),
            turned: TurnedInfo::of(turned),
            bounds: bounds.map(|bounds| BoundsInfo::new(bounds, None)),
            precision,
        })
    }

    /// Line of the part in the text output. A full line includes bounds and precision.
    pub(crate) fn line(&self, is_full: bool) -> String {
        let lines = if self.wires > 0 { format!(", {}", counted(self.wires, "line")) } else { String::new() };
        let painted = match (self.texture_coordinates, self.vertex_colours) {
            (true, true) => ", texture coordinates, coloured vertices",
            (true, false) => ", texture coordinates",
            (false, true) => ", coloured vertices",
            (false, false) => "",
        };
        let turned = self.turned.words().map_or_else(String::new, |turned| format!(", {turned}"));
        let precision = self.precision.words().filter(|_| is_full);
        let precision = precision.map_or_else(String::new, |words| format!(", {words}"));
        let triangles = counted(self.triangles, "triangle");
        let bounds = self.bounds.as_ref().filter(|_| is_full);
        let bounds = bounds.map_or_else(String::new, |bounds| format!(", {}", bounds.words("")));
        format!("{}: {triangles}{lines}{painted}{turned}{bounds}{precision}", named(&self.name))
    }
}

impl TurnedInfo {
    /// Sums the counts of several parts.
    pub(crate) fn of<'a>(parts: impl IntoIterator<Item = &'a TurnedFaces>) -> Self {
        parts.into_iter().fold(Self::default(), |sum, own| Self {
            triangles: sum.triangles + own.faces,
            surfaces: sum.surfaces + own.surfaces,
        })
    }

    /// The counts as text; `None` if no triangle was reversed.
    pub(crate) fn words(&self) -> Option<String> {
        let Self { triangles, surfaces } = *self;
        let is_any = triangles > 0;
        is_any
            .then(|| format!("{} turned in {}", counted(triangles, "triangle"), counted(surfaces, "surface")))
    }
}
