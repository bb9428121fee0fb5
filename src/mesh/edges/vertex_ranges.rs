//! [`vertex_ranges`]: blocks of vertices, one per task, with the faces that touch each block.

use std::ops::Range;

use crate::parallel::prelude::*;

use crate::parallel::task_size::MIN_TASK_ITEMS;

/// Number of faces per task.
const FACES_PER_TASK: usize = 1 << 12;

/// Block of vertices.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct VertexRange {
    /// Its vertices.
    pub vertices: Range<usize>,
    /// Runs of the faces with a corner in the block, ascending.
    pub faces: Vec<Range<usize>>,
}

/// Number of blocks of at most `size` vertices. A multiple of the number of threads, so that all have equal
/// work.
pub(crate) fn range_count(vertices: usize, size: usize) -> usize {
    if vertices <= size.min(MIN_TASK_ITEMS) {
        return vertices.min(1);
    }
    vertices.div_ceil(size).next_multiple_of(rayon_core::current_num_threads())
}

/// Divides vertices into `workers` blocks. Vertices and faces mostly have the same order, so the faces of a
/// block form few runs.
pub(crate) fn vertex_ranges(vertex_count: usize, triangles: &[[u32; 3]], workers: usize) -> Vec<VertexRange> {
    let workers = workers.max(1);
    let bound = |k: usize| vertex_count * k / workers;
    // Bounds are rounded down, so the vertex may already be in the next block.
    let whose = |v: usize| {
        let worker = v * workers / vertex_count;
        if bound(worker + 1) <= v { worker + 1 } else { worker }
    };
    if workers == 1 {
        return vec![VertexRange {
            vertices: 0..vertex_count,
            faces: std::iter::once(0..triangles.len()).collect(),
        }];
    }
    let found: Vec<Vec<Vec<Range<usize>>>> = triangles
        .par_chunks(FACES_PER_TASK)
        .enumerate()
        .map(|(chunk, triangles)| runs(chunk * FACES_PER_TASK, triangles, workers, (bound, whose)))
        .collect();
    let mut all: Vec<VertexRange> = (0..workers)
        .map(|worker| VertexRange { vertices: bound(worker)..bound(worker + 1), faces: Vec::new() })
        .collect();
    for (share, runs) in found.into_iter().flat_map(|runs| (0..).zip(runs)) {
        let faces: &mut Vec<Range<usize>> = &mut all[share].faces;
        for run in runs {
            match faces.last_mut() {
                Some(last) if last.end == run.start => last.end = run.end,
                _ => faces.push(run),
            }
        }
    }
    all
}

/// Runs of some faces, numbered from `first`, for each block. `bound` is the first vertex of a block, and
/// `whose` the block of a vertex.
fn runs(
    first: usize,
    triangles: &[[u32; 3]],
    workers: usize,
    (bound, whose): (impl Fn(usize) -> usize, impl Fn(usize) -> usize),
) -> Vec<Vec<Range<usize>>> {
    let mut runs = vec![Vec::new(); workers];
    // The current run of faces lies within one block.
    let (mut own, mut worker, mut start) = (0..0, 0, first);
    let mut add = |worker: usize, run: Range<usize>| {
        if run.is_empty() {
            return;
        }
        let runs: &mut Vec<Range<usize>> = &mut runs[worker];
        match runs.last_mut() {
            Some(last) if last.end == run.start => last.end = run.end,
            _ => runs.push(run),
        }
    };
    for (face, corners) in (first..).zip(triangles) {
        let corners = corners.map(|v| v as usize);
        if corners.iter().all(|v| own.contains(v)) {
            continue;
        }
        add(worker, start..face);
        start = face;
        let [a, b, c] = corners.map(&whose);
        if a == b && b == c {
            (own, worker) = (bound(a)..bound(a + 1), a);
            continue;
        }
        add(a, face..face + 1);
        if b != a {
            add(b, face..face + 1);
        }
        if c != a && c != b {
            add(c, face..face + 1);
        }
        start = face + 1;
    }
    add(worker, start..first + triangles.len());
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_vertex_range_lists_exactly_the_faces_that_touch_it() {
        let faces: Vec<[u32; 3]> = (0..40_000_u32)
            .map(|k| {
                let near = k / 2 % 9_990;
                if k % 97 == 0 { [near, (k * 31) % 9_998, 9_999] } else { [near, near + 1, near + 9] }
            })
            .collect();
        for workers in [1, 2, 3, 8, 317] {
            let shares = vertex_ranges(10_000, &faces, workers);
            assert_eq!(shares.len(), workers);
            for share in shares {
                let listed: Vec<usize> = share.faces.iter().flat_map(Clone::clone).collect();
                let touches = |face: &[u32; 3]| face.iter().any(|v| share.vertices.contains(&(*v as usize)));
                let expected: Vec<usize> = (0..faces.len()).filter(|face| touches(&faces[*face])).collect();
                assert_eq!(listed, expected);
            }
        }
    }

    #[test]
    fn range_count_of_large_meshes_is_a_multiple_of_the_threads() {
        for threads in [1, 2, 3, 16] {
            let pool = rayon_core::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            let count = |vertices: usize| pool.install(|| range_count(vertices, 100));
            assert_eq!([0, 1, 100].map(count), [0, 1, 1]);
            assert!([101, 299, 12_345].map(count).iter().all(|count| count.is_multiple_of(threads)));
            assert!(count(12_345) >= 124);
        }
    }
}
