//! Requirements of a style on the surface: light, paints, tones and feature lines.

use crate::hatching::{Direction, HatchLayer, PatternFixed};
use crate::light::ToneOptions;
use crate::light::tones::tone_options::ToneScale;
use crate::lines::{LineKind, LineOptions, Source};
use crate::regions::ShadowDarkening;
use crate::style::Style;

/// Whether a style needs light on the surface, for paint or hatching.
pub(crate) fn is_lit(style: &Style) -> bool {
    style.region.enabled || style.hatch.enabled
}

/// Whether a style draws lines where tones change.
pub(crate) fn draws_isophotes(style: &Style) -> bool {
    let lines = &style.lines;
    lines.enabled && lines.source != Source::Image && lines.kinds.contains(&LineKind::Isophote)
}

/// Whether a style needs the paints of the surface: for fills, for lines between painted colours, or for
/// lines between tones.
pub(crate) fn uses_paints(style: &Style) -> bool {
    is_lit(style) || draws_artist_lines(style) || draws_isophotes(style)
}

/// Whether a style draws lines between painted colours.
pub(crate) fn draws_artist_lines(style: &Style) -> bool {
    style.lines.enabled && style.lines.kinds.contains(&LineKind::Artist)
}

/// Whether a style lays strokes or patterns that are fixed to the model.
pub(crate) fn has_model_fixed_marks(style: &Style) -> bool {
    let fixed = |layer: &HatchLayer| matches!(layer.direction, Direction::Object | Direction::Uv);
    let hatches = style.hatch.enabled && style.hatch.layers.iter().any(fixed);
    hatches || style.patterns.iter().any(|own| own.fixed == PatternFixed::Surface)
}

/// Which of tones and hatching bins cast shadows darken.
pub(crate) fn darkened(style: &Style) -> ShadowDarkening {
    ShadowDarkening {
        tones: has_tones(style) && style.tones.cast_shadows,
        bins: style.hatch.enabled && style.hatch.cast_shadows,
    }
}

/// Whether light is divided into tones, for paint or for lines between tones.
fn has_tones(style: &Style) -> bool {
    style.region.enabled || draws_isophotes(style)
}

/// The tone options of a style; a single tone if it needs none.
pub(crate) fn tones(style: &Style) -> ToneOptions {
    let ShadowDarkening { tones, bins } = darkened(style);
    let cast_shadows = tones || bins;
    if has_tones(style) {
        return ToneOptions { cast_shadows, ..style.tones.clone() };
    }
    ToneOptions { scale: ToneScale::Thresholds(Vec::new()), cast_shadows, ..ToneOptions::default() }
}

/// Kinds of lines that separate regions, drawn or not.
const REGION_BORDER_KINDS: [LineKind; 4] =
    [LineKind::Contour, LineKind::Border, LineKind::Material, LineKind::Intersection];

/// Options for the feature lines to be found: those that the style draws, and with regions, those that may
/// separate them.
pub(crate) fn required_lines(style: &Style) -> LineOptions {
    let mut options = style.lines.clone();
    if options.source == Source::Image {
        options.kinds.clear();
    }
    if !is_lit(style) {
        return options;
    }
    if !options.enabled {
        options.enabled = true;
        options.kinds = Vec::new();
    }
    // Hatching strokes end at creases as well.
    let creases = style.hatch.enabled.then_some(LineKind::Crease);
    let missing = REGION_BORDER_KINDS
        .into_iter()
        .chain(creases)
        .filter(|kind| !options.kinds.contains(kind))
        .collect::<Vec<_>>();
    options.kinds.extend(missing);
    options
}
