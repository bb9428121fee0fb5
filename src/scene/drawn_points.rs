//! [`DrawnPoints`]: the points of a scene that count in its size: those of faces with an area and of wires with a length.
//!
//! Whether a face has an area is decided as the mesh decides it, by the scale of its part, whose box does not hold such
//! faces either. Most models have none: then one look at each face is all there is to do.

use std::borrow::Cow;
use std::ops::Range;
use std::sync::atomic::AtomicBool;
use std::sync::atomic::Ordering::Relaxed;

use glam::{DAffine3, DVec3};
use rayon::prelude::*;
use rustc_hash::FxHashMap;

use super::coordinate::{bounds, is_drawable};
use super::{Geometry, Part, Scene};
use crate::math::grain::GRAIN;
use crate::mesh::area::{has_area, has_own_area, largest_scale, scale_of};
use crate::mesh::extents::origin;

/// The points that are drawn, part by part.
#[derive(Debug, Clone, Default)]
pub(crate) struct DrawnPoints {
    /// World positions, each vertex of a part once.
    pub points: Vec<DVec3>,
    /// The parts that can be drawn, in the order of the scene.
    pub parts: Vec<DrawnPart>,
}

/// What is drawn of a part.
#[derive(Debug, Clone)]
pub(crate) struct DrawnPart {
    /// Its number in the scene.
    #[cfg_attr(not(any(feature = "cli", feature = "page")), expect(dead_code))]
    pub part: usize,
    /// Its points among all.
    pub points: Range<usize>,
    /// The faces and wires of it that are left out.
    #[cfg_attr(not(feature = "cli"), expect(dead_code))]
    pub left_out: LeftOut,
}

/// Faces without area and wires without length.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct LeftOut {
    pub faces: u64,
    pub wires: u64,
    /// The first corner of the first face, or else of the first wire, world.
    pub first: Option<DVec3>,
}

impl LeftOut {
    /// Whether nothing is left out.
    #[cfg(feature = "cli")]
    pub fn is_none(&self) -> bool {
        self.faces + self.wires == 0
    }
}

/// A part that can be placed.
struct Placed<'a> {
    part: usize,
    geometry: &'a Geometry,
    place: &'a DAffine3,
}

impl Placed<'_> {
    fn at(&self, vertex: u32) -> DVec3 {
        let own = self.geometry.positions.get(vertex as usize).copied().unwrap_or_default();
        if *self.place == DAffine3::IDENTITY { own } else { self.place.transform_point3(own) }
    }

    fn corners(&self, triangle: &[u32; 3]) -> [DVec3; 3] {
        triangle.map(|vertex| self.at(vertex))
    }

    fn is_long(&self, [a, b]: &[u32; 2]) -> bool {
        self.at(*a) != self.at(*b)
    }

    /// Whether some face of it may have no area, or some wire no length; `scale` is at least that of the part.
    fn may_leave_out(&self, scale: f64) -> bool {
        let faces = self.geometry.triangles.par_iter().with_min_len(GRAIN);
        faces.any(|t| !has_area(self.corners(t), scale))
            || !self.geometry.wires.iter().all(|w| self.is_long(w))
    }

    /// The vertices of faces for which `counts` holds and of wires with a length.
    fn counted(&self, counts: impl Fn([DVec3; 3]) -> bool + Sync) -> Cow<'_, [DVec3]> {
        let faces = |t: &[u32; 3]| counts(self.corners(t));
        points_of(self.geometry, faces, |wire| self.is_long(wire))
    }

    /// Adds points of the geometry to those of the world.
    fn add(&self, own: &[DVec3], to: &mut Vec<DVec3>) {
        if *self.place == DAffine3::IDENTITY {
            to.extend_from_slice(own);
        } else {
            to.par_extend(own.par_iter().with_min_len(GRAIN).map(|&p| self.place.transform_point3(p)));
        }
    }
}

impl DrawnPoints {
    /// Those of a scene.
    pub fn of(scene: &Scene) -> Self {
        Self::of_parts(scene, |_| true)
    }

