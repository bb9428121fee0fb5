//! Evenly spaced guides along a direction field.
//!
//! Source: Jobard and Lefer, "Creating evenly-spaced streamlines of arbitrary density", Visualization in
//! Scientific Computing '97. Lines grow both ways until they come near others, and new seeds are placed next
//! to existing lines.
//!
//! Deviations:
//! 1. This is done at several spacings, widest first. Lines of wider sets stay in the narrower ones, which
//!    makes them nested.
//! 2. The rank of a line is the share of the surface hatched when it is reached. Ranks therefore measure ink
//!    correctly for lines of any length.

use std::collections::VecDeque;

use crate::parallel::prelude::*;
use kurbo::{Point, Rect, Vec2};

use super::guide::{Guide, GuideScope};
use super::guide_directions::GuideDirections;
use crate::geometry::numbers::noise::hash;
use crate::geometry::plane::planar_distance::length;
use crate::geometry::plane::planar_grid::PlanarGrid;
use crate::geometry::plane::polylines::{bounds, polyline_length};
use crate::regions::HatchRegions;

/// Spacing of streamlines. Lengths are in page units.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Spacing {
    /// Distance between lines where they are densest.
    pub pitch: f64,
    /// Number of wider sets, each at twice the spacing of the next. 0: all lines have one rank.
    pub doublings: u32,
    /// A CSS px in page units.
    pub px: f64,
    /// Random seed.
    pub seed: u64,
}

/// A line ends where another one is closer than this share of the spacing.
const MIN_GAP_OF_SPACING: f64 = 0.62;

/// Length of a growth step, px.
const GROWTH_STEP_PX: f64 = 1.5;

/// Least cosine of the turn per step (60 degrees). A sharper turn ends the line.
const MIN_TURN_COSINE: f64 = 0.5;

/// Least length of a line in pitches. Shorter lines are dropped.
const MIN_LENGTH_PITCHES: f64 = 1.5;

/// Greatest number of points in half of a line.
const MAX_LINE_POINTS: usize = 20_000;

/// Guides along a direction field on all facets with wanted cells.
#[must_use]
pub(crate) fn streamlines(
    ground: &HatchRegions,
    flow: &GuideDirections,
    wanted: impl Fn(u32) -> bool,
    is_inked: &(impl Fn(u32, Point) -> bool + Sync),
    spacing: &Spacing,
) -> Vec<Guide> {
    let samples = flow.samples();
    let mut facet_wanted = vec![false; ground.facets as usize];
    for (number, cell) in ground.cells.iter().enumerate() {
        facet_wanted[cell.facet as usize] |= cell.facet != 0 && wanted(number as u32);
    }
    let mut of_facet: Vec<Vec<u32>> = vec![Vec::new(); ground.facets as usize];
    for (k, facet) in samples.facets.iter().enumerate() {
        if facet_wanted[*facet as usize] {
            of_facet[*facet as usize].push(k as u32);
        }
    }
    let facets: Vec<(u32, Vec<u32>)> = of_facet
        .into_iter()
        .enumerate()
        .map(|(f, points)| (f as u32, points))
        .filter(|(_, p)| !p.is_empty())
        .collect();
    let grown: Vec<Vec<Guide>> = facets
        .par_iter()
        .map(|(facet, points)| {
            let mut grower = Grower::new(flow, *facet, points, is_inked, spacing);
            for doubling in (0..=spacing.doublings).rev() {
                grower.grow(points, spacing.pitch * f64::from(1u32 << doubling), doubling);
            }
            let inked = points.iter().filter(|k| is_inked(*facet, samples.point(**k as usize))).count();
            grower.guides(inked as f64 * samples.pitch * samples.pitch)
        })
        .collect();
    grown.into_iter().flatten().collect()
}

struct Grower<'a, F> {
    flow: &'a GuideDirections<'a>,
    facet: u32,
    is_inked: &'a F,
    spacing: &'a Spacing,
    /// Lines, and the doubling of the spacing when each was grown.
    lines: Vec<(Vec<Point>, u32)>,
    /// Tiles with sides of one pitch, and the line points in each.
    grid: PlanarGrid,
    tiles: Vec<Vec<Point>>,
}

impl<'a, F: Fn(u32, Point) -> bool> Grower<'a, F> {
    fn new(
        flow: &'a GuideDirections,
        facet: u32,
        points: &[u32],
        is_inked: &'a F,
        spacing: &'a Spacing,
    ) -> Self {
        let samples = flow.samples();
        let bounds = bounds(points.iter().map(|k| samples.point(*k as usize))).unwrap_or_default();
        let margin = samples.pitch + spacing.pitch;
        let grid = PlanarGrid::new(bounds.inflate(margin, margin), 1.0 / spacing.pitch);
        let tiles = vec![Vec::new(); grid.count()];
        Self { flow, facet, is_inked, spacing, lines: Vec::new(), grid, tiles }
    }

    /// Whether a point is at least `distance` from all lines.
    fn is_free(&self, p: Point, distance: f64) -> bool {
        let around = Rect::from_points(p, p).inflate(distance, distance);
        let mut near = self.grid.rows_in(around).flat_map(|tiles| &self.tiles[tiles]).flatten();
        near.all(|q| (*q - p).hypot2() >= distance * distance)
    }

    fn put(&mut self, line: &[Point]) {
        for p in line.iter().filter(|p| self.grid.holds(**p)) {
            self.tiles[self.grid.number(self.grid.cell(*p))].push(*p);
        }
    }

