//! [`Verdicts`]: what each face of a mesh belongs to, told for its piece; and what a piece may be.

use crate::parallel::prelude::*;

use crate::mesh::components::disjoint_sets::Numbered;

/// The smallest piece of work for a thread, in faces.
const GRAIN: usize = 1 << 16;

/// What a piece of a model is meant to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Make {
    /// What its faces are.
    #[default]
    Block,
    /// Flats, and between them surfaces that may be round.
    Machined,
    /// A rounded surface but for its creases.
    Round,
}

/// How a surface came about, as far as its mesh tells: by that its lines may be noise.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, PartialOrd, Ord)]
pub enum Origin {
    /// All its lines are meant.
    #[default]
    Constructed,
    /// A figure that its file's normals shade round: what is small and stands alone is a matter of its few faces.
    Modelled,
    /// A round surface without normals: small folds and short creases are as likely noise as not.
    Scanned,
}

/// What a piece is, and how its file's normals have it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Verdict {
    pub make: Make,
    pub origin: Origin,
    pub believed: bool,
}

/// What the pieces of a mesh are, and which piece each face is of.
#[derive(Debug, Default)]
pub(crate) struct Verdicts {
    /// One of each piece. Every piece has a face.
    of_pieces: Vec<Verdict>,
    /// The number of the piece of each face.
    pieces: Vec<u32>,
}

impl Verdicts {
    /// Those of the pieces in the order of their numbers.
    pub fn new(of_pieces: Vec<Verdict>, pieces: Numbered) -> Self {
        Self { of_pieces, pieces: pieces.of_face }
    }

    /// That of the piece of a face.
    #[inline]
    pub fn of(&self, face: u32) -> &Verdict {
        &self.of_pieces[self.pieces[face as usize] as usize]
    }

    /// Whether one piece at least is made so.
    pub fn any(&self, make: Make) -> bool {
        self.of_pieces.iter().any(|verdict| verdict.make == make)
    }

    /// Whether all pieces are made so.
    pub fn all(&self, make: Make) -> bool {
        self.of_pieces.iter().all(|verdict| verdict.make == make)
    }

    /// Something of the verdict of each face.
    pub fn map<T: Clone + Send + Sync>(&self, of: impl Fn(&Verdict) -> T + Sync) -> Vec<T> {
        if let [only] = &self.of_pieces[..] {
            return vec![of(only); self.pieces.len()];
        }
        let of_face = |piece: &u32| of(&self.of_pieces[*piece as usize]);
        self.pieces.par_iter().with_min_len(GRAIN).map(of_face).collect()
    }

    /// The number of the piece of each face, in the order of the pieces' first faces; empty if there is but one.
    pub fn into_pieces(self) -> Vec<u32> {
        if self.of_pieces.len() < 2 { Vec::new() } else { self.pieces }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_are_told_by_their_pieces() {
        let make = |make| Verdict { make, ..Verdict::default() };
        let numbered = |of_face: &[u32]| Numbered { of_face: of_face.to_vec(), first: Vec::new() };
        let two = Verdicts::new(vec![make(Make::Round), make(Make::Machined)], numbered(&[0, 1, 1, 0]));
        assert_eq!(two.of(2).make, Make::Machined);
        assert!(two.any(Make::Machined) && !two.any(Make::Block) && !two.all(Make::Round));
        assert_eq!(two.map(|verdict| verdict.make == Make::Round), [true, false, false, true]);
        assert_eq!(two.into_pieces(), [0, 1, 1, 0]);
        let one = Verdicts::new(vec![make(Make::Round)], numbered(&[0, 0]));
        assert!(one.all(Make::Round));
        assert_eq!(one.map(|verdict| verdict.make), [Make::Round; 2]);
        assert!(one.into_pieces().is_empty());
        let none = Verdicts::default();
        assert!(none.all(Make::Round) && !none.any(Make::Round) && none.into_pieces().is_empty());
    }
}
