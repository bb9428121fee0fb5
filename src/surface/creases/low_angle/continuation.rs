//! [`Beyond`]: how a surface goes on from an edge, straight across one of its faces.
//!
//! Facets of a curve turn again by as much, the same way, before they have gone much farther than the facet before; what was
//! cut at an angle does not.

use std::f64::consts::PI;

use glam::DVec3;

use super::surface_trace::{Bend, Crossing, Walk};
use crate::geometry::numbers::portable_math::cos;
use crate::mesh::{EdgeFaces, FaceId};

/// A surface turns again if it does by more than this share of the turn.
const AGAIN: f64 = 0.35;

/// Facets of one curve are as wide as each other: a surface that turns again so many times farther off is none of them.
const WIDE: f64 = 4.0;
/// Facets of one rounding are as wide as each other but for this factor.
const ALIKE: f64 = 1.5;
/// In its middle a rounding turns by twice as much as at its ends, and by rounding a little more.
const TWICE: f64 = 2.2;

/// A facet of no more faces is looked at all around.
const FACET: usize = 16;
/// The cosine (a quarter of a degree) above which two sides of a facet lie on one line, if they are aside from it by no more than
/// this share of the way between.
const STRAIGHT: f64 = 0.999_99;
const ASIDE: f64 = 0.004;
/// The cosine (45 degrees) above which two edges of a facet run beside each other.
const PARALLEL: f64 = 0.71;
/// Edges one behind the other lie on one line where they are apart by less than this share of their distance.
const SAME_LINE: f64 = 0.1;

/// How a surface goes on straight across from an edge.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Beyond {
    /// It ends at so great a distance: at a crease, or where the mesh does.
    Ends(f64),
    /// It turns again at so great a distance, the same way.
    Bends(f64),
    /// It turns back by as much at this edge.
    TurnsBack(usize),
}

/// Whether surfaces that go on so from both sides of an edge end there.
fn is_end(beyond: [Beyond; 2]) -> bool {
    match beyond {
        [Beyond::Bends(far), Beyond::Ends(near)] | [Beyond::Ends(near), Beyond::Bends(far)] => {
            far > WIDE * near
        }
        [Beyond::Ends(_), _] | [_, Beyond::Ends(_)] => true,
        _ => false,
    }
}

