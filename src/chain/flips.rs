//! Evens out what flickers along a line: tiny gaps in the visible, tiny changes of class.
//!
//! Contours of meshes dip behind the folds of their own neighbourhood for a fraction of a px, and
//! change between silhouette and inner contour just as often; a pen makes one line of them.

use super::link::{Class, Routes, Step};
use crate::lines::LineKind;
use crate::viewmap::ViewMap;

/// A stretch of a route over which something stays the same.
#[derive(Debug, Clone, Copy)]
struct Run {
    first: usize,
    end: usize,
    length: f64,
    value: bool,
}

/// Makes hidden stretches of smooth contours shorter than `gap` visible where the line is visible
/// before and behind them. `routes` must join edges regardless of visibility.
pub(super) fn bridge(map: &ViewMap, routes: &Routes, gap: f64, classes: &mut [Option<Class>]) {
    for (steps, closed) in routes.iter() {
        let runs = runs(map, steps, closed, |step| class(classes, step).is_none_or(|c| c.hidden));
        let count = runs.len();
        for (i, run) in runs.iter().enumerate() {
            let inner = closed && count > 1 || (i > 0 && i + 1 < count);
            let beside = |j: usize| runs[j % count].length;
            if !run.value || !inner || run.length >= gap {
                continue;
            }
            // Two crumbs do not make a line by what is between them.
            if beside(i + count - 1).max(beside(i + 1)) < run.length {
                continue;
            }
            let smooth = |step: &Step| {
                let edge = &map.edges[step.edge as usize];
                edge.kind == LineKind::Contour && edge.smooth
            };
            if (run.first..run.end).all(|k| smooth(&steps[k % steps.len()])) {
                for k in run.first..run.end {
                    if let Some(class) = &mut classes[steps[k % steps.len()].edge as usize] {
                        class.hidden = false;
                    }
                }
            }
        }
    }
}

/// Gives stretches shorter than `shortest` the silhouette and thickness of their neighbours.
/// `routes` must join edges of one visibility regardless of both.
pub(super) fn even_out(map: &ViewMap, routes: &Routes, shortest: f64, classes: &mut [Option<Class>]) {
    type Aspect = (fn(&Class) -> bool, fn(&mut Class, bool));
    let aspects: [Aspect; 2] = [
        (|c| c.silhouette, |c, value| c.silhouette = value),
        (|c| c.both_seen, |c, value| c.both_seen = value),
    ];
    for (steps, closed) in routes.iter() {
        for (get, set) in aspects {
            let runs = runs(map, steps, closed, |step| class(classes, step).is_some_and(|c| get(&c)));
            for (run, value) in majority(&runs, closed, shortest) {
                for k in run.first..run.end {
                    if let Some(class) = &mut classes[steps[k % steps.len()].edge as usize] {
                        set(class, value);
                    }
                }
            }
        }
    }
}

/// The runs whose value changes: those of each group of short runs take the value of the long runs
/// on both sides if these agree, else the one that most of the group's length has.
fn majority(runs: &[Run], closed: bool, shortest: f64) -> Vec<(Run, bool)> {
    let count = runs.len();
    let mut changes = Vec::new();
    if count < 2 {
        return changes;
    }
    // A closed route is gone round from a long run.
    let start = if closed { runs.iter().position(|r| r.length >= shortest).unwrap_or(0) } else { 0 };
    let at = |k: usize| runs[(start + k) % count];
    let mut k = 0;
    let mut before: Option<bool> = None;
    while k < count {
        if at(k).length >= shortest {
            before = Some(at(k).value);
            k += 1;
            continue;
        }
        let group = (k..count).take_while(|j| at(*j).length < shortest).count();
        let after = if k + group < count {
            Some(at(k + group).value)
        } else if closed && before.is_some() {
            Some(at(0).value)
        } else {
            None
        };
        let balance: f64 =
            (k..k + group).map(|j| if at(j).value { at(j).length } else { -at(j).length }).sum();
        let value = match (before, after) {
            (Some(a), Some(b)) if a == b => a,
            (Some(a), None) | (None, Some(a)) => a,
            _ => balance > 0.0,
        };
        changes.extend((k..k + group).map(at).filter(|r| r.value != value).map(|r| (r, value)));
        k += group;
    }
    changes
}

/// The runs of equal value along a route. In a closed route the first run may begin before the
/// route's start: its `end` then exceeds the number of steps.
fn runs(map: &ViewMap, steps: &[Step], closed: bool, value: impl Fn(&Step) -> bool) -> Vec<Run> {
    let n = steps.len();
    let start =
        if closed { (1..n).find(|k| value(&steps[*k]) != value(&steps[k - 1])).unwrap_or(0) } else { 0 };
    let mut runs: Vec<Run> = Vec::new();
    for k in start..start + n {
        let step = &steps[k % n];
        let (now, length) = (value(step), step.length(map));
        match runs.last_mut() {
            Some(run) if run.value == now => {
                run.end = k + 1;
                run.length += length;
            }
            _ => runs.push(Run { first: k, end: k + 1, length, value: now }),
        }
    }
    runs
}

fn class(classes: &[Option<Class>], step: &Step) -> Option<Class> {
    classes[step.edge as usize]
}
