//! [`Surface`]: a mesh with its hard edges, rounded patches and normals, as the line options define them.

use std::borrow::Cow;

use super::LineOptions;
use super::line_options::{Contours, Normals, RoundRims, Surfaces};
use crate::light;
use crate::mesh::EdgeSet;
use crate::mesh::{EdgeFaces, Mesh};
use crate::scene::Camera;
use crate::surface::creases::pose_creases::pose_creases;
use crate::surface::evidence::evidence_layout::patches_by_evidence;
use crate::surface::normals::file_normals::file_cosines;
use crate::surface::normals::straight_edges;
use crate::surface::patches::patch_layout;
use crate::surface::refine::mesh_splice::{MeshCuts, RefinedMesh, splice};
use crate::surface::{EvenRuns, HardEdges, MeshSource, Patches, SmoothNormals};
use crate::view::Frame;

/// Cosine of the largest angle (20 degrees) between the file's normals at an edge that the file shades
/// smoothly.
const MIN_SMOOTH_NORMAL_COSINE: f32 = 0.94;

/// A mesh and the surface that it approximates. The same for all views, except after [`Surface::finer_for`].
#[derive(Debug, Clone, Default)]
pub struct Surface {
    /// The faces.
    pub mesh: Mesh,
    /// Creased edges.
    pub(crate) hard: HardEdges,
    /// Sharp edges that are neither creases nor inside a rounded surface.
    pub(crate) sliver_creases: EdgeSet,
    /// Middle edges of narrow roundings: drawn as creases, but smooth for normals.
    pub(crate) fillet_centres: EdgeSet,
    /// Normals of rounded parts, which have smooth contours; none with [`Contours::Mesh`].
    pub(crate) smooth: SmoothNormals,
    /// Lines that become curves because they turn evenly; none if rims are not rounded, or after subdivision.
    pub(crate) even_runs: Option<EvenRuns>,
    /// Origin of the surface, one per face.
    pub(crate) origins: Vec<MeshSource>,
    /// Connected component of each face; empty if there is only one, or if not computed.
    pub(crate) pieces: Vec<u32>,
    /// Whether faces were subdivided.
    pub(crate) refined: bool,
    /// A camera for which no face needs subdivision, if known.
    pub(crate) fine_enough_camera: Option<Camera>,
}

impl Surface {
    /// The surface of a mesh for the given options.
    #[must_use]
    pub(crate) fn new(mesh: Mesh, options: &LineOptions) -> Self {
        Self::with_patches(mesh, options).0
    }

    /// The surface of a mesh, and its patches if any are round. [`Surface::posed`] needs them for moving
    /// meshes.
    #[must_use]
    pub(crate) fn with_patches(mut mesh: Mesh, options: &LineOptions) -> (Self, Option<Patches>) {
        if !options.enabled {
            return (Self { mesh, ..Self::default() }, None);
        }
        if options.contours == Contours::Mesh {
            let (hard, origins, pieces) = patch_layout::classify_faces(&mesh, options.crease_deg);
            return (Self { mesh, hard, origins, pieces, ..Self::default() }, None);
        }
        let asks_evidence = options.surfaces != Surfaces::Statistics && options.contours == Contours::Auto;
        let patches = if asks_evidence {
            patches_by_evidence(&mut mesh, options.crease_deg, options.surfaces == Surfaces::Shaded)
        } else {
            Patches::new(&mesh, options.crease_deg, options.contours == Contours::Smooth)
        };
        if options.normals == Normals::Auto {
            mesh.remove_normals(|face| !patches.trusts_file_normals[face as usize]);
        }
        let smooth = normals(&mesh, &patches, &[]);
        let rounds_rims = !patches.by_evidence.is_empty() && options.round_rims == RoundRims::Auto;
        let even_runs = rounds_rims.then(|| EvenRuns::find(&mesh, &smooth, &patches.by_evidence));
        let surface = Self {
            even_runs,
            mesh,
            hard: patches.hard.clone(),
            sliver_creases: patches.sliver_creases.clone(),
            fillet_centres: patches.fillet_centres.clone(),
            smooth,
            origins: patches.origins.clone(),
            pieces: patches.pieces.clone(),
            refined: false,
            fine_enough_camera: None,
        };
        (surface, Some(patches))
    }

