//! Feature lines: curves on the surface that may be drawn.

pub mod edge_lines;
pub mod intersections;
pub mod kind;
pub mod line;
pub mod options;
pub mod zero_set;

pub use kind::LineKind;
pub use line::{FeatureLines, FeatureSegment, NO_FACE};
pub use options::{CreaseFilter, HiddenLines, LineOptions};

use crate::mesh::{HardEdges, Mesh};
use crate::view::View;

/// The edges of a mesh that are creases in every view, as the options have it.
#[must_use]
pub fn hard_edges(mesh: &Mesh, options: &LineOptions) -> HardEdges {
    match options.crease_filter {
        _ if !options.enabled => HardEdges::none(),
        CreaseFilter::Chains => HardEdges::find(mesh, options.crease_deg),
        CreaseFilter::Edges => HardEdges::above(mesh, options.crease_deg),
    }
}

/// All feature lines of a view that the options ask for; `hard` are the creases of the mesh.
#[must_use]
pub fn extract(mesh: &Mesh, hard: &HardEdges, view: &View, options: &LineOptions) -> FeatureLines {
    let mut lines = FeatureLines::default();
    if !options.enabled {
        return lines;
    }
    lines.segments = edge_lines::find(mesh, hard, view, options);
    if options.kinds.contains(&LineKind::Intersection) {
        intersections::find(mesh, view, options.hidden, &mut lines);
    }
    if options.kinds.contains(&LineKind::Wire) {
        lines.segments.extend(mesh.wires.iter().map(FeatureSegment::of_wire));
    }
    lines
}
