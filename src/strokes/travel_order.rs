//! Pen travel: paths ordered and reversed to shorten the pen-up ways between them.
//!
//! Algorithm: nearest neighbour over the ends of all paths. The search uses a grid over the page that is
//! rebuilt as it empties.

use kurbo::Point;

use super::tolerances;
use crate::drawing::{Layer, Mark, Paint};
use crate::geometry::plane::planar_grid::PlanarGrid;
use crate::geometry::plane::polyline_path::subpaths;
use crate::geometry::plane::polylines::bounds;

/// A layer in travel order, if it consists of opaque strokes of one colour, whose order is invisible. Other
/// layers are unchanged.
#[must_use]
pub(crate) fn in_travel_order(layer: Layer) -> Layer {
    let colour = |mark: &Mark| match &mark.paint {
        Paint::Stroke(stroke) => Some(stroke.colour),
        _ => None,
    };
    let first = layer.marks.first().and_then(colour);
    // Translucent strokes would look different when split from one path into several.
    let is_opaque = first.is_some_and(|colour| colour.a == 255);
    if !is_opaque || layer.marks.iter().any(|mark| colour(mark) != first) {
        return layer;
    }
    let strokes = layer.marks.iter().flat_map(single).collect();
    Layer { marks: rejoined(shorten_travel(strokes)), ordered: true, ..layer }
}

/// The subpaths of a mark, one mark each.
fn single(mark: &Mark) -> Vec<Mark> {
    let begun = subpaths(&mark.path).into_iter().filter(|path| path.elements().len() > 1);
    begun.map(|path| Mark { path, ..mark.clone() }).collect()
}

/// Joins consecutive strokes of equal provenance and paint into one mark.
fn rejoined(strokes: Vec<Mark>) -> Vec<Mark> {
    let mut marks: Vec<Mark> = Vec::new();
    for stroke in strokes {
        match marks.last_mut() {
            Some(last) if last.provenance == stroke.provenance && last.paint == stroke.paint => {
                last.path.extend(stroke.path);
            }
            _ => marks.push(stroke),
        }
    }
    marks
}

/// End of a mark's path.
#[derive(Clone, Copy)]
struct PathEnd {
    /// Index of the mark.
    mark: usize,
    /// Whether the path must be reversed to start here.
    turned: bool,
    /// Position of the end.
    at: Point,
}

/// Marks in travel order: each starts near the end of the previous one, beginning at the page's top-left
/// corner.
///
/// Paths may be reversed. Dashes of reversed paths still end well, because dash patterns are symmetrical or
/// are reversed too.
#[must_use]
pub(crate) fn shorten_travel(marks: Vec<Mark>) -> Vec<Mark> {
    let mut remaining: Vec<PathEnd> = Vec::with_capacity(marks.len() * 2);
    for (mark, paths) in marks.iter().enumerate() {
        let (Some(start), Some(end)) = (first_point(paths), last_point(paths)) else { continue };
        remaining.push(PathEnd { mark, turned: false, at: start });
        if turns_well(paths) && start != end {
            remaining.push(PathEnd { mark, turned: true, at: end });
        }
    }
    let mut used = vec![false; marks.len()];
    let mut order: Vec<(usize, bool)> = Vec::with_capacity(marks.len());
    let mut pen = Point::ZERO;
    let mut left = remaining.len();
    while left > 0 {
        let mut grid = PathEndGrid::new(&remaining);
        // A grid for many ends is slow for few. Rebuild it when three quarters are gone.
        let rebuild_at = left / 4;
        while left > rebuild_at
            && let Some(next) = grid.take_nearest(pen, &used)
        {
            used[next.mark] = true;
            order.push((next.mark, next.turned));
            let mark = &marks[next.mark];
            let beyond = if next.turned { first_point(mark) } else { last_point(mark) };
            pen = beyond.unwrap_or(next.at);
            left -= if turns_well(mark) && first_point(mark) != last_point(mark) { 2 } else { 1 };
        }
        remaining.retain(|end| !used[end.mark]);
        left = remaining.len();
    }
    let mut slots: Vec<Option<Mark>> = marks.into_iter().map(Some).collect();
    let mut result: Vec<Mark> = Vec::with_capacity(slots.len());
    for (index, turned) in order {
        if let Some(mut mark) = slots.get_mut(index).and_then(Option::take) {
            if turned {
                mark.path = mark.path.reverse_subpaths();
            }
            result.push(mark);
        }
    }
    result
}

/// The point where the path begins.
fn first_point(mark: &Mark) -> Option<Point> {
    mark.path.elements().first().and_then(kurbo::PathEl::end_point)
}

/// The point where the pen is lifted. A closed path ends where it began.
fn last_point(mark: &Mark) -> Option<Point> {
    mark.path.current_position()
}

/// Whether the path may be drawn in reverse. A dash pattern of more than one dash and gap may not be
/// symmetrical.
fn turns_well(mark: &Mark) -> bool {
    match &mark.paint {
        Paint::Stroke(stroke) => stroke.dash.len() <= 2,
        Paint::Fill(_) | Paint::Gradient(_) | Paint::Image(_) | Paint::Outline(_) => false,
    }
}

