//! [`ToneVeils`]: transparent veils painted over a picture to show the tones other than its own.
//!
//! 1. A drawing holds a picture once, in its lightest tone.
//! 2. Each other tone is a veil: a colour between black and white, painted with an opacity. If the tone
//!    leaves a share t of every channel, the opacity 1 − t is exact. It looks the same in every program,
//!    unlike blending by multiplication.
//! 3. A tone that tints gets the veil that is exact for the mean colour of the picture, and for its contrast
//!    in the channel that loses most.
//! 4. Veils lie on each other, each over all darker tones. So one border shows between two tones, not two.

use crate::colour::pixel_picture::Picture;
use crate::colour::srgb::Colour;
use crate::light::Shading;
use crate::scene::MaterialPaint;
use crate::scene::textures::EmbeddedTexture;

/// Veils over a picture.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ToneVeils {
    /// Effect of the picture's own tone on each channel of a colour: a factor and an addend.
    tone: [[f64; 2]; 3],
    /// Veils in the order of painting, with the tones that each lies over.
    pub veils: Vec<(Colour, Vec<u16>)>,
}

/// Effect of a tone on colours.
#[derive(Debug, Clone, Copy)]
struct ToneResponse {
    /// Factor for the difference of two colours, per channel.
    slope: [f64; 3],
    /// Resulting mean colour of the picture.
    mean: [f64; 3],
}

/// Contrast below which a picture shows nothing, so its plain tones replace it.
const MIN_TONE_SLOPE: f64 = 0.02;

/// Largest colour error of a veil that is laid over earlier ones.
const MAX_COLOUR_ERROR: f64 = 0.012;

impl ToneVeils {
    /// Veils for a picture; `None` if the tones have fixed colours that do not depend on the picture.
    pub(crate) fn of(shading: &Shading, paints: &[MaterialPaint], imaged: &EmbeddedTexture) -> Option<Self> {
        let channels = |paint: crate::mesh::PaintId| Some(paints.get(paint.index())?.colour.channels());
        let probes = [channels(imaged.probes[0])?, channels(imaged.probes[1])?];
        let mean = channels(imaged.paint)?;
        let tones: Vec<ToneResponse> = (0..shading.tone_count(imaged.paint))
            .map(|tone| {
                let [dark, light] = imaged.probes.map(|probe| shading.colour(probe, tone).channels());
                let slope = |c: usize| ((light[c] - dark[c]) / (probes[1][c] - probes[0][c])).max(0.0);
                ToneResponse {
                    slope: [0, 1, 2].map(slope),
                    mean: shading.colour(imaged.paint, tone).channels(),
                }
            })
            .collect();
        Self::over(&tones, mean)
    }

    fn over(tones: &[ToneResponse], mean: [f64; 3]) -> Option<Self> {
        let min_slope = |response: &ToneResponse| response.slope.into_iter().fold(f64::INFINITY, f64::min);
        let (lightest, lit) =
            tones.iter().enumerate().max_by(|a, b| min_slope(a.1).total_cmp(&min_slope(b.1)))?;
        if min_slope(lit) < MIN_TONE_SLOPE {
            return None;
        }
        let tone = [0, 1, 2].map(|c| [lit.slope[c], lit.mean[c] - lit.slope[c] * mean[c]]);
        // Share of the picture that a tone leaves, and its addend.
        let remainder = |tone_response: &ToneResponse| {
            let parts = [0, 1, 2].map(|c| tone_response.slope[c] / lit.slope[c].max(MIN_TONE_SLOPE));
            let part = parts.into_iter().fold(1.0, f64::min);
            let added =
                [0, 1, 2].map(|c| (tone_response.mean[c] - part * lit.mean[c]).clamp(0.0, 1.0 - part));
            (part, added)
        };
        let mut other_tones: Vec<(u16, f64, [f64; 3])> = tones
            .iter()
            .enumerate()
            .filter(|(tone, _)| *tone != lightest)
            .map(|(tone, made)| (tone as u16, remainder(made).0, remainder(made).1))
            .collect();
        other_tones.sort_by(|a, b| b.1.total_cmp(&a.1).then(b.0.cmp(&a.0)));
        let mut veils: Vec<(Colour, Vec<u16>)> = Vec::new();
        let mut separate_veils: Vec<(Colour, Vec<u16>)> = Vec::new();
        // Share that the veils up to here leave, and their addend.
        let (mut part, mut added) = (1.0, [0.0; 3]);
        for (tone, own_part, own_added) in other_tones {
            let relative_part = own_part / part;
            let relative_added = [0, 1, 2].map(|c| own_added[c] - added[c] * relative_part);
            if relative_added
                .into_iter()
                .any(|rest| rest < -MAX_COLOUR_ERROR || rest > 1.0 - relative_part + MAX_COLOUR_ERROR)
            {
                separate_veils.extend(veil(own_part, own_added).map(|(veil, _, _)| (veil, vec![tone])));
                continue;
            }
            // The opacity is used as written, so errors do not accumulate.
            if let Some((veil, written_part, written_added)) = veil(relative_part, relative_added) {
                part *= written_part;
                added = [0, 1, 2].map(|c| added[c] * written_part + written_added[c]);
                veils.push((veil, Vec::new()));
            }
            let reached = veils.len();
            veils.iter_mut().take(reached).for_each(|(_, tones)| tones.push(tone));
        }
        veils.extend(separate_veils);
        Some(Self { tone, veils })
    }

