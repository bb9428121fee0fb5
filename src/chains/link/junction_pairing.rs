//! Junction pairing: which ends of view edges continue each other at their vertices.
//!
//! Two ends that are the only ones of their class at a vertex form a pair. Where more meet, ends of one
//! feature segment are paired first, and then the pairs that turn least.

use crate::parallel::prelude::*;
use kurbo::Vec2;

use super::directed_edge::{DirectedEdge, order};
use super::edge_class::EdgeClass;
use crate::geometry::lists::csr_lists::{CsrLists, csr_lists};
use crate::geometry::plane::planar_distance::unit;
use crate::visibility::ViewMap;

/// Marks an end that nothing continues.
pub(crate) const NO_PARTNER: u32 = u32::MAX;

/// Maximum number of ends of one class at a vertex that are paired by direction. At larger fans only pieces
/// of one segment are paired.
const MAX_JUNCTION_ENDS: usize = 48;

/// Cosine of the sharpest turn (50 degrees) of a line at a junction of lines of its class.
const MIN_JUNCTION_COSINE: f64 = 0.643;

/// Vertices per task.
const VERTICES_PER_TASK: usize = 4096;

/// Edge ends at each vertex: end `2e` is the start of edge `e`, and `2e + 1` its end.
struct VertexEnds(CsrLists<u32>);

impl VertexEnds {
    /// Collects the ends of the edges that `keep` accepts.
    fn new(map: &ViewMap, keep: impl Fn(usize) -> bool) -> Self {
        Self(csr_lists(map.vertices.len(), |put| {
            for (e, edge) in map.edges.iter().enumerate().filter(|(e, _)| keep(*e)) {
                put(edge.start.index(), (2 * e) as u32);
                put(edge.end.index(), (2 * e + 1) as u32);
            }
        }))
    }

    fn at(&self, vertex: usize) -> &[u32] {
        self.0.of(vertex)
    }
}

/// Ends that meet at a range of vertices.
#[derive(Debug, Default)]
struct VertexPairs {
    /// Pairs that are the only two of their class at a vertex.
    pairs: Vec<[u32; 2]>,
    /// Groups of three or more ends of one class at a vertex, concatenated, and the index after each group.
    crowds: Vec<u32>,
    crowd_ends: Vec<usize>,
}

impl VertexPairs {
    /// Ends that meet at a range of vertices.
    fn from_vertices(
        vertices: std::ops::Range<usize>,
        ends: &VertexEnds,
        classes: &[Option<EdgeClass>],
    ) -> Self {
        let mut result = Self::default();
        let mut remaining: Vec<u32> = Vec::new();
        for vertex in vertices {
            match *ends.at(vertex) {
                [] | [_] => {}
                [a, b] => {
                    if class(classes, a) == class(classes, b) {
                        result.pairs.push([a, b]);
                    }
                }
                ref vertex_ends => {
                    remaining.clear();
                    remaining.extend_from_slice(vertex_ends);
                    while let Some(first) = remaining.first() {
                        let first_class = class(classes, *first);
                        let begin = result.crowds.len();
                        remaining.retain(|end| {
                            let is_same_class = class(classes, *end) == first_class;
                            if is_same_class {
                                result.crowds.push(*end);
                            }
                            !is_same_class
                        });
                        if let [a, b] = result.crowds[begin..] {
                            result.pairs.push([a, b]);
                        }
                        if result.crowds.len() <= begin + 2 {
                            result.crowds.truncate(begin);
                        } else {
                            result.crowd_ends.push(result.crowds.len());
                        }
                    }
                }
            }
        }
        result
    }

    /// Pairs within the groups. `partner` must hold all simple pairs.
    fn pair_crowds(mut self, map: &ViewMap, partner: &[u32], window: f64) -> Vec<[u32; 2]> {
        let step = |end: u32| DirectedEdge { edge: end / 2, reversed: end % 2 == 1 };
        let mut junction = JunctionScratch::default();
        let mut matched = Vec::with_capacity(self.crowd_ends.len());
        let mut begin = 0;
        for end in self.crowd_ends {
            let crowd = &mut self.crowds[begin..end];
            // Equal turns are ordered by geometry, not by position in the map.
            crowd.sort_by(|a, b| order(map, step(*a), step(*b)));
            junction.pair_straightest(map, crowd, partner, window, &mut matched);
            begin = end;
        }
        matched
    }
}

