//! `ligne styles --sheet`: one model drawn in many styles.

use std::path::{Path, PathBuf};

use super::style_grid_args::StyleSheetArgs;
use super::{ContactSheet, check_outputs, picture_request};
use crate::cli::draw::model_drawing;
use crate::cli::library_calls;
use crate::cli::models::opened_model;
use crate::cli::output::output_files::Output;
use crate::cli::output::progress::Progress;
use crate::cli::request::draw_request::{DrawRequest, check_apart};
use crate::error::Error;
use crate::geometry::names::glob::Glob;
use crate::pipeline::Stopwatch;
use crate::style::Style;

/// Number of columns.
const STYLE_COLUMN_COUNT: usize = 6;

/// Draws the model in the named styles, or in all built-in styles.
pub(crate) fn run(args: &StyleSheetArgs, out: &Path, model: &str) -> Result<(), Error> {
    let model = PathBuf::from(model);
    if args.how.page.is_some() {
        return Err(Error::new("sheets of styles are in px")
            .at("--page")
            .remedy("leave it out; --size is the size of each picture"));
    }
    let outputs = [Output::new(out.to_path_buf())?];
    check_apart(&model, &outputs, &[], None)?;
    check_outputs(&outputs)?;
    let styles = styles(&args.styles)?;
    let request = |style: &String| {
        let mut how = args.how.clone();
        how.style.clone_from(style);
        DrawRequest::of_model(model.clone(), how).map(picture_request)
    };
    let requests: Vec<DrawRequest> = styles.iter().map(request).collect::<Result<_, _>>()?;
    let Some(first) = requests.first() else { return Err(Error::new("there is no style")) };
    let mut sheet = ContactSheet::default();
    library_calls::in_threads(first.how.threads, || {
        let progress = Progress::start(first.how.quiet, &model);
        progress.step("reading");
        let read = opened_model::read(first)?;
        for (style, request) in styles.iter().zip(&requests) {
            let add = |_: &DrawRequest, drawn| {
                sheet.add(drawn, style.clone(), key(style));
                Ok(())
            };
            model_drawing::draw_model(
                Some(read.clone()),
                &[request],
                &mut Stopwatch::start(),
                &progress,
                add,
            )?;
        }
        Ok(())
    })??;
    sheet.finish(first, &outputs, STYLE_COLUMN_COUNT, "style")
}

/// Name of the layers of a style.
fn key(style: &str) -> String {
    match Style::sheet_text(style) {
        Some(_) => style.to_owned(),
        None => Path::new(style).file_stem().unwrap_or_default().to_string_lossy().into_owned(),
    }
}

/// Expands names, globs and files of styles, each alone or in a list.
///
/// # Errors
/// If a glob matches no style.
fn styles(typed: &[String]) -> Result<Vec<String>, Error> {
    if typed.is_empty() {
        return Ok(Style::names().map(str::to_owned).collect());
    }
    let mut styles: Vec<String> = Vec::new();
    let words = typed.iter().flat_map(|typed| {
        // A file name may contain commas.
        if Path::new(typed).is_file() { vec![typed.as_str()] } else { typed.split(',').collect() }
    });
    for word in words.map(str::trim).filter(|word| !word.is_empty()) {
        if Path::new(word).is_file() || !word.contains(['*', '?', '[']) {
            styles.push(word.to_owned());
            continue;
        }
        let glob = Glob::new(word);
        let before = styles.len();
        styles.extend(Style::names().filter(|name| glob.matches(name)).map(str::to_owned));
        if styles.len() == before {
            return Err(Error::new(format!("no built-in style matches `{word}`"))
                .at("--style")
                .remedy("`ligne styles` lists them"));
        }
    }
    let mut kept: Vec<String> = Vec::new();
    for style in styles {
        if !kept.contains(&style) {
            kept.push(style);
        }
    }
    Ok(kept)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn styles_accept_single_names_lists_and_globs() {
        let of = |typed: &[&str]| styles(&typed.iter().map(|&word| word.to_owned()).collect::<Vec<_>>());
        assert_eq!(of(&[]).unwrap().len(), Style::names().count());
        assert_eq!(of(&["ink, mine.toml", "ink", "to?n"]).unwrap(), ["ink", "mine.toml", "toon"]);
        assert!(of(&["nonesuch*"]).is_err());
    }
}
