//! [`cylinders`]: circular cylinders that a mesh approximates, with their axes.
//!
//! 1. Facets with parallel side lines are flat strips. Seen along the axis, a strip is a chord of the circle.
//! 2. The perpendicular bisectors of two adjacent strips meet in the centre of the circle.
//! 3. Pairs of strips that share a strip and agree on the circle form a cylinder.
//! 4. A circle is fitted to the corners of all strips.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;

use super::coaxial_rims::rims;
use super::cylinder::Cylinder;
use crate::geometry::lists::disjoint_sets::DisjointSets;
use crate::geometry::numbers::portable_math::atan2;
use crate::geometry::space::triangles::unit_normal;
use crate::mesh::components::bodies::body_of;
use crate::mesh::{EdgeFaces, FaceId, Mesh, PartId};
use crate::surface::tolerances::{
    MAX_CIRCLE_OFFSET_OF_RADIUS, MAX_END_DIFFERENCE_OF_STRIP, MAX_PARALLEL_SINE, MAX_SIDE_OFFSET_OF_WIDTH,
    MIN_BISECTOR_SINE,
};

/// Minimum cosine between faces of one facet (0.06 degrees), and between adjacent strips of one cylinder (50
/// degrees).
const MIN_FACET_COSINE: f64 = 0.999_999_4;
const MIN_STRIP_COSINE: f64 = 0.642_787_6;

/// Maximum number of side lines of a strip. A facet with more is a face of a machined part.
const MAX_STRIP_LINES: usize = 64;

/// Flat strip between two lines along an axis.
#[derive(Debug, Clone, Copy)]
struct FlatStrip {
    axis: DVec3,
    normal: DVec3,
    /// A point in its middle, and its width across the axis.
    middle: DVec3,
    width: f64,
    ends: [f64; 2],
    /// Whether it narrows at both ends, as segments of a torus do.
    tapers: bool,
}

/// Two adjacent strips, and the circle that has both as chords.
struct StripPair {
    strips: [usize; 2],
    centre: DVec3,
    radius: f64,
    is_hole: bool,
}

/// The cylinders of a mesh, by part, then by descending radius.
#[must_use]
pub(crate) fn cylinders(mesh: &Mesh) -> Vec<Cylinder> {
    let normals: Vec<DVec3> =
        (0..mesh.triangles.len()).map(|face| unit_normal(mesh.corners(FaceId(face as u32)))).collect();
    let joined_faces = |edge: usize| match mesh.edges.faces(edge) {
        EdgeFaces::Two { faces: [a, b], same_way: false } if mesh.body(a) == mesh.body(b) => Some([a, b]),
        _ => None,
    };
    let turn = |[a, b]: [u32; 2]| normals[a as usize].dot(normals[b as usize]);
    let facets = DisjointSets::new(mesh.triangles.len(), |join| {
        for faces in
            (0..mesh.edges.len()).filter_map(joined_faces).filter(|faces| turn(*faces) > MIN_FACET_COSINE)
        {
            join(faces[0], faces[1]);
        }
    });
    // Edges where the surface bends slightly, by the facets on both sides.
    let mut lines: FxHashMap<u32, Vec<usize>> = FxHashMap::default();
    let mut order: Vec<u32> = Vec::new();
    let facet = |face: u32| facets.representative(face);
    for edge in 0..mesh.edges.len() {
        let Some(faces) =
            joined_faces(edge).filter(|faces| (MIN_STRIP_COSINE..=MIN_FACET_COSINE).contains(&turn(*faces)))
        else {
            continue;
        };
        for face in faces {
            let facet_edges = lines.entry(facet(face)).or_default();
            if facet_edges.is_empty() {
                order.push(facet(face));
            }
            facet_edges.push(edge);
        }
    }
    let mut first_face: FxHashMap<u32, u32> = FxHashMap::default();
    for face in 0..mesh.triangles.len() as u32 {
        first_face.entry(facet(face)).or_insert(face);
    }
    let mut strips: Vec<FlatStrip> = Vec::new();
    let mut edges_of: Vec<Vec<usize>> = Vec::new();
    let mut part_of: Vec<PartId> = Vec::new();
    let mut at_edge: FxHashMap<usize, Vec<usize>> = FxHashMap::default();
    let mut edges: Vec<usize> = Vec::new();
    for facet_id in order {
        let (Some(lines), Some(face)) = (lines.get(&facet_id), first_face.get(&facet_id)) else { continue };
        for (strip, along) in strips_of(mesh, lines, normals[*face as usize]) {
            for edge in &along {
                let strip_ids = at_edge.entry(*edge).or_default();
                if strip_ids.is_empty() {
                    edges.push(*edge);
                }
                strip_ids.push(strips.len());
            }
            strips.push(strip);
            edges_of.push(along);
            part_of.push(mesh.face_part[*face as usize]);
        }
    }
    edges.sort_unstable();
    let pairs: Vec<StripPair> =
        edges.iter().flat_map(|edge| pairs_at(mesh, *edge, &at_edge[edge], &strips)).collect();
    let mut found = grouped(mesh, &pairs, (&strips, &edges_of), &part_of);
    let rims = rims(mesh, &normals, &facets, &found);
    found.extend(rims);
    found.sort_by(|a, b| a.part.index().cmp(&b.part.index()).then(b.radius.total_cmp(&a.radius)));
    found
}

