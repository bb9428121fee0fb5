//! Division of a tone's coverage among the layers of hatching.

use rustc_hash::FxHashMap;

use super::context::HatchContext;
use super::lines::stroke_path;
use super::options::{HatchKind, HatchLayer, HatchOptions};
use super::tone;
use crate::drawing::Unit;
use crate::geometry::numbers::portable_math::{pow, tan};
use crate::regions::HatchRegions;

/// Coverage and density of a layer in each cell of a ground.
pub(crate) struct LayerShares {
    /// Share of the paper that the layer covers.
    pub covered: Vec<f64>,
    /// Share of the layer's strokes that are drawn.
    pub density: Vec<f64>,
}

/// Share of the paper that a layer covers when `density` of its strokes are drawn.
///
/// Strokes that stray from their lines overlap, more so the denser they are. Strokes at random positions
/// cover 1 - exp(-x) for ink of x times the paper's area (Poisson).
fn covered_share(layer: &HatchLayer, unit: Unit, density: f64) -> f64 {
    if layer.kind != HatchKind::Lines || layer.swell {
        return density * MAX_SCREEN_COVERAGE;
    }
    let [pitch, width, length, gap, bow] =
        [layer.pitch(), layer.width, layer.length, layer.gap, layer.bow].map(|length| length.in_unit(unit));
    let inked = if length > 0.0 { length / (length + gap) } else { 1.0 };
    let ink = density * width * stroke_path::mean_width(layer, unit) / pitch * inked;
    let turn = length * tan(layer.turn.to_radians().min(1.0)) / 4.0;
    let astray = (RANDOMNESS_PER_STRAY * (layer.stray + (turn + bow / 2.0) / pitch)).min(1.0) * density;
    (ink - astray * (ink - (1.0 - pow(std::f64::consts::E, -ink)))).min(MAX_SCREEN_COVERAGE)
}

/// Randomness per unit of stray. Strokes that stray by their spacing on average count as 90 % random.
const RANDOMNESS_PER_STRAY: f64 = 0.9;

/// The greatest share of the paper that a layer covers.
pub(crate) fn fullest(layer: &HatchLayer, unit: Unit) -> f64 {
    covered_share(layer, unit, 1.0).max(f64::MIN_POSITIVE)
}

/// The greatest share of the paper that all layers cover together. Coverage tables cannot exceed it.
#[must_use]
pub(crate) fn max_coverage(options: &HatchOptions, unit: Unit) -> f64 {
    1.0 - options.layers.iter().map(|layer| 1.0 - fullest(layer, unit)).product::<f64>()
}

/// The share of a layer's strokes that covers a given share of the paper.
fn density(layer: &HatchLayer, unit: Unit, share: f64) -> f64 {
    if share <= 0.0 {
        return 0.0;
    }
    if share >= fullest(layer, unit) {
        return 1.0;
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..DENSITY_BISECTIONS {
        let middle = f64::midpoint(low, high);
        if covered_share(layer, unit, middle) < share { low = middle } else { high = middle }
    }
    f64::midpoint(low, high)
}

/// Bisections that find a density.
const DENSITY_BISECTIONS: usize = 30;

/// Greatest coverage of a screen, so that lines stay separate.
const MAX_SCREEN_COVERAGE: f64 = 0.98;

/// Coverage and density of a layer in each cell.
pub(crate) fn coverage_and_density(
    ground: &HatchRegions,
    context: &HatchContext,
    options: &HatchOptions,
    number: usize,
) -> LayerShares {
    let fullest: Vec<f64> = options.layers.iter().map(|layer| fullest(layer, context.unit)).collect();
    let mut known: FxHashMap<u64, f64> = FxHashMap::default();
    let covered: Vec<f64> = ground
        .cells
        .iter()
        .map(|cell| {
            let black = usize::from(cell.look.bin) < options.blacks;
            if cell.facet == 0 || black {
                return 0.0;
            }
            let tone = context.tones.get(cell.look.paint.index()).or(context.tones.last());
            let coverage = tone.map_or(0.0, |tone| tone.of_bin(cell.look.bin));
            tone::coverage_per_layer(coverage, &fullest).get(number).copied().unwrap_or_default()
        })
        .collect();
    // Few distinct shares occur, so densities are cached.
    let mut of = |share: f64| {
        *known.entry(share.to_bits()).or_insert_with(|| density(&options.layers[number], context.unit, share))
    };
    let density = covered.iter().map(|share| of(*share)).collect();
    LayerShares { covered, density }
}
