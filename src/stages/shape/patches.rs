//! [`Patches`]: where the surfaces of a mesh are parted, and which of them are meant to be round.
//!
//! Flats, cylinders and cones are drawn as their faces have them: what bends one way only has contours
//! along its edges already. Round is what bends both ways: scans and figures but for their creases,
//! and of machined parts the patches between hard edges that have curvature of their own.
//!
//! Source for curvature by angles: Meyer, Desbrun, Schröder and Barr, "Discrete differential-geometry
//! operators for triangulated 2-manifolds", 2002, section 4.

use super::HardEdges;
use super::file_normals::file_cosines;
use super::planes::{Planes, area};
use super::rounded::{LEAST_EDGES, Make, Origin, Verdict, verdicts};
use crate::math::function::{acos, cos};
use crate::mesh::edge_set::EdgeSet;
use crate::mesh::groups::Groups;
use crate::mesh::{Dihedral, EdgeFaces, FaceId, Mesh};

/// On round pieces a crease turns by so many times as much.
const ROUND: f64 = 1.5;

/// The cosine (10 degrees) beyond which the outline of a flat parts it from what is around.
const RIM_COSINE: f32 = 0.985;
/// The cosine (20 degrees) beyond which a strip is parted from a face so many times wider.
const STRIP_COSINE: f32 = 0.94;
const STRIP: f64 = 6.0;

/// The least total curvature of a patch that bends both ways, radians: a twelfth of a ball's.
const FREE_FORM: f64 = 1.0;
/// Angles around a vertex of a cylinder miss a whole turn by less than this, radians, by rounding.
const ROUNDING: f64 = 2e-4;
/// With more than this share of flat edges a patch is machined all over: flat quads have a third.
const MANY_FLAT: f64 = 0.45;
/// With more than this share of edges that turn by more than this (cosine, 15 degrees) a patch of a machined part
/// is too coarse for a curve that all would agree on, and is what its faces are.
const FEW_COARSE: f64 = 0.1;
const COARSE_COSINE: f32 = 0.966;
/// Patches of which flats hold more than this part are machined all over.
const FEW_FLATS: f64 = 0.1;
/// A face is long if it is so many times as long as wide: nobody knows what lies between its ends. Patches
/// of which long faces hold more than this part stay what they are.
const LONG: f64 = 6.0;
const FEW_LONG: f64 = 0.1;

/// How the surfaces of a mesh are meant.
#[derive(Debug, Clone, Default)]
pub struct Patches {
    /// Edges that are drawn as creases.
    pub hard: HardEdges,
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
        let planes = Planes::new(mesh);
        let verdicts = verdicts(mesh, &planes, all);
        let believed = verdicts.iter().map(|verdict| verdict.believed).collect();
        let makes: Vec<Make> = verdicts.iter().map(|verdict| verdict.make).collect();
        let hard = hard_edges(mesh, &verdicts, crease_deg);
        let rims = rims(mesh, &planes, &makes);
        let mut rounded: Vec<bool> = makes.iter().map(|make| all || *make == Make::Round).collect();
        if !all && makes.contains(&Make::Machined) {
            let parts = |edge: usize| hard.is_hard(edge) || rims.contains(edge);
            add_free_forms(mesh, &planes, &makes, parts, &mut rounded);
        }
        let (origins, pieces) = (origins_in(&verdicts), pieces_in(&verdicts));
        let figure = makes.iter().map(|make| *make == Make::Round).collect();
        Self { hard, rims, rounded, figure, origins, pieces, believed }
    }
}

/// How the surface at each face of a mesh came about, and which connected piece it is of: empty if there is but
/// one.
#[must_use]
pub fn origins_and_pieces(mesh: &Mesh) -> (Vec<Origin>, Vec<u32>) {
    let verdicts = verdicts(mesh, &Planes::new(mesh), false);
    (origins_in(&verdicts), pieces_in(&verdicts))
}

fn origins_in(verdicts: &[Verdict]) -> Vec<Origin> {
    verdicts.iter().map(|verdict| verdict.origin).collect()
}

fn pieces_in(verdicts: &[Verdict]) -> Vec<u32> {
    if verdicts.iter().all(|verdict| verdict.piece == 0) {
        return Vec::new();
    }
    verdicts.iter().map(|verdict| verdict.piece).collect()
}

/// Creases: every sharp edge of machined pieces; on round ones, whose faces turn at every edge, those over
/// which the file's normals turn as well, and chains that turn by more and stand out from what is around them.
fn hard_edges(mesh: &Mesh, verdicts: &[Verdict], crease_deg: f64) -> HardEdges {
    let is_round = |face: u32| verdicts[face as usize].make == Make::Round;
    let round = (0..verdicts.len() as u32).filter(|face| is_round(*face)).count();
    if round == 0 {
        return HardEdges::above(mesh, crease_deg);
    }
    let chains = HardEdges::find(mesh, (ROUND * crease_deg).min(180.0));
    if round == verdicts.len() && mesh.corner_normals.is_empty() {
        return chains;
    }
    let above = HardEdges::above(mesh, crease_deg);
    let least = cos(crease_deg.to_radians()) as f32;
    let shaded_sharp = |edge: usize, faces: [u32; 2]| {
        faces.iter().all(|face| verdicts[*face as usize].believed)
            && file_cosines(mesh, edge, faces).is_some_and(|[a, b]| a.min(b) < least)
    };
    HardEdges::of(mesh, |edge| match mesh.edges.faces(edge) {
        EdgeFaces::Two { faces, .. } if faces.iter().all(|face| is_round(*face)) => {
            chains.is_hard(edge) || (above.is_hard(edge) && shaded_sharp(edge, faces))
        }
        _ => above.is_hard(edge),
    })
}

