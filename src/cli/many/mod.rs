//! `ligne draw` of several models, from several sides, in shards, resumed, and again whenever something changes.

pub(super) mod args;
mod crew;
mod inputs;
mod leftovers;
mod plan;
pub(super) mod stamp;
mod watch;

use std::path::Path;
use std::process::ExitCode;

use crew::{Crew, Tally, Task};
use inputs::is_current;
use plan::Job;
use watch::Watch;

use super::draw_args::DrawArgs;
use super::output::{check_place, is_stdout};
use super::shard::{Shard, of_array};
use super::{number, pipeline, say, wonder};
use crate::error::Error;
use crate::render::Stopwatch;

/// Whether more is asked for than one drawing, made once.
pub(super) fn is_asked(args: &DrawArgs) -> bool {
    args.many.is_asked() || args.how.view.len() > 1
}

/// Draws all that is to be drawn here, and says so; where files are watched it goes on until it is stopped.
pub(super) fn run(args: DrawArgs) -> Result<ExitCode, Error> {
    let watch = Stopwatch::start();
    check(&args)?;
    let jobs = plan::jobs(&args)?;
    let shard = shard(&args, jobs.len())?;
    let mine = |(number, job)| shard.is_none_or(|shard| shard.has(number)).then_some(job);
    let jobs: Vec<Job> = jobs.into_iter().enumerate().filter_map(mine).collect();
    if let Some(request) = jobs.iter().flat_map(|job| &job.requests).next() {
        // Told once, and not by every model.
        pipeline::load_style(&request.style, &request.sets, request.background)?;
        match wonder::bare_lengths(request) {
            Some(warning) if request.strict => {
                return Err(Error::new(warning).remedy("give the unit, or draw without --strict"));
            }
            Some(warning) if !request.quiet => say(&format!("warning: {warning}")),
            _ => {}
        }
    }
    if args.many.out_dir.is_none() {
        // No folder is made but the one that is asked for.
        let mut outputs = jobs.iter().flat_map(|job| &job.requests).flat_map(|request| &request.outputs);
        outputs.try_for_each(|output| check_place(&output.path))?;
    }
    let pool = pipeline::pool(args.how.threads)?;
    let into = args.many.out_dir.as_deref();
    let quiet = args.how.quiet;
    let crew = Crew {
        pool: &pool,
        into: into.unwrap_or(&args.model),
        quiet,
        in_detail: into.is_none() || args.many.watch,
    };

    let mut watching = args.many.watch.then(|| Watch::new(&jobs));
    let tasks = tasks(&jobs, args.many.resume);
    if args.many.resume {
        let requests = tasks.iter().flat_map(|task| &task.requests);
        leftovers::sweep(requests.flat_map(|request| &request.outputs).map(|output| output.path.as_path()));
    }
    let current = (jobs.len() - tasks.len()) as u64;
    let tally = crew.draw(&tasks);
    if !quiet && (into.is_some() || current > 0) {
        say(&summary(crew.into, &tally, current, shard, watch.seconds()));
    }
    if watching.is_some() && !quiet {
        say(&format!("watching {}; Ctrl-C ends", number::counted(jobs.len() as u64, "model")));
    }
    while let Some(watching) = &mut watching {
        let again: Vec<Task> = watching.changed().into_iter().map(whole).collect();
        crew.draw(&again);
    }
    Ok(ExitCode::from(tally.status()))
}

/// Refuses what does not go together, before any work.
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
    if args.many.watch && plan::models(args).iter().any(|model| is_stdout(model)) {
        return Err(Error::new("standard input cannot be watched").at("--watch").remedy("name a file"));
    }
    match &args.many.out_dir {
        Some(folder) if folder.exists() && !folder.is_dir() => {
            Err(Error::new("this is not a folder").in_file(folder).remedy("name a folder for the drawings"))
        }
        _ => Ok(()),
    }
}

/// The share of the work that is to be done here. One model is nobody's share: it was picked already.
fn shard(args: &DrawArgs, models: usize) -> Result<Option<Shard>, Error> {
    match args.many.shard {
        Some(share) => share.shard().map(Some),
        None if args.many.out_dir.is_some() && models > 1 => of_array(),
        None => Ok(None),
    }
}

/// What is to be drawn: all, or where a run is resumed what is missing or old.
fn tasks(jobs: &[Job], resume: bool) -> Vec<Task<'_>> {
    let mut tasks: Vec<Task> = jobs.iter().map(whole).collect();
    if resume {
        for task in &mut tasks {
            task.requests.retain(|request| !is_current(request));
        }
        tasks.retain(|task| !task.requests.is_empty());
    }
    tasks
}

fn whole(job: &Job) -> Task<'_> {
    Task { job, requests: job.requests.iter().collect() }
}

/// `drawings: shard 2/4, 245 models drawn, 490 files, 1.2 MB, 3.40 s, 5 refused, 3 up to date`
fn summary(into: &Path, tally: &Tally, current: u64, shard: Option<Shard>, seconds: f64) -> String {
    let shard = shard.map_or_else(String::new, |shard| format!("shard {shard}, "));
    let mut line = format!(
        "{}: {shard}{} drawn, {}, {}, {seconds:.2} s",
        into.display(),
        number::counted(tally.drawn, "model"),
        number::counted(tally.files, "file"),
        number::bytes(tally.bytes),
    );
    let rest = [(tally.refused, "refused"), (tally.failed, "to be tried again"), (current, "up to date")];
    for (count, what) in rest.into_iter().filter(|(count, _)| *count > 0) {
        line += &format!(", {} {what}", number::grouped(count));
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_summary_is_one_line() {
        let tally = Tally { drawn: 245, files: 1490, bytes: 1_200_000, refused: 5, failed: 0 };
        assert_eq!(
            summary(Path::new("drawings"), &tally, 3, None, 3.4),
            "drawings: 245 models drawn, 1,490 files, 1.2 MB, 3.40 s, 5 refused, 3 up to date"
        );
    }
}
