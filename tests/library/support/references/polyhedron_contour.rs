//! Distances of visible smooth contours from the mesh contour, visible or hidden.

use kurbo::Point;
use ligne::lines::{Contours, LineKind, LineOptions, Surface};
use ligne::mesh::Mesh;
use ligne::scene::{Camera, Scene};
use ligne::visibility::ViewMap;

use super::contour_stops::build_view_map;
use crate::library::support::measures::line_picture::{SegmentGrid, quantile, sample_segments};

/// Maximum distance that is measured, px.
const MAX_DISTANCE_PX: f64 = 8.0;

/// A scene's surface prepared for smooth contours, and prepared for mesh contours.
pub(crate) struct SmoothAndMeshSurface {
    auto: Surface,
    polygon: Surface,
}

impl SmoothAndMeshSurface {
    pub(crate) fn of(scene: &Scene) -> Self {
        let [auto, polygon] = [Contours::Auto, Contours::Mesh]
            .map(|contours| Surface::new(Mesh::build(scene.to_soup()), &contour_options(contours)));
        Self { auto, polygon }
    }

    /// The distances in one view, px, ascending, one per half px of smooth contour.
    ///
    /// `None` if the model has no smooth contours, so both contours are the same.
    pub(crate) fn distances(&self, camera: &Camera) -> Option<Vec<f64>> {
        let smooth = build_view_map(&self.auto, camera, &contour_options(Contours::Auto));
        if smooth.contours.curves == 0 {
            return None;
        }
        let polygon = build_view_map(&self.polygon, camera, &contour_options(Contours::Mesh));
        let truth = SegmentGrid::new(contour_segments(&polygon, |_, _| true), MAX_DISTANCE_PX);
        let drawn = contour_segments(&smooth, |smooth, seen| smooth && seen);
        let mut found: Vec<f64> =
            sample_segments(&drawn, 0.5).iter().map(|(p, _)| truth.distance(*p)).collect();
        found.sort_by(f64::total_cmp);
        Some(found)
    }
}

/// Median, 95th percentile and maximum of the distances, and the share within half a px, percent.
pub(crate) fn distance_summary(distances: &[f64]) -> [f64; 4] {
    let within = distances.partition_point(|d| *d <= 0.5) as f64;
    let share = 100.0 * within / (distances.len() as f64).max(1.0);
    [quantile(distances, 0.5), quantile(distances, 0.95), quantile(distances, 1.0), share]
}

fn contour_options(contours: Contours) -> LineOptions {
    LineOptions { contours, ..LineOptions::default() }
}

fn contour_segments(map: &ViewMap, wanted: impl Fn(bool, bool) -> bool) -> Vec<[Point; 2]> {
    let contours = map.edges.iter().filter(|e| e.kind == LineKind::Contour || e.kind == LineKind::Border);
    let wanted = contours.filter(|e| wanted(e.smooth, e.invisibility == 0));
    wanted.map(|e| [e.start, e.end].map(|v| map.vertices[v.index()].position)).collect()
}
