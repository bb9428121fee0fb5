//! Checks that no other part hides a visible line of the view map, by rays at points along each line.

use kurbo::Point;
use ligne::lines::LineOptions;
use ligne::scene::{Camera, Scene};
use rayon::prelude::*;

use super::ray_casts::{Occluder, RayCaster, circle_points, project_point};
use super::textbook_camera::TextbookCamera;
use super::triangle_scene::TriangleScene;
use crate::library::support::pipeline::{Stages, run_stages};

/// Number of points tested, number of them hidden by another part, and the first hidden point.
#[derive(Debug, Default, Clone)]
pub(crate) struct HiddenPointCounts {
    pub tested: usize,
    pub hidden: usize,
    pub first: Option<Point>,
}

/// Tests all visible view edges every 2 px.
///
/// A hidden point is excused if a shift by `excused` px makes it visible. Points of smooth lines are also
/// excused if the mesh surface below is visible within that distance.
pub(crate) fn hidden_by_others(
    scene: &Scene,
    camera: &Camera,
    options: &LineOptions,
    excused: f64,
) -> HiddenPointCounts {
    let polygons = TriangleScene::of(scene);
    let eye = TextbookCamera::new(camera);
    let rays = RayCaster::new(&polygons, &eye, camera.width, camera.height);
    let stages = run_stages(scene, camera, options);
    let visible: Vec<usize> =
        (0..stages.map.edges.len()).filter(|id| stages.map.edges[*id].invisibility == 0).collect();
    let found: Vec<HiddenPointCounts> =
        visible.par_iter().map(|id| test_edge(&stages, &rays, *id, excused)).collect();
    found.into_iter().fold(HiddenPointCounts::default(), |sum, one| HiddenPointCounts {
        tested: sum.tested + one.tested,
        hidden: sum.hidden + one.hidden,
        first: sum.first.or(one.first),
    })
}

fn test_edge(stages: &Stages, rays: &RayCaster, id: usize, excused: f64) -> HiddenPointCounts {
    let edge = &stages.map.edges[id];
    let segment = &stages.lines.segments[edge.segment as usize];
    let [p, q] = segment.ends.map(|end| stages.lines.position(&stages.mesh, end) + stages.mesh.origin);
    let [(from, near_p), (to, near_q)] = [project_point(rays.camera, p), project_point(rays.camera, q)];
    let hosts = segment.hosts.iter().filter_map(|host| stages.mesh.face_part.get(*host as usize));
    let own: Vec<u32> = hosts.chain([&edge.part]).map(|part| part.index() as u32).collect();
    let [a, b] = stages.edge_ends(edge);
    let count = ((b - a).hypot2().sqrt() / 2.0).ceil().max(1.0) as usize;
    let mut shown = HiddenPointCounts::default();
    let others =
        |face: u32| (!own.contains(&rays.polygons.part[face as usize])).then_some(rays.contact_distance());
    for k in 0..count {
        let at = a.lerp(b, (k as f64 + 0.5) / count as f64);
        // Nearness is linear along the whole segment in the image, so it follows from the position on it.
        let way = to - from;
        let share = if way.hypot2() > 0.0 { (at - from).dot(way) / way.hypot2() } else { 0.5 };
        let nearness = near_p + (near_q - near_p) * share;
        let hides = |at: Point| rays.occluder_at(at, nearness, others) == Occluder::Surface;
        let nearby = || {
            std::iter::once(at)
                .chain([0.25, 0.5, 1.0].into_iter().flat_map(|k| circle_points(at, k * excused)))
        };
        // A smooth line differs from the mesh in depth as well, so the visibility of the mesh surface
        // decides.
        let polygon_is_seen = |at: Point| {
            let front = rays.nearest(at, |face| own.contains(&rays.polygons.part[face as usize]));
            front.is_some_and(|front| rays.occluder_at(at, front, others) != Occluder::Surface)
        };
        shown.tested += 1;
        if nearby().all(hides) && !(edge.smooth && nearby().any(polygon_is_seen)) {
            shown.hidden += 1;
            shown.first = shown.first.or(Some(at));
        }
    }
    shown
}
