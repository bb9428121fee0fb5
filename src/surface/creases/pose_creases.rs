//! Edges creased only by a pose: folds of a sheet, an opening hinge.
//!
//! Hysteresis in time prevents flicker at the threshold. An edge becomes a crease above the upper threshold
//! and stops being one below the lower threshold. In between it keeps its earlier state. This is Canny's
//! hysteresis (1986), applied along time instead of along a line.

use std::cmp::Ordering;

use crate::parallel::prelude::*;

use crate::geometry::numbers::portable_math::cos;
use crate::mesh::{Dihedral, Mesh};
use crate::parallel::task_size::MIN_TASK_ITEMS;

/// Distance of both thresholds from the crease angle, as a share of that angle.
const HYSTERESIS_OF_CREASE: f64 = 0.125;

/// Hysteresis thresholds, degrees.
#[derive(Debug, Clone, Copy)]
struct HysteresisThresholds {
    lower: f32,
    middle: f32,
    upper: f32,
}

/// Edges that a pose creases, ascending.
///
/// At such an edge the surface turns by more than about `crease_deg` degrees, and differs from the rest pose
/// by at least as much. Only edges that satisfy `may` are examined.
///
/// `before` yields the mesh at earlier moments, latest first. Only as many are taken as the decision needs.
/// Edges that stay undecided are creases if they turn by more than `crease_deg` now.
pub(crate) fn pose_creases(
    rest: &Mesh,
    posed: &Mesh,
    crease_deg: f64,
    may: impl Fn(usize) -> bool + Sync,
    before: impl Iterator<Item = Mesh>,
) -> Vec<usize> {
    let at = |share: f64| (crease_deg * share) as f32;
    let thresholds = HysteresisThresholds {
        lower: at(1.0 - HYSTERESIS_OF_CREASE),
        middle: at(1.0),
        upper: at(1.0 + HYSTERESIS_OF_CREASE),
    };
    let least = cos(f64::from(thresholds.lower.min(180.0)).to_radians()) as f32;
    // Nearly all edges are ruled out by their cosine.
    let turns = |edge: &usize| {
        may(*edge) && Dihedral::at(posed, *edge).is_some_and(|dihedral| dihedral.cosine < least)
    };
    let asked = (0..posed.edges.len()).into_par_iter().with_min_len(MIN_TASK_ITEMS).filter(turns);
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

impl HysteresisThresholds {
    /// Whether an edge is a crease, or `None` if that depends on its earlier state.
    fn decide(&self, bend: f32) -> Option<bool> {
        match (bend.partial_cmp(&self.upper), bend.partial_cmp(&self.lower)) {
            (Some(Ordering::Greater), _) => Some(true),
            (_, Some(Ordering::Less)) => Some(false),
            _ => None,
        }
    }
}

/// Smaller of two angles, degrees: the turn at an edge, and its difference from the rest pose.
fn bend(rest: &Mesh, posed: &Mesh, edge: usize) -> Option<f32> {
    let now = signed_turn(posed, edge)?;
    let then = signed_turn(rest, edge).unwrap_or(0.0);
    Some(now.abs().min((now - then).abs()))
}

/// Turn of the surface at an edge, degrees; negative where the outside is concave.
fn signed_turn(mesh: &Mesh, edge: usize) -> Option<f32> {
    let dihedral = Dihedral::at(mesh, edge)?;
    let hollow = mesh.fold_height(dihedral.faces, mesh.edges.vertices[edge]) > 0.0;
    Some(if hollow { -dihedral.turn() } else { dihedral.turn() })
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::geometry::numbers::portable_math::sin;
    use crate::mesh::Soup;

    /// Two squares that share a side and turn there by an angle.
    fn hinge(degrees: f64) -> Mesh {
        let (c, s) = (cos(degrees.to_radians()), sin(degrees.to_radians()));
        let points = [[-1., 0., 0.], [0., 0., 0.], [0., 1., 0.], [-1., 1., 0.], [c, 0., -s], [c, 1., -s]];
        Mesh::build(Soup {
            positions: points.map(DVec3::from).to_vec(),
            triangles: vec![[0, 1, 2], [0, 2, 3], [1, 4, 5], [1, 5, 2]],
            ..Soup::default()
        })
    }

    fn pose_crease_count(rest: f64, now: f64, before: &[f64]) -> usize {
        let before = before.iter().map(|degrees| hinge(*degrees));
        pose_creases(&hinge(rest), &hinge(now), 40.0, |_| true, before).len()
    }

    #[test]
    fn pose_creases_are_edges_that_bend_beyond_the_crease_angle() {
        assert_eq!(pose_crease_count(0.0, 46.0, &[]), 1);
        assert_eq!(pose_crease_count(0.0, 34.0, &[]), 0);
        assert_eq!(pose_crease_count(0.0, -46.0, &[]), 1);
        // Unchanged from rest, or flatter.
        assert_eq!(pose_crease_count(90.0, 90.0, &[]), 0);
        assert_eq!(pose_crease_count(90.0, 30.0, &[]), 0);
        // Folded the other way.
        assert_eq!(pose_crease_count(25.0, -46.0, &[]), 1);
        assert_eq!(pose_crease_count(25.0, 60.0, &[]), 0);
    }

    #[test]
    fn pose_creases_keep_their_state_near_the_threshold() {
        for now in [36.0, 44.0] {
            assert_eq!(pose_crease_count(0.0, now, &[40.0, 46.0, 0.0]), 1, "{now}");
            assert_eq!(pose_crease_count(0.0, now, &[40.0, 34.0, 90.0]), 0, "{now}");
        }
        assert_eq!(pose_crease_count(0.0, 39.0, &[38.0]), 0);
        assert_eq!(pose_crease_count(0.0, 41.0, &[38.0]), 1);
    }
}
