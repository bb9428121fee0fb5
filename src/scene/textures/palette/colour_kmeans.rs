//! [`kmeans_colours`]: a few representative colours of a picture, by k-means clustering in Oklab.
//!
//! Source: Lloyd, "Least squares quantization in PCM", 1982. Seeds as in Arthur and Vassilvitskii,
//! "k-means++", SODA 2007, but the farthest colour replaces the random choice.

use crate::colour::oklab::{self, Oklab, distance2, linear_table};
use crate::colour::srgb::Colour;

/// Bits per channel of the initial colour histogram.
const BIN_BITS: u32 = 5;

/// Rounds of Lloyd's algorithm.
const LLOYD_ROUNDS: usize = 24;

/// Minimum distance between seeds in Oklab.
const MIN_SEED_DISTANCE: f32 = 0.035;

/// Bin of the colour histogram: mean linear light and visible area.
#[derive(Clone, Copy, Default)]
struct ColourBin {
    light: [f64; 3],
    weight: f64,
}

/// At most `count` representative colours of texels, weighted by their visible area; the lightest first.
pub(crate) fn kmeans_colours(colours: &[Colour], shown: &[f32], count: usize) -> Vec<Colour> {
    let bins = histogram(colours, shown);
    let labs: Vec<Oklab> = bins.iter().map(|bin| oklab::of_linear(bin.light.map(|c| c as f32))).collect();
    // Square root, so that small areas count: a hundredth of the surface has a tenth of the weight.
    let weights: Vec<f32> = bins.iter().map(|bin| bin.weight.sqrt() as f32).collect();
    let mut centres = farthest_point_seeds(&labs, &weights, count.max(1));
    let mut nearest = vec![0; labs.len()];
    for _ in 0..LLOYD_ROUNDS {
        let mut sums = vec![([0.0_f64; 3], 0.0_f64); centres.len()];
        for ((lab, weight), nearest) in labs.iter().zip(&weights).zip(&mut nearest) {
            *nearest = nearest_centre_index(&centres, *lab);
            let (sum, all) = &mut sums[*nearest];
            sum.iter_mut().zip(lab).for_each(|(sum, c)| *sum += f64::from(*c) * f64::from(*weight));
            *all += f64::from(*weight);
        }
        for (centre, (sum, all)) in centres.iter_mut().zip(sums) {
            if all > 0.0 {
                *centre = sum.map(|sum| (sum / all) as f32);
            }
        }
    }
    let mut means = vec![ColourBin::default(); centres.len()];
    for (bin, nearest) in bins.iter().zip(nearest) {
        let mean = &mut means[nearest];
        mean.light.iter_mut().zip(bin.light).for_each(|(sum, c)| *sum += c * bin.weight);
        mean.weight += bin.weight;
    }
    let mut found: Vec<Colour> = means
        .iter()
        .filter(|mean| mean.weight > 0.0)
        .map(|mean| {
            let [r, g, b] = mean.light.map(|sum| (sum / mean.weight) as f32);
            Colour::from_linear([r, g, b, 1.0])
        })
        .collect();
    found.sort_unstable_by(|a, b| b.luma().total_cmp(&a.luma()).then(a.cmp(b)));
    found.dedup();
    found
}

/// Histogram of visible texels.
fn histogram(colours: &[Colour], shown: &[f32]) -> Vec<ColourBin> {
    let table = linear_table();
    let mut bins = vec![ColourBin::default(); 1 << (3 * BIN_BITS)];
    for (colour, shown) in colours.iter().zip(shown).filter(|(_, shown)| **shown > 0.0) {
        let channels = [colour.r, colour.g, colour.b];
        let key = channels.iter().fold(0, |key, c| key << BIN_BITS | usize::from(*c) >> (8 - BIN_BITS));
        let bin = &mut bins[key];
        let weight = f64::from(*shown);
        bin.light.iter_mut().zip(channels).for_each(|(sum, c)| *sum += f64::from(table[c as usize]) * weight);
        bin.weight += weight;
    }
    bins.retain(|bin| bin.weight > 0.0);
    for bin in &mut bins {
        bin.light = bin.light.map(|sum| sum / bin.weight);
    }
    bins
}

/// Seeds far from each other: the most frequent colour, then repeatedly the one with the greatest weighted
/// distance.
fn farthest_point_seeds(labs: &[Oklab], weights: &[f32], count: usize) -> Vec<Oklab> {
    let most = |values: &mut dyn Iterator<Item = f32>| {
        let mut best: Option<(usize, f32)> = None;
        for (k, value) in values.enumerate() {
            if best.is_none_or(|(_, most)| value > most) {
                best = Some((k, value));
            }
        }
        best.map(|(k, _)| k)
    };
    let Some(first) = most(&mut weights.iter().copied()) else { return Vec::new() };
    let mut centres = vec![labs[first]];
    let mut far: Vec<f32> = labs.iter().map(|lab| distance2(*lab, labs[first])).collect();
    while centres.len() < count {
        let mut worst = far.iter().zip(weights).map(|(far, weight)| {
            if *far < MIN_SEED_DISTANCE * MIN_SEED_DISTANCE { 0.0 } else { far * weight }
        });
        let Some(next) = most(&mut worst).filter(|next| far[*next] >= MIN_SEED_DISTANCE * MIN_SEED_DISTANCE)
        else {
            break;
        };
        centres.push(labs[next]);
        far.iter_mut().zip(labs).for_each(|(far, lab)| *far = far.min(distance2(*lab, labs[next])));
    }
    centres
}

/// Index of the nearest colour; the first of equally near ones.
pub(crate) fn nearest_centre_index(centres: &[Oklab], lab: Oklab) -> usize {
    let mut best = (0, f32::INFINITY);
    for (k, centre) in centres.iter().enumerate() {
        let far = distance2(*centre, lab);
        if far < best.1 {
            best = (k, far);
        }
    }
    best.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kmeans_keeps_few_colours_including_rare_ones() {
        let (red, blue, white) = (Colour::rgb(200, 0, 0), Colour::rgb(0, 0, 200), Colour::WHITE);
        let mut colours = vec![red; 5000];
        colours.extend(vec![blue; 4000]);
        colours.extend(vec![white; 40]);
        assert_eq!(kmeans_colours(&colours, &vec![1.0; colours.len()], 6), [white, red, blue]);
        // Invisible texels do not count.
        let shown: Vec<f32> = colours.iter().map(|c| if *c == blue { 0.0 } else { 1.0 }).collect();
        assert_eq!(kmeans_colours(&colours, &shown, 6), [white, red]);
        assert!(kmeans_colours(&colours, &vec![0.0; colours.len()], 6).is_empty());
    }

    #[test]
    fn kmeans_divides_a_ramp_into_even_steps() {
        let ramp: Vec<Colour> = (0..=255).map(|v| Colour::rgb(v, v, v)).collect();
        let steps = kmeans_colours(&ramp, &[1.0; 256], 4);
        assert_eq!(steps.len(), 4);
        let lightness: Vec<f32> = steps.iter().map(|c| oklab::of(*c)[0]).collect();
        assert!(
            lightness.windows(2).all(|pair| (0.15..0.35).contains(&(pair[0] - pair[1]))),
            "{lightness:?}"
        );
    }
}
