//! Feature lines that are edges of the mesh: contours, borders, creases, material boundaries.
//!
//! Source: Lake, Marshall, Harris and Blackstein, "Stylized rendering techniques for scalable
//! real-time 3D animation", NPAR 2000, section 4.1. A contour is told from the geometry of its
//! faces, not from their winding alone, so that meshes of mixed winding are drawn right.

use rayon::prelude::*;

use super::{FeatureSegment, LineKind, LineOptions, NO_FACE, Surface};
use crate::mesh::dihedral::{mark, runs_up};
use crate::mesh::needle::{Beyond, beyond};
use crate::mesh::{Dihedral, EdgeFaces, EdgeMark, FaceId, HardEdges, Mesh, SmoothNormals};
use crate::view::View;

/// All edges of the mesh that are feature lines of the kinds asked for, in edge order, but for the
/// contours of rounded surfaces. `facing` is the field n·v on their smooth vertices.
#[must_use]
pub fn find(surface: &Surface, view: &View, facing: &[f64], options: &LineOptions) -> EdgeLines {
    let finder = Finder::new(surface, view, facing, options);
    finder.find(surface.mesh.edges.len(), |k| k)
}

/// The same among some edges of the mesh, given in ascending order.
#[must_use]
pub fn find_among(
    edges: &[u32],
    surface: &Surface,
    view: &View,
    facing: &[f64],
    options: &LineOptions,
) -> EdgeLines {
    let finder = Finder::new(surface, view, facing, options);
    finder.find(edges.len(), |k| edges[k] as usize)
}

/// The feature lines that are edges.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct EdgeLines {
    /// Whole edges, in edge order.
    pub segments: Vec<FeatureSegment>,
    /// Hard edges of rounded surfaces that are contours over a part of their length or all of it.
    pub parted: Vec<PartedEdge>,
}

/// A hard edge of a rounded surface. Where its two faces turn different sides to the eye it is a
/// contour, and that may change along it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PartedEdge {
    /// Its vertices.
    pub ends: [u32; 2],
    /// Its two faces.
    pub hosts: [u32; 2],
    /// Degrees by which the surface turns.
    pub turn: f32,
    /// What it is where it is no contour, if anything.
    pub else_line: Option<FeatureSegment>,
    /// What each of its hosts turns to the eye.
    pub sides: [EdgeSide; 2],
    /// Whether both faces run along the edge the same way, so that outside meets inside.
    pub same_way: bool,
}

/// What the surface on one side of an edge turns to the eye.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EdgeSide {
    /// A flat face, and whether that is its outside.
    Flat(bool),
    /// A rounded surface with these smooth vertices at the ends of the edge.
    Rounded([u32; 2]),
}

struct Finder<'a> {
    mesh: &'a Mesh,
    hard: &'a HardEdges,
    view: &'a View,
    smooth: &'a SmoothNormals,
    facing: &'a [f64],
    wanted: u32,
    crease_deg: f32,
}

impl<'a> Finder<'a> {
    fn new(surface: &'a Surface, view: &'a View, facing: &'a [f64], options: &LineOptions) -> Self {
        let Surface { mesh, hard, smooth, .. } = surface;
        Self {
            mesh,
            hard,
            view,
            smooth,
            facing,
            wanted: options.kinds.iter().fold(0, |bits, k| bits | 1 << *k as u32),
            crease_deg: options.crease_deg as f32,
        }
    }

    /// What the first `count` edges are that `edge` tells.
    fn find(&self, count: usize, edge: impl Fn(usize) -> usize + Sync) -> EdgeLines {
        const CHUNK: usize = 1 << 14;
        let found: Vec<EdgeLines> = (0..count.div_ceil(CHUNK))
            .into_par_iter()
            .map(|chunk| {
                let mut lines = EdgeLines::default();
                for k in chunk * CHUNK..((chunk + 1) * CHUNK).min(count) {
                    self.add(edge(k), &mut lines);
                }
                lines
            })
            .collect();
        let mut all = EdgeLines::default();
        for lines in found {
            all.parted.extend(lines.parted);
            all.segments.extend(lines.segments);
        }
        all
    }

    fn wants(&self, kind: LineKind) -> bool {
        self.wanted & (1 << kind as u32) != 0
    }

    /// Adds what an edge is.
    #[inline]
    fn add(&self, edge: usize, lines: &mut EdgeLines) {
        if !self.smooth.is_empty()
            && let EdgeFaces::Two { faces, same_way } = self.mesh.edges.faces(edge)
            && (self.smooth.corners_of(faces[0]).is_some() || self.smooth.corners_of(faces[1]).is_some())
            && !faces.iter().any(|f| self.degenerate(*f))
        {
            if self.smooth.across(self.mesh, edge).is_some() {
                // The surface runs on: its contour is elsewhere, and a turn between its faces is none.
                lines.segments.extend(self.on_rounded(edge, faces));
            } else {
                self.add_parted(edge, faces, same_way, lines);
            }
            return;
        }
        lines.segments.extend(self.classify(edge));
    }

