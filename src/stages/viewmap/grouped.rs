//! Findings sorted back to the segments they are about.

/// Findings in the order of their segments.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Grouped<T> {
    starts: Vec<u32>,
    findings: Vec<T>,
}

impl<T: Copy> Grouped<T> {
    /// Those of one segment or bucket.
    pub(crate) fn of(&self, segment: usize) -> &[T] {
        &self.findings[self.range(segment)]
    }

    /// One of all findings, to be changed.
    pub(crate) fn at_mut(&mut self, at: usize) -> &mut T {
        &mut self.findings[at]
    }

    /// Where those of one segment or bucket lie among all findings.
    pub(crate) fn range(&self, segment: usize) -> std::ops::Range<usize> {
        self.starts[segment] as usize..self.starts[segment + 1] as usize
    }

    /// These groups after `tidy` has ordered and joined each that is not empty.
    pub(crate) fn tidied(self, tidy: impl Fn(usize, &mut Vec<T>)) -> Self {
        let mut tidied = Self {
            starts: Vec::with_capacity(self.starts.len()),
            findings: Vec::with_capacity(self.findings.len()),
        };
        tidied.starts.push(0);
        let mut own: Vec<T> = Vec::new();
        for group in 0..self.starts.len() - 1 {
            let found = self.of(group);
            if !found.is_empty() {
                own.clear();
                own.extend_from_slice(found);
                tidy(group, &mut own);
                tidied.findings.extend_from_slice(&own);
            }
            tidied.starts.push(tidied.findings.len() as u32);
        }
        tidied
    }
}

/// Sorts what `fill` puts into `count` buckets, stable, by a counting sort: `fill` runs twice and
/// must put the same both times.
pub(crate) fn bucket<T: Copy>(count: usize, fill: impl Fn(&mut dyn FnMut(usize, T))) -> Grouped<T> {
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
