//! [`DrawnPoints`]: the points that count for the size of a scene: those of faces with area and of wires with
//! length.
//!
//! Whether a face has area is decided as in the mesh: by the scale of its part, which such faces do not
//! enlarge. Most models have no degenerate faces; then one test per face is enough.

use std::borrow::Cow;
use std::ops::Range;
use std::sync::atomic::AtomicBool;
use std::sync::atomic::Ordering::Relaxed;

use crate::geometry::space::bounds::Bounds;
use crate::parallel::prelude::*;
use glam::{DAffine3, DVec3};
use rustc_hash::FxHashMap;

use super::coordinate_limits::{bounds, is_drawable};
use crate::mesh::normals::triangle_area::{has_area, has_own_area, largest_scale, scale_of};
use crate::mesh::part_metrics::origin;
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::scene::{Geometry, Part, Scene};

/// Points that are drawn, part by part.
#[derive(Debug, Clone, Default)]
pub(crate) struct DrawnPoints {
    /// World positions, each vertex of a part once.
    pub points: Vec<DVec3>,
    /// Parts that can be drawn, in scene order.
    pub parts: Vec<DrawnPart>,
}

/// Drawn points of a part.
#[derive(Debug, Clone)]
pub(crate) struct DrawnPart {
    /// Index of the part in the scene.
    #[cfg_attr(not(any(feature = "cli", feature = "page")), expect(dead_code))]
    pub part: usize,
    /// Range of its points.
    pub points: Range<usize>,
    /// Degenerate faces and wires that are left out.
    #[cfg_attr(not(feature = "cli"), expect(dead_code))]
    pub left_out: DegenerateCounts,
}

/// Counts of faces without area and wires without length.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct DegenerateCounts {
    pub faces: u64,
    pub wires: u64,
    /// First corner of the first such face, or else of the first wire, world space.
    pub first: Option<DVec3>,
}

impl DegenerateCounts {
    /// Whether nothing is left out.
    #[cfg(feature = "cli")]
    pub(crate) fn is_none(&self) -> bool {
        self.faces + self.wires == 0
    }
}

/// Instance of a geometry with a valid transform.
struct PlacedGeometry<'a> {
    part: usize,
    geometry: &'a Geometry,
    world_from_geometry: &'a DAffine3,
}

impl PlacedGeometry<'_> {
    fn at(&self, vertex: u32) -> DVec3 {
        let point = self.geometry.positions.get(vertex as usize).copied().unwrap_or_default();
        if *self.world_from_geometry == DAffine3::IDENTITY {
            point
        } else {
            self.world_from_geometry.transform_point3(point)
        }
    }

    fn corners(&self, triangle: &[u32; 3]) -> [DVec3; 3] {
        triangle.map(|vertex| self.at(vertex))
    }

    fn is_long(&self, [a, b]: &[u32; 2]) -> bool {
        self.at(*a) != self.at(*b)
    }

    /// Faces that may have no area, ascending; `scale` is at least that of the part.
    fn suspects(&self, scale: f64) -> Vec<u32> {
        let faces = self.geometry.triangles.par_iter().with_min_len(MIN_TASK_ITEMS).enumerate();
        let suspects = faces.filter(|(_, t)| !has_area(self.corners(t), scale));
        suspects.map(|(face, _)| face as u32).collect()
    }

    fn has_short_wires(&self) -> bool {
        !self.geometry.wires.iter().all(|wire| self.is_long(wire))
    }

    /// Transforms points of the geometry to world space and appends them.
    fn add(&self, points: &[DVec3], to: &mut Vec<DVec3>) {
        if *self.world_from_geometry == DAffine3::IDENTITY {
            to.extend_from_slice(points);
        } else {
            to.par_extend(
                points
                    .par_iter()
                    .with_min_len(MIN_TASK_ITEMS)
                    .map(|&p| self.world_from_geometry.transform_point3(p)),
            );
        }
    }
}

impl DrawnPoints {
    /// Collects the points of a scene.
    pub(crate) fn of(scene: &Scene) -> Self {
        Self::of_parts(scene, |_| true)
    }

