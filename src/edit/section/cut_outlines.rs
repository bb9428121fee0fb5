//! [`CutOutlines`]: outlines of all solids in the plane, split at crossings, and the constrained Delaunay
//! triangulation between them.

use glam::{DVec2, DVec3};
use robust::{Coord, orient2d};
use rustc_hash::FxHashMap;
use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2};

use super::plane::Plane;

#[derive(Clone, Copy)]
pub(crate) struct PlanePoint(Point2<f64>);

impl HasPosition for PlanePoint {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.0
    }
}

/// Triangulation of the plane. Its vertices are the points of the outlines, with the same indices.
pub(crate) type PlaneTriangles = ConstrainedDelaunayTriangulation<PlanePoint>;

/// Piece of an outline.
#[derive(Debug, Clone, Copy)]
pub(crate) struct OutlineEdge {
    pub ends: [u32; 2],
    /// Net number of faces along it.
    pub times: i32,
    /// Solid with this edge, and index of the open edge that this is a piece of.
    pub solid: u32,
    pub of: u32,
    /// Whether it is a side of a coplanar face rather than an open edge.
    pub flat: bool,
}

/// Outlines of all solids in the plane.
#[derive(Default)]
pub(crate) struct CutOutlines {
    points: Vec<DVec2>,
    /// World position of each point.
    world_positions: Vec<DVec3>,
    /// Points by grid cell.
    points_by_cell: FxHashMap<[i64; 2], Vec<u32>>,
    /// Distance within which points coincide, and lie on an edge.
    reach: f64,
    pub edges: Vec<OutlineEdge>,
}

/// Maximum number of rounds of splitting. Splitting moves edges slightly, which can cause new crossings. One
/// round is almost always enough.
const MAX_SPLIT_ROUNDS: usize = 8;

impl CutOutlines {
    /// Empty set with the distance within which points coincide.
    pub(crate) fn new(reach: f64) -> Self {
        Self { reach: reach.max(f64::MIN_POSITIVE), ..Self::default() }
    }

    /// Index of the point at a position, added if necessary.
    pub(crate) fn point(&mut self, p: DVec2, place: DVec3) -> u32 {
        let field = (p / (2.0 * self.reach)).to_array().map(|x| x.floor() as i64);
        for (i, j) in (-1..=1).flat_map(|i| (-1..=1).map(move |j| (i, j))) {
            let near = self.points_by_cell.get(&[field[0].saturating_add(i), field[1].saturating_add(j)]);
            let is_it = |v: &u32| self.at(*v).distance_squared(p) <= self.reach * self.reach;
            if let Some(known) = near.into_iter().flatten().copied().find(is_it) {
                return known;
            }
        }
        let number = self.points.len() as u32;
        self.points.push(p);
        self.world_positions.push(place);
        self.points_by_cell.entry(field).or_default().push(number);
        number
    }

    pub(crate) fn at(&self, v: u32) -> DVec2 {
        self.points[v as usize]
    }

    pub(crate) fn place(&self, v: u32) -> DVec3 {
        self.world_positions[v as usize]
    }

    /// Side of a point along an edge from `a` to `b`, exact: positive on the left.
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

    /// Splits an edge and all edges that cross it at their crossings.
    fn part(&mut self, [a, b]: [u32; 2], plane: &Plane) {
        let is_it = |edge_ends: [u32; 2]| edge_ends == [a, b] || edge_ends == [b, a];
        let mut cuts: Vec<(f64, u32)> = Vec::new();
        for k in 0..self.edges.len() {
            let OutlineEdge { ends, .. } = self.edges[k];
            if is_it(ends) || !self.cross([a, b], ends) {
                continue;
            }
            let ([p, q], [c, d]) = ([a, b].map(|v| self.at(v)), ends.map(|v| self.at(v)));
            let fraction = (c - p).perp_dot(d - c) / (q - p).perp_dot(d - c);
            let at = p + (q - p) * fraction;
            let cut = self.point(at, plane.raised(at));
            cuts.push((fraction, cut));
            self.divide(k, [cut]);
        }
        cuts.sort_by(|a, b| a.0.total_cmp(&b.0));
        for k in 0..self.edges.len() {
            let ends = self.edges[k].ends;
            let cut_points = cuts.iter().map(|(_, cut)| *cut);
            if ends == [a, b] {
                self.divide(k, cut_points);
            } else if ends == [b, a] {
                self.divide(k, cut_points.rev());
            }
        }
        self.edges.retain(|edge| edge.ends[0] != edge.ends[1]);
    }

