//! Camera and sheet of a drawing.

use std::borrow::Cow;
use std::path::Path;

use glam::DVec3;

use crate::cli::options::values::model_unit::ModelUnit;
use crate::cli::options::values::paper_size::{PageLength, PaperSize, PictureSheet};
use crate::cli::output::number_text::plain;
use crate::cli::tolerances;
use crate::drawing::Unit;
use crate::error::Error;
use crate::geometry::numbers::portable_math::tan;
use crate::scene::cameras::camera::{DEFAULT_FOV_Y_DEG, DEFAULT_FRAME_PX};
use crate::scene::cameras::framing::FRAME_MARGIN;
use crate::scene::cameras::named_views::{THREE_QUARTER_AZIMUTH_DEG, THREE_QUARTER_ELEVATION_DEG};
use crate::scene::{Camera, NamedView, Projection, Scene};

/// Share of the frame that stays free if the page has a margin. Keeps lines at the edge of the model whole.
const INNER_MARGIN_RATIO: f64 = 0.01;

/// Maximum size of a model that counts as a dot, as a share of the shorter side of the frame.
const MAX_DOT_RATIO: f64 = 0.02;

/// Requested view of a model.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum ViewRequest {
    /// Path of a camera record, or name of a camera in the model.
    Recorded(String),
    /// Named view; orthographic unless a projection is given.
    Named(NamedView, Option<Lens>),
    /// Angles and projection. Missing values are those of the three-quarter view in perspective.
    Angles { azimuth_deg: Option<f64>, elevation_deg: Option<f64>, lens: Option<Lens> },
    /// Camera and sheet of another drawing.
    Fixed(Camera, PictureSheet),
}

/// Projection of a camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Lens {
    Perspective { fov_y_deg: f64 },
    Parallel,
}

/// Requested sheet.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct SheetRequest {
    /// Size and unit.
    pub(crate) extent: Option<(PaperSize, Unit)>,
    pub(crate) margin: Option<PageLength>,
    /// Length on paper per length of the model. Without it the model is fitted, or the scale of the camera
    /// record is kept.
    pub(crate) scale: Option<f64>,
    /// Point at the centre of the frame, world space.
    pub(crate) centre: Option<DVec3>,
    /// Unit of the model, if given.
    pub(crate) unit: Option<ModelUnit>,
}

/// Camera and sheet, with a warning if the model does not fit.
#[derive(Debug)]
pub(crate) struct Viewpoint {
    pub(crate) camera: Camera,
    pub(crate) paper: PictureSheet,
    pub(crate) warning: Option<String>,
}

/// Computes the camera and the sheet. The frame fits `points` (world space).
///
/// # Errors
/// If the camera record is wrong, if the model has no such camera, if the margin leaves no room on the page,
/// and any error of `points`.
pub(crate) fn viewpoint<'p>(
    view: &ViewRequest,
    sheet: &SheetRequest,
    scene: &Scene,
    points: impl FnOnce() -> Result<Cow<'p, [DVec3]>, Error>,
) -> Result<Viewpoint, Error> {
    let square = PaperSize { width: DEFAULT_FRAME_PX, height: DEFAULT_FRAME_PX };
    let (extent, unit) = sheet.extent.unwrap_or((square, Unit::Px));
    let (direction, lens) = match view {
        ViewRequest::Recorded(name) => return recorded(sheet, scene, name, points),
        ViewRequest::Fixed(camera, paper) => {
            return Ok(Viewpoint { camera: *camera, paper: *paper, warning: None });
        }
        ViewRequest::Named(view, lens) => (Camera::named(*view, scene.up), lens.unwrap_or(Lens::Parallel)),
        ViewRequest::Angles { azimuth_deg, elevation_deg, lens } => (
            Camera::azimuth_elevation(
                azimuth_deg.unwrap_or(THREE_QUARTER_AZIMUTH_DEG),
                elevation_deg.unwrap_or(THREE_QUARTER_ELEVATION_DEG),
                scene.up,
            ),
            lens.unwrap_or(Lens::Perspective { fov_y_deg: DEFAULT_FOV_Y_DEG }),
        ),
    };
    let paper = PictureSheet::new(extent, unit, sheet.margin)?;
    let (width, height) = paper.frame();
    let projection = match lens {
        Lens::Perspective { fov_y_deg } => Projection::Perspective { fov_y_deg },
        Lens::Parallel => Projection::Orthographic { height: 1.0 },
    };
    let margin = if paper.margin > 0.0 { INNER_MARGIN_RATIO } else { FRAME_MARGIN };
    let points = points()?;
    let aimed = direction.with_frame(width, height).with_projection(projection);
    let camera = aimed.fit_points(&points, margin);
    let mut found = Viewpoint { camera, paper, warning: None };
    if sheet.scale.is_some() || sheet.centre.is_some() {
        apply_sheet(&mut found, sheet, scene, &points)?;
    }
    Ok(found)
}

/// Viewpoint of a camera record. It keeps its frame unless a sheet is requested.
fn recorded<'p>(
    sheet: &SheetRequest,
    scene: &Scene,
    name: &str,
    points: impl FnOnce() -> Result<Cow<'p, [DVec3]>, Error>,
) -> Result<Viewpoint, Error> {
    let mut found = on_sheet(sheet, open_camera(scene, name)?)?;
    let points = points()?;
    if sheet.scale.is_some() || sheet.centre.is_some() {
        apply_sheet(&mut found, sheet, scene, &points)?;
    } else {
        found.warning = framing_warning(&found, &points);
    }
    Ok(found)
}

