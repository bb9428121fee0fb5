//! [`stipple`]: dots of nearly one size, spread evenly, with a density that follows the tone.
//!
//! Source: Secord, Weighted Voronoi stippling, NPAR 2002.
//!
//! Deviations:
//! 1. Voronoi cells are weighted by the square of the wanted ink. The relaxed dots then have the wanted
//!    density instead of its square root.
//! 2. Each surface is stippled separately, with a seed that depends on its shape only.
//! 3. After relaxation each dot is resized to the ink wanted in its Voronoi cell, which varies little. Where
//!    dots overlap, they grow to make up for the overlap.

use std::f64::consts::PI;

use crate::parallel::prelude::*;
use kurbo::{BezPath, Point};
use rustc_hash::FxHashMap;

use super::halftone::MAX_DOTS;
use super::lattice_scan::{Lattice, LatticeScan};
use super::weighted_voronoi::{FULL_INK, InkGrid, NO_OWNER};
use crate::geometry::numbers::noise::{hash, unit_interval};
use crate::geometry::plane::planar_distance::nearest_on_segment;
use crate::hatching::CellDots;
use crate::hatching::clip::circle_clip::ClippedDisc;
use crate::hatching::clip::disc::Disc;
use crate::hatching::clip::domain::directed_border;
use crate::hatching::tolerances;
use crate::regions::HatchRegions;

/// Options of stippling. Lengths are in user units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stipple {
    /// Mean radius of a dot.
    pub radius: f64,
    /// Random variation of dot areas, as a share of the area.
    pub uneven: f64,
    /// Number of Lloyd iterations. Many iterations produce a lattice.
    pub rounds: u32,
    /// Random seed.
    pub seed: u64,
    /// The length of a px in user units.
    pub px: f64,
}

/// The dots of a stippled page, grouped by cell.
///
/// `coverage` returns the share of the area (0 to 1) to be inked in a cell at a point inside it. Nothing is
/// inked where it is 0.
#[must_use]
pub(crate) fn stipple(
    ground: &HatchRegions,
    options: &Stipple,
    coverage: &(dyn Fn(u32, Point) -> f64 + Sync),
) -> Vec<CellDots> {
    let area: f64 = ground.cells.iter().map(|cell| cell.area).sum();
    let least = (area / (PI * MAX_DOTS)).sqrt();
    let options = &Stipple { radius: options.radius.max(least), ..*options };
    let side = (options.radius * SQUARE_SIDE_OF_RADIUS).max((area / MAX_SQUARES).sqrt());
    if side.is_nan() || side <= 0.0 {
        return Vec::new();
    }
    let grid = Lattice::new(Point::new(side / 2.0, side / 2.0), 0.0, side);
    let scan = LatticeScan::new(ground, &grid);
    let mut runs: Vec<RowSpan> = (0..scan.rows()).flat_map(|row| runs(ground, &scan, row)).collect();
    runs.par_sort_by_key(|run| run.facet);
    let facets: Vec<&[RowSpan]> = runs.chunk_by(|a, b| a.facet == b.facet).collect();
    let found: Vec<Vec<(u32, Disc, ClippedDisc)>> = facets
        .par_iter()
        .map(|runs| FacetStipple::new(runs, &grid, coverage).stippled(ground, &grid, options))
        .collect();

    let mut paths: Vec<BezPath> = vec![BezPath::new(); ground.cells.len()];
    for (cell, disc, cut) in found.into_iter().flatten() {
        let path = &mut paths[cell as usize];
        match cut {
            ClippedDisc::Whole => disc.draw(path, options.px),
            ClippedDisc::Part(part, _) => path.extend(part.iter()),
            ClippedDisc::Nothing => {}
        }
    }
    let cells = (0u32..).zip(paths).filter(|(_, path)| !path.elements().is_empty());
    cells.map(|(cell, path)| CellDots { cell, path }).collect()
}

/// Side of the squares that hold the wanted ink, as a share of the mean dot radius.
const SQUARE_SIDE_OF_RADIUS: f64 = 0.45;

/// Greatest number of squares on a page. Larger pages use larger squares.
const MAX_SQUARES: f64 = 1.6e7;

