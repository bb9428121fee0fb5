//! [`NormalSum`]: the normal at a vertex, from the faces around it.
//!
//! Source: Nelson Max, "Weights for computing vertex normals from facet normals", Journal of
//! Graphics Tools 4(2), 1999: the weights that give the true normals of every polyhedron inscribed
//! in a sphere.

use glam::DVec3;

/// The normal at a vertex, from the faces around it.
///
/// Max's weights are right for a ball, where small faces are as good as large ones. Where a strip of
/// small faces meets large ones, these are the surface and the strip is its edge: there each face
/// counts by its area and its angle.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct NormalSum {
    of_max: DVec3,
    of_area: DVec3,
    /// The largest and the smallest face, twice their areas squared; the smallest as its inverse.
    most: f64,
    least: f64,
}

/// Faces around a vertex whose areas differ by more than this are an edge strip and what it borders.
const UNEVEN: f64 = 6.0;

/// What a face adds to the normals at its corners.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FaceWeights {
    /// The normal, as long as the face is large, twice.
    cross: DVec3,
    squared: f64,
    inverse: f64,
    /// At each corner one through the squared lengths of the two sides there.
    of_max: [f64; 3],
}

impl FaceWeights {
    /// Of a face with these corners; none if it has no area.
    #[inline]
    pub fn new([a, b, c]: [DVec3; 3]) -> Option<Self> {
        let (ab, bc, ca) = (b - a, c - b, a - c);
        let cross = ca.cross(ab);
        let squared = cross.length_squared();
        let sides = [ab, bc, ca].map(DVec3::length_squared);
        let weights = [sides[2] * sides[0], sides[0] * sides[1], sides[1] * sides[2]];
        let has_area = squared > 0.0 && weights.iter().all(|weight| *weight > 0.0);
        has_area.then(|| Self { cross, squared, inverse: 1.0 / squared, of_max: weights.map(|w| 1.0 / w) })
    }
}

impl NormalSum {
    /// Adds a face of which a corner is the vertex.
    #[inline]
    pub fn add(&mut self, face: &FaceWeights, which: usize) {
        // Max, eq. 2.
        let of_max = face.of_max[which];
        self.of_max += face.cross * of_max;
        // The sine stands for the angle, to which it is near where faces are many.
        self.of_area += face.cross * (face.squared * of_max).sqrt();
        self.most = self.most.max(face.squared);
        self.least = self.least.max(face.inverse);
    }

    /// The sum that is meant, not of unit length.
    #[inline]
    pub fn normal(&self) -> DVec3 {
        if self.most * self.least > UNEVEN * UNEVEN { self.of_area } else { self.of_max }
    }
}
