//! [`Triangulation`]: the page cut along borders, in triangles that know their neighbours.
//!
//! Triangles with no border between them make up a *cell*, all of which looks alike. A triangulation
//! needs no closed borders: where a line breaks off before it meets the next one, triangles close
//! the gap.

use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation as _};

use super::noding::{Border, GridPoint, Noded};

/// In [`Triangulation::neighbours`]: beyond the page.
pub(super) const OUTSIDE: u32 = u32::MAX;

/// Triangles between borders.
#[derive(Debug, Clone, Default)]
pub(super) struct Triangulation {
    pub points: Vec<GridPoint>,
    /// Corners of each triangle, turning from x to y.
    pub triangles: Vec<[u32; 3]>,
    /// The triangle beyond each side 0-1, 1-2, 2-0.
    pub neighbours: Vec<[u32; 3]>,
    /// What borders these sides are; `None` where the cell goes on.
    pub borders: Vec<[Option<Border>; 3]>,
}

#[derive(Clone, Copy)]
struct Corner {
    position: Point2<f64>,
}

impl HasPosition for Corner {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.position
    }
}

impl Triangulation {
    /// The Delaunay triangulation under these borders; empty where they enclose nothing.
    pub fn new(noded: Noded) -> Self {
        let at = |p: &GridPoint| Corner { position: Point2::new(p[0] as f64, p[1] as f64) };
        let corners = noded.points.iter().map(at).collect();
        let edges = noded.pieces.iter().map(|piece| piece.ends.map(|end| end as usize)).collect();
        // Nothing crosses any more; should rounding have left a crossing, one of both is left out.
        let built = ConstrainedDelaunayTriangulation::<Corner>::try_bulk_load_cdt(corners, edges, |_| {});
        let Ok(built) = built else { return Self::default() };
        let mut number = vec![OUTSIDE; built.num_all_faces()];
        for (k, face) in built.inner_faces().enumerate() {
            number[face.fix().index()] = k as u32;
        }
        let border = |a: u32, b: u32| {
            let ends = [a.min(b), a.max(b)];
            let piece = noded.pieces.binary_search_by_key(&ends, |piece| piece.ends);
            piece.map_or(Border::Hard, |k| noded.pieces[k].border)
        };
        let mut triangulation = Self::default();
        for face in built.inner_faces() {
            let edges = face.adjacent_edges();
            triangulation.triangles.push(edges.map(|edge| edge.from().fix().index() as u32));
            triangulation.neighbours.push(edges.map(|edge| number[edge.rev().face().fix().index()]));
            triangulation.borders.push(edges.map(|edge| {
                let [a, b] = [edge.from(), edge.to()].map(|vertex| vertex.fix().index() as u32);
                edge.is_constraint_edge().then(|| border(a, b))
            }));
        }
        triangulation.points = noded.points;
        triangulation
    }

    /// Twice the area of a triangle, in steps of the grid.
    pub fn area2(&self, triangle: usize) -> f64 {
        let [a, b, c] = self.corners(triangle);
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    }

    /// The corners of a triangle.
    pub fn corners(&self, triangle: usize) -> [[f64; 2]; 3] {
        self.triangles[triangle].map(|v| self.points[v as usize].map(|x| x as f64))
    }

    /// The length of a side.
    pub fn side(&self, triangle: usize, side: usize) -> f64 {
        let corners = self.corners(triangle);
        let (a, b) = (corners[side], corners[(side + 1) % 3]);
        ((b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1])).sqrt()
    }

    /// How wide a triangle is: the diameter of the circle inside it.
    pub fn width(&self, triangle: usize) -> f64 {
        let around: f64 = (0..3).map(|side| self.side(triangle, side)).sum();
        if around > 0.0 { 2.0 * self.area2(triangle) / around } else { 0.0 }
    }

    /// The cell of each triangle, numbered in the order of their first triangles, and their number.
    pub fn cells(&self) -> (Vec<u32>, usize) {
        self.flooded(|triangle, side, _| self.borders[triangle][side].is_none())
    }

    /// Numbers the sets of triangles that are joined where `joins(triangle, side, neighbour)`.
    pub fn flooded(&self, joins: impl Fn(usize, usize, usize) -> bool) -> (Vec<u32>, usize) {
        let mut set = vec![OUTSIDE; self.triangles.len()];
        let mut count = 0;
        let mut open = Vec::new();
        for first in 0..self.triangles.len() {
            if set[first] != OUTSIDE {
                continue;
            }
            set[first] = count;
            open.push(first);
            while let Some(triangle) = open.pop() {
                for side in 0..3 {
                    let next = self.neighbours[triangle][side];
                    if next != OUTSIDE
                        && set[next as usize] == OUTSIDE
                        && joins(triangle, side, next as usize)
                    {
                        set[next as usize] = count;
                        open.push(next as usize);
                    }
                }
            }
            count += 1;
        }
        (set, count as usize)
    }
}
