//! Hatching tone: coverage matches the table, darker tones contain the lighter ones, and hatching does not
//! repeat.

use std::collections::BTreeMap;

use crate::library::support::scenes::random_dice::Dice;
use crate::library::support::styled::style_with;
use kurbo::Point;
use ligne::colour::srgb::Colour;
use ligne::drawing::{Page, Unit};
use ligne::export::PngOptions;
use ligne::export::Resolution;
use ligne::hatching::{self, HatchContext, HatchOptions, HatchStroke, ToneCoverage};
use ligne::mesh::{MaterialId, PaintId, PartId};
use ligne::regions::hatch_regions::border_piece::BorderPiece;
use ligne::regions::hatch_regions::hatch_map::HatchCell;
use ligne::regions::{HatchRegions, SurfaceLabel};
use ligne::strokes::Ink;
use ligne::{Drawing, Style};

/// Side of a flat patch, px.
const PATCH_SIDE_PX: f64 = 360.0;

/// Hatch regions with one flat square of tone bin `bin`.
fn patch(bin: u16) -> HatchRegions {
    let look = SurfaceLabel {
        part: PartId(0),
        material: MaterialId(0),
        paint: PaintId(0),
        tone: 0,
        bin,
        cast: false,
    };
    let cells = vec![
        HatchCell { look, facet: 0, area: 0.0 },
        HatchCell { look, facet: 1, area: PATCH_SIDE_PX * PATCH_SIDE_PX },
    ];
    let corners = [(0.0, 0.0), (PATCH_SIDE_PX, 0.0), (PATCH_SIDE_PX, PATCH_SIDE_PX), (0.0, PATCH_SIDE_PX)]
        .map(|(x, y)| Point::new(x, y));
    let side = |k: usize| BorderPiece {
        ends: [corners[k], corners[(k + 1) % 4]],
        sides: [1, 0],
        parts_surfaces: true,
    };
    HatchRegions::of_pieces(cells, (0..4).map(side).collect())
}

fn context(tones: &[ToneCoverage], seed: u64) -> HatchContext<'_> {
    let unit = Unit::Px;
    HatchContext {
        unit,
        seed,
        parts: &[],
        materials: &[],
        paints: &[],
        tones,
        samples: None,
        flows: &[],
        fixed: &[],
        frame: None,
        paper: Colour::WHITE,
    }
}

/// Strokes of all layers on a patch, by layer and stroke id.
fn strokes(
    options: &HatchOptions,
    tones: &[ToneCoverage],
    bin: u16,
    seed: u64,
) -> BTreeMap<(usize, u64), HatchStroke> {
    let layers = hatching::strokes(&patch(bin), &context(tones, seed), options).into_iter().enumerate();
    let named = layers.flat_map(|(n, layer)| layer.strokes.into_iter().map(move |s| ((n, s.id), s)));
    named.collect()
}

/// Share of ink in the inner part of a rendered patch.
fn ink_share(options: &HatchOptions, tones: &[ToneCoverage], bin: u16) -> f64 {
    const PIXELS_PER_PX: u32 = 4;
    let layer = hatching::fill(&patch(bin), &context(tones, 0), options, Vec::new());
    let page =
        Page { width: PATCH_SIDE_PX, height: PATCH_SIDE_PX, unit: Unit::Px, background: Some(Colour::WHITE) };
    let drawing = Drawing::new("", page, layer.into_iter().collect());
    let width = PATCH_SIDE_PX as u32 * PIXELS_PER_PX;
    let png = drawing.to_png(&PngOptions::of_resolution(Resolution::Width(width))).expect("a picture");
    let picture = tiny_skia::Pixmap::decode_png(&png).expect("a picture");
    let margin = 20 * PIXELS_PER_PX;
    let inner = margin..width - margin;
    let (mut ink, mut count) = (0.0, 0.0);
    for y in inner.clone() {
        for x in inner.clone() {
            let pixel = picture.pixel(x, y).expect("a pixel");
            ink += 1.0 - f64::from(pixel.red()) / 255.0;
            count += 1.0;
        }
    }
    ink / count
}

/// Hatching options of a style in opaque black, without grain.
fn opaque_black(style: &Style) -> HatchOptions {
    let mut options = style.hatch.clone();
    for layer in &mut options.layers {
        layer.colour = Ink::Fixed(Colour::BLACK);
        layer.opacity = 1.0;
        layer.grain = 0.0;
    }
    options
}

