//! The moment of an animation that is drawn.

use crate::error::Error;
use crate::motion;
use crate::pose::{Clip, Playing, Rigged};
use crate::scene::Scene;
use crate::style::Style;

/// The scene at a time while clips of these names play, with equal shares, and what leaves motion lines in a style; as it is stored if
/// neither is asked for. Where the file has one clip, a time is enough.
///
/// # Errors
/// If no clip has such a name, if it is not told which one plays, and what posing says.
pub(super) fn scene_at(
    rigged: Rigged,
    names: &[String],
    time: Option<f64>,
    style: &Style,
) -> Result<Scene, Error> {
    if names.is_empty() && time.is_none() {
        return Ok(rigged.scene);
    }
    let in_file = |error: Error| match &rigged.scene.file {
        Some(file) if error.file.is_none() => error.in_file(file),
        _ => error,
    };
    let (clips, time) = (&rigged.rig.clips, time.unwrap_or(0.0));
    let playing = playing(clips, names, time).map_err(in_file)?;
    let mut scene = motion::posed(&rigged, &playing, &style.motion, style.seed).map_err(in_file)?;
    for Clip { name, .. } in
        playing.iter().filter_map(|own| clips.get(own.clip)).filter(|clip| !has(clip, time))
    {
        scene
            .warnings
            .note(format!("the animation `{name}` does not last until {time} s; it stands still there"));
    }
    Ok(scene)
}

/// The clips of these names, in equal shares, at a time.
///
/// # Errors
/// If there are no clips, if none has such a name, and if none is named of several.
pub(super) fn playing(clips: &[Clip], names: &[String], time: f64) -> Result<Vec<Playing>, Error> {
    let known = || clips.iter().map(|clip| clip.name.as_str()).collect::<Vec<_>>().join(", ");
    if clips.is_empty() {
        return Err(Error::new("it has no animations").remedy("leave out --animation and --time"));
    }
    if names.is_empty() && clips.len() > 1 {
        return Err(Error::new(format!("which of its {} animations is at {time} s?", clips.len()))
            .remedy(format!("name one with --animation: {}", known())));
    }
    if names.is_empty() {
        return Ok(vec![Playing::all(0, time)]);
    }
    let weight = 1.0 / names.len() as f64;
    let own = |name: &String| {
        let clip = clips.iter().position(|clip| clip.name == *name);
        let clip = clip.ok_or_else(|| {
            Error::new(format!("it has no animation `{name}`")).remedy(format!("it has {}", known()))
        })?;
        Ok(Playing { clip, time, weight })
    };
    names.iter().map(own).collect()
}

/// Whether a time lies within a clip, or the clip is all at one time.
fn has(clip: &Clip, time: f64) -> bool {
    let [from, to] = clip.span();
    (from..=to).contains(&time) || from == to || time == 0.0
}
