//! Cuts one triangle along the borders of an opacity mask and keeps the opaque pieces.
//!
//! 1. The corners, the crossings of borders with the sides, and the borders themselves form a constrained
//!    Delaunay triangulation in the texel plane.
//! 2. Its faces are grouped into components that no constraint separates.
//! 3. A component remains if it lies on the opaque side of its borders.
//!
//! Crossings come from the caller, computed once per side, so that neighbouring triangles still meet after
//! the cut.

use glam::DVec2;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation as _};

use super::opacity_mask::OpacityMask;
use crate::scene::textures::texel_plane::side_crossings::{TexelSide, doubled_area};
use crate::scene::textures::texel_plane::texel_borders::BorderSegment;

/// Position of a piece's vertex on the original triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum PieceVertex {
    /// At a corner.
    Corner(u8),
    /// On the side after a corner, at the crossing with this index.
    Side(u8, u32),
    /// Inside, in barycentric coordinates.
    Inside([f64; 3]),
}

/// A triangle in the texel plane, with the border crossings on its sides.
pub(crate) struct TexelTriangle<'a> {
    pub corners: [DVec2; 3],
    /// Side after each corner.
    pub sides: [TexelSide; 3],
    /// Crossings on each side, including those of the neighbours: ascending positions, 0 to 1.
    pub crossings: [&'a [f64]; 3],
}

/// Remaining pieces of a triangle: their vertices, and triangles with the orientation of the original.
#[derive(Debug, Default)]
pub(crate) struct TrianglePieces {
    pub places: Vec<PieceVertex>,
    pub triangles: Vec<[u32; 3]>,
}

type CutTriangulation = ConstrainedDelaunayTriangulation<Point2<f64>>;

/// A triangulation under construction.
#[derive(Default)]
struct TriangulationBuilder {
    faces: CutTriangulation,
    /// Position of each vertex on the original triangle.
    piece_vertices: Vec<PieceVertex>,
}

type VertexHandle = spade::handles::FixedVertexHandle;

const UNASSIGNED: u32 = u32::MAX;

impl TexelTriangle<'_> {
    /// Cuts the triangle and returns the opaque pieces, or all pieces without a mask. `None` if the
    /// triangulation fails.
    pub(crate) fn cut(
        &self,
        borders: &[BorderSegment],
        mask: Option<&OpacityMask>,
    ) -> Option<TrianglePieces> {
        let mut net = TriangulationBuilder::default();
        let corners = self.add_sides(&mut net)?;
        let mut drawn = Vec::new();
        for border in borders {
            self.add_border(&mut net, &corners, *border, &mut drawn)?;
        }
        let TriangulationBuilder { faces: net, piece_vertices: places } = net;
        let (component, count) = components(&net);
        let is_kept_face = self.kept(&net, &component, count, &drawn, mask);
        let turned = doubled_area(self.corners[0], self.corners[1], self.corners[2]) < 0.0;
        let mut pieces = TrianglePieces::default();
        let mut number = vec![UNASSIGNED; net.num_vertices()];
        for face in net.inner_faces().filter(|face| is_kept_face[face.index()]) {
            let mut triangle = face.vertices().map(|vertex| {
                let number = &mut number[vertex.index()];
                if *number == UNASSIGNED {
                    *number = pieces.places.len() as u32;
                    pieces.places.push(places[vertex.index()]);
                }
                *number
            });
            if turned {
                triangle.swap(1, 2);
            }
            pieces.triangles.push(triangle);
        }
        Some(pieces)
    }

    /// Adds corners and crossings and constrains the outline. Returns the vertices of each side, ends
    /// included.
    fn add_sides(&self, net: &mut TriangulationBuilder) -> Option<[Vec<VertexHandle>; 3]> {
        let mut corners = Vec::with_capacity(3);
        for (k, corner) in self.corners.iter().enumerate() {
            corners.push(net.insert(*corner, PieceVertex::Corner(k as u8))?);
        }
        let mut rows: [Vec<VertexHandle>; 3] = Default::default();
        for (k, row) in rows.iter_mut().enumerate() {
            let side = self.sides[k];
            let (first, last) = (corners[k], corners[(k + 1) % 3]);
            let is_forward = side.from == self.corners[k];
            row.push(if is_forward { first } else { last });
            for (number, part) in self.crossings[k].iter().enumerate() {
                let at = side.from + (side.to - side.from) * *part;
                row.push(net.insert(at, PieceVertex::Side(k as u8, number as u32))?);
            }
            row.push(if is_forward { last } else { first });
        }
        for row in &rows {
            for pair in row.windows(2) {
                net.join(pair[0], pair[1]);
            }
        }
        Some(rows)
    }

    /// Adds the part of a border inside the triangle as constraints, and records them in `drawn`.
    fn add_border(
        &self,
        net: &mut TriangulationBuilder,
        rows: &[Vec<VertexHandle>; 3],
        border: BorderSegment,
        drawn: &mut Vec<[VertexHandle; 2]>,
    ) -> Option<()> {
        let mut crossing_vertices: Vec<(f64, VertexHandle)> = Vec::new();
        for (k, side) in self.sides.iter().enumerate() {
            let Some((part, along)) = side.crossing(border) else { continue };
            let side_crossings = self.crossings[k];
            let nearest = match part {
                0.0 => 0,
                1.0 => side_crossings.len() + 1,
                _ => {
                    let after = side_crossings.partition_point(|other| *other < part);
                    let is_before = after > 0
                        && side_crossings
                            .get(after)
                            .is_none_or(|next| part - side_crossings[after - 1] < *next - part);
                    after + usize::from(!is_before)
                }
            };
            crossing_vertices.push((along, *rows[k].get(nearest)?));
        }
        for (end, along) in [(border[0], 0.0), (border[1], 1.0)] {
            if self.sides.iter().all(|side| side.admits(end)) {
                crossing_vertices.push((along, net.insert(end, PieceVertex::Inside(self.shares(end)))?));
            }
        }
        crossing_vertices.sort_by(|a, b| a.0.total_cmp(&b.0));
        for pair in crossing_vertices.chunks_exact(2) {
            let [from, to] = [pair[0].1, pair[1].1];
            if net.join(from, to) {
                drawn.push([from, to]);
            }
        }
        Some(())
    }

    /// Barycentric coordinates of a point of the texel plane.
    fn shares(&self, p: DVec2) -> [f64; 3] {
        let [a, b, c] = self.corners;
        let shares = [doubled_area(b, c, p), doubled_area(c, a, p), doubled_area(a, b, p)];
        let area_sum: f64 = shares.iter().sum();
        shares.map(|share| share / area_sum)
    }

    /// Which faces remain: those of components on the opaque (left) side of a border.
    ///
    /// Components without a border take the mask's value at the triangle's centre. If borders contradict each
    /// other, the mask decides for each face.
    fn kept(
        &self,
        net: &CutTriangulation,
        component: &[u32],
        count: u32,
        drawn: &[[VertexHandle; 2]],
        mask: Option<&OpacityMask>,
    ) -> Vec<bool> {
        let mut border_sides: Vec<[bool; 2]> = vec![[false; 2]; count as usize];
        for [from, to] in drawn {
            let Some(edge) = net.get_edge_from_neighbors(*from, *to) else { continue };
            border_sides[component[edge.face().index()] as usize][1] = true;
            border_sides[component[edge.rev().face().index()] as usize][0] = true;
        }
        let is_opaque = |p: DVec2| mask.is_none_or(|mask| mask.is_opaque(p));
        let without = is_opaque(self.corners.iter().sum::<DVec2>() / 3.0);
        let mut is_kept = vec![false; component.len()];
        for face in net.inner_faces() {
            let face_component = component[face.index()];
            is_kept[face.index()] = face_component != 0
                && match border_sides[face_component as usize] {
                    [false, true] => true,
                    [true, false] => false,
                    [false, false] => without,
                    [true, true] => {
                        let centre = face.center();
                        is_opaque(DVec2::new(centre.x, centre.y))
                    }
                };
        }
        is_kept
    }
}

