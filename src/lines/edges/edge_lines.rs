//! Feature lines that are mesh edges: contours, borders, creases and material boundaries.
//!
//! - One face: a border.
//! - Two faces: a contour if one faces the camera and the other does not, a crease if the edge is hard, or a
//!   material boundary. On rounded surfaces such edges form the mesh contour, which decides on the visibility
//!   of the smooth contour.
//! - Three or more faces: see `edge_fans`.
//!
//! Source: Lake, Marshall, Harris and Blackstein, "Stylized rendering techniques for scalable real-time 3D
//! animation", NPAR 2000, section 4.1. Deviation: contours follow from the geometry of the faces and not from
//! their winding alone, so meshes of mixed winding are drawn right.

use crate::parallel::prelude::*;

use crate::lines::{FeatureSegment, LineKind, LineOptions, NO_FACE, Role, Surface};
use crate::mesh::EdgeSet;
use crate::mesh::normals::degenerate_faces::{OppositeFace, opposite_face};
use crate::mesh::normals::dihedral::mark;
use crate::mesh::{Dihedral, EdgeFaces, EdgeMark, FaceId, Mesh};
use crate::parallel::concatenation::concatenate;
use crate::parallel::task_size::MIN_TASK_ITEMS;
use crate::surface::{HardEdges, SmoothNormals};
use crate::view::View;

/// All mesh edges that are feature lines of the wanted kinds, in edge order.
///
/// On rounded surfaces these are the hard edges, and the mesh contours that decide on visibility
/// ([`Role::MeshContour`]).
#[must_use]
pub(crate) fn find(surface: &Surface, view: &View, options: &LineOptions) -> Vec<FeatureSegment> {
    let finder = EdgeClassifier::new(surface, view, options);
    finder.find(surface.mesh.edges.len(), |k| k)
}

/// Feature lines among the given edges, which must be ascending.
#[must_use]
pub(crate) fn find_among(
    edges: &[u32],
    surface: &Surface,
    view: &View,
    options: &LineOptions,
) -> Vec<FeatureSegment> {
    let finder = EdgeClassifier::new(surface, view, options);
    finder.find(edges.len(), |k| edges[k] as usize)
}

pub(crate) struct EdgeClassifier<'a> {
    pub(crate) mesh: &'a Mesh,
    hard: &'a HardEdges,
    sliver_creases: &'a EdgeSet,
    fillet_centres: &'a EdgeSet,
    pub(crate) view: &'a View,
    smooth: &'a SmoothNormals,
    wanted: u32,
    pub(crate) crease_deg: f32,
    /// Whether every face has an area.
    all_real: bool,
}

impl<'a> EdgeClassifier<'a> {
    fn new(surface: &'a Surface, view: &'a View, options: &LineOptions) -> Self {
        let Surface { mesh, hard, sliver_creases: wrinkles, fillet_centres: roundings, smooth, .. } = surface;
        Self {
            mesh,
            hard,
            sliver_creases: wrinkles,
            fillet_centres: roundings,
            view,
            smooth,
            wanted: options.kinds.iter().fold(0, |bits, k| bits | 1 << *k as u32),
            crease_deg: options.crease_deg as f32,
            all_real: mesh
                .face_normals
                .par_iter()
                .with_min_len(MIN_TASK_ITEMS)
                .all(|normal| *normal != [0.0; 3]),
        }
    }

    /// Classifies the edges `edge(0)` to `edge(count - 1)`.
    fn find(&self, count: usize, edge: impl Fn(usize) -> usize + Sync) -> Vec<FeatureSegment> {
        const EDGES_PER_TASK: usize = 1 << 12;
        let found: Vec<Vec<FeatureSegment>> = (0..count.div_ceil(EDGES_PER_TASK))
            .into_par_iter()
            .with_max_len(1)
            .map(|chunk| {
                let edges = chunk * EDGES_PER_TASK..((chunk + 1) * EDGES_PER_TASK).min(count);
                edges.filter_map(|k| self.classify(edge(k))).collect()
            })
            .collect();
        concatenate(&found)
    }

    pub(crate) fn wants(&self, kind: LineKind) -> bool {
        self.wanted & (1 << kind as u32) != 0
    }