/// Consecutive squares of one cell in a row.
#[derive(Debug, Clone, Copy)]
struct RowSpan {
    facet: u32,
    row: i64,
    from: i64,
    /// End of the span, exclusive.
    to: i64,
    cell: u32,
}

fn runs<'a>(
    ground: &'a HatchRegions,
    scan: &'a LatticeScan,
    row: usize,
) -> impl Iterator<Item = RowSpan> + 'a {
    let of = move |(from, to, cell): (f64, f64, u32)| RowSpan {
        facet: ground.cells[cell as usize].facet,
        row: scan.first + row as i64,
        from: from.floor() as i64 + 1,
        to: to.floor() as i64 + 1,
        cell,
    };
    scan.stretches(row).map(of).filter(|run| run.from < run.to)
}

/// One facet, a stretch of surface to be stippled.
struct FacetStipple<'a> {
    runs: &'a [RowSpan],
    /// Column and row of the first square of the patch.
    corner: [i64; 2],
    patch: InkGrid,
    /// Cells where ink is wanted.
    inked: Vec<u32>,
}

impl<'a> FacetStipple<'a> {
    fn new(runs: &'a [RowSpan], grid: &Lattice, coverage: &(dyn Fn(u32, Point) -> f64 + Sync)) -> Self {
        let first_column = runs.iter().map(|run| run.from).min().unwrap_or_default();
        let right = runs.iter().map(|run| run.to).max().unwrap_or_default();
        let top = runs.first().map_or(0, |run| run.row);
        let bottom = runs.last().map_or(0, |run| run.row + 1);
        let [width, height] = [right - first_column, bottom - top].map(|size| size as usize);
        let mut ink = vec![0u16; width * height];
        let mut inked: Vec<u32> = Vec::new();
        // The tone is sampled once per block of squares and cell, at the first square met.
        let band = |run: &RowSpan| run.row.div_euclid(TONE_BLOCK_SQUARES);
        let bands: Vec<&[RowSpan]> = runs.chunk_by(|a, b| band(a) == band(b)).collect();
        let wanted_inks: Vec<Vec<(usize, u16)>> = bands
            .into_par_iter()
            .map(|runs| {
                let mut known: FxHashMap<(i64, u32), u16> = FxHashMap::default();
                let squares = runs.iter().flat_map(|run| (run.from..run.to).map(move |column| (run, column)));
                squares
                    .map(|(run, column)| {
                        let ink = known
                            .entry((column.div_euclid(TONE_BLOCK_SQUARES), run.cell))
                            .or_insert_with(|| {
                                let wanted_coverage =
                                    coverage(run.cell, grid.point(column as f64, run.row as f64));
                                (wanted_coverage.clamp(0.0, 1.0) * f64::from(FULL_INK)).round() as u16
                            });
                        ((run.row - top) as usize * width + (column - first_column) as usize, *ink)
                    })
                    .collect()
            })
            .collect();
        for (square, square_ink) in wanted_inks.into_iter().flatten() {
            ink[square] = square_ink;
        }
        for run in runs {
            let first = (run.row - top) as usize * width + (run.from - first_column) as usize;
            if ink[first..first + (run.to - run.from) as usize].iter().any(|ink| *ink > 0) {
                inked.push(run.cell);
            }
        }
        inked.sort_unstable();
        inked.dedup();
        Self { runs, corner: [first_column, top], patch: InkGrid { width, height, ink }, inked }
    }

