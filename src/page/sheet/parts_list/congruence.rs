//! [`PartShape`]: the shape of a part, compared with others up to a rotation and a translation.
//!
//! Two shapes are congruent if a rigid motion maps each corner of one to a corner of the other, and the
//! mapped faces cover the same surface.
//!
//! 1. The motion maps the mean of all corners to the mean. So the first corner maps to one at the same
//!    distance from the mean.
//! 2. The second corner maps to one that also has the same distance from the first. Two corners fix the
//!    motion.
//! 3. The first corner is chosen from the rarest distance, so there are few candidates.
//! 4. Each candidate is checked on all corners, then on the faces. Faces may be split along other diagonals:
//!    a face without a counterpart must be covered by the unmatched faces of the other shape.
//!
//! Distances are equal within the rounding of the file.

use glam::{DAffine3, DMat3, DVec3};
use rustc_hash::FxHashMap;

use crate::geometry::tolerances::F32_STEP;
use crate::mesh::tolerances::{MAX_F32_ROUNDING_STEPS, MAX_LATTICE_ROUNDING_STEPS};
use crate::page::tolerances::CORNER_ROUNDING_OF_COORDINATE;
use crate::scene::{Geometry, Part, Scene};

/// Minimum distance of the first corner from the mean, as a share of the largest distance.
const MIN_FIRST_CORNER_SHARE: f64 = 0.5;

/// Maximum number of corner comparisons for all candidates; shapes that need more count as different.
const MAX_CORNER_CHECKS: usize = 20_000_000;

/// Maximum number of faces that are split along other diagonals.
const MAX_FLIPPED_FACES: usize = 4000;

/// The shape of a part.
pub(crate) struct PartShape {
    /// Geometry, and the Gram matrix of the axes. Parts that share both, and are mirrored alike, have the
    /// same shape.
    instance: (usize, DMat3),
    is_mirrored: bool,
    /// Distinct corners, and faces as indices into them.
    corners: Vec<DVec3>,
    faces: Vec<[u32; 3]>,
    mean: DVec3,
    /// Distance of each corner from the mean, and the same values in rising order.
    far: Vec<f64>,
    sorted: Vec<f64>,
    /// Maximum shift of a corner by rounding.
    rounding: f64,
}

impl PartShape {
    /// The shape of a part; `None` without faces.
    pub(crate) fn of(scene: &Scene, part: &Part) -> Option<Self> {
        let geometry = scene.geometry_of(part).filter(|geometry| !geometry.triangles.is_empty())?;
        let transform = part.world_from_part;
        let rounding = file_rounding(geometry, &transform);
        let mut grid = CongruenceGrid::new(4.0 * rounding);
        let mut corner_of_position: FxHashMap<u32, u32> = FxHashMap::default();
        let mut corner_number = |p: u32| {
            *corner_of_position.entry(p).or_insert_with(|| {
                let world_point = transform.transform_point3(geometry.positions[p as usize]);
                grid.nearest(world_point, 2.0 * rounding, |_| true).unwrap_or_else(|| grid.add(world_point))
            })
        };
        let mut faces: Vec<[u32; 3]> =
            geometry.triangles.iter().map(|face| face.map(&mut corner_number)).collect();
        faces.retain(|[a, b, c]| a != b && b != c && a != c);
        let corners = grid.corners;
        let mean = corners.iter().sum::<DVec3>() / corners.len().max(1) as f64;
        let distances_from_mean: Vec<f64> = corners.iter().map(|p| p.distance(mean)).collect();
        let mut sorted = distances_from_mean.clone();
        sorted.sort_by(f64::total_cmp);
        let matrix = transform.matrix3;
        let instance = (part.geometry, matrix.transpose() * matrix);
        Some(Self {
            instance,
            is_mirrored: matrix.determinant() < 0.0,
            corners,
            faces,
            mean,
            far: distances_from_mean,
            sorted,
            rounding,
        })
    }

