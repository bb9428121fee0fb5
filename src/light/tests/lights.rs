//! Light at points.

use glam::DVec3;

use super::{assert_near, empty_mesh, frame, shading_and_warnings, surface_point};
use crate::geometry::numbers::portable_math::{cos, sin};
use crate::light::lights::light_options::{LightSource, SourceKind, Space};
use crate::light::{Caster, LightOptions, Shading, ToneOptions};
use crate::mesh::PaintId;
use crate::scene::{Light, LightKind, Scene};

const ANY_PAINT: PaintId = PaintId(0);

fn directional(direction: DVec3) -> LightSource {
    LightSource { kind: SourceKind::Directional { direction }, space: Space::World, ..LightSource::default() }
}

fn lamp(position: DVec3, falloff: Option<f64>) -> LightSource {
    LightSource { kind: SourceKind::Point { position, falloff }, ..directional(DVec3::Z) }
}

fn lit_by(sources: Vec<LightSource>) -> LightOptions {
    LightOptions { sources, ..LightOptions::default() }
}

fn light_value(light: &LightOptions, position: DVec3, normal: DVec3) -> f64 {
    let (shading, _) = shading_and_warnings(&Scene::default(), light, &ToneOptions::default());
    shading.value(0, ANY_PAINT, &surface_point(position, normal), 0)
}

fn model_light(kind: LightKind, intensity: f64) -> Light {
    Light { name: String::new(), kind, colour: [1.0; 3], intensity, range: None }
}

fn model_light_value(lights: Vec<Light>, position: DVec3, normal: DVec3) -> f64 {
    let scene = Scene { lights, ..Scene::default() };
    let (shading, _) = shading_and_warnings(&scene, &LightOptions::default(), &ToneOptions::default());
    shading.value(0, ANY_PAINT, &surface_point(position, normal), 0)
}

#[test]
fn a_directional_light_gives_lambert_cosine_with_optional_wrap() {
    let light = lit_by(vec![directional(DVec3::new(0.0, 0.0, 3.0))]);
    for angle in [0.0, 0.3, 1.1, 1.6, 3.0] {
        let normal = DVec3::new(sin(angle), 0.0, cos(angle)).normalize();
        let exactly = normal.dot(DVec3::Z).max(0.0);
        assert_eq!(light_value(&light, DVec3::ZERO, normal), exactly);
    }
    assert_eq!(light_value(&LightOptions { wrap: 1.0, ..light.clone() }, DVec3::ZERO, DVec3::X), 0.5);
    assert_near(light_value(&LightOptions { wrap: 0.5, ..light }, DVec3::ZERO, DVec3::NEG_Z), 0.0);
}

#[test]
fn shading_slope_bounds_the_light_between_normals() {
    let sky = [DVec3::X, DVec3::NEG_X, DVec3::new(0.3, 0.9, 0.2), DVec3::new(-0.5, 0.1, -0.8)];
    let mut within = 0;
    for (lamps, wrap) in [(1, 0.0), (1, 0.4), (2, 0.0), (4, 0.0), (4, 0.3)] {
        let sources = sky[..lamps].iter().map(|towards| directional(*towards)).collect();
        let light = LightOptions { wrap, ..lit_by(sources) };
        let (shading, _) = shading_and_warnings(&Scene::default(), &light, &ToneOptions::default());
        let at = |normal: DVec3| shading.value(0, ANY_PAINT, &surface_point(DVec3::ZERO, normal), 0);
        for k in 0..400 {
            // Triangles of unit vectors, mostly small. Every other one is on the terminators of the first two
            // lights.
            let unit =
                |axis: u64| crate::geometry::numbers::noise::hash(k, &[axis]) as f64 / u64::MAX as f64 - 0.5;
            let middle = DVec3::new(if k % 2 == 0 { 0.0 } else { unit(0) }, unit(1), unit(2)).normalize();
            let size = [0.01, 0.05, 0.3, 1.0][k as usize % 4];
            let corners = [3, 6, 9].map(|axis| {
                (middle + size * DVec3::new(unit(axis), unit(axis + 1), unit(axis + 2))).normalize()
            });
            let [a, b, c] = corners;
            let turn = a.distance(b).max(b.distance(c)).max(c.distance(a));
            let (low, high) = corners
                .map(at)
                .iter()
                .fold((f64::MAX, 0.0_f64), |(low, high), value| (low.min(*value), high.max(*value)));
            let [low, high] = shading.slope().between([low, high], turn);
            for (i, j) in
                (0..=12).flat_map(|i| (0..=12 - i).map(move |j| (f64::from(i) / 12.0, f64::from(j) / 12.0)))
            {
                let value = at((a * i + b * j + c * (1.0 - i - j)).normalize());
                assert!(
                    (low - 1e-12..=high + 1e-12).contains(&value),
                    "{value} not in {low}..{high}, {lamps} lamps"
                );
                within += 1;
            }
        }
    }
    assert_eq!(within, 5 * 400 * 91);
}

