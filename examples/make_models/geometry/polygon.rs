//! Triangulates a flat polygon with holes.
//!
//! 1. Holes are connected to the outer boundary by bridges.
//! 2. Ears are clipped one by one.
//! 3. Diagonals are flipped until the triangulation is constrained Delaunay.

use std::collections::BTreeMap;

use glam::DVec2;

/// Twice the signed area of a triangle.
fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

/// Counter-clockwise triangles of the area inside the first boundary and outside the others. A boundary lists
/// indices into `points`.
pub fn triangulate(points: &[DVec2], rims: Vec<Vec<usize>>) -> Vec<[usize; 3]> {
    let mut rims: Vec<Vec<usize>> = rims
        .into_iter()
        .enumerate()
        .map(|(place, mut rim)| {
            if (signed_area(points, &rim) > 0.0) != (place == 0) {
                rim.reverse();
            }
            rim
        })
        .collect();
    let mut polygon = rims.remove(0);
    let rightmost = |rim: &[usize]| {
        (0..rim.len()).max_by(|&a, &b| points[rim[a]].x.total_cmp(&points[rim[b]].x)).unwrap_or(0)
    };
    rims.sort_by(|a, b| points[b[rightmost(b)]].x.total_cmp(&points[a[rightmost(a)]].x));
    while !rims.is_empty() {
        let hole = rims.remove(0);
        let from = rightmost(&hole);
        let to = bridge(points, &polygon, &hole, &rims, hole[from]);
        let around = hole[from..].iter().chain(&hole[..=from]).copied();
        let detour: Vec<usize> = around.chain([polygon[to]]).collect();
        polygon.splice(to + 1..to + 1, detour);
    }
    let mut triangles = cut_ears(points, polygon);
    while turn_diagonals(points, &mut triangles) {}
    triangles
}

fn signed_area(points: &[DVec2], rim: &[usize]) -> f64 {
    (0..rim.len()).map(|i| points[rim[i]].perp_dot(points[rim[(i + 1) % rim.len()]])).sum()
}

/// Position in `polygon` of the nearest corner that is visible from `corner` of the hole.
fn bridge(
    points: &[DVec2],
    polygon: &[usize],
    hole: &[usize],
    others: &[Vec<usize>],
    corner: usize,
) -> usize {
    let eye = points[corner];
    let mut places: Vec<usize> = (0..polygon.len()).collect();
    places.sort_by(|&a, &b| {
        points[polygon[a]].distance_squared(eye).total_cmp(&points[polygon[b]].distance_squared(eye))
    });
    let count = polygon.len();
    let opens_to_eye = |place: usize| {
        let [before, here, after] =
            [(place + count - 1) % count, place, (place + 1) % count].map(|i| points[polygon[i]]);
        let (left, right) = (turn(before, here, eye) > 0.0, turn(here, after, eye) > 0.0);
        if turn(before, here, after) > 0.0 { left && right } else { left || right }
    };
    let is_clear = |place: usize| {
        let target = polygon[place];
        [polygon, hole].into_iter().chain(others.iter().map(Vec::as_slice)).all(|rim| {
            (0..rim.len()).all(|i| {
                let (a, b) = (rim[i], rim[(i + 1) % rim.len()]);
                [a, b].iter().any(|&end| points[end] == points[target] || end == corner)
                    || !meet(eye, points[target], points[a], points[b])
            })
        })
    };
    places.into_iter().find(|&place| opens_to_eye(place) && is_clear(place)).unwrap_or(0)
}

/// Whether two segments cross or touch.
fn meet(a: DVec2, b: DVec2, c: DVec2, d: DVec2) -> bool {
    turn(a, b, c) * turn(a, b, d) <= 0.0 && turn(c, d, a) * turn(c, d, b) <= 0.0
}

fn cut_ears(points: &[DVec2], mut polygon: Vec<usize>) -> Vec<[usize; 3]> {
    let mut triangles = Vec::with_capacity(polygon.len());
    let mut start = 0;
    while polygon.len() > 3 {
        let count = polygon.len();
        let corners_at = |i: usize| [(i + count - 1) % count, i, (i + 1) % count].map(|k| polygon[k]);
        let found =
            (0..count).map(|step| (start + step) % count).find(|&i| is_ear(points, &polygon, corners_at(i)));
        // Without an ear the boundaries cross. The rest is dropped, and the test for closed solids fails.
        let Some(i) = found else { return triangles };
        triangles.push(corners_at(i));
        polygon.remove(i);
        // Continuing after the ear avoids a single fan.
        start = i + 1;
    }
    triangles.extend(<[usize; 3]>::try_from(polygon));
    triangles
}

fn is_ear(points: &[DVec2], polygon: &[usize], corners: [usize; 3]) -> bool {
    let [a, b, c] = corners.map(|corner| points[corner]);
    turn(a, b, c) > 1e-12
        && polygon
            .iter()
            .filter(|corner| !corners.contains(corner))
            .map(|&corner| points[corner])
            .all(|p| turn(a, b, p) < 0.0 || turn(b, c, p) < 0.0 || turn(c, a, p) < 0.0)
}

/// Flips diagonals that are not Delaunay, at most one per triangle. Returns false if none was left.
fn turn_diagonals(points: &[DVec2], triangles: &mut [[usize; 3]]) -> bool {
    let mut sides: BTreeMap<[usize; 2], Vec<(usize, usize)>> = BTreeMap::new();
    for (place, triangle) in triangles.iter().enumerate() {
        for side in 0..3 {
            let (a, b) = (triangle[side], triangle[(side + 1) % 3]);
            sides.entry([a.min(b), a.max(b)]).or_default().push((place, side));
        }
    }
    let mut touched = vec![false; triangles.len()];
    let mut any = false;
    for pair in sides.values() {
        let &[(left, i), (right, j)] = pair.as_slice() else { continue };
        if touched[left] || touched[right] {
            continue;
        }
        let (a, b, c) = (triangles[left][i], triangles[left][(i + 1) % 3], triangles[left][(i + 2) % 3]);
        let d = triangles[right][(j + 2) % 3];
        let [pa, pb, pc, pd] = [a, b, c, d].map(|corner| points[corner]);
        let is_convex = turn(pc, pd, pb) > 1e-12 && turn(pd, pc, pa) > 1e-12;
        if is_convex && is_in_circle(pa, pb, pc, pd) {
            triangles[left] = [c, d, b];
            triangles[right] = [d, c, a];
            touched[left] = true;
            touched[right] = true;
            any = true;
        }
    }
    any
}

/// Whether `d` lies inside the circle through `a`, `b` and `c`, with a margin.
fn is_in_circle(a: DVec2, b: DVec2, c: DVec2, d: DVec2) -> bool {
    let [a, b, c] = [a - d, b - d, c - d];
    let [aa, bb, cc] = [a, b, c].map(DVec2::length_squared);
    let value = aa * b.perp_dot(c) + bb * c.perp_dot(a) + cc * a.perp_dot(b);
    // The margin is relative to the terms. It prevents endless flips of co-circular corners.
    value > 1e-9 * (aa * bb * cc).max(1e-30).sqrt() * (aa + bb + cc).sqrt()
}
