//! [`dots`]: half-tone screens, dots on a lattice fixed to the page and sized by tone.
//!
//! Each dot has the size that the tone at its lattice point needs, and is clipped where its surface ends.
//!
//! From a coverage of π/4 on, dots overlap. The white area then shrinks towards the middles between lattice
//! points. A darker screen therefore contains all ink of a lighter one.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_4, PI};

use crate::parallel::prelude::*;
use kurbo::{BezPath, Point};

use super::lattice_scan::{Lattice, LatticeScan};
use crate::geometry::numbers::portable_math::acos;
use crate::geometry::plane::planar_distance::{nearest_on_segment, segment_distance_squared};
use crate::hatching::clip::circle_clip::ClippedDisc;
use crate::hatching::clip::disc::Disc;
use crate::hatching::clip::domain::{Domains, NO_DOMAIN, directed_border};
use crate::hatching::tolerances;
use crate::regions::HatchRegions;
use crate::regions::hatch_regions::border_piece::PAPER;

/// Half-tone screen of dots. Lengths are in user units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct DotScreen {
    /// Distance between neighbouring dots.
    pub pitch: f64,
    /// Angle of the rows from the x axis, radians, turning from x to y.
    pub angle: f64,
    /// A point of the lattice.
    pub origin: Point,
    /// Treatment of dots on the border between two tones of one surface.
    pub tone_borders: ToneBorders,
    /// The length of a px in user units.
    pub px: f64,
}

/// Treatment of dots on the border between two tones of one surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum ToneBorders {
    /// Dots stay whole, sized by the tone at their centre. Only a border to blank paper clips them.
    #[default]
    Whole,
    /// Each tone clips its own dots, as cut shading film does.
    Cut,
}

/// The dots of one cell.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CellDots {
    /// The cell that contains the dot centres, or whose dots were clipped.
    pub cell: u32,
    /// All dots as one path that turns from x to y. Fill it by the nonzero rule.
    pub path: BezPath,
}

/// The dots of a screen, grouped by cell.
///
/// `coverage` returns the share of the area (0 to 1) to be inked in a cell at a point. It is sampled at dot
/// centres inside the cell, and for dots that reach in from outside, at the nearest point of the cell's
/// border. A cell whose samples are all 0 stays blank.
#[must_use]
pub(crate) fn dots(
    ground: &HatchRegions,
    screen: &DotScreen,
    coverage: &(dyn Fn(u32, Point) -> f64 + Sync),
) -> Vec<CellDots> {
    let area: f64 = ground.cells.iter().map(|cell| cell.area).sum();
    let pitch = screen.pitch.max((area / MAX_DOTS).sqrt());
    let grid = Lattice::new(screen.origin, screen.angle, pitch);
    let scan = LatticeScan::new(ground, &grid);
    let least = tolerances::MAX_DOT_OUTLINE_ERROR_PX * screen.px / pitch;
    let size = DotSizes { coverage, min_radius: least };

    // The size at each lattice point in its own cell, row by row.
    let rows: Vec<Vec<LatticeDot>> =
        (0..scan.rows()).into_par_iter().map(|row| spots(&scan, row, &grid, &size)).collect();
    let mut inked = vec![false; ground.cells.len()];
    rows.iter().flatten().for_each(|spot| inked[spot.cell as usize] |= spot.radius > 0.0);
    for piece in &ground.pieces {
        for cell in piece.sides.into_iter().filter(|cell| *cell != PAPER) {
            let inked = &mut inked[cell as usize];
            *inked = *inked || size.radius(cell, piece.ends[0].midpoint(piece.ends[1])) > 0.0;
        }
    }
    let domains = match screen.tone_borders {
        ToneBorders::Whole => Domains::of_facets(ground, &inked),
        ToneBorders::Cut => Domains::of_cells(&inked),
    };

    let meetings = border_contacts(ground, &grid, &domains);
    let cutter = DotClipper { ground, grid, domains: &domains, size, px: screen.px };
    let first = |row: i64| meetings.partition_point(|m| m.row < row);
    let numbers = meetings.first().map_or(scan.first, |m| m.row.min(scan.first))
        ..=meetings.last().map_or(scan.first, |m| m.row).max(scan.first + scan.rows() as i64 - 1);
    let numbers: Vec<i64> = numbers.collect();
    let marks: Vec<Vec<ClippedDot>> = numbers
        .into_par_iter()
        .map(|row| {
            let own = usize::try_from(row - scan.first).ok().and_then(|k| rows.get(k));
            cutter.row(row, own.map_or(&[], Vec::as_slice), &meetings[first(row)..first(row + 1)])
        })
        .collect();
    join_by_cell(ground.cells.len(), &marks, screen.px)
}

/// Greatest number of dots on a page. Finer screens could not be seen; they are made coarser.
pub(crate) const MAX_DOTS: f64 = 4e6;

/// Lattice point inside a cell.
#[derive(Debug, Clone, Copy)]
struct LatticeDot {
    column: i64,
    cell: u32,
    /// Radius in lattice steps; 0 for no dot.
    radius: f64,
}