    /// The dots: cell, disc and clipped shape of each.
    fn stippled(
        &self,
        ground: &HatchRegions,
        grid: &Lattice,
        options: &Stipple,
    ) -> Vec<(u32, Disc, ClippedDisc)> {
        let dot = PI * options.radius * options.radius / (grid.step * grid.step);
        let [left, top] = self.corner.map(i64::cast_unsigned);
        let words = [left, top, self.patch.width as u64, self.patch.height as u64];
        let seed = hash(options.seed, &words);
        let chance = |word: u64| unit_interval(hash(seed, &[word]));
        let count = (self.patch.total() / dot + chance(u64::MAX)) as usize;
        if count == 0 {
            return Vec::new();
        }
        let mut sites = self
            .patch
            .place_sites(count, |k| [0, 1, 2].map(|word| unit_interval(hash(seed, &[k as u64, word]))));
        self.patch.relax(&mut sites, options.rounds);

        let differs = |k: usize| 1.0 + options.uneven * (2.0 * chance(k as u64) - 1.0);
        let radii = SiteShares::new(&self.patch, &sites).radii(&sites, differs);
        let fence = InkedBorder { ground, inked: &self.inked };
        let drawn = |(k, site): (usize, &[f64; 2])| {
            let (radius, is_dense) = radii[k];
            let [x, y] = [0, 1].map(|axis| site[axis] - 0.5 + self.corner[axis] as f64);
            let cell = self.cell(x.round() as i64, y.round() as i64);
            let disc = Disc { centre: grid.point(x, y), radius: radius * grid.step };
            let (disc, cut) = fence.fitted(disc, is_dense, options.px);
            (cut != ClippedDisc::Nothing).then_some((cell, disc, cut))
        };
        sites.par_iter().enumerate().with_min_len(64).filter_map(drawn).collect()
    }

    /// The cell of a square.
    fn cell(&self, column: i64, row: i64) -> u32 {
        let next = self.runs.partition_point(|run| (run.row, run.from) <= (row, column));
        let run = self.runs.get(next.saturating_sub(1)).or(self.runs.first());
        run.map_or(0, |run| run.cell)
    }
}

/// Side of the blocks where the tone is sampled once, squares.
const TONE_BLOCK_SQUARES: i64 = 4;

/// Voronoi cells of the sites, with the ink and area of each.
struct SiteShares<'a> {
    patch: &'a InkGrid,
    owners: Vec<u32>,
    inks: Vec<f64>,
    areas: Vec<f64>,
}

impl<'a> SiteShares<'a> {
    fn new(patch: &'a InkGrid, sites: &[[f64; 2]]) -> Self {
        let owners = patch.owners(sites);
        let inks = patch.inks(&owners, sites.len());
        let mut areas = vec![0.0; sites.len()];
        for owner in owners.iter().filter(|owner| **owner != NO_OWNER) {
            areas[*owner as usize] += 1.0;
        }
        Self { patch, owners, inks, areas }
    }

    /// The radius of each site's dot, in squares, and whether dots are dense there.
    fn radii(&self, sites: &[[f64; 2]], differs: impl Fn(usize) -> f64 + Sync) -> Vec<(f64, bool)> {
        let of = |wanted: &[f64]| -> Vec<(f64, bool)> {
            let one = |(k, site): (usize, &[f64; 2])| {
                let alone = (self.inks[k] * differs(k) / PI).sqrt();
                let is_dense = self.inks[k] > MIN_OVERLAP_COVERAGE * self.areas[k];
                (if is_dense { self.grown(k, *site, alone, wanted[k]) } else { alone }, is_dense)
            };
            sites.par_iter().enumerate().with_min_len(64).map(one).collect()
        };
        let first = of(&self.inks);
        // Larger dots ink parts of neighbouring cells. That ink is subtracted from what the neighbours have
        // to supply.
        let mut inked = vec![0.0_f64; self.owners.len()];
        for ((radius, _), site) in first.iter().zip(sites).filter(|((_, is_dense), _)| *is_dense) {
            self.each_square(*site, *radius, |square, distance| {
                inked[square] = inked[square].max((radius - distance + 0.5).clamp(0.0, 1.0));
            });
        }
        let mut wanted: Vec<f64> = self.inks.iter().map(|ink| 2.0 * ink).collect();
        for (owner, inked) in self.owners.iter().zip(inked).filter(|(owner, _)| **owner != NO_OWNER) {
            wanted[*owner as usize] -= inked;
        }
        of(&wanted)
    }

    /// Calls `call` for the squares around a position, with their distances.
    fn each_square(&self, at: [f64; 2], radius: f64, mut call: impl FnMut(usize, f64)) {
        let range = |axis: usize, size: usize| {
            let (low, high) = ((at[axis] - radius - 1.0).floor(), (at[axis] + radius + 1.0).ceil());
            low.max(0.0) as usize..(high.max(0.0) as usize).min(size)
        };
        for y in range(1, self.patch.height) {
            for x in range(0, self.patch.width) {
                let [dx, dy] = [x as f64 + 0.5 - at[0], y as f64 + 0.5 - at[1]];
                call(y * self.patch.width + x, (dx * dx + dy * dy).sqrt());
            }
        }
    }

