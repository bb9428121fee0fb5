//! [`join_borders`]: shadow borders as segments on the surface that share their ends.

use std::collections::BTreeMap;

use glam::DVec3;

use super::shadow_receivers::ShadowBorders;
use super::tolerances;
use super::upper_envelope::EdgePart;
use crate::geometry::numbers::powers_of_two::power_of_two_below;
use crate::mesh::{FaceId, Mesh};
use crate::view::Frame;

/// Segments on faces, joined where they share a point.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct JoinedBorders {
    /// Ends of the segments, local space.
    pub points: Vec<DVec3>,
    /// Face and ends of each segment.
    pub segments: Vec<(u32, [u32; 2])>,
}

/// Joins the borders from all views of one light.
///
/// Pieces share a point where the border continues from one face to the next and where they share a vertex of
/// the light's view map. They also share one where loose ends meet: there the shadow of one edge continues as
/// that of another.
pub(crate) fn join_borders(mesh: &Mesh, views: Vec<ShadowBorders>) -> JoinedBorders {
    let mut all = JoinedBorders::default();
    // Distance from each point within which another one is the same.
    let mut reaches: Vec<f64> = Vec::new();
    for borders in &views {
        let frame = &borders.light.view.frame;
        let mut at_node: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for (edge, runs) in borders.edges.iter().zip(&borders.runs) {
            let mut before: Option<(f64, u32)> = None;
            for run in runs {
                let reach = mesh.extent(FaceId(run.face)).contact;
                let [p, q] = [(run.start, run.nearness[0]), (run.end, run.nearness[1])]
                    .map(|(t, nearness)| on_face(mesh, frame, run, edge.at(t), nearness))
                    .map(|p| rounded(p, reach));
                let start = match before {
                    Some((end, point)) if end == run.start => all.near(&[point], p, reach),
                    _ if run.start == 0.0 => {
                        all.near(at_node.get(&edge.nodes[0]).map_or(&[], Vec::as_slice), p, reach)
                    }
                    _ => None,
                };
                let start = start.unwrap_or_else(|| all.add(p, reach, &mut reaches));
                let existing = if run.end == 1.0 {
                    all.near(at_node.get(&edge.nodes[1]).map_or(&[], Vec::as_slice), q, reach)
                } else {
                    None
                };
                let end = existing.unwrap_or_else(|| all.add(q, reach, &mut reaches));
                for (t, node, point) in [(run.start, edge.nodes[0], start), (run.end, edge.nodes[1], end)] {
                    if t == 0.0 || t == 1.0 {
                        at_node.entry(node).or_default().push(point);
                    }
                }
                if start != end {
                    all.segments.push((run.face, [start, end]));
                }
                before = Some((run.end, end));
            }
        }
    }
    all.join_loose_ends(&reaches);
    all
}

impl JoinedBorders {
    fn add(&mut self, point: DVec3, reach: f64, reaches: &mut Vec<f64>) -> u32 {
        self.points.push(point);
        reaches.push(reach);
        self.points.len() as u32 - 1
    }

    /// First of some points that is near a place.
    fn near(&self, points: &[u32], target: DVec3, reach: f64) -> Option<u32> {
        points.iter().copied().find(|point| self.points[*point as usize].distance(target) <= reach)
    }

    /// Joins points that end one segment each and are near each other, and drops segments of zero length.
    fn join_loose_ends(&mut self, reaches: &[f64]) {
        let greatest = reaches.iter().copied().fold(0.0, f64::max);
        let mut uses = vec![0u32; self.points.len()];
        for (_, ends) in &self.segments {
            ends.iter().for_each(|end| uses[*end as usize] += 1);
        }
        let mut loose: Vec<u32> = (0..uses.len() as u32).filter(|k| uses[*k as usize] == 1).collect();
        let position = |k: u32| self.points[k as usize];
        loose.sort_by(|a, b| position(*a).x.total_cmp(&position(*b).x).then(a.cmp(b)));
        let mut joined_to: Vec<u32> = (0..uses.len() as u32).collect();
        for (i, a) in loose.iter().enumerate() {
            if joined_to[*a as usize] != *a {
                continue;
            }
            for b in &loose[i + 1..] {
                if position(*b).x - position(*a).x > greatest {
                    break;
                }
                let reach = reaches[*a as usize].max(reaches[*b as usize]);
                if joined_to[*b as usize] == *b && position(*a).distance(position(*b)) <= reach {
                    joined_to[*b as usize] = *a;
                }
            }
        }
        for (_, ends) in &mut self.segments {
            *ends = ends.map(|end| joined_to[end as usize]);
        }
        self.segments.retain(|(_, ends)| ends[0] != ends[1]);
        self.drop_unused();
    }

    fn drop_unused(&mut self) {
        let mut new_index = vec![u32::MAX; self.points.len()];
        for (_, ends) in &self.segments {
            ends.iter().for_each(|end| new_index[*end as usize] = 0);
        }
        let mut used_points = Vec::new();
        for (point, place) in self.points.iter().zip(&mut new_index).filter(|(_, place)| **place == 0) {
            *place = used_points.len() as u32;
            used_points.push(*point);
        }
        self.points = used_points;
        for (_, ends) in &mut self.segments {
            *ends = ends.map(|end| new_index[end as usize]);
        }
    }
}

/// Rounds a point to a small fraction of the merging distance, so the last digits do not depend on the
/// light's frame.
fn rounded(p: DVec3, reach: f64) -> DVec3 {
    let step = power_of_two_below(reach / 64.0);
    (p / step).round() * step
}

/// Point of a face behind a point of the light's image, local space. `nearness` is the interpolated nearness
/// of the face.
fn on_face(mesh: &Mesh, frame: &Frame, run: &EdgePart, image: DVec3, nearness: f64) -> DVec3 {
    let interpolated = local_from_image(frame, image, frame.depth_of(nearness));
    let [a, b, c] = mesh.corners(FaceId(run.face));
    let normal = (b - a).cross(c - a);
    let ray = if frame.perspective { (interpolated - frame.eye).normalize_or_zero() } else { frame.forward };
    let fall = normal.dot(ray);
    if fall.abs() <= tolerances::MAX_GRAZING_COSINE * normal.length() {
        return interpolated;
    }
    interpolated + ray * (normal.dot(a - interpolated) / fall)
}

/// Local point at an image position and a depth.
fn local_from_image(frame: &Frame, image: DVec3, depth: f64) -> DVec3 {
    let k = if frame.perspective { frame.scale / depth } else { frame.scale };
    let (x, y) = ((image.x - frame.width / 2.0) / k, (frame.height / 2.0 - image.y) / k);
    frame.eye + frame.right * x + frame.up * y + frame.forward * depth
}
