//! [`PenChoice`]: a function of the program that changes the pen of each line, after all rules.

use std::fmt;
use std::sync::Arc;

use kurbo::Vec2;

use super::pen::Pen;
use crate::chains::Chain;
use crate::drawing::Unit;
use crate::geometry::numbers::portable_math::atan2;
use crate::lines::LineKind;

/// A line that is about to get its ink.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct LineInfo<'a> {
    /// Kind of the line.
    pub kind: LineKind,
    /// Whether background is on one side of the line.
    pub silhouette: bool,
    /// Whether a surface hides the line.
    pub hidden: bool,
    /// Whether the line returns to its start.
    pub closed: bool,
    /// Name of the part; empty if it has none.
    pub part: &'a str,
    /// Name of the material; empty if it has none.
    pub material: &'a str,
    /// Unit of the page.
    pub unit: Unit,
    /// Length on the page, in `unit`.
    pub length: f64,
    /// Mean curvature of the line on the page, in radians per `unit`; 0 for a straight line.
    pub curvature: f64,
    /// Mean distance from the camera along its axis, 0 at the nearest point of the scene and 1 at the
    /// farthest.
    pub depth: f64,
    /// Mean light on the surface next to the line, from 0 to 1.
    pub light: f64,
}

impl<'a> LineInfo<'a> {
    /// The properties of a chain. `depths` are the depths of the nearest and farthest point of the scene.
    pub(crate) fn of(chain: &Chain, [part, material]: [&'a str; 2], depths: [f64; 2], unit: Unit) -> Self {
        let Chain { kind, silhouette, closed, points, samples, .. } = chain;
        let ring = closed.then(|| points.first()).flatten();
        let ends = points.iter().zip(points.iter().skip(1).chain(ring));
        let steps: Vec<Vec2> = ends.map(|(a, b)| *b - *a).filter(|step| step.hypot2() > 0.0).collect();
        let length: f64 = steps.iter().map(|step| step.length()).sum();
        let first = closed.then(|| steps.first()).flatten();
        let turns = steps.iter().zip(steps.iter().skip(1).chain(first));
        let turning: f64 = turns.map(|(a, b)| atan2(a.cross(*b), a.dot(*b)).abs()).sum();
        let mean = |value: fn(&crate::chains::Sample) -> f64| {
            samples.iter().map(value).sum::<f64>() / samples.len().max(1) as f64
        };
        let [near, far] = depths;
        let depth =
            if far > near { ((mean(|s| s.depth) - near) / (far - near)).clamp(0.0, 1.0) } else { 0.0 };
        Self {
            kind: *kind,
            silhouette: *silhouette,
            hidden: chain.invisibility > 0,
            closed: *closed,
            part,
            material,
            unit,
            length,
            curvature: if length > 0.0 { turning / length } else { 0.0 },
            depth,
            light: mean(|s| s.light),
        }
    }
}

/// Signature of the function.
type ChangePen = dyn Fn(&LineInfo, &mut Pen) + Send + Sync;

/// A function that changes the pen of each line. Compared by identity.
#[derive(Clone)]
pub(crate) struct PenChoice(pub Arc<ChangePen>);

impl fmt::Debug for PenChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("PenChoice")
    }
}

impl PartialEq for PenChoice {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}
