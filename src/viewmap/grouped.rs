//! Findings sorted back to the segments they are about.

/// Findings in the order of their segments.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Grouped<T> {
    starts: Vec<u32>,
    findings: Vec<T>,
}

impl<T: Copy> Grouped<T> {
    /// Those of one segment or bucket.
    pub(super) fn of(&self, segment: usize) -> &[T] {
        &self.findings[self.range(segment)]
    }

    /// The same, to be changed.
    pub(super) fn of_mut(&mut self, segment: usize) -> &mut [T] {
        let range = self.range(segment);
        &mut self.findings[range]
    }

    fn range(&self, segment: usize) -> std::ops::Range<usize> {
        self.starts[segment] as usize..self.starts[segment + 1] as usize
    }

    /// Sorts findings by segment (a counting sort, stable) and lets `tidy` order and join those
    /// of each.
    pub(super) fn new(segments: usize, found: &[&[(u32, T)]], tidy: impl Fn(usize, &mut Vec<T>)) -> Self {
        let mut starts = vec![0u32; segments + 1];
        for (segment, _) in found.iter().copied().flatten() {
            starts[*segment as usize + 1] += 1;
        }
        for segment in 0..segments {
            starts[segment + 1] += starts[segment];
        }
        let mut order = vec![(0u32, 0u32); starts[segments] as usize];
        let mut next = starts.clone();
        for (list, findings) in found.iter().enumerate() {
            for (i, (segment, _)) in findings.iter().enumerate() {
                order[next[*segment as usize] as usize] = (list as u32, i as u32);
                next[*segment as usize] += 1;
            }
        }
        let mut grouped = Self { starts: vec![0; segments + 1], findings: Vec::with_capacity(order.len()) };
        let mut own: Vec<T> = Vec::new();
        for segment in 0..segments {
            let places = &order[starts[segment] as usize..starts[segment + 1] as usize];
            if !places.is_empty() {
                own.clear();
                own.extend(places.iter().map(|(list, i)| found[*list as usize][*i as usize].1));
                tidy(segment, &mut own);
                grouped.findings.extend_from_slice(&own);
            }
            grouped.starts[segment + 1] = grouped.findings.len() as u32;
        }
        grouped
    }
}

/// Sorts what `fill` puts into `count` buckets, stable, by a counting sort: `fill` runs twice and
/// must put the same both times.
pub(super) fn bucket<T: Copy>(count: usize, fill: impl Fn(&mut dyn FnMut(usize, T))) -> Grouped<T> {
    let mut starts = vec![0u32; count + 1];
    let mut any = None;
    fill(&mut |bucket, value| {
        starts[bucket + 1] += 1;
        any = Some(value);
    });
    for bucket in 0..count {
        starts[bucket + 1] += starts[bucket];
    }
    let Some(blank) = any else { return Grouped { starts, findings: Vec::new() } };
    let mut findings = vec![blank; starts[count] as usize];
    let mut next = starts.clone();
    fill(&mut |bucket, value| {
        findings[next[bucket] as usize] = value;
        next[bucket] += 1;
    });
    Grouped { starts, findings }
}
