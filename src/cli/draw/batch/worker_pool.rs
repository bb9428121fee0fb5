//! [`WorkerPool`]: draws the models of a batch in parallel, prints messages, and counts the results.
//!
//! Each model is drawn in a task that runs in the thread pool. Its files are staged and then written all
//! together or not at all. An error ends the drawing of that model only.

use std::cell::Cell;
use std::fs;
use std::path::Path;
use std::sync::Mutex;
use std::time::{Duration, Instant};

use rayon_core::ThreadPool;

use super::batch_jobs::BatchJob;
use crate::cli::draw::model_drawing;
use crate::cli::output::output_files::Staging;
use crate::cli::output::progress::Progress;
use crate::cli::output::{exit_status, number_text};
use crate::cli::request::draw_request::DrawRequest;
use crate::cli::{EXIT_TRY_LATER, EXIT_WRONG};
use crate::error::{Error, ErrorKind};
use crate::pipeline::Stopwatch;
use crate::scene::warnings::add_new;

/// Drawings of one model that are still to be made.
pub(crate) struct DrawTask<'a> {
    pub(crate) job: &'a BatchJob,
    pub(crate) requests: Vec<&'a DrawRequest>,
}

/// Draws the models of a batch in a thread pool.
pub(crate) struct WorkerPool<'a> {
    pub(crate) pool: &'a ThreadPool,
    /// Output folder or model, for messages.
    pub(crate) into: &'a Path,
    pub(crate) quiet: bool,
    /// Whether each written file and each note is printed.
    pub(crate) in_detail: bool,
}

/// Counts of drawn and failed models.
#[derive(Debug, Default)]
pub(crate) struct BatchTally {
    /// Models that were drawn.
    pub(crate) drawn: u64,
    /// Files that were written, and their total size in bytes.
    pub(crate) files: u64,
    pub(crate) bytes: u64,
    /// Models with errors in the input.
    pub(crate) refused: u64,
    /// Models with errors that may be temporary.
    pub(crate) failed: u64,
}

/// Files that were written for a model.
#[derive(Default)]
struct WrittenFiles {
    /// A line of text per file, for messages.
    lines: Vec<String>,
    /// Hints and choices made for the user, without duplicates.
    notes: Vec<String>,
    files: u64,
    bytes: u64,
}

impl WorkerPool<'_> {
    /// Draws all models, as many in parallel as there are threads. Failures are reported, and the other
    /// models continue.
    pub(crate) fn draw(&self, tasks: &[DrawTask]) -> BatchTally {
        let progress = Progress::start(self.quiet, self.into);
        let started = Instant::now();
        let next = Mutex::new(tasks.iter());
        let tally = Mutex::new(BatchTally::default());
        let work = || {
            loop {
                let task = next.lock().ok().and_then(|mut next| next.next());
                let Some(task) = task else { return };
                let made = self.pool.install(|| draw_task(task));
                let Ok(mut tally) = tally.lock() else { return };
                self.take(task, made, &mut tally, &progress);
                progress.step(progress_text(&tally, tasks.len(), started.elapsed()));
            }
        };
        progress.step(progress_text(&BatchTally::default(), tasks.len(), Duration::ZERO));
        // Separate threads start the models. A pool thread that waits inside a drawing would otherwise
        // begin another drawing on the same stack.
        let at_once = self.pool.current_num_threads().min(tasks.len());
        std::thread::scope(|scope| {
            for _ in 0..at_once {
                scope.spawn(work);
            }
        });
        tally.into_inner().unwrap_or_default()
    }

    /// Adds the result of a task to the counts, and prints its messages.
    fn take(
        &self,
        task: &DrawTask,
        made: Result<(WrittenFiles, Vec<String>), Box<ModelFailure>>,
        tally: &mut BatchTally,
        progress: &Progress,
    ) {
        match made {
            Ok((made, warnings)) => {
                tally.drawn += 1;
                tally.files += made.files;
                tally.bytes += made.bytes;
                if !self.quiet {
                    for warning in warnings {
                        progress.print_line(&format!("warning: {}: {warning}", task.job.model().display()));
                    }
                    for note in made.notes.iter().filter(|_| self.in_detail) {
                        progress.print_line(&format!("note: {}: {note}", task.job.model().display()));
                    }
                    made.lines.iter().filter(|_| self.in_detail).for_each(|line| progress.print_line(line));
                }
            }
            Err(failure) => {
                let ModelFailure { error, is_temporary: passes } = *failure;
                *(if passes { &mut tally.failed } else { &mut tally.refused }) += 1;
                progress.print_line(&format!("error: {}", error.or_in_file(task.job.model())));
            }
        }
    }
}

