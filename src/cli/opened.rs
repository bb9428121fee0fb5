//! The model of a request: read, at its moment, with its parts, and with as many faces as asked for.

use std::io::Read;

use glam::DVec3;

use super::framing_args::Frame;
use super::moment::scene_at;
use super::request::DrawRequest;
use super::step::{open_rigged, open_scene};
use super::{lod, pipeline, wonder};
use crate::error::Error;
use crate::load::ModelFormat;
use crate::pose::Rigged;
use crate::scene::Scene;
use crate::scene::framing::world_points;
use crate::style::Style;

/// A model that was read.
pub(super) struct Opened {
    pub(super) scene: Scene,
    /// The points that the frame is to hold, where they are not those of the scene.
    pub(super) framed: Option<Vec<DVec3>>,
    /// Warnings about the options.
    pub(super) warnings: Vec<String>,
    /// Choices made for the user.
    pub(super) notes: Vec<String>,
}

/// The model: at the moment, with the parts, and with as many faces as asked for.
pub(super) fn open(request: &DrawRequest, model: Option<Rigged>, style: &Style) -> Result<Opened, Error> {
    let mut rigged = model.map_or_else(|| read(request), Ok)?;
    // Levels of detail belong to the stored model, with all parts and before any motion.
    let coarse = request.faces.map(|faces| (lod::detail(&request.model, &mut rigged.scene, faces), faces));
    let (mut scene, notes) = scene_at(rigged, request, style)?;
    let warnings = wonder::unmatched(&scene, &request.only, &request.hide);
    let parts_left_out = !(request.only.is_empty() && request.hide.is_empty());
    let framed = (request.frame == Frame::All && parts_left_out).then(|| world_points(&scene));
    pipeline::keep_parts(&mut scene, &request.only, &request.hide)?;
    let scene = match coarse {
        Some((detail, faces)) => lod::reduced(&scene, &detail, faces)?,
        None => scene,
    };
    Ok(Opened { scene, framed, warnings, notes })
}

/// The stored model, with its animations if one of them is drawn.
pub(super) fn read(request: &DrawRequest) -> Result<Rigged, Error> {
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
