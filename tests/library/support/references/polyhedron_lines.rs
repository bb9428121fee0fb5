//! The lines of a polyhedron that a viewer may see, found from triangles by the textbook: contours, borders,
//! creases, material boundaries and intersections.

use glam::DVec3;

use super::textbook_camera::Eye;
use super::triangle_intersections::piercings;
use super::triangle_scene::Polygons;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    Contour,
    Border,
    Crease,
    Material,
    Intersection,
}

/// A straight line that may be drawn.
pub struct Line {
    pub ends: [DVec3; 2],
    /// The corners it runs between; none of them for intersections.
    pub corners: [u32; 2],
    /// The faces it lies on.
    pub hosts: Vec<u32>,
    pub kind: Kind,
    /// By how many degrees its faces turn, where they are two; of more, the corner that is turned to the eye.
    pub turn_deg: f64,
    /// At the limit of what counts: neither asked for nor punished.
    pub unsure: bool,
}

/// A face at an edge.
struct Side {
    edge: [u32; 2],
    face: u32,
    /// The corner that is not on the edge.
    opposite: u32,
    /// Whether the face runs along the edge from its lower to its higher corner.
    forward: bool,
}

/// All lines; edges that turn by less than `crease_deg` are none.
pub fn lines(polygons: &Polygons, eye: &Eye, crease_deg: f64) -> Vec<Line> {
    let mut sides: Vec<Side> = Vec::new();
    for (id, face) in polygons.faces.iter().enumerate() {
        if polygons.is_flat(id) {
            continue;
        }
        for k in 0..3 {
            let [a, b, opposite] = [face[k], face[(k + 1) % 3], face[(k + 2) % 3]];
            sides.push(Side { edge: [a.min(b), a.max(b)], face: id as u32, opposite, forward: a < b });
        }
    }
    sides.sort_by_key(|side| (side.edge, side.face));
    let facing: Vec<bool> = (0..polygons.faces.len()).map(|face| faces_eye(polygons, eye, face)).collect();
    let mut found: Vec<Line> = sides
        .chunk_by(|a, b| a.edge == b.edge)
        .filter_map(|sides| line_of(polygons, eye, &facing, sides, crease_deg))
        .collect();
    found.extend(piercings(polygons).into_iter().map(|(ends, hosts)| Line {
        ends,
        corners: [u32::MAX; 2],
        hosts: hosts.to_vec(),
        kind: Kind::Intersection,
        turn_deg: 0.0,
        unsure: false,
    }));
    found
}

fn faces_eye(polygons: &Polygons, eye: &Eye, face: usize) -> bool {
    let [a, b, c] = polygons.corners(face);
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let towards = if eye.perspective { (eye.eye - a).normalize() } else { -eye.forward };
    normal.dot(towards) > 1e-10
}

fn line_of(polygons: &Polygons, eye: &Eye, facing: &[bool], sides: &[Side], crease_deg: f64) -> Option<Line> {
    let corners = sides[0].edge;
    let ends = corners.map(|corner| polygons.points[corner as usize]);
    // On which side of the edge's image each face lies.
    let left = |side: &&Side| facing[side.face as usize] == side.forward;
    let lefts = sides.iter().filter(left).count();
    let is_contour = sides.len() > 1 && (lefts == 0 || lefts == sides.len());
    let (turn_deg, most) = turns(polygons, eye, ends, sides);
    let material = |side: &Side| polygons.material[side.face as usize];
    let kind = if is_contour {
        Kind::Contour
    } else if sides.len() == 1 {
        Kind::Border
    } else if turn_deg.max(most) > crease_deg - 0.05 {
        Kind::Crease
    } else if sides.iter().any(|side| material(side) != material(&sides[0])) {
        Kind::Material
    } else {
        return None;
    };
    let hosts = sides.iter().map(|side| side.face).collect();
    let unsure = kind == Kind::Crease && turn_deg < crease_deg + 0.05;
    Some(Line { ends, corners, hosts, kind, turn_deg, unsure })
}

/// By how many degrees the corner turns that the eye looks into, and the one that turns most.
fn turns(polygons: &Polygons, eye: &Eye, [a, b]: [DVec3; 2], sides: &[Side]) -> (f64, f64) {
    let axis = (b - a).normalize();
    let across = |side: &Side| {
        (polygons.points[side.opposite as usize] - a).reject_from_normalized(axis).normalize_or_zero()
    };
    let first = across(&sides[0]);
    let up = axis.cross(first);
    let angle =
        |v: DVec3| ligne::geometry::numbers::portable_math::atan2(v.dot(up), v.dot(first)).to_degrees();
    let mut angles: Vec<f64> = sides.iter().map(|side| angle(across(side))).collect();
    angles.sort_by(f64::total_cmp);
    // Faces that lie in one another are one.
    angles.dedup_by(|a, b| (*a - *b).abs() < 1e-3);
    if angles.len() > 1 && angles[0] + 360.0 - angles[angles.len() - 1] < 1e-3 {
        angles.pop();
    }
    if angles.len() < 2 {
        return (0.0, 0.0);
    }
    let towards = angle(if eye.perspective { eye.eye - a.midpoint(b) } else { -eye.forward });
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
