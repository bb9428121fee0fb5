//! Drawing of one comic panel: its scene, its border, and the parts that break out of the border.
//!
//! Input: the panel's outline in page mm, and its keys in the page file. Output: drawings placed on the page.
//!
//! 1. The scene is assembled, and the bounding box of the panel becomes the frame of its camera. If parts
//!    break out, the frame is enlarged by a margin.
//! 2. The scene is drawn once and clipped to the outline of the panel.
//! 3. The marks of the parts that break out are copied from that drawing. They are painted over the border,
//!    outside the panel only.

use kurbo::{Affine, BezPath, Rect, Shape as _, Vec2};
use toml::Spanned;

use super::comic_keys::{ComicPage, PanelKeys};
use super::panel_border::panel_border;
use super::panel_outlines::{PageBoxes, PanelOutline};
use crate::colour::srgb::Colour;
use crate::drawing::{Drawing, Layer, LayerKind, Mark, Page, Paint, PlacedDrawing, Provenance, Unit};
use crate::error::Error;
use crate::page::figure::{self, CoverageGrid, PartExtent, camera_spec, name_matches};
use crate::page::mm_length::Mm;
use crate::page::page_source::PageSource;
use crate::pipeline;
use crate::scene::{Camera, Part, Scene};
use crate::style::Style;

/// How far a part may break out of its panel, as a share of the panel's shorter side.
const BREAK_MARGIN_SHARE: f64 = 0.5;

/// Overlap of broken-out parts with the panel, mm; it prevents gaps.
const BREAK_OVERLAP_MM: f64 = 0.1;

/// A panel that has been drawn.
pub(crate) struct DrawnPanel {
    /// The drawing of the scene, clipped to the panel, and the border.
    pub items: Vec<PlacedDrawing>,
    /// Parts that break out of the border; they may cover other panels.
    pub breakout: Option<PlacedDrawing>,
    /// The scene and its camera; `None` without a model.
    pub scene: Option<PanelScene>,
    /// Warnings about the panel.
    pub warnings: Vec<String>,
}

/// The scene of a panel with its camera.
pub(crate) struct PanelScene {
    scene: Scene,
    camera: Camera,
    /// Page position of the upper left corner of the camera's frame, mm.
    frame_origin: Vec2,
}

impl PanelScene {
    /// Grid of the panel area that models cover, so that text can be placed elsewhere.
    ///
    /// `parts` holds part names. Names of the form `model/part` select the models that count as figures,
    /// which weigh more than other models. Without such a name, all models are figures.
    pub(crate) fn coverage(&self, parts: &[&str]) -> CoverageGrid {
        let models: Vec<&str> =
            parts.iter().filter_map(|part| part.split_once('/')).map(|(model, _)| model).collect();
        let is_figure = |part: &Part| {
            let own = part.name.split_once('/').map(|(model, _)| model);
            models.is_empty() || own.is_some_and(|own| models.contains(&own))
        };
        CoverageGrid::of(&self.scene, &self.camera, self.frame_origin.to_point(), &is_figure)
    }

    /// Bounds and hulls on the page, mm, of the parts whose names match a pattern.
    ///
    /// # Errors
    /// Returns an error if no part matches.
    pub(crate) fn part_bounds(
        &self,
        glob: &Spanned<String>,
        source: &PageSource,
    ) -> Result<Vec<PartExtent>, Error> {
        let mut places = figure::find_part_bounds(&self.scene, &self.camera, glob.get_ref());
        if !self.scene.parts.iter().any(|part| name_matches(glob.get_ref(), &part.name)) {
            return Err(camera_spec::unknown_part(glob, &self.scene, source));
        }
        for place in &mut places {
            place.bounds = place.bounds + self.frame_origin;
            place.hull.iter_mut().for_each(|p| *p += self.frame_origin);
        }
        Ok(places)
    }
}