/// The strips that a facet forms, with their lines: one strip for each direction whose parallel lines all lie
/// on two sides.
fn strips_of(mesh: &Mesh, lines: &[usize], normal: DVec3) -> Vec<(FlatStrip, Vec<usize>)> {
    if lines.len() < 2 || lines.len() > MAX_STRIP_LINES {
        return Vec::new();
    }
    let ends = |edge: usize| mesh.ends(edge);
    let direction = |edge: usize| {
        let [a, b] = ends(edge);
        (b - a).normalize_or_zero()
    };
    let mut done = vec![false; lines.len()];
    let mut strips = Vec::new();
    for k in 0..lines.len() {
        let axis = direction(lines[k]);
        if done[k] || axis == DVec3::ZERO {
            continue;
        }
        let mut along = Vec::new();
        for (n, edge) in lines.iter().enumerate() {
            if direction(*edge).cross(axis).length() < MAX_PARALLEL_SINE {
                done[n] = true;
                along.push(*edge);
            }
        }
        let across = normal.cross(axis).normalize_or_zero();
        let offset_across = |edge: &usize| {
            let [a, b] = ends(*edge);
            (a + b).dot(across) / 2.0
        };
        let low = along.iter().map(offset_across).fold(f64::INFINITY, f64::min);
        let high = along.iter().map(offset_across).fold(f64::NEG_INFINITY, f64::max);
        let width = high - low;
        let is_outer = |edge: &usize| {
            (offset_across(edge) - low).min(high - offset_across(edge)) < MAX_SIDE_OFFSET_OF_WIDTH * width
        };
        if width <= 0.0 || !along.iter().all(is_outer) {
            continue;
        }
        let reach = |side: f64| {
            let is_on_side =
                |edge: &&usize| (offset_across(edge) - side).abs() < MAX_SIDE_OFFSET_OF_WIDTH * width;
            let side_edges = along.iter().filter(is_on_side);
            side_edges.flat_map(|edge| ends(*edge)).fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], p| {
                let at = p.dot(axis);
                [l.min(at), h.max(at)]
            })
        };
        let ([a, b], [c, d]) = (reach(low), reach(high));
        let (start, end) = (a.min(c), b.max(d));
        let nearly = MAX_END_DIFFERENCE_OF_STRIP * (end - start).max(width);
        let differs = (a - c).abs() > nearly && (b - d).abs() > nearly;
        let tapers = differs && (a < c) == (b > d);
        let some = ends(along[0])[0];
        let middle = some + across * ((low + high) / 2.0 - some.dot(across));
        strips.push((FlatStrip { axis, normal, middle, width, ends: [start, end], tapers }, along));
    }
    strips
}

