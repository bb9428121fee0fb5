//! Arcs: pieces of contours of rounded surfaces between places where visibility may change.
//!
//! A contour of the smooth surface lies among faces of the polyhedron that stand for the same
//! surface, and some of them would hide bits of it here and there. On the smooth surface visibility
//! changes only where the contour passes under another bounding line, at a cusp, and where surfaces
//! pass through each other. So the curve is cut at these places, and each arc between them is visible
//! or hidden as a whole:
//!
//! - hidden, if it runs backward on a closed surface, whose nearer side then is its inside;
//! - hidden, if it is a short spur from a cusp to where it comes out from under the line it meets;
//! - else as the greater part of its length is, compared with all faces that are nearer than those
//!   around it (the segment is lifted towards the eye by their size). Only where faces leave long
//!   stretches of both kinds is an arc broken, and that is counted; on closed surfaces other parts
//!   must be there to do it, and the stretches longer still.
//!
//! Source: Aaron Hertzmann and Denis Zorin, "Illustrating smooth surfaces", SIGGRAPH 2000, section
//! 4.4 (one decision for each piece between cusps and crossings); Pierre Bénard and Aaron Hertzmann,
//! "Line drawings from 3D models", 2019, chapter 7, for what goes wrong without it.

use super::events::{Event, Scene};
use super::graph::{ArcCounts, ViewVertexKind};
use super::layers::Layer;
use super::occlude::Interval;
use super::project::ImageSegment;
use super::visibility::Visibility;
use crate::math::tolerance;

/// A run of image segments of one contour, from head to tail.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Run {
    /// Image segments in order.
    pub segments: Vec<u32>,
    /// Whether the last meets the first.
    pub closed: bool,
    /// Whether its surface is closed, so that backward pieces show their inside.
    pub solid: bool,
}

/// What was decided: hidden pieces of image segments.
pub(super) type Decided = Vec<(u32, Layer)>;

/// A piece that is shorter than this (px) and ends in a cusp goes by what its other end says.
const SPUR_PX: f64 = 12.0;
/// Stretches shorter than this (px) have no say against the rest of their arc.
const STRETCH_PX: f64 = 6.0;

/// On closed surfaces, which nothing but another part can break, they must be shorter than this (px):
/// what is longer is hidden by a part whose edge or crossing was missed.
const SOLID_STRETCH_PX: f64 = 80.0;

/// A place along a run.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stop {
    /// Index of the segment in the run, plus the parameter on it.
    pub at: f64,
    /// What is there.
    pub kind: ViewVertexKind,
    covered: Option<bool>,
}

/// What all runs of a view share.
#[derive(Clone, Copy)]
pub(super) struct Judge<'a> {
    pub scene: &'a Scene<'a>,
    pub events: &'a [Event],
    pub seen: &'a Visibility,
    /// Whether the scene is one part, so that no other surface can hide any of it.
    pub alone: bool,
    /// A px in user units.
    pub px: f64,
}

