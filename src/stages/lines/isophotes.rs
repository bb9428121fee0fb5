//! Isophotes: where the tone of the surface changes, traced through the faces.
//!
//! Source: Claes, Di Fiore, Vansichem and Van Reeth, "Fast 3D cartoon rendering with improved
//! quality by exploiting graphics hardware", IVCNZ 2001, sections 3.5 and 3.6: triangles are cut
//! where the tone changes, by the number of tones at their corners, and at the centroid where three
//! meet. Here any number of levels is cut, and instead of at corners the tone is asked with the
//! interpolated unit normal wherever it bends, so that borders are right inside large faces too.

use glam::DVec3;
use rayon::prelude::*;

use super::covered::in_sight;
use super::line::segment;
use super::{FeatureLines, LineKind, Lit, NO_FACE};
use crate::field::SurfacePoint;
use crate::math::tolerance;
use crate::mesh::{FaceId, PaintId};

/// Adds the isophotes of a lit surface, for each of these sets of lights that are in shadow. With `sees_through` gradients have
/// steps behind other faces too.
pub fn find(lit: &Lit, shadowed: &[u32], sees_through: bool, lines: &mut FeatureLines) {
    const CHUNK: usize = 1 << 11;
    let count = lit.mesh.triangles.len();
    let ready = Ready::new(lit, shadowed, sees_through);
    let found: Vec<Vec<(u32, [DVec3; 2])>> = (0..count.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| {
            let mut tracer = Tracer::new(lit, &ready);
            for face in chunk * CHUNK..((chunk + 1) * CHUNK).min(count) {
                if lit.may_be_seen(face) && !lit.mesh.is_degenerate(FaceId(face as u32)) {
                    tracer.trace(face as u32, shadowed);
                }
            }
            tracer.segments
        })
        .collect();
    let found = found.into_iter().flatten().map(|(face, ends)| (face, LineKind::Isophote, ends));
    lines.append_in_faces(lit.mesh, found, |face, kind, ends| {
        segment(lit.mesh, face, [face, NO_FACE], kind, ends)
    });
}

/// A corner of a piece of a face: its barycentric weights, its place in the image, its value.
#[derive(Debug, Clone, Copy)]
struct Node {
    weights: [f64; 3],
    value: f64,
}

/// What is traced: one channel of one face.
#[derive(Clone, Copy)]
struct Band<'a> {
    face: u32,
    channel: usize,
    shadowed: u32,
    levels: &'a [f64],
    /// One in so many of them is drawn: the others are too near to it to be seen.
    stride: usize,
    /// Values that are off by no more than this cannot be told apart.
    alike: f64,
    /// How far the curve may lie from where the level is, px.
    near: f64,
    /// How far the value at a point of the curve may be from the level.
    exact: f64,
    /// Lengths of the face's sides in the image: opposite corners 0, 1, 2.
    sides: [f64; 3],
    /// Their lengths in space.
    spans: [f64; 3],
    /// By how much normals turn along them, radians.
    turns: [f64; 3],
}

struct Tracer<'a> {
    lit: &'a Lit<'a>,
    ready: &'a Ready,
    segments: Vec<(u32, [DVec3; 2])>,
}

/// What is the same for all faces.
struct Ready {
    /// A CSS px in user units.
    px: f64,
    /// For each channel and each set of shadowed lights the values at all normals of a surface that
    /// turns its outside to the eye, then its inside; empty where values vary from place to place.
    values: Vec<Vec<[Vec<f64>; 2]>>,
    /// Where there are gradients, which faces may be seen; empty if all of them.
    in_sight: Vec<bool>,
}

/// A CSS px in user units, on a page of the usual size.
pub(super) fn page_px(lit: &Lit) -> f64 {
    lit.view.frame.width.max(lit.view.frame.height) / PAGE_PX
}

impl Ready {
    fn new(lit: &Lit, shadowed: &[u32], sees_through: bool) -> Self {
        // Values are the same for all paints.
        let paint = PaintId(0);
        let value = |channel: usize, normal: DVec3, shadowed: u32| {
            let point = SurfacePoint { position: DVec3::ZERO, normal, openness: 1.0 };
            lit.shading.value(channel, paint, &point, shadowed)
        };
        let of = |channel: usize, shadowed: u32| {
            if lit.shading.is_local(channel) {
                return [Vec::new(), Vec::new()];
            }
            [1.0, -1.0].map(|side| {
                let normals = lit.normals.normals.par_iter().with_min_len(1 << 12);
                normals.map(|normal| value(channel, *normal * side, shadowed)).collect()
            })
        };
        let channels = 0..lit.shading.channels();
        Self {
            px: page_px(lit),
            values: channels.map(|c| shadowed.iter().map(|s| of(c, *s)).collect()).collect(),
            in_sight: if lit.shading.most_levels() > tolerance::FEW_LEVELS && !sees_through {
                in_sight(lit.mesh, lit.view)
            } else {
                Vec::new()
            },
        }
    }
}