    /// Collects the points of some parts of a scene.
    pub(crate) fn of_parts(scene: &Scene, is_wanted: impl Fn(&Part) -> bool) -> Self {
        let wanted = scene.parts.iter().enumerate().filter(|(_, part)| is_wanted(part));
        let placed = wanted.filter_map(|(number, part)| {
            let geometry = scene.geometry_of(part)?;
            Some(PlacedGeometry { part: number, geometry, world_from_geometry: &part.world_from_part })
        });
        Self::of_placed(placed.collect())
    }

    /// Points of a geometry, in local space.
    pub(crate) fn of_geometry(geometry: &Geometry) -> Vec<DVec3> {
        Self::of_placed(vec![PlacedGeometry { part: 0, geometry, world_from_geometry: &DAffine3::IDENTITY }])
            .points
    }

    fn of_placed(mut placed: Vec<PlacedGeometry>) -> Self {
        let mut all = Self::default();
        // Instances of a geometry share its list of used points.
        let mut points_by_geometry: FxHashMap<*const Geometry, Cow<[DVec3]>> = FxHashMap::default();
        placed.retain(|placed_geometry| {
            let first = all.points.len();
            let used = points_by_geometry
                .entry(std::ptr::from_ref(placed_geometry.geometry))
                .or_insert_with(|| used_points(placed_geometry.geometry));
            placed_geometry.add(used, &mut all.points);
            let points = all.points.get(first..).unwrap_or_default();
            // A part with coordinates that are not finite or too large is not drawn.
            let is_drawn = points.par_iter().with_min_len(MIN_TASK_ITEMS).all(|&p| is_drawable(p));
            if is_drawn {
                let points = first..all.points.len();
                all.parts.push(DrawnPart {
                    part: placed_geometry.part,
                    points,
                    left_out: DegenerateCounts::default(),
                });
            } else {
                all.points.truncate(first);
            }
            is_drawn
        });
        all.without_flat(&placed).unwrap_or(all)
    }

    /// Removes degenerate faces and wires; `None` if there are none, or no points.
    fn without_flat(&self, placed: &[PlacedGeometry]) -> Option<Self> {
        let (low, high) = bounds(&self.points)?;
        let largest = largest_scale(low, high);
        let doubtful = |placed_geometry: &PlacedGeometry| {
            let suspects = placed_geometry.suspects(largest);
            let is_whole = suspects.is_empty() && !placed_geometry.has_short_wires();
            (!is_whole).then(|| DegenerateCandidates::of(placed_geometry, suspects))
        };
        let doubtful: Vec<Option<DegenerateCandidates>> = placed.iter().map(doubtful).collect();
        if doubtful.iter().all(Option::is_none) {
            return None;
        }
        let all_bounds = |part: &DrawnPart| bounds(self.points.get(part.points.clone()).unwrap_or_default());
        let parts = || placed.iter().zip(&self.parts).zip(&doubtful);
        let boxes = parts().filter_map(|((own, part), doubtful)| match doubtful {
            Some(doubtful) => doubtful.bounds(own, has_own_area),
            None => all_bounds(part),
        });
        let (low, high) = boxes.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1))).unwrap_or((low, high));
        // From here on coordinates are relative to the origin of the mesh, as the mesh measures them.
        let origin = origin(low, high);
        let mut all = Self::default();
        for ((placement, part), doubtful) in parts() {
            let first = all.points.len();
            let mut left_out = DegenerateCounts::default();
            if let Some(doubtful) = doubtful {
                let counted = doubtful.bounds(placement, |corners| has_own_area(corners.map(|p| p - origin)));
                let scale =
                    counted.or(all_bounds(part)).map_or(0.0, |(l, h)| scale_of(l - origin, h - origin));
                let has_area = |corners: [DVec3; 3]| has_area(corners.map(|p| p - origin), scale);
                placement.add(&doubtful.counted(placement, has_area), &mut all.points);
                left_out = doubtful.left_out(placement, has_area);
            } else {
                all.points.extend_from_slice(self.points.get(part.points.clone()).unwrap_or_default());
            }
            all.parts.push(DrawnPart { part: placement.part, points: first..all.points.len(), left_out });
        }
        if all.points.is_empty() {
            // If no face has area, the camera still frames all points.
            all.points.clone_from(&self.points);
            for (part, original) in all.parts.iter_mut().zip(&self.parts) {
                part.points = original.points.clone();
            }
        }
        Some(all)
    }
}

