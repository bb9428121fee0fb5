//! [`Columns`]: what of a part stands on each field of a grid across an axis, as intervals along it.

use glam::DVec3;

/// A grid across an axis, the same for all parts.
#[derive(Debug, Clone, Copy)]
pub(super) struct Grid {
    /// Two directions across the axis, and the axis.
    pub axes: [DVec3; 3],
    /// Side of a field, units of the world.
    pub step: f64,
}

/// What of a part stands on each field that it reaches.
#[derive(Debug, Clone, Default)]
pub(super) struct Columns {
    first: [i64; 2],
    size: [i64; 2],
    /// Where the axis meets the surface over each field, rising.
    crossings: Vec<Vec<f64>>,
    /// Whether there is nothing on a field, but on others of its row and column to both sides.
    within: Vec<bool>,
    /// Fields with anything on them.
    pub count: usize,
    /// Least and greatest place along the axis.
    pub low: f64,
    pub high: f64,
}

/// Samples are taken a little beside the middle of fields, where models seldom have an edge.
const ASIDE: [f64; 2] = [0.503_7, 0.496_1];

impl Columns {
    /// The columns of the triangles of a part.
    pub fn new(triangles: &[[DVec3; 3]], grid: &Grid) -> Self {
        let place = |p: DVec3| grid.axes.map(|axis| p.dot(axis));
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        let placed: Vec<[[f64; 3]; 3]> = triangles.iter().map(|t| t.map(place)).collect();
        for p in placed.as_flattened() {
            for k in 0..3 {
                (low[k], high[k]) = (low[k].min(p[k]), high[k].max(p[k]));
            }
        }
        if placed.is_empty() {
            return Self::default();
        }
        let field = |x: f64, k: usize| (x / grid.step - ASIDE[k]).ceil() as i64;
        let first = [field(low[0], 0), field(low[1], 1)];
        let size = [0, 1].map(|k| (field(high[k], k) - first[k]).max(0));
        let mut made = Self {
            first,
            size,
            crossings: vec![Vec::new(); (size[0] * size[1]) as usize],
            within: Vec::new(),
            count: 0,
            low: low[2],
            high: high[2],
        };
        for [a, b, c] in placed {
            let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            if area == 0.0 {
                continue;
            }
            let range = |k: usize| {
                let least = a[k].min(b[k]).min(c[k]);
                let most = a[k].max(b[k]).max(c[k]);
                field(least, k).max(first[k])..field(most, k).min(first[k] + size[k])
            };
            for i in range(0) {
                let x = (i as f64 + ASIDE[0]) * grid.step;
                for j in range(1) {
                    let y = (j as f64 + ASIDE[1]) * grid.step;
                    let weight = |p: [f64; 3], q: [f64; 3]| {
                        ((q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])) / area
                    };
                    let (u, v, w) = (weight(b, c), weight(c, a), weight(a, b));
                    if u >= 0.0 && v >= 0.0 && w >= 0.0 {
                        let at = u * a[2] + v * b[2] + w * c[2];
                        made.crossings[((j - first[1]) * size[0] + i - first[0]) as usize].push(at);
                    }
                }
            }
        }
        for column in &mut made.crossings {
            column.sort_by(f64::total_cmp);
            made.count += usize::from(!column.is_empty());
        }
        made.within = made.surrounded();
        made
    }

    /// For each field whether it is empty and stands between others.
    fn surrounded(&self) -> Vec<bool> {
        let [columns, rows] = self.size.map(|size| size as usize);
        let mut sides = vec![0_u8; columns * rows];
        let mut pass = |fields: &mut dyn Iterator<Item = usize>, bit: u8| {
            let mut met = false;
            for field in fields {
                met |= !self.crossings[field].is_empty();
                sides[field] |= if met { bit } else { 0 };
            }
        };
        for row in 0..rows {
            let at = |column: usize| row * columns + column;
            pass(&mut (0..columns).map(at), 1);
            pass(&mut (0..columns).rev().map(at), 2);
        }
        for column in 0..columns {
            let at = |row: usize| row * columns + column;
            pass(&mut (0..rows).map(at), 4);
            pass(&mut (0..rows).rev().map(at), 8);
        }
        sides.iter().zip(&self.crossings).map(|(sides, column)| *sides == 15 && column.is_empty()).collect()
    }

    /// On how many of its fields another one goes round it.
    pub fn lies_within(&self, other: &Self) -> usize {
        let mut count = 0;
        for j in 0..self.size[1] {
            for i in 0..self.size[0] {
                if self.crossings[(j * self.size[0] + i) as usize].is_empty() {
                    continue;
                }
                let (x, y) = (i + self.first[0] - other.first[0], j + self.first[1] - other.first[1]);
                let is_in = (0..other.size[0]).contains(&x) && (0..other.size[1]).contains(&y);
                count += usize::from(is_in && other.within[(y * other.size[0] + x) as usize]);
            }
        }
        count
    }

    fn column(&self, i: i64, j: i64) -> &[f64] {
        let (i, j) = (i - self.first[0], j - self.first[1]);
        let is_in = (0..self.size[0]).contains(&i) && (0..self.size[1]).contains(&j);
        if is_in { &self.crossings[(j * self.size[0] + i) as usize] } else { &[] }
    }

    /// On how many fields both stand; on how many the other stands in the way when this one moves along the axis, and when it moves
    /// against it. What passes through the other already is not in the way.
    pub fn meets(&self, other: &Self, touch: f64) -> [usize; 3] {
        let from = [0, 1].map(|k| self.first[k].max(other.first[k]));
        let to = [0, 1].map(|k| (self.first[k] + self.size[k]).min(other.first[k] + other.size[k]));
        let mut met = [0; 3];
        for i in from[0]..to[0] {
            for j in from[1]..to[1] {
                let (own, its) = (self.column(i, j), other.column(i, j));
                if own.is_empty() || its.is_empty() {
                    continue;
                }
                let pairs = || intervals(own).flat_map(|a| intervals(its).map(move |b| (a, b)));
                met[0] += 1;
                met[1] += usize::from(pairs().any(|(a, b)| b[0] >= a[1] - touch));
                met[2] += usize::from(pairs().any(|(a, b)| b[1] <= a[0] + touch));
            }
        }
        met
    }

    /// The columns of both.
    pub fn with(&self, other: &Self) -> Self {
        if self.count == 0 {
            return other.clone();
        }
        if other.count == 0 {
            return self.clone();
        }
        let first = [0, 1].map(|k| self.first[k].min(other.first[k]));
        let end = |of: &Self, k: usize| of.first[k] + of.size[k];
        let size = [0, 1].map(|k| end(self, k).max(end(other, k)) - first[k]);
        let mut made = Self {
            first,
            size,
            crossings: Vec::with_capacity((size[0] * size[1]) as usize),
            within: Vec::new(),
            count: 0,
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        };
        for j in first[1]..first[1] + size[1] {
            for i in first[0]..first[0] + size[0] {
                let mut column = [self.column(i, j), other.column(i, j)].concat();
                column.sort_by(f64::total_cmp);
                made.count += usize::from(!column.is_empty());
                made.crossings.push(column);
            }
        }
        made.within = made.surrounded();
        made
    }
}

/// The stretches between an even and the next crossing; a last one that is alone is a sheet.
fn intervals(column: &[f64]) -> impl Iterator<Item = [f64; 2]> {
    column.chunks(2).map(|pair| [pair[0], *pair.last().unwrap_or(&pair[0])])
}
