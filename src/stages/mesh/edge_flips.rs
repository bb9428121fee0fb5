//! The edges of a mesh in which pairs of faces meet along their other diagonal: those of before, but for a few.

use super::Edges;
use super::edges::{MANY, NONE, SAME_WAY};

/// A diagonal that two faces give up for another one, and the sides that go from one of them to the other.
pub(super) struct EdgeFlip {
    /// The vertices of the old and of the new diagonal, smaller first.
    pub gone: [u32; 2],
    pub made: [u32; 2],
    /// The two faces.
    pub faces: [u32; 2],
    /// Sides, smaller vertex first, and the faces that each leaves and goes to.
    pub moved: [([u32; 2], u32, u32); 2],
}

impl Edges {
    /// Flips diagonals of faces no two of which are beside each other; no new one is an edge already.
    pub(super) fn flip(&mut self, flips: &[EdgeFlip]) {
        for (side, from, to) in flips.iter().flat_map(|flip| flip.moved) {
            if let Ok(edge) = self.vertices.binary_search(&side) {
                self.hand_over(edge, from, to);
            }
        }
        let mut gone: Vec<[u32; 2]> = flips.iter().map(|flip| flip.gone).collect();
        let mut made: Vec<([u32; 2], [u32; 2])> = flips.iter().map(|flip| (flip.made, flip.faces)).collect();
        gone.sort_unstable();
        made.sort_unstable();
        let (mut gone, mut made) = (gone.into_iter().peekable(), made.into_iter().peekable());
        let mut vertices = Vec::with_capacity(self.vertices.len());
        let mut faces = Vec::with_capacity(self.faces.len());
        for (ends, beside) in self.vertices.iter().zip(&self.faces) {
            while let Some((new, [a, b])) = made.next_if(|(new, _)| new < ends) {
                vertices.push(new);
                faces.push([a.min(b), a.max(b)]);
            }
            if gone.next_if_eq(ends).is_none() {
                vertices.push(*ends);
                faces.push(*beside);
            }
        }
        for (new, [a, b]) in made {
            vertices.push(new);
            faces.push([a.min(b), a.max(b)]);
        }
        (self.vertices, self.faces) = (vertices, faces);
        // They are numbers of edges as they were.
        self.suspects.clear();
    }

    /// Gives the place of one face at an edge to another.
    fn hand_over(&mut self, edge: usize, from: u32, to: u32) {
        match self.faces[edge] {
            [MANY, fan] => {
                let start = self.fan_starts[fan as usize] as usize;
                let end = self.fan_starts.get(fan as usize + 1).map_or(self.fans.len(), |end| *end as usize);
                let fan = &mut self.fans[start..end];
                fan.iter_mut().filter(|face| **face == from).for_each(|face| *face = to);
                fan.sort_unstable();
            }
            [_, NONE] => self.faces[edge] = [to, NONE],
            [first, second] => {
                let (way, second) = (second & SAME_WAY, second & !SAME_WAY);
                let pair = [first, second].map(|face| if face == from { to } else { face });
                self.faces[edge] = [pair[0].min(pair[1]), pair[0].max(pair[1]) | way];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flipped_edges_are_those_built_anew() {
        // Faces 0 and 1 share the edge 1 4; beside them are a face, a border, one that runs the other way, and a fan.
        let before = [[1, 4, 2], [1, 0, 4], [2, 4, 5], [0, 1, 7], [0, 4, 6], [0, 4, 8]];
        let mut after = before;
        // The face 1 4 2 and the one beyond, 4 1 0: along 0 2.
        after[0] = [1, 0, 2];
        after[1] = [0, 4, 2];
        let mut edges = Edges::build(9, &before);
        edges.flip(&[EdgeFlip {
            gone: [1, 4],
            made: [0, 2],
            faces: [0, 1],
            moved: [([0, 1], 1, 0), ([2, 4], 0, 1)],
        }]);
        let built = Edges::build(9, &after);
        assert_eq!(edges.vertices, built.vertices);
        for edge in 0..built.len() {
            assert_eq!(edges.faces(edge), built.faces(edge), "{:?}", built.vertices[edge]);
        }
    }
}
