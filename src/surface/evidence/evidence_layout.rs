//! [`patches_by_evidence`]: the creases of a mesh, the borders between its surfaces, and which surfaces are
//! curved.
//!
//! 1. Where the normals of the file say something, edges are split, soft or neither.
//! 2. Split edges are creases. Elsewhere chains and single edges above the crease angle are, if they stand out
//!    from the noise around them; a soft edge counts half, except next to a bevel. On constructed parts, edges
//!    that only slivers cause are dropped, and shallow creases added.
//! 3. Surfaces between creases and other borders are curved if their normals vary, and fine enough.

use super::curved_faces::CurvedFaces;
use super::normal_evidence::NormalEvidence;
use crate::mesh::{DihedralCosines, EdgeFaces, EdgeSet, Mesh};
use crate::surface::creases::low_angle::shallow_creases::shallow_creases;
use crate::surface::normals::bevel_normals::BevelNormals;
use crate::surface::patches::patch_layout::{
    MAX_RIM_COSINE, MAX_STRIP_COSINE, classify, fillet_centres, width,
};
use crate::surface::patches::planar_regions::PlanarRegions;
use crate::surface::patches::surface_class::{ComponentClass, ComponentClasses, FileShading, MeshSource};
use crate::surface::tolerances::MIN_STRIP_WIDTH_RATIO;
use crate::surface::{HardEdges, Patches};

/// Share of its turn that a soft edge counts for, except next to a bevel.
const SOFT_TURN_SHARE: f32 = 0.5;

/// Classifies the surfaces of a mesh whose creases turn by more than `crease_deg` degrees, by evidence. With
/// `only_shaded`, figures and components that the file does not shade smoothly are classified by their
/// statistics.
#[must_use]
pub(crate) fn patches_by_evidence(mesh: &mut Mesh, crease_deg: f64, only_shaded: bool) -> Patches {
    let (turns, planes, classes) = classify(mesh, false);
    let of_mesh = (&turns, &planes, &classes);
    let (has_shaded, is_all_shaded) = classes.are_shaded();
    if only_shaded && !has_shaded {
        return Patches::by_statistics(mesh, of_mesh, crease_deg, false);
    }
    let evidence = by_evidence(mesh, of_mesh, crease_deg);
    if !only_shaded || is_all_shaded {
        return evidence;
    }
    let statistics = Patches::by_statistics(mesh, of_mesh, crease_deg, false);
    let is_shaded = classes.map(ComponentClass::is_shaded_part);
    combined(mesh, evidence, &statistics, is_shaded)
}

/// The results of evidence on the components whose faces are shaded, and of statistics on the others.
fn combined(mesh: &Mesh, evidence: Patches, statistics: &Patches, is_shaded: Vec<bool>) -> Patches {
    // All faces at an edge belong to one component.
    let is_shaded_at = |edge: usize| is_shaded[mesh.edges.faces(edge).list()[0] as usize];
    let edges = |of: fn(&Patches, usize) -> bool| {
        EdgeSet::collect(mesh.edges.len(), |edge| {
            of(if is_shaded_at(edge) { &evidence } else { statistics }, edge)
        })
    };
    let faces = |of: fn(&Patches) -> &Vec<bool>| {
        let (shaded, others) = (of(&evidence), of(statistics));
        (0..is_shaded.len()).map(|face| if is_shaded[face] { shaded[face] } else { others[face] }).collect()
    };
    Patches {
        hard: HardEdges::of(mesh, |edge| {
            (if is_shaded_at(edge) { &evidence } else { statistics }).hard.is_hard(edge)
        }),
        sliver_creases: edges(|patches, edge| patches.sliver_creases.contains(edge)),
        fillet_centres: edges(|patches, edge| patches.fillet_centres.contains(edge)),
        rims: edges(|patches, edge| patches.rims.contains(edge)),
        rounded: faces(|patches| &patches.rounded),
        figure: faces(|patches| &patches.figure),
        trusts_file_normals: faces(|patches| &patches.trusts_file_normals),
        by_evidence: is_shaded,
        ..evidence
    }
}

