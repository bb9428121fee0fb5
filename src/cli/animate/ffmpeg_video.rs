//! [`Video`]: frames as MP4 or WebM, encoded by ffmpeg.

use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStderr, ChildStdin, Command, Stdio};
use std::thread::JoinHandle;

use super::destination::FilmFormat;
use crate::error::Error;
use crate::export::Pixels;

const FFMPEG: &str = "ffmpeg";

const FFMPEG_REMEDY: &str = "install ffmpeg, or write .webp, .gif, .png or .svg";

/// Maximum length of the end of ffmpeg's messages in an error, bytes.
const MAX_MESSAGE_BYTES: usize = 400;

/// Film encoded by ffmpeg, which starts with the first frame.
pub(crate) struct Video {
    fps: f64,
    format: FilmFormat,
    /// Path that ffmpeg writes to.
    path: PathBuf,
    running: Option<RunningFfmpeg>,
}

struct RunningFfmpeg {
    child: Child,
    frames: ChildStdin,
    words: JoinHandle<String>,
    size: [u32; 2],
}

impl Video {
    /// Prepares a film at `path`.
    ///
    /// # Errors
    /// If ffmpeg is not installed.
    pub(crate) fn new(path: &Path, format: FilmFormat, fps: f64) -> Result<Self, Error> {
        let mut asked = Command::new(FFMPEG);
        asked.arg("-version").stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
        let there = asked.status().is_ok_and(|status| status.success());
        if !there {
            return Err(Error::new("ffmpeg is not installed, and this film needs it")
                .in_file(path)
                .remedy(FFMPEG_REMEDY));
        }
        Ok(Self { fps, format, path: path.to_path_buf(), running: None })
    }

    /// Adds a frame that is shown for a number of ticks.
    ///
    /// # Errors
    /// If ffmpeg stops early, or if the size differs from the first frame.
    pub(crate) fn push(&mut self, pixels: &Pixels, ticks: u32) -> Result<(), Error> {
        if self.running.is_none() {
            self.running = Some(self.start([pixels.width, pixels.height])?);
        }
        let Some(running) = &mut self.running else { return Ok(()) };
        if running.size != [pixels.width, pixels.height] {
            return Err(Error::new("a frame has another size than the first"));
        }
        // Transparent video is not supported by all players.
        let paper = pixels.on_white();
        for _ in 0..ticks {
            if running.frames.write_all(&paper.rgba).is_err() {
                return self.end();
            }
        }
        Ok(())
    }

    /// Finishes the film.
    ///
    /// # Errors
    /// If ffmpeg cannot write it.
    pub(crate) fn end(&mut self) -> Result<(), Error> {
        let Some(RunningFfmpeg { mut child, frames, words, .. }) = self.running.take() else {
            return Err(Error::new("a film needs at least one frame"));
        };
        drop(frames);
        let status = child.wait().map_err(|error| Error::io("ffmpeg stopped unexpectedly", error))?;
        let words = words.join().unwrap_or_default();
        if status.success() {
            return Ok(());
        }
        let from = words.len().saturating_sub(MAX_MESSAGE_BYTES);
        let from = (from..=words.len()).find(|at| words.is_char_boundary(*at)).unwrap_or_default();
        let last = words.get(from..).unwrap_or_default().trim().replace('\n', "; ");
        Err(Error::new(format!("ffmpeg failed: {last}")).in_file(&self.path).remedy(FFMPEG_REMEDY))
    }

    fn start(&self, size: [u32; 2]) -> Result<RunningFfmpeg, Error> {
        let mut command = Command::new(FFMPEG);
        // One thread and no time stamps, so the same frames give the same bytes.
        command.args(["-v", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgba"]);
        command.args(["-s", &format!("{}x{}", size[0], size[1]), "-r", &format!("{}", self.fps), "-i", "-"]);
        command.args(["-threads", "1", "-fflags", "+bitexact", "-flags:v", "+bitexact"]);
        // Both codecs need even sizes.
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
            command.spawn().map_err(|error| Error::io("cannot start ffmpeg", error).remedy(FFMPEG_REMEDY))?;
        let lost = || Error::new("cannot send frames to ffmpeg").remedy(FFMPEG_REMEDY);
        let frames = child.stdin.take().ok_or_else(lost)?;
        let words = child.stderr.take().ok_or_else(lost)?;
        // Read in a separate thread, because a full pipe would block ffmpeg.
        Ok(RunningFfmpeg { child, frames, words: std::thread::spawn(move || all(words)), size })
    }
}

impl Drop for Video {
    fn drop(&mut self) {
        if let Some(mut running) = self.running.take() {
            // The film is abandoned, so failures do not matter.
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
