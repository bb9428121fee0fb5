use glam::DVec3;

use super::*;
use crate::lines::{NO_FACE, Role};
use crate::mesh::{Mesh, Soup};
use crate::scene::{Camera, UpAxis};
use crate::view::View;
use crate::visibility::occlusion::tiled_triangles::TiledTriangles;
use crate::visibility::sweep::segment_visibility::decide;
use crate::visibility::tiles::aligned_grid::grid_over;
use crate::visibility::view_tolerances::ViewTolerances;

/// Triangles of each fan.
const TRIANGLES_PER_FAN: u32 = 400;

/// Two fans of needle-shaped triangles that intersect and cross in the image.
fn fans() -> Mesh {
    let mut soup = Soup::default();
    for [from, low, high] in [
        [DVec3::ZERO, DVec3::new(1000.0, 0.0, 0.0), DVec3::new(1000.0, 9.0, 4.0)],
        [DVec3::new(1000.0, 3.0, 5.0), DVec3::new(0.0, -4.0, -3.0), DVec3::new(0.0, 6.0, 2.0)],
    ] {
        let first = soup.positions.len() as u32;
        soup.positions.push(from);
        soup.positions.extend(
            (0..=TRIANGLES_PER_FAN).map(|k| low.lerp(high, f64::from(k) / f64::from(TRIANGLES_PER_FAN))),
        );
        soup.triangles.extend((1..=TRIANGLES_PER_FAN).map(|k| [first, first + k, first + k + 1]));
    }
    Mesh::build(soup)
}

#[test]
fn long_pairs_of_needles_are_tested_once() {
    let mesh = fans();
    let points: Vec<DVec3> = mesh.positions.iter().map(|p| *p + mesh.origin).collect();
    let camera = Camera::azimuth_elevation(0.0, 25.0, UpAxis::Z).fit_points(&points, 0.1);
    let view = View::new(&mesh, &camera);
    let limits = ViewTolerances::new(&view.frame);
    let segments: Vec<ImageSegment> = mesh
        .edges
        .vertices
        .iter()
        .enumerate()
        .map(|(edge, ends)| {
            let [a, b] = ends.map(|end| view.points[end as usize]);
            let faces = mesh.edges.faces(edge).list().to_vec();
            let host = |k: usize| faces.get(k).copied().unwrap_or(NO_FACE);
            ImageSegment {
                a,
                b,
                ends: *ends,
                cut: [false; 2],
                hosts: [host(0), host(1)],
                source: edge as u32,
                bounds: false,
                role: Role::Line,
            }
        })
        .collect();
    let grid = grid_over(segments.iter(), 1);
    let triangles = TiledTriangles { mesh: &mesh, view: &view, grid: &grid, limits: &limits };
    let all: Vec<Occluder> = (0..triangles.count() as u32).map(|id| triangles.occluder(id)).collect();
    let [plain, counted] = [false, true].map(|counting| decide(&mesh, &view, &segments, &limits, counting));
    // Each pair once, and not in each of about sixty tiles.
    for tests in [plain.tests, counted.tests] {
        assert!(tests <= (segments.len() * all.len()) as u64 * 3 / 2, "{tests}");
    }
    let mut counts = [0; 3];
    // The edges across the wide ends of the fans are hardly longer than rounding, so they are skipped.
    for (i, segment) in segments.iter().enumerate().filter(|(_, s)| s.length() > 100.0 * limits.px) {
        let hiders = all.iter().filter(|triangle| !segment.hosts.contains(&triangle.face));
        let intervals: Vec<Interval> = hiders
            .filter_map(|triangle| hidden_interval(segment, (0.0, 1.0), triangle, &view.frame, &limits))
            .collect();
        for k in 0..20 {
            let t = (f64::from(k) + 0.37) / 20.0;
            let is_near = |end: f64| (end - t).abs() < 1e-5;
            if intervals.iter().any(|i| is_near(i.start) || is_near(i.end)) {
                continue;
            }
            let wanted = intervals.iter().filter(|i| i.start < t && i.end > t).count();
            let has = |layer: &&HiddenInterval| layer.interval.start < t && layer.interval.end > t;
            let found = counted.hidden(i).iter().find(has).map_or(0, |layer| usize::from(layer.count));
            assert_eq!(found, wanted, "{i} at {t}");
            assert_eq!(plain.hidden(i).iter().any(|layer| has(&layer)), wanted > 0, "{i} at {t}");
            counts[wanted.min(2)] += 1;
        }
    }
    assert!(counts[0] > 1000 && counts[1] > 1000, "{counts:?}");
}
