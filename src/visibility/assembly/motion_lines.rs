//! View map of motion lines: their visible parts outside the bodies that leave them.

use std::ops::Range;

use super::map_builder::of_hidden;
use crate::lines::FeatureLines;
use crate::mesh::Mesh;
use crate::scene::Camera;
use crate::view::View;
use crate::visibility::graph::ViewMap;
use crate::visibility::occlusion::interval_sweep::{HiddenInterval, sweep};
use crate::visibility::occlusion::triangle_occlusion::Interval;
use crate::visibility::projection::image_segments::{ImageSegment, project};
use crate::visibility::sweep::segment_visibility::decide;
use crate::visibility::view_tolerances::ViewTolerances;

/// Body, with the feature segments that must not be drawn over it, however near they are.
#[derive(Debug)]
pub(crate) struct BodyLines {
    /// Consecutive feature segments.
    pub segments: Range<u32>,
    /// Body that hides them.
    pub body: Mesh,
}

/// Builds the view map of lines that are drawn where nothing hides them and they do not cross their own
/// bodies.
#[must_use]
pub(crate) fn build_motion_lines(
    mesh: &Mesh,
    view: &View,
    camera: &Camera,
    lines: &FeatureLines,
    bodies: &[BodyLines],
) -> ViewMap {
    let limits = ViewTolerances::new(&view.frame);
    let segments = project(mesh, view, lines);
    let visibility = decide(mesh, view, &segments, &limits, false);
    let mut hidden: Vec<Vec<Interval>> = (0..segments.len())
        .map(|i| visibility.hidden(i).iter().map(|layer| layer.interval).collect())
        .collect();
    for BodyLines { segments: body_segments, body } in bodies {
        let of_body = View::new(body, camera);
        // A line behind all of a body is hidden everywhere the body covers it in the image.
        let nearness = of_body.points.iter().map(|point| point.z).filter(|nearness| !nearness.is_nan());
        let min_nearness = nearness.fold(f64::INFINITY, f64::min);
        let frame = &view.frame;
        let pushed_nearness =
            if frame.perspective { min_nearness / 2.0 } else { min_nearness - frame.side_at(frame.focus) };
        let behind = |segment: &ImageSegment| {
            let [mut a, mut b] = [segment.a, segment.b];
            (a.z, b.z) = (pushed_nearness, pushed_nearness);
            // Its ends are not vertices of the body.
            ImageSegment { a, b, ends: [u32::MAX; 2], ..*segment }
        };
        let numbers: Vec<usize> =
            (0..segments.len()).filter(|i| body_segments.contains(&segments[*i].source)).collect();
        let pushed: Vec<ImageSegment> = numbers.iter().map(|i| behind(&segments[*i])).collect();
        let covered = decide(body, &of_body, &pushed, &limits, false);
        for (k, i) in numbers.into_iter().enumerate() {
            hidden[i].extend(covered.hidden(k).iter().map(|layer| layer.interval));
        }
    }
    let joined = hidden.iter_mut().zip(&segments).map(|(hidden, segment)| {
        let shortest = limits.piece / segment.length().max(limits.piece);
        let mut layers: Vec<HiddenInterval> = Vec::new();
        sweep(hidden, shortest, false, &mut layers);
        layers
    });
    let hidden: Vec<Vec<HiddenInterval>> = joined.collect();
    of_hidden(mesh, view, lines, &segments, &hidden)
}
