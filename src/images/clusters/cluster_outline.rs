//! Outlines of clusters, widened slightly so that nothing shows through between neighbours.

use kurbo::{BezPath, Point, Vec2};
use rustc_hash::FxHashMap;

use super::facet_cluster::{FacetCluster, FacetNeighbours};
use crate::geometry::plane::planar_distance::{turn_from_y_to_x, unit};
use crate::geometry::plane::polyline_path::add_polygon;
use crate::images::facets::facet::Facet;

/// Distance from the straight line past a point within which the point is removed from a loop, px.
const MAX_DEVIATION_PX: f64 = 0.02;

/// Largest offset of a corner, as a multiple of the offset of the sides (mitre limit).
const MAX_MITRE: f64 = 2.0;

/// Loop of points, each with a flag: whether another face passes through at the side after it.
type OutlineRing = Vec<(Point, bool)>;

/// Outline of a cluster, moved by `offset`; `None` if it is empty. It is widened by `reach`, except at sides
/// where another face passes through.
pub(crate) fn outline(
    cluster: &FacetCluster,
    facets: &[Facet],
    neighbours: &FacetNeighbours,
    (reach, px): (f64, f64),
    offset: Vec2,
) -> Option<BezPath> {
    let mut path = BezPath::new();
    for ring in rings(cluster, facets, neighbours) {
        let ring = straightened(&ring, MAX_DEVIATION_PX * px);
        if ring.len() < 3 {
            continue;
        }
        add_polygon(&mut path, widened(&ring, reach).into_iter().map(|p| p + offset));
    }
    (!path.elements().is_empty()).then_some(path)
}

/// Loops around a cluster and around its holes, with the inside on the side of a turn from x to y.
fn rings(cluster: &FacetCluster, facets: &[Facet], neighbours: &FacetNeighbours) -> Vec<OutlineRing> {
    let mut members = cluster.facets.clone();
    members.sort_unstable();
    // Sides between the cluster and others, by their start.
    let mut sides: Vec<([u32; 2], [Point; 2], bool)> = Vec::new();
    for facet in &members {
        let member = &facets[*facet as usize];
        let numbers = neighbours.corners[*facet as usize];
        let turns = member.area2() >= 0.0;
        for side in 0..3 {
            if neighbours.beyond(*facet, side).is_some_and(|other| members.binary_search(&other).is_ok()) {
                continue;
            }
            let next = (side + 1) % 3;
            let [from, to] = if turns { [side, next] } else { [next, side] };
            let at = |k: usize| {
                let p = member.corners[k].image;
                Point::new(p.x, p.y)
            };
            sides.push(([numbers[from], numbers[to]], [at(from), at(to)], member.is_wall(side)));
        }
    }
    let mut sides_by_start: FxHashMap<u32, Vec<usize>> = FxHashMap::default();
    for (k, ([from, _], ..)) in sides.iter().enumerate() {
        sides_by_start.entry(*from).or_default().push(k);
    }
    let mut done = vec![false; sides.len()];
    let mut rings = Vec::new();
    for first in 0..sides.len() {
        let mut ring = Vec::new();
        let mut next = (!done[first]).then_some(first);
        while let Some(k) = next {
            done[k] = true;
            ring.push((sides[k].1[0], sides[k].2));
            let back = sides[k].1[0] - sides[k].1[1];
            // Where several sides begin, the one is taken that has the cluster between it and the last side.
            let starts = sides_by_start.get(&sides[k].0[1]).into_iter().flatten().copied();
            next = starts.filter(|k| !done[*k]).min_by(|a, b| {
                let turn = |k: &usize| turn_from_y_to_x(back, sides[*k].1[1] - sides[*k].1[0]);
                turn(a).total_cmp(&turn(b)).then(a.cmp(b))
            });
        }
        if ring.len() > 2 {
            rings.push(ring);
        }
    }
    rings
}

/// Loop without the points that lie on the straight line past them.
fn straightened(ring: &[(Point, bool)], tolerance: f64) -> OutlineRing {
    let mut remaining: OutlineRing = Vec::with_capacity(ring.len());
    for k in 0..ring.len() {
        let (before, (at, wall), after) =
            (*remaining.last().unwrap_or(&ring[ring.len() - 1]), ring[k], ring[(k + 1) % ring.len()].0);
        let chord = after - before.0;
        let cross_product = (at - before.0).cross(chord).abs();
        let along = (at - before.0).dot(chord);
        let is_between = along >= 0.0 && along <= chord.hypot2() && before.1 == wall;
        if !(is_between && cross_product <= tolerance * chord.hypot2().sqrt()) {
            remaining.push((at, wall));
        }
    }
    remaining
}

/// Loop with its sides moved outward by `reach`, except those where another face passes through.
fn widened(ring: &[(Point, bool)], reach: f64) -> Vec<Point> {
    let count = ring.len();
    // The inside is to the left in coordinates with y up, so outward is to the right.
    let normal_of = |k: usize| {
        let direction = unit(ring[(k + 1) % count].0 - ring[k].0);
        Vec2::new(direction.y, -direction.x)
    };
    let mut outline_points = Vec::with_capacity(count);
    for k in 0..count {
        let (before, after) = ((k + count - 1) % count, k);
        let (at, [first, second]) = (ring[k].0, [before, after].map(normal_of));
        match [ring[before].1, ring[after].1] {
            [false, false] => {
                let middle = unit(first + second);
                let cosine = middle.dot(second);
                let mitre = if cosine > 1.0 / MAX_MITRE { 1.0 / cosine } else { MAX_MITRE };
                outline_points.push(at + if middle == Vec2::ZERO { second } else { middle * mitre } * reach);
            }
            // Outward from the end of the wall and not along it, so nothing crosses the wall.
            [true, false] => outline_points.extend([at, at + second * reach]),
            [false, true] => outline_points.extend([at + first * reach, at]),
            [true, true] => outline_points.push(at),
        }
    }
    outline_points
}

#[cfg(test)]
mod tests {
    use crate::geometry::plane::polyline_path::polygon;
    use kurbo::Shape;

    use super::*;

    #[test]
    fn straightened_drops_collinear_points_and_widened_adds_reach() {
        let at = |x: f64, y: f64| Point::new(x, y);
        let ring = [at(0.0, 0.0), at(5.0, 0.001), at(10.0, 0.0), at(10.0, 10.0), at(0.0, 10.0)];
        let ring = straightened(&ring.map(|p| (p, false)), 0.02);
        assert_eq!(ring.len(), 4);
        let wide = widened(&ring, 1.0);
        let path = polygon(wide);
        assert!((path.area().abs() - 144.0).abs() < 1e-9, "{}", path.to_svg());
    }
}
