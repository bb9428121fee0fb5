//! [`Outlines`]: the ways along which solids were cut, in the plane, cut up until none crosses another, and the plane triangulated between
//! them (Delaunay, under constraints).

use glam::{DVec2, DVec3};
use robust::{Coord, orient2d};
use rustc_hash::FxHashMap;
use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2};

use super::plane::Plane;

#[derive(Clone, Copy)]
pub(crate) struct Corner(Point2<f64>);

impl HasPosition for Corner {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.0
    }
}

/// Triangles of the plane; their corners are points of the outlines, by number.
pub(crate) type Faces = ConstrainedDelaunayTriangulation<Corner>;

/// A piece of an outline.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Edge {
    pub ends: [u32; 2],
    /// How many faces there are along it.
    pub times: i32,
    /// The solid it bounds, and which of its open edges it is a piece of.
    pub solid: u32,
    pub of: u32,
    /// Whether it is a side of a face in the plane rather than an open edge.
    pub flat: bool,
}

/// The ways along which solids were cut, in the plane.
#[derive(Default)]
pub(crate) struct Outlines {
    points: Vec<DVec2>,
    /// Where each is in the world.
    places: Vec<DVec3>,
    /// Points by the field of a grid that they are in.
    known: FxHashMap<[i64; 2], Vec<u32>>,
    /// Points so near are one, and lie on an edge.
    reach: f64,
    pub edges: Vec<Edge>,
}

/// Cutting edges where they cross moves them a little, so that others may cross; seldom once, hardly ever twice.
const ROUNDS: usize = 8;

impl Outlines {
    /// None yet; points so near are one: what rounding leaves of the coordinates.
    pub fn new(reach: f64) -> Self {
        Self { reach: reach.max(f64::MIN_POSITIVE), ..Self::default() }
    }

    /// The number of a point.
    pub fn point(&mut self, p: DVec2, place: DVec3) -> u32 {
        let field = (p / (2.0 * self.reach)).to_array().map(|x| x.floor() as i64);
        for (i, j) in (-1..=1).flat_map(|i| (-1..=1).map(move |j| (i, j))) {
            let near = self.known.get(&[field[0].saturating_add(i), field[1].saturating_add(j)]);
            let is_it = |v: &u32| self.at(*v).distance_squared(p) <= self.reach * self.reach;
            if let Some(known) = near.into_iter().flatten().copied().find(is_it) {
                return known;
            }
        }
        let number = self.points.len() as u32;
        self.points.push(p);
        self.places.push(place);
        self.known.entry(field).or_default().push(number);
        number
    }

    pub fn at(&self, v: u32) -> DVec2 {
        self.points[v as usize]
    }

    pub fn place(&self, v: u32) -> DVec3 {
        self.places[v as usize]
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
    fn part(&mut self, [a, b]: [u32; 2], plane: &Plane) {
        let is_it = |ends: [u32; 2]| ends == [a, b] || ends == [b, a];
        let mut cuts: Vec<(f64, u32)> = Vec::new();
        for k in 0..self.edges.len() {
            let Edge { ends, .. } = self.edges[k];
            if is_it(ends) || !self.cross([a, b], ends) {
                continue;
            }
            let ([p, q], [c, d]) = ([a, b].map(|v| self.at(v)), ends.map(|v| self.at(v)));
            let share = (c - p).perp_dot(d - c) / (q - p).perp_dot(d - c);
            let at = p + (q - p) * share;
            let cut = self.point(at, plane.raised(at));
            cuts.push((share, cut));
            self.divide(k, [cut]);
        }
        cuts.sort_by(|a, b| a.0.total_cmp(&b.0));
        for k in 0..self.edges.len() {
            let ends = self.edges[k].ends;
            let way = cuts.iter().map(|(_, cut)| *cut);
            if ends == [a, b] {
                self.divide(k, way);
            } else if ends == [b, a] {
                self.divide(k, way.rev());
            }
        }
        self.edges.retain(|edge| edge.ends[0] != edge.ends[1]);
    }

    /// Puts points between the ends of an edge; the pieces behind the first one are added.
    fn divide(&mut self, k: usize, through: impl IntoIterator<Item = u32>) {
        let own = self.edges[k];
        let mut from = own.ends[0];
        for (n, to) in through.into_iter().chain([own.ends[1]]).enumerate() {
            let piece = Edge { ends: [from, to], ..own };
            if n == 0 {
                self.edges[k] = piece;
            } else {
                self.edges.push(piece);
            }
            from = to;
        }
    }

    /// Cuts edges at the points that lie on them.
    fn part_at_points(&mut self) {
        let mut order: Vec<u32> = (0..self.points.len() as u32).collect();
        order.sort_by(|a, b| self.at(*a).x.total_cmp(&self.at(*b).x));
        for k in 0..self.edges.len() {
            let ends = self.edges[k].ends;
            let [a, b] = ends.map(|v| self.at(v));
            let way = b - a;
            let (low, high) = (a.min(b) - self.reach, a.max(b) + self.reach);
            let first = order.partition_point(|v| self.at(*v).x < low.x);
            let near = order[first..].iter().copied().take_while(|v| self.at(*v).x <= high.x);
            let is_between = |v: &u32| {
                let p = self.at(*v);
                let share = (p - a).dot(way) / way.length_squared();
                !ends.contains(v)
                    && (low.y..=high.y).contains(&p.y)
                    && (0.0..=1.0).contains(&share)
                    && (self.side(ends, *v) == 0.0
                        || (p - a).perp_dot(way).abs() <= self.reach * way.length())
            };
            let mut on: Vec<u32> = near.filter(is_between).collect();
            on.sort_by(|p, q| (self.at(*p) - a).dot(way).total_cmp(&(self.at(*q) - a).dot(way)));
            self.divide(k, on);
        }
        self.edges.retain(|edge| edge.ends[0] != edge.ends[1]);
    }

    /// The plane between the outlines, which then consist of sides of its triangles.
    pub fn triangulated(&mut self, plane: &Plane) -> Option<Faces> {
        for round in 0..ROUNDS {
            self.part_at_points();
            let corners = self.points.iter().map(|p| Corner(Point2::new(p.x, p.y))).collect();
            let sorted = |edge: &Edge| {
                let [a, b] = edge.ends;
                [a.min(b) as usize, a.max(b) as usize]
            };
            let mut ends: Vec<[usize; 2]> = self.edges.iter().map(sorted).collect();
            ends.sort_unstable();
            ends.dedup();
            let mut crossing = Vec::new();
            let faces = Faces::try_bulk_load_cdt(corners, ends, |edge| crossing.push(edge)).ok()?;
            if crossing.is_empty() || round + 1 == ROUNDS {
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

/// The solid that has a triangle of the plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Owner {
    pub solid: u32,
    /// Whether anything in front of it was cut off.
    pub is_cut: bool,
}