    /// Whether two shapes are congruent.
    pub(crate) fn equals(&self, other: &Self) -> bool {
        let scale = self
            .instance
            .1
            .to_cols_array()
            .iter()
            .fold(0.0_f64, |max_component, x| max_component.max(x.abs()));
        let same_axes = self.instance.1.abs_diff_eq(other.instance.1, F32_STEP * scale);
        if self.instance.0 == other.instance.0 && self.is_mirrored == other.is_mirrored && same_axes {
            return true;
        }
        // Rounding moves a corner and the mean in both shapes.
        let tolerance = 2.0 * (self.rounding + other.rounding);
        let has_equal_distances =
            || self.sorted.iter().zip(&other.sorted).all(|(a, b)| (a - b).abs() <= tolerance);
        if self.corners.len() != other.corners.len() || !has_equal_distances() {
            return false;
        }
        let Some(first) = self.rarest(tolerance) else { return true };
        let first_direction = (self.corners[first] - self.mean).normalize_or_zero();
        let distance_from_axis = |p: &DVec3| (*p - self.mean).cross(first_direction).length();
        let second = self
            .corners
            .iter()
            .enumerate()
            .max_by(|a, b| distance_from_axis(a.1).total_cmp(&distance_from_axis(b.1)));
        let Some((second, p)) = second else { return true };
        if distance_from_axis(p) <= tolerance {
            // All corners are on a line, so there are no faces.
            return true;
        }
        let mut grid = CongruenceGrid::new(16.0 * tolerance);
        other.corners.iter().for_each(|p| {
            grid.add(*p);
        });
        let first_to_second = self.corners[first].distance(self.corners[second]);
        // The error of the first corner turns the shape and grows with the distance from the mean.
        let turned_tolerance =
            tolerance * (2.0 + self.sorted.last().map_or(0.0, |max_distance| max_distance / self.far[first]));
        let mut checks_left = MAX_CORNER_CHECKS;
        for p in (0..other.corners.len()).filter(|p| (other.far[*p] - self.far[first]).abs() <= tolerance) {
            for q in 0..other.corners.len() {
                checks_left = checks_left.saturating_sub(1);
                let is_candidate = (other.far[q] - self.far[second]).abs() <= tolerance
                    && (other.corners[p].distance(other.corners[q]) - first_to_second).abs() <= tolerance;
                if !is_candidate {
                    continue;
                }
                if checks_left == 0 {
                    return false;
                }
                let [from, to] = [(self, first, second), (other, p, q)].map(|(shape, first, second)| {
                    corner_frame(shape.corners[first] - shape.mean, shape.corners[second] - shape.mean)
                });
                let turn = to * from.transpose();
                let turned_corners = self.corners.iter().map(|p| other.mean + turn * (*p - self.mean));
                let corner_map = match_corners(turned_corners, &grid, turned_tolerance, &mut checks_left);
                if corner_map.is_some_and(|onto| same_faces(self, other, &onto, turned_tolerance)) {
                    return true;
                }
            }
        }
        false
    }

    /// A corner of the rarest distance from the mean, not too close to it.
    fn rarest(&self, tolerance: f64) -> Option<usize> {
        let max_distance = self.sorted.last().copied().filter(|most| *most > tolerance)?;
        let distances = &self.far;
        let mut order: Vec<usize> =
            (0..distances.len()).filter(|k| distances[*k] >= MIN_FIRST_CORNER_SHARE * max_distance).collect();
        order.sort_by(|a, b| distances[*a].total_cmp(&distances[*b]).then(a.cmp(b)));
        let groups = order.chunk_by(|a, b| distances[*b] - distances[*a] <= tolerance);
        groups
            .min_by(|a, b| a.len().cmp(&b.len()).then(distances[b[0]].total_cmp(&distances[a[0]])))?
            .first()
            .copied()
    }
}

/// The corner at each point, all distinct; `None` if a point is on no free corner.
fn match_corners(
    points: impl Iterator<Item = DVec3>,
    grid: &CongruenceGrid,
    tolerance: f64,
    checks_left: &mut usize,
) -> Option<Vec<u32>> {
    let mut is_matched = vec![false; grid.corners.len()];
    points
        .map(|p| {
            *checks_left = checks_left.saturating_sub(1);
            let k = grid.nearest(p, tolerance, |k| !is_matched[k as usize])?;
            is_matched[k as usize] = true;
            Some(k)
        })
        .collect()
}