impl Judge<'_> {
    /// Decides all arcs of a run.
    pub fn decide(&self, run: &Run, counts: &mut ArcCounts) -> Decided {
        let backward = even_backward(run, self.scene, tolerance::CUSP_PX * self.px);
        let stops = stops(run, self.events, &backward);
        let n = run.segments.len() as f64;
        let mut decided = Vec::new();
        for arc in arcs(&stops, n, run.closed) {
            counts.arcs += 1;
            if run.solid && backward[run_index((arc.from + arc.to) / 2.0, n)] {
                self.hide(run, arc.from, arc.to, arc.kinds, &mut decided);
                continue;
            }
            let length = self.length(run, arc.from, arc.to);
            let cusp = arc.kinds.contains(&ViewVertexKind::Cusp);
            if cusp && length < SPUR_PX * self.px && (arc.covered[0] || arc.covered[1]) {
                self.hide(run, arc.from, arc.to, arc.kinds, &mut decided);
                continue;
            }
            let stretches = self.stretches(run, &arc);
            counts.broken += stretches.len() as u64 - 1;
            for stretch in stretches.iter().filter(|stretch| stretch.hidden) {
                self.hide(run, stretch.from, stretch.to, stretch.kinds, &mut decided);
            }
        }
        decided
    }

    fn length(&self, run: &Run, from: f64, to: f64) -> f64 {
        let mut length = 0.0;
        each_part(run, from, to, |k, from, to| length += (to - from) * self.segment_length(run, k));
        length
    }

    fn segment_length(&self, run: &Run, k: usize) -> f64 {
        self.scene.segments[run.segments[k] as usize].length()
    }

    /// Hides all of a run between two places.
    fn hide(&self, run: &Run, from: f64, to: f64, kinds: [ViewVertexKind; 2], decided: &mut Decided) {
        each_part(run, from, to, |k, from, to| {
            let id = run.segments[k];
            let of_faces = self.seen.hidden(id as usize).iter();
            let of_faces = of_faces.filter(|l| l.interval.start < to && l.interval.end > from);
            let count = of_faces.map(|l| l.count).max().unwrap_or(1);
            let interval = Interval { start: from, end: to, start_kind: kinds[0], end_kind: kinds[1] };
            decided.push((id, Layer { interval, count }));
        });
    }

    /// The visible and hidden stretches of an arc by what faces say, the short ones given to their
    /// neighbours, shortest first.
    fn stretches(&self, run: &Run, arc: &Arc) -> Vec<Stretch> {
        let mut stretches: Vec<Stretch> = Vec::new();
        let mut push = |hidden: bool, from: f64, to: f64, length: f64| match stretches.last_mut() {
            Some(last) if last.hidden == hidden => {
                last.to = to;
                last.length += length;
            }
            _ => stretches.push(Stretch { hidden, from, to, length, kinds: arc.kinds }),
        };
        each_part_at(run, arc.from, arc.to, |k, base, from, to| {
            let length = self.segment_length(run, k);
            let mut at = from;
            for layer in self.seen.hidden(run.segments[k] as usize) {
                let (start, end) = (layer.interval.start.max(at), layer.interval.end.min(to));
                if end <= start {
                    continue;
                }
                if start > at {
                    push(false, base + at, base + start, (start - at) * length);
                }
                push(true, base + start, base + end, (end - start) * length);
                at = end;
            }
            if to > at {
                push(false, base + at, base + to, (to - at) * length);
            }
        });
        if stretches.is_empty() {
            stretches.push(Stretch {
                hidden: true,
                from: arc.from,
                to: arc.to,
                length: 0.0,
                kinds: arc.kinds,
            });
        }
        let least_stretch = match (run.solid, self.alone) {
            (true, true) => f64::INFINITY,
            (true, false) => SOLID_STRETCH_PX,
            (false, _) => STRETCH_PX,
        };
        while stretches.len() > 1 {
            let by_length = |a: &(usize, &Stretch), b: &(usize, &Stretch)| a.1.length.total_cmp(&b.1.length);
            let Some((least, stretch)) = stretches.iter().enumerate().min_by(by_length) else { break };
            if stretch.length >= least_stretch * self.px {
                break;
            }
            let before = if least > 0 { Some(stretches[least - 1].length) } else { None };
            let after = stretches.get(least + 1).map(|s| s.length);
            // An arc of two stretches is as its longer one; in the middle both neighbours are joined.
            let first = if before.is_some() { least - 1 } else { least };
            let last = if after.is_some() { least + 1 } else { least };
            let joined = Stretch {
                hidden: !stretches[least].hidden,
                from: stretches[first].from,
                to: stretches[last].to,
                length: stretches[first..=last].iter().map(|s| s.length).sum(),
                kinds: arc.kinds,
            };
            stretches.splice(first..=last, [joined]);
        }
        for k in 1..stretches.len() {
            stretches[k - 1].kinds[1] = ViewVertexKind::Piercing;
            stretches[k].kinds[0] = ViewVertexKind::Piercing;
        }
        stretches
    }
}

/// A stretch of an arc that faces hide or do not.
#[derive(Debug, Clone, Copy)]
struct Stretch {
    hidden: bool,
    from: f64,
    to: f64,
    length: f64,
    kinds: [ViewVertexKind; 2],
}

/// A piece of a run between two stops; `to` may lie beyond the end of a closed run.
struct Arc {
    from: f64,
    to: f64,
    kinds: [ViewVertexKind; 2],
    covered: [bool; 2],
}

fn arcs(stops: &[Stop], n: f64, closed: bool) -> Vec<Arc> {
    let free = |at: f64| Stop { at, kind: ViewVertexKind::Vertex, covered: None };
    let mut all: Vec<Stop> = stops.to_vec();
    if closed {
        match all.first().copied() {
            Some(first) => all.push(Stop { at: first.at + n, ..first }),
            None => all = vec![free(0.0), free(n)],
        }
    } else {
        all.insert(0, free(0.0));
        all.push(free(n));
    }
    let arc = |pair: &[Stop]| Arc {
        from: pair[0].at,
        to: pair[1].at,
        kinds: [pair[0].kind, pair[1].kind],
        covered: [pair[0].covered == Some(true), pair[1].covered == Some(false)],
    };
    all.windows(2).map(arc).filter(|arc| arc.to > arc.from).collect()
}

