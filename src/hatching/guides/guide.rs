//! [`Guide`]: a line along which strokes are laid, and its rank.
//!
//! Ranks make hatching nested: a guide is inked where the tone wants more than its rank. A darker tone
//! therefore keeps the strokes of a lighter one and adds more.
//!
//! Source: Praun, Hoppe, Webb and Finkelstein, "Real-time hatching", SIGGRAPH 2001, section 3, which nests
//! textures.

use kurbo::{Point, Vec2};

use crate::geometry::numbers::noise::{hash, unit_interval};
use crate::geometry::numbers::portable_math::{cos, sin};
use crate::mesh::PartId;
use crate::regions::HatchRegions;

/// The cells that a guide may ink.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum GuideScope {
    /// All cells of one part.
    Part(PartId),
    /// One connected stretch of visible surface.
    Facet(u32),
}

/// Line along which strokes are laid.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Guide {
    /// Polyline in page units.
    pub line: Vec<Point>,
    /// Share of all guides, 0 to 1. The guide is inked where more than this share is wanted.
    pub rank: f64,
    /// Identity of the guide: the same in all drawings of the same model with the same seed.
    pub id: u64,
    /// The cells that it may ink.
    pub scope: GuideScope,
    /// Crowding at each point of the line: 1 where guides lie at their spacing, 2 where they lie twice as
    /// close. Empty: 1 everywhere.
    pub crowding: Vec<f64>,
}

/// Rank of a line by its number: the radical inverse in base 2 (van der Corput 1935). Among consecutive
/// lines, those below any rank are spread evenly.
#[must_use]
pub(crate) fn rank(number: i64) -> f64 {
    f64::from((number as u32).reverse_bits()) / 4_294_967_296.0
}

/// Unit vectors along and across lines at an angle, radians, counter-clockwise as the page is seen.
#[must_use]
pub(crate) fn axes(angle: f64) -> [Vec2; 2] {
    let (s, c) = (sin(angle), cos(angle));
    [Vec2::new(c, -s), Vec2::new(s, c)]
}

/// Straight guides over the wanted cells of each part, `spacing` apart.
///
/// Each part has its own lines, turned at random by up to `turn_parts` radians. `identities` holds a stable
/// number for each part.
#[must_use]
pub(crate) fn straight(
    ground: &HatchRegions,
    wanted: impl Fn(u32) -> bool,
    identities: &[u64],
    angle: f64,
    turn_parts: f64,
    spacing: f64,
    seed: u64,
) -> Vec<Guide> {
    let count = ground.cells.iter().map(|cell| cell.look.part.index() + 1).max().unwrap_or(0);
    let identity = |part: usize| identities.get(part).copied().unwrap_or(part as u64);
    let angle_of = |part: usize| {
        angle + turn_parts * (2.0 * unit_interval(hash(seed, &[TURN_SEED, identity(part)])) - 1.0)
    };
    let axes: Vec<[Vec2; 2]> = (0..count).map(|part| axes(angle_of(part))).collect();
    let mut boxes = vec![[f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY]; count];
    for piece in &ground.pieces {
        for cell in piece.sides.into_iter().filter(|cell| wanted(*cell)) {
            let part = ground.cells[cell as usize].look.part.index();
            let reach = &mut boxes[part];
            for end in piece.ends {
                let [u, v] = axes[part].map(|axis| end.to_vec2().dot(axis));
                *reach = [reach[0].min(u), reach[1].max(u), reach[2].min(v), reach[3].max(v)];
            }
        }
    }
    let mut guides = Vec::new();
    for (part, [left, right, low, high]) in boxes.into_iter().enumerate() {
        if left > right {
            continue;
        }
        let [along, across] = axes[part];
        let part_seed = hash(seed, &[identity(part)]);
        let shift = unit_interval(part_seed) * spacing;
        let first = ((low - shift) / spacing).floor() as i64;
        let last = ((high - shift) / spacing).ceil() as i64;
        guides.extend((first..=last).map(|number| {
            let v = number as f64 * spacing + shift;
            let end = |u: f64| (along * u + across * v).to_point();
            Guide {
                line: vec![end(left - spacing), end(right + spacing)],
                rank: rank(number),
                id: hash(part_seed, &[number.cast_unsigned()]),
                scope: GuideScope::Part(PartId(part as u32)),
                crowding: Vec::new(),
            }
        }));
    }
    guides
}

/// Separates the random seeds of turns from those of lines.
const TURN_SEED: u64 = 0x7475_726e;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rank_spreads_guides_evenly() {
        // Of any 64 consecutive lines a quarter has a rank below 0.25, and those lie four apart.
        for first in [-1000, -3, 0, 77] {
            let below: Vec<i64> = (first..first + 64).filter(|n| rank(*n) < 0.25).collect();
            assert_eq!(below.len(), 16);
            assert!(below.windows(2).all(|pair| pair[1] - pair[0] == 4));
        }
        assert!((-100..100).all(|n| (0.0..1.0).contains(&rank(n))));
    }
}
