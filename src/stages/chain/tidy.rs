//! Decides which lines are drawn and sews them together.
//!
//! Source: Bénard, Hertzmann and Kass, Computing smooth surface contours with accurate topology,
//! ACM Transactions on Graphics 2014, section 6: lines without junctions that are short and end
//! free, loop on themselves or lie beside others go, until none is left.

use rayon::prelude::*;

use super::crumbs::drop_crumbs;
use super::doubles::drop_doubles;
use super::gaps::bridge;
use super::link::{Class, routes};
use super::raw::{Degrees, Raw};
use super::removed::{Bin, Reason};
use super::silhouette;
use super::stitch::stitch;
use crate::lines::HiddenLines;
use crate::shape::Origin;
use crate::viewmap::{Ahead, ViewEdge, ViewMap};

/// Hidden gaps are bridged up to this part of the tidy length.
const GAP: f64 = 0.6;

/// A line changes between silhouette and inner contour no more often than every so many tidy
/// lengths.
const SILHOUETTE: f64 = 3.0;

/// A line shorter than this many tidy lengths is less than a dot of the pen.
const POINT: f64 = 0.1;

/// Rounds of dropping and sewing; each may free the ends of others.
const ROUNDS: usize = 3;

/// The tidied lines of a view map. Hidden ones are left out where they are not drawn; what else is
/// left out goes to the bin.
pub(super) fn tidied(
    map: &ViewMap,
    hidden: HiddenLines,
    tidy: f64,
    window: f64,
    ahead: Option<&Ahead>,
    bin: &mut Bin,
) -> Vec<Raw> {
    let mut classes: Vec<Option<Class>> = map.edges.iter().map(|e| Some(Class::of(e))).collect();
    if tidy > 0.0 {
        leave_out_needles(map, &mut classes, bin);
        if map.edges.iter().any(|e| e.invisibility > 0) {
            let is_left = |(e, class): (&ViewEdge, &Option<Class>)| class.map(|_| Class::of_source(e));
            let sources: Vec<Option<Class>> = map.edges.iter().zip(&classes).map(is_left).collect();
            bridge(map, &routes(map, &sources, window), GAP * tidy, ahead, &mut classes);
        }
        for class in classes.iter_mut().flatten() {
            class.silhouette = false;
        }
    } else {
        // Nothing is taken for noise.
        classes.iter_mut().flatten().for_each(|class| class.origin = Origin::Constructed);
    }
    if hidden == HiddenLines::None {
        classes.iter_mut().filter(|c| c.is_some_and(|c| c.hidden)).for_each(|c| *c = None);
    }
    let routes = routes(map, &classes, window);
    let raw = |route| Raw::of_route(map, &routes, route, &classes);
    let mut raws: Vec<Raw> = (0..routes.len()).into_par_iter().with_min_len(64).filter_map(raw).collect();
    if tidy <= 0.0 {
        return raws;
    }
    let mut degrees = Degrees::new(map, &classes);
    for _ in 0..ROUNDS {
        let count = raws.len();
        raws = stitch(raws, &mut degrees, tidy, ahead, bin);
        drop_doubles(&mut raws, &mut degrees, tidy, bin);
        drop_crumbs(&mut raws, &mut degrees, tidy, bin);
        if raws.len() == count {
            break;
        }
    }
    let mut parts = Vec::with_capacity(raws.len());
    for raw in raws {
        if !raw.class.hidden && raw.length() < POINT * tidy {
            bin.put(&raw, || Reason::Point);
            continue;
        }
        silhouette::cut(raw, SILHOUETTE * tidy, &mut parts);
    }
    parts
}

/// Takes the sides of folds that are thinner than a pen from the lines, but for what of them is outline.
fn leave_out_needles(map: &ViewMap, classes: &mut [Option<Class>], bin: &mut Bin) {
    if map.needles.is_empty() {
        return;
    }
    for (edge, class) in map.edges.iter().zip(classes) {
        // A gap in the outline is worse.
        if !edge.silhouette && map.needles.binary_search(&edge.segment).is_ok() {
            *class = None;
            if edge.invisibility == 0 {
                let ends = [edge.start, edge.end].map(|v| map.vertices[v.index()].position);
                bin.put_piece(edge.kind, Reason::Double, ends);
            }
        }
    }
}
