//! Closing of hairline gaps: pixels between unconnected faces, through which other surfaces show.

use super::normal_depth_maps::{NO_FRONT, NormalDepthMaps};

/// Widest gap that is closed, pixels.
const MAX_GAP_PIXELS: usize = 2;

/// Smallest cosine of the angle between the normals (40 degrees) of two faces that may be one surface.
const MIN_SURFACE_COSINE: f32 = 0.766;

impl NormalDepthMaps {
    /// Closes gaps of one or two pixels between faces that `may_gap`. Both sides must continue as one surface
    /// in front of the surface that shows between them.
    pub(crate) fn close_hairlines(&mut self, may_gap: impl Fn(u32) -> bool) {
        let (columns, rows) = (self.columns, self.rows);
        let (in_rows, in_columns) = self.lines_with(&may_gap);
        for row in (0..rows).filter(|row| in_rows[*row]) {
            self.close_along(row * columns, 1, columns, &may_gap);
        }
        for column in (0..columns).filter(|column| in_columns[*column]) {
            self.close_along(column, columns, rows, &may_gap);
        }
    }

    /// Rows and columns with a pixel whose nearest face satisfies `is_such`.
    ///
    /// Closing gaps in rows moves such faces into neighbouring columns, so these count too.
    fn lines_with(&self, is_such: &impl Fn(u32) -> bool) -> (Vec<bool>, Vec<bool>) {
        let (mut in_rows, mut found) = (vec![false; self.rows], vec![false; self.columns]);
        for (row, faces) in self.faces.chunks(self.columns).enumerate() {
            for (column, face) in faces.iter().enumerate() {
                if *face != NO_FRONT && is_such(*face) {
                    in_rows[row] = true;
                    found[column] = true;
                }
            }
        }
        let near = |column: usize| {
            column.saturating_sub(MAX_GAP_PIXELS)..(column + MAX_GAP_PIXELS + 1).min(self.columns)
        };
        let in_columns = (0..self.columns).map(|column| found[near(column)].contains(&true)).collect();
        (in_rows, in_columns)
    }

    /// Closes gaps in one row or column of `count` pixels.
    fn close_along(&mut self, first: usize, step: usize, count: usize, may_gap: &impl Fn(u32) -> bool) {
        let mut at = 0;
        while at + 2 < count {
            let a = first + at * step;
            at += 1;
            let falls = self.depths[a + step] > self.depths[a];
            if !falls || !may_gap(self.faces[a]) {
                continue;
            }
            let gap =
                (1..=MAX_GAP_PIXELS.min(count - at - 1)).find(|gap| self.is_gap(a, step, *gap, may_gap));
            if let Some(gap) = gap {
                let b = a + (gap + 1) * step;
                for k in 1..=gap {
                    let (pixel, share) = (a + k * step, k as f32 / (gap + 1) as f32);
                    let side = if 2 * k <= gap { a } else { b };
                    self.faces[pixel] = self.faces[side];
                    self.normals[pixel] = self.normals[side];
                    self.depths[pixel] = self.depths[a] + (self.depths[b] - self.depths[a]) * share;
                }
            }
        }
    }

    /// Whether the `gap` pixels after `a` lie behind a surface that continues on both sides of them.
    fn is_gap(&self, a: usize, step: usize, gap: usize, may_gap: &impl Fn(u32) -> bool) -> bool {
        let b = a + (gap + 1) * step;
        let (from, to) = (self.depths[a], self.depths[b]);
        let (n, m) = (self.normals[a], self.normals[b]);
        let between = (1..=gap).map(|k| self.depths[a + k * step]).fold(f32::INFINITY, f32::min);
        let fall = between - from.max(to);
        may_gap(self.faces[b])
            && fall > 2.0 * (from - to).abs()
            && n[0] * m[0] + n[1] * m[1] + n[2] * m[2] > MIN_SURFACE_COSINE
    }
}
