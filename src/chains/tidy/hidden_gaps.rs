//! Bridges tiny hidden gaps in visible smooth contours by marking them as visible.
//!
//! On a mesh, a contour dips behind a fold of the same surface for a fraction of a px. On the smooth surface
//! it would be one line.
//!
//! 1. Hidden runs shorter than a limit, between visible runs of one contour, are candidates.
//! 2. Candidates that another surface hides are rejected ([`GapOcclusion`]).
//! 3. The edges of the others are classified as visible.

use crate::chains::link::directed_edge::DirectedEdge;
use crate::chains::link::edge_class::EdgeClass;
use crate::chains::link::routes::Routes;
use crate::lines::LineKind;
use crate::visibility::{GapOcclusion, GapSegment, ViewMap};

/// Maximal run of route steps that are all hidden or all visible.
#[derive(Debug, Clone, Copy)]
struct VisibilityRun {
    /// Index of the first step, and of the one after the last.
    first: usize,
    end: usize,
    /// Length in the image.
    length: f64,
    /// Whether the steps are hidden.
    is_hidden: bool,
}

/// Makes short hidden stretches of smooth contours visible.
///
/// A stretch must be shorter than `gap`, lie between visible stretches, and be hidden by its own surface
/// only. `routes` must join edges regardless of visibility. Without `occlusion`, other surfaces are not tested.
/// `classes` has one entry per view edge; `None` marks a dropped edge.
pub(crate) fn bridge_gaps(
    map: &ViewMap,
    routes: &Routes,
    gap: f64,
    occlusion: Option<&GapOcclusion>,
    classes: &mut [Option<EdgeClass>],
) {
    let gaps: Vec<HiddenGap> =
        routes.iter().flat_map_iter(|(steps, closed)| gaps(map, steps, closed, gap, classes)).collect();
    let gap_segments: Vec<GapSegment> = gaps.iter().map(|gap| gap.segment).collect();
    let hidden =
        occlusion.map_or_else(|| vec![false; gap_segments.len()], |ahead| ahead.occluded_gaps(&gap_segments));
    for (gap, _) in gaps.iter().zip(hidden).filter(|(_, hidden)| !hidden) {
        for step in &gap.steps {
            if let Some(class) = &mut classes[step.edge as usize] {
                class.hidden = false;
            }
        }
    }
}

/// Hidden stretch that may be bridged.
struct HiddenGap {
    steps: Vec<DirectedEdge>,
    /// The straight connection between its ends, for the occlusion test.
    segment: GapSegment,
}

/// Hidden stretches shorter than `gap` between visible stretches of one smooth contour.
fn gaps(
    map: &ViewMap,
    steps: &[DirectedEdge],
    closed: bool,
    gap: f64,
    classes: &[Option<EdgeClass>],
) -> Vec<HiddenGap> {
    let is_hidden = |step: &DirectedEdge| class(classes, step).is_none_or(|c| c.hidden);
    if !steps.iter().any(is_hidden) {
        return Vec::new();
    }
    let runs = runs(map, steps, closed, is_hidden);
    let count = runs.len();
    let smooth = |step: &DirectedEdge| {
        let edge = &map.edges[step.edge as usize];
        edge.kind == LineKind::Contour && edge.smooth
    };
    let mut gaps = Vec::new();
    for (i, run) in runs.iter().enumerate() {
        let inner = closed && count > 1 || (i > 0 && i + 1 < count);
        let run_length = |j: usize| runs[j % count].length;
        if !run.is_hidden || !inner || run.length >= gap {
            continue;
        }
        // A gap longer than both visible runs next to it does not join them.
        if run_length(i + count - 1).max(run_length(i + 1)) < run.length {
            continue;
        }
        let gap_steps: Vec<DirectedEdge> = (run.first..run.end).map(|k| steps[k % steps.len()]).collect();
        if gap_steps.iter().all(smooth) {
            gaps.extend(HiddenGap::new(map, gap_steps));
        }
    }
    gaps
}

impl HiddenGap {
    fn new(map: &ViewMap, steps: Vec<DirectedEdge>) -> Option<Self> {
        let (first, last) = (*steps.first()?, *steps.last()?);
        let ends = [first.from(map), last.to(map)].map(|v| map.vertices[v.index()]);
        let gap_segment = GapSegment {
            ends: ends.map(|vertex| vertex.position),
            depths: ends.map(|vertex| vertex.depth),
            segments: [first, last].map(|step| map.edges[step.edge as usize].segment),
        };
        Some(Self { steps, segment: gap_segment })
    }
}

/// Runs of equal value along a route. In a closed route the last run may pass the start of the route: its
/// `end` then exceeds the number of steps.
fn runs(
    map: &ViewMap,
    steps: &[DirectedEdge],
    closed: bool,
    value: impl Fn(&DirectedEdge) -> bool,
) -> Vec<VisibilityRun> {
    let n = steps.len();
    let start =
        if closed { (1..n).find(|k| value(&steps[*k]) != value(&steps[k - 1])).unwrap_or(0) } else { 0 };
    let mut runs: Vec<VisibilityRun> = Vec::new();
    for k in start..start + n {
        let step = &steps[k % n];
        let (step_value, length) = (value(step), step.length(map));
        match runs.last_mut() {
            Some(run) if run.is_hidden == step_value => {
                run.end = k + 1;
                run.length += length;
            }
            _ => runs.push(VisibilityRun { first: k, end: k + 1, length, is_hidden: step_value }),
        }
    }
    runs
}

fn class(classes: &[Option<EdgeClass>], step: &DirectedEdge) -> Option<EdgeClass> {
    classes[step.edge as usize]
}
