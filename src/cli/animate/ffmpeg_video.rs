//! [`Video`]: frames as MP4 or WebM, by ffmpeg if it is there.

use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStderr, ChildStdin, Command, Stdio};
use std::thread::JoinHandle;

use super::destination::FilmFormat;
use crate::error::Error;
use crate::export::Pixels;

const PROGRAM: &str = "ffmpeg";

const REMEDY: &str = "install ffmpeg, or write .webp, .gif, .png or .svg";

/// What ffmpeg said last, in messages.
const LAST_WORDS: usize = 400;

/// A running ffmpeg.
pub(crate) struct Video {
    fps: f64,
    format: FilmFormat,
    /// Where it writes.
    path: PathBuf,
    running: Option<Running>,
}

struct Running {
    child: Child,
    frames: ChildStdin,
    words: JoinHandle<String>,
    size: [u32; 2],
}

impl Video {
    /// A film that goes to `path`.
    ///
    /// # Errors
    /// If there is no ffmpeg.
    pub(crate) fn new(path: &Path, format: FilmFormat, fps: f64) -> Result<Self, Error> {
        let mut asked = Command::new(PROGRAM);
        asked.arg("-version").stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
        let there = asked.status().is_ok_and(|status| status.success());
        if !there {
            return Err(Error::new("ffmpeg is not installed, and this film needs it")
                .in_file(path)
                .remedy(REMEDY));
        }
        Ok(Self { fps, format, path: path.to_path_buf(), running: None })
    }

    /// Adds a frame that is shown for so many ticks.
    ///
    /// # Errors
    /// If ffmpeg ends before its time, or if the frame is of another size than the first.
    pub(crate) fn push(&mut self, pixels: &Pixels, ticks: u32) -> Result<(), Error> {
        if self.running.is_none() {
            self.running = Some(self.start([pixels.width, pixels.height])?);
        }
        let Some(running) = &mut self.running else { return Ok(()) };
        if running.size != [pixels.width, pixels.height] {
            return Err(Error::new("a frame has another size than the first"));
        }
        // Films know no clear pixels that all players show.
        let paper = pixels.on_white();
        for _ in 0..ticks {
            if running.frames.write_all(&paper.rgba).is_err() {
                return self.end();
            }
        }
        Ok(())
    }

    /// Ends the film.
    ///
    /// # Errors
    /// If ffmpeg could not write it.
    pub(crate) fn end(&mut self) -> Result<(), Error> {
        let Some(Running { mut child, frames, words, .. }) = self.running.take() else {
            return Err(Error::new("a film needs at least one frame"));
        };
        drop(frames);
        let status = child.wait().map_err(|error| Error::io("ffmpeg stopped unexpectedly", error))?;
        let words = words.join().unwrap_or_default();
        if status.success() {
            return Ok(());
        }
        let from = words.len().saturating_sub(LAST_WORDS);
        let from = (from..=words.len()).find(|at| words.is_char_boundary(*at)).unwrap_or_default();
        let last = words.get(from..).unwrap_or_default().trim().replace('\n', "; ");
        Err(Error::new(format!("ffmpeg failed: {last}")).in_file(&self.path).remedy(REMEDY))
    }

    fn start(&self, size: [u32; 2]) -> Result<Running, Error> {
        let mut command = Command::new(PROGRAM);
        // One thread and no time of day: the same frames give the same bytes.
        command.args(["-v", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgba"]);
        command.args(["-s", &format!("{}x{}", size[0], size[1]), "-r", &format!("{}", self.fps), "-i", "-"]);
        command.args(["-threads", "1", "-fflags", "+bitexact", "-flags:v", "+bitexact"]);
        // Both codecs want even sides.
        command.args(["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white,format=yuv420p"]);
        match self.format {
            FilmFormat::Webm => {
                command.args(["-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-f", "webm"]);
            }
            _ => {
                command.args(["-c:v", "libx264", "-preset", "slow", "-crf", "17", "-tune", "animation"]);
                command.args(["-movflags", "+faststart", "-f", "mp4"]);
            }
        }
        command.arg(&self.path).stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::piped());
        let mut child =
            command.spawn().map_err(|error| Error::io("cannot start ffmpeg", error).remedy(REMEDY))?;
        let lost = || Error::new("cannot send frames to ffmpeg").remedy(REMEDY);
        let frames = child.stdin.take().ok_or_else(lost)?;
        let words = child.stderr.take().ok_or_else(lost)?;
        // Read all the while: a program whose words nobody reads stands still.
        Ok(Running { child, frames, words: std::thread::spawn(move || all(words)), size })
    }
}

impl Drop for Video {
    fn drop(&mut self) {
        if let Some(mut running) = self.running.take() {
            // The film is given up; nothing is left to be told.
            let _ = running.child.kill();
            let _ = running.child.wait();
        }
    }
}

fn all(mut words: ChildStderr) -> String {
    let mut bytes = Vec::new();
    let _ = words.read_to_end(&mut bytes);
    String::from_utf8_lossy(&bytes).into_owned()
}
