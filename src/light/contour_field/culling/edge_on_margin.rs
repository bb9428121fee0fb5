//! [`EdgeOnMargin`]: the margin of each vertex of a rounded surface from being seen edge-on, which skips most
//! edges.
//!
//! For an edge between normals that differ little ([`SmoothNormals::gentle`]) the margins of its ends are
//! enough: two small numbers instead of two normals.

use crate::parallel::prelude::*;
use glam::DVec3;

use crate::light::tolerances;
use crate::mesh::Mesh;
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::surface::SmoothNormals;
use crate::surface::normals::straight_edges::MIN_GENTLE_COSINE;
use crate::view::Frame;

/// Factors that lower a value by more than its rounding error, in double and in single precision.
const LENGTH_MARGIN: f64 = 1.0 - tolerances::F64_MARGIN_SHARE;
const SINGLE_MARGIN: f64 = 1.0 - tolerances::F32_MARGIN_SHARE;

/// Margins of the vertices of a mesh from being seen edge-on in a view.
#[derive(Debug)]
pub(crate) struct EdgeOnMargin {
    /// Largest turn of the line of sight, along a gentle edge from each vertex, that keeps the field from
    /// vanishing. Negative where the surface is averted; zero where the field may vanish at once.
    room: Vec<f32>,
    /// Distance of the nearest vertex from the eye; infinite in a parallel view, where lines of sight do not
    /// turn.
    nearest: f64,
}

impl EdgeOnMargin {
    /// Margins in a view. The field must vary along an edge by at most `reach` times the turn of normal and
    /// line of sight.
    pub(crate) fn of(mesh: &Mesh, smooth: &SmoothNormals, frame: &Frame, reach: f64) -> Self {
        let most = (2.0 - 2.0 * MIN_GENTLE_COSINE).sqrt();
        // Vertices on edges that separate surfaces have several normals, and only one is used here. No gentle
        // edge ends at them.
        let vertices = mesh.positions.par_iter().zip(&smooth.normals).with_min_len(MIN_TASK_ITEMS);
        let of_vertex = |(at, normal): (&DVec3, &DVec3)| {
            let facing = normal.dot(frame.to_eye(*at));
            let room = (facing.abs() - tolerances::FACING_MARGIN) / reach - most;
            (room.max(0.0) * SINGLE_MARGIN).copysign(facing) as f32
        };
        let room = vertices.map(of_vertex).collect();
        let nearest = if frame.perspective {
            let squared = |at: &DVec3| frame.eye.distance_squared(*at);
            mesh.positions
                .par_iter()
                .with_min_len(MIN_TASK_ITEMS)
                .map(squared)
                .reduce(|| f64::INFINITY, f64::min)
                .sqrt()
        } else {
            f64::INFINITY
        };
        Self { room, nearest }
    }

    /// Whether the field cannot vanish over a gentle edge between two vertices, given its squared length.
    #[inline]
    pub(crate) fn cannot_vanish(&self, ends: [u32; 2], length_squared: f64) -> bool {
        let [a, b] = ends.map(|vertex| f64::from(self.room[vertex as usize]));
        // Unit vectors from two points to the eye differ by at most the distance between the points, divided
        // by that to the nearer one.
        let room = a.abs().min(b.abs());
        a * b > 0.0 && length_squared < (room * self.nearest).powi(2) * LENGTH_MARGIN
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::dice::Dice;
    use crate::geometry::numbers::portable_math::{cos, sin};
    use crate::mesh::Soup;
    use crate::scene::{Camera, Projection};

    /// Ball of many faces with random dents.
    fn dented_ball(across: u32) -> Mesh {
        let mut dice = Dice::new(5);
        let mut soup = Soup::default();
        for i in 0..2 * across {
            for k in 0..=across {
                let turn = std::f64::consts::PI / f64::from(across);
                let (u, v) = (f64::from(i) * turn, f64::from(k) * turn);
                let at = DVec3::new(sin(v) * cos(u), sin(v) * sin(u), cos(v));
                soup.positions.push(at + dice.point(4e-3));
                let at = |i: u32, k: u32| i % (2 * across) * (across + 1) + k;
                if k < across {
                    let corners = [at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)];
                    soup.triangles
                        .extend([[corners[0], corners[1], corners[2]], [corners[0], corners[2], corners[3]]]);
                }
            }
        }
        Mesh::build(soup)
    }

    #[test]
    fn cannot_vanish_holds_only_for_turned_edges_and_for_most_of_them() {
        const REACH: f64 = 0.55;
        let mesh = dented_ball(40);
        let smooth = SmoothNormals::new(&mesh, |_| true, |edge| edge % 997 == 0);
        let mut dice = Dice::new(11);
        let (mut told, mut turned) = (0, 0);
        for view in 0..12 {
            let eye = dice.point(1.0).normalize() * [1.1, 1.5, 4.0, 30.0][view % 4];
            let projection = match view % 3 {
                0 => Projection::Orthographic { height: 3.0 },
                _ => Projection::Perspective { fov_y_deg: 40.0 },
            };
            let (target, up) = (DVec3::ZERO, DVec3::Z);
            let camera = Camera { eye, target, up, projection, width: 1e3, height: 800.0, near: None };
            let frame = Frame::new(&camera, mesh.origin);
            let known = EdgeOnMargin::of(&mesh, &smooth, &frame, REACH);
            for edge in 0..mesh.edges.len() {
                let Some(ends) = smooth.across(&mesh, edge) else { continue };
                let at = ends.map(|v| mesh.positions[smooth.vertices[v as usize] as usize]);
                let to_eye = at.map(|p| frame.to_eye(p));
                let normals = ends.map(|v| smooth.normals[v as usize]);
                let facing = [0, 1].map(|k| normals[k].dot(to_eye[k]));
                let turn = normals[0].distance(normals[1]) + to_eye[0].distance(to_eye[1]);
                let is_turned =
                    facing[0] * facing[1] > 0.0 && facing[0].abs().min(facing[1].abs()) > REACH * turn;
                let is_told = smooth.gentle.contains(edge)
                    && known.cannot_vanish(mesh.edges.vertices[edge], at[0].distance_squared(at[1]));
                assert!(is_turned || !is_told, "edge {edge} from {eye}");
                told += u32::from(is_told);
                turned += u32::from(is_turned);
            }
        }
        assert!(turned > 50_000 && f64::from(told) > 0.75 * f64::from(turned), "{told} of {turned}");
    }
}
