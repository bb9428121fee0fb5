//! The pipeline: from a scene and a camera to a drawing and a report.
//!
//! 1. The scene is prepared once for a style: mesh, creases and smooth patches ([`Renderer`]; `prepare`).
//! 2. For each view, feature lines are found and their visibility is decided (`view`).
//! 3. Surfaces are filled and hatched (`fills`) while visible lines are linked into chains (`lines`).
//! 4. Chains get their strokes, and all layers are put together (`compose`).
//!
//! Files, in reading order: `prepare`; `view`; `lines`; `fills`; `compose`; `report`; `progress`; `stages` pictures of
//! intermediate results; `rest` positions on the resting model; `section` styles for cut models; `cache`
//! results shared by views; `steps` constructors of intermediate results; `thread_pool`.
//!
//! ```
//! use ligne::pipeline::Renderer;
//! use ligne::drawing::Page;
//! use ligne::scene::NamedView;
//! use ligne::{Camera, Scene, Style};
//!
//! let scene = Scene::open("examples/models/gear.obj")?;
//! let style = Style::default();
//! let renderer = Renderer::new(&scene, &style);
//! for view in [NamedView::Front, NamedView::Top] {
//!     let camera = Camera::named(view, scene.up).fit(&scene);
//!     let (drawing, report) = renderer.draw(&camera, Page::px(camera.width, camera.height))?;
//!     assert!(report.counts.chains > 0 && !drawing.layers.is_empty());
//! }
//! # Ok::<(), ligne::Error>(())
//! ```

mod cache;
mod compose;
mod fills;
mod lines;
mod prepare;
mod progress;
pub(crate) mod report;
mod rest;
mod section;
mod stages;
mod steps;
mod thread_pool;
mod tolerances;
mod view;

pub use compose::hotspots::hotspots;
pub(crate) use compose::map_files::MapFiles;
pub use prepare::prepared_scene::Renderer;
pub(crate) use prepare::rigged_scene::PosedRenderer;
pub use progress::Step;
pub(crate) use report::drawing_report::Stopwatch;
pub use report::drawing_report::{Counts, Report, StagesMs};
pub use section::section_style::with_cut_hatching;
pub(crate) use section::section_style::{with_cut_hatching_for, with_trail_lines};
pub(crate) use stages::stage::Stage;
// Types of the public interface that other areas define.
pub use crate::chains::Chain;
pub use crate::lines::{FeatureLines, FeatureSegment, LineKind, Surface};
pub use crate::mesh::{MaterialId, Mesh, PartId};
pub use crate::regions::{Region, RegionBorder, Regions, SurfaceLabel};
pub use crate::view::View;
pub use crate::visibility::{ViewEdge, ViewMap, ViewVertex, ViewVertexId, ViewVertexKind};

use std::borrow::Cow;

use crate::drawing::{Drawing, Page};
use crate::error::Error;
use crate::scene::{Camera, Scene};
use crate::style::Style;

/// Draws a scene on a page in px with the size of the camera's frame.
///
/// ```no_run
/// use ligne::{Camera, Scene, Style, SvgOptions, render};
///
/// let scene = Scene::open("gear.obj")?;
/// let camera = Camera::three_quarter().fit(&scene);
/// let drawing = render(&scene, &camera, &Style::load("ink")?)?;
/// drawing.warnings.iter().for_each(|warning| eprintln!("{warning}"));
/// println!("{}", drawing.to_svg(&SvgOptions::default()));
/// # Ok::<(), ligne::Error>(())
/// ```
///
/// # Errors
/// If the camera is invalid: see [`Camera::validate`].
pub fn render(scene: &Scene, camera: &Camera, style: &Style) -> Result<Drawing, Error> {
    render_on(Page::px(camera.width, camera.height), scene, camera, style)
}

/// Draws a scene on a page with the camera's frame in its centre. The page gets the background of the style.
///
/// ```
/// use ligne::drawing::Page;
/// use ligne::{Camera, Scene, Style, pipeline};
///
/// let scene = Scene::open("examples/models/gear.obj")?;
/// let camera = Camera::three_quarter().with_frame(128.0, 85.0).fit(&scene);
/// let drawing = pipeline::render_on(Page::mm(148.0, 105.0), &scene, &camera, &Style::load("technical")?)?;
/// # assert!(drawing.to_svg(&Default::default()).contains("width=\"148mm\""));
/// # Ok::<(), ligne::Error>(())
/// ```
///
/// # Errors
/// If the camera is invalid: see [`Camera::validate`].
pub fn render_on(page: Page, scene: &Scene, camera: &Camera, style: &Style) -> Result<Drawing, Error> {
    let page = Page { background: style.background, ..page };
    let renderer = Renderer::for_camera(Cow::Borrowed(scene), style, camera, page.unit);
    renderer.draw(camera, page).map(|(drawing, _)| drawing)
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
            let page = Page::px(10.0, 10.0);
            assert!(render(&scene, &camera, &style).is_err());
            assert!(Renderer::new(&scene, &style).draw(&camera, page).is_err());
        }
    }
}
