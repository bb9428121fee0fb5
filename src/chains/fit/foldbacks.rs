//! Removes tiny fold-backs of mesh contours.
//!
//! Along a row of nearly edge-on triangles a contour runs forward, back and forward again over the same
//! pixels. A shortcut between the two passes draws the same.

use crate::chains::sampled_line::SampledLine;
use crate::geometry::plane::planar_distance::{length, segment_distance_squared};

/// Replaces fold-backs by shortcuts.
///
/// A fold-back is a stretch of at most `reach` arc length, clearly longer than its chord, that stays within
/// `tolerance` of it.
pub(crate) fn remove_foldbacks(line: &SampledLine, tolerance: f64, reach: f64) -> SampledLine {
    let n = line.len();
    if n < 4 {
        return line.clone();
    }
    let mut kept = vec![0];
    let mut i = 0;
    while i + 1 < n {
        let mut next = i + 1;
        // The end of the longest fold-back that starts at `i`.
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
        // The last point is always kept. In a closed line it is a neighbour of the first point.
        kept.push(next);
        i = next;
    }
    kept.dedup();
    line.pick(&kept)
}

/// Whether all points between `i` and `j` are smooth and lie near the shortcut.
fn is_thin(line: &SampledLine, i: usize, j: usize, tolerance: f64) -> bool {
    let (a, b) = (line.points[i], line.points[j]);
    let near = tolerance * tolerance;
    (i + 1..j).all(|k| {
        line.sides[k - 1].soft && line.sides[k].soft && segment_distance_squared(line.points[k], a, b) <= near
    })
}
