//! [`Chain`]: view edges joined end to end, tidied, smoothed and fitted with curves.

mod corners;
mod crumbs;
mod curve;
mod doubles;
mod finish;
pub(crate) mod fit;
mod gaps;
mod line;
mod link;
pub mod options;
mod raw;
pub mod removed;
mod resample;
mod silhouette;
mod simplify;
mod smooth;
mod stitch;
#[cfg(test)]
mod tests;
mod tidy;
mod unfold;

pub use options::ChainOptions;
pub use removed::{Reason, Removed};

use kurbo::{BezPath, Point};
use rayon::prelude::*;

use crate::drawing::{Length, Unit};
use crate::lines::{HiddenLines, LineKind};
use crate::math::colour::Colour;
use crate::mesh::{MaterialId, PartId};
use crate::viewmap::{Ahead, ViewMap};
use finish::{Tolerances, finish};
use line::Line;
use raw::Raw;
use removed::Bin;
use tidy::tidied;

/// What a chain knows of the world at one of its points; travels with the chain so that strokes
/// never look back into the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Distance from the eye along the optical axis, world units.
    pub depth: f64,
    /// How strong the line is here, 0 to 1. Only suggestive contours, ridges and valleys are ever
    /// weaker than 1.
    pub strength: f64,
    /// The diffuse light on the surface beside the line, 0 to 1; 1 where nobody asked.
    pub light: f64,
    /// How far what lies behind the line is from it, 0 to 1; 1 before background, and where nobody
    /// asked.
    pub gap: f64,
    /// On which side of the line, as it runs, the nearer surface lies: 1 on the left, -1 on the right, 0
    /// where both are as near, and where nobody asked.
    pub side: f64,
    /// What is seen beside the line.
    pub under: Under,
}

/// What is seen beside a line at one of its points, where anybody asked.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Under {
    /// The colour of the surface that the line belongs to, as it is without light.
    pub colour: Option<Colour>,
    /// How far to both sides of the line there is nothing but spot blacks, user units.
    pub black: f64,
}

impl Sample {
    /// A sample of which only depth and strength are known.
    #[must_use]
    pub const fn new(depth: f64, strength: f64) -> Self {
        Self { depth, strength, light: 1.0, gap: 1.0, side: 0.0, under: Under { colour: None, black: 0.0 } }
    }

    /// What lies between two points of a line, at part `t` of the way.
    #[must_use]
    pub fn lerp(self, to: Self, t: f64) -> Self {
        let mix = |from: f64, to: f64| from + (to - from) * t;
        Self {
            depth: mix(self.depth, to.depth),
            strength: mix(self.strength, to.strength),
            light: mix(self.light, to.light),
            gap: mix(self.gap, to.gap),
            side: mix(self.side, to.side),
            // Colours of surfaces do not mix.
            under: if t < 0.5 { self.under } else { to.under },
        }
    }
}

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
    /// A contour with background behind it.
    pub silhouette: bool,
    /// Number of surfaces that hide it; 0 = visible. Hidden pieces of different number join, and
    /// the chain has the smallest.
    pub invisibility: u16,
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
    /// The curve that is drawn: fitted Béziers, or the polyline of `points`.
    pub path: BezPath,
}

/// Length over which directions are measured at junctions, px.
const DIRECTION_PX: f64 = 3.0;

/// Joins the view edges end to end and makes drawn lines of them; hidden ones only if `hidden` has
/// them drawn.
///
/// Visible and hidden edges, kinds, parts and materials never join. With every option off each
/// edge longer than nothing is in exactly one chain and no point is moved; points between pieces
/// of one straight line are left out. Chains come in the order of the feature segments they begin
/// with.
#[must_use]
pub fn link(map: &ViewMap, options: &ChainOptions, unit: Unit, hidden: HiddenLines) -> Vec<Chain> {
    link_with(map, options, unit, hidden, None, &mut Bin::default())
}

/// Chains as [`link`] makes them, but that tidying draws no line across what hides it, however thin, if
/// that is another surface than the line's own.
#[must_use]
pub fn link_behind(
    ahead: &Ahead,
    map: &ViewMap,
    options: &ChainOptions,
    unit: Unit,
    hidden: HiddenLines,
) -> Vec<Chain> {
    link_with(map, options, unit, hidden, Some(ahead), &mut Bin::default())
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
    let chains = link_with(map, options, unit, hidden, ahead, &mut bin);
    (chains, bin.emptied())
}

fn link_with(
    map: &ViewMap,
    options: &ChainOptions,
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
        fit: if options.fit { options.fit_tolerance.in_unit(unit).max(0.0) } else { 0.0 },
    };
    let raws = tidied(map, hidden, t.tidy, DIRECTION_PX * px, ahead, bin);
    raws.into_par_iter().with_min_len(4).map(|raw| chain(raw, t)).collect()
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
        fit: if options.fit { options.fit_tolerance.in_unit(unit).max(0.0) } else { 0.0 },
    };
    let sample = Sample::new(0.0, 1.0);
    let mut line = Line { closed, ..Line::default() };
    for (point, soft) in points.iter().zip(soft) {
        line.push(*point, sample, *soft, false);
    }
    finish(&simplify::simplify(&line, merge), t).1
}

/// Lines inside lie where noise puts them, more than contours do: smoothing may move them this many
/// times farther.
const INSIDE_SMOOTH: f64 = 3.0;

fn chain(raw: Raw, mut t: Tolerances) -> Chain {
    if raw.class.kind.is_inside() {
        t.smooth *= INSIDE_SMOOTH;
    }
    let (line, path) = finish(&raw.line, t);
    Chain {
        samples: line.samples,
        points: line.points,
        closed: line.closed,
        kind: raw.class.kind,
        silhouette: raw.class.silhouette,
        invisibility: raw.invisibility,
        both_seen: raw.class.both_seen,
        part: raw.class.part,
        material: raw.class.material,
        smooth: raw.smooth,
        covered: raw.covered,
        segment: raw.segment,
        path,
    }
}
