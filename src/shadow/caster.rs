//! [`Caster`]: a light that casts shadows.

use glam::DVec3;

/// A light that casts shadows, in local space: relative to the origin of the mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Caster {
    /// Parallel light.
    Directional {
        /// Towards the light; any length but 0.
        towards: DVec3,
    },
    /// Light from a point.
    Point {
        /// Where it is.
        position: DVec3,
    },
}

impl Caster {
    /// The direction from a point towards the light, of any length.
    #[must_use]
    pub fn towards(&self, point: DVec3) -> DVec3 {
        match *self {
            Self::Directional { towards } => towards,
            Self::Point { position } => position - point,
        }
    }
}
