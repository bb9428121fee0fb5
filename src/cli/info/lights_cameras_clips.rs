//! Lights, cameras and animations of a model file.

use serde::Serialize;

use super::text_lists::named;
use crate::animation::Clip;
use crate::cli::output::number_text::short;
use crate::scene::{Light, LightKind, NamedCamera, Projection};

/// Name and kind of a light.
#[derive(Debug, Serialize)]
pub(crate) struct LightInfo {
    name: String,
    kind: &'static str,
}

/// Name and projection of a camera.
#[derive(Debug, Serialize)]
pub(crate) struct CameraInfo {
    name: String,
    r#type: &'static str,
}

/// Time span and key rate of an animation.
#[derive(Debug, Serialize)]
pub(crate) struct ClipInfo {
    name: String,
    /// Start and end, seconds.
    from: f64,
    to: f64,
    /// Highest number of keys per second; none with fewer than two keys.
    rate: Option<f64>,
}

impl LightInfo {
    /// Name and kind of a light.
    pub(crate) fn of(light: &Light) -> Self {
        let kind = match light.kind {
            LightKind::Directional { .. } => "directional",
            LightKind::Point { .. } => "point",
            LightKind::Spot { .. } => "spot",
        };
        Self { name: light.name.clone(), kind }
    }

    /// Entry of the light in the text.
    pub(crate) fn line(&self) -> String {
        aside(&self.name, self.kind)
    }
}

impl CameraInfo {
    /// Name and projection of a camera.
    pub(crate) fn of(named: &NamedCamera) -> Self {
        let r#type = match named.camera.projection {
            Projection::Perspective { .. } => "perspective",
            Projection::Orthographic { .. } => "orthographic",
        };
        Self { name: named.name.clone(), r#type }
    }

    /// Entry of the camera in the text.
    pub(crate) fn line(&self) -> String {
        aside(&self.name, self.r#type)
    }
}

impl ClipInfo {
    /// Name, time span and key rate of an animation.
    pub(crate) fn of(clip: &Clip) -> Self {
        let [from, to] = clip.span();
        Self { name: clip.name.clone(), from, to, rate: clip.rate() }
    }

    /// Entry of the animation in the text.
    pub(crate) fn line(&self) -> String {
        let begins = if self.from == 0.0 { String::new() } else { format!(", from {} s", short(self.from)) };
        let keys = |rate: f64| {
            let rate = short(rate);
            format!(", {rate} {} a second", if rate == "1" { "key" } else { "keys" })
        };
        let keys = self.rate.map_or_else(String::new, keys);
        format!("{}: {} s{begins}{keys}", named(&self.name), short(self.to - self.from))
    }
}

fn aside(name: &str, kind: &str) -> String {
    format!("{}: {kind}", named(name))
}