/// The index of the segment at a place that may lie beyond the end of a closed run.
fn run_index(at: f64, n: f64) -> usize {
    let at = if at >= n { at - n } else { at };
    (at.floor().max(0.0) as usize).min(n as usize - 1)
}

/// Calls `visit(index in the run, from, to)` for the parts of segments between two places.
fn each_part(run: &Run, from: f64, to: f64, mut visit: impl FnMut(usize, f64, f64)) {
    each_part_at(run, from, to, |k, _, from, to| visit(k, from, to));
}

/// The same with the place where each segment begins, counted on beyond the end of a closed run.
fn each_part_at(run: &Run, from: f64, to: f64, mut visit: impl FnMut(usize, f64, f64, f64)) {
    let n = run.segments.len();
    let mut k = from.floor() as usize;
    while (k as f64) < to {
        let (start, end) = ((from - k as f64).max(0.0), (to - k as f64).min(1.0));
        if end > start {
            visit(k % n, k as f64, start, end);
        }
        k += 1;
    }
}

/// The places where a run may change, in order.
pub(super) fn stops(run: &Run, events: &[Event], backward: &[bool]) -> Vec<Stop> {
    let mut stops = Vec::new();
    for (k, id) in run.segments.iter().enumerate() {
        let before = if k > 0 { Some(k - 1) } else { run.closed.then(|| backward.len() - 1) };
        if before.is_some_and(|before| backward[before] != backward[k]) {
            stops.push(Stop { at: k as f64, kind: ViewVertexKind::Cusp, covered: None });
        }
        let first = events.partition_point(|e| e.segment < *id);
        let own = events[first..].iter().take_while(|e| e.segment == *id);
        stops.extend(own.map(|e| Stop { at: k as f64 + e.t, kind: e.kind, covered: e.covered }));
    }
    stops
}

/// Whether each segment of a run lies between cusps. Stretches that turn back for less than `cusp`
/// user units are ripples of the mesh: the shortest is made even first.
pub(super) fn even_backward(run: &Run, scene: &Scene, cusp: f64) -> Vec<bool> {
    let mut backward: Vec<bool> = run.segments.iter().map(|s| scene.advance[*s as usize] < 0.0).collect();
    let n = backward.len();
    // What a segment says weighs as much as is drawn of it.
    let weight = |s: u32| scene.segments[s as usize].length() * f64::from(scene.advance[s as usize].abs());
    loop {
        // Stretches of one value: first index, number, weight.
        let mut stretches: Vec<(usize, usize, f64)> = Vec::new();
        for k in 0..n {
            match stretches.last_mut() {
                Some((first, count, sum)) if backward[*first] == backward[k] => {
                    *count += 1;
                    *sum += weight(run.segments[k]);
                }
                _ => stretches.push((k, 1, weight(run.segments[k]))),
            }
        }
        if run.closed && stretches.len() > 1 && backward[0] == backward[n - 1] {
            let (first, count, sum) = stretches.pop().unwrap_or_default();
            stretches[0] = (first, stretches[0].1 + count, stretches[0].2 + sum);
        }
        if stretches.len() < 2 {
            return backward;
        }
        let least = stretches.iter().min_by(|a, b| a.2.total_cmp(&b.2).then(a.0.cmp(&b.0)));
        match least {
            Some(&(first, count, sum)) if sum < cusp => {
                for k in first..first + count {
                    backward[k % n] = !backward[k % n];
                }
            }
            _ => return backward,
        }
    }
}

/// The runs of image segments that are left of contour curves: `image_of` gives the image segment of
/// a feature segment, if it is on the page.
pub(super) fn runs(
    curve: &crate::lines::ContourCurve,
    solid: bool,
    segments: &[ImageSegment],
    image_of: impl Fn(u32) -> Option<u32>,
) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    let mut joined = false;
    for source in curve.segments.clone() {
        let Some(id) = image_of(source) else {
            joined = false;
            continue;
        };
        let cut = segments[id as usize].cut;
        match runs.last_mut() {
            Some(run) if joined && !cut[0] => run.segments.push(id),
            _ => runs.push(Run { segments: vec![id], closed: false, solid }),
        }
        joined = !cut[1];
    }
    let whole = runs.len() == 1 && runs[0].segments.len() == curve.segments.len();
    if whole && curve.closed && joined && !segments[runs[0].segments[0] as usize].cut[0] {
        runs[0].closed = true;
    }
    runs
}
