//! What was typed after `ligne draw` of several models and views, and of drawing again.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::cli::output::is_stdout;
use crate::cli::shard::Share;
use crate::error::Error;
use crate::load::ModelFormat;

/// Several models and views, and drawing again: docs/many.md.
#[derive(Debug, Args)]
pub(in crate::cli) struct ManyArgs {
    /// Draw all models that are named into this folder: DIR/NAME.svg, or DIR/NAME-VIEW.svg for each of several views
    #[arg(long, value_name = "DIR", help_heading = "Many", conflicts_with = "outputs")]
    pub(in crate::cli) out_dir: Option<PathBuf>,

    /// Which drawings are written: svg, png, pdf or several [default: svg]; for a model on standard input what it is:
    /// obj, gltf, glb, stl or ply
    #[arg(long, value_name = "NAME,...", value_delimiter = ',', help_heading = "Many", value_parser = Named::parse)]
    format: Vec<Named>,

    /// Keep the folders that models are named with: DIR/a/m.svg for a/m.obj
    #[arg(long, help_heading = "Many", requires = "out_dir")]
    pub(super) folders: bool,

    /// Draw the Kth of every N models only, so that N computers share the work; /N: the K of a job array
    /// [env: SLURM_ARRAY_TASK_ID, JOB_COMPLETION_INDEX]
    #[arg(long, value_name = "K/N", help_heading = "Many", requires = "out_dir", value_parser = Share::parse)]
    pub(super) shard: Option<Share>,

    /// Draw only what is missing, or older than its model, style sheet or camera record
    #[arg(long, help_heading = "Many")]
    pub(super) resume: bool,

    /// Draw again whenever the model, the style sheet or the camera record changes, until stopped
    #[arg(long, help_heading = "Many")]
    pub(super) watch: bool,
}

/// A name after `--format`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Named {
    /// Of a format that drawings are written in: its ending.
    Drawing(&'static str),
    /// Of a format of models.
    Model(ModelFormat),
}

impl Named {
    fn parse(text: &str) -> Result<Self, String> {
        let drawing = ["svg", "png", "pdf", "dxf"].into_iter().find(|name| text.eq_ignore_ascii_case(name));
        drawing.map(Self::Drawing).or_else(|| ModelFormat::of_ending(text).map(Self::Model)).ok_or_else(
            || {
                "drawings are svg, png, pdf and dxf; models on standard input obj, gltf, glb, stl and ply"
                    .to_owned()
            },
        )
    }
}

impl ManyArgs {
    /// Whether it takes more than one drawing, made once.
    pub(super) const fn is_asked(&self) -> bool {
        self.out_dir.is_some() || self.resume || self.watch
    }

    /// The endings of the drawings of each model, each once.
    pub(super) fn endings(&self) -> Vec<&'static str> {
        let mut endings = Vec::new();
        for named in &self.format {
            if let Named::Drawing(ending) = named
                && !endings.contains(ending)
            {
                endings.push(*ending);
            }
        }
        endings
    }

    /// What standard input holds, where one of the models is read from there.
    ///
    /// # Errors
    /// If it is not told, if it is told twice, and if it is told of no model.
    pub(in crate::cli) fn piped<'a>(
        &self,
        models: impl IntoIterator<Item = &'a PathBuf>,
    ) -> Result<Option<ModelFormat>, Error> {
        let piped = models.into_iter().filter(|model| is_stdout(model)).count();
        let mut formats = self.format.iter().filter_map(|named| match named {
            Named::Model(format) => Some(*format),
            Named::Drawing(_) => None,
        });
        let wrong = |message: &str, remedy: &str| Err(Error::new(message).at("--format").remedy(remedy));
        match (piped, formats.next(), formats.next()) {
            (0, None, _) => Ok(None),
            (0, Some(_), _) => wrong(
                "the ending of a model tells its format",
                "name drawings here: svg, png, pdf; or write - for a model on standard input",
            ),
            (_, Some(_), Some(_)) => wrong("the format of standard input is told twice", "leave one out"),
            (1, format @ Some(_), None) => Ok(format),
            (1, None, _) => wrong(
                "it is not told what standard input holds",
                "write --format with obj, gltf, glb, stl or ply",
            ),
            _ => Err(Error::new("standard input is given twice").remedy("leave one `-` out")),
        }
    }

    /// Where drawings of one model go: as typed, or by the model's name in the current folder.
    ///
    /// # Errors
    /// If formats are told twice, and if nothing tells the name.
    pub(in crate::cli) fn paths(&self, model: &Path, typed: Vec<PathBuf>) -> Result<Vec<PathBuf>, Error> {
        let endings = self.endings();
        if !typed.is_empty() {
            return if endings.is_empty() {
                Ok(typed)
            } else {
                Err(Error::new("the name of a drawing tells its format")
                    .at("--format")
                    .remedy("leave it out, or leave the names out"))
            };
        }
        match (is_stdout(model), endings.as_slice()) {
            (true, [] | ["svg"]) => Ok(vec![PathBuf::from("-")]),
            (true, _) => Err(Error::new("standard output takes one SVG")
                .at("--format")
                .remedy("name the drawing, such as model.png")),
            (false, []) => Ok(vec![named(model, "svg")]),
            (false, endings) => Ok(endings.iter().map(|ending| named(model, ending)).collect()),
        }
    }
}

/// The model's name with another ending, without its folder.
fn named(model: &Path, ending: &str) -> PathBuf {
    let mut name = stem(model);
    name.push(".");
    name.push(ending);
    PathBuf::from(name)
}

/// The model's name without folder and ending; that of standard input is `model`.
pub(super) fn stem(model: &Path) -> std::ffi::OsString {
    if is_stdout(model) {
        return "model".into();
    }
    model.file_stem().unwrap_or(model.as_os_str()).to_owned()
}
