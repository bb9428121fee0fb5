//! [`IntersectionCurves`]: curves along which triangles of a mesh pass through each other.
//!
//! 1. A box tree proposes pairs of triangles; exact predicates decide.
//! 2. Every end of a segment has *names* that describe it, such as "edge of one triangle through the interior
//!    of the other". Ends with a common name are one point, so segments of neighbouring triangles join
//!    without comparing positions.
//! 3. Where the borders of both triangles meet, an end has three names: edge of one through face of the
//!    other, the reverse, and border on border. All triangles around the point then agree.

use crate::geometry::lists::disjoint_sets::DisjointSets;
use crate::geometry::space::bounds::Bounds;
use std::cmp::Ordering;

use crate::parallel::prelude::*;
use glam::DVec3;
use rustc_hash::FxHashMap;

use super::triangle_pair::{
    Along, Feature, PairIntersection, PairTolerance, SegmentEnd, Touch, Triangle, cross_unrejected,
};
use crate::mesh::PartId;
use crate::mesh::bvh::box_tree::{BoxTree, TreeFaces};

/// Triangles to intersect.
#[derive(Debug, Clone, Copy)]
pub struct IntersectionInput<'a> {
    /// World positions, finite.
    pub positions: &'a [DVec3],
    /// Vertices of each triangle, as indices into `positions`.
    pub triangles: &'a [[u32; 3]],
    /// Whether each triangle takes part; empty: all do.
    pub active: &'a [bool],
    /// Body of each triangle, or empty if there is only one. Triangles of one body with a common vertex are
    /// never compared.
    pub bodies: &'a [PartId],
}

/// Curves along which triangles pass through each other.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct IntersectionCurves {
    /// End points of the segments in world space, each once.
    pub points: Vec<DVec3>,
    /// One segment per pair of triangles, sorted by faces.
    pub segments: Vec<IntersectionSegment>,
}

/// Common segment of two triangles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct IntersectionSegment {
    /// Two different points. Their order follows the cross product of the two face normals. On a consistently
    /// oriented surface, consecutive segments therefore have the same direction while the lesser face stays
    /// on the same surface.
    pub ends: [u32; 2],
    /// The two triangles, lesser first.
    pub faces: [u32; 2],
}

/// Finds where triangles strictly pass through each other.
///
/// Not reported are
/// - triangles of one body with a common vertex,
/// - overlaps in one plane, and triangles that touch from one side,
/// - contacts shorter than [`OVERLAP_OF_PART`](crate::mesh::tolerances::OVERLAP_OF_PART) of the diagonal of
///   the box around all triangles, which count as one part.
///
/// A vertex in the plane of the other triangle does not matter if the other two corners are on opposite
/// sides. The result does not depend on the number of threads.
#[must_use]
pub fn intersections(input: &IntersectionInput) -> IntersectionCurves {
    let Some((low, high)) = bounds(input.positions, input.triangles) else {
        return IntersectionCurves::default();
    };
    let scale = (high - low).length();
    join(&find_pairs(input, low, high, |_| PairTolerance::of_exact(scale)))
}

/// Intersections of triangles of several parts. `tolerance` returns that of the part of a face; the larger of
/// two applies.
#[must_use]
pub(crate) fn intersections_of_parts(
    input: &IntersectionInput,
    tolerance: impl Fn(u32) -> PairTolerance + Sync,
) -> IntersectionCurves {
    let Some((low, high)) = bounds(input.positions, input.triangles) else {
        return IntersectionCurves::default();
    };
    join(&find_pairs(input, low, high, tolerance))
}

/// All pairs of triangles that intersect or touch and are not neighbours, sorted. `low` and `high` are the
/// corners of a box around all triangles.
pub(crate) fn find_pairs(
    input: &IntersectionInput,
    low: DVec3,
    high: DVec3,
    tolerance: impl Fn(u32) -> PairTolerance + Sync,
) -> Vec<IntersectingPair> {
    let IntersectionInput { positions, triangles, active, .. } = *input;
    pairs_in(&BoxTree::new(positions, triangles, active, low, high), input, tolerance)
}

