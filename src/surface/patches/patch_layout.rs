//! [`Patches`]: where the surfaces of a mesh are parted, and which of them are meant to be round.
//!
//! Flats, cylinders and cones are drawn as their faces have them: what bends one way only has contours
//! along its edges already. Round is what bends both ways: scans and figures but for their creases,
//! and of machined parts the patches between hard edges that have curvature of their own.

use super::component_classes::{pieces, verdicts};
use super::curved_patches::add_free_forms;
use super::planar_regions::{Planes, area};
use super::surface_class::{Make, Origin, Verdicts};
use crate::geometry::numbers::portable_math::cos;
use crate::mesh::edges::edge_set::EdgeSet;
use crate::mesh::{EdgeFaces, Mesh, Turns};
use crate::surface::HardEdges;
use crate::surface::creases::hard_edges::LOW_OF_HIGH;
use crate::surface::creases::low_angle::narrow_fillets::narrow_roundings;
use crate::surface::creases::low_angle::shallow_creases::{shallow_creases, shallow_edges};
use crate::surface::creases::low_angle::surface_trace::Walk;
use crate::surface::normals::file_normals::file_cosines;

/// On round pieces a crease turns by so many times as much.
const ROUND: f64 = 1.5;

/// The cosine (10 degrees) beyond which the outline of a flat parts it from what is around.
const RIM_COSINE: f32 = 0.985;
/// The cosine (20 degrees) beyond which a strip is parted from a face so many times wider.
const STRIP_COSINE: f32 = 0.94;
const STRIP: f64 = 6.0;

/// How the surfaces of a mesh are meant.
#[derive(Debug, Clone, Default)]
pub struct Patches {
    /// Edges that are drawn as creases.
    pub hard: HardEdges,
    /// Sharp edges of machined parts that are no creases: slivers that lean by themselves. They part surfaces all the same.
    pub wrinkles: EdgeSet,
    /// The middle edges of narrow roundings, drawn as creases: the surface goes on over them.
    pub roundings: EdgeSet,
    /// Edges that part surfaces though they turn too little for a crease: rims of flats, strips beside
    /// wide faces.
    pub rims: EdgeSet,
    /// Whether each face is meant to be round.
    pub rounded: Vec<bool>,
    /// Whether each face is part of a figure or a scan, all of which is round but for its creases.
    pub figure: Vec<bool>,
    /// How the surface at each face came about.
    pub origins: Vec<Origin>,
    /// Which connected piece each face is of; empty if there is but one.
    pub pieces: Vec<u32>,
    /// Whether the file's normals tell the shape of each face, if it has any.
    pub believed: Vec<bool>,
}

impl Patches {
    /// The patches of a mesh whose creases turn by more than `crease_deg` degrees; with `all`, every
    /// face is meant to be round, and only the edges between are sought.
    #[must_use]
    pub fn new(mesh: &Mesh, crease_deg: f64, all: bool) -> Self {
        let (turns, planes, verdicts) = judged(mesh, all);
        let turns = &turns;
        let believed = verdicts.map(|verdict| verdict.believed);
        let makes = verdicts.map(|verdict| verdict.make);
        let ((hard, wrinkles), rims) = crate::parallel::join(
            || hard_edges(mesh, turns, &verdicts, crease_deg),
            || rims(mesh, turns, &planes, &makes),
        );
        let rounded_and_shallow = || {
            let mut rounded = verdicts.map(|verdict| all || verdict.make == Make::Round);
            if !all && verdicts.any(Make::Machined) {
                let parts =
                    |edge: usize| hard.is_hard(edge) || rims.contains(edge) || wrinkles.contains(edge);
                add_free_forms(mesh, (turns, &planes), &makes, parts, &mut rounded);
            }
            // A figure that its file means to be seen as planes bends at all edges.
            let is_exact = |face: &u32| !rounded[*face as usize] && verdicts.of(*face).believed;
            let may =
                |edge: usize| mesh.edges.faces(edge).list().iter().all(is_exact) && !wrinkles.contains(edge);
            let shallow = shallow_creases(mesh, (turns, &planes.flat), crease_deg, &hard, may);
            (rounded, shallow)
        };
        let ((rounded, shallow), roundings) = crate::parallel::join(rounded_and_shallow, || {
            if all {
                return EdgeSet::default();
            }
            roundings(mesh, (turns, &planes), &verdicts, (&hard, &wrinkles), crease_deg)
        });
        let hard = hard.with(mesh, &shallow);
        let origins = verdicts.map(|verdict| verdict.origin);
        let figure = verdicts.map(|verdict| verdict.make == Make::Round);
        let pieces = verdicts.into_pieces();
        Self { hard, wrinkles, roundings, rims, rounded, figure, origins, pieces, believed }
    }
}

