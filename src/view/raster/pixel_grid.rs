//! [`PixelGrid`]: a view on a grid of pixels, and the pixels that a triangle covers.
//!
//! Single precision is enough, because buffers only propose candidates. Nearness is scaled to the range 0 to
//! 1 first, so that distant eyes lose no digits.

use std::ops::Range;

use crate::parallel::prelude::*;
use glam::DVec3;

use crate::mesh::Mesh;
use crate::view::View;
use crate::view::tolerances;

/// Pixels along the longer side of the frame.
const DEFAULT_SIDE_PIXELS: f64 = 1024.0;
/// Largest bounding box, in pixels, that is tested pixel by pixel.
const MAX_SMALL_BOX_PIXELS: i32 = 16;

/// Corner on the pixel grid: x to the right and y down in pixels, and nearness.
pub(crate) type PixelPoint = [f32; 3];

/// A view on a grid of pixels.
#[derive(Debug, Clone)]
pub struct PixelGrid<'a> {
    mesh: &'a Mesh,
    view: &'a View,
    /// Pixels in a row.
    pub columns: usize,
    /// Number of rows.
    pub rows: usize,
    /// Pixels per user unit.
    scale: f64,
    /// Nearness of the farthest point, and the factor that scales nearness to the range 0 to 1.
    farthest: f64,
    per_nearness: f64,
    /// Each vertex; x is NaN where the near plane cuts it off.
    points: Vec<PixelPoint>,
}

/// Plane of a triangle over the pixels.
#[derive(Debug, Clone, Copy)]
struct PixelPlane {
    origin: PixelPoint,
    /// Change of nearness per pixel to the right and down.
    slope: [f32; 2],
}

impl PixelPlane {
    fn new([a, b, c]: [PixelPoint; 3]) -> Self {
        let (u, v) = (minus(b, a), minus(c, a));
        let area = u[0] * v[1] - u[1] * v[0];
        let per_area = 1.0 / area;
        let slope = [(u[2] * v[1] - v[2] * u[1]) * per_area, (u[0] * v[2] - v[0] * u[2]) * per_area];
        Self { origin: a, slope }
    }

    #[inline]
    fn at(&self, x: f32, y: f32) -> f32 {
        self.origin[2] + self.slope[0] * (x - self.origin[0]) + self.slope[1] * (y - self.origin[1])
    }
}

