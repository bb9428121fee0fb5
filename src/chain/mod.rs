//! [`Chain`]: view edges joined end to end, tidied, smoothed and fitted with curves.

mod corners;
mod crumbs;
mod curve;
mod doubles;
mod finish;
mod fit;
mod flips;
mod line;
mod link;
pub mod options;
mod resample;
mod simplify;
mod smooth;
mod stitch;
#[cfg(test)]
mod tests;
mod tidy;
mod unfold;

pub use options::ChainOptions;

use kurbo::{BezPath, Point};
use rayon::prelude::*;

use crate::drawing::{Length, Unit};
use crate::lines::LineKind;
use crate::mesh::{MaterialId, PartId};
use crate::viewmap::{ViewMap, ViewVertexId};
use finish::{Tolerances, finish};
use line::Line;
use link::{Ends, Step, routes};
use stitch::{Raw, stitch};
use tidy::Tidied;

/// What a chain knows of the world at one of its points; travels with the chain so that strokes
/// never look back into the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Distance from the eye along the optical axis, world units.
    pub depth: f64,
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
    /// The curve that is drawn: fitted Béziers, or the polyline of `points`.
    pub path: BezPath,
}

/// Length over which directions are measured at junctions, px.
const DIRECTION_PX: f64 = 3.0;

/// Joins the view edges end to end and makes drawn lines of them.
///
/// Visible and hidden edges, kinds, parts, materials and silhouettes never join. With every option
/// off each edge longer than nothing is in exactly one chain and no point is moved; points between
/// pieces of one straight line are left out. Chains come in the order of the feature segments
/// they begin with.
#[must_use]
pub fn link(map: &ViewMap, options: &ChainOptions, unit: Unit) -> Vec<Chain> {
    let px = Length::px(1.0).in_unit(unit);
    let t = Tolerances {
        px,
        smooth: options.smooth.in_unit(unit).max(0.0),
        simplify: options.simplify.in_unit(unit).max(0.0),
        tidy: options.tidy.in_unit(unit).max(0.0),
        fit: if options.fit { options.fit_tolerance.in_unit(unit).max(0.0) } else { 0.0 },
    };
    let window = DIRECTION_PX * px;
    let tidied = tidy::tidy(map, t, window);
    let routes = routes(map, &tidied.classes, window);
    let ends = Ends::new(map, |e| tidied.classes[e].is_some_and(|class| !class.hidden));
    let raws: Vec<Raw> = (0..routes.len())
        .into_par_iter()
        .with_min_len(64)
        .filter_map(|route| raw(map, routes.get(route), &tidied, &ends))
        .collect();
    stitch(raws, t).into_par_iter().with_min_len(4).map(|raw| chain(raw, t)).collect()
}

/// The line of a route, or nothing for one seen end-on as a point.
fn raw(map: &ViewMap, (steps, closed): (&[Step], bool), tidied: &Tidied, ends: &Ends) -> Option<Raw> {
    let (first, last) = (steps.first()?, steps.last()?);
    let class = tidied.classes[first.edge as usize]?;
    let noisy = matches!(class.kind, LineKind::Contour | LineKind::Crease) && tidied.is_organic(class.part);
    let line = Line::of_route(map, steps, closed, noisy);
    // A closed line of two points runs there and back.
    let line = if closed && line.len() == 2 { line.opened_at(0) } else { line };
    if line.len() < 2 {
        return None;
    }
    let edges = || steps.iter().map(|step| &map.edges[step.edge as usize]);
    let hidden = edges().map(|edge| edge.invisibility).filter(|i| *i > 0).min().unwrap_or(0);
    let free = |vertex: ViewVertexId| ends.at(vertex.index()).len() <= 1;
    Some(Raw {
        line,
        class,
        invisibility: if class.hidden { hidden } else { 0 },
        smooth: noisy || 2 * edges().filter(|edge| edge.smooth).count() > steps.len(),
        free: [free(first.from(map)), free(last.to(map))],
    })
}

fn chain(raw: Raw, t: Tolerances) -> Chain {
    let (line, path) = finish(&raw.line, t);
    Chain {
        samples: line.depths.iter().map(|depth| Sample { depth: *depth }).collect(),
        points: line.points,
        closed: line.closed,
        kind: raw.class.kind,
        silhouette: raw.class.silhouette,
        invisibility: raw.invisibility,
        both_seen: raw.class.both_seen,
        part: raw.class.part,
        material: raw.class.material,
        smooth: raw.smooth,
        path,
    }
}
