//! [`InkWidths`]: the ink width of view edges, before they become strokes.

use std::sync::Arc;

use super::pen_rules::{LineTraits, Selection, StrokeOptions};
use crate::colour::srgb::Colour;
use crate::drawing::Unit;
use crate::visibility::{ViewEdge, ViewMap};

/// Ink widths of the edges of a view map.
pub(crate) struct InkWidths<'a> {
    selection: Selection<'a>,
    options: &'a StrokeOptions,
    unit: Unit,
}

impl<'a> InkWidths<'a> {
    /// The widths from the pens of `options` and the names of parts and materials. `unit` is that of the
    /// page.
    #[must_use]
    pub(crate) fn new(
        options: &'a StrokeOptions,
        parts: &[Arc<str>],
        materials: &[(Arc<str>, Colour)],
        unit: Unit,
    ) -> Self {
        Self { selection: options.selection_for(parts, materials, 1.0), options, unit }
    }

    /// Half the least ink width of an edge, user units. 0 if the pen has a varying width or does not follow
    /// the line.
    #[must_use]
    pub(crate) fn half(&self, map: &ViewMap, edge: &ViewEdge) -> f64 {
        let ViewEdge { kind, silhouette, both_seen, part, material, .. } = *edge;
        let hidden = edge.invisibility > 0;
        let line = LineTraits { kind, hidden, silhouette, both_seen, veiled: false, part, material };
        let pen = self.selection.pen_of(&line, self.options.pen.clone());
        if pen.has_hand() {
            return 0.0;
        }
        let strength = |end: usize| map.vertices.get(end).map_or(1.0, |end| f64::from(end.strength));
        let weakest = strength(edge.start.index()).min(strength(edge.end.index())).min(1.0);
        pen.width.in_unit(self.unit) / 2.0 * (1.0 - pen.fade * (1.0 - weakest))
    }
}
