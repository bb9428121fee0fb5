//! Figures of page files: models placed in a scene, seen by a camera and drawn in a style. Also finds where
//! the parts of a figure are on the page.
//!
//! Comic panels, sheets and other page types share this module. Each reads [`models::Models`], a `CameraSpec`
//! and a style from its own keys, and uses them in this order:
//!
//! 1. [`figure_style`] loads the style and applies the changes of the page file.
//! 2. [`models`] reads the models, poses them and joins them to one scene.
//! 3. [`camera_spec`] makes the camera from the keys.
//! 4. [`draw`] draws the scene.
//! 5. [`part_bounds`] finds the boxes and hulls of parts in the frame; [`coverage_grid`] the area that
//!    models cover.
//!
//! Helpers: [`part_colours`] replaces materials by colours; `scene_assembly` moves and joins scenes.

pub(crate) mod camera_spec;
pub(crate) mod coverage_grid;
pub(crate) mod figure_style;
pub(crate) mod models;
pub(crate) mod part_bounds;
pub(crate) mod part_colours;
mod scene_assembly;

pub(crate) use camera_spec::{CameraSpec, camera};
pub(crate) use coverage_grid::CoverageGrid;
pub(crate) use figure_style::style;
pub(crate) use models::{Models, assemble_scene};
pub(crate) use part_bounds::{PartExtent, find_part_bounds, name_matches};

use std::borrow::Cow;

use crate::drawing::{Drawing, Page};
use crate::error::Error;
use crate::pipeline::Renderer;
use crate::scene::{Camera, Scene};
use crate::style::Style;

/// Draws a scene on a page with the camera's frame in its centre. Also returns the warnings of the scene and
/// of the drawing.
///
/// # Errors
/// Returns an error if the camera is invalid.
pub(crate) fn draw(
    scene: &Scene,
    camera: &Camera,
    style: &Style,
    page: Page,
) -> Result<(Drawing, Vec<String>), Error> {
    let (drawing, report) =
        Renderer::for_camera(Cow::Borrowed(scene), style, camera, page.unit).draw(camera, page)?;
    let mut warnings = scene.warnings.lines();
    warnings.extend(report.warnings.into_iter().filter(|warning| !scene.warnings.lines().contains(warning)));
    Ok((drawing, warnings))
}
