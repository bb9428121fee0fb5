//! Takes out the tiny folds of mesh contours: places where a line doubles back on itself.
//!
//! Where a contour runs along a row of nearly edge-on triangles it goes forth, back and forth again
//! over the same ink; the shortcut between the two passes draws the same.

use crate::chains::sampled_line::Line;
use crate::geometry::plane::planar_distance::{distance2, length};

/// Replaces each excursion of up to `reach` arc length that returns to within `tolerance` of where
/// it left, never having been farther than `tolerance` from the shortcut or its own way back.
pub(crate) fn unfold(line: &Line, tolerance: f64, reach: f64) -> Line {
    let n = line.len();
    if n < 4 {
        return line.clone();
    }
    let mut kept = vec![0];
    let mut i = 0;
    while i + 1 < n {
        let mut next = i + 1;
        // The farthest point from which the line has come back.
        let mut arc = 0.0;
        for j in i + 1..n {
            arc += length(line.points[j] - line.points[j - 1]);
            if arc > reach {
                break;
            }
            let chord = length(line.points[j] - line.points[i]);
            if j > i + 1 && arc > 1.6 * chord + 0.25 * tolerance && is_thin(line, i, j, tolerance) {
                next = j;
            }
        }
        // The last point of an open line is its end and stays; a closed line has it as a neighbour
        // of the first.
        kept.push(next);
        i = next;
    }
    kept.dedup();
    line.pick(&kept)
}

/// Whether all points between `i` and `j` lie near the shortcut between them.
fn is_thin(line: &Line, i: usize, j: usize, tolerance: f64) -> bool {
    let (a, b) = (line.points[i], line.points[j]);
    let near = tolerance * tolerance;
    (i + 1..j).all(|k| line.soft[k - 1] && line.soft[k] && distance2(line.points[k], a, b) <= near)
}
