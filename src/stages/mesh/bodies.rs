//! Bodies: parts whose surfaces continue in each other.
//!
//! Files may put each face of one surface in a group of its own. What its shape is for must not depend on that, so shapes and
//! tolerances are decided for bodies. Two parts are of one body if an edge has exactly two faces, one of each: then neither part
//! has another face there in which its surface goes on. Parts that merely touch have faces of their own on both sides of an
//! edge, and stay apart.

use rayon::prelude::*;

use super::{EdgeFaces, Edges, Groups, Mesh, PartId};
use crate::math::grain::GRAIN;

/// For each part the first part of its body; empty if each part is a body of its own.
pub(super) fn bodies(parts: &[PartId], edges: &Edges) -> Vec<PartId> {
    let count = parts.par_iter().with_min_len(GRAIN).map(|part| part.index() + 1).max().unwrap_or(0);
    let joint = |edge: usize| {
        let EdgeFaces::Two { faces, .. } = edges.faces(edge) else { return None };
        let [a, b] = faces.map(|face| parts.get(face as usize).copied().unwrap_or_default());
        (a != b).then_some([a, b])
    };
    if count < 2 {
        return Vec::new();
    }
    let joints: Vec<[PartId; 2]> =
        (0..edges.len()).into_par_iter().with_min_len(GRAIN).filter_map(joint).collect();
    if joints.is_empty() {
        return Vec::new();
    }
    let groups = Groups::new(count, |join| joints.iter().for_each(|[a, b]| join(a.0, b.0)));
    (0..count as u32).map(|part| PartId(groups.of(part))).collect()
}

/// The body of a part, by what [`bodies`] found.
#[inline]
#[must_use]
pub fn body_of(bodies: &[PartId], part: PartId) -> PartId {
    bodies.get(part.index()).copied().unwrap_or(part)
}

impl Mesh {
    /// The body that a face belongs to, by its first part.
    #[inline]
    #[must_use]
    pub fn body(&self, face: u32) -> PartId {
        body_of(&self.bodies, self.face_part[face as usize])
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::mesh::Soup;

    /// Six sides of a box of two triangles, with corners numbered by their coordinates.
    const SIDES: [[u32; 4]; 6] =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];

    /// Adds a box whose sides are of parts that `part` gives by their number.
    fn add_box(soup: &mut Soup, low: DVec3, part: impl Fn(u32) -> u32) {
        let first = soup.positions.len() as u32;
        let corner = |k: u32| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2));
        soup.positions.extend((0..8).map(|k| low + corner(k)));
        for (k, side) in (0..).zip(SIDES) {
            let [a, b, c, d] = side.map(|v| first + v);
            soup.triangles.extend([[a, b, c], [a, c, d]]);
            soup.triangle_part.extend([PartId(part(k)); 2]);
        }
    }

    #[test]
    fn sides_of_one_box_are_one_body_and_boxes_that_touch_are_two() {
        let mut soup = Soup::default();
        add_box(&mut soup, DVec3::ZERO, |side| side);
        // It lies on the first one, and shares no edge with it.
        add_box(&mut soup, DVec3::new(1.0, 0.25, 0.0), |side| 6 + side);
        // These two share nothing but an edge.
        add_box(&mut soup, DVec3::new(5.0, 0.0, 0.0), |_| 12);
        add_box(&mut soup, DVec3::new(6.0, 1.0, 0.0), |_| 13);
        let mesh = Mesh::build(soup);
        let found: Vec<u32> = mesh.bodies.iter().map(|body| body.0).collect();
        assert_eq!(found, [0, 0, 0, 0, 0, 0, 6, 6, 6, 6, 6, 6, 12, 13]);
        let scale = |part: u32| mesh.extents.of(PartId(part)).scale;
        assert!((0..14).all(|part| (scale(part) - 3.0_f64.sqrt()).abs() < 1e-12));
    }

    #[test]
    fn parts_that_share_no_edge_are_bodies_of_their_own() {
        let mut soup = Soup::default();
        add_box(&mut soup, DVec3::ZERO, |_| 0);
        add_box(&mut soup, DVec3::splat(3.0), |_| 1);
        assert!(Mesh::build(soup).bodies.is_empty());
    }
}
