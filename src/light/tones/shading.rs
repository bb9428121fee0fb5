//! [`Shading`]: the lighting of a view, and the tones of its surface.

use glam::DVec3;

use super::material_tones::{ToneChannel, ToneSurface, Tones};
use super::tone_options::{ToneOptions, ToneScale};
use crate::colour::srgb::Colour;
use crate::light::lights::light_options::LightOptions;
use crate::light::lights::lighting::{Caster, Lighting, SurfacePoint};
use crate::light::{LightSlope, ShadeOptions};
use crate::mesh::{Mesh, PaintId};
use crate::scene::{Material, MaterialPaint, Scene};
use crate::view::Frame;

/// Lighting of a view, and the tones of its surface.
///
/// The appearance of a point follows from *channels*: numbers that vary over the surface, such as diffuse
/// light or the strength of a highlight. Each channel has rising levels, where the tone may change.
///
/// The channels are, in this order:
/// - the diffuse light of all lights (channel 0);
/// - if a material uses a table of two lights: the light of the first and of the second light alone;
/// - if lights have several tints: the light of each tint;
/// - if a material has highlights: their strength;
/// - if surfaces are hatched: the diffuse light again, with the bins of hatching as its levels.
#[derive(Debug, Clone)]
pub(crate) struct Shading {
    lighting: Lighting,
    channels: Vec<ToneChannel>,
    /// Tones of each paint.
    // The last entry stands for unknown paints.
    tones: Vec<Tones>,
}

impl Shading {
    /// Creates the shading of a scene for a camera. If `paints` is empty, each material is a paint. Problems
    /// with lights and options are reported in `warnings`.
    #[must_use]
    pub(crate) fn new(
        scene: &Scene,
        paints: &[MaterialPaint],
        mesh: &Mesh,
        frame: &Frame,
        light: &LightOptions,
        tones: &ToneOptions,
        warnings: &mut Vec<String>,
    ) -> Self {
        let lighting = Lighting::new(scene, mesh, frame, light, tones.cast_shadows, warnings);
        let without = Material::default();
        let mut materials: Vec<(ToneOptions, &Material, Option<Colour>)> = scene
            .materials
            .iter()
            .chain([&without])
            .map(|material| {
                let (material_tones, colour) = tones.for_material(&material.name);
                (material_tones, material, colour)
            })
            .collect();

        let mut channels = vec![ToneChannel::Diffuse];
        if materials.iter().any(|(own, ..)| matches!(own.scale, ToneScale::Table(_))) {
            channels.extend([ToneChannel::Light(0), ToneChannel::Light(1)]);
            if lighting.count() < 2 {
                warnings.push("a table of tones is for two lights, but there is one".to_owned());
            }
        }
        let hues = if (2..=MAX_HUES).contains(&lighting.hues().len()) { lighting.hues() } else { &[] };
        channels.extend((0..hues.len()).map(ToneChannel::Hue));
        if materials.iter().any(|(own, ..)| own.highlight.enabled) {
            channels.push(ToneChannel::Highlight);
        }
        let tint = lighting.tint();
        let tones_of = |materials: &[(ToneOptions, &Material, Option<Colour>)]| -> Vec<Tones> {
            let of = |index: usize, colour: Option<Colour>| {
                let (paint_tones, material, instead) = materials.get(index).or(materials.last())?;
                let colour = instead.or(colour).unwrap_or(material.colour);
                let Material { emissive, gloss, .. } = **material;
                let surface = ToneSurface { colour, emissive, ambient: light.ambient, tint, gloss, hues };
                Some(Tones::new(paint_tones, &surface, &channels))
            };
            if paints.is_empty() {
                (0..materials.len()).filter_map(|index| of(index, None)).collect()
            } else {
                paints.iter().filter_map(|paint| of(paint.material.index(), Some(paint.colour))).collect()
            }
        };
        let mut tones_of_paints = tones_of(&materials);
        // All paints of a gradient get the same steps, so their tones end in the same places.
        let shades = tones_of_paints.iter().map(Tones::shades).max().unwrap_or_default();
        let fewer =
            |(own, ..): &(ToneOptions, &Material, Option<Colour>)| own.scale.clone().for_shades(shades);
        if materials.iter().any(|material| fewer(material) != material.0.scale) {
            materials.iter_mut().for_each(|material| material.0.scale = fewer(material));
            tones_of_paints = tones_of(&materials);
        }
        Self {
            tones: tones_of_paints,
            lighting: lighting.near_for_highlights(tones.highlight.near),
            channels,
        }
    }

    /// Adds the bins of hatching. `paints` are the same as in [`Shading::new`].
    #[must_use]
    pub(crate) fn with_bins(
        mut self,
        scene: &Scene,
        paints: &[MaterialPaint],
        options: &ShadeOptions,
    ) -> Self {
        self.channels.push(ToneChannel::Shade);
        let without = Material::default();
        for (k, tones) in self.tones.iter_mut().enumerate() {
            let paint = paints.get(k);
            let number = if paints.is_empty() { Some(k) } else { paint.map(|paint| paint.material.index()) };
            let material = number.and_then(|k| scene.materials.get(k)).unwrap_or(&without);
            let colour = paint.map_or(material.colour, |paint| paint.colour);
            tones.add_levels(options.levels(&material.name, colour));
        }
        self
    }