impl TriangulationBuilder {
    /// Adds a vertex; an existing vertex at the same position keeps its place.
    fn insert(&mut self, at: DVec2, piece_vertex: PieceVertex) -> Option<VertexHandle> {
        let vertex = self.faces.insert(spade::mitigate_underflow(Point2::new(at.x, at.y))).ok()?;
        if vertex.index() == self.piece_vertices.len() {
            self.piece_vertices.push(piece_vertex);
        }
        Some(vertex)
    }

    /// Constrains an edge unless it would cross another constraint; returns whether it is constrained.
    fn join(&mut self, from: VertexHandle, to: VertexHandle) -> bool {
        let can_be = from != to && self.faces.can_add_constraint(from, to);
        if can_be {
            self.faces.add_constraint(from, to);
        }
        can_be
    }
}

/// Components of faces that are connected without crossing a constraint, and their number. Component 0 is
/// outside.
fn components(net: &CutTriangulation) -> (Vec<u32>, u32) {
    let mut component = vec![UNASSIGNED; net.num_all_faces()];
    let mut stack = Vec::new();
    component[net.outer_face().index()] = 0;
    // Start outside, through hull edges that are not sides of the triangle.
    for edge in net.convex_hull() {
        let inner = edge.rev().face();
        let inner = if inner.is_outer() { edge.face() } else { inner };
        if !edge.is_constraint_edge() && component[inner.index()] == UNASSIGNED {
            component[inner.index()] = 0;
            stack.push(inner.fix());
        }
    }
    let mut count = 1;
    let mut rest = net.inner_faces();
    loop {
        while let Some(face) = stack.pop() {
            let face = net.face(face);
            let current_component = component[face.index()];
            let Some(inner) = face.as_inner() else { continue };
            for edge in inner.adjacent_edges() {
                let neighbour = edge.rev().face();
                if !edge.is_constraint_edge() && component[neighbour.index()] == UNASSIGNED {
                    component[neighbour.index()] = current_component;
                    stack.push(neighbour.fix());
                }
            }
        }
        let Some(seed) = rest.find(|face| component[face.index()] == UNASSIGNED) else { break };
        component[seed.index()] = count;
        count += 1;
        stack.push(seed.adjacent_edges()[0].face().fix());
    }
    (component, count)
}
