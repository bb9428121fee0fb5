//! [`SliverFace`]: sliver faces, and whether the surface bends along them.
//!
//! Samplings of a round surface are denser across bends: faces may be long where the surface is straight, but
//! are short where it bends. Tessellators of machined patches and convex hulls do not follow this. Their
//! faces reach from one end of a patch to the other, across all bends.

use crate::geometry::numbers::portable_math::cos;
use crate::geometry::space::triangles::{area_vector, longest_side_squared};
use crate::mesh::{DihedralCosines, FaceId, Mesh, VertexEdges};
use crate::surface::tolerances;

/// Cosine (40 degrees) below which an edge is a corner, not a bend.
const MIN_BEND_COSINE: f32 = 0.766;
/// The angle of such a corner, radians.
const MAX_BEND_RAD: f64 = 0.698;
/// A face bends if the turn at its short side, as an arc over its length, rises above half its width. The
/// rise is an eighth of the length times the angle.
const BEND_OF_ASPECT: f64 = 4.0;

/// Size of a face that is long enough to bend at less than a corner angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SliverFace {
    /// Longest side, world units.
    pub length: f64,
    /// Height over the longest side, world units.
    pub width: f64,
}

impl SliverFace {
    /// Whether a face with this area and longest side is a sliver.
    #[inline]
    pub(crate) fn is_sliver(area: f64, longest: f64) -> bool {
        area > 0.0 && 2.0 * area * BEND_OF_ASPECT < MAX_BEND_RAD * longest * longest
    }

    /// A face, if it is a sliver.
    pub(crate) fn of(mesh: &Mesh, face: u32) -> Option<Self> {
        let corners = mesh.corners(FaceId(face));
        let longest = longest_side_squared(corners);
        // Squared comparison: excludes most faces without square roots.
        if area_vector(corners).length_squared() * BEND_OF_ASPECT * BEND_OF_ASPECT
            > tolerances::SLIVER_ROUNDING_FACTOR * (MAX_BEND_RAD * longest).powi(2)
        {
            return None;
        }
        let (area, length) = (area_vector(corners).length() / 2.0, longest.sqrt());
        Self::is_sliver(area, length).then(|| Self { length, width: 2.0 * area / length })
    }
}

/// The longest side of a face, world units.
#[inline]
pub(crate) fn longest_side(mesh: &Mesh, face: u32) -> f64 {
    longest_side_squared(mesh.corners(FaceId(face))).sqrt()
}

/// Number of short sides (0 to 2) where the surface bends along a sliver.
pub(crate) fn bent_short_sides(
    mesh: &Mesh,
    (turns, edges): (&DihedralCosines, &VertexEdges),
    face: u32,
    slender: SliverFace,
) -> u32 {
    let least = cos(BEND_OF_ASPECT * slender.width / slender.length) as f32;
    let [a, b, c] = mesh.triangles[face as usize];
    let bends = |[a, b]: [u32; 2]| {
        let [from, to] = [a, b].map(|v| mesh.positions[v as usize]);
        let is_short = from.distance(to) < slender.length;
        let turns_less = |edge| (MIN_BEND_COSINE..least).contains(&turns.of_two(edge));
        is_short && edges.between(a, b).is_some_and(turns_less)
    };
    [[a, b], [b, c], [c, a]].into_iter().filter(|side| bends(*side)).count() as u32
}

#[cfg(test)]
mod tests {
    use crate::geometry::numbers::portable_math::{cos, sin};
    use crate::mesh::{Mesh, Soup};
    use crate::surface::MeshSource;
    use crate::surface::{HardEdges, Patches};
    use glam::DVec3;

    /// Body of revolution about z: rings of 40 vertices, each turned by half a step against the last, and two
    /// tips.
    fn body_of_revolution(rings: &[[f64; 2]], tips: f64) -> Mesh {
        const AROUND: u32 = 40;
        let mut soup = Soup { positions: vec![DVec3::Z * -tips, DVec3::Z * tips], ..Soup::default() };
        for (ring, [radius, z]) in (0u32..).zip(rings) {
            soup.positions.extend((0..AROUND).map(|k| {
                let turn = std::f64::consts::TAU * (f64::from(k) + 0.5 * f64::from(ring)) / f64::from(AROUND);
                DVec3::new(radius * cos(turn), radius * sin(turn), *z)
            }));
        }
        let last = rings.len() as u32 - 1;
        let at = |ring: u32, k: u32| 2 + ring * AROUND + k % AROUND;
        for k in 0..AROUND {
            soup.triangles.extend([[0, at(0, k + 1), at(0, k)], [1, at(last, k), at(last, k + 1)]]);
            for ring in 0..last {
                let [a, b] = [at(ring, k), at(ring, k + 1)];
                let [c, d] = [at(ring + 1, k), at(ring + 1, k + 1)];
                soup.triangles.extend([[a, b, c], [b, d, c]]);
            }
        }
        Mesh::build(soup)
    }

    /// Barrel with steep lids, with the given numbers of rings.
    fn barrel(rings: i32, lids: i32) -> Mesh {
        let radius = |z: f64| 1.0 - 0.05 * z * z;
        let mut profile: Vec<[f64; 2]> = (0..=rings)
            .map(|k| 4.0 * f64::from(k) / f64::from(rings) - 2.0)
            .map(|z| [radius(z), z])
            .collect();
        let lid = |k: i32| f64::from(k) / f64::from(lids);
        for k in 1..lids {
            profile.push([0.8 * (1.0 - lid(k)), 2.0 + 1.4 * lid(k)]);
            profile.insert(0, [0.8 * (1.0 - lid(k)), -2.0 - 1.4 * lid(k)]);
        }
        body_of_revolution(&profile, 3.4)
    }

    #[test]
    fn sliver_bends_mark_a_hull_as_constructed_instead_of_scanned() {
        let origins = |mesh: &Mesh| Patches::new(mesh, 40.0, false).origins;
        let is = |origin: MeshSource| move |of_face: &MeshSource| *of_face == origin;
        let (hull, scan) = (barrel(1, 1), barrel(24, 8));
        assert!(origins(&hull).iter().all(is(MeshSource::Constructed)));
        assert!(origins(&scan).iter().all(is(MeshSource::Scanned)));
        // The corners decide neither: there are none.
        assert_eq!([hull, scan].map(|mesh| HardEdges::above(&mesh, 40.0).count()), [0, 0]);
    }
}
