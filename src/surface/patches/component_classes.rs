//! What the pieces of a model are meant to be: machined, round, or plain blocks; told by their flats,
//! by how their faces turn, and by the file's normals.
//!
//! A piece is what hangs together by its edges, so that a file may hold a scan beside a machined part.
//! Machined parts are made of planes and of strips that turn one way; scans and modelled figures turn
//! a little at almost every edge.

use std::collections::BTreeMap;
use std::ops::AddAssign;

use crate::parallel::prelude::*;
use glam::Vec3;

use super::group_sums::sums;
use super::normal_validation::{leaning, leans};
use super::planar_regions::{Planes, area};
use super::sliver_bends::{Slender, bends_over_its_ends, longest_side};
use super::surface_class::{Make, Origin, Verdict, Verdicts};
use crate::mesh::components::disjoint_sets::{Groups, Numbered};
use crate::mesh::{EdgeFaces, FirstEdges, Mesh, Turns};
use crate::parallel::task_size::GRAIN;

/// A piece is machined if flats hold this part of its surface, without normals and with them. Of 160 models looked at scans have 0 to
/// 6 %, machined parts 10 % and more but for those that other signs tell; figures that are shaded round have as much.
const MACHINED: f64 = 0.08;
const MACHINED_SHADED: f64 = 0.1;
/// Without normals it is as well if most of its surface lies in one plane with a neighbour, however small its fillets and dimples
/// are cut: of scans an eighth does, by chance.
const MOST: f64 = 0.5;
/// It is as well with more than this share of flat edges: strips that bend one way are halves of flat
/// quads.
const FEW_FLAT: f64 = 0.15;
/// The share of flat edges of machined pieces where the file has normals: then armour and tools are shaded
/// round over sharp edges, and their flats tell them from figures.
const FEW_FLAT_SHADED: f64 = 0.08;
/// The cosine below which an edge counts as sharp: 60 degrees.
const SHARP_COSINE: f32 = 0.5;
/// A file that shades a piece smooth over more than this share of sharp edges means it to be seen with a
/// picture of its bumps: its normals are not those of its shape.
const SHARP_SHADED: f64 = 0.1;
/// Coarse figures turn sharply at many edges; with as many edges as this a shape needs no shading to be told.
const DENSE: u32 = 2000;
/// The cosine above which an edge is nearly flat: a degree, ten times as much as a flat edge may turn. Where turns are noise, a
/// tenth of the nearly flat edges are flat by chance.
const NEARLY_FLAT_COSINE: f32 = 0.999_847_7;
/// A piece with more than that share of sharp edges, without normals, is machined if so many times as many of its edges are
/// flat as are by chance: then flats were meant. Scans that are simplified until they are as sharp have what chance gives.
const MEANT: f64 = 2.0;
const BY_CHANCE: f64 = 0.1;
/// Unless it is dense, flats must hold this part of it as well: coarse figures have a few level quads, of two faces each. Or
/// more than this share of its nearly flat edges are flat: of those of figures a third are.
const SOME_FLATS: f64 = 0.02;
const SURELY_MEANT: f64 = 0.5;
/// Flats that were meant tell it with more than this share of sharp edges: of scans that have such flats, as what they were cut off
/// to stand on, no more than one edge in a hundred is sharp.
const SHARP_BESIDE_FLATS: f64 = 0.05;
/// Areas are as large as each other but for rounding: how sums are rounded depends on the order of faces.
const AS_LARGE: f64 = 1.0 - 1e-9;
/// What has fewer sharp edges than this share is round whatever it stands beside, such as the spout of a pot.
const HARDLY_SHARP: f64 = 0.01;
/// What has no more flat edges than these many times as many as by chance, and is dense, is a scan in any case.
const BY_CHANCE_AT_MOST: f64 = 1.5;
/// Where more than three of eight edges are sharp, nothing round is meant, at least without normals: figures have a sharp edge
/// in six, the hair of coarse ones in four.
const MOSTLY_SHARP: f64 = 0.375;
/// What goes for a scan is machined if more than this part of its faces' lengths bends over an end of a slender face. Of 300 models looked
/// at scans and figures have a hundredth at most, a teapot two for the points of its lids; hulls and tessellated fillets four and more.
/// A few long faces alone say nothing: more than one short side in a hundred bends.
const BENT: f64 = 0.03;
const FEW_BENDS: f64 = 0.01;
/// Fewer edges than this are no statistics: such a group is a block or a plate.
pub(crate) const LEAST_EDGES: u32 = 60;
/// The cosine above which a corner's normal is that of its face.
const OWN_NORMAL_COSINE: f32 = 0.9999;
/// A file whose normals say of fewer faces than this share that they are curved means them flat.
const FEW_CURVED: f64 = 0.05;

