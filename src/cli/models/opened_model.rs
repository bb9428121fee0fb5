//! Model of a request: read, posed, reduced to its parts and simplified.

use std::io::Read;

use glam::DVec3;

use super::lod;
use super::posed_scene::scene_at;
use crate::animation::Rigged;
use crate::cli::library_calls;
use crate::cli::options::framing_args::FramedParts;
use crate::cli::request::draw_request::DrawRequest;
use crate::cli::request::usage_warnings;
use crate::cli::step::{open_rigged, open_scene};
use crate::error::Error;
use crate::load::ModelFormat;
use crate::scene::Scene;
use crate::scene::cameras::framing::world_points;
use crate::style::Style;

/// Model of a request.
pub(crate) struct OpenedModel {
    pub(crate) scene: Scene,
    /// World points that must fit into the frame; none if they are those of the scene.
    pub(crate) framed: Option<Vec<DVec3>>,
    /// Warnings about the options.
    pub(crate) warnings: Vec<String>,
    /// Notes on choices made for the user.
    pub(crate) notes: Vec<String>,
}

/// Opens the model of a request: poses it, removes parts, and limits its faces.
pub(crate) fn open(
    request: &DrawRequest,
    model: Option<Rigged>,
    style: &Style,
) -> Result<OpenedModel, Error> {
    let mut rigged = model.map_or_else(|| read(request), Ok)?;
    // Levels of detail belong to the stored model, with all parts and in its rest pose.
    let coarse = request.faces.map(|faces| (lod::detail(&request.model, &mut rigged.scene, faces), faces));
    let (mut scene, notes) = scene_at(rigged, request, style)?;
    let warnings = usage_warnings::unmatched_patterns(&scene, &request.only, &request.hide);
    let parts_left_out = !(request.only.is_empty() && request.hide.is_empty());
    let framed = (request.frame == FramedParts::All && parts_left_out).then(|| world_points(&scene));
    library_calls::keep_parts(&mut scene, &request.only, &request.hide)?;
    let scene = match coarse {
        Some((detail, faces)) => lod::reduced(&scene, &detail, faces)?,
        None => scene,
    };
    Ok(OpenedModel { scene, framed, warnings, notes })
}

/// Reads the model, with its animations if the request needs them.
pub(crate) fn read(request: &DrawRequest) -> Result<Rigged, Error> {
    match (request.piped, request.is_at_rest()) {
        (Some(format), stands) => read_piped(format, stands).map_err(|error| error.in_file(&request.model)),
        (None, true) => open_scene(&request.model, &request.step).map(Rigged::from),
        (None, false) => open_rigged(&request.model, &request.step),
    }
}

/// Reads the model from standard input.
fn read_piped(format: ModelFormat, stands: bool) -> Result<Rigged, Error> {
    let mut bytes = Vec::new();
    std::io::stdin().lock().read_to_end(&mut bytes).map_err(|error| Error::io("cannot be read", error))?;
    if stands {
        Scene::from_bytes(&bytes, format).map(Rigged::from)
    } else {
        Rigged::from_bytes(&bytes, format)
    }
}
