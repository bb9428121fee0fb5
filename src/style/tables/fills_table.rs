//! The table `[fills]`: tones and their colours, and how regions are merged and painted.
//!
//! Tones come from one of `thresholds`, `steps`, `ramp` and `table`; colours from one of `palette`, `gooch`,
//! `ramp` and `table`. If a sheet sets one of a group, it replaces the others of the sheet it extends.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

use super::highlight_table::{HighlightRule, HighlightTable};
use super::ramp_source::{RampSource, TableSource};
use crate::colour::colour_factor::ColourFactor;
use crate::colour::srgb::Colour;
use crate::drawing::Length;
use crate::error::Error;
use crate::geometry::names::glob::Glob;
use crate::hatching::Pattern;
use crate::light::ToneOptions;
use crate::light::tones::tone_options::{Colours, Gooch, MaterialChange, ToneScale, thresholds};
use crate::light::tones::tone_ramps::MAX_TONES;
use crate::regions::{RegionOptions, Seams, StepsAs};
use crate::scene::{TextureFill, TextureOptions};
use crate::style::files::tile_file::read_tile;

/// The table `[fills]`.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct FillsTable {
    enabled: bool,
    #[serde(deserialize_with = "some_thresholds")]
    thresholds: Option<Vec<f64>>,
    #[serde(deserialize_with = "steps")]
    steps: Option<usize>,
    ramp: Option<RampSource>,
    table: Option<TableSource>,
    #[serde(deserialize_with = "palette")]
    palette: Option<Vec<Colour>>,
    gooch: Gooch,
    #[serde(deserialize_with = "tones")]
    tones: Option<Vec<f64>>,
    shadow: Option<ColourFactor>,
    lit: Option<ColourFactor>,
    #[serde(deserialize_with = "modulate")]
    modulate: Option<f64>,
    highlight: HighlightTable,
    cast_shadows: bool,
    steps_as: Option<StepsAs>,
    seams: Option<Seams>,
    underlap: Option<Length>,
    crumb: Option<Length>,
    fit_tolerance: Option<Length>,
    texture: Option<TextureFill>,
    #[serde(alias = "texture_colors", deserialize_with = "texture_colours")]
    texture_colours: Option<usize>,
    #[serde(deserialize_with = "texture_samples")]
    texture_samples: Option<f64>,
    material: Vec<FillsMaterialTable>,
    pattern: Vec<Pattern>,
}

/// A table `[[fills.material]]`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct FillsMaterialTable {
    name: Glob,
    #[serde(alias = "color")]
    colour: Option<Colour>,
    #[serde(default, deserialize_with = "some_thresholds")]
    thresholds: Option<Vec<f64>>,
    #[serde(default, deserialize_with = "steps")]
    steps: Option<usize>,
    ramp: Option<RampSource>,
    table: Option<TableSource>,
    #[serde(default, deserialize_with = "palette")]
    palette: Option<Vec<Colour>>,
    gooch: Option<Gooch>,
    #[serde(default, deserialize_with = "tones")]
    tones: Option<Vec<f64>>,
    shadow: Option<ColourFactor>,
    lit: Option<ColourFactor>,
    #[serde(default, deserialize_with = "modulate")]
    modulate: Option<f64>,
    highlight: Option<HighlightRule>,
}

impl FillsTable {
    /// Reads the pictures of ramps and tables.
    pub(crate) fn read_pictures(&mut self) -> Result<(), Error> {
        self.highlight.read_pictures()?;
        let own = self.material.iter_mut().filter_map(|material| material.highlight.as_mut());
        own.into_iter().try_for_each(HighlightRule::read_pictures)?;
        let own = (&mut self.ramp, &mut self.table);
        let materials = self.material.iter_mut().map(|material| (&mut material.ramp, &mut material.table));
        for (ramp, table) in std::iter::once(own).chain(materials) {
            if let Some(ramp) = ramp {
                ramp.read()?;
            }
            if let Some(table) = table {
                table.read()?;
            }
        }
        Ok(())
    }

    /// Reads the tiles of patterns.
    pub(crate) fn read_tiles(&mut self) -> Result<(), Error> {
        self.pattern.iter_mut().try_for_each(read_tile)
    }

    /// Converts the table to options.
    pub(crate) fn into_options(self) -> (ToneOptions, RegionOptions, TextureOptions, Vec<Pattern>) {
        let tones = ToneOptions::default();
        let region = RegionOptions::default();
        let gooch = Some(self.gooch).filter(|gooch| gooch.enabled);
        let tones = ToneOptions {
            scale: scale(self.thresholds, self.steps, self.ramp, self.table).unwrap_or(tones.scale),
            colours: colours(gooch, self.palette).unwrap_or(tones.colours),
            tones: self.tones.unwrap_or(tones.tones),
            shadow: self.shadow.unwrap_or(tones.shadow),
            lit: self.lit.unwrap_or(tones.lit),
            modulate: self.modulate.or(tones.modulate),
            highlight: self.highlight.into_options(),
            cast_shadows: self.cast_shadows,
            materials: self.material.into_iter().map(FillsMaterialTable::into_change).collect(),
        };
        let region = RegionOptions {
            enabled: self.enabled,
            steps_as: self.steps_as.unwrap_or(region.steps_as),
            seams: self.seams.unwrap_or(region.seams),
            underlap: self.underlap.unwrap_or(region.underlap),
            crumb: self.crumb.unwrap_or(region.crumb),
            fit_tolerance: self.fit_tolerance.unwrap_or(region.fit_tolerance),
        };
        let textures = TextureOptions::default();
        let textures = TextureOptions {
            fill: self.texture.unwrap_or(textures.fill),
            colours: self.texture_colours.unwrap_or(textures.colours),
            samples: self.texture_samples.unwrap_or(textures.samples),
        };
        (tones, region, textures, self.pattern)
    }
}

