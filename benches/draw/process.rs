//! `ligne draw` as a process of its own: wall time, CPU time, memory, stages.

use std::io::Error;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::Instant;

const LIGNE: &str = env!("CARGO_BIN_EXE_ligne");

/// GNU time, which tells the memory of a process that has ended.
const GNU_TIME: &str = "/usr/bin/time";

/// What has Bash tell CPU time in milliseconds, where GNU time tells it in hundredths of seconds.
const BASH_TIME: &str = "TIMEFORMAT='%3U %3S'; time \"$0\" \"$@\"";

/// How many threads a drawing may use.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Threads {
    One,
    All,
}

/// Seconds that drawing the model takes from start to end of the process, with more options if there are any.
pub fn draw(model: &Path, drawing: &Path, threads: Threads, options: &[&str]) -> Result<f64, Error> {
    let mut command = Command::new(LIGNE);
    add_arguments(&mut command, model, drawing, threads);
    command.args(options);
    let start = Instant::now();
    let output = command.stdin(Stdio::null()).output()?;
    let seconds = start.elapsed().as_secs_f64();
    succeeded(&output).map(|()| seconds)
}

/// CPU seconds, of the user and of the system, that drawing the model takes; `None` without Bash.
pub fn cpu(model: &Path, drawing: &Path, threads: Threads) -> Option<f64> {
    let mut command = Command::new("bash");
    command.args(["-c", BASH_TIME, LIGNE]);
    Some(told(command, model, drawing, threads)?.iter().sum())
}

/// Bytes of memory that drawing the model takes; `None` without GNU time.
pub fn memory(model: &Path, drawing: &Path, threads: Threads) -> Option<f64> {
    let mut command = Command::new(GNU_TIME);
    command.args(["-f", "%M", LIGNE]);
    Some(told(command, model, drawing, threads)?.first()? * 1024.0)
}

/// The numbers that a command around the drawing tells.
fn told(mut command: Command, model: &Path, drawing: &Path, threads: Threads) -> Option<Vec<f64>> {
    add_arguments(&mut command, model, drawing, threads);
    let output = command.stdin(Stdio::null()).output().ok()?;
    let said = String::from_utf8(output.stderr).ok()?;
    said.split_whitespace().map(|word| word.parse().ok()).collect()
}

/// The stages of a drawing and their milliseconds, in the order of the report.
pub fn stages(model: &Path, drawing: &Path) -> Result<Vec<(String, f64)>, Error> {
    let report = drawing.with_extension("json");
    let mut command = Command::new(LIGNE);
    add_arguments(&mut command, model, drawing, Threads::All);
    succeeded(&command.arg("--report").arg(&report).output()?)?;
    let text = std::fs::read_to_string(&report)?;
    // Stages are the only numbers with a point.
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
