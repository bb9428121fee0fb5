//! [`InkGrid`]: a grid of wanted ink, its Voronoi partition among sites, and Lloyd relaxation of the sites.
//!
//! Source: Secord, Weighted Voronoi stippling, NPAR 2002: Lloyd's method with weighted centroids of Voronoi
//! cells.
//!
//! Deviation: the weight is the square of the density. With the density itself, relaxed sites have the square
//! root of the wanted density (Gersho, Asymptotically optimal block quantization, 1979); with its square,
//! they have the wanted one.
//!
//! All sums are of integers, so the result does not depend on the number of threads.

use crate::parallel::prelude::*;
use kurbo::{Point, Rect};

use crate::geometry::lists::csr_lists::{CsrLists, csr_lists_from_pairs};
use crate::geometry::plane::planar_grid::PlanarGrid;
use crate::hatching::tolerances;

/// Ink value of a fully black square.
pub(crate) const FULL_INK: u16 = 16_384;

/// Box of squares. Positions are in squares, from the corner of the box.
#[derive(Debug, Clone, Default)]
pub(crate) struct InkGrid {
    pub width: usize,
    pub height: usize,
    /// Ink wanted in each square, row by row, 0 to [`FULL_INK`]. It is 0 outside the patch.
    pub ink: Vec<u16>,
}

/// Marks squares without an owner in [`InkGrid::owners`].
pub(crate) const NO_OWNER: u32 = u32::MAX;

/// Weighted sums over the Voronoi cell of a site.
#[derive(Debug, Clone, Copy, Default)]
struct CentroidSum {
    weight: u64,
    x: u64,
    y: u64,
}

impl InkGrid {
    /// All wanted ink, in fully black squares.
    pub(crate) fn total(&self) -> f64 {
        self.ink.iter().map(|ink| u64::from(*ink)).sum::<u64>() as f64 / f64::from(FULL_INK)
    }

    /// `count` initial positions, each in the middle of about the same amount of ink.
    ///
    /// The squares are ordered along a Hilbert curve, which keeps neighbours together. `random_triple` (0 to 1)
    /// places each position inside its stretch of ink and inside its square.
    pub(crate) fn place_sites(&self, count: usize, chance: impl Fn(usize) -> [f64; 3]) -> Vec<[f64; 2]> {
        let levels = self.width.max(self.height).next_power_of_two().trailing_zeros();
        let mut squares: Vec<(u64, u32)> = (0..self.ink.len())
            .into_par_iter()
            .filter(|k| self.ink[*k] > 0)
            .map(|k| (along_hilbert(levels, (k % self.width) as u32, (k / self.width) as u32), k as u32))
            .collect();
        squares.par_sort_unstable();
        let total: u64 = squares.iter().map(|(_, k)| u64::from(self.ink[*k as usize])).sum();
        let mut sites = Vec::with_capacity(count);
        let (mut passed, mut square) = (0u64, 0);
        for k in 0..count {
            let [along, x, y] = chance(k);
            let target = (k as f64 + along) / count as f64 * total as f64;
            while square + 1 < squares.len() {
                let own = u64::from(self.ink[squares[square].1 as usize]);
                if (passed + own) as f64 > target {
                    break;
                }
                passed += own;
                square += 1;
            }
            if let Some((_, square)) = squares.get(square) {
                let at = *square as usize;
                sites.push([(at % self.width) as f64 + x, (at / self.width) as f64 + y]);
            }
        }
        sites
    }

    /// Moves sites towards the weighted centroids of their Voronoi cells, `rounds` times. Sites without ink
    /// stay.
    pub(crate) fn relax(&self, sites: &mut [[f64; 2]], rounds: u32) {
        for _ in 0..rounds {
            let owners = self.owners(sites);
            let sums = self.sums(&owners, sites.len());
            for (site, sum) in sites.iter_mut().zip(sums) {
                if sum.weight > 0 {
                    let middle = [sum.x, sum.y].map(|of| of as f64 / sum.weight as f64 + 0.5);
                    // Over-relaxation reaches equilibrium in fewer rounds.
                    *site = [0, 1].map(|axis| site[axis] + (middle[axis] - site[axis]) * RELAXATION_FACTOR);
                }
            }
        }
    }

    /// The ink in the Voronoi cell of each site, in fully black squares.
    pub(crate) fn inks(&self, owners: &[u32], sites: usize) -> Vec<f64> {
        let mut inks = vec![0u64; sites];
        for (owner, ink) in owners.iter().zip(&self.ink) {
            if *owner != NO_OWNER {
                inks[*owner as usize] += u64::from(*ink);
            }
        }
        inks.into_iter().map(|ink| ink as f64 / f64::from(FULL_INK)).collect()
    }

