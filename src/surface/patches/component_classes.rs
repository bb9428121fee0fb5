//! Classes of the connected components of a mesh: machined, round or faceted.
//!
//! Components are connected by edges, so that a scan and a machined part in one file are classified
//! separately. Machined parts consist of planes and of strips that bend one way. Scans and modelled figures
//! turn a little at almost every edge. The decision uses planar area, the distribution of edge angles, and
//! the normals of the file.

use std::collections::BTreeMap;

use crate::geometry::lists::disjoint_sets::{DisjointSets, NumberedSets};
use crate::parallel::prelude::*;

use super::component_stats::{
    ComponentStats, EdgeStats, FaceStats, SliverBends, leaning_at, of_edge, of_face,
};
use super::normal_validation::leans;
use super::planar_regions::PlanarRegions;
use super::sliver_bends::{SliverFace, bent_short_sides};
use super::surface_class::{ComponentClass, ComponentClasses, FileShading, MeshSource, SurfaceClass};
use crate::geometry::lists::group_sums::sums;
use crate::mesh::{DihedralCosines, Mesh, VertexEdges};
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::surface::tolerances;

/// Minimum share of planar area for a machined component, without and with normals in the file. Measured on
/// 160 models: scans have 0 to 6 %, most machined parts 10 % and more. Figures that are shaded round have
/// similar shares.
const MIN_PLANAR_AREA_UNSHADED: f64 = 0.08;
const MIN_PLANAR_AREA_SHADED: f64 = 0.1;
/// Without normals, a component is also machined if more than this share of its area is coplanar with a
/// neighbouring face. Fillets and dimples of any size do not matter. Noise gives scans an eighth.
const MIN_LEVEL_AREA: f64 = 0.5;
/// Without normals, a component is also machined above this share of flat edges. Strips that bend one way are
/// halves of flat quads.
const MIN_FLAT_EDGES_UNSHADED: f64 = 0.15;
/// The same share with normals. Armour and tools that are shaded round over sharp edges are distinguished
/// from figures by their planar regions.
const MIN_FLAT_EDGES_SHADED: f64 = 0.08;
/// Maximum share of sharp edges for which smooth shading describes the shape. Above it, the normals are
/// intended for use with a bump map.
const MAX_SHARP_EDGES_SHADED: f64 = 0.1;
/// Minimum number of edges for a dense component, which is classified without shading. Coarse figures turn
/// sharply at many edges.
const MIN_DENSE_EDGES: u32 = 2000;
/// A component with many sharp edges and no normals is machined if flat edges are more than this many times
/// as common as noise would make them. Decimated scans with as many sharp edges match the noise.
const MIN_FLAT_OF_NOISE: f64 = 2.0;
const FLAT_OF_NEARLY_FLAT_NOISE: f64 = 0.1;
/// Components that are not dense also need this share of planar area, since coarse figures have a few flat
/// quads. Alternatively more than the second share of their nearly flat edges must be flat. Figures have a
/// third.
const MIN_SOME_PLANAR_AREA: f64 = 0.02;
const MIN_FLAT_OF_NEARLY_FLAT: f64 = 0.5;
/// Minimum share of sharp edges for flat edges to count as intended. Scans with planar regions, such as a cut
/// base, have at most 1 %.
const MIN_SHARP_EDGES_WITH_FLATS: f64 = 0.05;
/// Maximum share of sharp edges of a component that stays round next to machined ones, such as the spout of a
/// pot.
const MAX_SHARP_EDGES_ROUND: f64 = 0.01;
/// Maximum ratio of flat edges to those expected from noise, for a dense component that stays a scan in any
/// case.
const MAX_FLAT_OF_NOISE: f64 = 1.5;
/// Minimum share of sharp edges that makes a component without normals machined. Figures have a sharp edge in
/// six, coarse hair one in four.
const MIN_SHARP_EDGES_MACHINED: f64 = 0.375;
/// A scan is reclassified as machined if slivers bend over their ends along more than this share of the
/// length of its faces, and at more than the second share of its short sides.
///
/// Measured on 300 models: scans and figures have at most 1 %, a teapot 2 % (the tips of its lids), hulls and
/// tessellated fillets 4 % and more. The second limit excludes components with a few long faces.
const MIN_SLIVER_BEND_LENGTH: f64 = 0.03;
const MIN_SLIVER_BEND_SIDES: f64 = 0.01;
/// Minimum number of edges for statistics. A smaller group is a block or a plate.
pub(crate) const MIN_SAMPLE_EDGES: u32 = 60;
/// Minimum share of curved faces, by the normals of the file. Below it the component is intended to be
/// faceted.
const MIN_CURVED_FACES: f64 = 0.05;