#[test]
fn light_values_add_up_by_brightness_regardless_of_colour() {
    let red = LightSource {
        brightness: 0.5,
        colour: crate::colour::srgb::Colour::rgb(255, 0, 0),
        ..directional(DVec3::X)
    };
    let light = lit_by(vec![directional(DVec3::Z), red]);
    let normal = DVec3::new(0.6, 0.0, 0.8);
    assert_near(light_value(&light, DVec3::ZERO, normal), 0.8 + 0.5 * 0.6);
}

#[test]
fn point_light_falls_to_half_at_its_falloff_distance() {
    let at = DVec3::new(0.0, 0.0, 3.0);
    assert_near(light_value(&lit_by(vec![lamp(at, Some(3.0))]), DVec3::ZERO, DVec3::Z), 0.5);
    assert_near(light_value(&lit_by(vec![lamp(at, Some(1.0))]), DVec3::ZERO, DVec3::Z), 0.1);
    assert_near(light_value(&lit_by(vec![lamp(at, None)]), DVec3::ZERO, DVec3::Z), 1.0);
    let aside = DVec3::new(4.0, 0.0, 0.0);
    assert_near(light_value(&lit_by(vec![lamp(at, None)]), aside, DVec3::Z), 0.6);
    // At the lamp itself there is no direction to it.
    assert_eq!(light_value(&lit_by(vec![lamp(at, Some(1.0))]), at, DVec3::Z), 0.0);
}

#[test]
fn camera_space_lights_turn_with_the_camera() {
    let eyes = [DVec3::new(0.0, -9.0, 0.0), DVec3::new(5.0, 5.0, 7.0)];
    let tones = ToneOptions::default();
    for source in [LightSource::default(), lamp(DVec3::new(1.0, 2.0, -3.0), Some(2.0))] {
        let light = lit_by(vec![LightSource { space: Space::Camera, ..source }]);
        let [first, second] = eyes.map(|eye| {
            let frame = frame(eye);
            let shading =
                Shading::new(&Scene::default(), &[], &empty_mesh(), &frame, &light, &tones, &mut Vec::new());
            // Point with the same position relative to either camera.
            let normal = frame.right * 0.36 + frame.up * 0.48 - frame.forward * 0.8;
            let position = frame.eye + frame.forward * 5.0 - frame.right;
            shading.value(0, ANY_PAINT, &surface_point(position, normal), 0)
        });
        assert_near(first, second);
        assert!(first > 0.1);
    }
    // Without lights, there is one to the upper left of the viewer.
    let key = DVec3::new(-0.4, 0.6, 0.7).normalize();
    let world = DVec3::new(key.x, -key.z, key.y);
    assert_near(light_value(&LightOptions::default(), DVec3::ZERO, world), 1.0);
}

#[test]
fn model_lights_are_scaled_so_the_brightest_gives_one_at_the_target() {
    let point_light = LightKind::Point { position: DVec3::new(0.0, 0.0, 6.0) };
    let sun = LightKind::Directional { direction: DVec3::NEG_X };
    // 3600 candela at 6 units are 100 lux.
    let both = vec![model_light(point_light, 3600.0), model_light(sun, 25.0)];
    assert_near(model_light_value(both.clone(), DVec3::ZERO, DVec3::Z), 1.0);
    assert_near(model_light_value(both.clone(), DVec3::ZERO, DVec3::X), 0.25);
    assert_near(model_light_value(both, DVec3::new(0.0, 0.0, 3.0), DVec3::Z), 4.0);
    // A lamp near the target counts as a quarter of the frame's side of 2 away.
    let inside = vec![model_light(LightKind::Point { position: DVec3::ZERO }, 7.0)];
    assert_near(model_light_value(inside, DVec3::new(0.0, 0.0, -0.5), DVec3::Z), 1.0);
}

#[test]
fn spot_light_cones_and_ranges_follow_the_model_file() {
    let spot = |inner_angle: f64, outer_angle: f64| LightKind::Spot {
        position: DVec3::new(0.0, 0.0, 4.0),
        direction: DVec3::NEG_Z,
        inner_angle,
        outer_angle,
    };
    let at = |x: f64| DVec3::new(x, 0.0, 0.0);
    let lights = |inner, outer| vec![model_light(spot(inner, outer), 16.0)];
    assert_near(model_light_value(lights(0.2, 0.5), at(0.0), DVec3::Z), 1.0);
    assert_eq!(model_light_value(lights(0.2, 0.5), at(4.0), DVec3::Z), 0.0);
    // At 45 degrees: 16/32 cd/d², cosine 1/√2, half-way between the cosines of the cone, squared.
    let (inner, outer) = (
        crate::geometry::numbers::portable_math::acos(0.9_f64),
        crate::geometry::numbers::portable_math::acos(2.0_f64.sqrt() - 0.9),
    );
    assert_near(model_light_value(lights(inner, outer), at(4.0), DVec3::Z), 0.5 * 0.5_f64.sqrt() * 0.25);
    let ranged = Light { range: Some(5.0), ..model_light(spot(1.0, 1.2), 16.0) };
    assert_near(model_light_value(vec![ranged.clone()], at(0.0), DVec3::Z), 1.0 - 0.8_f64 * 0.8 * 0.8 * 0.8);
    assert_eq!(model_light_value(vec![ranged], at(3.1), DVec3::Z), 0.0);
}

