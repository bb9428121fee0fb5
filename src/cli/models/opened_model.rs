//! Model of a request: read, posed, reduced to its parts, simplified, cut and exploded.

use std::borrow::Cow;
use std::io::Read;

use glam::DVec3;

use super::lod;
use super::posed_scene::scene_at;
use crate::animation::Rigged;
use crate::cli::library_calls;
use crate::cli::options::framing_args::FramedParts;
use crate::cli::request::draw_request::DrawRequest;
use crate::cli::request::usage_warnings;
use crate::cli::request::viewpoint::viewpoint;
use crate::cli::step::{open_rigged, open_scene};
use crate::error::Error;
use crate::load::ModelFormat;
use crate::pipeline::{with_cut_hatching_for, with_trail_lines};
use crate::scene::cameras::framing::world_points;
use crate::scene::{Camera, Scene};
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
    let coarse =
        request.how.faces.map(|faces| (lod::detail(&request.model, &mut rigged.scene, faces), faces));
    let (mut scene, notes) = scene_at(rigged, request, style)?;
    let warnings = usage_warnings::unmatched_patterns(&scene, &request.how.only, &request.how.hide);
    let parts_left_out = !(request.how.only.is_empty() && request.how.hide.is_empty());
    let framed =
        (request.how.framing.frame == FramedParts::All && parts_left_out).then(|| world_points(&scene));
    library_calls::keep_parts(&mut scene, &request.how.only, &request.how.hide)?;
    let scene = match coarse {
        Some((detail, faces)) => lod::reduced(&scene, &detail, faces)?,
        None => scene,
    };
    Ok(OpenedModel { scene, framed, warnings, notes })
}

/// Cuts and explodes a model as requested, before views of it are drawn. Returns whether it was exploded.
///
/// The section plane and its hatching depend on the views of the uncut model. `framed` are the points that must
/// fit into the frame: the remaining parts (none), or the whole model under `--frame all`.
pub(crate) fn cut_and_explode(
    requests: &[&DrawRequest],
    scene: &mut Scene,
    framed: &mut Option<Vec<DVec3>>,
    style: &mut Style,
) -> Result<bool, Error> {
    let Some(request) = requests.first() else { return Ok(false) };
    let section = &request.how.section;
    if section.section.is_some() {
        let uncut_points = framed.take().unwrap_or_else(|| world_points(scene));
        let viewpoint_of = |request: &&DrawRequest| {
            viewpoint(&request.view, &request.sheet, scene, || Ok(Cow::Borrowed(&*uncut_points)))
        };
        let cameras = requests.iter().map(viewpoint_of).map(|eye| Ok(eye?.camera));
        let cameras: Vec<Camera> = cameras.collect::<Result<_, Error>>()?;
        let forward = cameras.first().map_or(DVec3::NEG_Z, |camera| camera.axes()[2]);
        if let Some(mut section) = section.cut(scene, request.sheet.unit, forward)? {
            *style = with_cut_hatching_for(style, scene, &mut section.faces, &cameras);
        }
        *framed = (request.how.framing.frame == FramedParts::All).then_some(uncut_points);
    }
    let is_exploded = section.explode(scene)?;
    if is_exploded {
        *framed = None;
        *style = with_trail_lines(style);
    }
    Ok(is_exploded)
}

/// Reads the model, with its animations if the request needs them.
pub(crate) fn read(request: &DrawRequest) -> Result<Rigged, Error> {
    match (request.piped, request.is_at_rest()) {
        (Some(format), stands) => read_piped(format, stands).map_err(|error| error.in_file(&request.model)),
        (None, true) => open_scene(&request.model, &request.how.step).map(Rigged::from),
        (None, false) => open_rigged(&request.model, &request.how.step),
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