    /// This surface with a moved mesh.
    ///
    /// It keeps its creases and rounded parts, and gets new creases where the pose folds it. Figures get
    /// none, since their skin stays round. `patches` and `crease_deg` are those it was made with. `before`
    /// yields the mesh at earlier times, latest first (see [`pose_creases`]).
    #[must_use]
    pub(crate) fn posed(
        &self,
        mut mesh: Mesh,
        patches: Option<&Patches>,
        crease_deg: f64,
        before: impl Iterator<Item = Mesh>,
    ) -> Self {
        if let Some(patches) = patches {
            patches.bevels.add_to(&mut mesh);
        }
        let is_figure = |edge: usize| {
            let figure = |patches: &Patches| {
                mesh.edges.faces(edge).list().iter().any(|face| patches.figure[*face as usize])
            };
            patches.is_some_and(figure)
        };
        let hard = &self.hard;
        let folds = pose_creases(
            &self.mesh,
            &mesh,
            crease_deg,
            |edge| !hard.is_hard(edge) && !is_figure(edge),
            before,
        );
        let smooth = patches.map_or_else(SmoothNormals::default, |patches| normals(&mesh, patches, &folds));
        Self {
            hard: hard.clone().with(&mesh, &folds),
            even_runs: self.even_runs.clone(),
            sliver_creases: self.sliver_creases.clone(),
            fillet_centres: self.fillet_centres.clone(),
            mesh,
            smooth,
            origins: self.origins.clone(),
            pieces: self.pieces.clone(),
            refined: false,
            fine_enough_camera: None,
        }
    }

    /// The surface, subdivided where a coarse rounded part would show corners to the camera: until lines are
    /// within `tolerance` (user units of the page) of the rounded surface.
    #[must_use]
    pub fn finer_for(mut self, camera: &Camera, tolerance: f64) -> Self {
        if self.refined || self.fine_enough_camera.as_ref() == Some(camera) {
            return self;
        }
        let frame = Frame::new(camera, self.mesh.origin);
        if let Some(cuts) = self.cuts_along_rims(&frame, tolerance) {
            self = self.cut(cuts).surface;
        }
        if let Some(cuts) = light::cuts_near_contours(&self.mesh, &self.smooth, &frame, tolerance) {
            let sides = self.fillet_centre_sides();
            let (mesh, smooth) = (std::mem::take(&mut self.mesh), std::mem::take(&mut self.smooth));
            self = self.refined_with(splice(Cow::Owned(mesh), Cow::Owned(smooth), cuts), &sides).surface;
        }
        if !self.refined {
            self.fine_enough_camera = Some(*camera);
        }
        self
    }

    /// The surface subdivided as by [`Self::finer_for`]; `None` if nothing needs it, or if it is subdivided
    /// already.
    ///
    /// Rims come first. Contours end on them.
    #[must_use]
    pub(crate) fn refined_for(&self, camera: &Camera, tolerance: f64) -> Option<RefinedSurface> {
        if self.refined || self.fine_enough_camera.as_ref() == Some(camera) {
            return None;
        }
        let frame = Frame::new(camera, self.mesh.origin);
        let rimmed = self.cuts_along_rims(&frame, tolerance).map(|cuts| self.cut(cuts));
        let surface = rimmed.as_ref().map_or(self, |rimmed| &rimmed.surface);
        let finer = light::cuts_near_contours(&surface.mesh, &surface.smooth, &frame, tolerance)
            .map(|cuts| surface.cut(cuts));
        match (rimmed, finer) {
            (Some(rimmed), Some(finer)) => Some(finer.after(&rimmed)),
            (rimmed, finer) => finer.or(rimmed),
        }
    }

    fn cuts_along_rims(&self, frame: &Frame, tolerance: f64) -> Option<MeshCuts> {
        light::cuts_along_rims(&self.mesh, &self.smooth, self.even_runs.as_ref()?, frame, tolerance)
    }

    /// The surface with cut faces.
    fn cut(&self, cuts: MeshCuts) -> RefinedSurface {
        let finer = splice(Cow::Borrowed(&self.mesh), Cow::Borrowed(&self.smooth), cuts);
        self.refined_with(finer, &self.fillet_centre_sides())
    }

