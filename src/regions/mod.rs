//! Regions: areas of the page with one part, material and tone, with borders that neighbours share.
//!
//! Input: the visible lines of a view and the lit surface. Output: closed curves to fill, or the areas to
//! hatch.
//!
//! 1. The visible lines that may separate two regions are snap-rounded to a grid (`arrangement`).
//! 2. A constrained Delaunay triangulation of the page is cut along them (`cells`).
//! 3. The face in front at the centre of each triangle gives the triangle a label (`labels`).
//! 4. Connected triangles of one label form a region. Small ones are merged into a neighbour.
//! 5. The border of two regions is one fitted curve that both use, so there is neither gap nor overlap.
//! 6. Regions are painted (`paint`), or give hatching its areas (`hatch_regions`, `sampling`,
//!    `surface_curves`).
//!
//! Files, in reading order: [`options`]; [`arrangement`]; [`cells`]; [`labels`]; [`paint`](mod@paint);
//! [`hatch_regions`]; [`sampling`]; [`surface_curves`].

mod arrangement;
mod cells;
pub(crate) mod hatch_regions;
pub(crate) mod labels;
pub(crate) mod options;
pub(crate) mod paint;
pub(crate) mod sampling;
pub(crate) mod surface_curves;
pub(crate) mod tolerances;

use crate::parallel::prelude::*;
use kurbo::{BezPath, Point};

pub(crate) use hatch_regions::hatch_map::HatchRegions;
pub(crate) use labels::labelled_page::{LabelledPage, PageBorders, label_page};
pub(crate) use labels::surface_label::ShadowDarkening;
pub use labels::surface_label::SurfaceLabel;
pub(crate) use options::{RegionOptions, Seams, StepsAs};
pub(crate) use paint::gradient_regions::Ramp;
pub(crate) use paint::region_paint::paint;
pub(crate) use sampling::page_lattice::LightLattice;

use crate::chains::{self, ChainOptions};
use crate::drawing::{Length, Unit};
use cells::border_arcs::{OUTSIDE_PATCH, RawArc};
use cells::triangulation::Triangulation;
use labels::surface_label::NO_LABEL;

/// Border between two regions.
#[derive(Debug, Clone, PartialEq)]
pub struct RegionBorder {
    /// Fitted curve in user units, the common border of both regions.
    pub path: BezPath,
    /// Indices of the regions on both sides, the one on the right of the path on the page (y down) first.
    /// `None` for paper and outside the page.
    pub sides: [Option<u32>; 2],
    /// Whether the curve is closed.
    pub closed: bool,
}

/// Connected part of the page with one label.
#[derive(Debug, Clone, PartialEq)]
pub struct Region {
    /// Its label.
    pub label: SurfaceLabel,
    /// Area, user units squared.
    pub area: f64,
    /// Loops around it and around its holes: indices into [`Regions::borders`], and whether each border is
    /// followed from start to end.
    pub loops: Vec<Vec<(u32, bool)>>,
    /// Gradient across it, if it joins several steps of light.
    pub(crate) ramp: Option<Ramp>,
}

/// All regions of a drawing.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Regions {
    /// All regions.
    pub regions: Vec<Region>,
    /// All borders.
    pub borders: Vec<RegionBorder>,
    /// Number of cells whose triangles have different labels, because a line around the cell has a gap.
    pub(crate) leaks: u64,
}

/// Collects the regions of a labelled page: connected areas of equal label. Neighbours that differ in
/// hatching bin only are one region. `unit` is the user unit of the page.
#[must_use]
pub(crate) fn gather(
    labelled_page: &LabelledPage,
    options: &RegionOptions,
    chain: &ChainOptions,
    unit: Unit,
) -> Regions {
    let (mut patches, table) = patches(labelled_page, |look| SurfaceLabel { bin: 0, ..*look }, options, unit);
    let drawn = BorderDrawing { step: labelled_page.step, leaks: labelled_page.leaks, options, chain, unit };
    let ramps = match options.steps_as {
        StepsAs::Bands => Vec::new(),
        StepsAs::Gradients => {
            let borders =
                cells::border_arcs::trace(&labelled_page.cut, &owners(&patches), patches.labels.len());
            let tolerance = Length::px(tolerances::MAX_GRADIENT_BORDER_ERROR_PX).in_unit(unit);
            paint::gradient_regions::join(
                &labelled_page.cut,
                &mut patches,
                &table,
                &borders,
                labelled_page.step,
                tolerance,
            )
        }
    };
    regions(&labelled_page.cut, &patches, &table, ramps, &drawn)
}

