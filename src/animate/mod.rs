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
//! use ligne::animate::{Animator, Moment, Timeline};
//! use ligne::drawing::{Page, Unit};
//! use ligne::animation::{Playing, Rigged};
//! use ligne::{Camera, Style};
//!
//! let crane = Rigged::open("examples/models/crane.glb")?;
//! let [from, to] = crane.rig.clips[0].span();
//! let timeline = Timeline::between(from, to, 2.0)?;
//! let camera = Camera::three_quarter().with_frame(300.0, 300.0).fit(&crane.scene);
//! let page = Page { width: 300.0, height: 300.0, unit: Unit::Px, background: None };
//! let style = Style::default();
//! let mut animator = Animator::new(&crane, &style);
//! for frame in timeline.drawn() {
//!     let playing = vec![Playing::all(0, timeline.time(frame))];
//!     let drawing = animator.step(&Moment { playing, camera, page })?;
//!     assert!(!drawing.layers.is_empty());
//! }
//! # Ok::<(), ligne::Error>(())
//! ```

mod detail_level;
mod face_budget;
mod film_extent;
mod stroke_fade;
mod timeline;
mod turntable;

use std::sync::OnceLock;

pub use detail_level::Level;
pub use face_budget::Budget;
pub use film_extent::reach;
pub use stroke_fade::{Trace, fade};
pub use timeline::Timeline;
pub use turntable::Turntable;

use crate::animation::{Playing, Rigged};
use crate::drawing::{Drawing, Page};
use crate::error::Error;
use crate::motion;
use crate::pipeline::{Report, Resting, Stopwatch};
use crate::scene::{Camera, Scene};
use crate::style::Style;

/// Creases that a pose makes depend on so many moments before it at the most, so many seconds apart.
const MEMORY: u32 = 24;
const STEP: f64 = 1.0 / 24.0;

/// What a frame shows.
#[derive(Debug, Clone, PartialEq)]
pub struct Moment {
    /// The clips that play, and when; none for the stored pose.
    pub playing: Vec<Playing>,
    /// From where it is seen.
    pub camera: Camera,
    /// What it is drawn on; the camera's frame is in its middle.
    pub page: Page,
}

/// Draws one moment after another.
///
/// A moment's drawing depends on nothing but the moment: any may be drawn alone, in any order, by any number of threads.
#[derive(Debug)]
pub struct Animator<'a> {
    rigged: &'a Rigged,
    /// Where it has fewer faces than the model.
    level: Option<&'a Level<'a>>,
    style: &'a Style,
    /// What all moments share.
    resting: OnceLock<Resting<'a>>,
    shown: Option<Drawing>,
}

impl<'a> Animator<'a> {
    /// Of a scene and what moves it, in a style.
    #[must_use]
    pub fn new(rigged: &'a Rigged, style: &'a Style) -> Self {
        Self { rigged, level: None, style, resting: OnceLock::new(), shown: None }
    }

    /// The same with the faces of a level of its scene.
    #[must_use]
    pub fn at_level(rigged: &'a Rigged, level: &'a Level<'a>, style: &'a Style) -> Self {
        Self { level: Some(level), ..Self::new(rigged, style) }
    }

    /// The same, with all made ready that moments share, which else the first drawing does. Whoever draws moments side by side
    /// on the threads of a pool calls it before: one that makes it there might wait for another that waits for it.
    #[must_use]
    pub fn ready(self) -> Self {
        self.resting();
        self
    }

    /// The scene at rest that is drawn, with what is hidden there and shown at some time.
    #[must_use]
    pub fn rest(&self) -> &'a Scene {
        self.level.map_or(&self.rigged.scene, |level| &level.rest)
    }

    fn resting(&self) -> &Resting<'a> {
        self.resting.get_or_init(|| Resting::new(self.rest(), self.style))
    }

    /// Poses the scene, draws it, and lends the drawing until the next step.
    ///
    /// # Errors
    /// As [`Animator::draw`].
    pub fn step(&mut self, moment: &Moment) -> Result<&Drawing, Error> {
        let (drawing, _) = self.draw(moment)?;
        Ok(self.shown.insert(drawing))
    }

    /// The poses that led to a moment, the latest first.
    fn before<'b>(&'b self, playing: &'b [Playing]) -> impl Iterator<Item = Scene> + use<'b, 'a> {
        (1..=MEMORY).map_while(move |steps| {
            let scene = self.rigged.posed(&motion::earlier(playing, f64::from(steps) * STEP)).ok()?;
            match self.level {
                Some(level) => level.posed(&scene).ok(),
                None => Some(scene),
            }
        })
    }

    /// The drawing of a moment, and what it took.
    ///
    /// # Errors
    /// If a clip is none of the model's, if a pose leads beyond all numbers, or if the camera can take no picture.
    pub fn draw(&self, moment: &Moment) -> Result<(Drawing, Report), Error> {
        let Moment { playing, camera, page } = moment;
        let mut watch = Stopwatch::start();
        let resting = self.resting();
        if playing.is_empty() && !self.rigged.hides() {
            return resting.still().draw(camera, *page, None);
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
        let (drawing, mut report) = prepared.draw(camera, *page, None)?;
        report.stages_ms.pose = pose;
        report.stages_ms.topology += preparing;
        Ok((drawing, report))
    }
}