/// Minimum share of faces with a corner normal that contradicts them, for which the normals of the whole
/// component are rejected.
const MIN_ASTRAY_FACES: f64 = 0.1;

/// Maximum share of faces whose normals all deviate by more than the surface turns. Above it the normals are
/// rejected. Measured on 98 models: at most 0.18 with correct normals, 0.21 and more after the shape was
/// turned or bent without them.
const MAX_LEANING_FACES: f64 = 0.2;

impl ComponentStats {
    /// Classifies the component. With `all`, no component is faceted.
    fn classify(&self, all: bool) -> ComponentClass {
        let Self { faces, edges, .. } = self;
        let share = |of: u32, all: u32| f64::from(of) / f64::from(all.max(1));
        let faceted = faces.with_normals == faces.all && share(faces.curved, faces.all) < MIN_CURVED_FACES;
        let shaded = share(faces.with_normals, faces.all) > 0.5 && !faceted;
        let bare = !shaded && !faceted;
        let few = if shaded { MIN_FLAT_EDGES_SHADED } else { MIN_FLAT_EDGES_UNSHADED };
        let pointed = share(edges.sharp, edges.all) > MAX_SHARP_EDGES_SHADED;
        let edged = edges.all >= MIN_DENSE_EDGES && pointed;
        let armoured = shaded && edged;
        let meant = f64::from(edges.flat)
            > MIN_FLAT_OF_NOISE * FLAT_OF_NEARLY_FLAT_NOISE * f64::from(edges.nearly_flat);
        let some_flats = faces.in_flats > MIN_SOME_PLANAR_AREA * faces.area;
        let surely = f64::from(edges.flat) > MIN_FLAT_OF_NEARLY_FLAT * f64::from(edges.nearly_flat);
        let has_corners = share(edges.sharp, edges.all) > MIN_SHARP_EDGES_WITH_FLATS;
        let cornered = (has_corners && meant && (some_flats || surely))
            || faces.level > MIN_LEVEL_AREA * faces.area
            || share(edges.sharp, edges.all) > MIN_SHARP_EDGES_MACHINED;
        let machined = armoured
            || (!shaded && edged && meant)
            || (bare && cornered)
            || faces.in_flats
                >= if bare { MIN_PLANAR_AREA_UNSHADED } else { MIN_PLANAR_AREA_SHADED } * faces.area
            || share(edges.flat, edges.all) > few;
        let shape = if machined { SurfaceClass::Machined } else { SurfaceClass::Round };
        let plain = faceted || edges.all < MIN_SAMPLE_EDGES;
        // Faceted components are drawn with their faces, but shaded as the round surface they approximate. If
        // all surfaces are to be round, the angles of a machined component show where it is not.
        let astray = share(faces.contradicting, faces.all) >= MIN_ASTRAY_FACES;
        let as_planes = faceted && shape == SurfaceClass::Round;
        let leans = share(self.deviating_faces, faces.all) > MAX_LEANING_FACES;
        let believed = !(astray || leans || armoured || as_planes || (all && machined));
        let make = if plain && !all { SurfaceClass::Faceted } else { shape };
        let origin = match (make, shaded) {
            (SurfaceClass::Round, false) => MeshSource::Scanned,
            (SurfaceClass::Round, true) => MeshSource::Modelled,
            _ => MeshSource::Constructed,
        };
        let shading = match (faces.with_normals == faces.all, faceted) {
            (true, true) => FileShading::Faceted,
            (true, false) if !astray && !leans => FileShading::Curved,
            _ => FileShading::None,
        };
        ComponentClass { make, origin, trusts_file_normals: believed, shading }
    }

