//! Lights of a model file (KHR_lights_punctual).

use glam::DVec3;

/// Kind and geometry of a light.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum LightKind {
    /// Parallel light.
    Directional {
        /// Direction of travel of the light, in world space, unit length.
        direction: DVec3,
    },
    /// Light from a point in all directions.
    Point {
        /// Position in world space.
        position: DVec3,
    },
    /// Light from a point into a cone.
    Spot {
        /// Position in world space.
        position: DVec3,
        /// Axis of the cone, pointing away from the light, unit length.
        direction: DVec3,
        /// Half angle within which the light has full intensity, radians.
        inner_angle: f64,
        /// Half angle outside which there is no light, radians.
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
    /// Brightness as stored in the file (lux or candela).
    pub intensity: f64,
    /// Maximum distance that the light reaches.
    pub range: Option<f64>,
}