    /// The surface of a subdivided mesh. `sides` are those of [`Self::fillet_centre_sides`].
    fn refined_with(&self, finer: RefinedMesh, sides: &[[u32; 2]]) -> RefinedSurface {
        let RefinedMesh { mesh, smooth, hosts, kept_count: kept, edges, edge_pieces } = finer;
        let surface = Self {
            hard: self.hard.refined(&edges, &edge_pieces, mesh.edges.len()),
            sliver_creases: self.sliver_creases.refined(&edges, &edge_pieces, mesh.edges.len()),
            even_runs: None,
            fillet_centres: self
                .fillet_centres
                .remapped(&edges, mesh.edges.len())
                .with(&pieces_between(&mesh, (&hosts, kept), sides), mesh.edges.len()),
            mesh,
            smooth,
            origins: hosts.iter().filter_map(|face| self.origins.get(*face as usize).copied()).collect(),
            pieces: hosts.iter().filter_map(|face| self.pieces.get(*face as usize).copied()).collect(),
            refined: true,
            fine_enough_camera: None,
        };
        RefinedSurface { surface, hosts, kept_count: kept }
    }

    /// Face pairs at the middle edges of narrow roundings, sorted.
    fn fillet_centre_sides(&self) -> Vec<[u32; 2]> {
        let sides = |edge| match self.mesh.edges.faces(edge) {
            EdgeFaces::Two { faces, .. } => Some(ascending(faces)),
            _ => None,
        };
        let mut found: Vec<[u32; 2]> = self.fillet_centres.iter().filter_map(sides).collect();
        found.sort_unstable();
        found
    }
}

