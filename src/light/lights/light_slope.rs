//! [`LightSlope`]: bounds for the change of parallel light with the normal.

/// Largest ratio of the angle between two unit normals to their distance, up to a quarter turn.
pub(crate) const TURN_PER_CHORD: f64 = 1.12;

/// Bounds for the change of light that depends on the normal alone.
///
/// Each light gives max(L·n, 0). This is linear in the normal, apart from the curvature of the sphere, and
/// convex where the light ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LightSlope {
    /// Largest change of light per radian of the normal.
    pub most: f64,
    /// Whether one light may end where another begins, so that there is less light between two points than at
    /// either.
    pub dips: bool,
}

impl LightSlope {
    /// Bounds of the light at all normals between some with a light of `low` to `high`. No two of these are
    /// farther apart than `turn` (distance of unit vectors).
    #[inline]
    #[must_use]
    pub(crate) fn between(&self, [low, high]: [f64; 2], turn: f64) -> [f64; 2] {
        // Light in between differs from that at one end by at most the turn of the normals. It differs from
        // the linear interpolation by at most a part of the square of that.
        let near = turn * TURN_PER_CHORD;
        let bent = near.min(turn * turn);
        [low - if self.dips { near } else { bent } * self.most, high + bent * self.most]
    }
}
