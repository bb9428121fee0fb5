//! The model of a request: read, at its moment, with its parts, and with as many faces as asked for.

use std::io::Read;

use glam::DVec3;

use super::lod;
use super::posed_scene::scene_at;
use crate::animation::Rigged;
use crate::cli::library_calls;
use crate::cli::options::framing_args::Frame;
use crate::cli::request::draw_request::DrawRequest;
use crate::cli::request::usage_warnings;
use crate::cli::step::{open_rigged, open_scene};
use crate::error::Error;
use crate::load::ModelFormat;
use crate::scene::Scene;
use crate::scene::cameras::framing::world_points;
use crate::style::Style;

/// A model that was read.
pub(crate) struct Opened {
    pub(crate) scene: Scene,
    /// The points that the frame is to hold, where they are not those of the scene.
    pub(crate) framed: Option<Vec<DVec3>>,
    /// Warnings about the options.
    pub(crate) warnings: Vec<String>,
    /// Choices made for the user.
    pub(crate) notes: Vec<String>,
}

/// The model: at the moment, with the parts, and with as many faces as asked for.
pub(crate) fn open(request: &DrawRequest, model: Option<Rigged>, style: &Style) -> Result<Opened, Error> {
    let mut rigged = model.map_or_else(|| read(request), Ok)?;
    // Levels of detail belong to the stored model, with all parts and before any motion.
    let coarse = request.faces.map(|faces| (lod::detail(&request.model, &mut rigged.scene, faces), faces));
    let (mut scene, notes) = scene_at(rigged, request, style)?;
    let warnings = usage_warnings::unmatched(&scene, &request.only, &request.hide);
    let parts_left_out = !(request.only.is_empty() && request.hide.is_empty());
    let framed = (request.frame == Frame::All && parts_left_out).then(|| world_points(&scene));
    library_calls::keep_parts(&mut scene, &request.only, &request.hide)?;
    let scene = match coarse {
        Some((detail, faces)) => lod::reduced(&scene, &detail, faces)?,
        None => scene,
    };
    Ok(Opened { scene, framed, warnings, notes })
}

/// The stored model, with its animations if one of them is drawn.
pub(crate) fn read(request: &DrawRequest) -> Result<Rigged, Error> {
    match (request.piped, request.stands()) {
        (Some(format), stands) => read_piped(format, stands).map_err(|error| error.in_file(&request.model)),
        (None, true) => open_scene(&request.model, &request.step).map(Rigged::from),
        (None, false) => open_rigged(&request.model, &request.step),
    }
}

/// The model on standard input.
fn read_piped(format: ModelFormat, stands: bool) -> Result<Rigged, Error> {
    let mut bytes = Vec::new();
    std::io::stdin().lock().read_to_end(&mut bytes).map_err(|error| Error::io("cannot be read", error))?;
    if stands {
        Scene::from_bytes(&bytes, format).map(Rigged::from)
    } else {
        Rigged::from_bytes(&bytes, format)
    }
}