    fn sums(&self, owners: &[u32], sites: usize) -> Vec<CentroidSum> {
        let rows = self.height.div_ceil(SUM_BANDS).max(1);
        let width = self.width.max(1);
        let bands = owners.par_chunks(rows * width).zip(self.ink.par_chunks(rows * width)).enumerate();
        let apart: Vec<Vec<CentroidSum>> = bands
            .map(|(band, (owners, ink))| {
                let mut sums = vec![CentroidSum::default(); sites];
                for (row, (owners, ink)) in owners.chunks(width).zip(ink.chunks(width)).enumerate() {
                    let y = (band * rows + row) as u64;
                    for (x, (owner, ink)) in owners.iter().zip(ink).enumerate() {
                        if let Some(sum) = sums.get_mut(*owner as usize) {
                            let weight = u64::from(*ink) * u64::from(*ink);
                            sum.weight += weight;
                            sum.x += weight * x as u64;
                            sum.y += weight * y;
                        }
                    }
                }
                sums
            })
            .collect();
        let mut all = vec![CentroidSum::default(); sites];
        for sums in &apart {
            for (all, sum) in all.iter_mut().zip(sums) {
                all.weight += sum.weight;
                all.x += sum.x;
                all.y += sum.y;
            }
        }
        all
    }

    /// The site closest to the centre of each square where ink is wanted.
    pub(crate) fn owners(&self, sites: &[[f64; 2]]) -> Vec<u32> {
        let mut owners = vec![NO_OWNER; self.ink.len()];
        if sites.is_empty() || self.width == 0 {
            return owners;
        }
        let width = self.width;
        let buckets = SiteGrid::new(self, sites);
        let bands =
            owners.par_chunks_mut(BLOCK_SQUARES * width).zip(self.ink.par_chunks(BLOCK_SQUARES * width));
        bands.enumerate().for_each_init(Vec::new, |near, (band, (owners, ink))| {
            let (rows, top) = (owners.len() / width, band * BLOCK_SQUARES);
            for left in (0..width).step_by(BLOCK_SQUARES) {
                let right = (left + BLOCK_SQUARES).min(width);
                let of_row = |row: usize| row * width + left..row * width + right;
                if (0..rows).all(|row| ink[of_row(row)].iter().all(|ink| *ink == 0)) {
                    continue;
                }
                let centre = [left, top].map(|low| low as f64 + BLOCK_SQUARES as f64 / 2.0);
                buckets.near(centre, near);
                let nearest = nearest(near, centre);
                for (row, nearest) in nearest.iter().enumerate().take(rows) {
                    let squares = owners[of_row(row)].iter_mut().zip(&ink[of_row(row)]);
                    for ((owner, ink), nearest) in squares.zip(nearest) {
                        *owner = if *ink > 0 { *nearest } else { NO_OWNER };
                    }
                }
            }
        });
        owners
    }
}

/// The closest of these sites for each square of a block, row by row.
fn nearest(sites: &[([f64; 2], u32)], centre: [f64; 2]) -> [[u32; BLOCK_SQUARES]; BLOCK_SQUARES] {
    // Coordinates are relative to the middle of the block, so single precision is enough.
    let at: [f32; BLOCK_SQUARES] = std::array::from_fn(|k| k as f32 + 0.5 - BLOCK_SQUARES as f32 / 2.0);
    let (mut best, mut owners) =
        ([[f32::INFINITY; BLOCK_SQUARES]; BLOCK_SQUARES], [[NO_OWNER; BLOCK_SQUARES]; BLOCK_SQUARES]);
    for (site, number) in sites {
        let [x, y] = [0, 1].map(|axis| (site[axis] - centre[axis]) as f32);
        let across = at.map(|at| (at - x) * (at - x));
        for row in 0..BLOCK_SQUARES {
            let down = (at[row] - y) * (at[row] - y);
            for column in 0..BLOCK_SQUARES {
                let distance2 = across[column] + down;
                let is_nearer = distance2 < best[row][column];
                best[row][column] = if is_nearer { distance2 } else { best[row][column] };
                owners[row][column] = if is_nearer { *number } else { owners[row][column] };
            }
        }
    }
    owners
}

/// Side of a block of squares whose closest sites are searched together.
const BLOCK_SQUARES: usize = 4;

/// Over-relaxation factor: step length as a multiple of the distance to the centroid.
const RELAXATION_FACTOR: f64 = 1.6;

/// Number of bands of rows that are summed in parallel.
const SUM_BANDS: usize = 4;

fn distance2(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1])
}

/// Sites in buckets over the box.
struct SiteGrid {
    grid: PlanarGrid,
    sites: CsrLists<([f64; 2], u32)>,
}

impl SiteGrid {
    fn new(patch: &InkGrid, sites: &[[f64; 2]]) -> Self {
        let (width, height) = (patch.width as f64, patch.height as f64);
        // About two sites per bucket if the box is full.
        let side = (2.0 * width * height / sites.len() as f64).sqrt().clamp(2.0, width.max(height).max(2.0));
        let grid = PlanarGrid::new(Rect::new(0.0, 0.0, width, height), 1.0 / side);
        let buckets = sites.iter().map(|[x, y]| grid.number(grid.cell(Point::new(*x, *y))));
        let numbered = sites.iter().copied().zip(0u32..);
        let sites = csr_lists_from_pairs(grid.count(), buckets.zip(numbered));
        Self { grid, sites }
    }