    /// Splits an edge at points. Pieces after the first are appended.
    fn divide(&mut self, k: usize, through: impl IntoIterator<Item = u32>) {
        let own = self.edges[k];
        let mut from = own.ends[0];
        for (n, to) in through.into_iter().chain([own.ends[1]]).enumerate() {
            let piece = OutlineEdge { ends: [from, to], ..own };
            if n == 0 {
                self.edges[k] = piece;
            } else {
                self.edges.push(piece);
            }
            from = to;
        }
    }

    /// Splits edges at the points on them.
    fn split_at_points(&mut self) {
        let mut order: Vec<u32> = (0..self.points.len() as u32).collect();
        order.sort_by(|a, b| self.at(*a).x.total_cmp(&self.at(*b).x));
        for k in 0..self.edges.len() {
            let ends = self.edges[k].ends;
            let [a, b] = ends.map(|v| self.at(v));
            let direction = b - a;
            let (low, high) = (a.min(b) - self.reach, a.max(b) + self.reach);
            let first = order.partition_point(|v| self.at(*v).x < low.x);
            let candidates = order[first..].iter().copied().take_while(|v| self.at(*v).x <= high.x);
            let is_between = |v: &u32| {
                let p = self.at(*v);
                let fraction = (p - a).dot(direction) / direction.length_squared();
                !ends.contains(v)
                    && (low.y..=high.y).contains(&p.y)
                    && (0.0..=1.0).contains(&fraction)
                    && (self.side(ends, *v) == 0.0
                        || (p - a).perp_dot(direction).abs() <= self.reach * direction.length())
            };
            let mut points_on_edge: Vec<u32> = candidates.filter(is_between).collect();
            points_on_edge.sort_by(|p, q| {
                (self.at(*p) - a).dot(direction).total_cmp(&(self.at(*q) - a).dot(direction))
            });
            self.divide(k, points_on_edge);
        }
        self.edges.retain(|edge| edge.ends[0] != edge.ends[1]);
    }

    /// Triangulates the plane between the outlines. All outlines then consist of triangle sides.
    pub(crate) fn triangulate(&mut self, plane: &Plane) -> Option<PlaneTriangles> {
        for round in 0..MAX_SPLIT_ROUNDS {
            self.split_at_points();
            let corners = self.points.iter().map(|p| PlanePoint(Point2::new(p.x, p.y))).collect();
            let sorted = |edge: &OutlineEdge| {
                let [a, b] = edge.ends;
                [a.min(b) as usize, a.max(b) as usize]
            };
            let mut ends: Vec<[usize; 2]> = self.edges.iter().map(sorted).collect();
            ends.sort_unstable();
            ends.dedup();
            let mut crossing = Vec::new();
            let faces = PlaneTriangles::try_bulk_load_cdt(corners, ends, |edge| crossing.push(edge)).ok()?;
            if crossing.is_empty() || round + 1 == MAX_SPLIT_ROUNDS {
                return Some(faces);
            }
            crossing.sort_unstable();
            for [a, b] in crossing {
                self.part([a as u32, b as u32], plane);
            }
        }
        None
    }
}

/// Solid that owns a triangle of the plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct TriangleOwner {
    pub solid: u32,
    /// Whether material in front of it was removed.
    pub is_cut: bool,
}
