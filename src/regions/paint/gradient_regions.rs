//! [`Ramp`]: bands of light with straight, parallel borders, joined into one region with a gradient.
//!
//! Where light is almost linear in one direction, as on a cylinder, its steps end in parallel lines. Bands
//! are joined under two conditions:
//!
//! - Every border between two bands stays within a tolerance of one line across the gradient.
//! - No band extends past its own borders.
//!
//! Then no point is painted a step lighter or darker than its band would be.

use crate::geometry::lists::disjoint_sets::UnionFind;
use std::collections::BTreeMap;

use kurbo::{Point, Vec2};

use crate::colour::srgb::Colour;
use crate::drawing::Gradient;
use crate::geometry::plane::douglas_peucker::{douglas_peucker, farthest_point};
use crate::regions::cells::border_arcs::{Borders, OUTSIDE_PATCH, RawArc};
use crate::regions::cells::label_components::LabelComponents;
use crate::regions::cells::triangulation::Triangulation;
use crate::regions::labels::surface_label::SurfaceLabel;

/// Tones along a direction.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Ramp {
    /// Unit direction of increasing tone.
    pub way: Vec2,
    /// For each border, ascending: its position along `way`, and the tones before and after it.
    pub steps: Vec<(f64, [u16; 2])>,
}

/// Gradient of a ramp, on a page where the ramp's frame lies at `offset`. The border of two tones is halfway
/// between them.
pub(crate) fn gradient(ramp: &Ramp, colour: impl Fn(u16) -> Colour, offset: Vec2) -> Gradient {
    let mut shades: Vec<(f64, [f64; 3])> = Vec::with_capacity(ramp.steps.len() + 2);
    let mut alpha = 255;
    let mut last = None;
    for (k, (at, tones)) in ramp.steps.iter().enumerate() {
        let [below, above] = tones.map(&colour);
        alpha = below.a;
        let adjacent_step = if k == 0 { ramp.steps.get(1) } else { ramp.steps.get(k - 1) };
        let half = adjacent_step.map_or(0.0, |(other, _)| (at - other).abs() / 2.0);
        if k == 0 {
            shades.push((at - half, below.channels()));
        }
        let (a, b) = (below.channels(), above.channels());
        shades.push((*at, [0, 1, 2].map(|c| f64::midpoint(a[c], b[c]))));
        last = Some((at + half, above.channels()));
    }
    shades.extend(last);
    let from = shades.first().map_or(0.0, |shade| shade.0);
    let length = shades.last().map_or(0.0, |shade| shade.0) - from;
    let kept = needed_stops(&shades);
    let stop_offset = |at: f64| if length > 0.0 { (at - from) / length } else { 0.0 };
    let stop = |(at, channels): &(f64, [f64; 3])| {
        (stop_offset(*at), Colour { a: alpha, ..Colour::from_channels(*channels) })
    };
    let stops = shades.iter().zip(&kept).filter(|(_, kept)| **kept).map(|(shade, _)| stop(shade)).collect();
    let at = |along: f64| (ramp.way * along + offset).to_point();
    Gradient { start: at(from), end: at(from + length), stops }
}

/// Whether each stop is needed. All others lie on the line between their neighbours.
fn needed_stops(shades: &[(f64, [f64; 3])]) -> Vec<bool> {
    let ends = [0, shades.len().saturating_sub(1)];
    douglas_peucker(shades.len(), &ends[..shades.len().min(2)], |first, last| {
        let (a, b) = (shades[first], shades[last]);
        let off = |k: usize| {
            let (at, shade) = shades[k];
            let t = if b.0 > a.0 { (at - a.0) / (b.0 - a.0) } else { 0.0 };
            let channel_error = |c: usize| (shade[c] - a.1[c] - (b.1[c] - a.1[c]) * t).abs();
            [0, 1, 2].map(channel_error).into_iter().fold(0.0, f64::max)
        };
        farthest_point(first + 1..last, off, MAX_CHANNEL_ERROR)
    })
}

/// Largest invisible error of a colour channel, 0 to 1.
const MAX_CHANNEL_ERROR: f64 = 0.6 / 255.0;

/// Minimum number of steps of a ramp. With fewer a gradient saves nothing.
const MIN_RAMP_STEPS: usize = 3;

