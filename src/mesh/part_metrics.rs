//! [`MeshMetrics`]: size, position and tolerances of each part.
//!
//! Tolerances are fractions of the size of a part, never of the whole model, so that a part does not depend
//! on others elsewhere.

use std::cmp::Ordering;

use crate::geometry::space::bounds::Bounds;
use crate::parallel::prelude::*;
use glam::DVec3;

use super::tolerances;
use super::{FaceId, Mesh, PartId, Soup};
use crate::geometry::numbers::powers_of_two::power_of_two_above;
use crate::mesh::normals::triangle_area::{has_own_area, scale_of};
use crate::parallel::task_size::MIN_TASK_ITEMS;

/// Grid step of the mesh origin, in sizes of the model rounded up to a power of two. A coarse grid keeps the
/// origin when parts are added or removed.
const ORIGIN_STEP_OF_SIZE: f64 = 256.0;

/// Size, position and tolerances of a part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PartMetrics {
    /// Lower corner of the box, local space.
    pub low: DVec3,
    /// Upper corner of the box, local space.
    pub high: DVec3,
    /// Reference length of its tolerances, world units: the diagonal of its box, or more for a part far from
    /// the origin.
    pub scale: f64,
    /// Maximum distance of touching surfaces, within the precision of the file, world units.
    pub contact: f64,
    /// Maximum distance of vertices that are welded, world units.
    pub weld: f64,
    /// Step of its coordinates as written in the file, world units; 0 where they are exact.
    pub step: f64,
    /// Maximum displacement of a vertex by rounding, world units; 0 where coordinates are exact.
    pub rounding: f64,
    /// Extent of the part without the rest of its body.
    own_extent: OwnExtent,
}

/// Scale and box of a single part.
#[derive(Debug, Clone, Copy, PartialEq)]
struct OwnExtent {
    scale: f64,
    low: DVec3,
    high: DVec3,
}

impl PartMetrics {
    const NOTHING: Self = Self {
        low: DVec3::INFINITY,
        high: DVec3::NEG_INFINITY,
        scale: 0.0,
        contact: 0.0,
        weld: 0.0,
        step: 0.0,
        rounding: 0.0,
        own_extent: OwnExtent { scale: 0.0, low: DVec3::INFINITY, high: DVec3::NEG_INFINITY },
    };

    /// Diagonal of the box, world units.
    #[must_use]
    pub fn diagonal(&self) -> f64 {
        if self.low.x <= self.high.x { self.low.distance(self.high) } else { 0.0 }
    }

    /// Compares two parts by size, then by position. Independent of their order in the file.
    #[must_use]
    pub fn precedence(&self, other: &Self) -> Ordering {
        let place = |own: &OwnExtent| [own.low.to_array(), own.high.to_array()];
        let by_place =
            || place(&self.own_extent).partial_cmp(&place(&other.own_extent)).unwrap_or(Ordering::Equal);
        self.own_extent.scale.total_cmp(&other.own_extent.scale).then_with(by_place)
    }

    /// Middle of the box, local space.
    #[must_use]
    pub fn middle(&self) -> DVec3 {
        if self.low.x <= self.high.x { self.low / 2.0 + self.high / 2.0 } else { DVec3::ZERO }
    }
}

/// Extents of all parts of a mesh.
#[derive(Debug, Clone, Default)]
pub(crate) struct MeshMetrics {
    part_metrics: Vec<PartMetrics>,
    /// Centre of the box around everything, local space. Only for searches whose result does not depend on
    /// it.
    pub middle: DVec3,
    /// Diagonal of the same box. Only for searches.
    pub diagonal: f64,
    /// Centre and diagonal of the box around everything except faces without area. Includes these if there
    /// are no others.
    counted: (DVec3, f64),
}

