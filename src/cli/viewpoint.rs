//! The camera and the sheet that are meant for a scene.

use std::path::Path;

use glam::DVec3;

use super::paper::{Extent, Measure, Paper};
use crate::drawing::Unit;
use crate::error::Error;
use crate::scene::camera::{DEFAULT_FOV_Y_DEG, DEFAULT_FRAME_PX};
use crate::scene::framing::{MARGIN, world_points};
use crate::scene::views::{THREE_QUARTER_AZIMUTH_DEG, THREE_QUARTER_ELEVATION_DEG};
use crate::scene::{Camera, NamedView, Projection, Scene};

/// Share of the frame left free where the page has a margin of its own: keeps lines on the rim of
/// the model whole.
const MARGIN_WITHIN_MARGIN: f64 = 0.01;

/// From where the model is seen.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum View {
    /// A camera record, or a camera of the model, by name.
    Recorded(String),
    /// A named view; orthographic unless told otherwise.
    Named(NamedView, Option<Lens>),
    /// Angles, each as in the three-quarter view unless told otherwise; perspective likewise.
    Angles { azimuth_deg: Option<f64>, elevation_deg: Option<f64>, lens: Option<Lens> },
    /// As another drawing was seen, whatever is in the frame.
    Fixed(Camera, Paper),
}

/// How lines of sight run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Lens {
    Perspective {
        fov_y_deg: f64,
    },
    /// With the length on paper of one unit of length, or as large as fits.
    Orthographic {
        scale: Option<f64>,
    },
}

/// The sheet that is asked for.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sheet {
    /// Its size and unit.
    pub(super) extent: Option<(Extent, Unit)>,
    pub(super) margin: Option<Measure>,
}

/// The camera, the sheet, and a warning where the one does not fit the other.
#[derive(Debug)]
pub(super) struct Viewpoint {
    pub(super) camera: Camera,
    pub(super) paper: Paper,
    pub(super) warning: Option<String>,
}

/// Chooses the camera and the sheet.
///
/// # Errors
/// Where the camera record is wrong, where the model has no such camera, and where the margin
/// leaves nothing of the page.
pub(super) fn viewpoint(view: &View, sheet: &Sheet, scene: &Scene) -> Result<Viewpoint, Error> {
    viewpoint_on(view, sheet, scene, || Ok(world_points(scene)))
}

/// Chooses the camera and the sheet as [`viewpoint`] does, where the frame is to hold `points` (world).
///
/// # Errors
/// As [`viewpoint`], and what the points say.
pub(super) fn viewpoint_on(
    view: &View,
    sheet: &Sheet,
    scene: &Scene,
    points: impl FnOnce() -> Result<Vec<DVec3>, Error>,
) -> Result<Viewpoint, Error> {
    let square = Extent { width: DEFAULT_FRAME_PX, height: DEFAULT_FRAME_PX };
    let (extent, unit) = sheet.extent.unwrap_or((square, Unit::Px));
    let (direction, lens) = match view {
        View::Recorded(name) => return recorded(sheet, scene, name),
        View::Fixed(camera, paper) => return Ok(Viewpoint { camera: *camera, paper: *paper, warning: None }),
        View::Named(view, lens) => {
            (Camera::named(*view, scene.up), lens.unwrap_or(Lens::Orthographic { scale: None }))
        }
        View::Angles { azimuth_deg, elevation_deg, lens } => (
            Camera::azimuth_elevation(
                azimuth_deg.unwrap_or(THREE_QUARTER_AZIMUTH_DEG),
                elevation_deg.unwrap_or(THREE_QUARTER_ELEVATION_DEG),
                scene.up,
            ),
            lens.unwrap_or(Lens::Perspective { fov_y_deg: DEFAULT_FOV_Y_DEG }),
        ),
    };
    let paper = Paper::new(extent, unit, sheet.margin)?;
    let (width, height) = paper.frame();
    let projection = match lens {
        Lens::Perspective { fov_y_deg } => Projection::Perspective { fov_y_deg },
        Lens::Orthographic { .. } => Projection::Orthographic { height: 1.0 },
    };
    let margin = if paper.margin > 0.0 { MARGIN_WITHIN_MARGIN } else { MARGIN };
    let points = points()?;
    let aimed = direction.with_frame(width, height).with_projection(projection);
    let camera = aimed.fit_points(&points, margin);
    let mut found = Viewpoint { camera, paper, warning: None };
    if let Lens::Orthographic { scale: Some(scale) } = lens {
        to_scale(&mut found, scale, scene, aimed.fit_points(&points, 0.0).projection);
    }
    Ok(found)
}

/// Gives the camera the height that makes a millimetre of the model `scale` mm on paper; `largest`
/// is the projection that just holds the model.
fn to_scale(view: &mut Viewpoint, scale: f64, scene: &Scene, largest: Projection) {
    let height = view.camera.height * view.paper.mm_per_unit() / (scale * model_mm(scene));
    view.camera.projection = Projection::Orthographic { height };
    if let Projection::Orthographic { height: needed } = largest
        && needed > height * (1.0 + 1e-9)
    {
        let fits = scale * height / needed;
        let fits = if fits < 1.0 { format!("1:{:.2}", 1.0 / fits) } else { format!("{fits:.2}:1") };
        view.warning = Some(format!("the model is larger than the page at this scale; {fits} would fit"));
    }
}

/// Millimetres in a unit of the model: glTF demands metres, the other formats leave it open, and
/// CAD programs write millimetres.
fn model_mm(scene: &Scene) -> f64 {
    if scene.format == "glTF" { 1000.0 } else { 1.0 }
}

/// A camera of a file: it keeps its own frame unless a sheet is asked for.
fn recorded(sheet: &Sheet, scene: &Scene, name: &str) -> Result<Viewpoint, Error> {
    on_sheet(sheet, open_camera(scene, name)?)
}

/// A camera that keeps its own frame unless a sheet is asked for.
pub(super) fn on_sheet(sheet: &Sheet, camera: Camera) -> Result<Viewpoint, Error> {
    let own = (Extent { width: camera.width, height: camera.height }, Unit::Px);
    let (extent, unit) = sheet.extent.unwrap_or(own);
    let paper = Paper::new(extent, unit, sheet.margin)?;
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
