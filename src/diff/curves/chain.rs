//! [`OutlineChain`]: lines and outlines of a drawing as polylines, in a form that two drawings can be compared in.
//!
//! 1. The paths of shapes are flattened to polylines.
//! 2. Open polylines of one group are joined where exactly two ends meet, because one drawing may split a
//!    line that the other draws in one piece.
//! 3. Start, direction and order are normalised, so that they do not depend on the order of the file.

use crate::parallel::prelude::*;
use kurbo::{PathEl, Point};
use rustc_hash::FxHashMap;

use crate::diff::shapes::mark_groups::MarkGroups;
use crate::diff::shapes::picture::{Picture, ShapeKind};
use crate::diff::tolerances::{FLATTENING_OF_TOLERANCE, MAX_JOIN_GAP_OF_TOLERANCE, MIN_FLATTENING_OF_CURVE};

/// A polyline in px with a canonical start and direction. Points are ordered by x, then y. An open chain
/// starts at its lesser end; a closed one starts at its least point and continues to the lesser neighbour.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct OutlineChain {
    /// Index of the group of marks that it belongs to. Only chains of one group are joined or compared.
    pub group: usize,
    /// At least two points; in a closed chain the last point repeats the first.
    pub points: Vec<Point>,
    pub closed: bool,
    /// Indices of the shapes that form the chain, ascending.
    pub shapes: Vec<usize>,
}

impl OutlineChain {
    /// Length in px.
    pub(crate) fn length(&self) -> f64 {
        self.segments().map(|(p, q)| p.distance(q)).sum()
    }

    pub(crate) fn segments(&self) -> impl Iterator<Item = (Point, Point)> {
        self.points.windows(2).map(|pair| (pair[0], pair[1]))
    }

    /// Chains of a path that belongs to a shape. With `closes`, open subpaths are closed.
    pub(crate) fn of_path(
        path: &kurbo::BezPath,
        (group, shape): (usize, usize),
        groups: &MarkGroups,
        closes: bool,
    ) -> impl Iterator<Item = Self> {
        let flat = flatten(path, groups.tolerance(group) * FLATTENING_OF_TOLERANCE, closes);
        flat.into_iter().map(move |(points, closed)| Self { group, points, closed, shapes: vec![shape] })
    }

    /// Gives the chain its canonical start and direction.
    pub(crate) fn canonical(mut self) -> Self {
        let less = |a: &Point, b: &Point| order(*a, *b).is_lt();
        if self.closed {
            self.points.pop();
            let least = (0..self.points.len()).reduce(|a, b| match less(&self.points[b], &self.points[a]) {
                true => b,
                false => a,
            });
            self.points.rotate_left(least.unwrap_or(0));
            let (second, last) = (self.points.get(1), self.points.last());
            if second.zip(last).is_some_and(|(second, last)| less(last, second)) {
                self.points[1..].reverse();
            }
            self.points.extend(self.points.first().copied());
        } else if self.points.first().zip(self.points.last()).is_some_and(|(first, last)| less(last, first)) {
            self.points.reverse();
        }
        self.shapes.sort_unstable();
        self.shapes.dedup();
        self
    }
}

/// Order of points by x, then y.
fn order(a: Point, b: Point) -> std::cmp::Ordering {
    a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y))
}

/// The chains of some shapes of a picture, sorted by position. `of_shape` gives the group of each shape of
/// the picture.
pub(crate) fn chains_of_shapes(
    picture: &Picture,
    shapes: &[usize],
    of_shape: &[usize],
    groups: &MarkGroups,
) -> Vec<OutlineChain> {
    let flat: Vec<Vec<OutlineChain>> = shapes
        .par_iter()
        .map(|index| {
            let (Some(shape), Some(group)) = (picture.shapes.get(*index), of_shape.get(*index)) else {
                return Vec::new();
            };
            let closes = shape.kind != ShapeKind::Line;
            OutlineChain::of_path(&shape.path, (*group, *index), groups, closes).collect()
        })
        .collect();
    let mut by_group: FxHashMap<usize, Vec<OutlineChain>> = FxHashMap::default();
    let mut done = Vec::new();
    for chain in flat.into_iter().flatten() {
        match chain.closed {
            true => done.push(chain.canonical()),
            false => by_group.entry(chain.group).or_default().push(chain),
        }
    }
    let mut open: Vec<(usize, Vec<OutlineChain>)> = by_group.into_iter().collect();
    open.sort_unstable_by_key(|(group, _)| *group);
    for (group, chains) in open {
        let joined = join(chains, groups.tolerance(group) * MAX_JOIN_GAP_OF_TOLERANCE);
        done.extend(joined.into_iter().map(OutlineChain::canonical));
    }
    sort(&mut done);
    done
}

