//! Reference for feature lines of a polyhedron: contours, borders, creases, material boundaries and
//! intersections.
//!
//! Each edge is classified from its triangles by the textbook definitions. Hidden lines are included.

use glam::DVec3;

use super::textbook_camera::TextbookCamera;
use super::triangle_intersections::intersection_segments;
use super::triangle_scene::TriangleScene;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ReferenceLineKind {
    Contour,
    Border,
    Crease,
    Material,
    Intersection,
}

/// A straight line that may be drawn.
pub(crate) struct ReferenceLine {
    pub ends: [DVec3; 2],
    /// The vertices at its ends; `u32::MAX` for intersections.
    pub corners: [u32; 2],
    /// The faces it lies on.
    pub hosts: Vec<u32>,
    pub kind: ReferenceLineKind,
    /// Angle between the faces, degrees, 0 if coplanar. With more than two faces, the angle of the wedge that
    /// contains the camera.
    pub angle_deg: f64,
    /// Whether the angle is at the crease limit; such a line may be drawn or not.
    pub unsure: bool,
}

/// A face at an edge.
struct EdgeFace {
    edge: [u32; 2],
    face: u32,
    /// The vertex that is not on the edge.
    opposite: u32,
    /// Whether the face's winding runs from the lower to the higher vertex number.
    forward: bool,
}

/// All lines that may be drawn. Edges with an angle below `crease_deg` are no creases.
pub(crate) fn feature_lines(
    polygons: &TriangleScene,
    eye: &TextbookCamera,
    crease_deg: f64,
) -> Vec<ReferenceLine> {
    let mut sides: Vec<EdgeFace> = Vec::new();
    for (id, face) in polygons.faces.iter().enumerate() {
        if polygons.is_degenerate(id) {
            continue;
        }
        for k in 0..3 {
            let [a, b, opposite] = [face[k], face[(k + 1) % 3], face[(k + 2) % 3]];
            sides.push(EdgeFace { edge: [a.min(b), a.max(b)], face: id as u32, opposite, forward: a < b });
        }
    }
    sides.sort_by_key(|side| (side.edge, side.face));
    let facing: Vec<bool> = (0..polygons.faces.len()).map(|face| faces_camera(polygons, eye, face)).collect();
    let mut found: Vec<ReferenceLine> = sides
        .chunk_by(|a, b| a.edge == b.edge)
        .filter_map(|sides| classify_edge(polygons, eye, &facing, sides, crease_deg))
        .collect();
    found.extend(intersection_segments(polygons).into_iter().map(|(ends, hosts)| ReferenceLine {
        ends,
        corners: [u32::MAX; 2],
        hosts: hosts.to_vec(),
        kind: ReferenceLineKind::Intersection,
        angle_deg: 0.0,
        unsure: false,
    }));
    found
}

fn faces_camera(polygons: &TriangleScene, eye: &TextbookCamera, face: usize) -> bool {
    let [a, b, c] = polygons.corners(face);
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let towards = if eye.perspective { (eye.position - a).normalize() } else { -eye.forward };
    normal.dot(towards) > 1e-10
}

fn classify_edge(
    polygons: &TriangleScene,
    eye: &TextbookCamera,
    facing: &[bool],
    sides: &[EdgeFace],
    crease_deg: f64,
) -> Option<ReferenceLine> {
    let corners = sides[0].edge;
    let ends = corners.map(|corner| polygons.points[corner as usize]);
    // Whether a face lies to the left of the edge in the image.
    let left = |side: &&EdgeFace| facing[side.face as usize] == side.forward;
    let lefts = sides.iter().filter(left).count();
    let is_contour = sides.len() > 1 && (lefts == 0 || lefts == sides.len());
    let (turn_deg, most) = wedge_angles(polygons, eye, ends, sides);
    let material = |side: &EdgeFace| polygons.material[side.face as usize];
    let kind = if is_contour {
        ReferenceLineKind::Contour
    } else if sides.len() == 1 {
        ReferenceLineKind::Border
    } else if turn_deg.max(most) > crease_deg - 0.05 {
        ReferenceLineKind::Crease
    } else if sides.iter().any(|side| material(side) != material(&sides[0])) {
        ReferenceLineKind::Material
    } else {
        return None;
    };
    let hosts = sides.iter().map(|side| side.face).collect();
    let unsure = kind == ReferenceLineKind::Crease && turn_deg < crease_deg + 0.05;
    Some(ReferenceLine { ends, corners, hosts, kind, angle_deg: turn_deg, unsure })
}

/// The angle of the wedge between faces that contains the camera, and the largest of all such angles,
/// degrees.
fn wedge_angles(
    polygons: &TriangleScene,
    eye: &TextbookCamera,
    [a, b]: [DVec3; 2],
    sides: &[EdgeFace],
) -> (f64, f64) {
    let axis = (b - a).normalize();
    let across = |side: &EdgeFace| {
        (polygons.points[side.opposite as usize] - a).reject_from_normalized(axis).normalize_or_zero()
    };
    let first = across(&sides[0]);
    let up = axis.cross(first);
    let angle = |v: DVec3| libm::atan2(v.dot(up), v.dot(first)).to_degrees();
    let mut angles: Vec<f64> = sides.iter().map(|side| angle(across(side))).collect();
    angles.sort_by(f64::total_cmp);
    // Coincident faces count as one.
    angles.dedup_by(|a, b| (*a - *b).abs() < 1e-3);
    if angles.len() > 1 && angles[0] + 360.0 - angles[angles.len() - 1] < 1e-3 {
        angles.pop();
    }
    if angles.len() < 2 {
        return (0.0, 0.0);
    }
    let towards = angle(if eye.perspective { eye.position - a.midpoint(b) } else { -eye.forward });
    let (mut seen, mut most) = (0.0, 0.0_f64);
    for (k, from) in angles.iter().enumerate() {
        let gap = (angles[(k + 1) % angles.len()] - from).rem_euclid(360.0);
        let turn = (180.0 - gap).abs();
        most = most.max(turn);
        if (towards - from).rem_euclid(360.0) < gap {
            seen = turn;
        }
    }
    (seen, most)
}