/// The pairs among the triangles of a tree, sorted.
pub(crate) fn pairs_in(
    tree: &BoxTree,
    input: &IntersectionInput,
    tolerance: impl Fn(u32) -> PairTolerance + Sync,
) -> Vec<IntersectingPair> {
    let faces = TreeFaces { triangles: input.triangles, bodies: input.bodies };
    let mut pairs =
        tree.overlaps(faces, |face, others, found| pairs_of(input, face, others, &tolerance, found));
    pairs.par_sort_unstable_by_key(|pair| pair.faces);
    pairs
}

/// Adds the pairs that a triangle forms with others.
pub(crate) fn pairs_of(
    input: &IntersectionInput,
    face: u32,
    others: &[u32],
    tolerance: impl Fn(u32) -> PairTolerance,
    found: &mut Vec<IntersectingPair>,
) {
    let IntersectionInput { positions, triangles, .. } = *input;
    let own_triangle = &Triangle::new(positions, triangles[face as usize]);
    let own_tolerance = tolerance(face);
    for &other_face in others {
        let other_vertices = triangles[other_face as usize];
        if own_triangle.has_on_one_side(&other_vertices.map(|v| positions[v as usize])) {
            continue;
        }
        let other_triangle = Triangle::new(positions, other_vertices);
        if other_triangle.has_on_one_side(&own_triangle.corners) {
            continue;
        }
        let tolerance = own_tolerance.and(tolerance(other_face));
        let common = if face < other_face {
            cross_unrejected(own_triangle, &other_triangle, tolerance)
        } else {
            cross_unrejected(&other_triangle, own_triangle, tolerance)
        };
        if let Some(common) = common {
            found.push(IntersectingPair { faces: [face.min(other_face), face.max(other_face)], common });
        }
    }
}

/// Two triangles with their common part.
#[derive(Debug, Clone, Copy)]
pub(crate) struct IntersectingPair {
    pub(crate) faces: [u32; 2],
    pub(crate) common: PairIntersection,
}

/// The box around all corners of all triangles.
pub(crate) fn bounds(positions: &[DVec3], triangles: &[[u32; 3]]) -> Option<(DVec3, DVec3)> {
    let grow =
        |around: Bounds, corners: &[u32; 3]| around.union(Bounds::of(corners.map(|v| positions[v as usize])));
    let all = triangles.par_iter().fold(|| Bounds::EMPTY, grow).reduce(|| Bounds::EMPTY, Bounds::union);
    (!triangles.is_empty()).then_some((all.low, all.high))
}

/// Name of an end: a feature, and the face that it pierces (with [`FACE_INTERIOR`]) or the feature that it meets.
type EndName = (Feature, [u32; 2]);

/// Marks a name whose second entry is a face; no vertex has this id.
const FACE_INTERIOR: u32 = u32::MAX;

/// One name of one end.
struct NamedEnd {
    name: EndName,
    end: u32,
    point: DVec3,
}

