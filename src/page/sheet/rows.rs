//! [`rows`]: lengths along one side of a view, stacked in rows so that none lies on another.

use kurbo::Point;

use super::dimension::ARROW;

/// From the view to the first row, and from row to row, mm.
pub(super) const FIRST: f64 = 9.0;
pub(super) const STEP: f64 = 7.5;

/// Room between two lengths in a row, mm.
const APART: f64 = 2.0;

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
}

/// A length that is to be told on a side of a view.
#[derive(Debug, Clone, PartialEq)]
pub struct Told {
    /// Between these points of the page.
    pub ends: [Point; 2],
    /// Its side.
    pub side: Side,
    /// What it says, and how wide that is, mm.
    pub text: String,
    /// Width of the text, mm.
    pub wide: f64,
}

impl Told {
    /// From where to where it goes along its side, as it grows to the right or downwards.
    fn span(&self) -> [f64; 2] {
        let at = |p: Point| if self.side.is_across() { p.x } else { p.y };
        let [a, b] = self.ends.map(at);
        [a.min(b), a.max(b)]
    }

    /// The same with arrows and text where they have no room within.
    fn taken(&self) -> [f64; 2] {
        let [low, high] = self.span();
        let length = high - low;
        let out = if length >= 2.0 * ARROW + 1.0 { 0.0 } else { 2.0 * ARROW };
        let beside = out > 0.0 || self.wide >= length - 2.0 * ARROW;
        let text = if beside { 2.0 * ARROW + self.wide } else { 0.0 };
        // Text stands behind the second end, as it was given.
        let at = |p: Point| if self.side.is_across() { p.x } else { p.y };
        let forward = at(self.ends[1]) >= at(self.ends[0]);
        let (before, after) = if forward { (out, text.max(out)) } else { (text.max(out), out) };
        [low - before - APART / 2.0, high + after + APART / 2.0]
    }
}

/// The row of each length, those of each side from 0 on outwards: shorter ones are nearer to the view, so that no line that leads to a
/// longer one around them crosses them, and in one row nothing overlaps.
#[must_use]
pub fn rows(lengths: &[Told]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..lengths.len()).collect();
    let long = |k: usize| lengths[k].span()[1] - lengths[k].span()[0];
    order.sort_by(|a, b| {
        let low = |k: usize| lengths[k].span()[0];
        long(*a).total_cmp(&long(*b)).then(low(*a).total_cmp(&low(*b))).then(a.cmp(b))
    });
    let mut rows = vec![0; lengths.len()];
    let mut done: Vec<usize> = Vec::new();
    for own in order {
        let [low, high] = lengths[own].taken();
        let meets = |other: &&usize| {
            let [from, to] = lengths[**other].taken();
            lengths[**other].side == lengths[own].side && from < high && low < to
        };
        rows[own] = done.iter().filter(meets).map(|other| rows[*other] + 1).max().unwrap_or(0);
        done.push(own);
    }
    rows
}
