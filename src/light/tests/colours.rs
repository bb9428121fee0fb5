//! Tones and their colours.

use glam::DVec3;

use super::{assert_near, empty_mesh, frame, shading_and_warnings, surface_point};
use crate::colour::colour_factor::ColourFactor;
use crate::colour::srgb::Colour;
use crate::geometry::names::glob::Glob;
use crate::light::lights::light_options::{LightSource, SourceKind, Space};
use crate::light::tones::tone_options::{Colours, Gooch, HighlightChange, MaterialChange, ToneScale};
use crate::light::tones::tone_ramps::{Strip, Table};
use crate::light::{LightOptions, Shading, ToneOptions};
use crate::mesh::{MaterialId, PaintId};
use crate::scene::{Material, MaterialPaint, Scene};

pub(crate) const FIRST_PAINT: PaintId = PaintId(0);
pub(crate) const ORANGE: Colour = Colour::rgb(200, 120, 40);

pub(crate) fn scene(materials: &[(&str, Colour)]) -> Scene {
    let of = |(name, colour): &(&str, Colour)| Material {
        name: (*name).to_owned(),
        colour: *colour,
        ..Material::default()
    };
    Scene { materials: materials.iter().map(of).collect(), ..Scene::default() }
}

pub(crate) fn shading_of_tone_options(options: &ToneOptions) -> Shading {
    shading_and_warnings(&scene(&[("body", ORANGE)]), &LightOptions::default(), options).0
}

pub(crate) fn tone_colours(shading: &Shading, material: PaintId, count: u16) -> Vec<Colour> {
    (0..count).map(|tone| shading.colour(material, tone)).collect()
}

pub(crate) fn empty_material_change(name: &str) -> MaterialChange {
    MaterialChange {
        name: Glob::new(name),
        colour: None,
        scale: None,
        colours: None,
        tones: None,
        shadow: None,
        lit: None,
        modulate: None,
        highlight: HighlightChange::default(),
    }
}

pub(crate) fn grey_tone_options(shadow: f64, scale: ToneScale) -> ToneOptions {
    ToneOptions { scale, shadow: ColourFactor([shadow; 3]), ..ToneOptions::default() }
}

#[test]
fn two_tones_follow_the_shading_equation_of_lake() {
    let light = LightOptions { ambient: ColourFactor([0.1; 3]), ..LightOptions::default() };
    let options = grey_tone_options(0.4, ToneScale::Thresholds(vec![0.5]));
    let (lake, _) = shading_and_warnings(&scene(&[("body", ORANGE)]), &light, &options);
    // a_g a_m + a_l a_m, and the same + d_l d_m.
    assert_eq!(lake.colour(FIRST_PAINT, 0), Colour::rgb(100, 60, 20));
    assert_eq!(lake.colour(FIRST_PAINT, 1), Colour::rgb(220, 132, 44));
    assert_eq!(lake.levels(FIRST_PAINT, 0), [0.5]);
    assert_eq!((lake.channels(), lake.levels(FIRST_PAINT, 1).len()), (1, 0));
    assert_eq!([0, 1, 7].map(|band| lake.tone(FIRST_PAINT, &[band])), [0, 1, 1]);
}

#[test]
fn tones_are_evenly_spaced_between_shadow_and_material_colour() {
    let shading =
        shading_of_tone_options(&grey_tone_options(0.5, ToneScale::Thresholds(vec![0.2, 0.3, 0.9])));
    let wanted = [0.5, 2.0 / 3.0, 5.0 / 6.0, 1.0].map(|part: f64| (200.0 * part).round() as u8);
    assert_eq!(tone_colours(&shading, FIRST_PAINT, 4).iter().map(|c| c.r).collect::<Vec<_>>(), wanted);

    let steps = shading_of_tone_options(&grey_tone_options(0.0, ToneScale::Steps(128)));
    assert_eq!(steps.levels(FIRST_PAINT, 0).len(), 127);
    assert_eq!(steps.levels(FIRST_PAINT, 0)[63], 0.5);
    assert_eq!((steps.colour(FIRST_PAINT, 0), steps.colour(FIRST_PAINT, 127)), (Colour::BLACK, ORANGE));

    // The default material, which has no name, has the most shades: 103, from 102 to 204. The others get the
    // same number of steps.
    let shades = shading_of_tone_options(&grey_tone_options(0.5, ToneScale::Steps(256)));
    assert_eq!(shades.levels(FIRST_PAINT, 0).len(), 102);
    let reds = tone_colours(&shades, FIRST_PAINT, 103).iter().map(|c| c.r).collect::<Vec<_>>();
    assert_eq!((reds[0], reds[102]), (100, 200));
    assert!(reds.windows(2).all(|pair| pair[1] - pair[0] <= 1), "{reds:?}");

    // A single tone is the material itself.
    let flat = shading_of_tone_options(&grey_tone_options(0.5, ToneScale::Thresholds(Vec::new())));
    assert_eq!((flat.colour(FIRST_PAINT, 0), flat.tone(FIRST_PAINT, &[0])), (ORANGE, 0));
}