    /// Channel whose levels are the bins of hatching, if there is one.
    #[must_use]
    pub(crate) fn bin_channel(&self) -> Option<usize> {
        self.channels.iter().position(|channel| *channel == ToneChannel::Shade)
    }

    /// Largest number of levels of a paint in any channel except the bins of hatching; 0 if no paint has
    /// several tones.
    #[must_use]
    pub(crate) fn most_levels(&self) -> usize {
        let other_channels =
            || (0..self.channels.len()).filter(|channel| self.bin_channel() != Some(*channel));
        let of = |tones: &Tones| other_channels().map(|channel| tones.levels(channel).len()).max();
        self.tones.iter().filter_map(of).max().unwrap_or_default()
    }

    /// Lights that cast shadows, at most 8, local space. The index of each is its bit in `shadowed` of
    /// [`Shading::value`].
    #[must_use]
    pub(crate) fn casters(&self) -> &[Caster] {
        self.lighting.casters()
    }

    /// Number of channels.
    #[must_use]
    pub(crate) fn channels(&self) -> usize {
        self.channels.len()
    }

    /// Whether a channel varies over a flat face: with the distance from a light, the direction to the
    /// camera, or the visible share of the sky. Other channels depend on the normal alone.
    #[must_use]
    pub(crate) fn is_local(&self, channel: usize) -> bool {
        matches!(self.channels.get(channel), Some(ToneChannel::Highlight)) || self.lighting.is_local()
    }

    /// Smallest and largest value that a channel may have within `extent` of a point, where the normal turns
    /// by at most `turn` radians.
    #[must_use]
    pub(crate) fn range(
        &self,
        channel: usize,
        paint: PaintId,
        point: &SurfacePoint,
        shadowed: u32,
        turn: f64,
        extent: f64,
    ) -> (f64, f64) {
        let lighting = &self.lighting;
        match self.channels.get(channel) {
            Some(channel) => match channel.lamps() {
                Some(lamps) => lighting.diffuse_range(lamps, point, shadowed, turn, extent),
                None => lighting.specular_range(point, self.exponent(paint), shadowed, turn, extent),
            },
            None => (0.0, 0.0),
        }
    }

    /// Bounds for how fast a channel that is not local changes with the normal.
    #[must_use]
    pub(crate) fn slope(&self) -> LightSlope {
        self.lighting.slope()
    }

    /// Direction to the light, and the cosines of the angles to it where a paint may change its tone, rising.
    /// `None` unless there is one parallel light and nothing but the normal matters.
    #[must_use]
    pub(crate) fn border_cosines(&self) -> Option<(DVec3, Vec<f64>)> {
        if (0..self.channels.len()).any(|channel| self.is_local(channel)) {
            return None;
        }
        let channels = 0..self.channels.len();
        let levels = self.tones.iter().flat_map(|tones| channels.clone().flat_map(|k| tones.levels(k)));
        let (towards, cosine_of) = self.lighting.only_parallel()?;
        let mut cosines: Vec<f64> = levels.map(|level| cosine_of(*level)).collect();
        cosines.sort_by(f64::total_cmp);
        cosines.dedup();
        Some((towards, cosines))
    }

    /// Rising levels of a channel on a paint.
    #[must_use]
    pub(crate) fn levels(&self, paint: PaintId, channel: usize) -> &[f64] {
        self.tones_of(paint).map_or(&[], |tones| tones.levels(channel))
    }

    /// Value of a channel at a point. Lights whose bits are set in `shadowed` do not reach it.
    #[must_use]
    pub(crate) fn value(&self, channel: usize, paint: PaintId, point: &SurfacePoint, shadowed: u32) -> f64 {
        match self.channels.get(channel) {
            Some(channel) => match channel.lamps() {
                Some(lamps) => self.lighting.diffuse(lamps, point, shadowed),
                None => self.lighting.specular(point, self.exponent(paint), shadowed),
            },
            None => 0.0,
        }
    }

    /// Tone of a point, 0 the darkest, from the number of levels that it reaches in each channel.
    #[must_use]
    pub(crate) fn tone(&self, paint: PaintId, bands: &[u16]) -> u16 {
        self.tones_of(paint).map_or(0, |tones| tones.tone(&self.channels, bands))
    }

    /// Number of tones of a paint, including highlights.
    #[must_use]
    pub(crate) fn tone_count(&self, paint: PaintId) -> u16 {
        self.tones_of(paint).map_or(1, Tones::count)
    }

    /// Colour of a tone on a paint.
    #[must_use]
    pub(crate) fn colour(&self, paint: PaintId, tone: u16) -> Colour {
        self.tones_of(paint).map_or(Colour::WHITE, |tones| tones.colour(tone))
    }

    /// Exponent of the highlights of a paint.
    fn exponent(&self, paint: PaintId) -> f64 {
        self.tones_of(paint).map_or(1.0, |tones| tones.exponent)
    }

    fn tones_of(&self, paint: PaintId) -> Option<&Tones> {
        self.tones.get(paint.index()).or(self.tones.last())
    }
}

/// Largest number of tints for which tones are computed separately.
const MAX_HUES: usize = 3;
