//! Highlights: their tones, their exponents from gloss, and their place on the surface.

use glam::DVec3;

use super::colours::{FIRST_PAINT, ORANGE, empty_material_change, scene, shading_of_tone_options};
use super::{assert_near, shading_and_warnings, surface_point};
use crate::colour::srgb::Colour;
use crate::light::lights::light_options::{LightSource, SourceKind, Space};
use crate::light::tones::tone_options::{Highlight, HighlightChange, MaterialChange};
use crate::light::tones::tone_ramps::Strip;
use crate::light::{LightOptions, Shading, ToneOptions};
use crate::mesh::PaintId;
use crate::scene::material::Gloss;
use crate::scene::{Material, Scene};

#[test]
fn highlights_are_tones_above_the_diffuse_tones() {
    let direction = DVec3::new(0.0, -1.0, 1.0);
    let kind = SourceKind::Directional { direction };
    let source = LightSource { kind, space: Space::World, ..LightSource::default() };
    let light = LightOptions { sources: vec![source], ..LightOptions::default() };
    let highlight =
        Highlight { enabled: true, thresholds: vec![0.4, 0.8], strength: 1.0, ..Highlight::default() };
    let options = ToneOptions { highlight, cast_shadows: true, ..ToneOptions::default() };
    let (gloss, _) = shading_and_warnings(&scene(&[("body", ORANGE)]), &light, &options);
    assert_eq!((gloss.channels(), gloss.levels(FIRST_PAINT, 1)), (2, &[0.4, 0.8][..]));

    // Seen from −y and lit from 45 degrees above, a surface mirrors the light if its normal is halfway
    // between.
    let half = (direction.normalize() + DVec3::NEG_Y).normalize();
    let value =
        |normal: DVec3, shadowed| gloss.value(1, FIRST_PAINT, &surface_point(DVec3::ZERO, normal), shadowed);
    assert_near(value(half, 0), 1.0);
    assert!(value(DVec3::NEG_Y, 0) < 0.1 && value(half + DVec3::X * 0.1, 0) < 1.0);
    assert_eq!((value(half, 1), value(DVec3::new(0.0, 1.0, 1.0), 0)), (0.0, 0.0));

    assert_eq!(
        [[0, 0], [1, 0], [1, 1], [1, 2], [0, 2]].map(|bands| gloss.tone(FIRST_PAINT, &bands)),
        [0, 1, 2, 3, 3]
    );
    assert_eq!(gloss.colour(FIRST_PAINT, 2), ORANGE.mix(Colour::WHITE, 0.5));
    assert_eq!(gloss.colour(FIRST_PAINT, 3), Colour::WHITE);
}

/// Material with this gloss.
fn glossy(name: &str, exponent: f32, strength: f32) -> Material {
    let gloss = Some(Gloss { exponent, strength });
    Material { name: name.to_owned(), colour: ORANGE, gloss, ..Material::default() }
}