/// The circles of each pair of strips at an edge.
fn pairs_at(mesh: &Mesh, edge: usize, strip_indices: &[usize], strips: &[FlatStrip]) -> Vec<StripPair> {
    let mut pairs = Vec::new();
    let on = mesh.positions[mesh.edges.vertices[edge][0] as usize];
    for (k, a) in strip_indices.iter().enumerate() {
        for b in &strip_indices[..k] {
            let (first, second) = (&strips[*a], &strips[*b]);
            let axis = first.axis;
            if axis.cross(second.axis).length() > MAX_PARALLEL_SINE {
                continue;
            }
            // Intersection of the perpendicular bisectors, seen along the axis.
            let flat = |v: DVec3| v - axis * v.dot(axis);
            let between = flat(second.middle - first.middle);
            let cross = first.normal.cross(second.normal).dot(axis);
            if cross.abs() < MIN_BISECTOR_SINE {
                continue;
            }
            let far = between.cross(second.normal).dot(axis) / cross;
            let centre = first.middle + first.normal * far;
            let radius = flat(on - centre).length();
            let hollow = flat(on - centre).dot(first.normal) < 0.0;
            pairs.push(StripPair { strips: [*a, *b], centre, radius, is_hole: hollow });
        }
    }
    pairs
}

/// Cylinders, as groups of pairs that share a strip and a circle.
fn grouped(
    mesh: &Mesh,
    pairs: &[StripPair],
    (strips, edges_of): (&[FlatStrip], &[Vec<usize>]),
    part_of: &[PartId],
) -> Vec<Cylinder> {
    let agree = |a: &StripPair, b: &StripPair| {
        let axis = strips[a.strips[0]].axis;
        let offset = a.centre - b.centre;
        let distance = (offset - axis * offset.dot(axis)).length();
        let reach = MAX_CIRCLE_OFFSET_OF_RADIUS * a.radius.min(b.radius);
        a.is_hole == b.is_hole && distance < reach && (a.radius - b.radius).abs() < reach
    };
    let mut at_strip: Vec<Vec<usize>> = vec![Vec::new(); strips.len()];
    for (k, pair) in pairs.iter().enumerate() {
        pair.strips.iter().for_each(|strip| at_strip[*strip].push(k));
    }
    let groups = DisjointSets::new(pairs.len(), |join| {
        for strip_pairs in &at_strip {
            for (k, a) in strip_pairs.iter().enumerate() {
                for b in strip_pairs[..k].iter().filter(|b| agree(&pairs[*a], &pairs[**b])) {
                    join(*a as u32, *b as u32);
                }
            }
        }
    });
    let mut members: Vec<Vec<usize>> = vec![Vec::new(); pairs.len()];
    for k in 0..pairs.len() {
        members[groups.representative(k as u32) as usize].push(k);
    }
    let mut found: Vec<Cylinder> = Vec::new();
    for group in members.into_iter().filter(|own| own.len() > 1) {
        let mut of: Vec<usize> = group.iter().flat_map(|pair| pairs[*pair].strips).collect();
        of.sort_unstable();
        of.dedup();
        if of.iter().all(|strip| strips[*strip].tapers) {
            continue;
        }
        let axis = strips[of[0]].axis;
        let mean = |value: &dyn Fn(&StripPair) -> f64| {
            group.iter().map(|k| value(&pairs[*k])).sum::<f64>() / group.len() as f64
        };
        let centre = group.iter().map(|k| pairs[*k].centre).sum::<DVec3>() / group.len() as f64;
        let radius = mean(&|pair| pair.radius);
        let angle = |width: f64| {
            let half = (width / 2.0).min(radius);
            2.0 * atan2(half, (radius * radius - half * half).sqrt())
        };
        let arc: f64 = of.iter().map(|strip| angle(strips[*strip].width)).sum();
        // Start and end, in the direction of the first strip.
        let ends = of.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], strip| {
            let [a, b] = strips[*strip].ends;
            let [a, b] = if strips[*strip].axis.dot(axis) < 0.0 { [-b, -a] } else { [a, b] };
            [low.min(a), high.max(b)]
        });
        let ends = ends.map(|end| end - centre.dot(axis));
        let corners = corners_of(mesh, &of, edges_of);
        let (centre, radius, spread) = fitted(&corners, axis, centre, radius);
        let (part, point) = (part_of[of[0]], centre + mesh.origin);
        let (arc, hollow) = (arc.min(TAU), pairs[group[0]].is_hole);
        merge(mesh, &mut found, Cylinder { part, point, axis, radius, spread, ends, arc, is_hole: hollow });
    }
    found
}