impl<'a> Tracer<'a> {
    fn new(lit: &'a Lit<'a>, ready: &'a Ready) -> Self {
        Self { lit, ready, segments: Vec::new() }
    }

    /// Whether no level can be crossed on a face, told from the values at its corners: inside, they
    /// differ from what lies between by no more than the normals turn.
    fn is_even(&self, face: u32, levels: &[f64], channel: usize, shadow: usize) -> bool {
        let [outside, inside] = &self.ready.values[channel][shadow];
        let values = if self.lit.view.facing[face as usize] { outside } else { inside };
        if values.is_empty() {
            return false;
        }
        let corners = self.lit.normals.corners[face as usize];
        let [a, b, c] = corners.map(|id| values[id as usize]);
        let [n, m, o] = self.lit.normals.of(face);
        let turn2 = n.distance_squared(m).max(m.distance_squared(o)).max(o.distance_squared(n));
        let off = turn2 * self.lit.shading.steepness();
        let (low, high) = (a.min(b).min(c) - off, a.max(b).max(c) + off);
        levels.partition_point(|level| *level < low) == levels.partition_point(|level| *level <= high)
    }

    fn trace(&mut self, face: u32, shadowed: &[u32]) {
        let Lit { mesh, view, normals, shading, .. } = self.lit;
        let corners = mesh.triangles[face as usize].map(|v| view.points[v as usize]);
        let length = |i: usize, j: usize| {
            let way = corners[j].truncate() - corners[i].truncate();
            // A side that the near plane cuts is as long as can be.
            if way.is_nan() || corners[i].z.is_nan() || corners[j].z.is_nan() {
                f64::INFINITY
            } else {
                way.length()
            }
        };
        let sides = [length(1, 2), length(2, 0), length(0, 1)];
        let p = mesh.corners(FaceId(face));
        let spans = [p[1].distance(p[2]), p[2].distance(p[0]), p[0].distance(p[1])];
        let n = normals.of(face);
        let turns = [n[1].distance(n[2]), n[2].distance(n[0]), n[0].distance(n[1])];
        let is_flat = turns.iter().all(|turn| *turn == 0.0);
        let own = [mesh.paint(FaceId(face))];
        let shown = self.paints_shown(face);
        let paints = shown.as_deref().unwrap_or(&own);
        let bands = (0..shading.channels()).flat_map(|channel| {
            paints.iter().enumerate().map(move |(k, paint)| (channel, k, shading.levels(*paint, channel)))
        });
        for (channel, k, levels) in bands {
            if levels.is_empty() || (is_flat && !shading.is_local(channel)) {
                continue;
            }
            if paints[..k].iter().any(|paint| shading.levels(*paint, channel) == levels) {
                continue;
            }
            let is_hidden = || self.ready.in_sight.get(face as usize) == Some(&false);
            if self.lit.is_gradient(channel, levels) && is_hidden() {
                continue;
            }
            for (shadow, shadowed) in shadowed.iter().enumerate() {
                if self.is_even(face, levels, channel, shadow) {
                    continue;
                }
                let alike = alike(levels);
                // Strokes of a hatching end there, one by one: less will do.
                let (near, exact) = if shading.bins() == Some(channel) {
                    (tolerance::BIN_PX, tolerance::BIN_VALUE)
                } else if self.lit.is_gradient(channel, levels) {
                    (tolerance::BIN_PX, tolerance::GRADIENT_VALUE)
                } else {
                    (tolerance::ISOPHOTE_PX, tolerance::ISOPHOTE_VALUE)
                };
                let shadowed = *shadowed;
                let stride = self.lit.stride(face, channel, levels, shadowed);
                let band =
                    Band { face, channel, shadowed, levels, stride, alike, near, exact, sides, spans, turns };
                let nodes = [0, 1, 2].map(|k| self.corner(&band, k, shadow));
                self.cut(&band, nodes, 0);
            }
        }
    }

