//! [`LevelTracer`]: traces the levels of one channel of light on one face.
//!
//! 1. The face is subdivided until light is almost linear on each piece.
//! 2. On a piece each level is a straight segment.
//! 3. Its ends are exact: they are found on the sides by root finding.

use glam::DVec3;

use crate::light::{LightSlope, SurfacePoint, TURN_PER_CHORD};
use crate::lines::Lit;
use crate::lines::tolerances;
use crate::mesh::PaintId;

/// Segment of a level, and the face it lies on. The brighter side is on its left.
pub(crate) type LevelSegment = (u32, [DVec3; 2]);

/// Corner of a piece of a face: barycentric weights and light.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FaceSample {
    pub weights: [f64; 3],
    pub value: f64,
}

/// Tracer of one channel of light on one face.
pub(crate) struct LevelTracer<'a> {
    pub lit: &'a Lit<'a>,
    /// A CSS px in user units.
    pub px: f64,
    pub face: u32,
    pub paint: PaintId,
    /// Normals at the corners of the face.
    pub normals: [DVec3; 3],
    pub channel: usize,
    /// Whether the light depends on position, and not on the normal alone.
    pub is_local: bool,
    /// Bound on the change of light with the normal, if it is not local.
    pub slope: LightSlope,
    pub shadowed: u32,
    pub levels: &'a [f64],
    /// Only each `stride`-th level is traced, since the others are too close to be seen.
    pub stride: usize,
    /// Largest invisible error of light.
    pub max_light_error: f64,
    /// Largest error of a curve's position, px.
    pub max_position_error: f64,
    /// Largest error of light at a point of the curve.
    pub exact: f64,
    pub measures: FaceExtents,
}

/// Measures along the sides of a face; entry k is for the side opposite corner k.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FaceExtents {
    /// Lengths in the image.
    pub sides: [f64; 3],
    /// Lengths in space.
    pub spans: [f64; 3],
    /// Turns of the normal, radians.
    pub turns: [f64; 3],
}

/// Side of a piece of a face.
#[derive(Clone, Copy)]
struct PieceSide {
    /// Turn of the normal along it, radians.
    turn: f64,
    /// Length in the image.
    length: f64,
    /// Whether the normal turns so little that light is almost linear.
    is_straight: bool,
}

