//! The pipeline: from a scene and a camera to a drawing and a report.
//!
//! 1. The scene is prepared once for a style: mesh, creases and smooth patches ([`Prepared`]; `prepare`).
//! 2. For each view, feature lines are found and their visibility is decided (`view`).
//! 3. Surfaces are filled and hatched (`fills`) while visible lines are linked into chains (`lines`).
//! 4. Chains get their strokes, and all layers are put together (`compose`).
//!
//! Files, in reading order: `prepare`; `view`; `lines`; `fills`; `compose`; `report`; `stages` pictures of
//! intermediate results; `rest` positions on the resting model; `section` styles for cut models; `cache`
//! results shared by views; `thread_pool`.
//!
//! ```
//! use ligne::pipeline::Prepared;
//! use ligne::drawing::{Page, Unit};
//! use ligne::scene::NamedView;
//! use ligne::{Camera, Scene, Style};
//!
//! let scene = Scene::open("examples/models/gear.obj")?;
//! let style = Style::default();
//! let prepared = Prepared::new(&scene, &style);
//! for view in [NamedView::Front, NamedView::Top] {
//!     let camera = Camera::named(view, scene.up).fit(&scene);
//!     let page = Page { width: camera.width, height: camera.height, unit: Unit::Px, background: None };
//!     let (drawing, report) = prepared.draw(&camera, page, None)?;
//!     assert!(report.counts.chains > 0 && !drawing.layers.is_empty());
//! }
//! # Ok::<(), ligne::Error>(())
//! ```

mod cache;
mod compose;
mod fills;
mod lines;
mod prepare;
pub mod report;
mod rest;
mod section;
mod stages;
mod thread_pool;
mod tolerances;
mod view;

pub use compose::hotspots::hotspots;
pub use compose::map_files::MapFiles;
pub use prepare::prepared_scene::Prepared;
pub use prepare::rigged_scene::PosedRenderer;
pub use report::drawing_report::{Report, Stopwatch};
pub use section::section_style::{with_cut_hatching, with_cut_hatching_for, with_trail_lines};
pub use stages::stage::Stage;

use crate::drawing::{Drawing, Page, Unit};
use crate::error::Error;
use crate::scene::{Camera, Scene};
use crate::style::Style;

/// Draws a scene on a page in px with the size of the camera's frame.
///
/// ```no_run
/// use ligne::{pipeline, scene::{Camera, Scene}, style::Style};
///
/// let scene = Scene::open("gear.obj")?;
/// let camera = Camera::three_quarter().fit(&scene);
/// let style = Style::preset("ink").unwrap_or_default();
/// let drawing = pipeline::render(&scene, &camera, &style)?;
/// drawing.warnings.iter().for_each(|warning| eprintln!("{warning}"));
/// println!("{}", drawing.to_svg(&ligne::export::SvgOptions::default()));
/// # Ok::<(), ligne::Error>(())
/// ```
///
/// # Errors
/// If the camera is invalid: see [`Camera::validate`].
pub fn render(scene: &Scene, camera: &Camera, style: &Style) -> Result<Drawing, Error> {
    let page =
        Page { width: camera.width, height: camera.height, unit: Unit::Px, background: style.background };
    render_reported(scene, camera, style, page, None).map(|(drawing, _)| drawing)
}

/// Draws a scene with the camera's frame centred on a page, and reports times and counts. With a stage named,
/// draws the result of that stage instead.
///
/// The report's load and write times and its path counts are left to the caller.
///
/// # Errors
/// If the camera is invalid: see [`Camera::validate`].
pub fn render_reported(
    scene: &Scene,
    camera: &Camera,
    style: &Style,
    page: Page,
    stage: Option<Stage>,
) -> Result<(Drawing, Report), Error> {
    let mut watch = Stopwatch::start();
    let prepared = Prepared::for_camera(scene, style, camera);
    let preparing = watch.lap_ms();
    let (drawing, mut report) = prepared.draw(camera, page, stage)?;
    report.stages_ms.topology += preparing;
    Ok((drawing, report))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn invalid_cameras_are_errors_in_every_render_function() {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let scene = Scene::from_triangles(corners, [[0, 1, 2]]).unwrap();
        let good = Camera::three_quarter().fit(&scene);
        let style = Style::default();
        assert!(render(&scene, &good, &style).is_ok());
        for camera in [
            Camera { eye: good.target, ..good },
            Camera { width: f64::NAN, ..good },
            Camera { up: good.target - good.eye, ..good },
        ] {
            let page = Page { width: 10.0, height: 10.0, unit: Unit::Px, background: None };
            assert!(render(&scene, &camera, &style).is_err());
            assert!(render_reported(&scene, &camera, &style, page, None).is_err());
            assert!(Prepared::new(&scene, &style).draw(&camera, page, None).is_err());
        }
    }
}
