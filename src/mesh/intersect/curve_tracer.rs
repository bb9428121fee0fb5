//! [`CurveTracer`]: follows intersection curves over a mesh, from one pair of triangles to the next.
//!
//! At each end of the common segment of two triangles, an edge of one pierces the other. The curve continues
//! in the face across that edge. At a vertex in the other plane, it continues in one of the faces around the
//! vertex.

use rustc_hash::FxHashSet;

use super::intersection_curves::{IntersectingPair, IntersectionCurves, IntersectionInput, find_pairs, join};
use super::triangle_pair::{Feature, PairIntersection, PairTolerance, SegmentEnd, Triangle, cross};
use crate::mesh::{EdgeFaces, FaceId, Mesh};

/// Follows the intersection curves of a mesh.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CurveTracer<'a> {
    mesh: &'a Mesh,
}

impl<'a> CurveTracer<'a> {
    /// The tracer of a mesh.
    #[must_use]
    pub(crate) fn new(mesh: &'a Mesh) -> Self {
        Self { mesh }
    }

    /// The pairs among the active faces that pass through each other, lesser face first.
    #[must_use]
    pub(crate) fn pairs_among(&self, active: &[bool]) -> Vec<[u32; 2]> {
        let Mesh { positions, triangles, .. } = self.mesh;
        let (middle, radius) = self.mesh.extents.ball();
        let bodies = self.mesh.face_bodies();
        let input = IntersectionInput { positions, triangles, active, bodies: &bodies };
        let tolerance = |face: u32| PairTolerance::of_part(self.mesh.extent(FaceId(face)));
        let pairs = find_pairs(&input, middle - radius, middle + radius, tolerance);
        pairs.iter().map(|pair| pair.faces).collect()
    }

    /// The complete curves through the given pairs of faces, as far as triangles without common vertices form
    /// them. The order of the pairs has no effect.
    #[must_use]
    pub(crate) fn curves(&self, seeds: &[[u32; 2]]) -> IntersectionCurves {
        let mut tested: FxHashSet<[u32; 2]> = seeds.iter().copied().collect();
        let mut waiting = seeds.to_vec();
        let mut found = Vec::new();
        let (mut firsts, mut seconds) = (Vec::new(), Vec::new());
        while let Some(faces) = waiting.pop() {
            let Some(common) = self.common(faces) else { continue };
            found.push(IntersectingPair { faces, common });
            for end in common.ends() {
                self.faces_at(end, 0, faces[0], &mut firsts);
                self.faces_at(end, 1, faces[1], &mut seconds);
                for &a in &firsts {
                    for &b in &seconds {
                        let pair = [a.min(b), a.max(b)];
                        if tested.insert(pair) && !self.are_neighbours(a, b) {
                            waiting.push(pair);
                        }
                    }
                }
            }
        }
        found.sort_unstable_by_key(|pair| pair.faces);
        join(&found)
    }

    fn common(&self, [a, b]: [u32; 2]) -> Option<PairIntersection> {
        let triangle = |face: u32| Triangle::new(&self.mesh.positions, self.mesh.triangles[face as usize]);
        let [own, other] = [a, b].map(|face| PairTolerance::of_part(self.mesh.extent(FaceId(face))));
        cross(&triangle(a), &triangle(b), own.and(other))
    }

    fn are_neighbours(&self, a: u32, b: u32) -> bool {
        let corners = self.mesh.triangles[b as usize];
        let common = self.mesh.triangles[a as usize].iter().filter(|v| corners.contains(v)).count();
        common > 1 || common == 1 && self.mesh.body(a) == self.mesh.body(b)
    }

    /// Collects the face and the faces where its surface continues at one end of a segment.
    fn faces_at(&self, end: SegmentEnd, side: usize, face: u32, faces: &mut Vec<u32>) {
        faces.clear();
        faces.push(face);
        let Some(piercing) = end[side] else { return };
        let feature = piercing.feature;
        // Faces without area are skipped. Around a vertex the step is repeated.
        let is_of_vertex = feature[0] == feature[1];
        let mut next = 0;
        while let Some(&at) = faces.get(next) {
            next += 1;
            if at == face || is_of_vertex || self.mesh.is_degenerate(FaceId(at)) {
                self.step(at, feature, faces);
            }
        }
        faces.retain(|f| *f == face || !self.mesh.is_degenerate(FaceId(*f)));
    }

    /// Adds the faces across those edges of `face` that contain the feature.
    fn step(&self, face: u32, [v, w]: Feature, faces: &mut Vec<u32>) {
        let [a, b, c] = self.mesh.triangles[face as usize];
        for (p, q) in [(a, b), (b, c), (c, a)] {
            let edge = [p.min(q), p.max(q)];
            let leads_on = edge == [v, w]
                || v == w && edge.contains(&v)
                || v != w && self.mesh.is_degenerate(FaceId(face));
            if !leads_on {
                continue;
            }
            let Ok(edge) = self.mesh.edges.vertices.binary_search(&edge) else { continue };
            let mut add = |other: u32| {
                if !faces.contains(&other) {
                    faces.push(other);
                }
            };
            match self.mesh.edges.faces(edge) {
                EdgeFaces::One(_) => {}
                EdgeFaces::Two { faces: [first, second], .. } => {
                    add(if first == face { second } else { first })
                }
                EdgeFaces::Many(others) => others.iter().for_each(|other| add(*other)),
            }
        }
    }
}
