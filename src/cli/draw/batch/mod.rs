//! `ligne draw` for several models or views: into a folder, in shards, resumed, or again after each change.
//!
//! 1. [`batch_jobs`] lists the drawings of each model and refuses two drawings with the same path.
//! 2. A shard keeps its share of the models. `--resume` drops drawings newer than their inputs
//!    ([`drawing_inputs`]) and removes unfinished files of stopped runs ([`temp_files`]).
//! 3. [`worker_pool`] draws the models in parallel and counts drawn, refused and failed ones.
//! 4. `--watch` repeats this for models whose inputs change ([`input_watch`]).

mod batch_jobs;
mod drawing_inputs;
mod input_watch;
mod temp_files;
mod worker_pool;

use std::path::Path;
use std::process::ExitCode;

use batch_jobs::BatchJob;
use drawing_inputs::is_current;
use input_watch::InputWatch;
use worker_pool::{BatchTally, DrawTask, WorkerPool};

use crate::cli::options::draw_args::DrawArgs;
use crate::cli::options::values::shard::{Shard, of_array};
use crate::cli::output::number_text;
use crate::cli::output::output_files::{check_place, is_stdout};
use crate::cli::request::usage_warnings;
use crate::cli::{library_calls, say};
use crate::error::Error;
use crate::pipeline::Stopwatch;

/// Whether a call draws more than one drawing once.
pub(crate) fn is_batch(args: &DrawArgs) -> bool {
    args.many.is_asked() || args.how.view.len() > 1
}

/// Draws all models of this shard and prints a summary. With `--watch` it continues until it is stopped.
pub(crate) fn run(args: DrawArgs) -> Result<ExitCode, Error> {
    let watch = Stopwatch::start();
    check(&args)?;
    let jobs = batch_jobs::jobs(&args)?;
    let shard = shard(&args, jobs.len())?;
    let mine = |(number, job)| shard.is_none_or(|shard| shard.has(number)).then_some(job);
    let jobs: Vec<BatchJob> = jobs.into_iter().enumerate().filter_map(mine).collect();
    if let Some(request) = jobs.iter().flat_map(|job| &job.requests).next() {
        // Style errors are reported once, not for each model.
        library_calls::load_style(&request.how.style, &request.sets, request.background)?;
        match usage_warnings::bare_lengths(request) {
            Some(warning) if request.how.strict => {
                return Err(Error::new(warning).remedy("give the unit, or draw without --strict"));
            }
            Some(warning) if !request.how.quiet => say(&format!("warning: {warning}")),
            _ => {}
        }
    }
    if args.many.out_dir.is_none() {
        // Only the folder of `--out-dir` is created.
        let mut outputs = jobs.iter().flat_map(|job| &job.requests).flat_map(|request| &request.outputs);
        outputs.try_for_each(|output| check_place(&output.path))?;
    }
    let pool = library_calls::pool(args.how.threads)?;
    let into = args.many.out_dir.as_deref();
    let quiet = args.how.quiet;
    let crew = WorkerPool {
        pool: &pool,
        into: into.unwrap_or(&args.model),
        quiet,
        in_detail: into.is_none() || args.many.watch,
    };

    let mut watching = args.many.watch.then(|| InputWatch::new(&jobs));
    let tasks = tasks(&jobs, args.many.resume);
    if args.many.resume {
        let requests = tasks.iter().flat_map(|task| &task.requests);
        temp_files::remove_temp_files(
            requests.flat_map(|request| &request.outputs).map(|output| output.path.as_path()),
        );
    }
    let current = (jobs.len() - tasks.len()) as u64;
    let tally = crew.draw(&tasks);
    if !quiet && (into.is_some() || current > 0) {
        say(&summary(crew.into, &tally, current, shard, watch.seconds()));
    }
    if watching.is_some() && !quiet {
        say(&format!("watching {}; Ctrl-C ends", number_text::counted(jobs.len() as u64, "model")));
    }
    while let Some(watching) = &mut watching {
        let again: Vec<DrawTask> = watching.changed().into_iter().map(whole).collect();
        crew.draw(&again);
    }
    Ok(ExitCode::from(tally.status()))
}

/// Refuses contradictory options before any work.
fn check(args: &DrawArgs) -> Result<(), Error> {
    let of_one = [
        ("--report", args.report.is_some()),
        ("--maps", args.maps.is_some()),
        ("--save-camera", args.save.save_camera.is_some()),
    ];
    if let Some((option, _)) = of_one.into_iter().find(|(_, given)| *given) {
        return Err(Error::new("this option works with a single drawing only")
            .at(option)
            .remedy("leave it out, or draw one model from one view"));
    }
    if args.many.watch && batch_jobs::models(args).iter().any(|model| is_stdout(model)) {
        return Err(Error::new("standard input cannot be watched").at("--watch").remedy("name a file"));
    }
    match &args.many.out_dir {
        Some(folder) if folder.exists() && !folder.is_dir() => {
            Err(Error::new("this is not a folder").in_file(folder).remedy("name a folder for the drawings"))
        }
        _ => Ok(()),
    }
}

/// Shard of this call. A single model is not split, because it was already selected.
fn shard(args: &DrawArgs, models: usize) -> Result<Option<Shard>, Error> {
    match args.many.shard {
        Some(share) => share.shard().map(Some),
        None if args.many.out_dir.is_some() && models > 1 => of_array(),
        None => Ok(None),
    }
}

/// Drawings to make: all, or under `--resume` only missing and outdated ones.
fn tasks(jobs: &[BatchJob], resume: bool) -> Vec<DrawTask<'_>> {
    let mut tasks: Vec<DrawTask> = jobs.iter().map(whole).collect();
    if resume {
        for task in &mut tasks {
            task.requests.retain(|request| !is_current(request));
        }
        tasks.retain(|task| !task.requests.is_empty());
    }
    tasks
}

fn whole(job: &BatchJob) -> DrawTask<'_> {
    DrawTask { job, requests: job.requests.iter().collect() }
}

/// Summary line: `drawings: shard 2/4, 245 models drawn, 490 files, 1.2 MB, 3.40 s, 5 refused, 3 up to date`
fn summary(into: &Path, tally: &BatchTally, current: u64, shard: Option<Shard>, seconds: f64) -> String {
    let shard = shard.map_or_else(String::new, |shard| format!("shard {shard}, "));
    let mut line = format!(
        "{}: {shard}{} drawn, {}, {}, {seconds:.2} s",
        into.display(),
        number_text::counted(tally.drawn, "model"),
        number_text::counted(tally.files, "file"),
        number_text::bytes(tally.bytes),
    );
    let rest = [(tally.refused, "refused"), (tally.failed, "to be tried again"), (current, "up to date")];
    for (count, what) in rest.into_iter().filter(|(count, _)| *count > 0) {
        line += &format!(", {} {what}", number_text::grouped(count));
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn batch_summary_is_one_line() {
        let tally = BatchTally { drawn: 245, files: 1490, bytes: 1_200_000, refused: 5, failed: 0 };
        assert_eq!(
            summary(Path::new("drawings"), &tally, 3, None, 3.4),
            "drawings: 245 models drawn, 1,490 files, 1.2 MB, 3.40 s, 5 refused, 3 up to date"
        );
    }
}
