//! Drops what no illustrator would draw: crumbs, spurs, tiny loops and creases that are noise.

use super::link::{Class, Ends, Routes, Step};
use crate::lines::LineKind;
use crate::viewmap::{ViewMap, ViewVertexId, ViewVertexKind};

/// A noisy crease must be this many times longer than a crumb.
const NOISE: f64 = 5.0;

/// Degrees of a dihedral angle beyond which a crease counts double.
const PRONOUNCED_DEG: f32 = 75.0;

/// Takes the class from the edges of every such route; returns whether there was any.
pub(super) fn drop_crumbs(
    map: &ViewMap,
    routes: &Routes,
    organic: &[bool],
    tidy: f64,
    classes: &mut [Option<Class>],
) -> bool {
    let ends = Ends::new(map, |e| classes[e].is_some_and(|c| !c.hidden));
    let mut dropped = false;
    for (steps, closed) in routes.iter() {
        if is_crumb(map, steps, closed, organic, tidy, &ends, classes) {
            for step in steps {
                classes[step.edge as usize] = None;
            }
            dropped = true;
        }
    }
    dropped
}

fn is_crumb(
    map: &ViewMap,
    steps: &[Step],
    closed: bool,
    organic: &[bool],
    tidy: f64,
    ends: &Ends,
    classes: &[Option<Class>],
) -> bool {
    let (Some(first), Some(last)) = (steps.first(), steps.last()) else { return false };
    let edge = |step: &Step| &map.edges[step.edge as usize];
    let Some(class) = classes[first.edge as usize] else { return false };
    let total = |keep: &dyn Fn(&Step) -> bool| -> f64 {
        steps.iter().filter(|s| keep(s)).map(|s| s.length(map)).sum()
    };
    let length = total(&|_| true);
    if class.hidden || length >= NOISE * tidy {
        return false;
    }
    let soft = total(&|s| edge(s).smooth) > 0.5 * length;
    // A gap in the outline is worse than a crumb on it.
    if total(&|s| edge(s).silhouette) > 0.5 * length {
        return false;
    }
    let scanned = organic.get(class.part.index()).copied().unwrap_or(false);
    if closed || first.from(map) == last.to(map) {
        // A loop of two strokes' width is a blot; a ring of creases on a scan, a grain.
        let noise = scanned && class.kind == LineKind::Crease;
        return (soft && length < 2.0 * tidy) || noise;
    }
    let free = |v: ViewVertexId, by_cover: bool| {
        ends.at(v.index()).len() == 1 || by_cover && map.vertices[v.index()].kind == ViewVertexKind::TJunction
    };
    // Where a surface covers the line it ends in the drawing, but not on the surface.
    let covered = |v: ViewVertexId| map.vertices[v.index()].kind == ViewVertexKind::TJunction;
    let (from, to) = (first.from(map), last.to(map));
    match class.kind {
        LineKind::Contour if soft => length < tidy && (free(from, true) || free(to, true)),
        LineKind::Crease if scanned => {
            // Hysteresis: pronounced pieces count double, so that a short sharp crease stays where
            // a long faint one does, and noise, short and faint, goes.
            let pronounced = total(&|s| edge(s).strength >= PRONOUNCED_DEG);
            length + pronounced < NOISE * tidy && (free(from, true) || free(to, true))
        }
        LineKind::Crease => {
            // On exact models only what ends in the middle of a surface is doubtful.
            let loose = |v: ViewVertexId| free(v, false) && !covered(v);
            length < tidy && loose(from) && loose(to)
        }
        LineKind::Wire | LineKind::Border | LineKind::Motion => false,
        _ => length < 0.25 * tidy && free(from, false) && free(to, false),
    }
}