    /// The radius where a dot supplies the `wanted` ink inside its Voronoi cell, not counting ink in other
    /// cells.
    fn grown(&self, site: usize, at: [f64; 2], alone: f64, wanted: f64) -> f64 {
        let (least, most) = (alone / MAX_RADIUS_GROWTH, alone * MAX_RADIUS_GROWTH);
        let mut foreign = Vec::new();
        self.each_square(at, most, |square, distance| {
            if self.owners[square] != site as u32 {
                foreign.push(distance);
            }
        });
        // A square counts by the part of it inside the circle, taking the circle as straight there.
        let inked = |r: f64| {
            let lost: f64 = foreign.iter().map(|distance| (r - distance + 0.5).clamp(0.0, 1.0)).sum();
            PI * r * r - lost
        };
        let (mut low, mut high) = (least, most);
        for _ in 0..GROWTH_BISECTIONS {
            let middle = f64::midpoint(low, high);
            if inked(middle) < wanted { low = middle } else { high = middle }
        }
        low
    }
}

/// Coverage above which dots overlap.
const MIN_OVERLAP_COVERAGE: f64 = 0.5;

/// Greatest radius of an overlapping dot relative to an isolated one.
const MAX_RADIUS_GROWTH: f64 = 1.6;

/// Bisections that narrow the radius to a thousandth.
const GROWTH_BISECTIONS: u32 = 10;

/// Border of the inked cells of a facet, which dots do not cross.
struct InkedBorder<'a> {
    ground: &'a HatchRegions,
    /// The inked cells, ascending.
    inked: &'a [u32],
}

impl InkedBorder<'_> {
    fn is_within(&self, cell: u32) -> bool {
        self.inked.binary_search(&cell).is_ok()
    }

    /// Fits a dot inside the border: moved inward if there is room, and clipped otherwise. Dense dots are
    /// only clipped.
    fn fitted(&self, disc: Disc, is_dense: bool, px: f64) -> (Disc, ClippedDisc) {
        let near = |disc: Disc| -> Vec<[Point; 2]> {
            let pieces = self.ground.pieces_near(disc.centre, disc.radius);
            let fence = |piece: u32| {
                directed_border(&self.ground.pieces[piece as usize], |cell| self.is_within(cell))
            };
            pieces.into_iter().filter_map(|piece| Some(fence(piece)?.0)).collect()
        };
        let mut moved = disc;
        let mut border = near(disc);
        for _ in 0..if is_dense { 0 } else { MAX_MOVES } {
            let offs = border.iter().map(|ends| (nearest_on_segment(moved.centre, ends[0], ends[1]), ends));
            let distance = |p: Point| (p - moved.centre).hypot2();
            let Some((p, [a, b])) = offs.min_by(|a, b| distance(a.0).total_cmp(&distance(b.0))) else {
                break;
            };
            let is_within = (*b - *a).cross(moved.centre - *a) > 0.0;
            let off = distance(p).sqrt();
            if (is_within && off >= moved.radius) || off <= 0.0 {
                break;
            }
            let outward = (p - moved.centre) / off * if is_within { 1.0 } else { -1.0 };
            moved.centre = p - outward * moved.radius * (1.0 + tolerances::BORDER_GAP_OF_RADIUS);
            border = near(moved);
        }
        let inside = self.is_within(self.ground.cell_at(moved.centre));
        let cut = moved.cut(&border, inside, px);
        let is_scrap = |cut: &ClippedDisc| match cut {
            ClippedDisc::Part(_, area) => {
                !is_dense && *area < MIN_DOT_AREA_SHARE * PI * moved.radius * moved.radius
            }
            _ => false,
        };
        if is_scrap(&cut) { (moved, ClippedDisc::Nothing) } else { (moved, cut) }
    }
}

/// Greatest number of moves before a dot is clipped.
const MAX_MOVES: u32 = 4;

/// Least remaining share of a dot's area. Smaller remainders are not drawn.
const MIN_DOT_AREA_SHARE: f64 = 0.4;
