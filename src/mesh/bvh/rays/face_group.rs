//! [`FaceGroup`]: eight faces projected along parallel rays, compared with a ray at once.
//!
//! Loops over the faces are written out without closures over arrays, because only then do compilers
//! vectorise them.

use super::ray_grid::{GridRay, RayBox};

/// Number of faces in a group. Plain loops of this length vectorise.
pub(crate) const FACES_PER_GROUP: usize = 8;

/// Rounding error of sums of coordinates, as a multiple of that of one coordinate.
const ROUNDING_OF_SUMS: f32 = 4.0;

/// One number per face.
type Lanes = [f32; FACES_PER_GROUP];

/// Faces in ray space, with the third axis along the rays.
pub(crate) struct FaceGroup {
    /// Coordinates of the three corners.
    corners: [[Lanes; 3]; 3],
    /// Normals, with the length of twice the area.
    normals: [Lanes; 3],
    /// Error bounds of the three side functions of each face.
    side_rooms: [Lanes; 3],
    /// Error bound of the plane function, constant and per unit along the rays.
    plane_rooms: [Lanes; 2],
    /// One bit per face.
    all: u32,
    pub around: RayBox,
}

impl FaceGroup {
    /// Builds a group from face corners whose coordinates are accurate to `slack`.
    #[inline]
    pub(crate) fn new(faces: &[u32], corners: impl Fn(u32) -> [[f32; 3]; 3], slack: f32) -> Self {
        let mut of = [[[0.0; FACES_PER_GROUP]; 3]; 3];
        for k in 0..FACES_PER_GROUP {
            // The last face fills missing entries.
            let corners = corners(faces[k.min(faces.len() - 1)]);
            for corner in 0..3 {
                for axis in 0..3 {
                    of[corner][axis][k] = corners[corner][axis];
                }
            }
        }
        let around = around(&of, slack);
        let (width, wide) =
            (around.high[0] - around.low[0] + around.high[1] - around.low[1], ROUNDING_OF_SUMS * slack);
        let [[ax, ay, az], [bx, by, bz], [cx, cy, cz]] = &of;
        let (mut normals, mut side_rooms, mut plane_rooms) =
            ([[0.0; FACES_PER_GROUP]; 3], [[0.0; FACES_PER_GROUP]; 3], [[0.0; FACES_PER_GROUP]; 2]);
        for k in 0..FACES_PER_GROUP {
            let (ux, uy, uz) = (bx[k] - ax[k], by[k] - ay[k], bz[k] - az[k]);
            let (vx, vy, vz) = (cx[k] - ax[k], cy[k] - ay[k], cz[k] - az[k]);
            let (wx, wy) = (cx[k] - bx[k], cy[k] - by[k]);
            let (nx, ny, nz) = (uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx);
            normals[0][k] = nx;
            normals[1][k] = ny;
            normals[2][k] = nz;
            side_rooms[0][k] = (ux.abs() + uy.abs()) * wide;
            side_rooms[1][k] = (wx.abs() + wy.abs()) * wide;
            side_rooms[2][k] = (vx.abs() + vy.abs()) * wide;
            // The errors of the corners and of the normal grow with the length of the sides.
            let sides = ux.abs() + uy.abs() + uz.abs() + vx.abs() + vy.abs() + vz.abs();
            plane_rooms[0][k] = (nx.abs() + ny.abs() + nz.abs() + sides * width) * wide;
            plane_rooms[1][k] = sides * wide;
        }
        let all = (1 << faces.len()) - 1;
        Self { corners: of, normals, side_rooms, plane_rooms, all, around }
    }

    /// The faces that a ray may meet, one bit each: those in front of its start that contain it in
    /// projection, from either side.
    #[inline]
    pub(crate) fn may_meet(&self, ray: &GridRay) -> u32 {
        let ([x, y], z) = (ray.at, ray.from);
        let [[ax, ay, az], [bx, by, _], [cx, cy, _]] = &self.corners;
        let ([nx, ny, nz], [r, s, t]) = (&self.normals, &self.side_rooms);
        let [room, of_way] = &self.plane_rooms;
        let mut found = [0_u32; FACES_PER_GROUP];
        for k in 0..FACES_PER_GROUP {
            let e = (bx[k] - ax[k]) * (y - ay[k]) - (by[k] - ay[k]) * (x - ax[k]);
            let f = (cx[k] - bx[k]) * (y - by[k]) - (cy[k] - by[k]) * (x - bx[k]);
            let g = (ax[k] - cx[k]) * (y - cy[k]) - (ay[k] - cy[k]) * (x - cx[k]);
            let above = nx[k] * (x - ax[k]) + ny[k] * (y - ay[k]) + nz[k] * (z - az[k]);
            let room = room[k] + of_way[k] * (z - az[k]).abs();
            // Along the normal a ray meets planes above it, against the normal planes below.
            let along = (e >= -r[k]) & (f >= -s[k]) & (g >= -t[k]) & (above <= room);
            let against = (e <= r[k]) & (f <= s[k]) & (g <= t[k]) & (above >= -room);
            found[k] = u32::from(along | against);
        }
        let mut bits = 0;
        for (k, found) in found.iter().enumerate() {
            bits |= found << k;
        }
        bits & self.all
    }
}

/// The box around all faces.
#[inline]
fn around(corners: &[[Lanes; 3]; 3], slack: f32) -> RayBox {
    let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    let [a, b, c] = corners;
    for axis in 0..3 {
        let (mut least, mut most) = ([0.0_f32; FACES_PER_GROUP], [0.0_f32; FACES_PER_GROUP]);
        for k in 0..FACES_PER_GROUP {
            let (p, q, r) = (a[axis][k], b[axis][k], c[axis][k]);
            let (below, above) = if p < q { (p, q) } else { (q, p) };
            least[k] = if below < r { below } else { r };
            most[k] = if above > r { above } else { r };
        }
        for k in 0..FACES_PER_GROUP {
            low[axis] = if least[k] < low[axis] { least[k] } else { low[axis] };
            high[axis] = if most[k] > high[axis] { most[k] } else { high[axis] };
        }
        low[axis] -= slack;
        high[axis] += slack;
    }
    RayBox { low, high }
}