impl MeshMetrics {
    /// Extents of the parts of a soup with positions relative to `origin`.
    ///
    /// With `has_flat_faces`, faces without area do not count for the extent of their part, unless it has no
    /// others.
    pub(crate) fn new(soup: &Soup, origin: DVec3, has_flat_faces: bool) -> Self {
        let mut extents = Self::of_all(soup, |_| true);
        if has_flat_faces {
            let counted = Self::of_all(soup, has_own_area);
            if counted.part_metrics.iter().any(|part| part.low.x <= part.high.x) {
                extents.counted = counted.counted;
            }
            for (own, counted) in extents.part_metrics.iter_mut().zip(counted.part_metrics) {
                // A part with only such faces keeps their box.
                *own = if counted.low.x <= counted.high.x { counted } else { *own };
            }
        }
        for (part, extent) in extents.part_metrics.iter_mut().enumerate() {
            let step = soup.steps.get(part).copied().unwrap_or_default();
            extent.measure(origin, soup.single_precision, step);
        }
        extents
    }

    /// Boxes of all parts, from the triangles with `counts` and the wires with a length.
    fn of_all(soup: &Soup, counts: impl Fn([DVec3; 3]) -> bool + Sync) -> Self {
        let part = |face: usize| soup.triangle_part.get(face).copied().unwrap_or_default();
        type Boxes = Vec<(PartId, Bounds)>;
        let grow = |boxes: &mut Boxes, part: PartId, vertices: &[u32]| {
            if boxes.last().is_none_or(|last| last.0 != part) {
                boxes.push((part, Bounds::EMPTY));
            }
            if let Some((_, around)) = boxes.last_mut() {
                *around = around.union(Bounds::of(vertices.iter().map(|v| soup.positions[*v as usize])));
            }
        };
        let of_faces: Vec<Boxes> = soup
            .triangles
            .par_chunks(MIN_TASK_ITEMS)
            .enumerate()
            .map(|(chunk, faces)| {
                let mut boxes = Boxes::new();
                for (i, t) in faces.iter().enumerate() {
                    if counts(t.map(|v| soup.positions[v as usize])) {
                        grow(&mut boxes, part(chunk * MIN_TASK_ITEMS + i), t);
                    }
                }
                boxes
            })
            .collect();
        let mut boxes = of_faces.concat();
        soup.wires.iter().for_each(|wire| grow(&mut boxes, wire.part, &wire.vertices));

        let mut all = PartMetrics::NOTHING;
        let count = boxes.iter().map(|(part, _)| part.index() + 1).max().unwrap_or(0);
        let mut of_part = vec![PartMetrics::NOTHING; count];
        for (part, Bounds { low, high }) in boxes {
            for extent in [&mut of_part[part.index()], &mut all] {
                (extent.low, extent.high) = (extent.low.min(low), extent.high.max(high));
            }
        }
        let (middle, diagonal) = (all.middle(), all.diagonal());
        Self { part_metrics: of_part, middle, diagonal, counted: (middle, diagonal) }
    }

    /// Extent of a part; empty for a part without faces and wires.
    #[must_use]
    pub(crate) fn part(&self, part: PartId) -> &PartMetrics {
        self.part_metrics.get(part.index()).unwrap_or(&PartMetrics::NOTHING)
    }

    /// Extents of all parts.
    #[must_use]
    pub(crate) fn all(&self) -> &[PartMetrics] {
        &self.part_metrics
    }

    /// Rank of each part in the order of [`PartMetrics::precedence`]. Equal parts keep the order of the file.
    #[must_use]
    pub(crate) fn ranks(&self) -> Vec<u32> {
        let mut order: Vec<u32> = (0..self.part_metrics.len() as u32).collect();
        order.sort_by(|a, b| self.part_metrics[*a as usize].precedence(&self.part_metrics[*b as usize]));
        let mut ranks = vec![0; order.len()];
        for (rank, part) in (0..).zip(order) {
            ranks[part as usize] = rank;
        }
        ranks
    }

    /// Whether the coordinates of any part are rounded.
    #[must_use]
    pub(crate) fn is_rounded(&self) -> bool {
        self.part_metrics.iter().any(|part| part.rounding > 0.0)
    }