    /// The paints that a face shows, if they differ in their levels.
    fn paints_shown(&self, face: u32) -> Option<Vec<PaintId>> {
        let Lit { mesh, shading, textures, .. } = self.lit;
        let textured = textures.on(mesh, face)?;
        let (first, others) = textured.palette().split_first()?;
        let differs =
            |channel| others.iter().any(|p| shading.levels(*p, channel) != shading.levels(*first, channel));
        Some(if (0..shading.channels()).any(differs) { textured.paints() } else { vec![*first] })
    }

    /// A corner of a face.
    fn corner(&self, band: &Band, k: usize, shadow: usize) -> Node {
        let [outside, inside] = &self.ready.values[band.channel][shadow];
        let values = if self.lit.view.facing[band.face as usize] { outside } else { inside };
        match values.get(self.lit.normals.corners[band.face as usize][k] as usize) {
            Some(value) => Node { weights: UNIT[k], value: *value },
            None => self.node(band, UNIT[k]),
        }
    }

    fn node(&self, band: &Band, weights: [f64; 3]) -> Node {
        let point = self.lit.point(band.face, weights);
        let paint = self.lit.mesh.paint(FaceId(band.face));
        Node { weights, value: self.lit.shading.value(band.channel, paint, &point, band.shadowed) }
    }

    /// Cuts a piece until the value is all but linear in it, then draws the levels through it.
    ///
    /// Whether a side is cut depends on the side alone, so that the pieces of neighbours meet.
    fn cut(&mut self, band: &Band, nodes: [Node; 3], depth: u32) {
        if self.is_out_of_reach(band, &nodes) {
            return;
        }
        if depth < DEEPEST {
            let middle = |i: usize, j: usize| {
                if self.is_straight(band, nodes[i], nodes[j]) {
                    return None;
                }
                let middle = self.node(band, mean(nodes[i].weights, nodes[j].weights));
                self.is_bent(band, nodes[i], middle, nodes[j]).then_some(middle)
            };
            let middles = [middle(1, 2), middle(2, 0), middle(0, 1)];
            if middles.iter().any(Option::is_some) {
                for piece in pieces(nodes, middles).iter().flatten() {
                    self.cut(band, *piece, depth + 1);
                }
                return;
            }
            if (0..3).all(|k| self.is_straight(band, nodes[k], nodes[(k + 1) % 3])) {
                self.draw(band, nodes);
                return;
            }
            let third = |k: usize| (nodes[0].weights[k] + nodes[1].weights[k] + nodes[2].weights[k]) / 3.0;
            let centroid = self.node(band, [third(0), third(1), third(2)]);
            let linear = (nodes[0].value + nodes[1].value + nodes[2].value) / 3.0;
            let side = |k: usize| extent(&band.sides, nodes[k].weights, nodes[(k + 1) % 3].weights);
            let longest = (0..3).map(side).fold(0.0, f64::max);
            if self.is_off(band, &nodes, centroid.value, linear, longest) {
                for k in 0..3 {
                    self.cut(band, [nodes[k], nodes[(k + 1) % 3], centroid], depth + 1);
                }
                return;
            }
        }
        self.draw(band, nodes);
    }

    /// Whether no level can be crossed anywhere on a piece, by how far normals turn on it.
    fn is_out_of_reach(&self, band: &Band, nodes: &[Node; 3]) -> bool {
        let most = |of: &[f64; 3]| {
            let side = |k: usize| extent(of, nodes[k].weights, nodes[(k + 1) % 3].weights);
            side(0).max(side(1)).max(side(2))
        };
        let turn = most(&band.turns) * TURN_OF_CHORD;
        let shading = self.lit.shading;
        let (low, high) = if shading.is_local(band.channel) {
            let point = self.lit.point(band.face, nodes[0].weights);
            let paint = self.lit.mesh.paint(FaceId(band.face));
            shading.range(band.channel, paint, &point, band.shadowed, turn, most(&band.spans))
        } else {
            let off = turn * shading.steepness();
            let values = nodes.iter().map(|node| node.value);
            (
                values.clone().fold(f64::INFINITY, f64::min) - off,
                values.fold(f64::NEG_INFINITY, f64::max) + off,
            )
        };
        band.levels.partition_point(|level| *level < low)
            == band.levels.partition_point(|level| *level <= high)
    }

