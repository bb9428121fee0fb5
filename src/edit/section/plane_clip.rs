//! [`clip`]: part of a shape behind a plane, and the open edges along the plane.
//!
//! Each vertex is classified once for all its faces: in front, behind, or on the plane. Vertices on the plane
//! are moved onto it exactly. Triangles with a vertex behind are kept or clipped, so no triangle is cut along
//! its own side. Triangles in the plane are listed separately, for [`caps`](super::section_caps::caps).
//! Vertices at the same position count as one, and an edge is cut once for all its faces.

use glam::{DAffine3, DVec3};
use rustc_hash::FxHashMap;

use super::plane::Plane;
use super::plane_sides::side;
use super::seam_division::{bits, push_interpolated};
use crate::mesh::EdgeMark;
use crate::scene::Geometry;

/// Remaining part of a shape.
#[derive(Debug, Default)]
pub(crate) struct Clipped {
    /// The remaining shape, world space.
    pub geometry: Geometry,
    /// Vertex of each node of the open edges.
    pub nodes: Vec<u32>,
    /// Open edges as pairs of nodes, in the direction of their faces, with the net number of faces.
    pub open: Vec<([u32; 2], i32)>,
    /// Triangles in the plane.
    pub flat: Vec<CoplanarFace>,
}

/// Triangle in the plane.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CoplanarFace {
    /// Index of the triangle in the shape.
    pub triangle: usize,
    /// Corners as nodes, counter-clockwise as seen from outside in world space.
    pub nodes: [u32; 3],
}

/// Corner of a clipped triangle: an original corner, or the cut on the side after a corner.
#[derive(Clone, Copy)]
enum OutlineCorner {
    Own(usize),
    Between(usize),
}

/// Part of a shape behind a plane, world space. Vertices with the same entry in `joined` count as one.
pub(crate) fn clip(
    shape: &Geometry,
    place: &DAffine3,
    (plane, reach): (&Plane, f64),
    joined: Option<&[u32]>,
) -> Clipped {
    let turned = place.matrix3.determinant() < 0.0;
    let mut made = Clipper::new(shape, place, (plane, reach), joined);
    for triangle in 0..shape.triangles.len() {
        made.triangle(triangle, turned);
    }
    for wire in &shape.wires {
        made.wire(*wire);
    }
    made.finish()
}

struct Clipper<'a> {
    shape: &'a Geometry,
    plane: &'a Plane,
    /// Representative of each vertex among all at its position.
    one: Vec<u32>,
    sides: Vec<i8>,
    to: Clipped,
    node_of: FxHashMap<[u32; 2], u32>,
    edges: Vec<([u32; 2], i32)>,
    has_marks: bool,
}