/// The edges of a mesh that turn by more than `crease_deg` degrees, how the surface at each of its faces came about, and
/// which connected piece each is of: empty if there is but one.
#[must_use]
pub fn of_faces(mesh: &Mesh, crease_deg: f64) -> (HardEdges, Vec<Origin>, Vec<u32>) {
    let (turns, _, verdicts) = judged(mesh, false);
    let turns = &turns;
    let hard = HardEdges::above_with(mesh, turns, crease_deg);
    (hard, verdicts.map(|verdict| verdict.origin), verdicts.into_pieces())
}

/// How the surface turns, its flats, and what each face belongs to.
fn judged(mesh: &Mesh, all: bool) -> (Turns, Planes, Verdicts) {
    let turned = || {
        let turns = Turns::of(mesh);
        let planes = Planes::new(mesh, &turns);
        (turns, planes)
    };
    let ((turns, planes), pieces) = crate::parallel::join(turned, || pieces(mesh));
    let verdicts = verdicts(mesh, &turns, (&planes, pieces), all);
    (turns, planes, verdicts)
}

/// Every sharp edge, and on machined pieces what a crease goes on along that would end inside the surface: flats and
/// strips that are cut out of it turn by more here and by less there. But for wrinkles of machined pieces, which come second.
fn sharp_edges(mesh: &Mesh, turns: &Turns, verdicts: &Verdicts, crease_deg: f64) -> (HardEdges, EdgeSet) {
    let is_machined = |face: &u32| verdicts.of(*face).make == Make::Machined;
    if !verdicts.any(Make::Machined) {
        return (HardEdges::above_with(mesh, turns, crease_deg), EdgeSet::default());
    }
    let low_deg = ROUND * LOW_OF_HIGH * crease_deg;
    HardEdges::above_and_on(mesh, turns, [crease_deg, low_deg], |edge| {
        mesh.edges.faces(edge).list().iter().all(is_machined)
    })
}

/// Creases: every sharp edge of machined pieces; on round ones, whose faces turn at every edge, those over
/// which the file's normals turn as well, and chains that turn by more and stand out from what is around them. Wrinkles of
/// machined pieces come second.
fn hard_edges(mesh: &Mesh, turns: &Turns, verdicts: &Verdicts, crease_deg: f64) -> (HardEdges, EdgeSet) {
    let is_round = |face: u32| verdicts.of(face).make == Make::Round;
    let above = || sharp_edges(mesh, turns, verdicts, crease_deg);
    if !verdicts.any(Make::Round) {
        return above();
    }
    let chains = HardEdges::find_with(mesh, turns, (ROUND * crease_deg).min(180.0), is_round);
    if verdicts.all(Make::Round) && mesh.corner_normals.is_empty() {
        return (chains, EdgeSet::default());
    }
    let (above, wrinkles) = above();
    let least = cos(crease_deg.to_radians()) as f32;
    let shaded_sharp = |edge: usize, faces: [u32; 2]| {
        faces.iter().all(|face| verdicts.of(*face).believed)
            && file_cosines(mesh, edge, faces).is_some_and(|[a, b]| a.min(b) < least)
    };
    let hard = HardEdges::of(mesh, |edge| match mesh.edges.faces(edge) {
        EdgeFaces::Two { faces, .. } if faces.iter().all(|face| is_round(*face)) => {
            chains.is_hard(edge) || (above.is_hard(edge) && shaded_sharp(edge, faces))
        }
        _ => above.is_hard(edge),
    });
    (hard, wrinkles)
}

