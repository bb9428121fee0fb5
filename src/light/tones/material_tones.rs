//! [`Tones`]: the levels and colours of one material.
//!
//! Source: Lake, Marshall, Harris, Blackstein, Stylized rendering techniques for scalable real-time 3D
//! animation, 2000, eq. 1 and section 3.
//!
//! Colours are computed in channels as written (sRGB), as on the hardware of the paper. Deviation: the
//! ambient coefficient of the light is a colour, slightly cooler than white by default, so that shadows are
//! cooler than lit surfaces.

use super::tone_options::{Colours, Gooch, Highlight, ToneOptions, ToneScale};
use super::tone_ramps::Table;
use crate::colour::colour_factor::ColourFactor;
use crate::colour::srgb::Colour;
use crate::light::lights::lighting::LampFilter;
use crate::scene::material::Gloss;

/// Smallest value of the largest channel of a material in toned colours. On darker ones, neither tones nor
/// lines could be distinguished.
const MIN_LIT_CHANNEL: f64 = 0.19;

/// Quantity in a channel of a drawing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ToneChannel {
    /// Diffuse light of all lights.
    Diffuse,
    /// Diffuse light of one light, by its index.
    Light(usize),
    /// Diffuse light of the lights of one tint, by its index.
    Hue(usize),
    /// Strength of the highlight.
    Highlight,
    /// Diffuse light of all lights again, with the bins of hatching as levels.
    Shade,
}

impl ToneChannel {
    /// The lights whose diffuse light it holds; `None` for highlights.
    pub(crate) fn lamps(self) -> Option<LampFilter> {
        match self {
            Self::Diffuse | Self::Shade => Some(LampFilter::All),
            Self::Light(index) => Some(LampFilter::Lamp(index)),
            Self::Hue(index) => Some(LampFilter::Hue(index)),
            Self::Highlight => None,
        }
    }
}

/// Properties of a surface and its light that determine the colours of tones.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ToneSurface<'a> {
    /// Base colour.
    pub colour: Colour,
    /// Emitted light; no tone is darker.
    pub emissive: Colour,
    /// Light from all directions.
    pub ambient: ColourFactor,
    /// Tint of all lights together.
    pub tint: [f64; 3],
    /// Gloss of the material, if the file has one.
    pub gloss: Option<Gloss>,
    /// Tint of each light, if tones are computed separately.
    pub hues: &'a [[f64; 3]],
}

/// Levels and colours of one material.
#[derive(Debug, Clone)]
pub(crate) struct Tones {
    /// Rising levels of each channel; none where the material does not use it.
    levels: Vec<Vec<f64>>,
    /// Colours of the tones, those of highlights last.
    colours: Vec<Colour>,
    /// Number of colours that are not highlights, at least 1.
    plain: usize,
    /// Exponent of the highlights.
    pub exponent: f64,
    /// Table of tones, indexed by two channels.
    table: Option<Table>,
    /// Mixture of lights, where they have several tints.
    mixture: Option<HueMixture>,
}

impl Tones {
    /// Tones of a material, with levels for these channels.
    pub(crate) fn new(options: &ToneOptions, surface: &ToneSurface, channels: &[ToneChannel]) -> Self {
        let mixture = HueMixture::of(options, surface.hues);
        let mut colours = match &mixture {
            Some(mixture) => {
                mixture.shares.iter().map(|shares| lake(options, surface, *shares, true)).collect()
            }
            None => plain_colours(options, surface),
        };
        let plain = colours.len();
        let highlight = options.highlight.of(surface.gloss);
        if let (Some(highlight), Some(brightest)) = (&highlight, colours.last().copied()) {
            colours.extend(highlight_colours(highlight, brightest));
        }
        let table = match &options.scale {
            ToneScale::Table(table) => Some(table.clone()),
            _ => None,
        };
        let levels = channels.iter().map(|channel| match (channel, &table) {
            (ToneChannel::Diffuse, None) if mixture.is_none() => diffuse_levels(&options.scale),
            (ToneChannel::Hue(_), None) if mixture.is_some() => diffuse_levels(&options.scale),
            (ToneChannel::Light(0), Some(table)) => table.columns.clone(),
            (ToneChannel::Light(1), Some(table)) => table.rows.clone(),
            (ToneChannel::Highlight, _) => highlight.as_ref().map_or(Vec::new(), highlight_levels),
            _ => Vec::new(),
        });
        let levels = levels.collect();
        let exponent = highlight.as_ref().unwrap_or(&options.highlight).exponent;
        Self { levels, colours, plain, exponent, table, mixture }
    }

    /// Adds the levels of one more channel.
    pub(crate) fn add_levels(&mut self, levels: Vec<f64>) {
        self.levels.push(levels);
    }

    /// Rising levels of a channel.
    pub(crate) fn levels(&self, channel: usize) -> &[f64] {
        self.levels.get(channel).map_or(&[], Vec::as_slice)
    }

