//! [`Destination`]: where frames go, each to a file of its own or all to one.

use std::path::{Path, PathBuf};

use crate::cli::output::{Format, Output, is_stdout};
use crate::error::Error;

/// Endings of numbered files and of films.
const NUMBERED: &str = "frames/%04d.svg, .png or .pdf";
const FILMS: &str = ".svg, .gif, .png, .webp, .mp4 or .webm";

/// Where frames go.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Destination {
    /// A file for each.
    Numbered(Numbered),
    /// One file of this kind.
    Film(PathBuf, FilmFormat),
}

/// One file of all frames.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FilmFormat {
    Svg,
    Gif,
    Apng,
    Webp,
    /// By ffmpeg: H.264 in MP4.
    Mp4,
    /// By ffmpeg: VP9 in WebM.
    Webm,
}

/// Files with numbers in their names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Numbered {
    /// The folder they are in; empty for the working folder.
    pub(super) folder: PathBuf,
    before: String,
    digits: usize,
    after: String,
    pub(super) format: Format,
}

impl Destination {
    /// Tells it by the name.
    pub(super) fn of(path: &Path) -> Result<Self, Error> {
        if is_stdout(path) {
            return Err(Error::new("frames are not written to standard output")
                .remedy("name a file, such as film.svg"));
        }
        let wrong = |message: String| {
            Error::new(message).in_file(path).remedy(format!(
                "end the name with {FILMS} for one film, or write {NUMBERED} for a file a frame"
            ))
        };
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
        if folder.to_string_lossy().contains('%') {
            return Err(wrong(
                "the number of a frame belongs into the name of the file, not of its folder".to_owned(),
            ));
        }
        if name.contains('%') {
            let number = number_in(&name)
                .ok_or_else(|| wrong(format!("`{name}` does not tell where the number of a frame stands")))?;
            let [before, digits, after] = number;
            let format = Output::new(PathBuf::from(&name))?.format;
            let digits = digits.parse().unwrap_or(0);
            return Ok(Self::Numbered(Numbered { folder, before, digits, after, format }));
        }
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
        let format = match ending.as_deref() {
            Some("svg") => FilmFormat::Svg,
            Some("gif") => FilmFormat::Gif,
            Some("png" | "apng") => FilmFormat::Apng,
            Some("webp") => FilmFormat::Webp,
            Some("mp4") => FilmFormat::Mp4,
            Some("webm") => FilmFormat::Webm,
            Some("pdf") => return Err(wrong("a PDF does not move".to_owned())),
            Some(other) => return Err(wrong(format!("films are not written as .{other}"))),
            None => return Err(wrong("the name of the film does not tell its format".to_owned())),
        };
        Ok(Self::Film(path.to_path_buf(), format))
    }
}

impl Numbered {
    /// The file of a frame.
    pub(super) fn path(&self, frame: usize) -> PathBuf {
        let Self { before, digits, after, .. } = self;
        self.folder.join(format!("{before}{frame:0digits$}{after}"))
    }
}

/// What stands before `%04d` (or `%d`) in a name, how many digits it asks for, and what stands behind it; `%%` is a percent sign.
fn number_in(name: &str) -> Option<[String; 3]> {
    let mut parts = [String::new(), String::new()];
    let mut digits = None;
    let mut rest = name;
    while let Some((before, after)) = rest.split_once('%') {
        let part = parts.get_mut(usize::from(digits.is_some()))?;
        part.push_str(before);
        if let Some(after) = after.strip_prefix('%') {
            part.push('%');
            rest = after;
            continue;
        }
        let (own, after) = after.split_once('d')?;
        let padded = own.strip_prefix('0').is_some_and(|width| matches!(width.parse(), Ok(1..=9_u8)));
        if digits.is_some() || !(own.is_empty() || padded) {
            return None;
        }
        digits = Some(own.trim_start_matches('0').to_owned());
        rest = after;
    }
    let [before, mut after] = parts;
    after.push_str(rest);
    Some([before, digits?, after])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stand_where_they_are_told_to() -> Result<(), Error> {
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
    fn names_that_tell_nothing_are_refused() {
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
