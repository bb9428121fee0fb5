//! [`Band`]: one channel of light on one face, through which levels are traced.
//!
//! The face is cut until the value is all but linear on its pieces; through each the levels are straight, and their ends are
//! where the value itself is right.

use glam::DVec3;

use super::Lit;
use crate::mesh::FaceId;

/// A piece of a level, and the face it lies on. The brighter side is on its left.
pub(super) type Found = (u32, [DVec3; 2]);

/// A corner of a piece of a face: its barycentric weights and its value.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node {
    pub weights: [f64; 3],
    pub value: f64,
}

/// What is traced: one channel of one face.
pub(super) struct Band<'a> {
    pub lit: &'a Lit<'a>,
    /// A CSS px in user units.
    pub px: f64,
    pub face: u32,
    pub channel: usize,
    pub shadowed: u32,
    pub levels: &'a [f64],
    /// One in so many of them is drawn: the others are too near to it to be seen.
    pub stride: usize,
    /// Values that are off by no more than this cannot be told apart.
    pub alike: f64,
    /// How far the curve may lie from where the level is, px.
    pub near: f64,
    /// How far the value at a point of the curve may be from the level.
    pub exact: f64,
    /// Lengths of the face's sides in the image: opposite corners 0, 1, 2.
    pub sides: [f64; 3],
    /// Their lengths in space.
    pub spans: [f64; 3],
    /// By how much normals turn along them, radians.
    pub turns: [f64; 3],
}

impl Band<'_> {
    /// The point of the face with these weights.
    pub fn node(&self, weights: [f64; 3]) -> Node {
        let point = self.lit.point(self.face, weights);
        let paint = self.lit.mesh.paint(FaceId(self.face));
        Node { weights, value: self.lit.shading.value(self.channel, paint, &point, self.shadowed) }
    }

    /// Traces the levels through the face; these are its corners.
    pub fn trace(&self, corners: [Node; 3], found: &mut Vec<Found>) {
        self.cut(corners, 0, found);
    }

    /// Cuts a piece until the value is all but linear in it, then draws the levels through it.
    ///
    /// Whether a side is cut depends on the side alone, so that the pieces of neighbours meet.
    fn cut(&self, nodes: [Node; 3], depth: u32, found: &mut Vec<Found>) {
        if self.is_out_of_reach(&nodes) {
            return;
        }
        if depth < DEEPEST {
            let middle = |i: usize, j: usize| {
                if self.is_straight(nodes[i], nodes[j]) {
                    return None;
                }
                let middle = self.node(mean(nodes[i].weights, nodes[j].weights));
                self.is_bent(nodes[i], middle, nodes[j]).then_some(middle)
            };
            let middles = [middle(1, 2), middle(2, 0), middle(0, 1)];
            if middles.iter().any(Option::is_some) {
                for piece in pieces(nodes, middles).iter().flatten() {
                    self.cut(*piece, depth + 1, found);
                }
                return;
            }
            if (0..3).all(|k| self.is_straight(nodes[k], nodes[(k + 1) % 3])) {
                self.draw(nodes, found);
                return;
            }
            let third = |k: usize| (nodes[0].weights[k] + nodes[1].weights[k] + nodes[2].weights[k]) / 3.0;
            let centroid = self.node([third(0), third(1), third(2)]);
            let linear = (nodes[0].value + nodes[1].value + nodes[2].value) / 3.0;
            let side = |k: usize| extent(&self.sides, nodes[k].weights, nodes[(k + 1) % 3].weights);
            let longest = (0..3).map(side).fold(0.0, f64::max);
            if self.is_off(&nodes, centroid.value, linear, longest) {
                for k in 0..3 {
                    self.cut([nodes[k], nodes[(k + 1) % 3], centroid], depth + 1, found);
                }
                return;
            }
        }
        self.draw(nodes, found);
    }

    /// Whether no level can be crossed anywhere on a piece, by how far normals turn on it.
    fn is_out_of_reach(&self, nodes: &[Node; 3]) -> bool {
        let most = |of: &[f64; 3]| {
            let side = |k: usize| extent(of, nodes[k].weights, nodes[(k + 1) % 3].weights);
            side(0).max(side(1)).max(side(2))
        };
        let turn = most(&self.turns) * TURN_OF_CHORD;
        let shading = self.lit.shading;
        let (low, high) = if shading.is_local(self.channel) {
            let point = self.lit.point(self.face, nodes[0].weights);
            let paint = self.lit.mesh.paint(FaceId(self.face));
            shading.range(self.channel, paint, &point, self.shadowed, turn, most(&self.spans))
        } else {
            let off = turn * shading.steepness();
            let values = nodes.iter().map(|node| node.value);
            (
                values.clone().fold(f64::INFINITY, f64::min) - off,
                values.fold(f64::NEG_INFINITY, f64::max) + off,
            )
        };
        self.levels.partition_point(|level| *level < low)
            == self.levels.partition_point(|level| *level <= high)
    }

    /// Whether normals turn so little along a side that the value must be all but linear there.
    fn is_straight(&self, a: Node, b: Node) -> bool {
        if self.lit.shading.is_local(self.channel) {
            return false;
        }
        let turn = extent(&self.turns, a.weights, b.weights);
        // What a cosine is off its chord at most.
        let off = turn * turn / 8.0 * self.lit.shading.steepness();
        let length = extent(&self.sides, a.weights, b.weights);
        turn <= MOST_TURN && off * length <= self.near * self.px * (a.value - b.value).abs()
    }

    /// Whether the value along a side bends so much that a level would cross it elsewhere.
    fn is_bent(&self, a: Node, middle: Node, b: Node) -> bool {
        let length = extent(&self.sides, a.weights, b.weights);
        let nodes = [a, b];
        let far_reaching = length > LONGEST_PX * self.px && self.lit.shading.is_local(self.channel);
        let turning = extent(&self.turns, a.weights, b.weights) > MOST_TURN;
        ((far_reaching || turning) && length > SHORTEST_PX * self.px)
            || self.is_off(&nodes, middle.value, f64::midpoint(a.value, b.value), length)
    }

    /// Whether a value differs from the linear one so much that a level would be displaced.
    fn is_off(&self, nodes: &[Node], value: f64, linear: f64, length: f64) -> bool {
        let off = (value - linear).abs();
        if length <= SHORTEST_PX * self.px || off <= self.alike {
            return false;
        }
        let (mut low, mut high) = (value, value);
        for node in nodes {
            low = low.min(node.value);
            high = high.max(node.value);
        }
        let crossed = self.levels.partition_point(|level| *level < low - off)
            < self.levels.partition_point(|level| *level <= high + off);
        crossed && off * length > self.near * self.px * (high - low)
    }

    fn draw(&self, nodes: [Node; 3], found: &mut Vec<Found>) {
        let values = nodes.map(|node| node.value);
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let first = self.levels.partition_point(|level| *level <= low);
        let last = self.levels.partition_point(|level| *level <= high);
        for number in (first..last).filter(|number| (number + 1) % self.stride == 0) {
            let level = &self.levels[number];
            let above = nodes.map(|node| node.value >= *level);
            // The corner that is alone on its side, and the two others.
            let Some(alone) =
                (0..3).find(|k| above[(k + 1) % 3] == above[(k + 2) % 3] && above[*k] != above[(k + 1) % 3])
            else {
                continue;
            };
            let mut ends = [1, 2].map(|k| self.crossing(nodes[alone], nodes[(alone + k) % 3], *level));
            // The brighter side lies on the left.
            if above[alone] {
                ends.swap(0, 1);
            }
            if ends[0] != ends[1] {
                found.push((self.face, ends));
            }
        }
    }

    /// Where a level crosses a side, from below to above.
    fn crossing(&self, a: Node, b: Node, level: f64) -> DVec3 {
        let (low, high) = if a.value < level { (a, b) } else { (b, a) };
        let at = |t: f64| [0, 1, 2].map(|k| low.weights[k] + (high.weights[k] - low.weights[k]) * t);
        let (mut t_low, mut t_high) = (0.0, 1.0);
        let (mut f_low, mut f_high) = (low.value - level, high.value - level);
        let mut t = 0.0;
        let mut stays = 0;
        // Regula falsi after Illinois: an end that stays for a second time counts half.
        for _ in 0..MOST_ROUNDS {
            t = t_low + (t_high - t_low) * (-f_low / (f_high - f_low)).clamp(0.0, 1.0);
            let f = self.node(at(t)).value - level;
            if f.abs() <= self.exact || t_high - t_low <= f64::EPSILON {
                break;
            }
            if f < 0.0 {
                (t_low, f_low) = (t, f);
                f_high = if stays == -1 { f_high / 2.0 } else { f_high };
                stays = -1;
            } else {
                (t_high, f_high) = (t, f);
                f_low = if stays == 1 { f_low / 2.0 } else { f_low };
                stays = 1;
            }
        }
        self.lit.lifted(self.face, at(t), self.px)
    }
}

