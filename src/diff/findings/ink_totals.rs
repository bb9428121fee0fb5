//! Totals of a comparison: number of marks, line length and filled area before and after, by layer, class and
//! part.
//!
//! They are part of the reports of `ligne diff` and show at a glance where ink was added or removed.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::diff::curves::region_area::size;
use crate::diff::shapes::picture::{Picture, ShapeKind};

/// Ink of a set of marks, before and after. Lengths are in px, areas in square px.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Measure {
    /// Number of marks.
    pub marks: [usize; 2],
    /// Length of lines.
    pub length: [f64; 2],
    /// Area of filled regions. Overlapping areas count once per region.
    pub area: [f64; 2],
}

/// Ink by layer, class and part. The key of marks without a name is empty.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Totals {
    /// All marks.
    pub all: Measure,
    /// By layer.
    pub layers: BTreeMap<String, Measure>,
    /// By class. A mark with several classes counts under the first one other than `silhouette`.
    pub classes: BTreeMap<String, Measure>,
    /// By part.
    pub parts: BTreeMap<String, Measure>,
}

impl Totals {
    /// Sums up the marks of two drawings. Clip paths are not counted.
    pub(crate) fn of(before: &Picture, after: &Picture) -> Self {
        let mut totals = Self::default();
        for (side, picture) in [before, after].into_iter().enumerate() {
            for shape in picture.shapes.iter() {
                let (length, area) = match shape.kind {
                    ShapeKind::Line => (size(shape), 0.0),
                    ShapeKind::Region => (0.0, size(shape)),
                    ShapeKind::Clip => continue,
                };
                let label = &shape.label;
                let class = label.classes.first().map_or("", |_| label.kind());
                let entries = [
                    totals.layers.entry(label.layer.to_string()).or_default(),
                    totals.classes.entry(class.to_owned()).or_default(),
                    totals.parts.entry(label.part.as_deref().unwrap_or_default().to_owned()).or_default(),
                    &mut totals.all,
                ];
                for entry in entries {
                    entry.marks[side] += 1;
                    entry.length[side] += length;
                    entry.area[side] += area;
                }
            }
        }
        totals
    }
}
