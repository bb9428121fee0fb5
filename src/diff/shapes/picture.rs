//! A drawing prepared for comparison: shapes in px, each with ink and label.

use std::sync::Arc;

use kurbo::{BezPath, Shape as _};

use super::ink::ShapeInk;
use super::label::Label;
use super::render_tree::RenderTree;
use crate::diff::tolerances::MIN_DIVISOR_PX;
use crate::drawing::Unit;

/// Most dashes of a drawing that is rasterised.
const MAX_DASHES: f64 = 400_000.0;

/// Kind of a shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ShapeKind {
    /// A line; the path is its axis.
    Line,
    /// A painted region; the path is its border.
    Region,
    /// A clip region.
    Clip,
}

/// One painted shape.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Shape {
    /// Geometry in px from the page's upper left corner, x right, y down.
    pub path: BezPath,
    /// Outline of a line of varying width, in px.
    pub outline: Option<BezPath>,
    /// Kind of the shape.
    pub kind: ShapeKind,
    /// Whether the fill rule of a region is even-odd.
    pub even_odd: bool,
    /// How the shape is painted.
    pub ink: ShapeInk,
    /// Label of the shape.
    pub label: Arc<Label>,
    /// Material, where the file names one. It is not compared.
    pub material: Option<Arc<str>>,
}

/// A drawing that can be compared.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Width in px.
    pub width: f64,
    /// Height in px.
    pub height: f64,
    /// Unit of the size in the file.
    pub unit: Unit,
    /// Size in px of one unit of the last decimal of coordinates.
    pub step_px: f64,
    /// Whether any path is written with arcs.
    pub has_arcs: bool,
    /// Shapes in painting order.
    pub(crate) shapes: Arc<[Shape]>,
    /// Text of the file.
    pub svg: Arc<str>,
    /// The parsed file for the renderer.
    pub(crate) drawn: Arc<RenderTree>,
    /// Contents of the file that are not compared.
    pub(crate) unread: Arc<[&'static str]>,
}

impl Picture {
    /// The same drawing with one part renamed.
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

    /// Whether the lines have too many dashes to be rasterised. Each dash is drawn separately.
    pub(crate) fn has_too_many_dashes(&self) -> bool {
        let dashes = self.shapes.iter().filter(|shape| !shape.ink.dash.is_empty()).map(|shape| {
            let pattern: f64 = shape.ink.dash.iter().sum();
            shape.path.perimeter(1.0) / pattern.max(MIN_DIVISOR_PX) * shape.ink.dash.len() as f64
        });
        dashes.sum::<f64>() > MAX_DASHES
    }

    /// Size of a user unit in px.
    #[must_use]
    pub fn px_per_unit(&self) -> f64 {
        match self.unit {
            Unit::Px => 1.0,
            Unit::Mm => 1.0 / crate::drawing::length::MM_PER_PX,
        }
    }
}
