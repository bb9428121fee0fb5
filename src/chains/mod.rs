//! Chains: view edges joined end to end, tidied, smoothed and fitted with curves. Each chain has one path to
//! draw.
//!
//! 1. `link` joins view edges of one class into routes that pass straight through junctions.
//! 2. `tidy` bridges short hidden gaps, stitches contours, and drops double, short and noisy lines.
//! 3. `fit` smooths and simplifies each line, fits arcs and Bézier curves, and cuts it where the part
//!    changes.
//! 4. `chain_identity` gives chains names that stay the same from frame to frame.
//!
//! Files, in reading order: [`options`] the `[chain]` table; [`sample`] depth, light and anchor at a point;
//! [`sampled_line`] the polyline that all steps share; [`link`]; [`tidy`]; [`fit`]; [`chain_identity`];
//! [`tolerances`] all thresholds for rounding.

pub(crate) mod chain_identity;
pub(crate) mod fit;
mod link;
pub(crate) mod options;
mod sample;
mod sampled_line;
#[cfg(test)]
mod tests;
pub(crate) mod tidy;
mod tolerances;

pub(crate) use options::ChainOptions;
pub(crate) use sample::{Anchor, LineBackdrop, Sample};
pub(crate) use tidy::removed_lines::{RemovalReason, RemovedLine};

use std::sync::Arc;

use crate::parallel::prelude::*;
use kurbo::{BezPath, Point};

use crate::drawing::{Length, Unit};
use crate::lines::{HiddenLines, LineKind};
use crate::mesh::{MaterialId, PartId};
use crate::visibility::{GapOcclusion, ViewMap};
use fit::circular_arcs::CircleTolerance;
use fit::line_finish::{FinishTolerances, finish};
use fit::part_runs::{PartPiece, PartRuns};
use sampled_line::{LineSide, SampledLine};
use tidy::raw_line::RawLine;
use tidy::removed_lines::RemovalLog;
use tidy::tidy_passes::tidied;

/// View edges of one class, joined end to end.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    /// Points in user units of the page, x right, y down. A closed chain does not repeat its first point.
    pub points: Vec<Point>,
    /// One per point.
    pub(crate) samples: Vec<Sample>,
    /// Whether the last point joins the first.
    pub closed: bool,
    /// Kind of line.
    pub kind: LineKind,
    /// Whether one side of the line is background.
    pub silhouette: bool,
    /// Number of surfaces in front of it; 0 = visible. Hidden pieces with different numbers are joined, and
    /// the chain has the smallest.
    pub invisibility: u16,
    /// Whether all of it is seen through a material that is not opaque.
    pub(crate) veiled: bool,
    /// Whether both surfaces that meet in it face the camera.
    pub(crate) both_seen: bool,
    /// Part that it belongs to.
    pub part: PartId,
    /// Material of the nearer surface.
    pub material: MaterialId,
    /// Whether it lies on a smooth surface.
    pub(crate) smooth: bool,
    /// Whether a surface covers the line at its first and last point. There the line ends in the drawing, but
    /// continues on the surface.
    pub(crate) covered: [bool; 2],
    /// Smallest number of its feature segments.
    pub(crate) segment: u32,
    /// Number that stays the same from frame to frame; 0 if not computed.
    pub(crate) identity: u64,
    /// Cells of the rest pose that it passes, as ascending numbers; empty if not computed.
    pub(crate) rest_cells: Arc<[u64]>,
    /// Path to draw: fitted Béziers, or the polyline of `points`.
    pub path: BezPath,
}

/// How far the rounding of the file moves corners on the page, user units, one per part. Known for parallel
/// views only.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Rounding<'a>(pub Option<&'a [f64]>);

impl Rounding<'_> {
    /// Tolerances of arcs for the parts of a line.
    fn nearness(self, line: &SampledLine, unit: Unit) -> Option<CircleTolerance> {
        let of_part = self.0?;
        let part_roundings =
            line.sides.iter().map(|side| of_part.get(side.part.index()).copied().unwrap_or_default());
        let radius = Length { value: MAX_RADIUS_ERROR_MM, unit: Unit::Mm }.in_unit(unit);
        Some(CircleTolerance { rounding: part_roundings.fold(0.0, f64::max).min(radius), radius })
    }
}

/// Largest error of an arc's radius, mm on the page.
const MAX_RADIUS_ERROR_MM: f64 = 0.02;

/// Window for measuring directions at junctions, px.
const DIRECTION_WINDOW_PX: f64 = 3.0;

/// Joins view edges end to end into chains, with hidden ones only if `hidden` draws them.
///
/// - Visible and hidden edges, different kinds, bodies and materials are never joined.
/// - A line that passes several parts of a body is cut between them after it is finished.
/// - With every option off, each edge of non-zero length is in exactly one chain and no point moves. Points
///   inside a straight line are left out.
/// - Chains are in the order of their feature segments.
#[must_use]
pub(crate) fn link(map: &ViewMap, options: &ChainOptions, unit: Unit, hidden: HiddenLines) -> Vec<Chain> {
    link_with(map, (options, Rounding::default()), unit, hidden, None, &mut RemovalLog::default())
}