/// Maximum shift of corners by the rounding of the file, world units.
fn file_rounding(geometry: &Geometry, transform: &DAffine3) -> f64 {
    let largest = geometry
        .positions
        .iter()
        .fold(0.0_f64, |max_coordinate, p| max_coordinate.max(p.abs().max_element()));
    let single_precision_rounding =
        if geometry.single_precision { F32_STEP * largest * MAX_F32_ROUNDING_STEPS } else { 0.0 };
    let lattice_rounding = geometry.lattice_step * MAX_LATTICE_ROUNDING_STEPS;
    let stretch = transform
        .matrix3
        .x_axis
        .length()
        .max(transform.matrix3.y_axis.length())
        .max(transform.matrix3.z_axis.length());
    let world_size = largest * stretch + transform.translation.abs().max_element();
    single_precision_rounding.max(lattice_rounding) * stretch + CORNER_ROUNDING_OF_COORDINATE * world_size
}

/// An orthonormal frame: x along the first vector, z normal to both.
fn corner_frame(first: DVec3, second: DVec3) -> DMat3 {
    let x = first.normalize_or_zero();
    let z = x.cross(second).normalize_or_zero();
    DMat3::from_cols(x, z.cross(x), z)
}

/// Whether the mapped faces of one shape cover the same surface as those of the other.
fn same_faces(first_shape: &PartShape, second_shape: &PartShape, corner_map: &[u32], tolerance: f64) -> bool {
    let key = |mut face: [u32; 3]| {
        face.sort_unstable();
        face
    };
    let mut unmatched_counts: FxHashMap<[u32; 3], usize> = FxHashMap::default();
    for face in &second_shape.faces {
        *unmatched_counts.entry(key(*face)).or_default() += 1;
    }
    let mut only_in_first = Vec::new();
    for face in &first_shape.faces {
        let face = face.map(|corner| corner_map[corner as usize]);
        match unmatched_counts.get_mut(&key(face)).filter(|count| **count > 0) {
            Some(count) => *count -= 1,
            None => only_in_first.push(face),
        }
    }
    let only_in_second: Vec<[u32; 3]> = second_shape
        .faces
        .iter()
        .copied()
        .filter(|face| unmatched_counts.get(&key(*face)).is_some_and(|count| *count > 0))
        .collect();
    if only_in_first.len().max(only_in_second.len()) > MAX_FLIPPED_FACES {
        return false;
    }
    let covered = |faces: &[[u32; 3]], covering_faces: &[[u32; 3]]| {
        faces.iter().all(|face| {
            let [a, b, c] = face.map(|k| second_shape.corners[k as usize]);
            let inner = [(a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0, (a + b + c) / 3.0];
            inner.into_iter().all(|p| {
                covering_faces
                    .iter()
                    .any(|face| lies_in(p, face.map(|k| second_shape.corners[k as usize]), tolerance))
            })
        })
    };
    covered(&only_in_first, &only_in_second) && covered(&only_in_second, &only_in_first)
}

/// Whether a point lies in a triangle, within a tolerance.
fn lies_in(p: DVec3, [a, b, c]: [DVec3; 3], tolerance: f64) -> bool {
    let normal = (b - a).cross(c - a);
    let normal_length = normal.length();
    if normal_length <= 0.0 || ((p - a).dot(normal) / normal_length).abs() > tolerance {
        return false;
    }
    [[a, b], [b, c], [c, a]]
        .into_iter()
        .all(|[a, b]| (b - a).cross(p - a).dot(normal) >= -tolerance * (b - a).length() * normal_length)
}

/// Corners in a grid of cubic cells.
struct CongruenceGrid {
    corners: Vec<DVec3>,
    cell: f64,
    cells: FxHashMap<[i64; 3], Vec<u32>>,
}

impl CongruenceGrid {
    fn new(cell: f64) -> Self {
        Self { corners: Vec::new(), cell: cell.max(f64::MIN_POSITIVE), cells: FxHashMap::default() }
    }

    fn cell_of(&self, p: DVec3) -> [i64; 3] {
        (p / self.cell).floor().to_array().map(|x| x as i64)
    }

    fn add(&mut self, p: DVec3) -> u32 {
        let number = self.corners.len() as u32;
        self.corners.push(p);
        self.cells.entry(self.cell_of(p)).or_default().push(number);
        number
    }

    /// The nearest allowed corner within a distance of at most half a cell.
    fn nearest(&self, p: DVec3, max_distance: f64, allowed: impl Fn(u32) -> bool) -> Option<u32> {
        let [low, high] = [p - max_distance, p + max_distance].map(|p| self.cell_of(p));
        let mut best: Option<(f64, u32)> = None;
        for x in low[0]..=high[0] {
            for y in low[1]..=high[1] {
                for z in low[2]..=high[2] {
                    for k in self.cells.get(&[x, y, z]).into_iter().flatten() {
                        let corner_distance = self.corners[*k as usize].distance(p);
                        if corner_distance <= max_distance
                            && allowed(*k)
                            && best.is_none_or(|(best_distance, _)| corner_distance < best_distance)
                        {
                            best = Some((corner_distance, *k));
                        }
                    }
                }
            }
        }
        best.map(|(_, k)| k)
    }
}

#[cfg(test)]
mod tests {
    use glam::DQuat;

    use super::*;

    /// A stepped wedge with moved corners, rounded to a number of decimals. `flipped` splits its faces along
    /// the other diagonals.
    fn wedge_shape(
        scene: &mut Scene,
        size: [f64; 3],
        place: DAffine3,
        decimals: i32,
        flipped: bool,
    ) -> PartShape {
        let [x, y, z] = size;
        let round = |p: f64| {
            let scale = 10.0_f64.powi(decimals);
            (p * scale).round() / scale
        };
        let corners = [
            [0.0, 0.0, 0.0],
            [x, 0.0, 0.0],
            [x, y, 0.0],
            [0.0, y, 0.0],
            [0.0, 0.0, z],
            [0.4 * x, 0.0, z],
            [0.4 * x, y, z],
            [0.0, y, z],
        ];
        let positions = corners
            .map(|p| DVec3::from_array(place.transform_point3(DVec3::from_array(p)).to_array().map(round)))
            .to_vec();
        let quads = [[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];
        let of = |[a, b, c, d]: [u32; 4]| {
            if flipped { [[b, c, d], [b, d, a]] } else { [[a, b, c], [a, c, d]] }
        };
        let triangles = quads.into_iter().flat_map(of).collect();
        let step = 10.0_f64.powi(-decimals);
        scene.geometries.push(Geometry { positions, triangles, lattice_step: step, ..Geometry::default() });
        let geometry = scene.geometries.len() - 1;
        let part = Part { name: String::new(), geometry, world_from_part: DAffine3::IDENTITY };
        PartShape::of(scene, &part).unwrap()
    }

    #[test]
    fn part_shapes_are_equal_up_to_rigid_motion_and_file_precision() {
        let mut scene = Scene::default();
        let turn = DAffine3::from_rotation_translation(
            DQuat::from_euler(glam::EulerRot::XYZ, 0.7, 1.9, -2.2),
            DVec3::new(120.0, -44.0, 17.0),
        );
        let mirror = DAffine3::from_scale(DVec3::new(-1.0, 1.0, 1.0));
        let skew = DAffine3::from_scale(DVec3::new(1.0, 1.002, 1.0));
        let size = [30.0, 20.0, 11.0];
        for decimals in [3, 5, 8] {
            let own = wedge_shape(&mut scene, size, DAffine3::IDENTITY, decimals, false);
            let mut equals = |size, place, flipped| {
                let other = wedge_shape(&mut scene, size, place, decimals, flipped);
                assert_eq!(own.equals(&other), other.equals(&own));
                own.equals(&other)
            };
            assert!(equals(size, DAffine3::IDENTITY, false) && equals(size, turn, false), "{decimals}");
            assert!(equals(size, turn, true), "{decimals}: along other diagonals");
            // The wedge has a plane of symmetry, so its mirror image is the same shape.
            assert!(equals(size, turn * mirror, false), "{decimals}");
            assert!(!equals([30.0, 20.0, 11.05], turn, false), "{decimals}");
            assert!(!equals(size, turn * skew, false), "{decimals}");
            assert!(!equals([20.0, 30.0, 11.0], turn, false), "{decimals}");
        }
    }

    #[test]
    fn mirror_images_are_different_part_shapes() {
        let mut scene = Scene::default();
        let hand = [[0.0, 0.0, 0.0], [5.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 2.0]];
        let mut shape = |sign: f64| {
            let positions = hand.map(|[x, y, z]| DVec3::new(sign * x, y, z)).to_vec();
            let triangles = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
            scene.geometries.push(Geometry { positions, triangles, ..Geometry::default() });
            let geometry = scene.geometries.len() - 1;
            PartShape::of(
                &scene,
                &Part { name: String::new(), geometry, world_from_part: DAffine3::IDENTITY },
            )
            .unwrap()
        };
        let [left, right, other] = [shape(1.0), shape(-1.0), shape(1.0)];
        assert!(left.equals(&other) && !left.equals(&right));
    }
}