/// Joins ends with a common name to points. The pairs must be sorted by faces.
pub(crate) fn join(pairs: &[IntersectingPair]) -> IntersectionCurves {
    // Segments have two ends. A point has one end, which contributes only its names.
    let mut namings = Vec::new();
    let mut end_count = 0;
    let mut segments = Vec::new();
    let (passing, crossed) = (passing_edges(pairs), crossed_edges(pairs));
    for &IntersectingPair { faces, common } in pairs {
        let (ends, step) = match common {
            PairIntersection::Segment(ends) => (ends, 1),
            PairIntersection::Point(ends) => (ends, 0),
            PairIntersection::Touch(touch) => {
                let Some([first, second]) = passing.get(&pierced_and_edge(faces, &touch)) else { continue };
                let (pierced, host_face) = pierced_and_own(faces, &touch);
                if host_face != *first {
                    continue;
                }
                // Neighbours may name either face at the edge.
                let second_faces = if pierced < *second { [pierced, *second] } else { [*second, pierced] };
                let turned = (pierced < host_face) != (pierced < *second);
                let ends = if turned { touch.ends.map(|[a, b]| [b, a]) } else { touch.ends };
                name_end(ends[0], second_faces, end_count, &mut namings);
                name_end(ends[1], second_faces, end_count + 1, &mut namings);
                (touch.ends, 1)
            }
            PairIntersection::Along(along) => {
                let Some(all) = crossed.get(&sorted(&along)).filter(|all| all[0].faces == faces) else {
                    continue;
                };
                for pair in &all[1..] {
                    let ends = pair.common.ends();
                    let is_turned = gap(&along.ends[0], &ends[1]) < gap(&along.ends[0], &ends[0]);
                    name_end(ends[usize::from(is_turned)], pair.faces, end_count, &mut namings);
                    name_end(ends[usize::from(!is_turned)], pair.faces, end_count + 1, &mut namings);
                }
                (along.ends, 1)
            }
        };
        if step == 1 {
            segments.push(IntersectionSegment { ends: [end_count, end_count + 1], faces });
        }
        name_end(ends[0], faces, end_count, &mut namings);
        name_end(ends[1], faces, end_count + step, &mut namings);
        end_count += step + 1;
    }
    namings.par_sort_unstable_by_key(|naming| (naming.name, naming.end));

    let joined = DisjointSets::new(end_count as usize, |join| {
        for same in namings.chunk_by(|a, b| a.name == b.name) {
            same[1..].iter().for_each(|naming| join(same[0].end, naming.end));
        }
    });

    // Positions of one point differ by rounding. Those of vertices take precedence over those on edges, and
    // then the smallest one is taken. Vertex and face numbers depend on the order of parts and must have no
    // effect.
    let order = |a: &&NamedEnd, b: &&NamedEnd| {
        let is_of_edge = |naming: &NamedEnd| naming.name.0[0] != naming.name.0[1];
        is_of_edge(a).cmp(&is_of_edge(b)).then_with(|| compare_places(a.point, b.point))
    };
    let mut best_naming: Vec<Option<&NamedEnd>> = vec![None; end_count as usize];
    for naming in &namings {
        let slot = &mut best_naming[joined.representative(naming.end) as usize];
        if slot.is_none_or(|best| order(&naming, &best).is_lt()) {
            *slot = Some(naming);
        }
    }

    let mut points = Vec::new();
    let mut index: Vec<Option<u32>> = vec![None; end_count as usize];
    for segment in &mut segments {
        segment.ends = segment.ends.map(|end| {
            let end = joined.representative(end) as usize;
            *index[end].get_or_insert_with(|| {
                points.extend(best_naming[end].map(|naming| naming.point));
                points.len() as u32 - 1
            })
        });
    }
    segments.retain(|segment| segment.ends[0] != segment.ends[1]);
    IntersectionCurves { points, segments }
}

/// The face that contains the edge, and the face that the edge belongs to.
fn pierced_and_own([a, b]: [u32; 2], touch: &Touch) -> (u32, u32) {
    if touch.is_of_second { (a, b) } else { (b, a) }
}

fn pierced_and_edge(faces: [u32; 2], touch: &Touch) -> (u32, Feature) {
    (pierced_and_own(faces, touch).0, touch.edge)
}

