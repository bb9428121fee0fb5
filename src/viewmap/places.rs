//! [`Place`]: where the visibility of contours of rounded surfaces may change, for looking at.

use kurbo::Point;

use super::arcs::{even_backward, stops};
use super::build::GRID;
use super::events::{self, Scene};
use super::graph::ViewVertexKind;
use super::occlude::Limits;
use super::project::project;
use super::rounded;
use super::visibility::grid_over;
use crate::lines::FeatureLines;
use crate::math::tolerance;
use crate::mesh::Mesh;
use crate::view::View;

/// A place on a contour where it is cut into arcs, hidden or not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// Where it is in the image, user units.
    pub position: Point,
    /// What is there: a T-junction, a piercing or a cusp.
    pub kind: ViewVertexKind,
}

/// All such places of a view, curve by curve.
#[must_use]
pub fn places(mesh: &Mesh, view: &View, lines: &FeatureLines) -> Vec<Place> {
    let segments = project(mesh, view, lines);
    let image_of = rounded::image_of(lines, &segments);
    let advance = rounded::advance(lines, &segments, &image_of);
    let scene = Scene { mesh, view, segments: &segments, sources: &lines.segments, advance: &advance };
    let events = events::find(&scene, &grid_over(&segments, GRID));
    let px = Limits::new(&view.frame).px;
    let mut places = Vec::new();
    for run in rounded::runs(mesh, lines, &segments, &image_of) {
        let backward = even_backward(&run, &scene, tolerance::CUSP_PX * px);
        for stop in stops(&run, &events, &backward) {
            let k = (stop.at.max(0.0) as usize).min(run.segments.len() - 1);
            let point = segments[run.segments[k] as usize].at(stop.at - k as f64);
            places.push(Place { position: Point::new(point.x, point.y), kind: stop.kind });
        }
    }
    places
}
