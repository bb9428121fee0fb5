//! [`BoundaryEdges`]: the borders of two areas on an integer grid, and the border of their intersection.
//!
//! Edges are split where they cross. New points are rounded to the grid, and all tests are exact in integers.
//!
//! Source: Margalit and Knott, An algorithm for computing the union, intersection or difference of two
//! polygons, Computers & Graphics 1989. The border of an intersection consists of those pieces of both
//! borders that have it on one side only.

use std::collections::BTreeMap;

/// Point of the integer grid.
pub(crate) type ClipGridPoint = [i64; 2];

/// Greatest number of splitting rounds. Rounding can create new crossings, but rarely does.
const MAX_ROUNDS: usize = 12;

/// Edge between two grid points, the smaller point first. `winding` counts how often the shape's border runs
/// along it. Opposite runs count negative. `parts` says whether the domain's border runs along it.
#[derive(Debug, Clone, Copy)]
struct BoundaryEdge {
    ends: [ClipGridPoint; 2],
    winding: i64,
    parts: bool,
}

/// The borders of two areas: a shape, filled by winding number, and a domain, which lies on one side of its
/// border.
#[derive(Debug, Default)]
pub(crate) struct BoundaryEdges(Vec<BoundaryEdge>);

impl BoundaryEdges {
    /// Adds an edge of the shape with a winding, or an edge of the domain.
    pub(crate) fn add(&mut self, [a, b]: [ClipGridPoint; 2], winding: i64, parts: bool) {
        if a != b {
            let (ends, winding) = if a < b { ([a, b], winding) } else { ([b, a], -winding) };
            self.0.push(BoundaryEdge { ends, winding, parts });
        }
    }

    /// Splits the edges until they meet at their ends only and are all distinct. `None` if that takes too
    /// many rounds.
    pub(crate) fn cut(mut self) -> Option<Self> {
        for _ in 0..MAX_ROUNDS {
            self.merge();
            let mut cuts: Vec<Vec<ClipGridPoint>> = vec![Vec::new(); self.0.len()];
            // Edges are sorted by x, so only those with overlapping x ranges are compared.
            for i in 0..self.0.len() {
                for j in i + 1..self.0.len() {
                    if self.0[j].ends[0][0] > self.0[i].ends[1][0] + 1 {
                        break;
                    }
                    add_crossings(self.0[i].ends, self.0[j].ends, |first, p| {
                        cuts[if first { i } else { j }].push(p)
                    });
                }
            }
            if cuts.iter().all(Vec::is_empty) {
                return Some(self);
            }
            let mut next = Self::default();
            for (edge, mut cuts) in self.0.into_iter().zip(cuts) {
                let [a, b] = edge.ends;
                let way = |p: &ClipGridPoint| dot(minus(*p, a), minus(b, a));
                cuts.sort_by_key(|p| (way(p), *p));
                let mut here = a;
                for p in cuts.into_iter().chain([b]) {
                    next.add([here, p], edge.winding, edge.parts);
                    here = p;
                }
            }
            self = next;
        }
        None
    }

    /// Merges coincident edges and drops those that separate nothing.
    fn merge(&mut self) {
        let mut all: BTreeMap<[ClipGridPoint; 2], (i64, bool)> = BTreeMap::new();
        for edge in &self.0 {
            let found = all.entry(edge.ends).or_default();
            found.0 += edge.winding;
            found.1 ^= edge.parts;
        }
        let of = |(ends, (winding, parts))| BoundaryEdge { ends, winding, parts };
        self.0 = all.into_iter().map(of).filter(|edge| edge.winding != 0 || edge.parts).collect();
    }

    /// The closed rings around the intersection of shape and domain.
    pub(crate) fn intersection_rings(&self) -> Vec<Vec<ClipGridPoint>> {
        let mut leads: BTreeMap<ClipGridPoint, Vec<ClipGridPoint>> = BTreeMap::new();
        for edge in &self.0 {
            let (winding, within) = self.winding_right_of(edge);
            let right = winding != 0 && within;
            let left = winding + edge.winding != 0 && within != edge.parts;
            let [a, b] = edge.ends;
            match (right, left) {
                (true, false) => leads.entry(a).or_default().push(b),
                (false, true) => leads.entry(b).or_default().push(a),
                _ => {}
            }
        }
        let mut rings: Vec<Vec<ClipGridPoint>> = Vec::new();
        while let Some((first, _)) = leads.first_key_value() {
            let first = *first;
            let mut here = first;
            let mut ring = Vec::new();
            while let Some(next) = leads.get_mut(&here).and_then(Vec::pop) {
                if leads.get(&here).is_some_and(Vec::is_empty) {
                    leads.remove(&here);
                }
                ring.push(here);
                here = next;
                if here == first {
                    break;
                }
            }
            if ring.len() > 2 {
                rings.push(ring);
            }
        }
        rings
    }

