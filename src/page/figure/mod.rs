//! A figure: models placed in a scene, seen by a camera, drawn in a style; and where its parts are on the page.
//!
//! Vocabularies hold [`models::Models`], an [`aim::Aim`] and a [`look`] under keys of their own, and make of them, in this
//! order: [`look::style`], [`models::staged`], [`aim::camera`], [`draw`], and [`places::places`].

pub mod aim;
pub mod colours;
pub mod cover;
pub mod look;
pub mod models;
mod moved;
pub mod places;

pub use aim::{Aim, AimKeys, Crop, camera};
pub use cover::Cover;
pub use look::style;
pub use models::{ModelKeys, Models, staged};
pub use places::{Place, is_named, places};

use crate::drawing::{Drawing, Page};
use crate::error::Error;
use crate::render::render_reported;
use crate::scene::{Camera, Scene};
use crate::style::Style;

/// Draws a scene on a page with the camera's frame in its middle; with what there is to say of it.
///
/// # Errors
/// If the camera can take no picture.
pub fn draw(
    scene: &Scene,
    camera: &Camera,
    style: &Style,
    page: Page,
) -> Result<(Drawing, Vec<String>), Error> {
    let (drawing, report) = render_reported(scene, camera, style, page, None)?;
    let mut warnings = scene.warnings.lines();
    warnings.extend(report.warnings.into_iter().filter(|warning| !scene.warnings.lines().contains(warning)));
    Ok((drawing, warnings))
}