/// How often a face is cut in two at most, along each side.
const DEEPEST: u32 = 9;

/// Rounds of the search along a side.
const MOST_ROUNDS: u32 = 30;

/// Pieces turn by no more than this, radians, so that no peak hides between their corners.
const MOST_TURN: f64 = 0.25;

/// The angle between two normals is no more than so many times their distance (up to a quarter turn).
const TURN_OF_CHORD: f64 = 1.12;

/// Where light varies from place to place, pieces are no longer than this.
const LONGEST_PX: f64 = 40.0;

/// Pieces this short are not cut again.
const SHORTEST_PX: f64 = 0.5;

/// Half way between two points of a face.
fn mean(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| f64::midpoint(a[k], b[k]))
}

/// How far it is between two points of a face of which these are the sides (each opposite the corner
/// of its number), at most; exact along a side.
pub(super) fn extent(sides: &[f64; 3], a: [f64; 3], b: [f64; 3]) -> f64 {
    let change = |k: usize| (a[k] - b[k]).abs();
    (0..3)
        .map(|k| (k, change((k + 1) % 3).min(change((k + 2) % 3))))
        .filter(|(_, part)| *part > 0.0)
        .map(|(k, part)| sides[k] * part)
        .sum()
}

/// A triangle cut at the middles of some of its sides (each opposite the corner of its number).
pub(super) fn pieces<N: Copy>(n: [N; 3], middles: [Option<N>; 3]) -> [Option<[N; 3]>; 4] {
    // Turned so that the cases below are all there are.
    let turned = |k: usize| {
        ([n[k], n[(k + 1) % 3], n[(k + 2) % 3]], [middles[k], middles[(k + 1) % 3], middles[(k + 2) % 3]])
    };
    for k in 0..3 {
        let ([a, b, c], m) = turned(k);
        match m {
            [Some(p), Some(q), Some(r)] => {
                return [Some([a, r, q]), Some([r, b, p]), Some([q, p, c]), Some([p, q, r])];
            }
            // Two sides that meet in a: the corner is cut off, the rest along a diagonal.
            [None, Some(q), Some(r)] => {
                return [Some([a, r, q]), Some([r, b, c]), Some([r, c, q]), None];
            }
            [Some(p), None, None] => return [Some([a, b, p]), Some([a, p, c]), None, None],
            _ => {}
        }
    }
    [Some(n), None, None, None]
}