    /// An edge across which a rounded surface runs on: a line only where the material changes.
    #[inline]
    fn on_rounded(&self, edge: usize, [first, second]: [u32; 2]) -> Option<FeatureSegment> {
        let material = |face: u32| self.mesh.face_material[face as usize];
        (material(first) != material(second) && self.wants(LineKind::Material)).then(|| {
            let nearer = if self.view.facing[first as usize] { first } else { second };
            FeatureSegment {
                strength: 0.0,
                ..self.segment(edge, LineKind::Material, nearer, [first, second])
            }
        })
    }

    /// A hard edge of a rounded surface.
    fn add_parted(&self, edge: usize, hosts: [u32; 2], same_way: bool, lines: &mut EdgeLines) {
        let ends = self.mesh.edges.vertices[edge];
        let sides = hosts.map(|face| match self.smooth.corners_of(face) {
            None => EdgeSide::Flat(self.view.facing[face as usize]),
            Some(corners) => {
                let triangle = self.mesh.triangles[face as usize];
                let corner = |v: u32| triangle.iter().position(|t| *t == v).map_or(0, |k| corners[k]);
                EdgeSide::Rounded(ends.map(corner))
            }
        });
        let facing = |side: EdgeSide, end: usize| match side {
            EdgeSide::Flat(facing) => facing,
            EdgeSide::Rounded(corners) => self.facing[corners[end] as usize] >= 0.0,
        };
        let is_contour = |end: usize| (facing(sides[0], end) != facing(sides[1], end)) != same_way;
        let steady = sides.iter().all(|side| facing(*side, 0) == facing(*side, 1));
        let else_line = self.classify_turn(edge, hosts[0], hosts[1], same_way, false);
        if !self.wants(LineKind::Contour) || (steady && !is_contour(0)) {
            lines.segments.extend(else_line);
            return;
        }
        let turn = Dihedral::of(self.mesh, hosts, same_way).turn();
        lines.parted.push(PartedEdge { ends, hosts, turn, else_line, sides, same_way });
    }

    #[inline]
    fn classify(&self, edge: usize) -> Option<FeatureSegment> {
        match self.mesh.edges.faces(edge) {
            EdgeFaces::Two { faces: [first, second], same_way } => {
                if self.degenerate(first) || self.degenerate(second) {
                    return self.classify_beside_needle(edge, &[first, second]);
                }
                self.classify_pair(edge, first, second, same_way)
            }
            EdgeFaces::One(face) => self.classify_single(edge, face),
            EdgeFaces::Many(faces) => self.classify_fan(edge, faces),
        }
    }

    fn degenerate(&self, face: u32) -> bool {
        self.mesh.is_degenerate(FaceId(face))
    }

    #[inline]
    fn classify_pair(&self, edge: usize, first: u32, second: u32, same_way: bool) -> Option<FeatureSegment> {
        let facing = &self.view.facing;
        let contour = (facing[first as usize] != facing[second as usize]) != same_way;
        self.classify_turn(edge, first, second, same_way, contour)
    }

    #[inline]
    fn classify_turn(
        &self,
        edge: usize,
        first: u32,
        second: u32,
        same_way: bool,
        contour: bool,
    ) -> Option<FeatureSegment> {
        let facing = &self.view.facing;
        let hard = self.hard.is_hard(edge);
        let other_material = self.other_material(edge, [first, second]);
        if !contour && !hard && !other_material {
            return None;
        }
        let kind = if contour && self.wants(LineKind::Contour) {
            LineKind::Contour
        } else if hard && self.wants(LineKind::Crease) {
            LineKind::Crease
        } else if other_material && self.wants(LineKind::Material) {
            LineKind::Material
        } else {
            return None;
        };
        let nearer = if facing[first as usize] { first } else { second };
        Some(FeatureSegment {
            both_seen: !contour,
            smooth: !hard,
            strength: Dihedral::of(self.mesh, [first, second], same_way).turn(),
            ..self.segment(edge, kind, nearer, [first, second])
        })
    }

    /// Whether the materials of two faces differ, and the file does not hide the edge.
    fn other_material(&self, edge: usize, faces: [u32; 2]) -> bool {
        let [first, second] = faces.map(|f| self.mesh.face_material[f as usize]);
        first != second && mark(self.mesh, edge, faces) != EdgeMark::Hidden
    }

    fn classify_single(&self, edge: usize, face: u32) -> Option<FeatureSegment> {
        (self.wants(LineKind::Border) && !self.degenerate(face)).then(|| FeatureSegment {
            both_seen: false,
            ..self.segment(edge, LineKind::Border, face, [face, NO_FACE])
        })
    }

