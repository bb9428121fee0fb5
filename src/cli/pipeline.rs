//! The calls of the command line into the rest of the crate.

use super::request::SvgChoices;
use crate::drawing::{Drawing, Page};
use crate::error::Error;
use crate::math::colour::Colour;
use crate::render::{Report, Stage};
use crate::scene::{Camera, Scene, Warnings};

/// Stands in for `crate::style::Style` until the rooms are joined.
pub(super) struct Style {
    background: Option<Colour>,
}

/// The style by that name or in that file, changed by `sets` (`KEY=VALUE` each) and with the
/// background that was asked for.
pub(super) fn load_style(
    name_or_path: &str,
    sets: &[String],
    background: Option<Option<Colour>>,
) -> Result<Style, Error> {
    let _ = (name_or_path, sets);
    Ok(Style { background: background.unwrap_or(Some(Colour::WHITE)) })
}

/// Names of the built-in styles.
pub(super) fn style_names() -> Vec<&'static str> {
    Vec::new()
}

/// Text of a built-in style's sheet.
pub(super) fn sheet_text(_name: &str) -> Option<&'static str> {
    None
}

/// Colour of the style's paper.
pub(super) fn background(style: &Style) -> Option<Colour> {
    style.background
}

/// Leaves only the parts whose names match `only` (all, where it is empty) and none of `hide`.
pub(super) fn keep_parts(_scene: &mut Scene, _only: &[String], _hide: &[String]) -> Result<(), Error> {
    Ok(())
}

/// What cleaning the mesh of a scene finds wrong with it.
pub(super) fn mesh_warnings(_scene: &Scene) -> Warnings {
    Warnings::default()
}

/// The drawing, or what one stage made of it. The frame of the camera lies in the middle of the
/// page.
pub(super) fn render(
    _scene: &Scene,
    _camera: &Camera,
    _style: &Style,
    page: Page,
    _stage: Option<Stage>,
) -> (Drawing, Report) {
    (Drawing { title: String::new(), page, layers: Vec::new() }, Report::default())
}

/// The drawing as SVG.
pub(super) fn svg(_drawing: &Drawing, choices: &SvgChoices) -> Vec<u8> {
    let _ = (choices.precision, choices.id_prefix.as_ref(), choices.group);
    Vec::new()
}

/// The drawing as PNG, at so many pixels to the inch.
pub(super) fn png(_drawing: &Drawing, _dpi: f64) -> Result<Vec<u8>, Error> {
    Err(Error::new("PNG is not joined yet"))
}
