//! Sweep over overlapping hidden intervals, which gives pieces of constant invisibility.

use super::triangle_occlusion::Interval;
use crate::visibility::graph::ViewVertexKind;

/// Piece of a segment behind a number of surfaces. The count is never 0, because visible parts have no entry.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct HiddenInterval {
    /// Parameter range, with the reasons for its ends.
    pub interval: Interval,
    /// Number of surfaces in front.
    pub count: u16,
}

/// Sweeps over `hidden` intervals and appends pieces of constant count in ascending order.
///
/// Pieces and gaps shorter than `shortest` are absorbed by their neighbours. With `counting` false, all
/// counts are 1.
pub(crate) fn sweep(
    hidden: &mut [Interval],
    shortest: f64,
    counting: bool,
    layers: &mut Vec<HiddenInterval>,
) {
    if hidden.is_empty() {
        return;
    }
    if counting {
        sweep_counting(hidden, shortest, layers);
    } else {
        sweep_union(hidden, shortest, layers);
    }
}

/// Hides everything except the parts that `front` hides and `behind` does not. Both lists are ascending.
pub(crate) fn only_behind(front: &[HiddenInterval], behind: &[HiddenInterval]) -> Vec<HiddenInterval> {
    let mut hidden = Vec::new();
    let mut push = |start: (f64, ViewVertexKind), end: (f64, ViewVertexKind)| {
        if end.0 > start.0 {
            let interval = Interval { start: start.0, end: end.0, start_kind: start.1, end_kind: end.1 };
            hidden.push(HiddenInterval { interval, count: 1 });
        }
    };
    let begin = (0.0, ViewVertexKind::TJunction);
    // Start of the current hidden piece, with its reason.
    let mut from = begin;
    for layer in front {
        let Interval { start, end, start_kind, end_kind } = layer.interval;
        push(from, (start, start_kind));
        let mut at = start;
        for other in behind.iter().map(|layer| layer.interval).filter(|o| o.end > start && o.start < end) {
            let (low, high) = (other.start.max(at), other.end.min(end));
            push((low, other.start_kind), (high, other.end_kind));
            at = high.max(at);
        }
        from = (end, end_kind);
    }
    push(from, (1.0, ViewVertexKind::TJunction));
    hidden
}

fn sweep_union(hidden: &mut [Interval], shortest: f64, layers: &mut Vec<HiddenInterval>) {
    hidden.sort_by(|a, b| a.start.total_cmp(&b.start).then(b.end.total_cmp(&a.end)));
    let mut run = hidden[0];
    for next in &hidden[1..] {
        if next.start <= run.end + shortest {
            if next.end > run.end {
                (run.end, run.end_kind) = (next.end, next.end_kind);
            }
        } else {
            push(HiddenInterval { interval: run, count: 1 }, shortest, layers);
            run = *next;
        }
    }
    push(HiddenInterval { interval: run, count: 1 }, shortest, layers);
}

fn sweep_counting(hidden: &[Interval], shortest: f64, layers: &mut Vec<HiddenInterval>) {
    let mut events: Vec<(f64, i32, ViewVertexKind)> = Vec::with_capacity(hidden.len() * 2);
    for h in hidden {
        events.push((h.start, 1, h.start_kind));
        events.push((h.end, -1, h.end_kind));
    }
    events.sort_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
    let first = layers.len();
    let (mut count, mut at) = (0i32, (0.0, ViewVertexKind::TJunction));
    let mut k = 0;
    while k < events.len() {
        // Events within `shortest` of each other are simultaneous.
        let (t, kind) = (events[k].0, events[k].2);
        let before = count;
        while k < events.len() && events[k].0 <= t + shortest {
            count += events[k].1;
            k += 1;
        }
        if before > 0 && before != count {
            let interval = Interval { start: at.0, end: t, start_kind: at.1, end_kind: kind };
            push(HiddenInterval { interval, count: before as u16 }, shortest, layers);
        }
        if before != count {
            at = (t, kind);
        }
    }
    // Merges neighbours of equal count that a dropped sliver had separated.
    let mut kept = first;
    for i in first..layers.len() {
        let layer = layers[i];
        if kept > first {
            let last = &mut layers[kept - 1];
            if last.count == layer.count && layer.interval.start - last.interval.end <= 2.0 * shortest {
                last.interval.end = layer.interval.end;
                last.interval.end_kind = layer.interval.end_kind;
                continue;
            }
        }
        layers[kept] = layer;
        kept += 1;
    }
    layers.truncate(kept);
}

fn push(layer: HiddenInterval, shortest: f64, layers: &mut Vec<HiddenInterval>) {
    if layer.interval.end - layer.interval.start > shortest {
        layers.push(layer);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn interval(start: f64, end: f64) -> Interval {
        let kind = ViewVertexKind::TJunction;
        Interval { start, end, start_kind: kind, end_kind: kind }
    }

    fn swept(intervals: &[(f64, f64)], counting: bool) -> Vec<(f64, f64, u16)> {
        let mut hidden: Vec<Interval> = intervals.iter().map(|(a, b)| interval(*a, *b)).collect();
        let mut layers = Vec::new();
        sweep(&mut hidden, 1e-6, counting, &mut layers);
        layers.iter().map(|l| (l.interval.start, l.interval.end, l.count)).collect()
    }

    #[test]
    fn sweep_joins_touching_intervals() {
        assert_eq!(swept(&[(0.5, 0.7), (0.1, 0.5), (0.8, 0.9)], false), [(0.1, 0.7, 1), (0.8, 0.9, 1)]);
    }

    #[test]
    fn sweep_counts_overlapping_layers() {
        assert_eq!(swept(&[(0.0, 0.6), (0.4, 1.0)], true), [(0.0, 0.4, 1), (0.4, 0.6, 2), (0.6, 1.0, 1)]);
        assert_eq!(swept(&[(0.0, 0.5), (0.5 - 1e-9, 1.0)], true), [(0.0, 1.0, 1)]);
    }
}
