//! [`Regions`]: the parts of the page that look alike, with borders that neighbours share.
//!
//! The page is cut along all visible lines that may part two looks, triangulated under these
//! constraints, and the eye is asked what it sees in the middle of each triangle. Triangles without
//! a line between them must look alike; those that do look alike and hang together are a region. The
//! border between two regions is one curve, which both use.

mod arcs;
pub mod axes;
mod cells;
mod chart;
pub mod decals;
mod flat;
pub mod ground;
mod insertion;
pub mod level_curves;
pub mod look;
mod looks;
mod meeting;
mod merge;
mod noding;
pub mod options;
pub mod paint;
mod piece;
mod piece_grid;
mod piece_tiles;
mod ramps;
pub mod samples;
pub mod seen;
mod seen_at;
mod thin;
pub(crate) mod unions;

use crate::parallel::prelude::*;
use kurbo::{BezPath, Point};

pub use ground::Ground;
pub use look::{Darkened, Look};
pub use options::{RegionOptions, Seams, StepsAs};
pub use paint::paint;
pub use ramps::Ramp;
pub use samples::Samples;
pub use seen::{PageBorders, Seen, see};

use crate::chain::{self, ChainOptions};
use crate::drawing::{Length, Unit};
use crate::math::tolerance;
use arcs::{OUTSIDE_PATCH, RawArc};
use cells::Triangulation;
use look::NOTHING;

/// A stretch of border between two regions.
#[derive(Debug, Clone, PartialEq)]
pub struct Border {
    /// The curve, in user units; both regions are painted up to it.
    pub path: BezPath,
    /// The regions on both sides: first the one that lies to the right of the path as the page is
    /// seen (y down). None beyond the page and where there is only paper.
    pub sides: [Option<u32>; 2],
    /// Whether it closes on itself.
    pub closed: bool,
}

/// A part of the page that looks alike and hangs together.
#[derive(Debug, Clone, PartialEq)]
pub struct Region {
    /// What it looks like.
    pub look: Look,
    /// Its area, user units squared.
    pub area: f64,
    /// The loops around it and around its holes: borders by their number in [`Regions::borders`], and
    /// whether they are run through from their start.
    pub loops: Vec<Vec<(u32, bool)>>,
    /// How its tone changes across it, where it is several steps of light.
    pub ramp: Option<Ramp>,
}

/// All regions of a drawing.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Regions {
    /// The regions.
    pub regions: Vec<Region>,
    /// Their borders.
    pub borders: Vec<Border>,
    /// Cells in which different looks were seen, because a line around them breaks off.
    pub leaks: u64,
}

/// Gathers what looks alike: neighbours that differ in their bin of light only are one region.
#[must_use]
pub fn gather(seen: &Seen, options: &RegionOptions, chain: &ChainOptions, unit: Unit) -> Regions {
    let (mut patches, table) = patches(seen, |look| Look { bin: 0, ..*look }, options, unit);
    let drawn = Drawn { step: seen.step, leaks: seen.leaks, options, chain, unit };
    let ramps = match options.steps_as {
        StepsAs::Bands => Vec::new(),
        StepsAs::Gradients => {
            let borders = arcs::trace(&seen.cut, &owners(&patches), patches.looks.len());
            let tolerance = Length::px(tolerance::RAMP_PX).in_unit(unit);
            ramps::join(&seen.cut, &mut patches, &table, &borders, seen.step, tolerance)
        }
    };
    regions(&seen.cut, &patches, &table, ramps, &drawn)
}

/// Gathers what looks alike to a coarser eye.
pub(crate) fn gather_as(
    seen: &Seen,
    coarser: impl Fn(&Look) -> Look,
    options: &RegionOptions,
    chain: &ChainOptions,
    unit: Unit,
) -> Regions {
    let (patches, table) = patches(seen, coarser, options, unit);
    let drawn = Drawn { step: seen.step, leaks: seen.leaks, options, chain, unit };
    regions(&seen.cut, &patches, &table, Vec::new(), &drawn)
}

/// What looks alike and hangs together, without crumbs.
fn patches(
    seen: &Seen,
    coarser: impl Fn(&Look) -> Look,
    options: &RegionOptions,
    unit: Unit,
) -> (merge::Patches, Vec<Look>) {
    let (looks, table) = seen.seen_as(coarser);
    let crumb = options.crumb.in_unit(unit).max(0.0) / seen.step;
    (merge::gather(&seen.cut, &looks, NOTHING, 2.0 * crumb * crumb), table)
}

/// The patch that each triangle is painted with.
fn owners(patches: &merge::Patches) -> Vec<u32> {
    // All paper counts as one: there is no border within it, nor between it and what is beyond.
    let is_paper = |patch: u32| patches.looks[patch as usize] == NOTHING;
    patches.of.iter().map(|patch| if is_paper(*patch) { OUTSIDE_PATCH } else { *patch }).collect()
}

/// How borders are drawn.
struct Drawn<'a> {
    step: f64,
    leaks: u64,
    options: &'a RegionOptions,
    chain: &'a ChainOptions,
    unit: Unit,
}

/// The regions of painted patches, and their borders; `ramps` one a patch, or none.
fn regions(
    cut: &Triangulation,
    patches: &merge::Patches,
    table: &[Look],
    mut ramps: Vec<Option<Ramp>>,
    drawn: &Drawn,
) -> Regions {
    let traced = arcs::trace(cut, &owners(patches), patches.looks.len());
    let mut number: Vec<Option<u32>> = vec![None; patches.looks.len()];
    let mut regions = Vec::new();
    for (patch, loops) in traced.loops.into_iter().enumerate() {
        let look = patches.looks[patch].checked_sub(1).and_then(|k| table.get(k as usize));
        if let (false, Some(look)) = (loops.is_empty(), look) {
            number[patch] = Some(regions.len() as u32);
            let area = patches.area2[patch] / 2.0 * drawn.step * drawn.step;
            let ramp = ramps.get_mut(patch).and_then(Option::take);
            regions.push(Region { look: *look, area, loops, ramp });
        }
    }
    let of = |patch: u32| number.get(patch as usize).copied().flatten();
    let borders = traced
        .arcs
        .par_iter()
        .with_max_len(4)
        .map(|arc| Border { path: curve(cut, arc, drawn), sides: arc.sides.map(of), closed: arc.closed })
        .collect();
    Regions { regions, borders, leaks: drawn.leaks }
}

/// The curve of an arc.
fn curve(cut: &Triangulation, arc: &RawArc, drawn: &Drawn) -> BezPath {
    let at = |v: &u32| {
        let [x, y] = cut.points[*v as usize];
        Point::new(x as f64 * drawn.step, y as f64 * drawn.step)
    };
    let points: Vec<Point> = arc.points.iter().map(at).collect();
    let px = Length::px(1.0);
    let chain = ChainOptions {
        smooth: if drawn.chain.smooth.in_unit(drawn.unit) > px.in_unit(drawn.unit) * SMOOTH_PX {
            Length::px(SMOOTH_PX)
        } else {
            drawn.chain.smooth
        },
        fit_tolerance: drawn.options.fit_tolerance,
        ..drawn.chain.clone()
    };
    chain::curve(&points, &arc.soft, arc.closed, tolerance::REGION_SNAP * drawn.step, &chain, drawn.unit)
}

/// Smoothing may move borders by no more than this, px: neighbours lie near to each other.
const SMOOTH_PX: f64 = 0.1;