/// Draws a panel with its border.
///
/// # Errors
/// Returns an error if a model, style or camera is missing or invalid.
pub(crate) fn draw_panel(
    shape: &PanelOutline,
    page: &ComicPage,
    sheet: &PageBoxes,
    source: &PageSource,
) -> Result<DrawnPanel, Error> {
    let bounds = shape.outline.bounds();
    let none = PanelKeys::default();
    let keys = shape.keys.map_or(&none, Spanned::get_ref);
    let name = keys.style.as_ref().unwrap_or(&page.style);
    let sets: Vec<Spanned<String>> = page.set.iter().chain(&keys.set).cloned().collect();
    let mut style = figure::style(name, &sets, source)?;
    if let Some(colour) = &keys.background {
        style.background = parse_background(colour, source)?;
    }
    let warnings = figure::figure_style::unit_warning(name, &sets, source).into_iter().collect();
    let mut drawn = DrawnPanel { items: Vec::new(), breakout: None, scene: None, warnings };
    let item = |name: &str, drawing, corner: Vec2, clip| PlacedDrawing {
        name: name.to_owned(),
        drawing,
        place: Affine::translate(corner),
        clip: Some(clip),
    };
    let outline = shape.outline.path();
    let mut broken = None;
    if keys.model.0.is_empty() {
        let size = paper([bounds.width(), bounds.height()], style.background);
        let drawing = Drawing::new(&shape.name, size, Vec::new());
        drawn.items.push(item(&shape.name, drawing, bounds.origin().to_vec2(), outline));
    } else {
        let (time, animation) = (keys.time.as_ref(), keys.animation.as_ref());
        let scene = figure::assemble_scene(&keys.model, time, animation, &style, source)?;
        let usual = Spanned::new(0..0, figure::CameraSpec::default());
        let aim = keys.camera.as_ref().unwrap_or(&usual);
        let camera = figure::camera(aim, &scene, [bounds.width(), bounds.height()], source)?;
        for glob in &keys.breaking {
            if !scene.parts.iter().any(|part| name_matches(glob.get_ref(), &part.name)) {
                return Err(camera_spec::unknown_part(glob, &scene, source));
            }
        }
        // Parts that break out are drawn outside the panel, so the frame must be larger.
        let beyond = if keys.breaking.is_empty() {
            0.0
        } else {
            BREAK_MARGIN_SHARE * bounds.width().min(bounds.height())
        };
        let wide = widen_frame(&camera, beyond);
        let size = paper([wide.width, wide.height], style.background);
        let (mut drawing, warnings) = figure::draw(&scene, &wide, &style, size)?;
        drawing.title.clone_from(&shape.name);
        let told = warnings.into_iter().map(|warning| format!("{}: {warning}", shape.name));
        drawn.warnings.extend(told);
        let corner = bounds.origin().to_vec2() - Vec2::new(beyond, beyond);
        if beyond > 0.0 {
            broken = Some((break_out_drawing(&drawing, &scene, &wide, &style, keys)?, corner));
        }
        drawn.items.push(item(&shape.name, drawing, corner, outline));
        drawn.scene = Some(PanelScene { scene, camera, frame_origin: bounds.origin().to_vec2() });
    }
    let border = keys.border.as_ref().unwrap_or(&page.border);
    source.check([border], |Mm(mm)| *mm >= 0.0, "this length is below 0", "write 0 or more")?;
    let Mm(width) = *border.get_ref();
    let hand = page.hand.get_ref().0;
    if width > 0.0 {
        let name = format!("{}-border", shape.name);
        drawn.items.push(panel_border(
            &name,
            &shape.outline,
            [width, hand],
            page.lettering.colour,
            sheet.bleed,
        ));
    }
    if let Some((drawing, corner)) = broken {
        let inner = shape.outline.inset(width / 2.0 + hand + BREAK_OVERLAP_MM);
        let clip = frame_with_hole(sheet.bleed, &inner.path());
        drawn.breakout = Some(item(&format!("{}-break", shape.name), drawing, corner, clip));
    }
    Ok(drawn)
}

fn paper([width, height]: [f64; 2], background: Option<Colour>) -> Page {
    Page { width, height, unit: Unit::Mm, background }
}

/// Parses a colour or `none`.
fn parse_background(word: &Spanned<String>, source: &PageSource) -> Result<Option<Colour>, Error> {
    if word.get_ref().eq_ignore_ascii_case("none") {
        return Ok(None);
    }
    let colour = Colour::parse(word.get_ref()).ok_or_else(|| {
        let message = format!("`{}` is not a colour", word.get_ref());
        source.fault(&word.span(), &message, "write it as #rrggbb, by its name in CSS, or none")
    })?;
    Ok(Some(colour))
}

/// The camera with a frame that is larger by a margin on each side and shows the same picture in its centre.
fn widen_frame(camera: &Camera, by: f64) -> Camera {
    if by == 0.0 {
        return *camera;
    }
    let larger = (camera.height + 2.0 * by) / camera.height;
    camera_spec::with_height(camera, |height| height * larger)
        .with_frame(camera.width + 2.0 * by, camera.height + 2.0 * by)
}

/// The marks of the parts that break out of the border, over fills in the background colour that hide the
/// border.
fn break_out_drawing(
    drawing: &Drawing,
    scene: &Scene,
    camera: &Camera,
    style: &Style,
    keys: &PanelKeys,
) -> Result<Drawing, Error> {
    let is_meant = |part: &str| keys.breaking.iter().any(|glob| name_matches(glob.get_ref(), part));
    let paper = style.background.unwrap_or(Colour::WHITE);
    let seen = pipeline::hotspots(scene, camera, drawing.page, style)?;
    let ground = seen.into_iter().filter(|spot| is_meant(&spot.part)).map(|spot| Mark {
        path: spot.outline,
        paint: Paint::Fill(paper),
        provenance: Provenance { part: Some(spot.part), ..Provenance::default() },
    });
    let mut layers: Vec<Layer> = drawing.layers.clone();
    for layer in &mut layers {
        layer.marks.retain(|mark| mark.provenance.part.as_deref().is_some_and(is_meant));
    }
    layers.retain(|layer| !layer.marks.is_empty());
    match layers.iter_mut().find(|layer| layer.kind == LayerKind::Fills) {
        Some(fills) => {
            let over = std::mem::replace(&mut fills.marks, ground.collect());
            fills.marks.extend(over);
        }
        None => {
            let marks = ground.collect();
            layers.insert(0, Layer { kind: LayerKind::Fills, pen: None, ordered: false, marks });
        }
    }
    let page = Page { background: None, ..drawing.page };
    Ok(Drawing::new(format!("{} over its border", drawing.title), page, layers))
}

/// A rectangle with a hole, as a clip path: everything outside the panel.
fn frame_with_hole(frame: Rect, hole: &BezPath) -> BezPath {
    let mut path = frame.to_path(0.1);
    path.extend(hole.reverse_subpaths());
    path
}