#[test]
fn darker_tones_keep_all_strokes_of_lighter_ones() {
    let mut dice = Dice::new(5);
    for round in 0..6 {
        let mut options = opaque_black(&style_with(["pen", "pencil", "patent"][round % 3], &[]));
        for layer in &mut options.layers {
            layer.angle = dice.between(0.0, 360.0);
            layer.uneven = dice.between(0.0, 1.0);
        }
        let darkest = 0.5 + 0.4 * dice.between(0.0, 1.0);
        let coverage: Vec<f64> = (0..64).map(|k| darkest * f64::from(63 - k) / 63.0).collect();
        let tones = vec![ToneCoverage { levels: Vec::new(), coverage }];
        let seed = round as u64;
        let mut lighter: BTreeMap<(usize, u64), HatchStroke> = BTreeMap::new();
        let mut lengths = 0.0;
        for bin in (0..64).rev() {
            let own = strokes(&options, &tones, bin, seed);
            for (id, stroke) in &lighter {
                assert_eq!(own.get(id), Some(stroke), "bin {bin} lost or changed a stroke");
            }
            let parts = own.values().flat_map(|stroke| stroke.points.windows(2));
            let total: f64 = parts.map(|ends| ends[0].distance(ends[1])).sum();
            assert!(total >= lengths);
            lengths = total;
            lighter = own;
        }
        assert!(lighter.len() > 50, "{}", lighter.len());
    }
}

#[test]
fn hatching_coverage_matches_the_table() {
    let mut faults = Vec::new();
    for name in ["pen", "pencil", "pencil-plain", "patent", "sketch", "blueprint"] {
        let style = style_with(name, &[]);
        let options = opaque_black(&style);
        let tone = ToneCoverage::new(&style.shade.thresholds, &options.coverage);
        for bin in 0..tone.coverage.len() as u16 {
            let (asked, found) = (tone.of_bin(bin), ink_share(&options, std::slice::from_ref(&tone), bin));
            if (asked - found).abs() >= 0.03 {
                faults.push(format!("{name}, bin {bin}: {found:.3} covered, {asked} asked"));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn hatching_does_not_repeat() {
    // Autocorrelation of the ink of one pencil layer.
    let mut options = opaque_black(&style_with("pencil", &[]));
    options.layers.truncate(1);
    options.layers[0].angle = 0.0;
    let tones = vec![ToneCoverage { levels: Vec::new(), coverage: vec![0.3] }];
    let strokes = strokes(&options, &tones, 0, 0);
    // Raster of the patch: 1 where a stroke passes.
    let (columns, rows) = (PATCH_SIDE_PX as usize, PATCH_SIDE_PX as usize);
    let mut ink = vec![0.0_f64; columns * rows];
    for stroke in strokes.values() {
        for pair in stroke.points.windows(2) {
            let steps = ((pair[1] - pair[0]).hypot() * 2.0).ceil().max(1.0) as usize;
            for k in 0..steps {
                let p = pair[0].lerp(pair[1], k as f64 / steps as f64);
                let (x, y) = (p.x as usize, p.y as usize);
                if x < columns && y < rows {
                    ink[y * columns + x] = 1.0;
                }
            }
        }
    }
    // Each row is measured against its own mean, so the rows of lines do not count as repetition.
    let means: Vec<f64> =
        ink.chunks_exact(columns).map(|row| row.iter().sum::<f64>() / columns as f64).collect();
    let correlation = |dx: usize, dy: usize| {
        let (mut sum, mut square) = (0.0, 0.0);
        for y in 0..rows - dy {
            for x in 0..columns - dx {
                let own = ink[y * columns + x] - means[y];
                sum += own * (ink[(y + dy) * columns + x + dx] - means[y + dy]);
                square += own * own;
            }
        }
        sum / square
    };
    // Farther apart than a stroke length, nothing may correlate.
    let mut greatest: f64 = 0.0;
    for dx in (60..240).step_by(3) {
        for dy in 0..24 {
            greatest = greatest.max(correlation(dx, dy));
        }
    }
    assert!(greatest < 0.1, "{greatest}");
    assert!(correlation(3, 0) > 0.4, "the measure sees strokes: {}", correlation(3, 0));
}
