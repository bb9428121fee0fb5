//! [`RayGrid`]: the cells of a grid over the plane across parallel rays, and the rays sorted into them.

use std::ops::Range;

/// Rays in a cell, on the mean.
const RAYS_OF_CELL: usize = 2;

/// A ray in the plane across it.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct GridRay {
    pub at: [f32; 2],
    /// From where to where along the direction; from infinity when it is blocked.
    pub from: f32,
    pub to: f32,
    pub id: u32,
}

/// A box around something, the third axis along the rays.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Around {
    pub low: [f32; 3],
    pub high: [f32; 3],
}

impl Around {
    /// Whether a ray passes it.
    #[inline]
    pub fn is_beside(&self, ray: &GridRay) -> bool {
        let ([x, y], Self { low, high }) = (ray.at, self);
        (ray.from > high[2]) | (ray.to < low[2]) | (x < low[0]) | (x > high[0]) | (y < low[1]) | (y > high[1])
    }
}

/// Where the rays of each cell are among those of one direction: one after another, and so those of a row of cells.
pub(crate) struct RayGrid {
    low: [f32; 2],
    /// Cells a unit of length.
    scale: [f32; 2],
    /// Columns and rows.
    size: [usize; 2],
    /// Where the rays of each cell begin.
    starts: Vec<u32>,
    /// From where to where along the direction the rays of each cell go, all together.
    spans: Vec<[f32; 2]>,
}

impl RayGrid {
    /// Sorts rays, of which each tells where it begins (the last coordinate along the direction), and its reach.
    pub fn sort(rays: impl ExactSizeIterator<Item = ([f32; 3], f32)> + Clone) -> (Self, Vec<GridRay>) {
        let nothing = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        let (low, high) = rays.clone().fold(nothing, |(low, high), (at, _)| {
            ([0, 1, 2].map(|k| low[k].min(at[k])), [0, 1, 2].map(|k| high[k].max(at[k])))
        });
        let extent = [0, 1].map(|k| (high[k] - low[k]).max(0.0));
        // Square cells, where the rays are not all in a line.
        let cells = (rays.len() / RAYS_OF_CELL).max(1);
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
        // Filled from behind, the starts move from the ends of the cells to their beginnings.
        for (id, (cell, ([x, y, from], reach))) in cells.iter().zip(rays).enumerate() {
            let cell = *cell as usize;
            grid.starts[cell] -= 1;
            let ray = GridRay { at: [x, y], from, to: from + reach, id: id as u32 };
            grid.spans[cell] = [grid.spans[cell][0].min(from), grid.spans[cell][1].max(ray.to)];
            sorted[grid.starts[cell] as usize] = ray;
        }
        (grid, sorted)
    }

    /// How many cells a box covers.
    #[inline]
    pub fn cells(&self, around: &Around) -> usize {
        self.lines(around).len() * self.lines(around).next().map_or(0, |cells| cells.len())
    }

    /// Whether something in a box may be in the way of a ray, as far as cells can tell.
    #[inline]
    pub fn may_meet(&self, around: &Around) -> bool {
        self.lines(around).any(|cells| self.may_meet_in(cells, around))
    }

    /// Which rays begin in the cells that a box covers, row by row, but for rows where it is in the way of none.
    #[inline]
    pub fn rows(&self, around: &Around) -> impl Iterator<Item = Range<usize>> {
        let lines = self.lines(around).filter(|cells| self.may_meet_in(cells.clone(), around));
        lines.map(|cells| self.starts[cells.start] as usize..self.starts[cells.end] as usize)
    }

    #[inline]
    fn may_meet_in(&self, cells: Range<usize>, Around { low, high }: &Around) -> bool {
        self.spans[cells].iter().any(|[from, to]| (*from <= high[2]) & (*to >= low[2]))
    }

    /// The cells that a box covers, row by row.
    #[inline]
    fn lines(&self, Around { low, high }: &Around) -> impl ExactSizeIterator<Item = Range<usize>> + use<> {
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
