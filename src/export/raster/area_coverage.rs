//! Fills paths on a pixel image with exact anti-aliasing: each pixel's coverage is the area of the path
//! inside it.
//!
//! Input: a path, a transform to pixels and a colour. Output: painted pixels of a pixmap.
//!
//! 1. Each edge of the path adds its signed height, and the signed area to its right, to the cells (pixels)
//!    that it crosses.
//! 2. A sweep along each row sums both. The result is the area of the path inside each pixel, times the
//!    winding number.
//! 3. Cells are stored only where edges pass, so the cost of an edge is proportional to its length.
//!
//! Where parts of one path overlap inside a pixel, their areas add up, to one at most.
//!
//! Source: the rasterisers of LibArt (Levien) and FreeType (Turner), which accumulate signed areas in cells.

use tiny_skia::{Path, PathSegment, PixmapMut, Point, PremultipliedColorU8, Transform};

/// Largest distance between a curve and its chords, pixels.
const FLATNESS_PX: f64 = 0.01;

/// Maximum number of chords per curve.
const MAX_CHORDS: f64 = 1000.0;

/// Fill rule.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Winding {
    /// Points with a winding number other than zero are inside.
    NonZero,
    /// Points with an odd winding number are inside.
    EvenOdd,
}

/// Contribution of consecutive edges to one pixel.
#[derive(Debug, Clone, Copy)]
struct CoverageCell {
    row: u32,
    column: u32,
    /// Signed height of the edges inside the pixel.
    height: f64,
    /// Signed area between the edges and the right side of the pixel.
    area: f64,
}

/// Accumulator of the coverage of one path on a canvas.
pub(crate) struct Coverage {
    width: f64,
    height: f64,
    cells: Vec<CoverageCell>,
}

impl Coverage {
    /// Creates an empty coverage for a canvas in pixels.
    pub(crate) fn new(width: u32, height: u32) -> Self {
        Self { width: f64::from(width), height: f64::from(height), cells: Vec::new() }
    }

    /// Adds the edges of a path and closes open contours. `to` transforms the path to pixels.
    pub(crate) fn add(&mut self, path: &Path, to: Transform) {
        let [sx, kx, ky, sy, tx, ty] = [to.sx, to.kx, to.ky, to.sy, to.tx, to.ty].map(f64::from);
        let place = |p: Point| {
            let [x, y] = [p.x, p.y].map(f64::from);
            [sx * x + kx * y + tx, ky * x + sy * y + ty]
        };
        let (mut start, mut last) = ([0.0; 2], [0.0; 2]);
        for segment in path.segments() {
            match segment {
                PathSegment::MoveTo(p) => {
                    self.edge(last, start);
                    start = place(p);
                    last = start;
                }
                PathSegment::LineTo(p) => {
                    let p = place(p);
                    self.edge(last, p);
                    last = p;
                }
                PathSegment::QuadTo(q, p) => {
                    let [q, p] = [q, p].map(place);
                    let third = |a: [f64; 2]| [0, 1].map(|k| a[k] + (q[k] - a[k]) * 2.0 / 3.0);
                    self.curve([last, third(last), third(p), p]);
                    last = p;
                }
                PathSegment::CubicTo(q, r, p) => {
                    let [q, r, p] = [q, r, p].map(place);
                    self.curve([last, q, r, p]);
                    last = p;
                }
                PathSegment::Close => {
                    self.edge(last, start);
                    last = start;
                }
            }
        }
        self.edge(last, start);
    }

