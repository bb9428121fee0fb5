//! [`PrecisionInfo`]: precision of the coordinates of a part.
//!
//! The mesh stores the step and the rounding that tolerances derive from, shared by the parts of a body. The
//! step is the larger of two: the step of single precision, and the coarsest lattice of the body in world
//! space. The larger one is reported as the source.

use serde::Serialize;

use crate::cli::output::number_text::three_digits;
use crate::mesh::components::bodies::body_of;
use crate::mesh::{Mesh, PartId, PartMetrics};
use crate::scene::Scene;
use crate::scene::triangle_soup::longest_axis;

/// Precision of the coordinates of a part in world space.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(crate) struct PrecisionInfo {
    /// Distance between neighbouring coordinates, model units. 0 if coordinates are exact, none if nothing is
    /// drawn.
    step: Option<f64>,
    /// Source of the step; none if the step is 0.
    step_from: Option<StepSource>,
    /// Maximum displacement of a vertex by rounding, model units. 0 if coordinates count as exact.
    rounding: Option<f64>,
}

/// Source of a coordinate step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
enum StepSource {
    /// Last decimal of the numbers in the file.
    Decimals,
    /// Single-precision numbers.
    SinglePrecision,
    /// Integers of a quantised accessor.
    Quantisation,
}

/// Precision of each part of a scene, from its mesh.
pub(crate) fn by_part(scene: &Scene, mesh: &Mesh) -> Vec<PrecisionInfo> {
    let body = |part: usize| body_of(&mesh.bodies, PartId::from(part)).index();
    // Coarsest lattice step of each body, world units.
    let mut lattices = vec![0.0_f64; scene.parts.len()];
    for (number, part) in scene.parts.iter().enumerate() {
        let Some(geometry) = scene.geometry_of(part) else { continue };
        if let Some(lattice) = lattices.get_mut(body(number)) {
            *lattice = lattice.max(geometry.lattice_step * longest_axis(&part.world_from_part));
        }
    }
    let lattice_source = if scene.format == "glTF" { StepSource::Quantisation } else { StepSource::Decimals };
    let of_part = |part: usize| {
        let lattice = lattices.get(body(part)).copied().unwrap_or_default();
        PrecisionInfo::of(mesh.extents.part(PartId::from(part)), lattice, lattice_source)
    };
    (0..scene.parts.len()).map(of_part).collect()
}

impl PrecisionInfo {
    fn of(extent: &PartMetrics, lattice: f64, lattice_source: StepSource) -> Self {
        let is_drawn = extent.low.x <= extent.high.x;
        let source = if lattice >= extent.step { lattice_source } else { StepSource::SinglePrecision };
        Self {
            step: is_drawn.then_some(extent.step),
            step_from: (is_drawn && extent.step > 0.0).then_some(source),
            rounding: is_drawn.then_some(extent.rounding),
        }
    }

    /// The step, its source and the rounding as text; none for a part that is not drawn.
    pub(crate) fn words(&self) -> Option<String> {
        let (step, rounding) = (self.step?, self.rounding?);
        let Some(source) = self.step_from else { return Some("exact coordinates".to_owned()) };
        let source = match source {
            StepSource::Decimals => "decimals of the file",
            StepSource::SinglePrecision => "single precision",
            StepSource::Quantisation => "quantisation",
        };
        Some(format!("step {} ({source}), rounding {}", three_digits(step), three_digits(rounding)))
    }
}