/// Collects regions after mapping each label by `coarser`, which may make labels equal.
pub(crate) fn gather_relabelled(
    labelled_page: &LabelledPage,
    coarser: impl Fn(&SurfaceLabel) -> SurfaceLabel,
    options: &RegionOptions,
    chain: &ChainOptions,
    unit: Unit,
) -> Regions {
    let (patches, table) = patches(labelled_page, coarser, options, unit);
    let drawn = BorderDrawing { step: labelled_page.step, leaks: labelled_page.leaks, options, chain, unit };
    regions(&labelled_page.cut, &patches, &table, Vec::new(), &drawn)
}

/// Groups triangles into patches of equal label, and merges patches smaller than a crumb into a neighbour.
/// Also returns the table of labels.
fn patches(
    labelled_page: &LabelledPage,
    coarser: impl Fn(&SurfaceLabel) -> SurfaceLabel,
    options: &RegionOptions,
    unit: Unit,
) -> (cells::label_components::LabelComponents, Vec<SurfaceLabel>) {
    let (looks, table) = labelled_page.relabelled(coarser);
    let crumb = options.crumb.in_unit(unit).max(0.0) / labelled_page.step;
    (cells::label_components::gather(&labelled_page.cut, &looks, NO_LABEL, 2.0 * crumb * crumb), table)
}

/// Index of the patch that each triangle is painted with.
fn owners(patches: &cells::label_components::LabelComponents) -> Vec<u32> {
    // Paper and the outside of the page are one patch, so that no border is drawn between them.
    let is_paper = |patch: u32| patches.labels[patch as usize] == NO_LABEL;
    patches
        .component_of_triangle
        .iter()
        .map(|patch| if is_paper(*patch) { OUTSIDE_PATCH } else { *patch })
        .collect()
}

/// Scale and options for tracing borders.
struct BorderDrawing<'a> {
    step: f64,
    leaks: u64,
    options: &'a RegionOptions,
    chain: &'a ChainOptions,
    unit: Unit,
}

/// Traces patches into regions and fitted borders. `ramps` has one entry per patch, or is empty.
fn regions(
    cut: &Triangulation,
    patches: &cells::label_components::LabelComponents,
    table: &[SurfaceLabel],
    mut ramps: Vec<Option<Ramp>>,
    drawn: &BorderDrawing,
) -> Regions {
    let traced = cells::border_arcs::trace(cut, &owners(patches), patches.labels.len());
    let mut number: Vec<Option<u32>> = vec![None; patches.labels.len()];
    let mut regions = Vec::new();
    for (patch, loops) in traced.loops.into_iter().enumerate() {
        let look = patches.labels[patch].checked_sub(1).and_then(|k| table.get(k as usize));
        if let (false, Some(look)) = (loops.is_empty(), look) {
            number[patch] = Some(regions.len() as u32);
            let area = patches.area2[patch] / 2.0 * drawn.step * drawn.step;
            let ramp = ramps.get_mut(patch).and_then(Option::take);
            regions.push(Region { label: *look, area, loops, ramp });
        }
    }
    let of = |patch: u32| number.get(patch as usize).copied().flatten();
    let borders = traced
        .arcs
        .par_iter()
        .with_max_len(4)
        .map(|arc| RegionBorder {
            path: curve(cut, arc, drawn),
            sides: arc.sides.map(of),
            closed: arc.closed,
        })
        .collect();
    Regions { regions, borders, leaks: drawn.leaks }
}

/// Fits a curve to a traced border, in user units.
fn curve(cut: &Triangulation, arc: &RawArc, drawn: &BorderDrawing) -> BezPath {
    let at = |v: &u32| {
        let [x, y] = cut.points[*v as usize];
        Point::new(x as f64 * drawn.step, y as f64 * drawn.step)
    };
    let points: Vec<Point> = arc.points.iter().map(at).collect();
    let px = Length::px(1.0);
    let chain = ChainOptions {
        smooth: if drawn.chain.smooth.in_unit(drawn.unit) > px.in_unit(drawn.unit) * MAX_BORDER_SMOOTHING_PX {
            Length::px(MAX_BORDER_SMOOTHING_PX)
        } else {
            drawn.chain.smooth
        },
        fit_tolerance: drawn.options.fit_tolerance,
        ..drawn.chain.clone()
    };
    chains::curve(
        &points,
        &arc.soft,
        arc.closed,
        tolerances::REGION_SNAP_STEPS * drawn.step,
        &chain,
        drawn.unit,
    )
}

/// Largest displacement of borders by smoothing, px. Neighbouring borders may be close to each other.
const MAX_BORDER_SMOOTHING_PX: f64 = 0.1;