/// A part with faces that may have no area, or with wires of zero length.
struct DegenerateCandidates {
    /// Faces that may have no area, ascending.
    suspects: Vec<u32>,
    /// For each vertex, whether another face or a wire with length uses it.
    used: Vec<bool>,
    /// Bounding box of these vertices, world space.
    around: Bounds,
}

impl DegenerateCandidates {
    fn of(placed: &PlacedGeometry, suspects: Vec<u32>) -> Self {
        let mut is_suspect = vec![false; placed.geometry.triangles.len()];
        suspects.iter().for_each(|face| is_suspect[*face as usize] = true);
        let used = used(placed.geometry, |face| !is_suspect[face], |wire| placed.is_long(wire));
        let vertices = used.par_iter().enumerate().with_min_len(MIN_TASK_ITEMS).filter(|(_, used)| **used);
        let grow = |around: Bounds, (vertex, _): (usize, &bool)| around.with(placed.at(vertex as u32));
        let around = vertices.fold(|| Bounds::EMPTY, grow).reduce(|| Bounds::EMPTY, Bounds::union);
        Self { suspects, used, around }
    }

    /// Suspect faces for which `counts` returns `wanted`.
    fn those<'a>(
        &'a self,
        placed: &'a PlacedGeometry,
        counts: impl Fn([DVec3; 3]) -> bool + 'a,
        wanted: bool,
    ) -> impl Iterator<Item = &'a [u32; 3]> {
        let faces = self.suspects.iter().map(|face| &placed.geometry.triangles[*face as usize]);
        faces.filter(move |t| counts(placed.corners(t)) == wanted)
    }

    /// Bounding box without the suspect faces for which `counts` is false, world space.
    fn bounds(&self, placed: &PlacedGeometry, counts: impl Fn([DVec3; 3]) -> bool) -> Option<(DVec3, DVec3)> {
        let real = self.those(placed, counts, true).flatten();
        let real = real.filter(|corner| (**corner as usize) < self.used.len());
        let Bounds { low, high } = self.around.union(Bounds::of(real.map(|corner| placed.at(*corner))));
        (low.x <= high.x).then_some((low, high))
    }

    /// Vertices without those of suspect faces for which `counts` is false, in local space.
    fn counted(&self, placed: &PlacedGeometry, counts: impl Fn([DVec3; 3]) -> bool) -> Vec<DVec3> {
        let mut used = self.used.clone();
        for corner in self.those(placed, counts, true).flatten() {
            if let Some(used) = used.get_mut(*corner as usize) {
                *used = true;
            }
        }
        let used_positions = placed.geometry.positions.iter().zip(used).filter(|(_, used)| *used);
        used_positions.map(|(p, _)| *p).collect()
    }

    fn left_out(&self, placed: &PlacedGeometry, has_area: impl Fn([DVec3; 3]) -> bool) -> DegenerateCounts {
        let is_short = |wire: &&[u32; 2]| !placed.is_long(wire);
        let wires = || placed.geometry.wires.iter().filter(is_short);
        let first_face = self.those(placed, &has_area, false).next().map(|t| placed.at(t[0]));
        DegenerateCounts {
            faces: self.those(placed, &has_area, false).count() as u64,
            wires: wires().count() as u64,
            first: first_face.or_else(|| wires().next().map(|wire| placed.at(wire[0]))),
        }
    }
}

/// Positions used by triangles or wires, each once; usually all.
pub(crate) fn used_points(geometry: &Geometry) -> Cow<'_, [DVec3]> {
    let used = used(geometry, |_| true, |_| true);
    if used.iter().all(|used| *used) {
        return Cow::Borrowed(&geometry.positions);
    }
    geometry.positions.iter().zip(used).filter_map(|(&p, used)| used.then_some(p)).collect()
}