    /// Those of some of the parts of a scene.
    pub fn of_parts(scene: &Scene, is_wanted: impl Fn(&Part) -> bool) -> Self {
        let wanted = scene.parts.iter().enumerate().filter(|(_, part)| is_wanted(part));
        let placed = wanted.filter_map(|(number, part)| {
            let geometry = scene.geometry_of(part)?;
            Some(Placed { part: number, geometry, place: &part.world_from_part })
        });
        Self::of_placed(placed.collect())
    }

    /// The points of a geometry, in its own space.
    pub fn of_geometry(geometry: &Geometry) -> Vec<DVec3> {
        Self::of_placed(vec![Placed { part: 0, geometry, place: &DAffine3::IDENTITY }]).points
    }

    fn of_placed(mut placed: Vec<Placed>) -> Self {
        let mut all = Self::default();
        // Instances of a shape share the list of its points.
        let mut known: FxHashMap<*const Geometry, Cow<[DVec3]>> = FxHashMap::default();
        placed.retain(|own| {
            let first = all.points.len();
            let used =
                known.entry(std::ptr::from_ref(own.geometry)).or_insert_with(|| used_points(own.geometry));
            own.add(used, &mut all.points);
            let points = all.points.get(first..).unwrap_or_default();
            // A part with coordinates that are no finite numbers is not drawn.
            let is_drawn = points.par_iter().with_min_len(GRAIN).all(|&p| is_drawable(p));
            if is_drawn {
                let points = first..all.points.len();
                all.parts.push(DrawnPart { part: own.part, points, left_out: LeftOut::default() });
            } else {
                all.points.truncate(first);
            }
            is_drawn
        });
        all.without_flat(&placed).unwrap_or(all)
    }

    /// The same without what has neither area nor length; none if all has, or nothing.
    fn without_flat(&self, placed: &[Placed]) -> Option<Self> {
        let (low, high) = bounds(&self.points)?;
        let largest = largest_scale(low, high);
        let suspect: Vec<bool> = placed.iter().map(|own| own.may_leave_out(largest)).collect();
        if !suspect.contains(&true) {
            return None;
        }
        let whole = |part: &DrawnPart| bounds(self.points.get(part.points.clone()).unwrap_or_default());
        let boxed = |((own, part), suspect): ((&Placed, &DrawnPart), &bool)| {
            if *suspect { own.bounds(has_own_area) } else { whole(part) }
        };
        let boxes = placed.iter().zip(&self.parts).zip(&suspect).filter_map(boxed);
        let (low, high) = boxes.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1))).unwrap_or((low, high));
        // From here on as the mesh measures: relative to its origin.
        let origin = origin(low, high);
        let mut all = Self::default();
        for ((own, part), suspect) in placed.iter().zip(&self.parts).zip(suspect) {
            let first = all.points.len();
            let mut left_out = LeftOut::default();
            if suspect {
                let counted = own.bounds(|corners| has_own_area(corners.map(|p| p - origin)));
                let scale = counted.or(whole(part)).map_or(0.0, |(l, h)| scale_of(l - origin, h - origin));
                let has_area = |corners: [DVec3; 3]| has_area(corners.map(|p| p - origin), scale);
                own.add(&own.counted(has_area), &mut all.points);
                left_out = own.left_out(has_area);
            } else {
                all.points.extend_from_slice(self.points.get(part.points.clone()).unwrap_or_default());
            }
            all.parts.push(DrawnPart { part: own.part, points: first..all.points.len(), left_out });
        }
        if all.points.is_empty() {
            // Nothing has an area: a camera looks at it all the same.
            all.points.clone_from(&self.points);
            for (part, whole) in all.parts.iter_mut().zip(&self.parts) {
                part.points = whole.points.clone();
            }
        }
        Some(all)
    }
}

