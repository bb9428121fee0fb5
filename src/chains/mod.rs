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
//! [`sampled_line`] the polyline that all steps share; [`link`]; [`tidy`]; [`fit`]; [`chain_identity`].

pub(crate) mod chain_identity;
pub(crate) mod fit;
mod link;
pub mod options;
mod sample;
mod sampled_line;
#[cfg(test)]
mod tests;
pub mod tidy;

pub use options::ChainOptions;
pub use sample::{Anchor, Sample, Under};
pub use tidy::removed_lines::{Reason, Removed};

use std::sync::Arc;

use crate::parallel::prelude::*;
use kurbo::{BezPath, Point};

use crate::drawing::{Length, Unit};
use crate::lines::{HiddenLines, LineKind};
use crate::mesh::{MaterialId, PartId};
use crate::visibility::{Ahead, ViewMap};
use fit::circular_arcs::Nearness;
use fit::line_finish::{Tolerances, finish};
use fit::part_runs::{PartRuns, Piece};
use sampled_line::Line;
use tidy::raw_line::Raw;
use tidy::removed_lines::Bin;
use tidy::tidy_passes::tidied;

/// View edges of one kind joined end to end.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    /// Points in user units of the page, x right, y down; a closed chain does not repeat its
    /// first point.
    pub points: Vec<Point>,
    /// One a point.
    pub samples: Vec<Sample>,
    /// Whether the last point joins the first.
    pub closed: bool,
    /// What line it is.
    pub kind: LineKind,
    /// Whether there is background on one side of it.
    pub silhouette: bool,
    /// Number of surfaces that hide it; 0 = visible. Hidden pieces of different number join, and
    /// the chain has the smallest.
    pub invisibility: u16,
    /// Whether it is seen through a material that is not opaque, and only so.
    pub veiled: bool,
    /// Whether both surfaces that meet in it face the eye.
    pub both_seen: bool,
    /// Part it belongs to.
    pub part: PartId,
    /// Material beside it.
    pub material: MaterialId,
    /// Whether it lies on a smooth surface.
    pub smooth: bool,
    /// Whether a surface covers the line at its first and last point, so that it ends in the drawing, but
    /// not on the surface.
    pub covered: [bool; 2],
    /// Smallest number of the feature segments that it has pieces of.
    pub segment: u32,
    /// What it is known by from frame to frame; 0 where nobody asked.
    pub identity: u64,
    /// Where on the model at rest it runs, as numbers of cells, in rising order; empty where nobody asked.
    pub places: Arc<[u64]>,
    /// The curve that is drawn: fitted Béziers, or the polyline of `points`.
    pub path: BezPath,
}

/// How far the rounding of the file moves the corners of each part on the page, user units. Only parallel views have it.
#[derive(Debug, Clone, Copy, Default)]
pub struct Rounding<'a>(pub Option<&'a [f64]>);

impl Rounding<'_> {
    /// How near the corners of a line are to circles.
    fn nearness(self, line: &Line, unit: Unit) -> Option<Nearness> {
        let of_part = self.0?;
        let own = line.part.iter().map(|part| of_part.get(part.index()).copied().unwrap_or_default());
        let radius = Length { value: MAX_UNCERTAIN_MM, unit: Unit::Mm }.in_unit(unit);
        Some(Nearness { rounding: own.fold(0.0, f64::max).min(radius), radius })
    }
}

/// By how much the radius of an arc may be uncertain, mm on the page.
const MAX_UNCERTAIN_MM: f64 = 0.02;

/// Length over which directions are measured at junctions, px.
const DIRECTION_PX: f64 = 3.0;

/// Joins the view edges end to end and makes drawn lines of them; hidden ones only if `hidden` has
/// them drawn.
///
/// Visible and hidden edges, kinds, bodies and materials never join. Lines that go on from part to part of a body are cut there
/// once they are finished. With every option off each
/// edge longer than nothing is in exactly one chain and no point is moved; points between pieces
/// of one straight line are left out. Chains come in the order of the feature segments they begin
/// with.
#[must_use]
pub fn link(map: &ViewMap, options: &ChainOptions, unit: Unit, hidden: HiddenLines) -> Vec<Chain> {
    link_with(map, (options, Rounding::default()), unit, hidden, None, &mut Bin::default())
}

/// Chains as [`link::routes`] makes them, but that tidying draws no line across what hides it, however thin, if
/// that is another surface than the line's own.
#[must_use]
pub fn link_behind(
    ahead: &Ahead,
    map: &ViewMap,
    options: &ChainOptions,
    unit: Unit,
    hidden: HiddenLines,
) -> Vec<Chain> {
    link_rounded(ahead, map, (options, Rounding::default()), unit, hidden)
}

