//! Bodies: parts whose surfaces continue in each other.
//!
//! Files may store each face of a surface as a separate part. Classification and tolerances must not depend
//! on this, so they are computed per body.
//!
//! 1. Two parts belong to one body if some edge has exactly two faces, one of each part.
//! 2. Where several bodies share an edge, the parts with one face there are paired if their faces enclose
//!    material.
//! 3. Parts that only touch have two faces each at the edge, and stay separate.

use crate::geometry::lists::disjoint_sets::DisjointSets;
use crate::parallel::prelude::*;
use glam::DVec3;

use crate::geometry::numbers::portable_math::atan2;
use crate::mesh::tolerances::MAX_COPLANAR_ANGLE_RAD;
use crate::mesh::{EdgeFaces, Edges, Mesh, PartId, Soup};
use crate::parallel::task_size::MIN_TASK_ITEMS;

/// For each part, the first part of its body; empty if every part is a separate body.
pub(crate) fn bodies(soup: &Soup, edges: &Edges) -> Vec<PartId> {
    let parts = &soup.triangle_part;
    let count = parts.par_iter().with_min_len(MIN_TASK_ITEMS).map(|part| part.index() + 1).max().unwrap_or(0);
    let part = |face: u32| parts.get(face as usize).copied().unwrap_or_default();
    let joints = |edge: usize| {
        let pairs = match edges.faces(edge) {
            EdgeFaces::One(_) => Vec::new(),
            EdgeFaces::Two { faces, .. } if part(faces[0]) == part(faces[1]) => Vec::new(),
            EdgeFaces::Two { faces, .. } => vec![faces],
            EdgeFaces::Many(faces) => {
                let is_alone =
                    |face: &u32| faces.iter().filter(|other| part(**other) == part(*face)).count() == 1;
                let alone: Vec<u32> = faces.iter().copied().filter(is_alone).collect();
                if alone.len() > 1 { wedges(soup, edges.vertices[edge], &alone) } else { Vec::new() }
            }
        };
        pairs.into_iter().map(|pair| pair.map(part))
    };
    if count < 2 {
        return Vec::new();
    }
    let joints: Vec<[PartId; 2]> =
        (0..edges.len()).into_par_iter().with_min_len(MIN_TASK_ITEMS).flat_map_iter(joints).collect();
    if joints.is_empty() {
        return Vec::new();
    }
    let groups = DisjointSets::new(count, |join| joints.iter().for_each(|[a, b]| join(a.0, b.0)));
    (0..count as u32).map(|part| PartId(groups.representative(part))).collect()
}

/// Pairs of faces around an edge with material between them: a face with material in the direction of growing
/// angles, and the next face with material on the other side.
fn wedges(soup: &Soup, [from, to]: [u32; 2], faces: &[u32]) -> Vec<[u32; 2]> {
    let at = |v: u32| soup.positions[v as usize];
    let Some(axis) = (at(to) - at(from)).try_normalize() else { return Vec::new() };
    // Direction away from the edge, and whether the face runs along the edge from its first end to its
    // second. `None` for faces without area.
    let spoke = |face: u32| {
        let corners = soup.triangles[face as usize];
        let k = corners.iter().position(|v| *v != from && *v != to)?;
        let over = at(corners[k]) - at(from);
        let out = (over - axis * over.dot(axis)).try_normalize()?;
        Some((out, corners[(k + 1) % 3] == from))
    };
    let spokes: Vec<(u32, DVec3, bool)> =
        faces.iter().filter_map(|face| spoke(*face).map(|(out, up)| (*face, out, up))).collect();
    let Some(zero) = spokes.first().map(|spoke| spoke.1) else { return Vec::new() };
    let quarter = axis.cross(zero);
    let half = std::f64::consts::PI;
    let mut round: Vec<(f64, bool, u32)> = Vec::with_capacity(spokes.len());
    for (face, out, up) in &spokes {
        let angle = atan2(out.dot(quarter), out.dot(zero));
        round.push((
            if angle > half - MAX_COPLANAR_ANGLE_RAD { angle - 2.0 * half } else { angle },
            *up,
            *face,
        ));
    }
    round.sort_by(|a, b| a.0.total_cmp(&b.0));
    // Among coplanar faces, wedges end before others begin. Of coincident faces, the one of the first part is
    // the nearest to the enclosed material at every edge.
    let part = |face: u32| soup.triangle_part.get(face as usize).map_or(0, |part| part.0);
    for own in round.chunk_by_mut(|a, b| b.0 - a.0 <= MAX_COPLANAR_ANGLE_RAD) {
        own.sort_by_key(|(_, up, face)| {
            (!*up, if *up { part(*face) } else { u32::MAX - part(*face) }, *face)
        });
    }
    let mut begun: Vec<u32> = Vec::new();
    let mut pairs = Vec::new();
    let mut left: Vec<u32> = Vec::new();
    for (_, up, face) in round {
        match (up, begun.last()) {
            (false, _) => begun.push(face),
            (true, None) => left.push(face),
            (true, Some(_)) => pairs.extend(begun.pop().map(|first| [first, face])),
        }
    }
    // Wedges that cross the start angle.
    for face in left {
        pairs.extend(begun.pop().map(|first| [first, face]));
    }
    pairs
}