    /// Whether normals turn so little along a side that the value must be all but linear there.
    fn is_straight(&self, band: &Band, a: Node, b: Node) -> bool {
        if self.lit.shading.is_local(band.channel) {
            return false;
        }
        let turn = extent(&band.turns, a.weights, b.weights);
        // What a cosine is off its chord at most.
        let off = turn * turn / 8.0 * self.lit.shading.steepness();
        let length = extent(&band.sides, a.weights, b.weights);
        turn <= MOST_TURN && off * length <= band.near * self.ready.px * (a.value - b.value).abs()
    }

    /// Whether the value along a side bends so much that a level would cross it elsewhere.
    fn is_bent(&self, band: &Band, a: Node, middle: Node, b: Node) -> bool {
        let length = extent(&band.sides, a.weights, b.weights);
        let nodes = [a, b];
        let far_reaching = length > LONGEST_PX * self.ready.px && self.lit.shading.is_local(band.channel);
        let turning = extent(&band.turns, a.weights, b.weights) > MOST_TURN;
        ((far_reaching || turning) && length > SHORTEST_PX * self.ready.px)
            || self.is_off(band, &nodes, middle.value, f64::midpoint(a.value, b.value), length)
    }

    /// Whether a value differs from the linear one so much that a level would be displaced.
    fn is_off(&self, band: &Band, nodes: &[Node], value: f64, linear: f64, length: f64) -> bool {
        let off = (value - linear).abs();
        if length <= SHORTEST_PX * self.ready.px || off <= band.alike {
            return false;
        }
        let (mut low, mut high) = (value, value);
        for node in nodes {
            low = low.min(node.value);
            high = high.max(node.value);
        }
        let crossed = band.levels.partition_point(|level| *level < low - off)
            < band.levels.partition_point(|level| *level <= high + off);
        crossed && off * length > band.near * self.ready.px * (high - low)
    }

    fn draw(&mut self, band: &Band, nodes: [Node; 3]) {
        let values = nodes.map(|node| node.value);
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let first = band.levels.partition_point(|level| *level <= low);
        let last = band.levels.partition_point(|level| *level <= high);
        for number in (first..last).filter(|number| (number + 1) % band.stride == 0) {
            let level = &band.levels[number];
            let above = nodes.map(|node| node.value >= *level);
            // The corner that is alone on its side, and the two others.
            let Some(alone) =
                (0..3).find(|k| above[(k + 1) % 3] == above[(k + 2) % 3] && above[*k] != above[(k + 1) % 3])
            else {
                continue;
            };
            let mut ends = [1, 2].map(|k| self.crossing(band, nodes[alone], nodes[(alone + k) % 3], *level));
            // The brighter side lies on the left.
            if above[alone] {
                ends.swap(0, 1);
            }
            if ends[0] != ends[1] {
                self.segments.push((band.face, ends));
            }
        }
    }

    /// Where a level crosses a side, from below to above.
    fn crossing(&self, band: &Band, a: Node, b: Node, level: f64) -> DVec3 {
        let (low, high) = if a.value < level { (a, b) } else { (b, a) };
        let at = |t: f64| [0, 1, 2].map(|k| low.weights[k] + (high.weights[k] - low.weights[k]) * t);
        let (mut t_low, mut t_high) = (0.0, 1.0);
        let (mut f_low, mut f_high) = (low.value - level, high.value - level);
        let mut t = 0.0;
        let mut stays = 0;
        // Regula falsi after Illinois: an end that stays for a second time counts half.
        for _ in 0..MOST_ROUNDS {
            t = t_low + (t_high - t_low) * (-f_low / (f_high - f_low)).clamp(0.0, 1.0);
            let f = self.node(band, at(t)).value - level;
            if f.abs() <= band.exact || t_high - t_low <= f64::EPSILON {
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
        self.lit.lifted(band.face, at(t), self.ready.px)
    }
}

/// The corners of a face.
const UNIT: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

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

/// Pages count as this many px wide.
const PAGE_PX: f64 = 1000.0;

/// Fewer levels than this part tones that the eye tells apart, so that their borders must be right.
const FEW_LEVELS: usize = 16;

/// Where there are many, values need be no better than this part of a step.
const ALIKE: f64 = 0.05;

/// By how much values may be off without a difference that is seen.
fn alike(levels: &[f64]) -> f64 {
    match levels {
        [first, .., last] if levels.len() >= FEW_LEVELS => ALIKE * (last - first) / (levels.len() - 1) as f64,
        _ => 0.0,
    }
}

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
