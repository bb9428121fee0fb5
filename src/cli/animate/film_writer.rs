//! [`FilmFile`]: one film file that receives frames in order.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use super::destination::FilmFormat;
use super::ffmpeg_video::Video;
use crate::cli::library_calls;
use crate::cli::options::draw_args::HowArgs;
use crate::cli::output::output_files::Staging;
use crate::drawing::Drawing;
use crate::error::Error;
use crate::export::Pixels;
use crate::export::film::{ApngFilm, GifFilm, SvgFilm, WebpFilm};

/// Film that is being written to a staged file.
pub(crate) struct FilmFile {
    writer: FilmWriter,
    /// The staged file, which is renamed when the film is finished.
    staging: Staging,
    file: Option<File>,
}

enum FilmWriter {
    Svg(Box<SvgFilm>),
    Gif(Box<GifFilm<BufWriter<File>>>),
    Apng(Box<ApngFilm<BufWriter<File>>>),
    Webp(WebpFilm),
    Video(Video),
}

/// Frame in the form that the film format needs.
pub(crate) enum FilmFrame {
    Vector(Box<Drawing>),
    Pixels(Pixels),
}

impl FilmFormat {
    /// Whether the film stores vector drawings instead of pixels.
    pub(crate) const fn is_vector(self) -> bool {
        matches!(self, Self::Svg)
    }
}

impl FilmFile {
    /// Begins a film of `frames` frames.
    ///
    /// # Errors
    /// If the file cannot be written, or if ffmpeg is needed and missing.
    pub(crate) fn new(
        path: &Path,
        format: FilmFormat,
        fps: f64,
        frames: usize,
        how: &HowArgs,
    ) -> Result<Self, Error> {
        let mut staging = Staging::default();
        if let FilmFormat::Mp4 | FilmFormat::Webm = format {
            // Fails before any frame is drawn if ffmpeg is missing.
            Video::new(path, format, fps)?;
        }
        let file = staging.create(path)?;
        let copy = || file.try_clone().map(BufWriter::new).map_err(|error| Error::io("cannot write", error));
        let writer = match format {
            FilmFormat::Svg => FilmWriter::Svg(Box::new(SvgFilm::new(fps, &library_calls::svg_options(how)))),
            FilmFormat::Gif => FilmWriter::Gif(Box::new(GifFilm::new(copy()?, fps))),
            FilmFormat::Apng => FilmWriter::Apng(Box::new(ApngFilm::new(copy()?, fps, frames as u32))),
            FilmFormat::Webp => FilmWriter::Webp(WebpFilm::new(fps)),
            FilmFormat::Mp4 | FilmFormat::Webm => {
                FilmWriter::Video(Video::new(staging.last().unwrap_or(path), format, fps)?)
            }
        };
        Ok(Self { writer, staging, file: Some(file) })
    }

    /// Adds a frame that is shown for a number of ticks.
    ///
    /// # Errors
    /// If the frame cannot be written.
    pub(crate) fn push(&mut self, frame: &FilmFrame, ticks: u32) -> Result<(), Error> {
        match (&mut self.writer, frame) {
            (FilmWriter::Svg(film), FilmFrame::Vector(drawing)) => film.push(drawing, ticks),
            (FilmWriter::Gif(film), FilmFrame::Pixels(pixels)) => film.push(pixels, ticks)?,
            (FilmWriter::Apng(film), FilmFrame::Pixels(pixels)) => film.push(pixels, ticks)?,
            (FilmWriter::Webp(film), FilmFrame::Pixels(pixels)) => film.push(pixels, ticks)?,
            (FilmWriter::Video(film), FilmFrame::Pixels(pixels)) => film.push(pixels, ticks)?,
            (FilmWriter::Svg(_), FilmFrame::Pixels(_)) | (_, FilmFrame::Vector(_)) => {
                return Err(Error::new("a frame has another format than the film"));
            }
        }
        Ok(())
    }

    /// Number of frames that are dropped because the format limits the frame rate.
    pub(crate) fn left_out(&self) -> u64 {
        if let FilmWriter::Gif(film) = &self.writer { film.left_out() } else { 0 }
    }

    /// Finishes the film and renames it to its path. Returns the number of bytes.
    ///
    /// # Errors
    /// If the film cannot be written.
    pub(crate) fn finish(self) -> Result<u64, Error> {
        let Self { writer, staging, mut file } = self;
        let mut write = |bytes: &[u8]| match &mut file {
            Some(file) => file.write_all(bytes).map_err(|error| Error::io("cannot write", error)),
            None => Ok(()),
        };
        match writer {
            FilmWriter::Svg(film) => write(film.finish().as_bytes())?,
            FilmWriter::Webp(film) => write(&film.finish()?)?,
            FilmWriter::Gif(film) => {
                let mut out = film.finish()?;
                out.flush().map_err(|error| Error::io("cannot write", error))?;
            }
            FilmWriter::Apng(film) => film.finish()?,
            FilmWriter::Video(mut film) => film.end()?,
        }
        let length =
            staging.last().and_then(|path| std::fs::metadata(path).ok()).map_or(0, |data| data.len());
        staging.commit()?;
        Ok(length)
    }
}