/// The body of a part, from the result of [`bodies`].
#[inline]
#[must_use]
pub(crate) fn body_of(bodies: &[PartId], part: PartId) -> PartId {
    bodies.get(part.index()).copied().unwrap_or(part)
}

impl Mesh {
    /// Body of a face, identified by its first part.
    #[inline]
    #[must_use]
    pub fn body(&self, face: u32) -> PartId {
        body_of(&self.bodies, self.face_part[face as usize])
    }

    /// Body of each face; empty if there is only one.
    #[must_use]
    pub fn face_bodies(&self) -> Vec<PartId> {
        let body = |part: &PartId| body_of(&self.bodies, *part);
        let first = self.face_part.first().map(body);
        let parts = self.face_part.par_iter().with_min_len(MIN_TASK_ITEMS);
        if parts.clone().all(|part| Some(body(part)) == first) {
            Vec::new()
        } else {
            parts.map(body).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::mesh::Soup;

    /// Six sides of a box with two triangles each. Corner numbers are binary coordinates.
    const BOX_SIDES: [[u32; 4]; 6] =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];

    /// Adds a box. `part` maps the side number to a part.
    fn add_box(soup: &mut Soup, low: DVec3, part: impl Fn(u32) -> u32) {
        let first = soup.positions.len() as u32;
        let corner = |k: u32| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2));
        soup.positions.extend((0..8).map(|k| low + corner(k)));
        for (k, side) in (0..).zip(BOX_SIDES) {
            let [a, b, c, d] = side.map(|v| first + v);
            soup.triangles.extend([[a, b, c], [a, c, d]]);
            soup.triangle_part.extend([PartId(part(k)); 2]);
        }
    }

    #[test]
    fn sides_of_a_box_form_one_body_and_touching_boxes_form_two() {
        let mut soup = Soup::default();
        add_box(&mut soup, DVec3::ZERO, |side| side);
        // Touches the first box without a common edge.
        add_box(&mut soup, DVec3::new(1.0, 0.25, 0.0), |side| 6 + side);
        // These two share only an edge.
        add_box(&mut soup, DVec3::new(5.0, 0.0, 0.0), |_| 12);
        add_box(&mut soup, DVec3::new(6.0, 1.0, 0.0), |_| 13);
        let mesh = Mesh::build(soup);
        let found: Vec<u32> = mesh.bodies.iter().map(|body| body.0).collect();
        assert_eq!(found, [0, 0, 0, 0, 0, 0, 6, 6, 6, 6, 6, 6, 12, 13]);
        let scale = |part: u32| mesh.extents.part(PartId(part)).scale;
        assert!((0..14).all(|part| (scale(part) - 3.0_f64.sqrt()).abs() < 1e-12));
    }

    #[test]
    fn parts_without_shared_edges_are_separate_bodies() {
        let mut soup = Soup::default();
        add_box(&mut soup, DVec3::ZERO, |_| 0);
        add_box(&mut soup, DVec3::splat(3.0), |_| 1);
        assert!(Mesh::build(soup).bodies.is_empty());
    }

    #[test]
    fn a_sheet_on_a_box_leaves_six_parts_in_its_body() {
        // Rotates the corners of every side, so that the order of faces at each edge varies. The sheet comes
        // before or after them.
        for sheet in [0, 1, 7] {
            for corner in 0..4 {
                let mut soup = Soup::default();
                add_box(&mut soup, DVec3::ZERO, |side| 1 + side + u32::from(side + 1 >= sheet && sheet > 0));
                let [a, b, c, d] = [0, 1, 2, 3].map(|k| BOX_SIDES[2][(k + corner) % 4]);
                soup.triangles.extend([[a, b, c], [a, c, d]]);
                soup.triangle_part.extend([PartId(sheet); 2]);
                let mesh = Mesh::build(soup);
                let count =
                    |body: PartId| (0..8).filter(|part| mesh.bodies.get(*part) == Some(&body)).count();
                let largest = mesh.bodies.iter().map(|body| count(*body)).max();
                assert_eq!(largest, Some(6), "{sheet} {corner} {:?}", mesh.bodies);
            }
        }
    }
}