fn by_evidence(
    mesh: &mut Mesh,
    (turns, planes, classes): (&DihedralCosines, &PlanarRegions, &ComponentClasses),
    crease_deg: f64,
) -> Patches {
    let shading = |face: u32| classes.class_of_face(face).shading;
    let is_shaded = |face: u32| shading(face) == FileShading::Curved;
    let (bevels, bevel_edges) = BevelNormals::part(mesh, (turns, &planes.flat), crease_deg, is_shaded);
    let mesh = &*mesh;
    let evidence = NormalEvidence::new(mesh, turns, is_shaded);
    let is_soft = |edge: usize| evidence.soft.contains(edge) && !bevel_edges.contains(edge);
    let weight = |edge: usize| if is_soft(edge) { SOFT_TURN_SHARE } else { 1.0 };
    let (found, rims) = crate::parallel::join(
        || HardEdges::find_weighted(mesh, turns, crease_deg, (&evidence.split, weight)),
        || rims(mesh, turns, planes, (&evidence, classes)),
    );
    // The surface is given by its faces, and its lines are intended.
    let is_exact = |face: &u32| {
        let class = classes.class_of_face(*face);
        class.origin == MeshSource::Constructed && class.trusts_file_normals
    };
    let is_exact_at = |edge: usize| mesh.edges.faces(edge).list().iter().all(is_exact);
    let (found, sliver_creases) = found
        .without_slivers(mesh, turns, crease_deg, |edge| is_exact_at(edge) && !evidence.split.contains(edge));
    let may =
        |edge: usize| is_exact_at(edge) && !evidence.soft.contains(edge) && !sliver_creases.contains(edge);
    let (shallow, fillet_centres) = crate::parallel::join(
        || shallow_creases(mesh, (turns, &planes.flat), crease_deg, &found, may),
        || {
            let may = |edge: usize| is_exact_at(edge) && !sliver_creases.contains(edge);
            fillet_centres(mesh, (turns, planes), &found, may, crease_deg)
        },
    );
    let hard = found.with(mesh, &shallow);
    let curved = CurvedFaces { mesh, turns, planes, classes, evidence: &evidence, hard: &hard };
    let (rounded, rims) = curved.find(&rims.union(&sliver_creases), crease_deg);
    let trusts_file_normals = (0..mesh.triangles.len() as u32)
        .map(|face| match shading(face) {
            FileShading::Curved => evidence.is_believed(face),
            _ => classes.class_of_face(face).trusts_file_normals,
        })
        .collect();
    Patches {
        hard,
        sliver_creases,
        fillet_centres,
        rims,
        rounded,
        figure: classes.map(|class| class.origin != MeshSource::Constructed),
        origins: classes.map(|class| class.origin),
        pieces: classes.pieces(),
        trusts_file_normals,
        by_evidence: vec![true; mesh.triangles.len()],
        bevels,
    }
}

/// Borders of planar regions and of wide faces, on figures and where the file does not shade the surface.
fn rims(
    mesh: &Mesh,
    turns: &DihedralCosines,
    planes: &PlanarRegions,
    (evidence, classes): (&NormalEvidence, &ComponentClasses),
) -> EdgeSet {
    let is_of = |origin: MeshSource| move |face: &u32| classes.class_of_face(*face).origin == origin;
    EdgeSet::collect(mesh.edges.len(), |edge| {
        let cosine = turns.of_two(edge);
        if cosine > MAX_RIM_COSINE {
            return false;
        }
        let EdgeFaces::Two { faces, .. } = mesh.edges.faces(edge) else { return false };
        let is_believed = |face: &u32| evidence.is_believed(*face);
        if faces.iter().all(is_believed) && !faces.iter().all(is_of(MeshSource::Modelled)) {
            return false;
        }
        let [first, second] = faces.map(|face| planes.compact(face));
        if first != second {
            return true;
        }
        // Slivers next to wide faces are random on scans.
        cosine < MAX_STRIP_COSINE && !faces.iter().any(is_of(MeshSource::Scanned)) && {
            let [a, b] = faces.map(|face| width(mesh, edge, face));
            a.max(b) > MIN_STRIP_WIDTH_RATIO * a.min(b)
        }
    })
}