impl FillsMaterialTable {
    fn into_change(self) -> MaterialChange {
        let off = self.gooch.filter(|gooch| !gooch.enabled).map(|_| Colours::Material);
        let gooch = self.gooch.filter(|gooch| gooch.enabled);
        MaterialChange {
            name: self.name,
            colour: self.colour,
            scale: scale(self.thresholds, self.steps, self.ramp, self.table),
            colours: colours(gooch, self.palette).or(off),
            tones: self.tones,
            shadow: self.shadow,
            lit: self.lit,
            modulate: self.modulate,
            highlight: self.highlight.map(HighlightRule::into_change).unwrap_or_default(),
        }
    }
}

/// The scale of tones; the more specific one if there are two.
fn scale(
    thresholds: Option<Vec<f64>>,
    steps: Option<usize>,
    ramp: Option<RampSource>,
    table: Option<TableSource>,
) -> Option<ToneScale> {
    let table = table.and_then(TableSource::into_table).map(ToneScale::Table);
    let ramp = ramp.and_then(RampSource::into_strip).map(ToneScale::Ramp);
    table.or(ramp).or(steps.map(ToneScale::Steps)).or(thresholds.map(ToneScale::Thresholds))
}

fn colours(gooch: Option<Gooch>, palette: Option<Vec<Colour>>) -> Option<Colours> {
    gooch.map(Colours::Gooch).or(palette.map(Colours::Palette))
}

/// Groups of keys that exclude each other: for tones, and for their colours.
const EXCLUSIVE_KEYS: [&[&str]; 2] =
    [&["thresholds", "steps", "ramp", "table"], &["palette", "gooch", "ramp", "table"]];

/// Removes the keys of a table `[fills]` that another table on top of it replaces. For example, thresholds
/// replace steps, and a palette replaces a ramp.
pub(crate) fn remove_replaced_keys(below: &mut toml::Table, above: &toml::Table) {
    let is_used = |key: &str| match above.get(key) {
        // A table of Gooch colours that is switched off sets no colours.
        Some(toml::Value::Table(gooch)) if key == "gooch" => {
            gooch.get("enabled").and_then(toml::Value::as_bool) != Some(false)
        }
        value => value.is_some(),
    };
    for ways in EXCLUSIVE_KEYS {
        if ways.iter().any(|way| is_used(way)) {
            below.retain(|key, _| !ways.contains(&key) || above.contains_key(key));
        }
    }
}

fn some_thresholds<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Vec<f64>>, D::Error> {
    thresholds(deserializer).map(Some)
}

fn steps<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<usize>, D::Error> {
    let steps = u64::deserialize(deserializer)?;
    if (1..=MAX_TONES as u64).contains(&steps) {
        return Ok(Some(steps as usize));
    }
    Err(D::Error::custom(format!(
        "{steps} is not a number of tones; write a whole number from 1 to {MAX_TONES}"
    )))
}

fn texture_colours<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<usize>, D::Error> {
    let count = u64::deserialize(deserializer)?;
    if (1..=MAX_TEXTURE_COLOURS).contains(&count) {
        return Ok(Some(count as usize));
    }
    Err(D::Error::custom(format!(
        "{count} is not a number of colours; write a whole number from 1 to {MAX_TEXTURE_COLOURS}"
    )))
}

fn texture_samples<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    let samples = f64::deserialize(deserializer)?;
    if (0.1..=8.0).contains(&samples) {
        return Ok(Some(samples));
    }
    Err(D::Error::custom(format!("{samples} is not a number of texels a px; write a number from 0.1 to 8")))
}

/// Maximum number of texture colours.
const MAX_TEXTURE_COLOURS: u64 = 64;

fn palette<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Vec<Colour>>, D::Error> {
    let list = Vec::<Colour>::deserialize(deserializer)?;
    if list.is_empty() || list.len() > MAX_TONES {
        return Err(D::Error::custom(
            "a palette has a colour for each tone; write such as [\"#334\", \"#eee\"]",
        ));
    }
    Ok(Some(list))
}

fn tones<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Vec<f64>>, D::Error> {
    let list = Vec::<f64>::deserialize(deserializer)?;
    if list.iter().all(|share| (0.0..=2.0).contains(share)) && list.len() <= MAX_TONES {
        return Ok(Some(list));
    }
    Err(D::Error::custom("tones are shares of light; write numbers from 0 to 2, such as [0, 0.4, 1]"))
}

fn modulate<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    let factor = f64::deserialize(deserializer)?;
    if (0.0..=10.0).contains(&factor) {
        return Ok(Some(factor));
    }
    Err(D::Error::custom(format!("{factor} is not a factor of colours; write a number from 0 to 10")))
}
