//! Additions to drawings for web pages: title, description, hotspots, and the text colour.

use crate::cli::library_calls;
use crate::cli::request::draw_request::DrawRequest;
use crate::drawing::Drawing;
use crate::error::Error;
use crate::export::SvgOptions;
use crate::pipeline;
use crate::scene::{Camera, Scene};
use crate::strokes::Ink;
use crate::style::Style;

/// Adds title and hotspots to a drawing. Returns a warning if there is nothing to add. Hotspots need the
/// scene.
pub(crate) fn complete(
    request: &DrawRequest,
    drawing: &mut Drawing,
    scene: Option<&Scene>,
    camera: &Camera,
    style: &Style,
) -> Result<Option<&'static str>, Error> {
    if let Some(title) = &request.web.title {
        drawing.title.clone_from(title);
    }
    if let Some(scene) = scene.filter(|_| request.web.hotspots) {
        let page = drawing.page;
        drawing.hotspots = pipeline::hotspots(scene, camera, page, style)?;
    }
    let bare = request.web.hotspots && drawing.hotspots.is_empty();
    Ok(bare.then_some("no named part is visible, so there are no hotspots"))
}

/// Options of the SVG exporter.
pub(crate) fn svg_options(request: &DrawRequest, style: &Style) -> Result<SvgOptions, Error> {
    let mut options = library_calls::svg_options(&request.how);
    if request.web.title.is_some() || request.web.desc.is_some() {
        options = options.read_aloud(request.web.desc.as_deref().unwrap_or_default());
    }
    if request.web.uses_current_colour() {
        let Ink::Fixed(ink) = style.stroke.pen.colour else {
            return Err(Error::new("the style's pen has no fixed colour")
                .at("--current-colour")
                .remedy("give it one: --set pen.colour=black"));
        };
        options = options.with_current_ink(ink);
    }
    Ok(options)
}