impl BatchTally {
    /// Exit status of the program. Temporary errors take precedence, because a second call may complete the
    /// work.
    pub(crate) const fn status(&self) -> u8 {
        match (self.failed, self.refused) {
            (0, 0) => 0,
            (0, _) => EXIT_WRONG,
            _ => EXIT_TRY_LATER,
        }
    }
}

/// Error that ended the drawing of a model.
struct ModelFailure {
    error: Error,
    /// Whether the same call may succeed later.
    is_temporary: bool,
}

/// Draws a model from all views and writes the files, all or none. Returns the warnings without duplicates.
fn draw_task(task: &DrawTask) -> Result<(WrittenFiles, Vec<String>), Box<ModelFailure>> {
    let (since, mut watch) = (Stopwatch::start(), Stopwatch::start());
    let mut staging = Staging::default();
    let (mut made, mut warnings) = (WrittenFiles::default(), Vec::new());
    let writes = Cell::new(false);
    let drawn = model_drawing::draw_model(
        None,
        &task.requests,
        &mut watch,
        &Progress::start(true, Path::new("")),
        |request, drawn| {
            model_drawing::refuse_warnings(request, &drawn.report)?;
            add_new(&mut warnings, drawn.report.warnings.iter().cloned());
            add_new(&mut made.notes, drawn.notes.iter().cloned());
            writes.set(true);
            for (output, bytes) in request.outputs.iter().zip(&drawn.encoded) {
                if let Some(folder) = output.path.parent() {
                    fs::create_dir_all(folder)
                        .map_err(|error| Error::io("cannot create the folder", error).in_file(folder))?;
                }
                staging.add(&output.path, bytes)?;
                made.files += 1;
                made.bytes += bytes.len() as u64;
            }
            writes.set(false);
            for (output, bytes) in request.outputs.iter().zip(&drawn.encoded) {
                made.lines.push(format!(
                    "{}: {}",
                    output.name(),
                    model_drawing::summary(&drawn, bytes, since.seconds())
                ));
            }
            Ok(())
        },
    );
    // Any error of the output folder may be temporary, because it says nothing about the model.
    let failure = |error: Error, writes: bool| {
        let passes = exit_status::is_temporary(&error) || (writes && error.kind == ErrorKind::Io);
        Box::new(ModelFailure { error, is_temporary: passes })
    };
    drawn.map_err(|error| failure(error, writes.get()))?;
    staging.commit().map_err(|error| failure(error, true))?;
    Ok((made, warnings))
}

/// Progress text: `312 drawn, 3 failed, 688 left, 12 s to go, into`
fn progress_text(tally: &BatchTally, all: usize, elapsed: Duration) -> String {
    let failed = tally.refused + tally.failed;
    let done = tally.drawn + failed;
    let left = (all as u64).saturating_sub(done);
    let mut text = format!("{} drawn, ", number_text::grouped(tally.drawn));
    if failed > 0 {
        text += &format!("{} failed, ", number_text::grouped(failed));
    }
    text += &format!("{} left, ", number_text::grouped(left));
    if done > 0 {
        text += &format!("{} to go, ", time(elapsed.as_secs_f64() * left as f64 / done as f64));
    }
    text + "into"
}

/// Duration as text: `45 s`, `12 min`, `3 h 20 min`.
fn time(seconds: f64) -> String {
    let (seconds, minutes) = (seconds.ceil() as u64, (seconds / 60.0).ceil() as u64);
    match seconds {
        0..120 => format!("{seconds} s"),
        120..7200 => format!("{minutes} min"),
        _ => format!("{} h {} min", minutes / 60, minutes % 60),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn progress_text_reports_models_left_and_remaining_time() {
        let none = BatchTally::default();
        assert_eq!(progress_text(&none, 1000, Duration::ZERO), "0 drawn, 1,000 left, into");
        let some = BatchTally { drawn: 98, refused: 2, ..BatchTally::default() };
        assert_eq!(
            progress_text(&some, 1000, Duration::from_secs(1)),
            "98 drawn, 2 failed, 900 left, 9 s to go, into"
        );
        assert_eq!([100.0, 600.0, 12_000.0].map(time), ["100 s", "10 min", "3 h 20 min"]);
    }

    #[test]
    fn batch_status_gives_temporary_errors_precedence() {
        let status = |refused, failed| BatchTally { refused, failed, ..BatchTally::default() }.status();
        assert_eq!(
            [status(0, 0), status(2, 0), status(0, 1), status(2, 1)],
            [0, EXIT_WRONG, EXIT_TRY_LATER, EXIT_TRY_LATER]
        );
    }
}
