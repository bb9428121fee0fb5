//! [`PointFaces`]: the faces around each point, in lists that can be merged when a point collapses onto another.

/// Faces around each point. All lists share one pool: a list grows in place or moves to the end of the pool.
#[derive(Debug, Clone)]
pub(crate) struct PointFaces {
    pool: Vec<u32>,
    lists: Vec<List>,
}

#[derive(Debug, Clone, Copy, Default)]
struct List {
    start: u32,
    len: u32,
    /// Capacity of the list before it must move.
    room: u32,
}

impl PointFaces {
    /// Builds the lists of `count` points, in face order, without the faces for which `left` holds.
    pub(crate) fn new(count: usize, corners: &[[u32; 3]], left: impl Fn(usize) -> bool) -> Self {
        let mut lists = vec![List::default(); count];
        let faces = || corners.iter().enumerate().filter(|(face, _)| !left(*face));
        for (_, corners) in faces() {
            corners.iter().for_each(|point| lists[*point as usize].room += 1);
        }
        let mut start = 0;
        for list in &mut lists {
            list.start = start;
            start += list.room;
        }
        let mut pool = vec![0; start as usize];
        for (face, corners) in faces() {
            for point in corners {
                let list = &mut lists[*point as usize];
                pool[(list.start + list.len) as usize] = face as u32;
                list.len += 1;
            }
        }
        Self { pool, lists }
    }

    /// Number of points.
    pub(crate) fn len(&self) -> usize {
        self.lists.len()
    }

    /// Faces around a point; may contain removed faces.
    #[inline]
    pub(crate) fn about(&self, point: u32) -> &[u32] {
        let List { start, len, .. } = self.lists[point as usize];
        &self.pool[start as usize..(start + len) as usize]
    }

    /// Moves the faces of `from` for which `moves` holds to `to`, and drops faces of `to` that are not
    /// `alive`.
    pub(crate) fn merge(
        &mut self,
        from: u32,
        to: u32,
        moves: impl Fn(u32) -> bool,
        alive: impl Fn(u32) -> bool,
    ) {
        let source = std::mem::take(&mut self.lists[from as usize]);
        let mut list = self.lists[to as usize];
        let mut kept = list.start;
        for at in list.start..list.start + list.len {
            let face = self.pool[at as usize];
            if alive(face) {
                self.pool[kept as usize] = face;
                kept += 1;
            }
        }
        list.len = kept - list.start;
        let moved = |pool: &[u32], at: u32| Some(pool[at as usize]).filter(|face| moves(*face));
        let range = source.start..source.start + source.len;
        let more = range.clone().filter(|at| moved(&self.pool, *at).is_some()).count() as u32;
        if list.len + more > list.room {
            let start = self.pool.len() as u32;
            self.pool.extend_from_within(list.start as usize..kept as usize);
            list.start = start;
            // Grow by half, so that merging many small lists into a large one does not move it each time.
            list.room = (list.len + more).max(list.len + list.len / 2);
            self.pool.resize((start + list.room) as usize, 0);
        }
        for at in range {
            if let Some(face) = moved(&self.pool, at) {
                self.pool[(list.start + list.len) as usize] = face;
                list.len += 1;
            }
        }
        self.lists[to as usize] = list;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn point_faces_merge_lists_and_drop_removed_faces() {
        let corners = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [1, 2, 3]];
        let mut fans = PointFaces::new(5, &corners, |face| face == 3);
        assert_eq!((fans.about(0), fans.about(1), fans.about(2)), (&[0, 1, 2][..], &[0][..], &[0, 1][..]));
        // Point 0 collapses onto point 4, and the face between them is removed.
        fans.merge(0, 4, |face| face != 2, |face| face != 2);
        assert_eq!((fans.about(4), fans.about(0)), (&[0, 1][..], &[][..]));
        fans.merge(2, 4, |_| false, |face| face != 0);
        assert_eq!(fans.about(4), [1]);
        assert_eq!(fans.len(), 5);
    }
}
