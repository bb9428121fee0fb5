//! [`HostedLine`]: a line in the image with the faces it lies on, and the sides that these faces leave open.
//!
//! Background can be visible next to the line only on an open side.

use glam::{DVec2, DVec3};

use crate::lines::NO_FACE;
use crate::mesh::{EdgeFaces, Mesh};
use crate::view::View;

/// Straight line in image space, with its own faces.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HostedLine {
    pub line: [DVec3; 2],
    /// Ids of its ends: mesh vertices or points of the feature lines.
    pub ends: [u32; 2],
    pub hosts: [u32; 2],
}

impl HostedLine {
    /// Whether its own faces leave a side open, so background may be next to it.
    pub(crate) fn may_bound(&self, mesh: &Mesh, view: &View, margin: f64) -> bool {
        self.across().is_some_and(|across| self.covered_sides(across, mesh, view, margin) != [true; 2])
    }

    /// Unit vector to the right of the line (y down); `None` if it has no length.
    pub(crate) fn across(&self) -> Option<DVec2> {
        (self.line[1] - self.line[0]).truncate().perp().try_normalize()
    }

    /// Whether its own faces cover its left side and its right side, farther than `margin` user units from
    /// it. Without own faces, both sides count as covered.
    pub(crate) fn covered_sides(&self, across: DVec2, mesh: &Mesh, view: &View, margin: f64) -> [bool; 2] {
        if self.hosts == [NO_FACE; 2] {
            return [true; 2];
        }
        let mut cover = [false; 2];
        for face in self.hosts.into_iter().filter(|face| *face != NO_FACE) {
            self.add_sides(face, across, mesh, view, margin, &mut cover);
        }
        if cover != [true; 2] {
            for face in self.others(mesh) {
                self.add_sides(*face, across, mesh, view, margin, &mut cover);
            }
        }
        cover
    }

    /// Adds the sides that one face covers.
    fn add_sides(
        &self,
        face: u32,
        across: DVec2,
        mesh: &Mesh,
        view: &View,
        margin: f64,
        cover: &mut [bool; 2],
    ) {
        let corners = mesh.triangles[face as usize];
        for corner in corners.into_iter().filter(|v| !self.ends.contains(v)) {
            let height = (view.points[corner as usize] - self.line[0]).truncate().dot(across);
            if height.is_finite() {
                cover[0] |= height < -margin;
                cover[1] |= height > margin;
            } else {
                // The near plane cuts the face, so its winding gives the side on which it lies.
                match winding_side(self.ends, corners, view.facing[face as usize]) {
                    Some(side) => cover[side] = true,
                    None => *cover = [true; 2],
                }
            }
        }
    }

    /// All faces at this edge if there are more than two. Which two of them are the hosts depends on the
    /// order of parts.
    fn others<'a>(&self, mesh: &'a Mesh) -> &'a [u32] {
        let [v, w] = self.ends;
        let found = mesh.edges.between(v, w);
        match found.map(|edge| mesh.edges.faces(edge)) {
            Some(EdgeFaces::Many(faces)) => faces,
            _ => &[],
        }
    }
}

/// Side of an edge on which its face lies in the image, 0 for left; `None` if the edge is not one of the
/// face.
fn winding_side(ends: [u32; 2], corners: [u32; 3], is_facing: bool) -> Option<usize> {
    let corner_index = |end: u32| corners.iter().position(|v| *v == end);
    let (from, to) = (corner_index(ends[0])?, corner_index(ends[1])?);
    let runs_forward = (from + 1) % 3 == to;
    // A facing face is counter-clockwise and lies to the left of its edges.
    Some(usize::from(runs_forward != is_facing))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::dice::Dice;
    use crate::mesh::Soup;
    use crate::scene::Camera;

    #[test]
    fn winding_side_is_the_side_that_the_face_covers() {
        let mut dice = Dice::new(9);
        let mut found = 0;
        for _ in 0..200 {
            let soup = Soup {
                positions: [0; 3].map(|_| dice.point(0.5)).to_vec(),
                triangles: vec![[0, 1, 2]],
                ..Soup::default()
            };
            let mesh = Mesh::build(soup);
            let view = View::new(&mesh, &Camera::three_quarter());
            for ends in [[0, 1], [1, 2], [2, 0], [1, 0], [2, 1], [0, 2]] {
                let line = ends.map(|v: u32| view.points[v as usize]);
                let hosted = HostedLine { line, ends, hosts: [0, NO_FACE] };
                let cover = hosted.covered_sides(hosted.across().unwrap(), &mesh, &view, 1e-6);
                let side = winding_side(ends, mesh.triangles[0], view.facing[0]).unwrap();
                assert_eq!((cover[side], cover[1 - side]), (true, false));
                found += 1;
            }
        }
        assert_eq!(found, 1200);
    }
}
