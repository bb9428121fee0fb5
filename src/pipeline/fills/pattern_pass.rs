//! Marks of patterns over the tones of a view.

use std::sync::Arc;

use kurbo::Vec2;

use super::surface_fills::SurfaceFills;
use super::surface_patterns;
use super::view_hatching::cut_of;
use crate::colour::srgb::Colour;
use crate::drawing::{Mark, Page};
use crate::hatching::guides::section_guides;
use crate::hatching::{self, Guide, HatchContext, Pattern, PatternFixed, PatternKind, SurfacePattern};
use crate::regions::surface_curves::level_curves::{are_visible, level_curves};
use crate::regions::{HatchRegions, LabelledPage};
use crate::scene::{Camera, Scene};
use crate::style::Style;

/// Greatest coverage of pattern lines. Denser parts are omitted, because they would fill surfaces that turn
/// away from the camera.
const MAX_LINE_COVERAGE: f64 = 0.7;

/// The marks of all patterns of a style.
pub(crate) fn marks(
    fills: &SurfaceFills,
    labelled_page: &LabelledPage,
    scene: &Scene,
    (page, camera, style): (&Page, &Camera, &Style),
) -> Vec<Mark> {
    let is_drawn = |own: &&Pattern| style.region.enabled || own.unpainted;
    if !style.patterns.iter().any(|own| is_drawn(&own)) {
        return Vec::new();
    }
    let offset = Vec2::new(page.width - camera.width, page.height - camera.height) / 2.0;
    let hatch_regions = HatchRegions::toned(labelled_page, style.region.crumb, page.unit, offset);
    let parts: Vec<Arc<str>> = scene.parts.iter().map(|part| Arc::from(part.name.as_str())).collect();
    let materials: Vec<(Arc<str>, Colour)> =
        scene.materials.iter().map(|own| (Arc::from(own.name.as_str()), own.colour)).collect();
    let context = HatchContext {
        unit: page.unit,
        seed: style.seed,
        parts: &parts,
        materials: &materials,
        paints: &fills.paint_colours(scene, style),
        tones: &[],
        samples: None,
        paper: style.background.unwrap_or(Colour::WHITE),
        flows: &[],
        fixed: &[],
        frame: None,
    };
    let of = |settings: &Pattern| {
        let fixed = match (settings.fixed, settings.kind) {
            (PatternFixed::Page, _) => None,
            (PatternFixed::Surface, PatternKind::Lines | PatternKind::Crosses) => {
                Some(SurfacePattern::Guides(guides(fills, &hatch_regions, scene, settings, page, offset)))
            }
            (PatternFixed::Surface, PatternKind::Dots | PatternKind::Tile) => {
                Some(surface_patterns::surface_figures(
                    &fills.lit(),
                    &hatch_regions,
                    scene,
                    settings,
                    page,
                    offset,
                ))
            }
        };
        let tones = |label: &crate::regions::SurfaceLabel| fills.tone_count(label.paint);
        hatching::pattern(&hatch_regions, &context, settings, tones, fixed.as_ref())
    };
    style.patterns.iter().filter(is_drawn).flat_map(of).collect()
}

/// The lines of a pattern that is fixed to the surface: cuts through the model, spaced as on the page at the
/// camera's target.
fn guides(
    fills: &SurfaceFills,
    ground: &HatchRegions,
    scene: &Scene,
    own: &Pattern,
    page: &Page,
    offset: Vec2,
) -> Vec<Guide> {
    let lit = fills.lit();
    let frame = &lit.view.frame;
    let [size, width] = [own.size, own.width].map(|length| length.in_unit(page.unit));
    let spacing = surface_patterns::in_model(size, frame);
    let turns = if own.kind == PatternKind::Crosses { &[0.0, 90.0][..] } else { &[0.0] };
    let of = |turn: &f64| {
        let across = cut_of(scene, (own.angle + turn).to_radians());
        let cut = |face: u32| Some(fills.rest_corners(face).map(|p| p.dot(across) / spacing));
        let curves = level_curves(&lit, offset, cut, |_, density| density * width < MAX_LINE_COVERAGE);
        section_guides::guides_along_curves(
            ground,
            &curves,
            |points| are_visible(&lit, offset, points),
            |_, _| 0,
            size,
            0,
        )
    };
    turns.iter().flat_map(of).collect()
}