/// Partner of each end of the edges that have a class, or [`NO_PARTNER`]. `window` is the length for measuring
/// directions at junctions.
pub(crate) fn pair_ends(map: &ViewMap, classes: &[Option<EdgeClass>], window: f64) -> Vec<u32> {
    let ends = VertexEnds::new(map, |e| classes[e].is_some());
    let mut partner = vec![NO_PARTNER; 2 * map.edges.len()];
    let count = map.vertices.len();
    let chunk = |k: usize| {
        VertexPairs::from_vertices(
            k * VERTICES_PER_TASK..count.min((k + 1) * VERTICES_PER_TASK),
            &ends,
            classes,
        )
    };
    let task_pairs: Vec<VertexPairs> =
        (0..count.div_ceil(VERTICES_PER_TASK)).into_par_iter().with_max_len(1).map(chunk).collect();
    let mut join = |[a, b]: [u32; 2]| {
        partner[a as usize] = b;
        partner[b as usize] = a;
    };
    task_pairs.iter().flat_map(|met| &met.pairs).for_each(|pair| join(*pair));
    // All directions are measured before any junction is paired, so the result does not depend on the order.
    let matched: Vec<Vec<[u32; 2]>> = task_pairs
        .into_par_iter()
        .with_max_len(1)
        .map(|met| met.pair_crowds(map, &partner, window))
        .collect();
    for [a, b] in matched.into_iter().flatten() {
        partner[a as usize] = b;
        partner[b as usize] = a;
    }
    partner
}

fn class(classes: &[Option<EdgeClass>], end: u32) -> Option<EdgeClass> {
    classes[(end / 2) as usize]
}

/// Buffers that are reused from junction to junction.
#[derive(Debug, Default)]
struct JunctionScratch {
    directions: Vec<Vec2>,
    pairs: Vec<(bool, f64, usize, usize)>,
    taken: Vec<bool>,
}

impl JunctionScratch {
    /// Pairs the ends of one class at a junction: pieces of one segment first, then the smallest turns.
    fn pair_straightest(
        &mut self,
        map: &ViewMap,
        crowd: &[u32],
        partner: &[u32],
        window: f64,
        matched: &mut Vec<[u32; 2]>,
    ) {
        let Self { directions, pairs, taken } = self;
        let segment = |end: u32| map.edges[(end / 2) as usize].segment;
        directions.clear();
        if crowd.len() <= MAX_JUNCTION_ENDS {
            directions.extend(crowd.iter().map(|end| direction(map, *end, partner, window)));
        }
        pairs.clear();
        for i in 0..crowd.len() {
            for j in i + 1..crowd.len() {
                let is_same_segment = segment(crowd[i]) == segment(crowd[j]) && crowd[i] / 2 != crowd[j] / 2;
                let cosine = match (directions.get(i), directions.get(j)) {
                    (Some(a), Some(b)) => -a.dot(*b),
                    _ => -1.0,
                };
                if is_same_segment || cosine > MIN_JUNCTION_COSINE {
                    pairs.push((is_same_segment, cosine, i, j));
                }
            }
        }
        pairs.sort_by(|a, b| b.0.cmp(&a.0).then(b.1.total_cmp(&a.1)).then((a.2, a.3).cmp(&(b.2, b.3))));
        taken.clear();
        taken.resize(crowd.len(), false);
        for &(_, _, i, j) in &*pairs {
            if !taken[i] && !taken[j] {
                taken[i] = true;
                taken[j] = true;
                matched.push([crowd[i], crowd[j]]);
            }
        }
    }
}

