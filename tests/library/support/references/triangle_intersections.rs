//! Reference for intersection lines: every pair of triangles with overlapping boxes is intersected.

use glam::DVec3;
use rayon::prelude::*;

use super::triangle_scene::TriangleScene;

/// Ends of each intersection segment, and its two faces. Faces that share a vertex or a plane have none.
pub(crate) fn intersection_segments(polygons: &TriangleScene) -> Vec<([DVec3; 2], [u32; 2])> {
    let boxes: Vec<[DVec3; 2]> = (0..polygons.faces.len())
        .map(|face| {
            let [a, b, c] = polygons.corners(face);
            [a.min(b).min(c), a.max(b).max(c)]
        })
        .collect();
    let low = boxes.iter().fold(DVec3::INFINITY, |sum, b| sum.min(b[0]));
    let extent = boxes.iter().fold(DVec3::NEG_INFINITY, |sum, b| sum.max(b[1])) - low;
    let axis = if extent.x >= extent.y.max(extent.z) {
        0
    } else if extent.y >= extent.z {
        1
    } else {
        2
    };
    let mut order: Vec<usize> = (0..boxes.len()).filter(|face| !polygons.is_degenerate(*face)).collect();
    order.sort_by(|a, b| boxes[*a][0][axis].total_cmp(&boxes[*b][0][axis]));
    let meet =
        |a: usize, b: usize| boxes[a][0].cmple(boxes[b][1]).all() && boxes[b][0].cmple(boxes[a][1]).all();
    order
        .par_iter()
        .enumerate()
        .flat_map_iter(|(place, &one)| {
            let later = &order[place + 1..];
            let end = later.partition_point(|other| boxes[*other][0][axis] <= boxes[one][1][axis]);
            later[..end].iter().copied().filter(move |other| meet(one, *other)).filter_map(move |other| {
                let neighbours =
                    polygons.faces[one].iter().any(|corner| polygons.faces[other].contains(corner));
                let line = if neighbours { None } else { intersect_triangles(polygons, one, other) };
                line.map(|ends| (ends, [one as u32, other as u32]))
            })
        })
        .collect()
}

/// The intersection segment of two triangles: the overlap of their intervals on the line of their planes.
fn intersect_triangles(polygons: &TriangleScene, one: usize, other: usize) -> Option<[DVec3; 2]> {
    let (p, q) = (polygons.corners(one), polygons.corners(other));
    let normal = |t: [DVec3; 3]| (t[1] - t[0]).cross(t[2] - t[0]).normalize();
    let (n, m) = (normal(p), normal(q));
    let way = n.cross(m);
    if way.length() < 1e-9 {
        return None;
    }
    let tiny = 1e-12 * polygons.size;
    let round = |d: f64| if d.abs() < tiny { 0.0 } else { d };
    let cut = |t: [DVec3; 3], through: DVec3, normal: DVec3| {
        let heights = t.map(|corner| round((corner - through).dot(normal)));
        let mut ends: Vec<DVec3> = (0..3).filter(|k| heights[*k] == 0.0).map(|k| t[k]).collect();
        for k in 0..3 {
            let (a, b) = (heights[k], heights[(k + 1) % 3]);
            if a * b < 0.0 {
                ends.push(t[k].lerp(t[(k + 1) % 3], a / (a - b)));
            }
        }
        ends.sort_by(|a, b| a.dot(way).total_cmp(&b.dot(way)));
        Some([*ends.first()?, *ends.last()?])
    };
    let (on_p, on_q) = (cut(p, q[0], m)?, cut(q, p[0], n)?);
    let later = |a: DVec3, b: DVec3| if a.dot(way) > b.dot(way) { a } else { b };
    let earlier = |a: DVec3, b: DVec3| if a.dot(way) < b.dot(way) { a } else { b };
    let ends = [later(on_p[0], on_q[0]), earlier(on_p[1], on_q[1])];
    ((ends[1] - ends[0]).dot(way) > tiny).then_some(ends)
}
