//! Free wires: wires of the file that do not repeat a line along mesh edges.
//!
//! A file may draw the edges of its meshes itself. Each edge is drawn once, as the mesh has it, so that a
//! model looks the same with and without such wires.
//!
//! 1. Lines along mesh edges are put into a bounding volume hierarchy.
//! 2. Lines and wires may be chords of one curve, cut at different steps. The distance of the curve from its
//!    chord (sagitta) follows from the turns at the ends, as for seams of the mesh (`mesh::seams`).
//! 3. A wire runs along a line over the range where each lies within reach of the other. A wire that is
//!    covered by lines from end to end is dropped. One that is covered in part stays whole, and the view map
//!    merges the overlap.

use crate::parallel::prelude::*;
use glam::DVec3;

use crate::geometry::lists::csr_lists::{CsrLists, csr_lists_from_pairs};
use crate::geometry::numbers::ranges::joined;
use crate::geometry::space::bounds::Bounds;
use crate::geometry::space::bounds_tree::BoundsTree;
use crate::lines::feature_line::{FeatureSegment, Role};
use crate::mesh::seams::sagitta::{MIN_SEAM_COSINE, SAGITTA_PER_TWIST, sagitta_height};
use crate::mesh::tolerances::MAX_SEAM_GAP_OF_PART;
use crate::mesh::{Mesh, Wire};

/// Wires of a mesh that do not run along a line on its edges.
pub(crate) fn find(mesh: &Mesh, lines: &[FeatureSegment]) -> Vec<Wire> {
    let drawn = lines.iter().filter(|line| line.role == Role::Line);
    let drawn = Chords::new(mesh, drawn.map(|line| (line.ends, mesh.extents.part(line.part).scale)));
    if drawn.list.is_empty() {
        return mesh.wires.clone();
    }
    let wires =
        Chords::new(mesh, mesh.wires.iter().map(|wire| (wire.vertices, mesh.extents.part(wire.part).scale)));
    let boxes: Vec<Bounds> = drawn.list.iter().map(WireChord::reach).collect();
    let tree = BoundsTree::new(&boxes);
    let is_free = |wire: &WireChord| !is_covered(wire, &drawn.list, &tree);
    let free: Vec<bool> = wires.list.par_iter().with_min_len(256).map(is_free).collect();
    mesh.wires.iter().zip(free).filter_map(|(wire, free)| free.then_some(*wire)).collect()
}

/// Whether lines cover a wire from end to end.
fn is_covered(wire: &WireChord, lines: &[WireChord], tree: &BoundsTree) -> bool {
    let reach = wire.reach();
    let near = tree.near(|around| around.meets(&reach));
    let ranges = near.filter_map(|line| wire.along(&lines[line as usize])).collect();
    let covered = joined(ranges, wire.slack);
    matches!(covered[..], [(from, to)] if from <= wire.slack && to + wire.slack >= wire.length)
}

/// Straight piece that may be a chord of a curve.
#[derive(Debug, Clone, Copy)]
struct WireChord {
    start: DVec3,
    along: DVec3,
    length: f64,
    /// Vector from the chord to the farthest point of the curve; zero for a straight line.
    sagitta: DVec3,
    /// Largest distance of points that count as one.
    slack: f64,
}

impl WireChord {
    fn end(&self) -> DVec3 {
        self.start + self.along * self.length
    }

    /// Bounding box of the chord and its curve.
    fn reach(&self) -> Bounds {
        Bounds::of([self.start, self.end()]).grown(self.sagitta.length() + self.slack)
    }

    /// Range of lengths along this chord where another chord runs next to it.
    fn along(&self, other_chord: &Self) -> Option<(f64, f64)> {
        let cosine = self.along.dot(other_chord.along);
        if cosine.abs() < MIN_SEAM_COSINE {
            return None;
        }
        let position_along = |p: DVec3| (p - self.start).dot(self.along);
        let (first, last) = (position_along(other_chord.start), position_along(other_chord.end()));
        let (from, to) = (first.min(last).max(0.0), first.max(last).min(self.length));
        if to - from <= self.slack.min(0.5 * self.length.min(other_chord.length)) {
            return None;
        }
        // Offset between the chords, tested at both ends of the range.
        let offset = |t: f64| {
            let at = self.start + self.along * t;
            at - (other_chord.start + other_chord.along * ((t - first) / cosine))
        };
        let is_near = |t: f64| other_chord.holds(self, offset(t)) || self.holds(other_chord, -offset(t));
        (is_near(from) && is_near(to)).then_some((from, to))
    }

