//! [`Diagonals`]: which sides of a polygon's triangles are diagonals, added by the triangulation.

use glam::DVec3;

use crate::mesh::EdgeMark;

/// Marks the sides of a polygon's triangles that are diagonals: those between corners that are not
/// consecutive. Corners at the position of the previous one count as the same corner. A triangle has no
/// diagonals.
#[derive(Debug, Default)]
pub(crate) struct Diagonals {
    /// For each corner, the number of distinct positions before it.
    numbers: Vec<u32>,
    /// Number of distinct consecutive positions.
    count: u32,
}

impl Diagonals {
    /// Prepares for a polygon with these corners.
    pub(crate) fn of(&mut self, points: &[DVec3]) {
        self.numbers.clear();
        self.count = 0;
        let mut last = None;
        for point in points {
            if last.is_some_and(|last| last != *point) {
                self.count += 1;
            }
            last = Some(*point);
            self.numbers.push(self.count);
        }
        let closes = self.count > 0 && points.first() == points.last();
        if closes {
            let last = self.count;
            self.numbers
                .iter_mut()
                .rev()
                .take_while(|number| **number == last)
                .for_each(|number| *number = 0);
        } else {
            self.count += 1;
        }
    }

    /// Marks of the sides of a triangle.
    pub(crate) fn marks(&self, triangle: [u32; 3]) -> [EdgeMark; 3] {
        let [a, b, c] = triangle.map(|corner| self.numbers.get(corner as usize).copied().unwrap_or_default());
        [(a, b), (b, c), (c, a)].map(|(from, to)| {
            let is_side = |from: u32, to: u32| to == if from + 1 == self.count { 0 } else { from + 1 };
            let is_diagonal = self.count > 3 && from != to && !is_side(from, to) && !is_side(to, from);
            if is_diagonal { EdgeMark::Diagonal } else { EdgeMark::Unmarked }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::triangulation::triangulate;
    use super::*;

    #[test]
    fn triangle_sides_inside_a_polygon_are_marked_as_diagonals() {
        let mut diagonals = Diagonals::default();
        let mut marked = |points: &[(f64, f64)]| -> Vec<[u32; 2]> {
            let points: Vec<DVec3> = points.iter().map(|&(x, y)| DVec3::new(x, y, 0.0)).collect();
            diagonals.of(&points);
            let mut found = Vec::new();
            let mut triangles = Vec::new();
            triangulate(&points, &mut triangles);
            for triangle in triangles {
                for (k, mark) in diagonals.marks(triangle).into_iter().enumerate() {
                    assert!(matches!(mark, EdgeMark::Unmarked | EdgeMark::Diagonal));
                    let ends = [triangle[k], triangle[(k + 1) % 3]];
                    found.extend(
                        (mark == EdgeMark::Diagonal).then_some([ends[0].min(ends[1]), ends[0].max(ends[1])]),
                    );
                }
            }
            found
        };
        let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        assert_eq!(marked(&square), [[0, 2], [0, 2]]);
        assert!(marked(&square[..3]).is_empty());
        let pentagon = [(0.0, 0.0), (2.0, 0.0), (3.0, 1.0), (1.0, 2.0), (-1.0, 1.0)];
        assert_eq!(marked(&pentagon), [[0, 2], [0, 2], [0, 3], [0, 3]]);
        // A triangle with one corner doubled, at any index, has no diagonal.
        for twice in 0..3 {
            let mut corners = square[..3].to_vec();
            corners.insert(twice, corners[twice]);
            assert!(marked(&corners).is_empty(), "corner {twice}");
        }
        assert!(marked(&[square[0], square[1], square[2], square[0]]).is_empty());
        // In a quad with its first corner doubled, the diagonal is between any copies of the same positions.
        let twice = [square[0], square[0], square[1], square[2], square[3]];
        assert_eq!(marked(&twice), [[1, 3], [1, 3]]);
    }
}