    /// Classifies an edge inside a rounded surface. Where one face is averted, the smooth contour is near. A
    /// turn is a crease only in the middle of a narrow rounding.
    #[inline]
    fn on_rounded(&self, edge: usize, [first, second]: [u32; 2]) -> Option<FeatureSegment> {
        let facing = &self.view.facing;
        let nearer = if facing[first as usize] { first } else { second };
        if facing[first as usize] != facing[second as usize] && self.wants(LineKind::Contour) {
            return Some(FeatureSegment {
                both_seen: false,
                smooth: true,
                role: Role::MeshContour { convex: self.is_convex(edge, [first, second]), fold: false },
                strength: Dihedral::of(self.mesh, [first, second], false).turn(),
                ..self.segment(edge, LineKind::Contour, nearer, [first, second])
            });
        }
        if self.fillet_centres.contains(edge) && self.wants(LineKind::Crease) {
            return Some(FeatureSegment {
                smooth: true,
                strength: Dihedral::of(self.mesh, [first, second], false).turn(),
                ..self.segment(edge, LineKind::Crease, nearer, [first, second])
            });
        }
        let material = |face: u32| self.mesh.face_material[face as usize];
        (material(first) != material(second) && self.wants(LineKind::Material)).then(|| FeatureSegment {
            strength: 0.0,
            ..self.segment(edge, LineKind::Material, nearer, [first, second])
        })
    }

    /// Whether the edge is convex: the second face lies behind the plane of the first.
    fn is_convex(&self, edge: usize, faces: [u32; 2]) -> bool {
        self.mesh.fold_height(faces, self.mesh.edges.vertices[edge]) < 0.0
    }

    fn classify(&self, edge: usize) -> Option<FeatureSegment> {
        if self.mesh.edge_marks.is_empty() {
            self.classify_by_shape(edge)
        } else {
            self.classify_marked(edge)
        }
    }

    /// Classifies an edge of a section: lines belong to the cut face, and lines within another part are left
    /// out.
    fn classify_marked(&self, edge: usize) -> Option<FeatureSegment> {
        let faces = match self.mesh.edges.faces(edge) {
            EdgeFaces::Two { faces, .. } => faces.to_vec(),
            EdgeFaces::One(face) => vec![face],
            EdgeFaces::Many(faces) => faces.to_vec(),
        };
        let said = |face: u32| mark(self.mesh, edge, [face; 2]);
        let is_covered = faces.iter().any(|face| said(*face) == EdgeMark::Covered);
        let cut: Vec<u32> = faces
            .into_iter()
            .filter(|face| said(*face) == EdgeMark::Cut && !self.degenerate(*face))
            .collect();
        let Some(first) = cut.first().copied() else {
            return if is_covered { None } else { self.classify_by_shape(edge) };
        };
        let crease = || {
            let hosts = [first, cut.get(1).copied().unwrap_or(NO_FACE)];
            self.wants(LineKind::Crease).then(|| self.segment(edge, LineKind::Crease, first, hosts))
        };
        let owner = self.owner(&cut) as usize;
        let (part, material) = (self.mesh.face_part[owner], self.mesh.face_material[owner]);
        let found = self.classify_by_shape(edge).or_else(crease)?;
        Some(FeatureSegment { part, material, strength: 180.0, ..found })
    }

    #[inline]
    fn classify_by_shape(&self, edge: usize) -> Option<FeatureSegment> {
        match self.mesh.edges.faces(edge) {
            EdgeFaces::Two { faces: [first, second], same_way } => {
                if self.all_real && !same_way && self.is_smooth_interior(edge, first, second) {
                    return None;
                }
                if self.degenerate(first) || self.degenerate(second) {
                    return self.classify_beside_degenerate(edge, &[first, second]);
                }
                self.classify_pair(edge, first, second, same_way)
            }
            EdgeFaces::One(face) if self.degenerate(face) => self.classify_beside_degenerate(edge, &[face]),
            EdgeFaces::One(face) => self.classify_single(edge, face),
            EdgeFaces::Many(faces) => self.classify_fan(edge, faces),
        }
    }

    /// Whether the surface continues smoothly across an edge between faces with area. This holds for most
    /// edges.
    #[inline]
    fn is_smooth_interior(&self, edge: usize, first: u32, second: u32) -> bool {
        let (first, second) = (first as usize, second as usize);
        self.view.facing[first] == self.view.facing[second]
            && self.mesh.face_material[first] == self.mesh.face_material[second]
            && !self.is_crease(edge)
    }

    /// Whether the edge is a crease from every viewpoint.
    #[inline]
    pub(crate) fn is_crease(&self, edge: usize) -> bool {
        self.hard.is_hard(edge) || self.fillet_centres.contains(edge)
    }

    pub(crate) fn degenerate(&self, face: u32) -> bool {
        self.mesh.is_degenerate(FaceId(face))
    }

