//! [`Patches`]: the creases of a mesh, the borders between its surfaces, and which surfaces are curved.
//!
//! Planes, cylinders and cones are drawn as their faces are: a surface that bends one way has contours along
//! its edges only. Surfaces that bend both ways are rounded. These are scans and figures, except at their
//! creases, and on machined parts the patches between hard edges with curvature inside.

use super::component_classes::{classify_components, pieces};
use super::curved_patches::add_curved_patches;
use super::planar_regions::PlanarRegions;
use super::surface_class::{ComponentClasses, MeshSource, SurfaceClass};
use crate::geometry::numbers::portable_math::cos;
use crate::mesh::EdgeSet;
use crate::mesh::{DihedralCosines, EdgeFaces, FaceId, Mesh};
use crate::surface::HardEdges;
use crate::surface::creases::hard_edges::LOW_THRESHOLD_OF_HIGH;
use crate::surface::creases::low_angle::narrow_fillets::narrow_fillets;
use crate::surface::creases::low_angle::shallow_creases::{shallow_creases, shallow_edges};
use crate::surface::creases::low_angle::surface_trace::SurfaceTracer;
use crate::surface::normals::bevel_normals::BevelNormals;
use crate::surface::normals::file_normals::file_cosines;
use crate::surface::tolerances::MIN_STRIP_WIDTH_RATIO;

/// Factor on the crease angle for round components.
const ROUND_CREASE_FACTOR: f64 = 1.5;

/// Cosine (10 degrees) below which the outline of a planar region separates it from its surroundings.
pub(crate) const MAX_RIM_COSINE: f32 = 0.985;
/// Cosine (20 degrees) below which a strip is separated from a wider face.
pub(crate) const MAX_STRIP_COSINE: f32 = 0.94;

/// Classification of the surfaces of a mesh.
#[derive(Debug, Clone, Default)]
pub(crate) struct Patches {
    /// Edges drawn as creases.
    pub hard: HardEdges,
    /// Sharp edges of machined parts that are no creases because only a sliver causes them. They separate
    /// surfaces.
    pub sliver_creases: EdgeSet,
    /// Centre edges of narrow fillets. They are drawn as creases, but the surface continues across them.
    pub fillet_centres: EdgeSet,
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
    pub trusts_file_normals: Vec<bool>,
    /// Whether each face was decided by evidence, or empty if none was. There `hard` and `rims` are all borders of
    /// curved surfaces, so that the normals of the file add none.
    pub by_evidence: Vec<bool>,
    /// Normals of the mesh that were not in the file.
    pub bevels: BevelNormals,
}

impl Patches {
    /// Classifies a mesh whose creases turn by more than `crease_deg` degrees. With `all`, every face counts
    /// as curved, and only the edges between surfaces are sought.
    #[must_use]
    pub(crate) fn new(mesh: &Mesh, crease_deg: f64, all: bool) -> Self {
        let (turns, planes, verdicts) = classify(mesh, all);
        Self::by_statistics(mesh, (&turns, &planes, &verdicts), crease_deg, all)
    }

