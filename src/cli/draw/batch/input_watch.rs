//! Drawing again whenever a file changes.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Duration;

use super::batch_jobs::Job;
use super::drawing_inputs::inputs;
use crate::cli::output::file_stamp::{Stamp, stamp};

/// Time between two looks at all files.
const LOOK: Duration = Duration::from_millis(60);

/// How long a file is to stay as it is before it is read: programs write in several strokes.
const REST: Duration = Duration::from_millis(80);

type Stamps = BTreeMap<PathBuf, Stamp>;

/// Looks at the files of jobs.
pub(crate) struct Watch<'a> {
    jobs: &'a [Job],
    /// The files of each job: a sheet may come to extend another one.
    files: Vec<Vec<PathBuf>>,
    seen: Stamps,
}

impl<'a> Watch<'a> {
    /// Begins; what changes from now on is noticed.
    pub(crate) fn new(jobs: &'a [Job]) -> Self {
        let files = files(jobs);
        let seen = stamps(&files);
        Self { jobs, files, seen }
    }

    /// Waits until something has changed, and gives the jobs that are to be done again.
    pub(crate) fn changed(&mut self) -> Vec<&'a Job> {
        loop {
            std::thread::sleep(LOOK);
            let mut now = stamps(&self.files);
            if now == self.seen {
                continue;
            }
            loop {
                std::thread::sleep(REST);
                let later = stamps(&self.files);
                let rests = later == now;
                now = later;
                if rests {
                    break;
                }
            }
            // A file that is away may be on its way back: programs that save replace files.
            now.retain(|_, stamp| stamp.is_some());
            let is_new =
                |path: &PathBuf| now.get(path).is_some_and(|stamp| self.seen.get(path) != Some(stamp));
            let files_of_jobs = self.jobs.iter().zip(&self.files);
            let jobs: Vec<&Job> =
                files_of_jobs.filter(|(_, files)| files.iter().any(is_new)).map(|(job, _)| job).collect();
            self.seen.extend(now);
            if jobs.is_empty() {
                continue;
            }
            self.files = files(self.jobs);
            for (path, stamp) in stamps(&self.files) {
                self.seen.entry(path).or_insert(stamp);
            }
            return jobs;
        }
    }
}

fn files(jobs: &[Job]) -> Vec<Vec<PathBuf>> {
    jobs.iter().map(|job| job.requests.first().map(inputs).unwrap_or_default()).collect()
}

fn stamps(files: &[Vec<PathBuf>]) -> Stamps {
    files.iter().flatten().map(|path| (path.clone(), stamp(path))).collect()
}