    /// All sites that may be closest to the centre of a square of the block around a centre.
    fn near(&self, centre: [f64; 2], near: &mut Vec<([f64; 2], u32)>) {
        let reach = (BLOCK_SQUARES as f64 - 1.0) / 2.0 * std::f64::consts::SQRT_2;
        // The site closest to such a point is at most this far from the centre, by the triangle inequality.
        let limit = self.nearest(centre) + 2.0 * reach + tolerances::SITE_SEARCH_MARGIN_SQUARES;
        let [x, y] = centre;
        near.clear();
        for buckets in self.grid.rows_in(Rect::new(x - limit, y - limit, x + limit, y + limit)) {
            let sites = self.sites.of_all(buckets).iter();
            near.extend(sites.filter(|(site, _)| distance2(*site, centre) <= limit * limit));
        }
    }

    /// Distance of the closest site. Rings of buckets are searched outwards.
    fn nearest(&self, centre: [f64; 2]) -> f64 {
        let middle = self.grid.cell(Point::new(centre[0], centre[1]));
        let mut best = f64::INFINITY;
        for ring in 0..=self.grid.ring_count() {
            let nearest = self.grid.ring_distance(ring);
            if best <= nearest * nearest {
                break;
            }
            for bucket in self.grid.ring(middle, ring) {
                let distances = self.sites.of(bucket).iter().map(|(site, _)| distance2(*site, centre));
                best = distances.fold(best, f64::min);
            }
        }
        best.sqrt()
    }
}

/// Position of a square along the Hilbert curve through a box of 2^levels squares a side.
fn along_hilbert(levels: u32, x: u32, y: u32) -> u64 {
    let (mut x, mut y, mut along) = (x, y, 0u64);
    for level in (0..levels).rev() {
        let (right, down) = ((x >> level) & 1, (y >> level) & 1);
        along = along << 2 | u64::from((3 * right) ^ down);
        // The quadrants at the ends of the curve are transposed.
        if down == 0 {
            if right == 1 {
                let most = (1 << level) - 1;
                (x, y) = (most - (x & most), most - (y & most));
            }
            std::mem::swap(&mut x, &mut y);
        }
    }
    along
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Wanted ink that increases to the right, with a hole.
    fn ink_gradient_with_hole(width: usize, height: usize) -> InkGrid {
        let ink = |k: usize| {
            let (x, y) = (k % width, k / width);
            let is_hole = x.abs_diff(width / 3) < 9 && y.abs_diff(height / 2) < 7;
            if is_hole { 0 } else { (x * usize::from(FULL_INK) / width) as u16 }
        };
        InkGrid { width, height, ink: (0..width * height).map(ink).collect() }
    }

    fn random_triple(k: usize) -> [f64; 3] {
        use crate::geometry::numbers::noise::{hash, unit_interval};
        [0, 1, 2].map(|word| unit_interval(hash(7, &[k as u64, word])))
    }

    #[test]
    fn owners_are_the_nearest_sites() {
        let patch = ink_gradient_with_hole(97, 61);
        for count in [1, 2, 40, 700] {
            let sites = patch.place_sites(count, random_triple);
            assert_eq!(sites.len(), count);
            for (k, owner) in patch.owners(&sites).into_iter().enumerate() {
                if patch.ink[k] == 0 {
                    assert_eq!(owner, NO_OWNER);
                    continue;
                }
                let at = [(k % 97) as f64 + 0.5, (k / 97) as f64 + 0.5];
                let least = sites.iter().map(|site| distance2(*site, at)).fold(f64::INFINITY, f64::min);
                assert!(distance2(sites[owner as usize], at) < least + 1e-4, "{count} {k}");
            }
        }
    }

    #[test]
    fn relaxed_sites_have_nearly_equal_ink() {
        let patch = ink_gradient_with_hole(240, 200);
        let count = 600;
        let mut sites = patch.place_sites(count, random_triple);
        let spread = |sites: &[[f64; 2]]| {
            let inks = patch.inks(&patch.owners(sites), count);
            let mean = patch.total() / count as f64;
            (inks.iter().map(|ink| (ink - mean) * (ink - mean)).sum::<f64>() / count as f64).sqrt() / mean
        };
        let before = spread(&sites);
        patch.relax(&mut sites, 30);
        let after = spread(&sites);
        assert!(before > 0.2 && after < 0.12, "{before} {after}");
    }

    #[test]
    fn hilbert_curve_steps_between_adjacent_squares() {
        let mut at = vec![[0i64; 2]; 64 * 64];
        for y in 0..64 {
            for x in 0..64 {
                at[along_hilbert(6, x, y) as usize] = [i64::from(x), i64::from(y)];
            }
        }
        let is_step =
            |pair: &[[i64; 2]]| (pair[0][0] - pair[1][0]).abs() + (pair[0][1] - pair[1][1]).abs() == 1;
        assert!(at.windows(2).all(is_step));
    }
}
