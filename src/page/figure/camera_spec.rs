//! [`CameraSpec`]: the camera of a figure as the page file describes it.
//!
//! 1. A record, a named view, or azimuth and elevation give the direction.
//! 2. `fov` and `ortho` give the projection.
//! 3. The camera is fitted to the scene or to the parts of `look_at`, cropped by `crop`.
//! 4. `zoom`, `shift` and `roll` are applied.

use std::fmt;
use std::path::PathBuf;

use glam::DVec3;
use serde::de::value::MapAccessDeserializer;
use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer};
use toml::Spanned;

use super::part_bounds::{name_matches, part_points};
use crate::error::Error;
use crate::error::nearest::{nearest, suggestion};
use crate::geometry::numbers::portable_math::{atan2, cos, sin, tan};
use crate::page::page_source::PageSource;
use crate::scene::cameras::framing::{FRAME_MARGIN, world_points};
use crate::scene::cameras::named_views::{THREE_QUARTER_AZIMUTH_DEG, THREE_QUARTER_ELEVATION_DEG};
use crate::scene::{Camera, NamedView, Projection, Scene, UpAxis};

/// Share of the height that a bust shows.
const BUST_HEIGHT_SHARE: f64 = 0.42;

/// Zoom factor of a close view.
const CLOSE_ZOOM: f64 = 1.7;

/// The camera of a figure: a word or a table.
#[derive(Debug, Clone)]
pub(crate) enum CameraSpec {
    /// A named view, the file of a camera record, or a camera of the model.
    Word(String),
    /// A table of keys.
    Keys(Box<CameraKeys>),
}

impl Default for CameraSpec {
    fn default() -> Self {
        Self::Keys(Box::default())
    }
}

/// The keys of a camera.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct CameraKeys {
    /// A named view. It is orthographic unless `fov` is given.
    pub view: Option<Spanned<String>>,
    /// The file of a camera record, or a camera of the model. With `look_at` only its direction is used.
    pub record: Option<Spanned<String>>,
    /// Degrees to the right of the front. Default: 35.
    pub azimuth: Option<Spanned<f64>>,
    /// Degrees above the horizon. Default: 22.
    pub elevation: Option<Spanned<f64>>,
    /// Vertical field of view in degrees. Default: 35.
    pub fov: Option<Spanned<f64>>,
    /// Whether the projection is orthographic. Default: no, except for named views.
    pub ortho: bool,
    /// Pattern of the parts that fill the frame. Default: all parts.
    pub look_at: Option<Spanned<String>>,
    /// The section of these parts that fills the frame: `full`, `bust` or `close`. Default: full.
    pub crop: Option<FramedPart>,
    /// Zoom factor relative to a fitted view. Default: 1.
    pub zoom: Option<Spanned<f64>>,
    /// Shift of the picture to the right and down, as shares of the frame. Default: 0, 0.
    pub shift: [f64; 2],
    /// Rotation of the picture in degrees, clockwise if positive. Default: 0.
    pub roll: f64,
}

/// The section of the parts that fills the frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum FramedPart {
    /// The whole parts.
    #[default]
    Full,
    /// The upper section.
    Bust,
    /// Enlarged, so that the rim is cut off.
    Close,
}

impl<'de> Deserialize<'de> for CameraSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(CameraSpecVisitor)
    }
}

struct CameraSpecVisitor;

impl<'de> Visitor<'de> for CameraSpecVisitor {
    type Value = CameraSpec;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a camera: a named view, a camera record's file, or a table such as { azimuth = 20, look_at = \"hero\" }")
    }

    fn visit_str<E: serde::de::Error>(self, word: &str) -> Result<CameraSpec, E> {
        Ok(CameraSpec::Word(word.to_owned()))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<CameraSpec, A::Error> {
        CameraKeys::deserialize(MapAccessDeserializer::new(map)).map(|keys| CameraSpec::Keys(Box::new(keys)))
    }
}

