//! Drawing again whenever a file changes.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Duration;

use super::inputs::{Stamp, inputs, stamp};
use super::plan::Job;

/// Time between two looks at all files.
const LOOK: Duration = Duration::from_millis(60);

/// How long a file is to stay as it is before it is read: programs write in several strokes.
const REST: Duration = Duration::from_millis(80);

type Stamps = BTreeMap<PathBuf, Stamp>;

/// Looks at the files of jobs.
pub(super) struct Watch<'a> {
    jobs: &'a [Job],
    seen: Stamps,
}

impl<'a> Watch<'a> {
    /// Begins; what changes from now on is noticed.
    pub(super) fn new(jobs: &'a [Job]) -> Self {
        Self { jobs, seen: stamps(jobs) }
    }

    /// Waits until something has changed, and gives the jobs that are to be done again.
    pub(super) fn changed(&mut self) -> Vec<&'a Job> {
        loop {
            std::thread::sleep(LOOK);
            let mut now = stamps(self.jobs);
            if now == self.seen {
                continue;
            }
            loop {
                std::thread::sleep(REST);
                let later = stamps(self.jobs);
                let rests = later == now;
                now = later;
                if rests {
                    break;
                }
            }
            // A file that is away may be on its way back: programs that save replace files.
            let is_new =
                |path: &PathBuf| now.get(path).is_some_and(|s| s.is_some() && self.seen.get(path) != Some(s));
            let jobs = self.jobs.iter().filter(|job| files(job).iter().any(is_new)).collect::<Vec<_>>();
            for (path, stamp) in now {
                if stamp.is_some() {
                    self.seen.insert(path, stamp);
                }
            }
            if !jobs.is_empty() {
                return jobs;
            }
        }
    }
}

fn files(job: &Job) -> Vec<PathBuf> {
    job.requests.first().map(inputs).unwrap_or_default()
}

fn stamps(jobs: &[Job]) -> Stamps {
    jobs.iter().flat_map(files).map(|path| (path.clone(), stamp(&path))).collect()
}
