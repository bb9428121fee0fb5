//! [`Guide`]: a line along which strokes are laid, and its rank.
//!
//! Ranks make hatching nested: a guide is inked where the tone asks for more than its rank, so a
//! darker tone keeps the strokes of a lighter one and adds more. Source: Praun, Hoppe, Webb and
//! Finkelstein, "Real-time hatching", SIGGRAPH 2001, section 3, there between textures.

use kurbo::{Point, Vec2};

use crate::geometry::numbers::noise::{hash, unit};
use crate::geometry::numbers::portable_math::{cos, sin};
use crate::mesh::PartId;
use crate::regions::Ground;

/// What a guide may be inked on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scope {
    /// Everything of one part.
    Part(PartId),
    /// One stretch of visible surface.
    Facet(u32),
}

/// A line along which strokes are laid.
#[derive(Debug, Clone, PartialEq)]
pub struct Guide {
    /// A polyline, page units.
    pub line: Vec<Point>,
    /// It is inked where more than this part of all guides is wanted, 0 to 1.
    pub rank: f64,
    /// What it is known by: the same in all drawings of the same thing by the same hand.
    pub id: u64,
    /// What it may be inked on.
    pub scope: Scope,
    /// How many guides there are too many, at each point of the line: 1 where they lie at their spacing, 2
    /// where twice as close. Empty: 1 everywhere.
    pub crowding: Vec<f64>,
}

/// The rank of the line of a number: of any consecutive lines, those below a rank are spread as evenly as
/// can be. Radical inverse in base 2 (van der Corput 1935).
#[must_use]
pub fn rank(number: i64) -> f64 {
    f64::from((number as u32).reverse_bits()) / 4_294_967_296.0
}

/// Unit vectors along and across lines at an angle (radians, counter-clockwise as the page is seen).
#[must_use]
pub fn axes(angle: f64) -> [Vec2; 2] {
    let (s, c) = (sin(angle), cos(angle));
    [Vec2::new(c, -s), Vec2::new(s, c)]
}

/// Straight guides at one angle over the wanted cells of each part, `spacing` apart. Each part has lines of
/// its own, turned by `turn_parts` radians at most; `identities` tells parts apart.
#[must_use]
pub fn straight(
    ground: &Ground,
    wanted: impl Fn(u32) -> bool,
    identities: &[u64],
    angle: f64,
    turn_parts: f64,
    spacing: f64,
    seed: u64,
) -> Vec<Guide> {
    let count = ground.cells.iter().map(|cell| cell.look.part.index() + 1).max().unwrap_or(0);
    let identity = |part: usize| identities.get(part).copied().unwrap_or(part as u64);
    let angle_of = |part: usize| angle + turn_parts * (2.0 * unit(hash(seed, &[TURN, identity(part)])) - 1.0);
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
        let shift = unit(part_seed) * spacing;
        let first = ((low - shift) / spacing).floor() as i64;
        let last = ((high - shift) / spacing).ceil() as i64;
        guides.extend((first..=last).map(|number| {
            let v = number as f64 * spacing + shift;
            let end = |u: f64| (along * u + across * v).to_point();
            Guide {
                line: vec![end(left - spacing), end(right + spacing)],
                rank: rank(number),
                id: hash(part_seed, &[number.cast_unsigned()]),
                scope: Scope::Part(PartId(part as u32)),
                crowding: Vec::new(),
            }
        }));
    }
    guides
}

/// Sets the seeds of turns apart from those of lines.
const TURN: u64 = 0x7475_726e;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_part_lines_evenly() {
        // Of any 64 neighbours, half have a rank below a half, and these lie two apart.
        for first in [-1000, -3, 0, 77] {
            let below: Vec<i64> = (first..first + 64).filter(|n| rank(*n) < 0.25).collect();
            assert_eq!(below.len(), 16);
            assert!(below.windows(2).all(|pair| pair[1] - pair[0] == 4));
        }
        assert!((-100..100).all(|n| (0.0..1.0).contains(&rank(n))));
    }
}
