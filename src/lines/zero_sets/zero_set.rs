//! [`ZeroSet`]: the curves on a mesh where a field on its smooth vertices vanishes.
//!
//! Smooth contours, suggestive contours, ridges and valleys are zero sets, and all are traced here. Inside a
//! triangle the field is linear, so its zero set is a straight piece between two sides.
//!
//! Source: Aaron Hertzmann and Denis Zorin, "Illustrating smooth surfaces", SIGGRAPH 2000, section 4.2:
//! contours of smooth surfaces as zero sets of an interpolated field.

use crate::parallel::prelude::*;
use glam::DVec3;

use crate::light::tolerances;
use crate::mesh::Mesh;
use crate::surface::SmoothNormals;
use crate::surface::normals::smooth_normals::NO_NORMAL;

/// Faces per task. Fixed, so that the result does not depend on the number of threads.
const FACES_PER_TASK: usize = 1 << 12;

/// Point on an edge of the mesh, between two smooth vertices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct EdgePoint {
    /// Smooth vertices at the ends of the edge, smaller id first. Faces on both sides of an edge that is not
    /// hard have the same ones, and so share the point.
    pub between: [u32; 2],
    /// Parameter from the first to the second vertex, 0 to 1 exclusive.
    pub t: f64,
}

impl EdgePoint {
    /// Local position.
    #[inline]
    #[must_use]
    pub(crate) fn position(&self, mesh: &Mesh, smooth: &SmoothNormals) -> DVec3 {
        let [a, b] = self.between.map(|v| mesh.positions[smooth.vertices[v as usize] as usize]);
        a + (b - a) * self.t
    }

    /// Field value at the point, interpolated linearly along the edge.
    #[inline]
    #[must_use]
    pub(crate) fn value(&self, field: &[f64]) -> f64 {
        let [a, b] = self.between.map(|v| field[v as usize]);
        a + (b - a) * self.t
    }
}

/// Straight piece of a zero set inside one face.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct ZeroSegment {
    /// Face that it crosses.
    pub face: u32,
    /// Ends, as indices into [`ZeroSet::points`].
    pub ends: [u32; 2],
}

/// Curves over a mesh. Pieces that meet share a point.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct ZeroSet {
    /// Crossings of the curves with edges, ordered by the smooth vertices of the edge.
    pub points: Vec<EdgePoint>,
    /// Pieces, in the order of their faces.
    pub segments: Vec<ZeroSegment>,
}

/// Zero set of a field with one value per smooth vertex, on the wanted faces.
///
/// Zero counts as positive, so that curves neither branch nor end at vertices. Each piece has the positive
/// side on its left, seen from the side where the face is counter-clockwise.
#[must_use]
pub(crate) fn trace(
    mesh: &Mesh,
    smooth: &SmoothNormals,
    field: &[f64],
    wanted: impl Fn(u32) -> bool + Sync,
) -> ZeroSet {
    let crossed = |face: u32| {
        let [a, b, c] = smooth.corners[face as usize].map(|v| field[v as usize] >= 0.0);
        a != b || b != c
    };
    trace_crossings(
        mesh,
        smooth,
        |face| crossed(face) && wanted(face),
        |a, b| {
            let (at_a, at_b) = (field[a as usize], field[b as usize]);
            ((at_a >= 0.0) != (at_b >= 0.0)).then(|| Crossing { t: at_a / (at_a - at_b), rising: at_a < 0.0 })
        },
    )
}

/// Crossing of a curve with an edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Crossing {
    /// Parameter from one end to the other, 0 to 1.
    pub t: f64,
    /// Whether the field grows in that direction; false where it has no sign.
    pub rising: bool,
}

/// Curves from their crossings with edges: `crossing(a, b)` is called with smooth vertices a < b. A face with
/// two crossings has a piece between them; other faces have none.
#[must_use]
pub(crate) fn trace_crossings(
    mesh: &Mesh,
    smooth: &SmoothNormals,
    wanted: impl Fn(u32) -> bool + Sync,
    crossing: impl Fn(u32, u32) -> Option<Crossing> + Sync,
) -> ZeroSet {
    let across = |[a, b]: [u32; 2]| {
        let (lo, hi) = (a.min(b), a.max(b));
        let found = crossing(lo, hi)?;
        let inner = tolerances::ZERO_SET_OF_EDGE..=1.0 - tolerances::ZERO_SET_OF_EDGE;
        let t = found.t.clamp(*inner.start(), *inner.end());
        // On the way around the face, the curve enters where the field rises.
        Some((EdgePoint { between: [lo, hi], t }, found.rising == (a < b)))
    };
    let piece = |face: u32| {
        let [a, b, c] = smooth.corners[face as usize];
        if a == NO_NORMAL || !wanted(face) {
            return None;
        }
        match [across([a, b]), across([b, c]), across([c, a])] {
            [Some(p), Some(q), None] | [None, Some(p), Some(q)] | [Some(p), None, Some(q)] => {
                Some((face, if p.1 { [q.0, p.0] } else { [p.0, q.0] }))
            }
            _ => None,
        }
    };
    let faces = smooth.corners.len();
    let found: Vec<Vec<(u32, [EdgePoint; 2])>> = (0..faces.div_ceil(FACES_PER_TASK))
        .into_par_iter()
        .with_max_len(1)
        .map(|k| {
            (k * FACES_PER_TASK..((k + 1) * FACES_PER_TASK).min(faces))
                .filter_map(|f| piece(f as u32))
                .collect()
        })
        .collect();
    joined(&found.concat(), mesh.positions.len())
}