#[test]
fn tones_option_sets_the_share_of_light_of_each_tone() {
    let mut options = grey_tone_options(0.5, ToneScale::Thresholds(vec![0.1, 0.6]));
    options.tones = vec![1.0, 0.0, 1.0];
    assert_eq!(
        tone_colours(&shading_of_tone_options(&options), FIRST_PAINT, 3),
        [ORANGE, Colour::rgb(100, 60, 20), ORANGE]
    );
    options.tones = vec![0.0, 1.0, 1.25];
    assert_eq!(shading_of_tone_options(&options).colour(FIRST_PAINT, 2), Colour::rgb(225, 135, 45));
}

#[test]
fn palette_colours_are_spread_over_the_tones() {
    let (a, b, c) = (Colour::rgb(0, 0, 100), Colour::rgb(0, 0, 200), Colour::rgb(100, 0, 200));
    let mut options = grey_tone_options(0.5, ToneScale::Thresholds(vec![0.3, 0.6]));
    options.colours = Colours::Palette(vec![a, b, c]);
    assert_eq!(tone_colours(&shading_of_tone_options(&options), FIRST_PAINT, 3), [a, b, c]);
    options.colours = Colours::Palette(vec![a, c]);
    assert_eq!(
        tone_colours(&shading_of_tone_options(&options), FIRST_PAINT, 3),
        [a, Colour::rgb(50, 0, 150), c]
    );
    options.colours = Colours::Palette(vec![a]);
    assert_eq!(tone_colours(&shading_of_tone_options(&options), FIRST_PAINT, 3), [a, a, a]);
    options.colours = Colours::Palette(vec![Colour::rgb(102, 102, 102), Colour::WHITE]);
    options.modulate = Some(1.0);
    assert_eq!(shading_of_tone_options(&options).colour(FIRST_PAINT, 0), Colour::rgb(80, 48, 16));
}

#[test]
fn coloured_light_tints_only_lit_tones() {
    let source = LightSource { colour: Colour::rgb(255, 0, 0), ..LightSource::default() };
    let light = LightOptions { sources: vec![source], ..LightOptions::default() };
    let options = grey_tone_options(0.5, ToneScale::Thresholds(vec![0.5]));
    let (tinted, _) = shading_and_warnings(&scene(&[("", Colour::rgb(200, 200, 200))]), &light, &options);
    assert_eq!(
        tone_colours(&tinted, FIRST_PAINT, 2),
        [Colour::rgb(100, 100, 100), Colour::rgb(200, 100, 100)]
    );
}

/// Lights from two sides in these colours.
fn lights_from_both_sides(colours: [Colour; 2]) -> LightOptions {
    let source = |x: f64, colour: Colour| LightSource {
        kind: SourceKind::Directional { direction: DVec3::new(x, -1.0, 0.0) },
        space: Space::World,
        colour,
        ..LightSource::default()
    };
    LightOptions {
        sources: vec![source(1.0, colours[0]), source(-1.0, colours[1])],
        ..LightOptions::default()
    }
}

#[test]
fn two_coloured_lights_give_separate_and_mixed_tones() {
    let light = lights_from_both_sides([Colour::rgb(255, 0, 0), Colour::rgb(0, 0, 255)]);
    let options = grey_tone_options(0.5, ToneScale::Thresholds(vec![0.5]));
    let (mixed, _) = shading_and_warnings(&scene(&[("", Colour::rgb(200, 200, 200))]), &light, &options);
    let seen = |normal: DVec3| {
        let at = surface_point(DVec3::ZERO, normal);
        let value = |channel: usize| mixed.value(channel, FIRST_PAINT, &at, 0);
        let levels = |channel: usize| mixed.levels(FIRST_PAINT, channel);
        let bands: Vec<u16> = (0..mixed.channels())
            .map(|channel| levels(channel).iter().filter(|level| **level <= value(channel)).count() as u16)
            .collect();
        mixed.colour(FIRST_PAINT, mixed.tone(FIRST_PAINT, &bands))
    };
    assert_eq!(seen(DVec3::X), Colour::rgb(200, 100, 100));
    assert_eq!(seen(DVec3::NEG_X), Colour::rgb(100, 100, 200));
    assert_eq!(seen(DVec3::NEG_Y), Colour::rgb(200, 100, 200));
    assert_eq!(seen(DVec3::Y), Colour::rgb(100, 100, 100));
    // The darkest tone is the first; red is lighter than blue.
    let tones = tone_colours(&mixed, FIRST_PAINT, 4);
    assert_eq!(
        tones.iter().map(|c| (c.r, c.b)).collect::<Vec<_>>(),
        [(100, 100), (100, 200), (200, 100), (200, 200)]
    );
}