    /// The winding number of the shape to the right of an edge (y upwards), and whether that side is in the
    /// domain.
    fn winding_right_of(&self, edge: &BoundaryEdge) -> (i64, bool) {
        let [a, b] = edge.ends;
        // The ray runs along x, or along y for a horizontal edge.
        let [u, v] = if a[1] == b[1] { [1, 0] } else { [0, 1] };
        let middle = [a[0] + b[0], a[1] + b[1]];
        let (mut winding, mut within) = (0, false);
        for other in &self.0 {
            let [c, d] = other.ends.map(|p| [2 * p[0], 2 * p[1]]);
            if (c[v] <= middle[v]) == (d[v] <= middle[v])
                || c[u].max(d[u]) < middle[u]
                || other.ends == edge.ends
            {
                continue;
            }
            // Whether the ray from the edge's middle towards greater `u` meets the other edge.
            let side = cross(minus(d, c), minus(middle, c));
            let rises = d[v] > c[v];
            let turned = if u == 0 { side } else { -side };
            if (turned > 0) == rises {
                winding += if rises == (u == 0) { other.winding } else { -other.winding };
                within ^= other.parts;
            }
        }
        // The counts so far describe the side with greater `u`.
        let is_right = u == 0 && b[1] > a[1];
        if is_right { (winding, within) } else { (winding - edge.winding, within != edge.parts) }
    }
}

fn minus(a: ClipGridPoint, b: ClipGridPoint) -> ClipGridPoint {
    [a[0] - b[0], a[1] - b[1]]
}

fn dot(a: ClipGridPoint, b: ClipGridPoint) -> i64 {
    a[0] * b[0] + a[1] * b[1]
}

fn cross(a: ClipGridPoint, b: ClipGridPoint) -> i64 {
    a[0] * b[1] - a[1] * b[0]
}

/// Calls `cut` for each point where a segment has to be split: whether it is the first segment, and the
/// point.
fn add_crossings(
    first: [ClipGridPoint; 2],
    second: [ClipGridPoint; 2],
    mut cut: impl FnMut(bool, ClipGridPoint),
) {
    let low = |s: [ClipGridPoint; 2], k: usize| s[0][k].min(s[1][k]);
    let high = |s: [ClipGridPoint; 2], k: usize| s[0][k].max(s[1][k]);
    if (0..2).any(|k| low(first, k) > high(second, k) + 1 || low(second, k) > high(first, k) + 1) {
        return;
    }
    let mut touches = false;
    for (is_first, segment, end_points) in [(true, first, second), (false, second, first)] {
        for p in end_points {
            if p != segment[0] && p != segment[1] && is_on(p, segment) {
                cut(is_first, p);
                touches = true;
            }
        }
    }
    let ([a, b], [c, d]) = (first, second);
    if touches || a == c || a == d || b == c || b == d {
        return;
    }
    let (first_vector, second_vector) = (minus(b, a), minus(d, c));
    let [sc, sd] = [c, d].map(|p| cross(first_vector, minus(p, a)).signum());
    let [sa, sb] = [a, b].map(|p| cross(second_vector, minus(p, c)).signum());
    if sc * sd < 0 && sa * sb < 0 {
        let part = cross(minus(c, a), second_vector) as f64 / cross(first_vector, second_vector) as f64;
        let p = [0, 1].map(|k| a[k] + (first_vector[k] as f64 * part).round() as i64);
        if p != a && p != b {
            cut(true, p);
        }
        if p != c && p != d {
            cut(false, p);
        }
    }
}

/// Whether a point lies within half a grid step of a segment, strictly between its ends.
fn is_on(p: ClipGridPoint, [a, b]: [ClipGridPoint; 2]) -> bool {
    let (way, from) = (minus(b, a), minus(p, a));
    let (along, whole) = (dot(way, from), dot(way, way));
    if along <= 0 || along >= whole {
        return false;
    }
    let off = cross(way, from) as f64;
    off * off * 4.0 <= whole as f64
}
