//! [`SideLength`]: a length along one side of a view.

use kurbo::{Point, Vec2};

/// A side of a view.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum ViewSide {
    /// The left side.
    Left,
    /// Above the view.
    Above,
    /// The right side.
    Right,
    /// Below the view.
    Below,
}

impl ViewSide {
    /// All sides.
    pub(crate) const ALL: [Self; 4] = [Self::Left, Self::Above, Self::Right, Self::Below];

    /// Whether lengths on this side are horizontal.
    #[must_use]
    pub(crate) fn is_across(self) -> bool {
        matches!(self, Self::Above | Self::Below)
    }

    /// Unit vector away from the view, y down.
    #[must_use]
    pub(crate) fn outward(self) -> Vec2 {
        match self {
            Self::Left => Vec2::new(-1.0, 0.0),
            Self::Above => Vec2::new(0.0, -1.0),
            Self::Right => Vec2::new(1.0, 0.0),
            Self::Below => Vec2::new(0.0, 1.0),
        }
    }
}

/// A length along a side of a view.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SideLength {
    /// Its two points, page mm.
    pub ends: [Point; 2],
    /// The side of the view.
    pub side: ViewSide,
    /// The text of the dimension.
    pub text: String,
}

impl SideLength {
    /// Its extent along the side, in rising order: x on horizontal sides, y on vertical ones.
    #[must_use]
    pub(crate) fn span(&self) -> [f64; 2] {
        let at = |p: Point| if self.side.is_across() { p.x } else { p.y };
        let [a, b] = self.ends.map(at);
        [a.min(b), a.max(b)]
    }
}
