//! Shapes and the parts that show them.

use glam::{DAffine3, DVec3};

use crate::geometry::numbers::tolerance::F32_STEP;
use crate::mesh::EdgeMark;
use crate::mesh::normals::triangle_area::has_own_area;

/// A shape: triangles and wires in its own space.
///
/// Arrays "per triangle" are as long as `triangles`, or empty where the file says nothing.
#[derive(Debug, Clone, Default)]
pub struct Geometry {
    /// Vertex positions, finite.
    pub positions: Vec<DVec3>,
    /// Vertices of each triangle, counter-clockwise seen from outside; each below
    /// `positions.len()`. Polygons are already triangulated.
    pub triangles: Vec<[u32; 3]>,
    /// Material of each triangle, an index into [`super::Scene::materials`]; empty: `material`.
    pub triangle_material: Vec<u32>,
    /// Material of all triangles if `triangle_material` is empty, and of the wires.
    pub material: Option<u32>,
    /// Normals of the file, to which `corner_normals` points; not necessarily of unit length.
    pub normals: Vec<[f32; 3]>,
    /// For each triangle the normals of its corners (`u32::MAX` = none), or empty.
    pub corner_normals: Vec<[u32; 3]>,
    /// Texture coordinates, to which `corner_uvs` points.
    pub uvs: Vec<[f32; 2]>,
    /// For each triangle the texture coordinates of its corners (`u32::MAX` = none), or empty.
    pub corner_uvs: Vec<[u32; 3]>,
    /// Linear RGBA of each vertex, not finite for one without a colour; or empty.
    pub colours: Vec<[f32; 4]>,
    /// For each triangle the marks of its sides 0-1, 1-2, 2-0, or empty.
    pub edge_marks: Vec<[EdgeMark; 3]>,
    /// Line segments that belong to no face.
    pub wires: Vec<[u32; 2]>,
    /// Whether the positions were stored in single precision.
    pub single_precision: bool,
    /// The step of the lattice to which the file rounded the positions, local units: a decimal of a text, a step of whole
    /// numbers; 0 where it is not known, and for single precision.
    pub lattice_step: f64,
}

impl Geometry {
    /// The distance between neighbouring coordinates that the file could have written, at its largest coordinate, local units;
    /// 0 for numbers in double precision.
    #[must_use]
    pub fn step(&self) -> f64 {
        if !self.single_precision {
            return self.lattice_step;
        }
        self.lattice_step.max(F32_STEP * self.largest())
    }

    /// The step of the coordinates as [`Self::step`], but of single precision the distance of the largest coordinate from the next
    /// number, not its upper bound.
    #[cfg(feature = "page")]
    #[must_use]
    pub(crate) fn finest_step(&self) -> f64 {
        if !self.single_precision {
            return self.lattice_step;
        }
        let largest = self.largest() as f32;
        self.lattice_step.max(f64::from(largest.next_up()) - f64::from(largest))
    }

    /// The coarsest of 1, 0.1, 0.01 and so on to 0.000001 that all coordinates are multiples of, local units; 0 if none is. A file of few decimals
    /// may have been rounded to it.
    #[must_use]
    pub(crate) fn decimal_step(&self) -> f64 {
        let numbers = || self.positions.iter().flat_map(|p| p.to_array());
        let is_whole = |number: f64| (number - number.round()).abs() <= 4.0 * f64::EPSILON * number.abs();
        let powers = [1.0, 10.0, 100.0, 1000.0, 10_000.0, 100_000.0, 1_000_000.0];
        let found = powers.into_iter().find(|power| numbers().all(|number| is_whole(number * power)));
        found.map_or(0.0, |power| 1.0 / power)
    }

    /// The largest coordinate, local units, of faces with an area and wires with a length; of all where there are none.
    fn largest(&self) -> f64 {
        let at = |vertex: u32| self.positions.get(vertex as usize).copied().unwrap_or_default();
        let size = |vertex: u32| at(vertex).abs().max_element();
        let all = self.positions.iter().fold(DVec3::ZERO, |most, p| most.max(p.abs())).max_element();
        let reaches = |corners: &[u32; 3]| corners.iter().any(|v| size(*v) >= all);
        let counts = |corners: &[u32; 3]| has_own_area(corners.map(at));
        if self.triangles.iter().any(|corners| reaches(corners) && counts(corners)) {
            return all;
        }
        // What is largest does not count.
        let faces = self.triangles.iter().filter(|corners| counts(corners)).flatten();
        let wires = self.wires.iter().filter(|[a, b]| at(*a) != at(*b)).flatten();
        let counted = faces.chain(wires).map(|v| size(*v)).fold(0.0, f64::max);
        if counted > 0.0 { counted } else { all }
    }

    /// The colour of a vertex, linear RGBA, if it has one.
    #[must_use]
    pub fn colour_of(&self, vertex: u32) -> Option<[f32; 4]> {
        self.colours.get(vertex as usize).copied().filter(|colour| colour.iter().all(|c| c.is_finite()))
    }

    /// The material of a triangle.
    #[must_use]
    pub fn material_of(&self, triangle: usize) -> Option<u32> {
        self.triangle_material.get(triangle).copied().or(self.material)
    }
}

/// One instance of a geometry.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// Name of the glTF node, OBJ object or group; unnamed parts get the name of the mesh or
    /// `part N`. Not necessarily unique.
    pub name: String,
    /// Index into [`super::Scene::geometries`].
    pub geometry: usize,
    /// Places the geometry in the world. A negative determinant turns the winding round.
    pub world_from_part: DAffine3,
}
