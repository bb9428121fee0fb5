//! [`Patches`]: the borders between the surfaces of a mesh, and which surfaces are curved.
//!
//! Planes, cylinders and cones are drawn as their faces are: a surface that bends one way has contours along
//! its edges only. Surfaces that bend both ways are rounded. These are scans and figures, except at their
//! creases, and on machined parts the patches between hard edges with curvature inside.

use super::component_classes::{pieces, verdicts};
use super::curved_patches::add_curved_patches;
use super::planar_regions::{PlanarRegions, area};
use super::surface_class::{ComponentClasses, MeshSource, SurfaceClass};
use crate::geometry::numbers::portable_math::cos;
use crate::mesh::edges::edge_set::EdgeSet;
use crate::mesh::{DihedralCosines, EdgeFaces, Mesh};
use crate::surface::HardEdges;
use crate::surface::creases::hard_edges::LOW_THRESHOLD_OF_HIGH;
use crate::surface::creases::low_angle::narrow_fillets::narrow_fillets;
use crate::surface::creases::low_angle::shallow_creases::{shallow_creases, shallow_edges};
use crate::surface::creases::low_angle::surface_trace::SurfaceTracer;
use crate::surface::normals::file_normals::file_cosines;

/// Factor on the crease angle for round components.
const ROUND_CREASE_FACTOR: f64 = 1.5;

/// Cosine (10 degrees) below which the outline of a planar region separates it from its surroundings.
const MAX_RIM_COSINE: f32 = 0.985;
/// Cosine (20 degrees) below which a strip is separated from a wider face, and the minimum ratio of their
/// widths.
const MAX_STRIP_COSINE: f32 = 0.94;
const MIN_STRIP_WIDTH_RATIO: f64 = 6.0;

/// Classification of the surfaces of a mesh.
#[derive(Debug, Clone, Default)]
pub struct Patches {
    /// Edges drawn as creases.
    pub hard: HardEdges,
    /// Sharp edges of machined parts that are no creases because only a sliver causes them. They separate
    /// surfaces.
    pub wrinkles: EdgeSet,
    /// Centre edges of narrow fillets. They are drawn as creases, but the surface continues across them.
    pub roundings: EdgeSet,
    /// Edges that separate surfaces although they turn too little for a crease: rims of planar regions, and
    /// strips next to wide faces.
    pub rims: EdgeSet,
    /// Whether each face belongs to a curved surface.
    pub rounded: Vec<bool>,
    /// Whether each face belongs to a figure or scan, which is curved everywhere except at creases.
    pub figure: Vec<bool>,
    /// Source of the surface at each face.
    pub origins: Vec<MeshSource>,
    /// Connected component of each face; empty if there is only one.
    pub pieces: Vec<u32>,
    /// Whether the normals of the file, if any, describe the shape of each face.
    pub believed: Vec<bool>,
}

