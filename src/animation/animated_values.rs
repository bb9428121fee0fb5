//! [`AnimatedValues`]: animated values of cameras, lights and materials while clips play.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use super::clip::{AnimationTarget, CameraProperty, Clip, LightProperty, MaterialProperty, Playing};
use super::material_factors::MaterialFactors;
use super::rig::blend_values;
use super::track::Track;
use crate::scene::{Camera, Light, LightKind, Projection};

/// Animated values of cameras, lights and materials, with their tracks, times and weights.
///
/// Invalid values, such as a negative angle of view between the keys of a cubic, are replaced by the stored
/// ones.
pub(crate) struct AnimatedValues<'a>(BTreeMap<AnimationTarget, Vec<(&'a Track, f64, f64)>>);

impl<'a> AnimatedValues<'a> {
    pub(crate) fn new(clips: &'a [Clip], playing: &[Playing]) -> Self {
        let mut moved: BTreeMap<AnimationTarget, Vec<_>> = BTreeMap::new();
        for Playing { clip, time, weight } in playing.iter().filter(|playing| playing.weight > 0.0) {
            let channels = clips.get(*clip).into_iter().flat_map(|clip| &clip.channels);
            for channel in channels.filter(|channel| channel.target.of_node().is_none()) {
                moved.entry(channel.target).or_default().push((&channel.track, *time, *weight));
            }
        }
        Self(moved)
    }

    /// Present value, given its rest value; `None` if nothing animates it.
    fn of<const N: usize>(&self, target: AnimationTarget, rest: [f64; N]) -> Option<[f64; N]> {
        let tracks = self.0.get(&target)?;
        let mut now = rest;
        for (number, own) in now.iter_mut().enumerate() {
            let values = tracks
                .iter()
                .filter_map(|(track, time, weight)| Some((*track.at(*time).get(number)?, *weight)));
            *own = blend_values(*own, values);
        }
        now.iter().all(|value| value.is_finite()).then_some(now)
    }

    /// Camera `number` of the file with its present properties.
    pub(crate) fn camera(&self, number: usize, mut camera: Camera) -> Camera {
        let of = |lens, rest: f64| Some(self.of(AnimationTarget::Camera(number, lens), [rest])?[0]);
        let positive = |value: &f64| *value > 0.0;
        let aspect = camera.width / camera.height;
        let near = of(CameraProperty::Near, camera.near.unwrap_or(0.0));
        match &mut camera.projection {
            Projection::Perspective { fov_y_deg } => {
                let angle = of(CameraProperty::FieldOfView, fov_y_deg.to_radians());
                *fov_y_deg = angle.filter(|a| *a > 0.0 && *a < PI).map_or(*fov_y_deg, f64::to_degrees);
                let aspect = of(CameraProperty::Aspect, aspect).filter(positive);
                camera.width = aspect.map_or(camera.width, |aspect| camera.height * aspect);
                camera.near = near.filter(positive).or(camera.near);
            }
            Projection::Orthographic { height } => {
                // Magnifications may be negative, as at rest.
                let (x, y) = (*height / 2.0 * aspect, *height / 2.0);
                let half = |lens, rest: f64| of(lens, rest).map(f64::abs).filter(positive);
                let (now_x, now_y) =
                    (half(CameraProperty::HalfWidth, x), half(CameraProperty::HalfHeight, y));
                *height = now_y.map_or(*height, |y| 2.0 * y);
                if now_x.is_some() || now_y.is_some() {
                    camera.width = camera.height * (now_x.unwrap_or(x) / now_y.unwrap_or(y));
                }
                camera.near = near.or(camera.near);
            }
        }
        camera
    }

    /// Sets the present properties of light `number` of the file.
    pub(crate) fn light(&self, number: usize, light: &mut Light) {
        let of = |shine, rest: f64| Some(self.of(AnimationTarget::Light(number, shine), [rest])?[0]);
        if let Some(colour) =
            self.of(AnimationTarget::Light(number, LightProperty::Colour), light.colour.map(f64::from))
        {
            light.colour = colour.map(|channel| channel.max(0.0) as f32);
        }
        let at_least_none = |value: &f64| *value >= 0.0;
        light.intensity =
            of(LightProperty::Intensity, light.intensity).filter(at_least_none).unwrap_or(light.intensity);
        light.range = of(LightProperty::Range, light.range.unwrap_or(f64::INFINITY)).or(light.range);
        if let LightKind::Spot { inner_angle, outer_angle, .. } = &mut light.kind {
            *inner_angle =
                of(LightProperty::InnerAngle, *inner_angle).filter(at_least_none).unwrap_or(*inner_angle);
            *outer_angle =
                of(LightProperty::OuterAngle, *outer_angle).filter(at_least_none).unwrap_or(*outer_angle);
        }
    }

    /// Present values of a material; `None` if nothing animates them.
    pub(crate) fn material(&self, number: usize, rest: &MaterialFactors) -> Option<MaterialFactors> {
        let target = |finish| AnimationTarget::Material(number, finish);
        let one = |finish, rest: f32| Some(self.of(target(finish), [f64::from(rest)])?[0] as f32);
        let base = self.of(target(MaterialProperty::Base), rest.base.map(f64::from));
        let emissive =
            rest.emissive.map(|rest| self.of(target(MaterialProperty::Emissive), rest.map(f64::from)));
        let now = MaterialFactors {
            base: base.map_or(rest.base, |base| base.map(|channel| channel as f32)),
            emissive: emissive.flatten().map(|own| own.map(|channel| channel as f32)).or(rest.emissive),
            cutoff: one(MaterialProperty::Cutoff, rest.cutoff).unwrap_or(rest.cutoff),
            roughness: one(MaterialProperty::Roughness, rest.roughness.unwrap_or(1.0)).or(rest.roughness),
            transmission: one(MaterialProperty::Transmission, rest.transmission).unwrap_or(rest.transmission),
            ..*rest
        };
        (now != *rest).then_some(now)
    }
}