    /// Tone of a point, from the number of levels that it reaches in each channel.
    pub(crate) fn tone(&self, channels: &[ToneChannel], bands: &[u16]) -> u16 {
        let band = |wanted: ToneChannel| {
            let index = channels.iter().position(|channel| *channel == wanted);
            index.and_then(|index| bands.get(index)).copied().unwrap_or_default()
        };
        let last = |count: usize| count.saturating_sub(1) as u16;
        match (band(ToneChannel::Highlight), &self.table) {
            (0, Some(table)) => table.tone(band(ToneChannel::Light(0)), band(ToneChannel::Light(1))),
            (0, None) => match &self.mixture {
                Some(mixture) => mixture.tone(|hue| band(ToneChannel::Hue(hue))),
                None => band(ToneChannel::Diffuse).min(last(self.plain)),
            },
            (highlight, _) => last(self.plain).saturating_add(highlight).min(last(self.colours.len())),
        }
    }

    /// Number of tones, including highlights.
    pub(crate) fn count(&self) -> u16 {
        self.colours.len() as u16
    }

    /// Number of shades that the tones without highlights run through: steps of 1/255 in the channel that
    /// changes most.
    pub(crate) fn shades(&self) -> usize {
        let plain = &self.colours[..self.plain.min(self.colours.len())];
        let total_change = |channel: fn(&Colour) -> u8| -> usize {
            plain.windows(2).map(|pair| usize::from(channel(&pair[0]).abs_diff(channel(&pair[1])))).sum()
        };
        total_change(|c| c.r).max(total_change(|c| c.g)).max(total_change(|c| c.b))
    }

    /// Colour of a tone; the last one for an index out of range.
    pub(crate) fn colour(&self, tone: u16) -> Colour {
        let colour = self.colours.get(usize::from(tone)).or(self.colours.last());
        colour.copied().unwrap_or(Colour::WHITE)
    }
}

fn diffuse_levels(scale: &ToneScale) -> Vec<f64> {
    match scale {
        ToneScale::Thresholds(thresholds) => thresholds.clone(),
        ToneScale::Steps(steps) => (1..*steps).map(|k| k as f64 / *steps as f64).collect(),
        ToneScale::Ramp(strip) => strip.levels.clone(),
        ToneScale::Table(_) => Vec::new(),
    }
}

/// Colours of the tones that are not highlights, darkest first.
fn plain_colours(options: &ToneOptions, surface: &ToneSurface) -> Vec<Colour> {
    let modulated_colours = |colours: &[Colour], modulate: f64| -> Vec<Colour> {
        colours
            .iter()
            .map(|&colour| if modulate > 0.0 { modulated(colour, modulate, surface) } else { colour })
            .collect()
    };
    let count = match &options.scale {
        ToneScale::Ramp(strip) => return modulated_colours(&strip.colours, options.modulate.unwrap_or(0.0)),
        ToneScale::Table(table) => return modulated_colours(&table.colours, options.modulate.unwrap_or(1.5)),
        scale => diffuse_levels(scale).len() + 1,
    };
    let even = [0.0, 1.0];
    let shares = if options.tones.is_empty() { &even[..] } else { &options.tones };
    let share = |k: usize| spread(shares, k, count, |a, b, t| a + (b - a) * t).unwrap_or(1.0);
    let colours = (0..count).map(|k| match &options.colours {
        Colours::Material => lake(options, surface, surface.tint.map(|c| c * share(k)), count > 1),
        Colours::Palette(palette) => {
            spread(palette, k, count, |a, b, t| a.mix(b, t)).unwrap_or(Colour::WHITE)
        }
        Colours::Gooch(gooch) => cool_to_warm(gooch, surface, share(k)),
    });
    let colours: Vec<Colour> = colours.collect();
    match options.colours {
        Colours::Palette(_) => modulated_colours(&colours, options.modulate.unwrap_or(0.0)),
        _ => colours,
    }
}

/// Lake's eq. 1 with tinted shares in place of max(L·n, 0). It adds the ambient light of the scene and of the
/// light to the diffuse share of the light, all times the material.
fn lake(options: &ToneOptions, surface: &ToneSurface, shares: [f64; 3], toned: bool) -> Colour {
    let mut material = surface.colour.channels();
    let greatest = material.into_iter().fold(0.0, f64::max);
    if toned && greatest < MIN_LIT_CHANNEL {
        material = material.map(|channel| channel + MIN_LIT_CHANNEL - greatest);
    }
    let (a_g, a_l, lit) = (surface.ambient.0, options.shadow.0, options.lit.0);
    let emitted = surface.emissive.channels();
    let channel =
        |c: usize| ((a_g[c] + a_l[c] + shares[c] * (lit[c] - a_l[c])) * material[c]).max(emitted[c]);
    Colour { a: surface.colour.a, ..Colour::from_channels([0, 1, 2].map(channel)) }
}

/// Mixture of lights of several tints. Each light falls into its own tones, and each combination of these is
/// a tone.
///
/// Source: Ishaya 2003, the table of two lights, here for any number of tints.
#[derive(Debug, Clone)]
struct HueMixture {
    /// Number of tones of each tint.
    count: usize,
    /// Tinted light of each tone, the darkest first.
    shares: Vec<[f64; 3]>,
    /// Tone of each combination; the first tint is the lowest digit of its index, in base `count`.
    order: Vec<u16>,
}

