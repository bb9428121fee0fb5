//! [`ColourLabels`]: the colour label of each texel of a picture, and of each point between texels.

use crate::parallel::prelude::*;
use glam::DVec2;

use super::soft_assignment::SoftAssignment;
use super::texel_assignments::{MAX_BLUR_TEXELS, TexelAssignments};
use crate::geometry::numbers::portable_math;
use crate::scene::textures::texel_plane::TexelPlane;
use crate::scene::tolerances;

/// Maximum number of colours with a share in a texel.
const MAX_SHARES: usize = 4;

/// Index in `mixed` for a texel without stored shares: its label has all of it.
const NO_SHARES: u32 = u32::MAX;

type ColourShares = [(u8, f32); MAX_SHARES];

/// The colour label of each texel of a picture, and of each point between texels.
///
/// Every texel has a slightly blurred share of each colour; its label is the colour with the greatest share.
/// Shares are linear between texels. Borders are straight between their crossings with cell sides, or meet in
/// a point where three colours do.
#[derive(Debug, Clone)]
pub(crate) struct ColourLabels {
    pub texels: TexelPlane,
    winners: Vec<u8>,
    /// Index of each texel's shares, or [`NO_SHARES`].
    mixed: Vec<u32>,
    shares: Vec<ColourShares>,
    /// Whether texels are drawn as blocks.
    blocks: bool,
}

impl ColourLabels {
    /// Labels of a picture drawn as blocks: the nearest palette colour of each texel.
    pub(crate) fn blocks(guesses: &TexelAssignments) -> Self {
        let winners: Vec<u8> = guesses.list.iter().map(|guess| guess.nearest).collect();
        let mixed = vec![NO_SHARES; winners.len()];
        Self { texels: guesses.texels, winners, mixed, shares: Vec::new(), blocks: true }
    }

    /// Labels from the nearest colours of each texel, blurred by a Gaussian with standard deviation `blur` in
    /// texels.
    pub(crate) fn of(guesses: &TexelAssignments, blur: f64, colours: usize) -> Self {
        let texels = guesses.texels;
        let width = texels.size[0];
        let reach = if blur < 0.3 { 0 } else { (2.5 * blur).ceil().min(f64::from(MAX_BLUR_TEXELS)) as i64 };
        let doubled_variance = (2.0 * blur * blur).max(tolerances::MIN_DOUBLED_BLUR_VARIANCE);
        let bell: Vec<f32> =
            (0..=reach).map(|k| portable_math::exp(-((k * k) as f64) / doubled_variance) as f32).collect();
        let of = |sums: &mut Vec<f32>, texel: &usize| {
            let (i, j) = ((texel % width) as i64, (texel / width) as i64);
            sums.fill(0.0);
            for y in -reach..=reach {
                for x in -reach..=reach {
                    let weight = bell[x.unsigned_abs() as usize] * bell[y.unsigned_abs() as usize];
                    let SoftAssignment { nearest, second, way } = guesses.list[texels.index(i + x, j + y)];
                    sums[nearest as usize] += weight * (1.0 - way);
                    sums[second as usize] += weight * way;
                }
            }
            largest_shares(sums)
        };
        let are_mixed = guesses.mixed(reach as u8);
        let sums = || vec![0.0_f32; colours.max(1)];
        let shares: Vec<ColourShares> =
            are_mixed.par_iter().with_min_len(1 << 8).map_init(sums, of).collect();
        let mut labels = Self { shares, ..Self::blocks(guesses) };
        labels.blocks = false;
        for (at, texel) in are_mixed.into_iter().enumerate() {
            labels.winners[texel] = labels.shares[at][0].0;
            labels.mixed[texel] = at as u32;
        }
        labels
    }

    /// Label of a texel.
    pub(crate) fn winner(&self, texel: usize) -> u8 {
        self.winners[texel]
    }

    /// Changes the label of a texel.
    pub(crate) fn repaint(&mut self, texel: usize, colour: u8) {
        self.winners[texel] = colour;
        self.mixed[texel] = NO_SHARES;
    }

    /// Difference of a texel's shares of two colours.
    pub(crate) fn lead(&self, texel: usize, of: u8, before: u8) -> f64 {
        let share = |colour: u8| match self.mixed[texel] {
            NO_SHARES => f64::from(u8::from(self.winners[texel] == colour)),
            at => self.shares[at as usize]
                .iter()
                .find(|(own, _)| *own == colour)
                .map_or(0.0, |s| f64::from(s.1)),
        };
        share(of) - share(before)
    }

    /// Label at a point of the texel plane.
    pub(crate) fn at(&self, p: DVec2) -> u8 {
        let (low, part) = (p.floor(), p - p.floor());
        let cell = LabelCell::new(self, low.x as i64, low.y as i64);
        cell.at(part)
    }
}

/// Largest sums and their indices, as shares of the total.
fn largest_shares(sums: &[f32]) -> ColourShares {
    let all: f32 = sums.iter().sum();
    let mut shares: ColourShares = [(0, 0.0); MAX_SHARES];
    for (colour, sum) in sums.iter().enumerate() {
        let mut next = (colour as u8, sum / all);
        for share in &mut shares {
            if next.1 > share.1 {
                std::mem::swap(&mut next, share);
            }
        }
    }
    shares
}

