//! `ligne test`: draws every case of a folder and compares it with the approved drawing.
//!
//! 1. [`case_folder`] finds the case files and reads each as a [`test_case`].
//! 2. [`case_outcome`] draws each case in parallel and compares it with its approved drawing, within the
//!    tolerance.
//! 3. Results are printed, and written as a page ([`html_report`]) or as JUnit XML ([`junit_report`]).
//! 4. [`failure_files`] writes the drawings of failing cases to a folder. `--bless` approves new drawings.

mod case_folder;
mod case_outcome;
mod failure_files;
mod html_report;
mod junit_report;
mod test_case;

use std::path::PathBuf;
use std::process::ExitCode;

use crate::parallel::prelude::*;
use clap::Args;

use self::case_folder::CaseFolder;
use self::case_outcome::{CaseOutcome, CaseTotals, CaseVerdict};
use super::{EXIT_DIFFERENCES, EXIT_WRONG, library_calls, print, say};
use crate::cli::config::call_defaults::CallEnvironment;
use crate::cli::config::project_config::ProjectConfig;
use crate::cli::output::output_files::{Staging, check_place};
use crate::cli::output::progress::Progress;
use crate::diff::Tolerances;
use crate::error::Error;
use crate::geometry::names::glob::Glob;

/// Maximum number of findings shown per case. Reports contain all.
const MAX_SHOWN_FINDINGS: usize = 20;

/// Options of `ligne test`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  ligne test drawings                        compare each case in drawings/ with its approved drawing
  ligne test drawings --html changes.html    show the changes on a page
  ligne test drawings --bless                approve the new drawings
  ligne test drawings --junit results.xml    results for a CI service

A case is a file such as drawings/lid.toml, next to its approved drawing lid.svg:
  model = \"../models/lid.glb\"
  view = \"iso\"
  style = \"technical\"
  tolerance = \"0.1px\"")]
pub(crate) struct TestArgs {
    /// Folder of case files, or one case file
    folder: PathBuf,

    /// Test only cases with a matching name; repeatable
    #[arg(long, alias = "only", value_name = "GLOB",
        value_parser = |glob: &str| Ok::<_, std::convert::Infallible>(Glob::new(glob)))]
    cases: Vec<Glob>,

    /// Approve drawings that differ or are new; refused if the variable CI is set
    #[arg(long)]
    bless: bool,

    /// Write a page with before, after and difference of each changed case
    #[arg(long, alias = "report", value_name = "FILE.html")]
    html: Option<PathBuf>,

    /// Include passing cases in the page
    #[arg(long, alias = "report-all", requires = "html")]
    html_all: bool,

    /// Write the results as JUnit XML
    #[arg(long, value_name = "FILE.xml")]
    junit: Option<PathBuf>,

    /// Write NAME.actual.svg and NAME.diff.svg of failing cases to this folder
    #[arg(long, alias = "output", value_name = "FOLDER")]
    out_dir: Option<PathBuf>,

    /// Number of threads; never changes the results [env: LIGNE_THREADS] [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,

    /// Print failing cases only
    #[arg(short, long)]
    quiet: bool,
}

/// Draws and compares all cases, prints the results, and writes the requested reports.
pub(crate) fn run(
    args: &TestArgs,
    no_config: bool,
    surroundings: &CallEnvironment,
) -> Result<ExitCode, Error> {
    if args.bless && surroundings.is_ci {
        return Err(Error::new("drawings cannot be approved in CI: the variable CI is set")
            .at("--bless")
            .remedy("run --bless on your own machine and commit the drawings"));
    }
    for file in args.html.iter().chain(&args.junit) {
        check_place(file)?;
    }
    let tolerances = tolerances(no_config, surroundings)?;
    let folder = CaseFolder::read(&args.folder, &args.cases)?;
    let progress = Progress::start(args.quiet, &args.folder);
    progress.step("drawing");
    let draw = || folder.cases.par_iter().map(|case| CaseOutcome::of(case, &tolerances)).collect::<Vec<_>>();
    let outcomes = library_calls::in_threads(args.threads, draw)?;
    drop(progress);

    let totals = CaseTotals::of(&outcomes);
    // Nothing is approved if a case has an error.
    let blessed = args.bless && totals.errors == 0;
    write(args, &outcomes, blessed)?;
    print(results_text(args, &outcomes, totals, blessed).as_bytes())?;
    for orphan in &folder.orphans {
        say(&format!(
            "warning: {}: no case uses this drawing; remove it, or write a case for it",
            orphan.display()
        ));
    }
    Ok(match totals {
        CaseTotals { errors: 1.., .. } => ExitCode::from(EXIT_WRONG),
        CaseTotals { differ: 0, new: 0, .. } => ExitCode::SUCCESS,
        _ if blessed => ExitCode::SUCCESS,
        _ => ExitCode::from(EXIT_DIFFERENCES),
    })
}

