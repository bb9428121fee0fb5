//! [`Edges`]: edges of a mesh and the faces at each edge, by counting sort on the smaller vertex.
//!
//! Each task handles a block of vertices and the edges whose smaller vertex is in it. The result does not
//! depend on the number of threads.

use crate::parallel::prelude::*;

use super::vertex_ranges::{VertexRange, range_count, vertex_ranges};
use crate::parallel::task_size::MIN_TASK_ITEMS;

pub(crate) const NO_FACE: u32 = u32::MAX;
pub(crate) const NON_MANIFOLD: u32 = u32::MAX - 1;
pub(crate) const PARALLEL_FLAG: u32 = 1 << 31;

/// Faces that meet at an edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EdgeFaces<'a> {
    /// A border.
    One(u32),
    /// Two faces, as almost everywhere.
    Two {
        /// The two faces, the one earlier in the mesh first.
        faces: [u32; 2],
        /// Whether both run along the edge in the same direction, which does not occur on a consistently
        /// wound surface.
        same_way: bool,
    },
    /// A non-manifold edge: three or more faces, in mesh order.
    Many(&'a [u32]),
}

impl<'a> EdgeFaces<'a> {
    /// The faces in mesh order.
    pub fn each(self) -> impl Iterator<Item = u32> + use<'a> {
        let (few, many): ([Option<u32>; 2], &[u32]) = match self {
            Self::One(face) => ([Some(face), None], &[]),
            Self::Two { faces, .. } => (faces.map(Some), &[]),
            Self::Many(faces) => ([None; 2], faces),
        };
        few.into_iter().flatten().chain(many.iter().copied())
    }

    /// The face across an edge from one of its faces, if it has two consistently wound faces.
    #[inline]
    pub(crate) fn across(&self, face: u32) -> Option<u32> {
        match self {
            Self::Two { faces, same_way: false } => Some(faces[usize::from(faces[0] == face)]),
            _ => None,
        }
    }

    /// The faces in mesh order, as a slice.
    #[must_use]
    pub fn list(&self) -> &[u32] {
        match self {
            Self::One(face) => std::slice::from_ref(face),
            Self::Two { faces, .. } => faces,
            Self::Many(faces) => faces,
        }
    }
}

/// All edges of a mesh, sorted by smaller and then by larger vertex.
#[derive(Debug, Clone, Default)]
pub struct Edges {
    /// The two vertices of each edge, the smaller id first.
    pub vertices: Vec<[u32; 2]>,
    pub(crate) faces: Vec<[u32; 2]>,
    pub(crate) fans: Vec<u32>,
    pub(crate) fan_starts: Vec<u32>,
    /// Ids of edges near which duplicate faces may occur.
    pub(crate) suspects: Vec<u32>,
}

/// Maximum number of vertices per block, so that their sides fit in the cache.
const MAX_VERTICES_PER_BLOCK: usize = 1 << 14;

/// Side of a triangle, seen from its smaller vertex.
#[derive(Clone, Copy)]
struct TriangleSide {
    larger_vertex: u32,
    /// Face id shifted left by one; bit 0 is set if the face runs from the smaller vertex to the larger.
    face_way: u32,
}

impl Edges {
    /// Finds the edges of `triangles`, whose vertex ids are below `vertex_count`.
    #[must_use]
    pub fn build(vertex_count: usize, triangles: &[[u32; 3]]) -> Self {
        let shares =
            vertex_ranges(vertex_count, triangles, range_count(vertex_count, MAX_VERTICES_PER_BLOCK));
        Self::joined(
            shares.par_iter().with_max_len(1).map(|share| edges_of_share(triangles, share)).collect(),
        )
    }

    /// Concatenates several tables.
    pub(crate) fn joined(mut parts: Vec<Self>) -> Self {
        if let [only] = parts.as_mut_slice() {
            return std::mem::take(only);
        }
        let total = parts.iter().map(Self::len).sum();
        let mut all = Self { vertices: vec![[0; 2]; total], faces: vec![[0; 2]; total], ..Self::default() };
        let (mut vertices, mut faces) = (all.vertices.as_mut_slice(), all.faces.as_mut_slice());
        let mut copies = Vec::with_capacity(parts.len());
        let mut edge = 0;
        for part in parts {
            let (fan, entry) = (all.fan_starts.len() as u32, all.fans.len() as u32);
            all.fans.extend(&part.fans);
            all.fan_starts.extend(part.fan_starts.iter().map(|s| s + entry));
            all.suspects.extend(part.suspects.iter().map(|e| e + edge));
            edge += part.vertices.len() as u32;
            let (own_vertices, own_faces);
            (own_vertices, vertices) = vertices.split_at_mut(part.vertices.len());
            (own_faces, faces) = faces.split_at_mut(part.faces.len());
            copies.push((own_vertices, own_faces, part, fan));
        }
        copies.into_par_iter().with_max_len(1).for_each(|(vertices, faces, part, fan)| {
            vertices.copy_from_slice(&part.vertices);
            faces.copy_from_slice(&part.faces);
            if fan > 0 {
                faces.iter_mut().filter(|f| f[0] == NON_MANIFOLD).for_each(|f| f[1] += fan);
            }
        });
        all
    }

