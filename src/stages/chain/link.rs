//! [`Routes`]: which view edges follow each other, every edge in exactly one route.
//!
//! Two edges of one class continue each other where they are the only two of their class at a view
//! vertex. Where more meet, pieces of one feature segment come first, then the straightest pairs,
//! with directions taken over a few px so that the zigzag of small triangles has no say.

use kurbo::Vec2;

use crate::lines::LineKind;
use crate::math::grouped::{Grouped, grouped};
use crate::math::plane::length;
use crate::mesh::{MaterialId, PartId};
use crate::shape::Origin;
use crate::viewmap::{ViewEdge, ViewMap, ViewVertexId};

/// Edges of equal class may join into one chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Class {
    pub kind: LineKind,
    pub part: PartId,
    pub material: MaterialId,
    pub hidden: bool,
    pub silhouette: bool,
    pub both_seen: bool,
    pub origin: Origin,
}

impl Class {
    /// The class of an edge as the view map has it. Hidden pieces of any invisibility are one class.
    pub fn of(edge: &ViewEdge) -> Self {
        Self {
            kind: edge.kind,
            part: edge.part,
            material: edge.material,
            hidden: edge.invisibility > 0,
            silhouette: edge.silhouette,
            both_seen: edge.both_seen,
            origin: edge.origin,
        }
    }

    /// The class without what may change along one line of the surface.
    pub fn of_source(edge: &ViewEdge) -> Self {
        Self { hidden: false, silhouette: false, both_seen: false, ..Self::of(edge) }
    }
}

/// One edge of a route and the sense it is passed in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Step {
    pub edge: u32,
    pub reversed: bool,
}

impl Step {
    fn turned(self) -> Self {
        Self { reversed: !self.reversed, ..self }
    }

    pub fn from(self, map: &ViewMap) -> ViewVertexId {
        let edge = &map.edges[self.edge as usize];
        if self.reversed { edge.end } else { edge.start }
    }

    pub fn to(self, map: &ViewMap) -> ViewVertexId {
        self.turned().from(map)
    }

    /// Length in the image.
    pub fn length(self, map: &ViewMap) -> f64 {
        let at = |v: ViewVertexId| map.vertices[v.index()].position;
        length(at(self.to(map)) - at(self.from(map)))
    }
}

/// Edges in the order and sense in which lines pass through them.
#[derive(Debug, Clone, Default)]
pub(super) struct Routes {
    steps: Vec<Step>,
    spans: Vec<Span>,
}

#[derive(Debug, Clone, Copy)]
struct Span {
    first: u32,
    end: u32,
    closed: bool,
    /// The first of the feature segments it has pieces of.
    segment: u32,
}

impl Routes {
    pub fn len(&self) -> usize {
        self.spans.len()
    }

    /// The steps of a route and whether its end joins its beginning.
    pub fn get(&self, route: usize) -> (&[Step], bool) {
        let span = self.spans[route];
        (&self.steps[span.first as usize..span.end as usize], span.closed)
    }

    pub fn iter(&self) -> impl Iterator<Item = (&[Step], bool)> {
        (0..self.len()).map(|route| self.get(route))
    }
}

const NONE: u32 = u32::MAX;

/// Beyond this many ends at a vertex only pieces of one segment are paired: nothing continues
/// through the tip of a fan.
const MOST_ENDS: usize = 48;

/// Cosine of the sharpest turn (50 degrees) a line takes at a junction of its own class.
const JUNCTION_COSINE: f64 = 0.643;

/// Edge ends around each vertex; end `2e` is the start of edge `e`, `2e + 1` its end.
pub(super) struct Ends(Grouped<u32>);

impl Ends {
    /// Collects the ends of the edges that `keep` admits.
    pub fn new(map: &ViewMap, keep: impl Fn(usize) -> bool) -> Self {
        Self(grouped(map.vertices.len(), |put| {
            for (e, edge) in map.edges.iter().enumerate().filter(|(e, _)| keep(*e)) {
                put(edge.start.index(), (2 * e) as u32);
                put(edge.end.index(), (2 * e + 1) as u32);
            }
        }))
    }