/// Sorts chains by their points, so that identical chains of one group are adjacent.
pub(crate) fn sort(chains: &mut [OutlineChain]) {
    let key = |chain: &OutlineChain| {
        chain.points.iter().map(|p| (p.x.to_bits(), p.y.to_bits())).collect::<Vec<_>>()
    };
    chains.sort_by(|a, b| {
        let start = |chain: &OutlineChain| chain.points.first().copied().unwrap_or_default();
        let end = |chain: &OutlineChain| chain.points.last().copied().unwrap_or_default();
        order(start(a), start(b))
            .then_with(|| order(end(a), end(b)))
            .then_with(|| key(a).cmp(&key(b)))
            .then_with(|| a.group.cmp(&b.group))
    });
}

/// For each chain, the index of the first chain of the same group with identical points, which may be the
/// chain itself. Chains must be sorted.
pub(crate) fn first_copies(chains: &[OutlineChain]) -> Vec<usize> {
    let mut firsts: Vec<usize> = Vec::with_capacity(chains.len());
    for (index, chain) in chains.iter().enumerate() {
        let before = firsts.last().copied().filter(|first| {
            chains.get(*first).is_some_and(|other| {
                other.group == chain.group && other.closed == chain.closed && other.points == chain.points
            })
        });
        firsts.push(before.unwrap_or(index));
    }
    firsts
}

/// Subpaths of a path as polylines, each with a flag that is true if it is closed. With `closes`, open
/// subpaths are closed. `tolerance` is the maximum deviation, px.
pub(crate) fn flatten(path: &kurbo::BezPath, tolerance: f64, closes: bool) -> Vec<(Vec<Point>, bool)> {
    let mut found: Vec<(Vec<Point>, bool)> = Vec::new();
    let size = path.control_box().size();
    let tolerance = tolerance.max(size.width.max(size.height) * MIN_FLATTENING_OF_CURVE);
    kurbo::flatten(path.elements().iter().copied(), tolerance, |element| match element {
        PathEl::MoveTo(p) => found.push((vec![p], false)),
        PathEl::ClosePath => {
            if let Some((points, closed)) = found.last_mut() {
                points.extend(points.first().copied());
                *closed = true;
                // Segments after a close without a move start at the same point.
                let start = points.first().copied();
                found.extend(start.map(|start| (vec![start], false)));
            }
        }
        PathEl::LineTo(p) | PathEl::QuadTo(_, p) | PathEl::CurveTo(_, _, p) => {
            if let Some((points, _)) = found.last_mut() {
                points.push(p);
            }
        }
    });
    for (points, closed) in &mut found {
        points.dedup_by(|b, a| b == a && !*closed);
        if closes && !*closed && points.len() > 2 {
            points.extend(points.first().copied());
            *closed = true;
        }
        if *closed {
            points.dedup();
        }
        if points.len() == 1 && !closes {
            // A dot has two equal points.
            points.extend(points.first().copied());
        }
    }
    let mut is_after_close = false;
    found.retain(|(points, closed)| {
        let is_end_of_last = std::mem::replace(&mut is_after_close, *closed) && is_dot(points);
        points.len() > 1 && !is_end_of_last
    });
    found
}

fn is_dot(points: &[Point]) -> bool {
    points.iter().all(|p| Some(p) == points.first())
}

/// One end of a chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
struct OutlineChainEnd {
    chain: usize,
    last: bool,
}

impl OutlineChainEnd {
    /// The other end of the same chain.
    fn other(self) -> Self {
        Self { last: !self.last, ..self }
    }
}

