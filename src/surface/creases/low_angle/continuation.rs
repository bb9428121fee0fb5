//! [`Continuation`]: how a surface continues from an edge, straight across one of its faces.
//!
//! Facets of a curve bend again by a similar angle in the same direction, at about the width of one facet. A
//! surface cut at an angle does not. An edge where neither side continues as a curve is a crease.

use std::f64::consts::PI;

use glam::DVec3;

use super::surface_trace::{BentEdge, SurfaceTracer, TraceCrossing};
use crate::geometry::numbers::portable_math::cos;
use crate::mesh::Dihedral;
use crate::mesh::edges::triangle_sides::sides;

/// Minimum turn, as a share of the first turn, for the surface to bend again.
const MIN_TURN_RATIO: f64 = 0.35;

/// Maximum ratio of facet widths on one curve. A surface that bends again farther away is not part of the
/// curve.
const MAX_FACET_WIDTH_RATIO: f64 = 4.0;
/// Maximum ratio of the widths of two neighbouring steps of one fillet.
const MAX_STEP_WIDTH_RATIO: f64 = 1.5;
/// Maximum turn in the middle of a fillet, as a multiple of the turn at its ends: 2, plus rounding.
const MAX_MIDDLE_TURN_RATIO: f64 = 2.2;

/// Maximum number of faces of a facet that is examined all around.
const MAX_FACET_FACES: usize = 16;
/// Two sides of a facet are collinear above this cosine (a quarter of a degree), if their offset is below the
/// share `MAX_COLLINEAR_OFFSET` of their distance or length.
const MIN_COLLINEAR_COSINE: f64 = 0.999_99;
const MAX_COLLINEAR_OFFSET: f64 = 0.004;
/// Minimum cosine (45 degrees) between parallel edges of a facet.
const MIN_PARALLEL_COSINE: f64 = 0.71;
/// Minimum sideways offset between parallel edges, as a share of their distance. Below it they lie on one
/// line.
const MIN_PARALLEL_OFFSET: f64 = 0.1;

/// Continuation of a surface straight across from an edge.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Continuation {
    /// Ends at this distance: at a crease, or at a border of the mesh.
    Ends(f64),
    /// Bends again at this distance, in the same direction.
    Bends(f64),
    /// Bends back by a similar angle at this edge.
    TurnsBack(usize),
}

/// Whether surfaces with these two continuations end at the edge between them.
fn is_end(continuations: [Continuation; 2]) -> bool {
    match continuations {
        [Continuation::Bends(far), Continuation::Ends(near)]
        | [Continuation::Ends(near), Continuation::Bends(far)] => far > MAX_FACET_WIDTH_RATIO * near,
        [Continuation::Ends(_), _] | [_, Continuation::Ends(_)] => true,
        _ => false,
    }
}

