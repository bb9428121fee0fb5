//! [`envelope`]: the nearest of the faces behind an edge over each part of it (upper envelope of their
//! nearness).

/// Face behind an edge, or touching it, over a part of the edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ReceiverCandidate {
    /// Id of the face.
    pub face: u32,
    /// Start on the edge, as a parameter.
    pub start: f64,
    /// End on the edge, as a parameter.
    pub end: f64,
    /// Nearness of the face at start and end, in image space.
    pub nearness: [f64; 2],
    /// Whether the edge lies on the face, so the face receives no shadow.
    pub touches: bool,
}

impl ReceiverCandidate {
    fn at(&self, t: f64) -> f64 {
        let span = self.end - self.start;
        if span <= 0.0 {
            return self.nearness[0].max(self.nearness[1]);
        }
        let part = ((t - self.start) / span).clamp(0.0, 1.0);
        self.nearness[0] + (self.nearness[1] - self.nearness[0]) * part
    }
}

/// A part of an edge whose shadow falls on one face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct EdgePart {
    /// Id of the face.
    pub face: u32,
    /// Start on the edge, as a parameter.
    pub start: f64,
    /// End on the edge, as a parameter.
    pub end: f64,
    /// Nearness of the face at start and end, in image space.
    pub nearness: [f64; 2],
}

/// Nearest candidate over each part of an edge, ascending; nothing where that candidate touches the edge.
/// Runs and gaps no longer than `shortest` are rounding.
pub(crate) fn envelope(mut candidates: Vec<ReceiverCandidate>, shortest: f64) -> Vec<EdgePart> {
    candidates.retain(|c| c.end > c.start);
    let mut stops: Vec<f64> = candidates.iter().flat_map(|c| [c.start, c.end]).collect();
    stops.sort_by(f64::total_cmp);
    stops.dedup();
    candidates.sort_by(|a, b| a.start.total_cmp(&b.start).then(a.face.cmp(&b.face)));
    let mut winners: Vec<(ReceiverCandidate, f64, f64)> = Vec::new();
    let mut active: Vec<ReceiverCandidate> = Vec::new();
    let mut next = 0;
    for pair in stops.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        active.retain(|c| c.end >= to);
        while next < candidates.len() && candidates[next].start <= from {
            if candidates[next].end >= to {
                active.push(candidates[next]);
            }
            next += 1;
        }
        nearest_over(&active, from, to, &mut winners);
    }
    runs(&winners, shortest)
}

/// Nearest of the candidates between two parameters; all of them must cover that range.
fn nearest_over(
    active: &[ReceiverCandidate],
    from: f64,
    to: f64,
    winners: &mut Vec<(ReceiverCandidate, f64, f64)>,
) {
    let ahead = |a: &ReceiverCandidate, b: &ReceiverCandidate| {
        (a.at(to).total_cmp(&b.at(to))).then(a.touches.cmp(&b.touches)).then(b.face.cmp(&a.face))
    };
    let first = active.iter().max_by(|a, b| a.at(from).total_cmp(&b.at(from)).then(ahead(a, b)));
    let (Some(mut best), mut at) = (first, from) else { return };
    // Each successor is nearer at the end than the one before, so the loop terminates.
    loop {
        let mut end = to;
        let mut heir: Option<&ReceiverCandidate> = None;
        for other in active {
            let (lead, lag) = (best.at(at) - other.at(at), other.at(to) - best.at(to));
            if lag <= 0.0 {
                continue;
            }
            let crossing = at + (to - at) * (lead.max(0.0) / (lead.max(0.0) + lag));
            let sooner = crossing < end || crossing == end && heir.is_some_and(|h| ahead(other, h).is_gt());
            if sooner {
                (end, heir) = (crossing, Some(other));
            }
        }
        winners.push((*best, at, end));
        let Some(next) = heir else { return };
        (best, at) = (next, end);
    }
}

