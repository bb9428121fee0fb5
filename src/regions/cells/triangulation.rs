//! [`Triangulation`]: the page as triangles with neighbours, cut along the borders.
//!
//! Triangles without a border between them form a *cell*, which should look the same everywhere. Borders need
//! not be closed: where a line ends before it meets the next one, triangles close the gap.

use crate::parallel::prelude::*;
use spade::handles::{FixedFaceHandle, InnerTag};
use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation as _};

use super::insertion_order::insertion_order;
use crate::regions::arrangement::grid_tiles::GridPoint;
use crate::regions::arrangement::snap_rounding::{Border, Noded};

/// Entry of [`Triangulation::neighbours`] outside the page.
pub(crate) const OUTSIDE: u32 = u32::MAX;

/// Minimum number of triangles per task.
const MIN_TRIANGLES_PER_TASK: usize = 1 << 9;

/// Constrained Delaunay triangulation of the page.
#[derive(Debug, Clone, Default)]
pub(crate) struct Triangulation {
    pub points: Vec<GridPoint>,
    /// Point ids of each triangle's corners, turning from x to y.
    pub triangles: Vec<[u32; 3]>,
    /// Neighbour across each side 0-1, 1-2, 2-0.
    pub neighbours: Vec<[u32; 3]>,
    /// Border on each side; `None` inside a cell.
    pub borders: Vec<[Option<Border>; 3]>,
}

/// Point with its id.
#[derive(Clone, Copy)]
struct NumberedPoint {
    position: Point2<f64>,
    number: u32,
}

impl HasPosition for NumberedPoint {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.position
    }
}

impl Triangulation {
    /// Builds the Delaunay triangulation constrained by the borders; empty if there is no triangle.
    ///
    /// Triangles are sorted by their corners, and each starts with its smallest corner, so their numbers do
    /// not depend on how they were found.
    pub(crate) fn new(noded: Noded) -> Self {
        let Some(built) = triangulated(&noded) else { return Self::default() };
        let with_corners = |face: FixedFaceHandle<InnerTag>| {
            let mut corners = built.face(face).vertices().map(|vertex| vertex.data().number);
            let first = least(corners);
            corners.rotate_left(first);
            (corners, face)
        };
        let faces: Vec<FixedFaceHandle<InnerTag>> = built.fixed_inner_faces().collect();
        let mut faces: Vec<_> =
            faces.into_par_iter().with_min_len(MIN_TRIANGLES_PER_TASK).map(with_corners).collect();
        faces.par_sort_unstable_by_key(|(corners, _)| *corners);
        let mut number = vec![OUTSIDE; built.num_all_faces()];
        for (k, (_, face)) in (0..).zip(&faces) {
            number[face.index()] = k;
        }
        let border = |a: u32, b: u32| {
            let ends = [a.min(b), a.max(b)];
            let piece = noded.pieces.binary_search_by_key(&ends, |piece| piece.ends);
            piece.map_or(Border::Hard, |k| noded.pieces[k].border)
        };
        let sides = |(_, face): &(_, FixedFaceHandle<InnerTag>)| {
            let mut edges = built.face(*face).adjacent_edges();
            let first = least(edges.map(|edge| edge.from().data().number));
            edges.rotate_left(first);
            let neighbours = edges.map(|edge| number[edge.rev().face().fix().index()]);
            let borders = edges.map(|edge| {
                let [a, b] = [edge.from(), edge.to()].map(|vertex| vertex.data().number);
                edge.is_constraint_edge().then(|| border(a, b))
            });
            (neighbours, borders)
        };
        let (neighbours, borders) = faces.par_iter().with_min_len(MIN_TRIANGLES_PER_TASK).map(sides).unzip();
        let triangles = faces.iter().map(|(corners, _)| *corners).collect();
        Self { triangles, neighbours, borders, points: noded.points }
    }

    /// Twice the area of a triangle, squared grid steps.
    pub(crate) fn area2(&self, triangle: usize) -> f64 {
        let [a, b, c] = self.corners(triangle);
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    }

    /// Corner positions of a triangle, grid steps.
    pub(crate) fn corners(&self, triangle: usize) -> [[f64; 2]; 3] {
        self.triangles[triangle].map(|v| self.points[v as usize].map(|x| x as f64))
    }

