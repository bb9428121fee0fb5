//! [`cap`]: the faces that close a shape where a plane has cut it open.
//!
//! The open edges are triangulated in the plane (Delaunay, under constraints); between them each patch is material or not by the number
//! of times that the edges go round it, so that holes stay open, and shells that overlap are one. Edges that cross get a vertex there.

use glam::DVec2;
use robust::{Coord, orient2d};
use rustc_hash::FxHashMap;
use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation as _};

use super::clip::Clipped;
use super::plane::Plane;
use crate::mesh::EdgeMark;

/// Cut faces of a shape.
#[derive(Debug, Default)]
pub(super) struct Cap {
    /// Vertices of the shape, counter-clockwise seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// What their sides are: hard where they border on the surface.
    pub marks: Vec<[EdgeMark; 3]>,
    /// Their area, in units of the world squared.
    pub area: f64,
    /// Least and greatest place along the axes of the plane.
    pub bounds: Option<[DVec2; 2]>,
    /// Outlines that do not close, and are left open.
    pub unclosed: u64,
}

#[derive(Clone, Copy)]
struct Corner(Point2<f64>);

impl HasPosition for Corner {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.0
    }
}

type Faces = ConstrainedDelaunayTriangulation<Corner>;

/// The edges that run in closed ways, and the number of connected outlines that do not.
pub(super) fn closed(cut: &Clipped) -> (Vec<([u32; 2], i32)>, u64) {
    let mut parent: Vec<u32> = (0..cut.nodes.len() as u32).collect();
    let mut excess = vec![0_i64; cut.nodes.len()];
    fn root(parent: &mut [u32], mut v: u32) -> u32 {
        while parent[v as usize] != v {
            parent[v as usize] = parent[parent[v as usize] as usize];
            v = parent[v as usize];
        }
        v
    }
    for ([a, b], times) in &cut.open {
        excess[*a as usize] += i64::from(*times);
        excess[*b as usize] -= i64::from(*times);
        let (a, b) = (root(&mut parent, *a), root(&mut parent, *b));
        parent[a.max(b) as usize] = a.min(b);
    }
    let mut is_open = vec![false; cut.nodes.len()];
    for v in 0..cut.nodes.len() as u32 {
        if excess[v as usize] != 0 {
            is_open[root(&mut parent, v) as usize] = true;
        }
    }
    let unclosed = is_open.iter().filter(|open| **open).count() as u64;
    let closes = |([a, _], _): &&([u32; 2], i32)| !is_open[root(&mut parent, *a) as usize];
    (cut.open.iter().filter(closes).copied().collect(), unclosed)
}

/// The cut faces of a shape; vertices where edges cross are added to it.
pub(super) fn cap(cut: &mut Clipped, plane: &Plane) -> Cap {
    let (open, unclosed) = closed(cut);
    let mut made = Cap { unclosed, ..Cap::default() };
    // Nodes at one place of the plane are one point.
    let mut outlines = Outlines::default();
    let mut vertices: Vec<u32> = Vec::new();
    let mut point = |node: u32| {
        let vertex = cut.nodes[node as usize];
        let point = outlines.point(plane.flat(cut.geometry.positions[vertex as usize]));
        if point as usize == vertices.len() {
            vertices.push(vertex);
        }
        point
    };
    // The new faces run the other way along the edges.
    let edges: Vec<([u32; 2], i32)> = open
        .iter()
        .map(|([a, b], times)| ([point(*b), point(*a)], *times))
        .filter(|([a, b], _)| a != b)
        .collect();
    outlines.edges = edges;
    let Some(faces) = triangulated(&mut outlines) else { return made };
    for p in outlines.points.iter().skip(vertices.len()) {
        vertices.push(cut.geometry.positions.len() as u32);
        cut.geometry.positions.push(plane.raised(*p));
        if !cut.geometry.colours.is_empty() {
            cut.geometry.colours.push([1.0; 4]);
        }
    }
    let inside = material(&faces, &outlines);
    for face in faces.inner_faces().filter(|face| inside[face.fix().index()]) {
        let mark = |beyond: usize| if inside[beyond] { EdgeMark::Hidden } else { EdgeMark::Hard };
        made.marks.push(face.adjacent_edges().map(|edge| mark(edge.rev().face().fix().index())));
        made.triangles.push(face.vertices().map(|corner| vertices[corner.fix().index()]));
        let [a, b, c] = face.positions().map(|p| DVec2::new(p.x, p.y));
        made.area += (b - a).perp_dot(c - a) / 2.0;
        let [low, high] = made.bounds.unwrap_or([a, a]);
        made.bounds = Some([low.min(a).min(b).min(c), high.max(a).max(b).max(c)]);
    }
    made
}

/// The closed ways along which a shape was cut, in the plane.
#[derive(Default)]
struct Outlines {
    points: Vec<DVec2>,
    known: FxHashMap<[u64; 2], u32>,
    /// Ends, and how many faces there are along the edge.
    edges: Vec<([u32; 2], i32)>,
}

impl Outlines {
    fn point(&mut self, p: DVec2) -> u32 {
        let p = p + DVec2::ZERO;
        let points = &mut self.points;
        *self.known.entry(p.to_array().map(f64::to_bits)).or_insert_with(|| {
            points.push(p);
            points.len() as u32 - 1
        })
    }

    fn at(&self, v: u32) -> DVec2 {
        self.points[v as usize]
    }

