//! Contours along hard edges of rounded surfaces, cut where one of the two sides turns.

use super::FeatureSegment;
use super::edge_lines::{EdgeSide, PartedEdge};
use super::smooth_contours::{Piece, Surface};
use super::zero_set::ZeroSet;

/// Cuts a hard edge where one of its sides turns, and adds the pieces that are contours and those that
/// are something else. The points of the zero set are ends from `first`.
pub(super) fn add(
    surface: &Surface,
    edge: &PartedEdge,
    set: &ZeroSet,
    first: u32,
    contours: &mut Vec<Piece>,
    others: &mut Vec<FeatureSegment>,
) {
    // Where each side turns: parameter along the edge, end id.
    let mut cuts: Vec<(f64, u32, usize)> = Vec::with_capacity(2);
    for (which, side) in edge.sides.iter().enumerate() {
        let EdgeSide::Rounded([a, b]) = *side else { continue };
        let between = [a.min(b), a.max(b)];
        if let Ok(id) = set.points.binary_search_by_key(&between, |p| p.between) {
            let t = set.points[id].t;
            cuts.push((if a < b { t } else { 1.0 - t }, first + id as u32, which));
        }
    }
    cuts.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
    let mut facing = edge.sides.map(|side| match side {
        EdgeSide::Flat(facing) => facing,
        EdgeSide::Rounded(corners) => surface.facing[corners[0] as usize] >= 0.0,
    });
    let mut from = edge.ends[0];
    let stops = cuts.iter().map(|(_, point, which)| (*point, Some(*which)));
    for (to, turns) in stops.chain([(edge.ends[1], None)]) {
        // Both sides turn in one point where the edge ends within a surface.
        if from == to {
        } else if (facing[0] != facing[1]) != edge.same_way {
            contours.push(contour(surface, edge, [from, to], facing));
        } else {
            others.extend(edge.else_line.map(|line| FeatureSegment { ends: [from, to], ..line }));
        }
        if let Some(which) = turns {
            facing[which] = !facing[which];
        }
        from = to;
    }
}

/// A piece of a hard edge as a contour, run through as its facing face runs along it.
fn contour(surface: &Surface, edge: &PartedEdge, ends: [u32; 2], facing: [bool; 2]) -> Piece {
    let (near, far) = if facing[0] { (0, 1) } else { (1, 0) };
    let triangle = surface.mesh.triangles[edge.hosts[near] as usize];
    let along = [0, 1, 2].map(|k| [triangle[k], triangle[(k + 1) % 3]]);
    let ends = if along.contains(&edge.ends) { ends } else { [ends[1], ends[0]] };
    let mut segment = surface.segment(ends, [edge.hosts[near], edge.hosts[far]], false);
    segment.strength = edge.turn;
    // Taken as running forward: what hides a hollow edge is seldom near, and faces tell.
    Piece { segment, advance: 1.0 }
}