    /// Whether the component stays round next to machined ones: it has almost no sharp edges, or many edges
    /// with no more flat ones than noise explains.
    fn is_always_round(&self) -> bool {
        let EdgeStats { all, flat, nearly_flat, sharp } = self.edges;
        let by_chance = FLAT_OF_NEARLY_FLAT_NOISE * f64::from(nearly_flat);
        f64::from(sharp) < MAX_SHARP_EDGES_ROUND * f64::from(all)
            || (all >= MIN_DENSE_EDGES && f64::from(flat) <= MAX_FLAT_OF_NOISE * by_chance)
    }
}

/// The connected components of a mesh. Depends on its edges only, so that it can run in parallel with other
/// steps.
pub(crate) fn pieces(mesh: &Mesh) -> NumberedSets {
    let groups = DisjointSets::new(mesh.triangles.len(), |join| {
        (0..mesh.edges.len()).into_par_iter().with_min_len(MIN_TASK_ITEMS).for_each(|edge| {
            let list = mesh.edges.faces(edge);
            for pair in list.list().windows(2) {
                join(pair[0], pair[1]);
            }
        });
    });
    groups.numbered(|_| None)
}

/// Classifies the component of each face; with `all`, as if every surface were to be round.
///
/// Components too small for statistics are classified together with those of the same body and material.
/// Scans may take the class of the largest component among these.
pub(crate) fn classify_components(
    mesh: &Mesh,
    turns: &DihedralCosines,
    (planes, pieces): (&PlanarRegions, NumberedSets),
    all: bool,
) -> ComponentClasses {
    let faces = mesh.triangles.len();
    let NumberedSets { set_of_face: number, first } = &pieces;
    let (of_faces, of_edges): (Vec<FaceStats>, Vec<EdgeStats>) = crate::parallel::join(
        || sums(first.len(), faces, |face| Some((number[face], of_face(mesh, planes, face as u32)))),
        || {
            sums(first.len(), mesh.edges.len(), |edge| {
                let (face, count) = of_edge(mesh, turns, planes, edge)?;
                Some((number[face as usize], count))
            })
        },
    );
    let both = |(faces, edges)| ComponentStats { faces, edges, ..ComponentStats::default() };
    let mut counts: Vec<ComponentStats> = of_faces.into_iter().zip(of_edges).map(both).collect();
    count_leaning(mesh, turns, number, &mut counts);
    let key = |face: u32| (mesh.body(face), mesh.face_material[face as usize]);
    let mut together: BTreeMap<_, ComponentStats> = BTreeMap::new();
    for (face, count) in first.iter().zip(&counts).filter(|(_, count)| count.edges.all < MIN_SAMPLE_EDGES) {
        *together.entry(key(*face)).or_default() += count;
    }
    let verdict = |(face, count): (&u32, &ComponentStats)| {
        let is_small = count.edges.all < MIN_SAMPLE_EDGES;
        let judged = if is_small { together.get(&key(*face)).unwrap_or(count) } else { count };
        judged.classify(all)
    };
    let mut verdicts: Vec<ComponentClass> = first.iter().zip(&counts).map(verdict).collect();
    reclassify_tessellated(mesh, turns, number, &mut counts, &mut verdicts);
    follow_largest(first.iter().map(|face| key(*face)), &counts, &mut verdicts);
    ComponentClasses::new(verdicts, pieces)
}

