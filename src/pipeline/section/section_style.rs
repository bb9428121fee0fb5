//! Additions to a style for models that were cut or exploded.
//!
//! - [`with_cut_hatching`] hatches the cut faces of a section. Neighbouring parts differ in angle or spacing.
//! - [`with_cut_hatching_for`] also avoids hatching parallel to the long sides of a part, for given cameras.
//! - [`with_trail_lines`] draws the trails of parts that were moved apart.
//!
//! A pattern is chosen by a kind, a small number that neighbouring parts do not share.

use super::cut_directions::{MAX_PARALLEL_DEG, long_sides};
use crate::drawing::{Length, Unit};
use crate::edit::explode::TRAIL;
use crate::edit::section::{CutFaces, Section, are_neighbours, material_name};
use crate::geometry::names::glob::Glob;
use crate::hatching::{Pattern, PatternKind};
use crate::lines::LineKind;
use crate::scene::{Camera, Scene};
use crate::strokes::{Condition, PenChange, Rule};
use crate::style::Style;

/// The style with thin chain lines (ISO 128-2, line type 04.1) for the trails of parts that were moved apart.
#[must_use]
pub(crate) fn with_trail_lines(style: &Style) -> Style {
    let mut style = style.clone();
    let dash = [24.0, 3.0, 0.5, 3.0].map(|part| Length::mm(part * TRAIL_MM));
    let pen =
        PenChange { width: Some(Length::mm(TRAIL_MM)), dash: Some(dash.into()), ..PenChange::default() };
    let when = Condition { material: Some(Glob::new(TRAIL)), ..Condition::default() };
    style.stroke.rules.push(Rule { when, pen });
    if !style.lines.kinds.contains(&LineKind::Wire) {
        style.lines.kinds.push(LineKind::Wire);
    }
    style
}

/// Width of trail lines, mm.
const TRAIL_MM: f64 = 0.25;

/// Default spacing of hatching lines on cut faces, and their width, mm.
const SPACING_MM: f64 = 2.0;
const WIDTH_MM: f64 = 0.18;

/// Angles (degrees) and spacing factors of the hatching of cut parts. Neighbours differ in at least one of
/// them (ISO 128-50, 6.2).
const HATCH_KINDS: [(f64, f64); 8] = [
    (45.0, 1.0),
    (135.0, 1.0),
    (45.0, 1.7),
    (135.0, 1.7),
    (45.0, 0.6),
    (135.0, 0.6),
    (30.0, 1.0),
    (120.0, 1.0),
];

/// Additional angles, for parts with long sides along 45 and 135 degrees.
const EXTRA_ANGLES_DEG: [f64; 6] = [60.0, 150.0, 15.0, 105.0, 75.0, 165.0];

/// Spacing factors of hatching at the additional angles.
const SPACING_FACTORS: [f64; 3] = [1.0, 1.7, 0.6];

/// Number of kinds of hatching: [`HATCH_KINDS`], then [`EXTRA_ANGLES_DEG`] and 180 whole degrees, each with
/// every factor of [`SPACING_FACTORS`].
const KIND_COUNT: usize = HATCH_KINDS.len() + (EXTRA_ANGLES_DEG.len() + 180) * SPACING_FACTORS.len();

/// Angle (degrees) and spacing factor of a kind. The last kinds use whole degrees, starting next to 45 and
/// 135.
fn hatching_of_kind(kind: usize) -> (f64, f64) {
    let kind = kind % KIND_COUNT;
    let Some(more) = kind.checked_sub(HATCH_KINDS.len()) else { return HATCH_KINDS[kind] };
    let (number, farther) = (more / SPACING_FACTORS.len(), SPACING_FACTORS[more % SPACING_FACTORS.len()]);
    let angle = EXTRA_ANGLES_DEG.get(number).copied().unwrap_or_else(|| {
        let degree = (number - EXTRA_ANGLES_DEG.len()) as f64;
        let turn = ((degree / 4.0).floor() + 1.0) * if degree % 4.0 < 2.0 { 1.0 } else { -1.0 };
        (if degree % 2.0 == 0.0 { 45.0 } else { 135.0 } + turn).rem_euclid(180.0)
    });
    (angle, farther)
}