/// Joins chains as [`link()`] does, but tidying draws no line across another surface that hides it, however
/// thin. Makes circular arcs where the options and the rounding of corners allow.
#[must_use]
pub(crate) fn link_with_arcs(
    occlusion: &GapOcclusion,
    map: &ViewMap,
    (options, rounding): (&ChainOptions, Rounding),
    unit: Unit,
    hidden: HiddenLines,
) -> Vec<Chain> {
    link_with(map, (options, rounding), unit, hidden, Some(occlusion), &mut RemovalLog::default())
}

/// Joins chains as [`link_with_arcs`] does, and returns the lines that tidying dropped, in that order.
#[must_use]
pub(crate) fn link_with_removed(
    occlusion: Option<&GapOcclusion>,
    map: &ViewMap,
    options: &ChainOptions,
    unit: Unit,
    hidden: HiddenLines,
) -> (Vec<Chain>, Vec<RemovedLine>) {
    let mut removal_log = RemovalLog::recording();
    let chains = link_with(map, (options, Rounding::default()), unit, hidden, occlusion, &mut removal_log);
    (chains, removal_log.into_removed())
}

fn link_with(
    map: &ViewMap,
    (options, rounding): (&ChainOptions, Rounding),
    unit: Unit,
    hidden: HiddenLines,
    occlusion: Option<&GapOcclusion>,
    removal_log: &mut RemovalLog,
) -> Vec<Chain> {
    let t = FinishTolerances::new(options, unit);
    let raws = tidied(map, hidden, t.tidy, DIRECTION_WINDOW_PX * t.px, occlusion, removal_log);
    let circle = |line: &SampledLine| if options.circles { rounding.nearness(line, unit) } else { None };
    raws.into_par_iter()
        .with_max_len(8)
        .flat_map_iter(|raw| {
            let circle = circle(&raw.line);
            chains(raw, FinishTolerances { circle, ..t })
        })
        .collect()
}

/// Fits a curve through a line, as for chains.
///
/// The curve is smooth where `soft` is set for the side after a point, and exact elsewhere. It keeps the
/// line's ends. Points nearer than `merge` to the line between their neighbours are left out first.
pub(crate) fn curve(
    points: &[Point],
    soft: &[bool],
    closed: bool,
    merge: f64,
    options: &ChainOptions,
    unit: Unit,
) -> BezPath {
    let t = FinishTolerances { tidy: 0.0, points: false, ..FinishTolerances::new(options, unit) };
    let sample = Sample::new(0.0, 1.0);
    let mut line = SampledLine { closed, ..SampledLine::default() };
    for (point, soft) in points.iter().zip(soft) {
        line.push(*point, sample, LineSide::soft(*soft));
    }
    finish(fit::line_simplification::simplify(&line, merge), t).1
}

/// Factor on the smoothing of interior lines, which noise displaces more than contours.
const INTERIOR_SMOOTHING_FACTOR: f64 = 3.0;

/// Factors on the smoothing and on the fit tolerance of motion trails, which are exact.
const MOTION_SMOOTHING_FACTOR: f64 = 0.04;
const MOTION_FIT_FACTOR: f64 = 0.25;

/// Factor on the smoothing of lines found in the image, which are shortest curves already.
const IMAGE_SMOOTHING_FACTOR: f64 = 0.5;

/// Finishes a line as chains, one for each part of the body along it.
fn chains(raw: RawLine, mut t: FinishTolerances) -> Vec<Chain> {
    if raw.class.kind.is_inside() {
        t.smooth *= INTERIOR_SMOOTHING_FACTOR;
    }
    if raw.class.kind == LineKind::Image {
        t.smooth *= IMAGE_SMOOTHING_FACTOR;
        t.clean = true;
    }
    if raw.class.kind == LineKind::Motion {
        t.smooth *= MOTION_SMOOTHING_FACTOR;
        t.fit *= MOTION_FIT_FACTOR;
        t.clean = true;
    }
    let (runs, part) =
        (PartRuns::of(&raw.line), raw.line.sides.first().map(|side| side.part).unwrap_or_default());
    let (line, path) = finish(raw.line, t);
    let chain = Chain {
        samples: Vec::new(),
        points: Vec::new(),
        closed: line.closed,
        kind: raw.class.kind,
        silhouette: raw.class.silhouette,
        invisibility: raw.invisibility,
        veiled: false,
        both_seen: raw.class.both_seen,
        part,
        material: raw.class.material,
        smooth: raw.smooth,
        covered: raw.covered,
        segment: raw.segment,
        identity: 0,
        rest_cells: Arc::default(),
        path: BezPath::new(),
    };
    let Some(runs) = runs else {
        return vec![Chain { samples: line.samples, points: line.points, path, ..chain }];
    };
    let of_part = |piece: PartPiece| Chain {
        samples: piece.line.samples,
        points: piece.line.points,
        path: piece.path,
        closed: false,
        part: piece.part,
        covered: [0, 1].map(|end| piece.is_end[end] && raw.covered[end]),
        ..chain.clone()
    };
    runs.cut(&line, &path, t.px).into_iter().map(of_part).collect()
}
