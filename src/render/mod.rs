//! The pipeline, on one screen.
//!
//! ```
//! use ligne::render::Prepared;
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

mod anchors;
mod areas;
mod at_rest;
mod beside;
pub mod defects;
mod fills;
mod glass;
mod hatching;
mod hidden;
mod image;
mod late_search;
mod late_shadows;
mod maps;
mod motion;
mod on_page;
mod on_surface;
mod on_threads;
mod painted;
mod patterns;
mod pictures;
pub mod report;
mod resting;
mod sections;
pub mod stage;
mod stages;
mod under;
mod welded;

use std::borrow::Cow;
use std::sync::Arc;

pub use areas::hotspots;
pub use maps::MapFiles;
pub use report::{Report, Stopwatch};
pub use resting::Resting;
pub use sections::{hatched, trailed};
pub use stage::Stage;

use crate::drawing::{Drawing, Layer, Length, Page, Unit};
use crate::error::Error;
use crate::hatch::{self, Hatched};
use crate::lines::{self, FeatureLines, Known, LineOptions, Surface, Textures};
use crate::math::colour::Colour;
use crate::mesh::solid::solid_parts;
use crate::region::{Ground, PageBorders};
use crate::scene::{Camera, Scene, Warnings, paint::Paints};
use crate::shape::Patches;
use crate::stroke::{self, InkContext, Parting};
use crate::style::Style;
use crate::view::View;
use crate::viewmap::{self, Ahead, ViewMap};
use anchors::Anchors;
use beside::Beside;
use fills::{Colours, Fills, Paintable};
use glass::Behind;
use hatching::Hatching;
use late_search::LateSearch;
use late_shadows::LateShadows;
use motion::Trails;
use on_page::{centre_on_page, margin};
use on_threads::on_threads;
use painted::{Painted, Unpainted};
use stages::Made;
use welded::Welded;

/// Draws a scene on a page in px that is as large as the camera's frame.
///
/// ```no_run
/// use ligne::{render, scene::{Camera, Scene}, style::Style};
///
/// let scene = Scene::open("gear.obj")?;
/// let camera = Camera::three_quarter().fit(&scene);
/// let style = Style::preset("ink").unwrap_or_default();
/// let drawing = render::render(&scene, &camera, &style)?;
/// drawing.warnings.iter().for_each(|warning| eprintln!("{warning}"));
/// println!("{}", drawing.to_svg(&ligne::export::SvgOptions::default()));
/// # Ok::<(), ligne::Error>(())
/// ```
///
/// # Errors
/// If the camera can take no picture: see [`Camera::validate`].
pub fn render(scene: &Scene, camera: &Camera, style: &Style) -> Result<Drawing, Error> {
    let page =
        Page { width: camera.width, height: camera.height, unit: Unit::Px, background: style.background };
    render_reported(scene, camera, style, page, None).map(|(drawing, _)| drawing)
}

/// Draws a scene on a page, with the camera's frame in the page's middle, and reports what it
/// took. With a stage named, what that stage made is drawn instead.
///
/// The report's load and write times and its path counts are left to the caller.
///
/// # Errors
/// If the camera can take no picture: see [`Camera::validate`].
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

/// A scene made ready for a style: what all its views share.
///
/// ```no_run
/// use ligne::{drawing::{Page, Unit}, render::Prepared, scene::{Camera, NamedView, Scene}, style::Style};
///
/// let scene = Scene::open("gear.obj")?;
/// let style = Style::preset("toon").unwrap_or_default();
/// let prepared = Prepared::new(&scene, &style);
/// for view in [NamedView::Front, NamedView::Top] {
///     let camera = Camera::named(view, scene.up).fit(&scene);
///     let page = Page { width: camera.width, height: camera.height, unit: Unit::Px, background: None };
///     let (drawing, _report) = prepared.draw(&camera, page, None)?;
///     println!("{}", drawing.to_svg(&ligne::export::SvgOptions::default()));
/// }
/// # Ok::<(), ligne::Error>(())
/// ```
#[derive(Debug)]
pub struct Prepared<'a> {
    /// What is drawn of the scene: without what pictures of its materials leave clear.
    scene: Cow<'a, Scene>,
    warnings: Warnings,
    style: &'a Style,
    sought: LineOptions,
    /// Where surfaces are painted or hatched, or lines take their colour: the paints of the scene.
    paints: Option<Arc<Paints>>,
    surface: Surface,
    /// How many vertices and edges the model has.
    counts: [u64; 2],
    /// For views that need finer triangles it is made anew.
    paintable: Option<Paintable>,
    search: LateSearch,
    shadows: LateShadows,
    /// Where lines are told to stay on the model.
    anchors: Option<Anchors>,
}