#[test]
fn highlights_use_the_gloss_of_the_material_unless_overridden() {
    let scene = Scene {
        materials: vec![glossy("steel", 100.0, 1.0), glossy("wood", 10.0, 0.5), glossy("chalk", 1.0, 0.0)],
        ..Scene::default()
    };
    let highlight = Highlight { enabled: true, strength: 1.0, material: true, ..Highlight::default() };
    let own = HighlightChange { exponent: Some(7.0), ..HighlightChange::default() };
    let rule = MaterialChange { highlight: own, ..empty_material_change("st*") };
    let plain = ToneOptions { highlight, ..ToneOptions::default() };
    let ruled = ToneOptions { materials: vec![rule], ..plain.clone() };
    let [by_file, by_rule] = [plain, ruled].map(|options| {
        let direction = DVec3::new(0.0, -1.0, 1.0);
        let kind = SourceKind::Directional { direction };
        let source = LightSource { kind, space: Space::World, ..LightSource::default() };
        shading_and_warnings(
            &scene,
            &LightOptions { sources: vec![source], ..LightOptions::default() },
            &options,
        )
        .0
    });
    let normal = DVec3::new(0.3, -1.0, 0.5);
    let half = (DVec3::new(0.0, -1.0, 1.0).normalize() + DVec3::NEG_Y).normalize();
    let cosine: f64 = normal.normalize().dot(half);
    let value =
        |shading: &Shading, k: u32| shading.value(1, PaintId(k), &surface_point(DVec3::ZERO, normal), 0);
    assert_near(value(&by_file, 0), crate::geometry::numbers::portable_math::pow(cosine, 100.0));
    assert_near(value(&by_file, 1), crate::geometry::numbers::portable_math::pow(cosine, 10.0));
    assert_near(value(&by_rule, 0), crate::geometry::numbers::portable_math::pow(cosine, 7.0));
    // Without gloss there is no highlight; weaker gloss gives a weaker one.
    assert!(by_file.levels(PaintId(2), 1).is_empty() && !by_file.levels(PaintId(1), 1).is_empty());
    assert_eq!(by_file.colour(PaintId(1), 2), by_file.colour(PaintId(1), 1).mix(Colour::WHITE, 0.5));
}

#[test]
fn highlight_ramp_colours_are_added_to_the_lit_tone() {
    let grey = |value: u8| Colour::rgb(value, value, value);
    let strip = Strip::of_columns(&[grey(0), grey(20), grey(60), grey(60)]).unwrap();
    let highlight = Highlight { enabled: true, ramp: Some(strip), ..Highlight::default() };
    let gloss = shading_of_tone_options(&ToneOptions { highlight, ..ToneOptions::default() });
    assert_eq!(gloss.levels(FIRST_PAINT, 1), [0.25, 0.5]);
    let wanted = [ORANGE, Colour::rgb(220, 140, 60), Colour::rgb(255, 180, 100)];
    assert_eq!([1, 2, 3].map(|tone| gloss.colour(FIRST_PAINT, tone)), wanted);
}

#[test]
fn near_highlights_are_local_spots_within_their_value_range() {
    let at = |near: f64| {
        let highlight = Highlight { enabled: true, exponent: 60.0, near, ..Highlight::default() };
        let direction = DVec3::new(0.0, -1.0, 0.2);
        let kind = SourceKind::Directional { direction };
        let source = LightSource { kind, space: Space::World, ..LightSource::default() };
        let light = LightOptions { sources: vec![source], ..LightOptions::default() };
        let options = ToneOptions { highlight, ..ToneOptions::default() };
        shading_and_warnings(&scene(&[("body", ORANGE)]), &light, &options).0
    };
    let (far, spot) = (at(0.0), at(0.5));
    let on_face = |x: f64, z: f64| surface_point(DVec3::new(x, 0.0, z), DVec3::new(0.0, -1.0, 0.1));
    let value = |shading: &Shading, x: f64, z: f64| shading.value(1, FIRST_PAINT, &on_face(x, z), 0);
    assert_near(value(&far, 0.0, 0.0), value(&far, 0.9, -0.9));
    assert!(value(&spot, 0.0, 0.0) > 0.9 && value(&spot, 0.9, 0.0) < 0.1 && value(&spot, 0.0, -0.9) < 0.1);
    for k in 0..40 {
        let (x, z) = (f64::from(k) / 20.0 - 1.0, f64::from(k * 7 % 40) / 20.0 - 1.0);
        for extent in [0.01, 0.1, 0.3] {
            let (low, high) = spot.range(1, FIRST_PAINT, &on_face(x, z), 0, 0.0, extent);
            for (dx, dz) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0), (0.0, 0.0)] {
                let found = value(&spot, x + dx * extent, z + dz * extent);
                assert!(low <= found && found <= high, "{x} {z} {extent}: {found} is not in {low} to {high}");
            }
        }
    }
}
