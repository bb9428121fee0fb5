//! Feature lines: curves on the surface that may be drawn.

pub mod edge_lines;
mod hard_contours;
pub mod intersections;
pub mod kind;
pub mod line;
pub mod needle;
pub mod options;
pub mod smooth_contours;
pub mod surface;
pub mod zero_set;

pub use kind::LineKind;
pub use line::{ContourCurve, FeatureLines, FeatureSegment, NO_FACE};
pub use options::{Contours, HiddenLines, LineOptions};
pub use surface::rounded_surface;

use crate::field;
use crate::mesh::{Mesh, SmoothNormals};
use crate::view::View;

/// All feature lines of a view that the options ask for. `smooth` are the rounded surfaces of the
/// mesh ([`rounded_surface`]); with none, contours are edges of the mesh.
#[must_use]
pub fn extract(mesh: &Mesh, view: &View, smooth: &SmoothNormals, options: &LineOptions) -> FeatureLines {
    let mut lines = FeatureLines::default();
    if !options.enabled {
        return lines;
    }
    let mut facing = field::facing(mesh, smooth, &view.frame);
    field::smooth_near_zero(mesh, smooth, &view.frame, &mut facing);
    let edges = edge_lines::find(mesh, view, smooth, &facing, options);
    lines.segments = edges.segments;
    if !smooth.is_empty() && options.kinds.contains(&LineKind::Contour) {
        smooth_contours::find(mesh, view, smooth, &facing, &edges.parted, &mut lines);
    }
    if options.kinds.contains(&LineKind::Intersection) {
        intersections::find(mesh, view, options.hidden, &mut lines);
    }
    if options.kinds.contains(&LineKind::Wire) {
        lines.segments.extend(mesh.wires.iter().map(FeatureSegment::of_wire));
    }
    lines
}