/// Joins neighbouring winners on one face and drops those that are too short.
fn runs(winners: &[(ReceiverCandidate, f64, f64)], shortest: f64) -> Vec<EdgePart> {
    struct EnvelopePart {
        face: u32,
        touches: bool,
        start: f64,
        end: f64,
        nearness: [f64; 2],
    }
    let mut parts: Vec<EnvelopePart> = Vec::new();
    let add = |parts: &mut Vec<EnvelopePart>, part: EnvelopePart| match parts.last_mut() {
        Some(last)
            if (last.face, last.touches) == (part.face, part.touches)
                && part.start - last.end <= shortest =>
        {
            last.end = part.end;
            last.nearness[1] = part.nearness[1];
        }
        _ => parts.push(part),
    };
    for (c, start, end) in winners {
        let nearness = [c.at(*start), c.at(*end)];
        add(
            &mut parts,
            EnvelopePart { face: c.face, touches: c.touches, start: *start, end: *end, nearness },
        );
    }
    // Once short parts are dropped, their neighbours may meet.
    let mut long: Vec<EnvelopePart> = Vec::new();
    for part in parts {
        if part.end - part.start > shortest {
            add(&mut long, part);
        }
    }
    let count = long.len();
    for k in 1..count {
        let gap = long[k].start - long[k - 1].end;
        if gap > 0.0 && gap <= 4.0 * shortest {
            long[k].start = long[k - 1].end;
        }
    }
    long.into_iter()
        .filter(|part| !part.touches)
        .map(|EnvelopePart { face, start, end, nearness, .. }| {
            let start = if start <= shortest { 0.0 } else { start };
            let end = if 1.0 - end <= shortest { 1.0 } else { end };
            EdgePart { face, start, end, nearness }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn candidate(face: u32, start: f64, end: f64, nearness: [f64; 2]) -> ReceiverCandidate {
        ReceiverCandidate { face, start, end, nearness, touches: false }
    }

    fn envelope_runs(candidates: &[ReceiverCandidate]) -> Vec<(u32, f64, f64)> {
        envelope(candidates.to_vec(), 1e-6).iter().map(|r| (r.face, r.start, r.end)).collect()
    }

    #[test]
    fn envelope_follows_the_nearest_face() {
        let far = candidate(1, 0.0, 1.0, [1.0, 1.0]);
        let near = candidate(2, 0.25, 0.5, [2.0, 2.0]);
        assert_eq!(envelope_runs(&[far, near]), [(1, 0.0, 0.25), (2, 0.25, 0.5), (1, 0.5, 1.0)]);
        let touching = ReceiverCandidate { touches: true, ..near };
        assert_eq!(envelope_runs(&[touching, far]), [(1, 0.0, 0.25), (1, 0.5, 1.0)]);
    }

    #[test]
    fn envelope_switches_faces_at_their_crossing() {
        let rising = candidate(1, 0.0, 1.0, [0.0, 1.0]);
        let falling = candidate(2, 0.0, 1.0, [1.0, 0.0]);
        let level = candidate(3, 0.0, 1.0, [0.25, 0.25]);
        assert_eq!(envelope_runs(&[rising, falling, level]), [(2, 0.0, 0.5), (1, 0.5, 1.0)]);
        let high = candidate(4, 0.0, 1.0, [0.75, 0.75]);
        assert_eq!(
            envelope_runs(&[rising, falling, high]),
            [(2, 0.0, 0.25), (4, 0.25, 0.75), (1, 0.75, 1.0)]
        );
    }

    #[test]
    fn rounding_at_a_crossing_adds_no_run_to_the_envelope() {
        for k in 1..2000 {
            let at = f64::from(k) * 0.000_37 + 0.01;
            let near = candidate(1, 0.0, 1.0, [at, 0.0]);
            let far = candidate(2, 0.0, 1.0, [0.0, 1.0 - at]);
            let runs = envelope_runs(&[near, far]);
            assert_eq!(runs.iter().map(|r| r.0).collect::<Vec<_>>(), [1, 2], "{at}");
            assert!((runs[0].2 - at).abs() < 1e-12 && runs[1].1 == runs[0].2);
        }
    }

    #[test]
    fn envelope_closes_slivers_and_gaps() {
        let parts = [
            candidate(1, 0.0, 0.5, [1.0, 1.0]),
            candidate(7, 0.5 - 1e-9, 0.5 + 1e-9, [3.0, 3.0]),
            candidate(2, 0.5, 1.0 - 1e-8, [1.0, 1.0]),
        ];
        let runs = envelope(parts.to_vec(), 1e-6);
        assert_eq!(runs.len(), 2);
        assert_eq!((runs[0].face, runs[0].start), (1, 0.0));
        assert_eq!((runs[1].face, runs[1].start, runs[1].end), (2, runs[0].end, 1.0));
        assert!((runs[0].end - 0.5).abs() < 1e-8);
    }

    #[test]
    fn envelope_of_nothing_has_no_runs() {
        assert!(envelope(Vec::new(), 1e-6).is_empty());
        assert!(envelope_runs(&[candidate(1, 0.3, 0.3, [1.0, 1.0])]).is_empty());
    }
}