/// Unit direction of a line away from the vertex at `end`, measured over `window`; zero for a line without
/// extent.
fn direction(map: &ViewMap, end: u32, partner: &[u32], window: f64) -> Vec2 {
    let position = |end: u32| {
        let edge = &map.edges[(end / 2) as usize];
        map.vertices[if end & 1 == 0 { edge.start } else { edge.end }.index()].position
    };
    let from = position(end);
    let mut at = end;
    let mut to = from;
    for _ in 0..64 {
        to = position(at ^ 1);
        if (to - from).hypot2() >= window * window {
            break;
        }
        match partner[(at ^ 1) as usize] {
            NO_PARTNER => break,
            next if next / 2 == end / 2 => break,
            next => at = next,
        }
    }
    unit(to - from)
}

#[cfg(test)]
mod tests {
    use kurbo::Point;

    use super::*;
    use crate::geometry::numbers::noise::hash;
    use crate::lines::LineKind;
    use crate::mesh::{MaterialId, PartId};
    use crate::surface::MeshSource;
    use crate::visibility::{ViewEdge, ViewVertex, ViewVertexId, ViewVertexKind};

    /// A random graph with the given numbers of vertices and edges.
    fn random_view_map(vertices: u64, edges: u64) -> ViewMap {
        let roll = |what: u64, k: u64, sides: u64| hash(what, &[k, vertices, edges]) % sides;
        let mut map = ViewMap::default();
        for k in 0..vertices {
            let position = Point::new(roll(0, k, 1000) as f64, roll(1, k, 1000) as f64);
            map.vertices.push(ViewVertex {
                position,
                depth: 1.0,
                strength: 1.0,
                kind: ViewVertexKind::Vertex,
            });
        }
        for k in 0..edges {
            let [start, end] = [2, 3].map(|what| ViewVertexId(roll(what, k, vertices) as u32));
            map.edges.push(ViewEdge {
                start,
                end,
                kind: if roll(4, k, 3) == 0 { LineKind::Border } else { LineKind::Crease },
                invisibility: 0,
                silhouette: false,
                both_seen: roll(5, k, 2) == 0,
                smooth: false,
                origin: MeshSource::Constructed,
                strength: 90.0,
                part: PartId(0),
                material: MaterialId(0),
                segment: roll(6, k, edges) as u32,
            });
        }
        map
    }

    /// Reference: the same pairing, one vertex and one class at a time.
    fn pair_ends_per_vertex(map: &ViewMap, classes: &[Option<EdgeClass>], window: f64) -> Vec<u32> {
        let step = |end: u32| DirectedEdge { edge: end / 2, reversed: end % 2 == 1 };
        let all = || (0..2 * map.edges.len() as u32).filter(|end| class(classes, *end).is_some());
        let mut groups: Vec<Vec<u32>> = Vec::new();
        for vertex in 0..map.vertices.len() {
            for first in all().filter(|end| step(*end).from(map).index() == vertex) {
                let is_same_class = |end: &u32| class(classes, *end) == class(classes, first);
                let group = all().filter(|end| step(*end).from(map).index() == vertex).filter(is_same_class);
                groups.push(group.collect());
            }
        }
        let mut partner = vec![NO_PARTNER; 2 * map.edges.len()];
        for group in groups.iter().filter(|group| group.len() == 2) {
            (partner[group[0] as usize], partner[group[1] as usize]) = (group[1], group[0]);
        }
        let before = partner.clone();
        for group in groups.iter_mut().filter(|group| group.len() > 2) {
            group.sort_by(|a, b| order(map, step(*a), step(*b)));
            let mut matched = Vec::new();
            JunctionScratch::default().pair_straightest(map, group, &before, window, &mut matched);
            for [a, b] in matched {
                (partner[a as usize], partner[b as usize]) = (b, a);
            }
        }
        partner
    }

    #[test]
    fn pair_ends_matches_a_vertex_by_vertex_reference() {
        for (vertices, edges) in [(1, 9), (20, 30), (300, 400), (150, 600)] {
            let map = random_view_map(vertices, edges);
            let of = |(k, edge): (usize, &ViewEdge)| (k % 7 != 3).then(|| EdgeClass::of(&map, edge));
            let classes: Vec<Option<EdgeClass>> = map.edges.iter().enumerate().map(of).collect();
            for window in [0.0, 500.0] {
                assert_eq!(
                    pair_ends(&map, &classes, window),
                    pair_ends_per_vertex(&map, &classes, window),
                    "{edges} edges"
                );
            }
        }
    }
}