/// The cosine (80 degrees) below which a corner's normal has nothing to do with its face, and the share of
/// such faces with which a file's normals are wrong for the whole piece.
const ASTRAY_COSINE: f32 = 0.17;
const FEW_ASTRAY: f64 = 0.1;

/// And with more than this share of faces from which all normals lean by more than the surface turns. Of 98 models looked at,
/// pieces with the normals of their shape have 0.18 at most; pieces that were turned or bent without them 0.21 and more.
const MANY_LEAN: f64 = 0.2;

/// What is counted of one piece.
#[derive(Debug, Clone, Copy, Default)]
struct Count {
    faces: FaceCount,
    edges: EdgeCount,
    bends: Bends,
    /// Faces from which all normals of the file lean by more than the surface turns; counted where many lean.
    leans: u32,
}

/// What is counted of its faces.
#[derive(Debug, Clone, Copy, Default)]
struct FaceCount {
    all: u32,
    curved: u32,
    with_normals: u32,
    astray: u32,
    /// Faces from which all normals of the file lean.
    leaning: u32,
    area: f64,
    in_flats: f64,
    level: f64,
    /// The longest sides of all faces, and of those that are slender.
    longest: f64,
    slender: f64,
}

/// What is counted of its edges between two faces with area.
#[derive(Debug, Clone, Copy, Default)]
struct EdgeCount {
    all: u32,
    flat: u32,
    nearly_flat: u32,
    sharp: u32,
}

/// The short sides over which slender faces bend, and the longest sides of these faces, once for each.
#[derive(Debug, Clone, Copy, Default)]
struct Bends {
    all: u32,
    longest: f64,
}

impl AddAssign<&Count> for Count {
    fn add_assign(&mut self, other: &Self) {
        self.faces += &other.faces;
        self.edges += &other.edges;
        self.bends += &other.bends;
        self.leans += other.leans;
    }
}

impl AddAssign<&FaceCount> for FaceCount {
    #[inline]
    fn add_assign(&mut self, other: &Self) {
        self.all += other.all;
        self.curved += other.curved;
        self.with_normals += other.with_normals;
        self.astray += other.astray;
        self.leaning += other.leaning;
        self.area += other.area;
        self.in_flats += other.in_flats;
        self.level += other.level;
        self.longest += other.longest;
        self.slender += other.slender;
    }
}

impl AddAssign<&EdgeCount> for EdgeCount {
    #[inline]
    fn add_assign(&mut self, other: &Self) {
        self.all += other.all;
        self.flat += other.flat;
        self.nearly_flat += other.nearly_flat;
        self.sharp += other.sharp;
    }
}

impl AddAssign<&Bends> for Bends {
    #[inline]
    fn add_assign(&mut self, other: &Self) {
        self.all += other.all;
        self.longest += other.longest;
    }
}

impl Count {
    /// With `all`, nothing is a block.
    fn verdict(&self, all: bool) -> Verdict {
        let Self { faces, edges, .. } = self;
        let share = |of: u32, all: u32| f64::from(of) / f64::from(all.max(1));
        let faceted = faces.with_normals == faces.all && share(faces.curved, faces.all) < FEW_CURVED;
        let shaded = share(faces.with_normals, faces.all) > 0.5 && !faceted;
        let bare = !shaded && !faceted;
        let few = if shaded { FEW_FLAT_SHADED } else { FEW_FLAT };
        let pointed = share(edges.sharp, edges.all) > SHARP_SHADED;
        let edged = edges.all >= DENSE && pointed;
        let armoured = shaded && edged;
        let meant = f64::from(edges.flat) > MEANT * BY_CHANCE * f64::from(edges.nearly_flat);
        let some_flats = faces.in_flats > SOME_FLATS * faces.area;
        let surely = f64::from(edges.flat) > SURELY_MEANT * f64::from(edges.nearly_flat);
        let has_corners = share(edges.sharp, edges.all) > SHARP_BESIDE_FLATS;
        let cornered = (has_corners && meant && (some_flats || surely))
            || faces.level > MOST * faces.area
            || share(edges.sharp, edges.all) > MOSTLY_SHARP;
        let machined = armoured
            || (!shaded && edged && meant)
            || (bare && cornered)
            || faces.in_flats >= if bare { MACHINED } else { MACHINED_SHADED } * faces.area
            || share(edges.flat, edges.all) > few;
        let shape = if machined { Make::Machined } else { Make::Round };
        let plain = faceted || edges.all < LEAST_EDGES;
        // Faces that a file means flat are drawn so, but light falls on what they stand for.
        // Where all is asked to be round, the angles of a machined piece say where it is not.
        let astray = share(faces.astray, faces.all) >= FEW_ASTRAY;
        let as_planes = faceted && shape == Make::Round;
        let leans = share(self.leans, faces.all) > MANY_LEAN;
        let believed = !(astray || leans || armoured || as_planes || (all && machined));
        let make = if plain && !all { Make::Block } else { shape };
        let origin = match (make, shaded) {
            (Make::Round, false) => Origin::Scanned,
            (Make::Round, true) => Origin::Modelled,
            _ => Origin::Constructed,
        };
        Verdict { make, origin, believed }
    }