/// Two numbers in ascending order.
fn ascending([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// Edges of a subdivided mesh that are parts of an original edge, given the face pairs of such edges in
/// ascending order.
fn pieces_between(mesh: &Mesh, (hosts, kept): (&[u32], usize), sides: &[[u32; 2]]) -> Vec<usize> {
    if sides.is_empty() {
        return Vec::new();
    }
    let is_piece = |edge: usize| match mesh.edges.faces(edge) {
        EdgeFaces::Two { faces, .. } if faces.iter().all(|face| *face as usize >= kept) => {
            sides.binary_search(&ascending(faces.map(|face| hosts[face as usize]))).is_ok()
        }
        _ => false,
    };
    EdgeSet::collect(mesh.edges.len(), is_piece).iter().collect()
}

/// A surface that was subdivided for a camera.
#[derive(Debug, Clone)]
pub(crate) struct RefinedSurface {
    /// The subdivided surface.
    pub surface: Surface,
    /// Original face of each of its faces.
    pub hosts: Vec<u32>,
    /// Number of unchanged faces. They come first, with ascending original faces.
    pub kept_count: usize,
}

impl RefinedSurface {
    /// The same after an earlier subdivision, whose faces it subdivides.
    fn after(self, earlier: &Self) -> Self {
        // Faces that both keep come first.
        let kept_count =
            self.hosts[..self.kept_count].partition_point(|face| (*face as usize) < earlier.kept_count);
        let hosts = self.hosts.iter().map(|face| earlier.hosts[*face as usize]).collect();
        Self { surface: self.surface, hosts, kept_count }
    }
}

/// Normals of the rounded patches. Folds (edges, ascending) separate patches too.
pub(crate) fn normals(mesh: &Mesh, patches: &Patches, folds: &[usize]) -> SmoothNormals {
    let parted = |edge: usize| parts(mesh, edge, patches) || folds.binary_search(&edge).is_ok();
    let mut smooth = SmoothNormals::new(mesh, |face| patches.rounded[face as usize], parted);
    if !patches.by_evidence.is_empty() {
        // The normals of figures turn as their shape does.
        let is_asked = |edge: usize| {
            let face = mesh.edges.faces(edge).list()[0] as usize;
            patches.by_evidence[face] && patches.origins[face] == MeshSource::Constructed
        };
        smooth.straight = smooth.straight.union(&straight_edges::level(mesh, &smooth, is_asked));
    }
    smooth
}

/// Whether an edge separates two rounded surfaces, by its angle and surroundings or by the file's normals.
/// Figures are shaded smoothly over edges that would be creases elsewhere.
fn parts(mesh: &Mesh, edge: usize, patches: &Patches) -> bool {
    if patches.rims.contains(edge) || patches.sliver_creases.contains(edge) {
        return true;
    }
    let hard = patches.hard.is_hard(edge);
    let face = mesh.edges.faces(edge).list()[0] as usize;
    if patches.by_evidence.get(face) == Some(&true) {
        return hard;
    }
    match file_normals_differ(mesh, edge) {
        None => hard,
        Some(differ) => differ || (hard && !patches.figure[face]),
    }
}

/// Whether the file's normals are creased at an edge; `None` where it has none.
fn file_normals_differ(mesh: &Mesh, edge: usize) -> Option<bool> {
    let EdgeFaces::Two { faces, .. } = mesh.edges.faces(edge) else { return None };
    Some(file_cosines(mesh, edge, faces)?.iter().any(|cosine| *cosine < MIN_SMOOTH_NORMAL_COSINE))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use glam::DVec3;

    use super::*;
    use crate::geometry::numbers::portable_math::{cos, sin};
    use crate::mesh::Soup;
    use crate::scene::Projection;

    /// A sphere with 16 meridians and the given number of rings between the poles.
    fn ball(rings: u32) -> Mesh {
        const AROUND: u32 = 16;
        let mut soup = Soup { positions: vec![DVec3::NEG_Z, DVec3::Z], ..Soup::default() };
        for ring in 1..=rings {
            let up = TAU / 2.0 * (f64::from(ring) / f64::from(rings + 1) - 0.5);
            let turns = (0..AROUND).map(|step| TAU * f64::from(step) / f64::from(AROUND));
            soup.positions
                .extend(turns.map(|turn| DVec3::new(cos(up) * cos(turn), cos(up) * sin(turn), sin(up))));
        }
        let at = |ring: u32, step: u32| 2 + ring * AROUND + step % AROUND;
        for step in 0..AROUND {
            soup.triangles.extend([
                [0, at(0, step + 1), at(0, step)],
                [1, at(rings - 1, step), at(rings - 1, step + 1)],
            ]);
            for ring in 0..rings - 1 {
                let [a, b] = [at(ring, step), at(ring, step + 1)];
                soup.triangles.extend([[a, b, b + AROUND], [a, b + AROUND, a + AROUND]]);
            }
        }
        Mesh::build(soup)
    }

    fn camera() -> Camera {
        Camera {
            eye: DVec3::new(3.0, 1.0, 2.0),
            up: DVec3::Z,
            target: DVec3::ZERO,
            projection: Projection::Orthographic { height: 2.5 },
            width: 1000.0,
            height: 1000.0,
            near: None,
        }
    }

    #[test]
    fn a_coarser_tolerance_splits_fewer_faces() {
        let options = LineOptions { contours: Contours::Smooth, ..LineOptions::default() };
        let surface = Surface::new(ball(7), &options);
        let faces = |tolerance: f64| surface.clone().finer_for(&camera(), tolerance).mesh.triangles.len();
        let [fine, coarse] = [0.04, 0.6].map(faces);
        assert!(fine > 3 * coarse / 2 && coarse > surface.mesh.triangles.len(), "{fine} {coarse}");
    }

    #[test]
    fn fillet_centre_edges_stay_complete_after_refinement() {
        let options = LineOptions { contours: Contours::Smooth, ..LineOptions::default() };
        let mut surface = Surface::new(ball(7), &options);
        let is_level = |mesh: &Mesh, edge: usize| {
            mesh.edges.vertices[edge]
                .iter()
                .all(|v| (mesh.positions[*v as usize] + mesh.origin).z.abs() < 1e-6)
        };
        let edges = surface.mesh.edges.len();
        surface.fillet_centres = EdgeSet::collect(edges, |edge| is_level(&surface.mesh, edge));
        assert_eq!(surface.fillet_centres.iter().count(), 16);
        let finer = surface.finer_for(&camera(), 0.04);
        let mesh = &finer.mesh;
        let place = |v: u32| mesh.positions[v as usize] + mesh.origin;
        let angle = |edge: usize| {
            let [a, b] = mesh.edges.vertices[edge].map(place);
            a.angle_between(b)
        };
        let found: Vec<usize> = finer.fillet_centres.iter().collect();
        assert!(found.len() > 16, "none of them was cut");
        assert!(found.iter().all(|edge| is_level(mesh, *edge)));
        let around: f64 = found.iter().map(|edge| angle(*edge)).sum();
        assert!((around - TAU).abs() < 1e-6, "{around}");
    }
}
