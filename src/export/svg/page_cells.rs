//! Conservative test whether marks may touch, by the cells of the page that they may paint.
//!
//! Two marks without a common cell have no common pixel at any resolution, so they may be painted in either
//! order.

use kurbo::{Affine, BezPath, PathEl, Point, flatten};

use crate::drawing::{Length, Mark, Page, Paint};

/// Cells along the longer side of the page.
const CELLS_PER_SIDE: f64 = 256.0;

/// Reach of anti-aliasing around a mark, in px at 96 per inch.
const BLUR_PX: f64 = 1.5;

/// Reach of a mitred corner, in half line widths.
const MITER_LIMIT: f64 = 4.0;

/// The page divided into square cells.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PageCells {
    size: f64,
    blur: f64,
    columns: i32,
    rows: i32,
}

impl PageCells {
    /// The cells of a page.
    pub(crate) fn of(page: &Page) -> Self {
        let px = Length::px(1.0).in_unit(page.unit);
        let size = (page.width.max(page.height) / CELLS_PER_SIDE).max(f64::MIN_POSITIVE);
        let count = |length: f64| (length / size).ceil().clamp(1.0, CELLS_PER_SIDE) as i32;
        Self { size, blur: BLUR_PX * px, columns: count(page.width), rows: count(page.height) }
    }

    /// Cells that a mark may paint, sorted and unique.
    pub(crate) fn cells_of(&self, mark: &Mark) -> Vec<u32> {
        let (reach, filled) = match &mark.paint {
            Paint::Stroke(stroke) => (MITER_LIMIT * stroke.width / 2.0, false),
            Paint::Fill(_) | Paint::Gradient(_) | Paint::Outline(_) | Paint::Image(_) => (0.0, true),
        };
        let mut found = Vec::new();
        let sides = self.sides(&mark.path, filled);
        let margin = (reach + self.blur) / self.size;
        for [from, to] in &sides {
            self.add_side(&mut found, *from, *to, margin);
        }
        if filled {
            self.add_inside(&mut found, &sides);
        }
        found.sort_unstable();
        found.dedup();
        found
    }

    /// Straight segments of a path in cell units. For fills, open subpaths are closed.
    fn sides(&self, path: &BezPath, filled: bool) -> Vec<[Point; 2]> {
        let mut sides = Vec::new();
        let (mut begun, mut pen) = (Point::ZERO, Point::ZERO);
        let path = Affine::scale(1.0 / self.size) * path.clone();
        flatten(&path, 0.1, |element| match element {
            PathEl::MoveTo(to) => {
                if filled && pen != begun {
                    sides.push([pen, begun]);
                }
                (begun, pen) = (to, to);
                // A subpath may be a single point.
                sides.push([to, to]);
            }
            PathEl::LineTo(to) => {
                sides.push([pen, to]);
                pen = to;
            }
            PathEl::ClosePath => {
                sides.push([pen, begun]);
                pen = begun;
            }
            PathEl::QuadTo(..) | PathEl::CurveTo(..) => {}
        });
        if filled && pen != begun {
            sides.push([pen, begun]);
        }
        sides
    }

    /// Adds the cells within `margin` of a segment; all lengths in cells.
    fn add_side(&self, found: &mut Vec<u32>, from: Point, to: Point, margin: f64) {
        // Limit the steps of segments far off the page. On the page, a segment is at most as long as the page
        // plus a cell.
        let steps = (to - from).hypot().ceil().clamp(1.0, 4.0 * CELLS_PER_SIDE);
        // The path was flattened within a tenth of a cell.
        let margin = margin + 0.1 + 0.5 * ((to - from).hypot() / steps - 1.0).max(0.0);
        for step in 0..steps as u32 {
            let [a, b] = [step, step + 1].map(|k| from.lerp(to, f64::from(k) / steps));
            let column = |x: f64| (x.floor().clamp(-1.0, f64::from(self.columns))) as i32;
            let row = |y: f64| (y.floor().clamp(-1.0, f64::from(self.rows))) as i32;
            for y in row(a.y.min(b.y) - margin).max(0)..=row(a.y.max(b.y) + margin).min(self.rows - 1) {
                let columns = column(a.x.min(b.x) - margin).max(0)
                    ..=column(a.x.max(b.x) + margin).min(self.columns - 1);
                found.extend(columns.map(|x| (y * self.columns + x) as u32));
            }
        }
    }

    /// Adds the cells whose centre is inside. Cells on the border were added with the segments.
    fn add_inside(&self, found: &mut Vec<u32>, sides: &[[Point; 2]]) {
        let mut crossings: Vec<Vec<(f64, i32)>> = vec![Vec::new(); usize::try_from(self.rows).unwrap_or(0)];
        for [from, to] in sides {
            let (low, high, turn) = if from.y < to.y { (from, to, 1) } else { (to, from, -1) };
            let begin = (low.y - 0.5).ceil().clamp(0.0, f64::from(self.rows)) as usize;
            let end = (high.y - 0.5).ceil().clamp(0.0, f64::from(self.rows)) as usize;
            for (row, crossed) in crossings.iter_mut().enumerate().take(end).skip(begin) {
                let t = (row as f64 + 0.5 - low.y) / (high.y - low.y);
                crossed.push((low.x + (high.x - low.x) * t, turn));
            }
        }
        for (row, crossed) in crossings.iter_mut().enumerate() {
            crossed.sort_by(|a, b| a.0.total_cmp(&b.0));
            let mut winding = 0;
            for pair in crossed.windows(2) {
                winding += pair[0].1;
                if winding == 0 {
                    continue;
                }
                let column = |x: f64| (x - 0.5).ceil().clamp(0.0, f64::from(self.columns)) as u32;
                let first = row as u32 * self.columns as u32;
                found.extend((column(pair[0].0)..column(pair[1].0)).map(|x| first + x));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::colour::srgb::Colour;
    use crate::drawing::{Provenance, Unit};

    #[test]
    fn cells_of_a_ring_exclude_the_cells_of_its_hole() {
        let page = Page { width: 256.0, height: 256.0, unit: Unit::Px, background: None };
        let ring = "M28 128A100 100 0 0 1 228 128A100 100 0 0 1 28 128ZM78 128A50 50 0 0 0 178 128A50 50 0 0 0 78 128Z";
        let mark = Mark {
            path: BezPath::from_svg(ring).unwrap(),
            paint: Paint::Fill(Colour::BLACK),
            provenance: Provenance::default(),
        };
        let under = PageCells::of(&page).cells_of(&mark);
        for y in 0..256u32 {
            for x in 0..256u32 {
                let far =
                    (Point::new(f64::from(x) + 0.5, f64::from(y) + 0.5) - Point::new(128.0, 128.0)).hypot();
                let is_under = under.binary_search(&(y * 256 + x)).is_ok();
                if far > 50.0 && far < 100.0 {
                    assert!(is_under, "{x} {y}");
                } else if !(46.0..=104.0).contains(&far) {
                    assert!(!is_under, "{x} {y}");
                }
            }
        }
    }

    #[test]
    fn cells_of_a_mark_off_the_page_are_few() {
        let page = Page { width: 100.0, height: 1.0, unit: Unit::Mm, background: None };
        for data in ["M-1e300 0L1e300 1e300Z", "M0 0", "M1e9 1e9L2e9 1e9", ""] {
            let path = BezPath::from_svg(data).unwrap();
            let mark = Mark { path, paint: Paint::Fill(Colour::BLACK), provenance: Provenance::default() };
            assert!(PageCells::of(&page).cells_of(&mark).len() <= 256 * 3);
        }
    }
}