#[test]
fn lights_of_similar_colour_share_one_channel() {
    let cream = Colour::rgb(255, 240, 230);
    let options = grey_tone_options(0.5, ToneScale::Thresholds(vec![0.5]));
    let scene = scene(&[("", Colour::rgb(200, 200, 200))]);
    let channels = |light: &LightOptions, options: &ToneOptions| {
        shading_and_warnings(&scene, light, options).0.channels()
    };
    assert_eq!(channels(&lights_from_both_sides([Colour::WHITE, cream]), &options), 1);
    let red = lights_from_both_sides([Colour::WHITE, Colour::rgb(255, 0, 0)]);
    assert_eq!(channels(&red, &options), 3);
    // A gradient uses the mean of their tints.
    let (gradient, _) = shading_and_warnings(&scene, &red, &grey_tone_options(0.5, ToneScale::Steps(128)));
    assert!(gradient.levels(FIRST_PAINT, 1).is_empty() && gradient.levels(FIRST_PAINT, 0).len() > 64);
}

#[test]
fn tone_table_is_looked_up_by_two_lights() {
    let of = |direction: DVec3, brightness: f64| LightSource {
        kind: SourceKind::Directional { direction },
        space: Space::World,
        brightness,
        ..LightSource::default()
    };
    let light =
        LightOptions { sources: vec![of(DVec3::X, 1.0), of(DVec3::Z, 0.5)], ..LightOptions::default() };
    let (dark, half, full) = (Colour::rgb(51, 51, 51), Colour::rgb(102, 102, 102), Colour::WHITE);
    let table = Table::of_rows(&[vec![dark, half], vec![half, full]]).unwrap();
    let options = ToneOptions { scale: ToneScale::Table(table), ..ToneOptions::default() };
    let (shading_, warnings) = shading_and_warnings(&scene(&[("body", ORANGE)]), &light, &options);
    assert!(warnings.is_empty() && shading_.channels() == 3);
    assert!(shading_.levels(FIRST_PAINT, 0).is_empty());
    assert_eq!((shading_.levels(FIRST_PAINT, 1), shading_.levels(FIRST_PAINT, 2)), (&[0.5][..], &[0.5][..]));
    let at = surface_point(DVec3::ZERO, DVec3::new(0.6, 0.0, 0.8));
    assert_near(shading_.value(1, FIRST_PAINT, &at, 0), 0.6);
    assert_near(shading_.value(2, FIRST_PAINT, &at, 0), 0.4);
    let tones = [[0, 0, 0], [0, 1, 0], [0, 0, 1], [0, 1, 1]].map(|bands| shading_.tone(FIRST_PAINT, &bands));
    assert_eq!(tones, [0, 1, 1, 2]);
    // 1.5 times shade times material, cut off at 1.
    let wanted = [Colour::rgb(60, 36, 12), Colour::rgb(120, 72, 24), Colour::rgb(255, 180, 60)];
    assert_eq!(tone_colours(&shading_, FIRST_PAINT, 3), wanted);

    let (_, warnings) = shading_and_warnings(&scene(&[]), &LightOptions::default(), &options);
    assert_eq!(warnings, ["a table of tones is for two lights, but there is one"]);
}

#[test]
fn strip_ramp_sets_tone_levels_and_colours() {
    let columns = [Colour::BLACK, ORANGE, ORANGE, Colour::WHITE];
    let strip = Strip::of_columns(&columns).unwrap();
    let shading =
        shading_of_tone_options(&ToneOptions { scale: ToneScale::Ramp(strip), ..ToneOptions::default() });
    assert_eq!(shading.levels(FIRST_PAINT, 0), [0.25, 0.75]);
    assert_eq!(tone_colours(&shading, FIRST_PAINT, 3), [Colour::BLACK, ORANGE, Colour::WHITE]);
}