/// Chains as [`link_behind`] makes them, with circles where the options ask for them and the rounding of corners is known.
#[must_use]
pub fn link_rounded(
    ahead: &Ahead,
    map: &ViewMap,
    (options, rounding): (&ChainOptions, Rounding),
    unit: Unit,
    hidden: HiddenLines,
) -> Vec<Chain> {
    link_with(map, (options, rounding), unit, hidden, Some(ahead), &mut Bin::default())
}

/// Chains as [`link_behind`] makes them, and what tidying left out, in the order in which it went.
#[must_use]
pub fn link_and_keep(
    ahead: Option<&Ahead>,
    map: &ViewMap,
    options: &ChainOptions,
    unit: Unit,
    hidden: HiddenLines,
) -> (Vec<Chain>, Vec<Removed>) {
    let mut bin = Bin::kept();
    let chains = link_with(map, (options, Rounding::default()), unit, hidden, ahead, &mut bin);
    (chains, bin.emptied())
}

fn link_with(
    map: &ViewMap,
    (options, rounding): (&ChainOptions, Rounding),
    unit: Unit,
    hidden: HiddenLines,
    ahead: Option<&Ahead>,
    bin: &mut Bin,
) -> Vec<Chain> {
    let px = Length::px(1.0).in_unit(unit);
    let t = Tolerances {
        px,
        smooth: options.smooth.in_unit(unit).max(0.0),
        simplify: options.simplify.in_unit(unit).max(0.0),
        tidy: options.tidy.in_unit(unit).max(0.0),
        clean: false,
        circle: None,
        fit: if options.fit { options.fit_tolerance.in_unit(unit).max(0.0) } else { 0.0 },
        points: true,
    };
    let raws = tidied(map, hidden, t.tidy, DIRECTION_PX * px, ahead, bin);
    let circle = |line: &Line| if options.circles { rounding.nearness(line, unit) } else { None };
    raws.into_par_iter()
        .with_max_len(8)
        .flat_map_iter(|raw| {
            let circle = circle(&raw.line);
            chains(raw, Tolerances { circle, ..t })
        })
        .collect()
}

/// The curve through a line that is drawn like chains are: smooth and fitted where `soft` says that
/// the piece after a point lies on a smooth surface, exact elsewhere. It begins and ends in the
/// line's ends; points nearer than `merge` to the line between their neighbours are passed over.
pub(crate) fn curve(
    points: &[Point],
    soft: &[bool],
    closed: bool,
    merge: f64,
    options: &ChainOptions,
    unit: Unit,
) -> BezPath {
    let px = Length::px(1.0).in_unit(unit);
    let t = Tolerances {
        px,
        smooth: options.smooth.in_unit(unit).max(0.0),
        simplify: options.simplify.in_unit(unit).max(0.0),
        tidy: 0.0,
        clean: false,
        circle: None,
        fit: if options.fit { options.fit_tolerance.in_unit(unit).max(0.0) } else { 0.0 },
        points: false,
    };
    let sample = Sample::new(0.0, 1.0);
    let mut line = Line { closed, ..Line::default() };
    for (point, soft) in points.iter().zip(soft) {
        line.push(*point, sample, *soft, false);
    }
    finish(fit::douglas_peucker::simplify(&line, merge), t).1
}

/// Lines inside lie where noise puts them, more than contours do: smoothing may move them this many
/// times farther.
const INSIDE_SMOOTH: f64 = 3.0;

/// Trails are where they are: smoothing may move them less by this factor, and only makes them round; curves keep nearer to them.
const MOTION_SMOOTH: f64 = 0.04;
const MOTION_FIT: f64 = 0.25;

/// Lines found in the image were pulled taut: smoothing may move them this many times farther.
const IMAGE_SMOOTH: f64 = 0.5;

/// The chains of a line: one for each part of the body along it.
fn chains(raw: Raw, mut t: Tolerances) -> Vec<Chain> {
    if raw.class.kind.is_inside() {
        t.smooth *= INSIDE_SMOOTH;
    }
    if raw.class.kind == LineKind::Image {
        t.smooth *= IMAGE_SMOOTH;
        t.clean = true;
    }
    if raw.class.kind == LineKind::Motion {
        t.smooth *= MOTION_SMOOTH;
        t.fit *= MOTION_FIT;
        t.clean = true;
    }
    let (runs, part) = (PartRuns::of(&raw.line), raw.line.part.first().copied().unwrap_or_default());
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
        places: Arc::default(),
        path: BezPath::new(),
    };
    let Some(runs) = runs else {
        return vec![Chain { samples: line.samples, points: line.points, path, ..chain }];
    };
    let of_part = |piece: Piece| Chain {
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