/// The distinct end points of the side lines of some strips.
fn corners_of(mesh: &Mesh, strips: &[usize], edges_of: &[Vec<usize>]) -> Vec<DVec3> {
    let edges = strips.iter().flat_map(|strip| &edges_of[*strip]);
    let mut corners: Vec<u32> = edges.flat_map(|edge| mesh.edges.vertices[*edge]).collect();
    corners.sort_unstable();
    corners.dedup();
    corners.into_iter().map(|corner| mesh.positions[corner as usize]).collect()
}

/// Centre and radius of the circle through some corners, seen along an axis, and the maximum distance of the
/// corners from it. If the fit deviates from the given circle, as on a short arc, the given one is kept.
///
/// The bisectors of two narrow strips meet at a small angle, so their intersection is much less accurate than
/// a fit to all corners.
///
/// Source: Kåsa, "A circle fitting procedure and its error analysis", 1976.
fn fitted(corners: &[DVec3], axis: DVec3, centre: DVec3, radius: f64) -> (DVec3, f64, f64) {
    let across = axis.any_orthonormal_vector();
    let along = axis.cross(across);
    let flat = |p: &DVec3| DVec2::new((*p - centre).dot(across), (*p - centre).dot(along));
    let spread = |to: DVec2, radius: f64| {
        corners.iter().map(|p| (flat(p).distance(to) - radius).abs()).fold(0.0, f64::max)
    };
    let unchanged = || (centre, radius, spread(DVec2::ZERO, radius));
    let count = corners.len() as f64;
    let mean = corners.iter().map(flat).sum::<DVec2>() / count;
    let (mut xx, mut xy, mut yy, mut right) = (0.0, 0.0, 0.0, DVec2::ZERO);
    for away in corners.iter().map(|p| flat(p) - mean) {
        (xx, xy, yy) = (xx + away.x * away.x, xy + away.x * away.y, yy + away.y * away.y);
        right += away * (away.length_squared() / 2.0);
    }
    let determinant = xx * yy - xy * xy;
    let to = mean + DVec2::new(yy * right.x - xy * right.y, xx * right.y - xy * right.x) / determinant;
    if !to.is_finite() || to.length() > MAX_CIRCLE_OFFSET_OF_RADIUS * radius {
        return unchanged();
    }
    let fitted = corners.iter().map(|p| flat(p).distance(to)).sum::<f64>() / count;
    let off = spread(to, fitted);
    if (fitted - radius).abs() > MAX_CIRCLE_OFFSET_OF_RADIUS * radius
        || off > MAX_CIRCLE_OFFSET_OF_RADIUS * radius
    {
        return unchanged();
    }
    (centre + across * to.x + along * to.y, fitted, off)
}

/// Adds a cylinder, or extends the known cylinder that it continues.
fn merge(mesh: &Mesh, found: &mut Vec<Cylinder>, new: Cylinder) {
    let body = |part: PartId| body_of(&mesh.bodies, part);
    let is_same = |existing: &&mut Cylinder| {
        let offset = existing.point - new.point;
        let reach = MAX_CIRCLE_OFFSET_OF_RADIUS * new.radius;
        body(existing.part) == body(new.part)
            && existing.is_hole == new.is_hole
            && existing.axis.cross(new.axis).length() < MAX_PARALLEL_SINE
            && (existing.radius - new.radius).abs() < reach
            && (offset - new.axis * offset.dot(new.axis)).length() < reach
    };
    match found.iter_mut().find(is_same) {
        None => found.push(new),
        Some(matching) => {
            let shift = (new.point - matching.point).dot(matching.axis);
            let [a, b] =
                if matching.axis.dot(new.axis) < 0.0 { [-new.ends[1], -new.ends[0]] } else { new.ends };
            matching.ends = [matching.ends[0].min(a + shift), matching.ends[1].max(b + shift)];
            matching.arc = (matching.arc + new.arc).min(TAU);
            matching.spread = matching.spread.max(new.spread);
        }
    }
}
