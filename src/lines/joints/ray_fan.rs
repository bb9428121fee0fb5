//! [`RayFan`]: the faces around a stretch of a line, seen along the line, and whether surfaces continue
//! across it.
//!
//! In the plane across the line, each face that reaches it is a ray. The two rays of a solid's corner enclose
//! its material. Where solids touch face to face, two rays coincide with material on both sides. So material
//! of one kind is bounded by the rays with material on one side only. The line is no edge of the union of
//! parts if there are no such rays, or two opposite ones.

use glam::DVec3;

use crate::mesh::PartId;
use crate::mesh::tolerances::MAX_NORMAL_ERROR_SINE;

/// Face at a line, seen along the line.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FaceRay {
    /// Direction away from the line, a unit vector across it.
    pub direction: DVec3,
    /// Whether material starts behind the ray, when turning from `right` to `up`.
    pub begins: bool,
    /// Sine of its largest angle error.
    pub angle_error: f64,
    pub kind: u32,
    pub part: PartId,
    pub body: PartId,
}

/// Rays around a line, sorted by angle.
pub(crate) struct RayFan {
    /// Each ray with the index of its direction.
    rays: Vec<(FaceRay, usize)>,
    /// The most accurate ray of each direction.
    directions: Vec<FaceRay>,
}

impl RayFan {
    /// Sorts rays in the plane of `right` and `up`, and groups those that coincide.
    pub(crate) fn new(mut rays: Vec<FaceRay>, right: DVec3, up: DVec3) -> Self {
        rays.sort_by(|a, b| turn(a.direction, right, up).total_cmp(&turn(b.direction, right, up)));
        let is_one = |a: &FaceRay, b: &FaceRay| {
            a.direction.cross(b.direction).length() <= a.angle_error + b.angle_error
                && a.direction.dot(b.direction) > 0.0
        };
        let mut count = 0;
        let mut numbered: Vec<(FaceRay, usize)> = Vec::with_capacity(rays.len());
        for ray in rays {
            count += usize::from(numbered.last().is_none_or(|(last, _)| !is_one(last, &ray)));
            numbered.push((ray, count - 1));
        }
        // The last rays may coincide with the first.
        if let [(first, _), .., (last, number)] = numbered.as_slice()
            && *number > 0
            && is_one(last, first)
        {
            let number = *number;
            numbered.iter_mut().filter(|(_, own)| *own == number).for_each(|(_, own)| *own = 0);
            count -= 1;
        }
        let best = |number: usize| {
            let own = numbered.iter().filter(|(_, own)| *own == number).map(|(ray, _)| *ray);
            own.min_by(|a, b| a.angle_error.total_cmp(&b.angle_error))
        };
        let directions = (0..count).filter_map(best).collect();
        Self { rays: numbered, directions }
    }

    /// Whether parts of one kind meet here, and no surface ends or turns.
    pub(crate) fn is_joint(&self) -> bool {
        let mut kinds: Vec<u32> = self.rays.iter().map(|(ray, _)| ray.kind).collect();
        kinds.sort_unstable();
        kinds.dedup();
        let mut plane: Option<[usize; 2]> = None;
        let mut is_shared = false;
        for kind in kinds {
            match *self.bounds(kind).as_slice() {
                [] => {}
                [a, b] if self.is_opposite(a, b) && plane.is_none_or(|plane| plane == [a, b]) => {
                    plane = Some([a, b]);
                }
                _ => return false,
            }
            let mut parts = self.rays.iter().filter(|(ray, _)| ray.kind == kind).map(|(ray, _)| ray.part);
            let first = parts.next();
            is_shared |= parts.any(|part| Some(part) != first);
        }
        is_shared
    }

    /// Indices of the directions that bound material of one kind.
    fn bounds(&self, kind: u32) -> Vec<usize> {
        let count = self.directions.len();
        let own =
            |body: PartId| self.rays.iter().filter(move |(ray, _)| ray.kind == kind && ray.body == body);
        let mut bodies: Vec<PartId> =
            self.rays.iter().filter(|(ray, _)| ray.kind == kind).map(|(ray, _)| ray.body).collect();
        bodies.sort_unstable();
        bodies.dedup();
        // Number of bodies that fill the sector after each direction, and directions with an open surface.
        let (mut filled, mut sheets) = (vec![0; count], vec![false; count]);
        for body in bodies {
            let mut steps = vec![0i32; count];
            own(body).for_each(|(ray, at)| steps[*at] += if ray.begins { 1 } else { -1 });
            let is_closed = steps.iter().sum::<i32>() == 0;
            let sums = steps.iter().scan(0, |sum, step| {
                *sum += step;
                Some(*sum)
            });
            let mut depths: Vec<i32> = sums.collect();
            let least = depths.iter().copied().min().unwrap_or_default();
            depths.iter_mut().for_each(|depth| *depth -= least);
            for (_, at) in own(body) {
                let before = depths[(at + count - 1) % count];
                sheets[*at] |= !is_closed || (before == 0 && depths[*at] == 0);
            }
            if is_closed {
                filled.iter_mut().zip(depths).for_each(|(filled, depth)| *filled += depth);
            }
        }
        let is_bound = |at: &usize| {
            let (before, after) = (filled[(at + count - 1) % count] == 0, filled[*at] == 0);
            before != after || (sheets[*at] && before)
        };
        (0..count).filter(is_bound).collect()
    }

