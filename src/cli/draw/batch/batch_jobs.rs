//! [`BatchJob`]: the drawings of one model in a call of `ligne draw`, with their output paths.
//!
//! A call may name several models, views and file types. [`jobs`] turns its options into one job per model,
//! and refuses a call that gives two drawings the same path.

use std::collections::HashMap;
use std::path::{Component, Path, PathBuf};

use crate::cli::options::draw_args::DrawArgs;
use crate::cli::output::output_files::{Output, is_stdout};
use crate::cli::request::draw_request::{DrawRequest, check_apart, same_file};
use crate::error::Error;
use crate::scene::NamedView;

/// Drawings of one model.
#[derive(Debug)]
pub(crate) struct BatchJob {
    /// One request per view.
    pub(crate) requests: Vec<DrawRequest>,
}

impl BatchJob {
    /// Path of the model, for messages.
    pub(crate) fn model(&self) -> &Path {
        self.requests.first().map_or(Path::new(""), |request| &request.model)
    }
}

/// Models named in a call. With an output folder, all paths are models.
pub(crate) fn models(args: &DrawArgs) -> Vec<PathBuf> {
    let into_folder = args.many.out_dir.is_some();
    let others = args.out.iter().chain(&args.more).filter(|_| into_folder);
    std::iter::once(&args.model).chain(others).cloned().collect()
}

/// Drawings of all models, in the order of the call. A model that is named twice is drawn once.
///
/// # Errors
/// If options contradict each other, or if drawings of two models would have the same path.
pub(crate) fn jobs(args: &DrawArgs) -> Result<Vec<BatchJob>, Error> {
    let models = models(args);
    let piped = args.many.piped(&models)?;
    let mut jobs: Vec<BatchJob> = Vec::with_capacity(models.len());
    let mut model_of_output: HashMap<PathBuf, &Path> = HashMap::new();
    'models: for model in &models {
        let plain = match &args.many.out_dir {
            Some(folder) => in_folder(folder, model, args)?,
            None => {
                let typed = args.out.iter().chain(&args.more).chain(&args.outputs).cloned().collect();
                args.many.paths(model, typed)?
            }
        };
        if plain.iter().any(|path| is_stdout(path)) {
            return Err(Error::new("standard output can hold a single drawing only")
                .remedy("name the drawing, such as drawing.svg"));
        }
        let mut job = BatchJob { requests: Vec::new() };
        for view in views(args) {
            let outputs = plain.iter().map(|path| Output::new(with_view_name(path, view, args)));
            let outputs = outputs.collect::<Result<Vec<_>, _>>()?;
            for output in &outputs {
                match model_of_output.insert(key(&output.path), model) {
                    Some(earlier_model) if earlier_model == model || same_file(earlier_model, model) => {
                        continue 'models;
                    }
                    Some(earlier_model) => return Err(clash(output, earlier_model, model, args)),
                    None => {}
                }
            }
            check_apart(model, &outputs, &[], None)?;
            let mut how = args.how.clone();
            how.view = view.into_iter().collect();
            let request = DrawRequest::of_model(model.clone(), how)?.reading(piped);
            #[cfg(feature = "pdf")]
            let print = args.print.of_outputs(args.web.pdf_inks(), &outputs)?;
            job.requests.push(DrawRequest {
                #[cfg(feature = "pdf")]
                print,
                outputs,
                stage: args.stage,
                web: args.web.clone(),
                dxf: args.dxf,
                ..request
            });
        }
        jobs.push(job);
    }
    Ok(jobs)
}

/// Named views without duplicates. `[None]` if no view is named: then the other options set the camera.
fn views(args: &DrawArgs) -> Vec<Option<NamedView>> {
    let mut views: Vec<Option<NamedView>> = Vec::new();
    for view in &args.how.view {
        if !views.contains(&Some(*view)) {
            views.push(Some(*view));
        }
    }
    if views.is_empty() { vec![None] } else { views }
}

/// Output paths of a model in the output folder.
fn in_folder(folder: &Path, model: &Path, args: &DrawArgs) -> Result<Vec<PathBuf>, Error> {
    let mut place = folder.to_path_buf();
    if args.many.folders {
        for part in model.parent().into_iter().flat_map(Path::components) {
            match part {
                Component::Normal(name) => place.push(name),
                Component::ParentDir => {
                    return Err(Error::new("a path with .. would lie outside the output folder")
                        .in_file(model)
                        .remedy("run ligne from a folder above the model, or leave out --folders"));
                }
                _ => {}
            }
        }
    }
    Ok(args.many.names(model).into_iter().map(|name| place.join(name)).collect())
}

/// Adds the name of the view to the file name if there are several views.
fn with_view_name(path: &Path, view: Option<NamedView>, args: &DrawArgs) -> PathBuf {
    let Some(view) = view.filter(|_| args.how.view.len() > 1) else { return path.to_path_buf() };
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push(format!("-{}", view.name()));
    if let Some(ending) = path.extension() {
        name.push(".");
        name.push(ending);
    }
    path.with_file_name(name)
}

/// Key for finding equal output paths. Case is ignored on Windows and macOS, as in their file systems.
fn key(path: &Path) -> PathBuf {
    if cfg!(any(windows, target_os = "macos")) {
        return PathBuf::from(path.to_string_lossy().to_lowercase());
    }
    path.to_path_buf()
}

/// The error for two models whose drawings would have the same path.
fn clash(output: &Output, one: &Path, other: &Path, args: &DrawArgs) -> Error {
    let apart = one.parent() != other.parent() && !args.many.folders;
    let remedy = if apart {
        "give --folders, or draw them into different folders"
    } else {
        "rename one, or draw them into different folders"
    };
    Error::new(format!("the drawings of {} and {} would have the same name", one.display(), other.display()))
        .in_file(&output.path)
        .remedy(remedy)
}
