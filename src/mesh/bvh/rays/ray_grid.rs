//! [`RayGrid`]: grid over the plane perpendicular to parallel rays, with the rays sorted into its cells.

use std::ops::Range;

/// Mean number of rays per cell.
const MEAN_RAYS_PER_CELL: usize = 2;

/// Ray projected along its direction.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct GridRay {
    pub at: [f32; 2],
    /// Range along the direction. It starts at infinity once the ray is blocked.
    pub from: f32,
    pub to: f32,
    pub id: u32,
}

/// Box in ray space, with the third axis along the rays.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RayBox {
    pub low: [f32; 3],
    pub high: [f32; 3],
}

impl RayBox {
    /// Whether a ray misses the box.
    #[inline]
    pub(crate) fn is_beside(&self, ray: &GridRay) -> bool {
        let ([x, y], Self { low, high }) = (ray.at, self);
        (ray.from > high[2]) | (ray.to < low[2]) | (x < low[0]) | (x > high[0]) | (y < low[1]) | (y > high[1])
    }
}

/// Rays of one direction, sorted by cell. The cells of a row are consecutive.
pub(crate) struct RayGrid {
    low: [f32; 2],
    /// Cells per unit of length.
    scale: [f32; 2],
    /// Number of columns and rows.
    size: [usize; 2],
    /// Index of the first ray of each cell.
    starts: Vec<u32>,
    /// Range along the direction that the rays of each cell cover together.
    spans: Vec<[f32; 2]>,
}

impl RayGrid {
    /// Sorts rays, given by start (third coordinate along the direction) and reach.
    pub(crate) fn sort(rays: impl ExactSizeIterator<Item = ([f32; 3], f32)> + Clone) -> (Self, Vec<GridRay>) {
        let nothing = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        let (low, high) = rays.clone().fold(nothing, |(low, high), (at, _)| {
            ([0, 1, 2].map(|k| low[k].min(at[k])), [0, 1, 2].map(|k| high[k].max(at[k])))
        });
        let extent = [0, 1].map(|k| (high[k] - low[k]).max(0.0));
        // Cells are square, unless all rays lie on a line.
        let cells = (rays.len() / MEAN_RAYS_PER_CELL).max(1);
        let of_line = extent[0].max(extent[1]) / cells as f32;
        let side = (extent[0] * extent[1] / cells as f32).sqrt().max(of_line);
        let size =
            extent.map(|extent| if side > 0.0 { ((extent / side) as usize).clamp(1, cells) } else { 1 });
        let scale = [0, 1].map(|k| if extent[k] > 0.0 { size[k] as f32 / extent[k] } else { 0.0 });
        let count = size[0] * size[1];
        let mut grid = Self {
            low: [low[0], low[1]],
            scale,
            size,
            starts: vec![0; count + 1],
            spans: vec![[f32::INFINITY, f32::NEG_INFINITY]; count],
        };
        let mut sorted = vec![GridRay::default(); rays.len()];
        let cells: Vec<u32> = rays.clone().map(|(at, _)| grid.cell(at) as u32).collect();
        cells.iter().for_each(|cell| grid.starts[*cell as usize] += 1);
        let mut total = 0;
        for start in &mut grid.starts {
            total += *start;
            *start = total;
        }
        // Filled from the back, so that the starts move from the ends of the cells to their beginnings.
        for (id, (cell, ([x, y, from], reach))) in cells.iter().zip(rays).enumerate() {
            let cell = *cell as usize;
            grid.starts[cell] -= 1;
            let ray = GridRay { at: [x, y], from, to: from + reach, id: id as u32 };
            grid.spans[cell] = [grid.spans[cell][0].min(from), grid.spans[cell][1].max(ray.to)];
            sorted[grid.starts[cell] as usize] = ray;
        }
        (grid, sorted)
    }

    /// Number of cells that a box covers.
    #[inline]
    pub(crate) fn cells(&self, around: &RayBox) -> usize {
        self.lines(around).len() * self.lines(around).next().map_or(0, |cells| cells.len())
    }

    /// Whether a box may block a ray, by the ranges of its cells.
    #[inline]
    pub(crate) fn may_meet(&self, around: &RayBox) -> bool {
        self.lines(around).any(|cells| self.may_meet_in(cells, around))
    }

    /// Ranges of the rays in the cells that a box covers, row by row. Rows where it blocks no ray are
    /// skipped.
    #[inline]
    pub(crate) fn rows(&self, around: &RayBox) -> impl Iterator<Item = Range<usize>> {
        let lines = self.lines(around).filter(|cells| self.may_meet_in(cells.clone(), around));
        lines.map(|cells| self.starts[cells.start] as usize..self.starts[cells.end] as usize)
    }

    #[inline]
    fn may_meet_in(&self, cells: Range<usize>, RayBox { low, high }: &RayBox) -> bool {
        self.spans[cells].iter().any(|[from, to]| (*from <= high[2]) & (*to >= low[2]))
    }

    /// The cells that a box covers, row by row.
    #[inline]
    fn lines(&self, RayBox { low, high }: &RayBox) -> impl ExactSizeIterator<Item = Range<usize>> + use<> {
        let is_beside =
            |k: usize| high[k] < self.low[k] || (low[k] - self.low[k]) * self.scale[k] > self.size[k] as f32;
        let rows = if self.low[0] == f32::INFINITY || is_beside(0) || is_beside(1) {
            0..0
        } else {
            self.index(1, low[1])..self.index(1, high[1]) + 1
        };
        let (first, last) = (self.index(0, low[0]), self.index(0, high[0]));
        let columns = self.size[0];
        rows.map(move |row| row * columns + first..row * columns + last + 1)
    }

    fn index(&self, axis: usize, x: f32) -> usize {
        (((x - self.low[axis]) * self.scale[axis]) as usize).min(self.size[axis] - 1)
    }

    fn cell(&self, at: [f32; 3]) -> usize {
        self.index(1, at[1]) * self.size[0] + self.index(0, at[0])
    }
}