    /// Length of a side, grid steps.
    pub(crate) fn side(&self, triangle: usize, side: usize) -> f64 {
        let corners = self.corners(triangle);
        let (a, b) = (corners[side], corners[(side + 1) % 3]);
        ((b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1])).sqrt()
    }

    /// Diameter of the inscribed circle of a triangle, grid steps.
    pub(crate) fn width(&self, triangle: usize) -> f64 {
        let around: f64 = (0..3).map(|side| self.side(triangle, side)).sum();
        if around > 0.0 { 2.0 * self.area2(triangle) / around } else { 0.0 }
    }

    /// Cell of each triangle, numbered by first triangle, and the number of cells.
    pub(crate) fn cells(&self) -> (Vec<u32>, usize) {
        self.flooded(|triangle, side, _| self.borders[triangle][side].is_none())
    }

    /// Connected components of triangles, joined where `joins(triangle, side, neighbour)`, and their number.
    pub(crate) fn flooded(&self, joins: impl Fn(usize, usize, usize) -> bool) -> (Vec<u32>, usize) {
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

/// Delaunay triangulation of points and border pieces; `None` if a coordinate is out of range.
fn triangulated(noded: &Noded) -> Option<ConstrainedDelaunayTriangulation<NumberedPoint>> {
    let points = noded.points.len();
    let mut built =
        ConstrainedDelaunayTriangulation::<NumberedPoint>::with_capacity(points, 3 * points, 2 * points);
    let mut vertices = vec![None; points];
    let mut last = None;
    for number in insertion_order(&noded.points) {
        let [x, y] = noded.points[number as usize];
        let corner = NumberedPoint { position: Point2::new(x as f64, y as f64), number };
        let vertex = match last {
            Some(near) => built.insert_with_hint(corner, near),
            None => built.insert(corner),
        }
        .ok()?;
        vertices[number as usize] = Some(vertex);
        last = Some(vertex);
    }
    for piece in &noded.pieces {
        // Borders no longer cross. Should rounding have left a crossing, one of the two is left out.
        if let [Some(from), Some(to)] = piece.ends.map(|end| vertices[end as usize]) {
            built.try_add_constraint(from, to);
        }
    }
    Some(built)
}

/// Index of a triangle's smallest corner.
fn least([a, b, c]: [u32; 3]) -> usize {
    if a < b && a < c { 0 } else { 1 + usize::from(c < b) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::numbers::noise::hash;
    use crate::regions::arrangement::snap_rounding::NodedPiece;

    #[test]
    fn triangulation_covers_the_page_with_sorted_triangles() {
        let mut points: Vec<GridPoint> =
            (0..300).map(|k| [0, 1].map(|axis| (hash(1, &[k, axis]) % 1000 + 1) as i64)).collect();
        points.extend([[0, 0], [0, 1001], [1001, 0], [1001, 1001]]);
        // Points on the diagonal would cut it.
        points.retain(|[x, y]| x != y || [0, 1001].contains(x));
        points.sort_unstable();
        points.dedup();
        let last = points.len() as u32 - 1;
        let diagonal = NodedPiece { ends: [0, last], border: Border::Soft };
        let cut = Triangulation::new(Noded { points, pieces: vec![diagonal] });
        assert!(cut.triangles.is_sorted() && cut.triangles.iter().all(|[a, b, c]| a < b && a < c));
        assert_eq!((0..cut.triangles.len()).map(|k| cut.area2(k)).sum::<f64>(), 2.0 * 1001.0 * 1001.0);
        let ends = |triangle: usize, side: usize| {
            [side, (side + 1) % 3].map(|corner| cut.triangles[triangle][corner])
        };
        for (triangle, neighbours) in cut.neighbours.iter().enumerate() {
            for (side, next) in neighbours.iter().enumerate() {
                if *next == OUTSIDE {
                    continue;
                }
                let [a, b] = ends(triangle, side);
                let back = (0..3).find(|side| ends(*next as usize, *side) == [b, a]);
                assert_eq!(cut.neighbours[*next as usize][back.unwrap()] as usize, triangle);
                assert_eq!(cut.borders[triangle][side].is_some(), [a.min(b), a.max(b)] == [0, last]);
            }
        }
        assert_eq!(cut.cells().1, 2);
    }
}
