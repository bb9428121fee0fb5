//! Tests of the whole stage on random walks over a coarse grid.

use super::*;
use crate::chains::fit::douglas_peucker::simplify;
use crate::geometry::numbers::noise::hash;

/// Text form of everything that a set of chains draws, independent of order.
fn drawing_of(chains: &[Chain]) -> Vec<String> {
    let mut drawn: Vec<String> = chains
        .iter()
        .map(|c| {
            let lengths = length_of(&c.points, c.closed);
            let mut points: Vec<[i64; 2]> =
                c.points.iter().map(|p| [(p.x * 1e6) as i64, (p.y * 1e6) as i64]).collect();
            points.sort_unstable();
            format!("{:?} {} {:.6} {points:?}", c.kind, c.closed, lengths)
        })
        .collect();
    drawn.sort();
    drawn
}

/// Seeded random numbers.
struct Dice {
    seed: u64,
    thrown: u64,
}

impl Dice {
    fn word(&mut self) -> u64 {
        self.thrown += 1;
        hash(self.seed, &[self.thrown])
    }

    /// A random number in `0..count`.
    fn below(&mut self, count: u64) -> i32 {
        (self.word() % count) as i32
    }
}

/// Random walks on a coarse grid, with crossings, junctions, doubled edges and loops.
fn walks(dice: &mut Dice) -> Vec<Polyline> {
    (0..1 + dice.below(7))
        .map(|_| {
            let mut at = (dice.below(8), dice.below(8));
            let mut points = vec![(f64::from(at.0) * 7.0, f64::from(at.1) * 7.1)];
            for _ in 0..1 + dice.below(29) {
                at = ((at.0 + dice.below(5) - 2).rem_euclid(8), (at.1 + dice.below(5) - 2).rem_euclid(8));
                points.push((f64::from(at.0) * 7.0, f64::from(at.1) * 7.1));
            }
            points.dedup();
            let kind = dice.below(3) as usize;
            (points, LineKind::ALL[kind], kind == 0)
        })
        .collect()
}

/// Runs a check on 256 random drawings.
fn all(check: impl Fn(&mut Dice, &[Polyline])) {
    for seed in 0..256 {
        let mut dice = Dice { seed, thrown: 0 };
        let lines = walks(&mut dice);
        check(&mut dice, &lines);
    }
}

#[test]
fn with_all_off_no_length_is_lost() {
    all(|_, lines| {
        let map = map_of(lines);
        let whole: f64 = map
            .edges
            .iter()
            .map(|e| map.vertices[e.start.index()].position.distance(map.vertices[e.end.index()].position))
            .sum();
        let chains = linked(&map, &off(), Unit::Px);
        let drawn: f64 = chains.iter().map(|c| length_of(&c.points, c.closed)).sum();
        assert!((whole - drawn).abs() < 1e-6 * (1.0 + whole), "{whole} drawn as {drawn}: {lines:?}");
        for c in &chains {
            assert_eq!(c.points.len(), c.samples.len());
        }
    });
}

#[test]
fn the_sense_of_edges_changes_nothing() {
    all(|dice, lines| {
        let map = map_of(lines);
        let mut turned = map.clone();
        for edge in &mut turned.edges {
            if dice.below(2) == 0 {
                std::mem::swap(&mut edge.start, &mut edge.end);
            }
        }
        assert_eq!(linked(&map, &off(), Unit::Px), linked(&turned, &off(), Unit::Px), "{lines:?}");
    });
}

#[test]
fn the_order_of_edges_and_vertices_changes_nothing() {
    all(|dice, lines| {
        let map = map_of(lines);
        let mut order: Vec<usize> = (0..map.vertices.len()).collect();
        order.sort_by_cached_key(|i| (dice.word(), *i));
        let mut place = vec![0; order.len()];
        order.iter().enumerate().for_each(|(to, from)| place[*from] = to as u32);
        let mut shuffled =
            ViewMap { vertices: order.iter().map(|i| map.vertices[*i]).collect(), ..map.clone() };
        for edge in &mut shuffled.edges {
            edge.start = ViewVertexId(place[edge.start.index()]);
            edge.end = ViewVertexId(place[edge.end.index()]);
        }
        let mut turn: Vec<usize> = (0..map.edges.len()).collect();
        turn.sort_by_cached_key(|i| (dice.word(), *i));
        shuffled.edges = turn.iter().map(|i| shuffled.edges[*i]).collect();
        let [one, other] = [&map, &shuffled].map(|map| drawing_of(&linked(map, &off(), Unit::Px)));
        assert_eq!(one, other, "{lines:?}");
    });
}

#[test]
fn simplifying_twice_is_simplifying_once() {
    all(|dice, lines| {
        let tolerance = 0.1 + f64::from(dice.below(90)) / 10.0;
        for (points, ..) in lines {
            let mut line = SampledLine::default();
            points
                .iter()
                .for_each(|(x, y)| line.push(Point::new(*x, *y), Sample::new(1.0, 1.0), true, false));
            let once = simplify(&line, tolerance);
            assert_eq!(simplify(&once, tolerance), once, "{tolerance} {points:?}");
        }
    });
}

#[test]
fn any_graph_gives_finite_chains() {
    all(|_, lines| {
        for chain in linked(&map_of(lines), &ChainOptions::default(), Unit::Px) {
            assert!(chain.points.len() > 1 && chain.path.is_finite(), "{lines:?}");
        }
    });
}
