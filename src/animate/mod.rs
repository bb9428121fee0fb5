//! Frames: a scene drawn repeatedly while clips play or the camera moves.
//!
//! 1. A [`Timeline`] lists the frames and their times; a [`Turntable`] moves the camera round the model.
//! 2. The scene is prepared once at rest and posed for each frame ([`Animator`]).
//! 3. Strokes that appear or disappear fade over several frames ([`fade`]).
//!
//! Files, in reading order: [`timeline`]; [`turntable`]; [`film_extent`] points that the frame must hold;
//! [`detail_level`] scenes with fewer faces; [`face_budget`] faces per frame in real time; [`stroke_fade`].
//!
//! ```
//! use ligne::animate::{Animator, FrameSpec, Timeline};
//! use ligne::drawing::Page;
//! use ligne::animation::{Playing, Rigged};
//! use ligne::{Camera, Style};
//!
//! let crane = Rigged::open("examples/models/crane.glb")?;
//! let [from, to] = crane.clips()[0].span();
//! let timeline = Timeline::between(from, to, 2.0)?;
//! let camera = Camera::three_quarter().with_frame(300.0, 300.0).fit(&crane.scene);
//! let page = Page::px(300.0, 300.0);
//! let style = Style::default();
//! let mut animator = Animator::new(&crane, &style);
//! for frame in timeline.drawn_frames() {
//!     let playing = vec![Playing::all(0, timeline.time(frame))];
//!     let drawing = animator.step(&FrameSpec { playing, camera, page })?;
//!     assert!(!drawing.layers.is_empty());
//! }
//! # Ok::<(), ligne::Error>(())
//! ```

mod detail_level;
mod face_budget;
mod film_extent;
mod stroke_fade;
mod timeline;
mod tolerances;
mod turntable;

use std::sync::OnceLock;

pub use crate::motion::FadeBy;
pub use detail_level::DetailLevel;
pub use face_budget::Budget;
pub use film_extent::film_points;
pub use stroke_fade::{StrokeTrace, fade};
pub use timeline::Timeline;
pub use turntable::Turntable;

use crate::animation::{Playing, Rigged};
use crate::drawing::{Drawing, Page};
use crate::error::Error;
use crate::motion;
use crate::pipeline::{PosedRenderer, Report, Stopwatch};
use crate::scene::{Camera, Scene};
use crate::style::Style;

/// Number and distance in seconds of the earlier moments that can influence the creases of a pose.
const MAX_CREASE_STEPS: u32 = 24;
const CREASE_STEP_S: f64 = 1.0 / 24.0;

/// Content of a frame.
#[derive(Debug, Clone, PartialEq)]
pub struct FrameSpec {
    /// Clips that play, with their times. Empty for the stored pose.
    pub playing: Vec<Playing>,
    /// Camera.
    pub camera: Camera,
    /// Page. The camera's frame is centred on it.
    pub page: Page,
}

/// Draws one moment after another.
///
/// The drawing of a moment depends only on that moment. Moments can be drawn alone, in any order and on
/// several threads.
#[derive(Debug)]
pub struct Animator<'a> {
    rigged: &'a Rigged,
    /// Level of detail, if it has fewer faces than the model.
    level: Option<&'a DetailLevel<'a>>,
    style: &'a Style,
    /// Preparation that all moments share.
    resting: OnceLock<PosedRenderer<'a>>,
    shown: Option<Drawing>,
}

impl<'a> Animator<'a> {
    /// An animator for a rigged scene in a style.
    #[must_use]
    pub fn new(rigged: &'a Rigged, style: &'a Style) -> Self {
        Self { rigged, level: None, style, resting: OnceLock::new(), shown: None }
    }

    /// The same, with the faces of a level of its scene.
    #[must_use]
    pub fn at_level(rigged: &'a Rigged, level: &'a DetailLevel<'a>, style: &'a Style) -> Self {
        Self { level: Some(level), ..Self::new(rigged, style) }
    }

    /// The same, with the shared preparation done now instead of in the first drawing.
    ///
    /// Call it before moments are drawn in parallel on a thread pool. Otherwise a thread that prepares there
    /// could wait for another one that waits for it.
    #[must_use]
    pub fn ready(self) -> Self {
        self.resting();
        self
    }

    /// The resting scene that is drawn, including parts that are hidden at rest but shown at some time.
    #[must_use]
    pub fn rest(&self) -> &'a Scene {
        self.level.map_or(&self.rigged.scene, |level| &level.rest)
    }

    fn resting(&self) -> &PosedRenderer<'a> {
        self.resting.get_or_init(|| PosedRenderer::new(self.rest(), self.style))
    }

    /// Poses the scene, draws it, and lends the drawing until the next step.
    ///
    /// # Errors
    /// As [`Animator::draw`].
    pub fn step(&mut self, moment: &FrameSpec) -> Result<&Drawing, Error> {
        let (drawing, _) = self.draw(moment)?;
        Ok(self.shown.insert(drawing))
    }

    /// The poses before a moment, latest first.
    fn before<'b>(&'b self, playing: &'b [Playing]) -> impl Iterator<Item = Scene> + use<'b, 'a> {
        (1..=MAX_CREASE_STEPS).map_while(move |steps| {
            let scene =
                self.rigged.posed(&motion::earlier(playing, f64::from(steps) * CREASE_STEP_S)).ok()?;
            match self.level {
                Some(level) => level.posed(&scene).ok(),
                None => Some(scene),
            }
        })
    }

    /// The drawing of a moment, and its report.
    ///
    /// # Errors
    /// If a clip is not in the model, if a pose is not finite, or if the camera is invalid.
    pub fn draw(&self, moment: &FrameSpec) -> Result<(Drawing, Report), Error> {
        let FrameSpec { playing, camera, page } = moment;
        let mut watch = Stopwatch::start();
        let resting = self.resting();
        if playing.is_empty() && !self.rigged.hides() {
            return resting.still().draw(camera, *page);
        }
        watch.lap_ms();
        let scene = motion::posed(self.rigged, playing, &self.style.motion, self.style.seed)?;
        let scene = match self.level {
            Some(level) => level.posed(&scene)?,
            None => scene,
        };
        let pose = watch.lap_ms();
        let prepared = resting.posed_after(&scene, || self.before(playing));
        let preparing = watch.lap_ms();
        let (drawing, mut report) = prepared.draw(camera, *page)?;
        report.stages_ms.pose = pose;
        report.stages_ms.topology += preparing;
        Ok((drawing, report))
    }
}
