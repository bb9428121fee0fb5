//! [`FramePlan`]: pose, camera and page of each frame.

use std::borrow::Cow;
use std::path::Path;

use glam::DAffine3;
use serde_json::Value;

use super::animate_args::AnimateArgs;
use crate::animate::{FrameSpec, Timeline, Turntable, film_points};
use crate::animation::{Playing, Rigged};
use crate::cli::draw::contact_sheet::PICTURE_COUNT;
use crate::cli::json_files;
use crate::cli::models::clip_blend::ClipBlend;
use crate::cli::options::values::paper_size::PictureSheet;
use crate::cli::request::draw_request::DrawRequest;
use crate::cli::request::viewpoint::{ViewRequest, Viewpoint, on_sheet, viewpoint};
use crate::cli::tolerances::TIME_ROUNDING_S;
use crate::colour::srgb::Colour;
use crate::drawing::Page;
use crate::error::Error;
use crate::scene::Camera;

/// Pose, camera and page of each frame.
#[derive(Debug)]
pub(crate) struct FramePlan {
    pub(crate) schedule: FrameSchedule,
    eye: CameraMotion,
    paper: PictureSheet,
    pub(crate) warnings: Vec<String>,
    /// Notes on choices made for the user.
    pub(crate) notes: Vec<String>,
}

/// Timeline with everything that moves on it.
#[derive(Debug)]
pub(crate) struct FrameSchedule {
    pub(crate) timeline: Timeline,
    /// Clips that play, if any.
    clips: Option<ClipBlend>,
    turntable: Option<Turntable>,
}

/// Camera of the frames.
#[derive(Debug)]
enum CameraMotion {
    /// One camera for all frames, moved by a turntable if there is one.
    Still(Camera),
    /// Animated camera of the model, by name.
    OfModel(String),
    /// One camera per frame.
    Path(Vec<Camera>),
}

impl FramePlan {
    /// Plans the frames of an animation.
    ///
    /// # Errors
    /// If nothing moves, if a clip or a camera does not exist, or if a time is invalid.
    pub(crate) fn new(args: &AnimateArgs, request: &DrawRequest, rigged: &Rigged) -> Result<Self, Error> {
        let clips = &rigged.rig.clips;
        let moves = args.turntable.is_some() || args.path.is_some();
        let has_no_clips = clips.is_empty() && request.how.animation.is_empty();
        if has_no_clips && !moves {
            return Err(Error::new("the model has no animation")
                .in_file(&request.model)
                .remedy("give --turntable 36, or a camera path with --path FILE.json"));
        }
        let clip_blend = if moves && request.how.animation.is_empty() {
            None
        } else {
            let blend = ClipBlend::new(clips, &request.how.animation, request.how.repeat);
            Some(blend.map_err(|error| without_time(error).in_file(&request.model))?)
        };
        let notes = clip_blend.as_ref().map_or_else(Vec::new, |own| own.notes().to_vec());
        let [start_time, end_time] = clip_blend.as_ref().map_or([0.0, 0.0], ClipBlend::span);
        let cameras = args.path.as_deref().map(open_path).transpose()?;
        let from = args.from.unwrap_or(start_time);
        let frames = args.turntable.map(|steps| steps as usize).or(cameras.as_ref().map(Vec::len));
        let timeline = match frames {
            Some(frames) => Timeline::of_frames(frames, from, args.fps),
            None if args.contact.contact_sheet => moments(from, args.to.unwrap_or(end_time)),
            None => Timeline::between(from, args.to.unwrap_or(end_time), args.fps),
        };
        let timeline = timeline?.holding(usize::from(args.hold));
        let mut warnings = Vec::new();
        let last = timeline.time(timeline.frames() - 1);
        let stands_still = clip_blend.as_ref().is_some_and(|own| !own.repeats());
        if stands_still && (from < start_time - TIME_ROUNDING_S || last > end_time + TIME_ROUNDING_S) {
            warnings.push(format!(
                "the animation lasts from {start_time} s to {end_time} s; outside that time nothing moves"
            ));
        }
        let rest = rigged.posed(&[])?;
        let turntable = args.turntable.map(|steps| Turntable::round(&rest, steps as usize));
        let over = [from, timeline.time(timeline.frames())];
        let course = FrameSchedule { timeline, clips: clip_blend.map(|own| own.over(over)), turntable };
        let Viewpoint { camera, paper, warning } = match cameras.as_ref().and_then(|path| path.first()) {
            Some(first) => on_sheet(&request.sheet, *first)?,
            None => viewpoint(&request.view, &request.sheet, &rigged.scene, || {
                course.reach(rigged).map(Cow::Owned)
            })?,
        };
        warnings.extend(warning);
        let has_camera =
            |name: &str| rigged.scene.cameras.iter().any(|scene_camera| scene_camera.name == name);
        let eye = match (cameras, &request.view) {
            (Some(cameras), _) => CameraMotion::Path(cameras),
            (None, ViewRequest::Recorded(name)) if has_camera(name) => CameraMotion::OfModel(name.clone()),
            (None, _) => CameraMotion::Still(camera),
        };
        Ok(Self { schedule: course, eye, paper, warnings, notes })
    }