    /// On which side of the way from `a` to `b` a point lies, exactly: positive on its left.
    fn side(&self, [a, b]: [u32; 2], p: u32) -> f64 {
        let [a, b, p] = [a, b, p].map(|v| self.at(v)).map(|p| Coord { x: p.x, y: p.y });
        orient2d(a, b, p)
    }

    /// Whether two edges cross between their ends.
    fn cross(&self, one: [u32; 2], other: [u32; 2]) -> bool {
        let apart = |edge, [p, q]: [u32; 2]| {
            let (p, q) = (self.side(edge, p), self.side(edge, q));
            p > 0.0 && q < 0.0 || p < 0.0 && q > 0.0
        };
        apart(one, other) && apart(other, one)
    }

    /// Cuts an edge and all that cross it where they do.
    fn part(&mut self, [a, b]: [u32; 2]) {
        let is_it = |ends: [u32; 2]| ends == [a, b] || ends == [b, a];
        let mut cuts: Vec<(f64, u32)> = Vec::new();
        for k in 0..self.edges.len() {
            let (ends, times) = self.edges[k];
            if is_it(ends) || !self.cross([a, b], ends) {
                continue;
            }
            let ([p, q], [c, d]) = ([a, b].map(|v| self.at(v)), ends.map(|v| self.at(v)));
            let share = (c - p).perp_dot(d - c) / (q - p).perp_dot(d - c);
            let cut = self.point(p + (q - p) * share);
            cuts.push((share, cut));
            self.edges[k] = ([ends[0], cut], times);
            self.edges.push(([cut, ends[1]], times));
        }
        cuts.sort_by(|a, b| a.0.total_cmp(&b.0));
        for k in 0..self.edges.len() {
            let (ends, times) = self.edges[k];
            if !is_it(ends) {
                continue;
            }
            let mut way: Vec<u32> = cuts.iter().map(|(_, cut)| *cut).collect();
            if ends == [b, a] {
                way.reverse();
            }
            let mut from = ends[0];
            for (n, cut) in way.into_iter().chain([ends[1]]).enumerate() {
                if n == 0 {
                    self.edges[k] = ([from, cut], times)
                } else {
                    self.edges.push(([from, cut], times))
                }
                from = cut;
            }
        }
        self.edges.retain(|([a, b], _)| a != b);
    }
}

/// Cutting edges where they cross moves them a little, so that others may cross; seldom once, hardly ever twice.
const ROUNDS: usize = 8;

fn triangulated(outlines: &mut Outlines) -> Option<Faces> {
    for round in 0..ROUNDS {
        let corners = outlines.points.iter().map(|p| Corner(Point2::new(p.x, p.y))).collect();
        let mut ends: Vec<[usize; 2]> =
            outlines.edges.iter().map(|([a, b], _)| [*a.min(b) as usize, *a.max(b) as usize]).collect();
        ends.sort_unstable();
        ends.dedup();
        let mut crossing = Vec::new();
        let faces = Faces::try_bulk_load_cdt(corners, ends, |edge| crossing.push(edge)).ok()?;
        if crossing.is_empty() || round + 1 == ROUNDS {
            return Some(faces);
        }
        crossing.sort_unstable();
        for [a, b] in crossing {
            outlines.part([a as u32, b as u32]);
        }
    }
    None
}

/// For each face whether it is material: whether the outlines go round it.
fn material(faces: &Faces, outlines: &Outlines) -> Vec<bool> {
    let mut along: FxHashMap<[u32; 2], i32> = FxHashMap::default();
    for ([a, b], times) in &outlines.edges {
        *along.entry([*a.min(b), *a.max(b)]).or_default() += if a < b { *times } else { -times };
    }
    // An edge that other corners lie on is known by none of its pieces.
    let longer = |piece: [u32; 2]| -> i32 {
        let covers = |ends: [u32; 2]| {
            let way = outlines.at(ends[1]) - outlines.at(ends[0]);
            let share = |v: u32| (outlines.at(v) - outlines.at(ends[0])).dot(way) / way.length_squared();
            let is_on = |v: u32| outlines.side(ends, v) == 0.0 && (0.0..=1.0).contains(&share(v));
            piece.into_iter().all(is_on).then(|| if share(piece[0]) < share(piece[1]) { 1 } else { -1 })
        };
        outlines.edges.iter().filter_map(|(ends, times)| Some(covers(*ends)? * times)).sum()
    };
    let mut turns: Vec<Option<i32>> = vec![None; faces.num_all_faces()];
    let outer = faces.outer_face();
    turns[outer.fix().index()] = Some(0);
    let mut waiting: Vec<_> = faces.convex_hull().map(|edge| (edge, 0)).collect();
    // The left side of an edge is gone round as often more than its right side as there are faces along it.
    while let Some((edge, own)) = waiting.pop() {
        let beyond = edge.rev();
        let Some(next) = beyond.face().as_inner() else { continue };
        if turns[next.fix().index()].is_some() {
            continue;
        }
        let [from, to] = [beyond.from(), beyond.to()].map(|corner| corner.fix().index() as u32);
        let times = if beyond.is_constraint_edge() {
            let [low, high] = [from.min(to), from.max(to)];
            let times = along.get(&[low, high]).copied().unwrap_or_else(|| longer([low, high]));
            if from < to { times } else { -times }
        } else {
            0
        };
        let found = own + times;
        turns[next.fix().index()] = Some(found);
        waiting.extend(next.adjacent_edges().map(|edge| (edge, found)));
    }
    turns.into_iter().map(|turns| turns.unwrap_or_default() != 0).collect()
}
