//! Feature lines: curves on the surface that may be drawn.

pub mod edge_lines;
pub mod inside;
pub mod intersections;
pub mod kind;
pub mod line;
pub mod needle;
pub mod options;
pub mod zero_set;

pub use inside::InsideOptions;
pub use kind::LineKind;
pub use line::{FeatureLines, FeatureSegment, NO_FACE};
pub use options::{HiddenLines, LineOptions};

use crate::mesh::{Mesh, SmoothNormals};
use crate::view::View;

/// All feature lines of a view that the options ask for.
#[must_use]
pub fn extract(mesh: &Mesh, view: &View, options: &LineOptions) -> FeatureLines {
    let mut lines = FeatureLines::default();
    if !options.enabled {
        return lines;
    }
    lines.segments = edge_lines::find(mesh, view, options);
    if options.kinds.contains(&LineKind::Intersection) {
        intersections::find(mesh, view, options.hidden, &mut lines);
    }
    if inside::wanted(options) {
        let smooth = SmoothNormals::rounded(mesh);
        let curvature = inside::curvature(mesh, &smooth, &options.inside);
        inside::find(mesh, view, &smooth, &curvature, options, &mut lines);
    }
    if options.kinds.contains(&LineKind::Wire) {
        lines.segments.extend(mesh.wires.iter().map(FeatureSegment::of_wire));
    }
    lines
}