    fn is_opposite(&self, a: usize, b: usize) -> bool {
        let (a, b) = (&self.directions[a], &self.directions[b]);
        a.direction.cross(b.direction).length() <= a.angle_error + b.angle_error
            && a.direction.dot(b.direction) < 0.0
    }
}

/// Monotonic function of the angle from `right` towards `up`, from 0 to 4.
fn turn(way: DVec3, right: DVec3, up: DVec3) -> f64 {
    let (x, y) = (way.dot(right), way.dot(up));
    let share = y / (x.abs() + y.abs());
    let share = if share.is_nan() { 0.0 } else { share };
    match (x >= 0.0, y >= 0.0) {
        (true, true) => share,
        (false, _) => 2.0 - share,
        (true, false) => 4.0 + share,
    }
}

/// Sine of the largest angle error of a triangle about a line, if rounding moves corners by half of
/// `contact`.
///
/// `height` is the smallest height of the triangle, and `length` that of the line.
pub(crate) fn angle_error_sine(contact: f64, height: f64, length: f64) -> f64 {
    (contact / height + contact / length).min(MAX_NORMAL_ERROR_SINE)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rays about z in degrees: where material starts, and where it ends.
    fn ray_fan_of(corners: &[(u32, u32, [f64; 2])]) -> RayFan {
        let ray = |degrees: f64, begins: bool, kind: u32, part: u32| {
            let angle = degrees.to_radians();
            let way = DVec3::new(
                crate::geometry::numbers::portable_math::cos(angle),
                crate::geometry::numbers::portable_math::sin(angle),
                0.0,
            );
            FaceRay {
                direction: way,
                begins,
                angle_error: 1e-6,
                kind,
                part: PartId(part),
                body: PartId(part),
            }
        };
        let rays = corners.iter().flat_map(|(kind, part, [from, to])| {
            [ray(*from, true, *kind, *part), ray(*to, false, *kind, *part)]
        });
        RayFan::new(rays.collect(), DVec3::X, DVec3::Y)
    }

    #[test]
    fn is_joint_accepts_only_flush_parts_of_one_material() {
        let is_joint = |corners: &[(u32, u32, [f64; 2])]| {
            // The result does not depend on rotation.
            let found: Vec<bool> = [0.0, 45.0, 100.0, 180.0, 269.0]
                .map(|turn| {
                    ray_fan_of(
                        &corners
                            .iter()
                            .map(|(k, p, [a, b])| (*k, *p, [a + turn, b + turn]))
                            .collect::<Vec<_>>(),
                    )
                    .is_joint()
                })
                .to_vec();
            assert!(found.iter().all(|one| *one == found[0]), "{corners:?}: {found:?}");
            found[0]
        };
        // Two boxes side by side, and three of a wall.
        assert!(is_joint(&[(0, 0, [180.0, 270.0]), (0, 1, [270.0, 360.0])]));
        assert!(is_joint(&[(0, 0, [0.0, 90.0]), (0, 1, [90.0, 180.0]), (0, 2, [180.0, 360.0])]));
        // The end of a box within another one, flush with it.
        assert!(is_joint(&[(0, 0, [180.0, 270.0]), (0, 1, [180.0, 360.0])]));
        // Not joints: the edge of a single box, a box on a wider one, two that share only an edge, and one
        // that turns slightly.
        assert!(!is_joint(&[(0, 0, [180.0, 270.0])]));
        assert!(!is_joint(&[(0, 0, [0.0, 90.0]), (0, 1, [180.0, 360.0])]));
        assert!(!is_joint(&[(0, 0, [0.0, 90.0]), (0, 1, [180.0, 270.0])]));
        assert!(!is_joint(&[(0, 0, [180.0, 270.0]), (0, 1, [270.0, 361.0])]));
        // Not joints: one part alone, and a second material.
        assert!(!is_joint(&[(0, 0, [180.0, 360.0])]));
        assert!(!is_joint(&[(0, 0, [180.0, 270.0]), (1, 1, [270.0, 360.0])]));
        // A joint on a floor of another material, but not in front of one that ends there.
        assert!(is_joint(&[(0, 0, [0.0, 90.0]), (0, 1, [90.0, 180.0]), (1, 2, [180.0, 360.0])]));
        assert!(!is_joint(&[(0, 0, [0.0, 90.0]), (0, 1, [90.0, 180.0]), (1, 2, [180.0, 300.0])]));
    }
}
