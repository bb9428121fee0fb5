//! [`VisibleView`]: a view with the visibility of its lines.

use crate::drawing::{Length, Unit};
use crate::error::Error;
use crate::lines::{self, FeatureLines, SharedSearches, Surface, Textures};
use crate::pipeline::fills::glass_pass::{self, BehindGlass};
use crate::pipeline::fills::surface_fills::{SurfaceColours, SurfaceFills, ToneInputs};
use crate::pipeline::fills::surface_requirements;
use crate::pipeline::lines::part_joints;
use crate::pipeline::prepare::prepared_scene::Renderer;
use crate::pipeline::progress::Step;
use crate::pipeline::report::drawing_report::{Report, Stopwatch};
use crate::pipeline::thread_pool::run_on_pool;
use crate::scene::Camera;
use crate::view::View;
use crate::visibility::{self, ViewMap};

/// View with the visibility of its lines decided.
pub(crate) struct VisibleView<'a> {
    pub surface: &'a Surface,
    pub view: &'a View,
    pub lines: &'a FeatureLines,
    /// Numbers of tone borders without a change of tone, and of omitted joints, ascending.
    pub unchanged: Vec<u32>,
    /// Set if lines or surfaces use colours.
    pub textures: Option<&'a Textures>,
    /// Set if surfaces are painted or hatched.
    pub fills: Option<&'a SurfaceFills<'a>>,
    pub map: ViewMap,
    /// Lines and surfaces visible through transparent materials.
    pub behind: Option<BehindGlass<'a>>,
    pub report: Report,
    pub watch: Stopwatch,
    pub warnings: Vec<String>,
}

impl Renderer<'_> {
    /// Decides the visibility of the lines of a view and calls `call` with the result.
    ///
    /// # Errors
    /// If the camera is invalid, if the progress function cancels, or if `call` fails.
    pub(crate) fn with_visibility<T: Send>(
        &self,
        camera: &Camera,
        unit: Unit,
        call: impl FnOnce(VisibleView) -> Result<T, Error> + Send,
    ) -> Result<T, Error> {
        camera.validate()?;
        run_on_pool(|| self.decided(camera, unit, call))
    }

    fn decided<T>(
        &self,
        camera: &Camera,
        unit: Unit,
        call: impl FnOnce(VisibleView) -> Result<T, Error>,
    ) -> Result<T, Error> {
        self.begin(Step::Lines)?;
        let Self { scene, style, line_options: sought, paints, .. } = self;
        let mut report = Report::default();
        let mut watch = Stopwatch::start();
        [report.counts.vertices, report.counts.edges] = self.counts;

        let refined = self.surface.refined_for(camera, style.chain.refinement_tolerance(unit));
        let surface = refined.as_ref().map_or(&self.surface, |finer| &finer.surface);
        // Refined triangles belong to this view only.
        let paint = || {
            let whole = self.paintable.as_ref().filter(|_| refined.is_some())?;
            Some(whole.finer(surface, paints.as_deref()?))
        };
        let search = || {
            refined.as_ref().and_then(|finer| self.search.share_with_finer_view(&self.surface, finer, sought))
        };
        let look = || crate::parallel::join(|| View::new(&surface.mesh, camera), paint);
        let (finer, (view, own)) = crate::parallel::join(search, look);
        let paintable = own.as_ref().or(self.paintable.as_ref());
        report.stages_ms.topology = watch.lap_ms();

        let panes = glass_pass::GlassPanes::of(surface, scene, style);
        // Through glass more is visible.
        let is_clear = panes.is_none();
        let in_sight =
            is_clear.then(|| self.search.in_sight(surface, &view, finer.as_ref(), sought)).flatten();
        let (covers, in_sight) = in_sight.unzip();
        let mut known = if surface.refined {
            SharedSearches { intersections: finer.as_ref(), ..SharedSearches::default() }
        } else {
            let normals = paintable.map(ToneInputs::normals);
            self.search.share_with_next_view(surface, sought, normals, in_sight.is_none())
        };
        known.intersections = known.intersections.or(in_sight.as_ref());
        let mut lines = lines::extract_with(surface, known, &view, sought);
        // Parts on both sides of a joint stay separate regions.
        let has_regions = self.paintable.is_some();
        let joints = part_joints::remove_part_joints(
            scene,
            paints.as_deref(),
            &surface.mesh,
            &mut lines,
            style,
            has_regions,
        );
        let mut warnings = Vec::new();
        let px = Length::px(1.0).in_unit(unit);
        let of = |paints| Textures::new(&surface.mesh, &view, paints, px, &style.lines);
        let textures = paints.as_deref().map(of);
        let colours = paints.as_deref().zip(textures.as_ref());
        // Transparent faces cast no shadow.
        let casting = panes.as_ref().map_or(&surface.mesh, glass_pass::GlassPanes::clear);
        // Shadows on faces that this view has split are not shared.
        let late = refined.is_none().then_some(&self.shadows);
        let fills = paintable.zip(colours).map(|(paintable, (paints, textures))| {
            let colours = SurfaceColours { paints, textures };
            let fills = SurfaceFills::new(
                surface,
                (casting, late),
                paintable,
                &view,
                scene,
                colours,
                style,
                &mut warnings,
            )
            .with_tone_tree(known.tone_tree);
            let moved = self.anchors.as_ref().filter(|_| surface_requirements::has_model_fixed_marks(style));
            moved.into_iter().fold(fills, SurfaceFills::laid_at)
        });
        warnings.extend(textures.iter().flat_map(Textures::warnings).cloned());
        let inked = surface_requirements::draws_isophotes(style);
        let mut unchanged = joints;
        unchanged.extend(
            fills.as_ref().map(|fills| fills.add_tone_borders(&mut lines, inked)).unwrap_or_default(),
        );
        report.stages_ms.features = watch.lap_ms();

        self.begin(Step::Visibility)?;
        let map = visibility::build_with(&surface.mesh, &view, &lines, sought, covers.as_ref());
        report.stages_ms.visibility = watch.lap_ms();
        let behind = panes.as_ref().map(|panes| panes.decide_behind(&surface.mesh, &view, &lines, sought));
        let (view, lines, fills, textures) = (&view, &lines, fills.as_ref(), textures.as_ref());
        call(VisibleView {
            surface,
            view,
            lines,
            unchanged,
            textures,
            fills,
            map,
            behind,
            report,
            watch,
            warnings,
        })
    }
}
