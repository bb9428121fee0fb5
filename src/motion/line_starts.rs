//! [`Starts`]: the vertices at which the lines of a body begin, the same at all times of a clip.

use glam::DVec3;
use rustc_hash::FxHashSet;

use super::moving_bodies::Body;
use super::options::MotionOptions;
use crate::animation::{Moment, Rigged};
use crate::geometry::numbers::noise::hash;
use crate::scene::Geometry;

/// Of so many vertices that chance gives, the one farthest from all others is taken, so that lines do not crowd where the mesh
/// is fine. (Mitchell 1991: the best of several candidates.)
const CANDIDATES: usize = 6;

/// So many vertices tell where the middle of a body is.
const ANCHORS: usize = 64;

/// A line of a body.
pub(crate) struct Start {
    /// Which one it is.
    pub number: usize,
    /// The vertex of the part at which it begins.
    pub vertex: usize,
    /// Whether the style says so.
    pub named: bool,
    /// How long it is.
    pub segments: usize,
    /// The entry of the style's list that is for it.
    pub rule: Option<usize>,
    pub visible: bool,
}

/// Where the lines of a body begin.
pub(crate) struct Starts {
    pub lines: Vec<Start>,
    /// Vertices spread over the body.
    pub anchors: Vec<usize>,
    /// The material at the first line.
    pub material: Option<u32>,
    /// Vertices that the style names and the part does not have.
    pub missing: Vec<u32>,
}

impl Starts {
    /// Chooses vertices of a body by chance: by where they rest, whatever their numbers, or as the style names them.
    pub fn new(rigged: &Rigged, body: &Body, options: &MotionOptions, seed: u64) -> Self {
        let mut own = Self { lines: Vec::new(), anchors: Vec::new(), material: None, missing: Vec::new() };
        let Some(part) = rigged.scene.parts.get(body.part) else { return own };
        let Some(geometry) = rigged.scene.geometries.get(part.geometry) else { return own };
        let joint = rigged.rig.nodes.get(body.node).map_or("", |node| &node.name);
        let rules: Vec<usize> = (0..options.line.len())
            .filter(|k| {
                let names = &options.line[*k].part;
                names.as_ref().is_none_or(|glob| glob.matches(&part.name) || glob.matches(joint))
            })
            .collect();
        let shuffled = shuffled(geometry, body, hash(seed, &[body.identity]));
        let count = rules.len().max(options.lines as usize);
        let mut spread = Spread { geometry, left: shuffled.clone(), taken: Vec::new() };
        for number in 0..count {
            let rule = rules.get(number).copied();
            let change = rule.map(|rule| options.line[rule].clone()).unwrap_or_default();
            let named = change.start.and_then(|vertex| {
                if vertex as usize >= geometry.positions.len() {
                    own.missing.push(vertex);
                }
                body.holds(vertex).then_some(vertex as usize).filter(|v| *v < geometry.positions.len())
            });
            let Some(vertex) = named.or_else(|| spread.next()) else { break };
            spread.taken.push(geometry.positions[vertex]);
            own.lines.push(Start {
                number,
                vertex,
                named: named.is_some(),
                segments: change.length.unwrap_or(options.segments) as usize,
                rule,
                visible: change.visible.unwrap_or(true),
            });
        }
        own.anchors = shuffled.into_iter().take(ANCHORS).collect();
        own.material = own.lines.first().and_then(|line| material_at(geometry, line.vertex));
        own
    }

    /// How fast the vertices are that lines begin at, world units a second: their mean over a step.
    pub fn speed(&self, part: usize, [now, before]: [&Moment; 2], step: f64) -> f64 {
        let way =
            |line: &Start| Some(now.place(part, line.vertex)?.distance(before.place(part, line.vertex)?));
        let ways: Vec<f64> = self.lines.iter().filter_map(way).collect();
        ways.iter().sum::<f64>() / ways.len().max(1) as f64 / step
    }
}

/// The vertices of a body that something is drawn with, one at each place, in an order by chance that rests on their places.
fn shuffled(geometry: &Geometry, body: &Body, seed: u64) -> Vec<usize> {
    let corners = geometry.triangles.as_flattened().iter().chain(geometry.wires.as_flattened());
    let mut met: FxHashSet<[u64; 3]> = FxHashSet::default();
    let mut keyed: Vec<(u64, usize)> = Vec::new();
    for &vertex in corners.filter(|vertex| body.holds(**vertex)) {
        let Some(position) = geometry.positions.get(vertex as usize) else { continue };
        let bits = position.to_array().map(f64::to_bits);
        if met.insert(bits) {
            keyed.push((hash(seed, &bits), vertex as usize));
        }
    }
    keyed.sort_unstable();
    keyed.into_iter().map(|(_, vertex)| vertex).collect()
}

/// Takes vertices one by one, each far from those before it.
struct Spread<'a> {
    geometry: &'a Geometry,
    left: Vec<usize>,
    taken: Vec<DVec3>,
}

impl Spread<'_> {
    fn next(&mut self) -> Option<usize> {
        let place = |vertex: usize| self.geometry.positions[vertex];
        let gap = |vertex: usize| {
            let ways = self.taken.iter().map(|other| other.distance_squared(place(vertex)));
            ways.fold(f64::INFINITY, f64::min)
        };
        let mut best: Option<(usize, f64)> = None;
        for (k, vertex) in self.left.iter().take(CANDIDATES).enumerate() {
            let gap = gap(*vertex);
            if best.is_none_or(|(_, most)| gap > most) {
                best = Some((k, gap));
            }
        }
        // A place that has a line already needs no second one.
        best.filter(|(_, gap)| *gap > 0.0).map(|(k, _)| self.left.remove(k))
    }
}

/// The material of the first triangle at a vertex.
fn material_at(geometry: &Geometry, vertex: usize) -> Option<u32> {
    let first = geometry.triangles.iter().position(|corners| corners.contains(&(vertex as u32)));
    first.map_or(geometry.material, |triangle| geometry.material_of(triangle))
}