/// How far a band may extend past its borders, in tolerances.
const MAX_OVERHANG_TOLERANCES: f64 = 2.0;

/// Straight border between two bands of one surface, on the page.
struct BandBorder {
    /// Index of its arc.
    arc: usize,
    /// Darker patch and lighter patch.
    patches: [u32; 2],
    tones: [u16; 2],
    ends: [Point; 2],
    /// Unit normal, towards the lighter side.
    normal: Vec2,
    length: f64,
}

/// Patches that may become one region.
#[derive(Default)]
struct RampGroup {
    direction: Vec2,
    /// Indices of the borders inside the group.
    steps: Vec<usize>,
    /// Range of positions of the borders, for each pair of tones.
    spans: Spans,
    is_broken: bool,
}

type Spans = BTreeMap<[u16; 2], (f64, f64)>;

/// Joins bands into ramps, and gives their patches a common number. Returns one entry per patch.
pub(crate) fn join(
    cut: &Triangulation,
    patches: &mut LabelComponents,
    table: &[SurfaceLabel],
    borders: &Borders,
    unit: f64,
    tolerance: f64,
) -> Vec<Option<Ramp>> {
    let count = patches.labels.len();
    let look = |patch: u32| patches.labels[patch as usize].checked_sub(1).and_then(|k| table.get(k as usize));
    let points: Vec<Vec<Point>> = borders
        .arcs
        .iter()
        .map(|arc| arc.points.iter().map(|v| cut.points[*v as usize]))
        .map(|points| points.map(|[x, y]| Point::new(x as f64 * unit, y as f64 * unit)).collect())
        .collect();
    let mut steps: Vec<BandBorder> = Vec::new();
    for (number, (arc, points)) in borders.arcs.iter().zip(&points).enumerate() {
        steps.extend(straight(number, arc, points, look, tolerance));
    }
    steps.sort_by(|a, b| b.length.total_cmp(&a.length).then(a.arc.cmp(&b.arc)));

    let mut joined = RampGroups { sets: UnionFind::new(count), groups: BTreeMap::new() };
    for number in 0..steps.len() {
        joined.join(&steps, number, tolerance);
    }
    joined.break_up(borders, &points, look, tolerance);

    let mut ramps = vec![None; count];
    let mut members: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for patch in 0..count as u32 {
        let root = joined.sets.root(patch);
        if joined.groups.get(&root).is_some_and(|g| !g.is_broken && g.spans.len() >= MIN_RAMP_STEPS) {
            members.entry(root).or_default().push(patch);
        }
    }
    let mut number: Vec<u32> = (0..count as u32).collect();
    for (root, mut own) in members {
        let Some(group) = joined.groups.get(&root) else { continue };
        let middle = |(from, to): (f64, f64)| f64::midpoint(from, to);
        let steps = group.spans.iter().map(|(tones, span)| (middle(*span), *tones)).collect();
        ramps[root as usize] = Some(Ramp { way: group.direction, steps });
        for patch in &own {
            number[*patch as usize] = root;
            if *patch != root {
                patches.area2[root as usize] += std::mem::take(&mut patches.area2[*patch as usize]);
            }
        }
        // The region gets the label of its middle tone.
        own.sort_by_key(|patch| (patches.labels[*patch as usize], *patch));
        patches.labels[root as usize] = patches.labels[own[own.len() / 2] as usize];
    }
    patches.component_of_triangle.iter_mut().for_each(|patch| *patch = number[*patch as usize]);
    ramps
}

