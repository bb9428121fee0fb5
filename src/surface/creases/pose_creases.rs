//! Edges that only a pose creases: folds of a sheet, a hinge that opens.
//!
//! Whether an edge is one has a memory, so that none flickers about a threshold: it appears when it turns by more than the upper one,
//! and goes when it turns by less than the lower one. In between it is what it was. This is Canny's hysteresis (1986) in time instead of
//! along a line.

use std::cmp::Ordering;

use crate::parallel::prelude::*;

use crate::geometry::numbers::portable_math::cos;
use crate::mesh::{Dihedral, FaceId, Mesh};
use crate::parallel::task_size::GRAIN;

/// The thresholds are so far above and below the angle of a crease, as a share of it.
const MEMORY: f64 = 0.125;

/// Degrees between which an edge stays what it was.
#[derive(Debug, Clone, Copy)]
struct Thresholds {
    lower: f32,
    middle: f32,
    upper: f32,
}

/// The edges of a mesh that a pose creases, ascending: those at which the surface turns by more than about `crease_deg` degrees, and by as
/// much more, or the other way, than at rest. `may` says which edges are asked.
///
/// `before` has the same mesh as it was at earlier moments, the latest first; it is asked for no more of them than decide. What they
/// leave open is a crease if it turns by more than `crease_deg` now.
pub fn bent(
    rest: &Mesh,
    posed: &Mesh,
    crease_deg: f64,
    may: impl Fn(usize) -> bool + Sync,
    before: impl Iterator<Item = Mesh>,
) -> Vec<usize> {
    let at = |share: f64| (crease_deg * share) as f32;
    let thresholds = Thresholds { lower: at(1.0 - MEMORY), middle: at(1.0), upper: at(1.0 + MEMORY) };
    let least = cos(f64::from(thresholds.lower.min(180.0)).to_radians()) as f32;
    // Nearly all edges turn too little, which their cosine tells.
    let turns = |edge: &usize| {
        may(*edge) && Dihedral::at(posed, *edge).is_some_and(|dihedral| dihedral.cosine < least)
    };
    let asked = (0..posed.edges.len()).into_par_iter().with_min_len(GRAIN).filter(turns);
    let bends: Vec<(usize, f32)> = asked.filter_map(|edge| Some((edge, bend(rest, posed, edge)?))).collect();
    let (mut creased, mut open) = (Vec::new(), Vec::new());
    for (edge, now) in bends {
        match thresholds.decide(now) {
            Some(true) => creased.push(edge),
            Some(false) => {}
            None => open.push((edge, now)),
        }
    }
    let mut before = before;
    while !open.is_empty() {
        let Some(earlier) = before.next().filter(|mesh| mesh.edges.len() == rest.edges.len()) else { break };
        open.retain(|(edge, _)| {
            let decided = bend(rest, &earlier, *edge).and_then(|then| thresholds.decide(then));
            if decided == Some(true) {
                creased.push(*edge);
            }
            decided.is_none()
        });
    }
    creased.extend(open.iter().filter(|(_, now)| *now > thresholds.middle).map(|(edge, _)| *edge));
    creased.sort_unstable();
    creased
}

impl Thresholds {
    /// Whether an edge is a crease, where that does not depend on what it was.
    fn decide(&self, bend: f32) -> Option<bool> {
        match (bend.partial_cmp(&self.upper), bend.partial_cmp(&self.lower)) {
            (Some(Ordering::Greater), _) => Some(true),
            (_, Some(Ordering::Less)) => Some(false),
            _ => None,
        }
    }
}

/// Degrees by which the surface turns at an edge and by which it turns otherwise than at rest, whichever is less.
fn bend(rest: &Mesh, posed: &Mesh, edge: usize) -> Option<f32> {
    let now = signed_turn(posed, edge)?;
    let then = signed_turn(rest, edge).unwrap_or(0.0);
    Some(now.abs().min((now - then).abs()))
}

/// Degrees by which the surface turns at an edge, less than 0 where its outside is hollow.
fn signed_turn(mesh: &Mesh, edge: usize) -> Option<f32> {
    let dihedral = Dihedral::at(mesh, edge)?;
    let [first, second] = dihedral.faces;
    let ends = mesh.edges.vertices[edge];
    let third = mesh.triangles[second as usize].iter().find(|vertex| !ends.contains(vertex))?;
    let [a, b, c] = mesh.corners(FaceId(first));
    let way = mesh.positions[*third as usize] - mesh.positions[ends[0] as usize];
    let hollow = (b - a).cross(c - a).dot(way) > 0.0;
    Some(if hollow { -dihedral.turn() } else { dihedral.turn() })
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::geometry::numbers::portable_math::sin;
    use crate::mesh::Soup;

    /// Two squares that share a side, at which they turn by so many degrees.
    fn hinge(degrees: f64) -> Mesh {
        let (c, s) = (cos(degrees.to_radians()), sin(degrees.to_radians()));
        let points = [[-1., 0., 0.], [0., 0., 0.], [0., 1., 0.], [-1., 1., 0.], [c, 0., -s], [c, 1., -s]];
        Mesh::build(Soup {
            positions: points.map(DVec3::from).to_vec(),
            triangles: vec![[0, 1, 2], [0, 2, 3], [1, 4, 5], [1, 5, 2]],
            ..Soup::default()
        })
    }

    fn count(rest: f64, now: f64, before: &[f64]) -> usize {
        let before = before.iter().map(|degrees| hinge(*degrees));
        bent(&hinge(rest), &hinge(now), 40.0, |_| true, before).len()
    }

    #[test]
    fn what_bends_by_more_than_a_crease_is_one() {
        assert_eq!(count(0.0, 46.0, &[]), 1);
        assert_eq!(count(0.0, 34.0, &[]), 0);
        assert_eq!(count(0.0, -46.0, &[]), 1);
        // As at rest, or flatter.
        assert_eq!(count(90.0, 90.0, &[]), 0);
        assert_eq!(count(90.0, 30.0, &[]), 0);
        // The other way.
        assert_eq!(count(25.0, -46.0, &[]), 1);
        assert_eq!(count(25.0, 60.0, &[]), 0);
    }

    #[test]
    fn what_is_in_between_is_what_it_was() {
        for now in [36.0, 44.0] {
            assert_eq!(count(0.0, now, &[40.0, 46.0, 0.0]), 1, "{now}");
            assert_eq!(count(0.0, now, &[40.0, 34.0, 90.0]), 0, "{now}");
        }
        assert_eq!(count(0.0, 39.0, &[38.0]), 0);
        assert_eq!(count(0.0, 41.0, &[38.0]), 1);
    }
}