/// The middle edges of narrow roundings of what is no figure or scan, where `hard` edges and wrinkles are none.
fn roundings(
    mesh: &Mesh,
    (turns, planes): (&Turns, &Planes),
    verdicts: &Verdicts,
    (hard, wrinkles): (&HardEdges, &EdgeSet),
    crease_deg: f64,
) -> EdgeSet {
    let is_made = |face: &u32| {
        let verdict = verdicts.of(*face);
        verdict.make != Make::Round && verdict.believed
    };
    let may = |edge: usize| mesh.edges.faces(edge).list().iter().all(is_made) && !wrinkles.contains(edge);
    let asked = shallow_edges(mesh, turns, crease_deg, hard, may);
    if asked.is_empty() {
        return EdgeSet::default();
    }
    let walk = Walk::new(mesh, (turns, &planes.flat), hard, crease_deg);
    EdgeSet::default().with(&narrow_roundings(&walk, &asked), mesh.edges.len())
}

/// Where flats and wide faces end.
fn rims(mesh: &Mesh, turns: &Turns, planes: &Planes, makes: &[Make]) -> EdgeSet {
    EdgeSet::collect(mesh.edges.len(), |edge| {
        let cosine = turns.of_two(edge);
        if cosine > RIM_COSINE {
            return false;
        }
        let EdgeFaces::Two { faces, .. } = mesh.edges.faces(edge) else { return false };
        let [first, second] = faces.map(|face| planes.compact(face));
        if first != second {
            return true;
        }
        // Scans have slivers beside wide faces by chance; what was modelled has them for a reason.
        let shaded = |face: u32| mesh.corner_normals.get(face as usize).is_some_and(|n| n[0] != u32::MAX);
        let modelled = faces.iter().all(|f| makes[*f as usize] == Make::Machined || shaded(*f));
        cosine < STRIP_COSINE && modelled && {
            let [a, b] = faces.map(|face| width(mesh, edge, face));
            a.max(b) > STRIP * a.min(b)
        }
    })
}