    pub fn at(&self, vertex: usize) -> &[u32] {
        self.0.of(vertex)
    }
}

/// Joins the edges that have a class; `window` is the length over which directions are measured at
/// junctions. The result does not depend on the order or sense of the edges, but for lines that
/// coincide exactly.
pub(super) fn routes(map: &ViewMap, classes: &[Option<Class>], window: f64) -> Routes {
    let partner = pair(map, classes, window);
    let mut used = vec![false; map.edges.len()];
    let mut routes = Routes { steps: Vec::with_capacity(map.edges.len()), spans: Vec::new() };
    // Open routes start at the ends that nothing continues; what they leave is closed.
    for open in [true, false] {
        for end in 0..partner.len() {
            let edge = end / 2;
            if used[edge] || classes[edge].is_none() || (open && partner[end] != NONE) {
                continue;
            }
            let first = routes.steps.len();
            let mut at = end as u32;
            loop {
                used[(at / 2) as usize] = true;
                routes.steps.push(Step { edge: at / 2, reversed: at % 2 == 1 });
                let next = partner[(at ^ 1) as usize];
                if next == NONE || used[(next / 2) as usize] {
                    break;
                }
                at = next;
            }
            let steps = &mut routes.steps[first..];
            make_canonical(map, steps, !open);
            let segments = steps.iter().map(|step| map.edges[step.edge as usize].segment);
            let segment = segments.min().unwrap_or(NONE);
            routes.spans.push(Span {
                first: first as u32,
                end: routes.steps.len() as u32,
                closed: !open,
                segment,
            });
        }
    }
    let steps = &routes.steps;
    routes.spans.sort_by(|a, b| {
        let start = |s: &Span| steps[s.first as usize];
        a.segment.cmp(&b.segment).then_with(|| order(map, start(a), start(b)))
    });
    routes
}

/// The end that continues each end, or [`NONE`].
fn pair(map: &ViewMap, classes: &[Option<Class>], window: f64) -> Vec<u32> {
    let ends = Ends::new(map, |e| classes[e].is_some());
    let mut partner = vec![NONE; 2 * map.edges.len()];
    let mut groups: Vec<Vec<u32>> = Vec::new();
    for vertex in 0..map.vertices.len() {
        let around = ends.at(vertex);
        match around {
            [] | [_] => {}
            [a, b] => {
                if class(classes, *a) == class(classes, *b) {
                    partner[*a as usize] = *b;
                    partner[*b as usize] = *a;
                }
            }
            _ => {
                let mut rest: Vec<u32> = around.to_vec();
                while let Some(&first) = rest.first() {
                    let (group, others): (Vec<u32>, Vec<u32>) =
                        rest.iter().partition(|end| class(classes, **end) == class(classes, first));
                    rest = others;
                    match group[..] {
                        [_] => {}
                        [a, b] => {
                            partner[a as usize] = b;
                            partner[b as usize] = a;
                        }
                        _ => groups.push(group),
                    }
                }
            }
        }
    }
    // Junctions of equal turns are paired by what the edges are, not by where they are in the map.
    for group in &mut groups {
        let step = |end: u32| Step { edge: end / 2, reversed: end % 2 == 1 };
        group.sort_by(|a, b| order(map, step(*a), step(*b)));
    }
    // Directions are all taken before any junction is paired, so that no order matters.
    let matched: Vec<Vec<(u32, u32)>> =
        groups.iter().map(|group| straightest(map, group, &partner, window)).collect();
    for (a, b) in matched.into_iter().flatten() {
        partner[a as usize] = b;
        partner[b as usize] = a;
    }
    partner
}

fn class(classes: &[Option<Class>], end: u32) -> Option<Class> {
    classes[(end / 2) as usize]
}

