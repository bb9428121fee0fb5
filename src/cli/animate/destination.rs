//! [`Destination`]: output of an animation, as numbered files, one film, or one sheet.

use std::path::{Path, PathBuf};

use crate::cli::output::numbered_files::NumberedFiles;
use crate::cli::output::output_files::{Output, is_stdout};
use crate::error::Error;

/// Names of numbered files and endings of films, for messages.
const NUMBERED_NAMES: &str = "frames/%04d.svg, .png or .pdf";
const FILM_ENDINGS: &str = ".svg, .gif, .png, .webp, .mp4 or .webm";

/// Output of an animation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Destination {
    /// One file per frame.
    Numbered(NumberedFiles),
    /// One film in this format.
    Film(PathBuf, FilmFormat),
    /// One contact sheet of a few moments.
    Sheet(Output),
}

/// Format of a film.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FilmFormat {
    Svg,
    Gif,
    Apng,
    Webp,
    /// H.264 in MP4, written by ffmpeg.
    Mp4,
    /// VP9 in WebM, written by ffmpeg.
    Webm,
}

impl Destination {
    /// Reads the destination from the file name.
    pub(crate) fn of(path: &Path) -> Result<Self, Error> {
        if is_stdout(path) {
            return Err(
                Error::new("a film cannot go to standard output").remedy("name a file, such as film.svg")
            );
        }
        let wrong = |message: String| {
            Error::new(message).in_file(path).remedy(format!(
                "end the name with {FILM_ENDINGS} for one film, or write {NUMBERED_NAMES} for one file per frame"
            ))
        };
        if let Some(numbered) = NumberedFiles::of(path, "a frame", wrong)? {
            return Ok(Self::Numbered(numbered));
        }
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
        let format = match ending.as_deref() {
            Some("svg") => FilmFormat::Svg,
            Some("gif") => FilmFormat::Gif,
            Some("png" | "apng") => FilmFormat::Apng,
            Some("webp") => FilmFormat::Webp,
            Some("mp4") => FilmFormat::Mp4,
            Some("webm") => FilmFormat::Webm,
            Some("pdf") => return Err(wrong("a PDF file cannot hold a film".to_owned())),
            Some(other) => return Err(wrong(format!("ligne cannot write films as .{other}"))),
            None => return Err(wrong("the name of the film has no format".to_owned())),
        };
        Ok(Self::Film(path.to_path_buf(), format))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbered_destination_inserts_the_frame_number() -> Result<(), Error> {
        for (name, frame, path) in [
            ("frames/%04d.svg", 7, "frames/0007.svg"),
            ("a-%d.png", 12, "a-12.png"),
            ("50%%-%03d-b.svg", 1234, "50%-1234-b.svg"),
        ] {
            let Destination::Numbered(numbered) = Destination::of(Path::new(name))? else { panic!("{name}") };
            assert_eq!(numbered.path(frame), Path::new(path));
        }
        Ok(())
    }

    #[test]
    fn destination_accepts_film_formats_and_rejects_other_names() {
        for name in [
            "-",
            "film",
            "film.pdf",
            "film.obj",
            "%s.svg",
            "%04d-%04d.svg",
            "%4d.svg",
            "%04d",
            "%d/a.svg",
            "%04d.gif",
        ] {
            assert!(Destination::of(Path::new(name)).is_err(), "{name}");
        }
        for (name, format) in
            [("a.SVG", FilmFormat::Svg), ("a.apng", FilmFormat::Apng), ("b/a.webm", FilmFormat::Webm)]
        {
            assert_eq!(Destination::of(Path::new(name)), Ok(Destination::Film(PathBuf::from(name), format)));
        }
    }
}
