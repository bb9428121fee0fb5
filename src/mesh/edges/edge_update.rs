//! Update of an edge table after some faces got other corners.
//!
//! Edges of the other faces are copied, those of changed faces are built, and both are merged. The result
//! equals a new table.

use crate::mesh::Edges;

impl Edges {
    /// The edges of `triangles`, where the faces in `changed` (ascending) are changed or new. All other faces
    /// are those of this table.
    pub(crate) fn with_changed(&self, vertex_count: usize, triangles: &[[u32; 3]], changed: &[u32]) -> Self {
        let mut is_changed = vec![false; triangles.len()];
        changed.iter().for_each(|face| is_changed[*face as usize] = true);
        let corners: Vec<[u32; 3]> = changed.iter().map(|face| triangles[*face as usize]).collect();
        let own = Self::build(vertex_count, &corners);
        let number = |k: u32| changed[k as usize];
        // Whether a face runs along an edge from the smaller to the larger vertex.
        let up = |ends: &[u32; 2], face: u32| {
            let [a, b, c] = triangles[face as usize];
            [[a, b], [b, c], [c, a]].contains(ends)
        };
        let mut all = Self::default();
        all.vertices.reserve_exact(self.len() + own.len());
        all.faces.reserve_exact(self.len() + own.len());
        let mut faces = Vec::new();
        let mut next = 0;
        for (edge, ends) in self.vertices.iter().enumerate() {
            while own.vertices.get(next).is_some_and(|other| other < ends) {
                all.add(&own, next, number);
                next += 1;
            }
            let meets = own.vertices.get(next) == Some(ends);
            let before = self.faces(edge);
            if !meets && !before.list().iter().any(|face| is_changed[*face as usize]) {
                all.add(self, edge, |face| face);
                continue;
            }
            faces.clear();
            faces.extend(before.list().iter().filter(|face| !is_changed[**face as usize]));
            if meets {
                faces.extend(own.faces(next).list().iter().map(|k| number(*k)));
                next += 1;
            }
            if !faces.is_empty() {
                faces.sort_unstable();
                let same_way = matches!(faces[..], [a, b] if up(ends, a) == up(ends, b));
                all.push(*ends, &faces, same_way);
            }
        }
        (next..own.len()).for_each(|edge| all.add(&own, edge, number));
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::numbers::noise::hash;

    #[test]
    fn edges_with_changed_faces_equal_a_rebuild() {
        const VERTICES: u64 = 40;
        let number = |n: u64, below: u64| (hash(1, &[n]) % below) as u32;
        let face = |n: u64| {
            let a = number(3 * n, VERTICES);
            let b = (a + 1 + number(3 * n + 1, VERTICES - 2)) % VERTICES as u32;
            let c = (0..VERTICES as u32).map(|k| (b + 1 + k) % VERTICES as u32).find(|c| *c != a && *c != b);
            [a, b, c.unwrap_or(0)]
        };
        // From a few faces to enough that most edges have several.
        for (round, count) in [5, 20, 60, 300].into_iter().enumerate() {
            let before: Vec<[u32; 3]> = (0..count).map(|n| face(1000 * round as u64 + n)).collect();
            let edges = Edges::build(VERTICES as usize, &before);
            for every in [1, 2, 7, 1000] {
                let is_changed = |n: &usize| n % every == every - 1;
                let mut changed: Vec<u32> = (0..before.len()).filter(is_changed).map(|n| n as u32).collect();
                let mut triangles = before.clone();
                changed.iter().for_each(|n| triangles[*n as usize] = face(u64::from(*n) + 77_777));
                // Some faces are appended.
                triangles.extend((0..3).map(|n| face(n + 99_999)));
                changed.extend(before.len() as u32..triangles.len() as u32);
                let found = edges.with_changed(VERTICES as usize, &triangles, &changed);
                let anew = Edges::build(VERTICES as usize, &triangles);
                assert_eq!((&found.vertices, &found.faces), (&anew.vertices, &anew.faces));
                assert_eq!((&found.fans, &found.fan_starts), (&anew.fans, &anew.fan_starts));
            }
        }
    }
}
