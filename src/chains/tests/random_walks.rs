//! Tests of the whole stage on random walks over a coarse grid.

use super::*;
use crate::chains::fit::line_simplification::simplify;
use crate::geometry::numbers::noise::hash;

/// Text form of everything that a set of chains draws, independent of order.
fn sorted_chain_texts(chains: &[Chain]) -> Vec<String> {
    let mut drawn: Vec<String> = chains
        .iter()
        .map(|c| {
            let lengths = polyline_length(&c.points, c.closed);
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
struct RandomNumbers {
    seed: u64,
    thrown: u64,
}

impl RandomNumbers {
    fn next_u64(&mut self) -> u64 {
        self.thrown += 1;
        hash(self.seed, &[self.thrown])
    }

    /// A random number in `0..count`.
    fn below(&mut self, count: u64) -> i32 {
        (self.next_u64() % count) as i32
    }
}

/// Random walks on a coarse grid, with crossings, junctions, doubled edges and loops.
fn random_polylines(dice: &mut RandomNumbers) -> Vec<Polyline> {
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
fn for_each_random_drawing(check: impl Fn(&mut RandomNumbers, &[Polyline])) {
    for seed in 0..256 {
        let mut dice = RandomNumbers { seed, thrown: 0 };
        let lines = random_polylines(&mut dice);
        check(&mut dice, &lines);
    }
}

#[test]
fn with_all_off_no_length_is_lost() {
    for_each_random_drawing(|_, lines| {
        let map = view_map_of(lines);
        let whole: f64 = map
            .edges
            .iter()
            .map(|e| map.vertices[e.start.index()].position.distance(map.vertices[e.end.index()].position))
            .sum();
        let chains = link_with_hidden_lines(&map, &all_options_off(), Unit::Px);
        let drawn: f64 = chains.iter().map(|c| polyline_length(&c.points, c.closed)).sum();
        assert!((whole - drawn).abs() < 1e-6 * (1.0 + whole), "{whole} drawn as {drawn}: {lines:?}");
        for c in &chains {
            assert_eq!(c.points.len(), c.samples.len());
        }
    });
}

#[test]
fn edge_direction_does_not_change_the_chains() {
    for_each_random_drawing(|dice, lines| {
        let map = view_map_of(lines);
        let mut turned = map.clone();
        for edge in &mut turned.edges {
            if dice.below(2) == 0 {
                std::mem::swap(&mut edge.start, &mut edge.end);
            }
        }
        assert_eq!(
            link_with_hidden_lines(&map, &all_options_off(), Unit::Px),
            link_with_hidden_lines(&turned, &all_options_off(), Unit::Px),
            "{lines:?}"
        );
    });
}

#[test]
fn edge_and_vertex_order_does_not_change_the_chains() {
    for_each_random_drawing(|dice, lines| {
        let map = view_map_of(lines);
        let mut order: Vec<usize> = (0..map.vertices.len()).collect();
        order.sort_by_cached_key(|i| (dice.next_u64(), *i));
        let mut place = vec![0; order.len()];
        order.iter().enumerate().for_each(|(to, from)| place[*from] = to as u32);
        let mut shuffled =
            ViewMap { vertices: order.iter().map(|i| map.vertices[*i]).collect(), ..map.clone() };
        for edge in &mut shuffled.edges {
            edge.start = ViewVertexId(place[edge.start.index()]);
            edge.end = ViewVertexId(place[edge.end.index()]);
        }
        let mut turn: Vec<usize> = (0..map.edges.len()).collect();
        turn.sort_by_cached_key(|i| (dice.next_u64(), *i));
        shuffled.edges = turn.iter().map(|i| shuffled.edges[*i]).collect();
        let [one, other] = [&map, &shuffled]
            .map(|map| sorted_chain_texts(&link_with_hidden_lines(map, &all_options_off(), Unit::Px)));
        assert_eq!(one, other, "{lines:?}");
    });
}

#[test]
fn simplify_is_idempotent() {
    for_each_random_drawing(|dice, lines| {
        let tolerance = 0.1 + f64::from(dice.below(90)) / 10.0;
        for (points, ..) in lines {
            let mut line = SampledLine::default();
            points.iter().for_each(|(x, y)| {
                line.push(Point::new(*x, *y), Sample::new(1.0, 1.0), LineSide::soft(true))
            });
            let once = simplify(&line, tolerance);
            assert_eq!(simplify(&once, tolerance), once, "{tolerance} {points:?}");
        }
    });
}

#[test]
fn random_view_maps_give_finite_chains() {
    for_each_random_drawing(|_, lines| {
        for chain in link_with_hidden_lines(&view_map_of(lines), &ChainOptions::default(), Unit::Px) {
            assert!(chain.points.len() > 1 && chain.path.is_finite(), "{lines:?}");
        }
    });
}
