//! [`Renderer`]: a scene prepared for a style, ready for drawing views.

use std::borrow::Cow;
use std::sync::Arc;

use super::prepare_mesh::PreparedMesh;
use crate::drawing::Unit;
use crate::error::{Error, ErrorKind};
use crate::lines::{LineOptions, Surface};
use crate::mesh::components::solid_parts::solid_parts;
use crate::pipeline::cache::shadow_cache::ShadowCache;
use crate::pipeline::cache::view_cache::ViewCache;
use crate::pipeline::fills::surface_fills::ToneInputs;
use crate::pipeline::fills::surface_requirements;
use crate::pipeline::progress::{ProgressFunction, Step};
use crate::pipeline::rest::chain_anchors::Anchors;
use crate::pipeline::thread_pool::run_on_pool;
use crate::scene::Paints;
use crate::scene::{Camera, Scene, Warnings};
use crate::style::Style;
use crate::surface::Patches;

/// Scene prepared for a style: everything that its views share.
///
/// See [`crate::pipeline`] for an example.
#[derive(Debug)]
pub struct Renderer<'a> {
    /// The drawn part of the scene, without areas that textures cut out.
    pub(crate) scene: Cow<'a, Scene>,
    pub(crate) warnings: Warnings,
    pub(crate) style: &'a Style,
    pub(crate) line_options: LineOptions,
    /// Paints of the scene, if surfaces are painted or hatched, or lines take their colour.
    pub(crate) paints: Option<Arc<Paints>>,
    pub(crate) surface: Surface,
    /// Numbers of vertices and edges of the model.
    pub(crate) counts: [u64; 2],
    /// Rebuilt for views that refine the surface.
    pub(crate) paintable: Option<ToneInputs>,
    pub(crate) search: ViewCache,
    pub(crate) shadows: ShadowCache,
    /// Anchors of lines on the model, if strokes have to persist.
    pub(crate) anchors: Option<Anchors>,
    /// Called at the beginning of each step.
    pub(crate) progress: ProgressFunction,
}

impl<'a> Renderer<'a> {
    /// Welds the scene into a mesh and finds its creases and rounded areas.
    #[must_use]
    pub fn new(scene: &'a Scene, style: &'a Style) -> Self {
        run_on_pool(|| Self::from_mesh(PreparedMesh::of(scene, style), style, None).0)
    }

    /// Prepares the scene for one camera and a page with the given unit. The surface is refined for it at once
    /// and permanently, which takes less memory than a refined copy next to the model. The geometry of an owned
    /// scene is freed once the mesh is built.
    #[must_use]
    pub(crate) fn for_camera(scene: Cow<'a, Scene>, style: &'a Style, camera: &Camera, unit: Unit) -> Self {
        run_on_pool(|| {
            let mesh = match scene {
                Cow::Borrowed(scene) => PreparedMesh::of(scene, style),
                Cow::Owned(scene) => PreparedMesh::of_all(scene, style),
            };
            Self::from_mesh(mesh, style, Some((camera, unit))).0
        })
    }

    /// Calls a function at the beginning of each step of a drawing. If it returns `false`, drawing ends with
    /// an error of the kind [`ErrorKind::Cancelled`](crate::ErrorKind::Cancelled).
    ///
    /// ```
    /// use ligne::drawing::Page;
    /// use ligne::pipeline::{Renderer, Step};
    /// use ligne::{Camera, ErrorKind, Scene, Style};
    ///
    /// let scene = Scene::open("examples/models/gear.obj")?;
    /// let style = Style::default();
    /// let renderer = Renderer::new(&scene, &style).with_progress(|step| step != Step::Strokes);
    /// let error = renderer.draw(&Camera::three_quarter().fit(&scene), Page::px(600.0, 600.0)).unwrap_err();
    /// assert_eq!(error.kind, ErrorKind::Cancelled);
    /// # Ok::<(), ligne::Error>(())
    /// ```
    #[must_use]
    pub fn with_progress(self, progress: impl Fn(Step) -> bool + Send + Sync + 'static) -> Self {
        Self { progress: ProgressFunction(Some(Box::new(progress))), ..self }
    }

    /// Reports that a step begins.
    ///
    /// # Errors
    /// If the progress function cancels.
    pub(crate) fn begin(&self, step: Step) -> Result<(), Error> {
        if self.progress.0.as_ref().is_none_or(|progress| progress(step)) {
            return Ok(());
        }
        Err(Error::new("the drawing was cancelled").of_kind(ErrorKind::Cancelled))
    }

    pub(crate) fn from_mesh(
        welded: PreparedMesh<'a>,
        style: &'a Style,
        only: Option<(&Camera, Unit)>,
    ) -> (Self, Option<Patches>) {
        let PreparedMesh { scene, warnings, paints, mesh } = welded;
        let sought = surface_requirements::required_lines(style);
        let (mut surface, mut patches) = Surface::with_patches(mesh, &sought);
        let counts = [surface.mesh.positions.len() as u64, surface.mesh.edges.len() as u64];
        let painted = paints.as_ref().filter(|_| surface_requirements::uses_paints(style));
        let painted = painted.map(|paints| (paints, solid_parts(&surface.mesh)));
        if let Some((camera, unit)) = only.filter(|(camera, _)| camera.validate().is_ok()) {
            patches = None;
            surface = surface.finer_for(camera, style.chain.refinement_tolerance(unit));
        }
        let paintable = painted.map(|(paints, solid)| ToneInputs::new(&surface, paints, solid));
        let prepared = Self {
            scene,
            warnings,
            style,
            line_options: sought,
            paints: paints.map(Arc::new),
            surface,
            counts,
            paintable,
            search: ViewCache::default(),
            shadows: ShadowCache::default(),
            anchors: None,
            progress: ProgressFunction::default(),
        };
        (prepared, patches)
    }
}