fn spots(scan: &LatticeScan, row: usize, grid: &Lattice, size: &DotSizes) -> Vec<LatticeDot> {
    let y = (scan.first + row as i64) as f64;
    let mut spots = Vec::new();
    for (from, to, cell) in scan.stretches(row) {
        spots.extend((from.floor() as i64 + 1..=to.floor() as i64).map(|column| {
            let radius = size.radius(cell, grid.point(column as f64, y));
            LatticeDot { column, cell, radius }
        }));
    }
    spots
}

/// Dot sizes by coverage.
struct DotSizes<'a> {
    coverage: &'a (dyn Fn(u32, Point) -> f64 + Sync),
    min_radius: f64,
}

impl DotSizes<'_> {
    /// Radius in lattice steps; 0 for no dot.
    fn radius(&self, cell: u32, p: Point) -> f64 {
        let radius = radius((self.coverage)(cell, p));
        if radius < self.min_radius { 0.0 } else { radius }
    }
}

/// The radius where discs on a unit square lattice cover the given share of the page.
fn radius(coverage: f64) -> f64 {
    if coverage.is_nan() || coverage <= 0.0 {
        return 0.0;
    }
    if coverage <= FRAC_PI_4 {
        return (coverage / PI).sqrt();
    }
    if coverage >= 1.0 {
        return FULL_COVER_RADIUS_STEPS;
    }
    // The covered area is the disc minus the four segments that its neighbours cover too.
    let covered = |r: f64| PI * r * r - 4.0 * (r * r * acos(0.5 / r) - 0.5 * (r * r - 0.25).sqrt());
    let (mut low, mut high) = (0.5, FRAC_1_SQRT_2);
    for _ in 0..RADIUS_BISECTIONS {
        let middle = f64::midpoint(low, high);
        if covered(middle) < coverage { low = middle } else { high = middle }
    }
    high
}

/// Bisections that narrow the radius interval to a millionth.
const RADIUS_BISECTIONS: u32 = 20;

/// Radius that covers everything, slightly more than half the diagonal of a unit square.
const FULL_COVER_RADIUS_STEPS: f64 = FRAC_1_SQRT_2 + tolerances::FULL_COVER_MARGIN_STEPS;

/// Lattice point whose dot may reach across a border piece of a domain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct BorderContact {
    row: i64,
    column: i64,
    domain: u32,
    piece: u32,
}

fn border_contacts(ground: &HatchRegions, grid: &Lattice, domains: &Domains) -> Vec<BorderContact> {
    let of_piece = |(piece, parted): (usize, [u32; 2])| {
        let [a, b] = ground.pieces[piece].ends.map(|p| grid.place(p));
        let (low, high) = if a.y < b.y { (a, b) } else { (b, a) };
        let delta = high - low;
        let mut found = Vec::new();
        for row in (low.y - FULL_COVER_RADIUS_STEPS).ceil() as i64
            ..=(high.y + FULL_COVER_RADIUS_STEPS).floor() as i64
        {
            // The stretch of the piece within reach of this row.
            let at = |y: f64| low.x + delta.x * ((y - low.y) / delta.y).clamp(0.0, 1.0);
            let (from, to) = if delta.y > 0.0 {
                (at(row as f64 - FULL_COVER_RADIUS_STEPS), at(row as f64 + FULL_COVER_RADIUS_STEPS))
            } else {
                (low.x, high.x)
            };
            for column in (from.min(to) - FULL_COVER_RADIUS_STEPS).ceil() as i64
                ..=(from.max(to) + FULL_COVER_RADIUS_STEPS).floor() as i64
            {
                let spot = Point::new(column as f64, row as f64);
                let reach2 = FULL_COVER_RADIUS_STEPS * FULL_COVER_RADIUS_STEPS;
                if segment_distance_squared(spot, a, b) < reach2 {
                    let of_domain = |domain| BorderContact { row, column, domain, piece: piece as u32 };
                    found.extend(parted.into_iter().filter(|domain| *domain != NO_DOMAIN).map(of_domain));
                }
            }
        }
        found
    };
    let parting: Vec<(usize, [u32; 2])> = (ground.pieces.iter().enumerate())
        .filter_map(|(k, piece)| domains.differing_domains(piece).map(|parted| (k, parted)))
        .collect();
    let mut all: Vec<BorderContact> =
        parting.into_par_iter().with_min_len(64).flat_map_iter(of_piece).collect();
    all.par_sort_unstable();
    all
}

/// Dot, whole or clipped.
enum ClippedDot {
    Whole(u32, Disc),
    Part(u32, BezPath),
}

struct DotClipper<'a> {
    ground: &'a HatchRegions,
    grid: Lattice,
    domains: &'a Domains,
    size: DotSizes<'a>,
    px: f64,
}

