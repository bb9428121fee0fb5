//! Clips polylines to the cells of `HatchRegions`, exactly where they cross its borders.
//!
//! A line is compared with the border pieces in the tiles that it passes. No polygon is built.

use kurbo::Point;

use crate::hatching::tolerances;
use crate::regions::HatchRegions;

/// Position on a polyline: the number of a segment plus the fraction of that segment already passed.
pub(crate) type LinePosition = f64;

/// Span of a polyline that may be drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LineSpan {
    /// Start of the span.
    pub from: LinePosition,
    /// End of the span.
    pub to: LinePosition,
    /// The cell where the span starts.
    pub cell: u32,
    /// Whether the start and the end lie on a border, rather than at the ends of the line.
    pub cut: [bool; 2],
}

/// The spans of a polyline in wanted cells. No span crosses the border of a surface.
#[must_use]
pub(crate) fn clip_to_cells(
    ground: &HatchRegions,
    line: &[Point],
    is_wanted: impl Fn(u32) -> bool,
) -> Vec<LineSpan> {
    let mut crossings: Vec<(f64, u32, bool)> = Vec::new();
    let mut positions: Vec<(LinePosition, u32, bool)> = Vec::new();
    for (k, pair) in line.windows(2).enumerate() {
        crossings.clear();
        ground.crossings(pair[0], pair[1], &mut crossings);
        positions.extend(crossings.iter().map(|(t, piece, along)| (k as f64 + t, *piece, *along)));
    }
    let last = line.len().saturating_sub(1) as f64;
    let sides = |number: u32, along: bool| {
        let piece = &ground.pieces[number as usize];
        let [right, left] = piece.sides;
        if along { (right, left) } else { (left, right) }
    };
    // Where borders meet in a corner, several pieces are crossed at one position and their order is
    // unreliable. There the cell is looked up at a point of the span.
    let is_corner = |k: usize| {
        let is_close = |neighbour: Option<&(LinePosition, u32, bool)>| {
            neighbour.is_some_and(|(other_position, ..)| {
                (other_position - positions[k].0).abs() < tolerances::MIN_POSITION_DIFFERENCE_SIDES
            })
        };
        is_close(positions.get(k + 1)) || is_close(k.checked_sub(1).and_then(|before| positions.get(before)))
    };
    let mut out: Vec<LineSpan> = Vec::new();
    let (mut from, mut behind): (LinePosition, Option<u32>) = (0.0, None);
    let mut parts = true;
    for k in 0..=positions.len() {
        let next = positions.get(k);
        let to = next.map_or(last, |(place, ..)| *place);
        let next_cell = next.filter(|_| !is_corner(k)).map(|(_, piece, along)| sides(*piece, *along).0);
        if to - from > tolerances::MIN_POSITION_DIFFERENCE_SIDES {
            let cell = match (behind, next_cell) {
                (Some(a), Some(b)) if a == b => a,
                (Some(a), None) | (None, Some(a)) => a,
                _ => ground.cell_at(point_at(line, f64::midpoint(from, to))),
            };
            if is_wanted(cell) {
                match out.last_mut() {
                    Some(before)
                        if from - before.to < tolerances::MIN_POSITION_DIFFERENCE_SIDES
                            && !parts
                            && from > 0.0 =>
                    {
                        before.to = to
                    }
                    _ => out.push(LineSpan { from, to, cell, cut: [from > 0.0, true] }),
                }
            }
            parts = false;
        }
        if let Some((place, piece, along)) = next {
            parts |= ground.pieces[*piece as usize].parts_surfaces;
            behind = (!is_corner(k)).then(|| sides(*piece, *along).1);
            from = *place;
        }
    }
    if let Some(stretch) = out.last_mut() {
        stretch.cut[1] = stretch.to < last;
    }
    out
}

/// The point at a position of a polyline. The position is clamped to the line.
#[must_use]
pub(crate) fn point_at(line: &[Point], place: LinePosition) -> Point {
    let k = (place.max(0.0) as usize).min(line.len().saturating_sub(2));
    match (line.get(k), line.get(k + 1)) {
        (Some(a), Some(b)) => a.lerp(*b, (place - k as f64).clamp(0.0, 1.0)),
        (Some(a), None) => *a,
        _ => Point::ZERO,
    }
}

