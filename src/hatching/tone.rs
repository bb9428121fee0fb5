//! [`ToneCoverage`]: ink coverage by light, and its division among the layers of hatching.

/// Light bins of one material, and the coverage of each.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ToneCoverage {
    /// Rising edges between the bins.
    pub levels: Vec<f64>,
    /// Coverage of each bin, darkest first: one more than there are edges.
    pub coverage: Vec<f64>,
}

impl ToneCoverage {
    /// The tone of bins with a table of coverage, which is interpolated if its length differs from the number
    /// of bins.
    #[must_use]
    pub(crate) fn new(levels: &[f64], table: &[f64]) -> Self {
        let bins = levels.len() + 1;
        let at = |bin: usize| {
            if table.len() == bins {
                return table[bin];
            }
            let place = bin as f64 / (bins.max(2) - 1) as f64 * table.len().saturating_sub(1) as f64;
            let before = (place as usize).min(table.len().saturating_sub(1));
            let after = (before + 1).min(table.len().saturating_sub(1));
            let [from, to] = [before, after].map(|k| table.get(k).copied().unwrap_or_default());
            from + (to - from) * (place - before as f64)
        };
        Self { levels: levels.to_vec(), coverage: (0..bins).map(|bin| at(bin).clamp(0.0, 1.0)).collect() }
    }

    /// The coverage of a bin.
    #[must_use]
    pub(crate) fn of_bin(&self, bin: u16) -> f64 {
        self.coverage.get(usize::from(bin)).or(self.coverage.last()).copied().unwrap_or_default()
    }

    /// Coverage as a continuous function of light.
    ///
    /// In full shadow the darkest bin applies. At the edge of two bins the result is their mean, or 0 if one
    /// of them is blank.
    #[must_use]
    pub(crate) fn of_light(&self, light: f64) -> f64 {
        let bin = self.levels.partition_point(|level| *level <= light);
        let own = self.of_bin(bin as u16);
        if own <= 0.0 {
            return 0.0;
        }
        let edge = |below: usize| {
            let (dark, bright) = (self.of_bin(below as u16), self.of_bin(below as u16 + 1));
            if dark <= 0.0 || bright <= 0.0 { 0.0 } else { f64::midpoint(dark, bright) }
        };
        let (low, dark) = bin.checked_sub(1).map_or((0.0, own), |below| (self.levels[below], edge(below)));
        let Some(high) = self.levels.get(bin) else { return own.min(dark) };
        let way = high - low;
        let t = if way > 0.0 { ((light - low) / way).clamp(0.0, 1.0) } else { 0.0 };
        dark + (edge(bin) - dark) * t
    }
}

/// Coverage of each of several crossing layers, which together cover `coverage`.
///
/// Layers are filled in order; `fullest` holds the greatest coverage of each. Where layers cross, ink
/// overlaps: a layer covers its share of the paper that the layers before it left blank.
#[must_use]
pub(crate) fn coverage_per_layer(coverage: f64, fullest: &[f64]) -> Vec<f64> {
    let mut left = coverage.clamp(0.0, 1.0);
    let mut blank = 1.0;
    fullest
        .iter()
        .map(|most| {
            if blank <= 0.0 {
                return 0.0;
            }
            let own = (left / blank).min(*most).max(0.0);
            left -= own * blank;
            blank *= 1.0 - own;
            if left < MIN_LAYER_COVERAGE {
                left = 0.0
            }
            own
        })
        .collect()
}

/// Least coverage of a layer. A smaller remainder would be a few isolated strokes.
const MIN_LAYER_COVERAGE: f64 = 0.012;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coverage_per_layer_fills_layers_in_order() {
        assert_eq!(coverage_per_layer(0.2, &[0.25, 0.25]), [0.2, 0.0]);
        let both = coverage_per_layer(0.4, &[0.25, 0.25]);
        assert_eq!(both[0], 0.25);
        let covered = 1.0 - both.iter().map(|share| 1.0 - share).product::<f64>();
        assert!((covered - 0.4).abs() < 1e-12);
        assert_eq!(coverage_per_layer(0.9, &[0.25, 0.25]), [0.25, 0.25]);
    }

    #[test]
    fn tone_coverage_spreads_tables_over_bins() {
        let tone = ToneCoverage::new(&[0.2, 0.4, 0.6, 0.8], &[1.0, 0.0]);
        assert_eq!(tone.coverage, [1.0, 0.75, 0.5, 0.25, 0.0]);
        assert_eq!(ToneCoverage::new(&[], &[0.5, 0.0]).coverage, [0.5]);
        assert_eq!(ToneCoverage::new(&[0.5], &[]).coverage, [0.0, 0.0]);
    }

    #[test]
    fn coverage_never_rises_with_light() {
        let tone = ToneCoverage::new(&[0.2, 0.5, 0.9], &[0.7, 0.4, 0.1, 0.0]);
        let mut before = f64::INFINITY;
        for k in 0..=1000 {
            let covered = tone.of_light(f64::from(k) / 1000.0);
            assert!(covered <= before + 1e-12, "{k}");
            assert!(before.is_infinite() || before - covered < 0.01, "{k}: a jump");
            before = covered;
        }
        assert_eq!(tone.of_light(0.95), 0.0);
        assert_eq!(tone.of_light(0.0), 0.7);
    }
}