#[test]
fn lights_without_output_are_replaced_by_the_default_with_a_warning() {
    let dark = vec![model_light(LightKind::Point { position: DVec3::Z }, 0.0)];
    let scene = Scene { lights: dark, ..Scene::default() };
    let (shading_, warnings) =
        shading_and_warnings(&scene, &LightOptions::default(), &ToneOptions::default());
    assert_eq!(warnings, ["the model's lights give no light and are left out"]);
    assert!(shading_.value(0, ANY_PAINT, &surface_point(DVec3::ZERO, DVec3::NEG_Y), 0) > 0.5);
    let black = LightSource { brightness: 0.0, ..LightSource::default() };
    let (_, warnings) =
        shading_and_warnings(&Scene::default(), &lit_by(vec![black]), &ToneOptions::default());
    assert_eq!(warnings.len(), 1);
    let ignored = LightOptions { from_model: false, ..LightOptions::default() };
    assert!(shading_and_warnings(&scene, &ignored, &ToneOptions::default()).1.is_empty());
}

#[test]
fn shadowed_lights_add_nothing_and_at_most_eight_cast_shadows() {
    let mut sources = vec![directional(DVec3::Z); 10];
    sources[0].shadows = false;
    sources[2] = lamp(DVec3::new(0.0, 0.0, 5.0), None);
    let tones = ToneOptions { cast_shadows: true, ..ToneOptions::default() };
    let (shading_, warnings) = shading_and_warnings(&Scene::default(), &lit_by(sources.clone()), &tones);
    assert_eq!(shading_.casters().len(), 8);
    assert_eq!(shading_.casters()[0], Caster::Directional { towards: DVec3::Z });
    assert_eq!(shading_.casters()[1], Caster::Point { position: DVec3::new(0.0, 0.0, 5.0) });
    assert_eq!(warnings, ["9 lights would cast shadows; only the first 8 do"]);
    let at = surface_point(DVec3::ZERO, DVec3::Z);
    for (shadowed, left) in [(0, 10.0), (0b10, 9.0), (0xff, 2.0)] {
        assert_near(shading_.value(0, ANY_PAINT, &at, shadowed), left);
    }
    let (without, _) = shading_and_warnings(&Scene::default(), &lit_by(sources), &ToneOptions::default());
    assert!(without.casters().is_empty());
}

#[test]
fn occlusion_darkens_points_and_invalid_normals_face_the_camera() {
    let light = LightOptions { occlusion: 0.5, ..lit_by(vec![directional(DVec3::NEG_Y)]) };
    let (shading_, _) = shading_and_warnings(&Scene::default(), &light, &ToneOptions::default());
    let mut at = surface_point(DVec3::ZERO, DVec3::ZERO);
    assert_near(shading_.value(0, ANY_PAINT, &at, 0), 1.0);
    at.ambient_visibility = 0.5;
    assert_near(shading_.value(0, ANY_PAINT, &at, 0), 0.75);
    at.normal = DVec3::NAN;
    assert_near(shading_.value(0, ANY_PAINT, &at, 0), 0.75);
}

#[test]
fn border_cosines_are_those_where_the_light_reaches_a_level() {
    for (wrap, brightness) in [(0.0, 1.0), (0.4, 1.0), (0.4, 0.7)] {
        let source = LightSource { brightness, ..directional(DVec3::new(0.0, 3.0, 4.0)) };
        let light = LightOptions { wrap, ..lit_by(vec![source]) };
        let (shading, _) = shading_and_warnings(&Scene::default(), &light, &ToneOptions::default());
        let (towards, cosines) = shading.border_cosines().expect("one parallel light");
        assert_near(towards.distance(DVec3::new(0.0, 0.6, 0.8)), 0.0);
        let levels = shading.levels(ANY_PAINT, 0);
        assert_eq!(cosines.len(), levels.len());
        for (cosine, level) in cosines.into_iter().zip(levels).filter(|(cosine, _)| cosine.abs() < 1.0) {
            let across = DVec3::X * (1.0 - cosine * cosine).sqrt();
            assert_near(light_value(&light, DVec3::ZERO, towards * cosine + across), *level);
        }
    }
    let several = lit_by(vec![directional(DVec3::Z), directional(DVec3::X)]);
    let near = lit_by(vec![lamp(DVec3::Z, None)]);
    let dimmed = LightOptions { occlusion: 0.5, ..lit_by(vec![directional(DVec3::Z)]) };
    for light in [several, near, dimmed] {
        let (shading, _) = shading_and_warnings(&Scene::default(), &light, &ToneOptions::default());
        assert!(shading.border_cosines().is_none());
    }
}
