//! Regions: the parts of the page that look alike, with borders that neighbours share.
//!
//! 1. The visible lines that may separate two looks are snap-rounded to a grid (`arrangement`).
//! 2. A constrained Delaunay triangulation of the page is cut along them (`cells`).
//! 3. The face in front at the centre of each triangle gives the triangle a label (`labels`).
//! 4. Connected triangles of one label form a region. Small ones are merged into a neighbour.
//! 5. The border of two regions is one fitted curve that both use, so there is neither gap nor overlap.
//! 6. Regions are painted (`paint`), or give hatching its areas (`hatch_regions`, `lattice`,
//!    `surface_curves`).
//!
//! Files, in reading order: [`options`]; [`arrangement`]; [`cells`]; [`labels`]; [`paint`];
//! [`hatch_regions`]; [`lattice`]; [`surface_curves`].

mod arrangement;
mod cells;
pub mod hatch_regions;
pub mod labels;
pub mod lattice;
pub mod options;
pub mod paint;
pub mod surface_curves;

use crate::parallel::prelude::*;
use kurbo::{BezPath, Point};

pub use hatch_regions::hatch_map::Ground;
pub use labels::labelled_page::{PageBorders, Seen, see};
pub use labels::surface_label::{Darkened, Look};
pub use lattice::page_lattice::Samples;
pub use options::{RegionOptions, Seams, StepsAs};
pub use paint::region_paint::paint;
pub use paint::tone_ramps::Ramp;

use crate::chains::{self, ChainOptions};
use crate::drawing::{Length, Unit};
use crate::geometry::numbers::tolerance;
use cells::border_arcs::{OUTSIDE_PATCH, RawArc};
use cells::triangulation::Triangulation;
use labels::surface_label::NOTHING;

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
            let borders = cells::border_arcs::trace(&seen.cut, &owners(&patches), patches.looks.len());
            let tolerance = Length::px(tolerance::RAMP_PX).in_unit(unit);
            paint::tone_ramps::join(&seen.cut, &mut patches, &table, &borders, seen.step, tolerance)
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
) -> (cells::patches::Patches, Vec<Look>) {
    let (looks, table) = seen.seen_as(coarser);
    let crumb = options.crumb.in_unit(unit).max(0.0) / seen.step;
    (cells::patches::gather(&seen.cut, &looks, NOTHING, 2.0 * crumb * crumb), table)
}

/// The patch that each triangle is painted with.
fn owners(patches: &cells::patches::Patches) -> Vec<u32> {
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
    patches: &cells::patches::Patches,
    table: &[Look],
    mut ramps: Vec<Option<Ramp>>,
    drawn: &Drawn,
) -> Regions {
    let traced = cells::border_arcs::trace(cut, &owners(patches), patches.looks.len());
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
    chains::curve(&points, &arc.soft, arc.closed, tolerance::REGION_SNAP * drawn.step, &chain, drawn.unit)
}

/// Smoothing may move borders by no more than this, px: neighbours lie near to each other.
const SMOOTH_PX: f64 = 0.1;
