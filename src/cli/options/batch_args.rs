//! Options of `ligne draw` for several models, several views, and watching.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::cli::options::values::shard::ShardSpec;
use crate::cli::output::output_files::is_stdout;
use crate::error::Error;
use crate::load::ModelFormat;

/// Options for several models, several views, and watching.
#[derive(Debug, Args)]
pub(crate) struct BatchArgs {
    /// Draw all models into this folder: DIR/NAME.svg, or DIR/NAME-VIEW.svg with several views
    #[arg(long, value_name = "DIR", help_heading = "Batch", conflicts_with = "outputs")]
    pub(crate) out_dir: Option<PathBuf>,

    /// Formats of the drawings: svg, png, pdf, dxf [default: svg]
    #[arg(long, value_name = "NAME,...", value_delimiter = ',', help_heading = "Batch", value_parser = FormatName::parse)]
    format: Vec<FormatName>,

    /// Format of a model on standard input: obj, gltf, glb, stl, ply
    #[arg(long, value_name = "NAME", help_heading = "Batch", value_parser = model_format)]
    input_format: Option<ModelFormat>,

    /// Keep the models' folders: DIR/a/m.svg for a/m.obj
    #[arg(long, help_heading = "Batch", requires = "out_dir")]
    pub(crate) folders: bool,

    /// Draw share K of N of the models, or share K of a job array with /N [env: SLURM_ARRAY_TASK_ID, JOB_COMPLETION_INDEX]
    #[arg(long, value_name = "K/N", help_heading = "Batch", requires = "out_dir", value_parser = ShardSpec::parse)]
    pub(crate) shard: Option<ShardSpec>,

    /// Skip drawings that are newer than their model, style sheet and camera record
    #[arg(long, help_heading = "Batch")]
    pub(crate) resume: bool,

    /// Draw again after each change of the model, style sheet or camera record
    #[arg(long, help_heading = "Batch")]
    pub(crate) watch: bool,
}

/// A name after `--format`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum FormatName {
    /// Ending of a drawing format.
    Drawing(&'static str),
    /// Model format, an older spelling of `--input-format`.
    Model(ModelFormat),
}

impl FormatName {
    fn parse(text: &str) -> Result<Self, String> {
        let drawing = ["svg", "png", "pdf", "dxf"].into_iter().find(|name| text.eq_ignore_ascii_case(name));
        let named = drawing.map(Self::Drawing).or_else(|| ModelFormat::of_ending(text).map(Self::Model));
        named.ok_or_else(|| "write svg, png, pdf or dxf".to_owned())
    }
}

/// Reads the name of a model format.
fn model_format(text: &str) -> Result<ModelFormat, String> {
    ModelFormat::of_ending(text).ok_or_else(|| "write obj, gltf, glb, stl or ply".to_owned())
}

impl BatchArgs {
    /// Whether these options need batch drawing.
    pub(crate) const fn is_asked(&self) -> bool {
        self.out_dir.is_some() || self.resume || self.watch
    }

    /// Endings of the drawings of each model, without duplicates.
    pub(crate) fn endings(&self) -> Vec<&'static str> {
        let mut endings = Vec::new();
        for named in &self.format {
            if let FormatName::Drawing(ending) = named
                && !endings.contains(ending)
            {
                endings.push(*ending);
            }
        }
        endings
    }

    /// Format of the model on standard input; none if no model is read from there.
    ///
    /// # Errors
    /// If the format is missing or given twice, or if it is given and no model is read from standard input.
    pub(crate) fn piped<'a>(
        &self,
        models: impl IntoIterator<Item = &'a PathBuf>,
    ) -> Result<Option<ModelFormat>, Error> {
        let piped = models.into_iter().filter(|model| is_stdout(model)).count();
        let older = self.format.iter().filter_map(|named| match named {
            FormatName::Model(format) => Some(*format),
            FormatName::Drawing(_) => None,
        });
        let mut formats = self.input_format.into_iter().chain(older);
        let wrong =
            |message: &str, remedy: &str| Err(Error::new(message).at("--input-format").remedy(remedy));
        match (piped, formats.next(), formats.next()) {
            (0, None, _) => Ok(None),
            (0, Some(_), _) => wrong(
                "no model is read from standard input",
                "leave the option out, or write - for the model; for drawings use --format svg,png",
            ),
            (_, Some(_), Some(_)) => wrong("standard input has two formats", "leave one out"),
            (1, format @ Some(_), None) => Ok(format),
            (1, None, _) => wrong(
                "the format of standard input is missing",
                "give --input-format with obj, gltf, glb, stl or ply",
            ),
            _ => Err(Error::new("two models are read from standard input").remedy("leave one `-` out")),
        }
    }

    /// Output paths of the drawings of one model: as typed, or named after the model in the working folder.
    ///
    /// # Errors
    /// If both paths and formats are given, or if standard output would receive a format other than SVG.
    pub(crate) fn paths(&self, model: &Path, typed: Vec<PathBuf>) -> Result<Vec<PathBuf>, Error> {
        let endings = self.endings();
        if !typed.is_empty() {
            return if endings.is_empty() {
                Ok(typed)
            } else {
                Err(Error::new("the names of the drawings already give their formats")
                    .at("--format")
                    .remedy("leave out --format or the names"))
            };
        }
        match (is_stdout(model), endings.as_slice()) {
            (true, [] | ["svg"]) => Ok(vec![PathBuf::from("-")]),
            (true, _) => Err(Error::new("standard output can hold a single SVG only")
                .at("--format")
                .remedy("name the drawing, such as model.png")),
            (false, _) => Ok(self.names(model)),
        }
    }

    /// Names of the drawings of one model: its name with each ending, or with `.svg`.
    pub(crate) fn names(&self, model: &Path) -> Vec<PathBuf> {
        let endings = self.endings();
        let endings = if endings.is_empty() { vec!["svg"] } else { endings };
        let named = |ending: &str| {
            let mut name = stem(model);
            name.push(".");
            name.push(ending);
            PathBuf::from(name)
        };
        endings.into_iter().map(named).collect()
    }
}

/// Name of the model without folder and ending; `model` for standard input.
fn stem(model: &Path) -> std::ffi::OsString {
    if is_stdout(model) {
        return "model".into();
    }
    model.file_stem().unwrap_or(model.as_os_str()).to_owned()
}