/// Merges the crossings of each edge into one point.
fn joined(pieces: &[(u32, [EdgePoint; 2])], vertices: usize) -> ZeroSet {
    debug_assert!(vertices > 0 || pieces.is_empty());
    let key = |[a, b]: [u32; 2]| u64::from(a) << 32 | u64::from(b);
    let ends = || pieces.iter().flat_map(|piece| piece.1);
    let mut order: Vec<(u64, u32)> =
        ends().zip(0..).map(|(point, place)| (key(point.between), place)).collect();
    order.sort_unstable();
    let mut points: Vec<EdgePoint> = Vec::with_capacity(pieces.len() + 1);
    let mut segments: Vec<ZeroSegment> =
        pieces.iter().map(|(face, _)| ZeroSegment { face: *face, ends: [0; 2] }).collect();
    let mut before = None;
    for (key, place) in order {
        let (piece, end) = (place as usize / 2, place as usize % 2);
        if before.replace(key) != Some(key) {
            points.push(pieces[piece].1[end]);
        }
        segments[piece].ends[end] = points.len() as u32 - 1;
    }
    ZeroSet { segments, points }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Soup;

    /// A unit square around zero of n × n cells, each cut in two.
    fn square(n: u32) -> (Mesh, SmoothNormals) {
        let mut positions = Vec::new();
        let mut triangles = Vec::new();
        for y in 0..=n {
            for x in 0..=n {
                let place = DVec3::new(f64::from(x), f64::from(y), 0.0) / f64::from(n);
                positions.push(place - DVec3::new(0.5, 0.5, 0.0));
                if x < n && y < n {
                    let a = y * (n + 1) + x;
                    triangles.push([a, a + 1, a + n + 2]);
                    triangles.push([a, a + n + 2, a + n + 1]);
                }
            }
        }
        let mesh = Mesh::build(Soup { positions, triangles, ..Soup::default() });
        let smooth = SmoothNormals::rounded(&mesh);
        (mesh, smooth)
    }

    fn positions(mesh: &Mesh, smooth: &SmoothNormals, set: &ZeroSet) -> Vec<DVec3> {
        set.points.iter().map(|p| p.position(mesh, smooth)).collect()
    }

    #[test]
    fn zero_set_of_a_circle_is_one_ring_with_positive_side_on_the_left() {
        let (mesh, smooth) = square(40);
        let field: Vec<f64> = mesh.positions.iter().map(|p| 0.3 - p.length()).collect();
        let set = trace(&mesh, &smooth, &field, |_| true);
        let points = positions(&mesh, &smooth, &set);
        assert!(points.iter().all(|p| (p.length() - 0.3).abs() < 1e-3));
        let mut next = vec![u32::MAX; points.len()];
        for s in &set.segments {
            let [a, b] = s.ends.map(|e| points[e as usize]);
            assert!(a.truncate().perp_dot(b.truncate()) > 0.0, "runs round its middle, which is positive");
            assert_eq!(next[s.ends[0] as usize], u32::MAX);
            next[s.ends[0] as usize] = s.ends[1];
        }
        let (mut at, mut steps) = (0, 0);
        loop {
            (at, steps) = (next[at as usize], steps + 1);
            if at == 0 {
                break;
            }
        }
        assert_eq!(steps, points.len());
    }

    #[test]
    fn zero_set_through_vertices_is_a_single_line() {
        let (mesh, smooth) = square(10);
        let field: Vec<f64> =
            mesh.positions.iter().map(|p| p.x).map(|x| if x.abs() < 1e-9 { 0.0 } else { x }).collect();
        let set = trace(&mesh, &smooth, &field, |_| true);
        let mut degrees = vec![0; set.points.len()];
        set.segments.iter().flat_map(|s| s.ends).for_each(|e| degrees[e as usize] += 1);
        assert_eq!(degrees.iter().filter(|d| **d == 1).count(), 2);
        assert!(degrees.iter().all(|d| (1..=2).contains(d)));
        assert!(set.segments.iter().all(|s| s.ends[0] != s.ends[1]));
    }

    #[test]
    fn zero_set_is_split_at_hard_edges_and_absent_on_flat_faces() {
        let (mesh, mut smooth) = square(2);
        let field: Vec<f64> = mesh.positions.iter().map(|p| p.y - 0.1).collect();
        let whole = trace(&mesh, &smooth, &field, |_| true);
        assert_eq!((whole.segments.len(), whole.points.len()), (4, 5));
        assert_eq!(trace(&mesh, &smooth, &field, |face| face < 6).segments.len(), 2);

        // The right half gets separate vertices.
        let count = smooth.vertices.len() as u32;
        for v in 0..count {
            smooth.vertices.push(smooth.vertices[v as usize]);
        }
        let right: Vec<usize> = (0..8).filter(|f| f / 2 % 2 == 1).collect();
        for f in &right {
            smooth.corners[*f] = smooth.corners[*f].map(|v| v + count);
        }
        let twice = [field.clone(), field].concat();
        let parted = trace(&mesh, &smooth, &twice, |_| true);
        assert_eq!((parted.segments.len(), parted.points.len()), (4, 6));

        for f in right {
            smooth.corners[f] = [NO_NORMAL; 3];
        }
        assert_eq!(trace(&mesh, &smooth, &twice, |_| true).segments.len(), 2);
    }

    #[test]
    fn zero_set_points_do_not_depend_on_the_face_order() {
        let (mesh, smooth) = square(8);
        let field: Vec<f64> = mesh.positions.iter().map(|p| p.x * p.y + 0.01).collect();
        let mut turned = smooth.clone();
        turned.corners.reverse();
        let (one, other) = (trace(&mesh, &smooth, &field, |_| true), trace(&mesh, &turned, &field, |_| true));
        assert_eq!(one.points, other.points);
        assert_eq!(one.segments.len(), other.segments.len());
    }
}
