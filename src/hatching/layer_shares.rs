//! How layers of hatching share the paper that a tone asks to be covered.

use rustc_hash::FxHashMap;

use super::context::HatchContext;
use super::lines::stroke_path;
use super::options::{HatchLayer, HatchOptions, Kind};
use super::tone;
use crate::drawing::Unit;
use crate::geometry::numbers::portable_math::{pow, tan};
use crate::regions::Ground;

/// How dense a layer is in each cell of a ground.
pub(crate) struct Shares {
    /// The part of the paper that the layer covers.
    pub covered: Vec<f64>,
    /// The covered part as a part of what the layer covers at most.
    pub density: Vec<f64>,
}

/// The part of the paper that a layer covers where `density` of its strokes are drawn.
///
/// Strokes that stray from their lines fall on each other, the more the denser they are: what strokes laid
/// down by chance would cover is 1 - exp(-x) for x times the paper of ink (Poisson).
fn covers(layer: &HatchLayer, unit: Unit, density: f64) -> f64 {
    if layer.kind != Kind::Lines || layer.swell {
        return density * MOST_COVERED;
    }
    let [pitch, width, length, gap, bow] =
        [layer.pitch(), layer.width, layer.length, layer.gap, layer.bow].map(|length| length.in_unit(unit));
    let inked = if length > 0.0 { length / (length + gap) } else { 1.0 };
    let ink = density * width * stroke_path::mean_width(layer, unit) / pitch * inked;
    let turn = length * tan(layer.turn.to_radians().min(1.0)) / 4.0;
    let astray = (STRAYS * (layer.stray + (turn + bow / 2.0) / pitch)).min(1.0) * density;
    (ink - astray * (ink - (1.0 - pow(std::f64::consts::E, -ink)))).min(MOST_COVERED)
}

/// Strokes that stray by all of their distance on average lie as by chance.
const STRAYS: f64 = 0.9;

/// The part of the paper that a layer covers at most.
pub(crate) fn fullest(layer: &HatchLayer, unit: Unit) -> f64 {
    covers(layer, unit, 1.0).max(f64::MIN_POSITIVE)
}

/// What all layers of a hatching cover together at most: tables that ask for more do not get it.
#[must_use]
pub fn most_covered(options: &HatchOptions, unit: Unit) -> f64 {
    1.0 - options.layers.iter().map(|layer| 1.0 - fullest(layer, unit)).product::<f64>()
}

/// The part of a layer's strokes that covers a part of the paper.
fn density(layer: &HatchLayer, unit: Unit, share: f64) -> f64 {
    if share <= 0.0 {
        return 0.0;
    }
    if share >= fullest(layer, unit) {
        return 1.0;
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(low, high);
        if covers(layer, unit, middle) < share { low = middle } else { high = middle }
    }
    f64::midpoint(low, high)
}

/// Bisections that find a density.
const HALVINGS: usize = 30;

/// Screens leave at least this little of the paper, so that lines stay lines.
const MOST_COVERED: f64 = 0.98;

/// How dense a layer is in each cell.
pub(crate) fn shares(
    ground: &Ground,
    context: &HatchContext,
    options: &HatchOptions,
    number: usize,
) -> Shares {
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
            tone::shares(coverage, &fullest).get(number).copied().unwrap_or_default()
        })
        .collect();
    // Few cells differ.
    let mut of = |share: f64| {
        *known.entry(share.to_bits()).or_insert_with(|| density(&options.layers[number], context.unit, share))
    };
    let density = covered.iter().map(|share| of(*share)).collect();
    Shares { covered, density }
}
