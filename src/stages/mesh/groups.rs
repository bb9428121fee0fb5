//! [`Groups`]: which faces hang together, by whatever joins them.

/// Faces in groups, each known by the least face in it.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Groups {
    first: Vec<u32>,
}

impl Groups {
    /// The groups of `count` faces of which `joins` tells pairs.
    #[must_use]
    pub fn new(count: usize, joins: impl FnOnce(&mut dyn FnMut(u32, u32))) -> Self {
        let mut first: Vec<u32> = (0..count as u32).collect();
        joins(&mut |a, b| {
            let (a, b) = (root(&mut first, a), root(&mut first, b));
            first[a.max(b) as usize] = a.min(b);
        });
        // The least face of a group comes before all others, so that one pass is enough.
        for face in 0..count {
            first[face] = first[first[face] as usize];
        }
        Self { first }
    }

    /// The least face of the group that a face is in.
    #[inline]
    #[must_use]
    pub fn of(&self, face: u32) -> u32 {
        self.first[face as usize]
    }
}

/// The least face known of a group; the way there is halved for those who come after.
fn root(first: &mut [u32], mut face: u32) -> u32 {
    while first[face as usize] != face {
        let next = first[first[face as usize] as usize];
        first[face as usize] = next;
        face = next;
    }
    face
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_are_known_by_their_least_face_in_whatever_order_they_are_joined() {
        let pairs = [[5, 6], [1, 3], [6, 3], [2, 4]];
        for turn in 0..pairs.len() {
            let groups = Groups::new(8, |join| {
                for k in 0..pairs.len() {
                    let [a, b] = pairs[(k + turn) % pairs.len()];
                    join(b, a);
                }
            });
            assert_eq!(groups.first, [0, 1, 2, 1, 2, 1, 1, 7]);
        }
    }
}