/// Largest number of tones from mixed lights. A gradient uses the mean tint instead.
const MAX_MIXED_TONES: usize = 64;

impl HueMixture {
    /// Mixture of lights of these tints; `None` where their mean is used.
    fn of(options: &ToneOptions, hues: &[[f64; 3]]) -> Option<Self> {
        if hues.len() < 2 || !matches!(options.colours, Colours::Material) {
            return None;
        }
        let count = match &options.scale {
            ToneScale::Thresholds(_) | ToneScale::Steps(_) => diffuse_levels(&options.scale).len() + 1,
            ToneScale::Ramp(_) | ToneScale::Table(_) => return None,
        };
        let all = count.checked_pow(hues.len() as u32).filter(|all| (2..=MAX_MIXED_TONES).contains(all))?;
        let even = [0.0, 1.0];
        let shares = if options.tones.is_empty() { &even[..] } else { &options.tones };
        let share = |k: usize| spread(shares, k, count, |a, b, t| a + (b - a) * t).unwrap_or(1.0);
        let brightest = share(count - 1).max(1.0);
        let light_of = |mut set: usize| {
            let mut light = [0.0; 3];
            for hue in hues {
                let share = share(set % count);
                light.iter_mut().zip(hue).for_each(|(light, c)| *light = (*light + c * share).min(brightest));
                set /= count;
            }
            light
        };
        let luma = |[r, g, b]: [f64; 3]| 0.2126 * r + 0.7152 * g + 0.0722 * b;
        let lights: Vec<[f64; 3]> = (0..all).map(light_of).collect();
        let mut ranked: Vec<usize> = (0..all).collect();
        ranked.sort_by(|a, b| luma(lights[*a]).total_cmp(&luma(lights[*b])));
        let mut order = vec![0; all];
        ranked.iter().enumerate().for_each(|(tone, set)| order[*set] = tone as u16);
        Some(Self { count, shares: ranked.iter().map(|set| lights[*set]).collect(), order })
    }

    /// Tone for the number of levels that each light reaches.
    fn tone(&self, band: impl Fn(usize) -> u16) -> u16 {
        let (mut set, mut worth, mut hue) = (0, 1, 0);
        while worth < self.order.len() {
            set += usize::from(band(hue)).min(self.count - 1) * worth;
            worth *= self.count;
            hue += 1;
        }
        self.order[set]
    }
}

/// Gooch's blend of k_cool = k_blue + α k_d and k_warm = k_yellow + β k_d.
fn cool_to_warm(gooch: &Gooch, surface: &ToneSurface, share: f64) -> Colour {
    let (cool, warm, material) = (gooch.cool.channels(), gooch.warm.channels(), surface.colour.channels());
    let channel = |c: usize| {
        let k_cool = (cool[c] + gooch.cool_share * material[c]).min(1.0);
        let k_warm = (warm[c] + gooch.warm_share * material[c]).min(1.0);
        k_cool + (k_warm - k_cool) * share
    };
    Colour { a: surface.colour.a, ..Colour::from_channels([0, 1, 2].map(channel)) }
}

/// Colour of a ramp times the material and the lights' tint, multiplied by a factor and cut off at 1.
fn modulated(colour: Colour, factor: f64, surface: &ToneSurface) -> Colour {
    let (shade, material) = (colour.channels(), surface.colour.channels());
    let channels = [0, 1, 2].map(|c| factor * shade[c] * material[c] * surface.tint[c]);
    Colour { a: surface.colour.a.min(colour.a), ..Colour::from_channels(channels) }
}

/// Rising strengths where highlights begin or change.
fn highlight_levels(highlight: &Highlight) -> Vec<f64> {
    highlight.ramp.as_ref().map_or_else(|| highlight.thresholds.clone(), |strip| strip.levels.clone())
}

/// Colours of highlights, weakest first.
fn highlight_colours(highlight: &Highlight, brightest: Colour) -> Vec<Colour> {
    if let Some(strip) = &highlight.ramp {
        let (below, a) = (brightest.channels(), brightest.a);
        let added = |light: &Colour| {
            let light = light.channels();
            Colour { a, ..Colour::from_channels([0, 1, 2].map(|c| (below[c] + light[c]).min(1.0))) }
        };
        return strip.colours.iter().skip(1).map(added).collect();
    }
    let count = highlight.thresholds.len();
    let of = |k: usize| brightest.mix(highlight.colour, highlight.strength * k as f64 / count as f64);
    (1..=count).map(of).collect()
}

/// The k-th of `count` values spread evenly over a list, ends included; a single value is the last of the
/// list.
fn spread<T: Copy>(list: &[T], k: usize, count: usize, mix: impl Fn(T, T, f64) -> T) -> Option<T> {
    let last = list.len().checked_sub(1)?;
    if count <= 1 {
        return list.last().copied();
    }
    let at = (k * last) as f64 / (count - 1) as f64;
    let below = (at as usize).min(last);
    let (a, b) = (*list.get(below)?, *list.get((below + 1).min(last))?);
    Some(mix(a, b, at - below as f64))
}