#[inline]
fn minus(a: PixelPoint, b: PixelPoint) -> PixelPoint {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

impl<'a> PixelGrid<'a> {
    /// Screen of a view, about a thousand pixels along the longer side of the frame.
    #[must_use]
    pub fn new(mesh: &'a Mesh, view: &'a View) -> Self {
        Self::of_side(mesh, view, DEFAULT_SIDE_PIXELS)
    }

    /// Screen of a view with `longer_side` pixels along the longer side of the frame.
    #[must_use]
    pub fn of_side(mesh: &'a Mesh, view: &'a View, longer_side: f64) -> Self {
        const POINTS_PER_TASK: usize = 1 << 14;
        let none = || (f64::INFINITY, f64::NEG_INFINITY);
        // Comparisons with NaN are false, so cut-off points are ignored.
        let (farthest, nearest) = view
            .points
            .par_iter()
            .with_min_len(POINTS_PER_TASK)
            .fold(none, |(low, high), p| {
                (if p.z < low { p.z } else { low }, if p.z > high { p.z } else { high })
            })
            .reduce(none, |a, b| (a.0.min(b.0), a.1.max(b.1)));
        let scale = longer_side / view.frame.width.max(view.frame.height);
        let pixels = |length: f64| (length * scale).ceil().clamp(1.0, longer_side.ceil()) as usize;
        let mut screen = Self {
            mesh,
            view,
            columns: pixels(view.frame.width),
            rows: pixels(view.frame.height),
            scale,
            farthest,
            per_nearness: if nearest > farthest { 1.0 / (nearest - farthest) } else { 0.0 },
            points: Vec::new(),
        };
        screen.points =
            view.points.par_iter().with_min_len(POINTS_PER_TASK).map(|p| screen.point(*p)).collect();
        screen
    }

    /// Screen point of a point of image space; x is NaN if the point is cut off.
    #[must_use]
    pub fn point(&self, p: DVec3) -> PixelPoint {
        let x = if p.z.is_nan() { f64::NAN } else { p.x * self.scale };
        [x as f32, (p.y * self.scale) as f32, ((p.z - self.farthest) * self.per_nearness) as f32]
    }

    /// Pixels per user unit.
    #[must_use]
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// Smallest and largest depth in the view, world units; `None` if the view is empty.
    #[must_use]
    pub fn depths(&self) -> Option<[f64; 2]> {
        let nearest = self.farthest + 1.0 / self.per_nearness;
        let nearest = if self.per_nearness > 0.0 { nearest } else { self.farthest };
        let frame = &self.view.frame;
        self.farthest.is_finite().then(|| [frame.depth_of(nearest), frame.depth_of(self.farthest)])
    }

    /// Image-space nearness of a nearness on the screen.
    #[inline]
    #[must_use]
    pub fn image_nearness(&self, nearness: f32) -> f64 {
        let range = if self.per_nearness > 0.0 { f64::from(nearness) / self.per_nearness } else { 0.0 };
        self.farthest + range
    }

    /// Number of triangles: those of the mesh, then the clipped parts of faces that the near plane cuts.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.mesh.triangles.len() + self.view.clipped.len()
    }

    /// Corners of a triangle and the face it belongs to.
    #[inline]
    #[must_use]
    pub fn triangle(&self, id: usize) -> ([PixelPoint; 3], u32) {
        match self.mesh.triangles.get(id) {
            Some(t) => (t.map(|v| self.points[v as usize]), id as u32),
            None => {
                let clipped = &self.view.clipped[id - self.mesh.triangles.len()];
                (clipped.points.map(|p| self.point(p)), clipped.face.0)
            }
        }
    }

    /// Pixels whose centres lie in the bounding box of a triangle: first column and one past the last, then
    /// the rows. `None` if there are none.
    #[inline]
    fn pixel_box(&self, [a, b, c]: &[PixelPoint; 3]) -> Option<[i32; 4]> {
        let clamped = |x: f32, count: usize| x.max(0.0).min(count as f32) as i32;
        let low = |axis: usize| a[axis].min(b[axis]).min(c[axis]) + (0.5 - tolerances::COVER_MARGIN_PIXELS);
        let high = |axis: usize| a[axis].max(b[axis]).max(c[axis]) + (0.5 + tolerances::COVER_MARGIN_PIXELS);
        let (left, right) = (clamped(low(0), self.columns), clamped(high(0), self.columns));
        let (top, bottom) = (clamped(low(1), self.rows), clamped(high(1), self.rows));
        ((left < right) & (top < bottom)).then_some([left, right, top, bottom])
    }

    /// Rows where a triangle may cover pixels; `None` if it covers none.
    #[inline]
    pub(crate) fn rows_of(&self, corners: &[PixelPoint; 3]) -> Option<Range<usize>> {
        self.pixel_box(corners).map(|[_, _, top, bottom]| top as usize..bottom as usize)
    }

    /// Calls `visit` with each pixel whose centre a triangle covers, and its nearness there.
    #[inline]
    pub fn cover(&self, corners: &[PixelPoint; 3], visit: impl FnMut(usize, f32)) {
        self.cover_within(0..self.rows, corners, visit);
    }

    /// Calls `visit` with the pixels of some rows as [`PixelGrid::cover`] does.
    #[inline]
    pub(crate) fn cover_within(
        &self,
        rows: Range<usize>,
        corners: &[PixelPoint; 3],
        visit: impl FnMut(usize, f32),
    ) {
        let Some([left, right, top, bottom]) = self.pixel_box(corners) else { return };
        let within = [left, right, top.max(rows.start as i32), bottom.min(rows.end as i32)];
        // All rows of a triangle use the same method.
        if (right - left) * (bottom - top) <= MAX_SMALL_BOX_PIXELS {
            self.cover_small_box(corners, within, visit);
        } else {
            self.cover_rows(corners, within, visit);
        }
    }

    /// Tests four pixels at a time. Nearly all triangles of a scan fit between two rows and columns.
    #[inline]
    fn cover_small_box(
        &self,
        &[a, b, c]: &[PixelPoint; 3],
        [left, right, top, bottom]: [i32; 4],
        mut visit: impl FnMut(usize, f32),
    ) {
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        if area == 0.0 || !area.is_finite() {
            return;
        }
        // Corners are reordered so that inside is positive.
        let (b, c) = if area > 0.0 { (b, c) } else { (c, b) };
        for row in (top..bottom).step_by(2) {
            for column in (left..right).step_by(2) {
                let (x, y) = (column as f32 + 0.5, row as f32 + 0.5);
                let quad = PixelQuad { x: [x, x + 1.0, x, x + 1.0], y: [y, y, y + 1.0, y + 1.0] };
                let (at_a, by_a) = quad.side(b, c);
                let (at_b, by_b) = quad.side(c, a);
                let (at_c, by_c) = quad.side(a, b);
                let first = row as usize * self.columns + column as usize;
                let (right_too, below_too) = (column + 1 < right, row + 1 < bottom);
                let quad_pixels = [
                    (true, first),
                    (right_too, first + 1),
                    (below_too, first + self.columns),
                    (right_too & below_too, first + self.columns + 1),
                ];
                for (i, (in_box, pixel)) in quad_pixels.into_iter().enumerate() {
                    if in_box & by_a[i] & by_b[i] & by_c[i] {
                        let q = (at_a[i] * a[2] + at_b[i] * b[2] + at_c[i] * c[2]) / area.abs();
                        visit(pixel, within_corners(q, a, b, c));
                    }
                }
            }
        }
    }

    /// Covers row by row, using the columns inside all sides.
    fn cover_rows(
        &self,
        &[a, b, c]: &[PixelPoint; 3],
        [left, right, top, bottom]: [i32; 4],
        mut visit: impl FnMut(usize, f32),
    ) {
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        if area == 0.0 || !area.is_finite() {
            return;
        }
        let plane = PixelPlane::new([a, b, c]);
        let sides = [(a, b), (b, c), (c, a)].map(|(p, q)| PixelSide::new(p, q, area));
        for row in top..bottom {
            let y = row as f32 + 0.5;
            let first = row as usize * self.columns;
            for column in span(&sides, f64::from(y), f64::from(left), f64::from(right)) {
                let q = plane.at(column as f32 + 0.5, y);
                visit(first + column, within_corners(q, a, b, c));
            }
        }
    }
}