/// Counts the faces whose normals all deviate by more than the surface turns, in components where many
/// deviate.
fn count_leaning(mesh: &Mesh, turns: &DihedralCosines, pieces: &[u32], counts: &mut [ComponentStats]) {
    let many = |count: &ComponentStats| {
        f64::from(count.faces.deviating) > MAX_LEANING_FACES * f64::from(count.faces.all)
    };
    let asked: Vec<bool> = counts.iter().map(many).collect();
    if !asked.contains(&true) {
        return;
    }
    let edges = VertexEdges::of(&mesh.edges, mesh.positions.len());
    let lean: Vec<u32> = sums(counts.len(), mesh.triangles.len(), |face| {
        let piece = pieces[face];
        let cosine = asked[piece as usize].then(|| leaning_at(mesh, face as u32))??;
        Some((piece, u32::from(leans(mesh, (turns, &edges), face as u32, cosine))))
    });
    counts.iter_mut().zip(lean).for_each(|(count, lean)| count.deviating_faces = lean);
}

/// Reclassifies scans as machined if too many of their faces are long across bends. No surface is sampled in
/// this way.
fn reclassify_tessellated(
    mesh: &Mesh,
    turns: &DihedralCosines,
    pieces: &[u32],
    counts: &mut [ComponentStats],
    verdicts: &mut [ComponentClass],
) {
    // Upper bound: every sliver bends over both ends.
    let asked: Vec<bool> = verdicts
        .iter()
        .zip(&*counts)
        .map(|(verdict, count)| {
            verdict.origin == MeshSource::Scanned
                && count.edges.all >= MIN_SAMPLE_EDGES
                && count.faces.sliver_length > MIN_SLIVER_BEND_LENGTH * count.faces.longest
        })
        .collect();
    if !asked.contains(&true) {
        return;
    }
    let edges = VertexEdges::of(&mesh.edges, mesh.positions.len());
    let bends: Vec<SliverBends> = sums(counts.len(), mesh.triangles.len(), |face| {
        let piece = pieces[face];
        let slender = asked[piece as usize].then(|| SliverFace::of(mesh, face as u32))??;
        let all = bent_short_sides(mesh, (turns, &edges), face as u32, slender);
        Some((piece, SliverBends { all, longest: f64::from(all) * slender.length }))
    });
    counts.iter_mut().zip(bends).for_each(|(count, bends)| count.bends = bends);
    for (verdict, count) in verdicts.iter_mut().zip(&*counts) {
        let ComponentStats { faces, bends, .. } = count;
        let are_many = f64::from(bends.all) > MIN_SLIVER_BEND_SIDES * 2.0 * f64::from(faces.all);
        if are_many && bends.longest > MIN_SLIVER_BEND_LENGTH * 2.0 * faces.longest {
            (verdict.make, verdict.origin) = (SurfaceClass::Machined, MeshSource::Constructed);
        }
    }
}

/// Reclassifies scans as machined where the largest component with the same key is machined, unless they are
/// clearly round. Most of a part and material is made in one way, and a large component shows it better than
/// a small one.
fn follow_largest<K: Ord>(
    kin: impl Iterator<Item = K> + Clone,
    counts: &[ComponentStats],
    verdicts: &mut [ComponentClass],
) {
    // Areas of the largest component that is not machined, and of the largest that is.
    let mut largest: BTreeMap<K, [f64; 2]> = BTreeMap::new();
    for (kin, (count, verdict)) in kin.clone().zip(counts.iter().zip(&*verdicts)) {
        let most = &mut largest.entry(kin).or_default()[usize::from(verdict.make == SurfaceClass::Machined)];
        *most = most.max(count.faces.area);
    }
    for (kin, (count, verdict)) in kin.zip(counts.iter().zip(verdicts)) {
        let [other, machined] = largest.get(&kin).copied().unwrap_or_default();
        let follows = machined > 0.0 && machined >= other * tolerances::AREA_ROUNDING_FACTOR;
        if verdict.origin == MeshSource::Scanned && follows && !count.is_always_round() {
            (verdict.make, verdict.origin) = (SurfaceClass::Machined, MeshSource::Constructed);
        }
    }
}
