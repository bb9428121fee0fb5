//! Marks and colours for pictures of stages.

use std::sync::Arc;

use kurbo::{BezPath, Point};

use crate::colour::srgb::Colour;
use crate::drawing::{Cap, Join, Mark, Paint, Provenance, StrokePaint};

/// Hues that are easy to distinguish, for adjacent things.
pub(crate) const HUES: [Colour; 8] = [
    Colour::rgb(0xd6, 0x27, 0x28),
    Colour::rgb(0x1f, 0x77, 0xb4),
    Colour::rgb(0x2c, 0xa0, 0x2c),
    Colour::rgb(0xff, 0x7f, 0x0e),
    Colour::rgb(0x94, 0x67, 0xbd),
    Colour::rgb(0x8c, 0x56, 0x4b),
    Colour::rgb(0xe3, 0x77, 0xc2),
    Colour::rgb(0x17, 0xbe, 0xcf),
];

/// Colour of things that are drawn for orientation only.
pub(crate) const PALE: Colour = Colour::rgb(0xb4, 0xb4, 0xb4);

/// A line of constant width.
pub(crate) fn line(
    path: BezPath,
    colour: Colour,
    width: f64,
    classes: &[&'static str],
    note: Option<&str>,
) -> Mark {
    let (cap, join) = (Cap::Round, Join::Round);
    let stroke = StrokePaint { width, colour, cap, join, dash: Vec::new(), dash_offset: 0.0 };
    Mark { path, paint: Paint::Stroke(stroke), provenance: provenance(classes, note) }
}

/// A filled shape.
pub(crate) fn fill(path: BezPath, colour: Colour, classes: &[&'static str], note: Option<&str>) -> Mark {
    Mark { path, paint: Paint::Fill(colour), provenance: provenance(classes, note) }
}

fn provenance(classes: &[&'static str], note: Option<&str>) -> Provenance {
    Provenance { classes: classes.to_vec(), note: note.map(Arc::from), ..Provenance::default() }
}

/// The polyline through the points.
pub(crate) fn polyline(points: &[Point]) -> BezPath {
    let mut path = BezPath::new();
    add(&mut path, points);
    path
}

/// Adds a polyline through the points to a path.
pub(crate) fn add(path: &mut BezPath, points: &[Point]) {
    if let Some((first, others)) = points.split_first() {
        path.move_to(*first);
        others.iter().for_each(|point| path.line_to(*point));
    }
}

/// Joins consecutive segments of a list into polylines.
#[derive(Debug, Default)]
pub(crate) struct PolylineRuns {
    finished: BezPath,
    points: Vec<Point>,
}

impl PolylineRuns {
    /// Adds a segment. It continues the last line if it starts where that line ends.
    pub(crate) fn push(&mut self, [a, b]: [Point; 2]) {
        if self.points.last() != Some(&a) {
            self.end_line();
            self.points.push(a);
        }
        self.points.push(b);
    }

    fn end_line(&mut self) {
        add(&mut self.finished, &std::mem::take(&mut self.points));
    }

    /// All lines as one path; `None` if there are none.
    pub(crate) fn finish(mut self) -> Option<BezPath> {
        self.end_line();
        (!self.finished.elements().is_empty()).then_some(self.finished)
    }
}