/// Where flats and wide faces end.
fn rims(mesh: &Mesh, planes: &Planes, makes: &[Make]) -> EdgeSet {
    EdgeSet::collect(mesh.edges.len(), |edge| {
        let EdgeFaces::Two { faces, same_way } = mesh.edges.faces(edge) else { return false };
        let cosine = Dihedral::of(mesh, faces, same_way).cosine;
        if cosine > RIM_COSINE {
            return false;
        }
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

/// What is counted of one patch.
#[derive(Debug, Clone, Copy, Default)]
struct Count {
    edges: u32,
    flat: u32,
    coarse: u32,
    area: f64,
    in_flats: f64,
    in_long: f64,
    curvature: f64,
}

impl Count {
    fn is_free_form(&self) -> bool {
        self.edges >= LEAST_EDGES
            && f64::from(self.flat) <= MANY_FLAT * f64::from(self.edges)
            && f64::from(self.coarse) <= FEW_COARSE * f64::from(self.edges)
            && self.in_flats <= FEW_FLATS * self.area
            && self.in_long <= FEW_LONG * self.area
            && self.curvature >= FREE_FORM
    }
}

/// Whether the surface turns over an edge between two faces by more than a cosine says.
fn turns(mesh: &Mesh, edge: usize, cosine: f32) -> bool {
    match mesh.edges.faces(edge) {
        EdgeFaces::Two { faces, same_way } => Dihedral::of(mesh, faces, same_way).cosine < cosine,
        _ => false,
    }
}

/// Marks the faces of machined pieces that lie in patches that bend both ways.
fn add_free_forms(
    mesh: &Mesh,
    planes: &Planes,
    makes: &[Make],
    parts: impl Fn(usize) -> bool,
    rounded: &mut [bool],
) {
    let machined = |face: u32| makes[face as usize] == Make::Machined;
    let inner = |edge: usize| match mesh.edges.faces(edge) {
        EdgeFaces::Two { faces, same_way: false } if machined(faces[0]) && !parts(edge) => Some(faces),
        _ => None,
    };
    let patches = Groups::new(mesh.triangles.len(), |join| {
        for [a, b] in (0..mesh.edges.len()).filter_map(inner) {
            join(a, b);
        }
    });
    let mut counts = vec![Count::default(); mesh.triangles.len()];
    // The angles around each vertex, and whether a patch ends there.
    let mut angles = vec![0.0; mesh.positions.len()];
    let mut ends = vec![false; mesh.positions.len()];
    for edge in 0..mesh.edges.len() {
        match inner(edge) {
            Some([face, _]) => {
                let count = &mut counts[patches.of(face) as usize];
                count.edges += 1;
                count.flat += u32::from(planes.flat.contains(edge));
                count.coarse += u32::from(turns(mesh, edge, COARSE_COSINE));
            }
            None => mesh.edges.vertices[edge].iter().for_each(|v| ends[*v as usize] = true),
        }
    }
    for face in (0..mesh.triangles.len() as u32).filter(|face| machined(*face)) {
        let count = &mut counts[patches.of(face) as usize];
        let area = area(mesh, face);
        count.area += area;
        count.in_flats += if planes.of(face).is_some() { area } else { 0.0 };
        let corners = mesh.corners(FaceId(face));
        let longest = (0..3).map(|k| corners[k].distance_squared(corners[(k + 1) % 3])).fold(0.0, f64::max);
        count.in_long += if longest > LONG * 2.0 * area { area } else { 0.0 };
        for (k, vertex) in mesh.triangles[face as usize].iter().enumerate() {
            let [a, b] = [1, 2].map(|step| (corners[(k + step) % 3] - corners[k]).normalize_or_zero());
            angles[*vertex as usize] += acos(a.dot(b).clamp(-1.0, 1.0));
        }
    }
    let mut done = vec![false; mesh.positions.len()];
    for face in (0..mesh.triangles.len() as u32).filter(|face| machined(*face)) {
        for vertex in mesh.triangles[face as usize] {
            let vertex = vertex as usize;
            if !ends[vertex] && !std::mem::replace(&mut done[vertex], true) {
                let missing = (std::f64::consts::TAU - angles[vertex]).abs();
                counts[patches.of(face) as usize].curvature += (missing - ROUNDING).max(0.0);
            }
        }
    }
    for face in (0..mesh.triangles.len() as u32).filter(|face| machined(*face)) {
        rounded[face as usize] = counts[patches.of(face) as usize].is_free_form();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::function::sin;
    use crate::mesh::Soup;
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
