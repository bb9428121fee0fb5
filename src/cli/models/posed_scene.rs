//! Scene at one moment of its animation.

use super::clip_blend::ClipBlend;
use crate::animation::{Clip, Rigged};
use crate::cli::request::draw_request::DrawRequest;
use crate::error::Error;
use crate::motion;
use crate::scene::Scene;
use crate::style::Style;

/// Poses the scene at the time of a request and adds motion lines. Also returns notes on the choice of clips.
/// Without a clip and a time the scene stays as stored.
///
/// # Errors
/// If no clip has the requested name, or if a pose is not finite.
pub(crate) fn scene_at(
    rigged: Rigged,
    request: &DrawRequest,
    style: &Style,
) -> Result<(Scene, Vec<String>), Error> {
    if request.is_at_rest() {
        return Ok((rigged.scene, Vec::new()));
    }
    let in_file = |error: Error| match &rigged.scene.file {
        Some(file) => error.or_in_file(file),
        None => error,
    };
    let (clips, time) = (&rigged.rig.clips, request.how.time.unwrap_or(0.0));
    let blend = ClipBlend::new(clips, &request.how.animation, request.how.repeat).map_err(in_file)?;
    let playing = blend.playing(time);
    let mut scene = motion::posed(&rigged, &playing, &style.motion, style.seed).map_err(in_file)?;
    if let Some(reason) = motion::no_lines_reason(&rigged, &playing, &style.motion, &scene) {
        scene.warnings.note(reason);
    }
    for Clip { name, .. } in playing
        .iter()
        .filter_map(|own| clips.get(own.clip))
        .filter(|clip| !(blend.repeats() || has(clip, time)))
    {
        scene.warnings.note(format!("the animation `{name}` ends before {time} s; its last pose is drawn"));
    }
    Ok((scene, blend.notes().to_vec()))
}

/// Whether a time lies within a clip. Always true for clips of zero length, and for time 0.
fn has(clip: &Clip, time: f64) -> bool {
    let [from, to] = clip.span();
    (from..=to).contains(&time) || from == to || time == 0.0
}
