//! From a view with known visibility to its drawing: fills, lines and further layers, stacked.

use std::sync::Arc;

use super::map_files::MapFiles;
use crate::colour::srgb::Colour;
use crate::drawing::{Drawing, Layer, Page, Unit};
use crate::error::Error;
use crate::hatching::{self, LayerStrokes};
use crate::pipeline::fills::fill_pass::{FillInputs, FillPass};
use crate::pipeline::fills::glass_pass::BehindGlass;
use crate::pipeline::fills::surface_fills::{self, SurfaceColours};
use crate::pipeline::fills::surface_requirements;
use crate::pipeline::fills::view_hatching;
use crate::pipeline::fills::view_hatching::Hatching;
use crate::pipeline::lines::chain_samples::{self, ChainSampler};
use crate::pipeline::lines::motion_line_pass::{self, Trails};
use crate::pipeline::lines::{chain_colours, image_line_pass, view_chains};
use crate::pipeline::prepare::prepared_scene::Renderer;
use crate::pipeline::progress::Step;
use crate::pipeline::report::drawing_report::{self, Report, Stopwatch};
use crate::pipeline::report::{empty_drawing, mesh_defects};
use crate::pipeline::stages::stage::Stage;
use crate::pipeline::stages::{self, StageInputs};
use crate::pipeline::thread_pool::run_on_pool;
use crate::pipeline::view::page_transform::{centre_on_page, frame_on_page, margin};
use crate::pipeline::view::visibility_pass::VisibleView;
use crate::regions::{self, HatchRegions, PageBorders, Regions};
use crate::scene::{Camera, Scene, Warning, WarningKind};
use crate::strokes::{self, InkContext, InkWidths, Parting};
use crate::view::View;
use crate::visibility::{GapOcclusion, ViewMap};

