//! [`ParityUnionFind`]: union-find over faces that also stores which faces must be turned to agree.

/// Union-find over faces with parity: whether a face must be turned to match the root of its set.
pub(crate) struct ParityUnionFind {
    /// Parent of each face, and whether their windings disagree.
    above: Vec<(u32, bool)>,
}

impl ParityUnionFind {
    /// One set per face.
    pub(crate) fn new(count: usize) -> Self {
        Self { above: (0..count as u32).map(|face| (face, false)).collect() }
    }

    /// Root of a face, and whether their windings disagree.
    pub(crate) fn root(&mut self, face: u32) -> (u32, bool) {
        let (mut at, mut disagree) = (face, false);
        while self.above[at as usize].0 != at {
            let (next, odd) = self.above[at as usize];
            let (after, more) = self.above[next as usize];
            // Path halving.
            self.above[at as usize] = (after, odd ^ more);
            disagree ^= odd ^ more;
            at = after;
        }
        (at, disagree)
    }

    /// Joins two faces. Returns false if the new relation contradicts the known one.
    pub(crate) fn join(&mut self, a: u32, b: u32, disagree: bool) -> bool {
        let ((a, odd_a), (b, odd_b)) = (self.root(a), self.root(b));
        let odd = odd_a ^ odd_b ^ disagree;
        if a != b {
            self.above[a.max(b) as usize] = (a.min(b), odd);
            return true;
        }
        !odd
    }
}
