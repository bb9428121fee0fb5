//! [`NormalSum`]: normal at a vertex, as a weighted sum of face normals.
//!
//! Source: Nelson Max, "Weights for computing vertex normals from facet normals", Journal of Graphics Tools
//! 4(2), 1999. These weights are exact for every polyhedron inscribed in a sphere.

use glam::DVec3;

/// Weighted sum of the face normals around a vertex.
///
/// Max's weights suit a sphere, where small faces are as reliable as large ones. Where a strip of small faces
/// meets large ones, the large faces are the surface and the strip is its rounded edge. There each face is
/// weighted by area and angle.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct NormalSum {
    of_max: DVec3,
    of_area: DVec3,
    /// Largest squared doubled area, and the inverse of the smallest.
    max_squared: f64,
    max_inverse: f64,
}

/// Maximum ratio of the areas around a vertex. Above it, the small faces form an edge strip.
const MAX_AREA_RATIO: f64 = 6.0;

/// Contribution of a face to the normals at its corners.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FaceWeights {
    /// Normal with the length of twice the area.
    cross: DVec3,
    squared: f64,
    inverse: f64,
    /// For each corner, the inverse product of the squared lengths of its two sides.
    of_max: [f64; 3],
}

impl FaceWeights {
    /// Weights of a face with these corners; `None` if it has no area.
    #[inline]
    pub(crate) fn new([a, b, c]: [DVec3; 3]) -> Option<Self> {
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
    /// Adds a face; `which` is its corner at the vertex.
    #[inline]
    pub(crate) fn add(&mut self, face: &FaceWeights, which: usize) {
        // Max, eq. 2.
        let of_max = face.of_max[which];
        self.of_max += face.cross * of_max;
        // The sine replaces the angle; they are close where faces are many.
        self.of_area += face.cross * (face.squared * of_max).sqrt();
        self.max_squared = self.max_squared.max(face.squared);
        self.max_inverse = self.max_inverse.max(face.inverse);
    }

    /// The selected sum, not of unit length.
    #[inline]
    pub(crate) fn normal(&self) -> DVec3 {
        if self.max_squared * self.max_inverse > MAX_AREA_RATIO * MAX_AREA_RATIO {
            self.of_area
        } else {
            self.of_max
        }
    }
}
