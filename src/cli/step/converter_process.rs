//! Runs a converter as a process with limits on time and memory.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{Read, Seek, SeekFrom};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Default limits. A STEP file of 100 MB takes about a minute and 2 GB.
const MAX_TIME_S: u64 = 300;
const MAX_MEMORY_MB: u64 = 8192;

/// Environment variables for other limits.
pub(crate) const SECONDS_VARIABLE: &str = "LIGNE_STEP_SECONDS";
pub(crate) const MB_VARIABLE: &str = "LIGNE_STEP_MB";

/// Time between two checks of the process.
const POLL_INTERVAL: Duration = Duration::from_millis(10);

/// Maximum number of bytes read from the end of the output, bytes. Converters report errors last.
const MAX_SHOWN_BYTES: u64 = 2000;

/// Limits of a converter.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ProcessLimits {
    pub(crate) seconds: u64,
    pub(crate) mb: u64,
}

impl ProcessLimits {
    /// Limits from the environment, or the defaults.
    pub(crate) fn of_process() -> Self {
        let number = |name: &str| std::env::var(name).ok()?.trim().parse().ok().filter(|n: &u64| *n > 0);
        Self {
            seconds: number(SECONDS_VARIABLE).unwrap_or(MAX_TIME_S),
            mb: number(MB_VARIABLE).unwrap_or(MAX_MEMORY_MB),
        }
    }
}

/// How a converter ended.
#[derive(Debug)]
pub(crate) enum ProcessOutcome {
    /// Exit status and last line of output.
    Exited(i32, String),
    /// Stopped by a signal; last line of output.
    Killed(String),
    /// Stopped because the time limit was exceeded.
    TimedOut,
    /// The program does not exist or cannot be run.
    NotRun(std::io::Error),
}

/// Runs a program until it ends or exceeds its time. Its output goes to the file `log`, because a pipe would
/// have to be read meanwhile.
///
/// `bounds_memory` limits the address space, for programs that reserve little more than they use.
pub(crate) fn run(
    program: &Path,
    arguments: &[OsString],
    variables: &[(&str, OsString)],
    (limits, bounds_memory): (ProcessLimits, bool),
    log: &Path,
) -> ProcessOutcome {
    let output = File::create(log).and_then(|file| Ok((file.try_clone()?, file)));
    let (out, err) = match output {
        Ok(files) => files,
        Err(error) => return ProcessOutcome::NotRun(error),
    };
    let mut command = bounded(program, limits, bounds_memory);
    command.args(arguments).envs(variables.iter().map(|(name, value)| (name, value)));
    let started = Instant::now();
    let mut child = match command.stdin(Stdio::null()).stdout(out).stderr(err).spawn() {
        Ok(child) => child,
        Err(error) => return ProcessOutcome::NotRun(error),
    };
    let outcome = loop {
        match child.try_wait() {
            Ok(Some(status)) => {
                let said = last_words(log);
                break status.code().map_or_else(
                    || ProcessOutcome::Killed(said.clone()),
                    |code| ProcessOutcome::Exited(code, said.clone()),
                );
            }
            Ok(None) if started.elapsed() < Duration::from_secs(limits.seconds) => {
                std::thread::sleep(POLL_INTERVAL)
            }
            Ok(None) => {
                // The process may have just ended. Failures are ignored.
                let _ = child.kill();
                let _ = child.wait();
                break ProcessOutcome::TimedOut;
            }
            Err(error) => break ProcessOutcome::NotRun(error),
        }
    };
    // A file that cannot be removed does no harm.
    let _ = fs::remove_file(log);
    outcome
}

/// Command that sets the limits in a shell and then runs the program. CPU time is limited as well, for
/// processes that outlive a script.
#[cfg(unix)]
fn bounded(program: &Path, limits: ProcessLimits, bounds_memory: bool) -> Command {
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get) as u64;
    let mut script = format!("ulimit -t {} 2>/dev/null; ", limits.seconds.saturating_mul(cores));
    if bounds_memory {
        // macOS does not support this limit.
        script += &format!("ulimit -v {} 2>/dev/null; ", limits.mb.saturating_mul(1024));
    }
    let mut command = Command::new("/bin/sh");
    command.arg("-c").arg(script + "exec \"$0\" \"$@\"").arg(program);
    command
}

#[cfg(not(unix))]
fn bounded(program: &Path, _: ProcessLimits, _: bool) -> Command {
    Command::new(program)
}

/// Last line of a text file that is not blank.
fn last_words(log: &Path) -> String {
    let read = || {
        let mut file = File::open(log)?;
        let length = file.metadata()?.len();
        file.seek(SeekFrom::Start(length.saturating_sub(MAX_SHOWN_BYTES)))?;
        let mut bytes = Vec::new();
        file.take(MAX_SHOWN_BYTES).read_to_end(&mut bytes)?;
        Ok::<_, std::io::Error>(bytes)
    };
    let text = String::from_utf8_lossy(&read().unwrap_or_default()).into_owned();
    // Progress bars separate their states with tabs and carriage returns.
    let mut lines = text.split(['\n', '\r', '\t']).map(str::trim);
    lines.rfind(|line| !line.is_empty()).unwrap_or_default().to_owned()
}