    /// Adds a cubic curve as chords.
    fn curve(&mut self, [a, b, c, d]: [[f64; 2]; 4]) {
        let bend = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
            let [x, y] = [0, 1].map(|k| a[k] - 2.0 * b[k] + c[k]);
            (x * x + y * y).sqrt()
        };
        // The error of n chords of a cubic is at most 6/8 of its largest second difference over n squared.
        // Source: Wang 1984.
        let chords = (0.75 * bend(a, b, c).max(bend(b, c, d)) / FLATNESS_PX).sqrt().ceil();
        let chords = if chords.is_finite() { chords.clamp(1.0, MAX_CHORDS) } else { 1.0 };
        let mut last = a;
        for k in 1..chords as u32 {
            let t = f64::from(k) / chords;
            let s = 1.0 - t;
            let weights = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
            let point =
                [0, 1].map(|k| a[k] * weights[0] + b[k] * weights[1] + c[k] * weights[2] + d[k] * weights[3]);
            self.edge(last, point);
            last = point;
        }
        self.edge(last, d);
    }

    /// Adds an edge clipped to the canvas. Parts left of the canvas are moved onto its left side, because
    /// they change the winding number to their right. Parts right of the canvas have no effect.
    fn edge(&mut self, from: [f64; 2], to: [f64; 2]) {
        if ![from, to].iter().flatten().all(|value| value.is_finite()) {
            return;
        }
        let (top, bottom, sign) = if from[1] <= to[1] { (from, to, 1.0) } else { (to, from, -1.0) };
        let (y0, y1) = (top[1].max(0.0), bottom[1].min(self.height));
        if y0 >= y1 {
            return;
        }
        let slope = (bottom[0] - top[0]) / (bottom[1] - top[1]);
        let at = |y: f64| top[0] + (y - top[1]) * slope;
        let within = |x: f64| x.clamp(top[0].min(bottom[0]), top[0].max(bottom[0]));
        // Crossings with the left and right sides of the canvas, in order of y.
        let mut cuts = [0.0, self.width].map(|x| top[1] + (x - top[0]) / slope);
        if slope < 0.0 {
            cuts.reverse();
        }
        let mut upper = y0;
        for lower in cuts.map(|y| if y.is_nan() { y1 } else { y.clamp(y0, y1) }).into_iter().chain([y1]) {
            if lower > upper {
                let middle = at(f64::midpoint(upper, lower));
                let [x0, x1] = [upper, lower].map(|y| within(at(y)));
                if middle <= 0.0 {
                    self.clipped([0.0, upper], [0.0, lower], sign);
                } else if middle < self.width {
                    let [x0, x1] = [x0, x1].map(|x| x.clamp(0.0, self.width));
                    self.clipped([x0, upper], [x1, lower], sign);
                }
                upper = lower;
            }
        }
    }

    /// Adds an edge inside the canvas that runs down, or up if `sign` is negative.
    fn clipped(&mut self, [x0, y0]: [f64; 2], [x1, y1]: [f64; 2], sign: f64) {
        let slope = (x1 - x0) / (y1 - y0);
        let mut x = x0;
        let mut y = y0;
        let mut row = y0.floor();
        while y < y1 {
            let next = (row + 1.0).min(y1);
            let end = if next >= y1 { x1 } else { (x0 + (next - y0) * slope).clamp(x0.min(x1), x0.max(x1)) };
            self.in_row(row, [x, end], (next - y) * sign);
            (x, y, row) = (end, next, row + 1.0);
        }
    }

    /// Adds an edge inside one row, from `x0` to `x1`, with a signed height.
    fn in_row(&mut self, row: f64, [x0, x1]: [f64; 2], height: f64) {
        let (left, right) = if x0 <= x1 { (x0, x1) } else { (x1, x0) };
        let last = self.width - 1.0;
        let (first, end) = (left.floor().min(last), right.floor().min(last));
        let mut add = |column: f64, height: f64, middle: f64| {
            let (row, column) = (row as u32, column as u32);
            let area = height * (f64::from(column) + 1.0 - middle);
            match self.cells.last_mut() {
                Some(cell) if cell.row == row && cell.column == column => {
                    cell.height += height;
                    cell.area += area;
                }
                _ => self.cells.push(CoverageCell { row, column, height, area }),
            }
        };
        if first >= end {
            add(first, height, f64::midpoint(left, right));
            return;
        }
        let per_px = height / (right - left);
        let mut from = left;
        let mut column = first;
        while column <= end {
            let to = if column < end { column + 1.0 } else { right };
            if to > from {
                add(column, per_px * (to - from), f64::midpoint(from, to));
            }
            (from, column) = (to, column + 1.0);
        }
    }

    /// Paints the covered pixels. The canvas must have the size given to [`Self::new`].
    pub(crate) fn paint(mut self, ink: CoverageInk, winding: Winding, pixmap: &mut PixmapMut) {
        self.cells.sort_by_key(|cell| (cell.row, cell.column));
        let columns = pixmap.width() as usize;
        let pixels = pixmap.pixels_mut();
        for cells in self.cells.chunk_by(|a, b| a.row == b.row) {
            let Some(row) = cells.first().map(|cell| cell.row as usize * columns) else { continue };
            let Some(line) = pixels.get_mut(row..row + columns) else { continue };
            let (mut sum, mut next) = (0.0, 0);
            for cells in cells.chunk_by(|a, b| a.column == b.column) {
                let Some(column) = cells.first().map(|cell| cell.column as usize) else { continue };
                ink.run(line.get_mut(next..column), winding.inside(sum));
                let area: f64 = cells.iter().map(|cell| cell.area).sum();
                ink.run(line.get_mut(column..=column), winding.inside(sum + area));
                sum += cells.iter().map(|cell| cell.height).sum::<f64>();
                next = column + 1;
            }
            // Edges right of the canvas were dropped, so the area extends to its right side.
            ink.run(line.get_mut(next..), winding.inside(sum));
        }
    }
}

