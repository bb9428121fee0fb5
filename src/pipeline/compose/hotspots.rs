//! Hotspots: the visible area of each part of a scene, independent of the drawing style.

use std::sync::Arc;

use kurbo::BezPath;
use rustc_hash::FxHashMap;

use crate::drawing::{Hotspot, Page};
use crate::error::Error;
use crate::hatching::HatchOptions;
use crate::light::tones::tone_options::ToneScale;
use crate::light::{LightOptions, ShadeOptions, ToneOptions};
use crate::lines::{LineKind, LineOptions, Source};
use crate::mesh::{MaterialId, PaintId};
use crate::pipeline::Renderer;
use crate::regions::paint::region_paint;
use crate::regions::{self, PageBorders, RegionOptions, SurfaceLabel};
use crate::scene::{Camera, GlassDraw, GlassOptions, Scene, TextureFill, TextureOptions};
use crate::style::Style;

/// Kinds of lines between parts.
const PART_BORDER_KINDS: [LineKind; 5] =
    [LineKind::Contour, LineKind::Border, LineKind::Crease, LineKind::Material, LineKind::Intersection];

/// A style that paints each part in one tone. Lines run where those of `style` do.
fn one_tone(style: &Style) -> Style {
    let draw = if style.glass.draw == GlassDraw::Absent { GlassDraw::Absent } else { GlassDraw::Opaque };
    Style {
        lines: LineOptions {
            enabled: true,
            source: Source::Object,
            kinds: PART_BORDER_KINDS.to_vec(),
            ..style.lines.clone()
        },
        light: LightOptions::default(),
        tones: ToneOptions { scale: ToneScale::Thresholds(Vec::new()), ..ToneOptions::default() },
        textures: TextureOptions { fill: TextureFill::Off, ..style.textures },
        patterns: Vec::new(),
        region: RegionOptions { enabled: true, ..RegionOptions::default() },
        shade: ShadeOptions::default(),
        hatch: HatchOptions::default(),
        glass: GlassOptions { draw, ..style.glass.clone() },
        ..style.clone()
    }
}

/// The visible area of each part of a scene, in the order of the parts. Parts without a name are omitted;
/// parts of equal name are merged. Areas do not overlap.
///
/// ```
/// use ligne::drawing::{Page, Unit};
/// use ligne::{Camera, Scene, Style, pipeline};
///
/// let scene = Scene::open("examples/models/gear.obj")?;
/// let camera = Camera::three_quarter().fit(&scene);
/// let page = Page { width: camera.width, height: camera.height, unit: Unit::Px, background: None };
/// let mut drawing = pipeline::render(&scene, &camera, &Style::default())?;
/// drawing.hotspots = pipeline::hotspots(&scene, &camera, page, &Style::default())?;
/// assert!(drawing.to_svg(&Default::default()).contains("pointer-events=\"all\""));
/// # Ok::<(), ligne::Error>(())
/// ```
///
/// # Errors
/// If the camera is invalid: see [`Camera::validate`].
pub fn hotspots(scene: &Scene, camera: &Camera, page: Page, style: &Style) -> Result<Vec<Hotspot>, Error> {
    let style = one_tone(style);
    let prepared = Renderer::new(scene, &style);
    let by_part = |look: &SurfaceLabel| SurfaceLabel {
        part: look.part,
        material: MaterialId(0),
        paint: PaintId(0),
        tone: 0,
        bin: 0,
        cast: false,
    };
    let areas = prepared.with_visibility(camera, page.unit, |on_view| {
        let Some(fills) = on_view.fills else { return Ok(Vec::new()) };
        let seen = fills.label_page(&PageBorders::of(&on_view.map, &on_view.view.frame), &page);
        let regions = regions::gather_relabelled(&seen, by_part, &style.region, &style.chain, page.unit);
        let offset = fills.paint_context(&page, camera).offset;
        Ok(region_paint::outlines(&regions, offset, 0.0, |_| true))
    });
    let mut areas = areas?;
    areas.sort_by_key(|(_, region)| region.label.part);
    let mut spots: Vec<Hotspot> = Vec::new();
    let mut numbers: FxHashMap<&str, usize> = FxHashMap::default();
    for (path, region) in areas {
        let Some(part) = prepared.scene.parts.get(region.label.part.index()) else { continue };
        if part.name.is_empty() {
            continue;
        }
        let number = *numbers.entry(&part.name).or_insert_with(|| {
            spots.push(Hotspot { part: Arc::from(part.name.as_str()), outline: BezPath::new() });
            spots.len() - 1
        });
        if let Some(spot) = spots.get_mut(number) {
            spot.outline.extend(path);
        }
    }
    Ok(spots)
}
