//! [`Sample`]: what a chain knows of the world at one of its points.

use crate::colour::srgb::Colour;

/// What a chain knows of the world at one of its points; travels with the chain so that strokes
/// never look back into the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Distance from the eye along the optical axis, world units.
    pub depth: f64,
    /// How strong the line is here, 0 to 1. Only suggestive contours, ridges and valleys are ever
    /// weaker than 1.
    pub strength: f64,
    /// The diffuse light on the surface beside the line, 0 to 1; 1 where nobody asked.
    pub light: f64,
    /// How far what lies behind the line is from it, 0 to 1; 1 before background, and where nobody
    /// asked.
    pub gap: f64,
    /// On which side of the line, as it runs, the nearer surface lies: 1 on the left, -1 on the right, 0
    /// where both are as near, and where nobody asked.
    pub side: f64,
    /// What is seen beside the line.
    pub under: Under,
    /// Where on the model this is.
    pub anchor: Anchor,
}

/// Where on a model a point of a line is, the same however the model is posed and seen; where anybody asked.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Anchor {
    /// A place in the part as it rests: in diagonals of its box, from its middle.
    pub place: [f32; 3],
    /// User units of the page in such a diagonal, as it is seen here; 0 where nothing is known.
    pub scale: f32,
}

impl Anchor {
    /// Whether anybody asked.
    #[must_use]
    pub fn is_known(&self) -> bool {
        self.scale > 0.0
    }

    /// Between two anchors, at part `t` of the way.
    #[must_use]
    pub fn lerp(self, to: Self, t: f64) -> Self {
        if !(self.is_known() && to.is_known()) {
            return if self.is_known() { self } else { to };
        }
        let mix = |a: f32, b: f32| (f64::from(a) + (f64::from(b) - f64::from(a)) * t) as f32;
        let place = [0, 1, 2].map(|axis| mix(self.place[axis], to.place[axis]));
        Self { place, scale: mix(self.scale, to.scale) }
    }
}

/// What is seen beside a line at one of its points, where anybody asked.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Under {
    /// The colour of the surface that the line belongs to, as it is without light.
    pub colour: Option<Colour>,
    /// How far to both sides of the line there is nothing but spot blacks, user units.
    pub black: f64,
}

impl Sample {
    /// A sample of which only depth and strength are known.
    #[must_use]
    pub const fn new(depth: f64, strength: f64) -> Self {
        Self {
            depth,
            strength,
            light: 1.0,
            gap: 1.0,
            side: 0.0,
            under: Under { colour: None, black: 0.0 },
            anchor: Anchor { place: [0.0; 3], scale: 0.0 },
        }
    }

    /// What lies between two points of a line, at part `t` of the way.
    #[must_use]
    pub fn lerp(self, to: Self, t: f64) -> Self {
        let mix = |from: f64, to: f64| from + (to - from) * t;
        Self {
            depth: mix(self.depth, to.depth),
            strength: mix(self.strength, to.strength),
            light: mix(self.light, to.light),
            gap: mix(self.gap, to.gap),
            side: mix(self.side, to.side),
            // Colours of surfaces do not mix.
            under: if t < 0.5 { self.under } else { to.under },
            anchor: self.anchor.lerp(to.anchor, t),
        }
    }
}
