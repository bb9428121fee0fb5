//! [`Picture`]: a drawing as it is compared: shapes in px, each with ink and label.

use std::sync::Arc;

use kurbo::BezPath;

use super::ink::Ink;
use super::label::Label;
use crate::diff::raster_check::Drawn;
use crate::drawing::Unit;

/// What a shape is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ShapeKind {
    /// A line: its path is its middle.
    Line,
    /// A painted region: its path is its border.
    Region,
    /// A region that other shapes are cut off at.
    Clip,
}

/// One painted shape.
#[derive(Debug, Clone, PartialEq)]
pub struct Shape {
    /// Geometry in px, x right, y down, from the page's corner.
    pub path: BezPath,
    /// The outline of a line of varying width, in px.
    pub outline: Option<BezPath>,
    /// What it is.
    pub kind: ShapeKind,
    /// Whether a region counts as inside what is wound round an odd number of times only.
    pub even_odd: bool,
    /// How it is painted.
    pub ink: Ink,
    /// What the file says of it.
    pub label: Arc<Label>,
    /// The material that it is of, where the file names one: it does not count.
    pub material: Option<Arc<str>>,
}

/// A drawing that can be compared.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Width in px.
    pub width: f64,
    /// Height in px.
    pub height: f64,
    /// The unit that its size is written in.
    pub unit: Unit,
    /// Px in the last decimal that its coordinates are written with.
    pub step_px: f64,
    /// Whether some of its paths are written with arcs.
    pub has_arcs: bool,
    /// Shapes, painted first to last.
    pub shapes: Arc<[Shape]>,
    /// The file's text.
    pub svg: Arc<str>,
    /// What the renderer paints.
    pub(crate) drawn: Arc<Drawn>,
    /// What the file holds that is not read.
    pub(crate) unread: Arc<[&'static str]>,
}

impl Picture {
    /// The same, with another name for one of its parts.
    #[cfg(feature = "cli")]
    #[must_use]
    pub(crate) fn with_part_renamed(mut self, old: &str, new: &str) -> Self {
        let is_old = |shape: &Shape| shape.label.part.as_deref() == Some(old);
        if self.shapes.iter().any(is_old) {
            let mut shapes = self.shapes.to_vec();
            for shape in shapes.iter_mut().filter(|shape| is_old(shape)) {
                shape.label = Arc::new(Label { part: Some(Arc::from(new)), ..(*shape.label).clone() });
            }
            self.shapes = Arc::from(shapes);
        }
        self
    }

    /// Px in a user unit of the drawing.
    #[must_use]
    pub fn px_per_unit(&self) -> f64 {
        match self.unit {
            Unit::Px => 1.0,
            Unit::Mm => 1.0 / crate::drawing::length::MM_PER_PX,
        }
    }
}
