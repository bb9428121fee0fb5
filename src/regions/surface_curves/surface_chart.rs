//! [`Chart`]: a plane laid on the faces of a mesh, and walks over the faces to a point of that plane.

use glam::{DVec2, DVec3};

use crate::lines::Lit;
use crate::mesh::FaceId;
use crate::regions::tolerances;

/// How the plane lies on a face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Chart {
    /// Corners of the face in the plane.
    pub corners: [DVec2; 3],
    /// Name of the chart. Charts with different names do not continue each other.
    pub name: u32,
}

/// Maximum number of faces of a walk.
const MAX_WALK_FACES: usize = 64;

/// Finds positions in space for points of the plane.
pub(crate) struct Walker<'a> {
    pub lit: &'a Lit<'a>,
    pub chart: &'a (dyn Fn(u32) -> Option<Chart> + Sync),
}

impl Walker<'_> {
    /// Position of a point of the plane, if it lies on the face.
    pub(crate) fn find(&self, face: u32, p: DVec2) -> Option<DVec3> {
        let parts = weights(&(self.chart)(face)?, p)?;
        parts.iter().all(|part| *part >= -tolerances::MAX_OUTSIDE_WEIGHT).then(|| self.on(face, parts))
    }

    pub(crate) fn on(&self, face: u32, parts: [f64; 3]) -> DVec3 {
        let corners = self.lit.mesh.corners(FaceId(face));
        (0..3).map(|k| corners[k] * parts[k]).sum()
    }

    /// Walks over the faces that `may` allows, straight towards a point of the plane.
    ///
    /// Returns the position, the last face, and whether the point lies on it.
    pub(crate) fn walk(&self, from: u32, p: DVec2, may: impl Fn(u32) -> bool) -> Option<(DVec3, u32, bool)> {
        let mut face = from;
        let mut own = (self.chart)(face)?;
        let mut parts = weights(&own, p)?;
        for _ in 0..MAX_WALK_FACES {
            let (side, least) = (0..3).map(|k| (k, parts[k])).min_by(|a, b| a.1.total_cmp(&b.1))?;
            if least >= -tolerances::MAX_OUTSIDE_WEIGHT {
                return Some((self.on(face, parts), face, true));
            }
            let Some((next, chart)) = self.next(face, &own, side).filter(|(next, _)| may(*next)) else {
                break;
            };
            let Some(there) = weights(&chart, p) else { break };
            (face, own, parts) = (next, chart, there);
        }
        Some((self.on(face, parts), face, false))
    }

    /// Neighbour across the side opposite a corner, if the plane continues there.
    pub(crate) fn next(&self, face: u32, own: &Chart, corner: usize) -> Option<(u32, Chart)> {
        let mesh = self.lit.mesh;
        let t = mesh.triangles[face as usize];
        let ends = [(corner + 1) % 3, (corner + 2) % 3];
        let [a, b] = ends.map(|k| t[k]);
        let edge = mesh.edges.between(a, b)?;
        let faces = mesh.edges.faces(edge);
        let [other] = faces.list().iter().filter(|other| **other != face).collect::<Vec<_>>()[..] else {
            return None;
        };
        let chart = (self.chart)(*other)?;
        let goes_on = ends.iter().all(|k| {
            let there = mesh.triangles[*other as usize].iter().position(|v| *v == t[*k]);
            there.is_some_and(|there| {
                (chart.corners[there] - own.corners[*k]).length() < tolerances::MAX_CHART_CORNER_DISTANCE
            })
        });
        (chart.name == own.name && goes_on).then_some((*other, chart))
    }
}

/// Barycentric weights of a point of the plane.
fn weights(chart: &Chart, p: DVec2) -> Option<[f64; 3]> {
    let [a, b, c] = chart.corners;
    let whole = (b - a).perp_dot(c - a);
    let part = |q: DVec2, r: DVec2| (q - p).perp_dot(r - p) / whole;
    let parts = [part(b, c), part(c, a), part(a, b)];
    parts.iter().all(|part| part.is_finite()).then_some(parts)
}