impl CameraSpec {
    /// The file of a camera record, if one is named.
    #[must_use]
    pub(crate) fn file(&self, source: &PageSource) -> Option<PathBuf> {
        let name = match self {
            Self::Word(word) => word,
            Self::Keys(keys) => keys.record.as_ref()?.get_ref(),
        };
        name.ends_with(".json").then(|| source.resolve(name))
    }
}

/// The camera of a figure with a frame of the given size, mm.
///
/// # Errors
/// Returns an error if there is no such camera, view or part, or a number is out of range.
pub(crate) fn camera(
    aim: &Spanned<CameraSpec>,
    scene: &Scene,
    [width, height]: [f64; 2],
    source: &PageSource,
) -> Result<Camera, Error> {
    let keys = match aim.get_ref() {
        CameraSpec::Word(word) => {
            let word = Spanned::new(aim.span(), word.clone());
            if let Some(view) = NamedView::parse(word.get_ref()) {
                let camera = Camera::named(view, scene.up).with_frame(width, height);
                return Ok(camera.fit(scene));
            }
            return named_camera(&word, scene, source).map(|camera| camera.with_frame(width, height));
        }
        CameraSpec::Keys(keys) => keys,
    };
    let direction = match (&keys.record, &keys.view) {
        (Some(record), _) => named_camera(record, scene, source)?,
        (None, Some(view)) => {
            let known = NamedView::ALL.map(NamedView::name);
            let named = NamedView::parse(view.get_ref());
            Camera::named(named.ok_or_else(|| source.unknown(view, "view", &known))?, scene.up)
        }
        (None, None) => {
            let angle =
                |key: &Option<Spanned<f64>>, default| key.as_ref().map_or(default, |key| *key.get_ref());
            let azimuth = angle(&keys.azimuth, THREE_QUARTER_AZIMUTH_DEG);
            let elevation = angle(&keys.elevation, THREE_QUARTER_ELEVATION_DEG);
            let is_elevation = |angle: &f64| (-90.0..=90.0).contains(angle);
            let advice = "write degrees from -90 to 90";
            source.check(&keys.elevation, is_elevation, "this is not an elevation", advice)?;
            Camera::azimuth_elevation(azimuth, elevation, scene.up)
        }
    };
    let camera = apply_lens(direction, keys, source)?.with_frame(width, height);
    let camera = match (&keys.record, &keys.look_at) {
        (Some(_), None) => camera,
        (_, look_at) => fit_camera(camera, look_at.as_ref(), keys.crop.unwrap_or_default(), scene, source)?,
    };
    let camera = apply_zoom_shift_roll(camera, keys, source)?;
    camera.validate().map_err(|error| source.about(&aim.span(), error))?;
    Ok(camera)
}

/// A camera of the model, or one from the file of a camera record.
fn named_camera(name: &Spanned<String>, scene: &Scene, source: &PageSource) -> Result<Camera, Error> {
    if let Some(named) = scene.cameras.iter().find(|camera| camera.name == *name.get_ref()) {
        return Ok(named.camera);
    }
    if name.get_ref().ends_with(".json") {
        return Camera::open(source.existing(name, "camera record")?);
    }
    let cameras = scene.cameras.iter().map(|camera| camera.name.as_str());
    let known: Vec<&str> = cameras.chain(NamedView::ALL.map(NamedView::name)).collect();
    let advice = suggestion(nearest(name.get_ref(), &known), || {
        format!("there are {}; or name a camera record, FILE.json", known.join(", "))
    });
    Err(source.fault(&name.span(), &format!("there is no camera `{}`", name.get_ref()), &advice))
}

/// The camera with the projection that the keys request.
fn apply_lens(camera: Camera, keys: &CameraKeys, source: &PageSource) -> Result<Camera, Error> {
    let is_angle = |fov: &f64| *fov > 0.0 && *fov < 180.0;
    source.check(&keys.fov, is_angle, "this is not a field of view", "write degrees between 0 and 180")?;
    match &keys.fov {
        Some(fov) => Ok(camera.with_projection(Projection::Perspective { fov_y_deg: *fov.get_ref() })),
        None if keys.ortho => Ok(camera.with_projection(Projection::Orthographic { height: 1.0 })),
        None => Ok(camera),
    }
}