    /// Applies the picture's own tone to its pixels.
    pub(crate) fn tone(&self, picture: &mut Picture) {
        let tables = self.tone.map(|[factor, added]| {
            let of = |c: u8| ((f64::from(c) * factor + added * 255.0).round().clamp(0.0, 255.0)) as u8;
            (0..=255).map(of).collect::<Vec<u8>>()
        });
        for pixel in &mut picture.pixels {
            let [r, g, b] = &tables;
            let of = |table: &[u8], c: u8| table.get(usize::from(c)).copied().unwrap_or(c);
            *pixel = Colour { r: of(r, pixel.r), g: of(g, pixel.g), b: of(b, pixel.b), a: pixel.a };
        }
    }
}

/// Veil that leaves the share `part` of the colours below and adds `added`, followed by both values as
/// written in 8 bits. `None` if it is invisible.
fn veil(part: f64, added: [f64; 3]) -> Option<(Colour, f64, [f64; 3])> {
    let opacity = ((1.0 - part) * 255.0).round() / 255.0;
    if opacity <= 0.0 {
        return None;
    }
    let colour = Colour::from_channels(added.map(|added| added / opacity));
    let added = colour.channels().map(|c| c * opacity);
    Some((Colour { a: (opacity * 255.0).round() as u8, ..colour }, 1.0 - opacity, added))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Resulting colour in a tone.
    fn veiled_colour(shades: &ToneVeils, colour: [f64; 3], tone: u16) -> [f64; 3] {
        let below = [0, 1, 2].map(|c| colour[c] * shades.tone[c][0] + shades.tone[c][1]);
        shades.veils.iter().filter(|(_, tones)| tones.contains(&tone)).fold(below, |below, (veil, _)| {
            let opacity = f64::from(veil.a) / 255.0;
            [0, 1, 2].map(|c| below[c] * (1.0 - opacity) + veil.channels()[c] * opacity)
        })
    }

    const MEAN_COLOUR: [f64; 3] = [0.6, 0.5, 0.3];

    fn multiplying_tones(factors: &[[f64; 3]]) -> Vec<ToneResponse> {
        let response = |slope: &[f64; 3]| ToneResponse {
            slope: *slope,
            mean: [0, 1, 2].map(|c| slope[c] * MEAN_COLOUR[c]),
        };
        factors.iter().map(response).collect()
    }

    fn max_channel_error(a: [f64; 3], b: [f64; 3]) -> f64 {
        [0, 1, 2].map(|c| (a[c] - b[c]).abs()).into_iter().fold(0.0, f64::max)
    }

    #[test]
    fn grey_tone_veils_are_exact_and_layered() {
        let shades =
            ToneVeils::over(&multiplying_tones(&[[0.3; 3], [0.7; 3], [1.0; 3]]), MEAN_COLOUR).unwrap();
        assert_eq!(
            shades.veils.iter().map(|(_, tones)| tones.clone()).collect::<Vec<_>>(),
            [vec![1, 0], vec![0]]
        );
        for (tone, factor) in [(0, 0.3), (1, 0.7), (2, 1.0)] {
            for colour in [[0.0; 3], [1.0, 0.5, 0.2], [1.0; 3]] {
                let off = max_channel_error(veiled_colour(&shades, colour, tone), colour.map(|c| c * factor));
                assert!(off < 0.004, "{tone}: {off}");
            }
        }
    }

    #[test]
    fn errors_of_many_veils_do_not_accumulate() {
        let factors: Vec<[f64; 3]> = (0..128).map(|k| [0.3 + 0.7 * f64::from(k) / 127.0; 3]).collect();
        let shades = ToneVeils::over(&multiplying_tones(&factors), MEAN_COLOUR).unwrap();
        for (tone, factor) in (0..).zip(&factors) {
            let off = max_channel_error(veiled_colour(&shades, [0.9; 3], tone), factor.map(|f| f * 0.9));
            assert!(off < 0.004, "{tone}: {off}");
        }
    }

    #[test]
    fn tinted_veils_match_the_mean_colour_and_highlights_are_exact() {
        let mut tones = multiplying_tones(&[[0.7, 0.66, 0.78], [1.0; 3]]);
        tones.push(ToneResponse { slope: [0.4; 3], mean: MEAN_COLOUR.map(|c| 0.4 * c + 0.6) });
        let shades = ToneVeils::over(&tones, MEAN_COLOUR).unwrap();
        assert!(max_channel_error(veiled_colour(&shades, MEAN_COLOUR, 0), tones[0].mean) < 0.004);
        assert!(max_channel_error(veiled_colour(&shades, [0.2, 0.3, 0.1], 2), [0.68, 0.72, 0.64]) < 0.004);
        let white = veiled_colour(&shades, [1.0; 3], 0);
        assert!(max_channel_error(white, [0.7, 0.66, 0.78]) < 0.09, "{white:?}");
        assert!(
            ToneVeils::over(&[ToneResponse { slope: [0.0; 3], mean: MEAN_COLOUR }], MEAN_COLOUR).is_none()
        );
    }
}