    /// Same, with the results of [`classify`].
    pub(crate) fn by_statistics(
        mesh: &Mesh,
        (turns, planes, verdicts): (&DihedralCosines, &PlanarRegions, &ComponentClasses),
        crease_deg: f64,
        all: bool,
    ) -> Self {
        let believed = verdicts.map(|verdict| verdict.trusts_file_normals);
        let makes = verdicts.map(|verdict| verdict.make);
        let ((hard, wrinkles), rims) = crate::parallel::join(
            || hard_edges(mesh, turns, verdicts, crease_deg),
            || rims(mesh, turns, planes, &makes),
        );
        let rounded_and_shallow = || {
            let mut rounded = verdicts.map(|verdict| all || verdict.make == SurfaceClass::Round);
            if !all && verdicts.any(SurfaceClass::Machined) {
                let parts =
                    |edge: usize| hard.is_hard(edge) || rims.contains(edge) || wrinkles.contains(edge);
                add_curved_patches(mesh, (turns, planes), &makes, parts, &mut rounded);
            }
            // A figure with faceted normals bends at all edges.
            let is_exact =
                |face: &u32| !rounded[*face as usize] && verdicts.class_of_face(*face).trusts_file_normals;
            let may =
                |edge: usize| mesh.edges.faces(edge).list().iter().all(is_exact) && !wrinkles.contains(edge);
            let shallow = shallow_creases(mesh, (turns, &planes.flat), crease_deg, &hard, may);
            (rounded, shallow)
        };
        let ((rounded, shallow), roundings) = crate::parallel::join(rounded_and_shallow, || {
            if all {
                return EdgeSet::default();
            }
            roundings(mesh, (turns, planes), verdicts, (&hard, &wrinkles), crease_deg)
        });
        let hard = hard.with(mesh, &shallow);
        let origins = verdicts.map(|verdict| verdict.origin);
        let figure = verdicts.map(|verdict| verdict.make == SurfaceClass::Round);
        let pieces = verdicts.pieces();
        Self {
            hard,
            sliver_creases: wrinkles,
            fillet_centres: roundings,
            rims,
            rounded,
            figure,
            origins,
            pieces,
            trusts_file_normals: believed,
            by_evidence: Vec::new(),
            bevels: BevelNormals::default(),
        }
    }
}

/// Edges that turn by more than `crease_deg` degrees, the source of each face, and the connected component of
/// each face (empty if there is only one).
#[must_use]
pub(crate) fn classify_faces(mesh: &Mesh, crease_deg: f64) -> (HardEdges, Vec<MeshSource>, Vec<u32>) {
    let (turns, _, verdicts) = classify(mesh, false);
    let turns = &turns;
    let hard = HardEdges::above_with(mesh, turns, crease_deg);
    (hard, verdicts.map(|verdict| verdict.origin), verdicts.pieces())
}

/// Dihedral angles, planar regions, and the class of each component.
pub(crate) fn classify(mesh: &Mesh, all: bool) -> (DihedralCosines, PlanarRegions, ComponentClasses) {
    let turned = || {
        let turns = DihedralCosines::of(mesh);
        let planes = PlanarRegions::new(mesh, &turns);
        (turns, planes)
    };
    let ((turns, planes), pieces) = crate::parallel::join(turned, || pieces(mesh));
    let verdicts = classify_components(mesh, &turns, (&planes, pieces), all);
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
    let is_machined = |face: &u32| verdicts.class_of_face(*face).make == SurfaceClass::Machined;
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
    let is_round = |face: u32| verdicts.class_of_face(face).make == SurfaceClass::Round;
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
        faces.iter().all(|face| verdicts.class_of_face(*face).trusts_file_normals)
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

/// Centre edges of narrow fillets, except on figures and scans, at `hard` edges and at `sliver_creases`.
fn roundings(
    mesh: &Mesh,
    (turns, planes): (&DihedralCosines, &PlanarRegions),
    verdicts: &ComponentClasses,
    (hard, wrinkles): (&HardEdges, &EdgeSet),
    crease_deg: f64,
) -> EdgeSet {
    let is_made = |face: &u32| {
        let verdict = verdicts.class_of_face(*face);
        verdict.make != SurfaceClass::Round && verdict.trusts_file_normals
    };
    let may = |edge: usize| mesh.edges.faces(edge).list().iter().all(is_made) && !wrinkles.contains(edge);
    fillet_centres(mesh, (turns, planes), hard, may, crease_deg)
}

/// Centre edges of narrow fillets among the edges that satisfy `may`, except at `hard` edges.
pub(crate) fn fillet_centres(
    mesh: &Mesh,
    (turns, planes): (&DihedralCosines, &PlanarRegions),
    hard: &HardEdges,
    may: impl Fn(usize) -> bool + Sync,
    crease_deg: f64,
) -> EdgeSet {
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
pub(crate) fn width(mesh: &Mesh, edge: usize, face: u32) -> f64 {
    let [a, b] = mesh.ends(edge);
    2.0 * mesh.area(FaceId(face)) / a.distance(b).max(f64::MIN_POSITIVE)
}

#[cfg(test)]
mod tests;