    #[inline]
    pub(crate) fn classify_pair(
        &self,
        edge: usize,
        first: u32,
        second: u32,
        same_way: bool,
    ) -> Option<FeatureSegment> {
        if !self.smooth.is_empty() && !same_way && self.smooth.across(self.mesh, edge).is_some() {
            return self.on_rounded(edge, [first, second]);
        }
        let dihedral = || Dihedral::of(self.mesh, [first, second], same_way);
        let crease = self.is_crease(edge);
        let found = self.classify_flat_pair(edge, [first, second], same_way, crease)?;
        // A material boundary on a flat face is painted there, so its corners are real.
        let is_painted = found.kind == LineKind::Material && dihedral().is_flat(self.mesh, edge);
        let smooth = !self.hard.is_hard(edge) && !self.sliver_creases.contains(edge) && !is_painted;
        Some(FeatureSegment { smooth, ..found })
    }

    /// Classifies an edge between two faces of a surface that is not rounded there.
    #[inline]
    pub(crate) fn classify_flat_pair(
        &self,
        edge: usize,
        [first, second]: [u32; 2],
        same_way: bool,
        crease: bool,
    ) -> Option<FeatureSegment> {
        let facing = &self.view.facing;
        let contour = self.turns_away([first, second], same_way);
        let other_material = self.other_material(edge, [first, second]);
        if !contour && !crease && !other_material {
            return None;
        }
        let kind = if contour && self.wants(LineKind::Contour) {
            LineKind::Contour
        } else if crease && self.wants(LineKind::Crease) {
            LineKind::Crease
        } else if other_material && self.wants(LineKind::Material) {
            LineKind::Material
        } else {
            return None;
        };
        let nearer = if facing[first as usize] { first } else { second };
        Some(FeatureSegment {
            both_seen: !contour,
            strength: Dihedral::of(self.mesh, [first, second], same_way).turn(),
            ..self.segment(edge, kind, nearer, [first, second])
        })
    }

    /// Whether the surface turns from facing to averted between two faces. A face seen edge-on has no side:
    /// the visible surface ends in it, for either winding.
    #[inline]
    fn turns_away(&self, faces: [u32; 2], same_way: bool) -> bool {
        let facing = &self.view.facing;
        match faces.map(|face| !facing[face as usize] && self.is_edge_on(face)) {
            [false, false] => (facing[faces[0] as usize] != facing[faces[1] as usize]) != same_way,
            [first, second] => first != second,
        }
    }

    /// Whether a face that is not seen from outside is not seen from inside either.
    fn is_edge_on(&self, face: u32) -> bool {
        let Self { mesh, view, .. } = self;
        let carrier = mesh.carriers.binary_search_by_key(&face, |pair| pair[0]);
        let face = carrier.map_or(face, |at| mesh.carriers[at][1]);
        let [a, b, c] = mesh.corners(FaceId(face));
        view.unsure.binary_search(&face).is_ok() || !view.frame.faces_eye(a, c, b)
    }

    /// Whether the materials of two faces differ and the file does not hide the edge.
    fn other_material(&self, edge: usize, faces: [u32; 2]) -> bool {
        let [first, second] = faces.map(|f| self.mesh.face_material[f as usize]);
        first != second && mark(self.mesh, edge, faces) != EdgeMark::Hidden
    }

    pub(crate) fn classify_single(&self, edge: usize, face: u32) -> Option<FeatureSegment> {
        self.wants(LineKind::Border).then(|| FeatureSegment {
            both_seen: false,
            ..self.segment(edge, LineKind::Border, face, [face, NO_FACE])
        })
    }

    /// Classifies an edge next to faces without area. The faces on their other sides take their place.
    fn classify_beside_degenerate(&self, edge: usize, faces: &[u32]) -> Option<FeatureSegment> {
        let mut seen = Vec::with_capacity(faces.len());
        for face in faces {
            match opposite_face(self.mesh, *face, self.mesh.edges.vertices[edge]) {
                OppositeFace::Face(face) => seen.push(face),
                OppositeFace::LongEdge => return None,
                OppositeFace::Nothing => {}
            }
        }
        match *seen.as_slice() {
            [first, second] if first != second => self.classify_pair(edge, first, second, false),
            [face] => self.classify_single(edge, face),
            _ => None,
        }
    }

    pub(crate) fn segment(
        &self,
        edge: usize,
        kind: LineKind,
        nearer: u32,
        hosts: [u32; 2],
    ) -> FeatureSegment {
        FeatureSegment::on_face(self.mesh, nearer, hosts, kind, self.mesh.edges.vertices[edge])
    }
}
