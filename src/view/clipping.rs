//! Clipping to the near plane and to the page.

use glam::DVec3;

use super::Frame;
use crate::mesh::{FaceId, Mesh};

/// Triangle of the part of a face that the near plane leaves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ClippedFace {
    /// Face it is part of.
    pub face: FaceId,
    /// Its corners in image space.
    pub points: [DVec3; 3],
}

/// Triangles left of all faces that the near plane cuts, in mesh order.
pub(crate) fn clip_faces(mesh: &Mesh, frame: &Frame, points: &[DVec3]) -> Vec<ClippedFace> {
    let Some(near) = frame.near else { return Vec::new() };
    if !points.iter().any(|p| p.z.is_nan()) {
        return Vec::new();
    }
    let mut out = Vec::new();
    for (id, t) in mesh.triangles.iter().enumerate() {
        let cut = t.iter().filter(|v| points[**v as usize].z.is_nan()).count();
        if cut == 0 || cut == 3 {
            continue;
        }
        let corners = t.map(|v| frame.camera_from_local(mesh.positions[v as usize]));
        let mut polygon: Vec<DVec3> = Vec::with_capacity(4);
        for i in 0..3 {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            if a.z >= near {
                polygon.push(a);
            }
            if (a.z >= near) != (b.z >= near) {
                polygon.push(at_plane(a, b, near));
            }
        }
        for k in 1..polygon.len().saturating_sub(1) {
            let triangle = [polygon[0], polygon[k], polygon[k + 1]];
            out.push(ClippedFace {
                face: FaceId::from(id),
                points: triangle.map(|c| frame.image_from_camera(c)),
            });
        }
    }
    out
}

/// Intersection of a segment, in camera axes, with the plane of depth `near`. The order of the ends does not
/// matter.
fn at_plane(a: DVec3, b: DVec3, near: f64) -> DVec3 {
    let (a, b) = if a.z < b.z { (a, b) } else { (b, a) };
    let p = a + (b - a) * ((near - a.z) / (b.z - a.z));
    DVec3::new(p.x, p.y, near)
}

impl Frame {
    /// Part of a local segment behind the near plane, in image space; `None` if there is none. The flags say
    /// which ends were cut off.
    #[must_use]
    pub fn clip_segment(&self, a: DVec3, b: DVec3) -> Option<([DVec3; 2], [bool; 2])> {
        let (mut ca, mut cb) = (self.camera_from_local(a), self.camera_from_local(b));
        let mut cut = [false; 2];
        if let Some(near) = self.near {
            if ca.z < near && cb.z < near {
                return None;
            }
            if ca.z < near {
                ca = at_plane(ca, cb, near);
                cut[0] = true;
            } else if cb.z < near {
                cb = at_plane(ca, cb, near);
                cut[1] = true;
            }
        }
        Some(([self.image_from_camera(ca), self.image_from_camera(cb)], cut))
    }

    /// Parameter range of the image segment a→b inside the frame; `None` if there is none.
    ///
    /// Source: Liang and Barsky, "A new concept and method for line clipping", 1984.
    #[must_use]
    pub fn clip_to_page(&self, a: DVec3, b: DVec3) -> Option<(f64, f64)> {
        let d = b - a;
        let (mut start, mut end) = (0.0f64, 1.0f64);
        for (p, q) in [(-d.x, a.x), (d.x, self.width - a.x), (-d.y, a.y), (d.y, self.height - a.y)] {
            if p == 0.0 {
                if q < 0.0 {
                    return None;
                }
            } else if p < 0.0 {
                start = start.max(q / p);
            } else {
                end = end.min(q / p);
            }
        }
        (start <= end).then_some((start, end))
    }
}
