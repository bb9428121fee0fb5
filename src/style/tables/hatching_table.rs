//! The table `[hatching]`: tone bins, ink coverage per bin, and the ink.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

use crate::drawing::Length;
use crate::geometry::names::glob::Glob;
use crate::geometry::numbers::checked_number::share;
use crate::hatching::{HatchLayer, HatchOptions};
use crate::light::ShadeOptions;
use crate::light::tones::tone_options::thresholds;
use crate::light::tones::tone_ramps::MAX_TONES;

/// The table `[hatching]`.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct HatchingTable {
    enabled: bool,
    #[serde(deserialize_with = "some_thresholds")]
    thresholds: Option<Vec<f64>>,
    #[serde(deserialize_with = "coverage")]
    coverage: Option<Vec<f64>>,
    #[serde(deserialize_with = "share")]
    materials_count: f64,
    cast_shadows: bool,
    blacks: usize,
    #[serde(deserialize_with = "some_share")]
    parting: Option<f64>,
    crumb: Option<Length>,
    layer: Vec<HatchLayer>,
    material: Vec<HatchingMaterialTable>,
}

/// A table `[[hatching.material]]`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct HatchingMaterialTable {
    name: Glob,
    #[serde(default, deserialize_with = "some_thresholds")]
    thresholds: Option<Vec<f64>>,
    #[serde(default, deserialize_with = "coverage")]
    coverage: Option<Vec<f64>>,
}

impl HatchingTable {
    /// Converts the table to options.
    pub(crate) fn into_options(self) -> (ShadeOptions, HatchOptions) {
        let shade = ShadeOptions::default();
        let hatch = HatchOptions::default();
        let materials = || self.material.iter();
        let own = |list: &Option<Vec<f64>>, name: &Glob| Some((name.clone(), list.clone()?));
        let shade = ShadeOptions {
            thresholds: self.thresholds.unwrap_or(shade.thresholds),
            materials_count: self.materials_count,
            materials: materials().filter_map(|m| own(&m.thresholds, &m.name)).collect(),
        };
        let hatch = HatchOptions {
            enabled: self.enabled,
            coverage: self.coverage.unwrap_or(hatch.coverage),
            materials: materials().filter_map(|m| own(&m.coverage, &m.name)).collect(),
            cast_shadows: self.cast_shadows,
            blacks: self.blacks,
            parting: self.parting.unwrap_or(hatch.parting),
            crumb: self.crumb.unwrap_or(hatch.crumb),
            layers: self.layer,
        };
        (shade, hatch)
    }
}

fn some_thresholds<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Vec<f64>>, D::Error> {
    thresholds(deserializer).map(Some)
}

/// Parses coverage. It must fall, because strokes of lighter bins are a subset of those of darker bins.
fn coverage<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Vec<f64>>, D::Error> {
    let list = Vec::<f64>::deserialize(deserializer)?;
    let falls = list.windows(2).all(|pair| pair[0] >= pair[1]);
    let fits = !list.is_empty() && list.len() <= MAX_TONES;
    if fits && falls && list.iter().all(|share| (0.0..=1.0).contains(share)) {
        return Ok(Some(list));
    }
    Err(D::Error::custom(
        "coverage is the share of ink in each bin, darkest first: falling numbers from 1 to 0, such as [0.6, 0.3, 0]",
    ))
}

fn some_share<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    share(deserializer).map(Some)
}