/// For each position, whether a selected triangle or wire uses it.
fn used(
    geometry: &Geometry,
    faces: impl Fn(usize) -> bool + Sync,
    wires: impl Fn(&[u32; 2]) -> bool,
) -> Vec<bool> {
    let used: Vec<AtomicBool> = geometry.positions.iter().map(|_| AtomicBool::new(false)).collect();
    let mark = |corner: &u32| {
        if let Some(used) = used.get(*corner as usize) {
            used.store(true, Relaxed);
        }
    };
    let counted = geometry
        .triangles
        .par_iter()
        .with_min_len(MIN_TASK_ITEMS)
        .enumerate()
        .filter(|(face, _)| faces(*face));
    counted.for_each(|(_, corners)| corners.iter().for_each(mark));
    geometry.wires.iter().filter(|ends| wires(ends)).for_each(|ends| ends.iter().for_each(mark));
    used.into_iter().map(AtomicBool::into_inner).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::cameras::framing::world_points;

    /// A tetrahedron, and far away a face without area, a face with all corners at one point, and a wire of
    /// zero length.
    fn scene(far: f64) -> Scene {
        let at = |x: f64, y: f64| DVec3::new(far + x, far * 0.7 + y, 0.3 * far);
        let positions = vec![
            DVec3::ZERO,
            DVec3::X,
            DVec3::Y,
            DVec3::Z,
            at(0.0, 0.0),
            at(1.0, 0.5),
            at(2.0, 1.0),
            at(5.0, 5.0),
            DVec3::ONE * -far,
        ];
        let triangles = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3], [4, 5, 6], [7, 7, 7]];
        let geometry = Geometry { positions, triangles, wires: vec![[7, 7]], ..Geometry::default() };
        let part = Part { name: "a".to_owned(), geometry: 0, world_from_part: DAffine3::IDENTITY };
        Scene { geometries: vec![geometry], parts: vec![part], ..Scene::default() }
    }

    #[test]
    fn drawn_points_leave_out_faces_and_wires_of_zero_size() {
        for far in [0.5, 1e3, -1e7] {
            let scene = scene(far);
            let drawn = DrawnPoints::of(&scene);
            assert_eq!(drawn.points, [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z], "{far}");
            let left_out = drawn.parts[0].left_out;
            assert_eq!((left_out.faces, left_out.wires), (2, 1));
            assert_eq!(left_out.first, Some(scene.geometries[0].positions[4]));
            assert_eq!(scene.bounds(), Some((DVec3::ZERO, DVec3::ONE)));
            // The mesh leaves out the same elements.
            let cleaning = crate::mesh::Mesh::build(scene.to_soup()).cleaning;
            assert_eq!((cleaning.degenerate > 0, cleaning.collapsed, cleaning.short_wires), (true, 1, 1));
        }
    }

    #[test]
    fn drawn_points_include_every_instance_at_its_position() {
        let mut scene = scene(1e4);
        let place = DAffine3::from_translation(DVec3::new(3.0, 0.0, 0.0)) * DAffine3::from_rotation_z(0.4);
        scene.parts.push(Part { name: "b".to_owned(), geometry: 0, world_from_part: place });
        let mut alone = scene.clone();
        alone.geometries[0].triangles.truncate(4);
        alone.geometries[0].wires.clear();
        assert_eq!(world_points(&scene), world_points(&alone));
        let drawn = DrawnPoints::of_parts(&scene, |part| part.name == "b");
        assert_eq!((drawn.parts[0].part, drawn.points.len()), (1, 4));
    }

    #[test]
    fn world_points_of_a_scene_without_area_are_not_empty() {
        let mut scene = scene(10.0);
        scene.geometries[0].triangles.drain(..4);
        assert_eq!(world_points(&scene).len(), 4);
        assert_eq!(DrawnPoints::of(&scene).parts[0].left_out.faces, 2);
    }
}