/// Tolerances of `ligne.toml`. Cases use nothing else of that file, because they contain all other settings.
fn tolerances(no_config: bool, surroundings: &CallEnvironment) -> Result<Tolerances, Error> {
    let config = match &surroundings.folder {
        Some(folder) if !no_config => ProjectConfig::find(folder)?,
        _ => None,
    };
    let text = config.and_then(|config| config.tolerance);
    text.map_or(Ok(Tolerances::default()), |text| Tolerances::parse(&text))
}

fn passed(outcome: &CaseOutcome<'_>, blessed: bool) -> bool {
    match outcome.verdict {
        CaseVerdict::Passed => true,
        CaseVerdict::Differs(_) | CaseVerdict::New => blessed,
        CaseVerdict::Error(_) => false,
    }
}

/// Writes approved drawings and reports, all or none.
fn write(args: &TestArgs, outcomes: &[CaseOutcome<'_>], blessed: bool) -> Result<(), Error> {
    let mut staging = Staging::default();
    if blessed {
        for outcome in outcomes {
            if let (CaseVerdict::Differs(_) | CaseVerdict::New, Some(after)) =
                (&outcome.verdict, &outcome.after)
            {
                staging.add(&outcome.case.drawing, after.as_bytes())?;
            }
        }
    }
    let folder = args.folder.to_string_lossy();
    if let Some(path) = &args.html {
        staging.add(path, html_report::page(&folder, outcomes, args.html_all, blessed).as_bytes())?;
    }
    if let Some(path) = &args.junit {
        staging.add(path, junit_report::document(&folder, outcomes, blessed).as_bytes())?;
    }
    if let Some(kept) = &args.out_dir {
        failure_files::write_failures(kept, outcomes, |outcome| passed(outcome, blessed))?;
    }
    staging.commit()
}

/// Result text: one line per case with its differences below, and the totals.
fn results_text(args: &TestArgs, outcomes: &[CaseOutcome<'_>], totals: CaseTotals, blessed: bool) -> String {
    let mut text = String::new();
    for outcome in outcomes {
        if args.quiet && matches!(outcome.verdict, CaseVerdict::Passed) {
            continue;
        }
        let word = match outcome.verdict {
            CaseVerdict::Differs(_) | CaseVerdict::New if blessed => "blessed",
            _ => outcome.verdict.word(),
        };
        let (name, summary) = (&outcome.case.name, outcome.summary(blessed).replace('\n', "\n         "));
        let colon = if summary.is_empty() { "" } else { ": " };
        text.push_str(&format!("{word:7}  {name}{colon}{summary}\n"));
        let lines = outcome.lines();
        for line in lines.iter().take(MAX_SHOWN_FINDINGS) {
            text.push_str(&format!("         {line}\n"));
        }
        if lines.len() > MAX_SHOWN_FINDINGS {
            text.push_str(&format!("         and {} more\n", lines.len() - MAX_SHOWN_FINDINGS));
        }
    }
    let CaseTotals { differ, new, errors, .. } = totals;
    if !args.quiet || differ + new + errors > 0 {
        text.push_str(&totals.line(blessed));
        text.push('\n');
    }
    if args.bless && !blessed {
        text.push_str("No drawing was approved, because a case cannot be drawn.\n");
    } else if !blessed && differ + new > 0 {
        text.push_str("Look at the changes with --html FILE.html. Accept intended ones with --bless.\n");
    }
    text
}