impl<'a> Prepared<'a> {
    /// Welds the scene to a mesh and finds where its surface is creased and where it is round.
    #[must_use]
    pub fn new(scene: &'a Scene, style: &'a Style) -> Self {
        on_threads(|| Self::made(Welded::of(scene, style), style, None).0)
    }

    /// Does so for one camera: the surface gets the finer triangles that it needs there at once and for good, which takes less
    /// memory than to have them beside those of the model.
    #[must_use]
    pub fn for_camera(scene: &'a Scene, style: &'a Style, camera: &Camera) -> Self {
        on_threads(|| Self::made(Welded::of(scene, style), style, Some(camera)).0)
    }

    /// Does so for one camera with a scene that nobody else needs: its shapes go when the mesh is made of them, and are not held
    /// beside it.
    #[must_use]
    pub fn of_scene(scene: Scene, style: &'a Style, camera: &Camera) -> Self {
        on_threads(|| Self::made(Welded::of_all(scene, style), style, Some(camera)).0)
    }

    fn made(welded: Welded<'a>, style: &'a Style, only: Option<&Camera>) -> (Self, Option<Patches>) {
        let Welded { scene, warnings, paints, mesh } = welded;
        let sought = fills::sought(style);
        let (mut surface, mut patches) = Surface::with_patches(mesh, &sought);
        let counts = [surface.mesh.positions.len() as u64, surface.mesh.edges.len() as u64];
        let painted = paints.as_ref().filter(|_| fills::asks_surface(style));
        let painted = painted.map(|paints| (paints, solid_parts(&surface.mesh)));
        if let Some(camera) = only.filter(|camera| camera.validate().is_ok()) {
            patches = None;
            surface = surface.finer_for(camera);
        }
        let paintable = painted.map(|(paints, solid)| Paintable::new(&surface, paints, solid));
        let prepared = Self {
            scene,
            warnings,
            style,
            sought,
            paints: paints.map(Arc::new),
            surface,
            counts,
            paintable,
            search: LateSearch::default(),
            shadows: LateShadows::default(),
            anchors: None,
        };
        (prepared, patches)
    }

    /// Draws a view as [`render_reported`] does; the report has only the times of what was done for
    /// this view.
    ///
    /// # Errors
    /// If the camera can take no picture: see [`Camera::validate`].
    pub fn draw(
        &self,
        camera: &Camera,
        page: Page,
        stage: Option<Stage>,
    ) -> Result<(Drawing, Report), Error> {
        camera.validate()?;
        Ok(self.on_view(camera, page.unit, |on_view| self.drawn(on_view, camera, page, stage)))
    }

    /// The maps of a view that lines in the image are found in, whether the style seeks any or not. `unit` is that of the page.
    ///
    /// # Errors
    /// If the camera can take no picture: see [`Camera::validate`].
    pub fn maps(&self, camera: &Camera, unit: Unit) -> Result<MapFiles, Error> {
        camera.validate()?;
        on_threads(|| {
            let refined = self.surface.refined_for(camera, None);
            let surface = refined.as_ref().map_or(&self.surface, |finer| &finer.surface);
            let view = View::new(&surface.mesh, camera);
            let maps = image::maps(surface, &view, self.style, unit);
            MapFiles::new(&surface.mesh, &maps, &self.style.lines.image)
        })
    }

    /// What a view is hatched on, and the strokes of each layer of its hatching, each with what it is
    /// known by. `None` if the style hatches nothing, or the camera can take no picture.
    #[must_use]
    pub fn hatch_strokes(&self, camera: &Camera, page: Page) -> Option<(Ground, Vec<Hatched>)> {
        camera.validate().ok()?;
        self.on_view(camera, page.unit, |on_view| {
            let OnView { fills, map, behind, .. } = on_view;
            let fills = fills.filter(|_| self.style.hatch.enabled)?;
            let (scene, style) = (self.scene.as_ref(), self.style);
            let hatching = Hatching { fills, scene, page: &page, camera, style };
            let see = || fills.see(&PageBorders::of(&map, &on_view.view.frame), &page);
            let seen = behind.map_or_else(see, |behind| behind.see(fills, &page));
            Some(hatching.strokes(&seen))
        })
    }

    /// Decides what is seen of the lines of a view.
    fn on_view<T: Send>(&self, camera: &Camera, unit: Unit, call: impl FnOnce(OnView) -> T + Send) -> T {
        on_threads(|| self.decided(camera, unit, call))
    }

