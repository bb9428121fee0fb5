//! Pen travel: paths ordered and reversed to shorten the pen-up ways between them.
//!
//! Algorithm: nearest neighbour over the ends of all paths. The search uses a grid over the page that is
//! rebuilt as it empties.

use kurbo::{BezPath, PathEl, Point};

use super::tolerances;
use crate::drawing::{Layer, Mark, Paint};

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
    let mut paths: Vec<BezPath> = Vec::new();
    for element in mark.path.elements() {
        match (element, paths.last_mut()) {
            (PathEl::MoveTo(_), _) | (_, None) => paths.push(BezPath::from_vec(vec![*element])),
            (_, Some(path)) => path.push(*element),
        }
    }
    let begun = paths.into_iter().filter(|path| path.elements().len() > 1);
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
    origin: Point,
    cell: f64,
    columns: usize,
    rows: usize,
    cells: Vec<Vec<PathEnd>>,
}

impl PathEndGrid {
    /// A grid with about two ends per cell.
    fn new(ends: &[PathEnd]) -> Self {
        let mut low = Point::new(f64::INFINITY, f64::INFINITY);
        let mut high = Point::new(f64::NEG_INFINITY, f64::NEG_INFINITY);
        for end in ends {
            low = Point::new(low.x.min(end.at.x), low.y.min(end.at.y));
            high = Point::new(high.x.max(end.at.x), high.y.max(end.at.y));
        }
        let (width, height) = (
            (high.x - low.x).max(tolerances::MIN_GRID_EXTENT_UNITS),
            (high.y - low.y).max(tolerances::MIN_GRID_EXTENT_UNITS),
        );
        // The longer side limits the number of cells for a thin drawing.
        let longer = width.max(height);
        let wished = (ends.len() as f64 / 2.0).max(1.0);
        let cell = (width * height / wished).sqrt().max(longer / wished);
        let columns = (width / cell) as usize + 1;
        let rows = (height / cell) as usize + 1;
        let mut grid = Self { origin: low, cell, columns, rows, cells: vec![Vec::new(); columns * rows] };
        for end in ends {
            let (column, row) = grid.cell_of(end.at);
            grid.cells[row * columns + column].push(*end);
        }
        grid
    }

    /// The cell of a point, or the closest cell.
    fn cell_of(&self, at: Point) -> (usize, usize) {
        let column = ((at.x - self.origin.x) / self.cell).max(0.0) as usize;
        let row = ((at.y - self.origin.y) / self.cell).max(0.0) as usize;
        (column.min(self.columns - 1), row.min(self.rows - 1))
    }

    /// The closest end of a mark not yet drawn. Among equally close ends, the first mark wins.
    fn take_nearest(&mut self, pen: Point, used: &[bool]) -> Option<PathEnd> {
        let (column, row) = self.cell_of(pen);
        let mut best: Option<(f64, usize, bool, PathEnd)> = None;
        for ring in 0..self.columns.max(self.rows) {
            // Cells of this ring are at least this far from any point of the middle cell.
            let nearest = (ring.saturating_sub(1)) as f64 * self.cell;
            if best.is_some_and(|(distance, ..)| distance < nearest * nearest) {
                break;
            }
            for r in row.saturating_sub(ring)..=(row + ring).min(self.rows - 1) {
                let whole_row = r + ring == row || r == row + ring;
                let step = if whole_row || ring == 0 { 1 } else { 2 * ring };
                let first = column as isize - ring as isize;
                for c in (first..=(column + ring) as isize).step_by(step) {
                    if c < 0 || c as usize >= self.columns {
                        continue;
                    }
                    let cell = &mut self.cells[r * self.columns + c as usize];
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
            paint: Paint::Stroke(StrokePaint {
                width: 1.0,
                colour: Colour::BLACK,
                cap: Cap::Round,
                join: Join::Round,
                dash: vec![],
                dash_offset: 0.0,
            }),
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