    /// Whether it stays round whatever it stands beside: it has hardly a crease to lose, or many edges of which no more are
    /// flat than by chance.
    fn stays_round(&self) -> bool {
        let EdgeCount { all, flat, nearly_flat, sharp } = self.edges;
        let by_chance = BY_CHANCE * f64::from(nearly_flat);
        f64::from(sharp) < HARDLY_SHARP * f64::from(all)
            || (all >= DENSE && f64::from(flat) <= BY_CHANCE_AT_MOST * by_chance)
    }
}

/// The connected pieces of a mesh. Needs nothing but its edges, so that it can be done beside all else.
pub(crate) fn pieces(mesh: &Mesh) -> Numbered {
    let groups = Groups::new(mesh.triangles.len(), |join| {
        (0..mesh.edges.len()).into_par_iter().with_min_len(GRAIN).for_each(|edge| {
            let list = mesh.edges.faces(edge);
            for pair in list.list().windows(2) {
                join(pair[0], pair[1]);
            }
        });
    });
    groups.numbered(|_| None)
}

/// What each face belongs to, with `all` as if all of it were meant to be round. Pieces too small for
/// statistics are judged together with those of their body and material; what goes for a scan may follow the largest of these.
pub(crate) fn verdicts(
    mesh: &Mesh,
    turns: &Turns,
    (planes, pieces): (&Planes, Numbered),
    all: bool,
) -> Verdicts {
    let faces = mesh.triangles.len();
    let Numbered { of_face: number, first } = &pieces;
    let (of_faces, of_edges): (Vec<FaceCount>, Vec<EdgeCount>) = crate::parallel::join(
        || sums(first.len(), faces, |face| Some((number[face], of_face(mesh, planes, face as u32)))),
        || {
            sums(first.len(), mesh.edges.len(), |edge| {
                let (face, count) = of_edge(mesh, turns, planes, edge)?;
                Some((number[face as usize], count))
            })
        },
    );
    let both = |(faces, edges)| Count { faces, edges, ..Count::default() };
    let mut counts: Vec<Count> = of_faces.into_iter().zip(of_edges).map(both).collect();
    count_leaning(mesh, turns, number, &mut counts);
    let key = |face: u32| (mesh.body(face), mesh.face_material[face as usize]);
    let mut together: BTreeMap<_, Count> = BTreeMap::new();
    for (face, count) in first.iter().zip(&counts).filter(|(_, count)| count.edges.all < LEAST_EDGES) {
        *together.entry(key(*face)).or_default() += count;
    }
    let verdict = |(face, count): (&u32, &Count)| {
        let is_small = count.edges.all < LEAST_EDGES;
        let judged = if is_small { together.get(&key(*face)).unwrap_or(count) } else { count };
        judged.verdict(all)
    };
    let mut verdicts: Vec<Verdict> = first.iter().zip(&counts).map(verdict).collect();
    tessellated(mesh, turns, number, &mut counts, &mut verdicts);
    follow_largest(first.iter().map(|face| key(*face)), &counts, &mut verdicts);
    Verdicts::new(verdicts, pieces)
}

/// Counts the faces from which all normals of the file lean by more than the surface turns, in pieces where many lean at all.
fn count_leaning(mesh: &Mesh, turns: &Turns, pieces: &[u32], counts: &mut [Count]) {
    let many = |count: &Count| f64::from(count.faces.leaning) > MANY_LEAN * f64::from(count.faces.all);
    let asked: Vec<bool> = counts.iter().map(many).collect();
    if !asked.contains(&true) {
        return;
    }
    let edges = FirstEdges::of(&mesh.edges, mesh.positions.len());
    let lean: Vec<u32> = sums(counts.len(), mesh.triangles.len(), |face| {
        let piece = pieces[face];
        let cosine = asked[piece as usize].then(|| leaning_at(mesh, face as u32))??;
        Some((piece, u32::from(leans(mesh, (turns, &edges), face as u32, cosine))))
    });
    counts.iter_mut().zip(lean).for_each(|(count, lean)| count.leans = lean);
}