    fn decided<T>(&self, camera: &Camera, unit: Unit, call: impl FnOnce(OnView) -> T) -> T {
        let Self { scene, style, sought, paints, .. } = self;
        let mut report = Report::default();
        let mut watch = Stopwatch::start();
        [report.counts.vertices, report.counts.edges] = self.counts;

        let refined = self.surface.refined_for(camera, self.search.cones_of_next_view(&self.surface));
        let surface = refined.as_ref().map_or(&self.surface, |finer| &finer.surface);
        // Finer triangles are those of this view alone.
        let paint = || {
            let whole = self.paintable.as_ref().filter(|_| refined.is_some())?;
            Some(whole.finer(surface, paints.as_deref()?))
        };
        let search =
            || refined.as_ref().and_then(|finer| self.search.of_finer_view(&self.surface, finer, sought));
        let look = || rayon::join(|| View::new(&surface.mesh, camera), paint);
        let (finer, (view, own)) = rayon::join(search, look);
        let paintable = own.as_ref().or(self.paintable.as_ref());
        report.stages_ms.topology = watch.lap_ms();

        let panes = glass::Panes::of(surface, scene, style);
        // Through glass one sees more.
        let is_clear = panes.is_none();
        let in_sight =
            is_clear.then(|| self.search.in_sight(surface, &view, finer.as_ref(), sought)).flatten();
        let (covers, in_sight) = in_sight.unzip();
        let mut known = if surface.refined {
            Known { intersections: finer.as_ref(), ..Known::default() }
        } else {
            self.search.of_next_view(surface, sought, in_sight.is_none())
        };
        known.intersections = known.intersections.or(in_sight.as_ref());
        let mut lines = lines::extract_with(surface, known, &view, sought);
        let mut warnings = Vec::new();
        let px = Length::px(1.0).in_unit(unit);
        let of = |paints| Textures::new(&surface.mesh, &view, paints, px, &style.lines);
        let textures = paints.as_deref().map(of);
        let colours = paints.as_deref().zip(textures.as_ref());
        // What one sees through casts no shadow.
        let casting = panes.as_ref().map_or(&surface.mesh, glass::Panes::clear);
        // Shadows on faces that this view has cut are its own.
        let late = refined.is_none().then_some(&self.shadows);
        let fills = paintable.zip(colours).map(|(paintable, (paints, textures))| {
            let colours = Colours { paints, textures };
            let fills =
                Fills::new(surface, (casting, late), paintable, &view, scene, colours, style, &mut warnings);
            let moved = self.anchors.as_ref().filter(|_| fills::lays_through(style));
            moved.into_iter().fold(fills, Fills::laid_at)
        });
        warnings.extend(textures.iter().flat_map(Textures::warnings).cloned());
        if let Some(fills) = &fills {
            fills.add_tone_borders(&mut lines);
        }
        report.stages_ms.features = watch.lap_ms();

        let map = viewmap::build_with(&surface.mesh, &view, &lines, sought, covers.as_ref());
        report.stages_ms.visibility = watch.lap_ms();
        let behind = panes.as_ref().map(|panes| panes.look_behind(&surface.mesh, &view, &lines, sought));
        let (view, lines, fills, textures) = (&view, &lines, fills.as_ref(), textures.as_ref());
        call(OnView { surface, view, lines, textures, fills, map, behind, report, watch, warnings })
    }

