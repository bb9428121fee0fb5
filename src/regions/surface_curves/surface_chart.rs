//! [`Chart`]: a plane laid on the faces of a mesh, and the way over them to a point of it.

use glam::{DVec2, DVec3};

use crate::lines::Lit;
use crate::mesh::FaceId;

/// How the plane lies on a face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Chart {
    /// Where the corners of the face are in the plane.
    pub corners: [DVec2; 3],
    /// Charts of other names do not go on in this one.
    pub name: u32,
}

/// A walk over more faces than this is given up.
const MOST_STEPS: usize = 64;

/// Points this far out of a face, as part of it, are on it.
const ON_FACE: f64 = 1e-9;

/// Finds points of the plane on the faces.
pub(crate) struct Walker<'a> {
    pub lit: &'a Lit<'a>,
    pub chart: &'a (dyn Fn(u32) -> Option<Chart> + Sync),
}

impl Walker<'_> {
    /// A point of the plane that lies on a face.
    pub fn find(&self, face: u32, p: DVec2) -> Option<DVec3> {
        let parts = weights(&(self.chart)(face)?, p)?;
        parts.iter().all(|part| *part >= -ON_FACE).then(|| self.on(face, parts))
    }

    pub fn on(&self, face: u32, parts: [f64; 3]) -> DVec3 {
        let corners = self.lit.mesh.corners(FaceId(face));
        (0..3).map(|k| corners[k] * parts[k]).sum()
    }

    /// Where a point of the plane is, the face that is nearest to it on the way over faces that `may` be walked on, and whether it
    /// lies on that.
    pub fn walk(&self, from: u32, p: DVec2, may: impl Fn(u32) -> bool) -> Option<(DVec3, u32, bool)> {
        let mut face = from;
        let mut own = (self.chart)(face)?;
        let mut parts = weights(&own, p)?;
        for _ in 0..MOST_STEPS {
            let (side, least) = (0..3).map(|k| (k, parts[k])).min_by(|a, b| a.1.total_cmp(&b.1))?;
            if least >= -ON_FACE {
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

    /// The face beyond the side opposite to a corner, if the plane goes on there.
    pub fn next(&self, face: u32, own: &Chart, corner: usize) -> Option<(u32, Chart)> {
        let mesh = self.lit.mesh;
        let t = mesh.triangles[face as usize];
        let ends = [(corner + 1) % 3, (corner + 2) % 3];
        let [a, b] = ends.map(|k| t[k]);
        let edge = mesh.edges.vertices.binary_search(&[a.min(b), a.max(b)]).ok()?;
        let faces = mesh.edges.faces(edge);
        let [other] = faces.list().iter().filter(|other| **other != face).collect::<Vec<_>>()[..] else {
            return None;
        };
        let chart = (self.chart)(*other)?;
        let goes_on = ends.iter().all(|k| {
            let there = mesh.triangles[*other as usize].iter().position(|v| *v == t[*k]);
            there.is_some_and(|there| (chart.corners[there] - own.corners[*k]).length() < SAME_PLACE)
        });
        (chart.name == own.name && goes_on).then_some((*other, chart))
    }
}

/// Corners this near in the plane are one.
const SAME_PLACE: f64 = 1e-5;

/// The barycentric weights of a point of the plane.
fn weights(chart: &Chart, p: DVec2) -> Option<[f64; 3]> {
    let [a, b, c] = chart.corners;
    let whole = (b - a).perp_dot(c - a);
    let part = |q: DVec2, r: DVec2| (q - p).perp_dot(r - p) / whole;
    let parts = [part(b, c), part(c, a), part(a, b)];
    parts.iter().all(|part| part.is_finite()).then_some(parts)
}