    /// Pose, camera and page of a frame.
    ///
    /// # Errors
    /// If a pose is not finite.
    pub(crate) fn moment(
        &self,
        rigged: &Rigged,
        frame: usize,
        background: Option<Colour>,
    ) -> Result<FrameSpec, Error> {
        let playing = self.schedule.playing(frame);
        let camera = match &self.eye {
            CameraMotion::Still(camera) => *camera,
            CameraMotion::Path(cameras) => cameras
                .get(frame)
                .copied()
                .ok_or_else(|| Error::new(format!("frame {frame} has no camera on the path")))?,
            CameraMotion::OfModel(name) => {
                let cameras = rigged.cameras(&playing)?;
                let named_camera = cameras.iter().find(|own| own.name == *name).map(|own| own.camera);
                named_camera.ok_or_else(|| Error::new(format!("there is no camera `{name}`")))?
            }
        };
        let camera = self.schedule.turntable.map_or(camera, |table| table.camera(&camera, frame));
        let (width, height) = self.paper.frame();
        let page = Page { background, ..self.paper.page() };
        Ok(FrameSpec { playing, camera: camera.with_frame(width, height), page })
    }
}

impl FrameSchedule {
    /// Drawing `by` drawings after (negative: before) the one at frame `drawn`; none outside the animation. A
    /// turntable without other animation wraps around.
    pub(crate) fn beside(&self, drawn: usize, by: isize) -> Option<usize> {
        let (hold, drawings) = (self.timeline.hold(), self.timeline.drawn_frames().count());
        let number = (drawn / hold).checked_add_signed(by).filter(|number| *number < drawings);
        let round = || {
            let number = (drawn / hold) as isize + by;
            usize::try_from(number.rem_euclid(drawings as isize)).ok()
        };
        let runs_round = self.turntable.is_some() && self.clips.is_none();
        number.or_else(|| round().filter(|_| runs_round)).map(|number| number * hold)
    }

    fn playing(&self, frame: usize) -> Vec<Playing> {
        let time = self.timeline.time(frame);
        self.clips.as_ref().map_or_else(Vec::new, |clips| clips.playing(time))
    }

    /// World points that must fit into the frame over the whole animation, turned into the view of the first
    /// camera.
    fn reach(&self, rigged: &Rigged) -> Result<Vec<glam::DVec3>, Error> {
        let moved = |frame| match self.turntable {
            Some(table) => table.turn(table.steps - frame % table.steps),
            None => DAffine3::IDENTITY,
        };
        let poses: Vec<_> =
            self.timeline.drawn_frames().map(|frame| (self.playing(frame), moved(frame))).collect();
        film_points(rigged, &poses)
    }
}

/// Timeline of a contact sheet: evenly spaced moments including both ends.
fn moments(from: f64, to: f64) -> Result<Timeline, Error> {
    if from == to {
        return Timeline::of_frames(1, from, 1.0);
    }
    // Refuses invalid times.
    Timeline::between(from, to, 1.0)?;
    Timeline::of_frames(PICTURE_COUNT, from, (PICTURE_COUNT - 1) as f64 / (to - from))
}

/// Removes `--time` from a remedy, since `ligne animate` does not accept it.
fn without_time(error: Error) -> Error {
    match error.remedy.as_deref() {
        Some("leave out --animation and --time") => error.remedy("leave out --animation"),
        _ => error,
    }
}

/// Reads the cameras of a path: a JSON list of camera records.
fn open_path(path: &Path) -> Result<Vec<Camera>, Error> {
    let remedy = "write a list of camera records: [{\"type\": \"perspective\", …}, …]";
    let Value::Array(records) = json_files::read(path, remedy)? else {
        return Err(Error::new("this is not a list").in_file(path).remedy(remedy));
    };
    if records.is_empty() {
        return Err(Error::new("the list of cameras is empty").in_file(path).remedy(remedy));
    }
    let camera = |(number, record): (usize, &Value)| {
        Camera::from_json(&record.to_string()).map_err(|error| {
            let place = error.place.as_ref().map_or(String::new(), |place| format!(", {place}"));
            error.at(format!("camera {number}{place}")).in_file(path)
        })
    };
    records.iter().enumerate().map(camera).collect()
}