impl Walk<'_> {
    /// Whether the surfaces on both sides of an edge end at it, with the edges at which they have to turn back for that.
    pub fn ends_at(&self, edge: usize) -> Option<[Option<usize>; 2]> {
        let (bend, faces) = self.bend(edge)?;
        let [first, second] = faces.map(|face| self.beyond(&bend, face));
        let beyond = [first?, second?];
        // Facets of curves are mostly told by a few faces; all around them is asked of what is left.
        if !is_end(beyond) {
            return None;
        }
        let first = self.seen_around(&bend, faces[0], beyond[0])?;
        // Whatever is around the other facet, it makes no end of what is none.
        if !is_end([first, beyond[1]]) {
            return None;
        }
        let beyond = [first, self.seen_around(&bend, faces[1], beyond[1])?];
        is_end(beyond).then_some(beyond.map(|beyond| match beyond {
            Beyond::TurnsBack(edge) => Some(edge),
            _ => None,
        }))
    }

    /// How the surface goes on from an edge, straight across one of its faces; none where that is not told.
    fn beyond(&self, bend: &Bend, face: u32) -> Option<Beyond> {
        let (beyond, crossed) = self.across(bend, face)?;
        match (beyond, crossed) {
            (Beyond::Ends(near), Some((sharp, last))) if self.is_of_rounding(bend, near, sharp, last) => {
                Some(Beyond::Bends(near))
            }
            _ => Some(beyond),
        }
    }

    /// The same, where the facet that the face is of does not bend straight across but may aside of that; none if it is a triangle.
    fn seen_around(&self, bend: &Bend, face: u32, beyond: Beyond) -> Option<Beyond> {
        let Some(around) = self.facet(face) else { return Some(beyond) };
        if self.is_triangle(&around) {
            return None;
        }
        match beyond {
            Beyond::Bends(_) => Some(beyond),
            _ => Some(self.bends_beside(bend, &around).map_or(beyond, Beyond::Bends)),
        }
    }

    /// Whether a crease that is met so far beyond an edge is the middle of a rounding in few steps: what is beyond is as
    /// wide and turns again the same way.
    fn is_of_rounding(&self, bend: &Bend, near: f64, sharp: usize, last: u32) -> bool {
        let most = cos((TWICE * bend.turn).min(PI)) as f32;
        let is_step =
            |edge: usize| self.turns.of_two(edge) >= most && self.is_convex(edge) == Some(bend.convex);
        let Some(other) = self.over(sharp, last).filter(|_| is_step(sharp)) else { return false };
        let far = match self.across(&Bend { edge: sharp, ..*bend }, other) {
            Some((Beyond::Bends(far), _)) => far,
            Some((Beyond::Ends(far), Some((next, _)))) if is_step(next) => far,
            _ => return false,
        };
        far < ALIKE * near && near < ALIKE * far
    }

    /// The edges around the facet that a face is of; none of a large one.
    fn facet(&self, face: u32) -> Option<Vec<usize>> {
        let (mut own, mut at, mut around) = (vec![face], 0, Vec::new());
        while at < own.len() {
            let face = own[at];
            at += 1;
            let [a, b, c] = self.mesh.triangles[face as usize];
            for [a, b] in [[a, b], [b, c], [c, a]] {
                let Some(edge) = self.edge([a.min(b), a.max(b)]) else { continue };
                match self.over(edge, face).filter(|_| self.flat.contains(edge)) {
                    Some(other) if own.contains(&other) => {}
                    Some(_) if own.len() == FACET => return None,
                    Some(other) => own.push(other),
                    None => around.push(edge),
                }
            }
        }
        Some(around)
    }

    /// Whether a facet has three sides alone: those of thinned out meshes end where it happens.
    fn is_triangle(&self, around: &[usize]) -> bool {
        let mut lines: Vec<[DVec3; 2]> = Vec::new();
        for edge in around {
            let [p, q] = self.mesh.edges.vertices[*edge].map(|v| self.mesh.positions[v as usize]);
            let along = (q - p).normalize_or_zero();
            let is_on = |[from, way]: &[DVec3; 2]| {
                let (aside, far) = ((p - *from).reject_from(*way).length(), (p - *from).length());
                along.dot(*way).abs() > STRAIGHT && aside <= ASIDE * far.max(p.distance(q))
            };
            if !lines.iter().any(is_on) {
                lines.push([p, along]);
            }
        }
        lines.len() <= 3
    }

    /// How far away a facet bends again along an edge much like this one.
    fn bends_beside(&self, bend: &Bend, around: &[usize]) -> Option<f64> {
        let ends = |edge: usize| self.mesh.edges.vertices[edge].map(|v| self.mesh.positions[v as usize]);
        let [from, to] = ends(bend.edge);
        let again = cos(AGAIN * bend.turn) as f32;
        let bends = |edge: usize| {
            let cosine = self.turns.of_two(edge);
            cosine < again && cosine >= self.most && self.is_convex(edge) == Some(bend.convex)
        };
        let way = |edge: usize| {
            let [p, q] = ends(edge);
            (q - p).normalize_or_zero()
        };
        let along = way(bend.edge);
        let apart = |edge: usize| {
            let [p, q] = ends(edge);
            let away = (p + q) / 2.0 - (from + to) / 2.0;
            let apart = away.reject_from(along).length();
            // What goes on along the edge itself is the same crease.
            let is_beside = way(edge).dot(along).abs() > PARALLEL && apart > SAME_LINE * away.length();
            is_beside.then_some(apart)
        };
        // What goes on from end to end around the facet is the same crease as well.
        let mut others: Vec<usize> =
            around.iter().copied().filter(|edge| *edge != bend.edge && bends(*edge)).collect();
        let mut same = vec![bend.edge];
        while let Some(last) = same.pop() {
            let [a, b] = self.mesh.edges.vertices[last];
            others.retain(|edge| {
                let meets = self.mesh.edges.vertices[*edge].iter().any(|v| *v == a || *v == b)
                    && way(*edge).dot(way(last)).abs() > PARALLEL;
                if meets {
                    same.push(*edge);
                }
                !meets
            });
        }
        others.into_iter().filter_map(apart).min_by(f64::total_cmp)
    }

    /// How the surface goes on from the middle of an edge, square to it, and the edge where that is, with the face before it.
    fn across(&self, bend: &Bend, face: u32) -> Option<(Beyond, Option<(usize, u32)>)> {
        let again = cos(AGAIN * bend.turn) as f32;
        for crossing in self.crossings(bend.edge, face) {
            let Crossing { edge, before, reach } = crossing?;
            let EdgeFaces::Two { faces, same_way } = self.mesh.edges.faces(edge) else {
                return Some((Beyond::Ends(reach), None));
            };
            let other = faces[usize::from(faces[0] == before)];
            if self.mesh.is_degenerate(FaceId(other)) {
                return None;
            }
            let cosine = self.turns.of_two(edge);
            if self.hard.is_hard(edge) || cosine < self.most {
                return Some((Beyond::Ends(reach), Some((edge, before))));
            }
            if cosine < again {
                let same = self.is_convex(edge)? == bend.convex;
                return Some((if same { Beyond::Bends(reach) } else { Beyond::TurnsBack(edge) }, None));
            }
            if same_way {
                return None;
            }
        }
        Some((Beyond::Ends(f64::INFINITY), None))
    }
}