impl<'a> Clipper<'a> {
    fn new(
        shape: &'a Geometry,
        place: &DAffine3,
        (plane, reach): (&'a Plane, f64),
        joined: Option<&[u32]>,
    ) -> Self {
        let world: Vec<DVec3> =
            shape.positions.iter().map(|p| place.transform_point3(*p) + DVec3::ZERO).collect();
        let one = joined.map_or_else(|| first_at_position(&world), <[u32]>::to_vec);
        let mut positions: Vec<DVec3> = one.iter().map(|v| world[*v as usize]).collect();
        let sides: Vec<i8> = positions.iter().map(|p| side(plane, *p, reach)).collect();
        for (p, _) in positions.iter_mut().zip(&sides).filter(|(_, side)| **side == 0) {
            *p = plane.nearest(*p);
        }
        let turn = place.matrix3.inverse().transpose();
        let normal = |&[x, y, z]: &[f32; 3]| {
            let normal = turn * DVec3::new(x.into(), y.into(), z.into());
            normal.try_normalize().unwrap_or_default().as_vec3().to_array()
        };
        let geometry = Geometry {
            positions,
            material: shape.material,
            normals: shape.normals.iter().map(normal).collect(),
            uvs: shape.uvs.clone(),
            colours: shape.colours.clone(),
            single_precision: shape.single_precision,
            lattice_step: shape.lattice_step,
            ..Geometry::default()
        };
        Self {
            shape,
            plane,
            one,
            sides,
            to: Clipped { geometry, ..Clipped::default() },
            node_of: FxHashMap::default(),
            edges: Vec::new(),
            has_marks: !shape.edge_marks.is_empty(),
        }
    }

    fn side(&self, v: u32) -> i8 {
        self.sides.get(v as usize).copied().unwrap_or(1)
    }

    fn triangle(&mut self, index: usize, turned: bool) {
        let corners = self.shape.triangles[index];
        let sides = corners.map(|v| self.side(v));
        if sides == [0; 3] {
            let nodes = [0, 1, 2].map(|k| self.node(corners, OutlineCorner::Own(k), corners[k]));
            if let [Some(a), Some(b), Some(c)] = nodes {
                let nodes = if turned { [a, c, b] } else { [a, b, c] };
                self.to.flat.push(CoplanarFace { triangle: index, nodes });
            }
            return;
        }
        if !sides.contains(&-1) {
            return;
        }
        let mut outline: Vec<OutlineCorner> = Vec::with_capacity(4);
        for k in 0..3 {
            if sides[k] <= 0 {
                outline.push(OutlineCorner::Own(k));
            }
            if sides[k] * sides[(k + 1) % 3] < 0 {
                outline.push(OutlineCorner::Between(k));
            }
        }
        let vertices: Vec<u32> = outline.iter().map(|corner| self.vertex(corners, *corner)).collect();
        let nodes: Vec<Option<u32>> =
            outline.iter().zip(&vertices).map(|(corner, v)| self.node(corners, *corner, *v)).collect();
        for k in 0..outline.len() {
            let next = (k + 1) % outline.len();
            if let (Some(a), Some(b)) = (nodes[k], nodes[next])
                && a != b
            {
                let [a, b] = if turned { [b, a] } else { [a, b] };
                self.edges.push(([a.min(b), a.max(b)], if a < b { 1 } else { -1 }));
            }
        }
        let normals = self.attribute(index, &outline, true);
        let uvs = self.attribute(index, &outline, false);
        for k in 1..outline.len().saturating_sub(1) {
            self.add(index, [0, k, k + 1], &outline, &vertices, (&normals, &uvs), turned);
        }
    }

    /// Adds a triangle of a clipped outline.
    fn add(
        &mut self,
        index: usize,
        of: [usize; 3],
        outline: &[OutlineCorner],
        vertices: &[u32],
        (normals, uvs): (&[u32], &[u32]),
        turned: bool,
    ) {
        let order = if turned { [of[0], of[2], of[1]] } else { of };
        let to = &mut self.to.geometry;
        to.triangles.push(order.map(|k| vertices[k]));
        if !self.shape.triangle_material.is_empty() {
            to.triangle_material.push(self.shape.material_of(index).unwrap_or_default());
        }
        if !self.shape.corner_normals.is_empty() {
            to.corner_normals.push(order.map(|k| normals[k]));
        }
        if !self.shape.corner_uvs.is_empty() {
            to.corner_uvs.push(order.map(|k| uvs[k]));
        }
        let marks = self.shape.edge_marks.get(index);
        let mark = |from: usize, to: usize| {
            let [low, high] = [from.min(to), from.max(to)];
            let is_side = high == low + 1 || (low == 0 && high + 1 == outline.len());
            let (first, next) = if high == low + 1 { (low, high) } else { (high, low) };
            let side = match (outline[first], outline[next]) {
                _ if !is_side => return EdgeMark::Hidden,
                (OutlineCorner::Own(k), OutlineCorner::Own(n)) if n == (k + 1) % 3 => k,
                (OutlineCorner::Own(k), OutlineCorner::Between(n)) if n == k => k,
                (OutlineCorner::Between(k), OutlineCorner::Own(n)) if n == (k + 1) % 3 => k,
                // The side along the cut.
                _ => return EdgeMark::Unmarked,
            };
            marks.map_or(EdgeMark::Unmarked, |marks| marks[side])
        };
        to.edge_marks.push([mark(order[0], order[1]), mark(order[1], order[2]), mark(order[2], order[0])]);
    }

    fn wire(&mut self, [a, b]: [u32; 2]) {
        let (from, to) = (self.side(a), self.side(b));
        if from <= 0 && to <= 0 {
            self.to.geometry.wires.push([a, b]);
        } else if from * to < 0 {
            let (p, _) = self.crossing([a, b]);
            let cut = self.to.geometry.positions.len() as u32;
            self.to.geometry.positions.push(p);
            let colour = self.to.geometry.colours.get(a as usize).copied();
            self.to.geometry.colours.extend(colour);
            self.to.geometry.wires.push(if from < 0 { [a, cut] } else { [cut, b] });
        }
    }

    /// Cut point of an edge, equal for all its faces, and its parameter from the first end.
    fn crossing(&self, [a, b]: [u32; 2]) -> (DVec3, f64) {
        let [a, b] = [a, b].map(|v| self.one[v as usize]);
        let at = |v: u32| self.to.geometry.positions[v as usize];
        if a < b {
            self.plane.crossing(at(a), at(b))
        } else {
            let (p, t) = self.plane.crossing(at(b), at(a));
            (p, 1.0 - t)
        }
    }

    fn ends(corners: [u32; 3], k: usize) -> [u32; 2] {
        [corners[k], corners[(k + 1) % 3]]
    }

    /// Vertex of a corner.
    fn vertex(&mut self, corners: [u32; 3], corner: OutlineCorner) -> u32 {
        let k = match corner {
            OutlineCorner::Own(k) => return corners[k],
            OutlineCorner::Between(k) => k,
        };
        let ends = Self::ends(corners, k);
        let [a, b] = ends.map(|v| self.one[v as usize]);
        let has_colours = !self.to.geometry.colours.is_empty();
        if let Some(node) = self.node_of.get(&[a.min(b), a.max(b)]).filter(|_| !has_colours) {
            return self.to.nodes[*node as usize];
        }
        let (p, t) = self.crossing(ends);
        let geometry = &mut self.to.geometry;
        geometry.positions.push(p);
        if has_colours {
            let colour = |v: u32| geometry.colours.get(v as usize).copied().unwrap_or([1.0; 4]);
            let (from, to) = (colour(ends[0]), colour(ends[1]));
            let t = t as f32;
            let mixed = std::array::from_fn(|c| from[c] + (to[c] - from[c]) * t);
            geometry.colours.resize(geometry.positions.len() - 1, [1.0; 4]);
            geometry.colours.push(mixed);
        }
        geometry.positions.len() as u32 - 1
    }

    /// Node of a corner on the plane; none for other corners.
    fn node(&mut self, corners: [u32; 3], corner: OutlineCorner, vertex: u32) -> Option<u32> {
        let key = match corner {
            OutlineCorner::Own(k) if self.side(corners[k]) == 0 => [self.one[corners[k] as usize]; 2],
            OutlineCorner::Own(_) => return None,
            OutlineCorner::Between(k) => {
                let [a, b] = Self::ends(corners, k).map(|v| self.one[v as usize]);
                [a.min(b), a.max(b)]
            }
        };
        let nodes = &mut self.to.nodes;
        Some(*self.node_of.entry(key).or_insert_with(|| {
            nodes.push(vertex);
            nodes.len() as u32 - 1
        }))
    }

    /// Normals or texture coordinates of the corners of an outline, as indices.
    fn attribute(&mut self, index: usize, outline: &[OutlineCorner], normals: bool) -> Vec<u32> {
        let stored = if normals { &self.shape.corner_normals } else { &self.shape.corner_uvs };
        let Some(own) = stored.get(index).copied() else { return vec![u32::MAX; outline.len()] };
        let corners = self.shape.triangles[index];
        let mut found = Vec::with_capacity(outline.len());
        for corner in outline {
            let k = match corner {
                OutlineCorner::Own(k) => {
                    found.push(own[*k]);
                    continue;
                }
                OutlineCorner::Between(k) => *k,
            };
            let (_, t) = self.crossing(Self::ends(corners, k));
            let (t, [from, to]) = (t as f32, Self::ends(own, k));
            let geometry = &mut self.to.geometry;
            found.push(if normals {
                push_interpolated(&mut geometry.normals, from, to, t)
            } else {
                push_interpolated(&mut geometry.uvs, from, to, t)
            });
        }
        found
    }

    fn finish(mut self) -> Clipped {
        self.edges.sort_by_key(|(ends, _)| *ends);
        for same in self.edges.chunk_by(|a, b| a.0 == b.0) {
            let ([a, b], net) = (same[0].0, same.iter().map(|(_, way)| way).sum::<i32>());
            match net {
                0 => {}
                1.. => self.to.open.push(([a, b], net)),
                _ => self.to.open.push(([b, a], -net)),
            }
        }
        // Without marks in the file only the cut needs marks. They are added with the cap.
        if !self.has_marks && self.to.open.is_empty() {
            self.to.geometry.edge_marks.clear();
        }
        self.to
    }
}

/// Adds a triangle in the plane to the remaining shape: unchanged, or as a piece with other corners. A piece
/// has no normals and texture coordinates.
pub(crate) fn add_flat(
    to: &mut Geometry,
    shape: &Geometry,
    index: usize,
    piece: Option<([u32; 3], [EdgeMark; 3])>,
    turned: bool,
) {
    let order = if turned { [0, 2, 1] } else { [0, 1, 2] };
    let own = shape.triangles[index];
    to.edge_marks.resize(to.triangles.len(), [EdgeMark::Unmarked; 3]);
    to.triangles.push(piece.map_or(order.map(|k| own[k]), |(corners, _)| corners));
    if !shape.triangle_material.is_empty() {
        to.triangle_material.push(shape.material_of(index).unwrap_or_default());
    }
    for (to, stored) in
        [(&mut to.corner_normals, &shape.corner_normals), (&mut to.corner_uvs, &shape.corner_uvs)]
    {
        if let Some(own) = stored.get(index) {
            to.push(if piece.is_some() { [u32::MAX; 3] } else { order.map(|k| own[k]) });
        }
    }
    let marks = shape.edge_marks.get(index).copied().unwrap_or_default();
    let sides = if turned { [marks[2], marks[1], marks[0]] } else { marks };
    to.edge_marks.push(piece.map_or(sides, |(_, marks)| marks));
}

/// First vertex at the position of each vertex.
pub(crate) fn first_at_position(positions: &[DVec3]) -> Vec<u32> {
    let mut known: FxHashMap<[u64; 3], u32> = FxHashMap::default();
    known.reserve(positions.len());
    positions.iter().enumerate().map(|(v, p)| *known.entry(bits(*p)).or_insert(v as u32)).collect()
}
