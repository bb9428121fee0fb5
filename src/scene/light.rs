//! Lights of a model file (KHR_lights_punctual).

use glam::DVec3;

/// What a light is like.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum LightKind {
    /// Parallel light; `direction` is the way it travels, unit length.
    Directional {
        /// Way the light travels, in world space, unit length.
        direction: DVec3,
    },
    /// Light from a point in all directions.
    Point {
        /// Where it is, in world space.
        position: DVec3,
    },
    /// Light from a point into a cone.
    Spot {
        /// Where it is, in world space.
        position: DVec3,
        /// Axis of the cone, away from the light, unit length.
        direction: DVec3,
        /// Half angle inside which the light is full, radians.
        inner_angle: f64,
        /// Half angle outside which there is none, radians.
        outer_angle: f64,
    },
}

/// A light.
#[derive(Debug, Clone, PartialEq)]
pub struct Light {
    /// Name in the file; may be empty.
    pub name: String,
    /// Directional, point or spot.
    pub kind: LightKind,
    /// Linear RGB, 0 to 1.
    pub colour: [f32; 3],
    /// Brightness as in the file (lux or candela).
    pub intensity: f64,
    /// Distance beyond which it gives no light.
    pub range: Option<f64>,
}