impl Winding {
    /// Covered share of a pixel, 0 to 1, from the sum of its signed areas.
    fn inside(self, sum: f64) -> f64 {
        match self {
            Self::NonZero => sum.abs().min(1.0),
            Self::EvenOdd => {
                let rest = sum.abs() % 2.0;
                if rest > 1.0 { 2.0 - rest } else { rest }
            }
        }
    }
}

/// The colour that a path is filled with.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CoverageInk {
    /// Channels, 0 to 255, not premultiplied.
    rgb: [f64; 3],
    /// Opacity, 0 to 1.
    opacity: f64,
    /// Whether pixels are covered completely or not at all.
    is_crisp: bool,
}

impl CoverageInk {
    /// Ink with channels from 0 to 255 and an opacity from 0 to 1.
    pub(crate) fn new(rgb: [u8; 3], opacity: f64) -> Self {
        Self { rgb: rgb.map(f64::from), opacity: opacity.clamp(0.0, 1.0), is_crisp: false }
    }

    /// The same ink without anti-aliasing.
    pub(crate) fn crisp(self) -> Self {
        Self { is_crisp: true, ..self }
    }

    /// Paints a run of pixels of equal coverage over their present colours (source-over).
    fn run(self, pixels: Option<&mut [PremultipliedColorU8]>, coverage: f64) {
        let Some(pixels) = pixels.filter(|pixels| !pixels.is_empty()) else { return };
        let coverage = match self.is_crisp {
            true if coverage >= 0.5 => 1.0,
            true => 0.0,
            false => coverage,
        };
        let alpha = coverage * self.opacity;
        // Less than half a step of 8-bit alpha has no effect.
        if alpha * 510.0 < 1.0 {
            return;
        }
        let keeps = 1.0 - alpha;
        let over = |below: u8, own: f64| (own * alpha + f64::from(below) * keeps).round() as u8;
        let [red, green, blue] = self.rgb;
        let mut before: Option<(PremultipliedColorU8, PremultipliedColorU8)> = None;
        for pixel in pixels {
            let after = match before {
                Some((below, after)) if below == *pixel => Some(after),
                _ => {
                    let a = over(pixel.alpha(), 255.0);
                    let [r, g, b] = [(pixel.red(), red), (pixel.green(), green), (pixel.blue(), blue)]
                        .map(|(below, own)| over(below, own).min(a));
                    PremultipliedColorU8::from_rgba(r, g, b, a)
                }
            };
            if let Some(after) = after {
                before = Some((*pixel, after));
                *pixel = after;
            }
        }
    }
}
