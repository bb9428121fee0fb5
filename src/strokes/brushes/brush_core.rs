//! The core of a brushed line: a filled strip from the axis of the line to the ink of the brush.
//!
//! Painted regions end at the axis. If the ink of a brush shape lies to one side of the axis, a gap of
//! paper would show between region and ink. The core fills it.
//!
//! 1. The brush shape is divided into columns along the line. For each, the distance to the ink nearest to
//!    the axis is found.
//! 2. The axis is widened by these distances and becomes an outline.
//! 3. The outline is added to the path of the brushed line, with the same orientation.

use kurbo::{BezPath, PathEl, PathSeg, Point};

use crate::strokes::axes::stroke_axis::StrokeAxis;
use crate::strokes::outlines::stroke_outline::{Nib, outline};
use crate::strokes::tolerances;

/// Number of columns along a brush shape.
pub(crate) const BRUSH_COLUMNS: usize = 256;

/// Distances from the axis to the left and to the right, as far as the middle of the nearest ink, in pen
/// widths. Both are 0 where the axis lies in ink.
pub(crate) type InkOffset = [f64; 2];

/// The ink nearest to the axis in each of [`BRUSH_COLUMNS`] evenly spaced columns of a shape. `None` for a
/// column without ink.
pub(crate) fn columns(shape: &BezPath) -> Vec<Option<InkOffset>> {
    let mut flat = BezPath::new();
    kurbo::flatten(shape, tolerances::BRUSH_FLATNESS_OF_SIZE, |element| flat.push(element));
    if !matches!(flat.elements().last(), Some(PathEl::ClosePath) | None) {
        flat.close_path();
    }
    let sides: Vec<[Point; 2]> = flat
        .segments()
        .filter_map(|segment| if let PathSeg::Line(line) = segment { Some([line.p0, line.p1]) } else { None })
        .collect();
    let column = |k: usize| {
        let x = (k as f64 + 0.5) / BRUSH_COLUMNS as f64;
        let mut meets: Vec<(f64, i32)> = Vec::new();
        for [a, b] in &sides {
            if (a.x > x) != (b.x > x) {
                let y = a.y + (b.y - a.y) * ((x - a.x) / (b.x - a.x));
                meets.push((y, if b.x > a.x { 1 } else { -1 }));
            }
        }
        meets.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        nearest_ink(&meets)
    };
    (0..BRUSH_COLUMNS).map(column).collect()
}

/// The ink nearest to the axis in one column. `meets` holds the y of the shape's crossings with the column
/// in ascending order, each with its winding (1 or -1).
pub(crate) fn nearest_ink(meets: &[(f64, i32)]) -> Option<InkOffset> {
    let mut winding = 0;
    let mut begun = 0.0;
    let mut best: Option<InkOffset> = None;
    for (y, turn) in meets {
        if winding == 0 {
            begun = *y;
        }
        winding += turn;
        if winding != 0 || *y <= begun {
            continue;
        }
        let middle = f64::midpoint(begun, *y);
        let extents = match (begun > 0.0, *y < 0.0) {
            (true, _) => [0.0, middle],
            (_, true) => [-middle, 0.0],
            _ => [0.0, 0.0],
        };
        let farthest = |ink_offset: InkOffset| ink_offset[0].max(ink_offset[1]);
        if best.is_none_or(|best| farthest(extents) < farthest(best)) {
            best = Some(extents);
        }
    }
    best
}

/// Adds the core to the outline of a line.
///
/// `half` takes the index of an axis point and the value of its column, and returns the extent of the core
/// to the left and right, user units. `place` returns the position of an axis point along the brush, where
/// each copy has length 1.
pub(crate) fn add(
    path: &mut BezPath,
    columns: &[Option<InkOffset>],
    axis: &StrokeAxis,
    half: impl Fn(usize, Option<InkOffset>) -> [f64; 2],
    place: impl Fn(usize) -> f64,
    nib: &Nib,
) {
    use kurbo::Shape;
    let column = |i: usize| {
        let place = place(i);
        let within = if place > 0.0 && place == place.floor() { 1.0 } else { place - place.floor() };
        let k = (within * columns.len() as f64) as usize;
        columns.get(k.min(columns.len().saturating_sub(1))).copied().flatten()
    };
    let halves: Vec<[f64; 2]> = (0..axis.len()).map(|i| half(i, column(i))).collect();
    let [left, right] = [0, 1].map(|side| halves.iter().map(|half| half[side]).collect::<Vec<f64>>());
    let Some(core) = outline(axis, [&left, &right], nib) else { return };
    // With opposite orientations the two would cancel where they overlap.
    let turned = core.area() * path.area() < 0.0;
    path.extend(if turned { core.reverse_subpaths() } else { core });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brush_columns_hold_distances_to_the_nearest_ink() {
        let beside = BezPath::from_svg("M0 0.2L1 0.2L1 0.4L0 0.4Z").unwrap();
        assert!(
            columns(&beside).iter().all(|way| way.is_some_and(|[l, r]| l == 0.0 && (r - 0.3).abs() < 1e-9))
        );
        let over = BezPath::from_svg("M0 -0.1L0.5 -0.1L0.5 0.4L0 0.4Z").unwrap();
        let found = columns(&over);
        assert_eq!((found[0], found[BRUSH_COLUMNS - 1]), (Some([0.0, 0.0]), None));
        // With two strands, the closer one counts.
        let two = BezPath::from_svg("M0 -0.2L1 -0.2L1 -0.1L0 -0.1ZM0 0.2L1 0.2L1 0.4L0 0.4Z").unwrap();
        assert!(
            columns(&two).iter().all(|way| way.is_some_and(|[l, r]| (l - 0.15).abs() < 1e-9 && r == 0.0))
        );
    }
}
