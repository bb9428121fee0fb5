//! [`hatched`], [`trailed`]: styles that also hatch the faces along which a scene is cut open, and draw trails of parts.

use crate::drawing::{Length, Unit};
use crate::explode::TRAIL;
use crate::hatch::{Pattern, PatternKind};
use crate::lines::LineKind;
use crate::math::glob::Glob;
use crate::section::{Section, material_name};
use crate::stroke::{Condition, PenChange, Rule};
use crate::style::Style;

/// The style with thin chain lines (ISO 128-2, line type 04.1) for the trails of parts that were moved apart.
#[must_use]
pub fn trailed(style: &Style) -> Style {
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

/// Width of trail lines.
const TRAIL_MM: f64 = 0.25;

/// The distance of lines on cut faces, and their width.
const SPACING_MM: f64 = 2.0;
const WIDTH_MM: f64 = 0.18;

/// Degrees that the lines of cut parts are turned by, and by how much they are farther apart: neighbours differ in one of both
/// (ISO 128-50, 6.2).
const KINDS: [(f64, f64); 8] = [
    (45.0, 1.0),
    (135.0, 1.0),
    (45.0, 1.7),
    (135.0, 1.7),
    (45.0, 0.6),
    (135.0, 0.6),
    (30.0, 1.0),
    (120.0, 1.0),
];

/// The style with thin lines at 45 degrees on the cut faces of a section, at other angles or distances on neighbouring parts, and with
/// outlines of these faces as wide as the widest lines of the style. A pattern
/// that the style itself has for the material of such faces (`cut 1`, `cut 2` and so on) is left as it is.
///
/// Source: ISO 128-50:2001, Basic conventions for representing areas on cuts and sections, 4 and 6.
#[must_use]
pub fn hatched(style: &Style, section: &Section) -> Style {
    let mut style = style.clone();
    let mut kinds: Vec<usize> = section.faces.iter().map(|faces| faces.kind).collect();
    kinds.sort_unstable();
    kinds.dedup();
    if kinds.is_empty() {
        return style;
    }
    if !style.hatch.enabled {
        // What is seen where is asked for; nothing but cut faces is hatched.
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
        if style.patterns.iter().any(|own| own.material != Glob::new("*") && own.material.matches(&name)) {
            continue;
        }
        let (angle, farther) = KINDS[kind % KINDS.len()];
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
    // Their outlines are as wide as any line of the style.
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
