//! [`LinesByPen`]: the visible lines of a drawing grouped by pen, and the difference between two drawings.

use std::collections::BTreeMap;

use kurbo::Point;
use ligne::drawing::{Drawing, Mark, Paint};

use crate::library::support::measures::line_picture::{SegmentGrid, sample_segments};
use crate::library::support::references::drawing_judge::{centre_line, visible_line_marks};

/// Distance between samples along lines, px.
const SAMPLE_STEP_PX: f64 = 0.25;

/// Visible lines as segments, by classes and pen width.
#[derive(Debug, Clone)]
pub(crate) struct LinesByPen(BTreeMap<String, Vec<[Point; 2]>>);

/// The lines of each drawing that are farther than a tolerance from the same pen in the other drawing.
#[derive(Debug, Clone)]
pub(crate) struct PenDifference {
    /// Length by pen of lines in the reference only, and of lines in the other drawing only; px of the
    /// reference.
    pub gone: BTreeMap<String, f64>,
    pub new: BTreeMap<String, f64>,
    /// A point of the reference drawing where they differ.
    pub at: Point,
}

impl PenDifference {
    pub(crate) fn length(&self) -> f64 {
        self.gone.values().chain(self.new.values()).sum()
    }
}

impl std::fmt::Display for PenDifference {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:.1} px differ, at ({:.1}, {:.1})", self.length(), self.at.x, self.at.y)?;
        for (what, pens) in [("gone", &self.gone), ("new", &self.new)] {
            for (pen, length) in pens {
                write!(f, "; {what}: {length:.1} px of {pen}")?;
            }
        }
        Ok(())
    }
}

fn pen_width(mark: &Mark) -> f64 {
    match &mark.paint {
        Paint::Stroke(stroke) => stroke.width,
        Paint::Outline(outline) => outline.pen_width,
        _ => 0.0,
    }
}

/// The classes and width of a mark.
fn pen_key(mark: &Mark) -> String {
    format!("{} {}", mark.provenance.classes.join(" "), pen_width(mark))
}

impl LinesByPen {
    pub(crate) fn of(drawing: &Drawing) -> Self {
        let mut pens: BTreeMap<String, Vec<[Point; 2]>> = BTreeMap::new();
        for mark in visible_line_marks(drawing) {
            pens.entry(pen_key(mark)).or_default().extend(centre_line(mark));
        }
        Self(pens)
    }

    /// The visible lines of a drawing, grouped by pen width only.
    pub(crate) fn by_width(drawing: &Drawing) -> Self {
        let mut pens: BTreeMap<String, Vec<[Point; 2]>> = BTreeMap::new();
        for mark in visible_line_marks(drawing) {
            pens.entry(format!("width {}", pen_width(mark))).or_default().extend(centre_line(mark));
        }
        Self(pens)
    }

    /// The lines with `place` applied to each point.
    pub(crate) fn moved(mut self, place: impl Fn(Point) -> Point) -> Self {
        self.0.values_mut().flatten().flatten().for_each(|point| *point = place(*point));
        self
    }

    /// The lines that differ by more than `tolerance` px.
    pub(crate) fn difference(&self, other: &Self, tolerance: f64) -> PenDifference {
        let mut at = None;
        let mut lost = |of: &Self, by: &Self| {
            let mut lost = BTreeMap::new();
            for (pen, lines) in &of.0 {
                let ink = SegmentGrid::new(by.0.get(pen).cloned().unwrap_or_default(), 4.0);
                let far = sample_segments(lines, SAMPLE_STEP_PX)
                    .into_iter()
                    .filter(|(p, _)| ink.distance(*p) > tolerance);
                let mut length = 0.0;
                for (place, share) in far {
                    at = at.or(Some(place));
                    length += share;
                }
                if length > 0.0 {
                    lost.insert(pen.clone(), length);
                }
            }
            lost
        };
        let (gone, new) = (lost(self, other), lost(other, self));
        PenDifference { gone, new, at: at.unwrap_or_default() }
    }
}