/// What goes for a scan is machined where too much of it is faces that are long across its bends: no surface is sampled so.
fn tessellated(mesh: &Mesh, turns: &Turns, pieces: &[u32], counts: &mut [Count], verdicts: &mut [Verdict]) {
    // As much may bend as is slender, over both ends.
    let asked: Vec<bool> = verdicts
        .iter()
        .zip(&*counts)
        .map(|(verdict, count)| {
            verdict.origin == Origin::Scanned
                && count.edges.all >= LEAST_EDGES
                && count.faces.slender > BENT * count.faces.longest
        })
        .collect();
    if !asked.contains(&true) {
        return;
    }
    let edges = FirstEdges::of(&mesh.edges, mesh.positions.len());
    let bends: Vec<Bends> = sums(counts.len(), mesh.triangles.len(), |face| {
        let piece = pieces[face];
        let slender = asked[piece as usize].then(|| Slender::of(mesh, face as u32))??;
        let all = bends_over_its_ends(mesh, (turns, &edges), face as u32, slender);
        Some((piece, Bends { all, longest: f64::from(all) * slender.length }))
    });
    counts.iter_mut().zip(bends).for_each(|(count, bends)| count.bends = bends);
    for (verdict, count) in verdicts.iter_mut().zip(&*counts) {
        let Count { faces, bends, .. } = count;
        let are_many = f64::from(bends.all) > FEW_BENDS * 2.0 * f64::from(faces.all);
        if are_many && bends.longest > BENT * 2.0 * faces.longest {
            (verdict.make, verdict.origin) = (Make::Machined, Origin::Constructed);
        }
    }
}

/// What goes for a scan is machined where the largest piece of its `kin` is, unless it is round for sure. Of a part and a
/// material, most is made in one way, and a small piece by itself says less of that than a large one.
fn follow_largest<K: Ord>(kin: impl Iterator<Item = K> + Clone, counts: &[Count], verdicts: &mut [Verdict]) {
    // How large the largest piece is that is not machined, and the largest that is.
    let mut largest: BTreeMap<K, [f64; 2]> = BTreeMap::new();
    for (kin, (count, verdict)) in kin.clone().zip(counts.iter().zip(&*verdicts)) {
        let most = &mut largest.entry(kin).or_default()[usize::from(verdict.make == Make::Machined)];
        *most = most.max(count.faces.area);
    }
    for (kin, (count, verdict)) in kin.zip(counts.iter().zip(verdicts)) {
        let [other, machined] = largest.get(&kin).copied().unwrap_or_default();
        let follows = machined > 0.0 && machined >= other * AS_LARGE;
        if verdict.origin == Origin::Scanned && follows && !count.stays_round() {
            (verdict.make, verdict.origin) = (Make::Machined, Origin::Constructed);
        }
    }
}

/// What is counted of an edge between two faces with area, and one of them.
#[inline]
fn of_edge(mesh: &Mesh, turns: &Turns, planes: &Planes, edge: usize) -> Option<(u32, EdgeCount)> {
    let cosine = turns.of_two(edge);
    let EdgeFaces::Two { faces, .. } = mesh.edges.faces(edge) else { return None };
    // Beside a face without area the cosine is zero.
    if cosine == 0.0 && faces.iter().any(|f| mesh.face_normals[*f as usize] == [0.0; 3]) {
        return None;
    }
    let flat = u32::from(planes.flat.contains(edge));
    let nearly_flat = u32::from(cosine > NEARLY_FLAT_COSINE);
    let sharp = u32::from(cosine < SHARP_COSINE);
    Some((faces[0], EdgeCount { all: 1, flat, nearly_flat, sharp }))
}

#[inline]
fn of_face(mesh: &Mesh, planes: &Planes, face: u32) -> FaceCount {
    let area = area(mesh, face);
    let in_flats = if planes.of(face).is_some() { area } else { 0.0 };
    let level = if planes.is_level(face) { area } else { 0.0 };
    let longest = longest_side(mesh, face);
    let slender = if Slender::is(area, longest) { longest } else { 0.0 };
    let mut count = FaceCount { all: 1, area, in_flats, level, longest, slender, ..FaceCount::default() };
    if let Some(ids) = mesh.corner_normals.get(face as usize) {
        let own = Vec3::from_array(mesh.face_normals[face as usize]);
        let normals = ids.map(|id| mesh.normals.get(id as usize));
        let leaves = |n: &[f32; 3]| Vec3::from_array(*n).dot(own).abs() < OWN_NORMAL_COSINE;
        count.with_normals = u32::from(normals.iter().all(Option::is_some));
        count.curved = u32::from(normals.iter().flatten().any(|n| leaves(n)));
        let strays = |n: &[f32; 3]| Vec3::from_array(*n).dot(own).abs() < ASTRAY_COSINE;
        count.astray = u32::from(normals.iter().flatten().any(|n| strays(n)));
        count.leaning = u32::from(leaning(own, normals).is_some());
    }
    count
}

/// How far all normals of the file lean from a face, if they do.
fn leaning_at(mesh: &Mesh, face: u32) -> Option<f32> {
    let ids = mesh.corner_normals.get(face as usize)?;
    leaning(Vec3::from_array(mesh.face_normals[face as usize]), ids.map(|id| mesh.normals.get(id as usize)))
}
