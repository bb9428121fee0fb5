//! [`LineStarts`]: the vertices where the lines of a body start, the same throughout a clip.

use glam::DVec3;
use rustc_hash::FxHashSet;

use super::moving_bodies::MovingBody;
use super::options::MotionOptions;
use crate::animation::{PosedVertices, Rigged};
use crate::geometry::numbers::noise::hash;
use crate::scene::Geometry;

/// Number of random candidates per line. The candidate farthest from all chosen vertices is taken, so that
/// lines do not crowd where the mesh is fine (best-candidate sampling, Mitchell 1991).
const CANDIDATES_PER_LINE: usize = 6;

/// Number of vertices that define the centre of a body.
const MIDDLE_VERTICES: usize = 64;

/// Motion line of a body.
pub(crate) struct LineStart {
    /// Index of the line.
    pub number: usize,
    /// Vertex of the part where it starts.
    pub vertex: usize,
    /// Whether the style names the vertex.
    pub named: bool,
    /// Length in segments.
    pub segments: usize,
    /// Entry of the style's list that applies to it.
    pub rule: Option<usize>,
    pub visible: bool,
}

/// Starts of the lines of a body.
pub(crate) struct LineStarts {
    pub lines: Vec<LineStart>,
    /// Vertices spread over the body.
    pub anchors: Vec<usize>,
    /// Material at the first line.
    pub material: Option<u32>,
    /// Vertices that the style names, but the part lacks.
    pub missing: Vec<u32>,
}

impl LineStarts {
    /// Chooses vertices of a body at random by their rest positions, independent of their numbers, or as the
    /// style names them.
    pub(crate) fn new(rigged: &Rigged, body: &MovingBody, options: &MotionOptions, seed: u64) -> Self {
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
        let mut spread = VertexSpread { geometry, remaining: shuffled.clone(), taken: Vec::new() };
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
            own.lines.push(LineStart {
                number,
                vertex,
                named: named.is_some(),
                segments: change.length.unwrap_or(options.segments) as usize,
                rule,
                visible: change.visible.unwrap_or(true),
            });
        }
        own.anchors = shuffled.into_iter().take(MIDDLE_VERTICES).collect();
        own.material = own.lines.first().and_then(|line| material_at(geometry, line.vertex));
        own
    }

    /// Mean speed over a step of the vertices where lines start, world units per second.
    pub(crate) fn speed(&self, part: usize, [now, before]: [&PosedVertices; 2], step: f64) -> f64 {
        let way =
            |line: &LineStart| Some(now.place(part, line.vertex)?.distance(before.place(part, line.vertex)?));
        let ways: Vec<f64> = self.lines.iter().filter_map(way).collect();
        ways.iter().sum::<f64>() / ways.len().max(1) as f64 / step
    }
}

/// The drawn vertices of a body, one per position, in a random order that depends only on positions.
fn shuffled(geometry: &Geometry, body: &MovingBody, seed: u64) -> Vec<usize> {
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

/// Takes vertices one by one, each far from the earlier ones.
struct VertexSpread<'a> {
    geometry: &'a Geometry,
    remaining: Vec<usize>,
    taken: Vec<DVec3>,
}

impl VertexSpread<'_> {
    fn next(&mut self) -> Option<usize> {
        let position_of = |vertex: usize| self.geometry.positions[vertex];
        let gap = |vertex: usize| {
            let distances = self.taken.iter().map(|other| other.distance_squared(position_of(vertex)));
            distances.fold(f64::INFINITY, f64::min)
        };
        let mut best: Option<(usize, f64)> = None;
        for (k, vertex) in self.remaining.iter().take(CANDIDATES_PER_LINE).enumerate() {
            let gap = gap(*vertex);
            if best.is_none_or(|(_, most)| gap > most) {
                best = Some((k, gap));
            }
        }
        // A position with a line needs no second one.
        best.filter(|(_, gap)| *gap > 0.0).map(|(k, _)| self.remaining.remove(k))
    }
}

/// The material of the first triangle at a vertex.
fn material_at(geometry: &Geometry, vertex: usize) -> Option<u32> {
    let first = geometry.triangles.iter().position(|corners| corners.contains(&(vertex as u32)));
    first.map_or(geometry.material, |triangle| geometry.material_of(triangle))
}