/// Joins open chains of one group where exactly two ends meet within `max_gap` px.
fn join(chains: Vec<OutlineChain>, max_gap: f64) -> Vec<OutlineChain> {
    let cell = |p: Point| ((p.x / max_gap).floor() as i64, (p.y / max_gap).floor() as i64);
    let position = |end: OutlineChainEnd| {
        let points = &chains[end.chain].points;
        if end.last { points[points.len() - 1] } else { points[0] }
    };
    let is_dot: Vec<bool> = chains.iter().map(|chain| is_dot(&chain.points)).collect();
    let ends = || {
        let both_ends =
            |chain| [OutlineChainEnd { chain, last: false }, OutlineChainEnd { chain, last: true }];
        (0..chains.len()).filter(|chain| !is_dot[*chain]).flat_map(both_ends)
    };
    let mut cells: FxHashMap<(i64, i64), Vec<OutlineChainEnd>> = FxHashMap::default();
    for end in ends() {
        cells.entry(cell(position(end))).or_default().push(end);
    }
    let single_neighbour = |end: OutlineChainEnd| {
        let (x, y) = cell(position(end));
        let mut nearby_ends = (x - 1..=x + 1)
            .flat_map(|x| (y - 1..=y + 1).map(move |y| (x, y)))
            .filter_map(|cell| cells.get(&cell))
            .flatten()
            .filter(|nearby_end| {
                **nearby_end != end && position(**nearby_end).distance(position(end)) <= max_gap
            });
        let first = nearby_ends.next().copied();
        if nearby_ends.next().is_some() { None } else { first }
    };
    let mut partner_of_end: FxHashMap<OutlineChainEnd, OutlineChainEnd> = FxHashMap::default();
    for end in ends() {
        if let Some(partner) = single_neighbour(end).filter(|other| single_neighbour(*other) == Some(end)) {
            partner_of_end.insert(end, partner);
        }
    }
    let mut used = vec![false; chains.len()];
    let mut joined = Vec::new();
    // Start open chains at free ends; the remaining chains are closed.
    let starts = ends().filter(|end| !partner_of_end.contains_key(end)).chain(ends());
    for start in starts.collect::<Vec<_>>() {
        if used[start.chain] {
            continue;
        }
        let mut points: Vec<Point> = Vec::new();
        let mut shapes = Vec::new();
        let mut current_end = start;
        let closed = loop {
            used[current_end.chain] = true;
            let chain = &chains[current_end.chain];
            let points_in_order: Vec<Point> = match current_end.last {
                false => chain.points.clone(),
                true => chain.points.iter().rev().copied().collect(),
            };
            // Both ends of a joint become one point.
            points.extend(points_in_order.into_iter().skip(usize::from(!points.is_empty())));
            shapes.extend_from_slice(&chain.shapes);
            match partner_of_end.get(&current_end.other()) {
                Some(other) if *other == start => break true,
                Some(other) if !used[other.chain] => current_end = *other,
                _ => break false,
            }
        };
        if closed {
            let first = points[0];
            if let Some(last) = points.last_mut() {
                *last = first;
            }
        }
        joined.push(OutlineChain { group: chains[start.chain].group, points, closed, shapes });
    }
    joined.extend(chains.into_iter().zip(is_dot).filter(|(_, dot)| *dot).map(|(chain, _)| chain));
    joined
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(points: &[(f64, f64)]) -> OutlineChain {
        let points = points.iter().map(|p| Point::from(*p)).collect();
        OutlineChain { group: 0, points, closed: false, shapes: vec![0] }
    }

    #[test]
    fn join_connects_split_lines_where_two_ends_meet() {
        let split = vec![line(&[(5.0, 0.0), (9.0, 0.0)]), line(&[(5.0, 0.0), (0.0, 0.0)])];
        let joined: Vec<OutlineChain> = join(split, 0.01).into_iter().map(OutlineChain::canonical).collect();
        assert_eq!(joined, [line(&[(0.0, 0.0), (5.0, 0.0), (9.0, 0.0)])]);
        let star = vec![
            line(&[(0.0, 0.0), (1.0, 0.0)]),
            line(&[(0.0, 0.0), (0.0, 1.0)]),
            line(&[(0.0, 0.0), (-1.0, 0.0)]),
        ];
        assert_eq!(join(star, 0.01).len(), 3);
        let round = vec![line(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)]), line(&[(0.0, 0.0), (1.0, 1.0)])];
        let round = join(round, 0.01);
        assert!(round.len() == 1 && round[0].closed && round[0].points.len() == 4, "{round:?}");
    }

    #[test]
    fn flatten_returns_one_polyline_per_subpath_and_dot() {
        let path = kurbo::BezPath::from_svg("M0 0H4V4ZM9 9h0M1 1L2 2").unwrap();
        let found = flatten(&path, 0.01, false);
        let lengths: Vec<(usize, bool)> =
            found.iter().map(|(points, closed)| (points.len(), *closed)).collect();
        assert_eq!(lengths, [(4, true), (2, false), (2, false)]);
    }
}