impl Renderer<'_> {
    /// Draws a view on a page, with the camera's frame in its centre. The report has the times of this view,
    /// without loading and writing.
    ///
    /// # Errors
    /// If the camera is invalid: see [`Camera::validate`]; or if the progress function cancels.
    pub fn draw(&self, camera: &Camera, page: Page) -> Result<(Drawing, Report), Error> {
        self.draw_stage(camera, page, None)
    }

    /// Draws a view, or with a stage named the result of that stage.
    pub(crate) fn draw_stage(
        &self,
        camera: &Camera,
        page: Page,
        stage: Option<Stage>,
    ) -> Result<(Drawing, Report), Error> {
        self.with_visibility(camera, page.unit, |on_view| self.drawn(on_view, camera, page, stage))
    }

    /// The regions of a view that the style paints, in user units of the page; none if it paints nothing.
    ///
    /// # Errors
    /// If the camera is invalid: see [`Camera::validate`]; or if the progress function cancels.
    pub fn regions(&self, camera: &Camera, page: Page) -> Result<Regions, Error> {
        self.with_visibility(camera, page.unit, |on_view| {
            let Some(fills) = on_view.fills else { return Ok(Regions::default()) };
            let seen = fills.label_page(&PageBorders::of(&on_view.map, &on_view.view.frame), &page);
            Ok(regions::gather(&seen, &self.style.region, &self.style.chain, page.unit))
        })
    }

    /// The maps of a view for finding image lines, even if the style draws none. `unit` is that of the page.
    ///
    /// # Errors
    /// If the camera is invalid: see [`Camera::validate`].
    pub(crate) fn maps(&self, camera: &Camera, unit: Unit) -> Result<MapFiles, Error> {
        camera.validate()?;
        run_on_pool(|| {
            let refined = self.surface.refined_for(camera, self.style.chain.refinement_tolerance(unit));
            let surface = refined.as_ref().map_or(&self.surface, |finer| &finer.surface);
            let view = View::new(&surface.mesh, camera);
            let maps = image_line_pass::maps(surface, &view, self.style, unit);
            MapFiles::new(&surface.mesh, &maps, &self.style.lines.image)
        })
    }

    /// The ground of a view's hatching, and the strokes of each of its layers with their identities. `None`
    /// if the style hatches nothing or the camera is invalid.
    #[must_use]
    pub(crate) fn hatch_strokes(
        &self,
        camera: &Camera,
        page: Page,
    ) -> Option<(HatchRegions, Vec<LayerStrokes>)> {
        let strokes = self.with_visibility(camera, page.unit, |on_view| {
            let VisibleView { fills, map, behind, .. } = on_view;
            let Some(fills) = fills.filter(|_| self.style.hatch.enabled) else { return Ok(None) };
            let (scene, style) = (self.scene.as_ref(), self.style);
            let hatching = Hatching { fills, scene, page: &page, camera, style };
            let see = || fills.label_page(&PageBorders::of(&map, &on_view.view.frame), &page);
            let seen = behind.map_or_else(see, |behind| behind.label_page(fills, &page));
            Ok(Some(hatching.strokes(&seen)))
        });
        strokes.ok().flatten()
    }

    /// The drawing of a view with its report; with a stage named, the result of that stage.
    pub(crate) fn drawn(
        &self,
        on_view: VisibleView,
        camera: &Camera,
        page: Page,
        stage: Option<Stage>,
    ) -> Result<(Drawing, Report), Error> {
        self.begin(Step::Fills)?;
        let Self { scene, style, paints, .. } = self;
        let VisibleView { surface, view, lines, unchanged, textures, fills, mut map, .. } = on_view;
        let VisibleView { mut behind, mut report, mut watch, mut warnings, .. } = on_view;
        let mut layers: Vec<Layer> = hatching::paper(&page, &style.paper, style.seed).into_iter().collect();
        let lit = fills.filter(|_| surface_requirements::is_lit(style));
        let borders = lit.map(|_| PageBorders::of(&map, &view.frame));
        let (mesh_and_pieces, margin) =
            ((&surface.mesh, surface.pieces.as_slice()), margin(&view.frame, &page));
        let parts: Vec<Arc<str>> = scene.parts.iter().map(|p| Arc::from(p.name.as_str())).collect();
        let materials: Vec<(Arc<str>, Colour)> =
            scene.materials.iter().map(|m| (Arc::from(m.name.as_str()), m.colour)).collect();
        let widths = InkWidths::new(&style.stroke, &parts, &materials, page.unit);
        // Painting and linking both have single-threaded parts, so they run side by side.
        let paint = || {
            let (fills, borders) = lit.zip(borders.as_ref())?;
            let (paints, behind) = (paints.as_deref(), behind.as_ref());
            let on = FillInputs { scene, style, paints, fills, surface, lines, borders, behind };
            Some(FillPass::of(&on, &page, camera))
        };
        let link = || {
            let mut watch = Stopwatch::start();
            if fills.is_some() {
                surface_fills::keep_inked(&mut map, style, &unchanged);
            }
            let lines = image_line_pass::add_image_lines(&mut map, lines, surface, view, style, page.unit);
            let joining = watch.lap_ms();
            centre_on_page(&mut map, &view.frame, &page);
            let occlusion = GapOcclusion::new(mesh_and_pieces, view, &lines, &map.visible_contours, margin);
            let of_view = (scene.as_ref(), &surface.mesh.extents, &view.frame);
            let chains = view_chains::chains(&occlusion, &map, (style, &widths), page.unit, of_view);
            (lines, chains, [joining, watch.lap_ms()])
        };
        let (painted, (lines, mut chains, [joining, linking])) = crate::parallel::join(paint, link);
        let FillPass { layers: painted, blacks, warnings: more, regions, leaks, regions_ms, hatching_ms } =
            painted.unwrap_or_default();
        layers.extend(painted);
        warnings.extend(more);
        (report.counts.regions, report.counts.leaks) = (regions, leaks);
        report.stages_ms.regions = regions_ms;
        report.stages_ms.hatching = hatching_ms;
        report.stages_ms.features += joining;
        let lines = &*lines;
        // Both have reported their own times.
        watch.lap_ms();
        if let Some(behind) = &mut behind {
            chains.extend(behind.chains(style, page.unit, |veiled| {
                surface_fills::keep_inked(veiled, style, &unchanged);
                centre_on_page(veiled, &view.frame, &page);
            }));
        }
        report.stages_ms.chains = linking + watch.lap_ms();

        let sampler = ChainSampler { scene, surface, view, style, margin, unit: page.unit };
        chain_samples::sample_chains(&mut chains, &sampler);
        let paints = paints.as_deref();
        let colours = paints.zip(textures).map(|(paints, textures)| SurfaceColours { paints, textures });
        chain_colours::sample_colours(&mut chains, &sampler, lines, colours, blacks.as_ref());
        if let Some(anchors) = &self.anchors {
            anchors.anchor_chains(&mut chains, camera, margin);
        }
        let names = chain_samples::segment_names(lines, surface, &style.stroke);
        let context = InkContext {
            unit: page.unit,
            parts: &parts,
            materials: &materials,
            hidden: style.lines.hidden,
            behind_glass: style.glass.width,
            seed: style.seed,
            painted: style.region.enabled,
            depths: view.frame.depths(),
            names: &names,
            parting: blacks.map(|_| Parting {
                colour: style.background.unwrap_or(Colour::WHITE),
                width: style.hatch.parting,
            }),
            frame: Some(frame_on_page(&view.frame, &page)),
        };
        self.begin(Step::Strokes)?;
        match stage {
            None => {
                let clear = behind.as_ref().map_or(&surface.mesh, BehindGlass::clear);
                let centre = |map: &mut ViewMap| centre_on_page(map, &view.frame, &page);
                let trails = Trails::of((clear, view, camera), scene, style, page.unit, centre);
                let before = layers.len();
                layers.extend(trails.iter().flat_map(|trails| trails.ink(&context)));
                let moves = scene.movers.as_ref().is_some_and(|movers| !movers.is_empty());
                if style.motion.enabled && moves && layers.len() == before {
                    warnings.push(motion_line_pass::NONE_SEEN.to_owned());
                }
                layers.extend(strokes::ink(&chains, &context, &style.stroke));
                layers.extend(hatching::tooth(&page, &style.paper, style.seed));
            }
            Some(stage) => {
                let stage_occlusion =
                    GapOcclusion::new(mesh_and_pieces, view, lines, &map.visible_contours, margin);
                let inputs = StageInputs {
                    surface,
                    view,
                    lines,
                    gap_occlusion: &stage_occlusion,
                    map: &map,
                    chains: &chains,
                    style,
                    page: &page,
                };
                layers = stages::draw(stage, &inputs);
            }
        }
        report.stages_ms.strokes = watch.lap_ms();

        report.counts.feature_edges = lines.segments.len() as u64;
        report.counts.ray_tests = map.tests;
        report.counts.contour_curves = map.contours.curves;
        report.counts.contour_bare = map.contours.unmatched;
        report.counts.contour_folds = map.contours.folds;
        report.counts.chains = chains.len() as u64;
        report.counts.points =
            layers.iter().flat_map(|l| &l.marks).map(|m| drawing_report::points(&m.path)).sum();
        let mut of_drawing: Vec<Warning> = mesh_defects::of_mesh(&surface.mesh, scene).iter().collect();
        of_drawing.extend(self.warnings.iter());
        of_drawing.extend(paints.iter().flat_map(|paints| paints.warnings.iter()));
        let has_no_moment = style.motion.enabled && scene.movers.is_none();
        let notes = warnings
            .into_iter()
            .chain(view_hatching::too_dark(style, page.unit))
            .chain(has_no_moment.then(|| motion_line_pass::NO_MOMENT.to_owned()));
        of_drawing.extend(notes.map(|note| Warning::of_kind(WarningKind::Note, note)));
        if stage.is_none() && empty_drawing::shows_nothing(&layers) {
            let viewed_mesh = (&surface.mesh, view);
            let reason = empty_drawing::empty_reason(scene, viewed_mesh, style, !chains.is_empty());
            of_drawing.push(Warning::of_kind(WarningKind::EmptyDrawing, reason));
        }
        report.warnings = of_drawing.iter().map(Warning::to_string).collect();
        Ok((
            Drawing { title: title(scene), page, layers, hotspots: Vec::new(), warnings: of_drawing },
            report,
        ))
    }
}

/// The model's name: the stem of its file name.
fn title(scene: &Scene) -> String {
    let stem = scene.file.as_ref().and_then(|file| file.file_stem());
    stem.map_or_else(|| "drawing".to_owned(), |stem| stem.to_string_lossy().into_owned())
}