impl LevelTracer<'_> {
    /// Light at the point with the given weights.
    pub(crate) fn node(&self, weights: [f64; 3]) -> FaceSample {
        FaceSample {
            weights,
            value: self.lit.shading.value(self.channel, self.paint, &self.point(weights), self.shadowed),
        }
    }

    /// Surface point with the given weights, with the properties that this channel needs.
    fn point(&self, weights: [f64; 3]) -> SurfacePoint {
        if !self.is_local {
            let normal = self.lit.normal(self.face, &self.normals, weights);
            // Without a normal, the direction to the camera replaces it, and that depends on position.
            if normal != DVec3::ZERO {
                return SurfacePoint { position: DVec3::ZERO, normal, ambient_visibility: 1.0 };
            }
        }
        self.lit.point(self.face, weights)
    }

    /// Traces the levels through the face, given its corners.
    pub(crate) fn trace(&self, corners: [FaceSample; 3], found: &mut Vec<LevelSegment>) {
        self.cut(corners, 0, found);
    }

    /// Subdivides a piece until light is almost linear on it, then draws the levels.
    ///
    /// Whether a side is split depends on the side alone, so that neighbouring pieces share their points.
    fn cut(&self, nodes: [FaceSample; 3], depth: u32, found: &mut Vec<LevelSegment>) {
        let turns = [self.turn(&nodes, 0), self.turn(&nodes, 1), self.turn(&nodes, 2)];
        if self.is_out_of_reach(&nodes, turns) {
            return;
        }
        if depth >= MAX_SPLITS {
            self.draw(nodes, found);
            return;
        }
        let mut sides = [PieceSide { turn: 0.0, length: 0.0, is_straight: true }; 3];
        let mut middles = [None; 3];
        for k in 0..3 {
            let (a, b) = (nodes[(k + 1) % 3], nodes[(k + 2) % 3]);
            sides[k] = self.side(a, b, turns[k]);
            if !sides[k].is_straight {
                let middle = self.node(midpoint_weights(a.weights, b.weights));
                if self.is_bent(a, middle, b, sides[k]) {
                    middles[k] = Some(middle);
                }
            }
        }
        if middles.iter().any(Option::is_some) {
            for piece in split_triangle(nodes, middles).iter().flatten() {
                self.cut(*piece, depth + 1, found);
            }
            return;
        }
        if sides.iter().all(|side| side.is_straight) {
            self.draw(nodes, found);
            return;
        }
        let third = |k: usize| (nodes[0].weights[k] + nodes[1].weights[k] + nodes[2].weights[k]) / 3.0;
        let centroid = self.node([third(0), third(1), third(2)]);
        let linear = (nodes[0].value + nodes[1].value + nodes[2].value) / 3.0;
        let longest = sides.iter().fold(0.0, |longest: f64, side| longest.max(side.length));
        if self.is_off(&nodes, centroid.value, linear, longest) {
            for k in 0..3 {
                self.cut([nodes[k], nodes[(k + 1) % 3], centroid], depth + 1, found);
            }
            return;
        }
        self.draw(nodes, found);
    }

    /// Bound on the turn of the normal along the side opposite a corner, radians.
    fn turn(&self, nodes: &[FaceSample; 3], opposite: usize) -> f64 {
        max_extent(&self.measures.turns, nodes[(opposite + 1) % 3].weights, nodes[(opposite + 2) % 3].weights)
    }

    /// Whether no level can cross a piece, by the turn of normals along its sides.
    fn is_out_of_reach(&self, nodes: &[FaceSample; 3], turns: [f64; 3]) -> bool {
        let turn = turns[0].max(turns[1]).max(turns[2]);
        let (low, high) = if self.is_local {
            let span =
                |a: usize, b: usize| max_extent(&self.measures.spans, nodes[a].weights, nodes[b].weights);
            let longest = span(0, 1).max(span(1, 2)).max(span(2, 0));
            let point = self.lit.point(self.face, nodes[0].weights);
            let turn = turn * TURN_PER_CHORD;
            self.lit.shading.range(self.channel, self.paint, &point, self.shadowed, turn, longest)
        } else {
            let [a, b, c] = [nodes[0].value, nodes[1].value, nodes[2].value];
            self.slope.between([a.min(b).min(c), a.max(b).max(c)], turn).into()
        };
        self.levels.partition_point(|level| *level < low)
            == self.levels.partition_point(|level| *level <= high)
    }

    /// A side of a piece, given the turn of the normal along it.
    fn side(&self, a: FaceSample, b: FaceSample, turn: f64) -> PieceSide {
        let length = max_extent(&self.measures.sides, a.weights, b.weights);
        // Largest deviation of a cosine from its chord.
        let off = turn * turn / 8.0 * self.slope.most;
        let is_straight = !self.is_local
            && turn <= MAX_TURN_RAD
            && off * length <= self.max_position_error * self.px * (a.value - b.value).abs();
        PieceSide { turn, length, is_straight }
    }

    /// Whether light along a side is so far from linear that a level would move.
    fn is_bent(&self, a: FaceSample, middle: FaceSample, b: FaceSample, side: PieceSide) -> bool {
        let PieceSide { turn, length, .. } = side;
        let far_reaching = length > MAX_LOCAL_SIDE_PX * self.px && self.is_local;
        ((far_reaching || turn > MAX_TURN_RAD) && length > MIN_SIDE_PX * self.px)
            || self.is_off(&[a, b], middle.value, f64::midpoint(a.value, b.value), length)
    }

    /// Whether the difference between a value and the linear one would move a level.
    fn is_off(&self, nodes: &[FaceSample], value: f64, linear: f64, length: f64) -> bool {
        let off = (value - linear).abs();
        if length <= MIN_SIDE_PX * self.px || off <= self.max_light_error {
            return false;
        }
        let (mut low, mut high) = (value, value);
        for node in nodes {
            low = low.min(node.value);
            high = high.max(node.value);
        }
        let crossed = self.levels.partition_point(|level| *level < low - off)
            < self.levels.partition_point(|level| *level <= high + off);
        crossed && off * length > self.max_position_error * self.px * (high - low)
    }

    fn draw(&self, nodes: [FaceSample; 3], found: &mut Vec<LevelSegment>) {
        let values = nodes.map(|node| node.value);
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let first = self.levels.partition_point(|level| *level <= low);
        let last = self.levels.partition_point(|level| *level <= high);
        for number in (first..last).filter(|number| (number + 1) % self.stride == 0) {
            let level = &self.levels[number];
            let above = nodes.map(|node| node.value >= *level);
            // The corner that is alone on its side of the level.
            let Some(alone) =
                (0..3).find(|k| above[(k + 1) % 3] == above[(k + 2) % 3] && above[*k] != above[(k + 1) % 3])
            else {
                continue;
            };
            let mut ends = [1, 2].map(|k| self.crossing(nodes[alone], nodes[(alone + k) % 3], *level));
            // The brighter side is on the left.
            if above[alone] {
                ends.swap(0, 1);
            }
            if ends[0] != ends[1] {
                found.push((self.face, ends));
            }
        }
    }

    /// Point where a level crosses a side.
    fn crossing(&self, a: FaceSample, b: FaceSample, level: f64) -> DVec3 {
        let (low, high) = if a.value < level { (a, b) } else { (b, a) };
        let at = |t: f64| {
            let weight = |k: usize| low.weights[k] + (high.weights[k] - low.weights[k]) * t;
            [weight(0), weight(1), weight(2)]
        };
        let (mut t_low, mut t_high) = (0.0, 1.0);
        let (mut f_low, mut f_high) = (low.value - level, high.value - level);
        let mut t = 0.0;
        let mut stays = 0;
        // Illinois variant of regula falsi: the weight of an end that stays twice is halved.
        for _ in 0..MAX_ROOT_STEPS {
            t = t_low + (t_high - t_low) * (-f_low / (f_high - f_low)).clamp(0.0, 1.0);
            let f = self.node(at(t)).value - level;
            if f.abs() <= self.exact || t_high - t_low <= tolerances::MIN_ROOT_INTERVAL {
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

/// Maximum depth of subdivision.
const MAX_SPLITS: u32 = 9;

/// Maximum number of root-finding steps.
const MAX_ROOT_STEPS: u32 = 30;

/// Largest turn of the normal along a side, radians, so that no peak is missed between corners.
const MAX_TURN_RAD: f64 = 0.25;

/// Largest side of a piece where light depends on position, px.
const MAX_LOCAL_SIDE_PX: f64 = 40.0;

/// Sides shorter than this are not split, px.
const MIN_SIDE_PX: f64 = 0.5;

/// Midpoint of two points of a face.
fn midpoint_weights(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [f64::midpoint(a[0], b[0]), f64::midpoint(a[1], b[1]), f64::midpoint(a[2], b[2])]
}

/// Upper bound on a measure between two points of a face, from the measures of its sides. Exact along a side.
#[inline]
pub(crate) fn max_extent(sides: &[f64; 3], a: [f64; 3], b: [f64; 3]) -> f64 {
    let change = [(a[0] - b[0]).abs(), (a[1] - b[1]).abs(), (a[2] - b[2]).abs()];
    let mut sum = 0.0;
    for k in 0..3 {
        let part = change[(k + 1) % 3].min(change[(k + 2) % 3]);
        // A side may have unlimited length.
        if part > 0.0 {
            sum += sides[k] * part;
        }
    }
    sum
}

/// Splits a triangle at the midpoints of some of its sides. Midpoint k is on the side opposite corner k.
pub(crate) fn split_triangle<N: Copy>(n: [N; 3], middles: [Option<N>; 3]) -> [Option<[N; 3]>; 4] {
    // Rotated so that the cases below are complete.
    let turned = |k: usize| {
        ([n[k], n[(k + 1) % 3], n[(k + 2) % 3]], [middles[k], middles[(k + 1) % 3], middles[(k + 2) % 3]])
    };
    for k in 0..3 {
        let ([a, b, c], m) = turned(k);
        match m {
            [Some(p), Some(q), Some(r)] => {
                return [Some([a, r, q]), Some([r, b, p]), Some([q, p, c]), Some([p, q, r])];
            }
            // Two split sides that meet in `a`: the corner is cut off, and the rest is split along a
            // diagonal.
            [None, Some(q), Some(r)] => {
                return [Some([a, r, q]), Some([r, b, c]), Some([r, c, q]), None];
            }
            [Some(p), None, None] => return [Some([a, b, p]), Some([a, p, c]), None, None],
            _ => {}
        }
    }
    [Some(n), None, None, None]
}