/// Edges that lie in a face where surfaces pass through it. Values are the first two faces with the edge on
/// either side, lesser first.
fn passing_edges(pairs: &[IntersectingPair]) -> FxHashMap<(u32, Feature), [u32; 2]> {
    let mut sides: FxHashMap<(u32, Feature), [Option<u32>; 2]> = FxHashMap::default();
    for IntersectingPair { faces, common } in pairs {
        if let PairIntersection::Touch(touch) = common {
            let side =
                &mut sides.entry(pierced_and_edge(*faces, touch)).or_default()[usize::from(touch.is_above)];
            let host_face = pierced_and_own(*faces, touch).1;
            *side = Some(side.map_or(host_face, |lowest| lowest.min(host_face)));
        }
    }
    let both = |(key, [below, above]): (_, [Option<u32>; 2])| {
        let (below, above) = (below?, above?);
        Some((key, [below.min(above), below.max(above)]))
    };
    sides.into_iter().filter_map(both).collect()
}

/// Pairs of collinear edges where two surfaces pass through each other, with their four pairs of faces in
/// order.
fn crossed_edges(pairs: &[IntersectingPair]) -> FxHashMap<[Feature; 2], Vec<IntersectingPair>> {
    let mut found: FxHashMap<[Feature; 2], Vec<IntersectingPair>> = FxHashMap::default();
    for pair in pairs {
        if let PairIntersection::Along(along) = &pair.common {
            found.entry(sorted(along)).or_default().push(*pair);
        }
    }
    found.retain(|_, line_pairs| alternate_around_line(line_pairs));
    found
}

/// The collinear edges of two faces, lesser first.
fn sorted(along: &Along) -> [Feature; 2] {
    let [a, b] = along.edges;
    [a.min(b), a.max(b)]
}

/// Whether the faces at two collinear edges alternate around the line, with two faces per edge. Coplanar
/// faces do not occur: such pairs have no common part.
fn alternate_around_line(pairs: &[IntersectingPair]) -> bool {
    let mut sides: [Vec<(u32, DVec3)>; 2] = Default::default();
    for IntersectingPair { faces, common } in pairs {
        let PairIntersection::Along(along) = common else { continue };
        for k in 0..2 {
            let side_faces = &mut sides[usize::from(along.edges[k] > along.edges[1 - k])];
            if side_faces.iter().all(|(face, _)| *face != faces[k]) {
                side_faces.push((faces[k], along.away[k]));
            }
        }
    }
    let (4, [[(_, first), (_, second)], others @ [_, _]]) =
        (pairs.len(), sides.each_ref().map(Vec::as_slice))
    else {
        return false;
    };
    let quarter = first.cross(others[0].1).normalize_or_zero().cross(*first);
    let angle = |direction: &DVec3| {
        let angle =
            crate::geometry::numbers::portable_math::atan2(direction.dot(quarter), direction.dot(*first));
        if angle < 0.0 { angle + std::f64::consts::TAU } else { angle }
    };
    let is_between = |candidate: &DVec3| angle(candidate) < angle(second);
    is_between(&others[0].1) != is_between(&others[1].1)
}

/// Distance between two ends.
fn gap(one: &SegmentEnd, other: &SegmentEnd) -> f64 {
    let point_of = |end: &SegmentEnd| end.iter().flatten().next().map(|piercing| piercing.point);
    point_of(one).zip(point_of(other)).map_or(f64::INFINITY, |(a, b)| a.distance(b))
}

/// Adds all names of one end of the common part of two faces.
fn name_end([a, b]: SegmentEnd, faces: [u32; 2], end: u32, namings: &mut Vec<NamedEnd>) {
    if let Some(a) = a {
        namings.push(NamedEnd { name: (a.feature, [faces[1], FACE_INTERIOR]), end, point: a.point });
    }
    if let Some(b) = b {
        namings.push(NamedEnd { name: (b.feature, [faces[0], FACE_INTERIOR]), end, point: b.point });
    }
    if let (Some(a), Some(b)) = (a, b) {
        // A vertex on the border of the other triangle has its own position. Two edges that meet have two
        // nearly equal positions; the lesser edge decides.
        let (first, second) = if a.feature < b.feature { (a, b) } else { (b, a) };
        namings.push(NamedEnd { name: (first.feature, second.feature), end, point: first.point });
    }
}

fn compare_places(a: DVec3, b: DVec3) -> Ordering {
    a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z))
}