/// The part of a polyline between two positions.
#[must_use]
pub(crate) fn sub_polyline(line: &[Point], from: LinePosition, to: LinePosition) -> Vec<Point> {
    let mut points = vec![point_at(line, from)];
    let first = from.floor() as usize + 1;
    points.extend((first..line.len()).take_while(|k| (*k as f64) < to).map(|k| line[k]));
    points.push(point_at(line, to));
    points.dedup();
    points
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::geometry::plane::planar_distance::length;
    use crate::mesh::{MaterialId, PaintId, PartId};
    use crate::regions::SurfaceLabel;
    use crate::regions::hatch_regions::border_piece::BorderPiece;
    use crate::regions::hatch_regions::hatch_map::HatchCell;

    /// Two squares of side 10 side by side from (0, 0), in bins 0 and 1, on one facet or on two.
    pub(crate) fn two_squares(parts_surfaces: bool) -> HatchRegions {
        let look = |bin: u16| SurfaceLabel {
            part: PartId(0),
            material: MaterialId(0),
            paint: PaintId(0),
            tone: 0,
            bin,
            cast: false,
        };
        let cell = |bin: u16, facet: u32| HatchCell { look: look(bin), facet, area: 100.0 };
        let cells = vec![cell(0, 0), cell(0, 1), cell(1, if parts_surfaces { 2 } else { 1 })];
        let piece = |a: [f64; 2], b: [f64; 2], sides: [u32; 2], parts_surfaces: bool| BorderPiece {
            ends: [Point::new(a[0], a[1]), Point::new(b[0], b[1])],
            sides,
            parts_surfaces,
        };
        let pieces = vec![
            piece([0.0, 0.0], [10.0, 0.0], [1, 0], true),
            piece([10.0, 0.0], [20.0, 0.0], [2, 0], true),
            piece([20.0, 0.0], [20.0, 10.0], [2, 0], true),
            piece([20.0, 10.0], [10.0, 10.0], [2, 0], true),
            piece([10.0, 10.0], [0.0, 10.0], [1, 0], true),
            piece([0.0, 10.0], [0.0, 0.0], [1, 0], true),
            piece([10.0, 0.0], [10.0, 10.0], [1, 2], parts_surfaces),
        ];
        HatchRegions::of_pieces(cells, pieces)
    }

    #[test]
    fn cell_at_finds_the_cell_of_a_point() {
        let ground = two_squares(false);
        for (x, y, cell) in [(5.0, 5.0, 1), (15.0, 5.0, 2), (25.0, 5.0, 0), (-5.0, 5.0, 0), (5.0, 11.0, 0)] {
            assert_eq!(ground.cell_at(Point::new(x, y)), cell, "{x} {y}");
        }
    }

    #[test]
    fn clip_to_cells_ends_lines_at_surface_borders() {
        let line = [Point::new(-5.0, 4.0), Point::new(30.0, 4.0)];
        let found = |parts: bool, wanted: fn(u32) -> bool| {
            let stretches = clip_to_cells(&two_squares(parts), &line, wanted);
            let at = |place: f64| (point_at(&line, place).x * 1e9).round() / 1e9;
            stretches.iter().map(|s| (at(s.from), at(s.to), s.cut)).collect::<Vec<_>>()
        };
        assert_eq!(found(false, |cell| cell > 0), [(0.0, 20.0, [true, true])]);
        assert_eq!(found(true, |cell| cell > 0), [(0.0, 10.0, [true, true]), (10.0, 20.0, [true, true])]);
        assert_eq!(found(false, |cell| cell == 2), [(10.0, 20.0, [true, true])]);
        assert_eq!(found(false, |cell| cell == 0), [(-5.0, 0.0, [false, true]), (20.0, 30.0, [true, false])]);
    }

    #[test]
    fn clip_to_cells_handles_corners_and_lines_inside_a_cell() {
        let ground = two_squares(false);
        let diagonal = [Point::new(-3.0, -3.0), Point::new(13.0, 13.0)];
        let found = clip_to_cells(&ground, &diagonal, |cell| cell > 0);
        let total: f64 =
            found.iter().map(|s| length(point_at(&diagonal, s.to) - point_at(&diagonal, s.from))).sum();
        assert!((total - 200.0_f64.sqrt()).abs() < 1e-9, "{found:?}");
        let inside = [Point::new(2.0, 2.0), Point::new(3.0, 5.0), Point::new(6.0, 6.0)];
        let found = clip_to_cells(&ground, &inside, |cell| cell == 1);
        assert_eq!(found, [LineSpan { from: 0.0, to: 2.0, cell: 1, cut: [false, false] }]);
    }
}