/// Like [`with_cut_hatching`], for particular views of a cut scene.
///
/// If the hatching of a part would run within 10 degrees of its long sides in the picture of any camera,
/// another angle is used where one exists. Neighbouring parts still differ. The kinds of the faces and the
/// names of their materials are updated. Parts are handled by decreasing area.
///
/// Source: ISO 128-50:2001, 4.
#[must_use]
pub(crate) fn with_cut_hatching_for(
    style: &Style,
    scene: &mut Scene,
    faces: &mut [CutFaces],
    cameras: &[Camera],
) -> Style {
    let mut order: Vec<usize> = (0..faces.len()).collect();
    order.sort_by(|a, b| faces[*b].area.total_cmp(&faces[*a].area).then(a.cmp(b)));
    let mut done: Vec<usize> = Vec::new();
    for own in order {
        let sides = long_sides(scene, &faces[own], cameras);
        let runs_along = |angle: f64| {
            let apart = |side: &f64| (angle - side).rem_euclid(180.0);
            sides.iter().map(apart).any(|apart| apart.min(180.0 - apart) < MAX_PARALLEL_DEG)
        };
        let near = done.iter().filter(|other| are_neighbours(&faces[own], &faces[**other]));
        let taken: Vec<usize> = near.map(|other| faces[*other].kind).collect();
        // A pattern that the style defines itself keeps its angle.
        let is_right = |kind: &usize| {
            !taken.contains(kind)
                && (has_pattern(style, &material_name(*kind)) || !runs_along(hatching_of_kind(*kind).0))
        };
        let usual = || (0..).find(|kind| !taken.contains(kind)).unwrap_or_default();
        let kind = (0..KIND_COUNT).find(is_right).unwrap_or_else(usual);
        faces[own].kind = kind;
        if let Some(material) = scene.materials.get_mut(faces[own].material as usize) {
            material.name = material_name(kind);
        }
        done.push(own);
    }
    with_kinds(style, faces)
}

/// Whether a style has its own pattern for a material.
fn has_pattern(style: &Style, name: &str) -> bool {
    style.patterns.iter().any(|own| own.material != Glob::new("*") && own.material.matches(name))
}

/// The style with thin hatching on the cut faces of a section, at 45 degrees or at other angles and spacings
/// on neighbouring parts.
///
/// The outlines of these faces are as wide as the widest lines of the style. A pattern that the style itself
/// has for their material (`cut 1`, `cut 2` and so on) is kept.
///
/// Source: ISO 128-50:2001, Basic conventions for representing areas on cuts and sections, 4 and 6.
#[must_use]
pub fn with_cut_hatching(style: &Style, section: &Section) -> Style {
    with_kinds(style, &section.faces)
}

/// Adds a pattern for each kind of the cut faces, and the pen of their outlines.
fn with_kinds(style: &Style, faces: &[CutFaces]) -> Style {
    let mut style = style.clone();
    let mut kinds: Vec<usize> = faces.iter().map(|faces| faces.kind).collect();
    kinds.sort_unstable();
    kinds.dedup();
    if kinds.is_empty() {
        return style;
    }
    if !style.hatch.enabled {
        // Patterns need the hatching pass, but nothing except cut faces is hatched.
        style.hatch.enabled = true;
        style.hatch.layers.clear();
        style.hatch.coverage.clear();
        style.hatch.materials.clear();
        style.hatch.blacks = 0;
        style.hatch.cast_shadows = false;
        style.shade.thresholds.clear();
        style.shade.materials.clear();
    }
    for kind in kinds {
        let name = material_name(kind);
        if has_pattern(&style, &name) {
            continue;
        }
        let (angle, farther) = hatching_of_kind(kind);
        style.patterns.push(Pattern {
            material: Glob::new(name),
            kind: PatternKind::Lines,
            size: Length::mm(SPACING_MM * farther),
            width: Length::mm(WIDTH_MM),
            angle,
            colour: style.stroke.pen.colour,
            unpainted: true,
            ..Pattern::default()
        });
    }
    // Outlines are as wide as the widest line of the style.
    let always = |rule: &&Rule| {
        rule.when.part.is_none() && rule.when.material.is_none() && rule.when.hidden != Some(true)
    };
    let widths = style.stroke.rules.iter().filter(always).filter_map(|rule| rule.pen.width);
    let mm = |width: &Length| width.in_unit(Unit::Mm);
    let width = widths.max_by(|a, b| mm(a).total_cmp(&mm(b)));
    let width = width.filter(|width| mm(width) > mm(&style.stroke.pen.width));
    let material = Some(Glob::new("cut *"));
    let when = Condition { material, hidden: Some(false), ..Condition::default() };
    style.stroke.rules.push(Rule { when, pen: PenChange { width, ..PenChange::default() } });
    style
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn section_hatchings_differ_and_begin_with_the_usual_angles() {
        assert_eq!([0, 1, 2].map(hatching_of_kind), [(45.0, 1.0), (135.0, 1.0), (45.0, 1.7)]);
        let degrees = |kind: usize| {
            (hatching_of_kind(kind).0.round() as usize, (hatching_of_kind(kind).1 * 10.0) as usize)
        };
        let all: std::collections::BTreeSet<_> = (0..KIND_COUNT).map(degrees).collect();
        assert!((0..180).all(|degree| degree == 45 || degree == 135 || all.contains(&(degree, 10))));
        let first = (0..60).map(degrees).collect::<std::collections::BTreeSet<_>>();
        assert!(first.len() > 50, "{first:?}");
    }
}