impl SurfaceTracer<'_> {
    /// Whether the surfaces on both sides of an edge end at it. Returns the edges where they must bend back
    /// for that.
    pub(crate) fn ends_at(&self, edge: usize) -> Option<[Option<usize>; 2]> {
        let (bend, faces) = self.bend(edge)?;
        let [first, second] = faces.map(|face| self.continuation(&bend, face));
        let direct = [first?, second?];
        // A trace is enough for most facets of curves. Only for the rest are the facets examined all around.
        if !is_end(direct) {
            return None;
        }
        let first = self.continuation_around_facet(&bend, faces[0], direct[0])?;
        // The other facet cannot turn this result into an end.
        if !is_end([first, direct[1]]) {
            return None;
        }
        let around_facets = [first, self.continuation_around_facet(&bend, faces[1], direct[1])?];
        is_end(around_facets).then_some(around_facets.map(|beyond| match beyond {
            Continuation::TurnsBack(edge) => Some(edge),
            _ => None,
        }))
    }

    /// Continuation of the surface from an edge, straight across one of its faces; `None` if undecided.
    fn continuation(&self, bend: &BentEdge, face: u32) -> Option<Continuation> {
        let (direct, crossed) = self.across(bend, face)?;
        match (direct, crossed) {
            (Continuation::Ends(near), Some((sharp, last)))
                if self.is_fillet_centre(bend, near, sharp, last) =>
            {
                Some(Continuation::Bends(near))
            }
            _ => Some(direct),
        }
    }

    /// Same, but checks the whole facet of the face for bends off the trace. `None` if the facet is a
    /// triangle.
    fn continuation_around_facet(
        &self,
        bend: &BentEdge,
        face: u32,
        direct: Continuation,
    ) -> Option<Continuation> {
        let Some(around) = self.facet(face) else { return Some(direct) };
        if self.is_triangle(&around) {
            return None;
        }
        match direct {
            Continuation::Bends(_) => Some(direct),
            _ => Some(self.parallel_bend_distance(bend, &around).map_or(direct, Continuation::Bends)),
        }
    }

    /// Whether a crease at distance `near` is the middle of a fillet of few steps: the next strip has a
    /// similar width and bends in the same direction.
    fn is_fillet_centre(&self, bend: &BentEdge, near: f64, sharp: usize, last: u32) -> bool {
        let min_cosine = cos((MAX_MIDDLE_TURN_RATIO * bend.turn).min(PI)) as f32;
        let is_step =
            |edge: usize| self.turns.of_two(edge) >= min_cosine && self.is_convex(edge) == Some(bend.convex);
        let Some(far_face) = self.mesh.edges.faces(sharp).across(last).filter(|_| is_step(sharp)) else {
            return false;
        };
        let far = match self.across(&BentEdge { edge: sharp, ..*bend }, far_face) {
            Some((Continuation::Bends(far), _)) => far,
            Some((Continuation::Ends(far), Some((next, _)))) if is_step(next) => far,
            _ => return false,
        };
        far < MAX_STEP_WIDTH_RATIO * near && near < MAX_STEP_WIDTH_RATIO * far
    }

    /// The edges around the facet of a face; `None` for a large facet.
    fn facet(&self, face: u32) -> Option<Vec<usize>> {
        let (mut facet_faces, mut at, mut around) = (vec![face], 0, Vec::new());
        while at < facet_faces.len() {
            let face = facet_faces[at];
            at += 1;
            for [a, b] in sides(self.mesh.triangles[face as usize]) {
                let Some(edge) = self.edges.between(a, b) else { continue };
                match self.beyond(edge, face).filter(|_| self.is_flat(edge)) {
                    Some(neighbour) if facet_faces.contains(&neighbour) => {}
                    Some(_) if facet_faces.len() == MAX_FACET_FACES => return None,
                    Some(unvisited) => facet_faces.push(unvisited),
                    None => around.push(edge),
                }
            }
        }
        Some(around)
    }

    /// Whether a facet has at most three sides. Facets of decimated meshes have arbitrary borders.
    fn is_triangle(&self, around: &[usize]) -> bool {
        let mut lines: Vec<[DVec3; 2]> = Vec::new();
        for edge in around {
            let [p, q] = self.mesh.ends(*edge);
            let along = (q - p).normalize_or_zero();
            let is_on = |[from, direction]: &[DVec3; 2]| {
                let (aside, far) = ((p - *from).reject_from(*direction).length(), (p - *from).length());
                along.dot(*direction).abs() > MIN_COLLINEAR_COSINE
                    && aside <= MAX_COLLINEAR_OFFSET * far.max(p.distance(q))
            };
            if !lines.iter().any(is_on) {
                lines.push([p, along]);
            }
        }
        lines.len() <= 3
    }

    /// Distance to the nearest edge of the facet that is parallel to this one and bends again.
    fn parallel_bend_distance(&self, bend: &BentEdge, around: &[usize]) -> Option<f64> {
        let ends = |edge: usize| self.mesh.ends(edge);
        let [from, to] = ends(bend.edge);
        let bend_cosine = cos(MIN_TURN_RATIO * bend.turn) as f32;
        let bends = |edge: usize| {
            let cosine = self.turns.of_two(edge);
            cosine < bend_cosine && cosine >= self.crease_cosine && self.is_convex(edge) == Some(bend.convex)
        };
        let direction = |edge: usize| {
            let [p, q] = ends(edge);
            (q - p).normalize_or_zero()
        };
        let along = direction(bend.edge);
        let bend_distance = |edge: usize| {
            let [p, q] = ends(edge);
            let away = (p + q) / 2.0 - (from + to) / 2.0;
            let distance = away.reject_from(along).length();
            // An edge on the same line belongs to the same crease.
            let is_beside = direction(edge).dot(along).abs() > MIN_PARALLEL_COSINE
                && distance > MIN_PARALLEL_OFFSET * away.length();
            is_beside.then_some(distance)
        };
        // So does an edge connected end to end around the facet.
        let mut others: Vec<usize> =
            around.iter().copied().filter(|edge| *edge != bend.edge && bends(*edge)).collect();
        let mut same = vec![bend.edge];
        while let Some(last) = same.pop() {
            let [a, b] = self.mesh.edges.vertices[last];
            others.retain(|edge| {
                let meets = self.mesh.edges.vertices[*edge].iter().any(|v| *v == a || *v == b)
                    && direction(*edge).dot(direction(last)).abs() > MIN_PARALLEL_COSINE;
                if meets {
                    same.push(*edge);
                }
                !meets
            });
        }
        others.into_iter().filter_map(bend_distance).min_by(f64::total_cmp)
    }

    /// Continuation found by a trace from the middle of an edge, with the edge where a crease ended it and
    /// the face before that edge.
    fn across(&self, bend: &BentEdge, face: u32) -> Option<(Continuation, Option<(usize, u32)>)> {
        let bend_cosine = cos(MIN_TURN_RATIO * bend.turn) as f32;
        for crossing in self.crossings(bend.edge, face) {
            let TraceCrossing { edge, before, reach } = crossing?;
            let Some(Dihedral { faces, same_way, cosine }) = self.turns.dihedral(self.mesh, edge) else {
                return Some((Continuation::Ends(reach), None));
            };
            // Faces without area lie between these two.
            if faces.iter().any(|face| self.mesh.apex(*face, self.mesh.edges.vertices[edge]).is_none()) {
                return None;
            }
            if self.hard.is_hard(edge) || cosine < self.crease_cosine {
                return Some((Continuation::Ends(reach), Some((edge, before))));
            }
            if cosine < bend_cosine {
                let same = self.is_convex(edge)? == bend.convex;
                return Some((
                    if same { Continuation::Bends(reach) } else { Continuation::TurnsBack(edge) },
                    None,
                ));
            }
            if same_way {
                return None;
            }
        }
        Some((Continuation::Ends(f64::INFINITY), None))
    }
}