/// Pairs ends of one class at a junction: pieces of one segment, then the smallest turns.
fn straightest(map: &ViewMap, group: &[u32], partner: &[u32], window: f64) -> Vec<(u32, u32)> {
    let segment = |end: u32| map.edges[(end / 2) as usize].segment;
    let directions: Vec<Vec2> = if group.len() > MOST_ENDS {
        Vec::new()
    } else {
        group.iter().map(|end| direction(map, *end, partner, window)).collect()
    };
    let mut pairs: Vec<(bool, f64, usize, usize)> = Vec::new();
    for i in 0..group.len() {
        for j in i + 1..group.len() {
            let one = segment(group[i]) == segment(group[j]) && group[i] / 2 != group[j] / 2;
            let cosine = match (directions.get(i), directions.get(j)) {
                (Some(a), Some(b)) => -a.dot(*b),
                _ => -1.0,
            };
            if one || cosine > JUNCTION_COSINE {
                pairs.push((one, cosine, i, j));
            }
        }
    }
    pairs.sort_by(|a, b| b.0.cmp(&a.0).then(b.1.total_cmp(&a.1)).then((a.2, a.3).cmp(&(b.2, b.3))));
    let mut taken = vec![false; group.len()];
    let mut matched = Vec::new();
    for (_, _, i, j) in pairs {
        if !taken[i] && !taken[j] {
            taken[i] = true;
            taken[j] = true;
            matched.push((group[i], group[j]));
        }
    }
    matched
}

/// Unit direction in which a line leaves the vertex at `end`, seen over `window`; zero if it does
/// not leave at all.
fn direction(map: &ViewMap, end: u32, partner: &[u32], window: f64) -> Vec2 {
    let position = |end: u32| {
        let edge = &map.edges[(end / 2) as usize];
        map.vertices[if end & 1 == 0 { edge.start } else { edge.end }.index()].position
    };
    let from = position(end);
    let mut at = end;
    let mut to = from;
    for _ in 0..64 {
        to = position(at ^ 1);
        if (to - from).hypot2() >= window * window {
            break;
        }
        match partner[(at ^ 1) as usize] {
            NONE => break,
            next if next / 2 == end / 2 => break,
            next => at = next,
        }
    }
    let way = to - from;
    let length = way.hypot2().sqrt();
    if length > 0.0 { way / length } else { Vec2::ZERO }
}

/// Orders steps by where they begin and end, then by segment: the numbers of segments change with what else is
/// drawn.
fn order(map: &ViewMap, a: Step, b: Step) -> std::cmp::Ordering {
    let segment = |s: Step| map.edges[s.edge as usize].segment;
    let at = |v: ViewVertexId| map.vertices[v.index()].position;
    let (p, q) = (at(a.from(map)), at(b.from(map)));
    let (r, s) = (at(a.to(map)), at(b.to(map)));
    (p.x.total_cmp(&q.x))
        .then(p.y.total_cmp(&q.y))
        .then(r.x.total_cmp(&s.x))
        .then(r.y.total_cmp(&s.y))
        .then(segment(a).cmp(&segment(b)))
}

/// Turns a route to the sense, and a closed one to the start, that its edges alone decide.
fn make_canonical(map: &ViewMap, steps: &mut [Step], closed: bool) {
    let reverse = |steps: &mut [Step]| {
        steps.reverse();
        for step in steps {
            *step = step.turned();
        }
    };
    if closed {
        let lower = |s: Step| if order(map, s, s.turned()).is_le() { s } else { s.turned() };
        let least = |a: &usize, b: &usize| order(map, lower(steps[*a]), lower(steps[*b]));
        let Some(start) = (0..steps.len()).min_by(least) else { return };
        if order(map, steps[start], steps[start].turned()).is_le() {
            steps.rotate_left(start);
        } else {
            reverse(steps);
            let last = steps.len() - 1;
            steps.rotate_left(last - start);
        }
    } else if let (Some(first), Some(last)) = (steps.first(), steps.last())
        && order(map, *first, last.turned()).is_gt()
    {
        reverse(steps);
    }
}
