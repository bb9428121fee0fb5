//! [`TestCase`]: a case file, which describes a drawing and its tolerance.

use std::path::{Path, PathBuf};

use clap::{Args, Command, FromArgMatches};
use toml::de::DeValue;

use crate::cli::config::project_config::tolerance;
use crate::cli::config::toml_options::{OptionKeys, TomlFile, refuse_incomplete};
use crate::cli::options::draw_args::HowArgs;
use crate::cli::request::draw_request::DrawRequest;
use crate::diff::Tolerances;
use crate::error::Error;

/// Keys of a case that are not options of `ligne draw`.
const CASE_KEYS: [&str; 4] = ["model", "page-file", "drawing", "tolerance"];

/// Options that are not allowed in cases, because they do not affect the drawing.
const EXCLUDED_OPTIONS: [&str; 3] = ["threads", "quiet", "dpi"];

/// Drawing under test.
#[derive(Debug)]
pub(crate) struct TestCase {
    /// Relative path in the folder of cases, with `/` and without `.toml`.
    pub(crate) name: String,
    /// Path of the approved drawing.
    pub(crate) drawing: PathBuf,
    /// Settings of the case, or the error in its file.
    pub(crate) order: Result<CaseSettings, Error>,
}

/// Settings of a case.
#[derive(Debug)]
pub(crate) struct CaseSettings {
    pub(crate) subject: CaseSubject,
    /// Tolerances that override those of the project.
    pub(crate) tolerances: Tolerances,
}

/// Subject of a case.
#[derive(Debug)]
pub(crate) enum CaseSubject {
    /// Drawing of a model.
    Drawing(Box<DrawRequest>),
    /// The single page of this page file.
    Page(PathBuf),
}

impl TestCase {
    /// Reads a case. A file with errors gives a case that fails.
    pub(crate) fn read(name: String, path: &Path) -> Self {
        match read(path) {
            Ok((drawing, order)) => Self {
                name,
                drawing: drawing.unwrap_or_else(|| path.with_extension("svg")),
                order: Ok(order),
            },
            Err(error) => Self { name, drawing: path.with_extension("svg"), order: Err(error) },
        }
    }
}

fn read(path: &Path) -> Result<(Option<PathBuf>, CaseSettings), Error> {
    let file = TomlFile::read(path, "the case")?;
    let (table, values) = (file.table()?, file.values()?);
    let command = HowArgs::augment_args(Command::new("draw"));
    let keys = OptionKeys { command: &command, without: &EXCLUDED_OPTIONS, others: &CASE_KEYS };
    let given = keys.read(&file, &table, &values)?;
    refuse_incomplete(&file, &given)?;

    let path_of = |key: &str| match table.get(key) {
        None => Ok(None),
        Some(value) => match value.get_ref() {
            DeValue::String(path) => Ok(Some((file.folder.join(path.as_ref()), value.span()))),
            _ => Err(file.misfit(value, "a path")),
        },
    };
    let (model, page) = (path_of("model")?, path_of("page-file")?);
    if model.is_none() && page.is_none() {
        return Err(Error::new("there is no `model`")
            .in_file(path)
            .remedy("write model = \"PATH\", relative to this file; a file that is not a case needs a name that starts with _"));
    }
    if let Some((_, span)) = page.as_ref().filter(|_| model.is_some() || !given.is_empty()) {
        let advice = "with `page-file` use only `drawing` and `tolerance`";
        return Err(file.fault(span, "a page file already contains all other settings", Some(advice)));
    }
    let drawing = path_of("drawing")?;
    if let Some((drawing, span)) = &drawing
        && drawing.extension().is_none_or(|ending| ending != "svg")
    {
        let shown = drawing.display();
        return Err(file.fault(span, &format!("{shown} is not an SVG file"), Some("end the name with .svg")));
    }
    let tolerances = match table.get("tolerance") {
        Some(value) => Tolerances::parse(&tolerance(&file, value)?)?,
        None => Tolerances::default(),
    };

    let drawing = drawing.map(|(drawing, _)| drawing);
    let Some((model, _)) = model else {
        let made = CaseSubject::Page(page.map(|(page, _)| page).unwrap_or_default());
        return Ok((drawing, CaseSettings { subject: made, tolerances }));
    };
    let words = std::iter::once("draw".to_owned()).chain(given.into_iter().flat_map(|given| given.words));
    let how = command.try_get_matches_from(words).and_then(|matches| HowArgs::from_arg_matches(&matches));
    let how = how.map_err(|error| {
        let message = error.to_string();
        let first = message.lines().next().unwrap_or_default();
        Error::new(first.trim_start_matches("error: ")).in_file(path)
    })?;
    let mut request = DrawRequest::of_model(model, how).map_err(|error| error.in_file(path))?;
    request.how.quiet = true;
    Ok((drawing, CaseSettings { subject: CaseSubject::Drawing(Box::new(request)), tolerances }))
}