    /// Number of edges.
    #[must_use]
    pub fn len(&self) -> usize {
        self.vertices.len()
    }

    /// Whether there are no edges.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.vertices.is_empty()
    }

    /// The edge between two vertices.
    pub(crate) fn between(&self, a: u32, b: u32) -> Option<usize> {
        self.vertices.binary_search(&[a.min(b), a.max(b)]).ok()
    }

    /// The faces that meet at edge `edge`.
    #[inline]
    #[must_use]
    pub fn faces(&self, edge: usize) -> EdgeFaces<'_> {
        match self.faces[edge] {
            [NON_MANIFOLD, fan] => {
                let fan = fan as usize;
                let start = self.fan_starts[fan] as usize;
                let end = self.fan_starts.get(fan + 1).map_or(self.fans.len(), |e| *e as usize);
                EdgeFaces::Many(&self.fans[start..end])
            }
            [face, NO_FACE] => EdgeFaces::One(face),
            [first, second] => EdgeFaces::Two {
                faces: [first, second & !PARALLEL_FLAG],
                same_way: second & PARALLEL_FLAG != 0,
            },
        }
    }

    /// Updates the direction flags after some faces were turned.
    pub(crate) fn turn(&mut self, turned: &[bool]) {
        let is_turned = |face: u32| turned.get(face as usize).copied().unwrap_or_default();
        self.faces.par_iter_mut().with_min_len(MIN_TASK_ITEMS).for_each(|[first, second]| {
            let has_two = *first != NON_MANIFOLD && *second != NO_FACE;
            if has_two && is_turned(*first) != is_turned(*second & !PARALLEL_FLAG) {
                *second ^= PARALLEL_FLAG;
            }
        });
    }

    /// Number of edges with one face.
    #[must_use]
    pub fn border_count(&self) -> usize {
        self.faces.iter().filter(|f| f[1] == NO_FACE && f[0] != NON_MANIFOLD).count()
    }

    /// Number of edges with three faces or more.
    #[must_use]
    pub fn non_manifold_count(&self) -> usize {
        self.fan_starts.len()
    }
}

fn edges_of_share(triangles: &[[u32; 3]], share: &VertexRange) -> Edges {
    let (first, span) = (share.vertices.start as u32, share.vertices.len());
    let mut starts = vec![0u32; span + 1];
    for &[a, b, c] in share.faces.iter().flat_map(|run| &triangles[run.clone()]) {
        for smaller in [a.min(b), b.min(c), c.min(a)] {
            let bucket = smaller.wrapping_sub(first) as usize;
            if bucket < span {
                starts[bucket] += 1;
            }
        }
    }
    let mut total = 0;
    for start in &mut starts {
        total += *start;
        *start = total;
    }
    // Filled from the back, so that `starts` moves from the ends of the buckets to their beginnings.
    let mut sides = vec![TriangleSide { larger_vertex: 0, face_way: 0 }; total as usize];
    for run in share.faces.iter().rev() {
        for (face, &[a, b, c]) in run.clone().zip(&triangles[run.clone()]).rev() {
            for (a, b) in [(c, a), (b, c), (a, b)] {
                let bucket = a.min(b).wrapping_sub(first) as usize;
                if bucket < span {
                    starts[bucket] -= 1;
                    sides[starts[bucket] as usize] = TriangleSide {
                        larger_vertex: a.max(b),
                        face_way: (face as u32) << 1 | u32::from(a < b),
                    };
                }
            }
        }
    }
    let mut own = Edges::default();
    own.vertices.reserve_exact(sides.len() / 2 + span / 64 + 1);
    own.faces.reserve_exact(sides.len() / 2 + span / 64 + 1);
    for bucket in 0..span {
        let bucket_sides = &mut sides[starts[bucket] as usize..starts[bucket + 1] as usize];
        own.push_bucket(first + bucket as u32, bucket_sides);
    }
    own
}