/// The arc as a border between two bands, if it is straight.
fn straight<'a>(
    arc: usize,
    raw: &RawArc,
    points: &[Point],
    look: impl Fn(u32) -> Option<&'a SurfaceLabel>,
    tolerance: f64,
) -> Option<BandBorder> {
    let [left, right] = raw.sides;
    if raw.closed || left == OUTSIDE_PATCH || right == OUTSIDE_PATCH || left == right {
        return None;
    }
    let (a, b) = (look(left)?, look(right)?);
    if (SurfaceLabel { tone: b.tone, ..*a }) != *b || a.tone == b.tone {
        return None;
    }
    let (first, last) = (*points.first()?, *points.last()?);
    let length = (last - first).hypot2().sqrt();
    // Shorter borders have no reliable direction.
    if length < tolerance * 4.0 {
        return None;
    }
    let along = (last - first) / length;
    // The left side, turning from x to y.
    let to_left = Vec2::new(-along.y, along.x);
    let is_near = |p: &Point| (*p - first).dot(to_left).abs() <= tolerance;
    let (patches, tones, way) = if a.tone > b.tone {
        ([right, left], [b.tone, a.tone], to_left)
    } else {
        ([left, right], [a.tone, b.tone], -to_left)
    };
    points.iter().all(is_near).then_some(BandBorder {
        arc,
        patches,
        tones,
        ends: [first, last],
        normal: way,
        length,
    })
}

struct RampGroups {
    sets: UnionFind,
    /// Groups of more than one patch, by root patch.
    groups: BTreeMap<u32, RampGroup>,
}

impl RampGroups {
    /// Joins the groups on both sides of a border, if all their borders fit along one direction.
    fn join(&mut self, steps: &[BandBorder], number: usize, tolerance: f64) {
        let step = &steps[number];
        let [a, b] = step.patches.map(|patch| self.sets.root(patch));
        if a == b {
            return;
        }
        let size = |root: u32| self.groups.get(&root).map_or(0, |group| group.steps.len());
        let (large, small) = if size(b) > size(a) { (b, a) } else { (a, b) };
        let (way, mut spans) = match self.groups.get(&large) {
            Some(group) => (group.direction, group.spans.clone()),
            None => (step.normal, Spans::new()),
        };
        let added: Vec<usize> = self
            .groups
            .get(&small)
            .map_or(&[][..], |group| &group.steps)
            .iter()
            .copied()
            .chain([number])
            .collect();
        for k in &added {
            let BandBorder { tones, ends, .. } = &steps[*k];
            let at = ends.map(|p| p.to_vec2().dot(way));
            let span = spans.entry(*tones).or_insert((f64::INFINITY, f64::NEG_INFINITY));
            *span = (span.0.min(at[0]).min(at[1]), span.1.max(at[0]).max(at[1]));
            if span.1 - span.0 > 2.0 * tolerance {
                return;
            }
        }
        let mut middles = spans.values().map(|(from, to)| f64::midpoint(*from, *to));
        let mut before = f64::NEG_INFINITY;
        if middles.any(|middle| middle <= std::mem::replace(&mut before, middle)) {
            return;
        }
        self.groups.remove(&small);
        self.sets.join_into(small, large);
        let group = self.groups.entry(large).or_default();
        group.direction = way;
        group.spans = spans;
        group.steps.extend(added);
    }

    /// Breaks up groups with a patch that extends past its borders.
    fn break_up<'a>(
        &mut self,
        borders: &Borders,
        points: &[Vec<Point>],
        look: impl Fn(u32) -> Option<&'a SurfaceLabel>,
        tolerance: f64,
    ) {
        for (arc, points) in borders.arcs.iter().zip(points) {
            for patch in arc.sides.into_iter().filter(|patch| *patch != OUTSIDE_PATCH) {
                let root = self.sets.root(patch);
                let (Some(group), Some(look)) = (self.groups.get_mut(&root), look(patch)) else { continue };
                if group.is_broken {
                    continue;
                }
                let middle = |(from, to): &(f64, f64)| f64::midpoint(*from, *to);
                let below = group.spans.iter().filter(|(tones, _)| tones[1] == look.tone);
                let above = group.spans.iter().filter(|(tones, _)| tones[0] == look.tone);
                let low = below.map(|(_, span)| middle(span)).fold(f64::INFINITY, f64::min);
                let high = above.map(|(_, span)| middle(span)).fold(f64::NEG_INFINITY, f64::max);
                let low = if low < f64::INFINITY { low } else { f64::NEG_INFINITY };
                let high = if high > f64::NEG_INFINITY { high } else { f64::INFINITY };
                let slack = MAX_OVERHANG_TOLERANCES * tolerance;
                let is_within = |p: &Point| {
                    let at = p.to_vec2().dot(group.direction);
                    at >= low - slack && at <= high + slack
                };
                group.is_broken = !points.iter().all(is_within);
            }
        }
    }
}
