//! Geometries, and the parts that instance them.

use glam::{DAffine3, DVec3};

use super::tolerances;
use crate::geometry::space::triangles::area;
use crate::geometry::tolerances::F32_STEP;
use crate::mesh::EdgeMark;
use crate::mesh::normals::triangle_area::has_own_area;

/// Triangles and wires in local space.
///
/// Arrays with one entry per triangle are as long as `triangles`, or empty if the file has no such data.
#[derive(Debug, Clone, Default)]
pub struct Geometry {
    /// Vertex positions, finite.
    pub positions: Vec<DVec3>,
    /// Vertices of each triangle, counter-clockwise from outside; each below `positions.len()`. Polygons are
    /// already triangulated.
    pub triangles: Vec<[u32; 3]>,
    /// Material of each triangle, an index into [`super::Scene::materials`]. If empty, `material` applies.
    pub triangle_material: Vec<u32>,
    /// Material of the wires, and of all triangles if `triangle_material` is empty.
    pub material: Option<u32>,
    /// Normals of the file, indexed by `corner_normals`; not necessarily of unit length.
    pub normals: Vec<[f32; 3]>,
    /// Normals of each triangle's corners (`u32::MAX` = none), or empty.
    pub corner_normals: Vec<[u32; 3]>,
    /// Texture coordinates, indexed by `corner_uvs`.
    pub uvs: Vec<[f32; 2]>,
    /// Texture coordinates of each triangle's corners (`u32::MAX` = none), or empty.
    pub corner_uvs: Vec<[u32; 3]>,
    /// Linear RGBA of each vertex, not finite for a vertex without a colour; or empty.
    pub colours: Vec<[f32; 4]>,
    /// Marks of each triangle's sides 0-1, 1-2, 2-0, or empty.
    pub edge_marks: Vec<[EdgeMark; 3]>,
    /// Line segments without a face.
    pub wires: Vec<[u32; 2]>,
    /// Whether the positions were stored in single precision.
    pub single_precision: bool,
    /// Rounding step of the file's positions, in local units: a decimal of a text, or a step of integers.
    /// Zero if unknown, and for single precision.
    pub lattice_step: f64,
}

impl Geometry {
    /// Distance between neighbouring coordinates that the file could store, at its largest coordinate, in
    /// local units; 0 for double precision.
    #[must_use]
    pub fn step(&self) -> f64 {
        if !self.single_precision {
            return self.lattice_step;
        }
        self.lattice_step.max(F32_STEP * self.largest())
    }

    /// Like [`Self::step`]. For single precision it is the exact distance to the next number at the largest
    /// coordinate, not its upper bound.
    #[cfg(feature = "page")]
    #[must_use]
    pub(crate) fn finest_step(&self) -> f64 {
        if !self.single_precision {
            return self.lattice_step;
        }
        let largest = self.largest() as f32;
        self.lattice_step.max(f64::from(largest.next_up()) - f64::from(largest))
    }

    /// Coarsest step (1, 0.1, 0.01 … 0.000001) that divides all coordinates, in local units; 0 if none does.
    /// A file with few decimals may have been rounded to it.
    #[must_use]
    pub(crate) fn decimal_step(&self) -> f64 {
        let numbers = || self.positions.iter().flat_map(|p| p.to_array());
        let is_whole =
            |number: f64| (number - number.round()).abs() <= tolerances::INTEGER_ROUNDING * number.abs();
        let powers = [1.0, 10.0, 100.0, 1000.0, 10_000.0, 100_000.0, 1_000_000.0];
        let found = powers.into_iter().find(|power| numbers().all(|number| is_whole(number * power)));
        found.map_or(0.0, |power| 1.0 / power)
    }

    /// Largest absolute coordinate of faces with area and wires with length, in local units; of all positions
    /// if there are none.
    fn largest(&self) -> f64 {
        let at = |vertex: u32| self.positions.get(vertex as usize).copied().unwrap_or_default();
        let size = |vertex: u32| at(vertex).abs().max_element();
        let all = self.positions.iter().fold(DVec3::ZERO, |most, p| most.max(p.abs())).max_element();
        let reaches = |corners: &[u32; 3]| corners.iter().any(|v| size(*v) >= all);
        let counts = |corners: &[u32; 3]| has_own_area(corners.map(at));
        if self.triangles.iter().any(|corners| reaches(corners) && counts(corners)) {
            return all;
        }
        // The largest position belongs only to degenerate elements.
        let faces = self.triangles.iter().filter(|corners| counts(corners)).flatten();
        let wires = self.wires.iter().filter(|[a, b]| at(*a) != at(*b)).flatten();
        let counted = faces.chain(wires).map(|v| size(*v)).fold(0.0, f64::max);
        if counted > 0.0 { counted } else { all }
    }

    /// Linear RGBA of a vertex, if it has a colour.
    #[must_use]
    pub fn colour_of(&self, vertex: u32) -> Option<[f32; 4]> {
        self.colours.get(vertex as usize).copied().filter(|colour| colour.iter().all(|c| c.is_finite()))
    }

    /// Material of a triangle.
    #[must_use]
    pub fn material_of(&self, triangle: usize) -> Option<u32> {
        self.triangle_material.get(triangle).copied().or(self.material)
    }
}

/// One instance of a geometry.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// Name of the glTF node, OBJ object or group. Unnamed parts get the name of the mesh or `part N`. Not
    /// necessarily unique.
    pub name: String,
    /// Index into [`super::Scene::geometries`].
    pub geometry: usize,
    /// Transform from local to world space. A negative determinant reverses the winding.
    pub world_from_part: DAffine3,
}

impl Part {
    /// Area of a triangle of its geometry, world units squared; `None` if a vertex is missing.
    pub(crate) fn area_of(&self, geometry: &Geometry, triangle: usize) -> Option<f64> {
        let [a, b, c] = geometry.triangles[triangle].map(|corner| geometry.positions.get(corner as usize));
        Some(area([*a?, *b?, *c?].map(|p| self.world_from_part.transform_point3(p))))
    }
}
