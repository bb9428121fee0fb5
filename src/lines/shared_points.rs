//! Lines that run through faces: pieces of them become segments that share their ends.
//!
//! Two faces compute the same point of their edge from the same numbers, so its bits name it.

use std::hash::BuildHasher;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use crate::parallel::prelude::*;
use glam::DVec3;
use rustc_hash::{FxBuildHasher, FxHashMap};

use super::{FeatureLines, FeatureSegment, LineKind};
use crate::mesh::Mesh;

/// Points are looked up in so many tables, side by side: which, their names say. A power of two.
const TABLES: u64 = 16;

/// What names a point: its bits.
type Name = [u64; 3];

fn name(p: DVec3) -> Name {
    p.to_array().map(f64::to_bits)
}

impl FeatureLines {
    /// Adds pieces of lines that run through faces, in runs of neighbours, and makes segments of them. Points are numbered in the order
    /// in which they first come.
    pub(crate) fn append_in_faces<P: Copy + Send + Sync>(
        &mut self,
        mesh: &Mesh,
        runs: &[Vec<P>],
        piece: impl Fn(P) -> (u32, LineKind, [DVec3; 2]) + Sync,
        segment: impl Fn(u32, LineKind, [u32; 2]) -> FeatureSegment + Sync,
    ) {
        // Most points are of one run alone, whose table is small: only what it knows no more of is looked up among all.
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

/// The numbers of all points of some runs, `first` that of the first new one; each is added to `points` once, where it first comes.
fn numbers(runs: &[Vec<DVec3>], first: u32, points: &mut Vec<DVec3>) -> Vec<Vec<u32>> {
    let table = |p: &DVec3| (FxBuildHasher.hash_one(name(*p)) >> 32) % TABLES;
    let tables: Vec<Vec<u8>> =
        runs.par_iter().with_max_len(1).map(|run| run.iter().map(|p| table(p) as u8).collect()).collect();
    let mut total = 0;
    let starts = runs.iter().map(|run| {
        total += run.len();
        total - run.len()
    });
    let starts: Vec<usize> = starts.collect();
    // Which of all points with the same name comes first.
    let earliest: Vec<AtomicU32> = (0..total as u32).map(AtomicU32::new).collect();
    (0..TABLES as u8).into_par_iter().with_max_len(1).for_each(|own| {
        let mut known: FxHashMap<Name, u32> = FxHashMap::default();
        known.reserve(total / TABLES as usize);
        for ((run, tables), start) in runs.iter().zip(&tables).zip(&starts) {
            for (k, p) in run.iter().enumerate().filter(|(k, _)| tables[*k] == own) {
                let at = (start + k) as u32;
                let before = *known.entry(name(*p)).or_insert(at);
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

/// The numbers of points that lines share, by their names.
#[derive(Default)]
pub(crate) struct PointIds(FxHashMap<Name, u32>);

impl PointIds {
    /// Those of some points, each of which has its own name and the number after that of the one before, from `first` on.
    pub fn new(points: &[DVec3], first: u32) -> Self {
        Self(points.iter().map(|p| name(*p)).zip(first..).collect())
    }

    /// The number of a point, which is added to `points` if it is new; the first of these has the number `first`.
    pub fn of(&mut self, points: &mut Vec<DVec3>, first: u32, p: DVec3) -> u32 {
        *self.0.entry(name(p)).or_insert_with(|| {
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
    fn points_are_numbered_as_they_come_whatever_table_they_are_in() {
        let mut dice = Dice::new(2);
        let some: Vec<DVec3> = (0..2000).map(|_| dice.point(1.0)).collect();
        let runs: Vec<Vec<DVec3>> = (0..40)
            .map(|run: usize| (0..run * 3).map(|k| some[(run * 37 + k * k * 11) % some.len()]).collect())
            .collect();
        let (mut points, mut plain) = (vec![DVec3::ZERO; 3], vec![DVec3::ZERO; 3]);
        let found = numbers(&runs, 100, &mut points);
        // One after the other, in one table.
        let mut ids = PointIds::default();
        let of_run =
            |run: &Vec<DVec3>| -> Vec<u32> { run.iter().map(|p| ids.of(&mut plain, 97, *p)).collect() };
        assert_eq!(found, runs.iter().map(of_run).collect::<Vec<_>>());
        assert!(points == plain && points.len() > 500 && points.len() < 3 + found.concat().len());
        // They go on where they are told to.
        let mut ids = PointIds::new(&points[3..], 100);
        assert_eq!(ids.of(&mut points, 97, runs[1][0]), found[1][0]);
        assert_eq!(ids.of(&mut points, 97, DVec3::ONE * 9.0), 97 + plain.len() as u32);
    }
}
