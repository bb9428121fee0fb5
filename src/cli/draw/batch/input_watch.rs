//! Waits for changes of the input files of jobs.

use std::path::PathBuf;

use super::batch_jobs::BatchJob;
use super::drawing_inputs::inputs;
use crate::cli::output::file_stamp::{FileStamps, changed_stamps, stamps};

/// Watch over the input files of jobs.
pub(crate) struct InputWatch<'a> {
    jobs: &'a [BatchJob],
    /// Input files of each job. They change when a style sheet extends another sheet.
    files: Vec<Vec<PathBuf>>,
    last_stamps: FileStamps,
}

impl<'a> InputWatch<'a> {
    /// Starts watching. Later changes are detected.
    pub(crate) fn new(jobs: &'a [BatchJob]) -> Self {
        let files = files(jobs);
        let seen = stamps(files.iter().flatten());
        Self { jobs, files, last_stamps: seen }
    }

    /// Waits for a change, and returns the jobs with changed inputs.
    pub(crate) fn changed(&mut self) -> Vec<&'a BatchJob> {
        loop {
            let mut now = changed_stamps(self.files.iter().flatten(), &self.last_stamps);
            // A missing file may come back: programs often save by replacing a file.
            now.retain(|_, file_stamp| file_stamp.is_some());
            let is_new = |path: &PathBuf| {
                now.get(path).is_some_and(|new_stamp| self.last_stamps.get(path) != Some(new_stamp))
            };
            let files_of_jobs = self.jobs.iter().zip(&self.files);
            let jobs: Vec<&BatchJob> =
                files_of_jobs.filter(|(_, files)| files.iter().any(is_new)).map(|(job, _)| job).collect();
            self.last_stamps.extend(now);
            if jobs.is_empty() {
                continue;
            }
            self.files = files(self.jobs);
            for (path, first_stamp) in stamps(self.files.iter().flatten()) {
                self.last_stamps.entry(path).or_insert(first_stamp);
            }
            return jobs;
        }
    }
}

fn files(jobs: &[BatchJob]) -> Vec<Vec<PathBuf>> {
    jobs.iter().map(|job| job.requests.first().map(inputs).unwrap_or_default()).collect()
}
