//! Progress on standard error, shown on terminals for work that takes over half a second.

use std::io::{IsTerminal, Write};
use std::path::Path;
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Delay before progress is shown.
const SHOW_DELAY: Duration = Duration::from_millis(500);

/// Time between two updates of the bar.
const TICK_INTERVAL: Duration = Duration::from_millis(100);

/// Width of the bar in characters.
const BAR_WIDTH_CHARS: u128 = 20;

/// Escape sequence that erases the current line.
const ERASE_LINE: &str = "\r\x1b[K";

/// Animated progress bar. Dropping it erases the line.
pub(crate) struct Progress {
    shown: Option<(Sender<String>, JoinHandle<()>)>,
}

impl Progress {
    /// Starts the bar. It stays invisible under `--quiet` and if standard error is not a terminal.
    pub(crate) fn start(quiet: bool, model: &Path) -> Self {
        if quiet || !std::io::stderr().is_terminal() {
            return Self { shown: None };
        }
        let name = model.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let (sender, steps) = mpsc::channel();
        let thread = std::thread::spawn(move || {
            let started = Instant::now();
            let mut step = String::new();
            let mut visible = false;
            loop {
                match steps.recv_timeout(if visible { TICK_INTERVAL } else { SHOW_DELAY }) {
                    Ok(next) => step = next,
                    Err(RecvTimeoutError::Disconnected) => break,
                    Err(RecvTimeoutError::Timeout) => {}
                }
                if started.elapsed() >= SHOW_DELAY {
                    visible = true;
                    show(&picture(started.elapsed(), &step, &name));
                }
            }
            if visible {
                show(ERASE_LINE);
            }
        });
        Self { shown: Some((sender, thread)) }
    }

    /// Shows the name of the current step.
    pub(crate) fn step(&self, name: impl Into<String>) {
        if let Some((sender, _)) = &self.shown {
            // Work continues without the bar.
            let _ = sender.send(name.into());
        }
    }
}

impl Progress {
    /// Prints a line on standard error above the bar. A closed pipe is not an error.
    pub(crate) fn print_line(&self, line: &str) {
        show(&if self.shown.is_some() { format!("{ERASE_LINE}{line}\n") } else { format!("{line}\n") });
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some((sender, thread)) = self.shown.take() {
            drop(sender);
            let _ = thread.join();
        }
    }
}

fn show(text: &str) {
    let mut stderr = std::io::stderr().lock();
    let _ = stderr.write_all(text.as_bytes()).and_then(|()| stderr.flush());
}

/// Text of the bar: a moving block, the current step, and the elapsed time.
fn picture(elapsed: Duration, step: &str, name: &str) -> String {
    let turn = (elapsed.as_millis() / TICK_INTERVAL.as_millis()) % (2 * BAR_WIDTH_CHARS);
    let place = if turn < BAR_WIDTH_CHARS { turn } else { 2 * BAR_WIDTH_CHARS - 1 - turn };
    let bar: String = (0..BAR_WIDTH_CHARS).map(|i| if i.abs_diff(place) <= 1 { '=' } else { ' ' }).collect();
    format!("{ERASE_LINE}[{bar}] {step} {name}, {:.1} s", elapsed.as_secs_f64())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn progress_block_stays_within_the_bar() {
        for tick in 0..100 {
            let text = picture(TICK_INTERVAL * tick, "drawing", "bunny.obj");
            let bar = text.split_once('[').and_then(|_| text.rsplit_once('[')).map(|(_, rest)| rest);
            let inside = bar.and_then(|bar| bar.split_once(']')).map(|(inside, _)| inside.to_owned());
            let inside = inside.unwrap_or_default();
            assert_eq!(inside.len() as u128, BAR_WIDTH_CHARS);
            assert!((2..=3).contains(&inside.matches('=').count()), "{inside}");
        }
        let text = picture(Duration::from_millis(700), "drawing", "bunny.obj");
        assert!(text.ends_with("] drawing bunny.obj, 0.7 s"), "{text}");
    }
}