/// How far a face reaches from one of its edges.
fn width(mesh: &Mesh, edge: usize, face: u32) -> f64 {
    let [a, b] = mesh.edges.vertices[edge].map(|v| mesh.positions[v as usize]);
    2.0 * area(mesh, face) / a.distance(b).max(f64::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::numbers::portable_math::sin;
    use crate::mesh::{FaceId, Soup};
    use glam::DVec3;

    /// A lens of two caps of a ball that turn into each other by an angle (degrees), with the normals of the
    /// caps, or with one normal at each vertex of the rim.
    fn lens(angle_deg: f64, split: bool) -> Mesh {
        const AROUND: u32 = 24;
        const RINGS: u32 = 12;
        let half = ((180.0 - angle_deg) / 2.0).to_radians();
        let mut soup = Soup::default();
        for up in [1.0, -1.0] {
            let first = soup.positions.len() as u32;
            let centre = DVec3::new(0.0, 0.0, -up * cos(half));
            for ring in 0..=RINGS {
                for step in 0..AROUND {
                    let (polar, turn) = (
                        half * f64::from(ring) / f64::from(RINGS),
                        std::f64::consts::TAU * (f64::from(step) + 0.5 * f64::from(ring)) / f64::from(AROUND),
                    );
                    let out = DVec3::new(sin(polar) * cos(turn), sin(polar) * sin(turn), up * cos(polar));
                    let is_rim = ring == RINGS;
                    let rim = DVec3::new(cos(turn), sin(turn), 0.0);
                    let normal = if is_rim && !split { rim } else { out };
                    soup.positions.push(if is_rim { rim * sin(half) } else { centre + out });
                    soup.normals.push(normal.as_vec3().to_array());
                }
            }
            for ring in 0..RINGS {
                for step in 0..AROUND {
                    let at = |ring: u32, step: u32| first + ring * AROUND + step % AROUND;
                    let (a, b) = (at(ring, step), at(ring, step + 1));
                    let (c, d) = (at(ring + 1, step), at(ring + 1, step + 1));
                    for [a, b, c] in [[a, c, b], [b, c, d]] {
                        soup.triangles.push(if up > 0.0 { [a, b, c] } else { [a, c, b] });
                    }
                }
            }
        }
        soup.corner_normals = soup.triangles.clone();
        Mesh::build(soup)
    }

    /// A star of eight points, drawn out and twisted but for so many of its rings.
    fn screw(straight: u32) -> Mesh {
        star((0..=60u32).map(|ring| 0.04 * f64::from(ring.saturating_sub(straight))))
    }

    /// A star of eight points, ring over ring, each turned by so much.
    fn star(turns: impl Iterator<Item = f64>) -> Mesh {
        const AROUND: u32 = 16;
        let mut soup = Soup::default();
        for (ring, turned) in (0u32..).zip(turns) {
            for step in 0..AROUND {
                let turn = std::f64::consts::TAU * f64::from(step) / f64::from(AROUND) + turned;
                let radius = if step % 2 == 0 { 1.0 } else { 0.6 };
                let z = 0.1 * f64::from(ring);
                soup.positions.push(DVec3::new(radius * cos(turn), radius * sin(turn), z));
                if ring > 0 {
                    let at = |ring: u32, step: u32| ring * AROUND + step % AROUND;
                    let (a, b) = (at(ring - 1, step), at(ring - 1, step + 1));
                    let (c, d) = (at(ring, step), at(ring, step + 1));
                    soup.triangles.extend([[a, b, c], [b, d, c]]);
                }
            }
        }
        Mesh::build(soup)
    }

    #[test]
    fn many_sharp_edges_and_some_flat_ones_are_of_a_machined_part() {
        let origins = |straight: u32| Patches::new(&screw(straight), 40.0, false).origins;
        assert!(origins(5).iter().all(|origin| *origin == Origin::Constructed));
        // So sharp and nowhere flat is what is left of a scan.
        assert!(origins(0).iter().all(|origin| *origin == Origin::Scanned));
    }

    /// Rough ground of 20 by 20 squares, as high as that at most and level for so many squares from one corner each way, and a
    /// plate of one square in width and of so much length that stands on one of its sides.
    fn ground(height: f64, level: u32, plate: f64) -> Mesh {
        const SIDE: u32 = 20;
        let mut soup = Soup::default();
        for i in 0..=SIDE {
            for j in 0..=SIDE {
                let (x, y) = (u64::from(i), u64::from(j));
                let by_chance =
                    ((x + 3).pow(2) * (y + 5).pow(3) * (x + 7) * 131 + x * 577 + y * y * 263) % 1009;
                let z = if i.max(j) <= level && level > 0 { 0.0 } else { height * by_chance as f64 / 1009.0 };
                soup.positions.push(DVec3::new(f64::from(i), f64::from(j), z));
            }
        }
        let at = |i: u32, j: u32| i * (SIDE + 1) + j;
        for (i, j) in (0..SIDE).flat_map(|i| (0..SIDE).map(move |j| (i, j))) {
            let (a, b, c, d) = (at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1));
            soup.triangles.extend([[a, b, c], [b, d, c]]);
        }
        if plate > 0.0 {
            let (low, high) = (at(SIDE, 3), at(SIDE, 4));
            let far = soup.positions.len() as u32;
            let ends = [low, high].map(|v| soup.positions[v as usize] + DVec3::X * plate);
            soup.positions.extend(ends);
            soup.triangles.extend([[low, far, high], [far, far + 1, high]]);
        }
        Mesh::build(soup)
    }

    /// A star of eight points that is twisted from ring to ring, but for so many of its rings that are level: each for itself,
    /// so that no flat is more than a quad.
    fn notched(level: u32) -> Mesh {
        star((0..=30).scan(0.0, |turned, ring| {
            *turned += if ring % 2 == 0 && ring < 2 * level { 0.0 } else { 0.06 };
            Some(*turned)
        }))
    }

    /// Meshes beside each other in one part.
    fn beside(meshes: &[(&Mesh, f64)]) -> Mesh {
        let mut soup = Soup::default();
        for (k, (mesh, scale)) in meshes.iter().enumerate() {
            let first = soup.positions.len() as u32;
            let away = DVec3::X * (100.0 * k as f64);
            soup.positions.extend(mesh.positions.iter().map(|p| (*p + mesh.origin) * *scale + away));
            soup.triangles.extend(mesh.triangles.iter().map(|t| t.map(|v| v + first)));
        }
        Mesh::build(soup)
    }

    #[test]
    fn flats_of_one_quad_tell_a_sharp_part_where_most_that_is_nearly_flat_is_flat() {
        assert!(constructed(&notched(4)), "bars that lie askew, each with a quad or two");
        assert!(!constructed(&notched(0)));
    }

    #[test]
    fn with_flats_a_part_is_machined_though_one_edge_in_twenty_alone_is_sharp() {
        // A flat of a twenty-fifth of its surface: what is as steep without is a scan, and what is less steep with it.
        let found =
            [(1.0, 4), (1.0, 0), (0.6, 4)].map(|(height, level)| constructed(&ground(height, level, 0.0)));
        assert_eq!(found, [true, false, false]);
    }

    #[test]
    fn small_pieces_follow_the_largest_of_their_part_unless_they_are_round_for_sure() {
        let origins = |large: &Mesh, scale: f64, small: &Mesh| {
            let mesh = beside(&[(large, scale), (small, 1.0)]);
            let origins = Patches::new(&mesh, 40.0, false).origins;
            [false, true].map(|is_small| {
                let at = |face: &usize| (mesh.corners(FaceId(*face as u32))[0] + mesh.origin).x;
                let mut own =
                    (0..origins.len()).filter(|face| (at(face) > 50.0) == is_small).map(|face| origins[face]);
                let first = own.next().expect("both have faces");
                assert!(own.all(|origin| origin == first));
                first
            })
        };
        let (machined, rough, scan) = (ground(0.6, 6, 0.0), ground(0.8, 0, 0.0), screw(0));
        assert_eq!(origins(&machined, 2.0, &rough), [Origin::Constructed; 2]);
        assert_eq!(
            origins(&rough, 2.0, &machined),
            [Origin::Scanned, Origin::Constructed],
            "the largest stays"
        );
        assert_eq!(origins(&machined, 2.0, &scan), [Origin::Constructed, Origin::Scanned], "dense");
        // One edge in two hundred is sharp.
        let gentle = ground(0.6, 0, 0.0);
        assert_eq!(origins(&machined, 2.0, &gentle), [Origin::Constructed, Origin::Scanned], "gentle");
    }

    #[test]
    fn creases_of_a_scan_are_the_same_beside_a_machined_part() {
        let hard = |mesh: &Mesh| Patches::new(mesh, 40.0, false).hard.count();
        let (scan, machined) = (screw(0), screw(5));
        let alone = [&scan, &machined].map(hard);
        assert!(alone.iter().all(|count| *count > 0), "{alone:?}");
        assert_eq!(hard(&beside(&[(&scan, 1.0), (&machined, 1.0)])), alone[0] + alone[1]);
    }

    fn constructed(mesh: &Mesh) -> bool {
        let origins = Patches::new(mesh, 40.0, false).origins;
        assert!(origins.iter().all(|origin| *origin == origins[0]));
        origins[0] == Origin::Constructed
    }

    #[test]
    fn rough_ground_is_a_scan_until_flats_levels_or_corners_say_otherwise() {
        let found = |parts: &[(f64, u32, f64)]| -> Vec<bool> {
            parts.iter().map(|(height, level, plate)| constructed(&ground(*height, *level, *plate))).collect()
        };
        // A flat of a twelfth of its surface, most of its surface in one plane with a neighbour, sharp at most of its edges.
        assert_eq!(found(&[(0.6, 6, 0.0), (0.6, 0, 600.0), (6.0, 0, 0.0)]), [true; 3]);
        // A flat of a twenty-fifth, a third in one plane with a neighbour, less steep.
        assert_eq!(found(&[(0.6, 0, 0.0), (0.6, 4, 0.0), (0.6, 0, 200.0), (1.2, 0, 0.0)]), [false; 4]);
    }

    #[test]
    fn sharp_parts_are_machined_where_more_of_their_edges_are_flat_than_by_chance() {
        // Of its edges one in sixty is flat, and no more are nearly flat.
        assert!(constructed(&screw(2)));
        assert!(!constructed(&screw(0)));
    }

    #[test]
    fn a_crease_of_a_round_piece_is_where_its_file_shades_one() {
        let hard = |angle_deg: f64, split: bool| {
            let mesh = lens(angle_deg, split);
            let patches = Patches::new(&mesh, 40.0, false);
            assert!(patches.rounded.iter().all(|rounded| *rounded));
            patches.hard.count()
        };
        assert_eq!(hard(52.0, true), 24, "shaded sharp");
        assert_eq!(hard(52.0, false), 0, "shaded smooth");
        assert_eq!(hard(36.0, true), 0, "below the angle of a crease");
        assert_eq!(hard(70.0, false), 24, "sharp by its angle, however shaded");
    }
}
