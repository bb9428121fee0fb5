//! The style of a figure: its sheet, and changes to it.

use std::path::PathBuf;

use toml::Spanned;

use crate::error::Error;
use crate::error::nearest::{nearest, suggestion};
use crate::page::page_source::PageSource;
use crate::style::{Style, placed_change, unitless_length_warning};

/// Loads a style by name or file, relative to the page file, and applies changes (`KEY=VALUE` each).
///
/// # Errors
/// Returns an error if there is no such style, or a change is invalid.
pub(crate) fn style(
    name: &Spanned<String>,
    sets: &[Spanned<String>],
    source: &PageSource,
) -> Result<Style, Error> {
    let known: Vec<&str> = Style::names().collect();
    let sheet = match style_file(name, source) {
        None => name.get_ref().clone(),
        Some(_) if !name.get_ref().ends_with(".toml") => {
            let advice = suggestion(nearest(name.get_ref(), &known), || {
                format!("built-in styles: {}; or name a sheet's file, such as my.toml", known.join(", "))
            });
            let message = format!("there is no style `{}`", name.get_ref());
            return Err(source.fault(&name.span(), &message, &advice));
        }
        Some(_) => source.existing(name, "style sheet")?.to_string_lossy().into_owned(),
    };
    let mut changes = Vec::new();
    for set in sets {
        let change = placed_change(set.get_ref(), source.folder());
        changes.push(change.map_err(|error| source.about(&set.span(), without_place(error)))?);
    }
    Style::load_with(&sheet, &changes).map_err(|error| source.about(&name.span(), error))
}

/// The warning about lengths without a unit in the page file or its own sheets; the default unit of a page is
/// mm.
#[must_use]
pub(crate) fn unit_warning(
    name: &Spanned<String>,
    sets: &[Spanned<String>],
    source: &PageSource,
) -> Option<String> {
    let sheet = style_file(name, source)
        .map_or_else(|| name.get_ref().clone(), |path| path.to_string_lossy().into_owned());
    let sets: Vec<String> = sets.iter().map(|set| set.get_ref().clone()).collect();
    unitless_length_warning(&sheet, &sets)
}

/// The error without its position in another text.
fn without_place(mut error: Error) -> Error {
    error.place = None;
    error.remedy = error.remedy.map(|remedy| remedy.lines().next().unwrap_or_default().to_owned());
    error
}

/// The file of a style, unless it is built in.
#[must_use]
pub(crate) fn style_file(name: &Spanned<String>, source: &PageSource) -> Option<PathBuf> {
    Style::sheet_text(name.get_ref()).is_none().then(|| source.resolve(name.get_ref()))
}