    /// Bounding sphere of all vertices: centre in local space, and radius. Both are rounded, so that they
    /// rarely change when parts are added, removed or moved.
    #[must_use]
    pub(crate) fn ball(&self) -> (DVec3, f64) {
        ball(self.middle, self.diagonal)
    }

    /// Same, without faces that have no area, unless there are no others. Use it for everything visible in a
    /// drawing.
    #[must_use]
    pub(crate) fn counted_ball(&self) -> (DVec3, f64) {
        ball(self.counted.0, self.counted.1)
    }

    /// Diagonal of the box around everything except faces without area.
    #[must_use]
    pub(crate) fn counted_diagonal(&self) -> f64 {
        self.counted.1
    }
}

impl MeshMetrics {
    /// Gives each part the extent of its body, the union of its parts. The order of parts still depends on
    /// their own sizes.
    pub(crate) fn united(mut self, bodies: &[PartId], origin: DVec3, single_precision: bool) -> Self {
        if bodies.is_empty() {
            return self;
        }
        let mut of_body = vec![PartMetrics::NOTHING; self.part_metrics.len()];
        for (extent, body) in self.part_metrics.iter().zip(bodies) {
            let own = &mut of_body[body.index()];
            (own.low, own.high) = (own.low.min(extent.low), own.high.max(extent.high));
            own.step = own.step.max(extent.step);
        }
        of_body.iter_mut().for_each(|extent| extent.measure(origin, single_precision, extent.step));
        for (extent, body) in self.part_metrics.iter_mut().zip(bodies) {
            *extent = PartMetrics { own_extent: extent.own_extent, ..of_body[body.index()] };
        }
        self
    }
}

/// Rounded sphere around a box.
fn ball(middle: DVec3, diagonal: f64) -> (DVec3, f64) {
    if diagonal == 0.0 {
        return (middle, 1.0);
    }
    let step = power_of_two_above(diagonal) / 8.0;
    let middle = (middle / step).round() * step;
    // Rounding moves the centre by at most half a step along each axis.
    let least = diagonal / 2.0 + step;
    let quarter = step / 2.0;
    (middle, (least / quarter).ceil() * quarter)
}

impl PartMetrics {
    fn measure(&mut self, origin: DVec3, single_precision: bool, step: f64) {
        if self.low.x > self.high.x {
            return;
        }
        self.scale = scale_of(self.low, self.high);
        let (low, high) = (self.low + origin, self.high + origin);
        let largest = low.abs().max(high.abs()).max_element();
        let written = if single_precision { tolerances::WELD_OF_F32_COORDINATE * largest } else { 0.0 };
        self.weld = (tolerances::WELD_OF_PART * self.scale).max(written);
        // Placing a part in the world rounds its coordinates again.
        let of_single = if single_precision { crate::geometry::tolerances::F32_STEP * largest } else { 0.0 };
        self.step = step.max(of_single);
        // A visible lattice is the intended shape.
        let step = if step <= tolerances::MAX_ROUNDED_STEP_OF_SIZE * self.diagonal() { step } else { 0.0 };
        let rounding = (tolerances::MAX_LATTICE_ROUNDING_STEPS * step)
            .max(tolerances::MAX_F32_ROUNDING_STEPS * of_single);
        self.rounding = rounding.min(tolerances::MAX_CONTACT_OF_PART * self.scale);
        let between =
            (2.0 * written).max(2.0 * self.rounding).min(tolerances::MAX_CONTACT_OF_PART * self.scale);
        self.contact = (tolerances::CONTACT_OF_PART * self.scale).max(between);
        self.own_extent = OwnExtent { scale: self.scale, low: self.low, high: self.high };
    }
}

/// Origin of a mesh with the given box. It is zero, unless the model is far from zero for its size. It lies
/// on a coarse grid, so that the subtraction is exact.
pub(crate) fn origin(low: DVec3, high: DVec3) -> DVec3 {
    let middle = low / 2.0 + high / 2.0;
    let size = low.distance(high);
    if size == 0.0 {
        return middle + DVec3::ZERO;
    }
    let step = ORIGIN_STEP_OF_SIZE * power_of_two_above(size);
    // Adding zero turns -0 into +0.
    (middle / step).round() * step + DVec3::ZERO
}