impl Patches {
    /// Classifies a mesh whose creases turn by more than `crease_deg` degrees. With `all`, every face counts
    /// as curved, and only the edges between surfaces are sought.
    #[must_use]
    pub fn new(mesh: &Mesh, crease_deg: f64, all: bool) -> Self {
        let (turns, planes, verdicts) = classify(mesh, all);
        let turns = &turns;
        let believed = verdicts.map(|verdict| verdict.believed);
        let makes = verdicts.map(|verdict| verdict.make);
        let ((hard, wrinkles), rims) = crate::parallel::join(
            || hard_edges(mesh, turns, &verdicts, crease_deg),
            || rims(mesh, turns, &planes, &makes),
        );
        let rounded_and_shallow = || {
            let mut rounded = verdicts.map(|verdict| all || verdict.make == SurfaceClass::Round);
            if !all && verdicts.any(SurfaceClass::Machined) {
                let parts =
                    |edge: usize| hard.is_hard(edge) || rims.contains(edge) || wrinkles.contains(edge);
                add_curved_patches(mesh, (turns, &planes), &makes, parts, &mut rounded);
            }
            // A figure with faceted normals bends at all edges.
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
        let figure = verdicts.map(|verdict| verdict.make == SurfaceClass::Round);
        let pieces = verdicts.into_pieces();
        Self { hard, wrinkles, roundings, rims, rounded, figure, origins, pieces, believed }
    }
}

/// Edges that turn by more than `crease_deg` degrees, the source of each face, and the connected component of
/// each face (empty if there is only one).
#[must_use]
pub fn classify_faces(mesh: &Mesh, crease_deg: f64) -> (HardEdges, Vec<MeshSource>, Vec<u32>) {
    let (turns, _, verdicts) = classify(mesh, false);
    let turns = &turns;
    let hard = HardEdges::above_with(mesh, turns, crease_deg);
    (hard, verdicts.map(|verdict| verdict.origin), verdicts.into_pieces())
}

/// Dihedral angles, planar regions, and the class of each component.
fn classify(mesh: &Mesh, all: bool) -> (DihedralCosines, PlanarRegions, ComponentClasses) {
    let turned = || {
        let turns = DihedralCosines::of(mesh);
        let planes = PlanarRegions::new(mesh, &turns);
        (turns, planes)
    };
    let ((turns, planes), pieces) = crate::parallel::join(turned, || pieces(mesh));
    let verdicts = verdicts(mesh, &turns, (&planes, pieces), all);
    (turns, planes, verdicts)
}

/// Sharp edges, and the slivers removed from them.
///
/// Includes every sharp edge. On machined components, creases that would end inside the surface are extended:
/// planar regions and strips cut out of a surface turn by varying angles. The second result holds the sharp
/// edges of machined components that only a sliver causes.
fn sharp_edges(
    mesh: &Mesh,
    turns: &DihedralCosines,
    verdicts: &ComponentClasses,
    crease_deg: f64,
) -> (HardEdges, EdgeSet) {
    let is_machined = |face: &u32| verdicts.of(*face).make == SurfaceClass::Machined;
    if !verdicts.any(SurfaceClass::Machined) {
        return (HardEdges::above_with(mesh, turns, crease_deg), EdgeSet::default());
    }
    let low_deg = ROUND_CREASE_FACTOR * LOW_THRESHOLD_OF_HIGH * crease_deg;
    HardEdges::above_with_extensions(mesh, turns, [crease_deg, low_deg], |edge| {
        mesh.edges.faces(edge).list().iter().all(is_machined)
    })
}

/// Creases, and the slivers removed from them (second result).
///
/// On machined components every sharp edge is a crease. Faces of round components turn at every edge. There,
/// sharp edges are creases if the normals of the file turn as well. Chains that turn by more and stand out
/// from the noise are also creases.
fn hard_edges(
    mesh: &Mesh,
    turns: &DihedralCosines,
    verdicts: &ComponentClasses,
    crease_deg: f64,
) -> (HardEdges, EdgeSet) {
    let is_round = |face: u32| verdicts.of(face).make == SurfaceClass::Round;
    let above = || sharp_edges(mesh, turns, verdicts, crease_deg);
    if !verdicts.any(SurfaceClass::Round) {
        return above();
    }
    let chains = HardEdges::find_with(mesh, turns, (ROUND_CREASE_FACTOR * crease_deg).min(180.0), is_round);
    if verdicts.all(SurfaceClass::Round) && mesh.corner_normals.is_empty() {
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

/// Centre edges of narrow fillets, except on figures and scans, at `hard` edges and at `wrinkles`.
fn roundings(
    mesh: &Mesh,
    (turns, planes): (&DihedralCosines, &PlanarRegions),
    verdicts: &ComponentClasses,
    (hard, wrinkles): (&HardEdges, &EdgeSet),
    crease_deg: f64,
) -> EdgeSet {
    let is_made = |face: &u32| {
        let verdict = verdicts.of(*face);
        verdict.make != SurfaceClass::Round && verdict.believed
    };
    let may = |edge: usize| mesh.edges.faces(edge).list().iter().all(is_made) && !wrinkles.contains(edge);
    let asked = shallow_edges(mesh, turns, crease_deg, hard, may);
    if asked.is_empty() {
        return EdgeSet::default();
    }
    let walk = SurfaceTracer::new(mesh, (turns, &planes.flat), hard, crease_deg);
    EdgeSet::default().with(&narrow_fillets(&walk, &asked), mesh.edges.len())
}

/// Borders of planar regions and of wide faces.
fn rims(mesh: &Mesh, turns: &DihedralCosines, planes: &PlanarRegions, makes: &[SurfaceClass]) -> EdgeSet {
    EdgeSet::collect(mesh.edges.len(), |edge| {
        let cosine = turns.of_two(edge);
        if cosine > MAX_RIM_COSINE {
            return false;
        }
        let EdgeFaces::Two { faces, .. } = mesh.edges.faces(edge) else { return false };
        let [first, second] = faces.map(|face| planes.compact(face));
        if first != second {
            return true;
        }
        // Slivers next to wide faces are random on scans, but intended on modelled surfaces.
        let shaded = |face: u32| mesh.corner_normals.get(face as usize).is_some_and(|n| n[0] != u32::MAX);
        let modelled = faces.iter().all(|f| makes[*f as usize] == SurfaceClass::Machined || shaded(*f));
        cosine < MAX_STRIP_COSINE && modelled && {
            let [a, b] = faces.map(|face| width(mesh, edge, face));
            a.max(b) > MIN_STRIP_WIDTH_RATIO * a.min(b)
        }
    })
}

/// Width of a face, measured from one of its edges.
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

    /// Lens of two spherical caps that meet at an angle (degrees). Normals are those of the caps, or with
    /// `split` false one shared normal per rim vertex.
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

    /// Extruded eight-pointed star, twisted except over its first `straight` rings.
    fn screw(straight: u32) -> Mesh {
        star((0..=60u32).map(|ring| 0.04 * f64::from(ring.saturating_sub(straight))))
    }

    /// Eight-pointed star stacked in rings, each turned by an angle.
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
        assert!(origins(5).iter().all(|origin| *origin == MeshSource::Constructed));
        // Sharp edges without flat ones are those of a decimated scan.
        assert!(origins(0).iter().all(|origin| *origin == MeshSource::Scanned));
    }

    /// Rough ground of 20 by 20 squares with heights up to `height`. It is level for `level` squares from one
    /// corner. A plate, one square wide and `plate` long, is attached to one side.
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

    /// Eight-pointed star that is twisted from ring to ring, except at `level` separate rings, so that no
    /// planar region is larger than a quad.
    fn notched(level: u32) -> Mesh {
        star((0..=30).scan(0.0, |turned, ring| {
            *turned += if ring % 2 == 0 && ring < 2 * level { 0.0 } else { 0.06 };
            Some(*turned)
        }))
    }

    /// Meshes side by side in one part.
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
        // A planar region of 1/25 of the surface. Without it, or with lower heights, the ground is a scan.
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
        assert_eq!(origins(&machined, 2.0, &rough), [MeshSource::Constructed; 2]);
        assert_eq!(
            origins(&rough, 2.0, &machined),
            [MeshSource::Scanned, MeshSource::Constructed],
            "the largest stays"
        );
        assert_eq!(origins(&machined, 2.0, &scan), [MeshSource::Constructed, MeshSource::Scanned], "dense");
        // One edge in 200 is sharp.
        let gentle = ground(0.6, 0, 0.0);
        assert_eq!(
            origins(&machined, 2.0, &gentle),
            [MeshSource::Constructed, MeshSource::Scanned],
            "gentle"
        );
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
        origins[0] == MeshSource::Constructed
    }

    #[test]
    fn rough_ground_is_a_scan_until_flats_levels_or_corners_say_otherwise() {
        let found = |parts: &[(f64, u32, f64)]| -> Vec<bool> {
            parts.iter().map(|(height, level, plate)| constructed(&ground(*height, *level, *plate))).collect()
        };
        // A planar region of 1/12 of the surface; most of the surface coplanar with a neighbour; most edges
        // sharp.
        assert_eq!(found(&[(0.6, 6, 0.0), (0.6, 0, 600.0), (6.0, 0, 0.0)]), [true; 3]);
        // No planar region; 1/25 of the surface; a third coplanar with a neighbour; less steep.
        assert_eq!(found(&[(0.6, 0, 0.0), (0.6, 4, 0.0), (0.6, 0, 200.0), (1.2, 0, 0.0)]), [false; 4]);
    }

    #[test]
    fn sharp_parts_are_machined_where_more_of_their_edges_are_flat_than_by_chance() {
        // One edge in 60 is flat, and no more are nearly flat.
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
