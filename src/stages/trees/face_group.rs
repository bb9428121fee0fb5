//! [`FaceGroup`]: a few faces seen along parallel rays, all compared with a ray at once.

use super::ray_grid::{Around, GridRay};

/// Faces of a group: plain loops over so many numbers are what processors do at once.
pub(super) const WIDTH: usize = 8;

/// How much wider than the rounding of a coordinate that of what is made of some of them may be.
const SUMS: f32 = 4.0;

/// One number of each face.
type Lanes = [f32; WIDTH];

/// Some faces in the space of their rays, the third axis along them.
pub(super) struct FaceGroup {
    /// Coordinates of the three corners.
    corners: [[Lanes; 3]; 3],
    /// Normals, twice as long as the face is large.
    normals: [Lanes; 3],
    /// By how much the sides, and the plane, of each face may be off, and the latter for each unit along the rays.
    rooms: [Lanes; 5],
    /// A bit for each face.
    all: u32,
    pub around: Around,
}

impl FaceGroup {
    /// Faces by their corners, whose coordinates are off by `slack` at most.
    #[inline]
    pub fn new(faces: &[u32], corners: impl Fn(u32) -> [[f32; 3]; 3], slack: f32) -> Self {
        let mut of = [[[0.0; WIDTH]; 3]; 3];
        for k in 0..WIDTH {
            // The last one stands in for those that are missing.
            let corners = corners(faces[k.min(faces.len() - 1)]);
            for (of, corner) in of.iter_mut().zip(corners) {
                for (of, x) in of.iter_mut().zip(corner) {
                    of[k] = x;
                }
            }
        }
        let [a, b, c] = of;
        let (mut normals, mut rooms) = ([[0.0; WIDTH]; 3], [[0.0; WIDTH]; 5]);
        let bound = |axis: usize, pick: fn(f32, f32) -> f32| {
            let of_face = |k: usize| pick(pick(a[axis][k], b[axis][k]), c[axis][k]);
            (1..WIDTH).fold(of_face(0), |bound, k| pick(bound, of_face(k)))
        };
        let low = [0, 1, 2].map(|axis| bound(axis, |x, y| if x < y { x } else { y }) - slack);
        let high = [0, 1, 2].map(|axis| bound(axis, |x, y| if x > y { x } else { y }) + slack);
        let (width, wide) = (high[0] - low[0] + high[1] - low[1], SUMS * slack);
        for k in 0..WIDTH {
            let [u, v, w] = [(&a, &b), (&a, &c), (&b, &c)].map(|(p, q)| [0, 1, 2].map(|x| q[x][k] - p[x][k]));
            let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
            for (normals, x) in normals.iter_mut().zip(normal) {
                normals[k] = x;
            }
            for (room, side) in rooms.iter_mut().zip([u, w, v]) {
                room[k] = (side[0].abs() + side[1].abs()) * wide;
            }
            // Corners are off, and so is the normal, by the length of the sides.
            let sides = u.into_iter().chain(v).fold(0.0, |sum, x| sum + x.abs());
            let length = normal[0].abs() + normal[1].abs() + normal[2].abs();
            rooms[3][k] = (length + sides * width) * wide;
            rooms[4][k] = sides * wide;
        }
        Self { corners: of, normals, rooms, all: (1 << faces.len()) - 1, around: Around { low, high } }
    }

    /// Which faces a ray may meet, one bit each: those that it begins before, and that hold it, seen from either side.
    #[inline]
    pub fn may_meet(&self, ray: &GridRay) -> u32 {
        let ([x, y], z) = (ray.at, ray.from);
        let ([a, b, c], [nx, ny, nz]) = (&self.corners, &self.normals);
        let mut found = [0_u8; WIDTH];
        for k in 0..WIDTH {
            let side = |p: &[Lanes; 3], q: &[Lanes; 3]| {
                (q[0][k] - p[0][k]) * (y - p[1][k]) - (q[1][k] - p[1][k]) * (x - p[0][k])
            };
            let sides = [side(a, b), side(b, c), side(c, a)];
            let [r, s, t, room, of_way] = [0, 1, 2, 3, 4].map(|of| self.rooms[of][k]);
            let room = room + of_way * (z - a[2][k]).abs();
            let above = nx[k] * (x - a[0][k]) + ny[k] * (y - a[1][k]) + nz[k] * (z - a[2][k]);
            // Along the normal a ray meets what is above it, against the normal what is below.
            let along = (sides[0] >= -r) & (sides[1] >= -s) & (sides[2] >= -t) & (above <= room);
            let against = (sides[0] <= r) & (sides[1] <= s) & (sides[2] <= t) & (above >= -room);
            found[k] = u8::from(along | against);
        }
        found.iter().enumerate().fold(0, |bits, (k, found)| bits | u32::from(*found) << k) & self.all
    }
}