    fn classify_beside_needle(&self, edge: usize, faces: &[u32; 2]) -> Option<FeatureSegment> {
        let real: Vec<u32> = faces.iter().copied().filter(|f| !self.degenerate(*f)).collect();
        let needle = faces.iter().copied().find(|f| self.degenerate(*f))?;
        let &[face] = real.as_slice() else { return None };
        let [lo, hi] = self.mesh.edges.vertices[edge];
        match beyond(self.mesh, needle, lo, hi) {
            Beyond::Face(other) => self.classify_pair(edge, face, other, false),
            Beyond::LongEdge => None,
            Beyond::Nothing => self.classify_single(edge, face),
        }
    }

    /// Three faces or more. The line is a contour if all of them lie on one side of it in the
    /// image. Else the eye looks into one of the corners between neighbouring faces, and that
    /// corner decides about a crease, or any part's own corner does.
    fn classify_fan(&self, edge: usize, faces: &[u32]) -> Option<FeatureSegment> {
        let mesh = self.mesh;
        let real: Vec<u32> = faces.iter().copied().filter(|f| !self.degenerate(*f)).collect();
        match *real.as_slice() {
            [] => return None,
            [face] => return self.classify_single(edge, face),
            [first, second] => {
                let same_way = runs_up(mesh, edge, first) == runs_up(mesh, edge, second);
                return self.classify_pair(edge, first, second, same_way);
            }
            _ => {}
        }
        let side = |f: u32| self.view.facing[f as usize] == runs_up(mesh, edge, f);
        let contour = real.iter().all(|f| side(*f)) || real.iter().all(|f| !side(*f));
        let turn = self.corner_turn(edge, &real).max(self.own_turn(edge, &real));
        let materials = |f: &u32| mesh.face_material[*f as usize];
        let other_material = real.iter().any(|f| materials(f) != materials(&real[0]));
        let kind = if contour && self.wants(LineKind::Contour) {
            LineKind::Contour
        } else if turn > self.crease_deg && self.wants(LineKind::Crease) {
            LineKind::Crease
        } else if other_material && self.wants(LineKind::Material) {
            LineKind::Material
        } else {
            return None;
        };
        let nearer = real.iter().copied().find(|f| self.view.facing[*f as usize]).unwrap_or(real[0]);
        Some(FeatureSegment {
            both_seen: !contour,
            strength: turn,
            ..self.segment(edge, kind, nearer, [real[0], real[1]])
        })
    }

    /// Degrees by which the surface turns in the corner between two faces into which the eye
    /// looks.
    fn corner_turn(&self, edge: usize, faces: &[u32]) -> f32 {
        let mesh = self.mesh;
        let [lo, hi] = mesh.edges.vertices[edge];
        let (a, b) = (mesh.positions[lo as usize], mesh.positions[hi as usize]);
        let Some(axis) = (b - a).try_normalize() else { return 0.0 };
        let away = |p: glam::DVec3| (p - a) - axis * (p - a).dot(axis);
        let spoke = |f: u32| {
            let opposite = mesh.triangles[f as usize].iter().find(|v| **v != lo && **v != hi);
            away(opposite.map_or(a, |v| mesh.positions[*v as usize]))
        };
        let zero = spoke(faces[0]);
        let quarter = axis.cross(zero);
        let angle = |d: glam::DVec3| crate::math::function::atan2(d.dot(quarter), d.dot(zero));
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
        (std::f64::consts::PI - (high - low)).abs().to_degrees() as f32
    }

    /// The largest turn between the two faces that one part has at the edge: where parts touch,
    /// each keeps its own creases.
    fn own_turn(&self, edge: usize, faces: &[u32]) -> f32 {
        let mesh = self.mesh;
        let part = |f: &u32| mesh.face_part[*f as usize];
        if faces.iter().all(|f| part(f) == part(&faces[0])) {
            return 0.0;
        }
        let mut most = 0.0f32;
        for first in faces {
            let own: Vec<u32> = faces.iter().copied().filter(|f| part(f) == part(first)).collect();
            if let [a, b] = *own.as_slice() {
                let same_way = runs_up(mesh, edge, a) == runs_up(mesh, edge, b);
                most = most.max(Dihedral::of(mesh, [a, b], same_way).turn());
            }
        }
        most
    }

    fn segment(&self, edge: usize, kind: LineKind, nearer: u32, hosts: [u32; 2]) -> FeatureSegment {
        FeatureSegment {
            ends: self.mesh.edges.vertices[edge],
            hosts,
            kind,
            both_seen: true,
            smooth: false,
            lift: 0.0,
            strength: 180.0,
            part: self.mesh.face_part[nearer as usize],
            material: self.mesh.face_material[nearer as usize],
        }
    }
}