impl DotClipper<'_> {
    /// The dots around the lattice points of a row: those inside cells and those that reach in from outside.
    fn row(&self, row: i64, spots: &[LatticeDot], meetings: &[BorderContact]) -> Vec<ClippedDot> {
        let mut dots = Vec::new();
        let mut spots = spots.iter().peekable();
        for at_column in meetings.chunk_by(|a, b| a.column == b.column) {
            let column = at_column[0].column;
            while let Some(spot) = spots.next_if(|spot| spot.column < column) {
                self.whole(row, spot, &mut dots);
            }
            let spot = spots.next_if(|spot| spot.column == column);
            let own = spot.map(|spot| self.domains.domain(spot.cell));
            let mut is_met = false;
            for met in at_column.chunk_by(|a, b| a.domain == b.domain) {
                is_met |= own == Some(met[0].domain);
                dots.extend(self.cut(met, spot.filter(|_| own == Some(met[0].domain))));
            }
            if let Some(spot) = spot.filter(|_| !is_met) {
                self.whole(row, spot, &mut dots);
            }
        }
        spots.for_each(|spot| self.whole(row, spot, &mut dots));
        dots
    }

    fn whole(&self, row: i64, spot: &LatticeDot, dots: &mut Vec<ClippedDot>) {
        if spot.radius > 0.0 {
            let centre = self.grid.point(spot.column as f64, row as f64);
            dots.push(ClippedDot::Whole(spot.cell, Disc { centre, radius: spot.radius * self.grid.step }));
        }
    }

    /// The dot of a lattice point in a domain whose border it touches. `own` is set if the point lies in that
    /// domain.
    fn cut(&self, met: &[BorderContact], own: Option<&LatticeDot>) -> Option<ClippedDot> {
        let BorderContact { row, column, domain, .. } = met[0];
        let centre = self.grid.point(column as f64, row as f64);
        let pieces: Vec<([Point; 2], u32)> = met
            .iter()
            .filter_map(|m| {
                directed_border(&self.ground.pieces[m.piece as usize], |cell| {
                    self.domains.domain(cell) == domain
                })
            })
            .collect();
        let (cell, radius) = match own {
            Some(spot) => (spot.cell, spot.radius),
            None => {
                let near =
                    pieces.iter().map(|(ends, cell)| (nearest_on_segment(centre, ends[0], ends[1]), *cell));
                let distance = |p: Point| (p - centre).hypot2();
                let (p, cell) = near.min_by(|a, b| distance(a.0).total_cmp(&distance(b.0)))?;
                (cell, self.size.radius(cell, p))
            }
        };
        let disc = Disc { centre, radius: radius * self.grid.step };
        let ends: Vec<[Point; 2]> = pieces.into_iter().map(|(ends, _)| ends).collect();
        match disc.cut(&ends, own.is_some(), self.px) {
            _ if radius <= 0.0 => None,
            ClippedDisc::Whole => Some(ClippedDot::Whole(cell, disc)),
            ClippedDisc::Part(path, _) => Some(ClippedDot::Part(cell, path)),
            ClippedDisc::Nothing => None,
        }
    }
}

/// Joins dots to one path per cell.
fn join_by_cell(cells: usize, rows: &[Vec<ClippedDot>], px: f64) -> Vec<CellDots> {
    let mut of_cell: Vec<Vec<&ClippedDot>> = vec![Vec::new(); cells];
    for dot in rows.iter().flatten() {
        let (ClippedDot::Whole(cell, _) | ClippedDot::Part(cell, _)) = dot;
        of_cell[*cell as usize].push(dot);
    }
    let drawn = |(cell, dots): (usize, Vec<&ClippedDot>)| {
        let mut path = BezPath::new();
        for dot in dots {
            match dot {
                ClippedDot::Whole(_, disc) => disc.draw(&mut path, px),
                ClippedDot::Part(_, part) => path.extend(part.iter()),
            }
        }
        CellDots { cell: cell as u32, path }
    };
    of_cell.into_par_iter().enumerate().filter(|(_, dots)| !dots.is_empty()).map(drawn).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halftone_radius_covers_the_wanted_share() {
        assert_eq!(radius(0.0), 0.0);
        assert!((radius(FRAC_PI_4) - 0.5).abs() < 1e-6);
        assert!(radius(1.0) > FRAC_1_SQRT_2 && radius(2.0) > FRAC_1_SQRT_2 && radius(f64::NAN) == 0.0);
        let mut before = 0.0;
        for percent in 1..100 {
            let asked = f64::from(percent) / 100.0;
            let r = radius(asked);
            assert!(r > before);
            before = r;
            // Samples the square around a lattice point. By symmetry its neighbours reach in no farther than
            // its own disc.
            let n = 400;
            let within = (0..n * n).filter(|k| {
                let [x, y] = [k % n, k / n].map(|k| (f64::from(k) + 0.5) / f64::from(n) - 0.5);
                x * x + y * y < r * r
            });
            let covered = within.count() as f64 / f64::from(n * n);
            assert!((covered - asked).abs() < 2e-3, "{asked}: {covered}");
        }
    }
}