    /// Whether a point at this offset may lie on the curve, or on a finer chord of it.
    fn holds(&self, other_chord: &Self, offset: DVec3) -> bool {
        let slack = self.slack.max(other_chord.slack);
        let bulge_direction = self.sagitta.normalize_or_zero();
        let (rise, height) = (offset.dot(bulge_direction), self.sagitta.length());
        rise >= -slack - other_chord.sagitta.length()
            && rise <= height + slack
            && (offset - bulge_direction * rise).length() <= slack + height / SAGITTA_PER_TWIST
    }
}

/// Chords with their sagittas.
struct Chords {
    list: Vec<WireChord>,
}

impl Chords {
    fn new(mesh: &Mesh, pieces: impl Iterator<Item = ([u32; 2], f64)>) -> Self {
        let pieces: Vec<([u32; 2], f64)> = pieces.collect();
        let position = |v: u32| mesh.positions[v as usize];
        let chord = |&([a, b], scale): &([u32; 2], f64)| {
            let chord_vector = position(b) - position(a);
            let length = chord_vector.length();
            let along = chord_vector.normalize_or_zero();
            WireChord {
                start: position(a),
                along,
                length,
                sagitta: DVec3::ZERO,
                slack: MAX_SEAM_GAP_OF_PART * scale,
            }
        };
        let mut list: Vec<WireChord> = pieces.iter().map(chord).collect();
        let ends = pieces.iter().zip(0..).flat_map(|((ends, _), k)| ends.map(|v| (v as usize, k)));
        let at: CsrLists<u32> = csr_lists_from_pairs(mesh.positions.len(), ends);
        let graph = ChordGraph { pieces: &pieces, list: &list, at };
        let sagittas: Vec<DVec3> = (0..pieces.len()).into_par_iter().map(|k| graph.sagitta(k)).collect();
        for (chord, sagitta) in list.iter_mut().zip(sagittas) {
            chord.sagitta = sagitta;
        }
        Self { list }
    }
}

/// Chords, connected at their ends.
struct ChordGraph<'a> {
    pieces: &'a [([u32; 2], f64)],
    list: &'a [WireChord],
    /// Chords that end at each vertex.
    at: CsrLists<u32>,
}

/// A chord with a direction: towards its end `to`, which is 1 forward and 0 backward.
#[derive(Clone, Copy)]
struct DirectedChord {
    chord: usize,
    to: usize,
}

/// Maximum number of chords at a vertex that are compared, to bound the work.
const MAX_CHORDS_AT_VERTEX: usize = 32;

impl ChordGraph<'_> {
    fn direction(&self, walk: DirectedChord) -> DVec3 {
        let along = self.list[walk.chord].along;
        if walk.to == 1 { along } else { -along }
    }

    /// Straightest continuation of a chord, and the cosine of the turn.
    fn next(&self, walk: DirectedChord) -> Option<(DirectedChord, f64)> {
        let corner = self.pieces[walk.chord].0[walk.to];
        let heading = self.direction(walk);
        let others = self.at.of(corner as usize).iter().take(MAX_CHORDS_AT_VERTEX).map(|k| *k as usize);
        let others = others.filter(|k| *k != walk.chord).map(|chord| {
            let onward = DirectedChord { chord, to: usize::from(self.pieces[chord].0[0] == corner) };
            (onward, self.direction(onward).dot(heading))
        });
        others.max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Sagitta of the curve of a chord, with its direction.
    ///
    /// It follows from the turn at the straighter end. The share of that turn that belongs to the next chord
    /// is subtracted; it is estimated from the turn at the next chord's other end.
    fn sagitta(&self, chord: usize) -> DVec3 {
        let this_chord = &self.list[chord];
        let ends = [0, 1].into_iter().filter_map(|to| {
            let walk = DirectedChord { chord, to };
            Some((walk, self.next(walk)?))
        });
        let straighter = ends.max_by(|a, b| a.1.1.total_cmp(&b.1.1));
        let Some((walk, (adjacent, cosine))) =
            straighter.filter(|(_, (_, cosine))| *cosine >= MIN_SEAM_COSINE)
        else {
            return DVec3::ZERO;
        };
        let after = self.next(adjacent).map(|(next, cosine)| (cosine, self.list[next.chord].length));
        let bend = self.direction(walk) * cosine - self.direction(adjacent);
        let lengths = [this_chord.length, self.list[adjacent.chord].length];
        bend.normalize_or_zero() * sagitta_height(cosine, lengths, after)
    }
}