    fn is_ground(&self, p: Point) -> bool {
        self.flow.at(self.facet, p).is_some() && (self.is_inked)(self.facet, p)
    }

    /// Grows lines at a spacing until there is no room.
    fn grow(&mut self, points: &[u32], distance: f64, doubling: u32) {
        let mut queue: VecDeque<usize> = (0..self.lines.len()).collect();
        let mut scanned = 0;
        loop {
            while let Some(line) = queue.pop_front() {
                let every = (distance / 2.0 / (GROWTH_STEP_PX * self.spacing.px)).max(1.0) as usize;
                let along = self.lines[line].0.clone();
                for k in (0..along.len()).step_by(every) {
                    let way = along[(k + 1).min(along.len() - 1)] - along[k.saturating_sub(1)];
                    let long = length(way);
                    if long <= 0.0 {
                        continue;
                    }
                    let across = Vec2::new(-way.y, way.x) / long * distance;
                    for seed in [along[k] + across, along[k] - across] {
                        self.seed(seed, distance, doubling, &mut queue);
                    }
                }
            }
            // No line leads further: continue at the next free lattice point.
            let next = points[scanned..].iter().position(|k| {
                let p = self.flow.samples().point(*k as usize);
                self.is_ground(p) && self.is_free(p, distance)
            });
            let Some(next) = next else { return };
            let p = self.flow.samples().point(points[scanned + next] as usize);
            scanned += next + 1;
            self.seed(p, distance, doubling, &mut queue);
        }
    }

    /// Grows a line from a point, if there is room for it.
    fn seed(&mut self, p: Point, distance: f64, doubling: u32, queue: &mut VecDeque<usize>) {
        if !self.is_ground(p) || !self.is_free(p, distance * MIN_SEED_GAP_OF_SPACING) {
            return;
        }
        let Some(way) = self.flow.at(self.facet, p) else { return };
        let mut line = self.half(p, -way, distance, &[]);
        line.reverse();
        line.push(p);
        let ahead = self.half(p, way, distance, &line);
        line.extend(ahead);
        let step = GROWTH_STEP_PX * self.spacing.px;
        if (line.len() as f64 - 1.0) * step < (MIN_LENGTH_PITCHES * self.spacing.pitch).max(2.0 * step) {
            return;
        }
        self.put(&line);
        queue.push_back(self.lines.len());
        self.lines.push((line, doubling));
    }

    /// One half of a line: the points after its seed. `behind` is the other half.
    fn half(&self, seed: Point, start_direction: Vec2, distance: f64, behind: &[Point]) -> Vec<Point> {
        let step = GROWTH_STEP_PX * self.spacing.px;
        let nearest = distance * MIN_GAP_OF_SPACING;
        let (mut p, mut direction) = (seed, start_direction);
        let mut line: Vec<Point> = Vec::new();
        // A line must not run into itself. Points nearby along the line are exempt from the test.
        let exempt_points = (distance * 2.0 / step).ceil() as usize;
        while line.len() < MAX_LINE_POINTS {
            let Some(middle) = self.flow.at(self.facet, p + direction * (step / 2.0)) else { break };
            let middle = if middle.dot(direction) < 0.0 { -middle } else { middle };
            if middle.dot(direction) < MIN_TURN_COSINE {
                break;
            }
            let next = p + middle * step;
            if !self.is_ground(next) || !self.is_free(next, nearest) {
                break;
            }
            let checked_points = &line[..line.len().saturating_sub(exempt_points)];
            let checked_behind = if line.len() >= exempt_points {
                behind
            } else {
                &behind[..behind.len().saturating_sub(exempt_points - line.len())]
            };
            if [checked_points, checked_behind]
                .iter()
                .any(|part| part.iter().any(|q| (*q - next).hypot2() < nearest * nearest))
            {
                break;
            }
            p = next;
            direction = middle;
            line.push(p);
        }
        line
    }

    /// The lines with their ranks. `area` is the hatched area.
    fn guides(self, area: f64) -> Vec<Guide> {
        let Self { facet, spacing, lines, .. } = self;
        let mut guides: Vec<(u32, u64, Guide, f64)> = lines
            .into_iter()
            .map(|(line, doubling)| {
                // A line is identified by the position of its middle point, rounded to a px.
                let place = line[line.len() / 2];
                let steps = [place.x, place.y].map(|x| ((x / spacing.px).round() as i64).cast_unsigned());
                let id = hash(spacing.seed, &[u64::from(facet), steps[0], steps[1]]);
                let length = polyline_length(&line);
                let guide =
                    Guide { line, rank: 0.0, id, scope: GuideScope::Facet(facet), crowding: Vec::new() };
                (doubling, hash(id, &[1]), guide, length)
            })
            .collect();
        if spacing.doublings == 0 {
            return guides.into_iter().map(|(_, _, guide, _)| guide).collect();
        }
        guides.sort_by_key(|(doubling, chance, ..)| (std::cmp::Reverse(*doubling), *chance));
        let whole = (area / spacing.pitch).max(f64::MIN_POSITIVE);
        let mut covered = 0.0;
        for (.., guide, length) in &mut guides {
            guide.rank = ((covered + *length / 2.0) / whole).min(1.0);
            covered += *length;
        }
        guides.into_iter().map(|(_, _, guide, _)| guide).collect()
    }
}

/// Least distance of a seed from lines as a share of the spacing. Slightly below 1, against rounding.
const MIN_SEED_GAP_OF_SPACING: f64 = 0.98;