    fn drawn(&self, on_view: OnView, camera: &Camera, page: Page, stage: Option<Stage>) -> (Drawing, Report) {
        let Self { scene, style, paints, .. } = self;
        let OnView { surface, view, lines, textures, fills, mut map, .. } = on_view;
        let OnView { mut behind, mut report, mut watch, mut warnings, .. } = on_view;
        let mut layers: Vec<Layer> = hatch::paper(&page, &style.paper, style.seed).into_iter().collect();
        let lit = fills.filter(|_| fills::is_lit(style));
        let borders = lit.map(|_| PageBorders::of(&map, &view.frame));
        let (whole, margin) = ((&surface.mesh, surface.pieces.as_slice()), margin(&view.frame, &page));
        // Both have parts that one thread does alone.
        let paint = || {
            let (fills, borders) = lit.zip(borders.as_ref())?;
            let (paints, behind) = (paints.as_deref(), behind.as_ref());
            let on = Unpainted { scene, style, paints, fills, surface, lines, borders, behind };
            Some(Painted::of(&on, &page, camera))
        };
        let link = || {
            let mut watch = Stopwatch::start();
            if fills.is_some() {
                fills::keep_inked(&mut map, style);
            }
            let lines = image::joined(&mut map, lines, surface, view, style, page.unit);
            let joining = watch.lap_ms();
            centre_on_page(&mut map, &view.frame, &page);
            let ahead = Ahead::new(whole, view, &lines, &map.seen_contours, margin);
            let chains = hidden::chains(&ahead, &map, style, page.unit, view.frame.perspective);
            (lines, chains, [joining, watch.lap_ms()])
        };
        let (painted, (lines, mut chains, [joining, linking])) = rayon::join(paint, link);
        let Painted { layers: painted, blacks, warnings: more, regions, leaks, regions_ms, hatching_ms } =
            painted.unwrap_or_default();
        layers.extend(painted);
        warnings.extend(more);
        (report.counts.regions, report.counts.leaks) = (regions, leaks);
        report.stages_ms.regions = regions_ms;
        report.stages_ms.hatching = hatching_ms;
        report.stages_ms.features += joining;
        let lines = &*lines;
        // Each of both has told its own time.
        watch.lap_ms();
        if let Some(behind) = &mut behind {
            chains.extend(behind.chains(style, page.unit, |veiled| {
                fills::keep_inked(veiled, style);
                centre_on_page(veiled, &view.frame, &page);
            }));
        }
        report.stages_ms.chains = linking + watch.lap_ms();

        let beside = Beside { scene, surface, view, style, margin, unit: page.unit };
        beside::ask(&mut chains, &beside);
        let paints = paints.as_deref();
        let colours = paints.zip(textures).map(|(paints, textures)| Colours { paints, textures });
        under::ask(&mut chains, &beside, lines, colours, blacks.as_ref());
        if let Some(anchors) = &self.anchors {
            anchors.ask(&mut chains, camera, margin);
        }
        let names = beside::names(lines, surface, &style.stroke);
        let parts: Vec<Arc<str>> = scene.parts.iter().map(|p| Arc::from(p.name.as_str())).collect();
        let materials: Vec<(Arc<str>, Colour)> =
            scene.materials.iter().map(|m| (Arc::from(m.name.as_str()), m.colour)).collect();
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
        };
        match stage {
            None => {
                let clear = behind.as_ref().map_or(&surface.mesh, Behind::clear);
                let centre = |map: &mut ViewMap| centre_on_page(map, &view.frame, &page);
                let trails = Trails::of((clear, view, camera), scene, style, page.unit, centre);
                layers.extend(trails.iter().flat_map(|trails| trails.ink(&context)));
                layers.extend(stroke::ink(&chains, &context, &style.stroke));
                layers.extend(hatch::tooth(&page, &style.paper, style.seed));
            }
            Some(stage) => {
                let ahead = Ahead::new(whole, view, lines, &map.seen_contours, margin);
                let made = Made {
                    surface,
                    view,
                    lines,
                    ahead: &ahead,
                    map: &map,
                    chains: &chains,
                    style,
                    page: &page,
                };
                layers = stages::draw(stage, &made);
            }
        }
        report.stages_ms.strokes = watch.lap_ms();

        report.counts.feature_edges = lines.segments.len() as u64;
        report.counts.ray_tests = map.tests;
        report.counts.contour_curves = map.contours.curves;
        report.counts.contour_bare = map.contours.bare;
        report.counts.contour_folds = map.contours.folds;
        report.counts.chains = chains.len() as u64;
        report.counts.points = layers.iter().flat_map(|l| &l.marks).map(|m| report::points(&m.path)).sum();
        report.warnings = defects::of_mesh(&surface.mesh, scene).lines();
        report.warnings.extend(self.warnings.lines());
        report.warnings.extend(paints.iter().flat_map(|paints| paints.warnings.lines()));
        report.warnings.extend(warnings);
        report.warnings.extend(hatching::too_dark(style, page.unit));
        if style.motion.enabled && scene.movers.is_none() {
            report.warnings.push(motion::NO_MOMENT.to_owned());
        }
        let warnings = report.warnings.clone();
        (Drawing { title: title(scene), page, layers, hotspots: Vec::new(), warnings }, report)
    }
}

/// A view whose lines are seen or hidden.
struct OnView<'a> {
    surface: &'a Surface,
    view: &'a View,
    lines: &'a FeatureLines,
    /// Where lines or surfaces have colours.
    textures: Option<&'a Textures>,
    /// Where surfaces are painted or hatched.
    fills: Option<&'a Fills<'a>>,
    map: ViewMap,
    /// What is seen through materials that are not opaque.
    behind: Option<Behind<'a>>,
    report: Report,
    watch: Stopwatch,
    warnings: Vec<String>,
}

/// The model's name: its file without folder and ending.
fn title(scene: &Scene) -> String {
    let stem = scene.file.as_ref().and_then(|file| file.file_stem());
    stem.map_or_else(|| "drawing".to_owned(), |stem| stem.to_string_lossy().into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_camera_that_can_take_no_picture_is_an_error_on_every_road() {
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