#[test]
fn material_changes_apply_by_name_pattern() {
    let mut options = grey_tone_options(0.5, ToneScale::Thresholds(vec![0.5]));
    options.materials = vec![
        MaterialChange {
            scale: Some(ToneScale::Steps(4)),
            highlight: HighlightChange { enabled: Some(true), ..HighlightChange::default() },
            ..empty_material_change("glass*")
        },
        MaterialChange { colour: Some(Colour::WHITE), ..empty_material_change("*blue") },
    ];
    let scene = scene(&[("body", ORANGE), ("glass blue", ORANGE)]);
    let (shading_, _) = shading_and_warnings(&scene, &LightOptions::default(), &options);
    assert_eq!(shading_.levels(FIRST_PAINT, 0), [0.5]);
    assert_eq!(shading_.levels(PaintId(1), 0), [0.25, 0.5, 0.75]);
    assert_eq!((shading_.levels(FIRST_PAINT, 1).len(), shading_.levels(PaintId(1), 1).len()), (0, 1));
    assert_eq!((shading_.colour(FIRST_PAINT, 1), shading_.colour(PaintId(1), 3)), (ORANGE, Colour::WHITE));
    // Surfaces without material are light grey, for any index.
    for without in [2, 77].map(PaintId) {
        assert_eq!(shading_.colour(without, 1), Colour::rgb(204, 204, 204));
    }
}

#[test]
fn paints_keep_the_tones_of_their_material_in_their_own_colours() {
    let scene = scene(&[("body", Colour::WHITE)]);
    let paint = |colour| MaterialPaint { material: MaterialId(0), colour };
    let paints = [paint(Colour::WHITE), paint(Colour::BLACK), paint(ORANGE)];
    let mut options = grey_tone_options(0.5, ToneScale::Thresholds(vec![0.5]));
    let painted = |options: &ToneOptions| {
        let (light, frame) = (LightOptions::default(), frame(DVec3::X));
        Shading::new(&scene, &paints, &empty_mesh(), &frame, &light, options, &mut Vec::new())
    };
    assert_eq!(tone_colours(&painted(&options), PaintId(2), 2), [Colour::rgb(100, 60, 20), ORANGE]);
    options.materials = vec![MaterialChange { colour: Some(Colour::WHITE), ..empty_material_change("body") }];
    assert_eq!(painted(&options).colour(PaintId(2), 1), Colour::WHITE);
}

#[test]
fn gooch_tones_run_from_cool_to_warm() {
    let gooch = Gooch { enabled: true, ..Gooch::default() };
    let options =
        ToneOptions { colours: Colours::Gooch(gooch), ..grey_tone_options(0.5, ToneScale::Steps(3)) };
    let shading = shading_of_tone_options(&options);
    let (cool, warm) = (Colour::rgb(50, 30, 150), Colour::rgb(177, 137, 20));
    assert_eq!((shading.colour(FIRST_PAINT, 0), shading.colour(FIRST_PAINT, 2)), (cool, warm));
    assert_eq!(shading.colour(FIRST_PAINT, 1).b, 85);
}

#[test]
fn black_and_emissive_materials_keep_distinct_tones() {
    let mut scene = scene(&[("tyre", Colour::BLACK), ("lamp", ORANGE)]);
    scene.materials[1].emissive = Colour::rgb(180, 20, 0);
    let options = grey_tone_options(0.5, ToneScale::Thresholds(vec![0.5]));
    let (shading_, _) = shading_and_warnings(&scene, &LightOptions::default(), &options);
    assert_eq!(tone_colours(&shading_, FIRST_PAINT, 2), [Colour::rgb(24, 24, 24), Colour::rgb(48, 48, 48)]);
    assert_eq!(shading_.colour(PaintId(1), 0), Colour::rgb(180, 60, 20));
    let flat = grey_tone_options(0.5, ToneScale::Thresholds(Vec::new()));
    assert_eq!(
        shading_and_warnings(&scene, &LightOptions::default(), &flat).0.colour(FIRST_PAINT, 0),
        Colour::BLACK
    );
}

#[test]
fn shadow_tones_are_cooler_and_darker_than_lit_tones() {
    let shading = shading_of_tone_options(&ToneOptions::default());
    let (shadow, lit) = (shading.colour(PaintId(9), 0), shading.colour(PaintId(9), 1));
    assert!(shadow.luma() < 0.75 * lit.luma());
    assert!(i16::from(shadow.b) - i16::from(shadow.r) > 10, "{shadow:?}");
}