/// Applies the requested scale and centre to an orthographic camera.
///
/// # Errors
/// If the camera is a perspective camera.
fn apply_sheet(
    found: &mut Viewpoint,
    sheet: &SheetRequest,
    scene: &Scene,
    points: &[DVec3],
) -> Result<(), Error> {
    if !matches!(found.camera.projection, Projection::Orthographic { .. }) {
        let option = if sheet.scale.is_some() { "--scale" } else { "--centre" };
        return Err(Error::new("this option needs an orthographic view")
            .at(option)
            .remedy("give --ortho, or another camera"));
    }
    if let Some(centre) = sheet.centre {
        let [right, up, _] = found.camera.axes();
        let aside = centre - found.camera.target;
        let moved = right * aside.dot(right) + up * aside.dot(up);
        found.camera.eye += moved;
        found.camera.target += moved;
    }
    if let Some(scale) = sheet.scale {
        let unit = ModelUnit::of(scene, sheet.unit).mm();
        let height = found.camera.height * found.paper.unit.mm() / (scale * unit);
        found.camera.projection = Projection::Orthographic { height };
    }
    found.warning = framing_warning(found, points).or_else(|| too_large(found, sheet, points));
    Ok(())
}

/// Warning with the scale that would fit, if the model is larger than the page.
fn too_large(chosen_view: &Viewpoint, sheet: &SheetRequest, points: &[DVec3]) -> Option<String> {
    let scale = sheet.scale?;
    let (Projection::Orthographic { height }, Projection::Orthographic { height: needed }) =
        (chosen_view.camera.projection, chosen_view.camera.fit_points(points, 0.0).projection)
    else {
        return None;
    };
    if sheet.centre.is_some() || needed <= height * (1.0 + tolerances::FRAME_ROUNDING_OF_HEIGHT) {
        return None;
    }
    let fitting_scale = scale * height / needed;
    let scale_text = if fitting_scale < 1.0 {
        format!("1:{:.2}", 1.0 / fitting_scale)
    } else {
        format!("{fitting_scale:.2}:1")
    };
    Some(format!("the model is larger than the page at this scale; {scale_text} would fit"))
}

/// Warning if the model is outside the frame, behind the camera, or tiny.
fn framing_warning(found: &Viewpoint, points: &[DVec3]) -> Option<String> {
    let Viewpoint { camera, paper, .. } = found;
    let [right, up, forward] = camera.axes();
    let half = match camera.projection {
        Projection::Perspective { fov_y_deg } => tan(fov_y_deg.to_radians() / 2.0),
        Projection::Orthographic { height } => height / 2.0,
    };
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for p in points.iter().filter(|p| p.is_finite()) {
        let p = *p - camera.eye;
        let (depth, perspective) = match camera.projection {
            Projection::Perspective { .. } => (p.dot(forward), true),
            Projection::Orthographic { .. } => (1.0, false),
        };
        if perspective && depth <= 0.0 {
            // Parts behind the camera may extend to the front of it.
            continue;
        }
        let unit = camera.height / 2.0 / (half * depth);
        let place = DVec3::new(p.dot(right) * unit, p.dot(up) * unit, 0.0);
        (low, high) = (low.min(place), high.max(place));
    }
    if points.is_empty() {
        return None;
    }
    if low.x > high.x {
        return Some("the model is behind the camera, so the drawing is empty".to_owned());
    }
    let (width, height) = (camera.width / 2.0, camera.height / 2.0);
    if low.x > width || high.x < -width || low.y > height || high.y < -height {
        return Some("the model is outside the frame, so the drawing is empty".to_owned());
    }
    let size = high - low;
    let dot = size.x.max(size.y) < MAX_DOT_RATIO * camera.width.min(camera.height);
    dot.then(|| {
        let (width, height) = (plain(size.x, 1), plain(size.y, 1));
        format!(
            "the model covers only {width} x {height} {} of the page; give its unit with --unit",
            paper.unit.name()
        )
    })
}

/// Viewpoint of a camera that keeps its frame unless a sheet is requested.
pub(crate) fn on_sheet(sheet: &SheetRequest, camera: Camera) -> Result<Viewpoint, Error> {
    let own = (PaperSize { width: camera.width, height: camera.height }, Unit::Px);
    let (extent, unit) = sheet.extent.unwrap_or(own);
    let paper = PictureSheet::new(extent, unit, sheet.margin)?;
    let (width, height) = paper.frame();
    Ok(Viewpoint { camera: camera.with_frame(width, height), paper, warning: None })
}

fn open_camera(scene: &Scene, name: &str) -> Result<Camera, Error> {
    if let Some(named) = scene.cameras.iter().find(|camera| camera.name == name) {
        return Ok(named.camera);
    }
    let path = Path::new(name);
    let is_record = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("json"));
    if is_record || path.is_file() {
        return Camera::open(path);
    }
    let names: Vec<&str> = scene.cameras.iter().map(|camera| camera.name.as_str()).collect();
    let remedy = if names.is_empty() {
        "the model has no cameras; give a camera record, FILE.json".to_owned()
    } else {
        format!("the model's cameras are {}; or give a camera record, FILE.json", names.join(", "))
    };
    Err(Error::new(format!("there is no camera `{name}`")).at("--camera").remedy(remedy))
}
