//! [`Slope`]: how much parallel light may change with the normal.

/// The angle between two unit normals is no more than so many times their distance (up to a quarter turn).
pub(crate) const TURN_OF_CHORD: f64 = 1.12;

/// How much light that follows from the normal alone may change with it.
///
/// Each light gives max(L·n, 0): straight in the normal but for its bend on the sphere, and where it ends, convex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slope {
    /// By how much light changes at most with the angle of the normal, per radian.
    pub most: f64,
    /// Whether one light may end where another one begins, so that there is less of both between two points than at either.
    pub dips: bool,
}

impl Slope {
    /// Bounds of the light at all normals between some that get as much as `low` to `high`, and of which no two are
    /// farther apart than `turn` (distance of unit vectors).
    #[inline]
    #[must_use]
    pub fn between(&self, [low, high]: [f64; 2], turn: f64) -> [f64; 2] {
        // What is between differs from one of the ends by no more than normals turn, and from what is straight between them
        // by no more than a part of the square of that.
        let near = turn * TURN_OF_CHORD;
        let bent = near.min(turn * turn);
        [low - if self.dips { near } else { bent } * self.most, high + bent * self.most]
    }
}