impl Mesh {
    /// The extent of the part that a face belongs to.
    #[inline]
    #[must_use]
    pub fn extent(&self, face: FaceId) -> &PartMetrics {
        self.extents.part(self.face_part[face.index()])
    }
}

#[cfg(test)]
mod tests {
    use super::super::{MaterialId, Wire};
    use super::*;

    #[test]
    fn origin_is_zero_for_near_models_and_close_to_far_ones() {
        let at = |x: f64| origin(DVec3::new(x, 0.0, 0.0), DVec3::new(x + 1.0, 1.0, 1.0));
        assert_eq!(at(-0.3), DVec3::ZERO);
        assert_eq!(at(100.0), DVec3::ZERO);
        let far = at(1e6 + 0.3);
        assert!((far.x - 1e6).abs() <= 256.5 && far.x % 512.0 == 0.0 && far.y == 0.0, "{far}");
        assert_eq!(at(1e6 + 0.3), at(1e6 + 40.3));
    }

    #[test]
    fn part_extents_do_not_depend_on_other_parts() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let soup = |far: f64| Soup {
            positions: corners.into_iter().chain(corners.map(|p| p * 3.0 + DVec3::Z * far)).collect(),
            triangles: vec![[0, 1, 2], [3, 4, 5]],
            triangle_part: vec![PartId(0), PartId(2)],
            ..Soup::default()
        };
        let (near, far) = (Mesh::build(soup(2.0)), Mesh::build(soup(7.0)));
        assert_eq!(near.extents.part(PartId(0)), far.extents.part(PartId(0)));
        assert_eq!(near.extents.part(PartId(0)).scale, 2.0_f64.sqrt());
        assert_eq!(near.extents.part(PartId(2)).scale, 18.0_f64.sqrt());
        for part in [1, 9] {
            assert_eq!(near.extents.part(PartId(part)).scale, 0.0);
        }
        let (middle, radius) = far.extents.ball();
        assert!(far.positions.iter().all(|p| p.distance(middle) <= radius));
    }

    #[test]
    fn part_extents_ignore_faces_without_area_and_wires_without_length() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let far = [[1e6, 0.0, 0.0], [1e6 + 1.0, 0.0, 0.0], [1e6 + 2.0, 0.0, 0.0]].map(DVec3::from_array);
        // Once the model is far from zero, and once the flat face.
        for shift in [DVec3::ZERO, DVec3::new(-1e6, 0.0, 0.0)] {
            let wire = Wire { vertices: [5, 5], part: PartId(0), material: MaterialId(0) };
            let soup = |triangles: &[[u32; 3]], parts: &[PartId]| Soup {
                positions: corners.into_iter().chain(far).map(|p| p + shift).collect(),
                triangles: triangles.to_vec(),
                triangle_part: parts.to_vec(),
                wires: vec![wire],
                ..Soup::default()
            };
            let plain = Mesh::build(soup(&[[0, 1, 2]], &[PartId(0)]));
            let flat = Mesh::build(soup(&[[0, 1, 2], [3, 4, 5]], &[PartId(0); 2]));
            assert_eq!(plain.extents.part(PartId(0)), flat.extents.part(PartId(0)), "{shift}");
            assert_eq!((plain.origin, flat.cleaning.degenerate > 0), (flat.origin, true));
            // A part with only such faces.
            let apart = Mesh::build(soup(&[[0, 1, 2], [3, 4, 5]], &[PartId(0), PartId(1)]));
            assert_eq!(plain.extents.part(PartId(0)), apart.extents.part(PartId(0)));
            assert_eq!(apart.extents.part(PartId(1)).diagonal(), 2.0);
            assert_eq!(plain.extents.counted_ball(), flat.extents.counted_ball());
            let (middle, radius) = flat.extents.ball();
            assert!(flat.positions.iter().all(|p| p.distance(middle) <= radius));
        }
    }
}
