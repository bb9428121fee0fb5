//! Creases that come and go while flat surfaces fold and open.
//!
//! Source of the two thresholds: Canny, as in [`hard_edges`](super::hard_edges), here in time: which of them counts is told by the
//! surface at rest and not by the moment before, so that no moment knows of another.

use super::HardEdges;
use crate::math::function::cos;
use crate::mesh::dihedral::{Dihedral, mark};
use crate::mesh::{EdgeMark, FaceId, Mesh};

/// Flat is what turns by less than this share of what makes a crease: there a crease is gone, and only there one may come.
const FLAT: f64 = 0.25;

/// A crease comes where what was flat turns by so many times what makes one at rest.
const FOLDED: f64 = 1.25;

/// A side of a face that is longer or shorter than at rest by more than this part of it is stretched: so skins deform, and no sheet that folds.
const STRETCHED: f64 = 0.01;

/// The hard edges of a mesh that has moved: those that it has at rest, without those that have become flat, and with those that were
/// flat and are folded sharply. Only edges between faces of which `may_fold` is true, and which are as large as at rest, change: skins bend
/// all over, and their creases are those that they were made with.
#[must_use]
pub fn folded(
    hard: &HardEdges,
    rest: &Mesh,
    moved: &Mesh,
    crease_deg: f64,
    may_fold: impl Fn(u32) -> bool,
) -> HardEdges {
    let cosine = |degrees: f64| cos(degrees.clamp(0.0, 180.0).to_radians()) as f32;
    let (flat, crease, sharp) = (cosine(FLAT * crease_deg), cosine(crease_deg), cosine(FOLDED * crease_deg));
    HardEdges::of(rest, |edge| {
        let was = hard.is_hard(edge);
        let (Some(before), Some(now)) = (Dihedral::at(rest, edge), Dihedral::at(moved, edge)) else {
            return was;
        };
        let told = || mark(rest, edge, before.faces) != EdgeMark::Unmarked;
        // One that was meant though it hardly turns stays, whatever it does.
        let is = if was {
            now.cosine < flat || before.cosine > crease
        } else {
            before.cosine > flat && now.cosine < sharp
        };
        let changes = |face: &u32| may_fold(*face) && is_rigid(rest, moved, FaceId(*face));
        if is == was || told() || !before.faces.iter().all(changes) { was } else { is }
    })
}

/// Whether a face is as large as at rest, side by side.
fn is_rigid(rest: &Mesh, moved: &Mesh, face: FaceId) -> bool {
    let sides = |mesh: &Mesh| {
        let [a, b, c] = mesh.corners(face);
        [a.distance(b), b.distance(c), c.distance(a)]
    };
    sides(rest).iter().zip(sides(moved)).all(|(before, now)| (now - before).abs() <= STRETCHED * before)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::math::function::sin;
    use crate::mesh::Soup;

    /// Two squares that turn by an angle at their common side.
    fn sheet(degrees: f64) -> Mesh {
        let (c, s) = (cos(degrees.to_radians()), sin(degrees.to_radians()));
        let points =
            [[-1.0, 0.0, 0.0], [-1.0, 1.0, 0.0], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [c, 0.0, s], [c, 1.0, s]];
        Mesh::build(Soup {
            positions: points.map(DVec3::from_array).to_vec(),
            triangles: vec![[0, 2, 3], [0, 3, 1], [2, 4, 5], [2, 5, 3]],
            ..Soup::default()
        })
    }

    fn count(rest: f64, moved: f64, may_fold: bool) -> usize {
        let rest = sheet(rest);
        let hard = HardEdges::above(&rest, 40.0);
        folded(&hard, &rest, &sheet(moved), 40.0, |_| may_fold).count()
    }

    #[test]
    fn what_was_flat_is_a_crease_where_it_folds_sharply() {
        let of = |moved: f64| count(0.0, moved, true);
        assert_eq!([0.0, 41.0, 49.0, 51.0, 90.0, -51.0].map(of), [0, 0, 0, 1, 1, 1]);
        assert_eq!(count(0.0, 90.0, false), 0);
        // What bends a little at rest is round, and no fold.
        assert_eq!([0.0, 30.0, 90.0].map(|moved| count(15.0, moved, true)), [0, 0, 0]);
    }

    #[test]
    fn a_crease_is_gone_where_it_is_flat() {
        let of = |moved: f64| count(90.0, moved, true);
        assert_eq!([90.0, 41.0, 20.0, 11.0, 9.0, 0.0].map(of), [1, 1, 1, 1, 0, 0]);
        assert_eq!(count(90.0, 0.0, false), 1);
    }
}
