//! Shared points: pieces of lines inside faces become segments that share their end points.
//!
//! Two faces compute a point on their common edge from the same numbers, so the bits of its coordinates
//! identify it.

use std::hash::BuildHasher;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use crate::parallel::prelude::*;
use glam::DVec3;
use rustc_hash::{FxBuildHasher, FxHashMap};

use super::{FeatureLines, FeatureSegment, LineKind};
use crate::mesh::Mesh;

/// Number of hash tables that are filled in parallel; a power of two.
const TABLE_COUNT: u64 = 16;

/// Key of a point: the bits of its coordinates.
type PointKey = [u64; 3];

fn point_key(p: DVec3) -> PointKey {
    p.to_array().map(f64::to_bits)
}

impl FeatureLines {
    /// Adds pieces of lines inside faces, given in runs of neighbours, as segments. Points are numbered by
    /// first occurrence.
    pub(crate) fn append_in_faces<P: Copy + Send + Sync>(
        &mut self,
        mesh: &Mesh,
        runs: &[Vec<P>],
        piece: impl Fn(P) -> (u32, LineKind, [DVec3; 2]) + Sync,
        segment: impl Fn(u32, LineKind, [u32; 2]) -> FeatureSegment + Sync,
    ) {
        // Most points occur in one run only, and a run's table is small. Only points that are new in their
        // run are looked up globally.
        let own: Vec<(Vec<DVec3>, Vec<[u32; 2]>)> = runs
            .par_iter()
            .with_max_len(1)
            .map(|run| {
                let (mut points, mut known) = (Vec::new(), PointIds::default());
                let ends = run.iter().map(|p| piece(*p).2.map(|p| known.of(&mut points, 0, p))).collect();
                (points, ends)
            })
            .collect();
        let (points, ends): (Vec<Vec<DVec3>>, Vec<Vec<[u32; 2]>>) = own.into_iter().unzip();
        let first = mesh.positions.len() + self.points.len();
        let numbers = numbers(&points, first as u32, &mut self.points);
        let segments: Vec<Vec<FeatureSegment>> = runs
            .par_iter()
            .zip(&ends)
            .zip(&numbers)
            .with_max_len(1)
            .map(|((run, ends), numbers)| {
                let of_piece = |(p, ends): (&P, &[u32; 2])| {
                    let (face, kind, _) = piece(*p);
                    segment(face, kind, ends.map(|end| numbers[end as usize]))
                };
                run.iter().zip(ends).map(of_piece).collect()
            })
            .collect();
        self.segments.reserve(segments.iter().map(Vec::len).sum());
        segments.into_iter().for_each(|segments| self.segments.extend(segments));
    }
}

/// Global ids of the points of all runs, starting with `first`. Each distinct point is appended to `points`
/// once.
fn numbers(runs: &[Vec<DVec3>], first: u32, points: &mut Vec<DVec3>) -> Vec<Vec<u32>> {
    let table = |p: &DVec3| (FxBuildHasher.hash_one(point_key(*p)) >> 32) % TABLE_COUNT;
    let tables: Vec<Vec<u8>> =
        runs.par_iter().with_max_len(1).map(|run| run.iter().map(|p| table(p) as u8).collect()).collect();
    let mut total = 0;
    let starts = runs.iter().map(|run| {
        total += run.len();
        total - run.len()
    });
    let starts: Vec<usize> = starts.collect();
    // For each point the first one with the same key.
    let earliest: Vec<AtomicU32> = (0..total as u32).map(AtomicU32::new).collect();
    (0..TABLE_COUNT as u8).into_par_iter().with_max_len(1).for_each(|own| {
        let mut known: FxHashMap<PointKey, u32> = FxHashMap::default();
        known.reserve(total / TABLE_COUNT as usize);
        for ((run, tables), start) in runs.iter().zip(&tables).zip(&starts) {
            for (k, p) in run.iter().enumerate().filter(|(k, _)| tables[*k] == own) {
                let at = (start + k) as u32;
                let before = *known.entry(point_key(*p)).or_insert(at);
                if before < at {
                    earliest[at as usize].store(before, Relaxed);
                }
            }
        }
    });
    let mut numbers: Vec<u32> = Vec::with_capacity(total);
    let before = points.len() as u32;
    let is_first = |(earliest, at): &(&AtomicU32, u32)| earliest.load(Relaxed) == *at;
    points.reserve_exact(earliest.iter().zip(0..).filter(is_first).count());
    for p in runs.iter().flatten() {
        let earliest = earliest[numbers.len()].load(Relaxed) as usize;
        let number = numbers.get(earliest).copied().unwrap_or_else(|| {
            points.push(*p);
            first + points.len() as u32 - 1 - before
        });
        numbers.push(number);
    }
    runs.iter().zip(starts).map(|(run, start)| numbers[start..start + run.len()].to_vec()).collect()
}

/// Ids of shared points, by key.
#[derive(Default)]
pub(crate) struct PointIds(FxHashMap<PointKey, u32>);

impl PointIds {
    /// Ids of distinct points, numbered from `first` on.
    pub(crate) fn new(points: &[DVec3], first: u32) -> Self {
        Self(points.iter().map(|p| point_key(*p)).zip(first..).collect())
    }

    /// Id of a point, which is appended to `points` if new. `points[0]` has the id `first`.
    pub(crate) fn of(&mut self, points: &mut Vec<DVec3>, first: u32, p: DVec3) -> u32 {
        *self.0.entry(point_key(p)).or_insert_with(|| {
            points.push(p);
            first + points.len() as u32 - 1
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::dice::Dice;

    #[test]
    fn shared_point_numbers_match_a_sequential_table() {
        let mut dice = Dice::new(2);
        let some: Vec<DVec3> = (0..2000).map(|_| dice.point(1.0)).collect();
        let runs: Vec<Vec<DVec3>> = (0..40)
            .map(|run: usize| (0..run * 3).map(|k| some[(run * 37 + k * k * 11) % some.len()]).collect())
            .collect();
        let (mut points, mut plain) = (vec![DVec3::ZERO; 3], vec![DVec3::ZERO; 3]);
        let found = numbers(&runs, 100, &mut points);
        // Reference: one point after another, in one table.
        let mut ids = PointIds::default();
        let of_run =
            |run: &Vec<DVec3>| -> Vec<u32> { run.iter().map(|p| ids.of(&mut plain, 97, *p)).collect() };
        assert_eq!(found, runs.iter().map(of_run).collect::<Vec<_>>());
        assert!(points == plain && points.len() > 500 && points.len() < 3 + found.concat().len());
        // Numbering continues after the given points.
        let mut ids = PointIds::new(&points[3..], 100);
        assert_eq!(ids.of(&mut points, 97, runs[1][0]), found[1][0]);
        assert_eq!(ids.of(&mut points, 97, DVec3::ONE * 9.0), 97 + plain.len() as u32);
    }
}