/// Ends in a uniform grid over their bounding box.
struct PathEndGrid {
    grid: PlanarGrid,
    cells: Vec<Vec<PathEnd>>,
}

impl PathEndGrid {
    /// A grid with about two ends per cell.
    fn new(ends: &[PathEnd]) -> Self {
        let bounds = bounds(ends.iter().map(|end| end.at)).unwrap_or_default();
        let [width, height] =
            [bounds.width(), bounds.height()].map(|size| size.max(tolerances::MIN_GRID_EXTENT_UNITS));
        // The longer side limits the number of cells for a thin drawing.
        let wished = (ends.len() as f64 / 2.0).max(1.0);
        let cell = (width * height / wished).sqrt().max(width.max(height) / wished);
        let grid = PlanarGrid::new(bounds, 1.0 / cell);
        let mut cells = vec![Vec::new(); grid.count()];
        for end in ends {
            cells[grid.number(grid.cell(end.at))].push(*end);
        }
        Self { grid, cells }
    }

    /// The closest end of a mark not yet drawn. Among equally close ends, the first mark wins.
    fn take_nearest(&mut self, pen: Point, used: &[bool]) -> Option<PathEnd> {
        let middle = self.grid.cell(pen);
        let mut best: Option<(f64, usize, bool, PathEnd)> = None;
        for ring in 0..self.grid.ring_count() {
            let nearest = self.grid.ring_distance(ring);
            if best.is_some_and(|(distance, ..)| distance < nearest * nearest) {
                break;
            }
            for number in self.grid.ring(middle, ring) {
                let cell = &mut self.cells[number];
                cell.retain(|end| !used[end.mark]);
                for end in cell.iter() {
                    let candidate = ((end.at - pen).hypot2(), end.mark, end.turned, *end);
                    let nearer = best.is_none_or(|(distance, mark, turned, _)| {
                        (candidate.0, candidate.1, candidate.2) < (distance, mark, turned)
                    });
                    if nearer {
                        best = Some(candidate);
                    }
                }
            }
        }
        best.map(|(.., end)| end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::colour::srgb::Colour;
    use crate::drawing::{Cap, Join, Provenance, StrokePaint};
    use kurbo::BezPath;

    fn mark(x0: f64, y0: f64, x1: f64, y1: f64) -> Mark {
        let mut path = BezPath::new();
        path.move_to((x0, y0));
        path.line_to((x1, y1));
        Mark {
            path,
            paint: Paint::Stroke(StrokePaint::solid(1.0, Colour::BLACK, Cap::Round, Join::Round)),
            provenance: Provenance::default(),
        }
    }

    fn travel_length(marks: &[Mark]) -> f64 {
        let mut pen = Point::ZERO;
        let mut sum = 0.0;
        for mark in marks {
            sum += (first_point(mark).unwrap() - pen).hypot();
            pen = last_point(mark).unwrap();
        }
        sum
    }

    #[test]
    fn shorten_travel_draws_a_comb_back_and_forth() {
        let teeth: Vec<Mark> =
            (0..50).map(|i| mark(f64::from(i * 37 % 50), 0.0, f64::from(i * 37 % 50), 100.0)).collect();
        let short = shorten_travel(teeth.clone());
        assert_eq!(short.len(), 50);
        assert!((travel_length(&short) - 49.0).abs() < 1e-9, "{}", travel_length(&short));
        assert!(travel_length(&teeth) > 5_000.0);
    }

    #[test]
    fn shorten_travel_keeps_all_marks_and_picks_the_nearest() {
        let mut state = 7u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 40) as f64 / f64::from(1u32 << 24) * 1000.0
        };
        let marks: Vec<Mark> =
            (0..300).map(|_| mark(random(), random(), random(), random() * 0.01)).collect();
        let short = shorten_travel(marks.clone());
        assert_eq!(short.len(), marks.len());
        // The greedy choice by exhaustive search.
        let mut left = marks;
        let mut pen = Point::ZERO;
        for drawn in &short {
            let nearest = left
                .iter()
                .flat_map(|m| [first_point(m).unwrap(), last_point(m).unwrap()])
                .map(|p| (p - pen).hypot2())
                .fold(f64::INFINITY, f64::min);
            let start = first_point(drawn).unwrap();
            assert!((start - pen).hypot2() <= nearest);
            pen = last_point(drawn).unwrap();
            let at = left.iter().position(|m| {
                let ends = [first_point(m).unwrap(), last_point(m).unwrap()];
                ends.contains(&start) && ends.contains(&pen)
            });
            left.remove(at.unwrap());
        }
        assert!(left.is_empty());
    }

    #[test]
    fn shorten_travel_handles_empty_and_point_drawings() {
        assert!(shorten_travel(vec![]).is_empty());
        assert_eq!(shorten_travel(vec![mark(5.0, 5.0, 5.0, 5.0); 3]).len(), 3);
    }
}
