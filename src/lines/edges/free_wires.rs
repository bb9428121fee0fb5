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
use crate::lines::feature_line::{FeatureSegment, Role};
use crate::mesh::tolerances::MAX_SEAM_GAP_OF_PART;
use crate::mesh::{Mesh, Wire};

/// Cosine of the largest turn (45 degrees) between chords of one curve. A larger turn is a corner.
const MIN_CHORD_COSINE: f64 = 0.7;

/// Factor on the sagitta, since the chords of a curve may differ in length.
const MAX_SAGITTA_RATIO: f64 = 2.0;

/// Ratio of a curve's sagitta to its distance from its plane.
const SAGITTA_PER_TWIST: f64 = 4.0;

/// Children per box of the hierarchy.
const TREE_FANOUT: usize = 8;

/// Wires of a mesh that do not run along a line on its edges.
pub(crate) fn find(mesh: &Mesh, lines: &[FeatureSegment]) -> Vec<Wire> {
    let drawn = lines.iter().filter(|line| line.role == Role::Line);
    let drawn = Chords::new(mesh, drawn.map(|line| (line.ends, mesh.extents.part(line.part).scale)));
    if drawn.list.is_empty() {
        return mesh.wires.clone();
    }
    let wires =
        Chords::new(mesh, mesh.wires.iter().map(|wire| (wire.vertices, mesh.extents.part(wire.part).scale)));
    let tree = ChordTree::new(&drawn.list);
    let is_free = |wire: &WireChord| !is_covered(wire, &drawn.list, &tree);
    let free: Vec<bool> = wires.list.par_iter().with_min_len(256).map(is_free).collect();
    mesh.wires.iter().zip(free).filter_map(|(wire, free)| free.then_some(*wire)).collect()
}

/// Whether lines cover a wire from end to end.
fn is_covered(wire: &WireChord, lines: &[WireChord], tree: &ChordTree) -> bool {
    let mut ranges: Vec<(f64, f64)> = Vec::new();
    let (low, high) = wire.reach();
    tree.near(low, high, |line| ranges.extend(lines.get(line as usize).and_then(|line| wire.along(line))));
    ranges.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut at = 0.0;
    for (from, to) in &ranges {
        if *from > at + wire.slack {
            return false;
        }
        at = to.max(at);
    }
    !ranges.is_empty() && at + wire.slack >= wire.length
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
    fn reach(&self) -> (DVec3, DVec3) {
        let room = DVec3::splat(self.sagitta.length() + self.slack);
        (self.start.min(self.end()) - room, self.start.max(self.end()) + room)
    }

    /// Range of lengths along this chord where another chord runs next to it.
    fn along(&self, other_chord: &Self) -> Option<(f64, f64)> {
        let cosine = self.along.dot(other_chord.along);
        if cosine.abs() < MIN_CHORD_COSINE {
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
            straighter.filter(|(_, (_, cosine))| *cosine >= MIN_CHORD_COSINE)
        else {
            return DVec3::ZERO;
        };
        // Tangent of half the turn. Equal chords share a turn evenly.
        let half_turn = |cosine: f64| ((1.0 - cosine) / (1.0 + cosine)).max(0.0).sqrt();
        let turn = half_turn(cosine);
        let share = self.next(adjacent).map_or(0.0, |(next_adjacent, cosine)| {
            let (near, far) = (self.list[adjacent.chord].length, self.list[next_adjacent.chord].length);
            if cosine < MIN_CHORD_COSINE { 0.0 } else { half_turn(cosine) * near / (near + far) }
        });
        let own_turn = (turn - share.max(turn / 2.0)).max(0.0);
        let bend = self.direction(walk) * cosine - self.direction(adjacent);
        bend.normalize_or_zero() * (MAX_SAGITTA_RATIO * this_chord.length * own_turn / 2.0)
    }
}

/// Bounding volume hierarchy of chords.
struct ChordTree {
    order: Vec<u32>,
    /// Boxes of the leaves first, the root last.
    levels: Vec<Vec<(DVec3, DVec3)>>,
}

impl ChordTree {
    fn new(chords: &[WireChord]) -> Self {
        let mut items: Vec<(DVec3, u32)> =
            chords.iter().zip(0..).map(|(chord, k)| ((chord.start + chord.end()) / 2.0, k)).collect();
        part(&mut items);
        let order: Vec<u32> = items.into_iter().map(|(_, k)| k).collect();
        let join = |a: (DVec3, DVec3), b: (DVec3, DVec3)| (a.0.min(b.0), a.1.max(b.1));
        let nothing = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let around = |run: &[u32]| run.iter().map(|k| chords[*k as usize].reach()).fold(nothing, join);
        let mut levels: Vec<Vec<(DVec3, DVec3)>> = vec![order.chunks(TREE_FANOUT).map(around).collect()];
        while let Some(last) = levels.last().filter(|last| last.len() > 1) {
            let above = last.chunks(TREE_FANOUT).map(|run| run.iter().copied().fold(nothing, join)).collect();
            levels.push(above);
        }
        Self { order, levels }
    }

    /// Visits the chords in all leaves whose boxes overlap the given box.
    fn near(&self, low: DVec3, high: DVec3, mut visit: impl FnMut(u32)) {
        let mut open: Vec<(usize, usize)> = vec![(self.levels.len() - 1, 0)];
        while let Some((level, k)) = open.pop() {
            let (own_low, own_high) = self.levels[level][k];
            if own_low.cmpgt(high).any() || own_high.cmplt(low).any() {
                continue;
            }
            let below = k * TREE_FANOUT..(k + 1) * TREE_FANOUT;
            if level == 0 {
                self.order[below.start..below.end.min(self.order.len())].iter().for_each(|k| visit(*k));
            } else {
                let below = below.start..below.end.min(self.levels[level - 1].len());
                open.extend(below.map(|k| (level - 1, k)));
            }
        }
    }
}

/// Sorts the items so that nearby ones form runs.
fn part(items: &mut [(DVec3, u32)]) {
    if items.len() <= TREE_FANOUT {
        return;
    }
    let nothing = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = items.iter().fold(nothing, |(low, high), (p, _)| (low.min(*p), high.max(*p)));
    let size = high - low;
    let axis = (0..3).max_by(|a, b| size[*a].total_cmp(&size[*b])).unwrap_or(0);
    // Runs stay whole, so that no box spans two places.
    let middle = (items.len() / 2).next_multiple_of(TREE_FANOUT).min(items.len() - 1);
    items.select_nth_unstable_by(middle, |a, b| a.0[axis].total_cmp(&b.0[axis]).then(a.1.cmp(&b.1)));
    let (near, far) = items.split_at_mut(middle);
    crate::parallel::join(|| part(near), || part(far));
}