/// Cell between four texel centres, clockwise from the upper left one.
pub(crate) struct LabelCell<'a> {
    labels: &'a ColourLabels,
    texels: [usize; 4],
    pub colours: [u8; 4],
}

/// Borders within a cell.
pub(crate) enum CellBorders {
    /// None: the cell has one label.
    Uniform,
    /// Borders from side to side.
    Across(Vec<[usize; 2]>),
    /// Borders from sides to a common point.
    Meeting(DVec2),
}

/// Crossings are rounded to 1/`STEPS_PER_TEXEL` of a texel, so that they are equal at both ends of a repeated picture.
const STEPS_PER_TEXEL: f64 = (1u64 << 20) as f64;

impl<'a> LabelCell<'a> {
    pub(crate) fn new(labels: &'a ColourLabels, i: i64, j: i64) -> Self {
        let texels = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(x, y)| labels.texels.index(i + x, j + y));
        Self { labels, texels, colours: texels.map(|texel| labels.winner(texel)) }
    }

    /// Whether the cell has a single label.
    pub(crate) fn is_even(&self) -> bool {
        self.colours == [self.colours[0]; 4]
    }

    /// Point in the unit square where the label changes on a side; sides are numbered by their first corner.
    pub(crate) fn crossing(&self, side: usize) -> Option<DVec2> {
        let next = (side + 1) % 4;
        let [a, b] = [self.colours[side], self.colours[next]];
        if a == b {
            return None;
        }
        // Always computed from the left or upper end, so that both cells of a side agree.
        let (first, second) = if side < 2 { (side, next) } else { (next, side) };
        let [a, b] = [self.colours[first], self.colours[second]];
        let ahead = self.labels.lead(self.texels[first], a, b);
        let behind = self.labels.lead(self.texels[second], b, a);
        let part = if ahead + behind > 0.0 { (ahead / (ahead + behind)).clamp(0.0, 1.0) } else { 0.5 };
        let part = (part * STEPS_PER_TEXEL).round() / STEPS_PER_TEXEL;
        let [from, to] = [CELL_CORNERS[first], CELL_CORNERS[second]];
        Some(from + (to - from) * part)
    }

    /// Borders within the cell.
    pub(crate) fn parting(&self) -> CellBorders {
        if self.is_even() {
            return CellBorders::Uniform;
        }
        if self.labels.blocks {
            return CellBorders::Meeting(DVec2::splat(0.5));
        }
        let crossed: Vec<usize> = (0..4).filter(|side| self.crossing(*side).is_some()).collect();
        let [a, b, c, d] = self.colours;
        match crossed[..] {
            [first, second] => CellBorders::Across(vec![[first, second]]),
            [_, _, _, _] if a == c && b == d => {
                let [p, q, r, s] = self.texels.map(|texel| self.labels.lead(texel, a, b));
                // Sign of the bilinear difference at its saddle.
                let joins_a = (p * r - q * s) / (p + r - q - s) >= 0.0;
                CellBorders::Across(if joins_a { vec![[0, 1], [2, 3]] } else { vec![[3, 0], [1, 2]] })
            }
            _ => {
                let all: DVec2 = crossed.iter().filter_map(|side| self.crossing(*side)).sum();
                CellBorders::Meeting(all / crossed.len() as f64)
            }
        }
    }

    /// Label at a point of the unit square.
    fn at(&self, p: DVec2) -> u8 {
        match self.parting() {
            CellBorders::Uniform => self.colours[0],
            CellBorders::Across(ways) => {
                // Whether the point is on the side of the corner between two adjacent sides.
                let is_behind = |[first, second]: &[usize; 2]| {
                    let [Some(from), Some(to)] = [*first, *second].map(|side| self.crossing(side)) else {
                        return false;
                    };
                    let turn = |q: DVec2| (to - from).perp_dot(q - from);
                    turn(p) * turn(CELL_CORNERS[(first + 1) % 4]) > 0.0
                };
                match ways.iter().find(|way| is_behind(way)) {
                    Some([first, _]) => self.colours[(first + 1) % 4],
                    None => self.colours[ways[0][0]],
                }
            }
            CellBorders::Meeting(middle) => {
                // Seen from the meeting point, each corner is between the borders on its two sides.
                let on_side = |side: usize| {
                    self.crossing(side).unwrap_or((CELL_CORNERS[side] + CELL_CORNERS[(side + 1) % 4]) / 2.0)
                        - middle
                };
                let way = p - middle;
                let is_of = |corner: &usize| {
                    let (from, to) = (on_side((corner + 3) % 4), on_side(*corner));
                    from.perp_dot(way) >= 0.0 && way.perp_dot(to) >= 0.0
                };
                (0..4).find(is_of).map_or(self.colours[0], |corner| self.colours[corner])
            }
        }
    }
}

/// Corners of a cell.
const CELL_CORNERS: [DVec2; 4] =
    [DVec2::new(0.0, 0.0), DVec2::new(1.0, 0.0), DVec2::new(1.0, 1.0), DVec2::new(0.0, 1.0)];
