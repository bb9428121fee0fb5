//! Decides which edges are drawn and what class each has, so that lines hold together.
//!
//! Source: Bénard, Hertzmann and Kass, Computing smooth surface contours with accurate topology,
//! ACM Transactions on Graphics 2014, section 6: lines without junctions that are short and end
//! free, loop on themselves or lie beside others go, until none is left.

use super::crumbs::drop_crumbs;
use super::doubles::drop_doubles;
use super::finish::Tolerances;
use super::flips::{bridge, even_out};
use super::link::{Class, routes};
use crate::lines::LineKind;
use crate::mesh::PartId;
use crate::viewmap::ViewMap;

/// Hidden gaps are bridged up to this part of the tidy length.
const GAP: f64 = 0.6;

/// Lines nearer than this part of the tidy length are double strokes.
const DOUBLE: f64 = 0.3;

/// Rounds of dropping; each may free the ends of others.
const ROUNDS: usize = 4;

/// What tidying found.
pub(super) struct Tidied {
    /// The class of every edge, `None` for those left out.
    pub classes: Vec<Option<Class>>,
    /// For each part, whether it is a scan or another rounded shape, whose creases may be noise;
    /// empty when nothing is tidied.
    organic: Vec<bool>,
}

impl Tidied {
    pub fn is_organic(&self, part: PartId) -> bool {
        self.organic.get(part.index()).copied().unwrap_or(false)
    }
}

/// Tidies the edges of a view map.
pub(super) fn tidy(map: &ViewMap, t: Tolerances, window: f64) -> Tidied {
    let mut classes: Vec<Option<Class>> = map.edges.iter().map(|e| Some(Class::of(e))).collect();
    if t.tidy <= 0.0 {
        return Tidied { classes, organic: Vec::new() };
    }
    if map.edges.iter().any(|e| e.invisibility > 0) {
        let sources: Vec<Option<Class>> = map.edges.iter().map(|e| Some(Class::of_source(e))).collect();
        bridge(map, &routes(map, &sources, window), GAP * t.tidy, &mut classes);
    }
    let sources: Vec<Option<Class>> = classes
        .iter()
        .zip(&map.edges)
        .map(|(c, e)| c.map(|c| Class { hidden: c.hidden, ..Class::of_source(e) }))
        .collect();
    even_out(map, &routes(map, &sources, window), t.tidy, &mut classes);
    let organic = organic_parts(map);
    for round in 0..ROUNDS {
        let routes = routes(map, &classes, window);
        let crumbs = drop_crumbs(map, &routes, &organic, t.tidy, &mut classes);
        let doubles = round < 2 && drop_doubles(map, &routes, &organic, DOUBLE * t.tidy, &mut classes);
        if !crumbs && !doubles {
            break;
        }
    }
    Tidied { classes, organic }
}

/// For each part, whether most of its contour runs over smooth surface: a scan or another rounded
/// shape, whose creases may be noise.
fn organic_parts(map: &ViewMap) -> Vec<bool> {
    let parts = map.edges.iter().map(|e| e.part.index() + 1).max().unwrap_or(0);
    let mut balance = vec![0.0; parts];
    for edge in &map.edges {
        let way = map.vertices[edge.end.index()].position - map.vertices[edge.start.index()].position;
        let length = super::line::length(way);
        balance[edge.part.index()] += match edge.kind {
            LineKind::Contour if edge.smooth => length,
            LineKind::Contour | LineKind::Crease => -length,
            _ => 0.0,
        };
    }
    balance.into_iter().map(|b| b > 0.0).collect()
}
