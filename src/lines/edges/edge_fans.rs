//! Lines along edges with three or more faces.
//!
//! 1. Faces are grouped by body. Each body has the line that it would have alone: a border for one face; a
//!    contour, crease or material boundary for two.
//! 2. Three or more faces of one body are judged together. The line is a contour if they lie on one side of
//!    the edge in the image. Otherwise the corner between faces that the camera looks into decides on a
//!    crease.
//! 3. Of the lines of all bodies the strongest is kept; among equals that of the smaller part.

use super::edge_lines::EdgeClassifier;
use crate::lines::{FeatureSegment, LineKind};
use crate::mesh::normals::dihedral::{is_unfolded_diagonal, mark, runs_up};
use crate::mesh::{Dihedral, FaceId, MaterialId};

impl EdgeClassifier<'_> {
    /// Classifies an edge with three or more faces.
    ///
    /// Each body has the line that it would have alone, whether the bodies share the vertices of the edge or
    /// merely touch there. The strongest line is drawn, and among equals that of the smaller part.
    pub(crate) fn classify_fan(&self, edge: usize, faces: &[u32]) -> Option<FeatureSegment> {
        let mesh = self.mesh;
        let mut real: Vec<u32> = faces.iter().copied().filter(|f| !self.degenerate(*f)).collect();
        match *real.as_slice() {
            [] => return None,
            [face] => return self.classify_single(edge, face),
            [first, second] => {
                let same_way = runs_up(mesh, edge, first) == runs_up(mesh, edge, second);
                return self.classify_pair(edge, first, second, same_way);
            }
            _ => {}
        }
        real.sort_by_key(|face| mesh.body(*face));
        let lines = real.chunk_by(|a, b| mesh.body(*a) == mesh.body(*b)).filter_map(|own| match *own {
            [face] => self.classify_single(edge, face),
            [first, second] => {
                let same_way = runs_up(mesh, edge, first) == runs_up(mesh, edge, second);
                let dihedral = Dihedral::of(mesh, [first, second], same_way);
                let is_diagonal = is_unfolded_diagonal(mark(mesh, edge, [first, second]), dihedral.turn());
                let crease =
                    self.is_crease(edge) || !is_diagonal && dihedral.sure_turn(mesh) > self.crease_deg;
                self.classify_flat_pair(edge, [first, second], same_way, crease)
            }
            _ => self.classify_own_fan(edge, own),
        });
        let extent = |line: &FeatureSegment| mesh.extents.part(line.part);
        lines.min_by(|a, b| a.kind.cmp(&b.kind).then_with(|| extent(a).precedence(extent(b))))
    }

    /// Classifies three or more faces of one body: a contour if all of them lie on one side of the edge in
    /// the image. Otherwise the corner that the camera looks into decides on a crease.
    fn classify_own_fan(&self, edge: usize, faces: &[u32]) -> Option<FeatureSegment> {
        let mesh = self.mesh;
        let side = |f: u32| self.view.facing[f as usize] == runs_up(mesh, edge, f);
        let contour = faces.iter().all(|f| side(*f)) || faces.iter().all(|f| !side(*f));
        let turn = self.corner_turn(edge, faces);
        let is_diagonal = is_unfolded_diagonal(mark(mesh, edge, faces.iter().copied()), turn);
        let is_crease = self.is_crease(edge) || !is_diagonal && turn > self.crease_deg;
        let other_material = self.materials_change(edge, faces);
        let kind = if contour && self.wants(LineKind::Contour) {
            LineKind::Contour
        } else if is_crease && self.wants(LineKind::Crease) {
            LineKind::Crease
        } else if other_material && self.wants(LineKind::Material) {
            LineKind::Material
        } else {
            return None;
        };
        let nearer = self.owner(faces);
        Some(FeatureSegment {
            both_seen: !contour,
            strength: turn,
            ..self.segment(edge, kind, nearer, [faces[0], faces[1]])
        })
    }

    /// Whether materials change across the edge. Parts that lie on each other face to face count as one
    /// surface: if each of its faces has the same materials, none of them ends at the edge.
    fn materials_change(&self, edge: usize, faces: &[u32]) -> bool {
        let mesh = self.mesh;
        let ends = mesh.edges.vertices[edge];
        let third = |face: u32| mesh.apex(face, ends);
        let mut found: Vec<(Option<u32>, MaterialId)> =
            faces.iter().map(|f| (third(*f), mesh.face_material[*f as usize])).collect();
        found.sort_unstable();
        found.dedup();
        let materials = |own: &[(Option<u32>, MaterialId)]| own.iter().map(|(_, m)| *m).collect::<Vec<_>>();
        let mut surfaces = found.chunk_by(|a, b| a.0 == b.0).map(materials);
        let first = surfaces.next();
        surfaces.any(|other| Some(&other) != first.as_ref())
    }

    /// Face that the line belongs to: a face with its outside to the camera, of the smallest part. The order
    /// of parts in the file does not matter.
    pub(crate) fn owner(&self, faces: &[u32]) -> u32 {
        let mesh = self.mesh;
        let seen = faces.iter().copied().filter(|f| self.view.facing[*f as usize]);
        let corners = |face: u32| {
            let mut corners = mesh.triangles[face as usize];
            corners.sort_unstable();
            corners
        };
        let first = seen.min_by(|a, b| {
            let of = |face: u32| mesh.extent(FaceId(face));
            of(*a).precedence(of(*b)).then_with(|| corners(*a).cmp(&corners(*b)))
        });
        first.unwrap_or(faces[0])
    }

    /// Turn of the surface in the corner that the camera looks into, degrees.
    fn corner_turn(&self, edge: usize, faces: &[u32]) -> f32 {
        let mesh = self.mesh;
        let [lo, hi] = mesh.edges.vertices[edge];
        let (a, b) = (mesh.positions[lo as usize], mesh.positions[hi as usize]);
        let Some(axis) = (b - a).try_normalize() else { return 0.0 };
        let away = |p: glam::DVec3| (p - a) - axis * (p - a).dot(axis);
        let spoke = |f: u32| away(mesh.apex(f, [lo, hi]).map_or(a, |v| mesh.positions[v as usize]));
        let zero = spoke(faces[0]);
        let quarter = axis.cross(zero);
        let angle =
            |d: glam::DVec3| crate::geometry::numbers::portable_math::atan2(d.dot(quarter), d.dot(zero));
        let eye = if self.view.frame.perspective {
            angle(self.view.frame.eye - (a + b) / 2.0)
        } else {
            angle(-self.view.frame.forward)
        };
        let mut angles: Vec<f64> = faces.iter().map(|f| angle(spoke(*f))).collect();
        angles.sort_by(f64::total_cmp);
        let turn_round = std::f64::consts::TAU;
        let below = angles.iter().rev().find(|x| **x <= eye).copied();
        let above = angles.iter().find(|x| **x > eye).copied();
        let (low, high) =
            (below.unwrap_or(angles[angles.len() - 1] - turn_round), above.unwrap_or(angles[0] + turn_round));
        let doubt = faces.iter().map(|f| Dihedral::normal_error(mesh, *f)).fold(0.0, f64::max);
        ((std::f64::consts::PI - (high - low)).abs().to_degrees() - 2.0 * doubt) as f32
    }
}
