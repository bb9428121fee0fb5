//! Runs `ligne draw` as a process, and measures wall time, CPU time, memory and stages.

use std::io::Error;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::Instant;

const LIGNE: &str = env!("CARGO_BIN_EXE_ligne");

/// GNU time, which reports the memory of a finished process.
const GNU_TIME: &str = "/usr/bin/time";

/// Bash script that reports CPU time in milliseconds. GNU time only reports hundredths of a second.
const BASH_TIME: &str = "TIMEFORMAT='%3U %3S'; time \"$0\" \"$@\"";

/// Number of threads of a drawing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Threads {
    One,
    All,
}

/// Wall time of drawing a model, from start to end of the process, seconds.
pub fn draw(model: &Path, drawing: &Path, threads: Threads, options: &[&str]) -> Result<f64, Error> {
    let mut command = Command::new(LIGNE);
    add_arguments(&mut command, model, drawing, threads);
    command.args(options);
    let start = Instant::now();
    let output = command.stdin(Stdio::null()).output()?;
    let seconds = start.elapsed().as_secs_f64();
    succeeded(&output).map(|()| seconds)
}

/// CPU time of drawing a model, user and system, seconds; `None` without Bash.
pub fn cpu(model: &Path, drawing: &Path, threads: Threads) -> Option<f64> {
    let mut command = Command::new("bash");
    command.args(["-c", BASH_TIME, LIGNE]);
    Some(told(command, model, drawing, threads)?.iter().sum())
}

/// Memory of drawing a model, bytes; `None` without GNU time.
pub fn memory(model: &Path, drawing: &Path, threads: Threads) -> Option<f64> {
    let mut command = Command::new(GNU_TIME);
    command.args(["-f", "%M", LIGNE]);
    Some(told(command, model, drawing, threads)?.first()? * 1024.0)
}

/// Numbers that a wrapper command prints about the drawing.
fn told(mut command: Command, model: &Path, drawing: &Path, threads: Threads) -> Option<Vec<f64>> {
    add_arguments(&mut command, model, drawing, threads);
    let output = command.stdin(Stdio::null()).output().ok()?;
    let said = String::from_utf8(output.stderr).ok()?;
    said.split_whitespace().map(|word| word.parse().ok()).collect()
}

/// Stages of a drawing with their times in milliseconds, in the order of the report.
pub fn stages(model: &Path, drawing: &Path) -> Result<Vec<(String, f64)>, Error> {
    let report = drawing.with_extension("json");
    let mut command = Command::new(LIGNE);
    add_arguments(&mut command, model, drawing, Threads::All);
    succeeded(&command.arg("--report").arg(&report).output()?)?;
    let text = std::fs::read_to_string(&report)?;
    // Only stage times contain a decimal point.
    let stage = |line: &str| {
        let (name, number) = line.trim().trim_end_matches(',').split_once(": ")?;
        let number = number.contains('.').then(|| number.parse().ok())??;
        Some((name.trim_matches('"').to_owned(), number))
    };
    Ok(text.lines().filter_map(stage).filter(|(_, ms)| *ms > 0.0).collect())
}

fn add_arguments(command: &mut Command, model: &Path, drawing: &Path, threads: Threads) {
    command.arg("draw").arg(model).arg(drawing).arg("--quiet");
    if threads == Threads::One {
        command.args(["--threads", "1"]);
    }
}

fn succeeded(output: &Output) -> Result<(), Error> {
    if output.status.success() {
        return Ok(());
    }
    Err(Error::other(String::from_utf8_lossy(&output.stderr).into_owned()))
}