/// Centres of four pixels.
struct PixelQuad {
    x: [f32; 4],
    y: [f32; 4],
}

impl PixelQuad {
    /// Twice the signed areas between a side and the centres, and whether the centres are on its inner side.
    #[inline]
    fn side(&self, p: PixelPoint, q: PixelPoint) -> ([f32; 4], [bool; 4]) {
        let (dx, dy) = (q[0] - p[0], q[1] - p[1]);
        let threshold = -tolerances::COVER_MARGIN_PIXELS * (dx.abs() + dy.abs());
        let mut areas = [0.0; 4];
        let mut inside = [false; 4];
        for i in 0..4 {
            areas[i] = dx * (self.y[i] - p[1]) - dy * (self.x[i] - p[0]);
            inside[i] = areas[i] >= threshold;
        }
        (areas, inside)
    }
}

/// Clamps a nearness to the range of the three corners, which the planes of steep triangles leave within a
/// pixel.
#[inline]
fn within_corners(q: f32, a: PixelPoint, b: PixelPoint, c: PixelPoint) -> f32 {
    q.min(a[2].max(b[2]).max(c[2])).max(a[2].min(b[2]).min(c[2])).max(0.0)
}

/// Side of a triangle, oriented so that inside is the same for all three.
struct PixelSide {
    x: f64,
    y: f64,
    dx: f64,
    dy: f64,
    slack: f64,
}

impl PixelSide {
    #[inline]
    fn new(p: PixelPoint, q: PixelPoint, area: f32) -> Self {
        let sign = f64::from(area.signum());
        let [x, y, qx, qy] = [p[0], p[1], q[0], q[1]].map(f64::from);
        let (dx, dy) = ((qx - x) * sign, (qy - y) * sign);
        Self { x, y, dx, dy, slack: f64::from(tolerances::COVER_MARGIN_PIXELS) * (dx.abs() + dy.abs()) }
    }
}

/// Columns from `left` up to `right` whose centres lie inside all sides, in the row at `y`.
#[inline]
fn span(sides: &[PixelSide; 3], y: f64, left: f64, right: f64) -> Range<usize> {
    let (mut from, mut to) = (left, right);
    for side in sides {
        let room = side.dx * (y - side.y) + side.slack;
        // Inside is dy · (x − px) ≤ room.
        let x = side.x + room / side.dy;
        if side.dy > 0.0 {
            to = to.min(x + 0.5);
        } else if side.dy < 0.0 {
            from = from.max(x - 0.5);
        } else if room < 0.0 {
            return 0..0;
        }
    }
    // Integer conversions are much faster than rounding functions.
    let from = from.min(right);
    let truncated = from as usize;
    truncated + usize::from(from > truncated as f64)..to.max(0.0) as usize
}