impl Placed<'_> {
    /// The box around what `counted` gives, world.
    fn bounds(&self, counts: impl Fn([DVec3; 3]) -> bool + Sync) -> Option<(DVec3, DVec3)> {
        let nothing = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let count = self.geometry.positions.len();
        let grow = |own: (DVec3, DVec3), corners: &[u32]| {
            let real = corners.iter().filter(|corner| (**corner as usize) < count);
            real.fold(own, |(low, high), corner| {
                let p = self.at(*corner);
                (low.min(p), high.max(p))
            })
        };
        let join = |a: (DVec3, DVec3), b: (DVec3, DVec3)| (a.0.min(b.0), a.1.max(b.1));
        let faces = self.geometry.triangles.par_iter().with_min_len(GRAIN);
        let counted = faces.filter(|t| counts(self.corners(t)));
        let of_faces = counted.fold(|| nothing, |own, t| grow(own, t)).reduce(|| nothing, join);
        let long = self.geometry.wires.iter().filter(|wire| self.is_long(wire));
        let (low, high) = long.fold(of_faces, |own, wire| grow(own, wire));
        (low.x <= high.x).then_some((low, high))
    }

    fn left_out(&self, has_area: impl Fn([DVec3; 3]) -> bool + Sync) -> LeftOut {
        let Geometry { triangles, wires, .. } = self.geometry;
        let is_flat = |t: &&[u32; 3]| !has_area(self.corners(t));
        let is_short = |wire: &&[u32; 2]| !self.is_long(wire);
        let first = triangles.iter().find(is_flat).map(|t| self.at(t[0]));
        LeftOut {
            faces: triangles.par_iter().with_min_len(GRAIN).filter(is_flat).count() as u64,
            wires: wires.iter().filter(is_short).count() as u64,
            first: first.or_else(|| wires.iter().find(is_short).map(|wire| self.at(wire[0]))),
        }
    }
}

/// The positions that triangles or wires use, each once; usually all.
pub(crate) fn used_points(geometry: &Geometry) -> Cow<'_, [DVec3]> {
    points_of(geometry, |_| true, |_| true)
}

/// The positions that some triangles and wires use.
fn points_of(
    geometry: &Geometry,
    faces: impl Fn(&[u32; 3]) -> bool + Sync,
    wires: impl Fn(&[u32; 2]) -> bool,
) -> Cow<'_, [DVec3]> {
    let used: Vec<AtomicBool> = geometry.positions.iter().map(|_| AtomicBool::new(false)).collect();
    let mark = |corner: &u32| {
        if let Some(used) = used.get(*corner as usize) {
            used.store(true, Relaxed);
        }
    };
    let counted = geometry.triangles.par_iter().with_min_len(GRAIN).filter(|corners| faces(corners));
    counted.for_each(|corners| corners.iter().for_each(mark));
    geometry.wires.iter().filter(|ends| wires(ends)).for_each(|ends| ends.iter().for_each(mark));
    if used.iter().all(|used| used.load(Relaxed)) {
        return Cow::Borrowed(&geometry.positions);
    }
    geometry.positions.iter().zip(used).filter_map(|(&p, used)| used.into_inner().then_some(p)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::framing::world_points;

    /// A tetrahedron, and far away a face without area, a face of one place and a wire without length.
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
    fn what_has_no_area_and_no_length_does_not_count() {
        for far in [0.5, 1e3, -1e7] {
            let scene = scene(far);
            let drawn = DrawnPoints::of(&scene);
            assert_eq!(drawn.points, [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z], "{far}");
            let left_out = drawn.parts[0].left_out;
            assert_eq!((left_out.faces, left_out.wires), (2, 1));
            assert_eq!(left_out.first, Some(scene.geometries[0].positions[4]));
            assert_eq!(scene.bounds(), Some((DVec3::ZERO, DVec3::ONE)));
            // The mesh leaves out the same.
            let cleaning = crate::mesh::Mesh::build(scene.to_soup()).cleaning;
            assert_eq!((cleaning.degenerate > 0, cleaning.collapsed, cleaning.short_wires), (true, 1, 1));
        }
    }

    #[test]
    fn instances_count_where_they_stand() {
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
    fn a_scene_without_any_area_is_framed_all_the_same() {
        let mut scene = scene(10.0);
        scene.geometries[0].triangles.drain(..4);
        assert_eq!(world_points(&scene).len(), 4);
        assert_eq!(DrawnPoints::of(&scene).parts[0].left_out.faces, 2);
    }
}
