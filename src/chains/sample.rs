//! [`Sample`]: depth, light, surroundings and anchor at one point of a chain.

use crate::colour::srgb::Colour;

/// Properties of the scene at one point of a chain. Strokes read these and need no access to the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sample {
    /// Distance from the camera along the optical axis, world units.
    pub depth: f64,
    /// Strength of the line, 0 to 1. Only suggestive contours, ridges and valleys are weaker than 1.
    pub strength: f64,
    /// Diffuse light on the surface next to the line, 0 to 1; 1 if not computed.
    pub light: f64,
    /// Distance from the line to the surface behind it, 0 to 1; 1 against the background, and if not
    /// computed.
    pub gap: f64,
    /// Side of the nearer surface, seen along the line: 1 left, -1 right; 0 if both are equally near, and if
    /// not computed.
    pub side: f64,
    /// Colours next to the line.
    pub backdrop: LineBackdrop,
    /// Position on the model.
    pub anchor: Anchor,
}

/// Position on the model that does not depend on pose and view. Known only if computed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Anchor {
    /// Position in the part's rest pose, in diagonals of its bounding box, relative to its centre.
    pub rest_position: [f32; 3],
    /// Length of one such diagonal on the page at this point, user units; 0 if unknown.
    pub scale: f32,
}

impl Anchor {
    /// Whether the anchor was computed.
    #[must_use]
    pub(crate) fn is_known(&self) -> bool {
        self.scale > 0.0
    }

    /// Linear interpolation between two anchors at parameter `t`.
    #[must_use]
    pub(crate) fn lerp(self, to: Self, t: f64) -> Self {
        if !(self.is_known() && to.is_known()) {
            return if self.is_known() { self } else { to };
        }
        let mix = |a: f32, b: f32| (f64::from(a) + (f64::from(b) - f64::from(a)) * t) as f32;
        let place = [0, 1, 2].map(|axis| mix(self.rest_position[axis], to.rest_position[axis]));
        Self { rest_position: place, scale: mix(self.scale, to.scale) }
    }
}

/// Colours next to a line at one of its points. Known only if computed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct LineBackdrop {
    /// Unlit colour of the surface that the line belongs to.
    pub colour: Option<Colour>,
    /// Distance to both sides of the line that is covered by spot blacks only, user units.
    pub black: f64,
}

impl Sample {
    /// A sample with known depth and strength, and defaults for the rest.
    #[must_use]
    pub(crate) const fn new(depth: f64, strength: f64) -> Self {
        Self {
            depth,
            strength,
            light: 1.0,
            gap: 1.0,
            side: 0.0,
            backdrop: LineBackdrop { colour: None, black: 0.0 },
            anchor: Anchor { rest_position: [0.0; 3], scale: 0.0 },
        }
    }

    /// Linear interpolation between two samples at parameter `t`.
    #[must_use]
    pub(crate) fn lerp(self, to: Self, t: f64) -> Self {
        let mix = |from: f64, to: f64| from + (to - from) * t;
        Self {
            depth: mix(self.depth, to.depth),
            strength: mix(self.strength, to.strength),
            light: mix(self.light, to.light),
            gap: mix(self.gap, to.gap),
            side: mix(self.side, to.side),
            // Surface colours are not interpolated.
            backdrop: if t < 0.5 { self.backdrop } else { to.backdrop },
            anchor: self.anchor.lerp(to.anchor, t),
        }
    }
}
