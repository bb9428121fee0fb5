//! [`Surface`]: a mesh with what its options make of it: which edges are hard, which faces round.

use glam::Vec3;

use super::LineOptions;
use super::options::Contours;
use crate::field;
use crate::mesh::rounded::rounded_faces;
use crate::mesh::{EdgeFaces, HardEdges, Mesh, SmoothNormals};
use crate::scene::Camera;
use crate::view::Frame;

/// Normals of one surface on both sides of an edge differ by no more than this cosine (20 degrees)
/// where the file has it smooth.
const SAME_NORMAL_COSINE: f32 = 0.94;

/// On rounded parts a crease turns by so many times as much.
const ROUNDED: f64 = 1.5;

/// A mesh and the surface it stands for. The same for all views, but for [`Surface::finer_for`].
#[derive(Debug, Clone, Default)]
pub struct Surface {
    /// The faces.
    pub mesh: Mesh,
    /// Where the surface is creased.
    pub hard: HardEdges,
    /// The normals of its rounded parts, whose contours are smooth; none with
    /// [`Contours::Mesh`].
    pub smooth: SmoothNormals,
    /// Whether faces were cut that the model does not have.
    pub refined: bool,
}

impl Surface {
    /// The surface of a mesh, as the options have it.
    #[must_use]
    pub fn new(mesh: Mesh, options: &LineOptions) -> Self {
        if !options.enabled {
            return Self { mesh, ..Self::default() };
        }
        if options.contours == Contours::Mesh {
            let hard = HardEdges::above(&mesh, options.crease_deg);
            return Self { mesh, hard, ..Self::default() };
        }
        let rounded = rounded(&mesh, options.contours);
        let hard = hard_edges(&mesh, &rounded, options.crease_deg);
        let smooth = SmoothNormals::new(&mesh, |f| rounded[f as usize], |e| is_hard(&mesh, e, &hard));
        Self { mesh, hard, smooth, refined: false }
    }

    /// The surface with more triangles where a coarse rounded part would show its corners to the
    /// camera.
    #[must_use]
    pub fn finer_for(self, camera: &Camera) -> Self {
        self.refined_for(camera).unwrap_or(self)
    }

    /// The same where there is such a part; else none.
    #[must_use]
    pub fn refined_for(&self, camera: &Camera) -> Option<Self> {
        let frame = Frame::new(camera, self.mesh.origin);
        let (mesh, smooth) = field::finer_near_contours(&self.mesh, &self.smooth, &frame)?;
        Some(Self { hard: self.hard.carried(&self.mesh, &mesh), mesh, smooth, refined: true })
    }
}

/// The faces of the parts that are meant to be round, or all with [`Contours::Smooth`].
fn rounded(mesh: &Mesh, contours: Contours) -> Vec<bool> {
    match contours {
        Contours::Smooth => vec![true; mesh.triangles.len()],
        _ => rounded_faces(mesh),
    }
}

/// The normals of the rounded parts, whatever the options say of contours.
pub(super) fn normals(mesh: &Mesh, hard: &HardEdges, contours: Contours) -> SmoothNormals {
    let rounded = rounded(mesh, contours);
    SmoothNormals::new(mesh, |f| rounded[f as usize], |e| is_hard(mesh, e, hard))
}

/// Creases: every sharp edge of exact parts; on rounded parts, whose faces turn at every edge, only
/// chains that turn by more and stand out from what is around them.
fn hard_edges(mesh: &Mesh, rounded: &[bool], crease_deg: f64) -> HardEdges {
    let blunt = || HardEdges::above(mesh, crease_deg);
    let sharp = || HardEdges::find(mesh, (ROUNDED * crease_deg).min(180.0));
    match (rounded.contains(&true), rounded.contains(&false)) {
        (false, _) => blunt(),
        (true, false) => sharp(),
        (true, true) => {
            let is_rounded = |edge: usize| match mesh.edges.faces(edge) {
                EdgeFaces::Two { faces, .. } => faces.iter().all(|f| rounded[*f as usize]),
                _ => false,
            };
            sharp().chosen_from(&blunt(), mesh, is_rounded)
        }
    }
}

/// Whether an edge parts two rounded surfaces: by the file's normals, or where it has none, by its
/// angle and what is around it.
fn is_hard(mesh: &Mesh, edge: usize, hard: &HardEdges) -> bool {
    if mesh.corner_normals.is_empty() {
        return hard.is_hard(edge);
    }
    let EdgeFaces::Two { faces: [first, second], .. } = mesh.edges.faces(edge) else { return false };
    let normals = |face: u32| {
        let triangle = mesh.triangles[face as usize];
        let ids = mesh.corner_normals.get(face as usize)?;
        let of = |v: u32| {
            let k = triangle.iter().position(|t| *t == v)?;
            mesh.normals.get(ids[k] as usize).map(|n| Vec3::from_array(*n))
        };
        let [a, b] = mesh.edges.vertices[edge];
        Some([of(a)?, of(b)?])
    };
    match (normals(first), normals(second)) {
        (Some(n), Some(m)) => (0..2).any(|k| n[k].dot(m[k]) < SAME_NORMAL_COSINE),
        _ => hard.is_hard(edge),
    }
}
