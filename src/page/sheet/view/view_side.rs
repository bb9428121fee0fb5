//! [`Told`]: a length along one side of a view.

use kurbo::{Point, Vec2};

/// The side of a view on which a length stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Side {
    /// On its left.
    Left,
    /// Above it.
    Above,
    /// On its right.
    Right,
    /// Below it.
    Below,
}

impl Side {
    /// All sides.
    pub const ALL: [Self; 4] = [Self::Left, Self::Above, Self::Right, Self::Below];

    /// Whether lengths on this side run across the page.
    #[must_use]
    pub fn is_across(self) -> bool {
        matches!(self, Self::Above | Self::Below)
    }

    /// Away from the view on the page.
    #[must_use]
    pub fn outward(self) -> Vec2 {
        match self {
            Self::Left => Vec2::new(-1.0, 0.0),
            Self::Above => Vec2::new(0.0, -1.0),
            Self::Right => Vec2::new(1.0, 0.0),
            Self::Below => Vec2::new(0.0, 1.0),
        }
    }
}

/// A length that is to be told on a side of a view.
#[derive(Debug, Clone, PartialEq)]
pub struct Told {
    /// Between these points of the page.
    pub ends: [Point; 2],
    /// Its side.
    pub side: Side,
    /// What it says.
    pub text: String,
}

impl Told {
    /// From where to where it goes along its side, as it grows to the right or downwards.
    #[must_use]
    pub fn span(&self) -> [f64; 2] {
        let at = |p: Point| if self.side.is_across() { p.x } else { p.y };
        let [a, b] = self.ends.map(at);
        [a.min(b), a.max(b)]
    }
}