/// The camera fitted to the scene or to some parts.
fn fit_camera(
    camera: Camera,
    look_at: Option<&Spanned<String>>,
    crop: FramedPart,
    scene: &Scene,
    source: &PageSource,
) -> Result<Camera, Error> {
    let points = match look_at {
        None => world_points(scene),
        Some(glob) => {
            let points = part_points(scene, glob.get_ref());
            if points.is_empty() {
                return Err(unknown_part(glob, scene, source));
            }
            points
        }
    };
    Ok(match crop {
        FramedPart::Full => camera.fit_points(&points, FRAME_MARGIN),
        FramedPart::Bust => camera.fit_points(&upper_points(&points, scene.up), FRAME_MARGIN),
        FramedPart::Close => with_height(&camera.fit_points(&points, 0.0), |height| height / CLOSE_ZOOM),
    })
}

/// The error that no part matches a pattern; it names the nearest part or all parts.
#[must_use]
pub(crate) fn unknown_part(glob: &Spanned<String>, scene: &Scene, source: &PageSource) -> Error {
    let mut known: Vec<&str> = scene.parts.iter().map(|part| part.name.as_str()).collect();
    known.dedup();
    let near = nearest(glob.get_ref(), &known).filter(|near| !name_matches(glob.get_ref(), near));
    known.truncate(12);
    let advice = suggestion(near, || format!("the parts are {}", known.join(", ")));
    source.fault(&glob.span(), &format!("there is no part `{}`", glob.get_ref()), &advice)
}

/// The points in the upper section of their extent, the share `BUST_HEIGHT_SHARE`.
fn upper_points(points: &[DVec3], up: UpAxis) -> Vec<DVec3> {
    let height = |p: &DVec3| match up {
        UpAxis::Y => p.y,
        UpAxis::Z => p.z,
    };
    let span = points.iter().map(height);
    let low = span.clone().fold(f64::INFINITY, f64::min);
    let high = span.fold(f64::NEG_INFINITY, f64::max);
    let least = high - BUST_HEIGHT_SHARE * (high - low);
    points.iter().copied().filter(|p| height(p) >= least).collect()
}

/// The camera with the zoom, shift and roll of the keys.
fn apply_zoom_shift_roll(camera: Camera, keys: &CameraKeys, source: &PageSource) -> Result<Camera, Error> {
    let zoom = keys.zoom.as_ref().map_or(1.0, |zoom| *zoom.get_ref());
    let is_positive = |zoom: &f64| zoom.is_finite() && *zoom > 0.0;
    source.check(&keys.zoom, is_positive, "this is not a zoom factor", "write a number above 0")?;
    let mut camera = with_height(&camera, |height| height / zoom);
    let [right, up, forward] = camera.axes();
    let tall = match camera.projection {
        Projection::Perspective { fov_y_deg } => {
            2.0 * camera.eye.distance(camera.target) * tan(fov_y_deg.to_radians() / 2.0)
        }
        Projection::Orthographic { height } => height,
    };
    let [x, y] = keys.shift;
    let moved = up * (y * tall) - right * (x * tall * camera.width / camera.height);
    camera.eye += moved;
    camera.target += moved;
    if keys.roll != 0.0 {
        let turn = keys.roll.to_radians();
        let (sine, cosine) = (sin(turn), cos(turn));
        // The picture turns clockwise if the camera turns counter-clockwise.
        camera.up = up * cosine - forward.cross(up) * sine;
    }
    Ok(camera)
}

/// The camera with another height of the picture: in parallel projection, or at the distance 1.
pub(crate) fn with_height(camera: &Camera, scaled: impl Fn(f64) -> f64) -> Camera {
    camera.with_projection(match camera.projection {
        Projection::Perspective { fov_y_deg } => {
            let half = scaled(tan(fov_y_deg.to_radians() / 2.0));
            Projection::Perspective { fov_y_deg: 2.0 * atan2(half, 1.0).to_degrees() }
        }
        Projection::Orthographic { height } => Projection::Orthographic { height: scaled(height) },
    })
}