/// Stable sort. Buckets have about six sides, but the hub of a fan may have thousands.
fn sort_by_other(sides: &mut [TriangleSide]) {
    if sides.len() > 24 {
        sides.sort_by_key(|s| s.larger_vertex);
        return;
    }
    for i in 1..sides.len() {
        let side = sides[i];
        let mut k = i;
        while k > 0 && sides[k - 1].larger_vertex > side.larger_vertex {
            sides[k] = sides[k - 1];
            k -= 1;
        }
        sides[k] = side;
    }
}

impl Edges {
    /// Adds the edges from `vertex` to its larger neighbours.
    fn push_bucket(&mut self, vertex: u32, sides: &mut [TriangleSide]) {
        sort_by_other(sides);
        let first_edge = self.vertices.len();
        let first_fan = self.fan_starts.len();
        let mut i = 0;
        while i < sides.len() {
            let one = sides[i];
            let mut end = i + 1;
            while end < sides.len() && sides[end].larger_vertex == one.larger_vertex {
                end += 1;
            }
            self.vertices.push([vertex, one.larger_vertex]);
            self.faces.push(match end - i {
                1 => [one.face_way >> 1, NO_FACE],
                2 => {
                    let two = sides[i + 1].face_way;
                    let same_way = if (one.face_way ^ two) & 1 == 0 { PARALLEL_FLAG } else { 0 };
                    [one.face_way >> 1, two >> 1 | same_way]
                }
                _ => {
                    self.fan_starts.push(self.fans.len() as u32);
                    self.fans.extend(sides[i..end].iter().map(|s| s.face_way >> 1));
                    [NON_MANIFOLD, self.fan_starts.len() as u32 - 1]
                }
            });
            i = end;
        }
        // Two faces with the same three corners share both edges at their smallest corner.
        let fresh = &self.faces[first_edge..];
        let twins = (1..fresh.len()).any(|k| {
            let pair = |f: &[u32; 2]| (f[0], f[1] & !PARALLEL_FLAG);
            fresh[k][1] != NO_FACE && fresh[..k].iter().any(|f| pair(f) == pair(&fresh[k]))
        });
        if twins || self.fan_starts.len() > first_fan {
            self.suspects.extend((first_edge..self.faces.len()).map(|e| e as u32));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tetrahedron_has_six_edges_of_two_faces() {
        let edges = Edges::build(4, &[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]);
        assert_eq!(edges.len(), 6);
        assert_eq!(edges.border_count() + edges.non_manifold_count(), 0);
        assert!((0..6).all(|e| matches!(edges.faces(e), EdgeFaces::Two { same_way: false, .. })));
    }

    #[test]
    fn edges_distinguish_borders_fins_and_flipped_neighbours() {
        // Two triangles with opposite windings at 0-1, then a fin there.
        let edges = Edges::build(5, &[[0, 1, 2], [0, 1, 3]]);
        assert_eq!(edges.faces(0), EdgeFaces::Two { faces: [0, 1], same_way: true });
        assert_eq!(edges.border_count(), 4);
        let edges = Edges::build(5, &[[0, 1, 2], [1, 0, 3], [0, 1, 4]]);
        assert_eq!(edges.faces(0), EdgeFaces::Many(&[0, 1, 2]));
        assert!(edges.suspects.iter().all(|e| *e < 4));
        let edges = Edges::build(5, &[[0, 1, 2], [2, 1, 0]]);
        assert_eq!(edges.suspects, [0, 1]);
    }

    #[test]
    fn edges_do_not_depend_on_the_number_of_threads_or_blocks() {
        let n = 300u32;
        let mut triangles = Vec::new();
        for y in 0..n {
            for x in 0..n {
                let a = y * (n + 1) + x;
                triangles.push([a, a + 1, a + n + 1]);
                triangles.push([a + 1, a + n + 2, a + n + 1]);
            }
        }
        let run = |threads| {
            let pool = rayon_core::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            pool.install(|| Edges::build(((n + 1) * (n + 1)) as usize, &triangles))
        };
        let (one, three) = (run(1), run(3));
        assert_eq!(one.vertices, three.vertices);
        assert_eq!(one.faces, three.faces);
        let whole = edges_of_share(&triangles, &vertex_ranges(90_601, &triangles, 1)[0]);
        assert!(one.border_count() == 4 * n as usize && 90_601 > 5 * MAX_VERTICES_PER_BLOCK);
        assert_eq!((one.vertices, one.faces), (whole.vertices, whole.faces));
    }
}
